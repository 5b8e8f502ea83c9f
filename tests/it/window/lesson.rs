//! A lesson in the window: its sentences, its question, its controls, and the way from step to step.

use std::path::Path;

use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use shadetrade::scene::{BUILT_IN, LESSONS, Scene, title};
use shadetrade::window::app::App;

use super::{PAUSE, SIZE, Window, choose, press};
use crate::support::window::widgets;

const LESSON: &str = r#"scene = "cuboid"
[[step]]
say = "White light."
set = { light.red.on = false }
show = ["segments", "on"]
[[step]]
say = "Red light."
set = { light.red.on = true, light.white.on = false, cuboid.emerald.size.x = 5 }
ask = ["light", "dark", "neither"]
right = 2
then = "It is dark."
"#;

fn lesson(text: &str) -> Scene {
    Scene::parse_lesson("a lesson", text, Path::new("")).expect("a lesson")
}

pub fn open() -> Window {
    Window::of(lesson(LESSON), SIZE)
}

/// Whether a widget of the window has these words.
fn shows(harness: &Harness<App>, words: &str) -> bool {
    harness.query_all_by_label_contains(words).next().is_some()
}

#[test]
fn keys_go_on_and_back_and_a_step_shows_the_scene_as_the_lesson_has_it() {
    let mut window = open();
    let steps = window.app.document.scene.lesson.clone();
    assert_eq!(window.record(), *steps[0].record);
    window.press(Key::Enter);
    assert_eq!(window.record(), *steps[1].record);
    window.press(Key::Enter);
    assert_eq!(window.record(), *steps[1].record);
    assert!(window.message().contains("last step"));
    window.press(Key::W);
    window.press(Key::Backspace);
    let is_gone = window.record() == *steps[0].record;
    assert!(is_gone, "the user's change");
    window.wait(PAUSE);
    window.undo();
    assert!(window.record().light[0].on, "and undo has it");
}

#[test]
fn without_a_lesson_there_is_no_step_to_go_to() {
    for key in [Key::Enter, Key::Backspace] {
        let mut window = Window::open();
        window.press(key);
        assert!(window.message().contains("no lesson"), "{key:?}");
    }
}

#[test]
fn the_picture_keeps_its_size_from_step_to_step() {
    let long = "so ".repeat(60);
    let text = LESSON.replace("Red light.", &long).replace("ask", "# ");
    let text = text.replace("right", "# ").replace("then", "# ");
    let mut window = Window::of(lesson(&text), SIZE);
    let size = window.app.canvas.size();
    window.press(Key::Enter);
    assert_eq!(window.app.canvas.size(), size);
}

#[test]
fn a_lesson_is_alone_until_a_key_brings_the_rest() {
    let mut harness = widgets(open().app, SIZE);
    let rest = ["help", "Why?"];
    assert!(shows(&harness, "White light.") && shows(&harness, "1 of 2"));
    assert!(rest.iter().all(|it| !shows(&harness, it)));
    press(&mut harness, Key::I);
    assert!(shows(&harness, "White light."));
    assert!(rest.iter().all(|it| shows(&harness, it)));
    press(&mut harness, Key::I);
    assert!(rest.iter().all(|it| !shows(&harness, it)));
    // A heading brings it, too.
    press(&mut harness, Key::E);
    assert!(rest.iter().all(|it| shows(&harness, it)));
}

#[test]
fn a_step_shows_its_controls_and_they_act() {
    let mut harness = widgets(open().app, SIZE);
    harness.get_by_label_contains("more").click();
    harness.run_ok();
    let cuboids = &harness.state().document.state.cuboid;
    assert_eq!(cuboids[0].segments.count(), 2);
    assert!(shows(&harness, "2 segments"));
    choose(&mut harness, "white diffuse");
    assert!(!harness.state().document.state.light[0].on);
    press(&mut harness, Key::Enter);
    assert!(!shows(&harness, "2 segments") && !shows(&harness, "more"));
}

#[test]
fn the_answer_is_told_once_one_is_chosen() {
    let mut harness = widgets(open().app, SIZE);
    assert!(!shows(&harness, "dark"));
    press(&mut harness, Key::Enter);
    let size = harness.state().canvas.size();
    for wrong_or_right in ["light", "dark"] {
        assert!(!shows(&harness, "It is dark."));
        choose(&mut harness, wrong_or_right);
        assert!(shows(&harness, "It is dark."));
        assert_eq!(harness.state().canvas.size(), size, "the picture stays");
        press(&mut harness, Key::Backspace);
        press(&mut harness, Key::Enter);
    }
}

#[test]
fn the_last_step_leads_to_the_next_lesson_and_escape_leaves() {
    let scene = Scene::load(Some(LESSONS[0].0)).expect("a lesson");
    let count = scene.lesson.len();
    let mut harness = widgets(Window::of(scene, SIZE).app, SIZE);
    let next = format!("Next lesson: {}", title(LESSONS[1].0));
    for _ in 1..count {
        assert!(!shows(&harness, &next));
        press(&mut harness, Key::Enter);
    }
    assert!(shows(&harness, &next));
    press(&mut harness, Key::Enter);
    assert_eq!(harness.state().document.scene.name, LESSONS[1].0);
    assert!(shows(&harness, "1 of "));
    press(&mut harness, Key::Escape);
    assert_eq!(harness.state().document.scene.name, BUILT_IN[0].0);
    assert!(shows(&harness, "Why?"));
}

#[test]
fn a_lesson_is_left_for_the_scene_before_it_as_it_was() {
    let scene = Scene::load(Some("bench-far")).expect("a scene");
    let mut window = Window::of(scene, SIZE);
    window.press(Key::Period);
    window.press(Key::W);
    let before = window.app.document.state.clone();
    for (name, _) in &LESSONS[..2] {
        window.app.open(name);
    }
    window.press(Key::Escape);
    assert_eq!(window.app.document.scene.name, "bench-far");
    assert_eq!(window.app.document.state, before);
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_ne!(window.app.document.state, before, "the history, too");
}

#[test]
fn a_step_is_no_edit() {
    let mut window = open();
    window.press(Key::Enter);
    assert!(!window.app.document.is_edited());
    assert!(window.app.may_close(true).expect("it closes"));
    assert_eq!(window.files(), [""; 0]);
}
