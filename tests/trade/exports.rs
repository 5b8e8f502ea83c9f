//! The files made of a made-up measurement.

use shadetrade::trade::{csv, json, plot, report};

use crate::{contract, example};

#[test]
fn the_csv_has_a_named_column_for_every_figure() {
    let text = csv::csv(&example::report());
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 5);
    assert_eq!(
        lines[0],
        "scene,camera,projection,width,height,covered_pixels,method,mode,tolerance,threads,samples,median_ms,mad_ms,\
         min_ms,p99_ms,ns_per_covered_pixel,model_evaluations,specular_evaluations,max_error,mean_error,rmse,p999_error,\
         over_1_level,flip_mean,max_own_error,own_rmse,highlight_kept,edge_pixels,on_front"
    );
    assert_eq!(
        lines[3],
        "cuboid,1,perspective,40,30,1000,phong-0.5,phong,0.5,1,300,0.003,0.000003,0.0015,0.006,3,8,4,0.4,0.05,0.1,0.2,\
         0,0.00078125,0.4,0.1,1,1,true"
    );
}

#[test]
fn the_csv_quotes_names_and_dashes_out_what_does_not_exist() {
    let mut report = example::empty_report();
    report.subject.scene = "a, \"b\"".to_owned();
    let text = csv::csv(&report);
    let line = text.lines().nth(4).expect("there are four methods");
    assert_eq!(
        line,
        "\"a, \"\"b\"\"\",1,perspective,40,30,0,phong-0,phong,0,1,300,0.008,0.000008,0.004,0.016,\
         -,0,0,-,-,-,-,-,-,-,-,-,0,false"
    );
}

#[test]
fn the_markdown_is_ready_for_a_readme() {
    let text = report::markdown(&example::report());
    let expected = "\
`shadetrade trade`

| method | ms | \u{b1} | ns/px | max | RMSE | FLIP | own | kept | front |
|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|
| gouraud-0.5 | 0.002 | 0.5% | 2.00 | 163 | 40.8 | 0.318 | 0.250 | 0 % | yes |
| phong-unit-vectors | 0.006 | 0.5% | 6.00 | 171 | 42.8 | 0.334 | 0 | 4 % |  |
| phong-0.5 | 0.003 | 0.5% | 3.00 | 0.400 | 0.100 | <0.001 | 0.400 | 100 % | yes |
| phong-0 | 0.008 | 0.5% | 8.00 | 0 | 0 | 0 | 0 | 100 % | yes |

Every difference in time is measurable.
";
    assert!(text.contains(expected), "{text}");
    assert!(
        text.starts_with("Phong within half a level costs 1.5x Gouraud here;"),
        "{text}"
    );
}

#[test]
fn the_json_of_nothing_keeps_every_key() {
    let mut report = example::empty_report();
    // The contract's ladder is longer than the example's.
    let ladder = shadetrade::shading::METHODS.iter();
    let sample = report.methods[0].clone();
    report.methods = ladder
        .map(|method| shadetrade::trade::Measurement {
            method: *method,
            ..sample.clone()
        })
        .collect();
    contract::assert_holds(&json::json(&report));
}

#[test]
fn the_json_of_the_example_says_what_was_measured() {
    let value: serde_json::Value =
        serde_json::from_str(&json::json(&example::report())).expect("it is JSON");
    let method = &value["methods"][0];
    assert_eq!(method["id"], "gouraud-0.5");
    assert_eq!(method["ms"]["median"], 0.002);
    assert_eq!(method["ns_per_covered_pixel"], 2.0);
    assert_eq!(method["error"]["max"], 163.0);
    assert_eq!(method["own_error"]["max"], 0.25);
    assert_eq!(method["edge_pixels"], 1);
    assert_eq!(method["on_front"], true);
    assert_eq!(value["size"], serde_json::json!([40, 30]));
    assert_eq!(value["covered_pixels"], 1000);
}

