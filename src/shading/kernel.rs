//! The illumination model in lanes, and what its rounding costs: vectors in, n.l and s^rho out.
//!
//! ```text
//!   N, L, O --> n.l = N.L / sqrt(N.N L.L)        |r - o|^2 / 2 = 1 - s --> s^rho
//! ```
//! The same lines evaluate sixteen pixels in f32, four in f64, and a node of each of four squares in f64. Where s is near 1
//! it is formed as 1 - |r - o|^2 / 2, which holds for unit vectors and cancels nothing (Lyon 1993).
//!
//! Rule: what rounding costs the model is counted here: [`Rounding`], per light and per term of the sum.

use std::ops::{Add, Mul};

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x4};
use glam::DVec3;

use super::U;
use super::affine::Affine;
use super::bound::{Field, MAX_RADIUS};
use super::display::{Levels, Rows};
use super::specular::{self, Squarings};
use super::square::Region;
use crate::simd::{apart, inlined, three};

/// Unit round-off of f64.
pub const DOUBLE: f64 = f64::EPSILON / 2.0;

/// Numbers side by side of one precision.
pub trait Reals<S: Simd>:
    SimdFloat<
        S,
        Element: Copy
                     + Default
                     + Add<Output = <Self as SimdBase<S>>::Element>
                     + Mul<Output = <Self as SimdBase<S>>::Element>,
        Mask: Select<Self>,
    >
{
    /// One number everywhere.
    fn all(simd: S, number: f64) -> Self;

    /// `from`, `from` + 1, ...
    fn count(simd: S, from: usize) -> Self;

    /// max(0, 1 - x)^rho.
    fn powers(self, power: &Power) -> Self;

    /// One of them.
    fn element(number: f64) -> Self::Element;

    /// Sixteen of each in f32, from those that `evaluate` gives from a lane on.
    fn sixteen(simd: S, evaluate: impl FnMut(usize) -> [Self; 3]) -> [f32x16<S>; 3];
}

/// The power of one shininess, s^rho from 1 - s.
#[derive(Clone, Copy, Debug)]
pub struct Power {
    shininess: f32,
    exact: f64,
    /// The steepest slope of (1 - d^2/2)^rho in d = |r - o|, at d^2 = 2 / (2 rho - 1): for a shininess of at least 1.
    steepest: f64,
    squarings: Option<Squarings>,
    /// What it errs by, f32 included.
    pub error: f64,
}

/// A bound on what the power errs by, with 1 - s rounded to f32 first: [`specular::power`] errs by less than half of it.
const POWER_ERROR: f64 = 16.0 * U;

impl Power {
    /// One that errs by at most `most` where s is at least `least` and nothing is asked elsewhere, if there is a cheap
    /// one; otherwise one for every s.
    pub fn new(shininess: f64, least: f64, most: f64) -> Self {
        let squarings = Squarings::new(shininess, least, most);
        let chord = (2.0 / (2.0 * shininess - 1.0)).sqrt();
        Power {
            shininess: shininess as f32,
            exact: shininess,
            steepest: shininess * chord * (1.0 - chord * chord / 2.0).powf(shininess - 1.0),
            squarings,
            error: squarings.map_or(POWER_ERROR, |squarings| squarings.error),
        }
    }

    /// What an error in |r - o|, and four roundings of 1 - s, make of s^rho. Below a shininess of 1 the slope has no bound as
    /// s goes to 0, but powers of two numbers then differ by no more than the power of their difference. From 1 on it makes
    /// relative errors of 1 - s no larger: rho (1 - s) s^(rho - 1) <= 1.
    fn moved(&self, apart: f64, unit: f64) -> f64 {
        let rounded = 4.0 * unit;
        match self.exact {
            0.0 => 0.0,
            shininess if shininess < 1.0 => (2.0 * apart + rounded).powf(shininess),
            _ => self.steepest * apart + rounded,
        }
    }
}

impl<S: Simd> Reals<S> for f32x16<S> {
    #[inline(always)]
    fn all(simd: S, number: f64) -> Self {
        Self::splat(simd, number as f32)
    }

    #[inline(always)]
    fn count(simd: S, from: usize) -> Self {
        const LANES: [f32; 16] = [
            0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0,
        ];
        Self::simd_from(simd, LANES) + from as i32 as f32
    }

    #[inline(always)]
    fn powers(self, power: &Power) -> Self {
        if let Some(squarings) = &power.squarings {
            squarings.power(self)
        } else if power.shininess > 0.0 {
            specular::power(power.shininess, self)
        } else {
            Self::splat(self.token(), 1.0)
        }
    }

