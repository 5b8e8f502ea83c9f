//! The levels along the probed pixel's row -> a board with a plot of them.
//!
//! ```text
//!   255 |        .-.        reference: dots
//!       |  ____.'   '.___   Phong, Gouraud: lines
//!     0 |_______|________   the probed column
//! ```
//! Rule: each pixel has the level of its brightest channel in the reference, so that all curves show the same channel.

use super::lines::Line;
use crate::canvas::{Canvas, Ink, Rect};
use crate::probe::Profile;
use crate::window::session::Session;

/// The colours of the curves, and what they are called.
const GOURAUD: u32 = 0x00ff_b454;
const PHONG: u32 = 0x0034_d399;
const REFERENCE: u32 = 0x00ff_ffff;
const GRID: Ink = Ink::glass(0x00ff_ffff, 40);
const PROBED: Ink = Ink::glass(0x00ff_ffff, 120);
/// How far apart the reference's dots are, in pixels.
const DOTS: i32 = 6;

/// What a plot shows: of each column the levels of Gouraud, Phong and the reference, 0 to 255.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    pub columns: Vec<[f32; 3]>,
    /// The column that is probed.
    pub probed: usize,
}

/// What is shown; empty where nothing is probed.
pub fn lines(session: &Session) -> Vec<Line> {
    let (Some(profile), Some(probe)) = (&session.profile, &session.probe) else {
        return Vec::new();
    };
    let [column, row] = probe.pixel;
    let swatches = [(GOURAUD, "Gouraud"), (PHONG, "Phong"), (REFERENCE, "exact")];
    let swatches = swatches.map(|(color, name)| (color, name.to_owned()));
    vec![
        Line::Title("levels", format!("along row {row}, 0 to 255")),
        Line::Profile(Plot {
            columns: columns(profile),
            probed: column,
        }),
        Line::Swatches(swatches.to_vec()),
    ]
}

fn columns(profile: &Profile) -> Vec<[f32; 3]> {
    let modes = profile.gouraud.iter().zip(&profile.phong);
    let all = modes.zip(&profile.reference);
    let column = |((gouraud, phong), exact): ((&[f64; 3], &[f64; 3]), &[f64; 3])| {
        let channels = [0, 1, 2].into_iter();
        let brightest =
            channels.reduce(|one, next| if exact[next] > exact[one] { next } else { one });
        [gouraud, phong, exact]
            .map(|levels| levels[brightest.unwrap_or(0)].clamp(0.0, 255.0) as f32)
    };
    all.map(column).collect()
}

/// Draws the curves in `area`.
pub fn draw(canvas: &mut Canvas, plot: &Plot, area: Rect) {
    let count = plot.columns.len().max(1);
    let column = |x: i32| (x as usize * count / area.width.max(1) as usize).min(count - 1);
    let height = |level: f32| (level / 255.0 * (area.height - 1) as f32).round() as i32;
    for level in [0.0, 127.5, 255.0] {
        let y = area.bottom() - 1 - height(level);
        canvas.fill(Rect::new(area.x, y, area.width, 1), GRID);
    }
    let probed = plot.probed as i32 * area.width / count as i32;
    canvas.fill(Rect::new(area.x + probed, area.y, 1, area.height), PROBED);
    for (curve, color) in [(0, GOURAUD), (1, PHONG), (2, REFERENCE)] {
        for x in 0..area.width {
            let Some(here) = plot.columns.get(column(x)) else {
                return;
            };
            let before = plot.columns[column((x - 1).max(0))];
            let [from, to] = [before[curve], here[curve]].map(height);
            let bar = if color == REFERENCE {
                Rect::new(area.x + x, area.bottom() - 1 - to, 2, 2)
            } else {
                let low = from.min(to);
                let top = area.bottom() - 1 - from.max(to);
                Rect::new(area.x + x, top, 1, from.max(to) - low + 2)
            };
            if color != REFERENCE || x % DOTS == 0 {
                canvas.fill(bar, Ink::solid(color));
            }
        }
    }
}
