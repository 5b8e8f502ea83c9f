//! All stages together.

use allocation_counter::measure;
use glam::{DVec3, dvec3};
use hecs::World;
use shadetrade::components::{
    LightKind, Orbit, Projection, ShadingMode, Spin, Transform, View, overwrite,
};
use shadetrade::reference;
use shadetrade::scene::Scene;
use shadetrade::systems::{self, FRAME};

use super::{MATERIAL, ahead, at, empty_frame, light, spawn_cuboid};

fn two_lit_cuboids() -> World {
    let mut world = World::new();
    for (order, mode) in [ShadingMode::Gouraud, ShadingMode::Phong]
        .into_iter()
        .enumerate()
    {
        let transform = Transform {
            position: DVec3::X * (order as f64 * 3.0),
            rotation: dvec3(20.0, 30.0, 40.0),
        };
        spawn_cuboid(
            &mut world,
            order,
            transform,
            DVec3::splat(4.0),
            MATERIAL,
            mode,
        );
    }
    world.spawn((at(dvec3(3.0, 8.0, 9.0)), light(LightKind::Diffuse, 300.0)));
    world.spawn((at(dvec3(-5.0, 8.0, 9.0)), light(LightKind::Specular, 200.0)));
    world
}

#[test]
fn every_stage_is_reported_once_in_order_and_draws_the_same_picture() {
    let view = ahead(Projection::Perspective, [60, 40]);
    let (mut plain, mut staged) = (empty_frame(), empty_frame());
    systems::draw(&mut two_lit_cuboids(), &view, &mut plain).expect("a small picture fits");
    let mut names = Vec::new();
    systems::draw_in_stages(&mut two_lit_cuboids(), &view, 0..40, &mut staged, |stage| {
        names.push(stage);
    })
    .expect("a small picture fits");
    assert_eq!(names, FRAME.map(|(name, _)| name));
    assert_eq!(plain.levels(), staged.levels());
}

#[test]
fn a_second_frame_is_the_same_and_takes_no_memory() {
    let view = ahead(Projection::Perspective, [60, 40]);
    let (mut world, mut frame) = (two_lit_cuboids(), empty_frame());
    systems::draw(&mut world, &view, &mut frame).expect("a small picture fits");
    let first = frame.levels().to_vec();
    assert!(frame.counts().covered_pixels > 100);
    let taken = measure(|| {
        systems::draw(&mut world, &view, &mut frame).expect("it fitted before");
    });
    assert_eq!(frame.levels(), first);
    assert_eq!(taken.count_total, 0);
}

#[test]
fn renderer_and_reference_draw_a_spun_and_orbited_scene_like_its_snapshot() {
    let mut scene = Scene::load(None).expect("the built-in scene is valid");
    let spin = Spin {
        degrees: 77,
        on: true,
    };
    let orbit = Orbit {
        azimuth: 30.0,
        zoom: 0.8,
        ..Orbit::default()
    };
    overwrite(&mut scene.world, &spin);
    overwrite(&mut scene.world, &orbit);
    overwrite(&mut scene.world, &ShadingMode::Phong);
    let drawn = |scene: &mut Scene| {
        let view = View::of(&scene.world, [60, 40]).with_tolerance(0.0);
        let mut frame = empty_frame();
        systems::draw(&mut scene.world, &view, &mut frame).expect("a small picture fits");
        let truth = reference::picture(&scene.world, &view, 0..40, &|| false, &|_| ());
        let truth = truth.expect("it is not cancelled");
        for (seen, exact) in frame.levels().iter().zip(&truth.levels) {
            for (seen, exact) in seen.iter().zip(exact) {
                assert!((f64::from(*seen) - exact).abs() < 0.05, "{seen} {exact}");
            }
        }
        (frame.levels().to_vec(), truth.levels)
    };
    let expected = drawn(&mut scene);
    assert_eq!(drawn(&mut scene.snapshot()), expected);
    let upright = Scene::load(None).expect("the built-in scene is valid");
    assert_ne!(drawn(&mut upright.snapshot()), expected);
}
