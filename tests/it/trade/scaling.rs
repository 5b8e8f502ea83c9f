//! Scaling: exponents and costs of times that follow a known law, and what is printed and written of them.

use serde_json::{Value, json};
use shadetrade::trade::scale::growth::power;
use shadetrade::trade::scale::{METHODS, Point, Quantity, Scaling, Series, Times, measure, report};
use shadetrade::trade::timing::Timing;
use shadetrade::trade::{Request, TradeError, export};

use super::requests::GREEN;
use super::{example, requests};

/// A timing whose least time is `ms`, and whose median tells something else.
fn least(ms: f64) -> Timing {
    Timing {
        min: ms,
        ..example::timing(3.0 * ms + 1.0)
    }
}

/// A quantity at these numbers, where method `m` of two takes `law(number, m)` milliseconds.
fn series(quantity: Quantity, numbers: &[usize], law: impl Fn(f64, usize) -> f64) -> Series {
    let times = |number: usize, method: usize| Times {
        id: ["gouraud-0.5", "phong-0"][method],
        timing: least(law(number as f64, method)),
        cost: None,
    };
    let point = |&number: &usize| Point {
        number,
        size: [number, 10],
        threads: if quantity == Quantity::Threads {
            number
        } else {
            1
        },
        covered_pixels: 1000 * number as u64,
        methods: vec![times(number, 0), times(number, 1)],
    };
    Series::new(quantity, numbers.iter().map(point).collect())
}

fn scaling(series: Vec<Series>) -> Scaling {
    Scaling {
        subject: example::subject("shadetrade trade --scale"),
        series,
    }
}

/// Pixels at a nanosecond each and two; lights that cost Gouraud nothing; quadratic cuboids; threads that help by half.
fn example() -> Scaling {
    scaling(vec![
        series(Quantity::Pixels, &[1, 4, 16, 64], |pixels, method| {
            (method + 1) as f64 * 1e-3 * pixels
        }),
        series(Quantity::Lights, &[1, 2, 4, 8], |lights, method| {
            if method == 0 { 3.0 } else { lights }
        }),
        series(Quantity::Cuboids, &[1, 10, 100, 1000], |cuboids, method| {
            if method == 0 {
                1.0 + cuboids
            } else {
                cuboids * cuboids
            }
        }),
        series(Quantity::Threads, &[1, 2, 4], |threads, method| {
            if method == 0 {
                8.0 / threads
            } else {
                8.0 / threads.sqrt()
            }
        }),
    ])
}

#[track_caller]
fn assert_near(found: Option<f64>, expected: f64) {
    let found = found.expect("there is a figure");
    assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
}

#[test]
fn the_exponent_of_a_power_is_its_exponent_without_error() {
    for exponent in [-0.5, 0.0, 1.0, 2.0] {
        let points = [1.0, 3.0, 10.0, 700.0].map(|x: f64| [x, 0.37 * x.powf(exponent)]);
        let [found, error] = power(&points);
        assert_near(found, exponent);
        assert_near(error, 0.0);
    }
}

#[test]
fn the_standard_error_is_the_one_computed_by_hand() {
    // Logarithms (0, 0), (1, 2), (2, 2): slope 1, residuals -1/3, 2/3, -1/3; SSE 2/3, one degree of freedom, Sxx 2.
    let e = std::f64::consts::E;
    let [exponent, error] = power(&[[1.0, 1.0], [e, e * e], [e * e, e * e]]);
    assert_near(exponent, 1.0);
    assert_near(error, (1.0_f64 / 3.0).sqrt());
    // A line meets two points whatever they are.
    let [exponent, error] = power(&[[1.0, 1.0], [e, e * e]]);
    assert_near(exponent, 2.0);
    assert_eq!(error, None);
}

#[test]
fn there_is_no_exponent_where_nothing_varies_or_the_clock_saw_nothing() {
    for points in [
        &[][..],
        &[[2.0, 1.0]],
        &[[2.0, 1.0], [2.0, 3.0], [2.0, 4.0]],
        &[[1.0, 0.0], [2.0, 3.0]],
    ] {
        assert_eq!(power(points), [None; 2], "{points:?}");
    }
}

#[test]
fn what_a_frame_costs_anyway_does_not_blur_the_exponent() {
    // Ten milliseconds and one a light: the lower half of the range would be nearly flat.
    let numbers = [1, 2, 4, 1000, 10_000, 100_000];
    let series = series(Quantity::Lights, &numbers, |lights, _| 10.0 + lights);
    let fit = &series.fits[0];
    assert_eq!(fit.from, 1000);
    let exponent = fit.exponent.expect("there is an exponent");
    assert!((0.99..1.0).contains(&exponent), "{exponent}");
}

