//! A colour polynomial in, rows of pixels out.
//!
//! Rule: coefficients are gathered to the row in f64; f32 then rounds each value at most six times at the size of its
//! largest term. Where the tolerance has 1/256 level to spare and no channel leaves the display's range,
//! the value is formed in multiples of 1/256 level at once, so that nothing is left to clamp and the byte only has to be
//! cut out.

use std::ops::Range;

use super::certificate::Color;
use super::display::{display_bits_within, pack};
use super::number::{Number, Truth};
use super::rows::{Rows, Source};
use super::{Row, TileKind, U};

/// A colour that is certified on a patch, alone or with what its pixels have besides, and how it is to be evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polynomial {
    pub(super) color: Color,
    /// How a square is drawn with it. Constant, linear, quadratic: how many of the terms are needed, and it is all light of
    /// the square. Terminator, highlight: some light is in the pixels, and all terms are used.
    pub kind: TileKind,
    /// Whether in multiples of 1/256 level.
    fixed: bool,
}

/// What f32 makes of a value, over the size of its terms.
const ROUNDING: f64 = 6.0 * U;

/// What multiples of 1/256 level cost: two roundings.
const FIXED: f64 = 1.0 / 256.0;

/// The levels that multiples of 1/256 can hold without a clamp: with a half added they stay within 0..256.
const FIXED_RANGE: [f64; 2] = [0.0, 255.49];

/// 1.5 * 2^15: a float added to it, of size below 2^14, is rounded to a multiple of 1/256 and stands, times 256, in the
/// low bits.
const PLACES: f32 = 49_152.0;

/// A level in multiples of 1/256, as an integer of which only the low bits are kept.
#[inline(always)]
fn fixed(level: f32) -> u32 {
    (PLACES + level).to_bits().wrapping_sub(PLACES.to_bits())
}

/// How the colours of some squares may be drawn: bit `i` of each stands for the `i`-th.
#[derive(Clone, Copy, Debug)]
pub struct Ways {
    /// Whether at all.
    possible: u64,
    /// Whether in multiples of 1/256 level.
    fixed: u64,
    /// Whether more than a linear colour is needed.
    curved: u64,
    /// Whether more than one colour is needed.
    sloped: u64,
}

impl Ways {
    /// What is the cheapest that stays within `budget` levels of `color`, f32 included.
    #[inline(always)]
    pub fn new<N: Number>(color: &Color<N>, half: [N; 2], budget: N) -> Self {
        let zero = budget.like(0.0);
        let [mut size, mut curve, mut reach] = [zero; 3];
        let mut possible = zero.below(budget);
        let mut inside = possible;
        for channel in &color.0 {
            let middle = channel.0[0];
            let bend = channel.quadratic_reach(half);
            let sway = channel.linear_reach(half) + bend;
            let rounding = (middle.abs() + sway) * ROUNDING;
            possible = possible & rounding.below(budget);
            inside = inside
                & !(middle - sway).below(budget.like(FIXED_RANGE[0]))
                & !budget.like(FIXED_RANGE[1]).below(middle + sway);
            size = size.or_more(rounding);
            curve = curve.or_more(bend);
            reach = reach.or_more(sway);
        }
        let budget = budget - size;
        let fixed = inside & !budget.below(budget.like(FIXED));
        let budget = fixed.choose(budget - FIXED, budget);
        Ways {
            possible: possible.bits(),
            fixed: fixed.bits(),
            curved: budget.below(curve).bits(),
            sloped: budget.below(reach).bits(),
        }
    }

    /// The polynomial for one of the squares, of these colours.
    #[inline(always)]
    pub fn polynomial<N: Number>(&self, index: usize, colors: &Color<N>) -> Option<Polynomial> {
        let is = |ways: u64| ways >> index & 1 == 1;
        if !is(self.possible) {
            return None;
        }
        Some(Polynomial {
            color: colors.one(index),
            kind: if is(self.curved) {
                TileKind::Quadratic
            } else if is(self.sloped) {
                TileKind::Linear
            } else {
                TileKind::Constant
            },
            fixed: is(self.fixed),
        })
    }
}

