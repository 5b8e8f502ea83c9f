//! The command line: commands, their options and their help.
//!
//! ```text
//! arguments --parse--> Command with checked values (commands, options) --main--> success, or Failure (failure)
//! ```
//! | question | where |
//! |---|---|
//! | Which commands are there? | here, with their examples |
//! | Which options does a command have? | `commands` |
//! | Which options do all that draw have? | [`options`] |
//! | What does a failure print? | `failure` |
//!
//! The doc comment of a command or option is its text in `--help`.

mod commands;
mod failure;
pub mod options;

use std::ffi::OsString;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::error::ContextKind;
use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;
use rayon::ThreadPoolBuilder;

use crate::components::ShadingMode;
use crate::output::Output;
use crate::questions::job::all_cores;
pub use commands::{
    DEFAULT_FIGURES, ExportOptions, ExtremesOptions, LessonOptions, ProbeOptions, ProveOptions,
    RenderOptions, RequiresOptions, TradeOptions, VaryOptions, ViewOptions,
};
pub use failure::Failure;

/// The command line: a command, or the options of `view` without its name.
#[derive(Debug, Parser)]
#[command(
    name = "shadetrade",
    version,
    about = "Draws lit cuboids with flat, Gouraud and Phong shading, and measures cost and error of each shortcut",
    args_conflicts_with_subcommands = true,
    after_help = "\
Examples:
  shadetrade                                  the built-in scene in a window
  shadetrade bench-far --size 800x600         another scene, as `shadetrade view bench-far ...`
  shadetrade render -o cuboid.png             one picture, without a window

If a scene file is named like a command, write ./name."
)]
pub struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    view: ViewOptions,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Opens a window on a scene; without a display, scene and options, draws the figures instead
    #[command(
        mut_arg("size", |argument| argument.help("The size of the window in pixels of 96 to an inch, 1x1 to 16384x16384").default_value("1280x800")),
        after_help = "\
Examples:
  shadetrade view assignment --camera 2 --shading phong
  shadetrade view --set light.white.intensity=20")]
    View(ViewOptions),
    /// Draws one picture into a PNG file
    #[command(after_help = "\
Examples:
  shadetrade render bench-close -o close.png --shading phong --size 1920x1080
  shadetrade render -o - --lights white,ambient > white.png")]
    Render(RenderOptions),
    /// Draws the assignment's figures, and a sheet of them all, into a folder
    #[command(after_help = "Example:\n  shadetrade figures -o pictures")]
    Figures {
        /// The folder for the figures, created if absent
        #[arg(short, long, value_name = "DIR", value_parser = commands::path(), default_value = DEFAULT_FIGURES)]
        output: PathBuf,
    },
    /// Writes the cuboids as Wavefront OBJ with their materials, so that other programs draw the same scene
    #[command(
        mut_arg("size", |argument| argument.hide(true)),
        mut_arg("shading", |argument| argument.hide(true)),
        mut_arg("tolerance", |argument| argument.hide(true)),
        mut_arg("simd", |argument| argument.hide(true)),
        mut_arg("threads", |argument| argument.hide(true)),
        after_help = "\
Examples:
  shadetrade export -o cuboid.obj
  shadetrade export my.toml --normals face -o my.obj

The materials go into a file beside it that ends in .mtl; lights and the camera are comments.")]
    Export(ExportOptions),
    /// Measures the time and the error of every shading method, and names the methods worth their time
    #[command(
        mut_arg("size", |argument| argument.default_value("1920x1080")),
        mut_arg("threads", |argument| argument.help("The number of threads that draw the timed frames, 1 to 1024 [default: 1]")),
        mut_arg("shading", |argument| argument.hide(true).value_parser(options::refuse::<ShadingMode>)),
        mut_arg("tolerance", |argument| argument.hide(true).value_parser(options::refuse::<f64>)),
        after_help = "\
Examples:
  shadetrade trade --quick
  shadetrade trade bench-close -o close --methods gouraud-0.5,phong-0.5

Errors are in levels of 255, against Phong in f64.")]
    Trade(TradeOptions),
    /// Shows the evaluation of one pixel: position, vectors and each term, for Gouraud, Phong and the reference
    #[command(after_help = "\
Example:
  shadetrade probe --pixel 480,300

Levels are unclamped. The rows `drawn` and `bytes` come from the renderer, all else is evaluated in f64.")]
    Probe(ProbeOptions),
    /// Proves, pixel by pixel, that a picture keeps its tolerance
    #[command(after_help = "\
Examples:
  shadetrade prove bench-close --shading phong --tolerance 0.1 -o proof.png
  shadetrade prove --shading phong --picture other.png -o judged.png
  shadetrade prove my.toml --picture class/1.png class/2.png

Encloses the exact levels of every pixel by interval arithmetic. Exit status 1 if one is not proven.
Of a wrong picture the cause is named where it is proven. Several pictures have a line each.")]
    Prove(ProveOptions),
    /// Shows which parts of the shading model a scene requires, with the proven error of leaving each out
    #[command(after_help = "\
