//! Position and normal interpolated, the model at every pixel (Phong 1975): the whole of it, certified square by square.
//!
//! A light behind the whole square is left out, and a highlight that stays below its share of the tolerance. All other light
//! is interpolated through nine samples where [`super::bound`] shows that this keeps the tolerance, and evaluated at every
//! pixel elsewhere.
//!
//! Rule: the error of every term, rounding included, is taken off the tolerance. At tolerance 0 every pixel is evaluated, and
//! the tolerance is [`super::EXACT`].

mod tile;

use glam::DVec3;

pub use self::tile::TileLights;
use super::face::{Face, Linear};
use super::field::Moving;
use super::gloss::Gloss;
use super::surface::Surface;
use crate::components::{PointLight, unit};

/// A point light on a face.
#[derive(Clone, Copy, Debug)]
pub struct FaceLight {
    /// w (L - P).
    pub towards: Moving,
    /// The factors of n.l and s^rho, in levels.
    pub diffuse: [f32; 3],
    pub specular: [f32; 3],
    /// The largest of each.
    pub most: [f64; 2],
}

impl FaceLight {
    /// A light that lights a face at all; `eye` in world units.
    fn new(
        face: &Face,
        normals: &Linear,
        surface: &Surface,
        light: &PointLight,
        eye: DVec3,
    ) -> Option<Self> {
        let coefficients = surface.coefficients(light);
        let most = coefficients.map(DVec3::max_element);
        let position = light.position - eye;
        if most == [0.0; 2] || face.is_behind(position, normals) {
            return None;
        }
        let [diffuse, specular] = coefficients.map(|levels| levels.as_vec3().to_array());
        Some(FaceLight {
            towards: face
                .towards(position, light.position - surface.centre)
                .into(),
            diffuse,
            specular,
            most,
        })
    }
}

/// The data of a face of a shaded object that all of its squares share.
pub struct Phong<'a> {
    pub face: &'a Face<'a>,
    pub surface: Surface<'a>,
    /// The eye, in world units.
    pub eye: DVec3,
    pub gloss: &'a Gloss,
    /// The lights that reach it.
    pub lights: &'a [FaceLight],
    /// In levels.
    pub tolerance: f64,
    /// The ambient term, in levels.
    pub ambient: [f32; 3],
    /// The interpolated normal, and the same times w.
    normals: Linear,
    normal: Moving,
}

impl<'a> Phong<'a> {
    /// A face of an object, from its normals; `lights` is overwritten with those that reach it.
    pub fn new(
        face: &'a Face,
        normals: Linear,
        surface: Surface<'a>,
        eye: DVec3,
        gloss: &'a Gloss,
        lights: &'a mut Vec<FaceLight>,
        tolerance: f64,
    ) -> Self {
        lights.clear();
        let points = surface.illumination.points.iter();
        lights.extend(
            points.filter_map(|light| FaceLight::new(face, &normals, &surface, light, eye)),
        );
        Phong {
            face,
            surface,
            eye,
            gloss,
            lights,
            tolerance,
            ambient: surface.ambient().as_vec3().to_array(),
            normals,
            normal: face.place.map(|place| normals.scaled(place)).into(),
        }
    }

    /// The brightest channel of the ambient term, in levels.
    fn brightest_ambient(&self) -> f64 {
        self.surface.ambient().max_element()
    }

    /// See [`super::Shader::define`].
    pub fn define(&self, x: f64, y: f64) -> DVec3 {
        let point = self.face.point(x, y);
        let normal = unit(self.normals.at(point.place));
        let to_eye = unit(self.face.to_eye(&point));
        self.surface.sum(normal, to_eye, |light| {
            let [from_eye, from_centre] =
                [self.eye, self.surface.centre].map(|origin| light.position - origin);
            unit(self.face.to_light(&point, from_eye, from_centre))
        })
    }
}
