//! The texts and pictures of an invented measurement show its figures.

use serde::Deserialize;
use shadetrade::components::{Projection, ShadingMode};
use shadetrade::trade::{Report, export, plot};

use super::contract::{self, Figure};
use super::example;

fn json(report: &Report) -> contract::Report {
    contract::read(&export::json(report).expect("it is written"))
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
        assert!(cells.len() >= 7, "{cells:?}");
    }
    assert!(markdown.contains("\n`shadetrade trade`\n"), "{markdown}");
}

#[test]
fn the_json_of_the_example_holds_its_figures() {
    let report = json(&example::report());
    assert_eq!(report.command, "shadetrade trade");
    assert_eq!(report.size, [40, 30]);
    assert_eq!(report.projection, Projection::Perspective);
    assert_eq!(report.covered_pixels, 1000);
    let method = &report.methods[0];
    assert_eq!(method.id, "gouraud-0.5");
    assert_eq!(method.mode, ShadingMode::Gouraud);
    assert_eq!(method.ms.median, 0.002);
    assert_eq!(method.ms.raw, [0.001, 0.002, 0.004]);
    assert_eq!(method.ns_per_covered_pixel, Figure::Some(2.0));
    assert_eq!(method.stages["rasterization"], 0.0015);
    assert_eq!(method.counts.model_evaluations, 8);
    assert_eq!(method.counts.specular_evaluations, 4);
    assert_eq!(method.error.levels.max, Figure::Some(163.0));
    assert_eq!(method.error.flip_mean, Figure::Some(163.0 / 512.0));
    assert_eq!(method.own_error.max, Figure::Some(0.25));
    assert_eq!(method.edge_pixels, 1);
    assert!(method.on_front);
}

#[test]
fn the_json_of_an_empty_picture_keeps_every_key() {
    let report = json(&example::empty_report());
    assert_eq!(report.covered_pixels, 0);
    assert_eq!(report.methods.len(), 4);
}

/// The parts of a plot that the tests check.
#[derive(Deserialize)]
struct Svg {
    #[serde(default)]
    circle: Vec<Circle>,
    #[serde(default)]
    polyline: Vec<Polyline>,
    text: Vec<Text>,
}

#[derive(Debug, Deserialize)]
struct Circle {
    #[serde(rename = "@cx")]
    x: f64,
    #[serde(rename = "@cy")]
    y: f64,
}

#[derive(Deserialize)]
struct Polyline {
    #[serde(rename = "@points")]
    points: String,
}

#[derive(Deserialize)]
struct Text {
    #[serde(rename = "@y")]
    y: f64,
    #[serde(rename = "$text")]
    text: String,
}

impl Svg {
    /// Panics if the plot is not XML.
    fn of(report: &Report) -> Svg {
        let text = plot::svg(report).expect("it is drawn");
        let forbidden = |c: char| (c.is_control() && c != '\n') || "\u{fffe}\u{ffff}".contains(c);
        assert!(
            !text.contains(forbidden),
            "characters that XML does not allow"
        );
        assert!(!text.contains("NaN") && !text.contains("inf"));
        quick_xml::de::from_str(&text).expect("it is XML")
    }

    /// The rows of the texts that contain `part`.
    fn rows(&self, part: &str) -> Vec<f64> {
        let texts = self.text.iter().filter(|text| text.text.contains(part));
        texts.map(|text| text.y).collect()
    }
}

#[test]
fn the_plot_names_every_method_and_the_scene() {
    let mut report = example::report();
    report.subject.scene = "<scene> & \"quotes\" \u{7} \u{fffe}".to_owned();
    let plot = Svg::of(&report);
    for measurement in &report.methods {
        let is_label = |text: &&Text| text.text.trim() == measurement.method.id;
        assert_eq!(plot.text.iter().filter(is_label).count(), 1);
    }
    assert_eq!(plot.rows("<scene> & \"quotes\"").len(), 1);
    assert_eq!(plot.rows("\u{2264} 0.001").len(), 1, "zero is on the floor");
}

#[test]
fn every_point_lies_in_the_plot_for_any_error() {
    let mut report = example::report();
    report.methods[2].accuracy.error.levels = Some(example::error(1e-30));
    let plot = Svg::of(&report);
    for point in &plot.circle {
        let is_within = (0.0..960.0).contains(&point.x) && (0.0..600.0).contains(&point.y);
        assert!(is_within, "{point:?}");
    }
    // A disc and a rim for each of four methods and five entries of the legend.
    assert_eq!(plot.circle.len(), 2 * (4 + 5));
}

#[test]
fn labels_do_not_overlap_where_points_coincide() {
    let mut report = example::report();
    let one = report.methods[0].clone();
    report.methods = vec![one; 9];
    let mut rows = Svg::of(&report).rows("gouraud-0.5");
    rows.sort_by(f64::total_cmp);
    assert_eq!(rows.len(), 9);
    assert!(
        rows.windows(2).all(|rows| rows[1] - rows[0] >= 12.0),
        "{rows:?}"
    );
}

#[test]
fn the_plot_of_an_empty_picture_has_no_points() {
    let plot = Svg::of(&example::empty_report());
    assert!(plot.circle.is_empty() && !plot.text.is_empty());
}

#[test]
fn the_front_descends_in_steps_from_the_fastest() {
    let plot = Svg::of(&example::report());
    let corners = |line: &Polyline| -> Vec<[f64; 2]> {
        let corner = |pair: &str| {
            let (x, y) = pair.split_once(',').expect("a pair");
            [x, y].map(|number| number.parse().expect("a number"))
        };
        line.points.split_whitespace().map(corner).collect()
    };
    // Two corners for each of three methods, and the end.
    let front = plot
        .polyline
        .iter()
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
