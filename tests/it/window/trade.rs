//! The live trade: the chart as a control, and measurements of the view that is shown.

use std::cell::Cell;
use std::time::{Duration, Instant};

use egui::{Event, Key, Modifiers, Pos2, RawInput};
use fearless_simd::Level;
use shadetrade::components::ShadingMode::{BlinnPhong, Flat, Gouraud, Phong};
use shadetrade::components::{Segments, Side, ViewMode, common};
use shadetrade::output::Monitor;
use shadetrade::questions::job::Drawing;
use shadetrade::questions::metrics::ErrorStatistics;
use shadetrade::questions::prove::prove;
use shadetrade::questions::requires::part_changes;
use shadetrade::questions::requires::segments::fewest_segments;
use shadetrade::questions::trade::timing::MIN_SAMPLES;
use shadetrade::questions::trade::verdict::method_name;
use shadetrade::questions::trade::{LeftOut, Measured, Measurement};
use shadetrade::scene::Scene;
use shadetrade::shading::{Method, methods};
use shadetrade::window::app::App;
use shadetrade::window::controls::{self, choose_method, show, wipe};
use shadetrade::window::facts::{Comparison, Worst};
use shadetrade::window::inspector::Tab;
use shadetrade::window::keys::Action;
use shadetrade::window::study::Runner;

use super::{FRAME, Window};
use crate::support::scene::done;
use crate::support::window::{app, default_scene, places, widgets};
use crate::trade::example::live;

const SIZE: [usize; 2] = [900, 700];
/// The worst pixels of Phong and of Gouraud, in the left and in the right half of a wide picture.
pub const WORST: [[usize; 2]; 2] = [[430, 400], [700, 330]];

/// The methods with the cuboids' own segments.
fn plain() -> Vec<Method> {
    methods(None).filter(|it| it.segments.is_none()).collect()
}

/// Milliseconds and errors of [`plain`] methods: a smaller error takes longer, except for exact Gouraud and the shortcut.
pub fn measured() -> Vec<Measurement> {
    let times = [0.15, 0.8, 0.2, 0.0, 0.0, 0.31, 0.33, 0.36, 0.41, 0.5, 1.0];
    let errors = [
        200.0, 165.0, 165.0, 171.0, 60.0, 3.9, 1.9, 0.98, 0.49, 0.24, 6e-4,
    ];
    let methods = plain().into_iter().zip(times).zip(errors);
    let measured = methods.map(|((method, time), error)| Measurement {
        on_front: ![0.8, 0.0].contains(&time),
        highlight_kept: Some(0.1),
        error: Some(ErrorStatistics {
            max: error,
            max_pixel: WORST[usize::from(method.mode == Gouraud)],
            ..ErrorStatistics::default()
        }),
        ..live(method, time, error)
    });
    measured.collect()
}

/// This measurement as a whole.
pub fn trade() -> Measured {
    Measured {
        methods: measured(),
        ..Measured::default()
    }
}

/// A window with this measurement.
pub fn app_with_trade(size: [usize; 2]) -> App {
    let mut app = with_trade(app(default_scene(), size, Level::new()));
    app.desk.tabs = vec![Tab::Time];
    app
}

/// A window that has measured everything.
pub fn with_trade(mut app: App) -> App {
    app.desk.shows_times = true;
    app.study.facts.trade.finish(Some(trade()));
    app
}

fn set_budget(window: &mut Window, budget: f64) {
    controls::set_budget(&mut window.app.document.scene.world, Some(budget));
}

fn open() -> Window {
    Window::with(app_with_trade(SIZE), SIZE)
}

/// The positions of the dots in the window, in the order of [`plain`].
fn dots() -> Vec<Pos2> {
    let harness = widgets(app_with_trade(SIZE), SIZE);
    let dot = |method: &Method| {
        let label = format!("choose {}", method_name(*method));
        places(&harness, &label)[0]
    };
    plain().iter().map(dot).collect()
}

#[test]
fn dots_lie_by_time_and_error() {
    let (dots, measured) = (dots(), measured());
    for (one, at) in measured.iter().zip(&dots) {
        for (other, there) in measured.iter().zip(&dots) {
            // What is not timed lies right of all others.
            let time = |it: &Measurement| {
                let is_timed = it.method.mode.is_drawn();
                if is_timed { it.timing.median } else { 100.0 }
            };
            let is_faster = time(one) < time(other);
            assert!(!is_faster || at.x < there.x, "{one:?}, {other:?}");
            let errs_more = one.largest_error() > other.largest_error();
            assert!(!errs_more || at.y < there.y, "{one:?}, {other:?}");
        }
    }
}

