//! The command line: commands, their options and their help.
//!
//! ```text
//! arguments --parse--> Command with checked values (commands, options) --main--> success, or Failure (failure)
//! ```
//! The doc comment of a command or option is its text in `--help`.

mod commands;
mod failure;
pub mod options;

use std::ffi::OsString;
use std::io::{self, ErrorKind, Write};

use anyhow::Context;
use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;
use rayon::ThreadPoolBuilder;

use crate::drawing::all_cores;
use crate::output::Output;
pub use commands::{
    DEFAULT_FIGURES, ExtremesOptions, FiguresOptions, ProbeOptions, ProveOptions, RenderOptions,
    ReplayOptions, RequiresOptions, TradeOptions, ViewOptions,
};
pub use failure::Failure;

/// The command line: a command, or the options of `view` without its name.
#[derive(Debug, Parser)]
#[command(
    name = "shadetrade",
    version,
    about = "Draws lit cuboids with Gouraud and Phong shading, and measures cost and error of each shortcut",
    args_conflicts_with_subcommands = true,
    after_help = "\
Examples:
  shadetrade                                  the built-in scene in a window
  shadetrade bench-far --size 800x600         another scene, as `shadetrade view bench-far ...`
  shadetrade figures                          the assignment's figures, into shadetrade-figures
  shadetrade render -o cuboid.png             one picture, without a window

Without a command it runs `view`. If a scene file is named like a command, write ./name."
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
    /// Opens a window on a scene; without a display, draws the figures instead
    #[command(after_help = "\
Examples:
  shadetrade view
  shadetrade view assignment --camera 2 --shading phong
  shadetrade view --record lesson.log

Without a display, plain `shadetrade` or `shadetrade view` draws the figures instead, as `shadetrade
figures` does. A recording has one event per line; `shadetrade replay` plays it.")]
    View(ViewOptions),
    /// Draws one picture into a PNG file
    #[command(after_help = "\
Examples:
  shadetrade render -o cuboid.png
  shadetrade render bench-close -o close.png --shading phong --size 1920x1080
  shadetrade render -o - --lights white,ambient > white.png
  shadetrade render -o truth.png --shading phong --reference

Prints to standard error the file written, the number of shaded pixels and the time of a frame.")]
    Render(RenderOptions),
    /// Draws the assignment's figures, and a sheet of them all, into a folder
    #[command(after_help = "\
Examples:
  shadetrade figures
  shadetrade figures -o pictures

Draws the built-in scene at tolerance 0 in 960x720: Gouraud, Phong, and Phong with the white and
ambient lights alone, each from both cameras; the components of the light; and a sheet of the six.")]
    Figures(FiguresOptions),
    /// Measures the time and the error of every shading method, and names the methods worth their time
    #[command(
        mut_arg("size", |argument| argument.default_value("1920x1080")),
        mut_arg("threads", |argument| argument.help("The number of threads that draw the timed frames, 1 to 1024 [default: 1]")),
        mut_arg("shading", |argument| argument.hide(true)),
        mut_arg("tolerance", |argument| argument.hide(true)),
        after_help = "\
Examples:
  shadetrade trade --quick
  shadetrade trade bench-close -o close
  shadetrade trade --methods gouraud-0.5,phong-0.5

Prints a verdict and a table. With -o it also writes trade.json, trade.md, trade.svg (error against
time) and an error map of each method. Errors are in levels of 255, against Phong in f64.")]
    Trade(TradeOptions),
    /// Shows the evaluation of one pixel: position, vectors and each term, for Gouraud, Phong and the reference
    #[command(after_help = "\
Examples:
  shadetrade probe --pixel 480,300
  shadetrade probe --pixel 480,300 --json > pixel.json

Levels are unclamped. The row `drawn` comes from the renderer, all else is evaluated in f64.")]
    Probe(ProbeOptions),
    /// Proves, pixel by pixel, that a picture keeps its tolerance
    #[command(after_help = "\
Examples:
  shadetrade prove
  shadetrade prove bench-close --shading phong --tolerance 0.1 -o proof.png
  shadetrade prove --shading phong --picture other.png -o judged.png