    #[inline(always)]
    fn element(number: f64) -> f32 {
        number as f32
    }

    #[inline(always)]
    fn sixteen(_simd: S, mut evaluate: impl FnMut(usize) -> [Self; 3]) -> [f32x16<S>; 3] {
        evaluate(0)
    }
}

impl<S: Simd> Reals<S> for f64x4<S> {
    #[inline(always)]
    fn all(simd: S, number: f64) -> Self {
        Self::splat(simd, number)
    }

    #[inline(always)]
    fn count(simd: S, from: usize) -> Self {
        Self::simd_from(simd, [0.0, 1.0, 2.0, 3.0]) + f64::from(from as i32)
    }

    #[inline(always)]
    fn powers(self, power: &Power) -> Self {
        if power.exact > 0.0 && power.exact < 1.0 {
            // The slope has no bound at s = 0: there f32 would make levels of a rounding.
            let exact = self
                .as_array()
                .map(|lambda| specular::power_exact(power.exact, lambda));
            return Self::simd_from(self.token(), exact);
        }
        let mut lambda = [0.0; 16];
        for (lambda, own) in lambda.iter_mut().zip(self.as_array()) {
            *lambda = *own as f32;
        }
        let powers = f32x16::simd_from(self.token(), lambda).powers(power);
        let [a, b, c, d, ..] = powers.as_array().map(f64::from);
        Self::simd_from(self.token(), [a, b, c, d])
    }

    #[inline(always)]
    fn element(number: f64) -> f64 {
        number
    }

    #[inline(always)]
    fn sixteen(simd: S, mut evaluate: impl FnMut(usize) -> [Self; 3]) -> [f32x16<S>; 3] {
        let mut levels = [[0.0; 16]; 3];
        for lane in (0..16).step_by(4) {
            let four = evaluate(lane);
            for channel in 0..3 {
                for (index, level) in four[channel].as_array().iter().enumerate() {
                    levels[channel][lane + index] = *level as f32;
                }
            }
        }
        levels.map(
            #[inline(always)]
            |levels| f32x16::simd_from(simd, levels),
        )
    }
}

/// A vector in each lane.
pub type Lanes3<V> = [V; 3];

/// The scalar product.
#[inline(always)]
pub fn dot<S: Simd, V: Reals<S>>(a: &Lanes3<V>, b: &Lanes3<V>) -> V {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// n.l, from vectors of any positive length.
#[inline(always)]
pub fn cosine<S: Simd, V: Reals<S>>(normal: &Lanes3<V>, normal2: V, light: &Lanes3<V>) -> V {
    dot(normal, light) / (normal2 * dot(light, light)).sqrt()
}

/// n.l and s^rho, from unit vectors n and o and a vector to the light of any positive length.
#[inline(always)]
pub fn highlight<S: Simd, V: Reals<S>>(
    simd: S,
    power: &Power,
    normal: &Lanes3<V>,
    light: &Lanes3<V>,
    eye: &Lanes3<V>,
) -> [V; 2] {
    let inverse = V::all(simd, 1.0) / dot(light, light).sqrt();
    let cosine = dot(normal, light) * inverse;
    let twice = cosine + cosine;
    let apart = three(
        #[inline(always)]
        |axis| normal[axis] * twice - light[axis] * inverse - eye[axis],
    );
    let lambda = dot(&apart, &apart) * V::all(simd, 0.5);
    [cosine, lambda.powers(power)]
}

/// At length one.
#[inline(always)]
pub fn unit<S: Simd, V: Reals<S>>(simd: S, vector: Lanes3<V>) -> Lanes3<V> {
    let inverse = V::all(simd, 1.0) / dot(&vector, &vector).sqrt();
    three(
        #[inline(always)]
        |axis| vector[axis] * inverse,
    )
}

/// `number` where `gate` is positive, zero elsewhere.
#[inline(always)]
fn gated<S: Simd, V: Reals<S>>(simd: S, gate: V, number: V) -> V {
    let zero = V::all(simd, 0.0);
    gate.simd_gt(zero).select(number, zero)
}

/// What rounding costs the model at one pixel, in levels. Rows of polynomials are counted in [`super::interpolation`].
///
/// A vector of length one at the middle is formed as (c + a x) + b y: c, a and b are rounded, then both products and both
/// sums, each by at most u times its size. So its direction errs by
///
/// ```text
///   delta = u (3 + 4 radius) / shortest
/// ```
/// A vector is brought to length one by five roundings: half of three for its square, a root, a quotient, a product. n.l
/// errs by the delta of n and of l, and by twelve roundings: those of n, three of the product, three of the length of l,
/// one more. |r - o| errs by twice the delta of n, those of l and o, and 50 roundings: 2 n.l n, of size two, by twice
/// those of n.l, n and a product; l and o by five each; and two differences of size at most three. s^rho errs by what that
/// and four roundings of 1 - s make of it, and by the power's own error.
///
/// The vectors at the middle are taken as exact: f64 forms them for the whole square alike, so that no row and no
/// column sees another vector.
#[derive(Clone, Copy, Debug)]
pub struct Rounding {
    /// Unit round-off.
    unit: f64,
    /// Direction errors of n and o.
    normal: f64,
    eye: f64,
    /// Levels that err so far, and the terms that were summed.
    error: f64,
    largest: f64,
    terms: f64,
}

impl Rounding {
    /// For numbers of a unit round-off, the normal's and the eye's [`Extent`], and a sum that starts with `ambient` levels.
    pub fn new(unit: f64, [normal, eye]: [Extent; 2], ambient: f64) -> Self {
        Rounding {
            unit,
            normal: direction(unit, normal),
            eye: direction(unit, eye),
            error: 0.0,
            largest: ambient,
            terms: 1.0,
        }
    }

    /// Adds a light's diffuse term of at most so many levels.
    pub fn diffuse(&mut self, light: Extent, levels: f64) {
        self.error += levels * (self.normal + direction(self.unit, light) + 12.0 * self.unit);
        self.count(levels);
    }

    /// Adds a light's specular term of at most so many levels.
    pub fn specular(&mut self, light: Extent, levels: f64, power: &Power) {
        let apart = 2.0 * self.normal + direction(self.unit, light) + self.eye + 50.0 * self.unit;
        self.error += levels * (power.moved(apart, self.unit) + power.error);
        self.count(levels);
    }

    fn count(&mut self, levels: f64) {
        self.largest += levels;
        self.terms += 1.0;
    }

    /// A bound, in levels: each term's coefficient, product and sum are rounded at the size of the largest sum there can
    /// be; the result once to f32, whose display may be that of the next float.
    pub fn levels(&self) -> f64 {
        self.error + self.largest * (self.unit * (2.0 + self.terms) + 3.0 * U)
    }
}

/// How far a vector of length one at the middle of a square gets from there, and how short it gets.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    pub radius: f64,
    pub shortest: f64,
}

