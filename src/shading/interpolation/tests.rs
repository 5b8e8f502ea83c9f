//! Drawn squares against the polynomials they are drawn from.
//!
//! Rule: every kind of row keeps the rest of the tolerance, and shows the levels it has.

use super::*;
use crate::shading::display::display_step;
use crate::shading::rows::Rows;
use crate::shading::running::Rounded;
use crate::shading::simd::{Baseline, baseline};

/// The term that each pixel makes of the fourth channel, and its factors.
type Fourth = Option<(SquareKind, [f64; 3])>;

/// Compares every pixel of a square with its polynomial.
struct Judge {
    color: [[[f64; 3]; 3]; 4],
    fourth: Fourth,
    side: usize,
    worst: f64,
    /// Pixels that differ from the display step of the levels, and others.
    shown: [u32; 2],
}

impl Judge {
    /// The channels at a place from -1 to 1, unclamped.
    fn at(&self, place: [f64; 2]) -> [f64; 3] {
        let [x, y] = place.map(|x| [1.0, x, x * x]);
        let value = |nine: &[[f64; 3]; 3]| {
            let terms = (0..9).map(|term| nine[term / 3][term % 3] * y[term / 3] * x[term % 3]);
            terms.sum::<f64>()
        };
        let fourth = value(&self.color[3]);
        let (term, factors) = match self.fourth {
            Some((SquareKind::Highlight, factors)) => (fourth.exp2(), factors),
            Some((_, factors)) => (fourth.max(0.0), factors),
            None => (0.0, [0.0; 3]),
        };
        [0, 1, 2].map(|channel| value(&self.color[channel]) + term * factors[channel])
    }
}

impl Judge {
    fn draw(&mut self, rows: &mut impl Rows<Baseline>) {
        for part in 0..self.side / 16 {
            rows.go_to(part);
            for row in 0..self.side {
                let (levels, pixels) = (rows.levels(row), rows.pixels(row));
                for lane in 0..16 {
                    let column = 16 * part + lane;
                    let last = (self.side - 1) as f64;
                    let place = [column, row].map(|pixel| 2.0 * pixel as f64 / last - 1.0);
                    let found = levels.map(|levels| levels[lane]);
                    for (found, expected) in found.iter().zip(self.at(place)) {
                        self.worst = self.worst.max((f64::from(*found) - expected).abs());
                    }
                    let [red, green, blue] = found.map(|level| display_step(f64::from(level)));
                    // Where a step of 1/256 or an ulp falls on a half, the byte may be the one above.
                    let expected = u32::from_be_bytes([0, red, green, blue]);
                    self.shown[usize::from(pixels[lane] == expected)] += 1;
                }
            }
        }
    }
}

fn judge(
    color: &[[[f64; 3]; 3]; 4],
    fourth: Fourth,
    side: usize,
    rest: f64,
) -> (Option<(SquareKind, [bool; 2])>, Judge) {
    let simd = baseline();
    let lanes = |number| f64x4::splat(simd, number);
    let interpolant = Interpolant::new(
        color.map(|nine| nine.map(|row| row.map(lanes))),
        [fourth.map_or([0.0; 3], |it| it.1.map(|factor| factor as f32)); 4],
        fourth.map_or(0, |it| {
            if it.0 == SquareKind::Highlight {
                0b1111
            } else {
                0
            }
        }),
        lanes(rest),
    );
    let mut judge = Judge {
        color: *color,
        fourth,
        side,
        worst: 0.0,
        shown: [0; 2],
    };
    let kind = interpolant.kinds[2];
    if kind.is_some() {
        let square = Square::whole([96, 64], side);
        match interpolant.linear_rows(simd, 2, &square) {
            Some(mut ramp) => judge.draw(&mut ramp),
            None => judge.draw(&mut interpolant.quadratic_rows(simd, 2, &square)),
        }
    }
    let form = [interpolant.linear, interpolant.fixed].map(|squares| has(squares, 2));
    (kind.map(|kind| (kind, form)), judge)
}