/// The cheapest polynomial that stays within `budget` levels of `color`, f32 included; none where `color` itself does
/// not.
#[inline(always)]
pub fn cheapest(color: Color, half: [f64; 2], budget: f64) -> Option<Polynomial> {
    Ways::new(&color, half, budget).polynomial(0, &color)
}

impl Polynomial {
    /// Whether it is all light of its square.
    #[inline(always)]
    pub fn is_whole(&self) -> bool {
        matches!(
            self.kind,
            TileKind::Constant | TileKind::Linear | TileKind::Quadratic
        )
    }

    /// Itself on a square whose first pixel lies `first` pixels right and down of its middle. A part of a square gets the
    /// bits that it has in the whole.
    #[inline(always)]
    pub fn placed(&self, first: [f64; 2]) -> Placed<'_> {
        Placed {
            polynomial: self,
            first,
        }
    }
}

/// A polynomial and where it is drawn.
pub struct Placed<'a> {
    polynomial: &'a Polynomial,
    first: [f64; 2],
}

impl<const SIDE: usize> Source<SIDE> for Placed<'_> {
    #[inline(always)]
    fn for_rows(&self, rows: Range<usize>, target: &mut impl Rows) {
        let Placed { polynomial, first } = *self;
        let color = &polynomial.color.0;
        let mut lanes = [0.0; SIDE];
        for (lane, x) in lanes.iter_mut().enumerate() {
            *x = first[0] as f32 + lane as f32;
        }
        match (polynomial.kind, polynomial.fixed) {
            (TileKind::Constant, _) => {
                let levels = color.map(|channel| channel.0[0] as f32);
                let flat = Flat {
                    pixel: pack(levels.map(display_bits_within)),
                    levels,
                };
                for row in rows {
                    target.take(row, &flat);
                }
            }
            (TileKind::Linear, true) => {
                let mut starts = [[0.0; SIDE]; 3];
                let mut ramps = [[0.0; SIDE]; 3];
                for (channel, polynomial) in color.iter().enumerate() {
                    let [middle, right, down, ..] = polynomial.0;
                    // A half is added here once: then the byte is the whole part.
                    let middle = middle + 0.5;
                    let slope = right as f32;
                    for row in 0..SIDE {
                        starts[channel][row] = (middle + (first[1] + row as f64) * down) as f32;
                    }
                    for lane in 0..SIDE {
                        ramps[channel][lane] = lanes[lane] * slope;
                    }
                }
                let (starts, ramps) = (paired(&starts), paired(&ramps));
                for row in rows {
                    let start = [starts[0][row], starts[1][row]];
                    target.take(
                        row,
                        &Ramp {
                            start,
                            ramps: &ramps,
                        },
                    );
                }
            }
            (_, fixed) => {
                // All rows at once, so that this goes through lanes too.
                let mut middles = [[0.0_f32; SIDE]; 3];
                let mut slopes = [[0.0_f32; SIDE]; 3];
                let bias = if fixed { f64::from(PLACES) + 0.5 } else { 0.0 };
                for (channel, polynomial) in color.iter().enumerate() {
                    let [middle, x, down, _, xy, yy] = polynomial.0;
                    for row in 0..SIDE {
                        let y = first[1] + row as f64;
                        middles[channel][row] = (bias + middle + y * (down + y * yy)) as f32;
                        slopes[channel][row] = (x + y * xy) as f32;
                    }
                }
                let bends = color.map(|channel| channel.0[3] as f32);
                let curve = |row: usize| Curve {
                    middle: [0, 1, 2].map(|channel| middles[channel][row]),
                    slope: [0, 1, 2].map(|channel| slopes[channel][row]),
                    bend: bends,
                    lanes: &lanes,
                };
                // Two loops: asked in one, each row would be prepared for both.
                if fixed {
                    for row in rows {
                        target.take(row, &Places(curve(row)));
                    }
                } else {
                    for row in rows {
                        target.take(row, &curve(row));
                    }
                }
            }
        }
    }
}

