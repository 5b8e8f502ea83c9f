//! What is known of a pixel -> lines for a board, and the cross that marks it.
//!
//! Rules: every figure is [`Probe`]'s own; what does not exist is "-". Levels are unclamped, bytes are displayed. Lights at
//! one place share one l and r.

use glam::DVec3;

use super::lines::Line;
use crate::canvas::{Canvas, Ink, Point, Rect, fit};
use crate::probe::{Light, Probe, Surface};

const CROSS: Ink = Ink::solid(0x00ff_ffff);
const CROSS_EDGE: Ink = Ink::glass(0, 170);

/// Letters of a name; longer ones are cut.
const NAME: usize = 11;
/// Letters of a number.
const NUMBER: usize = 9;

/// Levels smaller than this are 0 on the board, and so are parts of a vector below this share of its largest.
const NEGLIGIBLE: f64 = 1e-6;

/// The lines about `probe`: the modes side by side where `wide`, else below one another.
pub fn lines(probe: &Probe, wide: bool) -> Vec<Line> {
    let [x, y] = probe.pixel;
    let title = Line::Title("pixel", format!("{x},{y}"));
    let (Some(object), Some(surface)) = (&probe.object, &probe.surface) else {
        return vec![title, Line::Text("background".to_owned())];
    };
    let vector = |name: &str, vector: Option<DVec3>| {
        let numbers = |it: DVec3| numbers(it.to_array(), NEGLIGIBLE * it.abs().max_element());
        let cells = vector.map_or_else(nothing, numbers);
        Line::Text(row(name, &[cells]))
    };
    let mut lines = vec![
        title,
        Line::Text(format!("{object}, {}", surface.triangle_label())),
        Line::Text(row("", &[["x", "y", "z"].map(str::to_owned)])),
        vector("position", surface.position),
        vector("normal n", surface.normal),
        vector("to eye o", surface.to_eye),
    ];
    for (names, light) in places(surface) {
        lines.push(vector(
            &format!("{} l", fit(&names, NAME - 2)),
            light.to_light,
        ));
        lines.push(vector("reflected r", light.reflected));
    }
    lines.push(Line::Rule);
    if wide {
        lines.extend(table(surface, &[Mode::Gouraud, Mode::Phong]));
    } else {
        lines.extend(table(surface, &[Mode::Gouraud]));
        lines.extend(table(surface, &[Mode::Phong]));
    }
    lines
}

/// The places of the lights that have one, with the names of the lights there.
pub fn places(surface: &Surface) -> Vec<(String, &Light)> {
    let mut places: Vec<(String, &Light)> = Vec::new();
    for light in surface.lights.iter().filter(|it| it.kind != "ambient") {
        match places
            .iter_mut()
            .find(|(_, it)| it.to_light == light.to_light)
        {
            Some((names, _)) => "lights".clone_into(names),
            None => places.push((light.name.clone(), light)),
        }
    }
    places
}

#[derive(Clone, Copy)]
enum Mode {
    Gouraud,
    Phong,
}

/// Every light's term, the sum as drawn and as it ought to be, and the bytes, of each mode side by side.
fn table(surface: &Surface, modes: &[Mode]) -> Vec<Line> {
    let columns: Vec<_> = modes
        .iter()
        .map(|mode| match mode {
            Mode::Gouraud => ("Gouraud", &surface.gouraud, surface.reference.gouraud),
            Mode::Phong => ("Phong", &surface.phong, surface.reference.phong),
        })
        .collect();
    let mut lines = Vec::new();
    let mut add = |name: &str, cells: Vec<[String; 3]>| lines.push(Line::Text(row(name, &cells)));
    let levels = |levels: [f64; 3]| numbers(levels, NEGLIGIBLE);
    let each = |cells: &dyn Fn(usize) -> [String; 3]| (0..columns.len()).map(cells).collect();
    add(
        "",
        each(&|mode| ["", columns[mode].0, ""].map(str::to_owned)),
    );
    add("levels", each(&|_| ["r", "g", "b"].map(str::to_owned)));
    for (index, light) in surface.lights.iter().enumerate() {
        add(
            &light.name,
            each(&|mode| levels(columns[mode].1.terms[index].1)),
        );
    }
    add("drawn", each(&|mode| levels(columns[mode].1.levels)));
    let truth = |mode: usize| match columns[mode].2 {
        Some(truth) => levels(truth.levels),
        None => nothing(),
    };
    add("reference", each(&truth));
    add(
        "bytes",
        each(&|mode| columns[mode].1.bytes.map(|byte| byte.to_string())),
    );
    lines
}

/// A name and triples of cells, their columns right.
fn row(name: &str, triples: &[[String; 3]]) -> String {
    let mut row = format!("{:<NAME$}", fit(name, NAME));
    for cell in triples.iter().flatten() {
        let gap = NUMBER.saturating_sub(cell.chars().count());
        row.push_str(&" ".repeat(gap));
        row.push_str(cell);
    }
    row
}

/// The cells of what does not exist.
fn nothing() -> [String; 3] {
    ["-"; 3].map(str::to_owned)
}

/// In plain notation as long as that says something; 0 for what is `negligible`.
fn numbers(values: [f64; 3], negligible: f64) -> [String; 3] {
    values.map(|value| match value.abs() {
        size if size <= negligible => "0".to_owned(),
        1e-3..1e4 => format!("{value:.3}"),
        _ => format!("{value:.1e}"),
    })
}

/// From a marked pixel to the cross's arms, and their length.
const GAP: i32 = 3;
const ARM: i32 = 8;

/// What a marked pixel takes with its cross.
pub fn mark([x, y]: Point) -> Rect {
    Rect::new(x, y, 1, 1).inset(-(GAP + ARM + 2))
}

/// Marks a pixel, leaving it and its neighbours to be seen.
pub fn draw_cross(canvas: &mut Canvas, [x, y]: Point) {
    for [dx, dy] in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
        let [from_x, from_y] = [x + GAP * dx, y + GAP * dy];
        let [to_x, to_y] = [x + (GAP + ARM) * dx, y + (GAP + ARM) * dy];
        let arm = Rect::new(
            from_x.min(to_x),
            from_y.min(to_y),
            (from_x - to_x).abs() + 1,
            (from_y - to_y).abs() + 1,
        );
        canvas.fill(arm.inset(-1), CROSS_EDGE);
        canvas.fill(arm, CROSS);
    }
}
