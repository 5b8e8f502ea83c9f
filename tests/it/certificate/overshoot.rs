//! Slivers: how far snapping takes pixels off other faces, and that f32 evaluates no pixel of a sliver.

use fearless_simd::f64x4;
use fearless_simd::prelude::*;
use glam::DMat3;
use proptest::prelude::*;
use shadetrade::shading::Surface;
use shadetrade::shading::face::{Face, OVERSHOOT, Plane, Rays};
use shadetrade::shading::gloss::Gloss;
use shadetrade::shading::gouraud::{Gouraud, Source};
use shadetrade::shading::moving::Extents;
use shadetrade::shading::phong::Phong;
use shadetrade::shading::simd::baseline;

use crate::support::prelude::*;

/// A number of any magnitude between two powers of ten.
fn sized(from: i32, to: i32) -> impl Strategy<Value = f64> {
    (f64::from(from)..f64::from(to)).prop_map(|exponent| 10_f64.powf(exponent))
}

/// The place of a cuboid and half its edges. Its upper face is at a depth `below` the eye, which looks along the face with a
/// slight tilt.
fn cuboid() -> impl Strategy<Value = (WorldTransform, DVec3)> {
    let half = [sized(-2, 6), sized(-2, 6), sized(-2, 6)].prop_map(DVec3::from_array);
    let place = [-2.0..2.0, -2.0..2.0_f64];
    (half, place, sized(-3, 2)).prop_map(|(half, [aside, ahead], below)| {
        let position = DVec3::new(half.x * aside, -half.y - below, half.z * ahead);
        let place = WorldTransform {
            position,
            axes: DMat3::IDENTITY,
        };
        (place, half)
    })
}

fn upper_face<'a>(cuboid: &WorldTransform, edges: DVec3, rays: &'a Rays) -> Face<'a> {
    Face::new(&Plane::new(2, cuboid, edges, rays), cuboid, edges, rays)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_pixel_beside_a_steady_face_overshoots_it_by_at_most_the_limit_of_light_culling(
        (cuboid, edges) in cuboid(),
        orthographic in any::<bool>(),
        tilt in -0.2..0.2_f64,
        coarser in 0.5..1.0_f64,
        along in -1.0..=1.0_f64,
        side in 0..4_usize,
        aside in [-1.0..=1.0, -1.0..=1.0_f64],
    ) {
        let (sine, cosine) = tilt.sin_cos();
        // Upright, or upside down.
        let [right, up] = [DVec3::X, DVec3::new(0.0, cosine, sine)].map(|axis| axis * along.signum());
        let edge = [[along, 1.0], [along, -1.0], [1.0, along], [-1.0, along]][side];
        let lens = |pitch: f64| Lens {
            axes: [right, up, DVec3::new(0.0, sine, -cosine)],
            projection: if orthographic { Projection::Orthographic } else { Projection::Perspective },
            near: 1e-3,
            pitch,
            ..Lens::default()
        };
        let pixel = |lens: &Lens, face: &Face| {
            let seen = lens.seen(face.from_eye(edge));
            (seen.z > lens.near).then(|| lens.pixel(lens.homogeneous(seen)))
        };
        // Pixels as coarse as a face allows that is just steady at the edge.
        let fine = lens(1e-4);
        let rays = Rays::new(&fine);
        let face = upper_face(&cuboid, edges, &rays);
        let Some([x, y]) = pixel(&fine, &face) else { return Ok(()) };
        let lens = lens(1e-4 * coarser * face.uvw.at(x, y).z / face.least_steady());
        let rays = Rays::new(&lens);
        let face = upper_face(&cuboid, edges, &rays);
        let Some([x, y]) = pixel(&lens, &face) else { return Ok(()) };
        // Snapping moves a vertex, and so an edge, by at most 1/512 pixel.
        let place = face.uvw.at(x + aside[0] / 512.0, y + aside[1] / 512.0);
        if face.is_steady(place.z) {
            let beyond = (place.x.abs().max(place.y.abs()) / place.z) - 1.0;
            prop_assert!(beyond <= 2.0 * OVERSHOOT + 1e-6, "{beyond}");
        }
    }

    #[test]
    fn f32_evaluates_no_square_that_meets_the_end_of_a_sliver_or_in_which_depth_more_than_doubles(
        (cuboid, edges) in cuboid(),
        orthographic in any::<bool>(),
        roll in -3.2..3.2_f64,
        tilt in sized(-9, 0),
        pitch in sized(-4, -1),
        middle in [-400.0..400.0, -400.0..400.0_f64],
        half in [0.5..16.0, 0.5..16.0_f64],
    ) {
        let axes = DMat3::from_rotation_x(-tilt) * DMat3::from_rotation_z(roll);
        let lens = Lens {
            axes: [axes.x_axis, axes.y_axis, -axes.z_axis],
            projection: if orthographic { Projection::Orthographic } else { Projection::Perspective },
            near: 1e-3,
            pitch,
            ..Lens::default()
        };
        let rays = Rays::new(&lens);
        let face = upper_face(&cuboid, edges, &rays);
        let simd = baseline();
        let lanes = |place: [f64; 2]| place.map(|number| f64x4::splat(simd, number));
        let extents = Extents { middle: lanes(middle), half: lanes(half) };
        let w = |x: f64, y: f64| face.plane.w.at(middle[0] + x * half[0], middle[1] + y * half[1]);
        let corners = [w(-1.0, -1.0), w(1.0, -1.0), w(-1.0, 1.0), w(1.0, 1.0)];
        let least = corners.into_iter().fold(f64::INFINITY, f64::min) * (1.0 + 1e-9);

        let corners = [DVec3::splat(100.0); 4];
        let mut gouraud = Gouraud::new(&face, Source::Corners(&corners), 0.5);
        gouraud.prepare(simd, &extents, true);
        let by_vertex = gouraud.in_f32 & 1 == 1;
        prop_assert!(!by_vertex || face.is_steady(least) && least >= w(0.0, 0.0) / 2.0);

        let (w, (place, _)) = (w(0.0, 0.0), face.uv_at(middle[0], middle[1]));
        if !face.is_steady(w) {
            prop_assert!(place.iter().all(|u| u.abs() <= 1.0), "a place on a sliver: {place:?}");
            if orthographic {
                let seen = face.uvw.at(middle[0], middle[1]) / w;
                prop_assert_eq!(place, [seen.x, seen.y].map(|u| u.clamp(-1.0, 1.0)));
            }
        }

        // Infinitely far in the direction in which the place mirrors the eye.
        let to_eye = if orthographic { -lens.axes[2] } else { -face.from_eye(place).normalize() };
        let light = PointLight {
            position: (2.0 * to_eye.y * DVec3::Y - to_eye) * 1e20,
            diffuse: DVec3::ZERO,
            specular: DVec3::splat(100.0),
        };
        let (material, illumination) = (white(1e3), Illumination { points: vec![light], ..Illumination::default() });
        let surface = Surface::new(&material, &illumination, cuboid.position);
        let normals = face.interpolate(&[DVec3::Y; 4], 0);
        let gloss = Gloss::new(&surface, 0.5);
        let mut lights = Vec::new();
        let mut phong = Phong::new(&face, normals, surface, &gloss, &mut lights, 0.5);
        let levels = phong.levels_f64(middle[0], middle[1]);
        prop_assert!(levels.abs_diff_eq(DVec3::splat(100.0), 1e-6), "{levels} at {place:?}");
        phong.prepare(simd, &extents, true);
        prop_assert!(phong.in_f32 & 1 == 0 || face.is_steady(least));
    }
}

