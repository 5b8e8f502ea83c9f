//! The texts and pictures made of a made-up measurement: they hold its figures.

use serde_json::Value;
use shadetrade::trade::{Report, export, plot};

use super::example;

fn json(report: &Report) -> Value {
    let text = export::json(report).expect("it is written");
    serde_json::from_str(&text).expect("it is JSON")
}

/// The rows of `trade.csv`, a cell by its column.
fn csv(report: &Report) -> Vec<impl Fn(&str) -> String> {
    let text = export::csv(report).expect("it is written");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let head = reader.headers().expect("it has a head").clone();
    let row = |row: Result<csv::StringRecord, csv::Error>| {
        let (head, row) = (head.clone(), row.expect("it is a row"));
        move |column: &str| {
            let at = head.iter().position(|name| name == column);
            row[at.unwrap_or_else(|| panic!("there is no column {column}"))].to_owned()
        }
    };
    reader.records().map(row).collect()
}

/// The figures of a record by their way in the JSON, but for raw samples.
fn figures(way: &str, value: &Value, found: &mut Vec<(String, Value)>) {
    match value {
        Value::Object(keys) => {
            for (key, value) in keys.iter().filter(|(key, _)| *key != "raw") {
                let dot = if way.is_empty() { "" } else { "." };
                figures(&format!("{way}{dot}{key}"), value, found);
            }
        }
        _ => found.push((way.to_owned(), value.clone())),
    }
}

#[test]
fn the_csv_has_a_column_for_every_figure_of_the_json() {
    for report in [example::report(), example::empty_report()] {
        let (json, csv) = (json(&report), csv(&report));
        let methods = json["methods"].as_array().expect("there are methods");
        assert_eq!(csv.len(), methods.len());
        for (method, cell) in methods.iter().zip(csv) {
            let mut expected = Vec::new();
            figures("", method, &mut expected);
            assert!(expected.len() > 20);
            for (way, value) in expected {
                let cell = cell(&way);
                match value {
                    Value::Null => assert_eq!(cell, "", "{way}"),
                    Value::String(text) => assert_eq!(cell, text, "{way}"),
                    Value::Array(items) => {
                        assert_eq!(cell.split(' ').count(), items.len(), "{way}");
                    }
                    _ => assert_eq!(
                        cell.parse::<Value>().expect("it is a figure"),
                        value,
                        "{way}"
                    ),
                }
            }
            assert_eq!(cell("scene"), "cuboid");
            assert_eq!(cell("machine.lanes"), "avx2");
            assert_eq!(cell("size"), "40 30");
        }
    }
}

#[test]
fn a_name_out_of_a_file_is_one_cell_of_the_csv() {
    let mut report = example::report();
    report.subject.scene = "a, \"b\"\nc".to_owned();
    let rows = csv(&report);
    assert_eq!(rows.len(), report.methods.len());
    assert!(
        rows.iter()
            .all(|cell| cell("scene") == report.subject.scene)
    );
}

#[test]
fn the_markdown_has_the_cells_of_the_terminal() {
    let report = example::report();
    let [table, markdown] = [export::table(&report), export::markdown(&report)];
    for one in &report.methods {
        let row = |text: &str, start: &str| -> Vec<String> {
            let row = text.lines().find(|line| line.starts_with(start));
            let row = row.unwrap_or_else(|| panic!("{start} has no row in\n{text}"));
            let words = row.split(|c: char| c.is_whitespace() || c == '|');
            words
                .filter(|word| !word.is_empty())
                .map(str::to_owned)
                .collect()
        };
        let id = one.method.id;
        let cells = row(&table, &format!("{id} "));
        assert_eq!(cells, row(&markdown, &format!("| {id} ")));
        assert!(cells.len() >= 9, "{cells:?}");
    }
    assert!(markdown.contains("\n`shadetrade trade`\n"), "{markdown}");
}

#[test]
fn the_json_of_the_example_says_what_was_measured() {
    let report = example::report();
    let value = json(&report);
    let method = &value["methods"][0];
    assert_eq!(method["id"], "gouraud-0.5");
    assert_eq!(method["mode"], "gouraud");
    assert_eq!(method["ms"]["median"], 0.002);
    assert_eq!(
        method["ms"]["raw"],
        serde_json::json!([0.001, 0.002, 0.004])
    );
    assert_eq!(method["ns_per_covered_pixel"], 2.0);
    assert_eq!(method["stages"]["rasterization"], 0.0015);
    assert_eq!(method["error"]["max"], 163.0);
    assert_eq!(method["error"]["flip_mean"], 163.0 / 512.0);
    assert_eq!(method["own_error"]["max"], 0.25);
    assert_eq!(method["edge_pixels"], 1);
    assert_eq!(method["on_front"], true);
    assert_eq!(value["size"], serde_json::json!([40, 30]));
    assert_eq!(value["projection"], "perspective");
    assert_eq!(value["covered_pixels"], 1000);
}

#[test]
fn the_json_of_nothing_keeps_every_key() {
    let [some, none] = [example::report(), example::empty_report()].map(|report| {
        let mut found = Vec::new();
        figures("", &json(&report)["methods"][0], &mut found);
        found
    });
    let ways = |figures: &[(String, Value)]| -> Vec<String> {
        figures.iter().map(|(way, _)| way.clone()).collect()
    };
    assert_eq!(ways(&some), ways(&none));
    let null = |way: &str| {
        none.iter()
            .any(|(other, value)| other == way && value.is_null())
    };
    for way in [
        "error.max",
        "error.flip_mean",
        "own_error.rmse",
        "ns_per_covered_pixel",
    ] {
        assert!(null(way), "{way} does not exist");
    }
}

#[test]
fn the_plot_is_well_formed_and_names_every_method() {
    let mut report = example::report();
    report.subject.scene = "<scene> & \"quotes\" \u{7} \u{fffe}".to_owned();
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
    report.methods[2].accuracy.error.levels = Some(example::error(1e-30));
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
fn labels_stay_apart_where_points_are_in_one_place() {
    let mut report = example::report();
    let one = report.methods[0].clone();
    report.methods = vec![one; 9];
    let text = plot::svg(&report).expect("it is drawn");
    let lines: Vec<&str> = text.lines().collect();
    let label = |lines: &[&str]| {
        let [tag, text] = lines else { return None };
        let y = tag.split(" y=\"").nth(1)?.split('"').next()?;
        (*text == "gouraud-0.5").then(|| y.parse::<f64>().expect("it is a number"))
    };
    let mut rows: Vec<f64> = lines.windows(2).filter_map(label).collect();
    rows.sort_by(f64::total_cmp);
    assert_eq!(rows.len(), 9);
    assert!(
        rows.windows(2).all(|rows| rows[1] - rows[0] >= 12.0),
        "{rows:?}"
    );
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
        !text
            .chars()
            .any(|c| (c.is_control() && c != '\n') || c == '\u{fffe}' || c == '\u{ffff}'),
        "XML has neither control characters nor these"
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
