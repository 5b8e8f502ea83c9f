//! Scenes in; whether their pictures are right out.
//!
//! ```text
//! scenes --Renderer--> pictures --+-- proven: enclosures of every pixel's exact levels
//!                                 +-- same_bits, same_picture: the first scene, which is without the extreme
//!                                 '-- known, known_pixels: facts on paper
//! ```
//!
//! Rule: what is right never comes from what is tried. A picture that shows too little proves nothing, and fails.

use anyhow::{Result, ensure};
use rayon::prelude::*;

use super::renderer::{Picture, Renderer, name, wrong_pixel};
use super::scene_spec::{MODES, RenderConfig, SceneSpec};
use crate::components::{LightKind, Projection, View};
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
    /// No cuboid is seen.
    Background,
    /// Wherever a cuboid is seen, it is this one.
    Cuboid(u32),
    /// Wherever a cuboid is seen, each channel has this level. Lights that send nothing cost nothing.
    Everywhere(f64),
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

pub fn proven(renderer: &mut Renderer, scenes: &[SceneSpec]) -> Result<String> {
    let mut distance = Distance::default();
    for (index, spec) in scenes.iter().enumerate() {
        let covered = distance.covered;
        prove_scene(renderer, spec, index, &mut distance)?;
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

/// Proves every pixel in every projection and mode and at every tolerance. Unless everything is to be drawn, each
/// projection has one of the modes, the other at an odd `index`, and half of the tolerances.
fn prove_scene(
    renderer: &mut Renderer,
    spec: &SceneSpec,
    index: usize,
    distance: &mut Distance,
) -> Result<()> {
    let tolerances: &[f64] = if renderer.full {
        &[0.0, 0.25, 0.5, 1.0, 2.0, 4.0]
    } else {
        &[0.0, 0.5, 4.0]
    };
    let mut scene = spec.parse()?;
    for (first, projection) in Projection::ALL.into_iter().enumerate() {
        for (second, mode) in MODES.into_iter().enumerate() {
            if !renderer.full && (first + second + index) % 2 == 1 {
                continue;
            }
            let view = |tolerance| {
                let config = RenderConfig {
                    projection,
                    mode,
                    tolerance,
                };
                spec.view(&scene, config)
            };
            let views: Vec<View> = tolerances.iter().copied().map(view).collect();
            let enclosures = enclosures(&scene, &views[0]);
            for view in &views {
                prove_picture(renderer, &mut scene, view, &enclosures, distance)?;
            }
        }
    }
    Ok(())
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

pub fn same_bits(renderer: &mut Renderer, scenes: &[SceneSpec]) -> Result<String> {
    let mut covered = 0;
    for config in RenderConfig::all() {
        let plain = renderer.picture(&scenes[0], config)?;
        covered += plain.covered();
        for spec in &scenes[1..] {
            renderer.picture(spec, config)?.expect_bits_of(&plain)?;
        }
    }
    expect_covered(covered)?;
    Ok(format!(
        "the same: {covered} pixels, {} scenes",
        scenes.len()
    ))
}

pub fn same_picture(renderer: &mut Renderer, levels: f64, scenes: &[SceneSpec]) -> Result<String> {
    let mut worst = 0.0_f64;
    for config in RenderConfig::all() {
        for spec in &scenes[1..] {
            let both = [(&scenes[0], config), (spec, config)];
            worst = worst.max(difference(renderer, both, levels)?);
        }
    }
    Ok(format!("{worst:.2e} levels in {} scenes", scenes.len()))
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

/// Draws every scene in every way, and says what the fact is about.
///
/// # Errors
/// When a picture is not as the fact has it.
pub fn known(
    renderer: &mut Renderer,
    fact: Fact,
    configs: impl Iterator<Item = RenderConfig>,
    scenes: &[SceneSpec],
) -> Result<String> {
    let mut covered = 0;
    for config in configs {
        for scene in scenes {
            let picture = renderer.picture(scene, config)?;
            fact.expect_of(&picture, scene)?;
            covered += picture.covered();
        }
    }
    Ok(match fact {
        Fact::Background => "nothing".to_owned(),
        Fact::Cuboid(cuboid) => format!("cuboid {cuboid} at all of {covered} pixels"),
        Fact::Everywhere(level) => format!("{level} levels at all of {covered} pixels"),
    })
}

impl Fact {
    fn expect_of(self, picture: &Picture, spec: &SceneSpec) -> Result<()> {
        match self {
            Fact::Background => picture.expect(|_, _| false),
            Fact::Cuboid(cuboid) => {
                expect_covered(picture.covered())?;
                picture.expect(|id, _| id / 12 == cuboid)
            }
            Fact::Everywhere(level) => {
                expect_covered(picture.covered())?;
                let sends_nothing = spec
                    .lights
                    .iter()
                    .all(|light| *light.kind == LightKind::Ambient || *light.intensity == 0.0);
                ensure!(
                    !sends_nothing || picture.specular_evaluations == 0,
                    "powers are evaluated"
                );
                picture.expect(|_, levels| are_near(levels, [level; 3], 1e-4))
            }
        }
    }
}

/// Draws the pictures, and gives the levels found.
///
/// # Errors
/// When a pixel is not as known.
pub fn known_pixels(renderer: &mut Renderer, pixels: &[KnownPixel]) -> Result<String> {
    let mut observed = Vec::new();
    for known in pixels {
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
}

/// Whether levels are within `limit` of the expected ones; NaN is not.
pub fn are_near(levels: [f32; 3], expected: [f64; 3], limit: f64) -> bool {
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
pub fn levels_text(levels: [f64; 3]) -> String {
    let [red, green, blue] = levels.map(|level| format!("{level:.3}"));
    if red == green && green == blue {
        red
    } else {
        format!("({red} {green} {blue})")
    }
}
