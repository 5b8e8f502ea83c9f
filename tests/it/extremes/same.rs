//! The renderer draws the same bits with and without an extreme.

use super::MATERIAL;
use crate::stability::life::{Bits, still_life, views};
use crate::support::prelude::*;

/// Asserts that two worlds have the same picture, bit by bit, and that a cuboid is visible.
fn assert_same(plain: &mut (World, Vec<View>), extreme: &mut (World, Vec<View>), what: &str) {
    assert_eq!(plain.1.len(), extreme.1.len());
    for (view, other) in plain.1.iter().zip(&extreme.1) {
        let expected = Bits::of(&draw(&mut plain.0, view, Keep::Levels));
        let ids = expected.triangles.iter();
        let seen = ids.filter(|id| **id != TriangleId::NONE);
        assert!(seen.count() > 100, "{what}");
        let found = Bits::of(&draw(&mut extreme.0, other, Keep::Levels));
        assert!(found == expected, "{what}, {other:?}");
    }
}

/// Cuboids with these sizes and rotations at the origin under a light of each kind, from every side and in [`views`].
fn cuboids(all: &[([f64; 3], [f64; 3])]) -> (World, Vec<View>) {
    let mut world = still_life(0);
    for (size, rotation) in all {
        spawn_cuboid(&mut world, (*size).into(), turned(*rotation), MATERIAL);
    }
    (world, views([128, 96]))
}

/// 1e9 degrees are 2777777 turns and 280 degrees. The float nearest to 1e100 is an integer with a remainder of 64
/// modulo 360.
#[test]
fn whole_turns_change_no_bit() {
    let size = [4.0, 3.0, 2.0];
    for (few, many) in [
        ([280.0, -280.0, 10.0], [1e9, -1e9, 1e9 + 90.0]),
        ([280.0, -280.0, 10.0], [2800.0, -3520.0, 370.0]),
        ([64.0, 3.0, 4.0], [1e100, 3.0, 4.0]),
    ] {
        let [mut few, mut many] = [few, many].map(|rotation| cuboids(&[(size, rotation)]));
        assert_same(&mut few, &mut many, "turns");
    }
}

#[test]
fn a_hidden_cuboid_or_a_speck_changes_no_bit() {
    let size = DVec3::new(4.0, 3.0, 2.0);
    let mut alone = cuboids(&[(size.to_array(), [0.0; 3])]);
    for share in [0.1, 0.999_999, 1.0] {
        let inner = ((size * share).to_array(), [0.0; 3]);
        let mut both = cuboids(&[(size.to_array(), [0.0; 3]), inner]);
        assert_same(&mut alone, &mut both, &format!("{share}"));
    }
    let mut beside = cuboids(&[(size.to_array(), [0.0; 3])]);
    let place = at(DVec3::new(0.3, 2.5, 0.1));
    spawn_cuboid(&mut beside.0, DVec3::splat(1e-100), place, MATERIAL);
    assert_same(&mut alone, &mut beside, "a speck");
}

#[test]
fn a_near_plane_in_the_plane_of_a_face_clips_nothing_of_it() {
    let frontal = |near: f64| {
        let (world, _) = cuboids(&[([4.0, 3.0, 2.0], [0.0; 3])]);
        let views = Projection::ALL.into_iter().flat_map(|projection| {
            let mut view = view([128, 96], DVec3::Z * 10.0, DVec3::ZERO, projection);
            view.camera.near = Some(near);
            ShadingMode::ALL.map(|mode| view.shaded(mode))
        });
        (world, views.collect())
    };
    for near in [9.0_f64.next_down(), 9.0] {
        assert_same(&mut frontal(1.0), &mut frontal(near), &format!("{near}"));
    }
}
