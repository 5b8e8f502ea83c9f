//! The assignment's shortcut: unit n, l and o of the vertices, interpolated linearly on the screen, not renormalised.
//!
//! Rule: lambda_i = e_i w_i / sum(e_j w_j) are the coordinates that are linear on the screen; their sum is constant, so
//! no pixel divides. A triangle with a vertex nearer than the near plane has no three screen positions: its vectors are
//! interpolated perspective-correctly instead, as everything else is. A light behind a whole square is left out, and a highlight
//! that stays as faint there as Phong at tolerance 0 may leave out. Between unit vectors o.r is at most one; where a
//! pixel lies just outside its triangle it is held to that. In f32 where its rounding is bounded, pixel by
//! pixel in f64 elsewhere and for slivers.

use fearless_simd::{Simd, f32x16, f64x4};
use glam::DVec3;

use super::affine::Affine;
use super::display::Levels;
use super::face::{Face, Linear, places};
use super::gloss::Gloss;
use super::kernel::{DOUBLE, Light, Model, Reals, Vector, elements};
use super::specular::{Power, power_exact};
use super::square::Region;
use super::{EXACT, Evaluations, Scratch, Surface, TileKind, U};
use crate::components::{PointLight, unit};

/// Draws the shortcut; it has no tolerance to keep.
pub struct UnitVectors<'a> {
    /// What is interpolated over.
    pub face: &'a Face<'a>,
    /// What is shaded.
    pub surface: Surface<'a>,
    /// The eye, in world units.
    pub eye: DVec3,
    /// Against the view direction, where lines of sight are parallel.
    pub backward: Option<DVec3>,
    /// The face's two triangles.
    pub triangles: [Triangle; 2],
    /// Its highlights: how faint one is left out.
    pub gloss: &'a Gloss,
    /// Their power.
    pub power: Power,
}

/// A triangle of a face.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// Its corners, from the eye, in world units.
    corners: [DVec3; 3],
    /// Unit normals there.
    normals: [DVec3; 3],
    /// Weights times w, and times the vertices' own w where they have screen positions.
    weights: Affine,
    /// The sum of those is the same everywhere.
    linear: bool,
}

impl Triangle {
    /// Triangle 0 or 1 of a face with these normals; `depths`: of its corners in the order of the face's, as w in screen
    /// coordinates, if none is nearer than the near plane.
    pub fn new(face: &Face, normals: &Linear, second: usize, depths: [Option<f64>; 4]) -> Self {
        let corners = if second == 0 { [0, 1, 2] } else { [0, 2, 3] };
        let all = places(face.number);
        let weights = face.weights(corners.map(|corner| all[corner]));
        let factors = corners.map(|corner| depths[corner]);
        let screen = match factors {
            [Some(a), Some(b), Some(c)] => Some(DVec3::new(a, b, c)),
            _ => None,
        };
        Triangle {
            corners: corners.map(|corner| face.from_eye(all[corner])),
            normals: corners.map(|corner| normals.at(all[corner])),
            weights: weights.map(|weights| weights * screen.unwrap_or(DVec3::ONE)),
            linear: screen.is_some(),
        }
    }

    /// The weights as they are interpolated on the screen, anchored at a place from the picture's middle.
    fn weights_at(&self, [x, y]: [f64; 2]) -> Affine {
        let centre = self.weights.at(x, y);
        let total = centre.x + centre.y + centre.z;
        Affine {
            centre,
            ..self.weights
        }
        .map(|weights| weights / total)
    }
}

fn blend(weights: DVec3, values: &[DVec3; 3]) -> DVec3 {
    values[0] * weights.x + values[1] * weights.y + values[2] * weights.z
}

