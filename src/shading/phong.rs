//! Position and normal interpolated, the model at every pixel (Phong 1975).
//!
//! Per tile and light, what the signs of n.l allow is decided first: dark (nothing), lit (no gate), or a terminator in
//! between, whose gate each pixel takes from the exact quadratic N'.L' in f64. Lit pixels then go through f32 lanes:
//! normalise, reflect, and take the power of 1 - o.r = |r - o|^2 / 2.
//!
//! Rule: f32 where the bound of its rounding stays below the tolerance; the model in f64, pixel by pixel, elsewhere.

use glam::DVec3;

use super::patch::{Affine, Patch, Triangle};
use super::specular::power;
use super::{Coverage, EXACT, Evaluations, Scratch, Sink, Surface, TILE};
use crate::components::unit;

/// Unit round-off of f32.
const U: f64 = 5.960_464_5e-8;

/// How a light stands to a tile.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Side {
    /// n.l <= 0 all over.
    Dark,
    /// n.l > 0 all over.
    Lit,
    /// Neither is certain.
    Terminator,
}

/// N'.L' over a tile: the middle's value and the five higher coefficients.
struct Facing {
    coefficients: [f64; 6],
}

impl Facing {
    #[inline(always)]
    fn new(normal: &Affine, light: &Affine) -> Self {
        let (n, l) = (normal, light);
        Facing {
            coefficients: [
                n.centre.dot(l.centre),
                n.dx.dot(l.centre) + n.centre.dot(l.dx),
                n.dy.dot(l.centre) + n.centre.dot(l.dy),
                n.dx.dot(l.dx),
                n.dx.dot(l.dy) + n.dy.dot(l.dx),
                n.dy.dot(l.dy),
            ],
        }
    }

    #[inline(always)]
    fn side(&self, half: [f64; 2]) -> Side {
        let [middle, x, y, xx, xy, yy] = self.coefficients;
        let [right, down] = half;
        let reach = x.abs() * right
            + y.abs() * down
            + xx.abs() * right * right
            + xy.abs() * right * down
            + yy.abs() * down * down;
        // f64 rounding of the sums is a millionth of a millionth of the largest term.
        let doubt = 1e-12 * (middle.abs() + reach);
        if middle - reach > doubt {
            Side::Lit
        } else if middle + reach < -doubt {
            Side::Dark
        } else {
            Side::Terminator
        }
    }

    /// One where n.l > 0, zero elsewhere, for each lane of a row.
    #[inline(always)]
    fn gate(&self, lanes: &[f32; TILE], y: f64) -> [f32; TILE] {
        let [middle, x, down, xx, xy, yy] = self.coefficients;
        let at_middle = middle + y * (down + y * yy);
        let slope = x + y * xy;
        let mut gate = [0.0; TILE];
        for (open, lane) in gate.iter_mut().zip(lanes) {
            let lane = f64::from(*lane);
            *open = if at_middle + lane * (slope + lane * xx) > 0.0 {
                1.0
            } else {
                0.0
            };
        }
        gate
    }
}

/// Direction error, in radians, of a vector interpolated in f32 and normalised: its components are rounded four times
/// at the size of the largest on the tile, against the length of the shortest.
fn direction_error(swing: f64) -> f64 {
    7.0 * U * (1.0 + swing) / (1.0 - swing)
}

/// The steepest slope of (1 - d^2/2)^rho as a function of d = |r - o|, for rho >= 1; at d^2 = 2 / (2 rho - 1).
fn steepest(shininess: f64) -> f64 {
    let chord = (2.0 / (2.0 * shininess - 1.0)).sqrt();
    shininess * chord * (1.0 - 1.0 / (2.0 * shininess - 1.0)).powf(shininess - 1.0)
}

/// What a shaded object brings to all of its tiles.
pub struct Phong<'a> {
    surface: Surface<'a>,
    /// Levels of error a radian of error in |r - o| makes, per level of specular coefficient.
    slope: f64,
    tolerance: f64,
}

