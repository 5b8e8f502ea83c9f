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
const FIRST: &str = "`scene`, which a recording begins with";

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

    /// Writes the difference from the state that was noted before.
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
    let (one, other, mut sides) = (before, after, [Value::Null, Value::Null]);
    if !std::ptr::eq(one, other) {
        keep_difference(&mut sides, "background", &one.background, &other.background)?;
        keep_difference(&mut sides, "view", &one.view, &other.view)?;
        keep_differences(&mut sides, "cuboid", &one.cuboid, &other.cuboid)?;
        keep_differences(&mut sides, "light", &one.light, &other.light)?;
        keep_differences(&mut sides, "camera", &one.camera, &other.camera)?;
    }
    Ok(json_patch::diff(&sides[0], &sides[1]))
}

/// Entities are compared before they become JSON, which would take longer than a frame for ten thousand of them.
fn keep_differences<T: PartialEq + Serialize>(
    sides: &mut [Value; 2],
    kind: &str,
    one: &[T],
    other: &[T],
) -> serde_json::Result<()> {
    if one.len() != other.len() {
        // The array as a whole is replaced.
        return keep_difference(sides, kind, &None, &Some(other));
    }
    // The path of an array's element is that of an object whose keys are numbers.
    let mut kept = [Value::Null, Value::Null];
    for (index, (one, other)) in one.iter().zip(other).enumerate() {
        keep_difference(&mut kept, &index.to_string(), one, other)?;
    }
    if kept[0] != Value::Null {
        [sides[0][kind], sides[1][kind]] = kept;
    }
    Ok(())
}

fn keep_difference<T: PartialEq + Serialize>(
    sides: &mut [Value; 2],
    key: &str,
    one: &T,
    other: &T,
) -> serde_json::Result<()> {
    if one != other {
        sides[0][key] = serde_json::to_value(one)?;
        sides[1][key] = serde_json::to_value(other)?;
    }
    Ok(())
}

/// The record that a patch makes of another one.
///
/// # Errors
/// When the patch does not apply, or its result is no valid scene.
pub fn patched(record: &SceneRecord, patch: &Patch) -> anyhow::Result<SceneRecord> {
    let mut value = serde_json::to_value(record)?;
    json_patch::patch(&mut value, patch)?;
    let record: SceneRecord = serde_json::from_value(value)?;
    record.check()?;
    Ok(record)
}

/// The meaning of a line.
pub enum Event {
    /// A scene of this name is opened.
    Scene(Box<NamedScene>),
    Patch(Patch),
    /// Of the window, in pixels.
    Size([usize; 2]),
    Say(String),
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NamedScene {
    pub name: String,
    pub scene: SceneRecord,
}

/// Everything that happens at one time.
pub struct Frame {
    pub time: Duration,
    /// The time when it is played: pauses are cut.
    pub at: Duration,
    pub events: Vec<Event>,
}

/// A log that was read and is valid.
pub struct Log {
    /// In the order of their times, and at least one.
    pub frames: Vec<Frame>,
    /// The number of the last line, if it was cut off.
    pub cut_off: Option<usize>,
    start: Box<NamedScene>,
}

impl Log {
    /// Reads a log that errors call `name`; pauses longer than `idle` are cut to it.
    ///
    /// # Errors
    /// The first mistake, with its place.
    pub fn read(name: &str, bytes: &[u8], idle: Duration) -> anyhow::Result<Log> {
        let text = String::from_utf8_lossy(bytes);
        let (text, rest) = text.split_at(text.rfind('\n').map_or(0, |end| end + 1));
        let (mut frames, mut start, mut state) = (Vec::<Frame>::new(), None, None);
        for (number, line) in (1..).zip(text.lines()) {
            let last = frames.last().map_or(Duration::ZERO, |frame| frame.time);
            let (time, event) = read_line(line, last, &mut state).map_err(|(rest, reason)| {
                let column = line[..line.len() - rest.len()].chars().count() + 1;
                anyhow!("{name}:{number}:{column}: {reason}")
            })?;
            if let (Event::Scene(scene), None) = (&event, &start) {
                start = Some(scene.clone());
            }
            match frames.last_mut() {
                Some(frame) if frame.time == time => frame.events.push(event),
                last => {
                    let at = last.map(|last| last.at + idle.min(time.saturating_sub(last.time)));
                    frames.push(Frame {
                        time,
                        at: at.unwrap_or_default(),
                        events: vec![event],
                    });
                }
            }
        }
        Ok(Log {
            frames,
            cut_off: (!rest.is_empty()).then_some(text.lines().count() + 1),
            start: start.with_context(|| format!("{name}:1:1: {}", found("", FIRST)))?,
        })
    }

    /// The first state, drawn by `threads` threads.
    pub fn drawing(&self, threads: usize, level: Level) -> Drawing {
        let size = self.frames.first().and_then(Frame::size);
        Drawing {
            scene: Scene::spawn(self.start.name.clone(), &self.start.scene),
            size: size.unwrap_or(USUAL_SIZE),
            threads,
            level,
        }
    }
}

impl Frame {
    /// The size that the window gets.
    pub fn size(&self) -> Option<[usize; 2]> {
        let mut sizes = self.events.iter().rev().filter_map(|event| match event {
            Event::Size(size) => Some(*size),
            _ => None,
        });
        sizes.next()
    }
}

/// The rest of a line from its mistake on, and the reason.
type Fault<'a> = (&'a str, String);

/// Reads a line after the time `last`, and changes the state as it says.
fn read_line<'a>(
    line: &'a str,
    last: Duration,
    state: &mut Option<SceneRecord>,
) -> Result<(Duration, Event), Fault<'a>> {
    let (time, rest) = line.split_once(' ').unwrap_or((line, ""));
    let (name, argument) = rest.split_once(' ').unwrap_or((rest, ""));
    let fault = |reason: &dyn Display| (argument, format!("this gives no scene: {reason}"));
    let (least, most) = (last.as_secs_f64(), MAX_TIME.as_secs());
    let time = time
        .parse()
        .ok()
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
        .filter(|time| (last..=MAX_TIME).contains(time))
        .ok_or_else(|| {
            (
                line,
                found(time, &format!("seconds from {least} to {most}")),
            )
        })?;
    let event = match (name, &state) {
        ("scene", _) => {
            let named: NamedScene = parsed(argument)?;
            named.scene.check().map_err(|reason| fault(&reason))?;
            *state = Some(named.scene.clone());
            Event::Scene(Box::new(named))
        }
        (_, None) => return Err((rest, found(name, FIRST))),
        ("patch", Some(record)) => {
            let patch = parsed(argument)?;
            *state = Some(patched(record, &patch).map_err(|reason| fault(&reason))?);
            Event::Patch(patch)
        }
        ("size", _) => {
            let size: [usize; 2] = parsed(argument)?;
            if !size.iter().all(|side| (1..=MAX_SIDE).contains(side)) {
                let expected = format!("two numbers from 1 to {MAX_SIDE}");
                return Err((argument, found(argument, &expected)));
            }
            Event::Size(size)
        }
        ("say", _) => Event::Say(parsed(argument)?),
        _ => return Err((rest, found(name, "`scene`, `patch`, `size` or `say`"))),
    };
    Ok((time, event))
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

fn found(text: &str, expected: &str) -> String {
    let text: String = text.chars().take(QUOTED).collect();
    format!("found {text:?}, expected {expected}")
}
