//! shadetrade: parses the command line, runs one command and reports its error.

use std::path::Path;
use std::process::ExitCode;

use anyhow::anyhow;

use shadetrade::cli::{
    self, Command, ExtremesOptions, Failure, LessonOptions, ProbeOptions, ViewOptions,
};
use shadetrade::output::{self, Output};
use shadetrade::questions::{export, extremes, figures, probe, prove, requires, trade, vary};
use shadetrade::scene::{LESSONS, first_sentence};
use shadetrade::window::{self, NoWindow};

fn main() -> ExitCode {
    match cli::parse(std::env::args_os()).and_then(run) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

fn run(command: Option<Command>) -> Result<(), Failure> {
    let Some(command) = command else {
        return Ok(());
    };
    command.start_threads()?;
    match command {
        Command::View(options) => return view(&options),
        Command::Lesson(options) => return lesson(&options),
        Command::Extremes(options) => return extremes(&options),
        Command::Probe(options) => return probe(&options),
        Command::Render(options) => {
            let mut drawing = options.drawing.open(Some(&options.output))?;
            options.budget.apply_to(&mut drawing);
            if options.reference {
                figures::render_reference(&mut drawing, &options.output)
            } else {
                figures::render(&mut drawing, &options.output)
            }
        }
        Command::Trade(options) if options.batch => trade::batch::run(),
        Command::Trade(options) => trade::run(&options.request()?, options.output.as_deref()),
        Command::Prove(options) => {
            let map = options.output.as_ref();
            let mut drawing = options.drawing.open(map)?;
            if let Some(pictures) = options.pictures()? {
                prove::command::run_all(&mut drawing, pictures, options.json)
            } else {
                let picture = options.read_picture()?;
                prove::command::run(&mut drawing, picture.as_ref(), map, options.json)
            }
        }
        Command::Requires(options) => {
            let least = options.output.as_ref();
            requires::command::run(&options.drawing.open(least)?, least, options.json)
        }
        Command::Vary(options) => {
            let folder = options.output.as_deref();
            vary::run(&options.request()?, folder, options.json)
        }
        Command::Export(options) => {
            let (drawing, path) = options.open()?;
            export::run(&drawing, path)
        }
        Command::Figures { output } => figures::figures(&output),
        Command::Completions { shell } => cli::print_completions(shell),
    }?;
    Ok(())
}

/// Proves or lists extremes.
fn extremes(options: &ExtremesOptions) -> Result<(), Failure> {
    let level = options.workers.simd;
    let chosen = extremes::named(&options.names).map_err(Failure::Usage)?;
    if options.list {
        return Ok(extremes::list(&chosen, options.json)?);
    }
    Ok(extremes::run(&chosen, level, options.json)?)
}

/// Prints the evaluation of a pixel.
fn probe(options: &ProbeOptions) -> Result<(), Failure> {
    let mut drawing = options.drawing.open(None)?;
    let ([x, y], [width, height]) = (options.pixel, drawing.size);
    if x >= width || y >= height {
        return Err(Failure::Usage(anyhow!(
            "pixel {x},{y} is outside the picture, whose pixels are 0,0 to {},{}; --size makes it larger",
            width - 1,
            height - 1
        )));
    }
    let (view, level) = (drawing.view(), drawing.level);
    let probe = probe::at(&mut drawing.scene, &view, [x, y], level).map_err(anyhow::Error::from)?;
    let text = || probe.lines().join("\n");
    Ok(output::print(&probe.json(), options.json, None, text)?)
}

/// Opens the window. Without a display it draws the figures if the command has no options.
fn view(options: &ViewOptions) -> Result<(), Failure> {
    // Before the scene is read: a pipe can be read only once.
    window::restart_in_fit_environment()?;
    let is_plain = std::env::args_os().skip(1).all(|word| word == "view");
    let mut drawing = options.drawing.open(None)?;
    options.budget.apply_to(&mut drawing);
    let scene = output::one_line(output::quoted(&drawing.scene.name));
    let closed = window::run(drawing);
    if let Err(missing) = &closed
        && let Some(NoWindow::NoDisplay(_)) = missing.downcast_ref()
        && is_plain
    {
        output::say(&format!("{missing}; drawing the figures instead"));
        return Ok(figures::figures(Path::new(cli::DEFAULT_FIGURES))?);
    }
    let render = format!("render {scene} -o FILE.png` draws a picture");
    Ok(closed.map_err(|error| advise(error, &render))?)
}

/// Names a command that needs no window, if none can be opened.
fn advise(error: anyhow::Error, instead: &str) -> anyhow::Error {
    if error.is::<NoWindow>() {
        return anyhow!("{error}; `shadetrade {instead} without one");
    }
    error
}

/// Plays a lesson in a window, draws it into a file, or lists those that are built in.
fn lesson(options: &LessonOptions) -> Result<(), Failure> {
    if options.list {
        let name = |name: &'static str| name.trim_start_matches("lessons/");
        let lines = LESSONS.map(|it| format!("{:<26}{}", name(it.0), first_sentence(it.1)));
        return Ok(Output::Stdout.write(lines.join("\n") + "\n")?);
    }
    let Some(output) = &options.output else {
        window::restart_in_fit_environment()?;
        let drawing = options.open()?;
        let name = output::quoted(&drawing.scene.name);
        let draw = format!("lesson {name} -o FILE.png` draws it");
        return Ok(window::run(drawing).map_err(|error| advise(error, &draw))?);
    };
    Ok(window::lesson::draw(&options.open()?, output)?)
}
