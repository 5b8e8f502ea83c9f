//! Flat shading: one colour a face, on scenes whose levels are known on paper.
//!
//! ```text
//! worked face, m = 4      prism of n faces, from above
//!  +--+--+--+--+              ____
//!  |. |. |. |. |            /      \        the normals of the faces are 360 / n degrees apart
//!  +--+--+--+--+           |        |  -->  a light infinitely far
//!  |. |. |. |. |            \ ____ /
//! ```

use std::collections::HashSet;

use shadetrade::components::LightKind::Diffuse;

use crate::prove::proof;
use crate::support::prelude::*;

/// Dull and white.
const DULL: Material = grey([0.0, 1.0, 0.0], 1.0);

/// 255 cos of the light's incidence at (x, y) of the face z = 0 under a light 1 above the origin.
fn worked(x: f64, y: f64) -> f64 {
    255.0 / (1.0 + x * x + y * y).sqrt()
}

/// A picture of flat shading from z = 5, so many units high.
fn from_above(size: [usize; 2], height: f64) -> View {
    let eye = DVec3::Z * 5.0;
    let mut view = view(size, eye, DVec3::ZERO, Projection::Orthographic);
    view.camera.height = height;
    view.shaded(ShadingMode::Flat)
}

/// The face from -1 to 1, cut into `m` x `m` cuboids, from above.
fn worked_face(m: usize) -> (World, View) {
    let mut world = empty();
    let side = 2.0 / m as f64;
    for cell in 0..m * m {
        let [x, y] = [cell % m, cell / m].map(|it| (it as f64 + 0.5) * side - 1.0);
        let size = DVec3::new(side, side, 0.1);
        spawn_cuboid(&mut world, size, at(DVec3::new(x, y, -0.05)), DULL);
    }
    shine(&mut world, Diffuse, 255.0, DVec3::Z);
    overwrite(&mut world, &NormalMode::Face);
    (world, from_above([512; 2], 2.0))
}

#[test]
fn the_worked_face_errs_with_the_size_of_its_cells() {
    for m in [8, 64] {
        let (mut world, view) = worked_face(m);
        let frame = draw(&mut world, &view, Keep::Levels);
        let mut largest = 0.0_f64;
        for (pixel, levels) in frame.levels().iter().enumerate() {
            let [x, y] = [pixel % 512, 511 - pixel / 512].map(|it| (it as f64 + 0.5) / 256.0 - 1.0);
            let middle =
                |it: f64| ((it + 1.0) * m as f64 / 2.0).floor().mul_add(2.0, 1.0) / m as f64 - 1.0;
            let expected = worked(middle(x), middle(y));
            let [level, ..] = levels.map(f64::from);
            let is_known = (level - expected).abs() < 1e-4;
            assert!(is_known, "{level}, not {expected}, at {x}, {y}");
            largest = largest.max((level - worked(x, y)).abs());
        }
        // One colour a cell: the slope of the worked face is at most 255 2 / sqrt 27, and half a diagonal is sqrt 2 / m.
        let known = 255.0 * (8.0_f64 / 27.0).sqrt() / m as f64;
        let is_known = (0.85 * known..known).contains(&largest);
        assert!(is_known, "{largest}, not {known}, of {m}");
    }
}

#[test]
fn a_prism_errs_by_801_levels_over_the_number_of_its_faces() {
    for n in [16, 64] {
        let mut world = empty();
        let turn = 360.0 / f64::from(n);
        // Slabs through the axis: each has two faces of the prism.
        let size = DVec3::new(2.0 * (turn / 2.0).to_radians().tan(), 1.0, 2.0);
        for slab in 0..n / 2 {
            let transform = turned(DVec3::Y * turn * f64::from(slab));
            spawn_cuboid(&mut world, size, transform, DULL);
        }
        shine(&mut world, Diffuse, 255.0, DVec3::X * 1e15);
        overwrite(&mut world, &NormalMode::Face);
        let view = from_above([4001, 3], 2.0 * 3.0 / 4001.0);
        let frame = draw(&mut world, &view, Keep::Levels);
        let mut largest = 0.0_f64;
        for (column, levels) in frame.levels()[4001..8002].iter().enumerate() {
            let x = (column as f64 + 0.5) / 4001.0 * 2.0 - 1.0;
            // The direction of the place from the axis. Its face is 1 away from that.
            let half = (turn / 2.0).to_radians();
            let middle = turn * ((x * half.cos()).asin().to_degrees() / turn).round();
            let along = (x - middle.to_radians().sin()) / middle.to_radians().cos();
            let angle = middle + along.atan().to_degrees();
            let round = 255.0 * angle.to_radians().sin().max(0.0);
            largest = largest.max((f64::from(levels[0]) - round).abs());
        }
        let known = 801.0 / f64::from(n);
        let is_known = (largest - known).abs() < 0.03 * known;
        assert!(is_known, "{largest}, not {known}");
    }
}

#[test]
fn a_face_is_evaluated_once_and_neither_tolerance_nor_segments_change_it() {
    for normals in NormalMode::ALL {
        let mut world = empty();
        let (size, transform) = (DVec3::new(1.0, 2.0, 3.0), turned([20.0, 30.0, 0.0]));
        spawn_cuboid(&mut world, size, transform, white(20.0));
        shine(&mut world, Diffuse, 200.0, DVec3::new(3.0, 2.0, 5.0));
        overwrite(&mut world, &normals);
        let eye = DVec3::Z * 9.0;
        let view = view([96, 72], eye, DVec3::ZERO, Projection::Perspective);
        let view = view.shaded(ShadingMode::Flat);
        let frame = draw(&mut world, &view, Keep::Levels);
        assert_eq!(frame.counts().model_evaluations, 3);
        let colors = frame.levels().iter().map(|it| it.map(f32::to_bits));
        let colors: HashSet<_> = colors.collect();
        assert_eq!(colors.len(), 4, "three faces and the background");
        let other = View {
            segments: Segments::new(7),
            ..view.with_tolerance(4.0)
        };
        assert!(draw(&mut world, &other, Keep::Levels).levels() == frame.levels());
        assert!(truth(&world, &other).levels == truth(&world, &view).levels);
        let proof = proof(&mut world, &view);
        assert_eq!(proof.proven, 96 * 72, "{:?}", proof.examples);
    }
}
