//! The picture of one cuboid without rotation at the origin, evaluated in f64 without a rasterizer. A ray through every
//! pixel centre is intersected with the slabs of the box (Kay and Kajiya 1986), and the model is evaluated by its
//! definition.
//!
//! On a face, corner normals and corner colours are simple functions of the position. The normal is proportional to (x
//! / half x, y / half y, z / half z). The colours are linear on each side of the diagonal from (-, -) to (+, +).

use glam::DVec3;
use hecs::World;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode, View};

use crate::support::scene::{at, empty, spawn_cuboid, spawn_light, view};

/// A cuboid from -`half` to `half`, its lights, and an eye that looks at its centre.
#[derive(Clone, Debug)]
pub struct Setting {
    pub half: DVec3,
    pub material: Material,
    /// Kind, levels sent, position.
    pub lights: Vec<(LightKind, DVec3, DVec3)>,
    pub eye: DVec3,
    /// In degrees.
    pub fov: f64,
    pub height: f64,
    pub size: [usize; 2],
    pub projection: Projection,
    pub mode: ShadingMode,
}

/// The visible triangle of a pixel, two per face in the order +x, -x, +y, -y, +z, -z, and its levels.
pub type Seen = Option<(u32, DVec3)>;

impl Setting {
    /// The default scene from one of its cameras, with the numbers of the assignment.
    pub fn default_scene(camera: usize) -> Self {
        let position = DVec3::splat(10.0);
        Setting {
            half: DVec3::new(2.0, 1.5, 1.0),
            material: Material {
                ambient: DVec3::splat(0.3),
                diffuse: DVec3::new(0.07568, 0.61424, 0.07568),
                specular: DVec3::new(0.633, 0.72811, 0.66),
                shininess: 76.8,
            },
            lights: vec![
                (LightKind::Diffuse, DVec3::splat(173.2), position),
                (LightKind::Diffuse, DVec3::X * 1385.6, position),
                (LightKind::Specular, DVec3::splat(255.0), position),
                (LightKind::Ambient, DVec3::splat(100.0), DVec3::ZERO),
            ],
            eye: [DVec3::new(7.0, 5.0, 8.0), DVec3::new(9.0, 6.0, -4.0)][camera],
            fov: 30.0,
            height: 6.3,
            size: [640, 480],
            projection: Projection::Perspective,
            mode: ShadingMode::Phong,
        }
    }

    /// The scene as entities.
    pub fn world(&self) -> World {
        let mut world = empty();
        spawn_cuboid(&mut world, 2.0 * self.half, at(DVec3::ZERO), self.material);
        for &(kind, levels, position) in &self.lights {
            spawn_light(&mut world, kind, levels, position);
        }
        world
    }

    /// The scene as a view, at tolerance 0.
    pub fn view(&self) -> View {
        let mut view = view(self.size, self.eye, DVec3::ZERO, self.projection);
        view.viewpoint.camera.fov = self.fov;
        view.viewpoint.camera.height = self.height;
        view.shading = Some(self.mode);
        view
    }

    /// All pixels, row by row from the top.
    pub fn truth(&self) -> Vec<Seen> {
        let forward = -self.eye.normalize();
        let right = forward.cross(DVec3::Y).normalize();
        let up = right.cross(forward);
        let [width, height] = self.size.map(|pixels| pixels as f64);
        let corner_colors: [DVec3; 8] = std::array::from_fn(|corner| {
            let sign = |bit: usize| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
            let signs = DVec3::new(sign(0), sign(1), sign(2));
            self.model(signs * self.half, signs.normalize(), forward)
        });
        let pixel = |x: usize, y: usize| {
            let across = (x as f64 + 0.5 - width / 2.0) / height;
            let above = (height / 2.0 - y as f64 - 0.5) / height;
            let aside = right * across + up * above;
            let (start, along) = match self.projection {
                Projection::Perspective => (
                    self.eye,
                    forward + aside * 2.0 * (self.fov / 2.0).to_radians().tan(),
                ),
                Projection::Orthographic => (self.eye + aside * self.height, forward),
            };
            let (axis, point) = self.meet(start, along)?;
            let place = point / self.half;
            let (second, color) = on_face(&corner_colors, axis, place);
            let levels = match self.mode {
                ShadingMode::Gouraud => color,
                _ => self.model(point, place.normalize(), forward),
            };
            let face = 2 * axis as u32 + u32::from(place[axis] < 0.0);
            Some((2 * face + u32::from(second), levels))
        };
        (0..self.size[1])
            .flat_map(|y| (0..self.size[0]).map(move |x| pixel(x, y)))
            .collect()
    }

    /// The distance at which a ray enters the box, and the axis of the slab.
    fn meet(&self, start: DVec3, along: DVec3) -> Option<(usize, DVec3)> {
        let [one, other] = [-self.half, self.half].map(|side| (side - start) / along);
        let (enter, leave) = (one.min(other), one.max(other));
        let axis = (0..3).max_by(|&a, &b| enter[a].total_cmp(&enter[b]))?;
        let distance = enter[axis];
        (distance > 0.0 && distance < leave.min_element()).then(|| {
            let mut point = start + along * distance;
            point[axis] = self.half[axis].copysign(point[axis]);
            (axis, point)
        })
    }

    /// The illumination model.
    fn model(&self, point: DVec3, n: DVec3, forward: DVec3) -> DVec3 {
        let o = match self.projection {
            Projection::Perspective => (self.eye - point).normalize(),
            Projection::Orthographic => -forward,
        };
        let Material {
            ambient,
            diffuse,
            specular,
            shininess,
        } = self.material;
        let terms = self.lights.iter().map(|&(kind, levels, position)| {
            let l = (position - point).normalize();
            let cosine = n.dot(l);
            let mirrored = 2.0 * cosine * n - l;
            match kind {
                LightKind::Ambient => ambient * levels,
                LightKind::Diffuse => diffuse * levels * cosine.max(0.0),
                LightKind::Specular if cosine > 0.0 => {
                    specular * levels * o.dot(mirrored).max(0.0).powf(shininess)
                }
                LightKind::Specular => DVec3::ZERO,
            }
        });
        terms.sum()
    }
}

/// Corner colours, linear on each half of a face, and whether the half is the second triangle. `place` is in -1..1
/// along both axes of the face. Seen from outside, the first triangle is to the right of the diagonal.
fn on_face(colors: &[DVec3; 8], axis: usize, place: DVec3) -> (bool, DVec3) {
    let (across, along) = ((axis + 1) % 3, (axis + 2) % 3);
    let (u, v) = (place[across], place[along]);
    let positive = place[axis] > 0.0;
    let color = |right: bool, up: bool| {
        let bits = [(positive, axis), (right, across), (up, along)];
        colors[bits
            .map(|(bit, axis)| usize::from(bit) << axis)
            .iter()
            .sum::<usize>()]
    };
    let color = color(false, false) * ((1.0 - u.max(v)) / 2.0)
        + color(u > v, v >= u) * ((u - v).abs() / 2.0)
        + color(true, true) * f64::midpoint(u.min(v), 1.0);
    ((u > v) != positive, color)
}
