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

use std::io::{self, Write};
use std::sync::Arc;
use std::time::Duration;

use anyhow::{Context, anyhow, bail, ensure};
use fearless_simd::Level;
use json_patch::{Patch, PatchOperation};
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::app::reading_time;
use crate::drawing::Drawing;
use crate::scene::{MAX_SIDE, Scene, SceneRecord};

/// In MiB: days of work.
pub const LARGEST: u64 = 256;
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
    /// The name and the state of the scene that was noted last.
    noted: Option<(String, Arc<SceneRecord>)>,
    size: [usize; 2],
}

impl Recorder {
    /// Starts an empty log.
    pub fn new(writer: impl Write + 'static) -> Self {
        Recorder {
            writer: Box::new(writer),
            noted: None,
            size: [0, 0],
        }
    }

    /// Writes the difference from the state that was noted before.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn note(
        &mut self,
        now: Duration,
        name: &str,
        state: &Arc<SceneRecord>,
        size: [usize; 2],
    ) -> io::Result<()> {
        let scene = (name.to_owned(), Arc::clone(state));
        match self.noted.replace(scene) {
            Some((own, before)) if own == name => {
                if before != *state {
                    self.line(now, "patch", &patch(&before, state))?;
                }
            }
            _ => self.line(now, "scene", &json!({ "name": name, "scene": **state }))?,
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
pub fn patch(before: &SceneRecord, after: &SceneRecord) -> Patch {
    json_patch::diff(&json!(before), &json!(after))
}

/// The record that a patch makes of another one.
///
/// # Errors
/// If the patch does not apply, or its result is no valid scene.
pub fn patched(record: &SceneRecord, patch: &Patch) -> anyhow::Result<SceneRecord> {
    let mut value = json!(record);
    json_patch::patch(&mut value, patch)?;
    let record: SceneRecord = serde_path_to_error::deserialize(value)?;
    record.check()?;
    Ok(record)
}

/// The meaning of a line: its name, and its argument as JSON.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Event {
    /// A scene of this name is opened.
    Scene(Box<NamedScene>),
    Patch(Patch),
    /// Of the window, in pixels.
    Size([usize; 2]),
    /// Words for the status line.
    Say(String),
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NamedScene {
    pub name: String,
    pub scene: SceneRecord,
}

/// Everything that happens at one time.
pub struct RecordedFrame {
    pub time: Duration,
    /// The time when it is played: pauses are cut.
    pub at: Duration,
    pub events: Vec<Event>,
}

/// A log that was read and is valid.
pub struct Log {
    /// In the order of their times, and at least one.
    pub frames: Vec<RecordedFrame>,
    /// The number of the last line, if it was cut off.
    pub cut_off: Option<usize>,
    start: Box<NamedScene>,
}

impl Log {
    /// Reads a log that errors call `name`. Pauses longer than `idle` are cut to it, but words get the time to read them.
    ///
    /// # Errors
    /// The first mistake, with its line.
    pub fn read(name: &str, bytes: &[u8], idle: Duration) -> anyhow::Result<Log> {
        let text = String::from_utf8_lossy(bytes);
        let (mut frames, mut start, mut state) = (Vec::<RecordedFrame>::new(), None, None);
        let (mut cut_off, mut read_until) = (None, Duration::ZERO);
        for (number, line) in (1..).zip(text.split_inclusive('\n')) {
            let last = frames.last().map_or(Duration::ZERO, |frame| frame.time);
            let (time, event) = match read_line(line.trim_end(), last, &mut state) {
                Ok(read) => read,
                Err(_) if start.is_some() && !line.ends_with('\n') => {
                    cut_off = Some(number);
                    break;
                }
                Err(reason) => bail!("{name}:{number}: {reason:#}"),
            };
            if let (Event::Scene(scene), None) = (&event, &start) {
                start = Some(scene.clone());
            }
            if frames.last().is_none_or(|last| last.time != time) {
                let at = frames.last().map(|last| {
                    let whole = last.at + time.saturating_sub(last.time);
                    whole.min(read_until.max(last.at + idle))
                });
                frames.push(RecordedFrame {
                    time,
                    at: at.unwrap_or_default(),
                    events: Vec::new(),
                });
            }
            if let Some(frame) = frames.last_mut() {
                if let Event::Say(words) = &event {
                    read_until = frame.at + reading_time(words);
                }
                frame.events.push(event);
            }
        }
        Ok(Log {
            frames,
            cut_off,
            start: start.with_context(|| format!("{name}:1: {}", found("", FIRST)))?,
        })
    }

    /// The size of the largest frame, if the first one has size `first`.
    pub fn canvas(&self, first: [usize; 2]) -> [usize; 2] {
        let sizes = self.frames.iter().filter_map(RecordedFrame::size);
        sizes.fold(first, |[width, height], size| {
            [width.max(size[0]), height.max(size[1])]
        })
    }

    /// The first state, drawn by `threads` threads.
    pub fn drawing(&self, threads: usize, level: Level) -> Drawing {
        let size = self.frames.first().and_then(RecordedFrame::size);
        Drawing {
            scene: Scene::spawn(self.start.name.clone(), &self.start.scene),
            size: size.unwrap_or(USUAL_SIZE),
            threads,
            level,
        }
    }
}

impl RecordedFrame {
    /// The size that the window gets.
    pub fn size(&self) -> Option<[usize; 2]> {
        self.events.iter().rev().find_map(|event| match event {
            Event::Size(size) => Some(*size),
            _ => None,
        })
    }
}

/// Reads a line after the time `last`, and changes the state as it says.
fn read_line(
    line: &str,
    last: Duration,
    state: &mut Option<SceneRecord>,
) -> anyhow::Result<(Duration, Event)> {
    let (time, rest) = line.split_once(' ').unwrap_or((line, ""));
    let (name, argument) = rest.split_once(' ').unwrap_or((rest, ""));
    let seconds = time.parse().ok();
    let known = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    let known = known.filter(|time| (last..=MAX_TIME).contains(time));
    let (least, most) = (last.as_secs_f64(), MAX_TIME.as_secs());
    let expected = || found(time, &format!("seconds from {least} to {most}"));
    let time = known.with_context(expected)?;
    let json = format!("{{{name:?}:{argument}}}");
    let event: Event = serde_json::from_str(&json).map_err(|error| {
        // Its place is one of `json`, not of the log.
        let message = error.to_string();
        let end = message.rfind(" at line ").unwrap_or(message.len());
        anyhow!("{}", &message[..end])
    })?;
    match (&event, &mut *state) {
        (Event::Scene(named), _) => {
            named.scene.check()?;
            *state = Some(named.scene.clone());
        }
        (_, None) => bail!(found(name, FIRST)),
        (Event::Patch(patch), Some(record)) => {
            // Copies of copies could fill the memory, and no recording has any.
            let copies = |change: &PatchOperation| matches!(change, PatchOperation::Copy(_));
            ensure!(!patch.iter().any(copies), "a patch that copies");
            *record = patched(record, patch)?;
        }
        (Event::Size(size), _) => {
            let is_legal = size.iter().all(|side| (1..=MAX_SIDE).contains(side));
            let expected = format!("two numbers from 1 to {MAX_SIDE}");
            ensure!(is_legal, found(argument, &expected));
        }
        (Event::Say(_), _) => {}
    }
    Ok((time, event))
}

fn found(text: &str, expected: &str) -> String {
    let text: String = text.chars().take(QUOTED).collect();
    format!("found {text:?}, expected {expected}")
}
