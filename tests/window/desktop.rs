//! An X server for a test, and the program with its window on it.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use image::RgbImage;
use tempfile::TempDir;

/// A position in the window, in pixels.
pub type Point = [i32; 2];

/// The time limit of every wait.
const PATIENCE: Duration = Duration::from_mins(1);

/// Width and height of a display, in pixels.
const SCREEN: (u32, u32) = (3840, 2160);

/// An X server without a screen.
pub struct Display {
    server: Child,
    manager: Option<Child>,
    name: String,
}

impl Display {
    /// Starts one with so many bits a pixel.
    pub fn start(depth: u8) -> Self {
        let (width, height) = SCREEN;
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0"])
            .arg(format!("{width}x{height}x{depth}"))
            .args(["-nolisten", "tcp", "-noreset"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb is installed");
        let mut number = String::new();
        let stdout = server.stdout.take().expect("its output is piped");
        let read = BufReader::new(stdout).read_line(&mut number);
        read.expect("Xvfb says its number");
        Display {
            server,
            manager: None,
            name: format!(":{}", number.trim()),
        }
    }

    pub fn run(&self, program: &str, arguments: &[&str]) -> Vec<u8> {
        let mut command = Command::new(program);
        let output = command.args(arguments).env("DISPLAY", &self.name).output();
        output.expect(program).stdout
    }

    /// Sets the dots per inch of the screen.
    pub fn set_dpi(&self, dpi: u32) {
        let value = format!("Xft.dpi:\t{dpi}");
        let name = "RESOURCE_MANAGER";
        self.run("xprop", &["-root", "-f", name, "8s", "-set", name, &value]);
    }

    /// The program on this display, in a folder.
    pub fn command(&self, folder: &Path) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_shadetrade"));
        command
            .current_dir(folder)
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("XMODIFIERS")
            .env("DISPLAY", &self.name)
            .env("XDG_STATE_HOME", folder);
        command
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        for child in self.manager.iter_mut().chain([&mut self.server]) {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

/// The program with its window, in a temporary folder.
pub struct Program {
    display: Display,
    pub child: Child,
    pub window: String,
    pub folder: TempDir,
}

impl Program {
    pub fn open(arguments: &[&str], environment: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        Program::open_on(Display::start(24), folder, arguments, environment)
    }

    /// Opens the program on a display, in a folder.
    pub fn open_on(
        display: Display,
        folder: TempDir,
        arguments: &[&str],
        environment: &[(&str, &str)],
    ) -> Self {
        let child = display
            .command(folder.path())
            .args(arguments)
            .envs(environment.iter().copied())
            .spawn()
            .expect("the program starts");
        let mut program = Program {
            display,
            child,
            window: String::new(),
            folder,
        };
        until("the window is there", || {
            let found = program.xdotool(&["search", "--onlyvisible", "--name", "shadetrade"]);
            let first = found.lines().next().unwrap_or_default();
            first.clone_into(&mut program.window);
            !first.is_empty()
        });
        // Without a window manager the window gets neither a position nor the keyboard focus by itself.
        program.xdotool(&["windowmove", &program.window, "0", "0"]);
        program.xdotool(&["windowfocus", "--sync", &program.window]);
        until("a picture is there", || {
            program.picture().pixels().any(|pixel| pixel.0[0] > 100)
        });
        program
    }

    pub fn xdotool(&self, arguments: &[&str]) -> String {
        let output = self.display.run("xdotool", arguments);
        String::from_utf8_lossy(&output).trim().to_owned()
    }

    pub fn press(&self, key: &str) {
        self.xdotool(&["key", key]);
    }

    pub fn point_at(&self, place: Point) {
        let [x, y] = place.map(|place| place.to_string());
        self.xdotool(&["mousemove", "--window", &self.window, &x, &y]);
    }

    /// Presses and releases the button as a finger does.
    pub fn click(&self, place: Point) {
        self.point_at(place);
        self.xdotool(&["mousedown", "1", "sleep", "0.25", "mouseup", "1"]);
    }

    /// Drags in small steps, like a hand.
    pub fn drag(&self, from: Point, [right, down]: Point) {
        self.point_at(from);
        self.xdotool(&["mousedown", "1"]);
        for _ in 0..10 {
            let [x, y] = [right / 10, down / 10].map(|step| step.to_string());
            // A hand does not move in the moment of the press, and minifb polls the button.
            sleep(Duration::from_millis(30));
            self.xdotool(&["mousemove_relative", "--sync", "--", &x, &y]);
        }
        self.xdotool(&["mouseup", "1"]);
    }

    pub fn resize(&self, [width, height]: [u32; 2]) {
        let [width, height] = [width, height].map(|side| side.to_string());
        self.xdotool(&["windowsize", &self.window, &width, &height]);
    }

    pub fn title(&self) -> String {
        self.xdotool(&["getwindowname", &self.window])
    }

    /// The pixels of the window.
    pub fn picture(&self) -> RgbImage {
        let png = self
            .display
            .run("import", &["-window", &self.window, "png:-"]);
        let picture = image::load_from_memory(&png);
        picture.map(|it| it.to_rgb8()).unwrap_or_default()
    }

    /// Starts a window manager, and focuses the window again.
    pub fn start_window_manager(&mut self) {
        let manager = Command::new("openbox")
            .env("DISPLAY", &self.display.name)
            .stderr(Stdio::null())
            .spawn()
            .expect("openbox is installed");
        self.display.manager = Some(manager);
        // A request before the window manager manages the window is lost.
        until("the window manager has the window", || {
            let state = self
                .display
                .run("xprop", &["-id", &self.window, "WM_STATE"]);
            String::from_utf8_lossy(&state).contains("Normal")
        });
        self.xdotool(&["windowactivate", "--sync", &self.window]);
    }

    /// Removes the keyboard focus from all windows.
    pub fn focus_elsewhere(&self) {
        let root = self.xdotool(&["search", "--maxdepth", "0", ""]);
        self.xdotool(&["windowfocus", root.lines().next().expect("a root window")]);
    }

    /// Kills the X server.
    pub fn kill_display(&mut self) {
        self.display.server.kill().expect("it was running");
        self.display.server.wait().expect("it has ended");
    }

    /// Waits for the program to end, and returns its exit status.
    pub fn ended(&mut self) -> ExitStatus {
        let mut status = None;
        until("the program ends", || {
            status = self.child.try_wait().expect("its state is known");
            status.is_some()
        });
        status.expect("it was waited for")
    }

    /// Quits by the key, which must be a success.
    pub fn quit(mut self) {
        self.press("q");
        let status = self.ended();
        assert!(status.success(), "{status}");
    }

    /// The folder, which a later start takes over.
    pub fn take_folder(&mut self) -> TempDir {
        let other = tempfile::tempdir().expect("a temporary folder");
        std::mem::replace(&mut self.folder, other)
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub fn until(what: &str, mut holds: impl FnMut() -> bool) {
    let start = Instant::now();
    while !holds() {
        assert!(start.elapsed() < PATIENCE, "waited in vain: {what}");
        sleep(Duration::from_millis(20));
    }
}
