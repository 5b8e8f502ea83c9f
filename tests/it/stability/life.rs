//! A scene of three intersecting cuboids under five lights, and all ways to draw it.

use std::ops::Range;

use shadetrade::components::LightKind::{Ambient, Diffuse, Specular};

use crate::support::prelude::*;

/// The first `count` of the three cuboids, and the lights.
pub fn still_life(count: usize) -> World {
    let mut world = empty();
    let cuboids = [
        ([4.0, 3.0, 2.0], [0.0; 3], [10.0, 20.0, 30.0], 76.8),
        ([0.5, 9.0, 0.5], [1.0, 0.5, 0.5], [0.0, 0.0, -60.0], 9.0),
        ([3.0, 0.125, 3.0], [-1.0, 1.0, 0.75], [45.0, 0.0, 0.0], 1e3),
    ];
    for (size, position, rotation, shininess) in cuboids.into_iter().take(count) {
        let material = Material {
            ambient: DVec3::new(0.25, 0.125, 0.5),
            diffuse: DVec3::new(0.75, 0.5, 0.25),
            specular: DVec3::new(0.5, 0.75, 1.0),
            shininess,
        };
        let place = placed(position, rotation);
        spawn_cuboid(&mut world, size.into(), place, material);
    }
    for (kind, levels, position) in [
        (Ambient, [40.0; 3], [0.0; 3]),
        (Diffuse, [90.0, 60.0, 200.0], [4.0, 8.0, 6.0]),
        (Specular, [200.0; 3], [4.0, 8.0, 6.0]),
        (Diffuse, [300.0, 0.0, 0.0], [-6.0, 1.0, 2.0]),
        (Specular, [0.0, 90.0, 0.0], [2.0, 2.0, 1.5]),
    ] {
        spawn_light(&mut world, kind, levels.into(), position.into());
    }
    world
}

/// Views of it in every projection and mode, at tolerances 0, 0.5 and 4.
pub fn views(size: [usize; 2]) -> Vec<View> {
    let mut views = Vec::new();
    for projection in Projection::ALL {
        let (eye, target) = (DVec3::new(4.0, 3.0, 9.0), DVec3::new(0.0, 0.125, 0.0));
        let view = view(size, eye, target, projection);
        for mode in ShadingMode::ALL {
            let view = view.shaded(mode);
            views.extend([0.0, 0.5, 4.0].map(|it| view.with_tolerance(it)));
        }
        for (cells, tolerance) in [(2, 0.5), (7, 0.0), (64, 0.5)] {
            let mut view = view.shaded(ShadingMode::Gouraud);
            view.segments = Segments::new(cells);
            views.push(view.with_tolerance(tolerance));
        }
    }
    views
}

/// All buffers of a frame, floats as their bits.
#[derive(PartialEq, Eq)]
pub struct Bits {
    pub pixels: Vec<u32>,
    pub levels: Vec<[u32; 3]>,
    pub triangles: Vec<TriangleId>,
}

impl Bits {
    pub fn of(frame: &Frame) -> Self {
        let levels = frame.levels().iter();
        Bits {
            pixels: frame.pixels().to_vec(),
            levels: levels.map(|levels| levels.map(f32::to_bits)).collect(),
            triangles: frame.triangles().to_vec(),
        }
    }

    /// Some of the pixels. Buffers that the frame does not keep are empty.
    pub fn part(&self, pixels: Range<usize>) -> Self {
        Bits {
            pixels: self.pixels.get(pixels.clone()).unwrap_or_default().to_vec(),
            levels: self.levels.get(pixels.clone()).unwrap_or_default().to_vec(),
            triangles: self.triangles.get(pixels).unwrap_or_default().to_vec(),
        }
    }
}
