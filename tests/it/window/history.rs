//! Undo and redo: every state is restored bit for bit, within a limit of memory.

use std::sync::Arc;
use std::time::Duration;

use egui::Key::{self, ArrowLeft, C, CloseBracket, F4, Num2, O, P, Plus, W};
use egui::Modifiers;
use shadetrade::window::document::{State, history};

use super::{PAUSE, Window, default_record};
use crate::support::prelude::*;
use crate::support::window::default_scene;

const CHANGES: [Key; 9] = [W, Num2, P, O, CloseBracket, ArrowLeft, Plus, F4, C];

#[test]
fn changes_are_undone_and_redone_in_order() {
    // A second after each change, and at once.
    for pause in [PAUSE, Duration::ZERO] {
        // A small picture, because the error map is computed again at each step.
        let mut window = Window::of(default_scene(), [480, 160]);
        let state = |window: &Window| (window.record(), window.seen());
        let mut states = vec![state(&window)];
        for key in CHANGES {
            window.press(key);
            window.wait(pause);
            states.push(state(&window));
            assert_ne!(states[states.len() - 2].0, states[states.len() - 1].0);
        }
        for _ in 0..2 {
            for expected in states.iter().rev().skip(1) {
                window.undo();
                assert!(state(&window) == *expected);
            }
            window.undo();
            assert_eq!(window.message(), "nothing to undo");
            for expected in &states[1..] {
                window.press_with(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
                assert!(state(&window) == *expected);
            }
            window.redo();
            assert_eq!(window.message(), "nothing to redo");
        }
    }
}

#[test]
fn changes_of_one_gesture_are_one_step() {
    let mut window = Window::open();
    let at = window.app.canvas.place.center();
    let mut states = vec![window.record()];
    // A key that is held, two presses at once, the wheel without a pause, and a slow drag.
    window.key(Key::ArrowLeft, true);
    for _ in 0..5 {
        window.step(vec![window.repeated(Key::ArrowLeft)]);
    }
    window.key(Key::ArrowLeft, false);
    states.push(window.record());
    for _ in 0..2 {
        window.press(Key::ArrowLeft);
        states.push(window.record());
    }
    for _ in 0..2 {
        (0..3).for_each(|_| window.wheel(at, 1.0));
        states.push(window.record());
        window.wait(PAUSE);
    }
    // A key right after the wheel.
    window.wheel(at, 1.0);
    states.push(window.record());
    window.press(Key::ArrowLeft);
    states.push(window.record());
    window.drag(at, at + egui::vec2(90.0, 30.0), 200);
    states.push(window.record());
    for state in states.iter().rev().skip(1) {
        window.undo();
        assert_eq!(window.record(), *state);
    }
    window.undo();
    assert_eq!(window.message(), "nothing to undo");
}

#[test]
fn undo_does_not_change_rotation_and_pixel() {
    let mut window = Window::open();
    window.press(Key::W);
    window.wait(PAUSE);
    window.click(window.app.canvas.place.center());
    window.press(Key::Space);
    (0..20).for_each(|_| window.wait(PAUSE / 50));
    let before = window.record();
    assert!(before.view.turned > 0);
    window.undo();
    let after = window.record();
    assert!(after.light[0].on && !before.light[0].on);
    assert!(after.view.turned >= before.view.turned);
    assert!(after.view.pixel.is_some() && after.view.pixel == before.view.pixel);
    assert!(window.app.viewer().turns);
}

#[test]
fn an_undone_change_is_named() {
    type Change = fn(&mut SceneRecord);
    let off: Change = |it| it.light.iter_mut().for_each(|it| it.on = false);
    let several: Change = |it| (it.light[1].gain, it.background.x) = (2.0, 3.0);
    let sides: Change = |it| (it.view.tolerance, it.view.sides) = (1.0, Side::gouraud_phong(1.0));
    let changes: [(Change, &str); 8] = [
        (|it| it.light[1].intensity = 3.0, "light.red.intensity"),
        (off, "light.*.on"),
        (|it| drop(it.light.remove(0)), "light.white"),
        (|it| it.camera[0].name = "c".to_owned(), "camera.*"),
        (|it| it.cuboid[0].size *= 2.0, "cuboid.emerald.size.*"),
        (|it| it.background.x = 3.0, "background.r"),
        (several, "several changes"),
        (sides, "view.tolerance"),
    ];
    for (change, words) in changes {
        let mut window = Window::open();
        window.press(C);
        let mut record = window.record();
        change(&mut record);
        window.app.document.restore(&record);
        window.step(Vec::new());
        window.undo();
        assert_eq!(window.message(), format!("undo: {words}"));
    }
}

/// The number of steps that can be undone after this many edits of a scene.
fn steps_after(edits: u32, record: &SceneRecord) -> usize {
    let mut history = history(record);
    let mut present = State(Arc::new(record.clone()));
    for edit in 1..=edits {
        let mut next = record.clone();
        next.background.x = f64::from(edit % 250);
        present = State(Arc::new(next));
        history.add_undo(&present);
    }
    let mut steps = 0;
    while let Some(before) = history.undo(&present) {
        present = before.clone();
        steps += 1;
    }
    steps
}

#[test]
fn ten_thousand_edits_keep_no_more_states_than_the_memory_limit_allows() {
    let record = default_record();
    let steps = steps_after(10_000, &record);
    assert!((400..=500).contains(&steps), "{steps}");
    // 64 MiB in states of 512 bytes per entity.
    let mut large = record;
    let light = records::light("light", LightKind::Diffuse, 1.0, [0.0; 3]);
    large.light = vec![light; 10_000];
    let steps = steps_after(40, &large);
    assert!((8..=13).contains(&steps), "{steps}");
}
