//! Recordings: the states of a window as lines of text, written as they come and read again.
//!
//! ```text
//! 0.000 scene {"name":"cuboid","scene":{"background":[236.0,238.0,240.0],"cuboid":[...],...}}
//! 0.000 size [960,720]
//! 0.512 patch [{"op":"replace","path":"/light/0/on","value":false}]
//! 1.500 say "words for the status line"
//! ```
//! A patch (RFC 6902) turns the record of the state before into that of the next. Lines of one time make one frame. A last
//! line without an end was cut off and is left out.

use std::fmt::Display;
use std::io::{self, Write};
use std::iter;
use std::sync::Arc;
use std::time::Duration;

use anyhow::{Context, anyhow};
use fearless_simd::Level;
use json_patch::Patch;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::drawing::Drawing;
use crate::scene::{MAX_SIDE, Scene, SceneRecord};

/// The size of a window whose log does not say it, in pixels.
const USUAL_SIZE: [usize; 2] = [960, 720];
/// The latest time of a line: thirty years.
const MAX_TIME: Duration = Duration::from_secs(1_000_000_000);
/// The most letters that an error quotes.
const QUOTED: usize = 40;

/// Writes a log while things happen.
pub struct Recorder {
    writer: Box<dyn Write>,
    name: String,
    state: Option<Arc<SceneRecord>>,
    size: [usize; 2],
}

impl Recorder {
    /// Starts an empty log.
    pub fn new(writer: impl Write + 'static) -> Self {
        Recorder {
            writer: Box::new(writer),
            name: String::new(),
            state: None,
            size: [0, 0],
        }
    }

    /// Notes the state of the window, as far as it differs from the one noted before.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn note(
        &mut self,
        now: Duration,
        name: &str,
        state: &Arc<SceneRecord>,
        size: [usize; 2],
    ) -> io::Result<()> {
        match self.state.replace(Arc::clone(state)) {
            Some(before) if self.name == name => {
                let patch = patch(&before, state)?;
                if !patch.is_empty() {
                    self.line(now, "patch", &patch)?;
                }
            }
            _ => {
                name.clone_into(&mut self.name);
                self.line(now, "scene", &json!({ "name": name, "scene": **state }))?;
            }
        }
        if std::mem::replace(&mut self.size, size) != size {
            self.line(now, "size", &size)?;
        }
        Ok(())
    }

    /// Writes a line at once, so that a program that is killed leaves everything that happened before.
    fn line(&mut self, now: Duration, name: &str, argument: &impl Serialize) -> io::Result<()> {
        let argument = serde_json::to_string(argument)?;
        let line = format!("{:.3} {name} {argument}\n", now.as_secs_f64());
        self.writer.write_all(line.as_bytes())
    }
}

/// The patch that leads from one state to another.
///
/// # Errors
/// When a record cannot be written as JSON.
pub fn patch(before: &SceneRecord, after: &SceneRecord) -> serde_json::Result<Patch> {
    let mut sides = [Value::Null, Value::Null];
    if !std::ptr::eq(before, after) {
        let [one, other] = [before, after];
        keep_different(&mut sides, "background", &one.background, &other.background)?;
        keep_different(&mut sides, "view", &one.view, &other.view)?;
        keep_different_entities(&mut sides, "cuboid", &one.cuboid, &other.cuboid)?;
        keep_different_entities(&mut sides, "light", &one.light, &other.light)?;
        keep_different_entities(&mut sides, "camera", &one.camera, &other.camera)?;
    }
    Ok(json_patch::diff(&sides[0], &sides[1]))
}

fn keep_different<T: PartialEq + Serialize>(
    sides: &mut [Value; 2],
    key: &str,
    before: &T,
    after: &T,
) -> serde_json::Result<()> {
    if before != after {
        sides[0][key] = serde_json::to_value(before)?;
        sides[1][key] = serde_json::to_value(after)?;
    }
    Ok(())
}

