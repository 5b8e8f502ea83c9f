//! All stages together.

use hecs::{Component, Entity};
use shadetrade::systems::lighting;

use super::{MATERIAL, ahead, at, empty_frame, light};
use crate::support::prelude::*;

#[test]
fn renderer_and_reference_draw_a_spun_and_orbited_scene_like_its_snapshot() {
    let mut scene = built_in();
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
    let mut upright = built_in();
    assert_ne!(drawn(&mut upright), expected);
}

/// A component that the entity has is removed.
fn without<C: Component>(world: &mut World, entity: Entity) {
    world.remove_one::<C>(entity).expect("it has the component");
}

type Removal = fn(&mut World, Entity);

/// It stays where it was placed last, or keeps its normals; Phong does not use segments.
#[test]
fn a_cuboid_that_lacks_a_component_is_drawn_only_without_transform_normal_mode_or_segments() {
    let drawn: [Removal; 3] = [
        without::<Transform>,
        without::<NormalMode>,
        without::<Segments>,
    ];
    let missing: [Removal; 8] = [
        without::<FileOrder>,
        without::<Mesh>,
        without::<Material>,
        without::<ShadingMode>,
        without::<WorldTransform>,
        without::<Normals>,
        without::<VertexColors>,
        without::<Projected>,
    ];
    let all = drawn.into_iter().chain(missing);
    for (index, remove) in all.enumerate() {
        let mut world = World::new();
        let cuboid = spawn_cuboid(&mut world, DVec3::splat(2.0), at(DVec3::ZERO), MATERIAL);
        remove(&mut world, cuboid);
        let view = ahead(Projection::Perspective, [9, 9]);
        let frame = draw(&mut world, &view, Keep::Levels);
        let entity = world.entity(cuboid).expect("it is there");
        // Name is the twelfth component. No system adds one.
        assert_eq!(entity.component_types().count(), 11, "{index}");
        let is_drawn = frame.counts().covered_pixels > 0;
        assert_eq!(is_drawn, index < drawn.len(), "{index}");
    }
}

#[test]
fn a_light_without_a_transform_does_not_shine() {
    for kind in LightKind::ALL {
        let mut world = World::new();
        world.spawn((light(kind, 100.0),));
        let mut frame = empty_frame();
        let view = ahead(Projection::Perspective, [9, 9]);
        lighting::run(&mut world, &view, &mut frame);
        assert_eq!(*frame.illumination(), Illumination::default(), "{kind:?}");
    }
}
