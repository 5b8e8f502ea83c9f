//! Real measurements of small pictures: ordinary views, and views with little or nothing to measure.

use std::fs;
use std::sync::Mutex;

use fearless_simd::Level;
use glam::DVec3;
use shadetrade::components::{Background, Light, LightKind, ShadingMode, View, overwrite};
use shadetrade::frame::{Frame, Keep, Workers};
use shadetrade::reference;
use shadetrade::shading::{METHODS, Method};
use shadetrade::systems::{self, FRAME};
use shadetrade::trade::accuracy::share_kept;
use shadetrade::trade::front::on_front;
use shadetrade::trade::timing::Timing;
use shadetrade::trade::verdict::verdict;
use shadetrade::trade::{self, Measurement, Report, Request, export, live, plot};

use super::contract::{self, LADDER};
use super::requests::{CENTRE, GREEN, request, scene};

/// Measures, and checks the properties of all reports.
fn measured(request: Request) -> Report {
    let methods = request.methods.clone();
    let report = trade::measure(request, &|| false, &|_, _| ()).expect("it is measured");
    let text = export::json(&report).expect("it is written");
    contract::read(&text);
    let samples = report.methods.iter().map(|one| one.timing.samples);
    assert!(samples.min() >= Some(trade::MIN_SAMPLES));
    let measured: Vec<_> = report.methods.iter().map(|one| one.method).collect();
    assert_eq!(measured, methods);
    let stages = FRAME.map(|(name, _)| name);
    for one in &report.methods {
        let names: Vec<&str> = one.stages.iter().map(|(name, _)| *name).collect();
        assert_eq!(names, stages);
    }
    let svg = plot::svg(&report).expect("it is drawn");
    for text in [text, export::table(&report), export::markdown(&report), svg] {
        let words: Vec<&str> = text.split(|c: char| !c.is_alphanumeric()).collect();
        assert!(!words.contains(&"NaN") && !words.contains(&"inf"), "{text}");
    }
    report
}

#[test]
fn an_ordinary_view_gives_a_report_within_the_contract() {
    let report = measured(request(scene(GREEN, CENTRE, true), [80, 60], 1));
    assert!(report.covered_pixels > 500);
    let ids: Vec<&str> = report.methods.iter().map(|one| one.method.id).collect();
    assert!(LADDER.iter().all(|id| ids.contains(id)), "{ids:?}");
    for one in &report.methods {
        let own = one.accuracy.own_error.expect("it is compared");
        assert!(
            own.max <= one.method.tolerance.max(0.05),
            "{} errs by {}",
            one.method.id,
            own.max
        );
    }
    let find = |id| {
        report
            .methods
            .iter()
            .find(|one| one.method.id == id)
            .expect("it is measured")
    };
    let [exact, gouraud, shortcut] = ["phong-0", "gouraud-0", "phong-unit-vectors"].map(find);
    assert!(exact.max_error() < Some(0.05));
    assert!(gouraud.max_error() > Some(5.0));
    assert!(shortcut.max_error() > Some(5.0));
    assert!(exact.accuracy.highlight_kept > Some(0.999));
    assert!(shortcut.accuracy.highlight_kept < Some(0.5));
    assert!(exact.accuracy.error.flip_mean < gouraud.accuracy.error.flip_mean);
    assert_eq!(gouraud.counts.model_evaluations, 8);
    assert_eq!(exact.counts.model_evaluations, report.covered_pixels);
}

/// 300 rows are several bands, and the worst pixels are not in the first.
#[test]
fn a_live_trade_has_the_errors_and_the_front_of_its_report() {
    let asked = || {
        let mut asked = request(scene(GREEN, CENTRE, true), [100, 300], 1);
        asked.methods.push(Method::of(ShadingMode::Phong, 3.0));
        asked
    };
    let report = measured(asked());
    let shares = Mutex::new(Vec::new());
    let tell = |share| shares.lock().expect("nobody panics").push(share);
    let seen = live::measure(&asked(), &[], &|| false, &tell).expect("it is measured");
    for (one, seen) in report.methods.iter().map(Measurement::from).zip(&seen) {
        assert_eq!(seen.method, one.method);
        assert_eq!(seen.error, one.error, "{:?}", one.method);
        assert_eq!(seen.worst, one.worst, "{:?}", one.method);
        assert_eq!(seen.highlight_kept, one.highlight_kept, "{:?}", one.method);
        assert!(seen.timing.samples >= trade::MIN_SAMPLES);
    }
    let fronts = seen.iter().map(|it| it.on_front);
    assert_eq!(fronts.collect::<Vec<_>>(), on_front(&seen));
    let shares = shares.into_inner().expect("nobody panics");
    assert!(
        shares.is_sorted() && shares.last() == Some(&1.0),
        "{shares:?}"
    );
}

