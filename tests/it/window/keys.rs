//! Every key binding, by its action.

use std::collections::HashSet;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use shadetrade::scene::key::{assignment, set};
use shadetrade::window::facts::{Comparison, Worst};
use shadetrade::window::inspector::Tab;
use shadetrade::window::keys::{self, Action, EXACT_SIDES};

use super::trade::app_with_trade;
use super::{PAUSE, SIZE, Window, press};
use crate::support::prelude::*;
use crate::support::window::{default_scene, widgets};

/// The smallest size that opens with the panel.
const SMALL: [usize; 2] = [430, 100];

/// A key, and the assignment that has its effect on the scene.
const CHANGES: &str = r#"
W          light.white.on=false
R          light.red.on=false
S          light.specular.on=false
A          light.ambient.on=false
2          light.red.on=false
4          light.ambient.on=false
F          cuboid.emerald.shading=flat
P          cuboid.emerald.shading=phong
X          cuboid.emerald.normals=face
.          cuboid.emerald.segments=2
]          view.tolerance=1
PageUp     view.tolerance=1
[          view.tolerance=0.25
PageDown   view.tolerance=0.25
M          view.budget=1
C          view.camera="2"
O          view.projection=orthographic
ArrowLeft  camera.1.orbit.azimuth=-2
ArrowRight camera.1.orbit.azimuth=2
ArrowUp    camera.1.orbit.elevation=2
ArrowDown  camera.1.orbit.elevation=-2
+          camera.1.orbit.zoom=0.9090909090909091
=          camera.1.orbit.zoom=0.9090909090909091
-          camera.1.orbit.zoom=1.1
F3         view.show=wipe
F4         view.show=wipe
F5         view.show=error
F6         view.show=tiles
F7         view.show=terms"#;

#[test]
fn a_key_that_changes_the_scene_is_noted_and_undone() {
    let mut window = Window::of(default_scene(), SMALL);
    for row in CHANGES.lines().skip(1) {
        let (key, change) = row.split_once(' ').expect("a change");
        window.reopen(default_scene());
        let before = window.record();
        window.press(Key::from_name(key).expect(key));
        let after = window.record();
        let change = assignment(change.trim()).expect("an assignment");
        let mut expected = set(&before, &[change]).expect("a legal scene");
        // Those that followed the tolerance, and those of F4.
        expected.view.sides = match key {
            "F4" => EXACT_SIDES,
            _ => Side::gouraud_phong(expected.view.tolerance),
        };
        assert_eq!(after, expected, "{row}");
        assert_eq!(*window.app.document.state, after, "{row}");
        window.undo();
        assert_eq!(window.record(), before, "{row}");
    }
}

#[test]
fn a_key_of_the_window_does_its_own_and_nothing_else() {
    let mut window = Window::of(default_scene(), SMALL);
    for (modifiers, key, action) in keys::keys() {
        let action = *action;
        window.reopen(default_scene());
        if action == Action::Close {
            window.press(Key::H);
        }
        window.modifiers = *modifiers;
        window.key(*key, true);
        let blinks = window.app.desk.turn().is_some();
        window.key(*key, false);
        let desk = &window.app.desk;
        for (is_on, own) in [
            (blinks, Action::Blink),
            (desk.help, Action::Help),
            (desk.panel_folded, Action::Panel),
            (desk.is_open(Tab::Scene), Action::Tab(Tab::Scene)),
            (desk.is_open(Tab::Required), Action::Tab(Tab::Required)),
            (desk.is_open(Tab::Proof), Action::Tab(Tab::Proof)),
            (window.app.viewer().turns, Action::Rotate),
            (desk.quits, Action::Quit),
        ] {
            assert_eq!(is_on, action == own, "{key:?}");
        }
        assert_eq!(desk.turn(), None, "{key:?}");
        let saved = match action {
            Action::Save | Action::SaveAs => "cuboid.toml",
            Action::Screenshot | Action::SavePicture => "shadetrade-001.png",
            _ => "",
        };
        assert_eq!(window.files().join(" "), saved, "{key:?}");
    }
}

#[test]
fn a_held_key_goes_on_where_it_moves_something() {
    const NO: Modifiers = Modifiers::NONE;
    let mut window = Window::of(default_scene(), SMALL);
    for (modifiers, key, goes_on) in [
        (NO, Key::ArrowLeft, true),
        (NO, Key::Minus, true),
        (Modifiers::SHIFT, Key::ArrowRight, true),
        (Modifiers::COMMAND, Key::Z, true),
        (NO, Key::CloseBracket, false),
        (NO, Key::W, false),
    ] {
        for key in [Key::P, Key::O, Key::P] {
            window.press(key);
            window.wait(PAUSE);
        }
        window.modifiers = modifiers;
        window.key(key, true);
        let before = window.record();
        window.step(vec![window.repeated(key)]);
        assert_eq!(window.record() != before, goes_on, "{key:?}");
        window.key(key, false);
        window.modifiers = NO;
    }
}

#[test]
fn the_first_probed_pixel_is_in_the_middle() {
    let mut window = Window::open();
    window.press_with(Modifiers::SHIFT, Key::ArrowUp);
    let middle = window.app.canvas.size().map(|side| side / 2);
    assert_eq!(window.app.pixel(), Some(middle));
}

#[test]
fn a_key_without_effect_shows_a_message() {
    let mut window = Window::open();
    for (key, times) in [
        (Key::Num9, 1),
        (Key::OpenBracket, 9),
        (Key::Escape, 3),
        (Key::Y, 0),
    ] {
        (0..times).for_each(|_| window.press(key));
        let before = window.record();
        window.app.desk.message = None;
        window.press(key);
        assert_eq!(window.record(), before, "{key:?}");
        assert!(!window.message().is_empty(), "{key:?}");
    }
}

#[test]
fn keys_type_into_a_focused_field_and_do_nothing_else() {
    let text = "wrsagpfmco=-bzxehniq1 23?[]";
    let mut window = Window::open();
    window.press(Key::E);
    // A number that is clicked is a text field.
    let field = window.with_widgets(SIZE, |it| {
        let field = it.get_all_by_role(Role::SpinButton).next();
        field.expect("the width of the cuboid").rect().center()
    });
    window.click(field);
    window.press_with(Modifiers::COMMAND, Key::A);
    let before = window.record();
    window.enter(text);
    for key in [Key::Home, Key::PageUp, Key::Space] {
        window.press(key);
    }
    assert_eq!(window.record(), before);
    let desk = &window.app.desk;
    assert!(!desk.help && !desk.panel_folded && desk.blinks.is_none() && !window.app.desk.quits);
    // Keys that a text field ignores.
    window.press(Key::F6);
    assert_eq!(window.record().view.show, ViewMode::Tiles);
    window.press_with(Modifiers::COMMAND, Key::S);
    assert_eq!(window.files(), ["cuboid.toml"], "{}", window.message());
    window.press(Key::Enter);
    assert_eq!(window.record().cuboid, before.cuboid, "it is no number");
    window.press(Key::P);
    assert_eq!(window.record().cuboid[0].shading, ShadingMode::Phong);
    // Escape leaves the field alone.
    window.click(field);
    window.press(Key::Escape);
    assert!(window.app.desk.is_open(Tab::Scene));
}

#[test]
fn tab_goes_from_number_to_number_and_a_digit_after_it_is_no_key() {
    let mut window = Window::open();
    window.press(Key::E);
    let right = window.app.canvas.place.min.x;
    let width = window.with_widgets(SIZE, |it| {
        let numbers = it.get_all_by_role(Role::SpinButton);
        let mut places = numbers.map(|node| node.rect().center());
        places
            .find(|at| at.x < right)
            .expect("the size comes first")
    });
    let lights = window.record().light;
    window.click(width);
    let type_digit = |window: &mut Window, key, text: &str| {
        let press = window.key_event(key, true);
        window.step(vec![press, Event::Text(text.to_owned())]);
        window.key(key, false);
    };
    type_digit(&mut window, Key::Num6, "6");
    window.press(Key::Tab);
    type_digit(&mut window, Key::Num4, "4");
    window.press(Key::Enter);
    let size = window.record().cuboid[0].size;
    assert_eq!([size.x, size.y], [6.0, 4.0]);
    assert_eq!(window.record().light, lights);
    // Without a field the key acts again.
    window.press(Key::Num4);
    assert_ne!(window.record().light, lights);
}

#[test]
fn tab_goes_through_the_widgets_and_scrolls_to_each() {
    let size = [800, 400];
    let mut app = app_with_trade(size);
    app.study.facts.comparison.finish(Some(Comparison {
        worst: Some(Worst {
            error: 165.0,
            pixel: [0; 2],
        }),
        ..Comparison::default()
    }));
    let mut harness = widgets(app, size);
    let mut seen = HashSet::new();
    for _ in 0..25 {
        press(&mut harness, Key::Tab);
        let id = harness.ctx.memory(egui::Memory::focused);
        let widget = id.and_then(|id| harness.ctx.read_response(id));
        let widget = widget.expect("a widget has the focus");
        let rows = widget.rect.y_range();
        assert!(rows.min > 0.0 && rows.max < size[1] as f32, "{rows:?}");
        seen.insert(widget.id);
    }
    assert!(seen.len() > 22, "{}", seen.len());
}

#[test]
fn escape_closes_one_visible_thing_at_a_time() {
    // In a low and narrow window the panel is folded.
    for (size, count) in [(SIZE, 5), ([500, 400], 4)] {
        let mut window = Window::of(default_scene(), size);
        window.click(window.app.canvas.place.center());
        window.press(Key::H);
        window.app.desk.file_error = Some("wrong".to_owned());
        // The last press closes nothing and names the key that quits.
        for _ in 0..count {
            window.point_at(Pos2::ZERO);
            let before = window.app.pixels.clone();
            window.press(Key::Escape);
            assert!(window.app.pixels != before, "{size:?}");
        }
        assert_eq!(window.message(), "Q quits", "{size:?}");
    }
}

#[test]
fn the_picture_keeps_its_size_when_a_heading_opens() {
    for width in [330, 500, 960, 1199, 1200, 1900] {
        let mut window = Window::of(default_scene(), [width, 400]);
        let (size, place) = (window.app.canvas.size(), window.app.canvas.place);
        assert_eq!(window.app.desk.panel_folded, width < 560);
        assert!(size[0] > 100, "{width}");
        for at in [vec2(0.2, 0.8), vec2(0.8, 0.2)] {
            window.click(place.min + place.size() * at);
            window.step(Vec::new());
            assert_eq!(window.app.canvas.size(), size, "{width}");
            assert_eq!(window.app.desk.is_open(Tab::Pixel), width >= 560);
            window.press(Key::Escape);
            window.press(Key::Escape);
        }
        window.press(Key::E);
        window.step(Vec::new());
        assert!(window.app.desk.is_open(Tab::Scene), "{width}");
        assert_eq!(window.app.canvas.size() == size, width >= 560, "{width}");
    }
}
