//! A lesson in the window: its sentences, and the way from step to step.

use std::path::Path;

use egui::Key;
use egui_kittest::kittest::Queryable;
use shadetrade::scene::Scene;

use super::{PAUSE, SIZE, Window};
use crate::support::window::widgets;

const LESSON: &str = r#"scene = "cuboid"
[[step]]
say = "White light."
set = { light.red.on = false }
[[step]]
say = "Red light."
set = { light.red.on = true, light.white.on = false, cuboid.emerald.size.x = 5 }
"#;

pub fn open() -> Window {
    let scene = Scene::parse_lesson("a lesson", LESSON, Path::new(""));
    Window::of(scene.expect("a lesson"), SIZE)
}

#[test]
fn keys_go_on_and_back_and_a_step_shows_the_scene_as_the_lesson_has_it() {
    let mut window = open();
    let steps = window.app.document.scene.lesson.clone();
    assert_eq!(window.record(), *steps[0].record);
    let size = window.app.canvas.size();
    window.press(Key::Enter);
    assert_eq!(window.record(), *steps[1].record);
    assert_eq!(window.app.canvas.size(), size);
    window.press(Key::Enter);
    assert_eq!(window.record(), *steps[1].record);
    assert!(window.message().contains("no such step"));
    window.press(Key::W);
    window.press(Key::Backspace);
    assert_eq!(
        window.record(),
        *steps[0].record,
        "the user's change is gone"
    );
    window.wait(PAUSE);
    window.undo();
    assert!(window.record().light[0].on, "and undo has it");
}

#[test]
fn the_sentence_of_the_step_is_shown() {
    let mut harness = widgets(open().app, SIZE);
    assert!(harness.query_by_label("White light.").is_some());
    harness.key_press(Key::Enter);
    harness.run_ok();
    assert!(harness.query_by_label("Red light.").is_some());
    assert!(harness.query_by_label("2 of 2").is_some());
}

#[test]
fn a_step_is_no_edit() {
    let mut window = open();
    window.press(Key::Enter);
    assert!(!window.app.document.is_edited());
    assert!(window.app.may_close(true).expect("it closes"));
    assert_eq!(window.files(), [""; 0]);
}
