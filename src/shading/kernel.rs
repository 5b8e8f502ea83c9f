//! The illumination model in lanes: vectors in, n.l and s^rho out.
//!
//! ```text
//!   N, L, O --> n.l = N.L / sqrt(N.N L.L)        |r - o|^2 / 2 = 1 - s --> s^rho
//! ```
//! The same lines evaluate sixteen pixels in f32, four in f64, and a node of each of four squares in f64. 1 - s
//! is formed as |r - o|^2 / 2, which holds for unit vectors and cancels nothing (Lyon 1993).
//!
//! Rule: what rounding these lines cost is counted in [`super::rounding`], line by line.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x4};
use glam::DVec3;

use super::affine::Affine;
use super::pixels::Pixels;
use super::specular::{self, Power};
use crate::simd::{four, inlined, outlined, three};

/// Unit round-off of f64.
pub const DOUBLE: f64 = f64::EPSILON / 2.0;

/// Numbers side by side of one precision.
pub trait Reals<S: Simd>: SimdFloat<S, Element: Copy, Mask: Select<Self>> {
    /// One number everywhere.
    fn all(simd: S, number: f64) -> Self;

    /// Some of sixteen, from `lane` on.
    fn some(of: f32x16<S>, lane: usize) -> Self;

    /// max(0, 1 - x)^rho.
    fn powers(self, power: &Power) -> Self;

    /// One of them.
    fn element(number: f64) -> Self::Element;

    /// Sixteen of each in f32, from those that `evaluate` gives from a lane on.
    fn sixteen(simd: S, evaluate: impl FnMut(usize) -> [Self; 3]) -> [f32x16<S>; 3];
}

impl<S: Simd> Reals<S> for f32x16<S> {
    #[inline(always)]
    fn all(simd: S, number: f64) -> Self {
        Self::splat(simd, number as f32)
    }

    #[inline(always)]
    fn some(of: f32x16<S>, _lane: usize) -> Self {
        of
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
    fn some(of: f32x16<S>, lane: usize) -> Self {
        let four = [of[lane], of[lane + 1], of[lane + 2], of[lane + 3]];
        Self::simd_from(of.token(), four.map(f64::from))
    }

    #[inline(always)]
    fn powers(self, power: &Power) -> Self {
        if power.exact > 0.0 && power.exact < 1.0 {
            // The slope has no bound at s = 0: there f32 would make levels of a rounding.
            let exact = self
                .as_array()
                .map(|one_minus_cos| specular::power_exact(power.exact, one_minus_cos));
            return Self::simd_from(self.token(), exact);
        }
        let mut one_minus_cos = [0.0; 16];
        for (one_minus_cos, own) in one_minus_cos.iter_mut().zip(self.as_array()) {
            *one_minus_cos = *own as f32;
        }
        let powers = f32x16::simd_from(self.token(), one_minus_cos).powers(power);
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
        three!(|channel| f32x16::simd_from(simd, levels[channel]))
    }
}

/// A vector in each lane.
pub type Lanes3<V> = [V; 3];

/// Three numbers, each for all lanes.
pub fn elements<S: Simd, V: Reals<S>>(numbers: DVec3) -> [V::Element; 3] {
    numbers.to_array().map(V::element)
}

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

/// n.l and 1 - s, from unit vectors n and o and a vector to the light of any positive length.
#[inline(always)]
pub fn mirrored<S: Simd, V: Reals<S>>(
    simd: S,
    normal: &Lanes3<V>,
    light: &Lanes3<V>,
    eye: &Lanes3<V>,
) -> [V; 2] {
    let inverse = V::all(simd, 1.0) / dot(light, light).sqrt();
    let cosine = dot(normal, light) * inverse;
    let twice = cosine + cosine;
    let difference = three!(|axis| normal[axis] * twice - light[axis] * inverse - eye[axis]);
    [cosine, dot(&difference, &difference) * V::all(simd, 0.5)]
}

/// Powers at three nodes of four squares: twelve fit into sixteen lanes.
#[inline(always)]
pub fn powers_of_row<S: Simd>(
    simd: S,
    power: &Power,
    one_minus_cos: [f64x4<S>; 3],
) -> [f64x4<S>; 3] {
    if power.exact > 0.0 && power.exact < 1.0 {
        return three!(|node| one_minus_cos[node].powers(power));
    }
    let mut sixteen = [0.0; 16];
    for node in 0..3 {
        for (square, own) in one_minus_cos[node].as_array().iter().enumerate() {
            sixteen[4 * node + square] = *own as f32;
        }
    }
    let powers = f32x16::simd_from(simd, sixteen).powers(power);
    three!(|node| f64x4::simd_from(simd, four!(|square| f64::from(powers[4 * node + square]))))
}

/// At length one.
#[inline(always)]
pub fn unit<S: Simd, V: Reals<S>>(simd: S, vector: Lanes3<V>) -> Lanes3<V> {
    let inverse = V::all(simd, 1.0) / dot(&vector, &vector).sqrt();
    three!(|axis| vector[axis] * inverse)
}

/// `number` where `gate` is positive, zero elsewhere.
#[inline(always)]
fn gated<S: Simd, V: Reals<S>>(simd: S, gate: V, number: V) -> V {
    let zero = V::all(simd, 0.0);
    gate.simd_gt(zero).select(number, zero)
}

/// A vector on a square: `middle + right x + down y`, x and y in pixels from the square's middle.
#[derive(Clone, Copy, Debug)]
pub struct Vector<T> {
    middle: [T; 3],
    right: [T; 3],
    down: [T; 3],
}

impl<T: Copy> Vector<T> {
    /// A vector that is anchored at the square's middle.
    pub fn new<S: Simd, V: Reals<S, Element = T>>(vector: &Affine) -> Self {
        Vector {
            middle: elements::<S, V>(vector.centre),
            right: elements::<S, V>(vector.dx),
            down: elements::<S, V>(vector.dy),
        }
    }

