//! Faults around the real window: it is destroyed, its server dies, signals arrive, keys are held when the focus
//! leaves. A screenshot under its final name is complete, and the program ends or continues normally.

use std::fs;
use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

use super::desktop::{Program, until};
use super::display::picture;
use super::signal;

/// Asserts that every screenshot in `folder` is complete and every other file hidden; returns the number of
/// screenshots.
#[track_caller]
fn whole_screenshots(folder: &Path) -> usize {
    let entries = fs::read_dir(folder).expect("listed");
    let paths: Vec<_> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    let (whole, hidden): (Vec<_>, Vec<_>) = paths
        .into_iter()
        .partition(|path| path.extension().is_some_and(|it| it == "png"));
    for path in &whole {
        image::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
    for path in hidden {
        let name = path.file_name().expect("a name").to_string_lossy();
        assert!(name.starts_with(".shadetrade-"), "{name}");
    }
    whole.len()
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn a_window_destroyed_from_outside_ends_the_program_and_leaves_complete_files() {
    // The connection is closed, or the window alone is destroyed.
    for way in ["windowkill", "windowclose"] {
        let mut program = Program::open(&["--size", "1600x1200"], &[]);
        program.xdotool(&["key", "--repeat", "5", "--delay", "5", "F12"]);
        program.xdotool(&[way, &program.window]);
        until("the program ends", || !program.is_running());
        assert_eq!(program.status().code(), Some(1), "{way}: Xlib ends it");
        whole_screenshots(program.folder.path());
    }
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn a_dead_server_ends_the_program_and_leaves_complete_files() {
    let mut program = Program::open(&["--size", "1600x1200"], &[]);
    program.xdotool(&["key", "--repeat", "5", "--delay", "5", "F12"]);
    program.kill_display();
    until("the program ends", || !program.is_running());
    assert_eq!(program.status().code(), Some(1), "Xlib ends it");
    whole_screenshots(program.folder.path());
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn a_signal_during_a_screenshot_leaves_complete_files() {
    // Not INT: background processes, as these tests may be, ignore it.
    for signal in ["KILL", "TERM"] {
        let mut program = Program::open(&["--size", "3840x2160"], &[]);
        let folder = program.folder.path().to_owned();
        // The key is pressed until a second file is there.
        until("a second screenshot is being written", || {
            program.press("F12");
            fs::read_dir(&folder).expect("listed").count() > 1
        });
        assert!(signal::send(signal, &program.child));
        until("the program ends", || !program.is_running());
        assert!(!program.status().success(), "{signal}");
        assert!(whole_screenshots(&folder) > 0, "{signal}");
    }
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn a_key_held_when_the_focus_leaves_is_released() {
    let program = Program::open(&[], &[]);
    let start = program.picture();
    program.xdotool(&["keydown", "Left"]);
    program.next_while_moving(&start);
    program.focus_elsewhere();
    let rests = program.next_picture(&start, "the camera comes to rest");
    // The panel shows the error as soon as it is known.
    let is_at_rest = || picture(&program.picture()) == picture(&rests);
    sleep(Duration::from_millis(500));
    assert!(is_at_rest(), "it moves without the focus");
    program.xdotool(&["keyup", "Left"]);
    program.xdotool(&["windowfocus", "--sync", &program.window]);
    sleep(Duration::from_millis(500));
    assert!(is_at_rest(), "it moves with the key up");
    program.press("Right");
    until("keys come again", || !is_at_rest());
    program.press("q");
    program.end();
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn a_storm_of_keys_and_sizes_leaves_a_responding_window() {
    let mut program = Program::open(&[], &[]);
    let start = program.picture();
    // Every key is pressed an even number of times or undone by Home. I is not used: it folds different parts of a narrow
    // and of a wide window.
    let keys = [
        "1", "1", "3", "3", "o", "o", "c", "c", "h", "h", "space", "Left", "Up", "plus", "space",
        "Home",
    ];
    for round in 0..40_u32 {
        program.resize([1 + round * 197 % 1500, 1 + round * 71 % 1100]);
        let mut storm = vec!["key", "--delay", "0"];
        storm.extend(keys);
        program.xdotool(&storm);
    }
    program.resize([960, 720]);
    program.press("Home");
    until("the picture is as it was", || {
        picture(&program.picture()) == picture(&start)
    });
    assert!(program.is_running());
    program.press("q");
    program.end();
}
