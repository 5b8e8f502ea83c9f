//! A colour polynomial in, rows of levels out.
//!
//! Rule: coefficients are gathered to the row in f64; f32 then rounds each value at most six times at the size of its
//! largest term ([`rounding`]).

use std::ops::Range;

use super::certificate::Color;
use super::{Coverage, Sink, TILE, TileKind, TileRow, U};

/// Shades the covered pixels of a tile with as many terms as `kind` has; the tile's first pixel lies `first` pixels
/// right and down of the polynomial's middle.
#[inline(always)]
pub fn shade(
    color: &Color,
    kind: TileKind,
    first: [f64; 2],
    coverage: &Coverage,
    sink: &mut impl Sink,
) {
    let rows = usize::from(coverage.rows[0])..usize::from(coverage.rows[1]) + 1;
    for_rows(color, kind, first, rows, &mut Covered { coverage, sink });
}

/// Takes the rows of a square. A trait, not a closure, because only a function can be told to become part of the loop
/// it is called from, whose SIMD level it then has.
pub trait Rows<const SIDE: usize> {
    /// Takes a row, in levels, unclamped.
    fn take(&mut self, row: usize, levels: &[[f32; SIDE]; 3]);
}

/// Hands the covered rows of a tile to its sink.
struct Covered<'a, S> {
    coverage: &'a Coverage,
    sink: &'a mut S,
}

impl<S: Sink> Rows<TILE> for Covered<'_, S> {
    #[inline(always)]
    fn take(&mut self, row: usize, levels: &TileRow) {
        let (from, to) = self.coverage.spans[row];
        if from < to {
            self.sink.take_within(row, levels);
        }
    }
}

/// Evaluates `rows` of a square of `SIDE` pixels and hands them on one by one.
#[inline(always)]
pub fn for_rows<const SIDE: usize>(
    color: &Color,
    kind: TileKind,
    first: [f64; 2],
    rows: Range<usize>,
    target: &mut impl Rows<SIDE>,
) {
    let mut lanes = [0.0; SIDE];
    for (lane, x) in lanes.iter_mut().enumerate() {
        *x = first[0] as f32 + lane as f32;
    }
    // All rows at once, so that this goes through lanes too.
    let mut middles = [[0.0_f32; SIDE]; 3];
    let mut slopes = [[0.0_f32; SIDE]; 3];
    for (channel, polynomial) in color.0.iter().enumerate() {
        let [middle, x, down, _, xy, yy] = polynomial.0;
        for row in 0..SIDE {
            let y = first[1] + row as f64;
            middles[channel][row] = (middle + y * (down + y * yy)) as f32;
            slopes[channel][row] = (x + y * xy) as f32;
        }
    }
    let curves = color.0.map(|channel| channel.0[3] as f32);
    let mut levels = color.0.map(|channel| [channel.0[0] as f32; SIDE]);
    for row in rows {
        match kind {
            TileKind::Constant => {}
            TileKind::Linear => {
                for channel in 0..3 {
                    let (middle, slope) = (middles[channel][row], slopes[channel][row]);
                    for lane in 0..SIDE {
                        levels[channel][lane] = middle + lanes[lane] * slope;
                    }
                }
            }
            _ => {
                for channel in 0..3 {
                    let (middle, slope, curve) =
                        (middles[channel][row], slopes[channel][row], curves[channel]);
                    for lane in 0..SIDE {
                        levels[channel][lane] =
                            middle + lanes[lane] * (slope + lanes[lane] * curve);
                    }
                }
            }
        }
        target.take(row, &levels);
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

/// The cheapest kind of polynomial that stays within `budget` levels of `color`, f32 included; none where `color`
/// itself does not.
#[inline(always)]
pub fn cheapest(color: Color, half: [f64; 2], budget: f64) -> Option<(Color, TileKind)> {
    let budget = budget - rounding(&color, half);
    if budget.is_nan() || budget < 0.0 {
        return None;
    }
    let curve = color.largest(|channel| channel.quadratic_reach(half));
    if curve > budget {
        Some((color, TileKind::Quadratic))
    } else if color.largest(|channel| channel.linear_reach(half) + channel.quadratic_reach(half))
        > budget
    {
        Some((color, TileKind::Linear))
    } else {
        Some((color, TileKind::Constant))
    }
}
