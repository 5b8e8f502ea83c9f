//! Series of third order in a pixel's place: products, compositions, and the quadratic nearest to one.
//!
//! Rule: what is beyond the third order is dropped, as in [`super`]; the nearest quadratic says how far it is.

use super::Quadratic;
use crate::shading::TILE;
use crate::shading::number::Number;

/// A power series in x and y, in pixels from the middle of a tile, up to third order: the six terms of a [`Quadratic`],
/// then x^3, x^2 y, x y^2 and y^3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubic<N = f64>(pub [N; 10]);

impl<N: Number> From<Quadratic<N>> for Cubic<N> {
    #[inline(always)]
    fn from(quadratic: Quadratic<N>) -> Self {
        let [middle, x, y, xx, xy, yy] = quadratic.0;
        let zero = middle.like(0.0);
        Cubic([middle, x, y, xx, xy, yy, zero, zero, zero, zero])
    }
}

impl Cubic {
    /// The rows of a tile whose first lies `first` pixels below the middle, as polynomials in x in f32.
    #[inline(always)]
    pub fn ramps(&self, first: f64) -> CubicRamps {
        let [middle, x, down, xx, xy, yy, xxx, xxy, xyy, yyy] = self.0;
        let mut ramps = CubicRamps {
            middles: [0.0; TILE],
            slopes: [0.0; TILE],
            curves: [0.0; TILE],
            bend: xxx as f32,
        };
        for row in 0..TILE {
            let y = first + row as f64;
            ramps.middles[row] = (middle + y * (down + y * (yy + y * yyy))) as f32;
            ramps.slopes[row] = (x + y * (xy + y * xyy)) as f32;
            ramps.curves[row] = (xx + y * xxy) as f32;
        }
        ramps
    }
}

impl<N: Number> Cubic<N> {
    /// A multiple.
    #[inline(always)]
    #[must_use]
    pub fn scaled(&self, factor: N) -> Self {
        let [middle, x, y, xx, xy, yy, xxx, xxy, xyy, yyy] = self.0;
        Cubic([
            middle * factor,
            x * factor,
            y * factor,
            xx * factor,
            xy * factor,
            yy * factor,
            xxx * factor,
            xxy * factor,
            xyy * factor,
            yyy * factor,
        ])
    }

    /// The difference.
    #[inline(always)]
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        Cubic([
            a[0] - b[0],
            a[1] - b[1],
            a[2] - b[2],
            a[3] - b[3],
            a[4] - b[4],
            a[5] - b[5],
            a[6] - b[6],
            a[7] - b[7],
            a[8] - b[8],
            a[9] - b[9],
        ])
    }

    /// The sum with a number.
    #[inline(always)]
    #[must_use]
    pub fn plus(mut self, number: f64) -> Self {
        self.0[0] = self.0[0] + number;
        self
    }

    /// The terms up to second order.
    #[inline(always)]
    fn lower(&self) -> Quadratic<N> {
        let [middle, x, y, xx, xy, yy, ..] = self.0;
        Quadratic([middle, x, y, xx, xy, yy])
    }

    /// The product, to third order.
    #[inline(always)]
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        let [middle, x, y, xx, xy, yy] = self.lower().times(&other.lower()).0;
        Cubic([
            middle,
            x,
            y,
            xx,
            xy,
            yy,
            a[0] * b[6] + a[1] * b[3] + a[3] * b[1] + a[6] * b[0],
            a[0] * b[7] + a[1] * b[4] + a[2] * b[3] + a[3] * b[2] + a[4] * b[1] + a[7] * b[0],
            a[0] * b[8] + a[1] * b[5] + a[2] * b[4] + a[4] * b[2] + a[5] * b[1] + a[8] * b[0],
            a[0] * b[9] + a[2] * b[5] + a[5] * b[2] + a[9] * b[0],
        ])
    }

    /// 1 + k_1 e + k_2 e^2 + k_3 e^3, to third order, where e is this series without its value at the middle.
    #[inline(always)]
    #[must_use]
    pub fn composed(&self, [k1, k2, k3]: [f64; 3]) -> Self {
        let [_, x, y, xx, xy, yy, xxx, xxy, xyy, yyy] = self.0;
        let (x2, y2) = (x * x, y * y);
        let (twice, thrice) = (2.0 * k2, 3.0 * k3);
        Cubic([
            x.like(1.0),
            x * k1,
            y * k1,
            xx * k1 + x2 * k2,
            xy * k1 + x * twice * y,
            yy * k1 + y2 * k2,
            xxx * k1 + x * twice * xx + x * k3 * x2,
            xxy * k1 + (x * xy + y * xx) * twice + x2 * thrice * y,
            xyy * k1 + (x * yy + y * xy) * twice + x * thrice * y2,
            yyy * k1 + y * twice * yy + y * k3 * y2,
        ])
    }

    /// One over a series that is one at the middle.
    #[inline(always)]
    #[must_use]
    pub fn inverse(&self) -> Self {
        self.composed([-1.0, 1.0, -1.0])
    }

    /// One over the square root of a series that is one at the middle.
    #[inline(always)]
    #[must_use]
    pub fn inverse_root(&self) -> Self {
        self.composed([-0.5, 0.375, -0.3125])
    }

    /// Bounds on the size of the terms of first, second and third order within `half` pixels of the middle.
    #[inline(always)]
    pub fn reaches(&self, half: [N; 2]) -> [N; 3] {
        let [_, _, _, _, _, _, xxx, xxy, xyy, yyy] = self.0;
        let [h, v] = half;
        [
            self.lower().linear_reach(half),
            self.lower().quadratic_reach(half),
            h * h * (xxx.abs() * h + xxy.abs() * v) + v * v * (xyy.abs() * h + yyy.abs() * v),
        ]
    }

    /// The quadratic that is nearest within `half` pixels of the middle, and how far from it this is at most: Chebyshev's
    /// economization, x^3 = (3/4) h^2 x + (h^3 / 4) T_3(x / h) and x^2 y = (h^2 / 2) y + (h^2 / 2) T_2(x / h) y (Lanczos
    /// 1938).
    #[inline(always)]
    pub fn economized(&self, half: [N; 2]) -> (Quadratic<N>, N) {
        const PURE: [f64; 2] = [0.75, 0.25];
        const MIXED: f64 = 0.5;
        let [middle, x, y, xx, xy, yy, xxx, xxy, xyy, yyy] = self.0;
        let [h, v] = half;
        let (h2, v2) = (h * h, v * v);
        let quadratic = Quadratic([
            middle,
            x + h2 * PURE[0] * xxx + v2 * MIXED * xyy,
            y + v2 * PURE[0] * yyy + h2 * MIXED * xxy,
            xx,
            xy,
            yy,
        ]);
        let error = h2 * (h * PURE[1] * xxx.abs() + v * MIXED * xxy.abs())
            + v2 * (h * MIXED * xyy.abs() + v * PURE[1] * yyy.abs());
        (quadratic, error)
    }
}

