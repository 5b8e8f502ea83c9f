//! Scene files: reading, mistakes, the world that they become, and saving without loss.

mod errors;
mod keys;
mod lessons;
pub mod random;
mod read;
mod record;
mod saved;

/// A scene with only the mandatory keys.
const LEAST: &str = include_str!("support/least.toml");

/// A scene with every key, with numbers and tables in every notation, and with entities of mixed kinds.
const MOST: &str = r#"
camera = [{ name = "c", position = [0, 0, 9], target = [0, 0, 1], up = [1, 0, 0], fov = 179, height = 2, near = 3 }]
light = [{ name = "l", kind = "specular", color = [0x10, 0o17, 0b11], intensity = 1_000, gain = 1000000000000000000, position = [1, 2, 3], on = false }]
background = [0, 255, 1.5]
[[cuboid]]
name = "é"
size = [1, 2, 4]
position = [-1, +2, 3e2]
rotation = [10, 20, -720]
shading = "phong"
normals = "face"
material.ambient = [1, 2, 3]
material.diffuse = [4, 5, 6]
material.specular = [7, 8, 9]
material.shininess = 0
"#;
