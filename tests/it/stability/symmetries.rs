//! Symmetries of random scenes: the order of cuboids, a scene and its mirror image, and a cuboid written in another way.
//!
//! `SHADETRADE_CASES` sets the number of scenes of each test (default 64).

use std::ops::Range;

use glam::DVec3;
use hecs::World;
use proptest::prelude::*;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode, Transform, View};
use shadetrade::frame::{Frame, Keep, NO_TRIANGLE};
use shadetrade::reference::picture;

use crate::support::cases::cases;
use crate::support::scene::{draw, empty, spawn_cuboid, spawn_light, view};

const SIZE: [usize; 2] = [65, 48];

/// The largest difference of two exact pictures: each errs by at most 0.05 level.
const TWICE_EXACT: f64 = 0.1;

/// The number of outline pixels that rounding of the snapped corners may move: a few of some 400.
const SNAPPED: usize = 12;

#[derive(Clone, Debug)]
struct Cuboid {
    size: DVec3,
    transform: Transform,
    material: Material,
}

#[derive(Clone, Debug)]
struct Lamp {
    kind: LightKind,
    levels: DVec3,
    position: DVec3,
}

#[derive(Clone, Debug)]
struct Scene {
    cuboids: Vec<Cuboid>,
    lamps: Vec<Lamp>,
    view: View,
}

impl Scene {
    fn world(&self) -> World {
        let mut world = empty();
        for cuboid in &self.cuboids {
            spawn_cuboid(&mut world, cuboid.size, cuboid.transform, cuboid.material);
        }
        for lamp in &self.lamps {
            spawn_light(&mut world, lamp.kind, lamp.levels, lamp.position);
        }
        world
    }

    fn draw(&self) -> Frame {
        draw(&mut self.world(), &self.view, Keep::Levels)
    }

    fn in_mode(&self, mode: ShadingMode) -> Scene {
        Scene {
            view: self.view.shaded(mode),
            ..self.clone()
        }
    }
}

fn vector(range: Range<f64>) -> impl Strategy<Value = DVec3> {
    [range.clone(), range.clone(), range].prop_map(DVec3::from)
}

fn cuboid() -> impl Strategy<Value = Cuboid> {
    let transform = [vector(-2.0..2.0), vector(-180.0..180.0)]
        .prop_map(|[position, rotation]| Transform { position, rotation });
    let material =
        ([0.0..1.0, 0.0..1.0, 0.0..1.0], -0.3..3.0_f64).prop_map(|(k, decade)| Material {
            ambient: DVec3::new(0.3, 0.2, 0.1),
            diffuse: DVec3::from(k),
            specular: DVec3::ONE - DVec3::from(k),
            shininess: 10.0_f64.powf(decade),
        });
    (vector(0.5..4.0), transform, material).prop_map(|(size, transform, material)| Cuboid {
        size,
        transform,
        material,
    })
}

fn lamp() -> impl Strategy<Value = Lamp> {
    let kinds = vec![LightKind::Ambient, LightKind::Diffuse, LightKind::Specular];
    (
        prop::sample::select(kinds),
        vector(0.0..300.0),
        vector(-12.0..12.0),
    )
        .prop_map(|(kind, levels, position)| Lamp {
            kind,
            levels,
            position,
        })
}

fn scene() -> impl Strategy<Value = Scene> {
    let projections = vec![Projection::Perspective, Projection::Orthographic];
    let eye = vector(-9.0..9.0).prop_filter("it stands away", |eye| eye.x.hypot(eye.z) > 5.0);
    let sight = (eye, vector(-0.5..0.5), prop::sample::select(projections));
    let things = (
        prop::collection::vec(cuboid(), 1..4),
        prop::collection::vec(lamp(), 1..6),
    );
    (things, sight).prop_map(|((cuboids, lamps), (eye, target, projection))| Scene {
        cuboids,
        lamps,
        view: view(SIZE, eye, target, projection),
    })
}

fn config() -> ProptestConfig {
    ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(cases(64) as u32)
    }
}

/// The identity.
fn same<T>(what: T) -> T {
    what
}

/// The largest difference of two pixels in displayed levels.
fn difference(a: [f32; 3], b: [f32; 3]) -> f64 {
    let shown = |level: f32| f64::from(level).clamp(0.0, 255.0);
    let channels = a.into_iter().zip(b);
    channels
        .map(|(a, b)| (shown(a) - shown(b)).abs())
        .fold(0.0, f64::max)
}

/// The picture of a scene, and the triangles that the lines of sight through pixel centres hit.
fn drawn(scene: &Scene) -> (Frame, Vec<u32>) {
    let rows = 0..SIZE[1];
    let truth = picture(&scene.world(), &scene.view, rows, &|| false, &|_| ());
    (scene.draw(), truth.expect("it is not cancelled").triangles)
}

