//! The real window on its own X server: opened, controlled and checked from outside.

use std::fs;
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant};

use fearless_simd::Level;
use image::RgbImage;
use shadetrade::scene::BUILT_IN;

use super::desktop::{Point, Program, until};
use super::support::{app, default_scene, places, widgets};

/// The initial size of the window, in pixels.
const SIZE: [usize; 2] = [960, 720];

/// The centre of the widget with this label.
fn place(label: &str) -> Point {
    place_in(label, SIZE)
}

/// The centre of the widget with this label in a window of `size` pixels.
fn place_in(label: &str, size: [usize; 2]) -> Point {
    let mut app = app(default_scene(), size, Level::new());
    // The real window has the chart of times.
    app.shows_times = true;
    let harness = widgets(app, size);
    let at = places(&harness, label)[0];
    [at.x, at.y].map(|it| it as i32)
}

/// The picture's area in a window of the initial size.
pub(super) fn picture(window: &RgbImage) -> RgbImage {
    let harness = widgets(app(default_scene(), SIZE, Level::new()), SIZE);
    let place = harness.state().place;
    let [x, y, width, height] =
        [place.min.x, place.min.y, place.width(), place.height()].map(|it| it as u32);
    image::imageops::crop_imm(window, x, y, width, height).to_image()
}

