//! The renderer against the reference, on random scenes.
//!
//! `SHADETRADE_CASES` sets how many scenes (256 if unset); the first n are always the same.

use std::cell::RefCell;

use fearless_simd::Level;
use glam::DVec3;
use hecs::World;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use shadetrade::components::{
    Camera, Illumination, Light, LightKind, Material, Mesh, Name, Normals, Projected, Projection,
    ShadingMode, Transform, VertexColors, View, Viewpoint,
};
use shadetrade::frame::{Frame, Keep, Workers};
use shadetrade::reference::at_pixel;
use shadetrade::systems;
use shadetrade::trade::metrics::{Picture, compare, pixel_error};

use super::invariance::mixed_scene;
use super::scenes::{draw, shaded};

const SIZE: [usize; 2] = [64, 48];

/// What the contract calls exact: the largest error at tolerance 0, in levels.
const EXACT: f64 = 0.05;

/// Tolerances below that, from the least that is allowed, in levels.
const FINE: [f64; 5] = [1e-4, 3e-4, 1e-3, 5e-3, 0.02];

/// Pixels whose centre the snapping of vertices to 1/256 pixel may move over an edge: a few on each of some 30 edges.
const SNAPPED: u64 = 60;

/// Lengths in all but `cuboids` are in multiples of the first cuboid's radius, places from its centre.
#[derive(Clone, Debug)]
struct Case {
    offset: DVec3,
    cuboids: Vec<Cuboid>,
    lights: Vec<Lamp>,
    eye: DVec3,
    target: DVec3,
    up: DVec3,
    fov: f64,
    height: f64,
    near: f64,
    projection: Projection,
    mode: ShadingMode,
}

#[derive(Clone, Debug)]
struct Cuboid {
    size: DVec3,
    place: DVec3,
    rotation: DVec3,
    shininess: f64,
}

#[derive(Clone, Debug)]
struct Lamp {
    kind: LightKind,
    intensity: f64,
    color: DVec3,
    place: Place,
}

#[derive(Clone, Debug)]
enum Place {
    /// In multiples of the radius, from the centre.
    Anywhere(DVec3),
    /// Over a face of the first cuboid: the axis it crosses, where on it (-1..1), and how high in multiples of the
    /// radius.
    OverFace(usize, DVec3, f64),
    /// Where a place like that, on the face, mirrors it to the eye, and how far from it.
    InMirror(usize, DVec3, f64),
}

fn between(least: f64, most: f64) -> impl Strategy<Value = f64> {
    (least.ln()..most.ln()).prop_map(f64::exp)
}

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    [-size..size, -size..size, -size..size].prop_map(DVec3::from)
}

fn direction() -> impl Strategy<Value = DVec3> {
    vector(1.0)
        .prop_filter("has a direction", |v| v.length() > 0.1)
        .prop_map(DVec3::normalize)
}

fn cuboid() -> impl Strategy<Value = Cuboid> {
    let size = [
        between(0.01, 100.0),
        between(0.01, 100.0),
        between(0.01, 100.0),
    ];
    let shininess =
        prop_oneof![4 => between(0.5, 1000.0), 1 => between(1000.0, 1e6), 1 => Just(0.0)];
    (size, vector(1.5), vector(400.0), shininess).prop_map(|(size, place, rotation, shininess)| {
        Cuboid {
            size: size.into(),
            place,
            rotation,
            shininess,
        }
    })
}

fn lamp() -> impl Strategy<Value = Lamp> {
    let kind = prop_oneof![
        1 => Just(LightKind::Ambient),
        2 => Just(LightKind::Diffuse),
        3 => Just(LightKind::Specular),
    ];
    let over = (0..3_usize, vector(1.0), between(1e-4, 1.0));
    let mirrored = (0..3_usize, vector(1.0), between(0.01, 10.0));
    let place = prop_oneof![
        (direction(), between(0.3, 30.0)).prop_map(|(d, reach)| Place::Anywhere(d * reach)),
        over.prop_map(|(axis, at, height)| Place::OverFace(axis, at, height)),
        mirrored.prop_map(|(axis, at, reach)| Place::InMirror(axis, at, reach)),
    ];
    let color = [0.0..1.0, 0.0..1.0, 0.0..1.0].prop_map(DVec3::from);
    (kind, between(10.0, 2000.0), color, place).prop_map(|(kind, intensity, color, place)| Lamp {
        kind,
        intensity,
        color,
        place,
    })
}

