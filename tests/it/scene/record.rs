//! Records and worlds have the same content.

use std::fmt::{Debug, Write};

use hecs::World;
use proptest::prelude::*;
use shadetrade::components::{
    ActiveCamera, Background, Camera, FileOrder, Inspector, Light, Magnifier, Material, Mesh, Name,
    Orbit, Probed, Projection, ShadingMode, Show, Side, Spin, Tolerance, Transform, ordered,
    viewer,
};
use shadetrade::scene::{BUILT_IN, Scene, SceneRecord};

use super::random;

/// Every component of the world that comes from a scene, with entities in file order. Debug prints different floats
/// differently, also 0 and -0.
fn said(world: &World) -> String {
    let mut text = String::new();
    let kinds = [
        ordered::<Mesh>(world),
        ordered::<Light>(world),
        ordered::<Camera>(world),
        vec![viewer(world)],
    ];
    for entity in kinds.into_iter().flatten() {
        let it = world.entity(entity).expect("an entity of the world");
        let mut say = |component: Option<&dyn Debug>| writeln!(text, "{component:?}").unwrap();
        macro_rules! say {
            ($($component:ty),*) => {$(
                say(it.get::<&$component>().as_deref().map(|component| component as _));
            )*};
        }
        say!(
            Name,
            FileOrder,
            Transform,
            Mesh,
            Material,
            ShadingMode,
            Light,
            Camera,
            Orbit
        );
        say!(
            Projection, Background, Tolerance, Spin, Show, Magnifier, Probed, Inspector
        );
    }
    let ActiveCamera(camera) = *world.get::<&ActiveCamera>(viewer(world)).unwrap();
    let place = ordered::<Camera>(world).iter().position(|it| *it == camera);
    text + &format!("{place:?}")
}

proptest! {
    #[test]
    fn a_record_equals_that_of_the_world_it_is_spawned_as(record in random::record()) {
        let world = record.spawn();
        prop_assert_eq!(&SceneRecord::of(&world), &record);
        prop_assert_eq!(said(&SceneRecord::of(&world).spawn()), said(&world));
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
fn the_built_in_scenes_become_their_records() {
    for (name, _) in BUILT_IN {
        let scene = Scene::load(Some(name)).unwrap_or_else(|error| panic!("{error}"));
        let again = SceneRecord::of(&scene.world).spawn();
        assert_eq!(said(&again), said(&scene.world), "{name}");
    }
}

#[test]
fn whether_cuboids_turn_is_not_part_of_the_record() {
    let mut scene = Scene::load(None).unwrap_or_else(|error| panic!("{error}"));
    let before = SceneRecord::of(&scene.world);
    for spin in scene.world.query_mut::<&mut Spin>() {
        spin.on = true;
    }
    assert_eq!(SceneRecord::of(&scene.world), before);
}

#[test]
fn a_side_is_its_text() {
    for (text, side) in [
        ("picture", Side::Picture),
        ("reference", Side::Reference),
        (
            "gouraud-0.5",
            Side::Method {
                mode: ShadingMode::Gouraud,
                tolerance: 0.5,
            },
        ),
        (
            "phong-0",
            Side::Method {
                mode: ShadingMode::Phong,
                tolerance: 0.0,
            },
        ),
        (
            "phong-unit-vectors",
            Side::Method {
                mode: ShadingMode::UnitVectors,
                tolerance: 0.0,
            },
        ),
    ] {
        assert_eq!(text.parse(), Ok(side));
        assert_eq!(side.to_string(), text);
    }
    for wrong in [
        "",
        "phong",
        "phong-",
        "phong--1",
        "phong-256",
        "phong-nan",
        "Phong-1",
        "flat-1",
        "phong-1e-9",
    ] {
        assert!(wrong.parse::<Side>().is_err(), "{wrong}");
    }
}
