//! Polynomials that stand for the model on a tile, and bounds on what that costs.
//!
//! All vectors of the model are affine on a tile up to one positive factor (see [`super::patch`]); a displacement d from
//! its middle moves V by at most [`Affine::reach`], and `swing` is that over |V| at the middle. Along the path
//! t d, 0 <= t <= 1, the unit vector v = V / |V| then has, with q = swing / (1 - swing) >= |V'| / |V|,
//!
//! ```text
//!   |v'| <= q      |v''| <= (2 / sqrt 3) q^2      |v'''| <= 3 q^3
//! ```
//!
//! (v' is the part of V' across V over |V|; differentiating w / |w| for affine w gives the factors, which are attained at
//! 30 degrees and at 45 degrees to V.) By the product rule n.l has, with a, b the rates of n and l,
//! |(n.l)'''| <= 3 a^3 + 2 sqrt 3 a^2 b + 2 sqrt 3 a b^2 + 3 b^3, and Taylor's remainder after the quadratic term is at
//! most a sixth of that. The angle between V and its place at the middle is at most asin(swing), so the mirror direction
//! r turns by at most 2 asin(swing_n) + asin(swing_l): the chord |r - o| cannot be shorter than at the middle less that
//! and asin(swing_o), and s = 1 - |r - o|^2 / 2 gives the bound on the specular term, since (1 - x)^rho <= exp(-rho x).
//!
//! Rule: a bound that cannot be given is infinite, and infinite is above every tolerance.

use glam::DVec3;

use super::affine::{Affine, Scalar};
use super::number::{Number, Truth};
use super::series::Quadratic;

/// Beyond this swing nothing is certified: the series would converge too slowly to be of use.
pub const MOST_SWING: f64 = 0.5;

/// A colour on a tile: one polynomial a channel, in levels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Color<N = f64>(pub [Quadratic<N>; 3]);

impl<N: Number> Color<N> {
    /// The same everywhere, on as many tiles as `like` has.
    #[inline(always)]
    pub fn constant(levels: DVec3, like: N) -> Self {
        let zero = like.like(0.0);
        let [red, green, blue] = levels.to_array();
        Color([
            Quadratic([like.like(red), zero, zero, zero, zero, zero]),
            Quadratic([like.like(green), zero, zero, zero, zero, zero]),
            Quadratic([like.like(blue), zero, zero, zero, zero, zero]),
        ])
    }

    /// That of one of the tiles.
    #[inline(always)]
    pub fn one(&self, index: usize) -> Color {
        let [red, green, blue] = &self.0;
        Color([red.one(index), green.one(index), blue.one(index)])
    }

    /// Adds a scalar times a coefficient a channel.
    #[inline(always)]
    pub fn add(&mut self, scalar: &Quadratic<N>, coefficients: DVec3) {
        let [red, green, blue] = &mut self.0;
        red.add(scalar, coefficients.x);
        green.add(scalar, coefficients.y);
        blue.add(scalar, coefficients.z);
    }
}

/// A bound on how fast a direction turns on the way from the middle to anywhere on the tile: see the module's q.
#[inline(always)]
pub fn rate<N: Number>(swing: N) -> N {
    let rate = swing * (-swing + 1.0).inverse();
    moderate(swing).choose(rate, swing.like(f64::INFINITY))
}

/// Whether a vector that moves so far can be certified.
#[inline(always)]
pub fn moderate<N: Number>(swing: N) -> N::Truth {
    swing.below(swing.like(MOST_SWING))
}

/// The error of n.l's quadratic Taylor polynomial for rates `a` of n and `b` of l.
#[inline(always)]
pub fn cosine_remainder<N: Number>(a: N, b: N) -> N {
    /// 3 / 6 and 2 sqrt 3 / 6.
    const PURE: f64 = 0.5;
    const MIXED: f64 = 0.577_350_269_189_625_8;
    (a * a * a + b * b * b) * PURE + a * b * (a + b) * MIXED
}

/// max(0, c) within `half` pixels of the middle as a quadratic, for a quadratic c that may change its sign there, and what
/// that errs by: between -1 and 1 no even quadratic is nearer to |x| than x^2 + 1/8, which errs by 1/8 at 0, 1/2 and 1
/// (Chebyshev's alternation). With |c| <= M that is |c| = c^2 / M + M / 8 and max(0, c) = (c + |c|) / 2; of c^2 the terms
/// beyond second order are cut off. Where c is nothing all over both are NaN, which is below nothing.
#[inline(always)]
pub fn positive_part<N: Number>(c: &Quadratic<N>, half: [N; 2]) -> (Quadratic<N>, N) {
    const HALF: f64 = 0.5;
    const NEAREST: f64 = 0.0625;
    let [linear, quadratic] = [c.linear_reach(half), c.quadratic_reach(half)];
    let most = c.0[0].abs() + linear + quadratic;
    let factor = most.inverse() * HALF;
    let mut part = c.times(c).scaled(factor);
    part.add(c, HALF);
    part.0[0] = part.0[0] + most * NEAREST;
    let cut = quadratic * (linear + linear + quadratic) * factor;
    (part, most * NEAREST + cut)
}