/// Entities are compared before they become JSON, which would take longer than a frame for ten thousand of them.
fn keep_different_entities<T: PartialEq + Serialize>(
    sides: &mut [Value; 2],
    kind: &str,
    before: &[T],
    after: &[T],
) -> serde_json::Result<()> {
    if before.len() != after.len() {
        // The array as a whole is replaced.
        sides[0][kind] = Value::Null;
        sides[1][kind] = serde_json::to_value(after)?;
        return Ok(());
    }
    for (index, (before, after)) in before.iter().zip(after).enumerate() {
        if before != after {
            // The path of an array's element is that of an object whose keys are numbers.
            let index = index.to_string();
            sides[0][kind][&index] = serde_json::to_value(before)?;
            sides[1][kind][&index] = serde_json::to_value(after)?;
        }
    }
    Ok(())
}

/// A line's meaning.
#[derive(Debug)]
pub enum Event {
    /// A scene of this name is opened.
    Scene(String, SceneRecord),
    State(SceneRecord),
    /// Of the window, in pixels.
    Size([usize; 2]),
    Say(String),
}

/// Everything that happens at one time.
#[derive(Debug)]
pub struct Frame {
    pub time: Duration,
    /// The time when it is played: pauses are cut.
    pub at: Duration,
    pub events: Vec<Event>,
}

/// A log that was read and is valid.
pub struct Log {
    name: String,
    text: String,
    idle: Duration,
    /// The number of frames.
    pub count: usize,
    /// The largest width and the largest height.
    pub canvas: [usize; 2],
    /// The number of the last line, if it was cut off.
    pub cut_off: Option<usize>,
}

impl Log {
    /// Reads a log that errors call `name`; pauses longer than `idle` are cut to it.
    ///
    /// # Errors
    /// The first mistake, with its place.
    pub fn read(name: &str, bytes: &[u8], idle: Duration) -> anyhow::Result<Log> {
        let text = String::from_utf8_lossy(bytes);
        let (text, rest) = text.split_at(text.rfind('\n').map_or(0, |end| end + 1));
        let mut log = Log {
            name: name.to_owned(),
            text: text.to_owned(),
            idle,
            count: 0,
            canvas: [0, 0],
            cut_off: (!rest.is_empty()).then_some(text.lines().count() + 1),
        };
        let (mut count, mut canvas) = (0, [0, 0]);
        let mut size = None;
        for frame in log.frames() {
            for event in frame?.events {
                if let Event::Size(new) = event {
                    size = Some(new);
                }
            }
            let [width, height] = size.unwrap_or(USUAL_SIZE);
            canvas = [width.max(canvas[0]), height.max(canvas[1])];
            count += 1;
        }
        (log.count, log.canvas) = (count, canvas);
        log.start()?;
        Ok(log)
    }

    /// The frames, in the order of their times.
    pub fn frames(&self) -> impl Iterator<Item = anyhow::Result<Frame>> + '_ {
        let mut reader = Reader::default();
        let lines = (1..).zip(self.text.lines());
        let mut events = lines
            .map(move |(number, line)| {
                reader.read(line).map_err(|(rest, reason)| {
                    let column = line[..line.len() - rest.len()].chars().count() + 1;
                    anyhow!("{}:{number}:{column}: {reason}", self.name)
                })
            })
            .peekable();
        let (mut last, mut at) = (None, Duration::ZERO);
        iter::from_fn(move || {
            let (time, event) = match events.next()? {
                Ok(event) => event,
                Err(error) => return Some(Err(error)),
            };
            at += last.map_or(Duration::ZERO, |last| self.idle.min(time - last));
            last = Some(time);
            let mut frame = Frame {
                time,
                at,
                events: vec![event],
            };
            let is_same = |next: &anyhow::Result<(Duration, Event)>| matches!(next, Ok((next, _)) if *next == time);
            while let Some(Ok((_, event))) = events.next_if(is_same) {
                frame.events.push(event);
            }
            Some(Ok(frame))
        })
    }

    /// The scene and the size at the start.
    fn start(&self) -> anyhow::Result<(Scene, [usize; 2])> {
        let frame = self.frames().next().transpose()?;
        let (mut scene, mut size) = (None, USUAL_SIZE);
        for event in frame.into_iter().flat_map(|frame| frame.events) {
            match event {
                Event::Scene(name, record) => scene = Some(Scene::spawn(name, &record)),
                Event::Size(first) => size = first,
                _ => {}
            }
        }
        let empty = || format!("{}:1:1: found no line, expected `scene`", self.name);
        Ok((scene.with_context(empty)?, size))
    }

    /// The window as it opens, drawn by so many threads at this level.
    ///
    /// # Errors
    /// None, for the log is valid.
    pub fn drawing(&self, threads: usize, level: Level) -> anyhow::Result<Drawing> {
        let (scene, size) = self.start()?;
        Ok(Drawing {
            scene,
            size,
            threads,
            level,
        })
    }
}

