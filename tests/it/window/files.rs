//! The scene's file: saving, the mark of edits, quitting, and reloading after a change.

use std::fs;
use std::path::{Path, PathBuf};

use egui::{Key, Modifiers};
use shadetrade::components::Light;
use shadetrade::scene::{BUILT_IN, Scene, SceneRecord};
use shadetrade::window::recording::Log;
use shadetrade::window::replay;

use super::{PAUSE, SIZE, Window};

const CONTROL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// A window on a file in its temporary folder.
fn on_file() -> (Window, PathBuf) {
    let mut window = Window::open();
    let path = window.folder.path().join("mine.toml");
    fs::write(&path, BUILT_IN[0].1).expect("written");
    let scene = Scene::load_path(&path).expect("a scene");
    window.app.open(scene);
    window.wait(PAUSE);
    (window, path)
}

/// Makes an edit that must be saved.
fn edit(window: &mut Window, intensity: f64) {
    let lights = window.app.scene.world.query_mut::<&mut Light>();
    lights
        .into_iter()
        .for_each(|light| light.intensity = intensity);
    window.step(Vec::new());
    window.wait(PAUSE);
}

fn read(path: &Path) -> SceneRecord {
    let scene = Scene::load_path(path).unwrap_or_else(|error| panic!("{error}"));
    SceneRecord::of(&scene.world)
}

fn save(window: &mut Window) {
    window.press_with(Modifiers::COMMAND, Key::S);
}

#[test]
fn a_file_is_saved_in_place_with_its_comments_and_read_again() {
    let (mut window, path) = on_file();
    for key in [Key::W, Key::ArrowUp, Key::F3, Key::O, Key::E] {
        window.press(key);
    }
    edit(&mut window, 12.5);
    save(&mut window);
    assert_eq!(window.files(), ["mine.toml"]);
    assert_eq!(read(&path), window.record());
    let saved = fs::read_to_string(&path).expect("text");
    for comment in BUILT_IN[0]
        .1
        .lines()
        .filter(|line| line.starts_with('#') && !line.starts_with("# near"))
    {
        assert!(saved.contains(comment), "{comment}");
    }
    assert!(window.message().contains("mine.toml"));
}

#[test]
fn a_new_file_has_the_scenes_name_with_a_number_and_replaces_none() {
    let mut window = Window::open();
    fs::write(window.folder.path().join("cuboid-2.toml"), "mine").expect("written");
    save(&mut window);
    assert_eq!(window.files(), ["cuboid-2.toml", "cuboid.toml"]);
    edit(&mut window, 3.0);
    save(&mut window);
    assert_eq!(
        window.files(),
        ["cuboid-2.toml", "cuboid.toml"],
        "it has a file now"
    );
    edit(&mut window, 4.0);
    window.press_with(CONTROL_SHIFT, Key::S);
    assert_eq!(
        window.files(),
        ["cuboid-2.toml", "cuboid-3.toml", "cuboid.toml"]
    );
    let file = |name: &str| window.folder.path().join(name);
    assert_eq!(read(&file("cuboid.toml")).light[0].intensity, 3.0);
    assert_eq!(read(&file("cuboid-3.toml")), window.record());
    assert_eq!(fs::read(file("cuboid-2.toml")).expect("read"), b"mine");
}

#[test]
fn a_failed_write_is_reported_and_the_edits_stay() {
    let (mut window, path) = on_file();
    edit(&mut window, 3.0);
    fs::remove_file(&path).expect("removed");
    fs::create_dir(&path).expect("made");
    save(&mut window);
    assert!(
        window.message().starts_with("not saved"),
        "{}",
        window.message()
    );
    assert!(window.app.is_edited());
}

