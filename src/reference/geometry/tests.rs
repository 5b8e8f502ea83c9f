//! The bounds of a cuboid against a search of the whole picture, faces nearly parallel to the picture, points beside a face,
//! and the weights of the shortcut.

use glam::DVec3;

use super::*;
use crate::components::{Camera, Mesh, View};
use crate::reference::Interval;

const SIZE: [usize; 2] = [24, 18];

/// A stream of numbers in -1..1: the fractional parts of multiples of the golden ratio.
struct Numbers(f64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = (self.0 + 0.618_033_988_749_894_9).fract();
        2.0 * self.0 - 1.0
    }

    fn vector(&mut self, size: f64) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next()) * size
    }
}

fn view(position: DVec3, target: DVec3, projection: Projection) -> View {
    View {
        size: SIZE,
        camera: Camera {
            position,
            target,
            up: DVec3::new(0.1, 1.0, 0.2),
            fov: 50.0,
            height: 3.0,
            near: Some(0.3),
        },
        projection,
        background: DVec3::ZERO,
        turned: 0,
        shading: None,
        segments: None,
        tolerance: 0.0,
    }
}

#[test]
fn the_bounds_of_a_cuboid_hold_every_pixel_that_may_hit_it_and_few_others() {
    let mut numbers = Numbers(0.5);
    let (mut met, mut within, mut without) = (0, 0, 0);
    for case in 0..400 {
        let projection = Projection::ALL[case % 2];
        let view = view(numbers.vector(3.0), numbers.vector(0.5), projection);
        let transform = Transform {
            position: numbers.vector(2.0),
            rotation: numbers.vector(360.0),
        };
        let mesh = Mesh::cuboid(numbers.vector(1.5).abs());
        let sight = Sight::<Interval>::new(&view, None);
        let [columns, rows] = sight.bounds(&transform, &mesh);
        let everywhere = SIZE.map(|side| 0..side);
        let solid = CuboidGeometry::new(&sight, &transform, &mesh, everywhere);
        for (x, y) in (0..SIZE[0]).flat_map(|x| (0..SIZE[1]).map(move |y| (x, y))) {
            let is_within = columns.contains(&x) && rows.contains(&y);
            let is_met = solid.meet(&solid.line(sight.centre([x, y]))).is_some();
            assert!(is_within || !is_met, "case {case} pixel {x}, {y}");
            met += u32::from(is_met);
            within += u32::from(is_within);
            without += u32::from(!is_within);
        }
    }
    assert!(
        met > 5_000 && without > 50_000,
        "{met} met, {without} without"
    );
    assert!(within < 4 * met, "{within} within, {met} met");
}

#[test]
fn on_an_edge_a_line_may_show_a_point_of_each_face() {
    for projection in Projection::ALL {
        // On an edge and a corner of faces that are visible; on an edge of the outline.
        for target in [[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.0, -1.0]] {
            let eye = DVec3::new(4.0, 2.0, 5.0);
            let view = View {
                size: [3, 3],
                ..view(eye, target.into(), projection)
            };
            let sight = Sight::<Interval>::new(&view, None);
            let mesh = Mesh::cuboid(DVec3::splat(2.0));
            let solid = CuboidGeometry::new(&sight, &Transform::default(), &mesh, [0..3, 0..3]);
            let meeting = solid
                .meet(&solid.line(sight.centre([1, 1])))
                .expect("it may be hit");
            assert!(!meeting.is_certain, "{projection:?}, {target:?}");
            for (face, place) in &meeting.points {
                let (axis, outwards) = across(*face);
                let ends = [place.point.0[axis], solid.end(axis, outwards)].map(Real::endpoints);
                assert_eq!(ends[0], ends[1], "the point is on the plane of its face");
            }
            let mut faces: Vec<_> = meeting.points.iter().map(|(face, _)| *face).collect();
            faces.dedup();
            let visible = (0..3)
                .filter(|axis| target[*axis] == 1.0)
                .map(|axis| 2 * axis);
            assert!(faces.into_iter().eq(visible), "{projection:?}, {target:?}");
        }
    }
}

