//! The first screen: its question, what can be clicked, its words, and that all of it fits.

use egui::accesskit::Role;
use egui::{Key, Rect, Shape, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use shadetrade::window::app::App;
use shadetrade::window::inspector::{HEADINGS, Tab};

use super::trade::{trade, with_trade};
use super::{PAUSE, Window, press};
use crate::support::prelude::*;
use crate::support::window::{app, first_scene, places, widgets};

/// The roles of widgets that are clicked.
const CLICKED: [Role; 9] = [
    Role::Button,
    Role::CheckBox,
    Role::ColorWell,
    Role::ComboBox,
    Role::Link,
    Role::RadioButton,
    Role::Slider,
    Role::SpinButton,
    Role::TextInput,
];

const SIZE: [usize; 2] = [1366, 768];

fn open(size: [usize; 2]) -> Harness<'static, App> {
    let app = app(first_scene(), size, Level::new());
    widgets(with_trade(app), size)
}

/// The words of a text. A letter alone and one with a digit is the key of something.
fn words(text: &str) -> usize {
    let words = text.split(|letter: char| !letter.is_alphanumeric());
    words
        .filter(|word| word.len() > 1 && word.chars().all(char::is_alphabetic))
        .count()
}

/// Adds the texts that a shape paints.
fn painted(shape: &Shape, texts: &mut Vec<String>) {
    match shape {
        Shape::Text(text) => texts.push(text.galley.text().to_owned()),
        Shape::Vec(shapes) => shapes.iter().for_each(|it| painted(it, texts)),
        _ => {}
    }
}

#[test]
fn the_first_screen_has_few_things_to_click_and_few_words() {
    let mut window = Window::with(with_trade(app(first_scene(), SIZE, Level::new())), SIZE);
    window.app.desk.open(Tab::Proof);
    for _ in 0..3 {
        window.wait(PAUSE);
    }
    window.app.desk.tabs.clear();
    let harness = widgets(window.app, SIZE);
    let clicked = harness.query_all_by(|node| CLICKED.contains(&node.role()));
    assert!(clicked.count() <= 24, "things to click");
    let mut texts = Vec::new();
    for clipped in &harness.output().shapes {
        painted(&clipped.shape, &mut texts);
    }
    for text in ["proven", "bright spot", "lamps", "highlight kept"] {
        assert!(texts.iter().any(|it| it.contains(text)), "{text}");
    }
    let count: usize = texts.iter().map(|text| words(text)).sum();
    assert!((40..=70).contains(&count), "{count}: {texts:?}");
}

#[test]
fn everything_in_sight_fits() {
    for size in [[1366, 768], [1280, 800], [960, 720], [800, 600]] {
        let harness = open(size);
        let window = Rect::from_min_size([0.0; 2].into(), vec2(size[0] as f32, size[1] as f32));
        for node in harness.query_all_by(|node| CLICKED.contains(&node.role())) {
            let place = node.rect();
            assert!(window.contains_rect(place), "{size:?}: {node:?}");
        }
        let count = harness
            .query_all_by(|node| CLICKED.contains(&node.role()))
            .count();
        assert!(count > 20, "{size:?}: {count}");
        let is_row = size[1] < 650;
        for (_, name, keys, _) in HEADINGS {
            let first = keys.split(' ').next().filter(|it| is_row && !it.is_empty());
            let own = first.unwrap_or(name);
            assert!(!places(&harness, own).is_empty(), "{size:?}: {name}");
        }
    }
}

/// The columns of the highlight in the picture of a window.
fn highlight(window: &Window) -> [usize; 2] {
    let view = window.app.view().shaded(ShadingMode::Phong);
    let mut world = window.app.document.state.spawn();
    let frame = draw(&mut world, &view, Keep::Levels);
    let pixels = frame.levels().iter().zip(frame.triangles()).enumerate();
    // Elsewhere blue is below half of this.
    let is_bright = |it: &(usize, (&[f32; 3], &TriangleId))| {
        let (_, (levels, triangle)) = *it;
        *triangle != TriangleId::NONE && levels[2] > 120.0
    };
    let columns = pixels.filter(is_bright).map(|it| it.0 % view.size[0]);
    let least_and_most = columns.fold([usize::MAX, 0], |[least, most], column| {
        [least.min(column), most.max(column)]
    });
    assert!(least_and_most[0] < least_and_most[1], "a highlight");
    least_and_most
}

