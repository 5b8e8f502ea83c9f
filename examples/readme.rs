//! The window after a few keys -> its pictures in README.md, in `assets/figures`, without a display:
//! `cargo run --release --example readme`.
//!
//! Rule: a picture of the window is what the window shows after those keys, put together by the same code.

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
use shadetrade::window::examiner::{Answer, examine};
use shadetrade::window::hud::{Hud, Shown};
use shadetrade::window::session::Session;
use shadetrade::window::views::ViewMode;

/// As the window opens, in pixels.
const SIZE: [usize; 2] = [960, 720];
/// So many frames that the time in the panel is that of a warm one.
const FRAMES: usize = 60;

fn main() -> anyhow::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/figures");
    let phong = Action::Shading(ShadingMode::Phong);
    for (name, actions) in [
        ("window", vec![phong]),
        ("wipe", vec![Action::Show(ViewMode::GouraudPhong)]),
        ("error-map", vec![Action::Show(ViewMode::ErrorMap)]),
        ("tiles", vec![phong, Action::Show(ViewMode::Tiles)]),
    ] {
        let pixels = window_after(actions)?;
        let path = folder.join(name).with_extension("png");
        Output::File(path).write_png(&pixels, SIZE)?;
        say(&format!("wrote assets/figures/{name}.png"));
    }
    Ok(())
}

/// What the window shows of the built-in scene once all of `actions` are done and the picture rests.
fn window_after(actions: Vec<Action>) -> anyhow::Result<Vec<u32>> {
    let workers = || Workers::new(all_cores(), Level::new());
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
    let mut composition = Composition::new(workers()?, workers()?);
    for _ in 0..FRAMES {
        composition.draw(&mut session, SIZE)?;
    }
    let mut question = session.question(SIZE);
    if let Some(findings) = examine(&mut question, workers()?, &|| false) {
        let revision = findings.revision;
        session.answer(Answer::Findings(findings));
        let (world, view) = (&mut question.scene.world, &question.view);
        if let Some(proof) = prove(world, view, [workers()?, workers()?], &|| false, &|_| ())? {
            session.answer(Answer::Proof(revision, proof));
        }
    }
    let mut pixels = Vec::new();
    composition.compose(&session, &mut pixels);
    Hud::new(&session, SIZE, Shown::Lasting).draw(&mut pixels);
    Ok(pixels)
}
