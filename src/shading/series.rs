//! Quadratics in a pixel's place, as far as tiles need them; series of third order are in `cubic`.
//!
//! Rule: products and compositions drop what is beyond their order; what that costs is bounded in
//! [`super::certificate`].

mod cubic;

use super::TILE;
use super::affine::Affine;
use super::number::{Number, Truth};

pub use cubic::{Cubic, CubicRamps};

/// c_0 + c_1 x + c_2 y + c_3 x^2 + c_4 xy + c_5 y^2, x and y in pixels from the middle of a tile.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quadratic<N = f64>(pub [N; 6]);

impl Quadratic {
    /// The product of two vectors that are affine, without loss.
    #[inline(always)]
    pub fn dot(v: &Affine, w: &Affine) -> Self {
        Quadratic([
            v.centre.dot(w.centre),
            v.dx.dot(w.centre) + v.centre.dot(w.dx),
            v.dy.dot(w.centre) + v.centre.dot(w.dy),
            v.dx.dot(w.dx),
            v.dx.dot(w.dy) + v.dy.dot(w.dx),
            v.dy.dot(w.dy),
        ])
    }

    /// The same for as many tiles as `like` has.
    #[inline(always)]
    pub fn spread<N: Number>(&self, like: N) -> Quadratic<N> {
        let [middle, x, y, xx, xy, yy] = self.0;
        Quadratic([
            like.like(middle),
            like.like(x),
            like.like(y),
            like.like(xx),
            like.like(xy),
            like.like(yy),
        ])
    }

    /// The rows of a tile whose first lies `first` pixels below the middle, as polynomials in x in f32.
    #[inline(always)]
    pub fn ramps(&self, first: f64) -> Ramps {
        let [middle, x, down, xx, xy, yy] = self.0;
        let mut ramps = Ramps {
            middles: [0.0; TILE],
            slopes: [0.0; TILE],
            curve: xx as f32,
        };
        for row in 0..TILE {
            let y = first + row as f64;
            ramps.middles[row] = (middle + y * (down + y * yy)) as f32;
            ramps.slopes[row] = (x + y * xy) as f32;
        }
        ramps
    }
}

impl<N: Number> Quadratic<N> {
    /// A multiple.
    #[inline(always)]
    #[must_use]
    pub fn scaled(&self, factor: N) -> Self {
        let [middle, x, y, xx, xy, yy] = self.0;
        Quadratic([
            middle * factor,
            x * factor,
            y * factor,
            xx * factor,
            xy * factor,
            yy * factor,
        ])
    }

    /// One over the square root, to second order, of a quadratic that is one at the middle:
    /// (1 + e)^(-1/2) = 1 - e / 2 + 3 e^2 / 8 - ...
    #[inline(always)]
    #[must_use]
    pub fn inverse_root(&self) -> Self {
        const FIRST: f64 = -0.5;
        const SECOND: f64 = 0.375;
        let [_, x, y, xx, xy, yy] = self.0;
        Quadratic([
            x.like(1.0),
            x * FIRST,
            y * FIRST,
            xx * FIRST + x * SECOND * x,
            xy * FIRST + x * (2.0 * SECOND) * y,
            yy * FIRST + y * SECOND * y,
        ])
    }