/// The rest of a line from its mistake on, and the reason.
type Fault<'a> = (&'a str, String);

/// The time and the state that the lines so far lead to.
#[derive(Default)]
struct Reader {
    time: Duration,
    record: Option<SceneRecord>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct NamedScene {
    name: String,
    scene: SceneRecord,
}

impl Reader {
    fn read<'a>(&mut self, line: &'a str) -> Result<(Duration, Event), Fault<'a>> {
        let (time, rest) = line.split_once(' ').unwrap_or((line, ""));
        let (name, argument) = rest.split_once(' ').unwrap_or((rest, ""));
        let (least, most) = (self.time.as_secs_f64(), MAX_TIME.as_secs());
        self.time = time
            .parse()
            .ok()
            .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
            .filter(|time| (self.time..=MAX_TIME).contains(time))
            .ok_or_else(|| {
                (
                    line,
                    found(time, &format!("seconds from {least} to {most}")),
                )
            })?;
        let event = match (name, &self.record) {
            ("scene", _) => {
                let NamedScene { name, scene } = parsed(argument)?;
                scene.check().map_err(|reason| fault(argument, reason))?;
                self.record = Some(scene.clone());
                Event::Scene(name, scene)
            }
            (_, None) => return Err((rest, found(name, "`scene`, which a recording begins with"))),
            ("patch", Some(record)) => {
                let patch: Patch = parsed(argument)?;
                let record = patched(record, &patch).map_err(|reason| fault(argument, reason))?;
                self.record = Some(record.clone());
                Event::State(record)
            }
            ("size", _) => Event::Size(size(argument)?),
            ("say", _) => Event::Say(parsed(argument)?),
            _ => return Err((rest, found(name, "`scene`, `patch`, `size` or `say`"))),
        };
        Ok((self.time, event))
    }
}

fn patched(record: &SceneRecord, patch: &Patch) -> anyhow::Result<SceneRecord> {
    let mut value = serde_json::to_value(record)?;
    json_patch::patch(&mut value, patch)?;
    let record: SceneRecord = serde_json::from_value(value)?;
    record.check()?;
    Ok(record)
}

fn size(argument: &str) -> Result<[usize; 2], Fault<'_>> {
    let size: [usize; 2] = parsed(argument)?;
    let is_legal = size.iter().all(|side| (1..=MAX_SIDE).contains(side));
    let expected = format!("two numbers from 1 to {MAX_SIDE}");
    is_legal
        .then_some(size)
        .ok_or_else(|| (argument, found(argument, &expected)))
}

fn parsed<T: DeserializeOwned>(text: &str) -> Result<T, Fault<'_>> {
    serde_json::from_str(text).map_err(|error| {
        let reason = error.to_string();
        // The reason ends with a place in `text`, which is one of the log's line.
        let reason = reason.split(" at line ").next().unwrap_or(&reason);
        let rest = text.get(error.column().saturating_sub(1)..);
        (rest.unwrap_or(text), reason.to_owned())
    })
}

fn fault(rest: &str, reason: impl Display) -> Fault<'_> {
    (rest, format!("no scene comes of this: {reason}"))
}

fn found(text: &str, expected: &str) -> String {
    let text: String = text.chars().take(QUOTED).collect();
    format!("found {text:?}, expected {expected}")
}