#[test]
fn beside_a_sliver_a_pixel_shows_its_far_end_if_a_snap_reaches_it() {
    // The eye is almost in the plane of a face that lies 10 to 30 units ahead, 2 units wide. The far end, where u = -1, is
    // 1/1024 pixel below the horizon.
    let lens = Lens {
        axes: [DVec3::X, DVec3::Y, DVec3::NEG_Z],
        pitch: 1e-3,
        ..Lens::default()
    };
    let rays = Rays::new(&lens);
    let right = 50.0 / 3.0;
    for (aside, [x, y], expected) in [
        // On the face, at half its depth.
        (0.0, [right, 2.0], [0.5, 0.25]),
        // At twice the depth of the far end, and above the horizon.
        (0.0, [right, 0.5], [-1.0, 0.5]),
        (0.0, [right, -1.0], [-1.0, 0.5]),
        (1.5, [0.0, -1.0], [-1.0, -1.0]),
        // Too far above the horizon: infinitely far away.
        (0.0, [right, -1024.0], [-1.0, 1.0]),
        (0.0, [0.0, -1024.0], [-1.0, 0.0]),
        // Before the near end.
        (0.0, [right, 4.0], [1.0, 0.125]),
    ] {
        let place = WorldTransform {
            position: DVec3::new(aside, -1.0 - 30e-3 / 1024.0, -20.0),
            axes: DMat3::IDENTITY,
        };
        let face = upper_face(&place, DVec3::new(1.0, 1.0, 10.0), &rays);
        let (found, _) = face.uv_at(x, y / 1024.0);
        let error = [0, 1].map(|axis| (found[axis] - expected[axis]).abs());
        assert!(error[0].max(error[1]) < 1e-9, "{found:?}, {expected:?}");
    }
}
