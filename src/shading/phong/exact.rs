//! Every pixel by itself: in f32 lanes where their rounding is bounded below the tolerance, in f64 elsewhere.
//!
//! N, L and O are affine up to one positive factor a pixel, so their six dot products are quadratics, without loss, and
//! ```text
//!   n.l = N.L / sqrt(N.N L.L)      o.r = (2 N.L N.O / N.N - L.O) / sqrt(L.L O.O)
//! ```
//! A lane evaluates the products it needs. Where rho would make too much of the last bits of o.r, it normalises the three
//! vectors instead, reflects, and takes 1 - o.r = |r - o|^2 / 2. Where a terminator crosses the tile, each pixel's gate is
//! the sign of N.L in f64.

use fearless_simd::Simd;
use glam::DVec3;

use super::outlook::Outlook;
use super::products::{ToLight, Vectors};
use super::{Phong, Pixels, ROUNDED};
use crate::components::{PointLight, unit};
use crate::shading::affine::Affine;
use crate::shading::display::Exact;
use crate::shading::patch::{Patch, Squares};
use crate::shading::series::Quadratic;
use crate::shading::specular::power;
use crate::shading::triangle::Triangle;
use crate::shading::{
    Coverage, Evaluations, Scratch, Sink, TILE, TileKind, TileRow, U, doubles, limit,
};

/// The steepest slope of (1 - d^2/2)^rho as a function of d = |r - o|, taken at d^2 = 2 / (2 rho - 1) for rho >= 1; it
/// has no bound for smaller rho, where s goes to 0.
pub fn steepest(shininess: f64) -> f64 {
    if shininess == 0.0 {
        0.0
    } else if shininess < 1.0 {
        f64::INFINITY
    } else {
        let chord = (2.0 / (2.0 * shininess - 1.0)).sqrt();
        shininess * chord * (1.0 - 1.0 / (2.0 * shininess - 1.0)).powf(shininess - 1.0)
    }
}

/// Direction error, in radians, of a vector interpolated in f32 and normalised: its components are rounded four times
/// at the size of the largest on the tile, against the length of the shortest.
#[inline(always)]
fn direction_error(swing: f64) -> f64 {
    if swing < 1.0 {
        7.0 * U * (1.0 + swing) / (1.0 - swing)
    } else {
        f64::INFINITY
    }
}

/// A bound on what f32 makes of a quadratic within `half` pixels of the middle that errs by `doubt` itself: its
/// coefficients are rounded once, and Horner's rule leaves two roundings of the constant and five of the other terms.
#[inline(always)]
fn evaluation_error(quadratic: &Quadratic, half: [f64; 2], doubt: f64) -> f64 {
    doubt
        + U * (2.0 * quadratic.0[0].abs()
            + 5.0 * (quadratic.linear_reach(half) + quadratic.quadratic_reach(half)))
}

/// The same for a square length, over the square of what the length is at least; the vector has length one at the
/// middle.
#[inline(always)]
fn relative_error(square: &Quadratic, half: [f64; 2], doubt: f64, swing: f64) -> f64 {
    if swing < 1.0 {
        evaluation_error(square, half, doubt) / ((1.0 - swing) * (1.0 - swing))
    } else {
        f64::INFINITY
    }
}

/// How a specular term is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reflection {
    /// From the products.
    Products,
    /// From unit vectors.
    Vectors,
}