#[test]
fn a_face_parallel_to_the_picture_up_to_rounding_is_certainly_hit() {
    for projection in Projection::ALL {
        for degrees in [0.0, 10.0, 30.0, 45.0, 77.0] {
            // The camera looks straight at a rotated face, so the face is parallel to the picture up to rounding.
            let transform = Transform {
                position: DVec3::ZERO,
                rotation: DVec3::Y * degrees,
            };
            let (sin, cos) = f64::to_radians(degrees).sin_cos();
            let view = view(DVec3::new(sin, 0.0, cos) * 6.0, DVec3::ZERO, projection);
            let mesh = Mesh::cuboid(DVec3::splat(2.0));
            let sight = Sight::<Interval>::new(&view, None);
            let solid =
                CuboidGeometry::new(&sight, &transform, &mesh, sight.bounds(&transform, &mesh));
            let middle = SIZE.map(|side| side / 2);
            let meeting = solid.meet(&solid.line(sight.centre(middle)));
            assert!(
                meeting.is_some_and(|meeting| meeting.is_certain),
                "{projection:?} {degrees}"
            );
        }
    }
}

#[test]
fn beside_a_face_a_line_shows_its_point_of_the_plane_or_beyond_the_horizon_any_point() {
    let (eye, upper) = (DVec3::new(0.2, 6.0, 1.0), 2);
    let mesh = Mesh::cuboid(DVec3::splat(2.0));
    for (target, points) in [
        ([0.4, 1.0, 0.3], 2),
        ([0.3, 1.0, 0.4], 2),
        ([5.0, 9.0, 2.0], 1),
    ] {
        let view = View {
            size: [3, 3],
            ..view(eye, target.into(), Projection::Perspective)
        };
        let sight = Sight::<Interval>::new(&view, None);
        let solid = CuboidGeometry::new(&sight, &Transform::default(), &mesh, [0..3, 0..3]);
        let beside = solid.beside(upper, &solid.line(sight.centre([1, 1])));
        assert_eq!(beside.len(), points, "{target:?}");
        for place in beside {
            let [x, _, z] = place.share.0.map(Real::endpoints);
            if points == 1 {
                assert!([x, z].iter().all(|it| it[0] <= -0.5 && it[1] >= 0.5));
            } else {
                assert!((x[0] - target[0] / 2.0).abs() < 1e-12, "{x:?}");
                assert_eq!(place.is_on_first, Some(target[2] > target[0]));
            }
        }
    }
}

#[test]
fn the_shortcut_weighs_by_depth_where_no_corner_is_nearer_than_the_near_plane() {
    let view = view(
        DVec3::new(2.0, 3.0, 5.0),
        DVec3::ZERO,
        Projection::Perspective,
    );
    let sight = Sight::<Interval>::new(&view, None);
    let mesh = Mesh::cuboid(DVec3::splat(2.0));
    let mut solid = CuboidGeometry::new(&sight, &Transform::default(), &mesh, [0..3, 0..3]);
    let (corners, weights) = ([1, 3, 7], [0.2, 0.3, 0.5].map(Interval::of));
    let depths = corners.map(|corner| solid.corner_depth(corner).endpoints()[0]);
    let nearest = depths.into_iter().fold(f64::INFINITY, f64::min);
    let mut weighed = |near: f64| {
        solid.near = Interval::of(near);
        let weighed = solid.shortcut_weights(corners, weights);
        weighed.map(Real::endpoints)
    };
    assert_eq!(weighed(nearest + 0.5), weights.map(Real::endpoints));
    assert_eq!(weighed(nearest - 0.5), weighed(0.0));
    assert_ne!(weighed(nearest - 0.5), weights.map(Real::endpoints));
}
