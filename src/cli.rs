//! The words of the command line in, one command with checked values out; and how a run ends.
//!
//! Rule: a run ends with status 0 (done), 1 (could not do it) or 2 (the command line or the scene was wrong), and with
//! one paragraph on standard error unless it is 0.

pub mod options;

use std::ffi::{OsStr, OsString};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use anyhow::anyhow;
use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::error::ContextKind;
use clap::{Args, CommandFactory, Parser, Subcommand};
use clap_complete::Shell;

use crate::output::{Output, say};
use crate::{scene, trade};
use options::{DrawingOptions, MOST_PIXELS, WorkerOptions};

/// The command line: a command, or the options of `view` without its name.
#[derive(Debug, Parser)]
#[command(
    name = "shadetrade",
    version,
    about = "Draws lit cuboids with Gouraud and Phong shading, in a window or into PNG files",
    args_conflicts_with_subcommands = true,
    after_help = "\
Examples:
  shadetrade                                  the built-in scene in a window
  shadetrade bench-far --size 800x600         another scene: as `shadetrade view bench-far ...`
  shadetrade figures                          the assignment's figures, into shadetrade-figures
  shadetrade render -o cuboid.png             one picture, without a window

Without a command it does what `view` does. A scene file named like a command is given as ./name."
)]
pub struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    view: DrawingOptions,
}

/// What can be done.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Opens a window on a scene; without a display, draws the figures instead
    #[command(after_help = "\
Examples:
  shadetrade view
  shadetrade view assignment --camera 2 --shading phong
  shadetrade view bench-far --lights white,ambient --projection orthographic

Without a display to open, the built-in scene's figures are drawn, as by `shadetrade figures`.")]
    View(DrawingOptions),
    /// Draws one picture into a PNG file
    #[command(after_help = "\
Examples:
  shadetrade render -o cuboid.png
  shadetrade render bench-close -o close.png --shading phong --size 1920x1080
  shadetrade render -o exact.png --shading phong --tolerance 0 --threads 1
  shadetrade render -o - --lights white,ambient > white.png
  shadetrade render -o truth.png --shading phong --reference

Standard error says what was written, how many pixels were shaded and what a frame takes.")]
    Render(RenderOptions),
    /// Draws the assignment's figures, and a sheet of them all, into a folder
    #[command(after_help = "\
Examples:
  shadetrade figures
  shadetrade figures -o pictures

Drawn from the built-in scene, every pixel exactly, 960x720: Gouraud, Phong, and Phong with
the white and ambient lights alone, each from both cameras; the components of the light; and
a sheet of the six.")]
    Figures(FiguresOptions),
    /// Measures what every shading method costs and how far it errs, and which of them are worth their time
    #[command(
        mut_arg("size", |argument| argument.default_value("1920x1080")),
        mut_arg("threads", |argument| argument.help("How many threads draw the frames that are timed, 1 to 1024 [default: 1; with --scale the most, all cores]")),
        mut_arg("shading", |argument| argument.hide(true)),
        mut_arg("tolerance", |argument| argument.hide(true)),
        after_help = "\
Examples:
  shadetrade trade --quick
  shadetrade trade bench-close -o close
  shadetrade trade assignment --size 640x480 --threads 4 --seconds 5 -o results
  shadetrade trade --scale --quick

Prints a verdict and a table; with -o also writes trade.json, trade.csv, trade.md, trade.svg (error
against time) and an error map of each method. Errors are against exact Phong in f64, in levels.

With --scale it times frames instead: of 480p to 8K (--size times 4/9 to 4), under 1 to 64 lights,
with 1 to 10,000 cuboids, by 1 to all threads. Pixels and threads show the scene. With -o it writes
scale.json, scale.csv, scale.md and scale.svg.")]
    Trade(TradeOptions),
    /// Says what happened at one pixel: position, vectors, every light's term, for Gouraud, Phong and the reference
    #[command(after_help = "\
Examples:
  shadetrade probe --pixel 480,300
  shadetrade probe bench-far --pixel 500,400 --tolerance 0
  shadetrade probe --pixel 480,300 --json > pixel.json

Levels are unclamped; those of `drawn` come from the renderer, all else is evaluated in f64.")]
    Probe(ProbeOptions),
    /// Runs the table of numerical extremes: what each ought to give, what it gives, and whether that is right
    #[command(after_help = "\
Examples:
  shadetrade extremes
  shadetrade extremes --simd fallback
  shadetrade extremes --json > extremes.json

Exit status 1 if a case fails. The largest picture takes a gigabyte of memory while it is drawn.")]
    Extremes(ExtremesOptions),
    /// Prints a completion script for a shell
    #[command(after_help = "\
Examples:
  shadetrade completions bash > shadetrade.bash
  shadetrade completions fish > shadetrade.fish")]
    Completions {
        /// The shell that is to complete
        shell: Shell,
    },
}

