//! The vectors at the probed pixel -> arrows in the picture: n, o, and l and r of each place that has lights.
//!
//! Rule: unit vectors are seen in parallel along the view, so an arrow's length says how far it leans towards the viewer
//! or away; one that points along the view is a dot.

use glam::DVec3;

use super::lines::brightest;
use super::pixel::places;
use crate::canvas::{Canvas, Face, Ink, Point, Rect, mix};
use crate::components::{Light, Viewpoint};
use crate::window::session::Session;

const NORMAL: u32 = 0x00ff_ffff;
const TO_EYE: u32 = 0x0060_c8ff;
/// How long a unit vector across the view is, in heights of a letter.
const LENGTH: i32 = 9;
/// From the probed pixel to an arrow's beginning, in pixels.
const START: i32 = 7;
const EDGE: Ink = Ink::glass(0, 150);

/// An arrow from the probed pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    /// The unit vector right and down in the picture.
    pub way: [f64; 2],
    pub name: &'static str,
    /// 0x00RRGGBB.
    pub color: u32,
}

/// The arrows of what is probed; the later ones lie above.
pub fn arrows(session: &Session, viewpoint: &Viewpoint) -> Vec<Arrow> {
    let Some(surface) = session.probe.as_ref().and_then(|it| it.surface.as_ref()) else {
        return Vec::new();
    };
    let [right, up, _] = viewpoint.axes();
    let arrow = |name, color, vector: Option<DVec3>| {
        vector.map(|vector| Arrow {
            way: [vector.dot(right), -vector.dot(up)],
            name,
            color,
        })
    };
    let mut arrows = Vec::new();
    for (_, light) in places(surface) {
        let index = session.light_named(&light.name);
        let color = index.and_then(|it| session.light(it));
        let color = color.map_or(NORMAL, |Light { color, .. }| brightest(color));
        arrows.extend(arrow("r", mix(0, color, 170), light.reflected));
        arrows.extend(arrow("l", color, light.to_light));
    }
    arrows.extend(arrow("o", TO_EYE, surface.to_eye));
    arrows.extend(arrow("n", NORMAL, surface.normal));
    arrows
}

impl Arrow {
    /// What it takes of the window, its name included.
    pub fn rect(&self, from: Point, face: Face) -> Rect {
        let length = f64::from(LENGTH * face.height());
        let by = self.way.map(|way| (way * length) as i32);
        let [left, top] = [by[0].min(0), by[1].min(0)];
        let shaft = Rect::new(from[0] + left, from[1] + top, by[0].abs(), by[1].abs());
        shaft.inset(-face.height())
    }
}

/// Draws an arrow that begins beside the pixel `from`; one that points along the view has no room for a shaft, only for its name.
pub fn draw(canvas: &mut Canvas, arrow: &Arrow, from: Point, face: Face) {
    let length = f64::from(LENGTH * face.height());
    let [x, y] = arrow.way;
    let point = |share: f64, aside: f64| {
        let by = [x * share - y * aside, y * share + x * aside];
        [0, 1].map(|axis| from[axis] as f32 + 0.5 + (by[axis] * length) as f32)
    };
    let ink = Ink::solid(arrow.color);
    let start = f64::from(START) / (length * x.hypot(y));
    let tip = if start < 1.0 {
        point(1.0, 0.0)
    } else {
        [from[0] + START, from[1] - START].map(|at| at as f32)
    };
    if start < 1.0 {
        for (width, ink) in [(5.0, EDGE), (2.0, ink)] {
            canvas.line(point(start, 0.0), tip, width, ink);
            for aside in [-0.05, 0.05] {
                canvas.line(point(0.9, aside), tip, width, ink);
            }
        }
    }
    let place = [
        tip[0] as i32 + face.advance() / 2,
        tip[1] as i32 - face.height() / 2,
    ];
    for [x, y] in [[-1, 0], [1, 0], [0, -1], [0, 1]] {
        canvas.bold(face, [place[0] + x, place[1] + y], EDGE, arrow.name);
    }
    canvas.bold(face, place, ink, arrow.name);
}
