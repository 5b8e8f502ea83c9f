//! What happens in the window -> a log of it, line by line; a log -> what happened, frame by frame.
//!
//! ```text
//! shadetrade log 1
//! 0.000 start {"name":"cuboid","scene":"...","camera":"1","projection":"perspective",...}
//! 0.512 shading "phong"
//! 1.034 orbit {"azimuth":2.0,"elevation":0.0}
//! 1.500 say "words over the picture"
//! ```
//! Rules: a line is a time in seconds, a name, and what belongs to it as JSON. Lines of one time make one frame. A log holds
//! the scene itself, so that it means the same wherever it is replayed. Its last line counts only when it has ended.

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::Path;
use std::time::Duration;

use anyhow::{Context, bail};
use fearless_simd::Level;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize, Serializer};
use serde_json::{Value, json};

use super::bindings::Action;
use crate::components::{Projection, ShadingMode};
use crate::drawing::{Drawing, MAX_SIDE, is_tolerance};
use crate::scene::{Scene, SceneError};

/// What a log begins with: the format, and its version.
const HEADER: &str = "shadetrade log 1";
/// The latest time of a line: eleven days.
const MAX_TIME: Duration = Duration::from_secs(1_000_000);

/// The window as it opens, what a log begins with.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Start {
    name: String,
    scene: String,
    camera: String,
    projection: Projection,
    shading: Option<ShadingMode>,
    tolerance: f64,
    /// Of the picture, in pixels.
    pub size: [usize; 2],
}

impl Start {
    /// On `drawing`, of its size: the window sets that to what the panel leaves.
    pub fn new(drawing: &Drawing) -> Self {
        Start {
            name: drawing.scene.name.clone(),
            scene: drawing.scene.to_toml(),
            camera: drawing.scene.camera_names().swap_remove(drawing.camera),
            projection: drawing.projection,
            shading: drawing.shading,
            tolerance: drawing.tolerance,
            size: drawing.size,
        }
    }
}

/// What happens, by the name that a log has for it.
#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Event {
    /// The scene's file was read again.
    Scene(#[serde(serialize_with = "write_scene")] Box<Scene>),
    /// The scene's file is wrong, and how.
    SceneError(String),
    /// The picture has another size.
    Size([usize; 2]),
    /// Words are shown.
    Say(String),
    /// Nothing but that time went on.
    Time,
    /// The user did something.
    #[serde(untagged)]
    Action(Action),
}

impl From<Result<Scene, SceneError>> for Event {
    /// What became of the scene's file.
    fn from(read: Result<Scene, SceneError>) -> Self {
        match read {
            Ok(scene) => Event::Scene(Box::new(scene)),
            Err(error) => Event::SceneError(error.to_string()),
        }
    }
}

/// A scene in a log.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneText {
    name: String,
    scene: String,
}

fn write_scene<S: Serializer>(scene: &Scene, serializer: S) -> Result<S::Ok, S::Error> {
    let text = SceneText {
        name: scene.name.clone(),
        scene: scene.to_toml(),
    };
    text.serialize(serializer)
}

/// A log that is written while things happen.
pub struct Recorder {
    file: File,
}

impl Recorder {
    /// Begins a log in a new file.
    ///
    /// # Errors
    /// When there is such a file, or it cannot be written.
    pub fn create(path: &Path, start: &Start) -> io::Result<Recorder> {
        let file = OpenOptions::new().write(true).create_new(true).open(path)?;
        let mut recorder = Recorder { file };
        writeln!(recorder.file, "{HEADER}")?;
        recorder.line(Duration::ZERO, "start", &serde_json::to_string(start)?)?;
        Ok(recorder)
    }

    /// Notes what happened, as far as it can show in the picture or over it.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn note(&mut self, now: Duration, event: &Event) -> io::Result<()> {
        match serde_json::to_value(event) {
            Ok(Value::String(name)) => self.line(now, &name, ""),
            Ok(Value::Object(named)) => named
                .iter()
                .try_for_each(|(name, argument)| self.line(now, name, &argument.to_string())),
            // What says nothing of the picture has no name in a log.
            _ => Ok(()),
        }
    }

    /// Writes a line at once, so that a program that is killed leaves what happened before.
    fn line(&mut self, now: Duration, name: &str, argument: &str) -> io::Result<()> {
        let line = format!("{:.3} {name} {argument}", now.as_secs_f64());
        self.file
            .write_all((line.trim_end().to_owned() + "\n").as_bytes())
    }
}

/// What happened at one time.
pub struct LogFrame {
    pub time: Duration,
    pub events: Vec<Event>,
}

/// A log that was read.
pub struct Log {
    pub start: Drawing,
    /// In the order of their times, the first at the start; never none.
    pub frames: Vec<LogFrame>,
    /// The number of the last line, where it has not ended and so is left out.
    pub cut_off: Option<usize>,
}

impl Log {
    /// The largest width and the largest height of its pictures.
    pub fn canvas(&self) -> [usize; 2] {
        let events = self.frames.iter().flat_map(|frame| &frame.events);
        events.fold(self.start.size, |[width, height], event| match event {
            Event::Size(size) => [width.max(size[0]), height.max(size[1])],
            _ => [width, height],
        })
    }

