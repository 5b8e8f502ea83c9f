//! Real measurements of small pictures: ordinary views, and views with little or nothing to measure.

use std::sync::Mutex;
use std::time::Duration;

use fearless_simd::Level;
use glam::DVec3;
use shadetrade::cli::options::BudgetOption;
use shadetrade::components::{
    Background, Light, LightKind, ShadingMode, Viewer, overwrite, viewer_mut,
};
use shadetrade::output::CANCELLED;
use shadetrade::output::Monitor;
use shadetrade::output::finished;
use shadetrade::output::json;
use shadetrade::questions::job::Drawing;
use shadetrade::questions::metrics::ErrorStatistics;
use shadetrade::questions::trade::timing::{MIN_SAMPLES, Timing};
use shadetrade::questions::trade::verdict::verdict;
use shadetrade::questions::trade::{
    self, Measured, Measurement, Report, Request, accuracy, batch, export, measure, plot,
};
use shadetrade::reference;
use shadetrade::scene::{Scene, SceneRecord};
use shadetrade::shading::{METHODS, Method};
use shadetrade::systems;
use shadetrade::systems::frame::{Frame, Keep, Workers};

use super::contract;

/// A request to measure the default scene after a change, as briefly as possible.
fn request(size: [usize; 2], threads: usize, change: impl Fn(&mut SceneRecord)) -> Request {
    let mut record = SceneRecord::of(&Scene::load(None).expect("it is built in").world);
    change(&mut record);
    let drawing = Drawing {
        scene: Scene::spawn("test".to_owned(), &record),
        size,
        threads,
        level: Level::new(),
    };
    Request {
        drawing,
        methods: METHODS.to_vec(),
        time: Duration::ZERO,
        is_report: true,
        must_fit: true,
    }
}

fn ordinary(size: [usize; 2], threads: usize) -> Request {
    request(size, threads, |_| ())
}

/// Measures, checks the properties of all reports, and reads the JSON.
fn measured(request: &Request) -> (Report, contract::Report) {
    let report = finished(trade::measure_report(
        request,
        batch::time_here,
        Monitor::NONE,
    ))
    .expect("it is measured");
    let text = json(&report).expect("it is written");
    let read = contract::read(&text);
    assert_eq!(read.size, request.drawing.size.map(|side| side as u64));
    assert_eq!(report.methods.len(), request.methods.len());
    for ((one, asked), read) in report
        .methods
        .iter()
        .zip(&request.methods)
        .zip(&read.methods)
    {
        assert_eq!((one.method, &*read.id), (*asked, asked.id));
        assert_eq!(read.threads, request.drawing.threads as u64);
        let samples = read.ms.as_ref().map(|it| it.samples);
        assert!(samples.is_none_or(|it| it >= MIN_SAMPLES));
    }
    let svg = plot::svg(&report).expect("it is drawn");
    for text in [text, export::table(&report), export::markdown(&report), svg] {
        let mut words = text.split(|c: char| !c.is_alphanumeric());
        assert!(!words.any(|word| ["NaN", "inf"].contains(&word)), "{text}");
    }
    (report, read)
}

#[test]
fn an_ordinary_view_gives_a_report_within_the_contract() {
    let (_, report) = measured(&ordinary([80, 60], 1));
    assert!(report.covered_pixels > 500);
    for one in &report.methods {
        let own = one.own_error.as_ref().map(|error| error.max);
        let limit = Some(one.tolerance.max(0.05));
        assert!(own <= limit, "{own:?} of {}", one.id);
    }
    let find = |id| report.methods.iter().find(|one| one.id == id);
    let found = ["phong-0", "gouraud-0", "phong-unit-vectors"].map(|id| find(id).expect(id));
    let errors = found.map(|one| one.error.as_ref().expect("it is compared"));
    assert!(errors[0].max < 0.05 && errors[1].max > 5.0 && errors[2].max > 5.0);
    let [exact, gouraud, shortcut] = found;
    assert!(exact.highlight_kept > Some(0.999) && shortcut.highlight_kept < Some(0.5));
    assert_eq!(gouraud.counts.model_evaluations, 8);
    assert_eq!(exact.counts.model_evaluations, report.covered_pixels);
}

#[test]
fn a_live_trade_has_the_errors_and_the_front_of_its_report() {
    let mut asked = ordinary([100, 80], 1);
    asked.methods.push(Method::of(ShadingMode::Phong, 3.0));
    let (report, _) = measured(&asked);
    let shares = Mutex::new(Vec::new());
    let progress = |step, share| shares.lock().expect("nobody panics").push((step, share));
    let monitor = Monitor {
        progress: &progress,
        ..Monitor::NONE
    };
    asked.is_report = false;
    let none = Measured::default();
    let seen = finished(measure(&asked, &none, batch::time_here, monitor));
    let seen = seen.expect("it is measured").methods;
    for (one, seen) in report.methods.iter().zip(&seen) {
        assert_eq!(seen.method, one.method);
        assert_eq!(seen.error, one.error);
        assert_eq!(seen.highlight_kept, one.highlight_kept, "{:?}", one.method);
        let is_timed = seen.timing.samples >= MIN_SAMPLES;
        assert_eq!(is_timed, seen.method.mode.is_drawn(), "{:?}", one.method);
    }
    assert!(seen.iter().any(|it| it.on_front));
    let shares = shares.into_inner().expect("nobody panics");
    for steps in shares.chunk_by(|one, next| one.0 == next.0) {
        let [(step, first), .., (_, last)] = steps else {
            panic!("{shares:?}");
        };
        assert!(*first < 0.2 && *last >= 0.99, "{step}: {steps:?}");
    }
}