/// Bounds from above on n.l and on o.r = 2 (n.l)(n.o) - l.o over a square: the value and the slopes at its middle, and what
/// products of the vectors' changes add.
fn most(normal: &Affine, light: &Affine, eye: &Affine, half: [f64; 2]) -> [f64; 2] {
    /// Covers the rounding of what follows, whose terms are of size one.
    const ROUNDING: f64 = 1e-12;
    let change = |[x, y]: [f64; 2]| x.abs() * half[0] + y.abs() * half[1];
    let moved = |vector: &Affine| change([vector.dx.length(), vector.dy.length()]);
    let product = |a: &Affine, b: &Affine| {
        let slope = |a_slope: DVec3, b_slope| a_slope.dot(b.centre) + a.centre.dot(b_slope);
        let slopes = [slope(a.dx, b.dx), slope(a.dy, b.dy)];
        (a.centre.dot(b.centre), slopes, moved(a) * moved(b))
    };
    let (nl, nl_slopes, nl_rest) = product(normal, light);
    let (no, no_slopes, no_rest) = product(normal, eye);
    let (lo, lo_slopes, lo_rest) = product(light, eye);
    let (nl_change, no_change) = (change(nl_slopes), change(no_slopes));
    let slopes = [0, 1].map(|i| 2.0 * (nl_slopes[i] * no + nl * no_slopes[i]) - lo_slopes[i]);
    let rest = nl_rest * (no.abs() + no_change + no_rest)
        + no_rest * (nl.abs() + nl_change)
        + nl_change * no_change;
    [
        nl + nl_change + nl_rest + ROUNDING,
        2.0 * nl * no - lo + change(slopes) + 2.0 * rest + lo_rest + ROUNDING,
    ]
}

/// What a vector errs by that is at most so long at the middle, and moves by so much: three roundings of the one and four of
/// the other.
fn vector_error(u: f64, [middle, moved]: [f64; 2]) -> f64 {
    u * (3.0 * middle + 4.0 * moved)
}

/// What n.l errs by: the errors of both, and three roundings.
fn cosine_error(u: f64, sizes: [f64; 2]) -> f64 {
    2.0 * vector_error(u, sizes) + 3.0 * u
}

/// What 1 - o.r errs by where o.r is positive: four times the error of n, those of l and of o, for 2 n n^T - 1 makes no vector
/// longer, and 19 roundings: 6 of n.l, 6 of n.o, 2 of their product, 3 of l.o, 2 of the differences.
fn along_error(u: f64, sizes: [f64; 2]) -> f64 {
    6.0 * vector_error(u, sizes) + 19.0 * u
}

