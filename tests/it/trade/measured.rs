//! Real measurements of small pictures: ordinary views, and views with little or nothing to measure.

use std::fs;
use std::sync::Mutex;

use fearless_simd::Level;
use glam::DVec3;
use shadetrade::components::{Background, Light, LightKind, ShadingMode, View, overwrite};
use shadetrade::frame::{Frame, Keep, Workers};
use shadetrade::output::json;
use shadetrade::reference;
use shadetrade::report::Monitor;
use shadetrade::shading::{METHODS, Method};
use shadetrade::systems;
use shadetrade::trade::measurement::on_front;
use shadetrade::trade::timing::{MIN_SAMPLES, Timing};
use shadetrade::trade::verdict::verdict;
use shadetrade::trade::{self, Report, Request, accuracy, batch, export, live, plot};

use super::contract;
use super::requests::{CENTRE, GREEN, request, scene};

/// Measures, and checks the properties of all reports.
fn measured(request: &Request) -> Report {
    let report = trade::measure(request, batch::time_here, Monitor::NONE).expect("it is measured");
    let text = json(&report).expect("it is written");
    contract::read(&text);
    let samples = report.methods.iter().map(|one| one.timing.samples);
    assert!(samples.min() >= Some(MIN_SAMPLES));
    let measured: Vec<_> = report.methods.iter().map(|one| one.method).collect();
    assert_eq!(measured, request.methods);
    let svg = plot::svg(&report).expect("it is drawn");
    for text in [text, export::table(&report), export::markdown(&report), svg] {
        let words: Vec<&str> = text.split(|c: char| !c.is_alphanumeric()).collect();
        assert!(!words.contains(&"NaN") && !words.contains(&"inf"), "{text}");
    }
    report
}

/// A request for the ordinary view.
fn ordinary(size: [usize; 2], threads: usize) -> Request {
    request(scene(GREEN, CENTRE, true), size, threads)
}

#[test]
fn an_ordinary_view_gives_a_report_within_the_contract() {
    let report = measured(&ordinary([80, 60], 1));
    assert!(report.covered_pixels > 500);
    for one in &report.methods {
        let own = one.accuracy.own_error.expect("it is compared");
        let limit = one.method.tolerance.max(0.05);
        assert!(own.max <= limit, "{} errs by {}", one.method.id, own.max);
    }
    let find = |id| report.methods.iter().find(|one| one.method.id == id);
    let found = ["phong-0", "gouraud-0", "phong-unit-vectors"].map(|id| find(id).expect(id));
    let [exact, gouraud, shortcut] = found;
    assert!(exact.max_error() < Some(0.05));
    assert!(gouraud.max_error() > Some(5.0));
    assert!(shortcut.max_error() > Some(5.0));
    assert!(exact.accuracy.highlight_kept > Some(0.999));
    assert!(shortcut.accuracy.highlight_kept < Some(0.5));
    let flip = [exact, gouraud].map(|one| one.accuracy.error.map(|error| error.flip_mean));
    assert!(flip[0] < flip[1]);
    assert_eq!(gouraud.counts.model_evaluations, 8);
    assert_eq!(exact.counts.model_evaluations, report.covered_pixels);
    let time = gouraud.timing.median * 1e6 / report.covered_pixels as f64;
    assert_eq!(gouraud.ns_per_covered_pixel, Some(time));
}