#[test]
fn a_click_on_a_dot_chooses_its_method() {
    let mut window = open();
    for (method, at) in plain().iter().zip(dots()) {
        window.click(at);
        if method.mode.is_drawn() {
            assert_eq!(window.app.method(), Some(*method));
        } else {
            let viewer = window.app.viewer();
            assert_eq!(viewer.show, ViewMode::Wipe);
            let side = Side::from(*method);
            assert!(viewer.sides.contains(&side), "no scene asks for it");
        }
    }
}

#[test]
fn the_dot_of_a_grid_gives_its_segments_to_all_cuboids() {
    let mut world = default_scene().world;
    let grid = methods(None).find(|it| it.id == "gouraud-8x8-0.5");
    choose_method(&mut world, grid.expect("it is measured"));
    assert_eq!(common(&world), Segments::new(8));
    assert_eq!(common(&world), Some(Gouraud));
    // Its own dot is that of the scene's segments now.
    let ids: Vec<&str> = methods(common(&world)).map(|it| it.id).collect();
    assert!(ids.contains(&"gouraud-1x1-0.5") && !ids.contains(&"gouraud-8x8-0.5"));
}

/// Of a change `rooms` says which facts it outdates.
#[test]
fn a_trade_belongs_to_a_view_with_any_method_on_screen_and_a_comparison_to_a_picture() {
    let mut window = Window::with(app_with_trade(SIZE), [430, 200]);
    window.app.desk.tabs.clear();
    for (keys, are_current) in [
        (
            &[Key::F3, Key::F6, Key::F2, Key::H, Key::H][..],
            [true, true],
        ),
        (&[Key::P, Key::OpenBracket, Key::G], [true, false]),
        (
            &[Key::W, Key::O, Key::ArrowLeft, Key::C, Key::Plus, Key::Home],
            [false, false],
        ),
    ] {
        for key in keys {
            let facts = &mut window.app.study.facts;
            facts.trade.finish(Some(trade()));
            facts.comparison.finish(None);
            window.press(*key);
            let facts = &window.app.study.facts;
            let found = [facts.trade.is_current, facts.comparison.is_current];
            assert_eq!(found, are_current, "{key:?}");
            // The numbers of another picture are not told.
            let told = facts.measured(Method::of(Phong, 1.0));
            assert_eq!(told.is_some(), are_current[0], "{key:?}");
        }
    }
    window.app.study.facts.trade.finish(Some(trade()));
    window.size = [430, 190];
    window.step(Vec::new());
    assert!(!window.app.study.facts.trade.is_current, "another size");
}

#[test]
fn a_budget_chooses_the_method_and_the_scene_stays_as_it_is() {
    let mut window = open();
    let start = window.record();
    // As much time as Gouraud takes.
    window.press(Key::M);
    let budget = window.app.viewer().budget;
    let is_near = budget.is_some_and(|budget| (0.2..0.25).contains(&budget));
    assert!(is_near, "{budget:?}");
    assert_eq!(window.app.method(), Some(Method::of(Gouraud, 0.5)));
    for (budget, (mode, tolerance)) in [
        (5.0, (Phong, 0.0)),
        (0.45, (Phong, 0.5)),
        (0.32, (Phong, 4.0)),
        (0.18, (Flat, 0.0)),
    ] {
        set_budget(&mut window, budget);
        window.step(Vec::new());
        let method = Method::of(mode, tolerance);
        assert_eq!(window.app.method(), Some(method), "{budget} ms");
        let expected = window.drawn(|view| method.view(&view));
        let frame = window.app.canvas.pictures.frame.pixels();
        assert!(frame == expected, "{budget} ms");
        assert_eq!(window.record().cuboid, start.cuboid);
        assert!(window.app.study.facts.trade.current().is_some());
    }
    // More time, and less.
    set_budget(&mut window, 0.36);
    window.press(Key::OpenBracket);
    assert_eq!(window.app.method(), Some(Method::of(Phong, 0.5)));
    window.press(Key::CloseBracket);
    assert_eq!(window.app.method(), Some(Method::of(Phong, 1.0)));
    // The error is held again.
    window.press(Key::M);
    assert_eq!(window.record(), start);
    window.press(Key::M);
    window.press(Key::G);
    assert_eq!(window.app.viewer().budget, None);
    assert_eq!(common(&window.app.document.scene.world), Some(Gouraud));
}

