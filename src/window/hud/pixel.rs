//! What is known of a pixel -> lines for a board, and the cross that marks it.
//!
//! Rules: every figure is [`Probe`]'s own; what does not exist is "-". Levels are unclamped, bytes are displayed. Lights at
//! one place share one l and r.

use glam::DVec3;

use super::lines::Line;
use crate::canvas::{Canvas, Ink, Point, Rect, fit};
use crate::components::LightKind;
use crate::probe::{PRODUCT_HEADS, Probe, Surface, parts};
use crate::reference::LightSample;

const CROSS: Ink = Ink::solid(0x00ff_ffff);
const CROSS_EDGE: Ink = Ink::glass(0, 170);

/// Letters of a name; longer ones are cut.
const NAME: usize = 11;
/// Letters of a number.
const NUMBER: usize = 9;

/// The lines about `probe`, exact Phong as products among them where `worked`: tables side by side where `wide`, else below
/// one another.
pub fn lines(probe: &Probe, wide: bool, worked: bool) -> Vec<Line> {
    let [x, y] = probe.pixel;
    let title = Line::Title("pixel", format!("{x},{y}"));
    let (Some(object), Some(surface)) = (&probe.object, &probe.surface) else {
        return vec![title, Line::Text("background".to_owned())];
    };
    let vector = |name: &str, vector: Option<DVec3>| Line::Text(row(name, &[parts(vector)]));
    let mut lines = vec![
        title,
        Line::Text(format!("{object}, {}", surface.triangle_label())),
        Line::Text(row("", &[["x", "y", "z"].map(str::to_owned)])),
        vector("position", surface.position),
        vector("normal n", surface.normal),
        vector("to eye o", surface.to_eye),
    ];
    for (names, light) in places(surface) {
        let name = format!("{} l", fit(&names, NAME - 2));
        lines.push(vector(&name, light.to_light));
        lines.push(vector("reflected r", light.reflected));
    }
    let halves: &[&[usize]] = if wide { &[&[0, 1]] } else { &[&[0], &[1]] };
    if worked {
        lines.push(Line::Rule);
        lines.extend(halves.iter().flat_map(|it| products(surface, it)));
    }
    lines.push(Line::Rule);
    lines.extend(halves.iter().flat_map(|it| table(surface, it)));
    lines
}

/// The places of the lights that have one, with the names of the lights there.
pub fn places(surface: &Surface) -> Vec<(String, &LightSample)> {
    let mut places: Vec<(String, &LightSample)> = Vec::new();
    for light in surface
        .lights
        .iter()
        .filter(|it| it.kind != LightKind::Ambient)
    {
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

/// Exact Phong as products of factors, 0, and strengths, 1; these of them side by side.
fn products(surface: &Surface, halves: &[usize]) -> Vec<Line> {
    let titles = surface.product_titles();
    let titles = halves
        .iter()
        .map(|half| format!("{:>width$}", titles[*half], width = 3 * NUMBER));
    let title = format!("{:<NAME$}{}", "exact Phong", titles.collect::<String>());
    let heads = PRODUCT_HEADS.map(|cells| cells.map(str::to_owned));
    let rows = [(String::new(), heads)]
        .into_iter()
        .chain(surface.products());
    let row = |(name, cells): (String, [[String; 3]; 2])| {
        let cells: Vec<_> = halves.iter().map(|half| cells[*half].clone()).collect();
        row(&name, &cells)
    };
    [title]
        .into_iter()
        .chain(rows.map(row))
        .map(Line::Text)
        .collect()
}

/// The table of levels with these modes side by side: 0 is Gouraud, 1 is Phong.
fn table(surface: &Surface, modes: &[usize]) -> Vec<Line> {
    let each = |cells: &dyn Fn(usize) -> [String; 3]| -> Vec<[String; 3]> {
        modes.iter().map(|mode| cells(*mode)).collect()
    };
    let heads = each(&|mode| ["", ["Gouraud", "Phong"][mode], ""].map(str::to_owned));
    let channels = each(&|_| ["r", "g", "b"].map(str::to_owned));
    let mut lines = vec![row("", &heads), row("levels", &channels)];
    let rows = surface.table().into_iter();
    lines.extend(rows.map(|(name, cells)| row(&name, &each(&|mode| cells[mode].clone()))));
    lines.into_iter().map(Line::Text).collect()
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

/// From a marked pixel to the cross's arms, and their length.
const GAP: i32 = 3;
const ARM: i32 = 8;

/// What a marked pixel takes with its cross.
pub fn mark([x, y]: Point) -> Rect {
    Rect::new(x, y, 1, 1).inset(-(GAP + ARM + 2))
}

/// Marks a pixel that reaches so far from its middle, leaving it and what is close to be seen.
pub fn draw_cross(canvas: &mut Canvas, [x, y]: Point, reach: i32) {
    let gap = GAP + reach;
    for [dx, dy] in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
        let [from_x, from_y] = [x + gap * dx, y + gap * dy];
        let [to_x, to_y] = [x + (gap + ARM) * dx, y + (gap + ARM) * dy];
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
