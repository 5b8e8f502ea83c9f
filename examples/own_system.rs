//! A system of one's own between two of shadetrade's: it rounds the vertex colours of cuboids that have a `Step`.
//!
//! `cargo run --release --example own_system` draws own_system.png.

use fearless_simd::Level;
use hecs::World;
use image::{Rgb, RgbImage};
use shadetrade::components::{Mesh, VertexColors, View, ordered};
use shadetrade::scene::Scene;
use shadetrade::systems::frame::{Frame, Keep, Workers};
use shadetrade::systems::{self, FRAME};

/// A component: the distance of two vertex colours, in levels.
struct Step(f64);

/// The system: its query names the components that it reads and writes.
fn round_colors(world: &mut World, _view: &View, _frame: &mut Frame) {
    for (step, colors) in world.query_mut::<(&Step, &mut VertexColors)>() {
        for levels in colors.all_mut() {
            *levels = (*levels / step.0).round() * step.0;
        }
    }
}

fn main() -> anyhow::Result<()> {
    let mut scene = Scene::load(None)?; // the built-in cuboid, Gouraud
    for cuboid in ordered::<Mesh>(&scene.world) {
        scene.world.insert_one(cuboid, Step(64.0))?;
    }
    let [spin, normals, projection, lighting, rasterization] = FRAME;
    let stages = [
        spin,
        normals,
        projection,
        lighting,
        round_colors,
        rasterization,
    ];
    let view = View::of(&scene.world, [640, 480]);
    let mut frame = Frame::new(Keep::Display, Workers::new(1, Level::new())?);
    systems::draw_with(&stages, &mut scene.world, &view, 0..480, &mut frame)?;
    let color = |x: u32, y: u32| {
        let [_, rgb @ ..] = frame.pixels()[(y * 640 + x) as usize].to_be_bytes();
        Rgb(rgb)
    };
    RgbImage::from_fn(640, 480, color).save("own_system.png")?;
    Ok(())
}
