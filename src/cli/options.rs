//! The common options of all commands that draw, which give a [`Drawing`].
//!
//! Values are checked before anything is allocated. A message about a wrong value names the legal values.

use std::path::{Path, PathBuf};

use anyhow::anyhow;
use clap::Args;
use clap::builder::{PossibleValuesParser, RangedU64ValueParser, TypedValueParser};
use fearless_simd::Level;
use serde::de::DeserializeOwned;
use toml::Value;

use super::failure::Failure;
use crate::components::numbers::range_of;
use crate::components::{
    NormalMode, Projection, Segments, ShadingMode, Viewer, overwrite, viewer_mut,
};
use crate::output::files::check_place;
use crate::output::{MAX_PICTURE_SIDE, Output, one_line};
use crate::questions::job::{Drawing, MAX_THREADS, all_cores};
use crate::scene::key::{self, Key};
use crate::scene::{BUILT_IN, Scene, SceneRecord};
use crate::shading::simd;

/// The scene and the view on the command line.
#[derive(Args, Clone, Debug)]
pub struct DrawingOptions {
    /// A scene file, or a built-in scene: cuboid, bench-far, bench-close, assignment, extremes/NAME, lessons/NAME
    #[arg(value_name = "SCENE", default_value = BUILT_IN[0].0)]
    pub scene: PathBuf,
    /// Changes a number or a setting of the scene, such as light.white.on=false; it can be given several times
    #[arg(long, value_name = "KEY=VALUE", value_parser = key::assignment)]
    pub set: Vec<(Key, Value)>,
    /// The camera of the scene [default: as the scene says]
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// The projection [default: as the scene says]
    #[arg(long, value_name = "PROJECTION", value_parser = one_of::<Projection>(Projection::ALL.map(Projection::name)))]
    pub projection: Option<Projection>,
    /// The shading of all cuboids [default: each as the scene says]
    #[arg(long, value_name = "SHADING", value_parser = one_of::<ShadingMode>(ShadingMode::ALL.map(ShadingMode::name)))]
    pub shading: Option<ShadingMode>,
    /// The vertex normals of all cuboids: corner (smooth edges) or face (sharp ones) [default: each as the scene says]
    #[arg(long, value_name = "NORMALS", value_parser = one_of::<NormalMode>(NormalMode::ALL.map(NormalMode::name)))]
    pub normals: Option<NormalMode>,
    /// The segments along an edge of each face; Gouraud evaluates the model at the corners of their grid, 1 to 256 [default: each as the scene says]
    #[arg(long, value_name = "N", value_parser = segments, allow_negative_numbers = true)]
    pub segments: Option<Segments>,
    /// The lights that are on: names, `all` or `none` [default: as the scene says]
    #[arg(long, value_name = "NAME,NAME...")]
    pub lights: Option<String>,
    /// The largest error of a pixel, in levels of 255: 0 (exact), or 0.0001 to 255 [default: as the scene says, else 0.5]
    #[arg(long, value_name = "LEVELS", value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// The size of the picture in pixels, 1x1 to 16384x16384
    #[arg(long, default_value = "960x720", value_name = "WIDTHxHEIGHT", value_parser = size, allow_hyphen_values = true)]
    pub size: [usize; 2],
    /// The SIMD level and the threads.
    #[command(flatten)]
    pub workers: WorkerOptions,
}

/// The SIMD level and the threads on the command line.
#[derive(Args, Clone, Debug)]
pub struct WorkerOptions {
    /// The SIMD instructions of the renderer
    #[arg(long, default_value = "auto", value_name = "LEVEL", value_parser = level())]
    pub simd: Level,
    /// The number of threads, 1 to 1024 [default: all cores]
    #[arg(long, value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..=MAX_THREADS as u64), allow_negative_numbers = true)]
    pub threads: Option<usize>,
}

impl WorkerOptions {
    /// The number of threads.
    pub fn threads(&self) -> usize {
        self.threads.unwrap_or_else(all_cores)
    }
}

impl DrawingOptions {
    /// Loads the scene and applies the options to it. The command will write to `output`.
    ///
    /// # Errors
    /// [`Failure::Usage`] if the scene is wrong or its file is `output`, or if it has no such camera or light. [`Failure::Work`] if
    /// `output` is a directory or in none.
    pub fn open(&self, output: Option<&Output>) -> Result<Drawing, Failure> {
        let mut scene = Scene::load_path(&self.scene).map_err(Failure::Usage)?;
        check_output(scene.path.as_deref(), output)?;
        if !self.set.is_empty() {
            let record = key::set(&SceneRecord::of(&scene.world), &self.set);
            scene.world = record.map_err(Failure::Usage)?.spawn();
        }
        if let Some(name) = &self.camera {
            scene.look_from(name).map_err(Failure::Usage)?;
        }
        if let Some(lights) = &self.lights {
            scene.switch_lights(lights).map_err(Failure::Usage)?;
        }
        if let Some(mode) = self.shading {
            overwrite(&mut scene.world, &mode);
            // A budget chooses the shading, too.
            viewer_mut(&mut scene.world).budget = None;
        }
        if let Some(normals) = self.normals {
            overwrite(&mut scene.world, &normals);
        }
        if let Some(segments) = self.segments {
            overwrite(&mut scene.world, &segments);
        }
        if let Some(projection) = self.projection {
            viewer_mut(&mut scene.world).projection = projection;
        }
        if let Some(levels) = self.tolerance {
            let mut viewer = viewer_mut(&mut scene.world);
            (viewer.tolerance, viewer.budget) = (levels, None);
        }
        Ok(Drawing {
            scene,
            size: self.size,
            threads: self.workers.threads(),
            level: self.workers.simd,
        })
    }
}