#[test]
fn the_title_has_a_star_while_edits_are_not_saved() {
    let (mut window, _) = on_file();
    let has_star = |window: &Window| window.output.title.contains('*');
    for key in [
        Key::W,
        Key::ArrowLeft,
        Key::P,
        Key::F3,
        Key::E,
        Key::O,
        Key::CloseBracket,
    ] {
        window.press(key);
        assert!(!has_star(&window), "{key:?} is looking");
    }
    window.wait(PAUSE);
    edit(&mut window, 3.0);
    assert!(has_star(&window) && window.output.title.contains("mine.toml"));
    window.undo();
    assert!(!has_star(&window));
    window.redo();
    assert!(has_star(&window));
    save(&mut window);
    window.step(Vec::new());
    assert!(!has_star(&window));
    window.undo();
    assert!(has_star(&window), "the file has the edit now");
}

#[test]
fn quitting_asks_only_if_edits_would_be_lost() {
    let mut window = Window::open();
    window.press(Key::W);
    window.press(Key::Q);
    assert!(window.app.quits);
    let mut window = Window::open();
    edit(&mut window, 3.0);
    for _ in 0..2 {
        window.press(Key::Q);
        assert!(window.app.desk.asks_to_save && !window.app.quits);
        window.press(Key::Escape);
        assert!(!window.app.desk.asks_to_save && !window.app.quits);
    }
    save(&mut window);
    window.press(Key::Q);
    assert!(window.app.quits);
}

#[test]
fn unsaved_edits_are_rescued_into_a_new_file() {
    let (mut window, path) = on_file();
    window.press(Key::W);
    assert_eq!(window.app.rescue().expect("nothing to write"), None);
    edit(&mut window, 3.0);
    for name in ["mine-unsaved.toml", "mine-unsaved-2.toml"] {
        let told = window.app.rescue().expect("written");
        assert!(told.is_some_and(|told| told.contains(name)));
        assert_eq!(read(&window.folder.path().join(name)), window.record());
    }
    assert_ne!(read(&path), window.record());
}

#[test]
fn another_scene_takes_no_edits_with_it() {
    let (mut window, _) = on_file();
    edit(&mut window, 3.0);
    let edits = window.record();
    window
        .app
        .choose(Scene::load(Some("assignment")).expect("built in"));
    window.wait(PAUSE);
    assert!(window.output.title.contains("assignment"));
    let kept = window
        .files()
        .into_iter()
        .find(|name| name.contains("unsaved"));
    let kept = kept.expect("the edits are in a file");
    assert_eq!(read(&window.folder.path().join(kept)), edits);
    window.undo();
    assert_eq!(window.message(), "nothing to undo");
}

#[test]
fn a_recording_that_opens_another_scene_writes_no_file() {
    let (mut window, _) = on_file();
    edit(&mut window, 3.0);
    let before = window.files();
    let text = {
        let record = serde_json::to_string(&window.record()).expect("JSON");
        format!("0.000 scene {{\"name\":\"other\",\"scene\":{record}}}\n")
    };
    let log = Log::read("other.log", text.as_bytes(), PAUSE).expect("a recording");
    replay::play(&mut window.app, &log.frames[0]).expect("it is played");
    window.wait(PAUSE);
    assert!(window.output.title.contains("other"));
    assert_eq!(window.files(), before);
}

#[test]
fn a_changed_file_is_read_again_and_undo_restores_the_edits() {
    let (mut window, path) = on_file();
    window.press(Key::ArrowLeft);
    window.press(Key::O);
    edit(&mut window, 3.0);
    let edited = window.record();
    let text = BUILT_IN[0]
        .1
        .replace("size = [4.0, 3.0, 2.0]", "size = [5.0, 3.25, 2.0]");
    fs::write(&path, text).expect("written");
    window.wait(PAUSE);
    let record = window.record();
    assert_eq!(record.cuboid[0].size.to_array(), [5.0, 3.25, 2.0]);
    assert_eq!(record.light[0].intensity, 10.0);
    assert_eq!(record.camera, edited.camera, "the camera stays where it is");
    assert_eq!(record.view, edited.view);
    assert!(!window.message().is_empty());
    window.wait(PAUSE);
    window.undo();
    assert_eq!(window.record(), edited);
}

#[test]
fn the_windows_own_saving_does_not_reload_the_file() {
    let (mut window, _) = on_file();
    window.press(Key::P);
    save(&mut window);
    let before = window.record();
    window.app.desk.message = None;
    (0..5).for_each(|_| window.wait(PAUSE));
    assert_eq!(window.message(), "");
    assert_eq!(window.record(), before);
}

