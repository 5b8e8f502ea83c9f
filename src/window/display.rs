//! The window system behind [`Event`]s and pixels; what is peculiar to minifb 0.29 is dealt with here and nowhere else.
//!
//! Two limits remain. minifb reports keys to a callback but lets the button only be polled, so a click shorter than the
//! time between two polls is lost: poll often while the mouse is in use. And a window that another program destroys ends this one inside Xlib: write results first.

use std::cell::RefCell;
use std::rc::Rc;

use anyhow::{Context, anyhow, bail};
use minifb::{InputCallback, Key, MouseButton, MouseMode, ScaleMode, WindowOptions};
use raw_window_handle::{HasWindowHandle, RawWindowHandle};

use super::full_screen;
use super::input::Event;
use crate::canvas::Point;

/// Wayland tells the wheel in a length of its own; this much is a notch.
const WAYLAND_NOTCH: f32 = 10.0;

/// There is nothing to open a window on; nothing has been done.
#[derive(Debug, thiserror::Error)]
#[error("no display to open a window on ({reason})")]
pub struct NoDisplay {
    /// What the window system says.
    reason: String,
}

/// An open window.
pub struct Display {
    window: minifb::Window,
    reported: Rc<RefCell<Vec<Event>>>,
    /// What has happened since these were last taken, in order.
    pub events: Vec<Event>,
    is_wayland: bool,
    /// Whether keys come to this window.
    pub is_active: bool,
    mouse: Point,
    button: bool,
    wheel: f32,
}

/// Notes keys and characters as they are reported: polling would miss a tap between two polls.
struct Reporter(Rc<RefCell<Vec<Event>>>);

impl InputCallback for Reporter {
    fn add_char(&mut self, code: u32) {
        self.0
            .borrow_mut()
            .extend(char::from_u32(code).map(Event::Character));
    }

    fn set_key_state(&mut self, key: Key, down: bool) {
        self.0.borrow_mut().push(if down {
            Event::KeyDown(key)
        } else {
            Event::KeyUp(key)
        });
    }
}

impl Display {
    /// Opens a window with a picture area of `size` pixels.
    ///
    /// # Errors
    /// [`NoDisplay`] when there is nothing to open it on; when it cannot be opened there.
    pub fn open(title: &str, size: [usize; 2]) -> anyhow::Result<Self> {
        let options = WindowOptions {
            resize: true,
            // The picture is drawn at the window's size; only while that changes do they differ.
            scale_mode: ScaleMode::UpperLeft,
            ..WindowOptions::default()
        };
        // A window of no size ends the program inside Xlib.
        let mut window = minifb::Window::new(title, size[0].max(1), size[1].max(1), options)
            .map_err(not_opened)?;
        let reported = Rc::new(RefCell::new(Vec::new()));
        window.set_input_callback(Box::new(Reporter(Rc::clone(&reported))));
        let is_wayland = window
            .window_handle()
            .is_ok_and(|handle| matches!(handle.as_raw(), RawWindowHandle::Wayland(_)));
        Ok(Display {
            window,
            reported,
            events: Vec::new(),
            is_wayland,
            is_active: false,
            mouse: [0, 0],
            button: false,
            wheel: 0.0,
        })
    }

    /// Width and height of the picture area in pixels, each at least 1.
    pub fn size(&self) -> [usize; 2] {
        let (width, height) = self.window.get_size();
        [width.max(1), height.max(1)]
    }

    /// Whether the user has not closed the window.
    pub fn is_open(&self) -> bool {
        self.window.is_open()
    }

    /// Lets the window cover the screen, or gives it its size again.
    ///
    /// # Errors
    /// When the window system offers no such thing to this program.
    pub fn toggle_full_screen(&self) -> anyhow::Result<()> {
        match self.window.window_handle().map(|handle| handle.as_raw()) {
            Ok(RawWindowHandle::Xlib(handle)) => full_screen::toggle(handle.window as u32),
            _ => bail!("it is offered on X11 alone"),
        }
    }

    /// Says something in the window's frame.
    pub fn set_title(&mut self, title: &str) {
        self.window.set_title(title);
    }

    /// Shows a picture: 0x00RRGGBB, row by row from the top. Events are gathered on the way.
    ///
    /// # Errors
    /// When the window system refuses it.
    pub fn present(&mut self, pixels: &[u32], size: [usize; 2]) -> anyhow::Result<()> {
        let result = self.window.update_with_buffer(pixels, size[0], size[1]);
        self.gather();
        result.context("cannot show the picture")
    }