#[test]
fn known_errors_and_the_timing_with_more_samples_are_kept() {
    let mut asked = ordinary([64, 48], 1);
    asked.methods.truncate(3);
    let measure = |known: &_, monitor| finished(measure(&asked, known, batch::time_here, monitor));
    let mut known = measure(&Measured::default(), Monitor::NONE).expect("it is measured");
    // Errors that no picture can have.
    let error = Some(ErrorStatistics {
        max: 1e3,
        ..ErrorStatistics::default()
    });
    for (index, samples) in [1_000_000, 1].into_iter().enumerate() {
        known.methods[index].error = error;
        known.methods[index].timing = Timing {
            samples,
            median: -1.0,
            ..Timing::default()
        };
    }
    known.methods.remove(2);
    let again = measure(&known, Monitor::NONE).expect("it is measured");
    let again = again.methods;
    assert_eq!(again[0].timing, known.methods[0].timing);
    assert!(again[1].timing.samples >= MIN_SAMPLES && again[1].timing.median > 0.0);
    let errors: Vec<_> = again.iter().map(|it| it.error).collect();
    assert_eq!(errors[..2], [error; 2]);
    assert!(errors[2].is_some_and(|error| error.max <= 255.0));
    let cancelled = Monitor {
        is_cancelled: &|| true,
        ..Monitor::NONE
    };
    let error = measure(&known, cancelled).expect_err("it is cancelled");
    assert_eq!(error.to_string(), CANCELLED);
}

#[test]
fn more_threads_change_only_times_and_a_method_is_measured_alike_without_others() {
    let mut alone = ordinary([64, 48], 2);
    alone.methods.retain(|it| it.id == "phong-0.5");
    let [(all, _), (alone, _)] = [ordinary([64, 48], 1), alone].map(|it| measured(&it));
    let mut of_all = all.methods.iter();
    let other = of_all.find(|it| it.method == alone.methods[0].method);
    let figures = |it: &Measurement| (it.counts, it.error, it.own_error);
    assert_eq!(other.map(figures), Some(figures(&alone.methods[0])));
}

/// A light that is off stays off.
#[test]
fn the_share_of_the_highlight_is_that_of_specular_light_alone_before_black() {
    let asked = |background: f64, tolerance| {
        let mut asked = request([160, 120], 1, |record| {
            let mut off = record.light[2].clone();
            assert_eq!(off.kind, LightKind::Specular);
            (off.name, off.on) = ("off".to_owned(), false);
            off.position = Some(DVec3::new(-5.0, 9.0, 20.0));
            record.light.push(off);
        });
        let background = Background(DVec3::splat(background));
        let world = &mut asked.drawing.scene.world;
        overwrite(world, &background);
        viewer_mut(world).tolerance = tolerance;
        asked
    };
    let mut lit = asked(0.0, 0.5).drawing;
    for light in lit.scene.world.query_mut::<&mut Light>() {
        light.on = light.kind == LightKind::Specular && light.on;
    }
    let view = lit.view();
    let phong = view.shaded(ShadingMode::Phong);
    let truth = finished(reference::picture(
        &lit.scene.world,
        &phong,
        0..120,
        Monitor::NONE,
    ));
    let truth = truth.expect("it is not cancelled");
    let mut frame = Frame::new(Keep::Levels, Workers::alone(Level::new()));
    let expected = METHODS.iter().map(|method| {
        let view = method.view(&view);
        if !method.mode.is_drawn() {
            let levels = crate::support::scene::truth(&lit.scene.world, &view).levels;
            let levels = levels.into_iter().map(|it| it.map(|level| level as f32));
            return accuracy::share_kept(levels, &truth.levels);
        }
        systems::draw(&mut lit.scene.world, &view, &mut frame).expect("a small picture fits");
        accuracy::share_kept(frame.levels().iter().copied(), &truth.levels)
    });
    let expected: Vec<_> = expected.collect();
    for (background, tolerance) in [(20.0, 0.5), (200.0, 255.0)] {
        let (report, _) = measured(&asked(background, tolerance));
        let kept: Vec<_> = report.methods.iter().map(|it| it.highlight_kept).collect();
        assert_eq!(kept, expected, "{background}, {tolerance}");
    }
}