/// The longest time of a frame on the command line.
#[derive(Args, Clone, Debug)]
pub struct BudgetOption {
    /// The longest time of a frame, in milliseconds: the most exact method within it is chosen [default: as the scene says]
    #[arg(long, value_name = "MS", value_parser = budget, allow_negative_numbers = true, conflicts_with_all = ["tolerance", "shading"])]
    pub budget: Option<f64>,
}

impl BudgetOption {
    /// Sets the budget in place of the tolerance, if one is given.
    pub fn apply_to(&self, drawing: &mut Drawing) {
        if self.budget.is_some() {
            let mut viewer = viewer_mut(&mut drawing.scene.world);
            (viewer.tolerance, viewer.budget) = (Viewer::TOLERANCE, self.budget);
        }
    }
}

/// Checks that `output` is in a folder and not the file that is read.
///
/// # Errors
/// [`Failure::Usage`] if it is that file, [`Failure::Work`] if it is in no folder.
pub fn check_output(input: Option<&Path>, output: Option<&Output>) -> Result<(), Failure> {
    if let Some(Output::File(path)) = output {
        check_place(path)?;
    }
    input.map_or(Ok(()), |input| refuse_to_replace(input, output))
}

/// Checks that `output` is not the file that is read.
///
/// # Errors
/// [`Failure::Usage`] if it is.
pub fn refuse_to_replace(input: &Path, output: Option<&Output>) -> Result<(), Failure> {
    if let Some(Output::File(output)) = output
        && input.is_file()
        && let (Ok(read), Ok(written)) = (input.canonicalize(), output.canonicalize())
        && read == written
    {
        let output = one_line(output);
        let error = anyhow!("{output} is the input itself; give -o another place");
        return Err(Failure::Usage(error));
    }
    Ok(())
}

/// A parser of one of these names, which serde converts to the value.
fn one_of<T>(names: impl IntoIterator<Item = &'static str>) -> impl TypedValueParser<Value = T>
where
    T: DeserializeOwned + Clone + Send + Sync + 'static,
{
    PossibleValuesParser::new(names).try_map(|name| serde_json::from_value(name.into()))
}

fn level() -> impl TypedValueParser<Value = Level> {
    let names = ["auto"].into_iter().chain(simd::NAMES);
    PossibleValuesParser::new(names).try_map(|name| match &*name {
        "auto" => Ok(Level::new()),
        name => simd::named(name).ok_or("this machine lacks it; auto and fallback always work"),
    })
}

/// A legal number.
///
/// # Errors
/// `message` if it is no number, or not legal.
pub fn number(
    text: &str,
    is_legal: impl Fn(f64) -> bool,
    message: &'static str,
) -> Result<f64, &'static str> {
    // -0 is 0.
    let number = text.parse().ok().map(|number: f64| number + 0.0);
    number.filter(|it| is_legal(*it)).ok_or(message)
}

/// Two whole numbers with a separator between.
pub fn pair(text: &str, separator: char) -> Option<[usize; 2]> {
    let (one, other) = text.split_once(separator)?;
    Some([one.parse().ok()?, other.parse().ok()?])
}

fn tolerance(text: &str) -> Result<f64, &'static str> {
    let message = "it is 0 (exact) or a number of levels from 0.0001 to 255";
    number(text, Viewer::may_have, message)
}

fn segments(text: &str) -> Result<Segments, &'static str> {
    let segments = text.parse().ok().and_then(Segments::new);
    segments.ok_or("it is a whole number from 1 to 256")
}

fn budget(text: &str) -> Result<f64, &'static str> {
    let message = "it is a number of milliseconds from 0.001 to 10000";
    number(text, |it| range_of("budget").contains(&it), message)
}

pub(super) fn size(text: &str) -> Result<[usize; 2], &'static str> {
    let is_legal = |size: &[usize; 2]| {
        size.iter()
            .all(|side| (1..=MAX_PICTURE_SIDE).contains(side))
    };
    let size = pair(text, 'x').filter(is_legal);
    size.ok_or("it is WIDTHxHEIGHT in pixels, 1x1 to 16384x16384, such as 960x720")
}

/// Refuses an option that a command does not have.
pub(super) fn refuse<T>(_: &str) -> Result<T, &'static str> {
    Err("`trade` measures every shading at its own tolerance")
}