/// The options of `render`.
#[derive(Args, Debug)]
pub struct RenderOptions {
    /// What to draw, and how.
    #[command(flatten)]
    pub drawing: DrawingOptions,
    /// Where the PNG goes; `-` is standard output
    #[arg(short, long, value_name = "FILE", value_parser = PathBufValueParser::new().map(Output::from))]
    pub output: Output,
    /// Draws with the f64 reference instead of the renderer; --tolerance and --simd have no say then
    #[arg(long)]
    pub reference: bool,
}

/// The options of `trade`.
#[derive(Args, Debug)]
pub struct TradeOptions {
    /// What is measured; each method has its own shading and tolerance.
    #[command(flatten)]
    pub drawing: DrawingOptions,
    /// The folder for the reports, made if absent
    #[arg(short, long, value_name = "DIR", value_parser = PathBufValueParser::new().try_map(folder))]
    pub output: Option<PathBuf>,
    /// As few samples as a median needs; the same as --seconds 0
    #[arg(long, conflicts_with = "seconds")]
    pub quick: bool,
    /// How long to time frames in all, the reference apart; no less than 30 of each method, with --scale 9 [default: 20]
    #[arg(long, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    pub seconds: Option<Duration>,
    /// Measures time against pixels, lights, cuboids and threads instead
    #[arg(long)]
    pub scale: bool,
}

impl TradeOptions {
    /// What is to be measured.
    ///
    /// # Errors
    /// [`Failure::Usage`] when the scene is wrong, a shading or tolerance is asked for, or a size too large to
    /// scale.
    pub fn request(&self) -> Result<trade::Request, Failure> {
        let given = [
            ("--shading", self.drawing.shading.is_some()),
            ("--tolerance", self.drawing.tolerance.is_some()),
        ];
        if let Some((option, _)) = given.iter().find(|(_, given)| *given) {
            return Err(Failure::Usage(anyhow!(
                "{option} does not go with `trade`, which measures every shading at its own tolerance"
            )));
        }
        let mut drawing = self.drawing.open()?;
        if self.scale {
            let most = MOST_PIXELS / trade::scale::LARGEST;
            if drawing.size.iter().any(|side| *side > most) {
                return Err(Failure::Usage(anyhow!(
                    "--scale draws pictures up to {} times as wide and high as --size, which is {most}x{most} at most then",
                    trade::scale::LARGEST
                )));
            }
        } else if self.drawing.workers.threads.is_none() {
            drawing.threads = 1;
        }
        let time = if self.quick {
            trade::QUICK_TIME
        } else {
            self.seconds.unwrap_or(trade::USUAL_TIME)
        };
        let words: Vec<String> = std::env::args_os()
            .skip(1)
            .map(|word| word.to_string_lossy().into_owned())
            .collect();
        Ok(trade::Request::new(
            drawing,
            time,
            format!("shadetrade {}", words.join(" ")),
        ))
    }
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text
        .parse()
        .ok()
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    seconds
        .filter(|time| time.as_secs() <= 86_400)
        .ok_or_else(|| "it is a number of seconds from 0 to 86400".to_owned())
}

/// The options of `probe`.
#[derive(Args, Debug)]
pub struct ProbeOptions {
    /// What is drawn, and how.
    #[command(flatten)]
    pub drawing: DrawingOptions,
    /// The pixel: x to the right and y down from the top left corner, from 0
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pub pixel: [usize; 2],
    /// Prints one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

fn pixel(text: &str) -> Result<[usize; 2], String> {
    let coordinate = |text: &str| {
        text.parse()
            .map_err(|_| "it is X,Y in whole pixels from 0, such as 480,300".to_owned())
    };
    let (x, y) = text.split_once(',').unwrap_or((text, ""));
    Ok([coordinate(x)?, coordinate(y)?])
}

/// The options of `extremes`.
#[derive(Args, Debug)]
pub struct ExtremesOptions {
    /// Prints a JSON array with `name`, `expected`, `observed` and `pass` of each case
    #[arg(long)]
    pub json: bool,
    /// Who draws.
    #[command(flatten)]
    pub workers: WorkerOptions,
}

/// The options of `figures`.
#[derive(Args, Debug)]
pub struct FiguresOptions {
    /// The folder the figures go to, made if absent
    #[arg(short, long, value_name = "DIR", default_value = DEFAULT_FIGURES,
          value_parser = PathBufValueParser::new().try_map(folder))]
    pub output: PathBuf,
}

/// The folder for figures when none is named.
pub const DEFAULT_FIGURES: &str = "shadetrade-figures";

/// Several files need a folder.
fn folder(path: PathBuf) -> Result<PathBuf, &'static str> {
    match Output::from(path.clone()) {
        Output::File(_) => Ok(path),
        Output::Stdout => Err("it is a folder, not standard output; ./- is a folder of that name"),
    }
}

