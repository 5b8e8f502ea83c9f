//! The options of each command, and the checks of their values.
//!
//! A message about a wrong value names the legal values.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::time::Duration;

use anyhow::anyhow;
use clap::Args;
use clap::builder::{
    OsStringValueParser, PossibleValuesParser, RangedU64ValueParser, TypedValueParser,
};

use super::failure::Failure;
use super::options::{self, BudgetOption, DrawingOptions, WorkerOptions};
use crate::components::common;
use crate::output::{Output, PngPicture, read_png};
use crate::questions::job::Drawing;
use crate::questions::vary::picture::Contender;
use crate::questions::vary::variable::Variable;
use crate::questions::{export, trade, vary};
use crate::scene::{BUILT_IN, Scene, SceneRecord};
use crate::shading::{METHODS, Method, methods};

/// The options of `view`.
#[derive(Args, Clone, Debug)]
pub struct ViewOptions {
    /// The scene and the view.
    #[command(flatten)]
    pub drawing: DrawingOptions,
    /// The time of a frame.
    #[command(flatten)]
    pub budget: BudgetOption,
}

/// The options of `lesson`.
#[derive(Args, Debug)]
pub struct LessonOptions {
    /// A built-in lesson, or the file of one
    #[arg(value_name = "NAME|FILE", required_unless_present = "list")]
    pub lesson: Option<PathBuf>,
    /// The PNG file of a sheet with all steps, `-` for standard output [default: play in a window]
    #[arg(short, long, value_name = "FILE", value_parser = file(&["png"]))]
    pub output: Option<Output>,
    /// Names the built-in lessons with their first sentences
    #[arg(long, exclusive = true)]
    pub list: bool,
    /// The size in pixels, 1x1 to 16384x16384, of the window or of each picture of the sheet [default: 1280x800, or 640x480]
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = options::size, allow_hyphen_values = true)]
    pub size: Option<[usize; 2]>,
    /// The SIMD level and the threads.
    #[command(flatten)]
    pub workers: WorkerOptions,
}

impl LessonOptions {
    /// The first step of the lesson.
    ///
    /// # Errors
    /// [`Failure::Usage`] if it is wrong, or its file is the output. [`Failure::Work`] if the output is in no folder.
    pub fn open(&self) -> Result<Drawing, Failure> {
        let lesson = self.lesson.as_deref().unwrap_or(Path::new(""));
        let scene = Scene::load_lesson(lesson).map_err(Failure::Usage)?;
        options::check_output(Some(lesson), self.output.as_ref())?;
        let usual = self.output.as_ref().map_or([1280, 800], |_| [640, 480]);
        Ok(Drawing {
            scene,
            size: self.size.unwrap_or(usual),
            threads: self.workers.threads(),
            level: self.workers.simd,
        })
    }
}

/// The options of `render`.
#[derive(Args, Debug)]
pub struct RenderOptions {
    /// The scene and the view.
    #[command(flatten)]
    pub drawing: DrawingOptions,
    /// The time of a frame.
    #[command(flatten)]
    pub budget: BudgetOption,
    /// The PNG file; `-` for standard output
    #[arg(short, long, value_name = "FILE", value_parser = file(&["png"]))]
    pub output: Output,
    /// Draws with the f64 reference instead of the renderer, without use of --tolerance, --budget and --simd
    #[arg(long)]
    pub reference: bool,
}

/// The options of `export`.
#[derive(Args, Debug)]
pub struct ExportOptions {
    /// The scene and the view.
    #[command(flatten)]
    pub drawing: DrawingOptions,
    /// The OBJ file; the materials go into a file beside it that ends in .mtl
    #[arg(short, long, value_name = "FILE", value_parser = file(&["obj"]))]
    pub output: Output,
}

impl ExportOptions {
    /// The scene, and the path of the file.
    ///
    /// # Errors
    /// As [`DrawingOptions::open`]. [`Failure::Usage`] for standard output, which holds one file.
    pub fn open(&self) -> Result<(Drawing, &Path), Failure> {
        let Output::File(path) = &self.output else {
            let error = anyhow!("export writes two files; -o takes a name");
            return Err(Failure::Usage(error));
        };
        let drawing = self.drawing.open(Some(&self.output))?;
        let library = Output::File(export::library(path));
        options::check_output(drawing.scene.path.as_deref(), Some(&library))?;
        Ok((drawing, path))
    }
}

