//! Real measurements of small pictures: an ordinary view, and views with little or nothing to measure.

use std::sync::Mutex;
use std::time::Duration;

use shadetrade::cli::options::BudgetOption;
use shadetrade::components::ShadingMode::Phong;
use shadetrade::output::{CANCELLED, json};
use shadetrade::questions::job::Drawing;
use shadetrade::questions::metrics::ErrorStatistics;
use shadetrade::questions::trade::timing::{MIN_SAMPLES, Timing};
use shadetrade::questions::trade::verdict::verdict;
use shadetrade::questions::trade::{
    self, Measured, Measurement, Report, Request, accuracy, batch, export, measure, plot,
};
use shadetrade::shading::METHODS;

use super::contract;
use crate::support::prelude::*;

/// A request to measure the default scene after a change, as briefly as possible.
fn request(size: [usize; 2], threads: usize, change: impl FnOnce(&mut SceneRecord)) -> Request {
    Request {
        drawing: Drawing {
            scene: changed(change),
            size,
            threads,
            level: Level::new(),
        },
        methods: METHODS.to_vec(),
        time: Duration::ZERO,
        is_report: true,
    }
}

fn ordinary(size: [usize; 2]) -> Request {
    request(size, 1, |_| ())
}

/// Measures, and checks the properties of all reports.
fn measured(request: &Request) -> Report {
    let report = done(trade::measure_report(
        request,
        batch::time_here,
        Monitor::NONE,
    ));
    let text = json(&report).expect("it is written");
    contract::read(&text);
    assert_eq!(report.heading.size, request.drawing.size);
    let measured: Vec<Method> = report.methods.iter().map(|it| it.method).collect();
    assert_eq!(measured, request.methods);
    for one in &report.methods {
        assert_eq!(one.threads, request.drawing.threads);
        let samples = one.timing.samples;
        assert!(samples >= MIN_SAMPLES || !one.method.mode.is_drawn());
    }
    let svg = plot::svg(&report).expect("it is drawn");
    for text in [text, export::table(&report), export::markdown(&report), svg] {
        let mut words = text.split(|c: char| !c.is_alphanumeric());
        assert!(!words.any(|word| ["NaN", "inf"].contains(&word)), "{text}");
    }
    report
}

