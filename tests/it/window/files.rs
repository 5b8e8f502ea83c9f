//! The scene's file: saving, the mark of edits, quitting, and reloading after a change.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use egui::{Key, Modifiers};
use shadetrade::components::Light;
use shadetrade::questions::metrics::Pixel;
use shadetrade::scene::{BUILT_IN, Scene, SceneRecord};
use shadetrade::window::app::App;
use shadetrade::window::error_map;
use shadetrade::window::inspector::Tab;

use super::{PAUSE, SIZE, Window, choose, press};
use crate::support::scene::text_without_view;
use crate::support::window::widgets;

const CONTROL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// A window on a file in its temporary folder.
pub fn on_file() -> (Window, PathBuf) {
    let mut window = Window::open();
    let path = window.folder.path().join("mine.toml");
    fs::write(&path, BUILT_IN[0].1).expect("written");
    let scene = Scene::load_path(&path).expect("a scene");
    window.choose(scene);
    window.wait(PAUSE);
    (window, path)
}

/// Makes an edit that must be saved.
pub fn change(window: &mut Window, intensity: f64) {
    let world = &mut window.app.document.scene.world;
    for light in world.query_mut::<&mut Light>() {
        light.intensity = intensity;
    }
    window.step(Vec::new());
}

/// Makes an edit, and waits until it is a step of the history.
pub fn edit(window: &mut Window, intensity: f64) {
    change(window, intensity);
    window.wait(PAUSE);
}

/// Writes the built-in scene with another field of view.
pub fn write(path: &Path, fov: &str) {
    fs::write(path, BUILT_IN[0].1.replace("fov = 30.0", fov)).expect("written");
}

pub fn read(path: &Path) -> SceneRecord {
    let scene = Scene::load_path(path).unwrap_or_else(|error| panic!("{error}"));
    SceneRecord::of(&scene.world)
}

pub fn save(window: &mut Window) {
    window.press_with(Modifiers::COMMAND, Key::S);
}

#[test]
fn a_file_is_saved_in_place_with_its_comments_and_not_read_again() {
    let (mut window, path) = on_file();
    for key in [Key::W, Key::ArrowUp, Key::F3, Key::O, Key::E] {
        window.press(key);
    }
    edit(&mut window, 12.5);
    save(&mut window);
    assert!(window.message().contains("mine.toml"));
    assert_eq!(window.files(), ["mine.toml"]);
    let record = window.record();
    assert_eq!(read(&path), record);
    let saved = fs::read_to_string(&path).expect("text");
    let comments = BUILT_IN[0].1.lines().filter(|line| line.starts_with('#'));
    for comment in comments.filter(|line| !line.starts_with("# near")) {
        assert!(saved.contains(comment), "{comment}");
    }
    window.app.desk.message = None;
    (0..5).for_each(|_| window.wait(PAUSE));
    assert_eq!((window.message(), window.record()), ("", record));
}

#[test]
fn a_new_file_has_the_scenes_name_with_a_number_and_replaces_none() {
    let mut window = Window::open();
    fs::write(window.folder.path().join("cuboid-2.toml"), "mine").expect("written");
    save(&mut window);
    assert_eq!(window.files(), ["cuboid-2.toml", "cuboid.toml"]);
    edit(&mut window, 3.0);
    save(&mut window);
    // It has a file now.
    assert_eq!(window.files(), ["cuboid-2.toml", "cuboid.toml"]);
    edit(&mut window, 4.0);
    window.press_with(CONTROL_SHIFT, Key::S);
    let files = window.files().join(" ");
    assert_eq!(files, "cuboid-2.toml cuboid-3.toml cuboid.toml");
    let folder = window.folder.path().to_path_buf();
    let file = |name: &str| folder.join(name);
    assert_eq!(read(&file("cuboid.toml")).light[0].intensity, 3.0);
    assert_eq!(read(&file("cuboid-3.toml")), window.record());
    assert_eq!(fs::read(file("cuboid-2.toml")).expect("read"), b"mine");
}

