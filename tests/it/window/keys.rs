//! Every key binding, by its action.

use std::collections::HashSet;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use shadetrade::components::{
    NormalMode, Orbit, Projection, Segments, ShadingMode, Side, ViewMode,
};
use shadetrade::scene::SceneRecord;
use shadetrade::window::comparison::{Comparison, Worst};
use shadetrade::window::inspector::Tab;
use shadetrade::window::keys::{self, Action};

use super::trade::app_with_trade;
use super::{PAUSE, SIZE, Window, press};
use crate::support::window::{default_scene, widgets};

/// The smallest size that opens with the panel.
const SMALL: [usize; 2] = [430, 100];

/// Brings the window into a state in which the action has an effect.
fn prepare(window: &mut Window, action: Action) {
    match action {
        Action::Shading(ShadingMode::Gouraud) | Action::Undo => window.press(Key::P),
        Action::View(ViewMode::Picture) => window.press(Key::F5),
        Action::ShowAll => [Key::ArrowLeft, Key::Minus]
            .map(|key| window.press(key))
            .into_iter()
            .collect(),
        Action::Redo => {
            window.press(Key::P);
            window.undo();
        }
        Action::Close => window.press(Key::H),
        Action::Segments(_) => window.press(Key::Period),
        // The first of them probes the middle.
        Action::Probe(..) => window.press_with(Modifiers::SHIFT, Key::ArrowUp),
        _ => {}
    }
    window.wait(PAUSE);
}

/// The expected record after the action, according to its description and the scene format.
fn expected(action: Action, before: &SceneRecord, size: [usize; 2]) -> SceneRecord {
    let mut record = before.clone();
    let view = &mut record.view;
    let lights = ["white", "red", "specular", "ambient"];
    let mut switch = |index: usize| {
        if let Some(light) = record.light.get_mut(index) {
            light.on ^= true;
        }
    };
    match action {
        Action::Light(index) => switch(index),
        Action::LightNamed(name) => {
            switch(lights.iter().position(|own| *own == name).expect("a light"));
        }
        Action::Shading(mode) => record.cuboid[0].shading = mode,
        Action::FaceNormals => record.cuboid[0].normals = NormalMode::Face,
        Action::Undo => record.cuboid[0].shading = ShadingMode::Gouraud,
        Action::Redo => record.cuboid[0].shading = ShadingMode::Phong,
        Action::Tolerance(way) => {
            view.tolerance = if way > 0 { 1.0 } else { 0.25 };
            view.sides = Side::gouraud_phong(view.tolerance);
        }
        Action::Segments(steps) => {
            record.cuboid[0].segments =
                Segments::new(if steps > 0 { 4 } else { 1 }).expect("it is legal");
        }
        Action::HoldTime => view.budget = Some(1.0),
        Action::NextProjection => view.projection = Projection::Orthographic,
        Action::NextCamera => view.camera = Some("2".to_owned()),
        Action::View(mode) => view.show = mode,
        Action::WipeExact => {
            view.show = ViewMode::Wipe;
            view.sides = [Side::Picture, Side::Reference];
        }
        Action::Probe(right, down) => {
            let rows = size[1] as f64;
            let [x, y] = view.pixel_in(size, rows).expect("the middle");
            let moved = |at: usize, by: i32| at.saturating_add_signed(by as isize);
            view.set_pixel([moved(x, right), moved(y, down)], size, rows);
        }
        Action::Orbit(right, up) => {
            record.camera[0].orbit.azimuth = right;
            record.camera[0].orbit.elevation = up;
        }
        Action::Zoom(steps) => record.camera[0].orbit.zoom = 1.1_f64.powi(-steps),
        Action::ShowAll => record.camera[0].orbit = Orbit::default(),
        _ => {}
    }
    record
}

#[test]
fn every_key_does_what_its_description_says() {
    let mut window = Window::of(default_scene(), SMALL);
    for (modifiers, key, action) in keys::keys() {
        let action = *action;
        window.reopen(default_scene());
        prepare(&mut window, action);
        let before = window.record();
        window.modifiers = *modifiers;
        window.key(*key, true);
        let blinks = window.app.desk.turn().is_some();
        window.key(*key, false);
        let mut expected = expected(action, &before, window.app.canvas.size());
        if action == Action::Worst {
            let worst = window.comparison().worst.expect("Gouraud errs");
            assert_eq!(window.app.pixel(), Some(worst.pixel));
            expected.view.pixel = window.record().view.pixel;
        }
        assert_eq!(window.record(), expected, "{key:?}");
        let desk = &window.app.desk;
        for (is_on, own) in [
            (blinks, Action::Blink),
            (desk.help, Action::Help),
            (desk.panel_folded, Action::Panel),
            (desk.is_open(Tab::Scene), Action::Tab(Tab::Scene)),
            (desk.is_open(Tab::Required), Action::Tab(Tab::Required)),
            (desk.is_open(Tab::Proof), Action::Tab(Tab::Proof)),
            (window.app.viewer().turns, Action::Rotate),
            (window.app.desk.quits, Action::Quit),
        ] {
            assert_eq!(is_on, action == own, "{key:?}");
        }
        assert_eq!(window.app.desk.turn(), None, "{key:?}");
        let saved = match action {
            Action::Save | Action::SaveAs => vec!["cuboid.toml"],
            Action::Screenshot | Action::SavePicture => vec!["shadetrade-001.png"],
            _ => Vec::new(),
        };
        assert_eq!(window.files(), saved, "{key:?}");
        // The change was noted, whichever it was.
        assert_eq!(*window.app.document.state, window.record(), "{key:?}");
        // Undo leaves the explained pixel where it is.
        let is_travel = matches!(
            action,
            Action::Undo | Action::Redo | Action::Probe(..) | Action::Worst
        );
        if window.record() != before && !is_travel {
            window.modifiers = Modifiers::NONE;
            window.undo();
            assert_eq!(window.record(), before, "{key:?}");
        }
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
        (Key::ArrowUp, 60),
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
    let name = "wrsagpfmco=-bzxehniq1 23?[]";
    let editor = || {
        let mut window = Window::open();
        window.press(Key::E);
        window.step(Vec::new());
        window
    };
    let harness = widgets(editor().app, SIZE);
    let mut window = editor();
    let fields = harness.get_all_by_role(Role::TextInput);
    let field = fields.last().expect("in the inspector").rect().center();
    window.click(field);
    window.press_with(Modifiers::COMMAND, Key::A);
    let before = window.record();
    window.enter(name);
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
    assert_eq!(window.record().cuboid[0].name, name);
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
    let harness = widgets(window.app, SIZE);
    let numbers = harness.get_all_by_role(Role::SpinButton);
    let numbers = numbers.map(|node| node.rect().center());
    let place = harness.state().canvas.place;
    let width = numbers.into_iter().find(|at| at.x < place.min.x);
    let width = width.expect("the size comes first");
    let mut window = Window::open();
    window.press(Key::E);
    window.step(Vec::new());
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
    // In a low and narrow window headings open over the picture.
    for (size, count) in [(SIZE, 5), ([500, 400], 5)] {
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
            assert!(window.app.desk.is_open(Tab::Pixel), "{width}");
            window.press(Key::Escape);
            window.press(Key::Escape);
        }
        window.press(Key::E);
        window.step(Vec::new());
        assert_eq!(window.app.canvas.size(), size, "{width}");
    }
}
