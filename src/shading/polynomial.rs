//! A colour polynomial in, rows of levels out.
//!
//! Rule: coefficients are gathered to the row in f64; f32 then rounds each value at most six times at the size of its
//! largest term ([`rounding`]).

use super::certificate::Color;
use super::{Coverage, Sink, TILE, TileKind, U};

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
    let mut lanes = [0.0; TILE];
    for (lane, x) in lanes.iter_mut().enumerate() {
        *x = first[0] as f32 + lane as f32;
    }
    // All rows at once, so that this goes through lanes too.
    let mut rows = [[[0.0_f32; TILE]; 2]; 3];
    for (row, channel) in rows.iter_mut().zip(&color.0) {
        let [middle, x, down, _, xy, yy] = channel.0;
        for line in 0..TILE {
            let y = first[1] + line as f64;
            row[0][line] = (middle + y * (down + y * yy)) as f32;
            row[1][line] = (x + y * xy) as f32;
        }
    }
    let curves = color.0.map(|channel| channel.0[3] as f32);
    let mut levels = color.0.map(|channel| [channel.0[0] as f32; TILE]);
    for (line, &(from, to)) in coverage.spans.iter().enumerate() {
        if from < to {
            match kind {
                TileKind::Constant => {}
                TileKind::Linear => {
                    for channel in 0..3 {
                        let [middle, slope] = rows[channel].map(|terms| terms[line]);
                        for lane in 0..TILE {
                            levels[channel][lane] = middle + lanes[lane] * slope;
                        }
                    }
                }
                _ => {
                    for channel in 0..3 {
                        let ([middle, slope], curve) =
                            (rows[channel].map(|terms| terms[line]), curves[channel]);
                        for lane in 0..TILE {
                            levels[channel][lane] =
                                middle + lanes[lane] * (slope + lanes[lane] * curve);
                        }
                    }
                }
            }
            sink.take_within(line, &levels);
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