#[test]
fn the_title_has_a_star_while_edits_are_not_saved() {
    let (mut window, _) = on_file();
    let has_star = |window: &Window| window.app.document.title().contains('*');
    window.press(Key::W);
    assert!(!has_star(&window), "looking is no edit");
    window.wait(PAUSE);
    edit(&mut window, 3.0);
    assert!(has_star(&window) && window.app.document.title().contains("mine.toml"));
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
fn a_built_in_scene_is_chosen_from_a_list() {
    let (window, _) = on_file();
    let mut harness = widgets(window.app, [1000, 1000]);
    press(&mut harness, Key::E);
    choose(&mut harness, "other scenes");
    choose(&mut harness, "assignment");
    assert_eq!(harness.state().document.scene.name, "assignment");
}

#[test]
fn another_scene_has_nothing_of_the_one_before() {
    let (mut window, _) = on_file();
    window.press(Key::E);
    window.app.desk.selected = Some(("light", 2));
    window.app.desk.file_error = Some("of this file".to_owned());
    window.app.study.facts.trade.finish(None);
    let mut record = window.record();
    record.view.pixel = Some([0.0; 2]);
    let scene = Scene::spawn("other".to_owned(), &record);
    window.choose(scene);
    let App { desk, study, .. } = &window.app;
    assert!(desk.selected.is_none() && desk.is_open(Tab::Pixel));
    assert_eq!(desk.file_error, None);
    assert!(!study.facts.trade.is_current);
}

#[test]
fn a_changed_file_is_read_again_and_undo_restores_the_edits() {
    let (mut window, path) = on_file();
    window.press(Key::ArrowLeft);
    window.press(Key::O);
    edit(&mut window, 3.0);
    let edited = window.record();
    let (_, text) = BUILT_IN[0];
    let larger = text.replace("size = [4.0, 3.0, 2.0]", "size = [5.0, 3.25, 2.0]");
    fs::write(&path, larger).expect("written");
    save(&mut window);
    assert!(window.message().starts_with("not saved"), "it was not read");
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
    // An edit that no key or button has ended.
    let mut record = edited;
    record.light[0].intensity = 4.0;
    window.app.document.restore(&record);
    fs::write(&path, BUILT_IN[0].1).expect("written");
    (0..12).for_each(|_| window.step(Vec::new()));
    assert_eq!(window.record().light[0].intensity, 10.0);
    window.undo();
    assert_eq!(window.record().light[0].intensity, 4.0);
}

#[test]
fn a_changed_file_moves_the_camera_that_it_moves_and_keeps_its_new_text() {
    let (mut window, path) = on_file();
    window.press(Key::ArrowLeft);
    let moved = "orbit = { azimuth = 20.0, elevation = 0.0, zoom = 1.0 }\nfov = 30.0";
    let text = text_without_view().replacen("fov = 30.0", moved, 1);
    let start = |text: &str, count: usize| {
        let mut starts = text.match_indices("\n[[camera]]");
        starts.nth(count).expect("a camera").0
    };
    let third = text[start(&text, 1)..].replace("\"2\"", "\"3\"");
    let text = format!("# Another program's words.\n{text}\n{third}\n[view]\ncamera = \"3\"\n");
    fs::write(&path, &text).expect("written");
    window.wait(PAUSE);
    let record = window.record();
    assert_eq!(record.camera[0].orbit.azimuth, 20.0);
    assert_eq!(record.view.camera.as_deref(), Some("3"));
    assert!(!window.message().contains("Ctrl Z"), "there were no edits");
    // The camera that the user looks through is deleted.
    (0..2).for_each(|_| window.press(Key::C));
    edit(&mut window, 3.0);
    let without = [&text[..start(&text, 1)], &text[start(&text, 2)..]].concat();
    fs::write(&path, without).expect("written");
    window.wait(PAUSE);
    assert_eq!(window.record().view.camera.as_deref(), Some("3"));
    assert!(window.message().contains("Ctrl Z"));
    edit(&mut window, 4.0);
    save(&mut window);
    let saved = fs::read_to_string(&path).expect("text");
    assert!(saved.starts_with("# Another program's words."), "{saved}");
}

#[cfg(unix)]
fn make_pipe(path: &Path) -> bool {
    fs::remove_file(path).expect("removed");
    let made = std::process::Command::new("mkfifo").arg(path).status();
    made.expect("mkfifo is there").success()
}

#[test]
#[cfg(unix)]
fn a_file_that_holds_no_scene_is_reported_and_the_scene_stays() {
    type Change = fn(&Path);
    let deleted: Change = |path| fs::remove_file(path).expect("removed");
    let folder: Change = |path| {
        fs::remove_file(path).expect("removed");
        fs::create_dir(path).expect("made");
    };
    let changes: [(Change, &str); 4] = [
        (|path| write(path, "fov = -30.0"), "fov"),
        (deleted, "deleted"),
        (folder, "file"),
        (|path| assert!(make_pipe(path)), "file"),
    ];
    // A window that waits for the pipe would block the test.
    let (done, ends) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        for (change, word) in changes {
            let (mut window, path) = on_file();
            edit(&mut window, 3.0);
            let before = (window.record(), window.app.canvas.size());
            change(&path);
            (0..3).for_each(|_| window.wait(PAUSE));
            let error = window.app.desk.file_error.clone().expect("an error");
            let is_told = error.contains("mine.toml") && error.contains(word);
            assert!(is_told, "{error}");
            assert_eq!((window.record(), window.app.canvas.size()), before);
            // A wrong text is kept, and only a deleted file can be written.
            save(&mut window);
            let is_saved = word == "deleted";
            assert_eq!(window.app.document.is_edited(), !is_saved, "{word}");
            assert_eq!(window.message().starts_with("not saved"), !is_saved);
            assert_eq!(window.app.desk.file_error.is_none(), is_saved);
            if word == "fov" {
                write(&path, "fov = 31.25");
                window.wait(PAUSE);
                assert_eq!(window.app.desk.file_error, None);
                assert_eq!(window.record().camera[0].fov, 31.25);
            }
        }
        done.send(()).expect("it is waited for");
    });
    let patience = std::time::Duration::from_mins(1);
    ends.recv_timeout(patience).expect("the window goes on");
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