Encloses the exact levels of every pixel by interval arithmetic, from the scene's numbers on, and
compares the drawn levels with them. Prints how many pixels are proven, refuted or undecided, how
many are so near an edge that they may show either side, and a bound on the error of the f64
reference. The map shows proven pixels dim, undecided ones yellow and refuted ones red. With --picture
it judges a picture of another program: a byte is proven if it is the rounding of a level within the
tolerance of every value of the enclosure (0.05 level at tolerance 0). Exit status 1 if a pixel is
refuted.")]
    Prove(ProveOptions),
    /// Shows which parts of the shading model a scene requires, with the proven error of leaving each out and its cost
    #[command(after_help = "\
Examples:
  shadetrade requires
  shadetrade requires bench-close --shading phong --tolerance 4
  shadetrade requires my.toml -o least.toml

Leaves out one part at a time: each light, the specular gate (n.l > 0), the normalisation of
interpolated normals, Phong of each cuboid (Gouraud instead), perspective-correct interpolation (linear
on the screen instead), the depth test (the order of the file instead), the near plane, each cuboid,
and f64 (f32 throughout instead). Both pictures are enclosed by interval arithmetic, so the largest
error lies between the two numbers printed. A part is required unless its largest error is proven to be
within the tolerance (0.05 level at tolerance 0).

Then it rounds one stage of the model at a time after each of its operations, with all others in f64: the
fewest bits of significand that keep the tolerance, and whether f16, bf16 and f32 do.

With -o it leaves out several lights, cuboids and Phong of cuboids together as long as the tolerance is
kept, and writes the remaining scene with the active camera alone.")]
    Requires(RequiresOptions),
    /// Proves scenes with extreme numbers, each built in as `extremes/NAME`
    #[command(after_help = "\
Examples:
  shadetrade extremes
  shadetrade extremes eye-inside horizon-1e12
  shadetrade view extremes/horizon-1e12
  shadetrade extremes --chart -o stability

Every pixel is proven as by `prove`: from each camera, in both projections and both modes, at
tolerance 0 and 0.5. Values known from paper are compared, too. The first line of a scene describes
the extreme and the expected picture. Exit status 1 if an extreme fails.

With --chart it sweeps one number of a scene at a time instead: shininess, edge length, aspect,
distance from the origin, distance of the eye and of a light, field of view, intensity, number of
lights. Four evaluations are compared with enclosures of the exact levels: the reference in f32
(textbook-f32) and in f64, and this renderer at tolerance 0 and 0.5. Prints the range in which each keeps
0.05 level (0.5 at tolerance 0.5). With -o it also writes stability.svg and stability.json.")]
    Extremes(ExtremesOptions),
    /// Plays a recording in a window, or draws it into a file
    #[command(after_help = "\
Examples:
  shadetrade replay lesson.log
  shadetrade replay lesson.log -o lesson.apng --idle 5
  shadetrade replay lesson.log --hash --simd fallback

A frame is the window without the times, which differ between machines. All lines with the same time
make one frame. A line may be written by hand:
  2.500 say \"words for the status line\"
A hash covers the picture in the window. It is the same at every SIMD level and with any number of
threads.")]
    Replay(ReplayOptions),
    /// Prints a completion script for a shell
    #[command(after_help = "\
Examples:
  shadetrade completions bash > shadetrade.bash

Put the script into the folder of the shell's completions, or read it in the start-up file:
  echo 'source /path/to/shadetrade.bash' >> ~/.bashrc")]
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
            Command::Render(options) if options.reference => options.drawing.workers.threads(),
            Command::Probe(options) => options.drawing.workers.threads(),
            Command::Prove(options) => options.drawing.workers.threads(),
            Command::Requires(options) => options.drawing.workers.threads(),
            Command::Extremes(options) => options.workers.threads(),
            Command::Replay(options) => options.workers.threads(),
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

/// Prints the completion script of `shell` to standard output.
///
/// # Errors
/// If it cannot be written.
pub fn print_completions(shell: Shell) -> anyhow::Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "shadetrade", &mut script);
    Output::Stdout.write(|writer| writer.write_all(&script))
}
