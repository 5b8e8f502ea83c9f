//! Single pixels aimed at edges: what is hidden there, against a dense bundle of lines of sight in f64.

use glam::DVec3;
use hecs::World;

use super::*;
use crate::components::{
    Camera, FileOrder, Material, Mesh, NormalMode, Projection, Segments, ShadingMode, Transform,
    View,
};
use crate::reference::edge::EDGE;
use crate::reference::interval::Interval;

/// The lines of a bundle.
const LINES: usize = 1000;

/// A stream of numbers (Knuth's MMIX).
struct Numbers(u64);

impl Numbers {
    /// In -1..1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / f64::from(1 << 30) - 1.0
    }

    fn vector(&mut self, size: f64) -> DVec3 {
        DVec3::ZERO.map(|_| size * self.next())
    }
}

fn spawn(world: &mut World, transform: Transform, size: DVec3) {
    let order = FileOrder(world.len());
    let material = Material {
        ambient: DVec3::ONE,
        diffuse: DVec3::ZERO,
        specular: DVec3::ZERO,
        shininess: 1.0,
    };
    world.spawn((
        order,
        transform,
        Mesh::cuboid(size),
        material,
        ShadingMode::Phong,
        NormalMode::Corner,
        Segments::default(),
    ));
}

/// Eight boxes, and a point on an edge of the first one. They meet at its corner, or lie anywhere.
fn boxes(numbers: &mut Numbers, are_joined: bool) -> (World, DVec3) {
    let mut world = World::new();
    let mut rotation = numbers.vector(180.0);
    let mut axes = turned(rotation).axes();
    let corner = numbers.vector(0.3);
    // On an edge between its outer faces and those that may touch others, often at the end of the edge.
    let mut on_edge = corner.min(numbers.vector(1.5)).max(-DVec3::ONE);
    let outer = (3.0 * numbers.next().abs()) as usize;
    (on_edge[outer], on_edge[(outer + 1) % 3]) = (-1.0, corner[(outer + 1) % 3]);
    let target = axes * on_edge;
    for signs in Mesh::cuboid(DVec3::splat(2.0)).corners {
        // Between the common corner and a corner of the whole.
        let (mut size, mut middle) = ((signs - corner).abs(), (signs + corner) / 2.0);
        if !are_joined && signs != -DVec3::ONE {
            (size, middle) = (numbers.vector(1.0).abs(), numbers.vector(0.5));
            rotation = numbers.vector(180.0);
            axes = turned(rotation).axes();
        }
        let position = axes * middle;
        spawn(&mut world, Transform { position, rotation }, size);
    }
    (world, target)
}

fn turned(rotation: DVec3) -> Transform {
    Transform {
        rotation,
        ..Transform::default()
    }
}

/// A picture of one pixel, of this size in world units, whose centre shows `target`.
fn pixel(numbers: &mut Numbers, target: DVec3, size: f64) -> View {
    let eye = numbers.vector(1.0).normalize() * (3.0 + numbers.next());
    let camera = Camera {
        position: eye,
        target,
        up: numbers.vector(1.0),
        fov: 2.0 * (size / 2.0 / eye.distance(target)).atan().to_degrees(),
        height: size,
        near: None,
    };
    View {
        size: [1, 1],
        camera,
        projection: Projection::ALL[usize::from(numbers.next() > 0.0)],
        background: DVec3::ZERO,
        turned: 0,
        shading: None,
        segments: None,
        tolerance: 0.0,
    }
}

/// The surfaces that the pixel of a view may show, and for each whether a bundle of lines around its centre shows it.
fn seen(world: &World, view: &View) -> Vec<(Seen<Interval>, bool)> {
    let seen = Reference::<Interval>::new(world, view).at([0, 0]);
    let floats = Reference::<f64>::new(world, view);
    let (cuboids, mut met) = (floats.in_row(0), Vec::new());
    let mut shown = Vec::new();
    for line in (0..LINES).map(|line| line as f64 + 0.5) {
        // Evenly distributed in a disc (Vogel 1979).
        let (sin, cos) = (2.399_963_229_728_653 * line).sin_cos();
        let radius = EDGE * (line / LINES as f64).sqrt();
        let place = Place {
            offset: [radius * cos, radius * sin],
            margin: 0.0,
        };
        floats.meet_at(place, cuboids.iter().copied(), &mut met);
        let face = |met: &Met<f64>| 6 * met.cuboid.number + met.meeting.points[0].0;
        shown.push(met.first().map(face));
    }
    let is_shown = |seen: Seen<Interval>| (seen, shown.contains(&seen.face()));
    seen.into_iter().map(is_shown).collect()
}

#[test]
fn what_is_hidden_beside_the_edges_is_hidden_all_around_the_centre() {
    let mut numbers = Numbers(7);
    // Boxes that lie anywhere hide each other at few edges.
    for (are_joined, least_hidden) in [(true, 900), (false, 50)] {
        let (mut hidden, mut visible, mut unseen) = (0, 0, 0);
        for case in 0..500 {
            let (world, edge) = boxes(&mut numbers, are_joined);
            let size = 10_f64.powf(-2.0 + numbers.next());
            let target = edge + numbers.vector(0.7 * EDGE * size);
            let view = pixel(&mut numbers, target, size);
            for (seen, is_shown) in seen(&world, &view) {
                let what = format!("joined: {are_joined}, case {case}: {:?}", seen.face());
                assert!(!(seen.is_hidden && is_shown), "{what}");
                hidden += u32::from(seen.is_hidden);
                visible += u32::from(is_shown);
                unseen += u32::from(!seen.is_hidden && !is_shown);
            }
        }
        println!("joined: {are_joined}: {hidden} hidden, {visible} visible, {unseen} in doubt");
        assert!(
            hidden > least_hidden && visible > 1400,
            "{hidden} hidden, {visible} visible"
        );
        assert!(50 * unseen < visible, "{unseen} are in doubt");
    }
}

/// On edges and corners of visible faces the background is hidden, on the outline it is not.
#[test]
fn on_an_inner_edge_of_a_cuboid_the_background_is_hidden() {
    let mut world = World::new();
    spawn(&mut world, Transform::default(), DVec3::splat(2.0));
    for projection in Projection::ALL {
        for (target, is_hidden) in [
            ([1.0, 0.0, 1.0], true),
            ([1.0, 1.0, 1.0], true),
            ([1.0, 0.0, -1.0], false),
        ] {
            let mut view = pixel(&mut Numbers(1), target.into(), 0.1);
            (view.projection, view.camera.position) = (projection, DVec3::new(4.0, 2.0, 5.0));
            for (seen, is_shown) in seen(&world, &view) {
                assert_eq!(seen.is_hidden, !is_shown, "{projection:?}, {target:?}");
                assert!(seen.face().is_some() || seen.is_hidden == is_hidden);
            }
        }
    }
}