#[test]
fn the_plot_is_well_formed_and_names_every_method() {
    let mut report = example::report();
    report.subject.scene = "<scene> & \"quotes\" \u{7}".to_owned();
    let text = plot::svg(&report).expect("it is drawn");
    assert_well_formed(&text);
    for measurement in &report.methods {
        let label = format!("\n{}\n</text>", measurement.method.id);
        assert_eq!(text.matches(&label).count(), 1, "{}", measurement.method.id);
    }
    assert!(
        text.contains("&lt;scene&gt; &amp;"),
        "markup in names is escaped"
    );
    assert!(
        text.contains("\u{2264} 0.001"),
        "the floor says that zero stands on it"
    );
    assert!(!text.contains("NaN") && !text.contains("inf"));
}

#[test]
fn every_point_lies_in_the_plot_however_small_its_error() {
    let mut report = example::report();
    report.methods[2].accuracy.error = example::difference(1e-30);
    let text = plot::svg(&report).expect("it is drawn");
    let attribute = |tag: &str, name: &str| -> Option<f64> {
        let (_, rest) = tag.split_once(name)?;
        rest.split('"').nth(1)?.parse().ok()
    };
    let mut points = 0;
    for tag in text.lines().filter(|line| line.starts_with("<circle")) {
        let x = attribute(tag, "cx=").expect("a circle has a place");
        let y = attribute(tag, "cy=").expect("a circle has a place");
        assert!(
            (0.0..960.0).contains(&x) && (0.0..600.0).contains(&y),
            "{tag}"
        );
        points += 1;
    }
    // A disc and a rim for each of four methods and of five words of the key.
    assert_eq!(points, 2 * (4 + 5));
}

#[test]
fn the_plot_of_nothing_says_so() {
    let text = plot::svg(&example::empty_report()).expect("it is drawn");
    assert_well_formed(&text);
    assert!(text.contains("No pixel of this view can be compared"));
}

#[test]
fn the_front_goes_down_in_steps_from_the_fastest() {
    let text = plot::svg(&example::report()).expect("it is drawn");
    let corners = |line: &str| -> Vec<[f64; 2]> {
        let points = line
            .split("points=\"")
            .nth(1)
            .and_then(|rest| rest.split('"').next());
        let corner = |pair: &str| -> Option<[f64; 2]> {
            let (x, y) = pair.split_once(',')?;
            Some([x.parse().ok()?, y.parse().ok()?])
        };
        points
            .into_iter()
            .flat_map(str::split_whitespace)
            .filter_map(corner)
            .collect()
    };
    // Two corners for each of three methods, and the end.
    let front = text
        .lines()
        .map(corners)
        .find(|line| line.len() == 7)
        .expect("there is a line of seven points");
    for step in front.windows(2) {
        let [[from_x, from_y], [to_x, to_y]] = [step[0], step[1]];
        assert!(
            from_x <= to_x && from_y <= to_y,
            "right and down: {front:?}"
        );
        assert!(from_x == to_x || from_y == to_y, "never both: {front:?}");
    }
}

/// Panics unless every element that is opened is closed in turn and every entity is one of XML's.
fn assert_well_formed(text: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        assert_entities(&rest[..start]);
        let end = start + rest[start..].find('>').expect("a tag ends");
        let tag = &rest[start + 1..end];
        assert_eq!(
            tag.matches('"').count() % 2,
            0,
            "quotes are in pairs: {tag}"
        );
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "elements close in turn");
        } else if !tag.ends_with('/') {
            open.push(
                tag.split_whitespace()
                    .next()
                    .expect("an element has a name"),
            );
        }
        rest = &rest[end + 1..];
    }
    assert!(open.is_empty(), "{open:?} is not closed");
    assert!(
        !text.chars().any(|c| c.is_control() && c != '\n'),
        "XML has no control characters"
    );
}

fn assert_entities(text: &str) {
    for part in text.split('&').skip(1) {
        let entity = part.split(';').next().unwrap_or_default();
        assert!(
            ["lt", "gt", "amp", "quot", "apos"].contains(&entity),
            "&{entity}; is no entity"
        );
    }
}
