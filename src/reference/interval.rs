//! Interval arithmetic in f64 with outward rounding.
//!
//! ```text
//! sum      s = a + b     the rounding error is a float: (a - (s - (s - a))) + (b - (s - a))       (Knuth's TwoSum)
//! product  p = a b       it is exact where fma(a, b, -p) is 0, and p is no smaller than TINY
//! ```
//!
//! The exact result of an operation on any numbers of its intervals lies in the resulting interval. Operations of f64
//! round to nearest, so a bound that is not exact moves outwards by one float. A result that is undefined for some of
//! the numbers, such as a division by an interval that holds 0, is the interval of all numbers. Exponential, logarithm,
//! sine and cosine come from the crate maryada, whose bounds are proven (IEEE 1788.1).

use std::cmp::Ordering;
use std::f64::consts::PI;
use std::ops::{Add, Div, Mul, Neg, Sub};

use maryada::{EnclosureOps, IntervalOps};

use super::real::Real;

/// Up to this |n.l| the gate of a specular light is tied: it may be open or closed.
const GATE_TIE: f64 = 1e-6;

/// Every number from `least` to `largest`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    least: f64,
    largest: f64,
}

/// Below this magnitude the error of a product or a quotient may not be a float, so that it cannot be found to be 0.
const TINY: f64 = 1e-280;

/// Whether a b is `product`, which is no smaller than [`TINY`]. The product of an odd integer of m bits and one of n bits has at
/// least m + n - 1, and a float has 53. So most products are known to be rounded without the fma, which many processors take
/// from a library.
fn is_product(a: f64, b: f64, product: f64) -> bool {
    let bits = |factor: f64| 53 - (factor.to_bits() | 1 << 52).trailing_zeros();
    bits(a) + bits(b) <= 54 && a.mul_add(b, -product) == 0.0
}

impl Interval {
    /// Every number.
    pub const ALL: Interval = Interval {
        least: f64::NEG_INFINITY,
        largest: f64::INFINITY,
    };

    /// The numbers from `least` to `largest`; all numbers unless `least <= largest`, as with NaN.
    pub fn new(least: f64, largest: f64) -> Self {
        if least <= largest {
            Interval { least, largest }
        } else {
            Interval::ALL
        }
    }

    /// The numbers between two results. Each is given with whether it is exact; otherwise it is rounded to nearest.
    fn between(least: (f64, bool), largest: (f64, bool)) -> Self {
        if least.0.is_nan() || largest.0.is_nan() {
            return Interval::ALL;
        }
        let below =
            |(value, is_exact): (f64, bool)| if is_exact { value } else { value.next_down() };
        let above = |(value, is_exact): (f64, bool)| if is_exact { value } else { value.next_up() };
        Interval {
            least: below(least),
            largest: above(largest),
        }
    }

    /// The side of 0 on which the interval lies: `Greater` if it holds no negative number, `Less` if it holds no positive one.
    fn side(self) -> Option<Ordering> {
        if self.least >= 0.0 {
            Some(Ordering::Greater)
        } else if self.largest <= 0.0 {
            Some(Ordering::Less)
        } else {
            None
        }
    }

    /// Applies a function of the crate maryada.
    fn map(self, of: impl Fn(maryada::Interval) -> maryada::Interval) -> Self {
        let result = of(maryada::Interval::new(self.least, self.largest));
        // An empty interval has endpoints in the wrong order.
        Interval::new(result.inf(), result.sup())
    }
}

impl Real for Interval {
    fn of(value: f64) -> Self {
        Interval::new(value, value)
    }

    fn endpoints(self) -> [f64; 2] {
        [self.least, self.largest]
    }

    fn sign(self, margin: f64) -> Option<Ordering> {
        match self.endpoints() {
            [0.0, 0.0] if margin == 0.0 => Some(Ordering::Equal),
            [least, _] if least > margin => Some(Ordering::Greater),
            [_, largest] if largest < -margin => Some(Ordering::Less),
            _ => None,
        }
    }

    fn gate(self, if_tied: bool) -> Option<bool> {
        match self.endpoints() {
            _ if self.is_tied() => Some(if_tied),
            [least, _] if least > 0.0 => Some(true),
            [_, largest] if largest <= 0.0 => Some(false),
            _ => None,
        }
    }

    fn is_tied(self) -> bool {
        self.endpoints().iter().all(|end| end.abs() <= GATE_TIE)
    }

    fn square(self) -> Self {
        let square = self * self;
        Interval::new(square.least.max(0.0), square.largest)
    }