/// Red and blue in the upper and the lower half of one integer, green in another, in multiples of 1/256 level.
#[inline(always)]
fn paired<const SIDE: usize>([red, green, blue]: &[[f32; SIDE]; 3]) -> [[u32; SIDE]; 2] {
    let mut pairs = [[0; SIDE]; 2];
    for lane in 0..SIDE {
        pairs[0][lane] = (fixed(red[lane]) << 16).wrapping_add(fixed(blue[lane]));
        pairs[1][lane] = fixed(green[lane]);
    }
    pairs
}

/// A row of one colour.
struct Flat {
    pixel: u32,
    levels: [f32; 3],
}

impl Row for Flat {
    #[inline(always)]
    fn pixel(&self, _lane: usize) -> u32 {
        self.pixel
    }

    #[inline(always)]
    fn levels(&self, _lane: usize) -> [f32; 3] {
        self.levels
    }
}

/// A row of a linear colour in multiples of 1/256 level, as [`paired`] has them: two integer additions a pixel. Borrows
/// between the halves cancel, since each channel's sum is within 0..65536.
struct Ramp<'a, const SIDE: usize> {
    start: [u32; 2],
    ramps: &'a [[u32; SIDE]; 2],
}

impl<const SIDE: usize> Ramp<'_, SIDE> {
    #[inline(always)]
    fn at(&self, lane: usize) -> [u32; 2] {
        [0, 1].map(|pair| self.start[pair].wrapping_add(self.ramps[pair][lane]))
    }
}

impl<const SIDE: usize> Row for Ramp<'_, SIDE> {
    #[inline(always)]
    fn pixel(&self, lane: usize) -> u32 {
        let [red_blue, green] = self.at(lane);
        red_blue >> 8 & 0x00ff_00ff | green & 0xff00
    }

    #[inline(always)]
    fn levels(&self, lane: usize) -> [f32; 3] {
        let [red_blue, green] = self.at(lane);
        [red_blue >> 16, green & 0xffff, red_blue & 0xffff]
            .map(|places| places as f32 / 256.0 - 0.5)
    }
}

/// A row of a quadratic colour.
struct Curve<'a, const SIDE: usize> {
    middle: [f32; 3],
    slope: [f32; 3],
    bend: [f32; 3],
    lanes: &'a [f32; SIDE],
}

impl<const SIDE: usize> Curve<'_, SIDE> {
    #[inline(always)]
    fn at(&self, lane: usize) -> [f32; 3] {
        let x = self.lanes[lane];
        [0, 1, 2].map(|channel| {
            self.middle[channel] + x * (self.slope[channel] + x * self.bend[channel])
        })
    }
}

impl<const SIDE: usize> Row for Curve<'_, SIDE> {
    #[inline(always)]
    fn pixel(&self, lane: usize) -> u32 {
        pack(self.at(lane).map(display_bits_within))
    }

    #[inline(always)]
    fn levels(&self, lane: usize) -> [f32; 3] {
        self.at(lane)
    }
}

/// The same with [`PLACES`] and a half in its middle, so that it comes in multiples of 1/256 level.
struct Places<'a, const SIDE: usize>(Curve<'a, SIDE>);

impl<const SIDE: usize> Row for Places<'_, SIDE> {
    #[inline(always)]
    fn pixel(&self, lane: usize) -> u32 {
        let [red, green, blue] = self.0.at(lane).map(f32::to_bits);
        red << 8 & 0x00ff_0000 | green & 0xff00 | blue >> 8 & 0xff
    }

    #[inline(always)]
    fn levels(&self, lane: usize) -> [f32; 3] {
        self.0.at(lane).map(|level| level - PLACES - 0.5)
    }
}

#[cfg(test)]
mod tests {
    use super::super::display::display_step;
    use super::*;
    use crate::shading::TILE;
    use crate::shading::series::Quadratic;

