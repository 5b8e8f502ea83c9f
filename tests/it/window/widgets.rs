//! Widgets by their labels: clicks and typed text change the components.

use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use fearless_simd::Level;
use glam::DVec3;
use shadetrade::components::{Light, Projection, Viewer, names};
use shadetrade::scene::SceneRecord;
use shadetrade::window::app::App;
use shadetrade::window::desk::Desk;
use shadetrade::window::inspector::Tab;
use shadetrade::window::keys::{Action, BINDINGS};

use super::{PAUSE, Window, choose, click_at, default_record, drag, press, widgets_of};
use crate::support::window::{app, default_scene, places, widgets};

/// A size in which every section and tab is visible.
const SIZE: [usize; 2] = [1400, 1400];

fn open() -> Harness<'static, App> {
    widgets_of(SIZE)
}

/// The record of the world. The document has noted it.
#[track_caller]
fn record(harness: &Harness<App>) -> SceneRecord {
    let document = &harness.state().document;
    let record = SceneRecord::of(&document.scene.world);
    assert_eq!(*document.state, record);
    record
}

/// Clicks the widget with this label.
#[track_caller]
fn click(harness: &mut Harness<App>, label: &str) {
    let found = places(harness, label);
    assert!(!found.is_empty(), "there is no {label:?}");
    click_at(harness, found[0]);
}

/// Clicks the last widget with this label in the panel.
#[track_caller]
fn click_inside(harness: &mut Harness<App>, label: &str) {
    let right = harness.state().canvas.place.min.x;
    let mut found = places(harness, label);
    found.retain(|at| at.x < right);
    let place = found.last().expect("a widget with this label");
    click_at(harness, *place);
}

/// Clicks a number to the right of a label and types another.
#[track_caller]
fn enter(harness: &mut Harness<App>, label: &str, column: usize, text: &str) {
    click_at(harness, number(harness, label, column));
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.event(egui::Event::Text(text.to_owned()));
    let before = record(harness);
    harness.run_ok();
    let is_applied = record(harness) != before;
    assert!(!is_applied || label == "tolerance", "{text} is not entered");
    press(harness, Key::Enter);
}

/// The position of a number to the right of the last text with this name.
#[track_caller]
pub fn number(harness: &Harness<App>, label: &str, column: usize) -> Pos2 {
    let rows = harness.query_all_by(|node| node.role() == Role::Label);
    let mut row = rows.filter(|node| node.accesskit_node().value().as_deref() == Some(label));
    let row = row.next_back().expect("a text with this name").rect();
    let numbers = harness.query_all_by(|node| node.role() == Role::SpinButton);
    let mut numbers: Vec<Pos2> = numbers.map(|node| node.rect().center()).collect();
    numbers.retain(|at| row.y_range().contains(at.y) && at.x > row.max.x);
    numbers.sort_by(|one, other| one.x.total_cmp(&other.x));
    numbers[column]
}

#[test]
fn every_button_does_what_its_key_does() {
    let mut harness = widgets_of([900, 1600]);
    let headings = [Tab::Time, Tab::Pictures, Tab::Camera, Tab::Scene];
    harness.state_mut().desk.tabs = headings.to_vec();
    harness.run_ok();
    let start = record(&harness);
    let mut count = 0;
    for (name, _, keys) in BINDINGS.iter().flat_map(|section| section.1) {
        let (modifiers, key, action) = keys[0];
        // They write files, act while they are held, or have rows in the editor, too.
        let others = [
            Action::Save,
            Action::SaveAs,
            Action::Blink,
            Action::Screenshot,
            Action::SavePicture,
        ];
        let is_other = others.contains(&action) || matches!(action, Action::LightNamed(_));
        if places(&harness, name).is_empty() || is_other {
            continue;
        }
        // The state after the click or the key; then everything is as before.
        let mut look = |clicks: bool| {
            if clicks {
                click(&mut harness, name);
            } else {
                harness.key_press_modifiers(modifiers, key);
                harness.run_ok();
            }
            let app = harness.state_mut();
            let state = (
                SceneRecord::of(&app.document.scene.world),
                app.viewer().turns,
                app.desk.help,
            );
            app.viewer_mut().turns = false;
            app.document.restore(&start);
            app.desk = Desk::default();
            app.desk.tabs = headings.to_vec();
            harness.run_ok();
            state
        };
        assert_eq!(look(true), look(false), "{name}");
        count += 1;
    }
    assert!(count > 12, "{count}");
    let hold = places(&harness, "blink (hold)")[0];
    harness.drag_at(hold);
    harness.run_ok();
    assert!(harness.state().desk.turn().is_some());
    harness.drop_at(hold);
    harness.run_ok();
    assert!(harness.state().desk.turn().is_none());
    // A key that presses the widget with the focus does nothing else.
    harness.get_by_label_contains("show all").focus();
    press(&mut harness, Key::Space);
    assert!(!harness.state().viewer().turns);
    press(&mut harness, Key::O);
    let projection = harness.state().viewer().projection;
    assert_eq!(projection, Projection::Orthographic, "O presses no widget");
}

