//! Unsaved edits: on disk two seconds after a change, whatever ends the program, offered when the scene is opened again.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use shadetrade::scene::{BUILT_IN, Scene, SceneRecord};
use tempfile::TempDir;

use super::files::{change, edit, on_file, read, save, write};
use super::{FRAME, PAUSE, SIZE, Window, lesson};
use crate::support::window::{default_scene, widgets};

/// The folder of the user's in which edits are kept.
fn state_folder(window: &Window) -> PathBuf {
    window.folder.path().join("state")
}

/// A window on a file that keeps its edits.
fn keeping() -> (Window, PathBuf) {
    let (mut window, path) = on_file();
    let state = state_folder(&window);
    window.app.document.keep_edits(vec![state]);
    (window, path)
}

/// Ends a window as a killed program does, and returns its files.
fn kill(window: Window) -> TempDir {
    window.folder
}

/// A new window on a file in `folder`, or on the built-in scene.
fn start(folder: TempDir, path: Option<&Path>) -> Window {
    let scene = path.map(|path| Scene::load_path(path).expect("a scene"));
    let mut window = Window::of(scene.unwrap_or_else(default_scene), SIZE);
    window
        .app
        .document
        .keep_edits(vec![folder.path().join("state")]);
    window.folder = folder;
    window.step(Vec::new());
    window
}

/// Clicks a button of the offer.
#[track_caller]
fn answer(mut window: Window, label: &str) -> Window {
    let mut harness = widgets(window.app, SIZE);
    harness.get_by_label(label).click();
    harness.run_ok();
    window.app = std::mem::replace(harness.state_mut(), Window::open().app);
    window.wait(PAUSE);
    window
}

fn is_offered(window: Window) -> (Window, bool) {
    let Window { app, .. } = window;
    let mut harness = widgets(app, SIZE);
    let is_offered = harness.query_by_label("restore").is_some();
    let app = std::mem::replace(harness.state_mut(), Window::open().app);
    (Window { app, ..window }, is_offered)
}

fn intensity(path: &Path) -> f64 {
    read(path).light[0].intensity
}

#[test]
fn edits_are_on_disk_two_seconds_after_a_change_and_not_before() {
    let (mut window, path) = keeping();
    let file = path.with_file_name("mine-unsaved.toml");
    // Looking is no edit.
    window.press(Key::ArrowLeft);
    window.press(Key::W);
    window.wait(2 * PAUSE);
    assert!(!file.exists());
    change(&mut window, 3.0);
    let late = window.now + PAUSE;
    let early = window.now + Duration::from_millis(1999);
    window.step_at(early, Vec::new());
    assert!(!file.exists());
    assert!(window.output.repaint_after <= Duration::from_millis(1));
    window.step_at(late, Vec::new());
    assert_eq!(read(&file), window.record());
    // Changes that go on are on disk, too, the last of them two seconds later at most.
    for step in 0..200_i32 {
        let wanted = f64::from(4 + step);
        change(&mut window, wanted);
        let missing = wanted - intensity(&file);
        let steps = PAUSE.as_millis() / FRAME.as_millis();
        assert!(missing <= steps as f64, "{missing} steps");
    }
    window.wait(PAUSE);
    assert_eq!(read(&file), window.record());
    assert_eq!(window.files(), ["mine-unsaved.toml", "mine.toml"]);
    assert_eq!(window.message(), "");
}

#[test]
fn the_file_of_edits_goes_when_they_are_saved_or_undone() {
    let (mut window, path) = keeping();
    let file = path.with_file_name("mine-unsaved.toml");
    edit(&mut window, 3.0);
    assert!(file.exists());
    window.undo();
    assert!(!file.exists());
    window.redo();
    window.wait(PAUSE);
    assert!(file.exists());
    save(&mut window);
    assert!(!file.exists());
    // Edits after it are those of the new file.
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    edit(&mut window, 4.0);
    let files = ["mine-2-unsaved.toml", "mine-2.toml", "mine.toml"];
    assert_eq!(window.files(), files);
    window.undo();
    assert!(!window.app.document.title().contains('*'));
    // It is not offered either.
    window.wait(PAUSE);
    let folder = kill(window);
    let (_, is_offered) = is_offered(start(folder, Some(&path)));
    assert!(!is_offered);
}