#[test]
fn known_errors_are_kept_and_the_timing_with_more_samples_is_kept() {
    let mut asked = request(scene(GREEN, CENTRE, true), [64, 48], 1);
    asked.methods.truncate(3);
    let mut known = live::measure(&asked, &[], &|| false, &|_| ()).expect("it is measured");
    known[0].timing = Timing {
        samples: 1_000_000,
        ..known[0].timing.clone()
    };
    known[1].timing = Timing {
        samples: 1,
        median: -1.0,
        ..known[1].timing.clone()
    };
    // Errors that no picture can have.
    known[0].error = Some(1e3);
    known[1].error = Some(2e3);
    known.remove(2);
    let again = live::measure(&asked, &known, &|| false, &|_| ()).expect("it is measured");
    assert_eq!(again[0].timing, known[0].timing);
    assert!(again[1].timing.samples >= trade::MIN_SAMPLES && again[1].timing.median > 0.0);
    let errors: Vec<_> = again.iter().map(|it| it.error).collect();
    assert_eq!(errors[..2], [Some(1e3), Some(2e3)]);
    assert!(errors[2].is_some_and(|error| error <= 255.0));
    let cancelled = live::measure(&asked, &known, &|| true, &|_| ());
    assert!(matches!(cancelled, Err(trade::TradeError::Cancelled)));
}

#[test]
fn only_the_methods_asked_for_are_measured() {
    let mut few = request(scene(GREEN, CENTRE, true), [32, 24], 1);
    few.methods
        .retain(|method| ["phong-0.5", "gouraud-0"].contains(&method.id));
    let report = measured(few);
    assert_eq!(report.methods.len(), 2);
    // Errors are against exact Phong, even if that is not measured.
    assert!(report.methods[0].max_error() > Some(5.0));
    assert!(report.methods[1].max_error() <= Some(0.5));
}

#[test]
fn more_threads_change_only_times() {
    let [one, two] =
        [1, 2].map(|threads| measured(request(scene(GREEN, CENTRE, true), [64, 48], threads)));
    for (one, two) in one.methods.iter().zip(&two.methods) {
        assert_eq!([one.threads, two.threads], [1, 2]);
        assert_eq!(one.counts, two.counts);
        assert_eq!(one.accuracy.error, two.accuracy.error);
        assert_eq!(one.accuracy.own_error, two.accuracy.own_error);
        assert_eq!(one.accuracy.map, two.accuracy.map);
    }
}

#[test]
fn the_share_of_the_highlight_does_not_depend_on_background_or_view_tolerance() {
    let kept = |background: f64, tolerance: f64| {
        let mut scene = scene(GREEN, CENTRE, true);
        overwrite(&mut scene.world, &Background(DVec3::splat(background)));
        let mut request = request(scene, [64, 48], 1);
        request.view.tolerance = tolerance;
        measured(request)
            .methods
            .iter()
            .map(|one| one.accuracy.highlight_kept)
            .collect::<Vec<_>>()
    };
    let expected = kept(0.0, 0.0);
    assert_eq!(kept(200.0, 0.0), expected);
    assert_eq!(kept(0.0, 255.0), expected);
}

#[test]
fn the_share_of_the_highlight_is_measured_against_the_reference() {
    let request = || request(scene(GREEN, CENTRE, true), [320, 240], 1);
    let trade::Request {
        scene: mut lit,
        view: asked,
        ..
    } = request();
    for light in lit.world.query_mut::<&mut Light>() {
        light.on = light.kind == LightKind::Specular;
    }
    let view = |mode, tolerance| View {
        background: DVec3::ZERO,
        shading: Some(mode),
        tolerance,
        ..asked.clone()
    };
    let phong = view(ShadingMode::Phong, 0.0);
    let truth = reference::picture(&lit.world, &phong, 0..240, &|| false, &|_| ())
        .expect("it is not cancelled");
    let mut frame = Frame::new(Keep::Levels, Workers::alone(Level::new()));
    let expected = METHODS.iter().map(|method| {
        let view = view(method.mode, method.tolerance);
        systems::draw(&mut lit.world, &view, &mut frame).expect("a small picture fits");
        share_kept(frame.levels(), &truth.levels)
    });
    let expected: Vec<_> = expected.collect();
    let report = measured(request());
    let kept = report.methods.iter();
    assert_eq!(
        kept.map(|one| one.accuracy.highlight_kept)
            .collect::<Vec<_>>(),
        expected
    );
}

#[test]
fn a_view_past_everything_has_no_errors_and_no_front() {
    let report = measured(request(scene(GREEN, "[14, 10, 16]", true), [32, 24], 1));
    assert_eq!(report.covered_pixels, 0);
    assert!(
        report
            .methods
            .iter()
            .all(|one| one.max_error().is_none() && !one.on_front)
    );
}

