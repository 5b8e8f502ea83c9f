//! The texts and pictures of an invented measurement show its figures.

use std::fs;

use serde::Deserialize;
use shadetrade::components::{Projection, ShadingMode};
use shadetrade::output::json;
use shadetrade::report::tables::WIDTH;
use shadetrade::trade::export::{markdown, table};
use shadetrade::trade::{Report, plot};

use super::{contract, example};

#[test]
fn the_table_and_the_markdown_have_the_figures_of_every_method() {
    for (report, rows) in [
        (
            example::report(),
            [
                "gouraud-0.5 0.002 0.002 to 0.002 163 0 % yes",
                "phong-unit-vectors 0.006 0.006 to 0.006 171 4 %",
                "phong-0 0.008 0.008 to 0.008 0 100 % yes",
            ],
        ),
        // A dash stands for a figure that does not exist.
        (
            example::empty_report(),
            [
                "gouraud-0.5 0.002 0.002 to 0.002 - -",
                "phong-unit-vectors 0.006 0.006 to 0.006 - -",
                "phong-0 0.008 0.008 to 0.008 - -",
            ],
        ),
    ] {
        for text in [table(&report), markdown(&report)] {
            let words = |line: &str| {
                let words = line.split(|c: char| c.is_whitespace() || c == '|');
                let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
                words.join(" ")
            };
            let lines: Vec<String> = text.lines().map(words).collect();
            for row in rows {
                assert!(
                    lines.iter().any(|line| line == row),
                    "{row:?} is not in\n{text}"
                );
            }
            for part in ["40x30", "covered pixels", "Some CPU", "1 thread,", "1/255"] {
                assert!(text.contains(part), "{part:?} is not in\n{text}");
            }
        }
    }
    assert!(markdown(&example::report()).contains("\n`shadetrade trade`\n"));
}

#[test]
fn the_table_fits_its_columns_for_any_numbers() {
    let mut report = example::report();
    for (index, one) in report.methods.iter_mut().enumerate() {
        one.method.id = "phong-unit-vectors";
        one.timing = example::timing([1e-7, 0.999_9, 99.99, 12_345.6][index]);
        one.timing.interval[1] *= 3.0;
        one.accuracy.error = Some(example::error([1e-9, 0.999, 9.999, 254.9][index]));
    }
    for report in [report, example::report(), example::empty_report()] {
        let text = table(&report);
        assert!(
            text.lines().all(|line| line.chars().count() <= WIDTH),
            "{text}"
        );
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    }
}

#[test]
fn the_json_of_the_example_holds_its_figures() {
    let read = |report: &Report| contract::read(&json(report).expect("it is written"));
    let report = read(&example::report());
    assert_eq!(report.command, "shadetrade trade");
    assert_eq!((report.size, report.covered_pixels), ([40, 30], 1000));
    assert_eq!(report.projection, Projection::Perspective);
    let method = &report.methods[0];
    assert_eq!(
        (&*method.id, method.mode),
        ("gouraud-0.5", ShadingMode::Gouraud)
    );
    assert_eq!(method.ms.median, 0.002);
    assert_eq!(method.ms.raw, [0.001, 0.002, 0.004]);
    assert_eq!(method.ns_per_covered_pixel, Some(2.0));
    let counts = &method.counts;
    assert_eq!(
        [counts.model_evaluations, counts.specular_evaluations],
        [8, 4]
    );
    let error = method.error.as_ref().expect("it is compared");
    assert_eq!([error.levels.max, error.flip_mean], [163.0, 163.0 / 512.0]);
    assert_eq!(method.own_error.as_ref().map(|error| error.max), Some(0.25));
    assert!(method.edge_pixels == 1 && method.on_front);
    // Without a cuboid in the picture every key is there.
    assert_eq!(read(&example::empty_report()).methods.len(), 4);
}

#[test]
fn every_method_has_its_error_map_with_a_legend() {
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let mut report = example::report();
    report.subject.size = [2, 3];
    for (index, one) in (1..).zip(&mut report.methods) {
        one.accuracy.map = vec![index; 6];
    }
    shadetrade::trade::write_files(&report, folder.path()).expect("it is written");
    assert_eq!(
        fs::read_dir(folder.path()).expect("it is there").count(),
        3 + 4
    );
    for (index, one) in (1..).zip(&report.methods) {
        let path = folder.path().join(format!("error-{}.png", one.method.id));
        let picture = image::open(path).expect("a PNG").into_rgb8();
        assert_eq!(
            picture.get_pixel(1, 2).0,
            [0, 0, index],
            "{}",
            one.method.id
        );
        assert!(picture.width() > 100 && picture.height() > 50);
    }
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
fn the_plot_names_the_scene_and_has_every_point_and_its_label_inside() {
    let mut report = example::report();
    report.subject.scene = "<scene> & \"quotes\" \u{7} \u{fffe}".to_owned();
    report.methods[2].accuracy.error = Some(example::error(1e-30));
    let plot = Svg::of(&report);
    for one in &report.methods {
        let is_label = |text: &&Text| text.text.trim() == one.method.id;
        assert_eq!(plot.text.iter().filter(is_label).count(), 1);
    }
    assert_eq!(plot.rows("<scene> & \"quotes\"").len(), 1);
    for point in &plot.circle {
        let is_within = (0.0..960.0).contains(&point.x) && (108.0..600.0).contains(&point.y);
        assert!(is_within, "{point:?}");
    }
    // A disc and a rim for each of four methods.
    assert_eq!(plot.circle.len(), 2 * 4);
    assert!(Svg::of(&example::empty_report()).circle.is_empty());
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
    let mut lines = plot.polyline.iter().map(corners);
    let front = lines
        .find(|line| line.len() == 7)
        .expect("a line of seven points");
    for step in front.windows(2) {
        let [[from_x, from_y], [to_x, to_y]] = [step[0], step[1]];
        assert!(
            from_x <= to_x && from_y <= to_y,
            "right and down: {front:?}"
        );
        assert!(from_x == to_x || from_y == to_y, "never both: {front:?}");
    }
}