/// 300 rows are several bands, and the worst pixels are not in the first.
#[test]
fn a_live_trade_has_the_errors_and_the_front_of_its_report() {
    let mut asked = ordinary([100, 300], 1);
    asked.methods.push(Method::of(ShadingMode::Phong, 3.0));
    let report = measured(&asked);
    let shares = Mutex::new(Vec::new());
    let progress = |_, share| shares.lock().expect("nobody panics").push(share);
    let monitor = Monitor {
        progress: &progress,
        ..Monitor::NONE
    };
    let seen = live::measure(&asked, &[], monitor).expect("it is measured");
    for (one, seen) in report.measurements().iter().zip(&seen) {
        assert_eq!(seen.method, one.method);
        assert_eq!(seen.error, one.error, "{:?}", one.method);
        assert_eq!(seen.worst, one.worst, "{:?}", one.method);
        assert_eq!(seen.highlight_kept, one.highlight_kept, "{:?}", one.method);
        assert!(seen.timing.samples >= MIN_SAMPLES);
    }
    let fronts = seen.iter().map(|it| it.on_front);
    assert_eq!(fronts.collect::<Vec<_>>(), on_front(&seen));
    let shares = shares.into_inner().expect("nobody panics");
    let [least, most] = [shares.first(), shares.last()];
    assert!(
        shares.is_sorted() && least < Some(&0.2) && most == Some(&1.0),
        "{shares:?}"
    );
}

#[test]
fn known_errors_and_the_timing_with_more_samples_are_kept() {
    let mut asked = ordinary([64, 48], 1);
    asked.methods.truncate(3);
    let measure = |known: &[_], monitor| live::measure(&asked, known, monitor);
    let mut known = measure(&[], Monitor::NONE).expect("it is measured");
    // Errors that no picture can have.
    for (index, samples) in [1_000_000, 1].into_iter().enumerate() {
        known[index].error = Some(1e3);
        known[index].timing = Timing {
            samples,
            median: -1.0,
            ..Timing::default()
        };
    }
    known.remove(2);
    let again = measure(&known, Monitor::NONE).expect("it is measured");
    assert_eq!(again[0].timing, known[0].timing);
    assert!(again[1].timing.samples >= MIN_SAMPLES && again[1].timing.median > 0.0);
    let errors: Vec<_> = again.iter().map(|it| it.error).collect();
    assert_eq!(errors[..2], [Some(1e3); 2]);
    assert!(errors[2].is_some_and(|error| error <= 255.0));
    let cancelled = Monitor {
        is_cancelled: &|| true,
        ..Monitor::NONE
    };
    measure(&known, cancelled).expect_err("it is cancelled");
}

#[test]
fn more_threads_change_only_times_and_a_method_is_measured_alike_without_others() {
    let mut alone = ordinary([64, 48], 2);
    alone
        .methods
        .retain(|it| ["phong-0.5", "gouraud-0"].contains(&it.id));
    let [all, alone] = [ordinary([64, 48], 1), alone].map(|it| measured(&it));
    assert_eq!(alone.methods.len(), 2);
    for other in &alone.methods {
        let mut all = all.methods.iter();
        let one = all
            .find(|it| it.method == other.method)
            .expect("it is measured");
        assert_eq!([one.threads, other.threads], [1, 2]);
        assert_eq!(one.counts, other.counts);
        assert_eq!(one.accuracy.error, other.accuracy.error);
        assert_eq!(one.accuracy.own_error, other.accuracy.own_error);
        assert!(one.accuracy.map == other.accuracy.map);
    }
}

#[test]
fn the_share_of_the_highlight_is_that_of_specular_light_alone_before_black() {
    let asked = ordinary([160, 120], 1);
    let mut lit = asked.scene.snapshot();
    for light in lit.world.query_mut::<&mut Light>() {
        light.on = light.kind == LightKind::Specular;
    }
    let view = |mode, tolerance| View {
        background: DVec3::ZERO,
        shading: Some(mode),
        tolerance,
        ..asked.view.clone()
    };
    let phong = view(ShadingMode::Phong, 0.0);
    let truth = reference::picture(&lit.world, &phong, 0..120, &|| false, &|_| ());
    let truth = truth.expect("it is not cancelled");
    let mut frame = Frame::new(Keep::Levels, Workers::alone(Level::new()));
    let expected = METHODS.iter().map(|method| {
        let view = view(method.mode, method.tolerance);
        systems::draw(&mut lit.world, &view, &mut frame).expect("a small picture fits");
        accuracy::share(accuracy::light_kept(frame.levels(), &truth.levels))
    });
    let expected: Vec<_> = expected.collect();
    for (background, tolerance) in [(20.0, 0.5), (200.0, 255.0)] {
        let mut asked = ordinary([160, 120], 1);
        overwrite(
            &mut asked.scene.world,
            &Background(DVec3::splat(background)),
        );
        asked.view = View::of(&asked.scene.world, [160, 120]).with_tolerance(tolerance);
        let report = measured(&asked);
        let kept = report.methods.iter().map(|one| one.accuracy.highlight_kept);
        assert_eq!(
            kept.collect::<Vec<_>>(),
            expected,
            "{background}, {tolerance}"
        );
    }
}

