//! Numbers of one square of pixels, or those of four squares side by side: what certificates are worked out in.
//!
//! Rule: a square gets the bits that it would get alone. No function here looks across, none fuses two steps, and what is
//! not a number is below nothing.

use std::fmt::Debug;
use std::ops::{Add, BitAnd, BitOr, Mul, Neg, Not, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{f64x4, mask64x4};

/// How many squares are certified side by side.
pub const ABREAST: usize = 4;

/// A number a square.
pub trait Number:
    Copy
    + Debug
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// What holds or does not, a square.
    type Truth: Truth<Self>;

    /// How many squares.
    const COUNT: usize;

    /// The same number for as many squares as this has.
    #[must_use]
    fn like(self, number: f64) -> Self;

    /// A number for each of as many squares as this has.
    #[must_use]
    fn each(self, number: impl Fn(usize) -> f64) -> Self;

    /// Without its sign.
    #[must_use]
    fn abs(self) -> Self;

    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;

    /// One over it.
    #[must_use]
    fn inverse(self) -> Self;

    /// Whether it is below another.
    fn below(self, other: Self) -> Self::Truth;

    /// That of one of the squares.
    fn one(&self, index: usize) -> f64;

    /// The smaller one.
    #[inline(always)]
    #[must_use]
    fn or_less(self, other: Self) -> Self {
        self.below(other).choose(self, other)
    }

    /// The larger one.
    #[inline(always)]
    #[must_use]
    fn or_more(self, other: Self) -> Self {
        self.below(other).choose(other, self)
    }

    /// Itself where it is above zero, zero elsewhere.
    #[inline(always)]
    #[must_use]
    fn or_zero(self) -> Self {
        let zero = self.like(0.0);
        zero.below(self).choose(self, zero)
    }
}

/// What holds or does not, a square.
pub trait Truth<N>:
    Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// Whether it holds for any.
    fn any(self) -> bool;

    /// Whether it holds for all.
    fn all(self) -> bool;

    /// `yes` where it holds, `no` elsewhere.
    fn choose(self, yes: N, no: N) -> N;

    /// Bit `i` is set where it holds for the `i`-th.
    fn bits(self) -> u64;

    /// Whether it holds for one of the squares.
    #[inline(always)]
    fn one(self, index: usize) -> bool {
        self.bits() >> index & 1 == 1
    }
}

impl Number for f64 {
    type Truth = bool;

    const COUNT: usize = 1;

    #[inline(always)]
    fn like(self, number: f64) -> Self {
        number
    }

    #[inline(always)]
    fn each(self, number: impl Fn(usize) -> f64) -> Self {
        number(0)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn inverse(self) -> Self {
        1.0 / self
    }

    #[inline(always)]
    fn below(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn one(&self, _index: usize) -> f64 {
        *self
    }
}

impl Truth<f64> for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }

    #[inline(always)]
    fn all(self) -> bool {
        self
    }

    #[inline(always)]
    fn choose(self, yes: f64, no: f64) -> f64 {
        if self { yes } else { no }
    }

    #[inline(always)]
    fn bits(self) -> u64 {
        u64::from(self)
    }
}

impl<S: Simd> Number for f64x4<S> {
    type Truth = mask64x4<S>;

    const COUNT: usize = ABREAST;

    #[inline(always)]
    fn like(self, number: f64) -> Self {
        f64x4::splat(self.token(), number)
    }

    #[inline(always)]
    fn each(self, number: impl Fn(usize) -> f64) -> Self {
        let numbers = [number(0), number(1), number(2), number(3)];
        f64x4::simd_from(self.token(), numbers)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        SimdBase::abs(self)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        SimdFloat::sqrt(self)
    }

    #[inline(always)]
    fn inverse(self) -> Self {
        1.0 / self
    }

    #[inline(always)]
    fn below(self, other: Self) -> mask64x4<S> {
        self.simd_lt(other)
    }

    #[inline(always)]
    fn one(&self, index: usize) -> f64 {
        self.as_array()[index]
    }
}

impl<S: Simd> Truth<f64x4<S>> for mask64x4<S> {
    #[inline(always)]
    fn any(self) -> bool {
        self.any_true()
    }

    #[inline(always)]
    fn all(self) -> bool {
        self.all_true()
    }

    #[inline(always)]
    fn choose(self, yes: f64x4<S>, no: f64x4<S>) -> f64x4<S> {
        self.select(yes, no)
    }

    #[inline(always)]
    fn bits(self) -> u64 {
        self.to_bitmask()
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};

    use super::*;

    const NUMBERS: [f64; ABREAST] = [-2.5, 0.0, f64::NAN, f64::INFINITY];
    const OTHERS: [f64; ABREAST] = [1e-300, -0.0, 3.0, 7.0];

    /// Everything that two numbers can be asked, as bits.
    #[inline(always)]
    fn answers<N: Number>(a: N, b: N, index: usize) -> Vec<u64> {
        let both = a.below(b) | !b.below(a);
        let numbers = [
            a.abs(),
            b.abs().sqrt(),
            b.inverse(),
            a.or_less(b),
            a.or_more(b),
            a.or_zero(),
            b.or_zero(),
            a.like(5.0),
            b.each(|index| b.one(index).exp()),
            (a.below(b) & both).choose(a, b),
            a * b + b - a * 0.375 - 1.0,
        ];
        let mut answers: Vec<u64> = numbers.map(|n| n.one(index).to_bits()).to_vec();
        for truth in [a.below(b), both, !both] {
            answers.push(u64::from(truth.one(index)));
        }
        answers
    }

    #[test]
    fn squares_side_by_side_get_the_bits_that_they_get_alone() {
        let mut levels = vec![Level::new(), Level::fallback()];
        levels.extend(
            crate::simd::NAMES
                .iter()
                .filter_map(|name| crate::simd::named(name)),
        );
        for level in levels {
            for index in 0..ABREAST {
                let alone = answers(NUMBERS[index], OTHERS[index], 0);
                let beside: Vec<u64> = dispatch!(level, simd => {
                    let number = f64x4::splat(simd, 0.0);
                    let a = number.each(|index| NUMBERS[index]);
                    let b = number.each(|index| OTHERS[index]);
                    answers(a, b, index)
                });
                assert_eq!(alone, beside, "{level:?}, {index}");
            }
        }
    }

    #[test]
    fn any_and_all_look_at_every_square() {
        let number = f64x4::splat(fearless_simd::Fallback::new(), 0.0);
        for bits in 0..16_u64 {
            let set = number.each(|index| (bits >> index & 1) as f64);
            let truth = number.below(set);
            assert_eq!(truth.bits(), bits);
            assert_eq!((truth.any(), truth.all()), (bits > 0, bits == 15));
        }
        assert_eq!(
            (true.any(), false.any(), true.all(), false.all()),
            (true, false, true, false)
        );
    }
}
