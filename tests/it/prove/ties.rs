//! Tied gates: a picture is proven with each of them open or closed.

use glam::DVec3;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode, Transform};

use super::proof;
use crate::support::random::Random;
use crate::support::scene::{empty, shine, spawn_cuboid, view};

const SHINY: Material = Material {
    ambient: DVec3::ZERO,
    diffuse: DVec3::ZERO,
    specular: DVec3::ONE,
    shininess: 1.0,
};

/// The corners of the cube's face z = 1 have n = (±1, ±1, 1) / sqrt(3) and, for a light 2 above its middle, l = (∓1,
/// ∓1, 2) / sqrt(6), so n.l is 0 at all four on paper. The light is reflected to r = -l, which meets the eye from below
/// if the gate is open.
#[test]
fn corners_of_one_face_may_decide_a_tie_independently() {
    let mut random = Random(3);
    let mut covered = 0;
    for _ in 0..40 {
        let mut angle = || random.within(0.0, 360.0);
        let transform = Transform {
            position: DVec3::ZERO,
            rotation: DVec3::new(angle(), angle(), angle()),
        };
        let axes = transform.axes();
        let mut world = empty();
        spawn_cuboid(&mut world, DVec3::splat(2.0), transform, SHINY);
        shine(
            &mut world,
            LightKind::Specular,
            200.0,
            axes * (3.0 * DVec3::Z),
        );
        let mut view = view(
            [24, 18],
            axes * DVec3::new(6.0, 1.0, -4.0),
            DVec3::ZERO,
            Projection::Perspective,
        );
        view.shading = Some(ShadingMode::Gouraud);
        let proof = proof(&mut world, &view);
        assert_eq!(
            [proof.refuted, proof.undecided],
            [0, 0],
            "{:?}",
            proof.examples
        );
        covered += proof.covered;
    }
    assert!(covered > 1000, "{covered} pixels were covered");
}