#[test]
fn views_with_little_or_nothing_to_measure_have_a_report() {
    let nothing = measured(&request(scene(GREEN, "[14, 10, 16]", true), [32, 24], 1));
    assert_eq!(nothing.covered_pixels, 0);
    let is_off = |one: &trade::MethodReport| one.max_error().is_none() && !one.on_front;
    assert!(nothing.methods.iter().all(is_off));
    assert_eq!(measured(&ordinary([1, 1], 1)).covered_pixels, 1);
    // Without light or colour all methods draw the same black.
    for (color, is_lit) in [(GREEN, false), ("[0, 0, 0]", true)] {
        let report = measured(&request(scene(color, CENTRE, is_lit), [32, 24], 1));
        assert!(report.covered_pixels > 0);
        for one in &report.methods {
            assert_eq!(one.max_error(), Some(0.0), "{}", one.method.id);
            assert_eq!(one.accuracy.highlight_kept, None, "{}", one.method.id);
        }
        let verdict = verdict(&report.measurements());
        assert!(verdict.contains("off by 0 of 255"), "{verdict}");
    }
}

#[test]
fn progress_runs_from_0_to_1_in_two_steps() {
    let told: Mutex<Vec<(&str, f64)>> = Mutex::default();
    let progress = |step, share| told.lock().expect("nobody panics").push((step, share));
    let monitor = Monitor {
        progress: &progress,
        ..Monitor::NONE
    };
    let request = ordinary([16, 12], 1);
    trade::measure(&request, batch::time_here, monitor).expect("it is measured");
    let told = told.into_inner().expect("nobody panics");
    let mut shares = told.iter().map(|(_, share)| share);
    assert!(shares.all(|share| (0.0..=1.0).contains(share)));
    let mut steps: Vec<_> = told.iter().map(|(step, _)| *step).collect();
    steps.dedup();
    assert_eq!(steps.len(), 2);
    assert_eq!(told.last().map(|(_, share)| *share), Some(1.0));
}

#[test]
fn a_process_that_cannot_measure_is_an_error_with_its_message() {
    // Starts this test program, which does not know the option.
    let request = ordinary([16, 12], 1);
    let result = trade::measure(&request, batch::time_in_a_process, Monitor::NONE);
    let said = format!("{:#}", result.expect_err("it cannot"));
    assert!(said.contains("batch"), "{said}");
}

#[test]
fn what_cannot_be_measured_or_written_is_an_error_before_measuring() {
    let parent = tempfile::tempdir().expect("there is room for a folder");
    let error = |size, folder: &str| {
        let folder = parent.path().join(folder);
        let result = trade::run(&ordinary(size, 1), Some(&folder));
        format!("{:#}", result.expect_err("it cannot"))
    };
    // Measuring a picture of this size would take long.
    let message = error([4000, 4000], "missing/out");
    assert!(message.contains("missing"), "{message}");
    let message = error([1 << 24, 1 << 24], "out");
    // Per pixel: three reference pictures of 28 bytes, a frame of 25, two lists of errors of 16, and a map of 4 for each
    // method.
    let bytes = (84 + 25 + 32 + 4 * METHODS.len()) as f64 * 2.0_f64.powi(48) / 1e6;
    for part in ["cannot be compared", &format!("it takes {bytes:.0} MB")] {
        assert!(message.contains(part), "{message}");
    }
    let left = fs::read_dir(parent.path().join("out")).expect("the folder was made");
    assert_eq!(left.count(), 0);
}