#[test]
fn a_wrong_file_is_reported_with_its_place_and_the_scene_stays_until_it_is_right() {
    let (mut window, path) = on_file();
    let before = window.record();
    fs::write(&path, BUILT_IN[0].1.replace("fov = 30.0", "fov = -30.0")).expect("written");
    (0..3).for_each(|_| window.wait(PAUSE));
    let error = window.app.desk.file_error.clone().expect("an error");
    assert!(
        error.contains("mine.toml") && error.contains("fov"),
        "{error}"
    );
    assert_eq!(window.record(), before);
    save(&mut window);
    let text = fs::read_to_string(&path).expect("text");
    assert!(text.contains("fov = -30.0"), "the wrong text is kept");
    fs::write(&path, BUILT_IN[0].1.replace("fov = 30.0", "fov = 31.25")).expect("written");
    window.wait(PAUSE);
    assert_eq!(window.app.desk.file_error, None);
    assert_eq!(window.record().camera[0].fov, 31.25);
}

#[test]
fn a_file_that_is_half_written_is_no_error() {
    let (mut window, path) = on_file();
    let text = BUILT_IN[0].1.replace("fov = 30.0", "fov = 31.25");
    for end in [text.len() / 2, 0] {
        fs::write(&path, &text[..end]).expect("written");
        window.wait(PAUSE);
        assert_eq!(window.app.desk.file_error, None);
    }
    fs::write(&path, &text).expect("written");
    window.wait(PAUSE);
    assert_eq!(window.app.desk.file_error, None);
    assert_eq!(window.record().camera[0].fov, 31.25);
}

#[test]
fn a_deleted_file_is_reported_and_saving_writes_it_again() {
    let (mut window, path) = on_file();
    let before = window.record();
    fs::remove_file(&path).expect("removed");
    (0..3).for_each(|_| window.wait(PAUSE));
    assert!(
        window
            .app
            .desk
            .file_error
            .as_ref()
            .is_some_and(|it| it.contains("mine.toml"))
    );
    assert_eq!(window.record(), before);
    save(&mut window);
    assert_eq!(read(&path), before);
    assert_eq!(window.app.desk.file_error, None);
}

#[test]
#[cfg(unix)]
fn a_pipe_in_place_of_the_file_does_not_stop_the_window() {
    use std::sync::mpsc;
    let (done, ends) = mpsc::channel();
    // A window that waits for the pipe would block the test.
    std::thread::spawn(move || {
        let (mut window, path) = on_file();
        let before = window.record();
        fs::remove_file(&path).expect("removed");
        let made = std::process::Command::new("mkfifo").arg(&path).status();
        assert!(made.expect("mkfifo is there").success());
        (0..3).for_each(|_| window.wait(PAUSE));
        assert!(window.app.desk.file_error.is_some());
        assert_eq!(window.record(), before);
        done.send(()).expect("it is waited for");
    });
    let patience = std::time::Duration::from_mins(1);
    ends.recv_timeout(patience).expect("the window goes on");
}

#[test]
fn screenshots_are_the_pixels_that_are_shown() {
    let mut window = Window::open();
    let load = |window: &Window, name: &str| {
        let picture = image::open(window.folder.path().join(name)).expect("a picture");
        let picture = picture.to_rgb8();
        let pixels = picture.pixels().map(|pixel| {
            let [red, green, blue] = pixel.0.map(u32::from);
            red << 16 | green << 8 | blue
        });
        (
            [picture.width() as usize, picture.height() as usize],
            pixels.collect::<Vec<u32>>(),
        )
    };
    let shown: Vec<u32> = window
        .app
        .pixels()
        .iter()
        .map(|pixel| pixel & 0x00ff_ffff)
        .collect();
    window.press(Key::F12);
    assert_eq!(
        window.files(),
        ["shadetrade-001.png"],
        "{}",
        window.message()
    );
    let (size, pixels) = load(&window, "shadetrade-001.png");
    assert_eq!(size, SIZE);
    assert!(pixels == shown);
}
