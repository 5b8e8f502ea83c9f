//! Promises that the picture of every valid scene keeps.

use fearless_simd::Level;
use glam::DVec3;
use hecs::World;
use shadetrade::components::{Light, Material, Mesh, ShadingMode, Transform, View, length, unit};
use shadetrade::frame::{Frame, Keep, NO_TRIANGLE, Workers, display_step};
use shadetrade::reference::{in_row, picture};
use shadetrade::report::Monitor;
use shadetrade::systems;

/// The largest error at tolerance 0, in levels of 255.
const EXACT: f64 = 0.05;

/// The largest ratio of length to width of a cuboid with a promised accuracy. Beyond it the precision of f64 does not
/// suffice, and colours are only promised to be defined.
const LONGEST: f64 = 1e7;

/// The largest level at a corner with a promised accuracy. Beyond it f64 cannot resolve a level between two corners.
const BRIGHTEST: f64 = 1e9;

/// The largest distance of a cuboid from the eye with a promised accuracy, in multiples of its size. Beyond it f64
/// cannot tell its points apart.
const FARTHEST: f64 = 1e12;

/// A light within this distance of the visible point, in multiples of the cuboid's size, counts as at the point, where
/// it adds nothing.
const AT_THE_POINT: f64 = 1e-6;

/// Pictures are compared with the reference up to this ratio of length to width, and up to this distance from the eye
/// in multiples of a cuboid's size.
const PLAIN: f64 = 1e4;

fn frame(world: &mut World, view: &View, keep: Keep) -> Frame {
    let mut frame = Frame::new(keep, Workers::alone(Level::new()));
    systems::draw(world, view, &mut frame).expect("a small picture fits");
    frame
}

/// Draws `view` in every mode, at its tolerance and exactly.
///
/// # Panics
/// If a picture breaks a promise.
pub fn check(world: &mut World, view: &View) {
    for mode in [
        ShadingMode::Gouraud,
        ShadingMode::Phong,
        ShadingMode::UnitVectors,
    ] {
        let view = View {
            shading: Some(mode),
            ..view.clone()
        };
        let exactly = View {
            tolerance: 0.0,
            ..view.clone()
        };
        let exact = frame(world, &exactly, Keep::Levels);
        defined(world, &view, &exact);
        let certified = frame(world, &view, Keep::Levels);
        defined(world, &view, &certified);
        let longest = longest(world);
        let farthest = farthest(world, &view);
        if longest <= LONGEST && farthest <= FARTHEST {
            within(world, &view, &exact, &certified);
        }
        if longest <= PLAIN && farthest <= PLAIN && brightest(world) <= BRIGHTEST {
            true_to_the_reference(world, &exactly, &exact);
        }
        displayed(&certified, &frame(world, &view, Keep::Display));
    }
}

/// Asserts that no level is NaN, that pixels without a triangle show the background, and that counts and ids fit the
/// scene.
fn defined(world: &mut World, view: &View, frame: &Frame) {
    let cuboids = world.query_mut::<&Mesh>().into_iter().count() as u32;
    let background = view.background.as_vec3().to_array();
    let mut covered = 0;
    for (levels, &id) in frame.levels().iter().zip(frame.triangles()) {
        assert!(levels.iter().all(|level| !level.is_nan()), "{levels:?}");
        if id == NO_TRIANGLE {
            assert_eq!(*levels, background, "a pixel without a triangle");
        } else {
            assert!(id < 12 * cuboids, "there is no triangle {id}");
            covered += 1;
        }
    }
    // With a depth buffer a pixel may be covered more than once.
    assert!(frame.counts().covered_pixels >= covered);
}

/// Asserts that the tolerance moves no edge, and changes no displayed level by more than itself.
fn within(world: &World, view: &View, exact: &Frame, certified: &Frame) {
    let tolerance = view.tolerance + EXACT;
    assert_eq!(exact.triangles(), certified.triangles());
    let shown = |level: f32| f64::from(level).clamp(0.0, 255.0);
    let pairs = exact.levels().iter().zip(certified.levels());
    for (pixel, (exact, certified)) in pairs.enumerate() {
        for (&a, &b) in exact.iter().zip(certified) {
            let error = (shown(a) - shown(b)).abs();
            assert!(
                error <= tolerance || is_tie(world, view, pixel),
                "{error} levels at pixel {pixel}, {tolerance} allowed: {certified:?}, exactly {exact:?}"
            );
        }
    }
}