impl<'a> Phong<'a> {
    /// Prepares an object; `tolerance` in levels.
    pub fn new(surface: Surface<'a>, tolerance: f64) -> Self {
        let shininess = surface.material.shininess;
        let slope = if shininess == 0.0 {
            0.0
        } else if shininess < 1.0 {
            // The slope of s^rho has no bound where s goes to 0.
            f64::INFINITY
        } else {
            steepest(shininess)
        };
        Phong {
            surface,
            slope,
            tolerance: tolerance.max(EXACT),
        }
    }

    /// Shades the covered pixels of a tile.
    #[inline(always)]
    pub fn shade(
        &self,
        triangle: &Triangle,
        patch: &Patch,
        coverage: &Coverage,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) -> Evaluations {
        let normal = patch.blend(&triangle.normals);
        let position = patch.blend(&triangle.offsets);
        let to_eye = match triangle.eye {
            Some(eye) => Affine {
                centre: patch.constant(eye).centre - position.centre,
                dx: patch.constant(eye).dx - position.dx,
                dy: patch.constant(eye).dy - position.dy,
            },
            None => patch.constant(triangle.backward),
        };
        if !patch.steady || self.rounding(patch, &normal, &position, &to_eye) > self.tolerance {
            return self.shade_exactly(triangle, patch, coverage, sink);
        }
        let lanes = patch.lanes();
        self.begin(
            patch,
            coverage,
            &lanes,
            &normal.map(scaled_by(normal.centre)),
            &to_eye.map(scaled_by(to_eye.centre)),
            scratch,
        );
        let mut evaluations = Evaluations {
            model: u64::from(coverage.pixels),
            specular: 0,
        };
        for light in &self.surface.illumination.points {
            let to_light = self.to_light(patch, light.position, &position);
            let facing = Facing::new(&normal, &to_light);
            let side = facing.side(patch.half);
            if side == Side::Dark {
                continue;
            }
            let [diffuse, specular] = self.surface.coefficients(light);
            let to_light = to_light.map(scaled_by(to_light.centre));
            let shines = specular != DVec3::ZERO;
            evaluations.specular += if shines {
                u64::from(coverage.pixels)
            } else {
                0
            };
            let (diffuse, specular) = (diffuse.as_vec3().to_array(), specular.as_vec3().to_array());
            for (row, &(from, to)) in coverage.spans.iter().enumerate() {
                if from < to {
                    let y = row as f64 - patch.row;
                    let gate = if side == Side::Lit {
                        [1.0; TILE]
                    } else {
                        facing.gate(&lanes, y)
                    };
                    let mut cosine = [0.0; TILE];
                    let mut lambda = [0.0; TILE];
                    let ramp = to_light.row(y);
                    for lane in 0..TILE {
                        let v: [f32; 6] = [0, 1, 2, 3, 4, 5]
                            .map(|component| scratch.vectors[component][row][lane]);
                        let l = normalised(ramp.at(lanes[lane]));
                        let nl = v[0] * l[0] + v[1] * l[1] + v[2] * l[2];
                        let q = [0, 1, 2].map(|axis| 2.0 * nl * v[axis] - l[axis] - v[axis + 3]);
                        cosine[lane] = if nl > 0.0 { nl } else { 0.0 };
                        lambda[lane] = 0.5 * (q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
                    }
                    let levels = &mut scratch.levels[row];
                    for channel in 0..3 {
                        for lane in 0..TILE {
                            levels[channel][lane] += diffuse[channel] * (cosine[lane] * gate[lane]);
                        }
                    }
                    if shines {
                        let mut strength = gate;
                        if self.surface.material.shininess > 0.0 {
                            let shininess = self.surface.material.shininess as f32;
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
        for (row, &(from, to)) in coverage.spans.iter().enumerate() {
            if from < to {
                sink.take(row, &scratch.levels[row]);
            }
        }
        evaluations
    }

    /// Ambient levels, unit normals and unit vectors to the eye, for the covered rows.
    #[inline(always)]
    fn begin(
        &self,
        patch: &Patch,
        coverage: &Coverage,
        lanes: &[f32; TILE],
        normal: &Affine,
        to_eye: &Affine,
        scratch: &mut Scratch,
    ) {
        let ambient = self.surface.ambient().as_vec3().to_array();
        for (row, &(from, to)) in coverage.spans.iter().enumerate() {
            if from < to {
                let y = row as f64 - patch.row;
                let (normal, to_eye) = (normal.row(y), to_eye.row(y));
                for (component, ramp) in [(0, normal), (3, to_eye)] {
                    let mut unit = [[0.0; TILE]; 3];
                    for lane in 0..TILE {
                        let v = normalised(ramp.at(lanes[lane]));
                        [unit[0][lane], unit[1][lane], unit[2][lane]] = v;
                    }
                    for axis in 0..3 {
                        scratch.vectors[component + axis][row] = unit[axis];
                    }
                }
                scratch.levels[row] = ambient.map(|level| [level; TILE]);
            }
        }
    }

    /// L - P, weighted.
    #[inline(always)]
    fn to_light(&self, patch: &Patch, light: DVec3, position: &Affine) -> Affine {
        let light = patch.constant(light - self.surface.centre);
        Affine {
            centre: light.centre - position.centre,
            dx: light.dx - position.dx,
            dy: light.dy - position.dy,
        }
    }

    /// A bound, in levels, on what f32 costs on this tile; infinite where it cannot be given.
    ///
    /// With direction errors a, b, c of n, l, o: n.l errs by a + b and nine roundings, |r - o| by 2a + b + c and twenty;
    /// the sum over lights of coefficients by six roundings of itself.
    #[inline(always)]
    fn rounding(&self, patch: &Patch, normal: &Affine, position: &Affine, to_eye: &Affine) -> f64 {
        let swing_eye = to_eye.swing(patch.half);
        let swing_normal = normal.swing(patch.half);
        let mut largest = self.surface.ambient().max_element();
        let mut bound = 0.0;
        let mut sound = swing_eye < 1.0 && swing_normal < 1.0;
        for light in &self.surface.illumination.points {
            let swing_light = self
                .to_light(patch, light.position, position)
                .swing(patch.half);
            sound &= swing_light < 1.0;
            let [a, b, c] = [swing_normal, swing_light, swing_eye].map(direction_error);
            let [diffuse, specular] = self.surface.coefficients(light).map(DVec3::max_element);
            largest += diffuse + specular;
            bound += diffuse * (a + b + 9.0 * U);
            if specular > 0.0 {
                bound += specular * self.slope * (2.0 * a + b + c + 20.0 * U);
            }
        }
        if sound {
            bound + 6.0 * U * largest
        } else {
            f64::INFINITY
        }
    }

    /// The model in f64 at every covered pixel.
    fn shade_exactly(
        &self,
        triangle: &Triangle,
        patch: &Patch,
        coverage: &Coverage,
        sink: &mut impl Sink,
    ) -> Evaluations {
        let mut levels = [[0.0; TILE]; 3];
        for (row, &(from, to)) in coverage.spans.iter().enumerate() {
            if from < to {
                for lane in from..to {
                    let weights =
                        patch.weights_at(f64::from(lane) - patch.lane, row as f64 - patch.row);
                    let offset = Triangle::blend(weights, &triangle.offsets);
                    let normal = unit(Triangle::blend(weights, &triangle.normals));
                    let to_eye = triangle
                        .eye
                        .map_or(triangle.backward, |eye| unit(eye - offset));
                    let lane = usize::from(lane);
                    [levels[0][lane], levels[1][lane], levels[2][lane]] = self
                        .surface
                        .levels(offset, normal, to_eye)
                        .as_vec3()
                        .to_array();
                }
                sink.take(row, &levels);
            }
        }
        let pixels = u64::from(coverage.pixels);
        Evaluations {
            model: pixels,
            specular: pixels * self.surface.powers() as u64,
        }
    }
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
