//! Pixels that snapping adds beyond an edge: their distance from a face that is not a sliver.

use glam::{DMat3, DVec3};
use proptest::prelude::*;
use shadetrade::components::{Lens, Projection};
use shadetrade::shading::face::{Face, OVERSHOOT, Rays, Solid};

/// A number of any magnitude between two powers of ten.
fn sized(from: i32, to: i32) -> impl Strategy<Value = f64> {
    (f64::from(from)..f64::from(to)).prop_map(|exponent| 10_f64.powf(exponent))
}

/// A cuboid with its upper face at a depth `below` the eye, which looks along the face with a slight tilt.
fn solid() -> impl Strategy<Value = Solid> {
    let half = [sized(-2, 6), sized(-2, 6), sized(-2, 6)].prop_map(DVec3::from_array);
    let place = [-2.0..2.0, -2.0..2.0_f64];
    (half, place, sized(-3, 2)).prop_map(|(half, [aside, ahead], below)| Solid {
        centre: DVec3::new(half.x * aside, -half.y - below, half.z * ahead),
        axes: DMat3::IDENTITY,
        half,
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_pixel_beside_a_steady_face_overshoots_it_by_at_most_the_limit_of_light_culling(
        solid in solid(),
        orthographic in any::<bool>(),
        tilt in -0.2..0.2_f64,
        coarser in 0.5..1.0_f64,
        along in -1.0..=1.0_f64,
        side in 0..4_usize,
        aside in [-1.0..=1.0, -1.0..=1.0_f64],
    ) {
        let (sine, cosine) = tilt.sin_cos();
        let edge = [[along, 1.0], [along, -1.0], [1.0, along], [-1.0, along]][side];
        let lens = |pitch: f64| Lens {
            axes: [DVec3::X, DVec3::new(0.0, cosine, sine), DVec3::new(0.0, sine, -cosine)],
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
        let face = Face::new(2, &solid, &rays);
        let Some([x, y]) = pixel(&fine, &face) else { return Ok(()) };
        let lens = lens(1e-4 * coarser * face.place.at(x, y).z / face.least_steady());
        let rays = Rays::new(&lens);
        let face = Face::new(2, &solid, &rays);
        let Some([x, y]) = pixel(&lens, &face) else { return Ok(()) };
        // Snapping moves a vertex, and so an edge, by at most 1/512 pixel.
        let place = face.place.at(x + aside[0] / 512.0, y + aside[1] / 512.0);
        if face.is_steady(place.z) {
            let beyond = (place.x.abs().max(place.y.abs()) / place.z) - 1.0;
            prop_assert!(beyond <= 2.0 * OVERSHOOT + 1e-6, "{beyond}");
        }
    }
}