#[test]
fn the_line_goes_through_the_highlight_in_windows_of_all_sizes() {
    for size in [
        [1920, 1080],
        [1366, 768],
        [1280, 800],
        [1280, 720],
        [960, 720],
        [800, 600],
        [400, 740],
        [390, 844],
    ] {
        let window = Window::of(first_scene(), size);
        let column = window.app.canvas.divider_column(&window.app.viewer());
        let [first, last] = highlight(&window);
        // A good part of it is seen on the right, and is missing on the left.
        let part = (last - first) / 8;
        let middle = first + part..=last - part;
        assert!(middle.contains(&column), "{size:?}: {column}, {middle:?}");
    }
}

#[test]
fn the_question_asks_for_the_highlight_where_there_is_one() {
    let mut window = Window::of(first_scene(), [1240, 960]);
    assert_eq!(window.record().view.show, ViewMode::Wipe);
    assert_eq!(window.record().view.sides, Side::gouraud_phong(0.5));
    let has_question = |window: &mut Window| {
        window.with_widgets([1240, 960], |it| {
            it.query_by_label_contains("bright spot").is_some()
        })
    };
    assert!(has_question(&mut window));
    // Without a highlight on either side there is nothing to ask for.
    for key in [Key::X, Key::S, Key::G, Key::F5] {
        window.press(key);
        assert!(!has_question(&mut window), "{key:?}");
        window.press(Key::F3);
        if [Key::X, Key::S].contains(&key) {
            window.press(key);
        }
        assert!(has_question(&mut window), "{key:?}");
    }
    // With many segments vertices lie in it.
    window.press(Key::Period);
    for (error, has) in [(165.0, true), (46.0, false)] {
        let mut known = trade();
        for one in &mut known.methods {
            one.error.as_mut().expect("measured").max = error;
        }
        window.app.study.facts.trade.finish(Some(known));
        assert_eq!(has_question(&mut window), has, "{error}");
    }
}

#[test]
fn a_mode_shows_the_whole_picture_and_a_key_brings_the_line_back() {
    let mut harness = open([960, 720]);
    for (key, mode) in [
        (Key::P, ShadingMode::Phong),
        (Key::G, ShadingMode::Gouraud),
        (Key::F, ShadingMode::Flat),
    ] {
        let size = harness.state().canvas.size();
        press(&mut harness, key);
        let app = harness.state();
        assert_eq!(app.viewer().show, ViewMode::Picture);
        assert_eq!(common(&app.document.scene.world), Some(mode));
        assert_eq!(app.canvas.size(), size, "the picture keeps its size");
        press(&mut harness, Key::F3);
        assert_eq!(harness.state().viewer().show, ViewMode::Wipe);
    }
    // A wipe of the picture goes on with another mode.
    press(&mut harness, Key::F4);
    press(&mut harness, Key::P);
    assert_eq!(harness.state().viewer().show, ViewMode::Wipe);
}

#[test]
fn a_heading_opens_in_place_and_one_at_a_time_in_a_low_window() {
    for (size, is_alone) in [([1280, 800], true), ([1280, 1400], false)] {
        let mut harness = open(size);
        let picture = harness.state().canvas.size();
        for (tab, name, ..) in HEADINGS {
            let at = places(&harness, name)[0];
            harness.hover_at(at);
            harness.drag_at(at);
            harness.drop_at(at);
            harness.run_ok();
            let app = harness.state();
            assert!(app.desk.is_open(tab), "{size:?}: {name}");
            assert_eq!(app.desk.tabs.len() == 1, is_alone || tab == HEADINGS[0].0);
            assert_eq!(app.canvas.size(), picture, "{name}");
            if !is_alone {
                break;
            }
        }
        press(&mut harness, Key::Escape);
        assert!(!harness.state().desk.is_open(HEADINGS[8].0));
    }
}
