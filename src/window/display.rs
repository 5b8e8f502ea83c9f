//! Opens a window with minifb 0.29, gathers its events and shows pixels. Works around the faults of minifb.
//!
//! Keys come through a callback, because polling loses taps. The button can only be polled, so a click between two polls is
//! lost. A window that another program destroys ends this one inside Xlib.

use std::cell::RefCell;
use std::rc::Rc;

use anyhow::{Context, anyhow};
use egui::{Event, PointerButton, Pos2};
use minifb::{InputCallback, Key, MouseButton, MouseMode, ScaleMode, WindowOptions};
use raw_window_handle::{HasWindowHandle, RawWindowHandle};
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{AtomEnum, ConnectionExt};
use x11rb::rust_connection::RustConnection;

use super::input::{Input, KeyReport};

/// One notch of the wheel, as each window system reports it.
const NOTCH: f32 = if cfg!(windows) {
    12.0
} else if cfg!(target_os = "macos") {
    1.0
} else {
    2.0
};
const WAYLAND_NOTCH: f32 = -10.0;

/// The size of the window, in points, where none is asked for, and where the screen has no room for that.
const USUAL: [usize; 2] = [1280, 800];
const SMALL: [usize; 2] = [960, 720];
/// The bits a pixel that minifb shows.
const DEPTH: u8 = 24;
/// The dots per inch at which a point of egui is a pixel.
const USUAL_DPI: f32 = 96.0;
/// The length of the longest table of resources that is read, in units of four bytes.
const MOST: u32 = 1 << 18;

/// No window can be opened; nothing has been done.
#[derive(Debug, thiserror::Error)]
pub enum NoWindow {
    #[error("no display to open a window on ({0})")]
    NoDisplay(&'static str),
    #[error("cannot open a window: the display has {0} bits a pixel, {DEPTH} are needed")]
    Depth(u8),
}

/// An open window.
pub struct Display {
    pub window: minifb::Window,
    /// Pixels in a point of egui.
    pub scale: f32,
    reports: Rc<RefCell<Vec<KeyReport>>>,
    /// Events that were not taken yet, in pixels of the window.
    pub input: Input,
    /// It is opened when it is used first, because closing it takes a second.
    clipboard: Option<arboard::Clipboard>,
    is_wayland: bool,
    is_active: bool,
    mouse: Option<Pos2>,
    /// Whether the left button is down; no other one is used.
    is_pressed: bool,
    /// Turns of the wheel that make no whole notch yet.
    wheel: f32,
}

struct Reporter(Rc<RefCell<Vec<KeyReport>>>);

impl InputCallback for Reporter {
    fn add_char(&mut self, code: u32) {
        let character = char::from_u32(code).map(KeyReport::Character);
        self.0.borrow_mut().extend(character);
    }

    fn set_key_state(&mut self, key: Key, down: bool) {
        let report = if down { KeyReport::Down } else { KeyReport::Up };
        self.0.borrow_mut().push(report(key));
    }
}

impl Display {
    /// Opens a window of `size` points.
    ///
    /// # Errors
    /// [`NoWindow`] when there is nothing to open it on, or nothing with enough colours; when it cannot be opened there.
    pub fn open(title: &str, size: [usize; 2]) -> anyhow::Result<Self> {
        let options = WindowOptions {
            resize: true,
            // The picture is drawn at the window's size; only while that changes do they differ.
            scale_mode: ScaleMode::UpperLeft,
            ..WindowOptions::default()
        };
        // It stays until the window is open.
        let screen = x_screen();
        if let Some(Screen { depth, .. }) = &screen
            && *depth != DEPTH
        {
            return Err(NoWindow::Depth(*depth).into());
        }
        // A compositor of Wayland scales the window itself.
        let scale = match &screen {
            Some(screen) if !is_set("WAYLAND_DISPLAY") => screen.scale,
            _ => 1.0,
        };
        // A window of no size ends the program inside Xlib.
        let scaled =
            |size: [usize; 2]| size.map(|side| (side as f32 * scale).round().max(1.0) as usize);
        let is_beyond = |it: &Screen| (0..2).any(|axis| scaled(size)[axis] > it.size[axis]);
        let is_small = size == USUAL && screen.as_ref().is_some_and(is_beyond);
        let [width, height] = scaled(if is_small { SMALL } else { size });
        let mut window = minifb::Window::new(title, width, height, options).map_err(not_opened)?;
        let reports = Rc::new(RefCell::new(Vec::new()));
        window.set_input_callback(Box::new(Reporter(Rc::clone(&reports))));
        let handle = window.window_handle().map(|it| it.as_raw());
        Ok(Display {
            window,
            scale,
            reports,
            input: Input::default(),
            clipboard: None,
            is_wayland: matches!(handle, Ok(RawWindowHandle::Wayland(_))),
            is_active: false,
            mouse: None,
            is_pressed: false,
            wheel: 0.0,
        })
    }

    /// Width and height in pixels, each at least 1.
    pub fn size(&self) -> [usize; 2] {
        let (width, height) = self.window.get_size();
        [width.max(1), height.max(1)]
    }

    /// Shows pixels, `0x00RRGGBB`, row by row from the top, and gathers events.
    ///
    /// # Errors
    /// If the window system refuses them.
    pub fn present(&mut self, pixels: &[u32], [width, height]: [usize; 2]) -> anyhow::Result<()> {
        let result = self.window.update_with_buffer(pixels, width, height);
        self.gather();
        result.context("cannot show the picture")
    }