#[test]
fn frames_over_the_budget_are_drawn_by_a_faster_method_and_what_was_recorded_is_not() {
    let mut window = open();
    set_budget(&mut window, 0.6);
    window.step(Vec::new());
    assert_eq!(window.app.method(), Some(Method::of(Phong, 0.25)));
    // Measurements of another view say nothing about this one, and nothing moves.
    window.app.study.facts.trade.is_current = false;
    window.step(Vec::new());
    assert_eq!(window.app.method(), Some(Method::of(Phong, 0.25)));
    // No frame of this picture takes so little time.
    set_budget(&mut window, 0.0011);
    window.key(Key::ArrowLeft, true);
    assert_eq!(window.app.method(), Some(Method::of(Flat, 0.0)));
    assert_eq!(window.record().view.budget, Some(0.0011));
    // Where nothing is measured, the tolerance is drawn.
    let mut other = Window::of(Scene::spawn("other".to_owned(), &window.record()), SIZE);
    other.press(Key::ArrowLeft);
    assert_eq!(other.app.method(), Some(Method::of(Gouraud, 0.5)));
    assert_eq!(other.app.view().tolerance, 0.5);
    assert_eq!(other.app.view().shading, None);
}

/// Steps until `is_done` returns true, for ten minutes at most.
fn run(app: &mut App, is_done: impl Fn(&App) -> bool) {
    run_pressing(app, &[], is_done);
}

/// As [`run`], with these events in each step.
fn run_pressing(app: &mut App, events: &[Event], is_done: impl Fn(&App) -> bool) {
    let start = Instant::now();
    while start.elapsed() < Duration::from_mins(10) {
        let now = app.desk.now + FRAME;
        let input = RawInput {
            events: events.to_vec(),
            ..RawInput::default()
        };
        let output = app.step(now, [300, 240], input);
        output.expect("a small picture fits");
        if is_done(app) {
            return;
        }
        app.carry_on(now, Duration::ZERO);
        std::thread::yield_now();
    }
    panic!("no answer");
}

/// A window whose questions are answered between steps.
fn in_the_background(runner: Runner) -> App {
    let drawing = Drawing {
        scene: default_scene(),
        size: [300, 240],
        threads: 1,
        level: Level::new(),
    };
    App::new(drawing, runner).expect("there are threads")
}

#[test]
fn questions_are_answered_row_by_row_without_threads() {
    let mut app = in_the_background(Runner::Pieces);
    app.desk.tabs = vec![Tab::Required];
    let steps = Cell::new(0);
    run(&mut app, |app| {
        steps.set(steps.get() + 1);
        app.study.facts.segments.is_current
    });
    let facts = &app.study.facts;
    let mut scene = app.document.scene.snapshot();
    let view = app.view();
    let (level, none) = (Level::new(), Monitor::NONE);
    let rows = view.size[1];
    assert!(steps.get() > 3 * rows, "a piece is a row: {steps:?}");
    let compared = Comparison::of(&mut scene.world, &view, Vec::new(), level, none);
    assert_eq!(facts.comparison.current(), Some(&done(compared)));
    let proof = prove(&mut scene.world, &view, None, level, none);
    let found = facts.proof.current().map(|it| &it.1);
    assert_eq!(found, Some(&done(proof)));
    let found = facts.required.current().expect("an answer");
    assert!(found.is_all);
    assert_eq!(found.rows, done(part_changes(&scene, &view, none)));
    let segments = done(fewest_segments(&scene, &view, none));
    assert_eq!(facts.segments.current(), Some(&segments));
    let samples = facts.trade.current().expect("an answer").methods.iter();
    let timed = samples.filter(|it| it.method.mode.is_drawn());
    let mut samples = timed.map(|it| it.timing.samples);
    assert!(samples.all(|it| it >= MIN_SAMPLES) && facts.trade.is_current);
}

