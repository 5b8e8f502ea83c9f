//! The texts and pictures of an invented measurement show its figures.

use serde::Deserialize;
use shadetrade::components::Segments;
use shadetrade::components::ShadingMode::Gouraud;
use shadetrade::questions::metrics::ErrorStatistics;
use shadetrade::questions::trade::export::{markdown, table};
use shadetrade::questions::trade::{LeftOut, Report, plot};
use shadetrade::shading::Method;

use super::example::{empty_report, report, timing};

fn with_max(max: f64) -> ErrorStatistics {
    ErrorStatistics {
        max,
        ..ErrorStatistics::default()
    }
}

/// Rows of the table. A dash stands for a figure that does not exist.
const ROWS: [&str; 3] = [
    "gouraud-0.5 0.002 0.002 163 0 % yes
phong-unit-vectors 0.006 0.006 171 4 %
phong-0 0.008 0.008 0 100 % yes",
    "gouraud-0.5 0.002 0.002 - -
phong-unit-vectors 0.006 0.006 - -
phong-0 0.008 0.008 - -",
    "phong-unit-vectors <0.001 <0.001 <0.001 0 % yes
phong-unit-vectors 100 99.5 to 301 10.2 100 % yes
phong-unit-vectors 12346 12284 to 37222 252 100 % yes",
];

#[test]
fn the_table_and_the_markdown_have_the_figures_of_every_method() {
    let mut wide = report();
    let times = [1e-7, 0.999_9, 99.99, 12_345.6];
    for ((one, time), error) in wide
        .methods
        .iter_mut()
        .zip(times)
        .zip([1e-9, 0.02, 10.2, 252.0])
    {
        one.method.id = "phong-unit-vectors";
        one.timing = timing(time);
        one.timing.interval[1] *= 3.0;
        one.error = Some(with_max(error));
    }
    for (report, rows) in [report(), empty_report(), wide].iter().zip(ROWS) {
        let table = table(report);
        let is_narrow = table.lines().all(|line| line.chars().count() <= 100);
        assert!(is_narrow, "{table}");
        for text in [table, markdown(report)] {
            let words = |line: &str| {
                let words = line.split(|c: char| c.is_whitespace() || c == '|');
                let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
                words.join(" ")
            };
            let lines: Vec<String> = text.lines().map(words).collect();
            for row in rows.lines() {
                assert!(lines.iter().any(|it| it == row), "no {row:?} in\n{text}");
            }
            for part in ["40x30", "covered pixels", "Some CPU", "1 thread,", "1/255"] {
                assert!(text.contains(part), "{part:?} is not in\n{text}");
            }
        }
    }
    assert!(markdown(&report()).contains("\n`shadetrade trade`\n"));
}

#[test]
fn what_is_left_out_is_said_with_the_reason() {
    let mut report = report();
    let none = table(&report);
    assert!(!none.contains("left out"), "{none}");
    report.left_out = vec![LeftOut {
        method: Method::with(Gouraud, Segments::new(256), 0.5),
        reason: "no room for the grids".to_owned(),
    }];
    for text in [table(&report), markdown(&report)] {
        let told = "gouraud-256x256-0.5 is left out: no room for the grids.";
        assert!(text.contains(told), "{text}");
    }
}

/// The parts of a plot that the tests check.
#[derive(Deserialize)]
struct Svg {
    #[serde(default)]
    circle: Vec<Element>,
    #[serde(default)]
    polyline: Vec<Element>,
    text: Vec<Element>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Element {
    #[serde(rename = "@cx")]
    center_x: f64,
    #[serde(rename = "@cy")]
    center_y: f64,
    #[serde(rename = "@fill")]
    fill: String,
    #[serde(rename = "@points")]
    points: String,
    #[serde(rename = "@x")]
    x: f64,
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
        assert!(!text.contains(forbidden), "XML does not allow it");
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
    let mut report = report();
    report.heading.scene = "<scene> & \"quotes\" \u{7} \u{fffe}".to_owned();
    report.methods[2].error = Some(with_max(1e-30));
    let plot = Svg::of(&report);
    assert_eq!(plot.rows("Filled: a best trade").len(), 1);
    for one in &report.methods {
        let is_label = |text: &&Element| text.text.trim() == one.method.id;
        assert_eq!(plot.text.iter().filter(is_label).count(), 1);
    }
    assert_eq!(plot.rows("<scene> & \"quotes\"").len(), 1);
    for point in &plot.circle {
        assert!((0.0..960.0).contains(&point.center_x), "{point:?}");
        assert!((108.0..600.0).contains(&point.center_y), "{point:?}");
    }
    // On the front a label is below its point, to the left, and the disc is filled; other labels are above, to
    // the right, or to the left of what is not timed.
    let discs = plot.circle.iter().filter(|it| it.fill != "none");
    for (one, disc) in report.methods.iter().zip(discs) {
        let is_label = |text: &&Element| text.text.trim() == one.method.id;
        let label = plot.text.iter().find(is_label).expect("it has a label");
        assert_eq!(disc.fill != "#FFFFFF", one.on_front);
        let [right, below] = [label.x > disc.center_x, label.y > disc.center_y];
        let is_left = one.on_front || !one.method.mode.is_drawn();
        assert_eq!([right, below], [!is_left, one.on_front], "{label:?}");
    }
    // Two points of the front for each of three best trades, and its end, as steps.
    let points = plot.polyline.iter().map(|it| it.points.split([' ', ',']));
    let mut lines = points.map(Iterator::collect::<Vec<_>>);
    let front = lines.find(|it| it.len() == 2 * 7 + 1).expect("it is drawn");
    let is_step = |ends: &[&str]| ends[0] == ends[2] || ends[1] == ends[3];
    assert!(front[..14].windows(4).step_by(2).all(is_step), "{front:?}");
    // A disc and a rim for each of four methods.
    assert_eq!(plot.circle.len(), 2 * 4);
    assert!(Svg::of(&empty_report()).circle.is_empty());
}

#[test]
fn labels_do_not_overlap_where_points_coincide() {
    let mut report = report();
    report.methods = vec![report.methods[0].clone(); 9];
    for on_front in [true, false] {
        for one in &mut report.methods {
            one.on_front = on_front;
        }
        let plot = Svg::of(&report);
        let mut rows = plot.rows("gouraud-0.5");
        rows.sort_by(f64::total_cmp);
        assert_eq!(rows.len(), 9);
        let is_free = |rows: &[f64]| rows[1] - rows[0] >= 12.0;
        assert!(rows.windows(2).all(is_free), "{rows:?}");
        let middle = plot.circle[0].center_y;
        assert!(rows.iter().all(|row| (*row > middle) == on_front));
    }
    // A time that is too short for the clock has no place.
    report.methods[0].timing.median = 0.0;
    assert_eq!(Svg::of(&report).circle.len(), 2 * 8);
}
