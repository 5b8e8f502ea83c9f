//! The tab of a number that is varied: its curves, and the line that is dragged.

use std::pin::pin;
use std::task::{Context, Poll, Waker};

use egui::{Key as Press, Rect, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use shadetrade::components::ShadingMode::{Gouraud, Phong, UnitVectors};
use shadetrade::questions::vary::curve::Curve;
use shadetrade::questions::vary::picture::{Compared, errors};
use shadetrade::questions::vary::refined::{PIXELS, Refined};
use shadetrade::questions::vary::variable::{Variable, present};
use shadetrade::scene::key::Key;
use shadetrade::window::app::App;
use shadetrade::window::inspector::Tab;

use super::{Window, click_at, default_record, drag, press};
use crate::support::prelude::*;
use crate::support::window::{default_scene, places, widgets};

/// A window with one open heading.
const SIZE: [usize; 2] = [940, 890];

/// A window that varies a key of the default scene, with all values drawn.
fn varying(key: &str) -> Window {
    let mut window = Window::of(default_scene(), SIZE);
    let App { desk, document, .. } = &mut window.app;
    desk.vary(Key::from(key), &document.state);
    for _ in 0..100 {
        window.step(vec![]);
        let curves = window.app.study.facts.curves.value.as_ref();
        if curves.is_some_and(|it| it.is_all) {
            return window;
        }
    }
    panic!("the curves of {key} are not finished");
}

fn curves(app: &App) -> Vec<Curve> {
    let curves = app.study.facts.curves.value.as_ref().expect("curves");
    curves.curves().into_iter().map(|it| it.1).collect()
}

fn value(app: &App, key: &str) -> f64 {
    let record = SceneRecord::of(&app.document.scene.world);
    present(&Key::from(key), &record).expect("a number")
}

/// The area of the plot.
fn area(harness: &Harness<App>) -> Rect {
    harness.get_by_label_contains("errors over").rect()
}

#[test]
fn curves_reach_from_end_to_end_and_end_within_a_hundredth() {
    for key in ["camera.1.orbit.zoom", "cuboid.emerald.segments"] {
        let window = varying(key);
        let varied = window.app.desk.varied.as_ref().expect("it is open");
        let variable = &varied.variable;
        let mut count = 0;
        for curve in curves(&window.app) {
            let ends = [curve.points.first(), curve.points.last()].map(|it| it.map(|it| it.value));
            assert_eq!(ends, [Some(variable.from), Some(variable.to)], "{key}");
            for pair in curve.points.windows(2) {
                let is_kept = |at: usize| pair[at].found.keeps(0.5);
                let gap = variable.share(pair[1].value) - variable.share(pair[0].value);
                let is_next =
                    variable.key.last() == "segments" && pair[1].value - pair[0].value < 1.5;
                assert!(gap <= 1.0 / 32.0 || is_next, "{key}: {gap}");
                if is_kept(0) != is_kept(1) {
                    assert!(gap <= 0.01 || is_next, "{key}: {gap}");
                    count += 1;
                }
            }
        }
        assert!(count > 0, "{key}");
    }
}

#[test]
fn the_line_is_dragged() {
    let key = "cuboid.emerald.material.shininess";
    let window = varying(key);
    let varied = window.app.desk.varied.as_ref().expect("it is open");
    let variable = varied.variable.clone();
    let before = window.app.document.state.clone();
    let mut harness = widgets(window.app, SIZE);
    let area = area(&harness);
    let at = |share: f64| area.lerp_inside([share as f32, 1.0]) - vec2(0.0, 2.0);
    let now = variable.share(value(harness.state(), key));
    drag(&mut harness, &[at(now), at(0.4), at(0.25)]);
    let dragged = value(harness.state(), key);
    assert!((variable.share(dragged) - 0.25).abs() < 0.01, "{dragged}");
    let mut record = SceneRecord::of(&harness.state().document.scene.world);
    record.cuboid[0].material.shininess = before.cuboid[0].material.shininess;
    assert_eq!(record, *before);
}

/// Small cuboids at every pixel, and large ones at some of them.
#[test]
fn values_are_drawn_and_compared_at_the_size_of_the_picture_as_the_command_does() {
    let record = default_record();
    let contenders = [(Gouraud, 0.5), (Phong, 0.5), (UnitVectors, 0.0)];
    let contenders = contenders.map(|(mode, tolerance)| Method::of(mode, tolerance).into());
    let (level, none) = (Level::new(), Monitor::NONE);
    for size in [[240, 180], [161, 121]] {
        let zoom = Variable::parse("camera.1.orbit.zoom=0.5..10", &record).expect("a number");
        let refined = Refined::new(zoom.clone(), &record, size).expect("a scene");
        let refined = done(refined.refine(17, level, none));
        let curves = refined.curves();
        let (mut small, mut large) = (0, 0);
        for index in 0..curves[0].1.points.len() {
            let value = curves[0].1.points[index].value;
            let scene = zoom.scene(&record, value).expect("it is legal");
            let all = errors(&scene, size, &contenders, level, Compared::All, none);
            for (all, (_, curve)) in done(all).iter().zip(&curves) {
                let some = curve.points[index].found;
                // A box takes half of the rectangle around it at least.
                if all.pixels <= PIXELS / 4 {
                    small += usize::from(some.pixels > 0);
                    let found = (some.error, some.pixels);
                    assert_eq!(found, (all.error, all.pixels), "{value}");
                } else {
                    large += usize::from(some.pixels < all.pixels);
                    let is_part = (PIXELS / 16..=PIXELS).contains(&some.pixels);
                    let is_less = (0..2).all(|end| some.error[end] <= all.error[end]);
                    assert!(is_part && is_less, "{value}: {some:?}");
                }
            }
        }
        assert!(small >= 9 && large >= 9, "{small}, {large}");
    }
}

#[test]
fn every_number_of_the_scene_has_a_button() {
    let mut harness = widgets(Window::of(default_scene(), SIZE).app, SIZE);
    press(&mut harness, Press::E);
    for (label, key) in [
        ("x", "cuboid.emerald.size.x"),
        ("📈", "cuboid.emerald.segments"),
    ] {
        let found = places(&harness, label);
        click_at(&mut harness, found[0]);
        let desk = &harness.state().desk;
        let varied = desk.varied.as_ref().expect("it is open");
        assert_eq!(varied.variable.key, Key::from(key));
        assert!(harness.state().desk.is_open(Tab::Vary));
        press(&mut harness, Press::E);
    }
}

#[test]
fn a_key_that_is_gone_says_so() {
    let mut window = Window::of(default_scene(), [600, 200]);
    let key = Key::from("light.red.intensity");
    window.app.desk.vary(key, &window.app.document.state);
    window.step(vec![]);
    let mut record = default_record();
    record.light.retain(|it| it.name != "red");
    window.app.document.restore(&record);
    window.step(vec![]);
    window.step(vec![]);
    let varied = window.app.desk.varied.as_ref().expect("it is open");
    let reason = varied.wanted.as_ref().expect_err("there is no red light");
    assert!(reason.contains("light.red"), "{reason}");
}

#[test]
fn work_in_pieces_finds_the_same() {
    let (record, key) = (default_record(), Key::from("light.white.position.z"));
    let variable = Variable::around(key, &record).expect("a number");
    let none = Refined::new(variable, &record, [320, 240]).expect("a scene");
    let at_once = done(none.clone().refine(5, Level::new(), Monitor::NONE));
    let mut polls = 0;
    let monitor = Monitor {
        is_due: Some(&|| true),
        ..Monitor::NONE
    };
    let mut pieces = pin!(none.refine(5, Level::new(), monitor));
    let context = &mut Context::from_waker(Waker::noop());
    let pieces = loop {
        match pieces.as_mut().poll(context) {
            Poll::Ready(found) => break found.expect("a small picture fits"),
            Poll::Pending => polls += 1,
        }
    };
    let [pieces, at_once] = [pieces, at_once].map(|it| it.curves());
    assert_eq!(pieces.len(), 4);
    let mut pairs = pieces.iter().zip(&at_once);
    assert!(pairs.all(|(one, other)| one.1 == other.1));
    // A pause after each row of cuboids in five pictures.
    assert!(polls >= 5 * 30, "{polls}");
}
