//! A colour polynomial in, rows of levels out.
//!
//! Rule: coefficients are gathered to the row in f64; f32 then rounds each value at most six times at the size of its
//! largest term ([`rounding`]).

use super::certificate::Color;
use super::patch::Patch;
use super::{Coverage, Sink, TILE, TileKind, U};

/// Shades the covered pixels of a tile with as many terms as `kind` has.
#[inline(always)]
pub fn shade(
    color: &Color,
    kind: TileKind,
    patch: &Patch,
    coverage: &Coverage,
    sink: &mut impl Sink,
) {
    let lanes = patch.lanes();
    let mut levels = [[0.0; TILE]; 3];
    if kind == TileKind::Constant {
        levels = color.0.map(|channel| [channel.0[0] as f32; TILE]);
    }
    for (row, &(from, to)) in coverage.spans.iter().enumerate() {
        if from < to {
            let y = row as f64 - patch.row;
            match kind {
                TileKind::Constant => {}
                TileKind::Linear => {
                    for (levels, channel) in levels.iter_mut().zip(&color.0) {
                        let [middle, x, down, ..] = channel.0;
                        let (middle, slope) = ((middle + down * y) as f32, x as f32);
                        for lane in 0..TILE {
                            levels[lane] = middle + lanes[lane] * slope;
                        }
                    }
                }
                _ => row_of(color, y, &lanes, &mut levels),
            }
            sink.take(row, &levels);
        }
    }
}

/// One row, `y` pixels below the middle, with all terms.
#[inline(always)]
pub fn row_of(color: &Color, y: f64, lanes: &[f32; TILE], levels: &mut [[f32; TILE]; 3]) {
    for (levels, channel) in levels.iter_mut().zip(&color.0) {
        let [middle, slope, curve] = channel.row(y).map(|coefficient| coefficient as f32);
        for lane in 0..TILE {
            levels[lane] = middle + lanes[lane] * (slope + lanes[lane] * curve);
        }
    }
}

/// A bound on what f32 costs, in levels.
#[inline(always)]
pub fn rounding(color: &Color, half: [f64; 2]) -> f64 {
    6.0 * U
        * color.largest(|channel| {
            channel.0[0].abs() + channel.linear_reach(half) + channel.quadratic_reach(half)
        })
}

/// The cheapest kind of polynomial that stays within `budget` levels of `color`.
#[inline(always)]
pub fn cheapest(color: &Color, half: [f64; 2], budget: f64) -> TileKind {
    let curve = color.largest(|channel| channel.quadratic_reach(half));
    if curve > budget {
        TileKind::Quadratic
    } else if color.largest(|channel| channel.linear_reach(half) + channel.quadratic_reach(half))
        > budget
    {
        TileKind::Linear
    } else {
        TileKind::Constant
    }
}