    /// Gathers events without showing anything.
    pub fn poll(&mut self) {
        self.window.update();
        self.gather();
    }

    fn gather(&mut self) {
        self.gather_keys();
        let is_active = self.window.is_active();
        if std::mem::replace(&mut self.is_active, is_active) && !is_active {
            self.events.push(Event::FocusLost);
        }
        self.gather_wheel();
        let button = self.window.get_mouse_down(MouseButton::Left);
        if button && !self.button {
            // The mouse was asked for its place before the press was told, and may have moved in between: ask again.
            self.window.update();
            self.gather_keys();
            self.gather_wheel();
        }
        self.gather_mouse();
        if button != self.button {
            self.button = button;
            self.events.push(if button {
                Event::MouseDown
            } else {
                Event::MouseUp
            });
        }
    }

    fn gather_keys(&mut self) {
        let mut reported = self.reported.take();
        if self.is_wayland {
            press_first(&mut reported);
        }
        self.events.append(&mut reported);
    }

    fn gather_mouse(&mut self) {
        let Some((x, y)) = self.window.get_mouse_pos(MouseMode::Pass) else {
            return;
        };
        let mouse = [x.floor() as i32, y.floor() as i32];
        if mouse != self.mouse {
            self.mouse = mouse;
            self.events.push(Event::MouseAt(mouse));
        }
    }

    fn gather_wheel(&mut self) {
        let Some((_, turned)) = self.window.get_scroll_wheel() else {
            return;
        };
        if !self.is_wayland {
            // How much is told for one notch differs between systems: only the sign is meant.
            self.events
                .extend((turned != 0.0).then_some(Event::Wheel(turned.signum() as i32)));
            return;
        }
        // Wayland counts towards the user, and a touchpad in small parts of a notch.
        self.wheel -= turned;
        if self.wheel.abs() >= WAYLAND_NOTCH {
            self.events.push(Event::Wheel(self.wheel.signum() as i32));
            self.wheel = 0.0;
        }
    }
}

/// A missing display, or what else kept the window from opening.
fn not_opened(error: minifb::Error) -> anyhow::Error {
    let reason = match error {
        minifb::Error::WindowCreate(reason) => reason,
        other => other.to_string(),
    };
    let unset = |name| std::env::var_os(name).is_none_or(|value| value.is_empty());
    let none_named =
        cfg!(all(unix, not(target_os = "macos"))) && unset("DISPLAY") && unset("WAYLAND_DISPLAY");
    // minifb has no error of its own for an X server that does not answer.
    if none_named || reason == "XOpenDisplay failed" {
        NoDisplay { reason }.into()
    } else {
        anyhow!("cannot open a window: {reason}")
    }
}

/// Puts the key before its character, as the other systems report them; minifb does it the other way round on Wayland.
fn press_first(events: &mut [Event]) {
    for start in 1..events.len() {
        if let [Event::Character(_), Event::KeyDown(_)] = events[start - 1..=start] {
            events.swap(start - 1, start);
        }
    }
}

/// Opening a window segfaults inside Xlib where `XMODIFIERS` names an input method whose server does not run, so the
/// program starts itself anew without one; it needs none. Call it before anything is read. Other systems have no such
/// input methods.
///
/// # Errors
/// When the program cannot be started anew.
pub fn restart_without_input_method() -> anyhow::Result<()> {
    #[cfg(all(unix, not(target_os = "macos")))]
    {
        use std::os::unix::process::CommandExt;
        const NONE: &str = "@im=none";
        let is_set = std::env::var_os("XMODIFIERS").is_some_and(|value| value != NONE);
        if is_set && std::env::var_os("DISPLAY").is_some() {
            let mut arguments = std::env::args_os();
            let restarted = std::env::current_exe().map(|program| {
                let mut command = std::process::Command::new(program);
                if let Some(name) = arguments.next() {
                    command.arg0(name);
                }
                command.args(arguments).env("XMODIFIERS", NONE).exec()
            });
            let error = restarted.unwrap_or_else(|error| error);
            let reason =
                "cannot start again with XMODIFIERS=@im=none, which opening a window needs";
            return Err(error).context(reason);
        }
    }
    Ok(())
}