/// A position on the cuboid.
const CUBOID: Point = [620, 350];

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn keys_change_the_picture_and_restore_it() {
    let program = Program::open(&[], &[]);
    let start = program.picture();
    assert_eq!(start.dimensions(), (960, 720));
    assert_eq!(program.title(), "cuboid - shadetrade");
    let start = picture(&start);
    let seen = || picture(&program.picture());
    let pairs = [
        ("w", "1"),
        ("2", "r"),
        ("p", "g"),
        ("o", "o"),
        ("c", "c"),
        ("Left", "Right"),
        ("Up", "Home"),
        ("plus", "minus"),
        ("KP_Subtract", "KP_Add"),
        ("z", "x"),
        ("F3", "F2"),
        ("F6", "F2"),
        ("h", "h"),
        ("question", "Escape"),
        ("F1", "Escape"),
        ("p", "ctrl+z"),
    ];
    for (there, back) in pairs {
        program.press(there);
        until(there, || seen() != start);
        program.press(back);
        until(&format!("{back} after {there}"), || seen() == start);
    }
    program.press("space");
    for _ in 0..3 {
        let before = seen();
        until("the cuboid turns", || seen() != before);
    }
    program.press("q");
    program.end();
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn clicks_drags_and_the_wheel_have_their_effects() {
    let program = Program::open(&[], &[]);
    let start = picture(&program.picture());
    let seen = || picture(&program.picture());
    for label in ["red", "Phong"] {
        let before = seen();
        program.click(place(label));
        until(label, || seen() != before);
    }
    for label in ["red", "Gouraud"] {
        program.click(place(label));
    }
    until("both are taken back", || seen() == start);
    program.point_at(CUBOID);
    program.xdotool(&["click", "--repeat", "7", "--delay", "20", "4"]);
    until("the wheel", || seen() != start);
    program.xdotool(&["click", "--repeat", "7", "--delay", "20", "5"]);
    until("as many notches back", || seen() == start);
    program.drag(CUBOID, [100, 40]);
    until("a drag", || seen() != start);
    program.press("Home");
    until("the view is reset", || seen() == start);
    program.press("F3");
    until("the wipe", || seen() != start);
    let wipe = seen();
    program.drag([place_of_divider(), 500], [100, 0]);
    until("the divider", || seen() != wipe);
    program.press("F2");
    until("the camera is where it was", || seen() == start);
    program.click(CUBOID);
    until("a probe", || seen() != start);
    program.press("q");
    program.end();
}

/// The column of the divider in the window.
fn place_of_divider() -> i32 {
    let harness = widgets(app(default_scene(), SIZE, Level::new()), SIZE);
    harness.state().place.center().x as i32
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn exact_phong_is_shown_while_its_key_is_held() {
    let program = Program::open(&[], &[]);
    let start = picture(&program.picture());
    let seen = || picture(&program.picture());
    program.xdotool(&["keydown", "b"]);
    until("B held", || seen() != start);
    program.xdotool(&["keyup", "b"]);
    until("B let go", || seen() == start);
    program.press("F5");
    until("the error map", || seen() != start);
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn no_tap_of_a_key_is_lost() {
    let program = Program::open(&[], &[]);
    let start = picture(&program.picture());
    let seen = || picture(&program.picture());
    // An odd number of taps, so that a lost one shows. Events come in order: the help opens after all taps.
    program.xdotool(&["key", "--repeat", "41", "--delay", "12", "1"]);
    let before = seen();
    program.press("h");
    until("the help", || seen() != before);
    program.press("h");
    until("the light is off", || seen() != start);
    program.press("1");
    until("the last tap", || seen() == start);
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn screenshots_show_the_window_and_never_overwrite() {
    let program = Program::open(&[], &[]);
    let file = |number: u32| {
        program
            .folder
            .path()
            .join(format!("shadetrade-{number:03}.png"))
    };
    fs::write(file(1), "mine").expect("written");
    program.press("F12");
    until("a file is there", || file(2).exists());
    let saved = image::open(file(2)).expect("a picture").to_rgb8();
    assert!(picture(&saved) == picture(&program.picture()));
    program.press("shift+F12");
    until("another file is there", || file(3).exists());
    let drawn = image::open(file(3)).expect("a picture").to_rgb8();
    assert!(drawn == picture(&saved));
    assert_eq!(fs::read(file(1)).expect("read"), b"mine");
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn a_scene_is_opened_by_its_path_changed_saved_and_read_again() {
    let scenes = tempfile::tempdir().expect("a folder");
    let path = scenes.path().join("mine.toml");
    fs::write(&path, BUILT_IN[0].1).expect("written");
    // All of the panel is in sight.
    let program = Program::open(&["--size", "960x960"], &[]);
    let seen = || picture(&program.picture());
    let start = seen();
    let [x, y] = place_in("open", [960, 960]);
    program.click([x - 60, y]);
    program.xdotool(&["type", "--delay", "20", path.to_str().expect("UTF-8")]);
    program.press("Return");
    until("the file is open", || program.title().contains("mine.toml"));
    assert!(seen() == start, "typing presses no key");
    program.press("w");
    until("a light is off", || seen() != start);
    let dark = seen();
    program.press("ctrl+s");
    until("it is saved", || {
        fs::read_to_string(&path).is_ok_and(|text| text.contains("on = false"))
    });
    let saved = fs::read_to_string(&path).expect("text");
    assert!(
        saved.contains("# levels per unit of intensity"),
        "comments are kept"
    );
    fs::write(&path, saved.replace("fov = 30.0", "fov = -30.0")).expect("written");
    until("the error is told", || {
        program.picture().height() == 960 && seen() != dark
    });
    fs::write(&path, BUILT_IN[0].1).expect("written");
    until("the file is read again", || seen() == start);
    fs::write(&path, BUILT_IN[0].1.replace("size = [4.0", "size = [4.5")).expect("written");
    until("and again", || seen() != start);
    program.press("q");
    program.end();
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn any_size_is_drawn() {
    let mut program = Program::open(&[], &[]);
    let start = picture(&program.picture());
    for size in [
        [320, 240],
        [1, 1],
        [480, 360],
        [3840, 2160],
        [1, 2160],
        [3840, 1],
        [17, 900],
        [1920, 1080],
    ] {
        program.resize(size);
        until("the window has its size", || {
            program.picture().dimensions() == (size[0], size[1])
        });
        for key in ["i", "e", "h"] {
            let before = program.picture();
            program.press(key);
            if size.iter().all(|side| *side >= 240) {
                program.next_picture(&before, key);
            }
            program.press(key);
        }
    }
    program.resize([960, 720]);
    until("the picture is as ever", || {
        let window = program.picture();
        window.dimensions() == (960, 720) && picture(&window) == start
    });
    assert!(program.is_running());
}

#[test]
#[ignore = "needs a display server and a window manager: apt-get install xvfb xdotool imagemagick libxcursor1 x11-utils openbox"]
fn q_asks_about_edits_and_closing_the_frame_rescues_them() {
    let mut program = Program::open(&[], &[]);
    let folder = program.folder.path().to_path_buf();
    program.start_window_manager();
    let start = picture(&program.picture());
    program.press("e");
    until("the editor", || picture(&program.picture()) != start);
    // A new cuboid is an edit.
    let harness = {
        let mut app = app(default_scene(), SIZE, Level::new());
        app.set_look(shadetrade::components::Inspector(Some(
            shadetrade::components::Tab::Scene,
        )));
        widgets(app, SIZE)
    };
    let add = *places(&harness, "add cuboid").last().expect("a button");
    program.click([add.x as i32, add.y as i32]);
    until("a star", || program.title().contains('*'));
    program.press("q");
    sleep(Duration::from_millis(500));
    assert!(program.is_running(), "it asks");
    program.press("Escape");
    program.press("alt+F4");
    until("the program ends", || !program.is_running());
    assert!(program.status().success());
    assert!(folder.join("cuboid-unsaved.toml").exists());
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn an_input_method_that_does_not_run_is_harmless() {
    let program = Program::open(&["assignment"], &[("XMODIFIERS", "@im=ibus")]);
    let title = "the arguments are handed on";
    until(title, || program.title().contains("assignment"));
    program.press("q");
    program.end();
}

#[test]
#[ignore = "tells of a machine without a display, which needs none; it is here beside its opposite"]
fn without_a_display_a_named_scene_is_an_error_that_advises_render() {
    let output = Command::new(env!("CARGO_BIN_EXE_shadetrade"))
        .args(["view", "assignment"])
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .expect("it runs");
    assert_eq!(output.status.code(), Some(1));
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(
        told.contains("no display") && told.contains("render"),
        "{told}"
    );
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn an_idle_window_uses_little_processor_time() {
    let program = Program::open(&["--size", "1920x1080"], &[]);
    let worked = || {
        let tasks = fs::read_dir(format!("/proc/{}/task", program.child.id())).expect("listed");
        let nanoseconds = tasks.map(|task| {
            let statistics =
                fs::read_to_string(task.expect("a task").path().join("schedstat")).expect("read");
            statistics
                .split(' ')
                .next()
                .and_then(|word| word.parse::<u64>().ok())
                .expect("a number")
        });
        Duration::from_nanos(nanoseconds.sum())
    };
    // The reference runs once. The promise is 2 %; the limit leaves room for a busy machine.
    let share = || {
        let (start, before) = (Instant::now(), worked());
        sleep(Duration::from_secs(1));
        worked().saturating_sub(before).as_secs_f64() / start.elapsed().as_secs_f64()
    };
    until("it rests", || share() < 0.05);
}
