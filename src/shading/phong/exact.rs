//! Every pixel by itself: in f32 lanes where their rounding is bounded below the tolerance, in f64 elsewhere.
//!
//! Lanes normalise N, L and O, reflect, and take the power of 1 - o.r = |r - o|^2 / 2. Where a terminator crosses the
//! tile, each pixel's gate comes from the sign of the exact quadratic N'.L' in f64.

use glam::DVec3;

use super::{Outlook, Phong, Side, Vectors, side};
use crate::components::{PointLight, unit};
use crate::shading::certificate::Quadratic;
use crate::shading::patch::{Patch, Triangle};
use crate::shading::specular::power;
use crate::shading::{Coverage, Evaluations, Scratch, Sink, TILE, TileKind, U, doubles};

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

impl Phong<'_> {
    /// A bound, in levels, on what f32 costs on this tile; infinite where it cannot be given.
    ///
    /// With direction errors a, b of n and l, n.l errs by a + b and nine roundings; the sum over lights by six roundings
    /// of itself.
    #[inline(always)]
    pub(super) fn rounding(&self, vectors: &Vectors, patch: &Patch) -> f64 {
        let mut largest = self.surface.ambient().max_element();
        let mut bound = 0.0;
        for light in &self.surface.illumination.points {
            let swing = self
                .to_light(light, &vectors.position, patch)
                .swing(patch.half);
            let [diffuse, specular] = self.surface.coefficients(light).map(DVec3::max_element);
            largest += diffuse + specular;
            bound += diffuse
                * (direction_error(vectors.swing_normal) + direction_error(swing) + 9.0 * U);
            bound += self.specular_rounding(specular, vectors, swing);
        }
        let bound = bound + 6.0 * U * largest;
        if bound.is_nan() { f64::INFINITY } else { bound }
    }

    /// A bound, in levels, on what f32 costs a specular term of the given coefficient: with direction errors a, b, c of
    /// n, l and o, |r - o| errs by 2 a + b + c and twenty roundings, and the power by two.
    #[inline(always)]
    pub(super) fn specular_rounding(&self, coefficient: f64, vectors: &Vectors, swing: f64) -> f64 {
        if coefficient == 0.0 {
            return 0.0;
        }
        let [a, b, c] = [vectors.swing_normal, swing, vectors.swing_eye].map(direction_error);
        coefficient * (self.slope * (2.0 * a + b + c + 20.0 * U) + 16.0 * U)
    }

    /// The model in f32 at every covered pixel.
    #[inline(always)]
    pub(super) fn shade_lanes(
        &self,
        vectors: &Vectors,
        patch: &Patch,
        coverage: &Coverage,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) -> Evaluations {
        let ambient = self.surface.ambient().as_vec3().to_array();
        scratch.levels.fill(ambient.map(|level| [level; TILE]));
        vectors.normalise(patch, coverage, &patch.lanes(), scratch);
        let mut evaluations = Evaluations {
            model: u64::from(coverage.pixels),
            ..Evaluations::of(TileKind::Exact)
        };
        for light in &self.surface.illumination.points {
            let to_light = self.to_light(light, &vectors.position, patch);
            let facing = Quadratic::dot(&vectors.normal, &to_light);
            let side = side(&facing, patch.half);
            if side == Side::Dark {
                continue;
            }
            let shines = self.surface.coefficients(light)[1] != DVec3::ZERO;
            evaluations.specular += if shines {
                u64::from(coverage.pixels)
            } else {
                0
            };
            let outlook = Outlook {
                to_light,
                facing,
                side,
                cosine: Quadratic::default(),
                remainder: 0.0,
                shines,
                swing: 0.0,
            };
            self.add_light(light, &outlook, true, patch, coverage, scratch);
        }
        flush(coverage, scratch, sink);
        evaluations
    }

    /// Adds a light's specular term, if it shines here, and with `diffuse` its diffuse term.
    #[inline(always)]
    pub(super) fn add_light(
        &self,
        light: &PointLight,
        outlook: &Outlook,
        diffuse: bool,
        patch: &Patch,
        coverage: &Coverage,
        scratch: &mut Scratch,
    ) {
        let lanes = patch.lanes();
        let to_light = outlook.to_light.map(scaled_by(outlook.to_light.centre));
        let [diffuse_levels, specular] = self
            .surface
            .coefficients(light)
            .map(|levels| levels.as_vec3().to_array());
        let shininess = self.surface.material.shininess as f32;
        for (row, &(from, to)) in coverage.spans.iter().enumerate() {
            if from < to {
                let y = row as f64 - patch.row;
                let gate = if outlook.side == Side::Lit {
                    [1.0; TILE]
                } else {
                    gate(&outlook.facing, &lanes, y)
                };
                let mut cosine = [0.0; TILE];
                let mut lambda = [0.0; TILE];
                let ramp = to_light.row(y);
                for lane in 0..TILE {
                    let v: [f32; 6] =
                        [0, 1, 2, 3, 4, 5].map(|component| scratch.vectors[component][row][lane]);
                    let l = normalised(ramp.at(lanes[lane]));
                    let nl = v[0] * l[0] + v[1] * l[1] + v[2] * l[2];
                    let q = [0, 1, 2].map(|axis| 2.0 * nl * v[axis] - l[axis] - v[axis + 3]);
                    cosine[lane] = if nl > 0.0 { nl } else { 0.0 };
                    lambda[lane] = 0.5 * (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
                }
                let levels = &mut scratch.levels[row];
                if diffuse {
                    for channel in 0..3 {
                        for lane in 0..TILE {
                            levels[channel][lane] +=
                                diffuse_levels[channel] * (cosine[lane] * gate[lane]);
                        }
                    }
                }
                if outlook.shines {
                    let mut strength = gate;
                    if shininess > 0.0 {
                        for lane in 0..TILE {
                            strength[lane] *= power(shininess, lambda[lane]);
                        }
                    }
                    for channel in 0..3 {
                        for lane in 0..TILE {
                            levels[channel][lane] += specular[channel] * strength[lane];
                        }
                    }
                }
            }
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
        doubles::shade(patch, coverage, sink, |weights| {
            let offset = Triangle::blend(weights, &triangle.offsets);
            let normal = unit(Triangle::blend(weights, &triangle.normals));
            let to_eye = triangle
                .eye
                .map_or(triangle.backward, |eye| unit(eye - offset));
            self.surface.levels(offset, normal, to_eye)
        });
        Evaluations::of(TileKind::Double).of_every_pixel(coverage, &self.surface)
    }
}

impl Vectors {
    /// Fills the scratch with unit normals and unit vectors to the eye, for the covered rows.
    #[inline(always)]
    pub(super) fn normalise(
        &self,
        patch: &Patch,
        coverage: &Coverage,
        lanes: &[f32; TILE],
        scratch: &mut Scratch,
    ) {
        let normal = self.normal.map(scaled_by(self.normal.centre));
        let to_eye = self.to_eye.map(scaled_by(self.to_eye.centre));
        for (row, &(from, to)) in coverage.spans.iter().enumerate() {
            if from < to {
                let y = row as f64 - patch.row;
                for (component, ramp) in [(0, normal.row(y)), (3, to_eye.row(y))] {
                    let mut unit = [[0.0; TILE]; 3];
                    for lane in 0..TILE {
                        [unit[0][lane], unit[1][lane], unit[2][lane]] =
                            normalised(ramp.at(lanes[lane]));
                    }
                    for axis in 0..3 {
                        scratch.vectors[component + axis][row] = unit[axis];
                    }
                }
            }
        }
    }
}

/// Hands the finished rows on.
#[inline(always)]
pub(super) fn flush(coverage: &Coverage, scratch: &Scratch, sink: &mut impl Sink) {
    for (row, &(from, to)) in coverage.spans.iter().enumerate() {
        if from < to {
            sink.take(row, &scratch.levels[row]);
        }
    }
}

/// One where n.l > 0, zero elsewhere, for each lane of the row `y` pixels below the middle.
#[inline(always)]
fn gate(facing: &Quadratic, lanes: &[f32; TILE], y: f64) -> [f32; TILE] {
    let [middle, slope, curve] = facing.row(y);
    let mut gate = [0.0; TILE];
    for (open, lane) in gate.iter_mut().zip(lanes) {
        let lane = f64::from(*lane);
        *open = if middle + lane * (slope + lane * curve) > 0.0 {
            1.0
        } else {
            0.0
        };
    }
    gate
}

/// Divides by the length of `middle`, so that f32 neither overflows nor loses small vectors.
#[inline(always)]
fn scaled_by(middle: DVec3) -> impl Fn(DVec3) -> DVec3 {
    let scale = 1.0 / middle.length();
    move |v| v * scale
}

#[inline(always)]
fn normalised(v: [f32; 3]) -> [f32; 3] {
    let inverse = 1.0 / (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|component| component * inverse)
}