/// The largest ratio of length to width of the cuboids.
fn longest(world: &mut World) -> f64 {
    let ratio = |mesh: &Mesh| mesh.corners[7].max_element() / mesh.corners[7].min_element();
    world
        .query_mut::<&Mesh>()
        .into_iter()
        .map(ratio)
        .fold(1.0, f64::max)
}

/// An upper bound of the levels of any point under all lights.
fn brightest(world: &mut World) -> f64 {
    let sent: f64 = world
        .query_mut::<&Light>()
        .into_iter()
        .map(|light| light.levels().max_element())
        .sum();
    let answer = |material: &Material| {
        let Material {
            ambient,
            diffuse,
            specular,
            ..
        } = material;
        ambient.max(*diffuse).max(*specular).max_element()
    };
    let materials = world.query_mut::<&Material>().into_iter();
    sent * materials.map(answer).fold(0.0, f64::max)
}

/// The largest distance of a cuboid from the eye, in multiples of its size.
fn farthest(world: &mut World, view: &View) -> f64 {
    let far = |(mesh, transform): (&Mesh, &Transform)| {
        length(transform.position - view.camera.position) / length(mesh.corners[7])
    };
    let cuboids = world.query_mut::<(&Mesh, &Transform)>().into_iter();
    cuboids.map(far).fold(0.0, f64::max)
}

/// Asserts that the exact picture equals the reference where both show the same triangle and no light is tied.
fn true_to_the_reference(world: &World, view: &View, exact: &Frame) {
    let rows = 0..view.size[1];
    let truth = picture(world, view, rows, Monitor::NONE).expect("nobody cancels");
    let shown = |level: f64| level.clamp(0.0, 255.0);
    for (pixel, (drawn, truth_levels)) in exact.levels().iter().zip(&truth.levels).enumerate() {
        let id = truth.triangles[pixel];
        if id != exact.triangles()[pixel] || id == NO_TRIANGLE {
            continue;
        }
        for (&a, &b) in drawn.iter().zip(truth_levels) {
            let error = (shown(a.into()) - shown(b)).abs();
            assert!(
                error <= EXACT || is_tie(world, view, pixel),
                "{error} levels at pixel {pixel}, {:?}: drawn {drawn:?}, reference {truth_levels:?}",
                view.shading
            );
        }
    }
}

/// Whether the level of this pixel is ambiguous: a light grazes its face or is at the visible point, or the near plane
/// touches a corner, and so decides how unit vectors are interpolated.
fn is_tie(world: &World, view: &View, pixel: usize) -> bool {
    if view.shading == Some(ShadingMode::UnitVectors) && touches_a_corner(world, view) {
        return true;
    }
    let [x, y] = [pixel % view.size[0], pixel / view.size[0]];
    let Some(Some(seen)) = in_row(world, view, y, &[x]).pop() else {
        return true;
    };
    let grazes = |l: DVec3| seen.normal.dot(l).abs() < 1e-6;
    if seen
        .lights
        .iter()
        .filter_map(|light| light.to_light)
        .any(grazes)
    {
        return true;
    }
    let sizes = world
        .query::<&Mesh>()
        .iter()
        .map(|mesh| length(mesh.corners[7]))
        .fold(0.0, f64::max);
    let mut lights = world.query::<(&Light, &Transform)>();
    lights
        .iter()
        .any(|(_, place)| length(place.position - seen.position) <= AT_THE_POINT * sizes)
}

/// Whether the depth of a corner is that of the near plane, but for rounding.
fn touches_a_corner(world: &World, view: &View) -> bool {
    let (eye, near) = (view.camera.position, view.camera.near());
    let forward = unit(view.camera.target - eye);
    let mut cuboids = world.query::<(&Mesh, &Transform)>();
    cuboids.iter().any(|(mesh, transform)| {
        let transform = transform.turned(view.turned);
        let mut corners = mesh.corners.iter();
        corners.any(|corner| {
            let from_eye = transform.axes() * *corner + transform.position - eye;
            (forward.dot(from_eye) / near - 1.0).abs() < 1e-12
        })
    })
}

/// Asserts that the displayed bytes are the display step of the levels, or of the next float: certified squares convert
/// levels that may differ in the last bit.
fn displayed(levels: &Frame, bytes: &Frame) {
    for (pixel, (levels, shown)) in levels.levels().iter().zip(bytes.pixels()).enumerate() {
        let [_, shown @ ..] = shown.to_be_bytes();
        for (level, byte) in levels.iter().zip(shown) {
            let near = [*level, level.next_up()].map(|level| display_step(level.into()));
            assert!(near.contains(&byte), "pixel {pixel}: {levels:?}, {shown:?}");
        }
    }
}