#[test]
fn edits_of_a_window_that_ended_are_offered_until_they_are_restored_or_discarded() {
    let (mut window, path) = keeping();
    let file = path.with_file_name("mine-unsaved.toml");
    let saved = window.record();
    edit(&mut window, 3.0);
    let edits = window.record();
    // Without an answer they are offered again.
    let folder = kill(window);
    let window = start(folder, Some(&path));
    assert_eq!(window.record(), saved, "nothing is restored by itself");
    let folder = kill(window);
    let mut window = answer(start(folder, Some(&path)), "restore");
    assert_eq!(window.record(), edits);
    assert!(window.app.document.title().contains('*'));
    // A restart still offers them.
    let folder = kill(window);
    window = answer(start(folder, Some(&path)), "restore");
    assert_eq!(window.files(), ["mine-unsaved.toml", "mine.toml"]);
    window.undo();
    assert_eq!(window.record(), saved);
    window.redo();
    save(&mut window);
    assert_eq!(read(&path), edits);
    assert_eq!(window.files(), ["mine.toml"]);
    edit(&mut window, 4.0);
    let folder = kill(window);
    assert!(file.exists());
    let (window, is_left) = is_offered(answer(start(folder, Some(&path)), "discard"));
    assert!(!is_left && !file.exists());
    assert_eq!(window.record(), edits);
}

#[test]
fn two_windows_on_one_scene_leave_each_other_s_edits_alone() {
    let (mut one, path) = keeping();
    edit(&mut one, 3.0);
    let folder = tempfile::tempdir().expect("a folder");
    let (mut other, has_first) = is_offered(start(folder, Some(&path)));
    assert!(!has_first, "its window is open");
    edit(&mut other, 4.0);
    edit(&mut one, 5.0);
    let [first, second] =
        ["mine-unsaved.toml", "mine-unsaved-2.toml"].map(|name| path.with_file_name(name));
    assert_eq!([&first, &second].map(|it| intensity(it)), [5.0, 4.0]);
    let (_other, folder) = (kill(other), kill(one));
    // Each is offered, one after the other, and edits made meanwhile are kept.
    let mut window = start(folder, Some(&path));
    edit(&mut window, 6.0);
    let third = path.with_file_name("mine-unsaved-3.toml");
    assert_eq!(intensity(&third), 6.0);
    let mut window = answer(window, "restore");
    assert_eq!(window.record().light[0].intensity, 5.0);
    save(&mut window);
    assert!(!first.exists());
    let window = answer(window, "restore");
    assert_eq!(window.record().light[0].intensity, 6.0);
    assert_eq!([&second, &third].map(|it| intensity(it)), [4.0, 6.0]);
}

#[test]
fn edits_go_to_a_folder_of_the_user_s_where_the_scene_has_none() {
    // A built-in scene.
    let mut window = start(tempfile::tempdir().expect("a folder"), None);
    edit(&mut window, 3.0);
    let edits = window.record();
    assert!(
        state_folder(&window)
            .join("built-in/cuboid-unsaved.toml")
            .exists()
    );
    let window = answer(start(kill(window), None), "restore");
    assert_eq!(window.record(), edits);
    // A folder that is removed while the window is open.
    let (mut window, other) = on_file();
    let folder = other.with_file_name("own");
    fs::create_dir(&folder).expect("made");
    let path = folder.join("mine.toml");
    fs::rename(other, &path).expect("moved");
    window.choose(Scene::load_path(&path).expect("a scene"));
    let state = state_folder(&window);
    window.app.document.keep_edits(vec![state.clone()]);
    edit(&mut window, 3.0);
    fs::remove_dir_all(&folder).expect("removed");
    window.wait(PAUSE);
    window.wait(PAUSE);
    let kept = state.join(path.strip_prefix("/").expect("a path from the root"));
    assert_eq!(
        read(&kept.with_file_name("mine-unsaved.toml")),
        window.record()
    );
    assert!(!folder.exists());
    // So it is at once if the window closes.
    edit(&mut window, 4.0);
    assert!(window.app.may_close(true).expect("written"));
    fs::create_dir(&folder).expect("made");
    fs::write(&path, BUILT_IN[0].1).expect("written");
    let window = answer(start(kill(window), Some(&path)), "restore");
    assert_eq!(window.record().light[0].intensity, 4.0);
}

