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
use shadetrade::window::examination::examine;
use shadetrade::window::hud::{self, Hud};
use shadetrade::window::jobs::Progress;
use shadetrade::window::session::Session;

/// As the window opens, in pixels.
const SIZE: [usize; 2] = [960, 720];
/// A pixel of the picture whose row goes through the highlight.
const BESIDE_HIGHLIGHT: [usize; 2] = [470, 345];

fn main() -> anyhow::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/figures");
    let phong = Action::Shading(ShadingMode::Phong);
    for (name, actions, probed) in [
        ("window", vec![phong], None),
        ("error-map", vec![Action::View(3)], None),
        ("tiles", vec![phong, Action::View(4)], None),
        ("lens", vec![phong], Some(BESIDE_HIGHLIGHT)),
    ] {
        let pixels = window_after(actions, probed)?;
        let path = folder.join(name).with_extension("png");
        Output::File(path).write_png(&pixels, SIZE)?;
        say(&format!("wrote assets/figures/{name}.png"));
    }
    Ok(())
}

/// What the window shows of the built-in scene once all of `actions` are done, a pixel is probed, and the picture rests.
fn window_after(actions: Vec<Action>, probed: Option<[usize; 2]>) -> anyhow::Result<Vec<u32>> {
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
    session.apply(Action::Probe(probed));
    let picture = hud::picture(&session, SIZE);
    let size = [picture.width as usize, picture.height as usize];
    let mut composition = Composition::new(workers()?);
    composition.draw(&mut session, size)?;
    composition.time(&mut session)?;
    let mut request = session.reference_request(size);
    if let Some(result) = examine(&mut request, workers()?, &|| false) {
        let revision = result.revision;
        session.hear(Progress::Examined(result));
        let (world, view) = (&mut request.scene.world, &request.view);
        if let Some(proof) = prove(world, view, [workers()?, workers()?], &|| false, &|_| ())? {
            session.hear(Progress::Proven(revision, proof));
        }
    }
    let (mut picture, mut pixels) = (Vec::new(), Vec::new());
    composition.compose(&session, &mut picture);
    Hud::new(&session, SIZE).draw(&picture, true, &mut pixels);
    Ok(pixels)
}