#[test]
fn a_change_by_each_kind_of_widget_is_noted_and_undone() {
    type Change = fn(&mut Harness<'static, App>);
    let changes: [(&str, Change); 10] = [
        ("a check box", |it| click(it, "red")),
        ("a button", |it| click(it, "Phong")),
        ("a camera", |it| click(it, "next camera")),
        ("a number of the panel", |it| enter(it, "tolerance", 0, "2")),
        ("a number of the editor", |it| enter(it, "size", 1, "7.25")),
        ("a word of the editor", |it| click_inside(it, "face")),
        ("the background", |it| enter(it, "background", 1, "7")),
        ("a copy", |it| click(it, "copy")),
        ("a new light", |it| click(it, "new light")),
        ("a drag of the picture", |it| {
            let middle = it.state().canvas.place.center();
            drag(it, &[middle, middle + vec2(60.0, 30.0)]);
        }),
    ];
    let mut harness = open();
    harness.state_mut().desk.tabs = vec![Tab::Time, Tab::Camera, Tab::Scene];
    harness.run_ok();
    for (name, change) in changes {
        let before = record(&harness);
        harness.state_mut().document.keep(PAUSE, true);
        change(&mut harness);
        assert!(record(&harness) != before, "{name}");
        harness.state_mut().document.keep(PAUSE, true);
        harness.state_mut().document.travel(true);
        harness.run_ok();
        assert!(record(&harness) == before, "{name}");
    }
}

#[test]
fn the_tolerance_is_typed_and_dragged() {
    let mut harness = open();
    click(&mut harness, "Time and error");
    for (text, tolerance) in [("2", 2.0), ("0", 0.0), ("1000", 255.0)] {
        enter(&mut harness, "tolerance", 0, text);
        assert_eq!(harness.state().viewer().tolerance, tolerance);
    }
    for (right, end) in [(-9000.0, 0.0), (9000.0, 255.0)] {
        enter(&mut harness, "tolerance", 0, "2");
        let from = number(&harness, "tolerance", 0);
        drag(&mut harness, &[from, from + vec2(right / 900.0, 0.0)]);
        let levels = harness.state().viewer().tolerance;
        assert!(Viewer::may_have(levels) && levels != 2.0, "{levels}");
        let path = [0.1, 0.4, 1.0].map(|share| from + vec2(share * right, 0.0));
        drag(&mut harness, &[&[from], &path[..]].concat());
        assert_eq!(harness.state().viewer().tolerance, end);
    }
}

#[test]
fn entities_are_copied_renamed_and_deleted() {
    let mut harness = open();
    press(&mut harness, Key::E);
    let start = record(&harness);
    let counts = |harness: &Harness<App>| {
        let now = record(harness);
        now.check().expect("a legal scene");
        [now.cuboid.len(), now.light.len(), now.camera.len()]
    };
    for (index, kind) in ["cuboid", "light", "camera"].into_iter().enumerate() {
        let mut expected = counts(&harness);
        harness.state_mut().desk.selected = Some((kind, 0));
        harness.run_ok();
        for (label, change) in [("copy", 1), ("copy", 1), ("delete", -1)] {
            click(&mut harness, label);
            expected[index] = expected[index].saturating_add_signed(change);
            assert_eq!(counts(&harness), expected, "{kind}");
        }
        let now = record(&harness);
        let lights = &now.light;
        assert_ne!(lights[0].position, lights[lights.len() - 1].position);
        // The neighbour of the deleted one is selected.
        let copied = expected[index] - 1;
        assert_eq!(harness.state().desk.selected, Some((kind, copied)));
        click(&mut harness, "delete");
        // The camera stepped back to show the copies.
        let mut now = record(&harness);
        now.camera[0].orbit = start.camera[0].orbit;
        assert_eq!(now, start, "{kind}");
    }
    // The view forgets a deleted camera.
    harness.key_press(Key::C);
    harness.state_mut().desk.selected = Some(("camera", 1));
    harness.run_ok();
    assert_eq!(record(&harness).view.camera.as_deref(), Some("2"));
    click(&mut harness, "delete");
    assert_eq!(record(&harness).view, start.view);
    // A scene may have no light, and gets one.
    for lights in [3, 2, 1, 0, 1] {
        let is_fewer = lights < counts(&harness)[1];
        harness.state_mut().desk.selected = Some(("light", 0));
        click(&mut harness, ["new light", "delete"][usize::from(is_fewer)]);
        assert_eq!(counts(&harness)[1], lights);
    }
    harness.state_mut().document.restore(&start);
    // The last cuboid cannot be deleted.
    harness.state_mut().desk.selected = Some(("cuboid", 0));
    harness.run_ok();
    click(&mut harness, "delete");
    assert_eq!(record(&harness), start);
    // A duplicate name, or a name that a list of lights cannot hold, is refused.
    for (name, is_taken) in [("blue", true), ("red", false), ("", false), ("a,b", false)] {
        let before = names::<Light>(&harness.state().document.scene.world);
        harness.state_mut().desk.selected = Some(("light", 0));
        harness.run_ok();
        let field = harness.get_by_role(Role::TextInput).rect().center();
        click_at(&mut harness, field);
        harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
        harness.run_ok();
        match name {
            "" => harness.key_press(Key::Backspace),
            _ => harness.event(egui::Event::Text(name.to_owned())),
        }
        press(&mut harness, Key::Enter);
        let after = names::<Light>(&harness.state().document.scene.world);
        assert_eq!(after[0] == name, is_taken, "{name:?}: {after:?}");
        assert_eq!(after[1..], before[1..]);
    }
}

#[test]
fn a_number_s_tooltip_is_the_comment_of_its_own_key() {
    let mut harness = open();
    press(&mut harness, Key::E);
    for (kind, label, own) in [
        ("cuboid", "position", "centre"),
        ("light", "position", "shines from"),
        ("camera", "position", "the eye"),
        ("camera", "fov", "at most 179.0"),
    ] {
        harness.state_mut().desk.selected = Some((kind, 0));
        harness.run_ok();
        let rows = harness.query_all_by(|node| node.role() == Role::Label);
        let mut rows = rows.filter(|it| it.accesskit_node().value().as_deref() == Some(label));
        let at = rows.next_back().expect("a row").rect().center();
        drop(rows);
        harness.hover_at(at);
        harness.run_steps(8);
        let is_shown = harness.query_by_label_contains(own).is_some();
        assert!(is_shown, "{label} of {kind}");
    }
}

#[test]
pub fn numbers_are_typed_within_their_range() {
    let mut harness = open();
    press(&mut harness, Key::E);
    for (label, column, text, wanted) in [
        ("size", 1, "7.25", 7.25),
        ("size", 0, "-3", 4.0),
        ("position", 2, "-1.5e3", -1500.0),
        ("position", 1, "\u{2212}2", -2.0),
        ("size", 2, "nan", 2.0),
    ] {
        enter(&mut harness, label, column, text);
        let cuboid = &record(&harness).cuboid[0];
        let found = [cuboid.position, cuboid.size][usize::from(label == "size")];
        assert_eq!(found[column], wanted, "{label} {text}");
    }
    enter(&mut harness, "shininess", 0, "5");
    assert_eq!(record(&harness).cuboid[0].material.shininess, 5.0);
    let background = record(&harness).background;
    enter(&mut harness, "background", 0, "300");
    assert_eq!(record(&harness).background, background);
    let said = &harness.state().desk.message;
    assert!(said.as_ref().expect("why").0.starts_with("`background"));
    harness.get_by_value("cuboid emerald").click();
    harness.run_ok();
    choose(&mut harness, "light white");
    enter(&mut harness, "gain", 0, "40.5");
    assert_eq!(record(&harness).light[0].gain, 40.5);
    // A light that is not ambient any more is somewhere.
    harness.state_mut().desk.selected = Some(("light", 3));
    harness.run_ok();
    click_inside(&mut harness, "diffuse");
    assert_eq!(record(&harness).light[3].position, Some(DVec3::ZERO));
}

#[test]
fn a_number_that_only_gets_the_focus_keeps_every_digit() {
    let mut scene = default_scene();
    let mut start = default_record();
    start.cuboid[0].position.x = 0.123_456_789_012;
    start.light[0].intensity = 1_234.567_891;
    start.view.tolerance = 0.123_456_789;
    scene.world = start.spawn();
    let mut harness = widgets(app(scene, SIZE, Level::new()), SIZE);
    press(&mut harness, Key::E);
    start = record(&harness);
    let lights = harness.query_all_by(|node| node.role() == Role::SpinButton);
    let all: Vec<Pos2> = lights.map(|node| node.rect().center()).collect();
    // The focus leaves each number once before it is laid out and once after.
    for at in all.iter().rev().chain(&all) {
        click_at(&mut harness, *at);
    }
    assert_eq!(record(&harness), start);
}

#[test]
fn nothing_of_a_closed_dialog_stays_on_screen() {
    for size in [[320, 240], [480, 360], [960, 720]] {
        let mut app = app(default_scene(), size, Level::new());
        // With the chart the panel is wider than a small window leaves it.
        app.desk.shows_times = true;
        let mut window = Window::with(app, size);
        window.wait(PAUSE);
        let before = window.app.pixels.clone();
        window.press(Key::H);
        window.wait(PAUSE);
        assert!(window.app.pixels != before, "{size:?}: the help is shown");
        window.press(Key::H);
        window.wait(PAUSE);
        // The status line has a time.
        let above = ..size[0] * (size[1] - 40);
        assert!(before[above] == window.app.pixels[above], "{size:?}");
    }
}