    /// Negative numbers count as 0.
    fn sqrt(self) -> Self {
        let [least, largest] = self.endpoints().map(|value| {
            let root = value.max(0.0).sqrt();
            let is_exact = value == 0.0 || value > TINY;
            (root, is_exact && is_product(root, root, value))
        });
        Interval::between(least, largest)
    }

    fn max(self, other: Self) -> Self {
        Interval::new(self.least.max(other.least), self.largest.max(other.largest))
    }

    fn min(self, other: Self) -> Self {
        Interval::new(self.least.min(other.least), self.largest.min(other.largest))
    }

    fn sin_cos(degrees: f64) -> [Self; 2] {
        // The constant is the float below pi.
        let half_turn = Interval::new(PI, PI.next_up());
        let radians = Interval::of(degrees) * half_turn / Interval::of(180.0);
        [
            radians.map(EnclosureOps::sin),
            radians.map(EnclosureOps::cos),
        ]
    }

    fn power(self, exponent: f64) -> Self {
        if exponent == 0.0 {
            Interval::of(1.0)
        } else if self.largest <= 0.0 {
            Interval::of(0.0)
        } else {
            // The logarithm is that of the positive numbers; of 0 it is negative infinity, which gives 0.
            self.map(|base| (base.log() * exponent).exp())
        }
    }

    /// The intersection; all numbers if it is empty.
    fn both(self, other: Self) -> Self {
        Interval::new(self.least.max(other.least), self.largest.min(other.largest))
    }