#[test]
fn a_picture_of_one_pixel_is_measured() {
    let report = measured(request(scene(GREEN, CENTRE, true), [1, 1], 1));
    assert_eq!(report.covered_pixels, 1);
}

#[test]
fn without_light_or_colour_all_methods_draw_the_same_black() {
    for dark in [
        scene(GREEN, CENTRE, false),
        scene("[0, 0, 0]", CENTRE, true),
    ] {
        let report = measured(request(dark, [32, 24], 1));
        assert!(report.covered_pixels > 0);
        for one in &report.methods {
            assert_eq!(one.max_error(), Some(0.0), "{}", one.method.id);
            assert_eq!(one.accuracy.highlight_kept, None, "{}", one.method.id);
        }
        let measured: Vec<Measurement> = report.methods.iter().map(Measurement::from).collect();
        let verdict = verdict(&measured);
        assert!(verdict.contains("off by 0 of 255"), "{verdict}");
    }
}

#[test]
fn progress_runs_from_0_to_1_in_two_steps() {
    let told: Mutex<Vec<(&str, f64)>> = Mutex::default();
    let on_progress = |step, share| {
        let mut told = told.lock().expect("no thread has panicked");
        told.push((step, share));
    };
    let request = request(scene(GREEN, CENTRE, true), [16, 12], 1);
    trade::measure(request, &|| false, &on_progress).expect("it is measured");
    let told = told.into_inner().expect("no thread has panicked");
    let mut shares = told.iter().map(|(_, share)| share);
    assert!(shares.all(|share| (0.0..=1.0).contains(share)));
    let mut steps: Vec<_> = told.iter().map(|(step, _)| *step).collect();
    steps.dedup();
    assert_eq!(steps.len(), 2);
    assert_eq!(told.last().map(|(_, share)| *share), Some(1.0));
}

#[test]
fn a_process_that_cannot_measure_is_an_error_with_its_message() {
    let request = Request {
        // Starts this test program, which does not know the option.
        time_batch: trade::process::in_a_process,
        ..request(scene(GREEN, CENTRE, true), [16, 12], 1)
    };
    let error = trade::measure(request, &|| false, &|_, _| ()).expect_err("it cannot");
    let said = format!("{:#}", anyhow::Error::from(error));
    assert!(said.contains("batch"), "{said}");
}

#[test]
fn all_files_and_no_others_are_written() {
    let parent = tempfile::tempdir().expect("there is room for a folder");
    let folder = parent.path().join("out");
    fs::create_dir(&folder).expect("a folder can be made in it");
    let report = measured(request(scene(GREEN, CENTRE, true), [24, 18], 1));
    for _ in 0..2 {
        // Existing files are replaced.
        trade::write_files(&report, &folder).expect("it is written");
    }
    let mut found: Vec<String> = fs::read_dir(&folder)
        .expect("the folder was made")
        .map(|entry| {
            entry
                .expect("it can be listed")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    let maps = METHODS
        .iter()
        .map(|method| format!("error-{}.png", method.id));
    let mut expected: Vec<String> = ["json", "md", "svg"]
        .map(|kind| format!("trade.{kind}"))
        .into_iter()
        .chain(maps)
        .collect();
    found.sort();
    expected.sort();
    assert_eq!(found, expected);
    contract::read(&fs::read_to_string(folder.join("trade.json")).expect("it can be read"));
}

#[test]
fn a_folder_that_cannot_be_created_is_reported_before_measuring() {
    let parent = tempfile::tempdir().expect("there is room for a folder");
    let folder = parent.path().join("missing").join("out");
    // Measuring a picture of this size would take long.
    let result = trade::run(
        request(scene(GREEN, CENTRE, true), [4000, 4000], 1),
        Some(&folder),
    );
    let message = format!("{:#}", result.expect_err("there is no parent"));
    assert!(message.contains("missing"), "{message}");
}

#[test]
fn a_picture_too_large_for_memory_is_an_error_and_leaves_an_empty_folder() {
    let parent = tempfile::tempdir().expect("there is room for a folder");
    let folder = parent.path().join("out");
    let huge = request(scene(GREEN, CENTRE, true), [1 << 24, 1 << 24], 1);
    let error = trade::run(huge, Some(&folder)).expect_err("no machine holds it");
    let message = format!("{error:#}");
    // Per pixel: three reference pictures of 28 bytes, a frame of 25, two error maps of 16, and one byte for the map of
    // each method.
    let bytes = (84 + 25 + 32 + METHODS.len()) as f64 * 2.0_f64.powi(48);
    let expected = format!(
        "the methods cannot be compared: a picture of 16777216x16777216 pixels does not fit in memory: it takes {:.0} MB",
        bytes / 1e6
    );
    assert!(message.starts_with(&expected), "{message}");
    let left = fs::read_dir(&folder).expect("the folder was made");
    assert_eq!(left.count(), 0);
}
