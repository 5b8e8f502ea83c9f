//! Scenes in; cases that say whether their pictures are right out.
//!
//! ```text
//! scenes --Renderer--> pictures --+-- proven: enclosures of every pixel's exact levels
//!                                 +-- same_bits, same_picture: the first scene, which is without the extreme
//!                                 '-- known, known_pixels: facts on paper
//! ```
//!
//! Rule: what is right never comes from what is tried. A picture that shows too little proves nothing, and fails.

use anyhow::{Result, bail, ensure};
use rayon::prelude::*;

use super::renderer::{Renderer, name, wrong_pixel};
use super::scene_spec::{RenderConfig, SceneSpec};
use super::{Case, case};
use crate::components::{Projection, View};
use crate::prove::{self, Shown, Verdict, shown_face};
use crate::reference::{Interval, Reference, Seen};
use crate::scene::Scene;
use crate::shading::{EXACT, limit};
use crate::systems;
use crate::trade::metrics::pixel_error;

/// The least number of pixels that must show a cuboid for a comparison to mean something.
const MIN_COVERED: u64 = 100;

/// What is known of every picture of a scene without drawing it.
#[derive(Clone, Copy)]
pub enum Fact {
    /// No cuboid is seen in these projections.
    Background(&'static [Projection]),
    /// Wherever a cuboid is seen, it is this one.
    Cuboid(u32),
    /// Wherever a cuboid is seen, each channel has this level.
    Everywhere(f64),
    /// The same, and no power is evaluated.
    Unlit(f64),
}

/// A picture of which the levels of one pixel are known.
pub struct KnownPixel {
    pub scene: SceneSpec,
    pub config: RenderConfig,
    pub pixel: [usize; 2],
    pub levels: [f64; 3],
}

/// How far proven pictures are from their enclosures, at most.
#[derive(Default)]
struct Distance {
    /// The largest error at tolerance 0, in levels.
    exact: f64,
    /// The largest error at the others, as a share of the tolerance.
    share: f64,
    /// Pixels that show a cuboid, or may.
    covered: u64,
    /// Pixels so near an edge that they may show either side.
    outline: u64,
}

/// A case whose every pixel is proven in every projection and mode, at every tolerance.
pub fn proven(name: &'static str, scenes: impl IntoIterator<Item = SceneSpec>) -> Case {
    let scenes = Vec::from_iter(scenes);
    case(name, "every pixel proven", move |renderer| {
        prove_scenes(renderer, &scenes)
    })
}

/// Proves every pixel in every projection and mode and at every tolerance. Unless everything is to be drawn, each
/// projection has one of the modes, the other in every second scene, and half of the tolerances.
///
/// # Errors
/// When a pixel is not proven, or a scene shows too little.
pub fn prove_scenes(renderer: &mut Renderer, scenes: &[SceneSpec]) -> Result<String> {
    let tolerances: &[f64] = if renderer.full {
        &[0.0, 0.25, 0.5, 1.0, 2.0, 4.0]
    } else {
        &[0.0, 0.5, 4.0]
    };
    let mut distance = Distance::default();
    for (index, spec) in scenes.iter().enumerate() {
        let covered = distance.covered;
        let mut scene = spec.parse()?;
        for config in RenderConfig::all().filter(|config| config.tolerance == 0.0) {
            let parity = config.projection as usize + config.mode as usize + index;
            if !renderer.full && parity % 2 == 1 {
                continue;
            }
            let exact = spec.view(&scene, config);
            let enclosures = enclosures(&scene, &exact);
            for &tolerance in tolerances {
                let view = View {
                    tolerance,
                    ..exact.clone()
                };
                prove_picture(renderer, &mut scene, &view, &enclosures, &mut distance)?;
            }
        }
        expect_covered(distance.covered - covered)?;
    }
    Ok(format!(
        "{} pixels, {} on edges: {:.1e} levels at 0, else up to {:.0} % of the tolerance",
        distance.covered,
        distance.outline,
        distance.exact,
        100.0 * distance.share
    ))
}

/// Draws a picture and judges every pixel by what it may show.
fn prove_picture(
    renderer: &mut Renderer,
    scene: &mut Scene,
    view: &View,
    enclosures: &[Vec<Seen<Interval>>],
    distance: &mut Distance,
) -> Result<()> {
    systems::draw(&mut scene.world, view, &mut renderer.levels)?;
    systems::draw(&mut scene.world, view, &mut renderer.display)?;
    for (pixel, seen) in enclosures.iter().enumerate() {
        let shown = Shown::at(pixel, &renderer.levels, &renderer.display);
        let (mark, error) = prove::judge(shown, seen, limit(view.tolerance));
        if mark.verdict != Verdict::Proven {
            let what = format!("is {:?}: {shown:?}, not {seen:?}", mark.verdict);
            return Err(wrong_pixel(view, pixel, &what));
        }
        if view.tolerance == 0.0 {
            distance.exact = distance.exact.max(error);
        } else {
            distance.share = distance.share.max(error / view.tolerance);
        }
        distance.covered += u64::from(mark.is_covered);
        distance.outline += u64::from(mark.is_outline);
    }
    Ok(())
}

/// What every pixel of a picture may show, row by row from the top.
pub fn enclosures(scene: &Scene, view: &View) -> Vec<Vec<Seen<Interval>>> {
    let reference = Reference::<Interval>::new(&scene.world, view);
    let rows = (0..view.size[1]).into_par_iter().map(|y| {
        let mut row = Vec::new();
        reference.row(y, |_, seen| row.push(seen.to_vec()));
        row
    });
    rows.collect::<Vec<_>>().concat()
}

/// A case whose scenes have the same bits as the first one, which is not extreme.
pub fn same_bits(name: &'static str, scenes: impl IntoIterator<Item = SceneSpec>) -> Case {
    let scenes = Vec::from_iter(scenes);
    case(name, "the same bits as without it", move |renderer| {
        let mut covered = 0;
        for config in RenderConfig::all() {
            let plain = renderer.picture(&scenes[0], config)?;
            covered += plain.covered();
            for spec in &scenes[1..] {
                renderer.picture(spec, config)?.expect_bits_of(&plain)?;
            }
        }
        expect_covered(covered)?;
        let count = scenes.len();
        Ok(format!("the same: {covered} pixels, {count} scenes"))
    })
}

/// A case whose scenes are within so many levels of the first one, which is not extreme.
pub fn same_picture(
    name: &'static str,
    levels: f64,
    scenes: impl IntoIterator<Item = SceneSpec>,
) -> Case {
    let scenes = Vec::from_iter(scenes);
    let expected = format!("within {levels} level of the picture without it");
    case(name, expected, move |renderer| {
        let mut worst = 0.0_f64;
        for config in RenderConfig::all() {
            for spec in &scenes[1..] {
                let both = [(&scenes[0], config), (spec, config)];
                worst = worst.max(difference(renderer, both, levels)?);
            }
        }
        Ok(format!("{worst:.2e} levels in {} scenes", scenes.len()))
    })
}

/// The largest difference between two pictures, the plain one first, where they show the same face.
///
/// # Errors
/// When it is above `most` levels, or they show different faces where the plain one may not.
pub fn difference(
    renderer: &mut Renderer,
    [plain, extreme]: [(&SceneSpec, RenderConfig); 2],
    most: f64,
) -> Result<f64> {
    let expected = renderer.picture(plain.0, plain.1)?;
    expect_covered(expected.covered())?;
    let drawn = renderer.picture(extreme.0, extreme.1)?;
    let reference = Reference::<Interval>::new(&plain.0.parse()?.world, &expected.view);
    let width = expected.view.size[0];
    let mut worst = 0.0_f64;
    for (pixel, ids) in drawn.triangles.iter().zip(&expected.triangles).enumerate() {
        let faces = [*ids.0, *ids.1].map(shown_face);
        let may_show = || reference.at([pixel % width, pixel / width]);
        if faces[0] == faces[1] {
            worst = worst.max(pixel_error(drawn.levels[pixel], expected.levels[pixel]));
        } else if !may_show().iter().any(|seen| seen.face() == faces[0]) {
            let what = format!("shows {}, not {}", name(*ids.0), name(*ids.1));
            return Err(wrong_pixel(&drawn.view, pixel, &what));
        }
    }
    ensure!(worst <= most, "{worst} levels, {:?}", extreme.1);
    Ok(worst)
}

/// A case of which one fact is known about every scene, however it is drawn.
pub fn known(
    name: &'static str,
    expected: &str,
    fact: Fact,
    scenes: impl IntoIterator<Item = SceneSpec>,
) -> Case {
    let scenes = Vec::from_iter(scenes);
    let is_known = move |config: &RenderConfig| match fact {
        Fact::Background(projections) => projections.contains(&config.projection),
        _ => true,
    };
    case(name, expected, move |renderer| {
        let mut all = 0;
        for config in RenderConfig::all().filter(is_known) {
            for scene in &scenes {
                let picture = renderer.picture(scene, config)?;
                let covered = picture.covered();
                picture.expect(|id, levels| match fact {
                    Fact::Background(_) => false,
                    Fact::Cuboid(cuboid) => id / 12 == cuboid,
                    Fact::Everywhere(level) | Fact::Unlit(level) => {
                        are_near(levels, [level; 3], 1e-4)
                    }
                })?;
                match fact {
                    Fact::Background(_) => {}
                    Fact::Unlit(_) if picture.specular_evaluations > 0 => {
                        bail!("powers are evaluated")
                    }
                    _ => expect_covered(covered)?,
                }
                all += covered;
            }
        }
        Ok(match fact {
            Fact::Background(_) => "nothing".to_owned(),
            Fact::Cuboid(cuboid) => format!("cuboid {cuboid} at all of {all} pixels"),
            Fact::Everywhere(level) | Fact::Unlit(level) => {
                format!("{level} levels at all of {all} pixels")
            }
        })
    })
}

/// A case of pictures of each of which the levels of one pixel are known.
pub fn known_pixels(name: &'static str, pixels: impl IntoIterator<Item = KnownPixel>) -> Case {
    let pixels = Vec::from_iter(pixels);
    let levels: Vec<String> = pixels.iter().map(|it| levels_text(it.levels)).collect();
    let expected = format!("on paper {}", levels.join(", "));
    case(name, expected, move |renderer| {
        let mut observed = Vec::new();
        for known in &pixels {
            let picture = renderer.picture(&known.scene, known.config)?;
            let [x, y] = known.pixel;
            let pixel = y * known.scene.size[0] + x;
            let levels = picture.levels[pixel];
            if !are_near(levels, known.levels, EXACT) {
                let what = format!("has levels {levels:?}");
                return Err(wrong_pixel(&picture.view, pixel, &what));
            }
            observed.push(levels_text(levels.map(f64::from)));
        }
        Ok(observed.join(", "))
    })
}

/// Whether levels are within `limit` of the expected ones; NaN is not.
fn are_near(levels: [f32; 3], expected: [f64; 3], limit: f64) -> bool {
    let mut channels = levels.into_iter().zip(expected);
    channels.all(|(level, expected)| (f64::from(level) - expected).abs() <= limit)
}

/// Too few pixels that show a cuboid prove nothing.
///
/// # Errors
/// When there are too few.
pub fn expect_covered(pixels: u64) -> Result<()> {
    ensure!(
        pixels >= MIN_COVERED,
        "no more than {pixels} pixels show a cuboid"
    );
    Ok(())
}

/// Three levels, or one where they are alike.
fn levels_text(levels: [f64; 3]) -> String {
    let [red, green, blue] = levels.map(|level| format!("{level:.3}"));
    if red == green && green == blue {
        red
    } else {
        format!("({red} {green} {blue})")
    }
}
