//! Scaling: exponents and verdicts of times that follow a known law, and every file made of them.

use serde_json::{Value, json};
use shadetrade::shading::METHODS;
use shadetrade::trade::scale::growth::{exponent, exponents, summary, verdict};
use shadetrade::trade::scale::{Point, Quantity, Scaling, Series, data, measure, plot, report};
use shadetrade::trade::timing::Timing;
use shadetrade::trade::{Request, TradeError};

use crate::requests::GREEN;
use crate::{example, requests};

/// A timing whose least time is `ms`, and whose median tells something else.
fn least(ms: f64) -> Timing {
    Timing {
        min: ms,
        ..example::timing(3.0 * ms + 1.0)
    }
}

/// A quantity at these numbers, where method `m` of two takes `law(number, m)` milliseconds.
fn series(quantity: Quantity, numbers: &[usize], law: impl Fn(f64, usize) -> f64) -> Series {
    let point = |&number: &usize| Point {
        number,
        size: [number, 10],
        threads: if quantity == Quantity::Threads {
            number
        } else {
            1
        },
        covered_pixels: 1000 * number as u64,
        timings: [0, 1]
            .map(|method| least(law(number as f64, method)))
            .to_vec(),
    };
    Series {
        quantity,
        points: numbers.iter().map(point).collect(),
    }
}

fn scaling(series: Vec<Series>) -> Scaling {
    let methods = METHODS
        .iter()
        .filter(|method| ["gouraud-0.5", "phong-0"].contains(&method.id));
    Scaling {
        subject: example::subject("shadetrade trade --scale"),
        methods: methods.copied().collect(),
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
    let found = found.expect("there is an exponent");
    assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
}

#[test]
fn the_exponent_of_a_power_is_its_exponent() {
    for power in [-0.5, 0.0, 1.0, 2.0] {
        let points = [1.0, 3.0, 10.0, 700.0].map(|x: f64| [x, 0.37 * x.powf(power)]);
        assert_near(exponent(&points), power);
    }
    // Times e and 1/e at the middle number of three leave the slope as it is.
    let e = std::f64::consts::E;
    assert_near(exponent(&[[1.0, 1.0], [e, e * e], [e * e, e * e]]), 1.0);
}

#[test]
fn there_is_no_exponent_where_nothing_varies_or_the_clock_saw_nothing() {
    for points in [
        &[][..],
        &[[2.0, 1.0]],
        &[[2.0, 1.0], [2.0, 3.0]],
        &[[1.0, 0.0], [2.0, 3.0]],
    ] {
        assert_eq!(exponent(points), None, "{points:?}");
    }
}

#[test]
fn what_a_frame_costs_anyway_does_not_blur_the_exponent() {
    // Ten milliseconds and one a light: the lower half of the range would be nearly flat.
    let series = series(
        Quantity::Lights,
        &[1, 2, 4, 1000, 10_000, 100_000],
        |lights, _| 10.0 + lights,
    );
    let exponent = exponents(&series, 2)[0].expect("there is an exponent");
    assert!((0.99..1.0).contains(&exponent), "{exponent}");
}

#[test]
fn every_series_has_a_verdict_that_follows_from_its_times() {
    let scaling = example();
    let verdicts: Vec<String> = scaling
        .series
        .iter()
        .map(|one| verdict(&scaling, one))
        .collect();
    assert_eq!(
        verdicts,
        [
            "Cost per pixel is flat: time goes as pixels^1.00 (gouraud-0.5) and pixels^1.00 (phong-0), from 16x10 on.",
            "Time is linear in the lights at most: time goes as lights^0.00 (gouraud-0.5) and lights^1.00 (phong-0), \
             from 4 on.",
            "Time is nearer to the square of the cuboids than to their number: time goes as cuboids^1.00 (gouraud-0.5) \
             and cuboids^2.00 (phong-0), from 100 on.",
            "4 threads are 2.00 to 4.00 times as fast as one: 4.00x (gouraud-0.5) and 2.00x (phong-0).",
        ]
    );
    assert_eq!(
        summary(&scaling),
        "Something grows nearly as a square: the steepest is phong-0, with cuboids^2.00."
    );
}

#[test]
fn a_claim_says_no_more_than_was_measured() {
    let claims = |quantity, power: f64| {
        let one = series(quantity, &[1, 10, 100], |number, _| number.powf(power));
        let scaling = scaling(vec![one]);
        let words = verdict(&scaling, &scaling.series[0]);
        (
            words.split(':').next().unwrap_or_default().to_owned(),
            summary(&scaling),
        )
    };
    for (quantity, power, claim, whole) in [
        (
            Quantity::Pixels,
            0.8,
            "Cost per pixel is flat or falls",
            "Nothing grows faster",
        ),
        (
            Quantity::Pixels,
            1.05,
            "Cost per pixel is flat",
            "Nothing grows faster",
        ),
        (
            Quantity::Pixels,
            1.2,
            "Time grows faster than the pixels",
            "though not as its square",
        ),
        (
            Quantity::Lights,
            0.95,
            "Time is linear in the lights",
            "Nothing grows faster",
        ),
        (
            Quantity::Cuboids,
            1.3,
            "Time grows faster than the cuboids",
            "though not as its square",
        ),
        (
            Quantity::Cuboids,
            1.6,
            "Time is nearer to the square of the cuboids than",
            "as a square",
        ),
    ] {
        let (found, found_whole) = claims(quantity, power);
        assert!(found.starts_with(claim), "{quantity:?}^{power}: {found}");
        assert!(
            found_whole.contains(whole),
            "{quantity:?}^{power}: {found_whole}"
        );
    }
    let alone = scaling(vec![
        series(Quantity::Threads, &[1], |_, _| 1.0),
        series(Quantity::Cuboids, &[1], |_, _| 1.0),
    ]);
    let words: Vec<String> = alone
        .series
        .iter()
        .map(|one| verdict(&alone, one))
        .collect();
    assert_eq!(
        words,
        [
            "One thread draws, so there is no speed-up to see.",
            "There is too little to see how time grows with the cuboids."
        ]
    );
    assert_eq!(
        summary(&alone),
        "There is too little to see how time grows."
    );
}

#[test]
fn the_table_shows_time_and_cost_of_every_setting() {
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
}

#[test]
fn the_markdown_is_ready_for_a_readme() {
    let text = report::markdown(&example());
    let expected = "
| threads | gouraud-0.5 ms | faster | phong-0 ms | faster |
|---|---:|---:|---:|---:|
| 1 | 8.00 | 1.00 | 8.00 | 1.00 |
| 2 | 4.00 | 2.00 | 5.66 | 1.41 |
| 4 | 2.00 | 4.00 | 4.00 | 2.00 |
";
    assert!(text.contains(expected), "{text}");
    assert!(text.contains("\n`shadetrade trade --scale`\n"), "{text}");
}

#[test]
fn the_csv_has_a_line_for_every_method_in_every_setting() {
    let text = data::csv(&example());
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 1 + 2 * (4 + 4 + 4 + 3));
    assert_eq!(
        lines[0],
        "scene,camera,projection,quantity,number,width,height,covered_pixels,threads,method,mode,tolerance,samples,\
         median_ms,mad_ms,min_ms,p99_ms,cost,unit"
    );
    assert_eq!(
        lines[4],
        "cuboid,1,perspective,pixels,4,4,10,4000,1,phong-0,phong,0,300,1.024,0.001024,0.008,2.048,2,\
         ns_per_covered_pixel"
    );
    assert_eq!(
        lines[9],
        "-,-,perspective,lights,1,1,10,1000,1,gouraud-0.5,gouraud,0.5,300,10,0.01,3,20,3000,us_per_light"
    );
}

