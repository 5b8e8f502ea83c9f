//! Records and worlds have the same content.

use proptest::prelude::*;

use super::random;
use crate::support::cases::config;
use crate::support::prelude::*;

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn a_record_equals_that_of_the_world_it_is_spawned_as(record in random::record()) {
        let mut world = record.spawn();
        prop_assert_eq!(&SceneRecord::of(&world), &record);
        // Whether cuboids keep turning is not part of the record.
        viewer_mut(&mut world).turns = true;
        prop_assert_eq!(&SceneRecord::of(&world), &record);
    }

    #[test]
    fn a_record_survives_json(record in random::record()) {
        let text = serde_json::to_string(&record).unwrap();
        prop_assert_eq!(serde_json::from_str::<SceneRecord>(&text).unwrap(), record);
    }

    /// Worlds with removed entities: the order of the file has gaps.
    #[test]
    fn a_world_with_gaps_becomes_a_record_without_them(record in random::record(), gone in any::<prop::sample::Index>()) {
        let mut world = record.spawn();
        let mut expected = record.clone();
        if record.light.is_empty() {
            return Ok(());
        }
        let gone = gone.index(record.light.len());
        world.despawn(ordered::<Light>(&world)[gone]).unwrap();
        expected.light.remove(gone);
        prop_assert_eq!(SceneRecord::of(&world), expected);
    }
}

#[test]
fn a_snapshot_is_independent_and_keeps_the_assignment_s_shortcut() {
    let mut scene = built_in();
    overwrite(&mut scene.world, &ShadingMode::UnitVectors);
    let copy = scene.snapshot();
    let before = SceneRecord::of(&scene.world);
    assert_eq!(copy.name, scene.name);
    assert_eq!(SceneRecord::of(&copy.world), before);
    overwrite(&mut scene.world, &ShadingMode::Phong);
    assert_eq!(SceneRecord::of(&copy.world), before);
}