impl Extent {
    /// That of any vector that nodes are sampled of.
    pub const CALM: Self = Extent {
        radius: MAX_RADIUS,
        shortest: 1.0 - MAX_RADIUS,
    };
}

impl<S: Simd> From<&Field<S>> for Extent {
    fn from(field: &Field<S>) -> Self {
        Extent {
            radius: field.radius.as_array()[0],
            shortest: field.shortest.as_array()[0],
        }
    }
}

/// Direction error of an interpolated vector.
fn direction(unit: f64, Extent { radius, shortest }: Extent) -> f64 {
    if shortest > 0.0 {
        unit * (3.0 + 4.0 * radius) / shortest
    } else {
        f64::INFINITY
    }
}

/// A vector on a square: `middle + right x + down y`, x and y in pixels from the square's middle.
#[derive(Clone, Copy, Debug)]
pub struct Vector<T> {
    middle: [T; 3],
    right: [T; 3],
    down: [T; 3],
    /// `middle + right x` in sixteen columns.
    columns: [[T; 16]; 3],
}

impl<T: Copy + Default + Add<Output = T> + Mul<Output = T>> Vector<T> {
    /// A vector that is anchored at the square's middle, times `scale`.
    #[inline(always)]
    pub fn new<S: Simd, V: Reals<S, Element = T>>(vector: &Affine, scale: f64) -> Self {
        let all = inlined(
            #[inline(always)]
            |v: DVec3| {
                three(
                    #[inline(always)]
                    |axis| V::element(v[axis] * scale),
                )
            },
        );
        Vector {
            middle: all(vector.centre),
            right: all(vector.dx),
            down: all(vector.dy),
            columns: [[T::default(); 16]; 3],
        }
    }

    /// Goes to columns, some of the sixteen from `lane` on.
    #[inline(always)]
    fn go_to<S: Simd, V: Reals<S, Element = T>>(&mut self, lane: usize, x: V) {
        let simd = x.token();
        for axis in 0..3 {
            let column = V::splat(simd, self.right[axis]) * x + V::splat(simd, self.middle[axis]);
            self.columns[axis][lane..lane + V::LEN].copy_from_slice(column.as_slice());
        }
    }