    /// What is far from the middle of a tile.
    const HALF: [f64; 2] = [7.5, 7.5];

    /// Holds every pixel to the polynomial.
    struct Judge {
        color: Color,
        budget: f64,
        worst: f64,
        shown: [u32; 2],
    }

    impl Rows for Judge {
        fn take(&mut self, row: usize, levels: &impl Row) {
            let y = row as f64 - HALF[1];
            for lane in 0..TILE {
                let x = lane as f64 - HALF[0];
                let found = levels.levels(lane);
                for (channel, found) in self.color.0.iter().zip(found) {
                    let [middle, slope, curve] = channel.row(y);
                    let error = (f64::from(found) - (middle + x * (slope + x * curve))).abs();
                    self.worst = self.worst.max(error);
                }
                let [red, green, blue] = found.map(|level| display_step(f64::from(level)));
                // Where a step of 1/256 or an ulp falls on a half, the byte may be the one above.
                let expected = u32::from_be_bytes([0, red, green, blue]);
                self.shown[usize::from(levels.pixel(lane) == expected)] += 1;
            }
        }
    }

    fn judge(coefficients: [[f64; 6]; 3], budget: f64) -> (Option<Polynomial>, Judge) {
        let color = Color(coefficients.map(Quadratic));
        let mut judge = Judge {
            color,
            budget,
            worst: 0.0,
            shown: [0, 0],
        };
        let polynomial = cheapest(color, HALF, budget);
        if let Some(polynomial) = &polynomial {
            let placed = polynomial.placed([-HALF[0], -HALF[1]]);
            Source::<TILE>::for_rows(&placed, 0..TILE, &mut judge);
        }
        (polynomial, judge)
    }

    #[test]
    fn every_way_to_draw_a_polynomial_stays_within_its_budget_and_shows_the_levels_it_has() {
        let mut ways = std::collections::HashSet::new();
        let mut seed = 1_u64;
        let mut random = move |size: f64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0) * size
        };
        for _ in 0..4000 {
            let [slope, curve] =
                [random(1.0), random(1.0)].map(|size| 10.0_f64.powf(3.0 * size - 2.0));
            let budget = 10.0_f64.powf(random(2.0) - 1.0);
            let coefficients = [0, 1, 2].map(|_| {
                let middle = 128.0 + random(140.0);
                let [x, y] = [random(slope), random(slope)];
                [middle, x, y, random(curve), random(curve), random(curve)]
            });
            let (polynomial, judge) = judge(coefficients, budget);
            let Some(polynomial) = polynomial else {
                continue;
            };
            ways.insert((polynomial.kind, polynomial.fixed));
            assert!(
                judge.worst <= judge.budget,
                "{} levels of {budget}: {polynomial:?}",
                judge.worst
            );
            assert!(
                judge.shown[0] <= 4,
                "{:?} bytes differ: {polynomial:?}",
                judge.shown
            );
        }
        assert_eq!(ways.len(), 6, "three kinds, in steps or not: {ways:?}");
    }

    #[test]
    fn steps_of_a_256th_are_taken_only_where_nothing_has_to_be_clamped() {
        let fixed = |middle: f64, slope: f64, budget: f64| {
            let channel = [middle, slope, 0.0, 0.0, 0.0, 0.0];
            judge([channel; 3], budget)
                .0
                .map(|polynomial| polynomial.fixed)
        };
        assert_eq!(fixed(100.0, 1.0, 0.5), Some(true));
        assert_eq!(
            fixed(100.0, 1.0, 1e-3),
            Some(false),
            "too coarse for the budget"
        );
        assert_eq!(fixed(7.0, 1.0, 0.5), Some(false), "black on one side");
        assert_eq!(fixed(250.0, 1.0, 0.5), Some(false), "white on the other");
        assert_eq!(fixed(100.0, 1.0, 1e-6), None, "f32 itself errs more");
        assert_eq!(fixed(f64::NAN, 1.0, 0.5), None);
    }
}