    /// Gathers events without showing anything.
    pub fn poll(&mut self) {
        self.window.update();
        self.gather();
    }

    /// The clipboard of the system.
    ///
    /// # Errors
    /// If there is none.
    pub fn clipboard(&mut self) -> anyhow::Result<&mut arboard::Clipboard> {
        let opened = match self.clipboard.take() {
            Some(opened) => opened,
            None => arboard::Clipboard::new()?,
        };
        Ok(self.clipboard.insert(opened))
    }

    /// Whether a key or a button is down.
    pub fn is_busy(&self) -> bool {
        self.input.is_busy() || self.is_pressed
    }

    fn gather(&mut self) {
        self.gather_reports();
        let is_active = self.window.is_active();
        if std::mem::replace(&mut self.is_active, is_active) != is_active {
            self.input.focus(is_active);
        }
        self.gather_wheel();
        let is_pressed = self.window.get_mouse_down(MouseButton::Left);
        let has_changed = is_pressed != self.is_pressed;
        if has_changed {
            // minifb asks for the mouse's place before it reads the press, and the mouse may have moved in between.
            self.window.update();
            self.gather_reports();
            self.gather_wheel();
        }
        self.gather_mouse(is_pressed);
        self.is_pressed = is_pressed;
        if has_changed {
            self.input.events.push(Event::PointerButton {
                pos: self.mouse.unwrap_or_default(),
                button: PointerButton::Primary,
                pressed: is_pressed,
                modifiers: self.input.modifiers,
            });
        }
    }

    fn gather_reports(&mut self) {
        let mut reports = self.reports.take();
        if self.is_wayland {
            key_first(&mut reports);
        }
        for report in reports {
            self.input.report(report);
        }
    }

    fn gather_mouse(&mut self, is_dragging: bool) {
        // A drag goes on outside of the window.
        let mode = if is_dragging {
            MouseMode::Pass
        } else {
            MouseMode::Discard
        };
        let mouse = self.window.get_mouse_pos(mode).map(Pos2::from);
        if std::mem::replace(&mut self.mouse, mouse) != mouse {
            let event = mouse.map_or(Event::PointerGone, Event::PointerMoved);
            self.input.events.push(event);
        }
    }

    fn gather_wheel(&mut self) {
        let Some((_, turned)) = self.window.get_scroll_wheel() else {
            return;
        };
        let notch = if self.is_wayland {
            WAYLAND_NOTCH
        } else {
            NOTCH
        };
        self.wheel += turned / notch;
        let notches = self.wheel.trunc();
        if notches != 0.0 {
            self.wheel -= notches;
            self.input.wheel(notches as i32);
        }
    }
}

pub(super) fn is_set(variable: &str) -> bool {
    std::env::var_os(variable).is_some_and(|value| !value.is_empty())
}

fn not_opened(error: minifb::Error) -> anyhow::Error {
    let reason = match error {
        minifb::Error::WindowCreate(reason) => reason,
        other => other.to_string(),
    };
    let none_named = cfg!(all(unix, not(target_os = "macos")))
        && !is_set("DISPLAY")
        && !is_set("WAYLAND_DISPLAY");
    // minifb has no error of its own for an X server that does not answer.
    let reason = match reason.as_str() {
        _ if none_named => "neither DISPLAY nor WAYLAND_DISPLAY is set",
        "XOpenDisplay failed" if is_set("DISPLAY") => {
            "the X server that DISPLAY names does not answer"
        }
        "XOpenDisplay failed" => "the compositor that WAYLAND_DISPLAY names does not answer",
        _ => return anyhow!("cannot open a window: {reason}"),
    };
    NoWindow::NoDisplay(reason).into()
}

/// Puts a key before its character, as X11 reports them; minifb has the other order on Wayland.
fn key_first(reports: &mut [KeyReport]) {
    for start in 1..reports.len() {
        if let [KeyReport::Character(_), KeyReport::Down(_)] = reports[start - 1..=start] {
            reports.swap(start - 1, start);
        }
    }
}

/// The screen of an X server. It holds a connection: a server without other clients resets once the last one leaves, and refuses
/// a window that is opened meanwhile.
struct Screen {
    _connection: RustConnection,
    /// Bits a pixel.
    depth: u8,
    /// Pixels in a point of egui.
    scale: f32,
    /// Width and height in pixels.
    size: [usize; 2],
}

/// Asks the X server that `DISPLAY` names. minifb crashes on a screen whose depth it does not know, and does not tell the
/// dots per inch.
fn x_screen() -> Option<Screen> {
    let (connection, index) = x11rb::connect(None).ok()?;
    let screen = connection.setup().roots.get(index)?;
    let (table, text) = (AtomEnum::RESOURCE_MANAGER, AtomEnum::STRING);
    let asked = connection.get_property(false, screen.root, table, text, 0, MOST);
    let resources = asked.ok()?.reply().ok()?.value;
    let depth = screen.root_depth;
    let size = [screen.width_in_pixels, screen.height_in_pixels].map(usize::from);
    Some(Screen {
        _connection: connection,
        depth,
        scale: scale(&String::from_utf8_lossy(&resources)),
        size,
    })
}

/// The pixels in a point, by the `Xft.dpi` among the resources of an X server.
pub fn scale(resources: &str) -> f32 {
    let mut values = resources
        .lines()
        .filter_map(|it| it.strip_prefix("Xft.dpi:"));
    let dpi = values.find_map(|it| it.trim().parse().ok());
    (dpi.unwrap_or(USUAL_DPI) / USUAL_DPI).clamp(0.5, 4.0)
}