/// Asserts that two scenes show the same faces except at a few pixels of edges, and levels within [`TWICE_EXACT`] where
/// both pixel centres lie in the visible triangle. `pixel` maps a pixel of the first picture to the second, `face` a
/// face of the second to the first.
fn alike(
    first: &Scene,
    second: &Scene,
    pixel: impl Fn(usize) -> usize,
    face: impl Fn(u32) -> u32,
) -> Result<(), TestCaseError> {
    let ((first, first_met), (second, second_met)) = (drawn(first), drawn(second));
    let seen = |id: u32| (id != NO_TRIANGLE).then_some((id / 12, id % 12 / 2));
    let (mut astray, mut compared) = (0, 0);
    for (here, &id) in first.triangles().iter().enumerate() {
        let there = pixel(here);
        let other = second.triangles()[there];
        if seen(id) != seen(other).map(|(cuboid, other)| (cuboid, face(other))) {
            astray += 1;
        } else if id != NO_TRIANGLE && id == first_met[here] && other == second_met[there] {
            let error = difference(first.levels()[here], second.levels()[there]);
            prop_assert!(error <= TWICE_EXACT, "{error} levels at pixel {here}");
            compared += 1;
        }
    }
    prop_assert!(astray <= SNAPPED, "{astray} pixels show another face");
    prop_assert!(compared >= 10 * astray, "{compared} pixels are compared");
    Ok(())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_order_of_cuboids_changes_no_bit(
        (scene, order) in scene().prop_flat_map(|scene| {
            let order: Vec<usize> = (0..scene.cuboids.len()).collect();
            (Just(scene), Just(order).prop_shuffle())
        }),
        tolerance in prop::sample::select(vec![0.0, 0.5]),
    ) {
        for mode in [ShadingMode::Gouraud, ShadingMode::Phong, ShadingMode::UnitVectors] {
            let mut scene = scene.in_mode(mode);
            scene.view.tolerance = tolerance;
            let first = scene.draw();
            let cuboids = order.iter().map(|&from| scene.cuboids[from].clone()).collect();
            let second = Scene { cuboids, ..scene.clone() }.draw();
            for (pixel, id) in second.triangles().iter().enumerate() {
                // The depths of random cuboids do not tie.
                let expected = match *id {
                    NO_TRIANGLE => NO_TRIANGLE,
                    id => order[id as usize / 12] as u32 * 12 + id % 12,
                };
                prop_assert_eq!(first.triangles()[pixel], expected);
                let bits = |frame: &Frame| frame.levels()[pixel].map(f32::to_bits);
                prop_assert_eq!(bits(&first), bits(&second), "pixel {}", pixel);
            }
        }
    }

    #[test]
    fn a_mirrored_scene_is_the_mirrored_picture(scene in scene()) {
        let mirror = |v: DVec3| DVec3::new(-v.x, v.y, v.z);
        let scene = scene.in_mode(ShadingMode::Phong);
        let mut mirrored = scene.clone();
        for cuboid in &mut mirrored.cuboids {
            cuboid.transform.position = mirror(cuboid.transform.position);
            // A rotation about the mirror's normal stays, a rotation about an axis in the mirror is reversed.
            cuboid.transform.rotation = -mirror(cuboid.transform.rotation);
        }
        for lamp in &mut mirrored.lamps {
            lamp.position = mirror(lamp.position);
        }
        let viewpoint = &mut mirrored.view.viewpoint;
        viewpoint.position = mirror(viewpoint.position);
        viewpoint.camera.target = mirror(viewpoint.camera.target);
        // Swaps +x and -x.
        let exchanged = |face: u32| if face < 2 { 1 - face } else { face };
        let [width, _] = SIZE;
        let across = |pixel: usize| pixel - pixel % width + (width - 1 - pixel % width);
        alike(&scene, &mirrored, across, exchanged)?;
    }

    #[test]
    fn a_cuboid_written_another_way_is_the_same_picture(scene in scene(), quarters in 1..4_u8) {
        // Rotated about its own x axis, which its rotation applies first. Its corners and triangles then have another
        // order.
        let scene = scene.in_mode(ShadingMode::Phong);
        let mut rewritten = scene.clone();
        for cuboid in &mut rewritten.cuboids {
            cuboid.transform.rotation.x += 90.0 * f64::from(quarters);
            if quarters % 2 == 1 {
                let DVec3 { x, y, z } = cuboid.size;
                cuboid.size = DVec3::new(x, z, y);
            }
        }
        // A quarter turn moves +y, +z, -y, -z to +z, -y, -z, +y: faces 2, 4, 3, 5 in a ring.
        let turned = |face: u32| (0..quarters).fold(face, |face, _| [0, 1, 4, 5, 3, 2][face as usize]);
        alike(&scene, &rewritten, same, turned)?;
    }
}