impl UnitVectors<'_> {
    fn to_eye(&self, triangle: &Triangle) -> [DVec3; 3] {
        triangle
            .corners
            .map(|corner| self.backward.unwrap_or_else(|| unit(-corner)))
    }

    fn to_light(&self, triangle: &Triangle, light: &PointLight) -> [DVec3; 3] {
        let light = light.position - self.eye;
        triangle.corners.map(|corner| unit(light - corner))
    }

    /// A bound, in levels, on what rounding by `u` costs on a square; infinite where it cannot be given. s^rho errs by rho times
    /// what o.r errs by, and by the power's own error.
    fn rounding(&self, u: f64, sizes: [f64; 2]) -> f64 {
        let steepest = match self.surface.material.shininess {
            shininess if shininess > 0.0 && shininess < 1.0 => f64::INFINITY,
            shininess => shininess,
        };
        let (mut largest, mut terms) = (self.surface.ambient().max_element(), 1.0);
        let mut bound = 0.0;
        for light in &self.surface.illumination.points {
            let [diffuse, specular] = self.surface.coefficients(light).map(DVec3::max_element);
            largest += diffuse + specular;
            terms += 2.0;
            bound += diffuse * cosine_error(u, sizes);
            if specular > 0.0 {
                bound += specular * (steepest * along_error(u, sizes) + self.power.error);
            }
        }
        bound + ((2.0 + terms) * u + 3.0 * U) * largest
    }

    /// See [`super::Shader::evaluate`].
    pub fn evaluate<S: Simd>(
        &self,
        simd: S,
        region: &Region,
        scratch: &mut Scratch,
    ) -> Option<Evaluations> {
        let (middle, half) = (region.middle(), region.square.half());
        if !self.face.is_steady_on(middle, half) {
            return None;
        }
        let diagonal = &self.face.diagonal;
        let (before, reach) = (diagonal.at(middle[0], middle[1]), diagonal.reach(half));
        let used = [before > -reach, before < reach];
        let weights = self.triangles.map(|triangle| triangle.weights_at(middle));
        let mut roundings = [0.0_f64; 2];
        for ((triangle, weights), used) in self.triangles.iter().zip(&weights).zip(used) {
            let moved = weights.dx.abs() * half[0] + weights.dy.abs() * half[1];
            let sizes =
                [weights.centre.abs(), moved].map(|weights| weights.x + weights.y + weights.z);
            if used && !(triangle.linear && sizes[0] + sizes[1] < 2.0) {
                return None;
            }
            if used {
                roundings = [0, 1].map(|precision| {
                    roundings[precision].max(self.rounding([U, DOUBLE][precision], sizes))
                });
            }
        }
        let dropped = self.gloss.faint * self.surface.powers() as f64;
        let [single, double] = roundings.map(|rounding| rounding + dropped);
        let kind = if single <= EXACT {
            TileKind::Exact
        } else if double <= EXACT {
            TileKind::Double
        } else {
            return None;
        };
        let mut highlights = 0;
        for (index, triangle) in self.triangles.iter().enumerate() {
            if !used[index] {
                continue;
            }
            // Pixels that the diagonal divides get the first triangle's levels, and where they are beyond the second's.
            let wanted = |[x, y]: [f64; 2]| index == 0 || !used[0] || diagonal.at(x, y) < 0.0;
            let weights = &weights[index];
            let Scratch {
                levels,
                single,
                double,
                ..
            } = scratch;
            let shining = if kind == TileKind::Exact {
                self.fill::<S, f32x16<S>>(simd, triangle, weights, region, single, levels, wanted)
            } else {
                self.fill::<S, f64x4<S>>(simd, triangle, weights, region, double, levels, wanted)
            };
            highlights = highlights.max(shining);
        }
        Some(Evaluations {
            kind,
            model: region.square.pixels as u64,
            specular: (region.square.pixels * highlights) as u64,
        })
    }

    /// Evaluates a square with a triangle's vectors, where `wanted`; how many lights have a highlight there.
    fn fill<S: Simd, V: Reals<S>>(
        &self,
        simd: S,
        triangle: &Triangle,
        weights: &Affine,
        region: &Region,
        lights: &mut Vec<Light<V::Element>>,
        levels: &mut Levels,
        wanted: impl Fn([f64; 2]) -> bool,
    ) -> usize {
        let interpolated = |values: &[DVec3; 3]| weights.map(|weights| blend(weights, values));
        let normal = interpolated(&triangle.normals);
        let eye = interpolated(&self.to_eye(triangle));
        lights.clear();
        for light in &self.surface.illumination.points {
            let terms = self.surface.coefficients(light);
            let to_light = interpolated(&self.to_light(triangle, light));
            let [cosine, along] = most(&normal, &to_light, &eye, region.square.half());
            if cosine > 0.0 {
                lights.push(Light {
                    vector: Vector::new::<S, V>(&to_light),
                    levels: terms.map(elements::<S, V>),
                    is: [
                        terms[0] != DVec3::ZERO,
                        terms[1] != DVec3::ZERO && along > self.gloss.least,
                    ],
                });
            }
        }
        let model = Model::<S, V, true> {
            simd,
            normal: Vector::new::<S, V>(&normal),
            eye: Vector::new::<S, V>(&eye),
            highlights: lights.iter().filter(|light| light.is[1]).count(),
            lights,
            ambient: elements::<S, V>(self.surface.ambient()),
            power: &self.power,
        };
        model.fill(region, levels, wanted);
        model.highlights
    }

    /// See [`super::Shader::define`].
    pub fn define(&self, x: f64, y: f64) -> DVec3 {
        let point = self.face.point(x, y);
        let second = self.face.across(point.place) < 0.0;
        let triangle = &self.triangles[usize::from(second)];
        let own = triangle.weights.at(x, y);
        let inside = if point.held {
            own.max(DVec3::ZERO)
        } else {
            own
        };
        let total = inside.x + inside.y + inside.z;
        let weights = if total > 0.0 && total.is_finite() {
            inside / total
        } else {
            DVec3::splat(1.0 / 3.0)
        };
        let n = blend(weights, &triangle.normals);
        let o = blend(weights, &self.to_eye(triangle));
        let mut levels = self.surface.ambient();
        for light in &self.surface.illumination.points {
            let [diffuse, specular] = self.surface.coefficients(light);
            let l = blend(weights, &self.to_light(triangle, light));
            let cosine = n.dot(l);
            if cosine > 0.0 {
                let one_minus_cos = (1.0 - o.dot(2.0 * cosine * n - l)).max(0.0);
                levels += diffuse * cosine
                    + specular * power_exact(self.surface.material.shininess, one_minus_cos);
            }
        }
        levels
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::running::{Rounded, dot};
    use super::*;

    fn vector(size: f64) -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-size..size).prop_map(DVec3::from)
    }

    fn affine() -> impl Strategy<Value = Affine> {
        (vector(0.6), vector(0.02), vector(0.02)).prop_map(|(centre, dx, dy)| Affine {
            centre,
            dx,
            dy,
        })
    }

    proptest! {
        #[test]
        fn nothing_on_a_square_is_above_its_bounds(
            [n, l, o] in [affine(), affine(), affine()],
            half in [0.5..16.0, 0.5..16.0],
            at in [-1.0..=1.0, -1.0..=1.0],
        ) {
            let [cosine, along] = most(&n, &l, &o, half);
            let [n, l, o] = [n, l, o].map(|v| v.at(at[0] * half[0], at[1] * half[1]));
            prop_assert!(n.dot(l) <= cosine);
            prop_assert!(2.0 * n.dot(l) * n.dot(o) - l.dot(o) <= along);
        }
    }

    /// n.l and 1 - o.r as the kernel forms them.
    fn products([n, l, o]: [DVec3; 3]) -> [Rounded; 2] {
        let [n, l, o] = [n, l, o].map(|v| v.to_array().map(Rounded::exact));
        let cosine = dot(&n, &l);
        // Doubling rounds nothing.
        let twice = Rounded {
            value: 2.0 * cosine.value,
            error: 2.0 * cosine.error,
        };
        let along = twice * dot(&n, &o) - dot(&l, &o);
        [cosine, Rounded::exact(1.0) - along]
    }

    proptest! {
        #[test]
        fn no_product_of_unit_vectors_errs_by_more_than_is_said(
            vectors in [vector(1.0), vector(1.0), vector(1.0)],
            errors in [vector(1.0), vector(1.0), vector(1.0)],
        ) {
            const ERROR: f64 = 1e-6;
            let vectors = vectors.map(DVec3::normalize_or_zero);
            let [cosine, along] = products(vectors);
            // What vectors err by is the same wherever they stand, so it is not analysed with the rest.
            prop_assert!(cosine.error <= cosine_error(1.0, [0.0; 2]));
            prop_assert!(along.value > 1.0 || along.error <= along_error(1.0, [0.0; 2]));
            let [moved_cosine, moved_along] =
                products([0, 1, 2].map(|i| vectors[i] + errors[i].normalize_or_zero() * ERROR));
            let sizes = [ERROR / 3.0, 0.0];
            let [of_cosine, of_along] = [cosine_error, along_error].map(|of| of(1.0, sizes) - of(1.0, [0.0; 2]));
            prop_assert!((moved_cosine.value - cosine.value).abs() <= of_cosine * (1.0 + 1e-5));
            prop_assert!((moved_along.value - along.value).abs() <= of_along * (1.0 + 1e-5));
        }
    }
}