/// The picture that a window saves in a view, 0x00RRGGBB; the pixels on screen, their width, and the column of the divider.
fn saved_picture(view: Key) -> (Vec<u32>, Vec<u32>, [usize; 2]) {
    let mut window = Window::open();
    window.press(view);
    window.wait(PAUSE);
    window.press_with(Modifiers::SHIFT, Key::F12);
    let picture = image::open(window.folder.path().join("shadetrade-001.png"));
    let picture = picture.expect("a picture").to_rgb8();
    let width = window.app.canvas.size()[0];
    assert_eq!(picture.width() as usize, width);
    let pixels = picture.pixels().map(|it| it.0);
    let pixels = pixels.map(|[red, green, blue]| u32::from_be_bytes([0, red, green, blue]));
    let shown = window.app.shown().into_owned();
    let divider = window.app.canvas.divider_column(&window.app.viewer());
    (pixels.collect(), shown, [width, divider])
}

#[test]
fn a_saved_picture_is_the_picture_alone_and_an_error_map_has_its_scale_in_a_corner() {
    let (saved, shown, _) = saved_picture(Key::F6);
    assert!(saved == shown);
    let (saved, shown, [width, _]) = saved_picture(Key::F5);
    assert_eq!(saved.len(), shown.len());
    let changed = (0..saved.len()).filter(|at| saved[*at] != shown[*at]);
    let legend: Vec<usize> = changed.collect();
    // The cuboid and the other corners are free.
    let is_in_corner = |at: &usize| at % width < width / 2 && at / width < saved.len() / width / 2;
    assert!(legend.iter().all(is_in_corner));
    for error in [0.5, 16.0, 200.0] {
        let color = error_map::color_of(Pixel::Error(error));
        let has_color = |at: &usize| is_near(saved[*at], color);
        assert!(legend.iter().any(has_color), "{error}");
    }
}

/// Whether each channel of two pixels differs by at most two levels.
fn is_near(one: u32, other: u32) -> bool {
    let mut channels = one.to_be_bytes().into_iter().zip(other.to_be_bytes());
    channels.all(|(one, other)| one.abs_diff(other) <= 2)
}

#[test]
fn a_saved_wipe_has_its_line_and_the_names_of_its_sides() {
    let (saved, shown, [width, divider]) = saved_picture(Key::F3);
    assert_eq!(saved.len(), shown.len());
    let height = saved.len() / width;
    let changed = |row: usize, columns: Range<usize>| {
        let at = |column: &usize| row * width + column;
        let is_changed = |column: &usize| saved[at(column)] != shown[at(column)];
        columns.filter(is_changed).count()
    };
    let line = divider - 2..divider + 2;
    for row in 0..height {
        assert!(changed(row, line.clone()) >= 2, "row {row}");
    }
    for half in [0..line.start, line.end..width] {
        let rows: Vec<usize> = (0..height).map(|row| changed(row, half.clone())).collect();
        let (names, rest) = rows.split_at(40);
        assert!(names.iter().sum::<usize>() > 200 && rest.iter().all(|it| *it == 0));
    }
}

#[test]
fn q_asks_once_where_edits_are_not_saved() {
    let mut window = Window::open();
    window.press(Key::W);
    window.press(Key::Q);
    assert!(window.app.desk.quits, "a switched light is no edit");
    window.app.desk.quits = false;
    change(&mut window, 11.0);
    window.press(Key::Q);
    assert!(!window.app.desk.quits && window.message().contains("Ctrl S"));
    window.press(Key::Q);
    assert!(window.app.desk.quits);
}

#[test]
fn screenshots_are_the_pixels_that_are_shown() {
    let mut window = Window::open();
    let shown = window.app.pixels.clone();
    window.press(Key::F12);
    let picture = image::open(window.folder.path().join("shadetrade-001.png"));
    let picture = picture.expect("a picture").to_rgb8();
    let size = [picture.width(), picture.height()];
    assert_eq!(size, SIZE.map(|it| it as u32));
    for (saved, shown) in picture.pixels().zip(shown) {
        assert_eq!(saved.0, shown.to_be_bytes()[1..]);
    }
    assert!(window.message().contains("shadetrade-001.png"));
    window.app.document.folder.push("there is none");
    window.press(Key::F12);
    assert!(window.message().contains("no picture"));
}
