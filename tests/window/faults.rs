//! Faults around the real window: it is destroyed, its server dies, signals arrive, keys are held when the focus
//! leaves. A screenshot under its final name is complete, and the program ends or continues normally.

use std::fs;
use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

use shadetrade::scene::Scene;

use super::desktop::{Program, until};
use super::display::{PLAIN, UNSAVED, edit, picture};
use super::signal;

/// Asserts that every screenshot in `folder` is complete and every other file hidden; returns the number of
/// screenshots.
#[track_caller]
fn whole_screenshots(folder: &Path) -> usize {
    let mut whole = 0;
    for entry in fs::read_dir(folder).expect("listed") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy();
        if name.ends_with(".png") {
            image::open(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
            whole += 1;
        } else {
            assert!(name.starts_with(".shadetrade-"), "{name}");
        }
    }
    whole
}

/// Ends and exit codes. The connection is closed, the window alone is destroyed, or the server dies: Xlib ends the program. Others
/// are signals.
const ENDS: [(&str, Option<i32>); 6] = [
    ("connection", Some(1)),
    ("window", Some(1)),
    ("server", Some(1)),
    ("KILL", None),
    ("TERM", Some(0)),
    ("HUP", Some(0)),
];

fn end(program: &mut Program, way: &str) {
    match way {
        "connection" => drop(program.xdotool(&["windowkill", &program.window])),
        "window" => drop(program.xdotool(&["windowclose", &program.window])),
        "server" => program.kill_display(),
        name => assert!(signal::send(name, &program.child)),
    }
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn however_the_program_ends_edits_are_on_disk() {
    for (way, code) in ENDS {
        let mut program = Program::open(PLAIN, &[]);
        let file = program.folder.path().join(UNSAVED);
        edit(&program);
        until("the edits are on disk", || file.exists());
        end(&mut program, way);
        assert_eq!(program.ended().code(), code, "{way}");
        let scene = Scene::load_path(&file).unwrap_or_else(|error| panic!("{way}: {error}"));
        assert_ne!(scene.record.cuboid[0].size.x, 4.0, "{way}");
    }
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn however_the_program_ends_its_files_are_complete() {
    for (way, code) in ENDS {
        let mut program = Program::open(&["--size", "3840x2160"], &[]);
        let folder = program.folder.path().to_owned();
        // The key is pressed until a second file is there.
        until("a second screenshot is being written", || {
            program.press("F12");
            fs::read_dir(&folder).expect("listed").count() > 1
        });
        end(&mut program, way);
        assert_eq!(program.ended().code(), code, "{way}");
        assert!(whole_screenshots(&folder) > 0, "{way}");
    }
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn a_key_held_when_the_focus_leaves_is_released() {
    let program = Program::open(PLAIN, &[]);
    let start = program.picture();
    program.xdotool(&["keydown", "Left"]);
    until("the picture moves", || program.picture() != start);
    program.focus_elsewhere();
    let mut rests = start;
    until("the camera comes to rest", || {
        let before = std::mem::replace(&mut rests, program.picture());
        before == rests
    });
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
    program.quit();
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn a_storm_of_keys_and_sizes_leaves_a_responding_window() {
    let program = Program::open(PLAIN, &[]);
    let start = program.picture();
    // Every key is pressed an even number of times or undone by Home. I is not used: it folds different parts of a narrow
    // and of a wide window.
    let keys = [
        "1", "1", "3", "3", "o", "o", "c", "c", "h", "h", "space", "Left", "Up", "plus", "space",
        "Home",
    ];
    let sizes = (0..40).map(|round| [1 + round * 197 % 1500, 1 + round * 71 % 1100]);
    for size in sizes.chain([[1, 1], [3840, 2160], [1, 2160], [3840, 1]]) {
        program.resize(size);
        let mut storm = vec!["key", "--delay", "0"];
        storm.extend(keys);
        program.xdotool(&storm);
    }
    program.resize([960, 720]);
    program.press("Home");
    until("the picture is as it was", || {
        picture(&program.picture()) == picture(&start)
    });
    program.quit();
}