Examples:
  shadetrade requires bench-close --shading phong --tolerance 4
  shadetrade requires my.toml -o least.toml

A part is required unless the error of leaving it out is proven to be within the tolerance.
The second table has the fewest segments along an edge with which Gouraud keeps the tolerance.")]
    Requires(RequiresOptions),
    /// Varies a number of the scene, and shows the range in which each method keeps the tolerance
    #[command(after_help = "\
Examples:
  shadetrade vary camera.1.orbit.zoom=1..30            from which distance does per-vertex light do?
  shadetrade vary light.white.position.z=1.1..20 -o lamp   how close may a lamp come to a face?
  shadetrade vary cuboid.emerald.material.shininess=1..1e6 --tolerance 0   how large a shininess does f32 carry?

Every pixel is compared with an interval that encloses its exact level.
Ends are found by bisection, to a hundredth of the range.
Steps are logarithmic where both ends have one sign and a ratio of 10 or more.
Ranges end where nothing is drawn. Those of a camera's zoom are also given as heights of the cuboids in pixels.")]
    Vary(VaryOptions),
    /// Proves scenes with extreme numbers, each built in as `extremes/NAME`
    #[command(after_help = "\
Examples:
  shadetrade extremes --list
  shadetrade extremes eye-inside horizon-1e12

Every pixel is proven as by `prove`, from each camera, in both projections and both modes, at
tolerance 0 and 0.5; of some scenes in fewer pictures. Exit status 1 if an extreme fails.")]
    Extremes(ExtremesOptions),
    /// Plays a lesson in a window, or draws all its steps on a sheet
    #[command(after_help = "\
Examples:
  shadetrade lesson why-the-plane-stays-dull
  shadetrade lesson --list
  shadetrade lesson my-lesson.toml -o lesson.png

A lesson is a TOML file: a scene, and steps with a sentence, values of keys, controls and a question.
docs/lessons.md tells how to write one.")]
    Lesson(LessonOptions),
    /// Prints a completion script for a shell
    #[command(after_help = "Example:\n  shadetrade completions bash > shadetrade.bash")]
    Completions {
        /// The shell
        shell: Shell,
    },
}

impl Command {
    /// Starts the global threads of rayon, which evaluate the reference. The renderer starts its own threads.
    ///
    /// Otherwise rayon would start one per core on first use, and panic if that fails.
    ///
    /// # Errors
    /// If the threads cannot be started.
    pub fn start_threads(&self) -> anyhow::Result<()> {
        let threads = match self {
            // A budget is measured against the reference, and scenes can hold one.
            Command::Render(options) => options.drawing.workers.threads(),
            Command::Prove(options) => options.drawing.workers.threads(),
            Command::Requires(options) => options.drawing.workers.threads(),
            Command::Vary(options) => options.drawing.workers.threads(),
            Command::Extremes(options) => options.workers.threads(),
            Command::Lesson(options) => options.workers.threads(),
            // The reference is not timed, so it may use every core.
            Command::Trade(_) => all_cores(),
            _ => return Ok(()),
        };
        ThreadPoolBuilder::new()
            .num_threads(threads)
            .use_current_thread()
            .build_global()
            .context("cannot start the threads that draw")
    }
}

/// Parses a command line. Prints the help or the version if asked for, and then returns `None`.
///
/// # Errors
/// If the command line is wrong, or the help cannot be printed.
pub fn parse(words: impl IntoIterator<Item = OsString>) -> Result<Option<Command>, Failure> {
    let words: Vec<OsString> = words.into_iter().collect();
    if let Some(error) = mistyped(&words) {
        return Err(Failure::of(&error));
    }
    match Arguments::try_parse_from(words) {
        Ok(Arguments { command, view }) => Ok(Some(command.unwrap_or(Command::View(view)))),
        Err(error) if error.use_stderr() => Err(Failure::of(&error)),
        Err(help) => match help.print().and_then(|()| io::stdout().flush()) {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Work(
                anyhow::Error::from(error).context("cannot write to standard output"),
            )),
            _ => Ok(None),
        },
    }
}

/// The error of a first word that is similar to a command: it would be read as the scene of `view`. No built-in scene's name is
/// similar to a command.
fn mistyped(words: &[OsString]) -> Option<clap::Error> {
    let word = words.get(1)?.to_str()?;
    if word.starts_with('-') || word.contains(['.', '/']) || Path::new(word).exists() {
        return None;
    }
    let commands = Command::augment_subcommands(clap::Command::new("shadetrade"));
    let error = commands.try_get_matches_from(&words[..2]).err()?;
    error.get(ContextKind::SuggestedSubcommand)?;
    Some(error)
}

/// Prints the completion script of `shell` to standard output.
///
/// # Errors
/// If it cannot be written.
pub fn print_completions(shell: Shell) -> anyhow::Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "shadetrade", &mut script);
    Output::Stdout.write(script)
}
