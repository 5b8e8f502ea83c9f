//! Lessons: a scene and steps, each a sentence and values of keys.
//!
//! ```toml
//! scene = "cuboid"             # a built-in scene, or a file beside the lesson
//!
//! [[step]]
//! say = "No vertex lies in the highlight, so Gouraud misses it."
//! set = { cuboid.emerald.shading = "gouraud", view.tolerance = 0 }
//! ```

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use anyhow::anyhow;
use serde::Deserialize;
use toml::{Table, Value};

use super::check::span;
use super::key::Key;
use super::{Scene, SceneRecord, built_in, error, read_text, updated};

/// The built-in lessons, as name (`lessons/NAME`) and text, ordered by name.
pub const LESSONS: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/lessons.rs"));

/// The most letters of a sentence.
const MOST_LETTERS: usize = 200;

/// A step of a lesson.
#[derive(Debug)]
pub struct Step {
    /// Its sentence.
    pub say: String,
    /// The scene after this step.
    pub record: Arc<SceneRecord>,
}

/// The file of a lesson.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
struct LessonRecord {
    scene: String,
    step: Vec<StepRecord>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
struct StepRecord {
    say: String,
    #[serde(default)]
    set: Table,
}

impl Scene {
    /// Loads the built-in lesson of this name, with or without `lessons/`, or else the file at this path: the scene of its
    /// first step.
    ///
    /// # Errors
    /// If the file cannot be read or is not a valid lesson.
    pub fn load_lesson(path: &Path) -> anyhow::Result<Scene> {
        // A path that is joined to `lessons` has another separator on Windows.
        let is_named = |name: &str| {
            let last = name.strip_prefix("lessons/");
            [Some(name), last].contains(&path.to_str())
        };
        if let Some((name, text)) = LESSONS.iter().find(|(name, _)| is_named(name)) {
            return Scene::parse_lesson(name, text, Path::new(""));
        }
        let text = read_text(path, "lesson", LESSONS)?;
        let folder = path.parent().unwrap_or(path);
        Scene::parse_lesson(&path.to_string_lossy(), &text, folder)
    }

    /// Reads the text of a lesson whose scene, if it is a file, is in `folder`. The scene and its errors carry `name`.
    ///
    /// # Errors
    /// If the text is not a valid lesson: the first mistake, with its place.
    pub fn parse_lesson(name: &str, text: &str, folder: &Path) -> anyhow::Result<Scene> {
        let whole = |key| span(text, key, 0, &[""; 0]);
        let located =
            |(span, why): (Range<usize>, String)| anyhow!(error::located(name, text, &span, &why));
        let lesson: LessonRecord = error::read(text).map_err(located)?;
        let own = Path::new(&lesson.scene);
        let path = match built_in(own) {
            Some(_) => own.to_owned(),
            None => folder.join(own),
        };
        let scene = Scene::load_path(&path);
        let scene = scene.map_err(|why| located((whole("scene"), why.to_string())))?;
        let mut record = SceneRecord::of(&scene.world);
        let step = |(index, step): (usize, StepRecord)| {
            let fault = |(keys, why): (Vec<String>, _)| (span(text, "step", index, &keys), why);
            step.applied_to(&mut record).map_err(fault).map_err(located)
        };
        let steps: Vec<Step> = lesson
            .step
            .into_iter()
            .enumerate()
            .map(step)
            .collect::<Result<_, _>>()?;
        let Some(first) = steps.first().map(|step| Arc::clone(&step.record)) else {
            let why = "expected one or more tables, each headed `[[step]]`".to_owned();
            return Err(located((whole("step"), why)));
        };
        Ok(Scene {
            text: updated(&scene.text, &first),
            lesson: steps.into(),
            ..Scene::spawn(name.to_owned(), &first)
        })
    }
}

impl StepRecord {
    /// Changes a scene by this step. An error has the key in the step.
    fn applied_to(self, record: &mut SceneRecord) -> Result<Step, (Vec<String>, String)> {
        let own = |key: &str| vec![key.to_owned()];
        let letters = self.say.chars().count();
        if letters > MOST_LETTERS {
            let why = format!("a sentence of {letters} letters, expected at most {MOST_LETTERS}");
            return Err((own("say"), why));
        }
        let mut values = Vec::new();
        collect(&Key::default(), self.set.into(), &mut values);
        for (key, value) in values {
            let place = || [own("set"), key.parts().to_vec()].concat();
            key.write(record, value)
                .map_err(|why| (place(), why.to_string()))?;
        }
        record
            .check()
            .map_err(|why| (own("set"), why.to_string()))?;
        Ok(Step {
            say: self.say,
            record: Arc::new(record.clone()),
        })
    }
}

/// Collects the keys and values of a step.
fn collect(key: &Key, value: Value, values: &mut Vec<(Key, Value)>) {
    match value {
        Value::Table(table) => {
            table
                .into_iter()
                .for_each(|(part, value)| collect(&key.child(&part), value, values));
        }
        value => values.push((key.clone(), value)),
    }
}
