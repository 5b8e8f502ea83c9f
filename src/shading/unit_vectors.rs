//! The assignment's shortcut: unit n, l and o of the vertices, interpolated linearly on the screen, not renormalised.
//!
//! Let e_i be the weights of a triangle's vertices at a point of the face, and z_i the depths of the vertices. The weights
//! e_i z_i / sum(e_j z_j) are linear on the screen. A vertex nearer than the near plane has no position on the screen; the
//! vectors of its triangle are interpolated with e_i, perspective-correctly, as everything else is.
//!
//! This is its definition, evaluated in f64 at every pixel. It shows the error of the shortcut; its time is not tuned.

use glam::{DMat3, DVec3};

use super::affine::Affine;
use super::face::Face;
use super::specular::power_exact;
use super::surface::Surface;
use crate::components::{Projection, unit};

/// The corners of a face that each of its triangles has.
const CORNERS: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// Draws the shortcut; it has no tolerance to keep.
pub struct UnitVectors<'a> {
    pub face: &'a Face<'a>,
    pub surface: Surface<'a>,
    /// Unit n and o at the face's corners.
    normals: [DVec3; 4],
    to_eye: [DVec3; 4],
    /// Unit l there, of each light.
    to_lights: &'a [[DVec3; 4]],
    /// By triangle: from u, v and 1 to the weights of its corners, times the z_i where it has them.
    weights: [DMat3; 2],
}

impl<'a> UnitVectors<'a> {
    /// A face of an object with these normals; `to_lights` is overwritten.
    pub fn new(
        face: &'a Face,
        normals: &Affine,
        surface: Surface<'a>,
        to_lights: &'a mut Vec<[DVec3; 4]>,
    ) -> Self {
        let (uvs, lens) = (face.corners, &face.rays.lens);
        let corners = uvs.map(|uv| face.from_eye(uv));
        let lights = surface.illumination.points.iter();
        to_lights.clear();
        to_lights.extend(lights.map(|light| {
            let light = light.position - lens.eye;
            corners.map(|corner| unit(light - corner))
        }));
        // The depths of the corners on the screen, where they have a position there.
        let depths = corners.map(|corner| {
            let depth = lens.axes[2].dot(corner);
            (depth >= lens.near).then_some(match lens.projection {
                Projection::Perspective => depth,
                Projection::Orthographic => 1.0,
            })
        });
        let weights = CORNERS.map(|corners| {
            let [a, b, c] = corners.map(|corner| {
                let [u, v] = uvs[corner];
                DVec3::new(u, v, 1.0)
            });
            let depths = match corners.map(|corner| depths[corner]) {
                [Some(a), Some(b), Some(c)] => DVec3::new(a, b, c),
                _ => DVec3::ONE,
            };
            DMat3::from_diagonal(depths) * DMat3::from_cols(a, b, c).inverse()
        });
        UnitVectors {
            face,
            surface,
            normals: uvs.map(|[u, v]| normals.at(u, v)),
            to_eye: corners.map(|corner| match lens.projection {
                Projection::Perspective => unit(-corner),
                Projection::Orthographic => -lens.axes[2],
            }),
            to_lights,
            weights,
        }
    }

    /// See [`super::Shader::levels_f64`].
    pub fn levels_f64(&self, x: f64, y: f64) -> DVec3 {
        let ([u, v], _) = self.face.uv_at(x, y);
        let triangle = usize::from(self.face.diagonal_at([u, v]) < 0.0);
        let weights = self.weights[triangle] * DVec3::new(u, v, 1.0);
        // Weights times depths add up to the depth of the point, which is positive.
        let weights = weights / weights.element_sum();
        let between = |values: &[DVec3; 4]| {
            let [a, b, c] = CORNERS[triangle].map(|corner| values[corner]);
            a * weights.x + b * weights.y + c * weights.z
        };
        let (n, o) = (between(&self.normals), between(&self.to_eye));
        let mut levels = self.surface.ambient();
        let lights = self.surface.illumination.points.iter();
        for (light, to_light) in lights.zip(self.to_lights) {
            let [diffuse, specular] = self.surface.coefficients(light);
            let l = between(to_light);
            let cosine = n.dot(l);
            if self.surface.is_lit(light, cosine) {
                // Between unit vectors o.r is at most 1; a pixel's centre may lie outside its triangle.
                let one_minus_cos = (1.0 - o.dot(2.0 * cosine * n - l)).max(0.0);
                levels += diffuse * cosine.max(0.0)
                    + specular * power_exact(self.surface.material.shininess, one_minus_cos);
            }
        }
        levels
    }
}
