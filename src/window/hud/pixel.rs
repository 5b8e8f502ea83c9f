//! What is known of a pixel -> lines for a board, and the cross that marks it.
//!
//! Rule: every figure is [`Probe`]'s own; what does not exist is "-". Levels are unclamped, bytes are displayed.

use glam::DVec3;

use super::lines::Line;
use crate::canvas::{Canvas, Ink, Point, Rect, fit};
use crate::frame::display_step;
use crate::probe::{Levels, Probe, Shaded, Surface};

const CROSS: Ink = Ink::solid(0x00ff_ffff);
const CROSS_EDGE: Ink = Ink::glass(0, 170);

/// Letters of a name; longer ones are cut.
const NAME: usize = 10;
/// Letters of a number.
const NUMBER: usize = 9;
/// Letters of three numbers.
const TRIPLE: usize = 3 * NUMBER;

/// The lines about `probe`: the modes side by side where `wide`, else below one another.
pub fn lines(probe: &Probe, wide: bool) -> Vec<Line> {
    let [x, y] = probe.pixel;
    let (Some(object), Some(surface)) = (&probe.object, &probe.surface) else {
        return vec![
            Line::Title("pixel", String::new()),
            Line::Text(format!("{x},{y}: background")),
        ];
    };
    let mut lines = vec![
        Line::Title("pixel", format!("{x},{y}")),
        Line::Text(format!("{object}, {}", surface.triangle_label())),
        Line::Heading("vectors"),
        vector("position", surface.position),
        vector("normal   n", surface.normal),
        vector("to eye   o", surface.to_eye),
    ];
    for light in &surface.lights {
        if light.kind != "ambient" {
            lines.push(vector(&named(&light.name, "l"), light.to_light));
            lines.push(vector(&named("", "r"), light.reflected));
        }
    }
    let modes = [
        Column::of("Gouraud", &surface.gouraud, surface.reference.gouraud),
        Column::of("Phong", &surface.phong, surface.reference.phong),
    ];
    lines.push(Line::Heading("levels and bytes"));
    if wide {
        lines.extend(table(surface, &modes));
    } else {
        lines.extend(
            modes
                .iter()
                .flat_map(|mode| table(surface, std::slice::from_ref(mode))),
        );
    }
    lines
}

/// What a mode and its reference make of the pixel.
struct Column<'a> {
    name: &'static str,
    shaded: &'a Shaded,
    reference: Option<Levels>,
}

impl<'a> Column<'a> {
    fn of(name: &'static str, shaded: &'a Shaded, reference: Option<Levels>) -> Self {
        Column {
            name,
            shaded,
            reference,
        }
    }
}

/// Every light's term, the sum as drawn and as it ought to be, and the bytes of both.
fn table(surface: &Surface, columns: &[Column]) -> Vec<Line> {
    let row = |name: &str, cell: &dyn Fn(&Column) -> String| {
        let cells: Vec<_> = columns
            .iter()
            .map(|it| format!("{:>TRIPLE$}  ", cell(it)))
            .collect();
        let cells = cells.concat();
        Line::Text(format!("{:<NAME$}{}", cut(name, NAME), cells.trim_end()))
    };
    let mut lines = vec![row("", &|column| column.name.to_owned())];
    for (index, light) in surface.lights.iter().enumerate() {
        lines.push(row(&light.name, &|column| {
            triple(column.shaded.terms[index].1)
        }));
    }
    let bytes = |bytes: [u8; 3]| numbers(bytes.map(|byte| byte.to_string()));
    let truth = |column: &Column| column.reference.map(|reference| reference.levels);
    let or_none = |text: Option<String>| text.unwrap_or_else(|| "-".to_owned());
    lines.push(row("drawn", &|column| triple(column.shaded.levels)));
    lines.push(row("reference", &|column| {
        or_none(truth(column).map(triple))
    }));
    lines.push(row("bytes", &|column| bytes(column.shaded.bytes)));
    lines.push(row("reference", &|column| {
        or_none(truth(column).map(|levels| bytes(levels.map(display_step))))
    }));
    lines
}

fn vector(name: &str, vector: Option<DVec3>) -> Line {
    let value = vector.map_or_else(|| "-".to_owned(), |it| triple(it.to_array()));
    Line::Text(format!("{name:<NAME$}{value:>TRIPLE$}"))
}

/// A name and a sign at the end of its column.
fn named(name: &str, sign: &str) -> String {
    format!("{:<width$}{sign}", cut(name, NAME - 2), width = NAME - 1)
}

fn cut(name: &str, letters: usize) -> String {
    fit(name, letters)
}

fn triple(values: [f64; 3]) -> String {
    numbers(values.map(number))
}

fn numbers(numbers: [String; 3]) -> String {
    numbers.map(|number| format!("{number:>NUMBER$}")).concat()
}

/// In plain notation as long as that says something.
fn number(value: f64) -> String {
    // Adding zero takes the sign off a negative zero.
    let value = value + 0.0;
    if value == 0.0 || (1e-3..1e4).contains(&value.abs()) {
        format!("{value:.3}")
    } else {
        format!("{value:.1e}")
    }
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