fn case(mode: ShadingMode) -> impl Strategy<Value = Case> {
    let offset = prop_oneof![3 => Just(DVec3::ZERO), 1 => vector(1e6)];
    let things = (
        offset,
        prop::collection::vec(cuboid(), 1..4),
        prop::collection::vec(lamp(), 0..6),
    );
    let eye = (direction(), between(0.3, 20.0)).prop_map(|(d, reach)| d * reach);
    let projection = prop_oneof![
        Just(Projection::Perspective),
        Just(Projection::Orthographic)
    ];
    let sight = (
        eye,
        vector(0.3),
        direction(),
        between(3.0, 150.0),
        between(0.1, 4.0),
        between(1e-3, 1.0),
    );
    (things, sight, projection)
        .prop_map(
            move |((offset, cuboids, lights), (eye, target, up, fov, height, near), projection)| {
                Case {
                    offset,
                    cuboids,
                    lights,
                    eye,
                    target,
                    up,
                    fov,
                    height,
                    near,
                    projection,
                    mode,
                }
            },
        )
        .prop_filter("up is not the view direction", |case| {
            case.up.cross((case.target - case.eye).normalize()).length() > 0.01
        })
}

impl Case {
    fn build(&self, tolerance: f64) -> (World, View) {
        let first = &self.cuboids[0];
        let radius = first.size.length() / 2.0;
        let place = |place: DVec3| self.offset + place * radius;
        let mut world = World::new();
        world.spawn((Illumination::default(),));
        for (index, cuboid) in self.cuboids.iter().enumerate() {
            let position = if index == 0 {
                self.offset
            } else {
                place(cuboid.place)
            };
            world.spawn((
                Name(index.to_string()),
                Transform {
                    position,
                    rotation: cuboid.rotation,
                },
                Mesh::cuboid(cuboid.size),
                Material {
                    ambient: DVec3::new(0.1, 0.2, 0.3),
                    diffuse: DVec3::new(0.9, 0.6, 0.3),
                    specular: DVec3::new(0.3, 0.7, 1.0),
                    shininess: cuboid.shininess,
                },
                self.mode,
                Normals::default(),
                VertexColors::default(),
                Projected::default(),
            ));
        }
        let axes = Transform {
            position: self.offset,
            rotation: first.rotation,
        }
        .axes();
        let on_face = |axis: usize, mut at: DVec3| {
            at[axis] = 1.0_f64.copysign(at[axis]);
            at
        };
        for (index, lamp) in self.lights.iter().enumerate() {
            let position = match lamp.place {
                Place::Anywhere(at) => place(at),
                Place::OverFace(axis, at, height) => {
                    let mut local = on_face(axis, at) * first.size / 2.0;
                    local[axis] += (height * radius).copysign(at[axis]);
                    self.offset + axes * local
                }
                Place::InMirror(axis, at, reach) => {
                    let at = on_face(axis, at);
                    let point = axes * (at * first.size / 2.0);
                    let to_eye = match self.projection {
                        Projection::Perspective => self.eye * radius - point,
                        Projection::Orthographic => self.eye - self.target,
                    };
                    let (normal, to_eye) = ((axes * at).normalize(), to_eye.normalize());
                    let to_light = 2.0 * normal.dot(to_eye) * normal - to_eye;
                    self.offset + point + to_light * reach * radius
                }
            };
            let light = Light {
                kind: lamp.kind,
                color: lamp.color,
                intensity: lamp.intensity,
                gain: 1.0,
                on: true,
            };
            world.spawn((
                Name(index.to_string()),
                Transform {
                    position,
                    rotation: DVec3::ZERO,
                },
                light,
            ));
        }
        let camera = Camera {
            target: place(self.target),
            up: self.up,
            fov: self.fov,
            height: self.height * radius,
            near: Some(self.near * radius),
        };
        let view = View {
            size: SIZE,
            viewpoint: Viewpoint {
                position: place(self.eye),
                camera,
            },
            projection: self.projection,
            background: DVec3::new(20.0, 20.0, 24.0),
            shading: None,
            tolerance,
        };
        (world, view)
    }
}

/// Whether a light grazes what this pixel sees, so that the highlight's gate may fall either way.
fn is_exact_tie(world: &World, view: &View, x: usize, y: usize) -> bool {
    at_pixel(world, view, x, y).is_some_and(|seen| {
        seen.lights
            .iter()
            .filter_map(|light| light.to_light)
            .any(|l| seen.normal.dot(l).abs() < 1e-6)
    })
}

#[test]
fn gouraud_keeps_its_promise_wherever_both_see_one_face() {
    check(ShadingMode::Gouraud, 0.0);
    for tolerance in FINE.into_iter().chain([0.5]) {
        check(ShadingMode::Gouraud, tolerance);
    }
}

#[test]
fn phong_keeps_its_promise_wherever_both_see_one_face() {
    check(ShadingMode::Phong, 0.0);
    for tolerance in FINE.into_iter().chain([0.5, 4.0]) {
        check(ShadingMode::Phong, tolerance);
    }
}