/// The options of `trade`.
#[derive(Args, Debug)]
pub struct TradeOptions {
    /// The scene and the view; each method has its own shading and tolerance.
    #[command(flatten)]
    pub drawing: DrawingOptions,
    /// The folder for trade.json, trade.md and trade.svg (error against time), created if absent
    #[arg(short, long, value_name = "DIR", value_parser = path())]
    pub output: Option<PathBuf>,
    /// Takes the least number of samples; the same as --seconds 0
    #[arg(long, conflicts_with = "seconds")]
    pub quick: bool,
    /// The total time for timing frames, without the reference; at least 30 frames of each method
    #[arg(long, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    #[arg(default_value = "20", default_value_if("quick", "true", "0"))]
    pub seconds: Duration,
    /// Measures only these methods [default: all]
    #[arg(long, value_name = "ID,...", value_delimiter = ',', value_parser = PossibleValuesParser::new(METHODS.iter().map(|method| method.id)))]
    pub methods: Option<Vec<String>>,
    /// Times the batch on standard input and prints the times; `trade` starts itself with it
    #[arg(long, hide = true)]
    pub batch: bool,
}

impl TradeOptions {
    /// The request to measure.
    ///
    /// # Errors
    /// [`Failure::Usage`] if the scene is wrong.
    pub fn request(&self) -> Result<trade::Request, Failure> {
        let mut drawing = self.drawing.open(None)?;
        drawing.threads = self.drawing.workers.threads.unwrap_or(1);
        let methods = match &self.methods {
            Some(ids) => {
                let is_chosen = |it: &&Method| ids.iter().any(|id| id == it.id);
                METHODS.iter().filter(is_chosen).copied().collect()
            }
            None => methods(common(&drawing.scene.world)).collect(),
        };
        Ok(trade::Request {
            drawing,
            methods,
            time: self.seconds,
            is_report: true,
        })
    }
}

fn seconds(text: &str) -> Result<Duration, &'static str> {
    let message = "it is a number of seconds from 0 to 86400";
    let seconds = options::number(text, |it| (0.0..=86_400.0).contains(&it), message)?;
    Ok(Duration::from_secs_f64(seconds))
}

/// The options of `probe`.
#[derive(Args, Debug)]
pub struct ProbeOptions {
    /// The scene and the view.
    #[command(flatten)]
    pub drawing: DrawingOptions,
    /// The pixel: x to the right and y down, from 0,0 in the top left corner
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pub pixel: [usize; 2],
    /// Prints one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

fn pixel(text: &str) -> Result<[usize; 2], &'static str> {
    options::pair(text, ',').ok_or("it is X,Y in whole pixels from 0, such as 480,300")
}

/// The options of `prove`.
#[derive(Args, Debug)]
pub struct ProveOptions {
    /// The scene and the view.
    #[command(flatten)]
    pub drawing: DrawingOptions,
    /// Judges pictures of the scene by any program: PNG files with 8 bits per channel, whose size replaces --size; `-` for standard input
    #[arg(long, value_name = "FILE.png", num_args = 1.., conflicts_with = "size")]
    pub picture: Vec<PathBuf>,
    /// The PNG file of the verdicts: proven pixels dim, and blue at outlines, undecided ones yellow, gaps violet, refuted ones red
    #[arg(short, long, value_name = "FILE", value_parser = file(&["png"]))]
    pub output: Option<Output>,
    /// Prints one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

impl ProveOptions {
    /// The picture to judge, if one is given.
    ///
    /// # Errors
    /// [`Failure::Usage`] if it is no such PNG, the map would replace it, or there are several.
    pub fn read_picture(&self) -> Result<Option<PngPicture>, Failure> {
        let [path] = &self.picture[..] else {
            return Ok(None);
        };
        options::refuse_to_replace(path, self.output.as_ref())?;
        read_png(path).map(Some).map_err(Failure::Usage)
    }

