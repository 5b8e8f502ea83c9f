//! The real window on its own X server: opened, controlled and checked from outside.

use std::fs;
use std::thread::sleep;
use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use fearless_simd::Level;
use image::RgbImage;

use super::desktop::{Display, Point, Program, until};
use super::support::{app, default_scene, places, widgets};
use shadetrade::window::inspector::Tab;

/// The initial size of the window, in pixels.
const SIZE: [usize; 2] = [960, 720];
/// A window of that size with the picture alone.
pub(super) const PLAIN: &[&str] = &[
    "--size=960x720",
    "--set=view.show=picture",
    "--set=view.divider=0.5",
];

/// The centre of the widget with this label.
fn place(label: &str) -> Point {
    let mut app = app(default_scene(), SIZE, Level::new());
    // The real window has the chart of times.
    app.desk.shows_times = true;
    let harness = widgets(app, SIZE);
    let at = places(&harness, label)[0];
    [at.x, at.y].map(|it| it as i32)
}

/// The picture's area in a window of the initial size.
pub(super) fn picture(window: &RgbImage) -> RgbImage {
    let harness = widgets(app(default_scene(), SIZE, Level::new()), SIZE);
    let place = harness.state().canvas.place;
    let [x, y, width, height] =
        [place.min.x, place.min.y, place.width(), place.height()].map(|it| it as u32);
    image::imageops::crop_imm(window, x, y, width, height).to_image()
}

/// A position on the cuboid.
const CUBOID: Point = [620, 350];

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn keys_change_the_picture_and_restore_it() {
    let program = Program::open(PLAIN, &[]);
    let start = program.picture();
    assert_eq!(start.dimensions(), (960, 720));
    let file = program.folder.path().join("cuboid.toml");
    let title = format!("cuboid (Ctrl S writes {}) - shadetrade", file.display());
    assert_eq!(program.title(), title);
    let start = picture(&start);
    let seen = || picture(&program.picture());
    let pairs = "w 1|2 r|p g|o o|c c|Left Right|Up Home|plus minus|KP_Subtract KP_Add|F3 F2|F6 F2|h h|question Escape|\
                 F1 Escape|p ctrl+z";
    for (there, back) in pairs.split('|').filter_map(|it| it.split_once(' ')) {
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
    program.quit();
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn clicks_drags_and_the_wheel_have_their_effects() {
    let program = Program::open(PLAIN, &[]);
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
    program.quit();
}

/// The column of the divider in the window.
fn place_of_divider() -> i32 {
    let harness = widgets(app(default_scene(), SIZE, Level::new()), SIZE);
    harness.state().canvas.place.center().x as i32
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn no_tap_of_a_key_is_lost() {
    let program = Program::open(PLAIN, &[]);
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
#[ignore = "needs a display server and a window manager: apt-get install xvfb xdotool imagemagick libxcursor1 x11-utils openbox"]
fn quitting_and_closing_the_frame_keep_edits() {
    for way in ["q", "alt+F4"] {
        let mut program = Program::open(PLAIN, &[]);
        let folder = program.folder.path().to_path_buf();
        program.start_window_manager();
        edit(&program);
        if way == "q" {
            // The first press says that edits are not saved.
            let before = program.picture();
            program.press("q");
            until("a question", || program.picture() != before);
        }
        program.press(way);
        assert!(program.ended().success(), "{way}");
        assert!(folder.join(UNSAVED).exists(), "{way}");
    }
}

/// The file of unsaved edits.
pub(super) const UNSAVED: &str = "shadetrade/built-in/cuboid-unsaved.toml";

/// Makes an edit: another width of the cuboid.
pub(super) fn edit(program: &Program) {
    let start = picture(&program.picture());
    program.press("e");
    until("the editor", || picture(&program.picture()) != start);
    let mut app = app(default_scene(), SIZE, Level::new());
    app.desk.open(Tab::Scene);
    let harness = widgets(app, SIZE);
    let mut numbers = harness.query_all_by_role(Role::SpinButton);
    let width = numbers.next().expect("a number").rect().center();
    program.drag([width.x as i32, width.y as i32], [30, 0]);
    until("a star", || program.title().contains('*'));
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn an_input_method_that_does_not_run_is_harmless() {
    let program = Program::open(&["assignment"], &[("XMODIFIERS", "@im=ibus")]);
    let title = "the arguments are handed on";
    until(title, || program.title().contains("assignment"));
    program.quit();
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn a_display_without_24_bits_is_an_error_in_words() {
    for depth in [8, 16, 30] {
        let display = Display::start(depth);
        let folder = tempfile::tempdir().expect("a folder");
        for arguments in [&[][..], &["lesson", "how-many-vertices"]] {
            let output = display.command(folder.path()).args(arguments).output();
            let output = output.expect("the program starts");
            let text = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(1), "{depth}: {text}");
            let is_told = text.contains(&format!("{depth} bits")) && text.contains("without");
            assert!(is_told, "{text}");
        }
        assert_eq!(fs::read_dir(folder.path()).expect("listed").count(), 0);
    }
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1 x11-utils"]
fn letters_have_the_size_of_the_screen_and_of_the_user_s_choice() {
    let open = |folder, dpi| {
        let display = Display::start(24);
        display.set_dpi(dpi);
        Program::open_on(display, folder, PLAIN, &[])
    };
    let mut program = open(tempfile::tempdir().expect("a folder"), 96);
    let is_light = |pixel: &&image::Rgb<u8>| pixel.0.iter().all(|it| *it > 150);
    let light = |picture: &RgbImage| picture.pixels().filter(is_light).count() as f64;
    let usual = light(&program.picture());
    // The second start goes on from the choice of the first.
    let mut chosen = 1.0;
    for _ in 0..2 {
        let file = program.folder.path().join("shadetrade/zoom");
        let kept = || fs::read_to_string(&file).ok()?.parse::<f32>().ok();
        program.press("ctrl+plus");
        let is_kept = || kept().is_some_and(|it| it > chosen);
        until("the choice is kept", is_kept);
        chosen = kept().expect("a number");
        let folder = program.take_folder();
        program.quit();
        program = open(folder, 96);
    }
    program = open(tempfile::tempdir().expect("a folder"), 192);
    let picture = program.picture();
    assert_eq!(picture.dimensions(), (1920, 1440));
    // Letters twice as large have about four times as many pixels.
    let factor = light(&picture) / usual;
    assert!((2.5..6.0).contains(&factor), "{factor}");
    program.quit();
}

#[test]
#[ignore = "needs a display server: apt-get install xvfb xdotool imagemagick libxcursor1"]
fn an_idle_window_uses_little_processor_time() {
    let program = Program::open(&["--size", "1920x1080"], &[]);
    let worked = || {
        let tasks = fs::read_dir(format!("/proc/{}/task", program.child.id())).expect("listed");
        let nanoseconds = tasks.filter_map(|task| {
            let file = task.expect("a task").path().join("schedstat");
            // A task that has ended since has no file.
            let statistics = fs::read_to_string(file).ok()?;
            statistics.split(' ').next()?.parse::<u64>().ok()
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