/// The command of a command line, or none where help or the version was asked for: that is printed already.
///
/// # Errors
/// When the command line is wrong, or help could not be printed.
pub fn parse(words: impl IntoIterator<Item = OsString>) -> Result<Option<Command>, Failure> {
    let mut words: Vec<OsString> = words.into_iter().collect();
    let asks_help = words.get(1).is_some_and(|word| word == "help");
    if asks_help && words.get(2).is_some_and(|word| is_flag(word)) {
        // To clap `help` has no options, not even this one.
        words.remove(1);
    }
    let named = words.get(if asks_help { 2 } else { 1 });
    if let Some(error) = named.and_then(|word| misspelt_command(word)) {
        return Err(Failure::of(&error, None));
    }
    match Arguments::try_parse_from(&words) {
        Ok(Arguments {
            command: Some(command),
            ..
        }) => Ok(Some(command)),
        Ok(Arguments {
            command: None,
            view,
        }) => match &view.scene {
            Some(scene) if is_command(OsStr::new(scene)) => {
                Err(Failure::Usage(anyhow!(command_first(scene))))
            }
            _ => Ok(Some(Command::View(view))),
        },
        Err(error) if error.use_stderr() => Err(wrong(words, error)),
        Err(help) => match help.print().and_then(|()| io::stdout().flush()) {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Work(
                anyhow::Error::from(error).context("cannot write to standard output"),
            )),
            _ => Ok(None),
        },
    }
}

/// What is wrong with a line that clap refuses for `error`.
fn wrong(mut words: Vec<OsString>, error: clap::Error) -> Failure {
    if words.get(1).is_none_or(|word| is_command(word)) {
        return Failure::of(&error, None);
    }
    let meant = words
        .iter()
        .skip(2)
        .find(|word| is_command(word))
        .map(|word| command_first(&word.to_string_lossy()));
    // Clap takes a second scene for a command; spelt out, the line is told what it is.
    words.insert(1, "view".into());
    Failure::of(
        &Arguments::try_parse_from(words).err().unwrap_or(error),
        meant,
    )
}

fn is_command(word: &OsStr) -> bool {
    // Clap adds `help` by itself, and only while parsing.
    word == "help"
        || Arguments::command()
            .get_subcommands()
            .any(|command| command.get_name() == word)
}

fn is_flag(word: &OsStr) -> bool {
    word.to_string_lossy().starts_with('-')
}

fn command_first(command: &str) -> String {
    format!(
        "a command comes before its options: `shadetrade {command} ...`; a scene file so named is ./{command}"
    )
}

/// Clap's error for a first word that resembles a command and can be no scene.
///
/// To clap alone a first word that is no command is a scene, so that `rendr` would be a missing file.
fn misspelt_command(word: &OsStr) -> Option<clap::Error> {
    let path = Path::new(word);
    let is_plain = path.components().count() == 1 && path.extension().is_none();
    if !is_plain || path.exists() || scene::BUILT_IN.iter().any(|(name, _)| *name == word) {
        return None;
    }
    let error = clap::Command::new("shadetrade")
        .subcommands(Arguments::command().get_subcommands().cloned())
        .try_get_matches_from([OsStr::new("shadetrade"), word])
        .err()?;
    error
        .get(ContextKind::SuggestedSubcommand)
        .is_some()
        .then_some(error)
}

/// Prints the completion script of `shell` to standard output.
///
/// # Errors
/// When it cannot be written.
pub fn print_completions(shell: Shell) -> anyhow::Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "shadetrade", &mut script);
    Output::Stdout.write(|writer| writer.write_all(&script))
}

/// Why a run did not do what was asked.
#[derive(Debug)]
pub enum Failure {
    /// The command line or the scene was wrong: status 2.
    Usage(anyhow::Error),
    /// It could not be done: status 1.
    Work(anyhow::Error),
}

impl From<anyhow::Error> for Failure {
    fn from(error: anyhow::Error) -> Self {
        Failure::Work(error)
    }
}

impl Failure {
    /// Clap's error with one more tip, as one paragraph: clap sets its tips and the usage apart with blank lines.
    fn of(error: &clap::Error, tip: Option<String>) -> Self {
        let text = error.render().to_string();
        let tip = tip.map(|tip| format!("  tip: {tip}"));
        let lines = text
            .trim_start_matches("error: ")
            .lines()
            .filter(|line| !line.trim().is_empty());
        Failure::Usage(anyhow!(
            lines.chain(tip.as_deref()).collect::<Vec<_>>().join("\n")
        ))
    }

    /// Says on standard error what went wrong; the status to end with.
    pub fn report(&self) -> ExitCode {
        let (error, status) = match self {
            Failure::Usage(error) => (error, 2),
            Failure::Work(error) => (error, 1),
        };
        say(format!("error: {error:#}").trim_end());
        ExitCode::from(status)
    }
}