/// The rows of a [`Cubic`] in f32.
#[derive(Clone, Copy, Debug)]
pub struct CubicRamps {
    middles: [f32; TILE],
    slopes: [f32; TILE],
    curves: [f32; TILE],
    bend: f32,
}

impl CubicRamps {
    /// The coefficients of a row.
    #[inline(always)]
    pub fn row(&self, row: usize) -> [f32; 4] {
        [
            self.middles[row],
            self.slopes[row],
            self.curves[row],
            self.bend,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x, y and a series there.
    fn at(series: &Cubic, x: f64, y: f64) -> f64 {
        let powers = [
            1.0,
            x,
            y,
            x * x,
            x * y,
            y * y,
            x * x * x,
            x * x * y,
            x * y * y,
            y * y * y,
        ];
        powers.iter().zip(series.0).map(|(p, c)| p * c).sum()
    }

    const SERIES: Cubic = Cubic([
        1.0, 0.15, -0.1, 0.025, 0.005, -0.02, 0.01, -0.03, 0.02, 0.015,
    ]);

    #[test]
    fn cubic_series_agree_with_the_functions_to_fourth_order() {
        type Form = (Cubic, fn(f64) -> f64);
        let forms: [Form; 4] = [
            (SERIES.times(&SERIES), |value| value * value),
            (SERIES.inverse(), |value| 1.0 / value),
            (SERIES.inverse_root(), |value| 1.0 / value.sqrt()),
            (SERIES.composed([2.5, 1.875, 0.3125]), |value| {
                value.powf(2.5)
            }),
        ];
        for (form, (series, function)) in forms.into_iter().enumerate() {
            for (x, y) in [(1.0, 0.7), (-0.6, 1.0), (1.0, 0.0), (0.0, 1.0)] {
                let error = |step: f64| {
                    let (x, y) = (step * x, step * y);
                    (at(&series, x, y) - function(at(&SERIES, x, y))).abs()
                };
                let ratio = error(0.05) / error(0.025);
                assert!(
                    (ratio - 16.0).abs() < 2.5,
                    "halving the step divides a fourth-order error by 16, not {ratio}: {form} towards {x}, {y}"
                );
            }
        }
    }

    #[test]
    fn an_economized_series_is_as_near_as_it_says_and_nearer_than_one_cut_off() {
        let half = [3.0, 2.0];
        let (near, bound) = SERIES.economized(half);
        let near = Cubic::from(near);
        let cut = Cubic::from(SERIES.lower());
        let (mut worst, mut worst_cut) = (0.0_f64, 0.0_f64);
        for step in 0..=40 * 40 {
            let x = half[0] * (f64::from(step % 41) / 20.0 - 1.0);
            let y = half[1] * (f64::from(step / 41) / 19.5 - 1.0);
            let value = at(&SERIES, x, y);
            worst = worst.max((at(&near, x, y) - value).abs());
            worst_cut = worst_cut.max((at(&cut, x, y) - value).abs());
        }
        assert!(worst <= bound && worst > 0.5 * bound, "{worst} of {bound}");
        assert!(worst < 0.6 * worst_cut, "{worst}, cut off {worst_cut}");
        let [_, _, third] = SERIES.reaches(half);
        assert!(worst_cut <= third && worst_cut > 0.5 * third);
    }
}
