//! Clicks whose press and release come in one step, as those of a touchpad or in a slow frame.

use egui::accesskit::Role;
use egui::{Event, Key, PointerButton, Pos2};
use egui_kittest::kittest::Queryable;
use shadetrade::scene::SceneRecord;
use shadetrade::window::inspector::Tab;

use super::{PAUSE, SIZE, Window, changed};
use crate::support::window::widgets;

/// The events of a press and a release at a place.
fn events(window: &Window, at: Pos2) -> Vec<Event> {
    let button = |pressed| Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed,
        modifiers: window.modifiers,
    };
    vec![Event::PointerMoved(at), button(true), button(false)]
}

/// Presses and releases the button in one step. The mouse arrives in it, too.
fn tap(window: &mut Window, at: Pos2) {
    window.step(events(window, at));
}

#[test]
fn a_click_within_one_step_does_what_a_slow_one_does() {
    // A small cuboid: some clicks open answers about all of its pixels.
    let scene = || changed(|record| record.camera[0].orbit.zoom = 8.0);
    let before = SceneRecord::of(&scene().world);
    let shown = |window: &mut Window| {
        window.reopen(scene());
        window.app.desk.tabs = vec![Tab::Time];
        window.step(Vec::new());
    };
    // What egui remembers, such as folded rows, changes in both.
    let [mut slow, mut quick] = [(); 2].map(|()| Window::open());
    shown(&mut slow);
    let mut places = slow.with_widgets(SIZE, |it| {
        let clicked = [Role::Button, Role::CheckBox, Role::RadioButton];
        let nodes = it.query_all_by(|node| clicked.contains(&node.role()));
        let places = nodes.map(|node| node.rect().center());
        places.collect::<Vec<Pos2>>()
    });
    places.push(slow.app.canvas.place.center());
    let after = |window: &mut Window, at, click: fn(&mut Window, Pos2)| {
        shown(window);
        click(window, at);
        window.wait(PAUSE);
        let tabs = window.app.desk.tabs.clone();
        (window.record(), window.files(), tabs)
    };
    let mut changes = 0;
    for at in places {
        let found = after(&mut slow, at, Window::click);
        changes += usize::from(found.0 != before);
        assert_eq!(found, after(&mut quick, at, tap), "{at}");
    }
    assert!(changes > 5, "{changes}");
}

/// A window that shows the numbers of the scene and its file.
fn editor() -> Window {
    let mut window = Window::open();
    window.press(Key::E);
    window.step(Vec::new());
    window
}

#[test]
fn a_text_is_selected_and_copied_in_steps_with_clicks() {
    let mut window = editor();
    let number = window.with_widgets(SIZE, |it| {
        let number = it.get_all_by_role(Role::SpinButton).next();
        number.expect("the width of the cuboid").rect().center()
    });
    // A number that is clicked is a text, all of which is selected.
    tap(&mut window, number);
    window.wait(PAUSE);
    let click = events(&window, Pos2::new(1.0, 1.0));
    window.step([vec![Event::Copy], click].concat());
    assert_eq!(window.output.copied.as_deref(), Some("4"));
}

#[test]
fn a_choice_of_a_list_is_clicked_within_a_step() {
    let mut harness = widgets(editor().app, SIZE);
    let list = harness.get_by_label("other scenes").rect().center();
    harness.hover_at(list);
    harness.drag_at(list);
    harness.drop_at(list);
    harness.run_ok();
    let choice = harness.get_by_label("bench-far").rect().center();
    for click in [Window::click, tap] {
        let mut window = editor();
        for at in [list, choice] {
            click(&mut window, at);
            window.wait(PAUSE);
        }
        assert_eq!(window.app.document.scene.name, "bench-far");
    }
}
