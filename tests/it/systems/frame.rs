//! All stages together.

use shadetrade::components::{Light, Orbit, ShadingMode, View, overwrite, viewer_mut};
use shadetrade::frame::Keep;
use shadetrade::scene::Scene;
use shadetrade::systems;

use super::empty_frame;
use crate::stability::life::{still_life, views};
use crate::support::scene::{draw, truth};

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

#[test]
fn a_light_that_goes_off_and_on_again_leaves_the_same_picture() {
    let mut world = still_life(3);
    // Phong at tolerance 0, which shows every light.
    let view = &views([60, 40])[3];
    let mut frame = empty_frame();
    let mut levels = |off: Option<usize>| {
        let lights = world.query_mut::<&mut Light>().into_iter().enumerate();
        lights.for_each(|(index, light)| light.on = off != Some(index));
        systems::draw(&mut world, view, &mut frame).expect("a small picture fits");
        frame.levels().to_vec()
    };
    let expected = levels(None);
    for light in 0..5 {
        assert_ne!(levels(Some(light)), expected, "light {light}");
        assert_eq!(levels(None), expected, "light {light}");
    }
}
