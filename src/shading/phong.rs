//! Phong shading of a face (Phong 1975): position and normal are interpolated, the illumination model is evaluated at every
//! pixel.
//!
//! This file holds the data of the face and its definition in f64. [`super::lights`] draws squares of it within the tolerance.

use glam::DVec3;

use super::affine::Affine;
use super::face::Face;
use super::gloss::Gloss;
use super::surface::Surface;
use crate::components::{PointLight, Projection, unit};

/// A point light on a face.
#[derive(Clone, Copy, Debug)]
pub struct FaceLight {
    /// w (L - P).
    pub towards: Affine,
    /// The factors of n.l and s^rho, in levels.
    pub diffuse: [f32; 3],
    pub specular: [f32; 3],
    /// The largest of each.
    pub most: [f64; 2],
}

impl FaceLight {
    /// A light on a face; None if it lights no pixel of it.
    fn new(face: &Face, normals: &Affine, surface: &Surface, light: &PointLight) -> Option<Self> {
        let coefficients = surface.coefficients(light);
        let most = coefficients.map(DVec3::max_element);
        let position = light.position - face.rays.lens.eye;
        if most == [0.0; 2] || face.is_behind(position, normals) {
            return None;
        }
        let [diffuse, specular] = coefficients.map(|levels| levels.as_vec3().to_array());
        Some(FaceLight {
            towards: face.towards(position, light.position - surface.centre),
            diffuse,
            specular,
            most,
        })
    }
}

/// A face of an object, its lights and its normals.
pub struct Phong<'a> {
    pub face: &'a Face<'a>,
    pub surface: Surface<'a>,
    pub gloss: &'a Gloss,
    /// The lights that reach it.
    pub lights: &'a [FaceLight],
    /// In levels.
    pub tolerance: f64,
    /// The ambient term, in levels.
    pub ambient: [f32; 3],
    /// The interpolated normal by u and v, and times w by pixel.
    normals: Affine,
    pub normal: Affine,
}

impl<'a> Phong<'a> {
    /// A face with these normals; `lights` is overwritten with the lights that reach it.
    pub fn new(
        face: &'a Face,
        normals: Affine,
        surface: Surface<'a>,
        gloss: &'a Gloss,
        lights: &'a mut Vec<FaceLight>,
        tolerance: f64,
    ) -> Self {
        lights.clear();
        let points = surface.illumination.points.iter();
        lights.extend(points.filter_map(|light| FaceLight::new(face, &normals, &surface, light)));
        Phong {
            face,
            surface,
            gloss,
            lights,
            tolerance,
            ambient: surface.ambient().as_vec3().to_array(),
            normals,
            normal: face.uvw.map(|it| normals.homogeneous(it.x, it.y, it.z)),
        }
    }

    /// See [`super::Shader::levels_f64`].
    pub fn levels_f64(&self, x: f64, y: f64) -> DVec3 {
        let face = self.face;
        let ([u, v], is_clamped) = face.uv_at(x, y);
        // A clamped point is not where the line of sight through the pixel meets the plane.
        let point = face.from_eye([u, v]);
        let is_turned = is_clamped && face.rays.lens.projection == Projection::Perspective;
        let to_eye = if is_turned {
            -point
        } else {
            face.rays.to_eye.at(x, y)
        };
        let normal = unit(self.normals.at(u, v));
        self.surface.sum(normal, unit(to_eye), |light| {
            let from_eye = light.position - face.rays.lens.eye;
            unit(if is_clamped {
                from_eye - point
            } else {
                let from_centre = light.position - self.surface.centre;
                face.towards(from_eye, from_centre).at(x, y)
            })
        })
    }
}
