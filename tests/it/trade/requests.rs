//! Requests of the tests: small pictures of a cuboid, measured as briefly as possible.

use std::time::Duration;

use fearless_simd::Level;
use shadetrade::drawing::Drawing;
use shadetrade::scene::Scene;
use shadetrade::trade::Request;

pub const GREEN: &str = "[0.3, 0.9, 0.3]";
pub const CENTRE: &str = "[0, 0, 0]";

/// A cuboid under three lights. These lines replace those of the material and the lights.
pub fn scene(diffuse: &str, target: &str, lights: bool) -> Scene {
    let mut text = format!(
        "[[cuboid]]\nname = \"box\"\nsize = [4, 3, 2]\n\
         [cuboid.material]\nambient = {diffuse}\ndiffuse = {diffuse}\nspecular = {diffuse}\nshininess = 20\n\
         [[camera]]\nname = \"1\"\nposition = [7, 5, 8]\ntarget = {target}\nfov = 30\nheight = 6\n"
    );
    for (kind, position) in [
        ("ambient", ""),
        ("diffuse", "position = [10, 10, 10]"),
        ("specular", "position = [10, 10, 10]"),
    ] {
        if lights {
            text += "[[light]]\ncolor = [1, 1, 1]\nintensity = 100\n";
            for line in ["name", "kind"].map(|key| format!("{key} = \"{kind}\"\n")) {
                text += &line;
            }
            text += position;
            text += "\n";
        }
    }
    Scene::parse("test", &text).expect("it is a valid scene")
}

/// A request to measure it as briefly as possible.
pub fn request(scene: Scene, size: [usize; 2], threads: usize) -> Request {
    let drawing = Drawing {
        scene,
        size,
        threads,
        level: Level::new(),
    };
    Request::new(drawing, Duration::ZERO, "shadetrade trade test".to_owned())
}