    /// In those columns, `y` pixels below the middle.
    #[inline(always)]
    fn at<S: Simd, V: Reals<S, Element = T>>(&self, simd: S, lane: usize, y: T) -> Lanes3<V> {
        three(
            #[inline(always)]
            |axis| {
                V::from_slice(simd, &self.columns[axis][lane..lane + V::LEN])
                    + V::splat(simd, self.down[axis] * y)
            },
        )
    }
}

/// A light on a square, with the terms that are evaluated there.
#[derive(Clone, Copy, Debug)]
pub struct Light<T> {
    /// The vector to it.
    pub vector: Vector<T>,
    /// What n.l and s^rho are multiplied with, in levels.
    pub levels: [[T; 3]; 2],
    /// Whether either is not zero.
    pub is: [bool; 2],
}

/// The model at every pixel of a square. `UNIT`: the vectors are taken to be of length one and are not normalised.
pub struct Model<'a, S: Simd, V: Reals<S>, const UNIT: bool> {
    pub simd: S,
    pub normal: Vector<V::Element>,
    pub eye: Vector<V::Element>,
    pub lights: &'a mut [Light<V::Element>],
    pub ambient: [V::Element; 3],
    pub power: &'a Power,
    /// The square's first pixel from its middle, in pixels.
    pub x: V::Element,
    pub y: V::Element,
    /// Whether any light has a specular term.
    pub shines: bool,
}

impl<S: Simd, V: Reals<S>, const UNIT: bool> Model<'_, S, V, UNIT> {
    /// Evaluates what is covered of a region, where `wanted`: see [`Levels::fill_where`].
    pub fn fill_where(
        &mut self,
        region: &Region,
        levels: &mut Levels,
        wanted: impl Fn([f64; 2]) -> bool,
    ) {
        apart(
            self.simd,
            #[inline(always)]
            || levels.fill_where(region, self, wanted),
        );
    }

    /// Evaluates all that is covered of a region.
    pub fn fill(&mut self, region: &Region, levels: &mut Levels) {
        apart(
            self.simd,
            #[inline(always)]
            || levels.fill(region, self),
        );
    }

    /// In some of the sixteen columns, from `lane` on, `y` pixels below the middle.
    #[inline(always)]
    fn at(&self, lane: usize, y: V::Element) -> [V; 3] {
        let simd = self.simd;
        let mut n: Lanes3<V> = self.normal.at(simd, lane, y);
        let mut o = n;
        if self.shines {
            o = self.eye.at(simd, lane, y);
            if !UNIT {
                (n, o) = (unit(simd, n), unit(simd, o));
            }
        }
        let n2 = dot(&n, &n);
        let mut levels = three(
            #[inline(always)]
            |channel| V::splat(simd, self.ambient[channel]),
        );
        for light in &*self.lights {
            let l = light.vector.at(simd, lane, y);
            let [cosine, power] = if UNIT {
                let cosine = dot(&n, &l);
                if light.is[1] {
                    let along = (cosine + cosine) * dot(&n, &o) - dot(&l, &o);
                    let lambda = (V::all(simd, 1.0) - along).max(V::all(simd, 0.0));
                    [cosine, lambda.powers(self.power)]
                } else {
                    [cosine; 2]
                }
            } else if light.is[1] {
                highlight(simd, self.power, &n, &l, &o)
            } else {
                [cosine(&n, n2, &l); 2]
            };
            if light.is[0] {
                let lit = cosine.max(V::all(simd, 0.0));
                for channel in 0..3 {
                    levels[channel] += lit * light.levels[0][channel];
                }
            }
            if light.is[1] {
                let power = gated(simd, cosine, power);
                for channel in 0..3 {
                    levels[channel] += power * light.levels[1][channel];
                }
            }
        }
        levels
    }
}

impl<S: Simd, V: Reals<S>, const UNIT: bool> Rows<S> for Model<'_, S, V, UNIT> {
    #[inline(always)]
    fn go_to(&mut self, part: usize) {
        for lane in (0..16).step_by(V::LEN) {
            let x = V::count(self.simd, 16 * part + lane) + V::splat(self.simd, self.x);
            self.normal.go_to(lane, x);
            self.eye.go_to(lane, x);
            for light in &mut *self.lights {
                light.vector.go_to(lane, x);
            }
        }
    }

    #[inline(always)]
    fn levels(&self, row: usize) -> [f32x16<S>; 3] {
        let y = V::element(f64::from(row as i32)) + self.y;
        V::sixteen(
            self.simd,
            #[inline(always)]
            |lane| self.at(lane, y),
        )
    }
}
