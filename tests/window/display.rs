//! The real window, on a display of its own: opened, driven and looked at from outside.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant};

use image::RgbImage;
use shadetrade::canvas::Rect;
use shadetrade::components::ShadingMode;
use shadetrade::scene::BUILT_IN;
use shadetrade::trade::error_map;
use shadetrade::window::bindings::Action;
use shadetrade::window::hud::lines::Line;
use shadetrade::window::hud::{Hud, Part, picture};

use super::desktop::{Program, SCREEN, until};
use super::support::{COMMON, SIZE, board, commands, default_session, hud, place_of};

/// The picture in a window of 960 x 720, short of where a message stands.
pub(super) fn right_part(window: &RgbImage) -> RgbImage {
    let picture = picture(&default_session(), SIZE);
    let [x, width] = [picture.x, picture.width].map(|it| it as u32);
    image::imageops::crop_imm(window, x, 0, width, 600).to_image()
}

/// The panel's commands in the same window.
fn left_part(window: &RgbImage) -> RgbImage {
    panel_commands(window, SIZE)
}

/// The panel's commands in a window of `size`: what is above the facts, which come when they are known.
fn panel_commands(window: &RgbImage, size: [usize; 2]) -> RgbImage {
    let session = default_session();
    let hud = Hud::new(&session, size);
    let panel = board(&hud, Part::Panel);
    let rows = panel.rows.iter();
    let facts = rows.clone().find(|(line, _)| *line == Line::Rule);
    let (_, facts) = facts.expect("facts follow");
    let width = panel.rect.width as u32;
    image::imageops::crop_imm(window, 0, 0, width, facts.y as u32).to_image()
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn every_key_changes_the_picture_or_the_panel() {
    let program = Program::open(&[], &[]);
    let start = program.picture();
    assert_eq!(start.dimensions(), (960, 720));
    assert!(program.title().contains("Gouraud, perspective, camera 1"));
    // Keys that undo themselves when pressed again, or that the second one undoes.
    let pairs = [
        ("1", "w"),
        ("2", "r"),
        ("3", "s"),
        ("4", "a"),
        ("w", "1"),
        ("r", "2"),
        ("s", "3"),
        ("a", "4"),
        ("p", "g"),
        ("o", "o"),
        ("c", "c"),
        ("Left", "Right"),
        ("Up", "Down"),
        ("Right", "Home"),
        ("Down", "Home"),
        ("plus", "minus"),
        ("KP_Subtract", "KP_Add"),
    ];
    for (there, back) in pairs {
        program.press(there);
        let changed = program.next_picture(&start, there);
        assert_ne!(
            right_part(&changed),
            right_part(&start),
            "{there} and the picture"
        );
        let steady = ["Left", "Right", "Up", "Down", "plus", "KP_Subtract"].contains(&there);
        assert!(
            steady || left_part(&changed) != left_part(&start),
            "{there} and the panel"
        );
        program.press(back);
        until(back, || {
            right_part(&program.picture()) == right_part(&start)
        });
    }
    for (key, title) in [
        ("p", "Phong, perspective, camera 1"),
        ("o", "Phong, orthographic, camera 1"),
        ("c", "Phong, orthographic, camera 2"),
    ] {
        program.press(key);
        until(title, || program.title().contains(title));
    }
    for key in ["h", "question", "F1"] {
        let before = program.picture();
        program.press(key);
        let help = program.next_picture(&before, key);
        program.press("Escape");
        program.next_picture(&help, "the help is closed");
    }
    let before = program.picture();
    program.press("i");
    assert_ne!(
        left_part(&program.next_picture(&before, "i")),
        left_part(&before)
    );
    program.press("space");
    for _ in 0..3 {
        let before = right_part(&program.picture());
        until("the cuboid turns", || {
            right_part(&program.picture()) != before
        });
    }
    program.press("q");
    program.end();
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn the_mouse_does_what_keys_do() {
    let program = Program::open(&[], &[]);
    let start = program.picture();
    let mut session = default_session();
    let panel_row = |action| place_of(&hud(&session, SIZE), Part::Panel, action);
    let [red_light, phong] = [Action::Light(1), Action::Shading(ShadingMode::Phong)].map(panel_row);
    program.click(red_light.expect("a row"));
    let red = program.next_picture(&start, "a click on the red light");
    assert_ne!(right_part(&red), right_part(&start));
    program.click(phong.expect("a row"));
    until("a click on Phong", || program.title().contains("Phong"));
    let before = program.picture();
    program.xdotool(&[
        "mousemove",
        "--window",
        &program.window,
        "600",
        "400",
        "mousedown",
        "1",
    ]);
    program.xdotool(&["mousemove_relative", "--sync", "60", "20"]);
    let dragged = program.next_picture(&before, "a drag");
    program.xdotool(&["mouseup", "1", "click", "4"]);
    program.next_picture(&dragged, "the wheel");
    session.apply(Action::Help);
    let quit = place_of(&hud(&session, SIZE), Part::Help, Action::Quit);
    let before = program.picture();
    program.press("h");
    program.next_picture(&before, "the help");
    // The boards are a little wider once angles are told.
    let [x, y] = quit.expect("a row");
    program.click([x + 40, y]);
    program.end();
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn every_row_of_the_panel_does_something_in_every_common_window() {
    for size @ [width, height] in COMMON {
        let program = Program::open(&["view", "--size", &format!("{width}x{height}")], &[]);
        let hud = Hud::new(&default_session(), size);
        let parts = |window: &RgbImage| {
            let Rect {
                x, width, height, ..
            } = hud.picture;
            let [x, width, height] = [x, width, height].map(|it| it as u32);
            let picture = image::imageops::crop_imm(window, x, 0, width, height);
            (panel_commands(window, size), picture.to_image())
        };
        for (command, place) in commands(&hud, Part::Panel) {
            let (_, action) = command.keys.last().expect("it has a key");
            // What is so already is made otherwise before.
            match action {
                Action::Shading(ShadingMode::Gouraud) => program.press("p"),
                Action::ResetView => program.press("Left"),
                _ => {}
            }
            // A row that the mouse is over is brighter.
            let middle = [place.x + place.width / 2, place.y + place.height / 2];
            program.point_at(middle);
            let mut before = program.picture();
            until("the window rests", || {
                std::mem::replace(&mut before, program.picture()) == before
            });
            program.click(middle);
            until(&format!("{command:?} at {size:?}"), || {
                parts(&program.picture()) != parts(&before)
            });
            match action {
                Action::Panel => program.press("i"),
                Action::Help => program.press("Escape"),
                Action::Turning => {
                    program.click(middle);
                    program.press("Home");
                }
                Action::Measure | Action::Blink | Action::Editor => program.click(middle),
                _ => continue,
            }
            until(&format!("{command:?} is undone at {size:?}"), || {
                panel_commands(&program.picture(), size) == panel_commands(&before, size)
            });
        }
        program.press("q");
        program.end();
    }
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn views_follow_keys_and_come_back() {
    let program = Program::open(&[], &[]);
    let start = right_part(&program.picture());
    let back = |what| until(what, || right_part(&program.picture()) == start);
    for view in [
        "Gouraud | Phong",
        "method | reference",
        "error map",
        "tiles",
    ] {
        let before = program.picture();
        program.press("Tab");
        let after = program.next_picture(&before, view);
        assert_ne!(right_part(&after), right_part(&before), "{view}");
        if view == "error map" {
            // The picture's upper right corner: nothing is drawn there.
            until("the reference is there", || {
                let [_, red, green, blue] = error_map::NOTHING.to_be_bytes();
                program.picture().get_pixel(955, 5).0 == [red, green, blue]
            });
        }
    }
    program.press("Tab");
    back("the picture after the last view");
    program.press("shift+Tab");
    until("the last view again", || {
        right_part(&program.picture()) != start
    });
    program.press("Tab");
    back("the picture again");
    for [there, again] in [["bracketright", "bracketleft"], ["Prior", "Next"]] {
        let before = left_part(&program.picture());
        program.press(there);
        until(there, || left_part(&program.picture()) != before);
        program.press(again);
        until(again, || left_part(&program.picture()) == before);
    }
    // While B is held, the word "reference" and the reference are there.
    program.xdotool(&["keydown", "b"]);
    until("B held", || right_part(&program.picture()) != start);
    program.xdotool(&["keyup", "b"]);
    back("B let go");
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn a_pixel_is_probed_a_view_is_measured_and_a_divider_dragged() {
    let program = Program::open(&[], &[]);
    let start = right_part(&program.picture());
    let back = |what| until(what, || right_part(&program.picture()) == start);
    let shown = |what| until(what, || right_part(&program.picture()) != start);
    program.click([600, 300]);
    shown("what is known of the pixel");
    program.press("Escape");
    back("it is closed");
    program.press("m");
    shown("the measurement");
    // The table has many times the rows of the words about a running measurement.
    let changed = || {
        let now = right_part(&program.picture());
        let pixels = now.pixels().zip(start.pixels());
        pixels.filter(|(now, start)| now != start).count()
    };
    until("the table", || changed() > 40_000);
    program.press("Escape");
    back("the table is closed");
    let before = program.picture();
    program.press("Tab");
    let wipe = program.next_picture(&before, "the wipe");
    let session = default_session();
    let rect = picture(&session, SIZE);
    let column = rect.x + rect.width / 2;
    program.xdotool(&[
        "mousemove",
        "--window",
        &program.window,
        &column.to_string(),
        "500",
        "mousedown",
        "1",
    ]);
    // The press is seen when the program next looks, and no picture tells of it: go on until the divider follows.
    until("the divider is caught", || {
        program.xdotool(&["mousemove_relative", "--sync", "10", "0"]);
        program.picture() != wipe
    });
    program.xdotool(&[
        "mousemove",
        "--window",
        &program.window,
        &(column + 100).to_string(),
        "500",
        "mouseup",
        "1",
    ]);
    // It was the divider that moved and not the camera: in the first view nothing is changed.
    program.press("shift+Tab");
    back("the picture as it was");
    program.press("q");
    program.end();
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn no_tap_of_a_key_is_lost() {
    let program = Program::open(&[], &[]);
    let start = program.picture();
    // An odd number of times, so that one lost tap shows.
    program.xdotool(&["key", "--repeat", "41", "--delay", "12", "1"]);
    // Events come in order: when the help is there every tap has been answered.
    let before = left_part(&program.picture());
    program.press("h");
    until("the help", || left_part(&program.picture()) != before);
    program.press("h");
    until("the light is off", || {
        right_part(&program.picture()) != right_part(&start) && !program.title().is_empty()
    });
    program.press("1");
    until("the last tap", || {
        right_part(&program.picture()) == right_part(&start)
    });
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn screenshots_are_what_is_shown_and_never_overwrite() {
    let program = Program::open(&["--size", "640x480"], &[]);
    let file = |number: u32| {
        program
            .folder
            .path()
            .join(format!("shadetrade-{number:03}.png"))
    };
    fs::write(file(1), "mine").expect("written");
    let last = std::cell::Cell::new(2);
    // The panel tells times, errors and the proof as soon as they are known; what is saved is the same once all are.
    until("a file shows what the window shows", || {
        let number = last.get();
        let shown = program.picture();
        program.press("F12");
        until("a file is there", || file(number).exists());
        last.set(number + 1);
        let saved = image::open(file(number)).expect("a picture").to_rgb8();
        let part = |window: &RgbImage| image::imageops::crop_imm(window, 0, 0, 640, 380).to_image();
        part(&saved) == part(&shown)
    });
    let saved = fs::read(file(2)).expect("read");
    program.press("F12");
    until("another file is there", || file(last.get()).exists());
    assert_eq!(fs::read(file(2)).expect("read"), saved);
    assert_eq!(fs::read(file(1)).expect("read"), b"mine");
    let before = program.picture();
    make_read_only(program.folder.path());
    program.press("F12");
    // The superuser may write everywhere: then there is one more file, and it is said too.
    program.next_picture(&before, "what came of it");
}

fn make_read_only(folder: &Path) {
    fs::set_permissions(folder, fs::Permissions::from_mode(0o555)).expect("permitted");
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn a_scene_is_edited_saved_drawn_by_its_command_and_read_again() {
    let scenes = tempfile::tempdir().expect("a folder");
    let path = scenes.path().join("mine.toml");
    fs::write(&path, BUILT_IN[0].1).expect("written");
    let program = Program::open(&[path.to_str().expect("UTF-8")], &[]);
    let seen = || right_part(&program.picture());
    let start = seen();
    let file = |name: &str| program.folder.path().join(name);
    // The gain of the first light, which is the last number of its page.
    program.press("e");
    program.press("Up");
    for key in ["4", "0", "period", "5", "Return", "Escape"] {
        program.press(key);
    }
    until("another picture", || seen() != start);
    program.press("ctrl+s");
    until("a scene is saved", || file("mine-1.toml").exists());
    let saved = fs::read_to_string(file("mine-1.toml")).expect("text");
    assert!(saved.contains("gain = 40.5"), "{saved}");
    program.press("shift+F12");
    until("a picture is saved", || file("shadetrade-001.png").exists());
    let shown = image::open(file("shadetrade-001.png")).expect("a picture");
    let size = format!("{}x{}", shown.width(), shown.height());
    let output = Command::new(env!("CARGO_BIN_EXE_shadetrade"))
        .args(["render", "mine-1.toml", "--size", &size, "-o", "drawn.png"])
        .current_dir(program.folder.path())
        .output()
        .expect("it runs");
    assert!(output.status.success(), "{output:?}");
    let drawn = image::open(file("drawn.png")).expect("a picture");
    assert_eq!(shown.to_rgb8(), drawn.to_rgb8());
    program.press("ctrl+z");
    until("the first picture", || seen() == start);
    // The file becomes wrong, and right again.
    fs::write(&path, BUILT_IN[0].1.replace("fov = ", "fov = -")).expect("written");
    until("it is said that it is wrong", || seen() != start);
    fs::write(&path, BUILT_IN[0].1).expect("written");
    until("all is as before", || seen() == start);
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn any_size_is_drawn() {
    let mut program = Program::open(&[], &[]);
    for size in [
        [1, 1],
        [3840, 2160],
        [1, 2160],
        [3840, 1],
        [2, 2],
        [17, 900],
        [320, 240],
        [1, 1],
        [640, 480],
    ] {
        program.resize(size);
        until("the window has its size", || {
            program.picture().dimensions() == (size[0], size[1])
        });
    }
    program.press("h");
    for step in 0..100_u32 {
        program.resize([1 + step * 197 % 1500, 1 + step * 71 % 1100]);
    }
    program.press("Escape");
    for size in [[1, 1], [320, 240], [960, 720], [3840, 2160]] {
        program.resize(size);
        until("the window has its size", || {
            program.picture().dimensions() == (size[0], size[1])
        });
    }
    program.resize([960, 720]);
    let fresh = Program::open(&[], &[]);
    let expected = right_part(&fresh.picture());
    until("the picture is as ever", || {
        right_part(&program.picture()) == expected
    });
    assert!(program.is_running());
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn an_input_method_that_does_not_run_does_no_harm() {
    let program = Program::open(&["--camera", "2"], &[("XMODIFIERS", "@im=ibus")]);
    assert!(
        program.title().contains("camera 2"),
        "the arguments are handed on"
    );
    program.press("q");
    program.end();
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn a_resting_window_hardly_works() {
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
    // The reference takes its time once. The promise is 2 %; the limit leaves room for a busy machine.
    let share = || {
        let (start, before) = (Instant::now(), worked());
        sleep(Duration::from_secs(1));
        worked().saturating_sub(before).as_secs_f64() / start.elapsed().as_secs_f64()
    };
    until("it rests", || share() < 0.05);
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn what_is_recorded_is_replayed_as_it_was_seen() {
    let mut program = Program::open(&["--record", "a.log"], &[]);
    let start = program.picture();
    program.press("p");
    let phong = program.next_picture(&start, "p");
    // A number is begun and forgotten again.
    program.press("e");
    program.press("minus");
    program.next_picture(&phong, "the editor");
    program.xdotool(&["key", "Escape", "Right", "Tab"]);
    until("the wipe is shown", || program.picture() != phong);
    program.press("shift+F12");
    let folder = program.folder.path().to_path_buf();
    let saved = folder.join("shadetrade-001.png");
    until("the picture is saved", || saved.exists());
    program.press("q");
    assert!(program.status().success());
    let replay = |options: &[&str]| {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_shadetrade"))
            .args(["replay", "a.log"])
            .args(options)
            .current_dir(&folder)
            .output()
            .expect("the program starts");
        assert!(output.status.success());
        output.stdout
    };
    let hashes = replay(&["-o", "last.png", "--hash"]);
    assert!(hashes.split(|byte| *byte == b'\n').count() > 4);
    assert_eq!(replay(&["--hash", "--simd", "fallback"]), hashes);
    let [saved, replayed] = [saved, folder.join("last.png")]
        .map(|path| image::open(path).expect("a picture").to_rgb8());
    assert_eq!(saved.dimensions(), replayed.dimensions());
    // The boards that name both sides lie over the upper edge of what is replayed, and the divider's handle over its middle.
    let lower = |picture: &RgbImage| {
        let [width, height] = [picture.width() / 3, picture.height()];
        image::imageops::crop_imm(picture, 0, height / 4, width, height / 2).to_image()
    };
    assert!(lower(&saved) == lower(&replayed));
}

#[test]
#[ignore = "needs a display server and a window manager: apt-get install xvfb xdotool imagemagick libxcursor1 x11-utils openbox"]
fn the_window_covers_the_screen_where_a_window_manager_lets_it() {
    let mut program = Program::open(&[], &[]);
    let start = program.picture();
    program.press("F11");
    let refused = program.next_picture(&start, "a message says that nothing can");
    assert_eq!(refused.dimensions(), start.dimensions());
    program.start_window_manager();
    for size in [SCREEN, start.dimensions()] {
        program.press("F11");
        until("the window has its new size", || {
            program.picture().dimensions() == size
        });
    }
    program.press("q");
    program.end();
}
