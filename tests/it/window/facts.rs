//! Answers about the picture belong to the picture shown, and old ones are marked as old.

use std::sync::{Arc, mpsc};
use std::time::Duration;

use egui::{Key, Modifiers, Pos2};
use egui_kittest::kittest::Queryable;
use fearless_simd::Level;
use shadetrade::components::{ShadingMode, Side, View, common};
use shadetrade::output::Monitor;
use shadetrade::questions::requires::without;
use shadetrade::systems::frame::{Keep, Workers};
use shadetrade::window::app::App;
use shadetrade::window::canvas::REST;
use shadetrade::window::desk::{Desk, reading_time};
use shadetrade::window::facts::Change;
use shadetrade::window::inspector::Tab;
use shadetrade::window::study::{Runner, SLOW_PROOF, Study, Subject};
use shadetrade::window::work::{Question, Work, pool};

use super::files::on_file;
use super::{PAUSE, Window, changed, choose, default_record, press};
use crate::support::records;
use crate::support::scene::draw;
use crate::support::window::{default_scene, widgets};

/// A size so small that everything is computed at once.
const SMALL: [usize; 2] = [150, 130];

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
    // A few more rows come with each step.
    let known = |window: &Window| {
        let found = window.app.study.facts.required.current();
        found.cloned().expect("an answer")
    };
    let mut rows = Vec::new();
    while !known(&window).is_all {
        rows.push(known(&window).rows.len());
        window.step(Vec::new());
    }
    assert!(rows.len() > 1 && rows.is_sorted(), "{rows:?}");
    window.step(Vec::new());
    let parts = known(&window).rows;
    let left_out = parts.iter().filter(|it| it.change.keeps(0.5)).count();
    let segments = window.app.study.facts.segments.current();
    let count = segments.expect("an answer")[0].count();
    let harness = widgets(window.app, [1400, 1400]);
    let [red, depth] = ["light red", "depth test"].map(|name| {
        let part = parts.iter().find(|it| it.name == name);
        let row = harness.get_by_label(name).rect().min.y;
        (part.expect("a part").change.most(), row)
    });
    assert!(red.0 > depth.0 && red.1 < depth.1, "{red:?}, {depth:?}");
    // A text is a node in a node.
    let sentence = format!("emerald: Gouraud needs {count} segments.");
    assert!(harness.query_all_by_value(&sentence).count() > 0);
    assert_eq!(harness.query_all_by_value("no").count(), 2 * left_out);
}

#[test]
fn a_click_on_a_part_shows_the_picture_without_it_and_another_the_picture() {
    let click = |window: &mut Window, name: &str| {
        // Every row is in sight.
        window.with_widgets([1300, 1000], |it| choose(it, name));
        window.step(Vec::new());
    };
    let mut window = Window::of(default_scene(), [1300, 120]);
    window.press(Key::P);
    window.press(Key::N);
    let is_all = |window: &Window| {
        let required = window.app.study.facts.required.current();
        required.is_some_and(|it| it.is_all)
    };
    while !is_all(&window) {
        window.step(Vec::new());
    }
    let picture = window.app.shown().into_owned();
    for name in ["light red", "light white"] {
        click(&mut window, name);
        let left_out = window.app.study.facts.left_out.current();
        let (part, pixels) = left_out.expect("an answer");
        let mut world = without(&window.app.document.scene, &[*part]).world;
        let frame = draw(&mut world, &window.app.view(), Keep::Display);
        let differs = |(one, other): &(&u32, &u32)| {
            let channels = one.to_be_bytes().into_iter().zip(other.to_be_bytes());
            channels.map(|(one, other)| one.abs_diff(other)).max() > Some(1)
        };
        let different = pixels.iter().zip(frame.pixels()).filter(differs).count();
        // On an edge two faces are as near.
        assert!(different < 20, "{name}: {different}");
        assert_eq!(*window.app.shown(), pixels[..]);
        assert_ne!(picture, *pixels, "{name}");
        click(&mut window, name);
        assert_eq!(*window.app.shown(), picture[..]);
    }
}