    /// At places from the middle, in pixels right and down.
    #[inline(always)]
    fn at<S: Simd, V: Reals<S, Element = T>>(&self, [x, y]: [V; 2]) -> Lanes3<V> {
        three!(|axis| x * self.right[axis] + (y * self.down[axis] + self.middle[axis]))
    }
}

/// A light on a square, with the terms that are evaluated there.
#[derive(Clone, Copy, Debug)]
pub struct Light<T> {
    /// The vector to it.
    pub vector: Vector<T>,
    /// What n.l and s^rho are multiplied with, in levels, and which of the two terms are evaluated.
    pub diffuse: [T; 3],
    pub specular: [T; 3],
    pub has_diffuse: bool,
    pub has_specular: bool,
}

/// The model at every pixel of a square.
pub struct Model<'a, S: Simd, V: Reals<S>> {
    pub simd: S,
    pub normal: Vector<V::Element>,
    pub eye: Vector<V::Element>,
    pub lights: &'a [Light<V::Element>],
    pub ambient: [V::Element; 3],
    pub power: &'a Power,
    /// How many of the lights have a specular term.
    pub highlights: usize,
}

impl<S: Simd, V: Reals<S>> Model<'_, S, V> {
    /// Evaluates pixels.
    pub fn fill(&self, pixels: &mut Pixels) {
        let evaluate = inlined!(|[x, y]: [f32x16<S>; 2]| {
            V::sixteen(
                self.simd,
                inlined!(|lane| self.sum([V::some(x, lane), V::some(y, lane)])),
            )
        });
        outlined!(self.simd, pixels.evaluate(self.simd, evaluate));
    }

    /// Its levels at places from the square's middle, in pixels.
    #[inline(always)]
    fn sum(&self, place: [V; 2]) -> [V; 3] {
        let simd = self.simd;
        let mut n = self.normal.at(place);
        let mut o = n;
        if self.highlights > 0 {
            o = self.eye.at(place);
            (n, o) = (unit(simd, n), unit(simd, o));
        }
        let n2 = dot(&n, &n);
        let mut levels = three!(|channel| V::splat(simd, self.ambient[channel]));
        for light in self.lights {
            let l = light.vector.at(place);
            let [cosine, power] = if light.has_specular {
                let [cosine, one_minus_cos] = mirrored(simd, &n, &l, &o);
                [cosine, one_minus_cos.powers(self.power)]
            } else {
                [cosine(&n, n2, &l); 2]
            };
            if light.has_diffuse {
                let lit = cosine.max(V::all(simd, 0.0));
                for channel in 0..3 {
                    levels[channel] += lit * light.diffuse[channel];
                }
            }
            if light.has_specular {
                let power = gated(simd, cosine, power);
                for channel in 0..3 {
                    levels[channel] += power * light.specular[channel];
                }
            }
        }
        levels
    }
}
