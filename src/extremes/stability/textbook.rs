//! Phong's levels by the formula as a student writes it, in f32 from the scene's numbers on.
//!
//! ```text
//! model matrix --> world places and normals of the corners --+-- weights in the pixel --> P, n --> I
//! view, projection matrix --> clip coordinates --------------'
//! ```
//!
//! No step is adapted to f32. The reference in f32 is not the same: it subtracts positions first and evaluates each cuboid in
//! its own coordinates, which are free of errors that this formula makes.

use glam::camera::rh::{proj, view};
use glam::{DVec3, Mat3, Mat4, Vec3};

use crate::components::{LightKind, Mesh, TRIANGLES};
use crate::scene::{CuboidRecord, SceneRecord};

/// A perspective picture.
pub struct Textbook<'a> {
    scene: &'a SceneRecord,
    /// Width and height in pixels.
    size: [f32; 2],
    cuboids: Vec<Cuboid>,
    eye: Vec3,
}

struct Cuboid {
    /// In world space, and in clip space without the depth: x, y, w.
    corners: [Vec3; 8],
    clip: [Vec3; 8],
    normals: [Vec3; 8],
}

impl<'a> Textbook<'a> {
    /// The view of the first camera.
    pub fn new(scene: &'a SceneRecord, size: [usize; 2]) -> Self {
        let lens = &scene.camera[0];
        let [eye, target, up] = [lens.position, lens.target, lens.up].map(DVec3::as_vec3);
        let size @ [width, height] = size.map(|pixels| pixels as f32);
        let fov = (lens.fov as f32).to_radians();
        // The near plane does not matter: only x, y and w are used.
        let projection = proj::directx::perspective_infinite(fov, width / height, 1.0);
        let camera = projection * view::look_at_mat4(eye, target, up);
        let cuboid = |cuboid: &CuboidRecord| {
            let [x, y, z] = cuboid.rotation.as_vec3().to_array().map(f32::to_radians);
            let rotation =
                Mat3::from_rotation_z(z) * Mat3::from_rotation_y(y) * Mat3::from_rotation_x(x);
            let model =
                Mat4::from_translation(cuboid.position.as_vec3()) * Mat4::from_mat3(rotation);
            let corners = Mesh::cuboid(cuboid.size).corners.map(DVec3::as_vec3);
            Cuboid {
                corners: corners.map(|corner| model.transform_point3(corner)),
                clip: corners.map(|corner| {
                    let clip = camera * model * corner.extend(1.0);
                    Vec3::new(clip.x, clip.y, clip.w)
                }),
                normals: corners.map(|corner| (rotation * corner.signum()).normalize()),
            }
        };
        Textbook {
            scene,
            size,
            cuboids: scene.cuboid.iter().map(cuboid).collect(),
            eye,
        }
    }

    /// The levels of a face, cuboid * 6 + face, at pixel (`x`, `y`).
    pub fn levels(&self, face: usize, [x, y]: [usize; 2]) -> [f32; 3] {
        let cuboid = &self.cuboids[face / 6];
        let [width, height] = self.size;
        let pixel = Vec3::new(
            2.0 * (x as f32 + 0.5) / width - 1.0,
            1.0 - 2.0 * (y as f32 + 0.5) / height,
            1.0,
        );
        let triangles = [0, 1].map(|half| TRIANGLES[2 * (face % 6) + half].map(usize::from));
        let [first, second] = triangles.map(|corners| {
            // Perspective-correct (Olano and Greer 1997).
            let [a, b, c] = corners.map(|corner| cuboid.clip[corner]);
            let weights = Vec3::new(
                pixel.dot(b.cross(c)),
                pixel.dot(c.cross(a)),
                pixel.dot(a.cross(b)),
            );
            (corners, weights / weights.element_sum())
        });
        let is_first = first.1.min_element() >= second.1.min_element();
        let (corners, weights) = if is_first { first } else { second };
        let blend = |of: &[Vec3; 8]| {
            let [a, b, c] = corners.map(|corner| of[corner]);
            a * weights.x + b * weights.y + c * weights.z
        };
        let (position, normal) = (blend(&cuboid.corners), blend(&cuboid.normals).normalize());
        let material = self.scene.cuboid[face / 6].material;
        let to_eye = (self.eye - position).normalize();
        let terms = self.scene.light.iter().map(|light| {
            let sent = light.color.as_vec3() * light.intensity as f32 * light.gain as f32;
            let place = light.position.unwrap_or_default().as_vec3();
            let to_light = (place - position).normalize();
            let facing = normal.dot(to_light);
            match light.kind {
                LightKind::Ambient => material.ambient.as_vec3() * sent,
                LightKind::Diffuse => material.diffuse.as_vec3() * sent * facing.max(0.0),
                LightKind::Specular if facing > 0.0 => {
                    let reflected = normal * (2.0 * facing) - to_light;
                    let along = to_eye.dot(reflected).max(0.0);
                    material.specular.as_vec3() * sent * along.powf(material.shininess as f32)
                }
                LightKind::Specular => Vec3::ZERO,
            }
        });
        terms.sum::<Vec3>().to_array()
    }
}