#[test]
fn the_json_says_what_was_measured_and_what_it_shows() {
    let value: Value = serde_json::from_str(&data::json(&example())).expect("it is JSON");
    let cuboids = &value["series"][2];
    assert_eq!(cuboids["quantity"], "cuboids");
    assert_eq!(cuboids["fits"][1]["id"], "phong-0");
    assert_near(cuboids["fits"][1]["exponent"].as_f64(), 2.0);
    assert_eq!(cuboids["fits"][1]["from"], 100);
    let point = &cuboids["points"][1];
    assert_eq!(point["cuboids"], 10);
    assert_eq!(point["methods"][0]["ms"]["min"], 11.0);
    assert_eq!(point["methods"][0]["us_per_cuboid"], 1100.0);
    assert_eq!(
        value["series"][3]["points"][2]["methods"][1]["speed_up"],
        2.0
    );
    assert_eq!(value["series"][3]["fits"][0]["exponent"], Value::Null);
    assert_eq!(value["size"], json!([40, 30]));
}

#[test]
fn the_picture_has_a_panel_for_every_quantity() {
    let text = plot::svg(&example()).expect("it is drawn");
    for word in [
        "pixels",
        "lights",
        "cuboids",
        "threads",
        "gouraud-0.5",
        "phong-0",
        "Cost per pixel is flat",
    ] {
        assert!(text.contains(word), "{word} is not in the picture");
    }
    assert!(text.starts_with("<svg") && text.trim_end().ends_with("</svg>"));
    assert!(!text.contains("NaN") && !text.contains("inf"));
}

#[test]
fn times_too_short_for_the_clock_leave_words_instead_of_numbers() {
    let nothing = scaling(
        Quantity::ALL
            .map(|one| series(one, &[1, 2], |_, _| 0.0))
            .to_vec(),
    );
    let svg = plot::svg(&nothing).expect("it is drawn");
    assert!(svg.contains("too short for the clock"));
    for text in [
        svg,
        data::json(&nothing),
        data::csv(&nothing),
        report::table(&nothing),
        report::markdown(&nothing),
    ] {
        let words: Vec<&str> = text.split(|c: char| !c.is_alphanumeric()).collect();
        assert!(!words.contains(&"NaN") && !words.contains(&"inf"), "{text}");
    }
}

fn request(target: &str, size: [usize; 2], threads: usize) -> Request {
    requests::request(requests::scene(GREEN, target, true), size, threads)
}

#[test]
fn what_varies_is_what_each_series_is_about() {
    let scaling = measure(&request("[0, 0, 0]", [90, 72], 3), &|_| ()).expect("it is measured");
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
            assert_eq!(point.timings.len(), 3);
            assert!(point.timings.iter().all(|timing| timing.samples >= 9));
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
    let scaling = measure(&request("[14, 10, 16]", [32, 24], 1), &|_| ()).expect("it is measured");
    let pixels = &scaling.series[0];
    assert!(pixels.points.iter().all(|point| point.covered_pixels == 0));
    assert_eq!(pixels.cost(&pixels.points[0], 0), None);
    assert!(report::table(&scaling).contains(" - "));
}

#[test]
fn a_picture_beyond_all_memory_is_an_error() {
    let error = measure(&request("[0, 0, 0]", [1 << 24, 1 << 24], 1), &|_| ());
    assert!(matches!(error, Err(TradeError::Memory(_))));
}