    /// Reads the log `text`, which errors call `name`, to be replayed by so many threads at this level.
    ///
    /// # Errors
    /// The first thing wrong, with its place.
    pub fn parse(name: &str, text: &str, threads: usize, level: Level) -> anyhow::Result<Log> {
        let (whole, rest) = text.rsplit_once('\n').unwrap_or(("", text));
        let mut lines = (1..).zip(whole.lines());
        if lines.next().is_none_or(|(_, line)| line != HEADER) {
            bail!("{name}:1:1: a recording begins with the line {HEADER:?}");
        }
        let mut start = None;
        let mut frames = vec![LogFrame {
            time: Duration::ZERO,
            events: Vec::new(),
        }];
        for (number, line) in lines {
            let read = match &start {
                Some(_) => read_event(line, &mut frames),
                None => read_start(line, threads, level).map(|read| start = Some(read)),
            };
            if let Err((rest, reason)) = read {
                let column = line[..line.len() - rest.len()].chars().count() + 1;
                bail!("{name}:{number}:{column}: {reason}");
            }
        }
        let last = whole.lines().count() + 1;
        Ok(Log {
            start: start
                .with_context(|| format!("{name}:{last}:1: the line `start` is missing"))?,
            frames,
            cut_off: (!rest.is_empty()).then_some(last),
        })
    }
}

/// The rest of a line from where it is wrong on, and why it is.
type Fault<'a> = (&'a str, String);

fn read_start(line: &str, threads: usize, level: Level) -> Result<Drawing, Fault<'_>> {
    let (_, name, argument) = parts(line)?;
    if name != "start" {
        return Err((line, "the first line is `start`".to_owned()));
    }
    start(argument, threads, level).map_err(|reason| (argument, reason))
}

/// Adds what happened to the last frame, or begins another.
fn read_event<'a>(line: &'a str, frames: &mut Vec<LogFrame>) -> Result<(), Fault<'a>> {
    let (time, name, argument) = parts(line)?;
    let event = event(name, argument).map_err(|reason| (argument, reason))?;
    match frames.last_mut() {
        Some(last) if last.time == time => last.events.push(event),
        Some(last) if last.time > time => return Err((line, "times do not go back".to_owned())),
        _ => frames.push(LogFrame {
            time,
            events: vec![event],
        }),
    }
    Ok(())
}

/// The time, the name and the JSON of a line.
fn parts(line: &str) -> Result<(Duration, &str, &str), Fault<'_>> {
    let (time, rest) = line.split_once(' ').unwrap_or((line, ""));
    let seconds = time.parse().ok();
    let time = seconds
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
        .filter(|time| *time <= MAX_TIME)
        .ok_or_else(|| {
            let most = MAX_TIME.as_secs();
            (line, format!("a line begins with seconds, 0 to {most}"))
        })?;
    let (name, argument) = rest.split_once(' ').unwrap_or((rest, ""));
    if name.is_empty() {
        return Err((rest, "after the time comes what happened".to_owned()));
    }
    Ok((time, name, argument))
}

fn start(argument: &str, threads: usize, level: Level) -> Result<Drawing, String> {
    let start: Start = parsed(argument)?;
    if !is_tolerance(start.tolerance) {
        return Err(format!("no tolerance is {}", start.tolerance));
    }
    let scene = Scene::parse(&start.name, &start.scene).map_err(|error| error.to_string())?;
    let camera = scene.find_camera(&start.camera);
    Ok(Drawing {
        camera: camera.ok_or_else(|| format!("no camera is named {:?}", start.camera))?,
        scene,
        projection: start.projection,
        shading: start.shading,
        tolerance: start.tolerance,
        size: checked(start.size)?,
        threads,
        level,
    })
}

fn event(name: &str, argument: &str) -> Result<Event, String> {
    Ok(match name {
        "scene" => {
            let text: SceneText = parsed(argument)?;
            let scene = Scene::parse(&text.name, &text.scene).map_err(|error| error.to_string())?;
            Event::Scene(Box::new(scene))
        }
        "scene-error" => Event::SceneError(parsed(argument)?),
        "size" => Event::Size(checked(parsed(argument)?)?),
        "say" => Event::Say(parsed(argument)?),
        "time" => Event::Time,
        _ => {
            let action = if argument.is_empty() {
                json!(name)
            } else {
                json!({ name: parsed::<Value>(argument)? })
            };
            Event::Action(serde_json::from_value(action).map_err(|error| {
                let reason = without_line(&error);
                format!("no command, with what belongs to it, as in `light 0`: {reason}")
            })?)
        }
    })
}

fn checked(size: [usize; 2]) -> Result<[usize; 2], String> {
    let fits = size.iter().all(|side| (1..=MAX_SIDE).contains(side));
    fits.then_some(size)
        .ok_or_else(|| format!("a size is 1, 1 to {MAX_SIDE}, {MAX_SIDE}"))
}

fn parsed<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    serde_json::from_str(text).map_err(|error| without_line(&error))
}

/// What JSON's reader says, but for the place: its line is a part of one of ours.
fn without_line(error: &serde_json::Error) -> String {
    let text = error.to_string();
    match text.rsplit_once(" at line ") {
        Some((reason, _)) => reason.to_owned(),
        None => text,
    }
}