#[test]
fn a_budget_on_the_command_line_replaces_the_tolerance_of_the_scene() {
    let mut drawing = request([1, 1], 1, |record| record.view.tolerance = 4.0).drawing;
    let budget = Some(2.0);
    BudgetOption { budget }.apply_to(&mut drawing);
    let view = SceneRecord::of(&drawing.scene.world).view;
    assert_eq!((view.tolerance, view.budget), (Viewer::TOLERANCE, budget));
}

#[test]
fn views_with_little_or_nothing_to_measure_have_a_report() {
    let away: fn(&mut SceneRecord) =
        |record| record.camera[0].target = DVec3::new(14.0, 10.0, 16.0);
    let (nothing, _) = measured(&request([32, 24], 1, away));
    assert_eq!(nothing.covered_pixels, 0);
    for one in &nothing.methods {
        assert_eq!(
            (one.largest_error(), one.ns_per_covered_pixel),
            (None, None)
        );
        assert!(!one.on_front);
    }
    assert_eq!(measured(&ordinary([1, 1], 1)).0.covered_pixels, 1);
    // What is not timed has its pixels, too.
    let mut by_reference = ordinary([1, 1], 1);
    by_reference.methods.retain(|it| !it.mode.is_drawn());
    assert_eq!(measured(&by_reference).0.covered_pixels, 1);
    // Without light or colour all methods draw the same black.
    let unlit: fn(&mut SceneRecord) = |record| record.light.clear();
    let black: fn(&mut SceneRecord) = |record| {
        let material = &mut record.cuboid[0].material;
        for color in [
            &mut material.ambient,
            &mut material.diffuse,
            &mut material.specular,
        ] {
            *color = DVec3::ZERO;
        }
    };
    for change in [unlit, black] {
        let (report, _) = measured(&request([32, 24], 1, change));
        assert!(report.covered_pixels > 0);
        for one in &report.methods {
            assert_eq!((one.largest_error(), one.highlight_kept), (Some(0.0), None));
        }
        let verdict = verdict(&report.methods);
        assert!(verdict.contains("off by 0 of 255"), "{verdict}");
    }
}

#[test]
fn grids_that_memory_cannot_hold_are_left_out_unless_they_were_asked_for() {
    // Their grids of 256 segments take 119 GB.
    let crowd = 25_000;
    let mut asked = request([16, 12], 1, |record| {
        let first = record.cuboid[0].clone();
        record.cuboid.extend((1..crowd).map(|number| {
            let mut other = first.clone();
            other.name = number.to_string();
            other.position.x += 1e3 * f64::from(number);
            other
        }));
    });
    let ids = ["flat", "gouraud-256x256-0.5", "phong-0.5"];
    asked.methods.retain(|it| ids.contains(&it.id));
    let time = async |request: &Request, _: usize, _: Monitor<'_>| {
        let times = request.timed().map(|it| {
            assert!(it.segments.is_none(), "it is not drawn");
            vec![1.0]
        });
        Ok(times.collect())
    };
    let measure = |asked: &Request| finished(trade::measure_report(asked, time, Monitor::NONE));
    let error = measure(&asked).expect_err("it was asked for").to_string();
    assert!(error.contains("the grids of 25000 cuboids"), "{error}");
    asked.must_fit = false;
    let report = measure(&asked).expect("the others are measured");
    let found: Vec<&str> = report.methods.iter().map(|it| it.method.id).collect();
    assert_eq!(found, [ids[0], ids[2]]);
    let [out] = &report.left_out[..] else {
        panic!("{report:?}");
    };
    assert_eq!((out.method.id, &out.reason), (ids[1], &error));
    contract::read(&json(&report).expect("it is written"));
}

#[test]
fn what_cannot_be_measured_or_written_is_an_error() {
    // Starts this test program, which does not know the option.
    let request = ordinary([16, 12], 1);
    let result = finished(measure(
        &request,
        &Measured::default(),
        batch::time_in_a_process,
        Monitor::NONE,
    ));
    let said = format!("{:#}", result.expect_err("it cannot"));
    assert!(
        said.contains("batch") && !said.contains("error: "),
        "{said}"
    );
    let parent = tempfile::tempdir().expect("there is room for a folder");
    // Per pixel: seven reference pictures of 28 bytes, a frame of 17, a list of errors of 8.
    let bytes = f64::from(196 + 17 + 8) * 2.0_f64.powi(48) / 1e6;
    let needed = format!(
        "cannot be compared: memory has no room for a picture of 16777216x16777216 pixels: {bytes:.0} MB are needed"
    );
    // Measuring the first picture would take long.
    for (side, folder, words) in [(4000, "missing/out", "missing"), (1 << 24, "out", &needed)] {
        let result = trade::run(&ordinary([side; 2], 1), Some(&parent.path().join(folder)));
        let message = format!("{:#}", result.expect_err("it cannot"));
        assert!(message.contains(words), "{message}");
    }
    assert_eq!(crate::cli::listing(&parent.path().join("out")), [""; 0]);
}
