//! Bytes in: whatever they say, the scene parser answers with a scene or with one located message, and what parses can
//! be drawn.
#![no_main]

#[path = "../promises.rs"]
mod promises;

use libfuzzer_sys::fuzz_target;
use shadetrade::components::{Projection, View};
use shadetrade::scene::Scene;

/// A scene that takes longer than a moment to draw teaches nothing more.
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
    if scene.cuboids.len() + scene.lights.len() > MOST_THINGS {
        return;
    }
    for camera in 0..scene.cameras.len().min(2) {
        for projection in [Projection::Perspective, Projection::Orthographic] {
            let view = View {
                size: [19, 13],
                viewpoint: scene.viewpoint(camera),
                projection,
                background: scene.background,
                shading: None,
                tolerance: 0.5,
            };
            promises::check(&mut scene.world, &view);
        }
    }
});
