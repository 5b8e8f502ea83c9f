//! The window after a few keys -> its pictures in README.md, in `assets/figures`; recordings -> the animations beside them,
//! in `assets/lessons`; without a display: `cargo run --release --example readme`.
//!
//! Rule: a picture of the window is what the window shows after those keys, put together by the same code.

use std::fs;
use std::path::Path;

use fearless_simd::Level;
use shadetrade::components::{Projection, ShadingMode};
use shadetrade::drawing::{Drawing, all_cores};
use shadetrade::frame::Workers;
use shadetrade::output::{Output, say};
use shadetrade::prove::prove;
use shadetrade::scene::Scene;
use shadetrade::window::bindings::Action;
use shadetrade::window::composition::Composition;
use shadetrade::window::examination::examine;
use shadetrade::window::hud::{self, Hud};
use shadetrade::window::jobs::Progress;
use shadetrade::window::recording::Log;
use shadetrade::window::replay;
use shadetrade::window::session::Session;
use shadetrade::window::views::ViewMode;

/// As the window opens, in pixels.
const SIZE: [usize; 2] = [960, 720];

fn main() -> anyhow::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/figures");
    let phong = Action::Shading(ShadingMode::Phong);
    for (name, actions) in [
        ("window", vec![phong]),
        ("tiles", vec![phong, Action::Show(ViewMode::Tiles)]),
    ] {
        let pixels = window_after(actions)?;
        let path = folder.join(name).with_extension("png");
        Output::File(path).write_png(&pixels, SIZE)?;
        say(&format!("wrote assets/figures/{name}.png"));
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/lessons");
    for name in ["gouraud-misses-the-highlight", "what-a-tolerance-buys"] {
        let path = folder.join(name);
        let text = fs::read_to_string(path.with_extension("log"))?;
        let log = Log::parse(name, &text, all_cores(), Level::new())?;
        let output = Output::File(path.with_extension("png"));
        replay::run(log, Some(&output), true, false)?;
    }
    Ok(())
}

/// What the window shows of the built-in scene once all of `actions` are done and the picture rests.
fn window_after(actions: Vec<Action>) -> anyhow::Result<Vec<u32>> {
    let mut session = Session::new(Drawing {
        scene: Scene::load(None)?,
        camera: 0,
        projection: Projection::Perspective,
        shading: None,
        tolerance: 0.5,
        size: SIZE,
        threads: all_cores(),
        level: Level::new(),
    });
    for action in actions {
        session.apply(action);
    }
    let picture = hud::picture(&session, SIZE);
    let size = picture.size();
    let mut composition = Composition::new(Workers::new(all_cores(), Level::new())?);
    composition.draw(&mut session, size)?;
    composition.time(&mut session)?;
    let mut snapshot = session.snapshot(size);
    if let Some(result) = examine(&mut snapshot, Level::new(), &|| false)? {
        session.on_progress(snapshot.revision, Progress::Examined(result));
        let (world, view) = (&mut snapshot.scene.world, &snapshot.view);
        if let Some(proof) = prove(world, view, Level::new(), &|| false, &|_| ())? {
            session.on_progress(snapshot.revision, Progress::Proven(proof));
        }
    }
    let (mut picture, mut pixels) = (Vec::new(), Vec::new());
    composition.compose(&session, &mut picture);
    Hud::new(&session, SIZE).draw(&picture, true, &mut pixels);
    Ok(pixels)
}