impl<S: Simd> Phong<'_, S> {
    /// A bound on what f32 makes of n.l: the errors of its three products and three roundings.
    #[inline(always)]
    pub(super) fn cosine_error(vectors: &Vectors, outlook: &Outlook, patch: &Patch) -> f64 {
        let ToLight {
            facing,
            light_square,
            doubt,
            ..
        } = &outlook.to_light;
        let (normal, light) = (vectors.swing_normal(), outlook.to_light.swing());
        let least = (1.0 - normal) * (1.0 - light);
        evaluation_error(facing, patch.half, *doubt) / least
            + 0.5 * relative_error(&vectors.normal_square, patch.half, *doubt, normal)
            + 0.5 * relative_error(light_square, patch.half, *doubt, light)
            + 3.0 * U
    }

    /// A bound, in levels, on what f32 costs a specular term of the given coefficient, and the cheapest way that keeps
    /// it below its share of the tolerance, or the truest if none does.
    ///
    /// From the products, o.r errs by the sum of theirs and eight roundings, and s^rho by rho times that. From unit
    /// vectors with direction errors a, b, c of n, l and o, |r - o| errs by 2 a + b + c and twenty roundings, and s^rho
    /// by that times its steepest slope.
    #[inline(always)]
    pub(super) fn reflection(
        &self,
        coefficient: f64,
        vectors: &Vectors,
        outlook: &Outlook,
        patch: &Patch,
    ) -> (Reflection, f64) {
        let share = ROUNDED * self.share_of_tolerance();
        let half = patch.half;
        let to_light = &outlook.to_light;
        let doubt = to_light.doubt;
        let [normal, light, eye] = [
            vectors.swing_normal(),
            to_light.swing(),
            vectors.swing_eye(),
        ];
        let [normal_eye, eye_square] = vectors.to_eye();
        let most = (1.0 + normal) * (1.0 + normal) * (1.0 + light) * (1.0 + eye);
        let twice = evaluation_error(&to_light.facing, half, doubt) * (1.0 + normal) * (1.0 + eye)
            + evaluation_error(&normal_eye, half, doubt) * (1.0 + normal) * (1.0 + light)
            + most * (relative_error(&vectors.normal_square, half, doubt, normal) + 3.0 * U);
        let numerator = 2.0 * twice / ((1.0 - normal) * (1.0 - normal))
            + evaluation_error(&to_light.light_eye(vectors), half, doubt)
            + U;
        let cosine = numerator / ((1.0 - light) * (1.0 - eye))
            + 0.5 * relative_error(&to_light.light_square, half, doubt, light)
            + 0.5 * relative_error(&eye_square, half, doubt, eye)
            + 4.0 * U;
        let shininess = self.surface.material.shininess;
        let steepest = if shininess == 0.0 || shininess >= 1.0 {
            shininess
        } else {
            f64::INFINITY
        };
        let power = self.power_error();
        let products = coefficient * (steepest * cosine + power);
        if products <= share {
            return (Reflection::Products, products);
        }
        let [a, b, c] = [normal, light, eye].map(direction_error);
        (
            Reflection::Vectors,
            coefficient * (self.slope * (2.0 * a + b + c + 20.0 * U) + power),
        )
    }

    /// The model in f32 at every covered pixel, specular terms where they reach; `None`, and nothing drawn, where that
    /// would err too much.
    #[inline(always)]
    pub(super) fn shade_lanes(
        &self,
        triangle: &Triangle,
        tiles: &Squares<TILE>,
        index: usize,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) -> Option<Evaluations> {
        let patch = &tiles.patches[index];
        let mut pixels = Pixels::new(&tiles.covered[index], index, scratch);
        let coverage = pixels.coverage;
        let mut own = None;
        let vectors = &self.vectors(triangle, patch, &mut own);
        let budget = limit(self.tolerance);
        let mut largest = self.surface.ambient().max_element();
        let mut error = self.dropped();
        let mut highlights = 0;
        pixels.fill(self.ambient);
        for (index, light) in self.surface.illumination.points.iter().enumerate() {
            let mut own = None;
            let to_light = self.to_light(index, vectors, triangle, patch, &mut own);
            let outlook = self.outlook(light, vectors, to_light);
            if outlook.dark {
                continue;
            }
            let [diffuse, specular] = self.surface.coefficients(light).map(DVec3::max_element);
            largest += diffuse + specular;
            error += diffuse * Self::cosine_error(vectors, &outlook, patch);
            self.add_diffuse(light, vectors, &outlook, patch, &mut pixels);
            if outlook.shines {
                highlights += 1;
                error += self.add_specular(light, vectors, &outlook, triangle, patch, &mut pixels);
            }
        }
        let error = error + self.rounding * largest;
        if error.is_nan() || error > budget {
            return None;
        }
        flush(coverage, pixels.levels, sink);
        let pixels = u64::from(coverage.pixels);
        Some(Evaluations {
            model: pixels,
            specular: pixels * highlights,
            ..Evaluations::of(TileKind::Exact)
        })
    }

    /// Adds a light's diffuse term.
    #[inline(always)]
    fn add_diffuse(
        &self,
        light: &PointLight,
        vectors: &Vectors,
        outlook: &Outlook,
        patch: &Patch,
        pixels: &mut Pixels,
    ) {
        let diffuse = self.surface.coefficients(light)[0];
        if diffuse == DVec3::ZERO {
            return;
        }
        let lanes = patch.lanes();
        let diffuse = diffuse.as_vec3().to_array();
        let (nl, nn, ll) = (
            outlook.to_light.facing.ramps(-patch.row),
            vectors.normal_square.ramps(-patch.row),
            outlook.to_light.light_square.ramps(-patch.row),
        );
        for (row, &(from, to)) in pixels.coverage.spans.iter().enumerate() {
            if from < to {
                let y = row as f64 - patch.row;
                let gate = outlook.gate(&lanes, y);
                let (nl, nn, ll) = (nl.row(row), nn.row(row), ll.row(row));
                let mut cosine = [0.0; TILE];
                for lane in 0..TILE {
                    let x = lanes[lane];
                    let value = at(nl, x) / (at(nn, x) * at(ll, x)).sqrt();
                    cosine[lane] = if value > 0.0 { value * gate[lane] } else { 0.0 };
                }
                pixels.add(row, diffuse, &cosine);
            }
        }
    }

    /// Adds a light's specular term; a bound on what f32 costs it, in levels.
    #[inline(always)]
    pub(super) fn add_specular(
        &self,
        light: &PointLight,
        vectors: &Vectors,
        outlook: &Outlook,
        triangle: &Triangle,
        patch: &Patch,
        pixels: &mut Pixels,
    ) -> f64 {
        let specular = self.surface.coefficients(light)[1];
        let (reflection, cost) = self.reflection(specular.max_element(), vectors, outlook, patch);
        if reflection == Reflection::Vectors && !pixels.normalised {
            normalise(triangle, patch, pixels);
            pixels.normalised = true;
        }
        let specular = specular.as_vec3().to_array();
        let lanes = patch.lanes();
        let first = -patch.row;
        let [normal_eye, eye_square] = vectors.to_eye();
        let (nl, no, lo) = (
            outlook.to_light.facing.ramps(first),
            normal_eye.ramps(first),
            outlook.to_light.light_eye(vectors).ramps(first),
        );
        let (nn, ll, oo) = (
            vectors.normal_square.ramps(first),
            outlook.to_light.light_square.ramps(first),
            eye_square.ramps(first),
        );
        let to_light =
            at_length_one(patch.to_light(triangle, light.position - self.surface.centre));
        for (row, &(from, to)) in pixels.coverage.spans.iter().enumerate() {
            if from < to {
                let y = row as f64 - patch.row;
                let mut strength = outlook.gate(&lanes, y);
                let mut lambda = [0.0; TILE];
                match reflection {
                    Reflection::Products => {
                        let (nl, no, lo) = (nl.row(row), no.row(row), lo.row(row));
                        let (nn, ll, oo) = (nn.row(row), ll.row(row), oo.row(row));
                        for lane in 0..TILE {
                            let x = lanes[lane];
                            let along = 2.0 * at(nl, x) * at(no, x) / at(nn, x) - at(lo, x);
                            lambda[lane] = 1.0 - along / (at(ll, x) * at(oo, x)).sqrt();
                        }
                    }
                    Reflection::Vectors => {
                        let ramp = to_light.row(y);
                        for lane in 0..TILE {
                            let v: [f32; 6] = [0, 1, 2, 3, 4, 5]
                                .map(|component| pixels.vectors[component][row][lane]);
                            let l = normalised(ramp.at(lanes[lane]));
                            let nl = v[0] * l[0] + v[1] * l[1] + v[2] * l[2];
                            let q =
                                [0, 1, 2].map(|axis| 2.0 * nl * v[axis] - l[axis] - v[axis + 3]);
                            lambda[lane] = 0.5 * (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
                        }
                    }
                }
                self.raise(&lambda, &mut strength);
                pixels.add(row, specular, &strength);
            }
        }
        cost
    }

    /// Multiplies each `strength` with s^rho for s = 1 - `lambda`.
    #[inline(always)]
    pub(super) fn raise(&self, lambda: &[f32; TILE], strength: &mut [f32; TILE]) {
        let shininess = self.surface.material.shininess as f32;
        if let Some(squarings) = &self.squarings {
            squarings.raise(lambda, strength);
        } else if shininess > 0.0 {
            for lane in 0..TILE {
                strength[lane] *= power(shininess, lambda[lane]);
            }
        }
    }

    /// What the power errs by.
    #[inline(always)]
    pub(super) fn power_error(&self) -> f64 {
        match &self.squarings {
            Some(squarings) => squarings.error,
            None => 16.0 * U,
        }
    }

    /// The model in f64 at every covered pixel.
    pub(super) fn shade_doubles(
        &self,
        triangle: &Triangle,
        patch: &Patch,
        coverage: &Coverage,
        sink: &mut impl Sink,
    ) -> Evaluations {
        doubles::shade(triangle, patch, coverage, sink, |point| {
            let normal = unit(Triangle::blend(point.weights, &point.vertices.normals));
            let to_eye = triangle
                .eye
                .map_or(triangle.backward, |eye| unit(eye - point.offset));
            self.surface.levels(point.offset, normal, to_eye)
        });
        Evaluations::of(TileKind::Double).of_every_pixel(coverage, &self.surface)
    }
}

