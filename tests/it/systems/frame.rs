//! All stages together.

use shadetrade::components::{Orbit, ShadingMode, View, overwrite, viewer_mut};
use shadetrade::frame::Keep;
use shadetrade::scene::Scene;

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