#[test]
fn the_proof_refutes_nothing_and_the_status_line_does_not_tell_of_the_picture_before() {
    let mut window = Window::of(default_scene(), [1000, 120]);
    window.app.desk.open(Tab::Proof);
    window.wait(PAUSE);
    window.wait(PAUSE);
    let (_, proof) = window.app.study.facts.proof.current().expect("an answer");
    let [width, height] = window.app.canvas.size();
    assert_eq!(proof.refuted, 0);
    assert_eq!(proof.proven + proof.undecided, (width * height) as u64);
    let mut harness = widgets(window.app, [1000, 120]);
    for is_told in [true, false] {
        let mut labels = harness.query_all_by_label_contains("Drawn as defined");
        assert_eq!(labels.next().is_some(), is_told);
        drop(labels);
        press(&mut harness, Key::P);
    }
}

#[test]
fn work_that_is_dropped_ends() {
    let pool = pool().expect("the system has threads");
    let (tell, told) = mpsc::channel();
    let find = async move |monitor: Monitor<'_>| {
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

/// A study that is asked about the default scene, with the middle pixel explained if it is `probed`.
fn ask(study: &mut Study, probed: bool, rests: bool, desk: &Desk) {
    let mut record = default_record();
    record.view.pixel = probed.then_some([0.0; 2]);
    let pixel = record.view.pixel_in(SMALL, SMALL[1] as f64);
    let subject = Subject {
        name: "default",
        view: View::of(&record.spawn(), SMALL),
        fit: 1.0,
        pixel: pixel.map(|it| (it, Side::Picture)),
        record: &Arc::new(record),
        method: None,
        workers: &Workers::alone(Level::new()),
        rests,
    };
    study.ask(&subject, desk);
}

fn live() -> Study {
    Study::new(Runner::Threads).expect("the system has threads")
}

/// Whether a study works: progress or an answer is to be shown.
fn works(mut study: Study) -> bool {
    study.receive(PAUSE)
}

#[test]
fn work_stops_when_the_picture_changes_and_for_a_question_of_more_worth() {
    let desk = Desk::default();
    for is_probed in [false, true] {
        let mut study = live();
        ask(&mut study, is_probed, false, &desk);
        let is_proof = study
            .work
            .is_some_and(|work| work.question == Question::Prove);
        assert_eq!(is_proof, !is_probed, "things move");
    }
    for (is_probed, change, goes_on) in [
        (true, Change::Method, false),
        (false, Change::Nothing, true),
        (false, Change::Method, false),
    ] {
        let mut study = live();
        ask(&mut study, is_probed, true, &desk);
        study.outdate(change);
        assert_eq!(works(study), goes_on, "{change:?}");
    }
    let mut study = live();
    study.facts.comparison.finish(None);
    ask(&mut study, false, true, &desk);
    ask(&mut study, true, true, &desk);
    study.outdate(Change::Method);
    assert!(!works(study), "the pixel stopped the proof");
}

#[test]
fn a_proof_goes_on_while_things_move_unless_it_is_slow() {
    let begin = || {
        let mut study = live();
        ask(&mut study, false, false, &Desk::default());
        study
    };
    let mut study = begin();
    study.outdate(Change::Scene);
    while study.last_proof().is_none() {
        std::thread::yield_now();
        study.receive(Duration::ZERO);
    }
    let proof = study.facts.proof.current();
    assert!(proof.is_none(), "that of the picture before");
    ask(&mut study, false, true, &Desk::default());
    let question = study.work.as_ref().map(|work| work.question);
    assert_eq!(question, Some(Question::Compare), "once nothing moves");

    let mut study = begin();
    let work = study.work.as_mut().expect("a proof");
    work.begun -= 2 * SLOW_PROOF;
    study.outdate(Change::Scene);
    ask(&mut study, false, false, &Desk::default());
    assert!(study.work.is_none(), "it is given up");
}

#[test]
fn methods_are_measured_once_and_where_times_are_shown() {
    let is_measured = |shows_times: bool, is_known: bool| {
        let mut study = live();
        study.facts.comparison.finish(None);
        if is_known {
            study.facts.trade.finish(None);
        }
        let desk = Desk {
            shows_times,
            ..Desk::default()
        };
        ask(&mut study, false, true, &desk);
        let work = study.work.as_ref();
        work.is_some_and(|work| work.question == Question::Measure)
    };
    assert!(is_measured(true, false));
    assert!(!is_measured(true, true), "even if that failed");
    assert!(!is_measured(false, false));
}

#[test]
fn an_answer_is_new_when_it_is_received() {
    let mut study = live();
    ask(&mut study, false, true, &Desk::default());
    let mut is_new = study.receive(Duration::ZERO);
    while study.facts.comparison.current().is_none() {
        std::thread::yield_now();
        is_new = study.receive(Duration::ZERO);
    }
    assert!(is_new);
    study.clear();
    assert!(study.facts.comparison.value.is_none());
}

#[test]
fn the_reason_why_a_question_has_no_answer_is_told_once() {
    let mut window = Window::of(default_scene(), SMALL);
    let App {
        document,
        study,
        canvas,
        ..
    } = &mut window.app;
    let subject = Subject {
        name: "too large",
        record: &document.state,
        view: View::of(&document.scene.world, [1 << 24; 2]),
        fit: 1.0,
        pixel: None,
        method: None,
        workers: canvas.pictures.frame.workers(),
        rests: true,
    };
    let desk = Desk {
        blinks: Some(Duration::ZERO),
        ..Desk::default()
    };
    study.ask(&subject, &desk);
    window.step(Vec::new());
    assert!(!window.message().is_empty());
    window.app.desk.message = None;
    window.step(Vec::new());
    assert_eq!(window.message(), "");
}

#[test]
fn a_pixel_of_a_scene_opens_its_tab_once() {
    let scene = changed(|record| record.view.pixel = Some([0.0; 2]));
    let mut window = Window::open();
    window.app.document.restore(&scene.record);
    window.step(Vec::new());
    assert_eq!(window.app.desk.tabs, [Tab::Pixel]);
    window.app.desk.tabs.clear();
    window.step(Vec::new());
    assert_eq!(window.app.desk.tabs, [], "the user closed it");
    let window = Window::of(scene, [600, 200]);
    assert_eq!(window.app.desk.tabs, [Tab::Pixel]);
}

#[test]
fn a_step_is_due_when_something_is() {
    let due = |window: &Window| window.output.repaint_after;
    let mut window = Window::of(default_scene(), SMALL);
    window.press(Key::P);
    assert!(due(&window) <= REST, "the picture does not rest yet");
    window.wait(PAUSE);
    window.wait(PAUSE);
    assert_eq!(due(&window), Duration::MAX);
    window.app.desk.say("a message");
    window.step(Vec::new());
    assert!(due(&window) <= reading_time("a message"));
    assert!(reading_time("a message") < reading_time(&"a message".repeat(20)));
    window.wait(due(&window));
    assert_eq!(window.message(), "");
    let (window, _) = on_file();
    assert!(due(&window) < PAUSE, "the file may change");
}

#[test]
fn different_modes_are_mixed_until_a_key_makes_them_equal() {
    let other = records::cuboid("other", [1.0; 3], [3.0, 0.0, 0.0]);
    let two = changed(|record| record.cuboid.push(other));
    let mut window = Window::of(two, SMALL);
    let mode = |window: &Window| common(&window.app.document.scene.world);
    assert_eq!(mode(&window), None);
    // The first one has this mode already.
    window.press(Key::G);
    assert_eq!(mode(&window), Some(ShadingMode::Gouraud));
}
