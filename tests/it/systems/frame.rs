//! All stages together.

use glam::DVec3;
use hecs::{Component, Entity, World};
use shadetrade::components::{
    FileOrder, Illumination, LightKind, Material, Mesh, NormalMode, Normals, Orbit, Projected,
    Projection, Segments, ShadingMode, Transform, VertexColors, View, WorldTransform, overwrite,
    viewer_mut,
};
use shadetrade::scene::Scene;
use shadetrade::systems::frame::Keep;
use shadetrade::systems::lighting;

use super::{MATERIAL, ahead, at, empty_frame, light};
use crate::support::scene::{draw, spawn_cuboid, truth};

#[test]
fn renderer_and_reference_draw_a_spun_and_orbited_scene_like_its_snapshot() {
    let mut scene = Scene::load(None).expect("the built-in scene is valid");
    let orbit = Orbit {
        azimuth: 30.0,
        zoom: 0.8,
        ..Orbit::default()
    };
    viewer_mut(&mut scene.world).turned = 77;
    overwrite(&mut scene.world, &orbit);
    overwrite(&mut scene.world, &ShadingMode::Phong);
    let drawn = |scene: &mut Scene| {
        let view = View::of(&scene.world, [60, 40]).with_tolerance(0.0);
        let frame = draw(&mut scene.world, &view, Keep::Levels);
        let truth = truth(&scene.world, &view);
        for (seen, exact) in frame.levels().iter().zip(&truth.levels) {
            for (seen, exact) in seen.iter().zip(exact) {
                assert!((f64::from(*seen) - exact).abs() < 0.05, "{seen} {exact}");
            }
        }
        (frame.levels().to_vec(), truth.levels)
    };
    let expected = drawn(&mut scene);
    assert_eq!(drawn(&mut scene.snapshot()), expected);
    let mut upright = Scene::load(None).expect("the built-in scene is valid");
    assert_ne!(drawn(&mut upright), expected);
}

/// A component and the removal of it from an entity.
type Removal = (&'static str, fn(&mut World, Entity));

/// Removes a component that the entity has.
fn without<C: Component>(world: &mut World, entity: Entity) {
    world.remove_one::<C>(entity).expect("it has the component");
}

#[test]
fn a_cuboid_that_lacks_a_component_is_drawn_only_without_transform_normal_mode_or_segments() {
    let removals: [Removal; 11] = [
        ("FileOrder", without::<FileOrder>),
        ("Transform", without::<Transform>),
        ("Mesh", without::<Mesh>),
        ("Material", without::<Material>),
        ("ShadingMode", without::<ShadingMode>),
        ("NormalMode", without::<NormalMode>),
        ("Segments", without::<Segments>),
        ("WorldTransform", without::<WorldTransform>),
        ("Normals", without::<Normals>),
        ("VertexColors", without::<VertexColors>),
        ("Projected", without::<Projected>),
    ];
    for (component, remove) in removals {
        let mut world = World::new();
        let cuboid = spawn_cuboid(&mut world, DVec3::splat(2.0), at(DVec3::ZERO), MATERIAL);
        remove(&mut world, cuboid);
        let frame = draw(
            &mut world,
            &ahead(Projection::Perspective, [9, 9]),
            Keep::Levels,
        );
        let left = world
            .entity(cuboid)
            .expect("it is there")
            .component_types()
            .count();
        // Name is the twelfth component. No system adds one.
        assert_eq!(left, 11, "{component}");
        // It stays where it was placed last, or keeps its normals; Phong does not use segments.
        let is_drawn = frame.counts().covered_pixels > 0;
        let stays = ["Transform", "NormalMode", "Segments"].contains(&component);
        assert_eq!(is_drawn, stays, "{component}");
    }
}

#[test]
fn a_light_without_a_transform_does_not_shine() {
    for kind in LightKind::ALL {
        let mut world = World::new();
        world.spawn((light(kind, 100.0),));
        let mut frame = empty_frame();
        lighting::run(
            &mut world,
            &ahead(Projection::Perspective, [9, 9]),
            &mut frame,
        );
        assert_eq!(*frame.illumination(), Illumination::default(), "{kind:?}");
    }
}