#[test]
fn every_form_stays_within_its_budget_and_shows_the_levels_it_has() {
    let mut forms = std::collections::HashSet::new();
    let mut seed = 1_u64;
    let mut random = move |size: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        ((seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0) * size
    };
    for case in 0..3000 {
        let [slope, curve] = [0, 1].map(|_| 10.0_f64.powf(random(1.5)));
        let rest = 10.0_f64.powf(random(2.0) - 1.0);
        // Terms of higher order are as large as the others, or so much smaller.
        let falls = [1.0, 8.0_f64][(case / 2 % 2) as usize];
        let mut nine = |middle: f64, slope: f64, curve: f64| {
            let mut term = |order: i32, size: f64| random(size / falls.powi(order));
            [
                [middle, term(0, slope), term(0, curve)],
                [term(0, slope), term(0, curve), term(1, curve)],
                [term(0, curve), term(1, curve), term(2, curve)],
            ]
        };
        let middle = 128.0 + f64::from(case % 280 - 140);
        let color = [
            nine(middle, slope, curve),
            nine(middle, slope, curve),
            nine(middle, slope, curve),
            nine([0.0, -3.0][(case % 2) as usize], 0.5, 0.1),
        ];
        let fourth = match case % 10 {
            0 => Some((SquareKind::Terminator, [200.0, 90.0, 0.0])),
            5 => Some((SquareKind::Highlight, [2000.0, 90.0, 0.0])),
            _ => None,
        };
        let side = [16, 32][case as usize % 2];
        let (form, judge) = judge(&color, fourth, side, rest);
        let Some(form) = form else {
            continue;
        };
        forms.insert(form);
        assert!(
            judge.worst <= rest,
            "{} levels of {rest}: {form:?}, {color:?}",
            judge.worst
        );
        assert!(
            judge.shown[0] <= 16,
            "{:?} pixels differ: {form:?}",
            judge.shown
        );
    }
    // A colour is linear or not, and in steps or not; each alone, with a terminator and with a highlight.
    assert_eq!(forms.len(), 12, "{forms:?}");
}

#[test]
fn steps_of_a_256th_are_taken_only_where_nothing_has_to_be_clamped() {
    let fixed = |middle: f64, slope: f64, rest: f64| {
        let nine = [[middle, slope, 0.0], [0.0; 3], [0.0; 3]];
        let color = [nine, nine, nine, [[0.0; 3]; 3]];
        judge(&color, None, 16, rest).0.map(|(_, [_, fixed])| fixed)
    };
    assert_eq!(fixed(100.0, 8.0, 0.5), Some(true));
    assert_eq!(fixed(100.0, 8.0, 1e-3), Some(false), "too coarse for it");
    assert_eq!(fixed(7.0, 8.0, 0.5), Some(false), "black on one side");
    assert_eq!(fixed(250.0, 8.0, 0.5), Some(false), "white on the other");
    assert_eq!(fixed(100.0, 8.0, 1e-6), None, "f32 itself errs more");
    assert_eq!(fixed(f64::NAN, 8.0, 0.5), None);
    // They leave less for the half level of an x^2 that is left out.
    let bent = [[100.0, 0.0, 1.0], [0.0; 3], [0.0; 3]];
    let color = [bent, bent, bent, [[0.0; 3]; 3]];
    for (rest, kind) in [(0.505, SquareKind::Quadratic), (0.51, SquareKind::Linear)] {
        let is_linear = kind == SquareKind::Linear;
        let (form, _) = judge(&color, None, 16, rest);
        assert_eq!(form, Some((kind, [is_linear, true])));
    }
    // A fourth channel is clamped, but no float of 2^14 levels or more is rounded to a step.
    let fixed = |levels: f64| {
        let color = [[[0.0; 3]; 3]; 4];
        let fourth = Some((SquareKind::Terminator, [levels; 3]));
        judge(&color, fourth, 16, 0.5)
            .0
            .map(|(_, [_, fixed])| fixed)
    };
    assert_eq!(fixed(15_900.0), Some(true));
    assert_eq!(fixed(16_100.0), Some(false));
}

#[test]
fn a_colour_with_any_term_that_is_not_a_number_is_not_drawn() {
    for (channel, term) in (0..3).flat_map(|channel| (0..9).map(move |term| (channel, term))) {
        for number in [f64::NAN, f64::INFINITY] {
            let mut color = [[[0.0; 3]; 3]; 4];
            color[channel][term / 3][term % 3] = number;
            let (form, _) = judge(&color, None, 16, 4.0);
            assert_eq!(form, None, "{number} at {channel}, {term}");
        }
    }
}

#[test]
fn the_count_of_roundings_is_what_a_running_error_analysis_finds() {
    // x^2 y^2 alone, at the corner, through the rows of a terminator.
    let [zero, one] = [0.0, 1.0].map(Rounded::exact);
    let bend = (one * Rounded::stored(1.0) + zero) * one + zero;
    let lit = (bend * one + zero) * one + zero;
    let level = zero + lit * Rounded::stored(1.0);
    // The display may be that of the next float.
    let count = (level.error + 2.0 * level.value) * U;
    let share = count / ROW_ERROR;
    assert!((0.9999..1.0).contains(&share), "{share}");
}