#[test]
fn every_method_and_the_one_on_screen_is_measured_in_the_background() {
    let mut app = in_the_background(Runner::Threads);
    run(&mut app, |app| app.study.facts.trade.current().is_some());
    let error = app.study.facts.comparison.current();
    assert!(error.is_some(), "it takes less time");
    run(&mut app, |app| app.study.facts.proof.current().is_some());
    let measured = app.study.facts.trade.current().expect("an answer");
    let found: Vec<Method> = measured.methods.iter().map(|it| it.method).collect();
    let known: Vec<Method> = methods(Some(Segments::default())).collect();
    assert_eq!(found, known);
    let [shown, beside] = [0.7, 0.3].map(|tolerance| Method::of(Phong, tolerance));
    let world = &mut app.document.scene.world;
    choose_method(world, shown);
    let side = Side::Method {
        segments: None,
        mode: Phong,
        tolerance: beside.tolerance,
    };
    let blinn = Method::of(BlinnPhong, 0.0);
    wipe(world, [side, Side::from(blinn)]);
    run(&mut app, |app| {
        let facts = &app.study.facts;
        facts.measured(beside).is_some() && facts.comparison.current().is_some()
    });
    let facts = &app.study.facts;
    assert!(known.iter().all(|it| facts.measured(*it).is_some()));
    let [shown, beside, blinn] = [shown, beside, blinn].map(|it| facts.measured(it));
    let shown = shown.expect("it is measured");
    let (mut world, view, level) = (app.document.state.spawn(), app.view(), Level::new());
    let sides = vec![Method::of(Phong, 0.3), Method::of(BlinnPhong, 0.0)];
    let compared = done(Comparison::of(
        &mut world,
        &view,
        sides,
        level,
        Monitor::NONE,
    ));
    let error = |it: Option<&Measurement>| it.and_then(|it| it.error).map(Worst::from);
    assert_eq!(error(Some(shown)), compared.worst);
    let found = [error(beside), error(blinn)];
    assert_eq!(found, [0, 1].map(|it| compared.sides[it].1));
    assert_eq!(facts.comparison.current(), Some(&compared));
    let [low, high] = shown.timing.interval;
    assert!(0.0 < low && low <= shown.timing.median && shown.timing.median <= high);
    assert!(shown.timing.raw.is_empty(), "each layout would copy them");
}

/// The least time of a measurement that is repeated here.
const BRIEF: Duration = Duration::from_millis(20);

#[test]
fn the_time_is_measured_for_longer_while_it_is_not_sure_and_what_does_not_fit_is_left_out() {
    for (width, time) in [(2.0, 2 * BRIEF), (1.01, BRIEF)] {
        let mut app = in_the_background(Runner::Pieces);
        run(&mut app, |app| app.study.facts.trade.current().is_some());
        let trade = app.study.facts.trade.value.as_mut().expect("an answer");
        trade.time = BRIEF;
        for one in &mut trade.methods {
            one.timing.samples = MIN_SAMPLES;
            one.timing.interval = [1.0, width];
        }
        // The finest grid does not fit.
        let methods = trade.methods.iter().map(|it| it.method);
        let finest = methods.max_by_key(|it| it.segments.map(Segments::count));
        let finest = finest.expect("methods");
        trade.methods.retain(|it| it.method != finest);
        trade.left_out = vec![LeftOut {
            method: finest,
            reason: "large".to_owned(),
        }];
        // On a busy machine it may stay unsure.
        let is_longer = time > BRIEF;
        run(&mut app, |app| {
            let study = &app.study;
            let is_idle = study.work.is_none() && study.facts.proof.is_current;
            let trade = study.facts.trade.value.as_ref();
            (is_idle || is_longer) && trade.is_some_and(|it| it.time >= time)
        });
        let trade = app.study.facts.trade.current().expect("an answer");
        // Once measured again, it may be unsure still.
        assert!(trade.time == time || time > BRIEF && trade.time > time);
        assert!(trade.knows(finest) && app.study.facts.measured(finest).is_none());
    }
}

#[test]
fn the_worst_pixel_opens_by_itself_once_it_is_known() {
    for mode in [ViewMode::Picture, ViewMode::Wipe] {
        let mut app = in_the_background(Runner::Threads);
        show(&mut app.document.scene.world, mode);
        run(&mut app, |_| true);
        app.run(Action::Worst);
        assert_eq!(app.pixel(), None);
        run(&mut app, |app| app.pixel().is_some());
        assert!(app.desk.is_open(Tab::Pixel));
        // The picture is that by Gouraud, which in the wipe is on the left and errs more.
        let comparison = app.study.facts.comparison.current().expect("an answer");
        let worst = comparison.worst.expect("it errs");
        assert_eq!(app.pixel(), Some(worst.pixel));
        assert!(worst.error > 100.0);
    }
}

#[test]
fn keys_that_change_nothing_let_a_measurement_end() {
    let mut app = in_the_background(Runner::Threads);
    let events = [true, false].map(|pressed| Event::Key {
        key: Key::H,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: Modifiers::NONE,
    });
    run_pressing(&mut app, &events, |app| {
        app.study.facts.trade.current().is_some()
    });
}