/// A power series whose coefficients are nowhere below those of another one, in size: its value at one, and its terms up
/// to third order (Cauchy's method of majorants).
///
/// Along the path t d from a tile's middle, 0 <= t <= 1, a vector V of length one at the middle stays in a plane: as a
/// complex number it is 1 + z t, where |z| is at most its swing a. Its direction is (1 + z t)^(1/2) (1 + z' t)^(-1/2), z'
/// the conjugate, so with x = a t its coefficients are at most those of (2 - (1 - x)^(1/2)) (1 - x)^(-1/2). The mirror
/// across it, 2 n n^T - 1, is the square of that number in the plane, and -1 across: (1 + z t) / (1 + z' t), at most
/// (1 + x) / (1 - x). A product of vectors or matrices has at most the product's coefficients.
#[derive(Clone, Copy, Debug)]
pub struct Majorant<N> {
    value: N,
    terms: [N; 4],
}

impl<N: Number> Majorant<N> {
    /// 2 (1 - x)^(-1/2) - 1 = 1 + x + 3/4 x^2 + 5/8 x^3 + ..., of a vector's direction; its swing must be below one.
    #[inline(always)]
    pub fn direction(swing: N) -> Self {
        const TERMS: [f64; 4] = [1.0, 1.0, 0.75, 0.625];
        let root = (-swing + 1.0).sqrt().inverse();
        Majorant {
            value: root + root - 1.0,
            terms: Self::terms(swing, TERMS),
        }
    }

    /// (1 + x) / (1 - x) = 1 + 2 x + 2 x^2 + ..., of the mirror across a vector's direction; its swing must be below one.
    #[inline(always)]
    pub fn mirror(swing: N) -> Self {
        const TERMS: [f64; 4] = [1.0, 2.0, 2.0, 2.0];
        Majorant {
            value: (swing + 1.0) * (-swing + 1.0).inverse(),
            terms: Self::terms(swing, TERMS),
        }
    }

    #[inline(always)]
    fn terms(swing: N, [middle, first, second, third]: [f64; 4]) -> [N; 4] {
        let square = swing * swing;
        [
            swing.like(middle),
            swing * first,
            square * second,
            square * swing * third,
        ]
    }

    /// The product.
    #[inline(always)]
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let (a, b) = (&self.terms, &other.terms);
        Majorant {
            value: self.value * other.value,
            terms: [
                a[0] * b[0],
                a[0] * b[1] + a[1] * b[0],
                a[0] * b[2] + a[1] * b[1] + a[2] * b[0],
                a[0] * b[3] + a[1] * b[2] + a[2] * b[1] + a[3] * b[0],
            ],
        }
    }

    /// The terms beyond third order at t = 1, and what f64 makes of that difference.
    #[inline(always)]
    pub fn tail(&self) -> N {
        /// With room to spare.
        const ROUNDING: f64 = 1e-14;
        let [a, b, c, d] = self.terms;
        self.value - (a + b + c + d) + ROUNDING
    }
}

/// A bound on asin(swing): the ratio grows with the swing and is 1.0472 at a half.
#[inline(always)]
pub fn angle<N: Number>(swing: N) -> N {
    const RATIO: f64 = 1.0473;
    moderate(swing).choose(swing * RATIO, swing.like(f64::INFINITY))
}

/// An upper bound of e^x, and none beyond x = 64: 1 - z <= e^(-z), and z = x / 64.
#[inline(always)]
pub fn exponential<N: Number>(x: N) -> N {
    const DOUBLINGS: u32 = 6;
    const PART: f64 = 1.0 / (1 << DOUBLINGS) as f64;
    let mut power = (-x * PART + 1.0).or_zero().inverse();
    for _ in 0..DOUBLINGS {
        power = power * power;
    }
    power
}

/// A lower bound of lambda = 1 - s on a tile: `chord` is |r - o| at its middle, `turns` what it may shrink by.
#[inline(always)]
pub fn least_lambda<N: Number>(chord: N, turns: N) -> N {
    const HALF: f64 = 0.5;
    let shortest = (chord - turns).or_zero();
    shortest * shortest * HALF
}