/// At length one in the middle, so that f32 neither overflows nor loses it.
#[inline(always)]
fn at_length_one(vector: Affine) -> Affine {
    let inverse = 1.0 / vector.centre.length();
    vector.map(|v| v * inverse)
}

/// Fills the scratch with unit normals and unit vectors to the eye, for the covered rows.
#[inline(always)]
fn normalise(triangle: &Triangle, patch: &Patch, pixels: &mut Pixels) {
    let lanes = patch.lanes();
    let normal = at_length_one(patch.normal(triangle));
    let to_eye = at_length_one(patch.to_eye(triangle));
    for (row, &(from, to)) in pixels.coverage.spans.iter().enumerate() {
        if from < to {
            let y = row as f64 - patch.row;
            for (component, ramp) in [(0, normal.row(y)), (3, to_eye.row(y))] {
                let mut unit = [[0.0; TILE]; 3];
                for lane in 0..TILE {
                    [unit[0][lane], unit[1][lane], unit[2][lane]] =
                        normalised(ramp.at(lanes[lane]));
                }
                for axis in 0..3 {
                    pixels.vectors[component + axis][row] = unit[axis];
                }
            }
        }
    }
}

impl Outlook<'_> {
    /// One where n.l > 0, zero elsewhere, for each lane of the row `y` pixels below the middle.
    #[inline(always)]
    fn gate(&self, lanes: &[f32; TILE], y: f64) -> [f32; TILE] {
        let mut gate = [1.0; TILE];
        if !self.lit {
            let [middle, slope, curve] = self.to_light.facing.row(y);
            for (open, lane) in gate.iter_mut().zip(lanes) {
                let lane = f64::from(*lane);
                *open = if middle + lane * (slope + lane * curve) > 0.0 {
                    1.0
                } else {
                    0.0
                };
            }
        }
        gate
    }
}

/// Hands the finished rows on.
#[inline(always)]
fn flush(coverage: &Coverage, levels: &[TileRow; TILE], sink: &mut impl Sink) {
    for (row, &(from, to)) in coverage.spans.iter().enumerate() {
        if from < to {
            sink.take(row, &Exact(&levels[row]));
        }
    }
}

/// A row's quadratic at `x` pixels from the middle column.
#[inline(always)]
pub(super) fn at([middle, slope, curve]: [f32; 3], x: f32) -> f32 {
    middle + x * (slope + x * curve)
}

#[inline(always)]
fn normalised(v: [f32; 3]) -> [f32; 3] {
    let inverse = 1.0 / (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|component| component * inverse)
}
