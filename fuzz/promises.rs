//! What every picture keeps to, whatever its scene.

use fearless_simd::Level;
use glam::DVec3;
use hecs::World;
use shadetrade::components::{Light, Material, Mesh, ShadingMode, Transform, View, length};
use shadetrade::frame::{Frame, Keep, NO_TRIANGLE, Workers, display_step};
use shadetrade::reference::{at_pixel, picture};
use shadetrade::systems;

/// What the contract calls exact: the largest error at tolerance 0, in levels.
const EXACT: f64 = 0.05;

/// A cuboid longer than so many times its width asks more of f64 than it has: its colours are defined, and no more.
const LONGEST: f64 = 1e7;

/// Gouraud interpolates between what the corners show; more levels than this there leave f64 none of those in between.
const BRIGHTEST: f64 = 1e9;

/// Seen from further than this, in multiples of its size, a cuboid's places differ by less than what f64 tells apart.
const FARTHEST: f64 = 1e12;

/// A light this close to the point seen, in multiples of the cuboid's size, may as well stand at it, where it does nothing.
const AT_THE_POINT: f64 = 1e-6;

/// The reference is asked about cuboids that are no longer than this, seen from no further, in multiples of their size.
const PLAIN: f64 = 1e4;

fn frame(world: &mut World, view: &View, keep: Keep) -> Frame {
    let mut frame = Frame::new(keep, Workers::alone(Level::new()));
    systems::draw(world, view, &mut frame).expect("a small picture fits");
    frame
}

/// Draws `view` in every mode, at its tolerance and exactly.
///
/// # Panics
/// When a picture breaks a promise.
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

/// No level is NaN, what shows nothing is background, and the counts and ids are those of the scene.
fn defined(world: &mut World, view: &View, frame: &Frame) {
    let cuboids = world.query_mut::<&Mesh>().into_iter().count() as u32;
    let background = view.background.as_vec3().to_array();
    let mut covered = 0;
    for (levels, &id) in frame.levels().iter().zip(frame.triangles()) {
        assert!(levels.iter().all(|level| !level.is_nan()), "{levels:?}");
        if id == NO_TRIANGLE {
            assert_eq!(*levels, background, "nothing is drawn there");
        } else {
            assert!(id < 12 * cuboids, "there is no triangle {id}");
            covered += 1;
        }
    }
    // With depths, a pixel may be covered more than once.
    assert!(frame.counts().covered_pixels >= covered);
}

/// The tolerance moves no edge, and no level further than it says.
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

/// How many times longer than wide a cuboid is at most.
fn longest(world: &mut World) -> f64 {
    let ratio = |mesh: &Mesh| mesh.corners[7].max_element() / mesh.corners[7].min_element();
    world
        .query_mut::<&Mesh>()
        .into_iter()
        .map(ratio)
        .fold(1.0, f64::max)
}

/// The most levels that all lights together can make of a material.
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

/// How far from the eye a cuboid stands at most, in multiples of its size.
fn farthest(world: &mut World, view: &View) -> f64 {
    let far = |(mesh, transform): (&Mesh, &Transform)| {
        length(transform.position - view.viewpoint.position) / length(mesh.corners[7])
    };
    let cuboids = world.query_mut::<(&Mesh, &Transform)>().into_iter();
    cuboids.map(far).fold(0.0, f64::max)
}

/// Where both see one triangle and no light grazes it, the exact picture is the reference's.
fn true_to_the_reference(world: &World, view: &View, exact: &Frame) {
    let rows = 0..view.size[1];
    let truth = picture(world, view, rows, &|| false, &|_| ()).expect("nobody cancels");
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
                "{error} levels at pixel {pixel}, {:?}: {drawn:?}, in truth {truth_levels:?}",
                view.shading
            );
        }
    }
}

/// Whether what is seen at this pixel may fall either way: a light grazes it, or stands at the very point.
fn is_tie(world: &World, view: &View, pixel: usize) -> bool {
    let [x, y] = [pixel % view.size[0], pixel / view.size[0]];
    let Some(seen) = at_pixel(world, view, x, y) else {
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

/// The bytes for a window are the display step of the levels, of which a certified one may lose its last bit.
fn displayed(levels: &Frame, bytes: &Frame) {
    for (pixel, (levels, shown)) in levels.levels().iter().zip(bytes.pixels()).enumerate() {
        let [_, shown @ ..] = shown.to_be_bytes();
        for (level, byte) in levels.iter().zip(shown) {
            let near = [*level, level.next_up()].map(|level| display_step(level.into()));
            assert!(near.contains(&byte), "pixel {pixel}: {levels:?}, {shown:?}");
        }
    }
}
