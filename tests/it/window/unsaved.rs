//! Unsaved edits: on disk two seconds after a change, offered when the scene is opened again, removed once saved or undone.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use shadetrade::scene::{Scene, SceneRecord};
use tempfile::TempDir;

use super::files::{change, edit, on_file, read, save};
use super::{FRAME, PAUSE, SIZE, Window, choose};
use crate::support::window::default_scene;

/// The folder of the user's in which edits are kept.
fn state_folder(window: &Window) -> PathBuf {
    window.folder.path().join("state")
}

/// A window on a file that keeps its edits.
fn keeping() -> (Window, PathBuf) {
    let (mut window, path) = on_file();
    let state = state_folder(&window);
    window.app.document.keep_edits(&state);
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
    window.folder = folder;
    let state = state_folder(&window);
    window.app.document.keep_edits(&state);
    window.step(Vec::new());
    window
}

/// Clicks a button of the offer.
#[track_caller]
fn answer(mut window: Window, label: &str) -> Window {
    window.with_widgets(SIZE, |it| choose(it, label));
    window.wait(PAUSE);
    window
}

fn is_offered(window: &mut Window) -> bool {
    window.with_widgets(SIZE, |it| it.query_by_label("restore").is_some())
}

/// The files of edits in a state folder.
fn kept_in(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let below = |path: PathBuf| {
        if path.is_dir() {
            kept_in(&path)
        } else {
            vec![path]
        }
    };
    paths.flat_map(below).collect()
}

fn kept(window: &Window) -> Vec<PathBuf> {
    kept_in(&state_folder(window))
}

/// The edits that are on disk, in one file.
#[track_caller]
fn edits(window: &Window) -> SceneRecord {
    let paths = kept(window);
    assert_eq!(paths.len(), 1, "{paths:?}");
    read(&paths[0])
}

#[test]
fn edits_are_on_disk_two_seconds_after_a_change_and_not_before() {
    let (mut window, _) = keeping();
    // Looking is no edit.
    window.press(Key::ArrowLeft);
    window.press(Key::W);
    window.wait(2 * PAUSE);
    assert!(kept(&window).is_empty());
    change(&mut window, 3.0);
    let late = window.now + PAUSE;
    let early = window.now + Duration::from_millis(1999);
    window.step_at(early, Vec::new());
    assert!(kept(&window).is_empty());
    assert!(window.output.repaint_after <= Duration::from_millis(1));
    window.step_at(late, Vec::new());
    assert_eq!(edits(&window), window.record());
    // Changes that go on are on disk, too, the last of them two seconds later at most.
    for step in 0..200_i32 {
        let wanted = f64::from(4 + step);
        change(&mut window, wanted);
        let missing = wanted - edits(&window).light[0].intensity;
        let steps = PAUSE.as_millis() / FRAME.as_millis();
        assert!(missing <= steps as f64, "{missing} steps");
    }
    window.wait(PAUSE);
    assert_eq!(edits(&window), window.record());
    assert_eq!(window.files(), ["mine.toml", "state"]);
    assert_eq!(window.message(), "");
}

#[test]
fn the_file_of_edits_goes_when_they_are_saved_or_undone() {
    let (mut window, path) = keeping();
    edit(&mut window, 3.0);
    assert_eq!(kept(&window).len(), 1);
    window.undo();
    assert!(kept(&window).is_empty());
    window.redo();
    window.wait(PAUSE);
    assert_eq!(kept(&window).len(), 1);
    save(&mut window);
    assert!(kept(&window).is_empty());
    // Edits after it are those of the new file.
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    edit(&mut window, 4.0);
    let mut window = start(kill(window), Some(&path));
    assert!(!is_offered(&mut window));
    let other = path.with_file_name("mine-2.toml");
    window.choose(Scene::load_path(&other).expect("a scene"));
    let window = answer(window, "restore");
    assert_eq!(window.record().light[0].intensity, 4.0);
}