    /// The pictures of a table, if several are given.
    ///
    /// # Errors
    /// [`Failure::Usage`] if there is a map, which shows one picture.
    pub fn pictures(&self) -> Result<Option<&[PathBuf]>, Failure> {
        if self.picture.len() < 2 {
            return Ok(None);
        }
        if self.output.is_some() {
            let error = anyhow!("-o shows one picture; --picture has {}", self.picture.len());
            return Err(Failure::Usage(error));
        }
        Ok(Some(&self.picture))
    }
}

/// The options of `requires`.
#[derive(Args, Debug)]
pub struct RequiresOptions {
    /// The scene and the view.
    #[command(flatten)]
    pub drawing: DrawingOptions,
    /// The file for the least scene that keeps the tolerance: lights, cuboids, Phong and corner normals are left out together
    #[arg(short, long, value_name = "FILE", value_parser = file(&["toml"]))]
    pub output: Option<Output>,
    /// Prints one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

/// The options of `vary`.
#[derive(Args, Debug)]
pub struct VaryOptions {
    /// The scene and the view.
    #[command(flatten)]
    pub drawing: DrawingOptions,
    /// The numbers that are varied, one after another, each over its range
    #[arg(value_name = "KEY=FROM..TO")]
    pub variables: Vec<String>,
    /// The number of values of each key, 2 to 1000
    #[arg(long, default_value = "21", value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(2..=1000), allow_negative_numbers = true)]
    pub steps: usize,
    /// The methods, by their ids; also textbook-f32 and reference [default: gouraud-0.5, phong-0.5, phong-unit-vectors and these two]
    #[arg(long, value_name = "ID,ID...", value_delimiter = ',', value_parser = PossibleValuesParser::new(Contender::all().map(|it| it.id)))]
    pub methods: Option<Vec<String>>,
    /// Measures the time of frames, for so long in all
    #[arg(long, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    pub seconds: Option<Duration>,
    /// The folder for vary.json and vary.svg, created if absent
    #[arg(short, long, value_name = "DIR", value_parser = path())]
    pub output: Option<PathBuf>,
    /// Prints one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

impl VaryOptions {
    /// Loads the scene and checks the keys.
    ///
    /// # Errors
    /// [`Failure::Usage`] if the scene, a key or its range is wrong.
    pub fn request(&self) -> Result<vary::Request, Failure> {
        let mut options = self.drawing.clone();
        let mut texts = self.variables.clone();
        // The scene may be left out.
        if let Some(first) = options.scene.to_str().filter(|it| it.contains('=')) {
            texts.insert(0, first.to_owned());
            options.scene = BUILT_IN[0].0.into();
        }
        let drawing = options.open(None)?;
        let record = SceneRecord::of(&drawing.scene.world);
        let parsed = texts.iter().map(|text| Variable::parse(text, &record));
        let variables: Vec<_> = parsed.collect::<Result<_, _>>().map_err(Failure::Usage)?;
        if variables.is_empty() {
            let says = "give KEY=FROM..TO, such as light.white.intensity=1..100";
            return Err(Failure::Usage(anyhow!(says)));
        }
        let contenders = match &self.methods {
            Some(ids) => {
                let is_chosen = |it: &Contender| ids.iter().any(|id| id == it.id);
                Contender::all().filter(is_chosen).collect()
            }
            None => Contender::usual(),
        };
        Ok(vary::Request {
            drawing,
            variables,
            contenders,
            steps: self.steps,
            time: self.seconds,
        })
    }
}

/// The options of `extremes`.
#[derive(Args, Debug)]
pub struct ExtremesOptions {
    /// Proves only these extremes [default: all]
    #[arg(value_name = "NAME")]
    pub names: Vec<String>,
    /// Prints the names, each with a sentence about its scene, and proves nothing
    #[arg(long)]
    pub list: bool,
    /// Prints a JSON array: `name`, `expected`, `observed` and `pass` of each extreme; `name` and `says` with --list
    #[arg(long)]
    pub json: bool,
    /// The SIMD level and the threads.
    #[command(flatten)]
    pub workers: WorkerOptions,
}

/// The default folder for figures.
pub const DEFAULT_FIGURES: &str = "shadetrade-figures";

/// Refuses a name that ends like a file of another kind: a picture must not replace a scene. A name needs no ending, and that of
/// a pipe or a device may have any.
fn file(endings: &'static [&'static str]) -> impl TypedValueParser<Value = Output> {
    OsStringValueParser::new().try_map(move |path| {
        let found = Path::new(&path).metadata();
        let is_special = found.is_ok_and(|it| !it.is_file() && !it.is_dir());
        let ending = Path::new(&path).extension();
        let is_legal = |ending: &OsStr| endings.iter().any(|it| ending.eq_ignore_ascii_case(it));
        if path.is_empty() {
            Err("a file needs a name".to_owned())
        } else if is_special || ending.is_none_or(is_legal) {
            Ok(Output::from(path))
        } else {
            let endings = endings.join(" or .");
            Err(format!("its name ends in .{endings}, or has no ending"))
        }
    })
}

/// Refuses standard output, which does not hold the files of a folder.
pub(super) fn path() -> impl TypedValueParser<Value = PathBuf> {
    OsStringValueParser::new().try_map(|path| match path.to_str() {
        Some("") => Err("it needs a name"),
        Some("-") => Err("it is not written to standard output; ./- has that name"),
        _ => Ok(PathBuf::from(path)),
    })
}