#[test]
fn steps_of_a_256th_cost_what_they_are_said_to() {
    let mut worst = 0.0_f64;
    for case in 0..400 {
        let term = |factor: f64, size: f64| size * (f64::from(case) * factor).sin();
        let nine = [
            [128.0 + term(1.3, 90.0), term(0.7, 9.0), 0.0],
            [term(2.1, 9.0), 0.0, 0.0],
            [0.0; 3],
        ];
        let bent = [nine[0], nine[1], [0.0, 0.0, 0.1]];
        let color = [[nine; 3], [bent; 3]][case as usize % 2];
        let [red, green, blue] = color;
        // Too little to leave out what is bent.
        let rest = FIXED_ERROR + 256.0 * ROW_ERROR;
        let (form, judge) = judge(&[red, green, blue, [[0.0; 3]; 3]], None, 16, rest);
        assert!(form.is_some_and(|(_, [_, fixed])| fixed), "{form:?}");
        worst = worst.max(judge.worst);
    }
    println!("{:.3} of the count", worst / FIXED_ERROR);
    assert!(worst <= FIXED_ERROR, "{worst}");
    assert!(worst > 0.5 * FIXED_ERROR, "{worst}: the count is loose");
}

#[test]
fn samples_err_by_no_more_in_between_than_the_constant_says() {
    // Errors of one that alternate weigh most, and in the corners.
    let simd = baseline();
    let signs = [1.0, -1.0, 1.0];
    let samples = signs.map(|y: f64| signs.map(|x| f64x4::splat(simd, x * y)));
    let terms = biquadratic(&samples).map(|row| row.map(|term| term.as_array()[0]));
    let corner: f64 = terms.as_flattened().iter().sum();
    assert!((corner - AMPLIFICATION).abs() < 1e-12, "{corner}");
}

#[test]
fn every_term_that_is_left_out_counts_at_its_size_whatever_its_sign() {
    let number = |value| f64x4::splat(baseline(), value);
    let power = |x: f64, exponent: usize| x.powi(exponent as i32);
    for (j, i) in (0..9).map(|term| (term / 3, term % 3)) {
        for sign in [1.0, -1.0] {
            // One level of one term.
            let mut terms = [[[number(0.0); 3]; 3]; 4];
            terms[1][j][i] = number(sign);
            let mut kinds = [0; 3];
            for step in 1..=120 {
                let rest = f64::from(step) / 100.0;
                let interpolant = Interpolant::new(terms, [[0.0; 3]; 4], 0, number(rest));
                let kind = interpolant.kinds[0].expect("a rest of the tolerance");
                kinds[kind as usize] += 1;
                // Half extents of a pixel.
                let square = Square::whole([0, 0], 3);
                let color = interpolant.color(0, &square)[1];
                let grid = (0..=20).map(|place| f64::from(place) / 10.0 - 1.0);
                for (x, y) in grid.clone().flat_map(|x| grid.clone().map(move |y| (x, y))) {
                    let drawn = (0..9).map(|term| {
                        color[term / 3][term % 3] * power(y, term / 3) * power(x, term % 3)
                    });
                    let error = (drawn.sum::<f64>() - sign * power(y, j) * power(x, i)).abs();
                    assert!(error <= rest, "{error} of {rest} for {sign} x^{i} y^{j}");
                }
            }
            // No term is counted at more than its size.
            assert!(kinds[SquareKind::Linear as usize] >= 19, "{kinds:?}");
        }
    }
}

#[test]
fn a_fourth_channel_is_drawn_in_any_other_unless_its_levels_are_rounded_too_coarsely() {
    for kind in [SquareKind::Terminator, SquareKind::Highlight] {
        for (case, fourth) in (0..27).flat_map(|case| [-1.0, 1.0].map(|it| (case, it))) {
            let (channel, j, i) = (case / 9, case / 3 % 3, case % 3);
            let mut color = [[[0.0; 3]; 3]; 4];
            color[3][j][i] = fourth;
            let found = |levels: f64| {
                let mut factors = [0.0; 3];
                factors[channel] = levels;
                let (form, _) = judge(&color, Some((kind, factors)), 16, 0.5);
                form.map(|(kind, _)| kind)
            };
            assert_eq!(found(100.0), Some(kind));
            assert_eq!(found(1e9), None);
            // Longer exponents have too few digits behind the point.
            for (size, expected) in [(0.99e6, Some(kind)), (1.01e6, None)] {
                color[3][j][i] = size * fourth;
                let (form, _) = judge(&color, Some((kind, [1e-9; 3])), 16, 0.5);
                assert_eq!(form.map(|(kind, _)| kind), expected);
            }
        }
    }
}
