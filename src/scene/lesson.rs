//! Lessons: a scene and steps, each a sentence and values of keys.
//!
//! ```toml
//! scene = "cuboid"             # a built-in scene, or a file beside the lesson
//!
//! [[step]]
//! say = "Light is computed at the corners of each side. Where is the bright spot?"
//! set = { cuboid.emerald.shading = "gouraud", view.tolerance = 0 }
//! show = ["segments", "row"]   # optional: the controls of this step
//! ask = ["in the middle", "nowhere"]      # optional: answers to choose from
//! right = 2                    # the right one, counted from 1
//! then = "Nowhere: no corner lies in it." # the sentence once an answer is chosen
//! ```

use std::path::Path;
use std::sync::Arc;

use serde::Deserialize;
use toml::{Table, Value};

use super::key::Key;
use super::read::{Mistake, located, read};
use super::{Scene, SceneRecord, built_in, read_text, updated};
use crate::components::{ViewMode, Viewer};
use crate::output::words::capital;

/// The built-in lessons, as name (`lessons/NAME`) and text, in the order in which they are read.
pub const LESSONS: [(&str, &str); 5] = [
    (
        "lessons/why-the-plane-stays-dull",
        include_str!("../../assets/lessons/why-the-plane-stays-dull.toml"),
    ),
    (
        "lessons/smooth-or-sharp-edges",
        include_str!("../../assets/lessons/smooth-or-sharp-edges.toml"),
    ),
    (
        "lessons/how-many-vertices",
        include_str!("../../assets/lessons/how-many-vertices.toml"),
    ),
    (
        "lessons/what-a-tolerance-buys",
        include_str!("../../assets/lessons/what-a-tolerance-buys.toml"),
    ),
    (
        "lessons/which-highlight",
        include_str!("../../assets/lessons/which-highlight.toml"),
    ),
];

/// The most letters of a sentence or of an answer.
const MOST_LETTERS: usize = 200;

/// A step of a lesson.
#[derive(Debug)]
pub struct Step {
    /// Its sentence.
    pub say: String,
    pub show: Vec<Control>,
    pub question: Option<Question>,
    /// The scene after this step.
    pub record: Arc<SceneRecord>,
}

/// A control of a step: the last part of the keys that it changes, or the curve along the row of the explained pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Control {
    Shading,
    Normals,
    Segments,
    Tolerance,
    Shininess,
    Intensity,
    /// The switches of the lights.
    On,
    /// The views of the picture.
    Show,
    Row,
}

/// A question that the sentence of a step asks.
#[derive(Debug)]
pub struct Question {
    pub answers: Vec<String>,
    /// The place of the right answer, counted from 0.
    pub right: usize,
    /// The sentence once an answer is chosen.
    pub then: String,
}

/// The file of a lesson.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
struct LessonRecord {
    scene: String,
    #[serde(default)]
    step: Vec<StepRecord>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
struct StepRecord {
    say: String,
    #[serde(default)]
    set: Table,
    #[serde(default)]
    show: Vec<Control>,
    #[serde(default)]
    ask: Vec<String>,
    right: Option<usize>,
    then: Option<String>,
}

/// The title of the lesson of this name or file: `lessons/how-many-vertices` is "How many vertices".
pub fn title(name: &str) -> String {
    let stem = Path::new(name).file_stem().unwrap_or_default();
    capital(&stem.to_string_lossy().replace('-', " "))
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
        let text = read_text(path, "lesson", &LESSONS)?;
        let folder = path.parent().unwrap_or(path);
        Scene::parse_lesson(&path.to_string_lossy(), &text, folder)
    }

    /// Reads the text of a lesson whose scene, if it is a file, is in `folder`. The scene and its errors carry `name`.
    ///
    /// # Errors
    /// If the text is not a valid lesson: the first mistake, with its place.
    pub fn parse_lesson(name: &str, text: &str, folder: &Path) -> anyhow::Result<Scene> {
        let located = |it: Mistake| located(name, text, &it.span(text), &it.why);
        let lesson: LessonRecord = read(name, text)?;
        let own = Path::new(&lesson.scene);
        let path = match built_in(own) {
            Some(_) => own.to_owned(),
            None => folder.join(own),
        };
        let scene = Scene::load_path(&path)
            .map_err(|why| located(Mistake::new("scene", why.to_string())))?;
        let mut record = SceneRecord::of(&scene.world);
        // A lesson begins with the picture, whatever the scene opens with.
        record.view = Viewer {
            show: ViewMode::default(),
            divider: Viewer::default().divider,
            ..record.view
        };
        let step = |(index, step): (usize, StepRecord)| {
            let within = |mistake: Mistake| mistake.within(&index.to_string()).within("step");
            step.applied_to(&mut record)
                .map_err(within)
                .map_err(located)
        };
        let applied = lesson.step.into_iter().enumerate().map(step);
        let steps: Vec<Step> = applied.collect::<Result<_, _>>()?;
        let Some(first) = steps.first().map(|step| Arc::clone(&step.record)) else {
            let why = "expected one or more tables, each headed `[[step]]`";
            return Err(located(Mistake::new("step", why)));
        };
        Ok(Scene {
            text: updated(&scene.text, &first),
            lesson: steps.into(),
            ..Scene::spawn(name.to_owned(), &first)
        })
    }
}

impl StepRecord {
    /// Changes a scene by this step.
    fn applied_to(self, record: &mut SceneRecord) -> Result<Step, Mistake> {
        self.check_texts()?;
        let question = self.question()?;
        let mut values = Vec::new();
        collect(&Key::default(), self.set.into(), &mut values);
        for (key, value) in values {
            key.write(record, value).map_err(|why| {
                let parts = key.parts().iter().rev();
                let mistake = parts.fold(Mistake::new("", why.to_string()), |it, part| {
                    it.within(part)
                });
                mistake.within("set")
            })?;
        }
        record
            .check()
            .map_err(|why| Mistake::new("set", why.to_string()))?;
        Ok(Step {
            say: self.say,
            show: self.show,
            question,
            record: Arc::new(record.clone()),
        })
    }

    /// Refuses a text that is too long to be read above a picture.
    fn check_texts(&self) -> Result<(), Mistake> {
        let answers = self.ask.iter().map(|text| ("ask", text));
        let then = self.then.iter().map(|text| ("then", text));
        for (key, text) in answers.chain(then).chain([("say", &self.say)]) {
            let letters = text.chars().count();
            if letters > MOST_LETTERS {
                let why = format!("a text of {letters} letters, expected at most {MOST_LETTERS}");
                return Err(Mistake::new(key, why));
            }
        }
        Ok(())
    }

    /// The question, if the step asks one.
    fn question(&self) -> Result<Option<Question>, Mistake> {
        let count = self.ask.len();
        match (self.right, &self.then) {
            (None, None) if count == 0 => Ok(None),
            (Some(right @ 1..), Some(then)) if count > 1 && right <= count => Ok(Some(Question {
                answers: self.ask.clone(),
                right: right - 1,
                then: then.clone(),
            })),
            _ => {
                let why = "expected two or more answers, with `right`, the number of one of them from 1 on, and `then`, \
                           the sentence after an answer";
                Err(Mistake::new("ask", why))
            }
        }
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
