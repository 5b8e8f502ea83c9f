//! The two sides of a wipe: their tags, and the worst pixel.

use std::time::Duration;

use egui::Key;
use egui_kittest::kittest::Queryable;
use shadetrade::window::app::App;
use shadetrade::window::inspector::Tab;
use shadetrade::window::pictures::side_view;

use super::trade::{WORST, app_with_trade};
use super::{Window, changed, choose, press};
use crate::support::prelude::*;
use crate::support::window::{default_scene, widgets};

const SIZE: [usize; 2] = [1400, 800];
/// A window that has measured the methods of a wipe.
fn measured() -> App {
    app_with_trade(SIZE)
}

fn open(tab: Option<Tab>) -> Window {
    let mut app = measured();
    app.desk.tabs.extend(tab);
    let mut window = Window::with(app, SIZE);
    window.press(Key::F3);
    window.step(Vec::new());
    window
}

#[test]
fn both_tags_are_whole_in_windows_of_any_width() {
    for size in [SIZE, [760, 700]] {
        let mut harness = widgets(measured(), size);
        press(&mut harness, Key::F3);
        let place = harness.state().canvas.place;
        let tags = [
            ["Gouraud", "light at vertices"],
            ["Phong within half a level", "light at pixels"],
        ];
        let tags = tags.map(|[name, lit]| {
            let mut named = harness.query_all_by_value(name).map(|node| node.rect());
            let name = named.find(|it| place.contains_rect(*it)).expect("a tag");
            name.union(harness.get_by_label(lit).rect())
        });
        let are_inside = tags.iter().all(|tag| place.contains_rect(*tag));
        assert!(are_inside, "{tags:?} in {place}");
        assert!(tags[0].max.x < tags[1].min.x, "{tags:?}");
    }
}

#[test]
fn two_pictures_take_turns_while_a_key_is_held() {
    for (view, sides) in [
        (Key::F2, [Side::Reference, Side::Picture]),
        (Key::F3, Side::gouraud_phong(0.5)),
        (Key::F4, [Side::Picture, Side::Reference]),
    ] {
        let mut window = Window::of(default_scene(), [300, 200]);
        window.press(view);
        let before = window.app.shown().to_vec();
        window.key(Key::B, true);
        for turn in [0, 1, 0, 1] {
            let expected = match sides[turn] {
                Side::Reference => window.comparison().exact.clone(),
                side => window.drawn(|view| side_view(&side, &view).expect("it is drawn")),
            };
            assert!(window.app.shown() == expected, "{sides:?}, {turn}");
            assert!(window.output.repaint_after <= Duration::from_millis(500));
            window.now += Duration::from_millis(480);
            window.step(vec![window.repeated(Key::B)]);
        }
        window.key(Key::B, false);
        assert!(window.app.shown() == before);
    }
}

#[test]
fn a_wipe_of_what_the_reference_draws_shows_it_at_any_size() {
    let blinn = Method::of(ShadingMode::BlinnPhong, 0.0);
    for side in [Side::Reference, blinn.into()] {
        let scene = changed(|record| {
            (record.view.show, record.view.sides) = (ViewMode::Wipe, [side, Side::Reference]);
            record.light[2].position = Some(DVec3::new(-6.0, 6.0, 10.0));
            record.view.divider = 0.9;
        });
        let mut window = Window::of(scene, [600, 300]);
        for key in [Key::ArrowLeft, Key::E] {
            window.press(key);
            let exact = &window.comparison().exact;
            let is_exact = *window.app.shown() == *exact;
            assert_eq!(is_exact, side == Side::Reference, "{key:?}");
            let frame = &window.app.canvas.pictures.frame;
            assert_eq!(frame.size(), window.app.canvas.size());
            assert!(frame.counts().covered_pixels > 0, "else nothing is seen");
        }
    }
}

#[test]
fn the_worst_pixel_is_probed_by_its_key_and_by_the_result() {
    let probed = |window: &Window| window.app.pixel();
    // That of the side that errs more. The divider moves off it.
    let mut window = open(Some(Tab::Scene));
    let [width, _] = window.app.canvas.size();
    window.app.viewer_mut().divider = 0.02;
    window.press(Key::Y);
    assert_eq!(probed(&window), Some(WORST[1]));
    assert!(window.app.desk.is_open(Tab::Pixel));
    assert!(window.app.viewer().divider > WORST[1][0] as f64 / width as f64);
    // The divider stays where it hides nothing.
    window.app.viewer_mut().divider = 0.95;
    window.press(Key::Y);
    assert_eq!(window.app.viewer().divider, 0.95);
    // So does a click on the result.
    let mut window = Window::with(measured(), SIZE);
    window.press(Key::F5);
    let mut harness = widgets(window.app, SIZE);
    harness.get_by_label_contains("errs by up to").click();
    harness.run_ok();
    assert!(harness.state().desk.is_open(Tab::Pixel));
    // A place that was saved in a wider window may be outside.
    harness.state_mut().viewer_mut().pixel = Some([3.0, 0.0]);
    harness.run_ok();
    assert!(harness.query_by_label_contains("outside").is_some());
}

#[test]
fn a_tag_chooses_the_method_of_its_side() {
    let mut harness = widgets(measured(), SIZE);
    press(&mut harness, Key::F3);
    harness.get_by_value("Phong within half a level").click();
    harness.run_ok();
    choose(&mut harness, "Reference: exact Phong in f64");
    let sides = harness.state().viewer().sides;
    assert_eq!(sides, [Side::gouraud_phong(0.5)[0], Side::Reference]);
}

#[test]
fn no_error_of_another_picture_is_shown() {
    for key in [None, Some(Key::X), Some(Key::ArrowLeft), Some(Key::Period)] {
        let mut window = open(None);
        if let Some(key) = key {
            window.press(key);
        }
        let harness = widgets(window.app, SIZE);
        let mut shown = harness.query_all_by_label_contains("off by");
        // The wipe has no number.
        let is_number = shown.any(|node| format!("{node:?}").contains("165"));
        assert!(!is_number || key.is_none(), "{key:?}");
        let tags = harness.query_all_by_label_contains("errs by up to").count();
        assert_eq!(tags, usize::from(key.is_none()), "{key:?}");
    }
}