#[test]
fn edits_of_a_window_that_ended_are_offered_until_they_are_restored_or_discarded() {
    // Of a file, and of a built-in scene.
    for (mut window, path) in [
        (keeping().0, true),
        (start(tempfile::tempdir().expect("a folder"), None), false),
    ] {
        let path = path.then(|| window.folder.path().join("mine.toml"));
        let path = path.as_deref();
        let saved = window.record();
        // The record has the view, too.
        for key in [Key::ArrowLeft, Key::P, Key::O] {
            window.press(key);
        }
        edit(&mut window, 3.0);
        let edited = window.record();
        // Without an answer they are offered again, and nothing is restored by itself.
        window = start(kill(window), path);
        assert_eq!(window.record(), saved);
        window = answer(start(kill(window), path), "restore");
        assert_eq!(window.record(), edited);
        assert!(window.app.document.title().contains('*'));
        // A restart still offers them.
        window = answer(start(kill(window), path), "restore");
        assert_eq!(kept(&window).len(), 1);
        window.undo();
        assert_eq!(window.record(), saved);
        assert!(kept(&window).is_empty());
        window.redo();
        window.wait(PAUSE);
        assert_eq!(edits(&window), edited);
        let mut window = answer(start(kill(window), path), "discard");
        assert!(!is_offered(&mut window) && kept(&window).is_empty());
        assert_eq!(window.record(), saved);
    }
}

#[test]
fn edits_made_beside_an_offer_are_kept() {
    for (label, intensity) in [("restore", 3.0), ("discard", 4.0)] {
        let (mut window, path) = keeping();
        edit(&mut window, 3.0);
        window = start(kill(window), Some(&path));
        edit(&mut window, 4.0);
        window = answer(window, label);
        window.wait(PAUSE);
        assert_eq!(window.record().light[0].intensity, intensity);
        assert_eq!(edits(&window), window.record(), "{label}");
        if label == "restore" {
            window.undo();
            assert_eq!(window.record().light[0].intensity, 4.0);
        }
    }
}

#[test]
fn of_two_windows_on_one_scene_the_last_writer_stays() {
    let (mut one, path) = keeping();
    edit(&mut one, 3.0);
    let mut other = Window::of(Scene::load_path(&path).expect("a scene"), SIZE);
    other.app.document.keep_edits(&state_folder(&one));
    edit(&mut other, 4.0);
    assert_eq!(edits(&one), other.record());
    assert!(one.app.may_close(false).expect("written"));
    assert_eq!(edits(&one), one.record());
}

#[test]
fn edits_that_cannot_be_written_are_told_once_and_hold_the_window() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("state"), "a file in its place").expect("written");
    let mut window = start(folder, None);
    edit(&mut window, 3.0);
    let message = window.message();
    assert!(message.contains("cannot be written"), "{message}");
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
    assert_eq!(edits(&window), window.record());
}

#[test]
fn another_scene_leaves_the_edits_of_the_one_before_on_disk() {
    let (mut window, path) = keeping();
    change(&mut window, 3.0);
    let edits = window.record();
    let other = Scene::load(Some("assignment")).expect("built in");
    window.choose(other);
    window.wait(PAUSE);
    assert!(window.app.document.title().contains("assignment"));
    window.undo();
    assert_eq!(window.message(), "nothing to undo");
    window.choose(Scene::load_path(&path).expect("a scene"));
    let window = answer(window, "restore");
    assert_eq!(window.record(), edits);
}

#[test]
fn a_scene_has_one_file_whatever_the_way_to_it() {
    let (mut window, path) = keeping();
    edit(&mut window, 3.0);
    let folder = path.with_file_name("folder");
    fs::create_dir(&folder).expect("made");
    let mut window = start(kill(window), Some(&folder.join("../mine.toml")));
    assert!(is_offered(&mut window));
}
