//! The assignment's shortcut: unit n, l and o of the vertices, interpolated linearly on the screen, not renormalised.
//!
//! Rule: lambda_i = e_i w_i / sum(e_j w_j) are the coordinates that are linear on the screen; their sum is constant, so
//! no pixel divides. A triangle with a vertex nearer than the near plane has no three screen positions: its vectors are
//! interpolated perspective-correctly instead, as everything else is.

use glam::DVec3;

use super::certificate::Color;
use super::patch::{Affine, Patch, Triangle};
use super::specular::{power, power_exact};
use super::{Coverage, Evaluations, Scratch, Shader, Sink, Surface, TILE, TileKind, doubles};

/// Draws the shortcut; it has no tolerance to keep.
pub struct UnitVectors<'a> {
    /// What is shaded.
    pub surface: Surface<'a>,
}

impl Shader for UnitVectors<'_> {
    #[inline(always)]
    fn polynomial(&self, _triangle: &Triangle, _patch: &Patch) -> Option<(Color, TileKind)> {
        None
    }

    #[inline(always)]
    fn shade(
        &self,
        triangle: &Triangle,
        patch: &Patch,
        coverage: &Coverage,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) -> Evaluations {
        let surface = &self.surface;
        let Some(factors) = triangle.screen else {
            return self.shade_clipped(triangle, patch, coverage, sink);
        };
        let to_eye = triangle.to_eye();
        let weights = screen_weights(factors, patch);
        let blend = |values: &[DVec3; 3]| weights.map(|weights| Triangle::blend(weights, values));
        let (normal, to_eye) = (blend(&triangle.normals), blend(&to_eye));
        let shininess = surface.material.shininess as f32;
        let ambient = surface.ambient().as_vec3().to_array();
        let lanes = patch.lanes();
        scratch.levels.fill(ambient.map(|level| [level; TILE]));
        for light in &surface.illumination.points {
            let [diffuse, specular] = surface
                .coefficients(light)
                .map(|levels| levels.as_vec3().to_array());
            let to_light = blend(&triangle.to_light(light.position - surface.centre));
            for (row, &(from, to)) in coverage.spans.iter().enumerate() {
                if from < to {
                    let y = row as f64 - patch.row;
                    let (n, l, o) = (normal.row(y), to_light.row(y), to_eye.row(y));
                    let mut cosine = [0.0; TILE];
                    let mut strength = [0.0; TILE];
                    for lane in 0..TILE {
                        let (n, l, o) = (n.at(lanes[lane]), l.at(lanes[lane]), o.at(lanes[lane]));
                        let nl = n[0] * l[0] + n[1] * l[1] + n[2] * l[2];
                        let no = n[0] * o[0] + n[1] * o[1] + n[2] * o[2];
                        let lo = l[0] * o[0] + l[1] * o[1] + l[2] * o[2];
                        let raised = if shininess > 0.0 {
                            power(shininess, 1.0 - (2.0 * nl * no - lo))
                        } else {
                            1.0
                        };
                        cosine[lane] = if nl > 0.0 { nl } else { 0.0 };
                        strength[lane] = if nl > 0.0 { raised } else { 0.0 };
                    }
                    for channel in 0..3 {
                        for lane in 0..TILE {
                            scratch.levels[row][channel][lane] += diffuse[channel] * cosine[lane]
                                + specular[channel] * strength[lane];
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
        Evaluations::of(TileKind::Exact).of_every_pixel(coverage, surface)
    }
}

impl UnitVectors<'_> {
    /// Shades a triangle that has no three screen positions, in f64, pixel by pixel.
    fn shade_clipped(
        &self,
        triangle: &Triangle,
        patch: &Patch,
        coverage: &Coverage,
        sink: &mut impl Sink,
    ) -> Evaluations {
        let surface = &self.surface;
        doubles::shade(patch, coverage, sink, |weights| {
            let n = Triangle::blend(weights, &triangle.normals);
            let o = Triangle::blend(weights, &triangle.to_eye());
            let mut levels = surface.ambient();
            for light in &surface.illumination.points {
                let [diffuse, specular] = surface.coefficients(light);
                let l =
                    Triangle::blend(weights, &triangle.to_light(light.position - surface.centre));
                let cosine = n.dot(l);
                if cosine > 0.0 {
                    let lambda = 1.0 - o.dot(2.0 * cosine * n - l);
                    levels += diffuse * cosine
                        + specular * power_exact(surface.material.shininess, lambda);
                }
            }
            levels
        });
        Evaluations::of(TileKind::Double).of_every_pixel(coverage, surface)
    }
}

/// The three coordinates that are linear on the screen: the weights times the vertices' w.
fn screen_weights(factors: [f64; 3], patch: &Patch) -> Affine {
    let linear = patch
        .weights
        .map(|weights| weights * DVec3::from_array(factors));
    let total = linear.centre.x + linear.centre.y + linear.centre.z;
    linear.map(|weights| weights / total)
}