    /// The product, to second order.
    #[inline(always)]
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        Quadratic([
            a[0] * b[0],
            a[0] * b[1] + a[1] * b[0],
            a[0] * b[2] + a[2] * b[0],
            a[0] * b[3] + a[1] * b[1] + a[3] * b[0],
            a[0] * b[4] + a[1] * b[2] + a[2] * b[1] + a[4] * b[0],
            a[0] * b[5] + a[2] * b[2] + a[5] * b[0],
        ])
    }

    /// The value at a place.
    #[inline(always)]
    pub fn at(&self, [x, y]: [N; 2]) -> N {
        let [middle, slope, curve] = self.row(y);
        middle + x * (slope + x * curve)
    }

    /// The same, counted from `[x, y]`.
    #[inline(always)]
    #[must_use]
    pub fn moved(&self, [x, y]: [N; 2]) -> Self {
        let [_, right, down, xx, xy, yy] = self.0;
        Quadratic([
            self.at([x, y]),
            right + (x + x) * xx + y * xy,
            down + (y + y) * yy + x * xy,
            xx,
            xy,
            yy,
        ])
    }

    /// Adds a multiple of another.
    #[inline(always)]
    pub fn add(&mut self, other: &Self, factor: f64) {
        let (a, b) = (self.0, &other.0);
        self.0 = [
            a[0] + b[0] * factor,
            a[1] + b[1] * factor,
            a[2] + b[2] * factor,
            a[3] + b[3] * factor,
            a[4] + b[4] * factor,
            a[5] + b[5] * factor,
        ];
    }

    /// That of one of the tiles.
    #[inline(always)]
    pub fn one(&self, index: usize) -> Quadratic {
        let [middle, x, y, xx, xy, yy] = &self.0;
        Quadratic([
            middle.one(index),
            x.one(index),
            y.one(index),
            xx.one(index),
            xy.one(index),
            yy.one(index),
        ])
    }

    /// Itself where `holds`, nothing elsewhere.
    #[inline(always)]
    #[must_use]
    pub fn only(&self, holds: N::Truth) -> Self {
        let zero = Quadratic([self.0[0].like(0.0); 6]);
        self.or(!holds, &zero)
    }

    /// Itself, but another one where `holds`.
    #[inline(always)]
    #[must_use]
    pub fn or(&self, holds: N::Truth, other: &Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        Quadratic([
            holds.choose(b[0], a[0]),
            holds.choose(b[1], a[1]),
            holds.choose(b[2], a[2]),
            holds.choose(b[3], a[3]),
            holds.choose(b[4], a[4]),
            holds.choose(b[5], a[5]),
        ])
    }

    /// A bound on the linear terms' size within `half` pixels of the middle.
    #[inline(always)]
    pub fn linear_reach(&self, half: [N; 2]) -> N {
        self.0[1].abs() * half[0] + self.0[2].abs() * half[1]
    }

    /// A bound on the quadratic terms' size within `half` pixels of the middle.
    #[inline(always)]
    pub fn quadratic_reach(&self, half: [N; 2]) -> N {
        let [right, down] = half;
        self.0[3].abs() * right * right
            + self.0[4].abs() * right * down
            + self.0[5].abs() * down * down
    }

    /// One row, `y` pixels below the middle, as a polynomial in x.
    #[inline(always)]
    pub fn row(&self, y: N) -> [N; 3] {
        let [middle, x, down, xx, xy, yy] = self.0;
        [middle + y * (down + y * yy), x + y * xy, xx]
    }
}

/// The rows of a [`Quadratic`] in f32.
#[derive(Clone, Copy, Debug)]
pub struct Ramps {
    middles: [f32; TILE],
    slopes: [f32; TILE],
    curve: f32,
}

impl Ramps {
    /// The coefficients of a row.
    #[inline(always)]
    pub fn row(&self, row: usize) -> [f32; 3] {
        [self.middles[row], self.slopes[row], self.curve]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_agree_with_the_functions_to_third_order() {
        let q = Quadratic([1.0, 0.15, -0.1, 0.025, 0.005, -0.02]);
        let at = |q: &Quadratic, x: f64, y: f64| {
            let [middle, slope, curve] = q.row(y);
            middle + x * (slope + x * curve)
        };
        let (root, square) = (q.inverse_root(), q.times(&q));
        let error = |step: f64| {
            let (x, y) = (step, 0.7 * step);
            let value = at(&q, x, y);
            (
                (at(&root, x, y) - 1.0 / value.sqrt()).abs(),
                (at(&square, x, y) - value * value).abs(),
            )
        };
        let (far, near) = (error(0.1), error(0.05));
        assert!(
            (far.0 / near.0 - 8.0).abs() < 0.8,
            "halving the step divides a third-order error by eight: {far:?} {near:?}"
        );
        assert!((far.1 / near.1 - 8.0).abs() < 0.8, "{far:?} {near:?}");
    }
}
