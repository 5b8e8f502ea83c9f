//! Draws README's pictures of the window and the animations of the lessons, without a display:
//! `cargo run --release --example readme`.

use std::fs;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use egui::RawInput;
use fearless_simd::Level;
use shadetrade::components::{ShadingMode, ViewMode};
use shadetrade::drawing::{Drawing, all_cores};
use shadetrade::output::Output;
use shadetrade::scene::Scene;
use shadetrade::window::app::App;
use shadetrade::window::keys::Command;
use shadetrade::window::recording::Log;
use shadetrade::window::replay;

const SIZE: [usize; 2] = [960, 720];
/// The time in which the window measures its methods again and again.
const MEASURED: Duration = Duration::from_secs(8);

fn main() -> anyhow::Result<()> {
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    for (name, mode) in [
        ("figures/window.png", ViewMode::Picture),
        ("figures/tiles.png", ViewMode::Tiles),
    ] {
        let drawing = Drawing {
            scene: Scene::load(None)?,
            size: SIZE,
            threads: all_cores(),
            level: Level::new(),
        };
        let mut app = App::new(drawing, true)?;
        app.run(Command::Shading(ShadingMode::Phong));
        app.run(Command::View(mode));
        let start = Instant::now();
        let step = |app: &mut App| app.step(start.elapsed(), SIZE, RawInput::default());
        step(&mut app)?;
        while start.elapsed() < MEASURED
            || app.facts.trade.current().is_none()
            || app.facts.proof.current().is_none()
        {
            step(&mut app)?;
            thread::sleep(Duration::from_millis(20));
        }
        step(&mut app)?;
        Output::File(assets.join(name)).write_png(app.pixels(), SIZE)?;
    }
    for name in ["why-the-plane-stays-dull", "what-a-tolerance-buys"] {
        let path = assets.join("lessons").join(name);
        let text = fs::read(path.with_extension("log"))?;
        let log = Log::read(name, &text, Duration::from_secs(6))?;
        let drawing = log.drawing(all_cores(), Level::new());
        let output = Output::File(path.with_extension("png"));
        replay::run(&log, drawing, Some(&output), true, false)?;
    }
    Ok(())
}