/// Perspective-correct colours, sum(e_i C_i) / sum(e_i), as a quadratic: with kappa the gradient of the quotient at the
/// middle and e how far the denominator strays from 1, C(d) = C + kappa.d / (1 + e.d) exactly, so the quadratic
/// kappa.d (1 - e.d) errs by |kappa.d| e^2 / (1 - e) at most. Returns that bound in levels.
#[inline(always)]
pub fn quotient(colors: &Affine, total: &Scalar, half: [f64; 2]) -> (Color, f64) {
    let [x, y] = [total.dx, total.dy];
    let stray = x.abs() * half[0] + y.abs() * half[1];
    let mut reach = 0.0_f64;
    let mut color = Color::default();
    for channel in 0..3 {
        let middle = colors.centre[channel];
        let kappa = [
            colors.dx[channel] - middle * x,
            colors.dy[channel] - middle * y,
        ];
        reach = reach.max(kappa[0].abs() * half[0] + kappa[1].abs() * half[1]);
        color.0[channel] = Quadratic([
            middle,
            kappa[0],
            kappa[1],
            -kappa[0] * x,
            -kappa[0] * y - kappa[1] * x,
            -kappa[1] * y,
        ]);
    }
    let bound = if stray < MOST_SWING {
        reach * stray * stray / (1.0 - stray)
    } else {
        f64::INFINITY
    };
    (color, bound)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_third_derivative_of_a_direction_is_bounded_by_three_and_nearly_attains_it() {
        // v = (1 + t c, t s) / |..| with |V'| = 1 and |V| = 1 at t = 0; derivatives by central differences.
        let mut most = [0.0_f64; 3];
        for degrees in 0..=180 {
            let (s, c) = f64::from(degrees).to_radians().sin_cos();
            let v = |t: f64| DVec3::new(1.0 + t * c, t * s, 0.0).normalize();
            let h = 1e-3;
            let derivatives = [
                (v(h) - v(-h)) / (2.0 * h),
                (v(h) - 2.0 * v(0.0) + v(-h)) / (h * h),
                (v(2.0 * h) - 2.0 * v(h) + 2.0 * v(-h) - v(-2.0 * h)) / (2.0 * h * h * h),
            ];
            for (most, derivative) in most.iter_mut().zip(derivatives) {
                *most = most.max(derivative.length());
            }
        }
        assert!(most[0] <= 1.0 + 1e-5 && most[0] > 0.999, "{most:?}");
        assert!(
            most[1] <= 2.0 / 3.0_f64.sqrt() + 1e-4 && most[1] > 1.154,
            "{most:?}"
        );
        assert!(most[2] <= 3.0 + 1e-3 && most[2] > 2.99, "{most:?}");
    }

    #[test]
    fn no_series_of_a_direction_or_a_mirror_exceeds_its_majorant() {
        // V = 1 + a t e^(i angle), so its direction d has d^2 = (1 + z t) / (1 + z' t); by long division and by
        // 2 d_0 d_k + sum of d_j d_(k - j) = the square's term.
        let times = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a * c - b * d, a * d + b * c];
        let swing = 0.4_f64;
        let (mut worst_mirror, mut worst_direction) = (0.0_f64, 0.0_f64);
        for degrees in 0..180 {
            let (sine, cosine) = f64::from(degrees).to_radians().sin_cos();
            let z = [swing * cosine, swing * sine];
            let conjugate = [-z[0], z[1]];
            let mut mirror = vec![[1.0, 0.0], [z[0] + conjugate[0], z[1] + conjugate[1]]];
            for k in 2..=12 {
                mirror.push(times(mirror[k - 1], conjugate));
            }
            let mut direction: Vec<[f64; 2]> = vec![[1.0, 0.0]];
            for k in 1..=12 {
                let mut term = mirror[k];
                for j in 1..k {
                    let product = times(direction[j], direction[k - j]);
                    term = [term[0] - product[0], term[1] - product[1]];
                }
                direction.push(term.map(|part| 0.5 * part));
            }
            let length = |[a, b]: [f64; 2]| a.hypot(b);
            let mut bound = 2.0;
            for k in 1..=12 {
                let order = f64::from(k as u32);
                bound *= swing * (order - 0.5) / order;
                worst_direction = worst_direction.max(length(direction[k]) / bound);
                let most = 2.0 * swing.powi(k as i32);
                worst_mirror = worst_mirror.max(length(mirror[k]) / most);
            }
        }
        assert!(
            worst_mirror <= 1.0 + 1e-12 && worst_mirror > 0.999,
            "{worst_mirror}"
        );
        assert!(
            worst_direction <= 1.0 + 1e-12 && worst_direction > 0.999,
            "{worst_direction}"
        );
    }

    #[test]
    fn a_majorants_tail_is_the_sum_of_what_is_beyond_third_order() {
        // (1 + x) / (1 - x) has the terms 2 x^k, its square 4 k x^k.
        let mirror = Majorant::mirror(0.1);
        assert!((mirror.tail() - 2e-4 / 0.9).abs() < 1e-13);
        let square: f64 = (4..40).map(|k| 4.0 * f64::from(k) * 0.1_f64.powi(k)).sum();
        assert!((mirror.times(&mirror).tail() - square).abs() < 1e-13);
        // 2 (1 - x)^(-1/2) - 1 has the terms 2 (2k choose k) (x/4)^k.
        let mut term = 2.0;
        let mut beyond = 0.0;
        for k in 1..40 {
            term *= 0.1 * (f64::from(k) - 0.5) / f64::from(k);
            beyond += if k > 3 { term } else { 0.0 };
        }
        assert!((Majorant::direction(0.1).tail() - beyond).abs() < 1e-13);
        let none = Majorant::direction(0.0);
        assert!((mirror.times(&none).tail() - mirror.tail()).abs() < 1e-13);
        assert!(none.tail() > 0.0, "rounding is part of it");
    }
}