#[test]
fn edits_that_cannot_be_written_are_told_once_and_hold_the_window() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("state"), "a file in its place").expect("written");
    let mut window = start(folder, None);
    edit(&mut window, 3.0);
    assert!(
        window.message().contains("cannot be written"),
        "{}",
        window.message()
    );
    window.app.desk.message = None;
    window.wait(PAUSE);
    edit(&mut window, 4.0);
    assert_eq!(window.message(), "");
    window.press(Key::Q);
    assert!(!window.app.may_close(false).expect("it stays") && !window.app.desk.quits);
    assert!(window.message().contains("not closed"));
    window.choose(Scene::load(Some("assignment")).expect("built in"));
    assert!(window.message().contains("not opened"));
    assert!(window.app.document.title().starts_with("cuboid*"));
    assert!(window.app.may_close(true).is_err());
    // As soon as there is a place, they are there.
    fs::remove_file(state_folder(&window)).expect("removed");
    window.wait(PAUSE);
    assert!(
        state_folder(&window)
            .join("built-in/cuboid-unsaved.toml")
            .exists()
    );
}

#[test]
fn edits_that_a_changed_file_takes_away_are_offered() {
    let (mut window, path) = keeping();
    edit(&mut window, 3.0);
    let edits = window.record();
    write(&path, "fov = 31.25");
    window.wait(PAUSE);
    assert_eq!(window.record().light[0].intensity, 10.0);
    let window = answer(window, "restore");
    assert_eq!(window.record(), edits);
    assert_eq!(window.files(), ["mine-unsaved.toml", "mine.toml"]);
}

#[test]
fn edits_that_a_step_of_a_lesson_takes_away_are_offered() {
    let mut window = lesson::open();
    let state = state_folder(&window);
    window.app.document.keep_edits(vec![state]);
    change(&mut window, 3.0);
    let edits = window.record();
    window.press(Key::Enter);
    assert_ne!(window.record(), edits);
    let window = answer(window, "restore");
    assert_eq!(window.record(), edits);
}

#[test]
fn another_scene_leaves_the_edits_of_the_one_before_on_disk() {
    let (mut window, path) = keeping();
    change(&mut window, 3.0);
    let edits = window.record();
    let other = Scene::load(Some("assignment")).expect("built in");
    window.choose(other);
    assert!(window.message().contains("mine-unsaved.toml"));
    window.wait(PAUSE);
    assert!(window.app.document.title().contains("assignment"));
    window.undo();
    assert_eq!(window.message(), "nothing to undo");
    assert_eq!(window.files(), ["mine-unsaved.toml", "mine.toml"]);
    window.choose(Scene::load_path(&path).expect("a scene"));
    let window = answer(window, "restore");
    assert_eq!(window.record(), edits);
}

#[test]
fn a_file_that_only_has_the_name_of_edits_is_neither_offered_nor_replaced() {
    let (window, path) = keeping();
    let own = [
        "mine-unsaved.toml",
        "mine-unsaved-b.toml",
        "mine-unsaved.txt",
    ];
    for (name, text) in own.into_iter().zip(["mine", BUILT_IN[0].1, BUILT_IN[0].1]) {
        fs::write(path.with_file_name(name), text).expect("written");
    }
    let folder = kill(window);
    let (mut window, is_offered) = is_offered(start(folder, Some(&path)));
    assert!(!is_offered);
    edit(&mut window, 3.0);
    assert!(path.with_file_name("mine-unsaved-2.toml").exists());
    assert_eq!(
        fs::read(path.with_file_name(own[0])).expect("read"),
        b"mine"
    );
}

#[test]
fn a_record_of_the_edits_has_the_view_too() {
    let (mut window, path) = keeping();
    for key in [Key::ArrowLeft, Key::P, Key::O] {
        window.press(key);
    }
    edit(&mut window, 3.0);
    let edits: SceneRecord = window.record();
    let window = answer(start(kill(window), Some(&path)), "restore");
    assert_eq!(window.record(), edits);
}