#[test]
fn the_table_shows_time_and_cost_of_every_setting_and_every_exponent() {
    let text = report::table(&example());
    assert!(
        text.lines().all(|line| line.chars().count() <= 100),
        "{text}"
    );
    let rows: Vec<Vec<&str>> = text
        .lines()
        .map(|line| line.split_whitespace().collect())
        .collect();
    for row in [
        // 0.128 ms for 64,000 covered pixels are 2 ns each.
        &["64x10", "0.064", "1.00", "0.128", "2.00"][..],
        &["8", "3.00", "375", "8.00", "1000"],
        &["10", "11.0", "1100", "100", "10000"],
        &["4", "2.00", "4.00", "4.00", "2.00"],
    ] {
        assert!(rows.contains(&row.to_vec()), "{row:?} is not in\n{text}");
    }
    for exponent in ["1.00 (gouraud-0.5)", "2.00 (phong-0)", "0.00 (gouraud-0.5)"] {
        assert!(text.contains(exponent), "{exponent} is not in\n{text}");
    }
    let noisy = series(Quantity::Cuboids, &[1, 2, 4, 8, 16, 32], |cuboids, _| {
        cuboids * if cuboids == 16.0 { 1.5 } else { 1.0 }
    });
    let error = noisy.fits[0].standard_error.expect("there is one");
    let text = report::table(&scaling(vec![noisy]));
    assert!(text.contains(&format!("\u{b1} {error:.2}")), "{text}");
}

#[test]
fn the_json_says_what_was_measured_and_what_it_shows() {
    let text = export::json(&example()).expect("it is written");
    let value: Value = serde_json::from_str(&text).expect("it is JSON");
    let cuboids = &value["series"][2];
    assert_eq!(cuboids["quantity"], "cuboids");
    assert_eq!(cuboids["fits"][1]["id"], "phong-0");
    assert_near(cuboids["fits"][1]["exponent"].as_f64(), 2.0);
    assert_eq!(cuboids["fits"][1]["standard_error"], Value::Null);
    assert_eq!(cuboids["fits"][1]["from"], 100);
    let point = &cuboids["points"][1];
    assert_eq!(point["number"], 10);
    assert_eq!(point["methods"][0]["ms"]["min"], 11.0);
    assert_eq!(point["methods"][0]["cost"], 1100.0);
    let threads = &value["series"][3];
    assert_eq!(threads["points"][2]["methods"][1]["cost"], 2.0);
    assert_eq!(threads["fits"], json!([]));
    assert_eq!(value["size"], json!([40, 30]));
}

#[test]
fn times_too_short_for_the_clock_leave_dashes_instead_of_numbers() {
    let nothing = Quantity::ALL.map(|one| series(one, &[1, 2], |_, _| 0.0));
    let nothing = scaling(nothing.to_vec());
    let json = export::json(&nothing).expect("it is written");
    for text in [json, report::table(&nothing)] {
        let words: Vec<&str> = text.split(|c: char| !c.is_alphanumeric()).collect();
        assert!(!words.contains(&"NaN") && !words.contains(&"inf"), "{text}");
    }
}

fn request(target: &str, size: [usize; 2], threads: usize) -> Request {
    let mut request = requests::request(requests::scene(GREEN, target, true), size, threads);
    request
        .methods
        .retain(|method| METHODS.contains(&method.id));
    request
}

#[test]
fn what_varies_is_what_each_series_is_about() {
    let scaling = measure(&request("[0, 0, 0]", [90, 72], 3), &|_, _| ()).expect("it is measured");
    let numbers = |index: usize| -> Vec<usize> {
        scaling.series[index]
            .points
            .iter()
            .map(|point| point.number)
            .collect()
    };
    assert_eq!(
        numbers(0),
        [40 * 32, 60 * 48, 90 * 72, 120 * 96, 180 * 144, 360 * 288]
    );
    assert_eq!(numbers(1), [1, 2, 4, 8, 16, 32, 64]);
    assert_eq!(numbers(2), [1, 3, 10, 30]);
    assert_eq!(numbers(3), [1, 2, 3]);
    for series in &scaling.series {
        let pixels: Vec<u64> = series
            .points
            .iter()
            .map(|point| point.covered_pixels)
            .collect();
        for (point, pixels) in series.points.iter().zip(&pixels) {
            let ids: Vec<&str> = point.methods.iter().map(|times| times.id).collect();
            assert_eq!(ids, METHODS);
            assert!(point.methods.iter().all(|times| times.timing.samples >= 8));
            assert!(*pixels > 0);
            let threads = if series.quantity == Quantity::Threads {
                point.number
            } else {
                1
            };
            assert_eq!(point.threads, threads);
        }
        match series.quantity {
            // Of a view that is the same but larger.
            Quantity::Pixels => assert!(pixels.is_sorted() && pixels[5] > 12 * pixels[2]),
            Quantity::Lights | Quantity::Threads => assert!(pixels.iter().all(|n| *n == pixels[0])),
            // Each turned another way, but none hidden.
            Quantity::Cuboids => assert!(pixels[3] > 20 * pixels[0]),
        }
    }
}

#[test]
fn a_view_past_everything_has_times_and_no_cost_per_pixel() {
    let scaling =
        measure(&request("[14, 10, 16]", [32, 24], 1), &|_, _| ()).expect("it is measured");
    let pixels = &scaling.series[0];
    assert!(pixels.points.iter().all(|point| point.covered_pixels == 0));
    assert_eq!(pixels.points[0].methods[0].cost, None);
    assert!(report::table(&scaling).contains(" - "));
}

#[test]
fn a_picture_beyond_all_memory_is_an_error() {
    let error = measure(&request("[0, 0, 0]", [1 << 24, 1 << 24], 1), &|_, _| ());
    assert!(matches!(error, Err(TradeError::Memory(_))));
}