    fn either(self, other: Self) -> Self {
        Interval::new(self.least.min(other.least), self.largest.max(other.largest))
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Interval::new(-self.largest, -self.least)
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let sum = |a: f64, b: f64| {
            let sum = a + b;
            let part = sum - a;
            // The error of an infinite sum is NaN, so the sum counts as not exact.
            (sum, (a - (sum - part)) + (b - part) == 0.0)
        };
        Interval::between(
            sum(self.least, other.least),
            sum(self.largest, other.largest),
        )
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = |a: f64, b: f64| {
            let product = a * b;
            let is_exact = product.abs() > TINY && is_product(a, b, product);
            (product, is_exact || a == 0.0 || b == 0.0)
        };
        let ([a, b], [c, d]) = (self.endpoints(), other.endpoints());
        // The signs decide which products are the ends.
        let (least, largest) = match (self.side(), other.side()) {
            (Some(Ordering::Greater), Some(Ordering::Greater)) => ([a, c], [b, d]),
            (Some(Ordering::Greater), Some(_)) => ([b, c], [a, d]),
            (Some(Ordering::Greater), None) => ([b, c], [b, d]),
            (Some(_), Some(Ordering::Greater)) => ([a, d], [b, c]),
            (Some(_), Some(_)) => ([b, d], [a, c]),
            (Some(_), None) => ([a, d], [a, c]),
            (None, Some(Ordering::Greater)) => ([a, d], [b, d]),
            (None, Some(_)) => ([b, c], [a, c]),
            (None, None) => {
                let one = Interval::between(product(a, d), product(a, c));
                return one.either(Interval::between(product(b, c), product(b, d)));
            }
        };
        Interval::between(product(least[0], least[1]), product(largest[0], largest[1]))
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let ([a, b], [c, d]) = (self.endpoints(), other.endpoints());
        if c <= 0.0 && d >= 0.0 {
            return Interval::ALL;
        }
        let quotient = |a: f64, b: f64| {
            let quotient = a / b;
            let is_exact = a == 0.0 || quotient.abs() > TINY && a.abs() > TINY;
            (quotient, is_exact && is_product(quotient, b, a))
        };
        let (least, largest) = match (self.side(), c > 0.0) {
            (Some(Ordering::Greater), true) => ([a, d], [b, c]),
            (Some(Ordering::Greater), false) => ([b, d], [a, c]),
            (Some(_), true) => ([a, c], [b, d]),
            (Some(_), false) => ([b, c], [a, d]),
            (None, true) => ([a, c], [b, c]),
            (None, false) => ([b, d], [a, d]),
        };
        Interval::between(
            quotient(least[0], least[1]),
            quotient(largest[0], largest[1]),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every pair of numbers of many magnitudes: zero, short decimals, subnormal numbers and the largest float among
    /// them.
    fn pairs() -> impl Iterator<Item = [f64; 2]> {
        let values: Vec<f64> = (0..40_u32)
            .map(|i| f64::from(i).sin() * 10_f64.powi((i as i32 * 7) % 25 - 12))
            .chain([
                0.0,
                1.0,
                -1.0,
                0.1,
                3.0,
                1e-200,
                -1e-310,
                1e300,
                5e-324,
                f64::MAX,
            ])
            .collect();
        let others = values.clone();
        let pairs = move |a: f64| others.clone().into_iter().map(move |b| [a, b]);
        values.into_iter().flat_map(pairs)
    }

    fn both_kinds([a, b]: [f64; 2]) -> (Interval, maryada::Interval) {
        let (least, largest) = (a.min(b), a.max(b));
        (
            Interval::new(least, largest),
            maryada::Interval::new(least, largest),
        )
    }

    /// Asserts that `found` encloses `tightest` and that each bound is at most one float farther out.
    fn assert_close(found: Interval, tightest: maryada::Interval, what: &str) {
        let (least, largest) = (tightest.inf(), tightest.sup());
        let [low, high] = found.endpoints();
        assert!(
            low <= least && largest <= high,
            "{what}: {found:?} does not hold {tightest:?}"
        );
        let is_near = low >= least.next_down() && high <= largest.next_up();
        assert!(is_near, "{what}: {found:?} is wider than {tightest:?}");
    }

    #[test]
    fn operations_are_within_one_float_of_the_library_s_tightest_enclosures() {
        for left in pairs().step_by(7) {
            for right in pairs().step_by(11) {
                let ((a, x), (b, y)) = (both_kinds(left), both_kinds(right));
                let what = format!("{a:?} and {b:?}");
                assert_close(a + b, x + y, &what);
                assert_close(a - b, x - y, &what);
                assert_close(a * b, x * y, &what);
                if !y.contains(0.0) {
                    assert_close(a / b, x / y, &what);
                }
                assert_close(a.max(b), maryada::IntervalOps::max(x, y), &what);
                assert_close(a.min(b), maryada::IntervalOps::min(x, y), &what);
                assert_close(a.either(b), x.convex_hull(y), &what);
                if x.intersects(y) {
                    assert_close(a.both(b), x.intersection(y), &what);
                }
            }
        }
    }

    #[test]
    fn functions_of_one_number_enclose_the_library_s_results() {
        for pair in pairs() {
            let (a, x) = both_kinds(pair);
            let what = format!("{a:?}");
            assert_close(-a, -x, &what);
            let [low, high] = a.square().endpoints();
            assert!(
                low <= x.sqr().inf() && x.sqr().sup() <= high && low >= 0.0,
                "{what}"
            );
            if a.least >= 0.0 {
                assert_close(a.sqrt(), EnclosureOps::sqrt(x), &what);
            }
        }
    }

    #[test]
    fn an_exact_result_is_one_number() {
        let [three, half] = [3.0, 0.5].map(Interval::of);
        assert_eq!((three * half + three - half).endpoints(), [4.0; 2]);
        assert_eq!((three / half).endpoints(), [6.0; 2]);
        assert_eq!((three - three).endpoints(), [0.0; 2]);
        // All 53 bits.
        let long = Interval::of(9_007_199_254_740_991.0);
        assert_eq!((long * half / half).endpoints(), long.endpoints());
        let zero = Interval::of(0.0);
        assert_eq!([zero * half, half * zero, zero / half], [zero; 3]);
        assert_eq!(Interval::of(2.25).sqrt().endpoints(), [1.5; 2]);
        assert_eq!(Interval::of(0.0).power(76.8).endpoints(), [0.0; 2]);
        assert_eq!(Interval::of(0.0).power(0.0).endpoints(), [1.0; 2]);
    }

    #[test]
    fn an_undefined_result_is_the_interval_of_all_numbers() {
        let (zero, one) = (Interval::of(0.0), Interval::of(1.0));
        assert_eq!(zero / zero, Interval::ALL);
        for divisor in [[-1.0, 1.0], [0.0, 1.0], [-1.0, 0.0]] {
            assert_eq!(one / Interval::new(divisor[0], divisor[1]), Interval::ALL);
        }
        assert_eq!(zero * Interval::ALL, Interval::ALL);
        assert_eq!(Interval::ALL - Interval::ALL, Interval::ALL);
        assert_eq!(Interval::of(f64::NAN), Interval::ALL);
        let [least, largest] = (Interval::of(f64::MAX) + Interval::of(f64::MAX)).endpoints();
        assert!(least <= f64::MAX && largest == f64::INFINITY);
    }

    #[test]
    fn a_power_encloses_the_known_value() {
        for (base, exponent, expected) in [(0.5, 2.0, 0.25), (0.25, 0.5, 0.5), (1.0, 1e6, 1.0)] {
            let [least, largest] = Interval::of(base).power(exponent).endpoints();
            assert!(least <= expected && expected <= largest && largest - least < 1e-14);
        }
        let [least, largest] = Interval::new(0.0, 0.5).power(2.0).endpoints();
        assert!(least == 0.0 && (0.25..0.250_001).contains(&largest));
    }
}
