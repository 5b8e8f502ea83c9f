//! Answers about the picture belong to the picture shown, and old ones are marked as old.

use std::sync::mpsc;

use egui::{Key, Modifiers, Pos2};
use egui_kittest::kittest::Queryable;
use shadetrade::components::{ShadingMode, common_mode};
use shadetrade::report::Monitor;
use shadetrade::scene::{Scene, SceneRecord};
use shadetrade::window::facts::{Question, Work, pool};
use shadetrade::window::inspector::Tab;

use super::{PAUSE, Window};
use crate::support::records;
use crate::support::window::{default_scene, widgets};

/// A size so small that everything is computed at once.
const SMALL: [usize; 2] = [130, 100];

#[test]
fn an_answer_becomes_old_exactly_when_the_picture_changes() {
    let mut window = Window::of(default_scene(), SMALL);
    window.press(Key::P);
    window.click(window.app.canvas.place.center());
    window.press(Key::N);
    window.press(Key::F5);
    window.step(Vec::new());
    let are_current = |window: &Window| {
        let facts = &window.app.study.facts;
        [
            facts.section.is_current,
            facts.comparison.is_current,
            facts.required.is_current,
            facts.segments.is_current,
        ]
    };
    for key in [Key::F2, Key::F6, Key::H, Key::H] {
        window.press(key);
        assert_eq!(are_current(&window), [true; 4], "{key:?}");
    }
    // Nothing asks for them again.
    window.app.desk.tab = None;
    window.press(Key::F2);
    for key in [Key::OpenBracket, Key::G] {
        window.press(key);
        assert_eq!(are_current(&window)[1..], [false; 3], "{key:?}");
        window.app.study.facts.comparison.is_current = true;
    }
    window.size = [140, 90];
    window.step(Vec::new());
    assert!(
        !window.app.study.facts.comparison.is_current,
        "another size"
    );
}

#[test]
fn a_probed_pixel_stays_on_its_point_when_the_window_is_resized_and_in_the_picture() {
    let mut window = Window::of(default_scene(), [300, 200]);
    window.click(Pos2::new(170.0, 120.0));
    let before = window.app.pixel().expect("a pixel");
    let (place, [width, height]) = (window.record().view.pixel, window.app.canvas.size());
    window.size = [600, 400];
    (0..2).for_each(|_| window.wait(PAUSE));
    assert!(window.app.study.facts.section.current().is_some());
    let pixel = window.app.probed().expect("an answer").pixel;
    assert_eq!(Some(pixel), window.app.pixel());
    assert_eq!(window.record().view.pixel, place);
    let [wider, higher] = window.app.canvas.size();
    let scale = higher as f64 / height as f64;
    for (before, after, sides) in [
        (before[0], pixel[0], [width, wider]),
        (before[1], pixel[1], [height, higher]),
    ] {
        let [from, to] = sides.map(|side| side as f64 / 2.0);
        let expected = (before as f64 + 0.5 - from) * scale + to;
        assert!((after as f64 - expected).abs() <= 1.0, "{pixel:?}");
    }
    let last = [wider - 1, higher - 1];
    window.app.probe(last);
    window.press_with(Modifiers::SHIFT, Key::ArrowRight);
    assert_eq!(window.app.pixel(), Some(last));
}

#[test]
fn the_part_that_matters_most_comes_first() {
    let mut window = Window::of(default_scene(), SMALL);
    window.press(Key::P);
    window.press(Key::N);
    let parts = window
        .app
        .study
        .facts
        .required
        .current()
        .expect("an answer");
    assert!(parts.iter().any(|it| it.name.contains("red")));
    assert!(parts.is_sorted_by(|one, other| one.change.most() >= other.change.most()));
    let left_out = parts.iter().filter(|it| it.change.keeps(0.5)).count();
    let segments = window.app.study.facts.segments.current();
    let cells = segments.expect("an answer")[0].cells();
    let harness = widgets(window.app, [1400, 1000]);
    // A text is a node in a node.
    let sentence = format!("emerald: Gouraud needs {cells} cells.");
    assert_eq!(harness.query_all_by_value(&sentence).count(), 2);
    assert_eq!(harness.query_all_by_value("no").count(), 2 * left_out);
}

#[test]
fn the_proof_of_a_picture_within_its_tolerance_refutes_nothing() {
    let mut window = Window::of(default_scene(), [1000, 120]);
    window.app.desk.tab = Some(Tab::Proof);
    window.wait(PAUSE);
    window.wait(PAUSE);
    let proof = window.app.study.facts.proof.current().expect("an answer");
    let [width, height] = window.app.canvas.size();
    assert_eq!(proof.refuted, 0);
    assert_eq!(proof.proven + proof.undecided, (width * height) as u64);
}

#[test]
fn work_that_is_dropped_ends() {
    let pool = pool().expect("the system has threads");
    let (tell, told) = mpsc::channel();
    let find = move |monitor: Monitor| {
        tell.send("it begins")?;
        while monitor.check().is_ok() {}
        tell.send("it ends")?;
        anyhow::bail!("nothing is found")
    };
    let work = Work::begin(Some(&pool), Question::Require, |it| &mut it.required, find);
    assert_eq!(told.recv(), Ok("it begins"));
    drop(work);
    assert_eq!(told.recv_timeout(30 * PAUSE), Ok("it ends"));
}

#[test]
fn different_modes_are_mixed_until_a_key_makes_them_equal() {
    let mut record = SceneRecord::of(&default_scene().world);
    let other = records::cuboid("other", [1.0; 3], [3.0, 0.0, 0.0]);
    record.cuboid.push(other);
    let mut window = Window::of(Scene::spawn("two".to_owned(), &record), SMALL);
    let mode = |window: &Window| common_mode(&window.app.document.scene.world);
    assert_eq!(mode(&window), None);
    // The first one has this mode already.
    window.press(Key::G);
    assert_eq!(mode(&window), Some(ShadingMode::Gouraud));
}
