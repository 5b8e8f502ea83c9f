//! Random scenes of a few cuboids, with lights anywhere, just above faces and at highlights, and a view of them.

use proptest::prelude::*;
use shadetrade::scene::{CameraRecord, CuboidRecord, LightRecord};

use super::prelude::*;

/// A scene, given by its seed.
#[derive(Clone, Debug)]
pub struct Case {
    pub seed: u64,
    pub mode: ShadingMode,
}

/// A random scene in one shading mode.
pub fn case(mode: ShadingMode) -> impl Strategy<Value = Case> {
    any::<u64>().prop_map(move |seed| Case { seed, mode })
}

/// Evenly distributed in the logarithm.
pub fn between(least: f64, most: f64) -> impl Strategy<Value = f64> {
    (least.ln()..most.ln()).prop_map(f64::exp)
}

impl Case {
    /// The scene and a view of it.
    pub fn build(&self, size: [usize; 2], tolerance: f64) -> (World, View) {
        let world = self.record(tolerance).spawn();
        let view = View::of(&world, size);
        (world, view)
    }

    /// The scene. Distances grow with the radius of the first cuboid.
    pub fn record(&self, tolerance: f64) -> SceneRecord {
        let random = &mut Random(self.seed);
        // Coordinates far from the origin have fewer bits for details.
        let offset = random.around(1e6) * random.one_of(&[0.0, 0.0, 0.0, 1.0]);
        let count = 1 + random.below(3);
        let mut cuboids: Vec<_> = (0..count)
            .map(|index| self.cuboid(random, index, offset))
            .collect();
        let radius = cuboids[0].size.length() / 2.0;
        for cuboid in &mut cuboids[1..] {
            cuboid.position += random.around(1.5) * radius;
        }
        let projection = random.one_of(&Projection::ALL);
        let reach = random.between(0.3, 20.0) * radius;
        let eye = offset + random.direction() * reach;
        let target = offset + random.around(0.3) * radius;
        let to_eye = |point: DVec3| match projection {
            Projection::Perspective => eye - point,
            Projection::Orthographic => eye - target,
        };
        let count = random.below(6);
        let lights = (0..count)
            .map(|index| light(random, index, &cuboids[0], to_eye))
            .collect();
        let up = loop {
            let up = random.direction();
            if up.cross((target - eye).normalize()).length() > 0.01 {
                break up;
            }
        };
        let sees = [
            random.between(3.0, 150.0),
            random.between(0.1, 4.0) * radius,
        ];
        let camera = CameraRecord {
            up,
            near: Some(random.between(1e-3, 1.0) * radius),
            ..records::camera("random", eye, target, sees)
        };
        SceneRecord {
            background: DVec3::new(20.0, 20.0, 24.0),
            cuboid: cuboids,
            light: lights,
            camera: vec![camera],
            view: Viewer {
                projection,
                tolerance,
                ..Viewer::default()
            },
        }
    }

    fn cuboid(&self, random: &mut Random, index: usize, position: DVec3) -> CuboidRecord {
        let size = DVec3::ZERO.map(|_| random.between(0.01, 100.0));
        let [smooth, sharp] = [(0.5, 1e3), (1e3, 1e6)].map(|(a, b)| random.between(a, b));
        // Its own stream leaves the other numbers of a seed as they are.
        let cells = &mut Random(!self.seed ^ index as u64);
        let many = cells.between(1.0, 256.999) as u32;
        CuboidRecord {
            segments: Segments::new(cells.one_of(&[1, 1, 1, many])).unwrap_or_default(),
            rotation: random.around(400.0),
            shading: self.mode,
            normals: NormalMode::ALL
                [usize::from((self.seed >> (20 + 2 * index)).is_multiple_of(4))],
            material: Material {
                ambient: DVec3::new(0.1, 0.2, 0.3),
                diffuse: DVec3::new(0.9, 0.6, 0.3),
                specular: DVec3::new(0.3, 0.7, 1.0),
                shininess: random.one_of(&[0.0, sharp, smooth, smooth, smooth, smooth]),
            },
            ..records::cuboid(index.to_string(), size, position)
        }
    }
}

/// A light anywhere, above a face of the cuboid, or where a point of the face reflects it to the eye.
fn light(
    random: &mut Random,
    index: usize,
    cuboid: &CuboidRecord,
    to_eye: impl Fn(DVec3) -> DVec3,
) -> LightRecord {
    use LightKind::{Ambient, Diffuse, Specular};
    let axes = turned(cuboid.rotation).axes();
    let radius = cuboid.size.length() / 2.0;
    let axis = random.below(3);
    let mut on_face = random.around(1.0);
    on_face[axis] = 1.0_f64.copysign(on_face[axis]);
    let point = cuboid.position + axes * (on_face * cuboid.size / 2.0);
    let position = match random.below(3) {
        0 => cuboid.position + random.direction() * random.between(0.3, 30.0) * radius,
        1 => point + axes.col(axis) * on_face[axis] * random.between(1e-4, 1.0) * radius,
        _ => {
            let (normal, to_eye) = ((axes * on_face).normalize(), to_eye(point).normalize());
            let to_light = 2.0 * normal.dot(to_eye) * normal - to_eye;
            point + to_light * random.between(0.01, 10.0) * radius
        }
    };
    let kind = random.one_of(&[Ambient, Diffuse, Diffuse, Specular, Specular, Specular]);
    let levels = random.between(10.0, 2000.0);
    LightRecord {
        color: DVec3::ZERO.map(|_| random.within(0.0, 1.0)),
        on: random.below(6) > 0,
        ..records::light(index.to_string(), kind, levels, position)
    }
}