#[test]
fn an_ordinary_view_has_a_report_and_its_live_trade_the_same_errors() {
    let mut asked = ordinary([100, 80]);
    asked.methods.push(Method::of(Phong, 3.0));
    let report = measured(&asked);
    assert!(report.covered_pixels > 500);
    for one in &report.methods {
        let own = one.own_error.map(|error| error.max);
        let limit = Some(one.method.tolerance.max(0.05));
        assert!(own <= limit, "{own:?} of {:?}", one.method);
    }
    let find = |id| report.methods.iter().find(|it| it.method.id == id);
    let found = ["phong-0", "gouraud-0", "phong-unit-vectors", "phong-0.5"];
    let [exact, gouraud, shortcut, half] = found.map(|id| find(id).expect(id));
    assert!(exact.largest_error() < Some(0.05) && gouraud.largest_error() > Some(5.0));
    assert!(shortcut.largest_error() > Some(5.0) && shortcut.highlight_kept < Some(0.5));
    assert!(exact.highlight_kept > Some(0.999));
    assert_eq!(gouraud.counts.model_evaluations, 8);
    assert_eq!(exact.counts.model_evaluations, report.covered_pixels);
    // More threads change only times, and a method is measured alike without others.
    let mut alone = request([100, 80], 2, |_| ());
    alone.methods = vec![half.method];
    let figures = |it: &Measurement| (it.counts, it.error, it.own_error);
    assert_eq!(figures(&measured(&alone).methods[0]), figures(half));

    asked.is_report = false;
    let shares = Mutex::new(Vec::new());
    let progress = |step, share| shares.lock().expect("nobody panics").push((step, share));
    let monitor = Monitor {
        progress: &progress,
        ..Monitor::NONE
    };
    let none = Measured::default();
    let seen = done(measure(&asked, &none, batch::time_here, monitor)).methods;
    for (one, seen) in report.methods.iter().zip(&seen) {
        assert_eq!((seen.method, seen.error), (one.method, one.error));
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
    let mut asked = ordinary([64, 48]);
    asked.methods.truncate(3);
    let measure = |known: &_, monitor| finished(measure(&asked, known, batch::time_here, monitor));
    let mut known = measure(&Measured::default(), Monitor::NONE).expect("it is measured");
    // Errors that no picture can have.
    let error = Some(ErrorStatistics {
        max: 1e3,
        ..ErrorStatistics::default()
    });
    for (one, samples) in known.methods.iter_mut().zip([1_000_000, 1]) {
        one.error = error;
        one.timing = Timing {
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
    assert_eq!([again[0].error, again[1].error], [error; 2]);
    assert!(again[2].largest_error().is_some_and(|error| error <= 255.0));
    let error = measure(&known, CANCEL).expect_err("it is cancelled");
    assert_eq!(error.to_string(), CANCELLED);
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
        let world = &mut asked.drawing.scene.world;
        overwrite(world, &Background(DVec3::splat(background)));
        viewer_mut(world).tolerance = tolerance;
        asked
    };
    let lit = asked(0.0, 0.5).drawing;
    let view = lit.view();
    let mut world = lit.scene.world;
    for light in world.query_mut::<&mut Light>() {
        light.on = light.kind == LightKind::Specular && light.on;
    }
    let exact = truth(&world, &view.shaded(Phong)).levels;
    let expected = METHODS.iter().map(|method| {
        let view = method.view(&view);
        let levels = if method.mode.is_drawn() {
            let frame = draw(&mut world, &view, Keep::Levels);
            let levels = frame.levels().iter().map(|it| it.map(f64::from));
            levels.collect()
        } else {
            truth(&world, &view).levels
        };
        accuracy::share_kept(&levels, &exact)
    });
    let expected: Vec<_> = expected.collect();
    for (background, tolerance) in [(20.0, 0.5), (200.0, 255.0)] {
        let report = measured(&asked(background, tolerance));
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
    let away = |record: &mut SceneRecord| record.camera[0].target = DVec3::new(14.0, 10.0, 16.0);
    let nothing = measured(&request([32, 24], 1, away));
    assert_eq!(nothing.covered_pixels, 0);
    for one in &nothing.methods {
        let figures = (one.largest_error(), one.ns_per_covered_pixel);
        assert_eq!((figures, one.on_front), ((None, None), false));
    }
    assert_eq!(measured(&ordinary([1, 1])).covered_pixels, 1);
    // What is not timed has its pixels, too.
    let mut by_reference = ordinary([1, 1]);
    by_reference.methods.retain(|it| !it.mode.is_drawn());
    assert_eq!(measured(&by_reference).covered_pixels, 1);
    // Without light or colour all methods draw the same black.
    let unlit: fn(&mut SceneRecord) = |record| record.light.clear();
    let black: fn(&mut SceneRecord) = |record| {
        record.cuboid[0].material = grey([0.0; 3], 1.0);
    };
    for change in [unlit, black] {
        let report = measured(&request([32, 24], 1, change));
        assert!(report.covered_pixels > 0);
        for one in &report.methods {
            assert_eq!((one.largest_error(), one.highlight_kept), (Some(0.0), None));
        }
        let verdict = verdict(&report.methods);
        assert!(verdict.contains("off by 0 of 255"), "{verdict}");
    }
}

#[test]
fn grids_that_memory_cannot_hold_are_left_out() {
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
    let report = finished(trade::measure_report(&asked, time, Monitor::NONE));
    let report = report.expect("the others are measured");
    let found: Vec<&str> = report.methods.iter().map(|it| it.method.id).collect();
    assert_eq!(found, [ids[0], ids[2]]);
    let read = contract::read(&json(&report).expect("it is written"));
    let [out] = &read["left_out"].as_array().expect("a list")[..] else {
        panic!("{report:?}");
    };
    assert_eq!(
        (&out["id"], &out["mode"]),
        (&ids[1].into(), &"gouraud".into())
    );
    assert_eq!(
        (&out["segments"], &out["tolerance"]),
        (&256.into(), &0.5.into())
    );
    let reason = out["reason"].as_str().expect("words");
    assert!(reason.contains("the grids of 25000 cuboids"), "{reason}");
}

#[test]
fn what_cannot_be_measured_or_written_is_an_error() {
    // Starts this test program, which does not know the option.
    let (request, none) = (ordinary([16, 12]), Measured::default());
    let work = measure(&request, &none, batch::time_in_a_process, Monitor::NONE);
    let said = format!("{:#}", finished(work).expect_err("it cannot"));
    assert!(
        said.contains("batch") && !said.contains("error: "),
        "{said}"
    );
    let parent = tempfile::tempdir().expect("there is room for a folder");
    // Per pixel: five pictures of 28 bytes, rows of 32, a frame of 17, a list of errors of 8.
    let bytes = f64::from(140 + 32 + 17 + 8) * 2.0_f64.powi(48) / 1e6;
    let needed = format!(
        "cannot be compared: memory has no room for a picture of 16777216x16777216 pixels: {bytes:.0} MB are needed"
    );
    // Measuring the first picture would take long.
    for (side, folder, words) in [(4000, "missing/out", "missing"), (1 << 24, "out", &needed)] {
        let result = trade::run(&ordinary([side; 2]), Some(&parent.path().join(folder)));
        let message = format!("{:#}", result.expect_err("it cannot"));
        assert!(message.contains(words), "{message}");
    }
    assert_eq!(crate::cli::listing(&parent.path().join("out")), [""; 0]);
}