#[test]
fn unit_vectors_keep_their_promise_wherever_both_see_one_face() {
    check(ShadingMode::UnitVectors, 0.0);
}

#[test]
fn scenes_far_from_the_origin_or_at_the_ends_of_the_allowed_lengths_keep_the_promise() {
    let workers = Workers::new(1, Level::new()).expect("one thread is always there");
    let mut frame = Frame::new(Keep::Levels, workers);
    for projection in [Projection::Perspective, Projection::Orthographic] {
        for (offset, scale) in [(1e9, 1.0), (0.0, 1e98), (0.0, 1e-98)] {
            for mode in [ShadingMode::Gouraud, ShadingMode::Phong] {
                let (mut world, view) = mixed_scene(offset, scale, projection);
                world.spawn((Illumination::default(),));
                let view = shaded(mode, &view);
                let truth = draw(&world, &view);
                systems::draw(&mut world, &view, &mut frame).expect("a small picture fits");
                let width = view.size[0];
                let drawn = Picture {
                    width,
                    levels: frame.levels(),
                    triangles: frame.triangles(),
                };
                let expected = Picture {
                    width,
                    levels: &truth.levels,
                    triangles: &truth.triangles,
                };
                let difference = compare(drawn, expected);
                let error = difference.error.expect("something is seen");
                assert!(error.max <= EXACT, "{error:?} at {offset} {scale} {mode:?}");
                assert!(
                    difference.edge_pixels <= 3,
                    "{difference:?} at {offset} {scale} {mode:?}"
                );
            }
        }
    }
}

/// Draws random scenes both ways. No pixel may err by more than the tolerance, or at 0 by more than what the contract calls
/// exact, and no byte by more than half a level besides.
fn check(mode: ShadingMode, tolerance: f64) {
    let promise = if tolerance > 0.0 { tolerance } else { EXACT };
    let cases = std::env::var("SHADETRADE_CASES").map_or(256, |cases| {
        cases.parse().expect("SHADETRADE_CASES is a number")
    });
    let config = Config {
        cases,
        failure_persistence: None,
        ..Config::default()
    };
    let mut runner =
        TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let workers = Workers::new(1, Level::new()).expect("one thread is always there");
    let frame = RefCell::new(Frame::new(Keep::Levels, workers));
    let display = RefCell::new(Frame::new(Keep::Display, Workers::alone(Level::new())));
    let worst = RefCell::new((0.0, None));
    let compared = RefCell::new([0, 0]);
    runner
        .run(&case(mode), |case| {
            let (mut world, view) = case.build(tolerance);
            let truth = draw(&world, &view);
            let mut frame = frame.borrow_mut();
            systems::draw(&mut world, &view, &mut frame).expect("a small picture fits");
            let mut display = display.borrow_mut();
            systems::draw(&mut world, &view, &mut display).expect("a small picture fits");
            let drawn = Picture {
                width: SIZE[0],
                levels: frame.levels(),
                triangles: frame.triangles(),
            };
            let expected = Picture {
                width: SIZE[0],
                levels: &truth.levels,
                triangles: &truth.triangles,
            };
            for pixel in (0..SIZE[0] * SIZE[1]).filter(|pixel| drawn.shows_as(&expected, *pixel)) {
                let [x, y] = [pixel % SIZE[0], pixel / SIZE[0]];
                let [_, bytes @ ..] = display.pixels()[pixel].to_be_bytes();
                let shown = pixel_error(bytes.map(f64::from), expected.levels[pixel]) - 0.5;
                let error = pixel_error(drawn.levels[pixel], expected.levels[pixel]).max(shown);
                // Beside a diagonal what is drawn may continue the other triangle of the face.
                if error > promise && drawn.triangles[pixel] != expected.triangles[pixel] {
                    continue;
                }
                let noteworthy = error > promise || error > worst.borrow().0;
                if noteworthy && !is_exact_tie(&world, &view, x, y) {
                    prop_assert!(
                        error <= promise,
                        "pixel ({x}, {y}) errs by {error}: {:?}, shown as {bytes:?}, not {:?}",
                        drawn.levels[pixel],
                        expected.levels[pixel]
                    );
                    *worst.borrow_mut() = (error, Some(case.clone()));
                }
            }
            let difference = compare(drawn, expected);
            prop_assert!(
                difference.edge_pixels <= SNAPPED,
                "{} edge pixels",
                difference.edge_pixels
            );
            let mut compared = compared.borrow_mut();
            compared[0] += difference.compared_pixels;
            compared[1] += difference.edge_pixels;
            Ok(())
        })
        .unwrap_or_else(|failure| panic!("{failure}"));
    println!("{mode:?}: worst error {:?}", worst.borrow());
    println!(
        "{mode:?}: compared pixels, edge pixels {:?}",
        compared.borrow()
    );
}
