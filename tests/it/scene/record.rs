//! A record and its world say the same.

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

/// Every component of the world that a scene says, entities in file order. Debug writes different floats differently, 0 and
/// -0 too.
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
    fn a_record_is_that_of_the_world_it_is_spawned_as(record in random::record()) {
        let world = record.spawn();
        prop_assert_eq!(&SceneRecord::of(&world), &record);
        prop_assert_eq!(said(&SceneRecord::of(&world).spawn()), said(&world));
    }

    #[test]
    fn a_record_is_the_same_in_json(record in random::record()) {
        let text = serde_json::to_string(&record).unwrap();
        prop_assert_eq!(serde_json::from_str::<SceneRecord>(&text).unwrap(), record);
    }

    /// Worlds as they are once entities were removed: the order of the file has gaps.
    #[test]
    fn a_world_with_gaps_is_written_down_without_them(record in random::record(), gone in any::<prop::sample::Index>()) {
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
fn the_built_in_scenes_are_written_down_as_they_are() {
    for (name, _) in BUILT_IN {
        let scene = Scene::load(Some(name)).unwrap_or_else(|error| panic!("{error}"));
        let again = SceneRecord::of(&scene.world).spawn();
        assert_eq!(said(&again), said(&scene.world), "{name}");
    }
}

#[test]
fn whether_cuboids_go_on_turning_is_not_written_down() {
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
