//! Fuzzes the text of a scene file: the parser returns a scene, which can be drawn, or one message with its place.
#![no_main]

#[path = "../promises.rs"]
mod promises;

use libfuzzer_sys::fuzz_target;
use shadetrade::components::{Camera, Light, Mesh, Projection, View, ordered, viewer_mut};
use shadetrade::scene::Scene;

/// Larger scenes are skipped: they take long to draw and find no other faults.
const MOST_THINGS: usize = 40;

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    let mut scene = match Scene::parse("fuzz", text) {
        Ok(scene) => scene,
        Err(error) => {
            let said = error.to_string();
            assert!(said.starts_with("fuzz:") && said.len() > 8, "{said:?}");
            return;
        }
    };
    let things = ordered::<Mesh>(&scene.world).len() + ordered::<Light>(&scene.world).len();
    if things > MOST_THINGS {
        return;
    }
    for camera in ordered::<Camera>(&scene.world).into_iter().take(2) {
        for projection in Projection::ALL {
            viewer_mut(&mut scene.world).projection = projection;
            let view = View {
                camera: Camera::of(&scene.world, camera),
                ..View::of(&scene.world, [19, 13]).with_tolerance(0.5)
            };
            promises::check(&mut scene.world, &view);
        }
    }
});
