//! Scenes with extreme numbers, and proofs of their pictures.
//!
//! Each file of `assets/extremes` is a scene, built in as `extremes/NAME`. Its first line describes the extreme and the right
//! picture. Every pixel of its pictures is proven: from each camera, in both projections and all modes, exactly and within half a
//! level. `index.toml` lists the exceptions: another size, fewer pictures, and levels known on paper.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

use anyhow::{Context, bail, ensure};
use fearless_simd::Level;
use hecs::World;
use serde::{Deserialize, Serialize};
use serde_json::json;
use toml::Table;

use crate::components::{Camera, Projection, ShadingMode, TriangleId, View, names, viewer_mut};
use crate::output::words::joined;
use crate::output::{Monitor, Output, finished, print};
use crate::questions::prove::{Example, Proof, Verdict, prove_at};
use crate::scene::{EXTREMES, Scene, first_sentence};
use crate::shading::limit;
use crate::systems;
use crate::systems::frame::{Frame, Keep, Workers};

/// The folder of the built-in names.
const FOLDER: &str = "extremes/";

/// Width and height of a picture where the index names none, in pixels.
pub const SIZE: [usize; 2] = [144, 108];

/// The width of a name in a list.
const WIDTH: usize = 36;

/// Every picture is proven at these.
const TOLERANCES: [f64; 2] = [0.0, 0.5];

/// A scene and its expectations, from the index or by default.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Extreme {
    /// The built-in name without the folder.
    #[serde(skip)]
    pub name: &'static str,
    /// Width and height of the pictures in pixels.
    pub size: [usize; 2],
    projections: Vec<Projection>,
    pub modes: Vec<ShadingMode>,
    pub fact: Option<KnownFact>,
}

impl Default for Extreme {
    fn default() -> Self {
        Extreme {
            name: "",
            size: SIZE,
            projections: Projection::ALL.to_vec(),
            modes: ShadingMode::ALL.to_vec(),
            fact: None,
        }
    }
}

/// A property of every picture, known on paper.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum KnownFact {
    /// No cuboid is visible.
    Background,
    /// Only this cuboid is visible, counted from 0 in the order of the file.
    Cuboid(u32),
    /// Each channel of a pixel that shows a cuboid has this level.
    Everywhere(f64),
    /// This pixel has these levels.
    Pixel { at: [usize; 2], levels: [f64; 3] },
}

impl KnownFact {
    /// Whether a pixel may show this cuboid, or the background, with these levels, each within `limit`.
    fn allows(self, pixel: [usize; 2], cuboid: Option<u32>, drawn: [f32; 3], limit: f64) -> bool {
        let has = |levels: [f64; 3]| {
            let mut channels = levels.iter().zip(drawn);
            channels.all(|(level, drawn)| (level - f64::from(drawn)).abs() <= limit)
        };
        match self {
            KnownFact::Background => cuboid.is_none(),
            KnownFact::Cuboid(number) => cuboid.is_none_or(|it| it == number),
            KnownFact::Everywhere(level) => cuboid.is_none() || has([level; 3]),
            KnownFact::Pixel { at, levels } => at != pixel || has(levels),
        }
    }
}

/// The result of an extreme.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Outcome {
    pub name: &'static str,
    pub expected: String,
    /// The largest proven errors, or the first wrong pixel.
    pub observed: String,
    pub pass: bool,
}

/// Every extreme, ordered by name.
///
/// # Panics
/// If the index, which is built in, is wrong.
pub fn table() -> Vec<Extreme> {
    let index = include_str!("../../assets/extremes/index.toml");
    let read = index.parse().and_then(Table::try_into);
    let mut left: BTreeMap<String, Extreme> = read.expect("the index is right");
    let names = EXTREMES
        .iter()
        .map(|(path, _)| path.trim_start_matches(FOLDER));
    let extreme = |name| Extreme {
        name,
        ..left.remove(name).unwrap_or_default()
    };
    let scenes = names.map(extreme).collect();
    assert!(left.is_empty(), "the index names scenes that do not exist");
    scenes
}

/// The extremes of these names, with or without their folder; all if there are none.
///
/// # Errors
/// If there is no extreme of a name.
pub fn named(names: &[String]) -> anyhow::Result<Vec<Extreme>> {
    let mut table = table();
    let own_name = |name: &String| name.trim_start_matches(FOLDER).to_owned();
    let asked: Vec<String> = names.iter().map(own_name).collect();
    let is_missing = |name: &&String| table.iter().all(|it| it.name != **name);
    if let Some(name) = asked.iter().find(is_missing) {
        bail!("no extreme is named {name:?}; `shadetrade extremes --list` names them");
    }
    if !asked.is_empty() {
        table.retain(|extreme| asked.iter().any(|it| it == extreme.name));
    }
    Ok(table)
}

/// The command: proves extremes on rayon's current threads, and prints each outcome once it is known.
///
/// # Errors
/// If one of them fails, or the result cannot be printed.
pub fn run(extremes: &[Extreme], level: Level, as_json: bool) -> anyhow::Result<()> {
    let mut outcomes = Vec::with_capacity(extremes.len());
    for extreme in extremes {
        let outcome = extreme.outcome(level);
        if !as_json {
            Output::Stdout.write(format!("{outcome}\n"))?;
        }
        outcomes.push(outcome);
    }
    let failed = outcomes.iter().filter(|outcome| !outcome.pass).count();
    let passed = outcomes.len() - failed;
    print(&outcomes, as_json, None, || {
        format!("\n{passed} of {} pass", outcomes.len())
    })?;
    ensure!(failed == 0, "{failed} of the extremes fail");
    Ok(())
}

/// The command with `--list`: prints the names, each with what the scene is.
///
/// # Errors
/// If they cannot be printed.
pub fn list(extremes: &[Extreme], as_json: bool) -> anyhow::Result<()> {
    let record = |it: &Extreme| json!({ "name": it.name, "says": it.sentence() });
    let line = |it: &Extreme| format!("{:<WIDTH$}  {}", it.name, it.sentence());
    let records: Vec<_> = extremes.iter().map(record).collect();
    print(&records, as_json, None, || {
        joined(extremes.iter().map(line), "\n")
    })
}

impl Display for Outcome {
    fn fmt(&self, formatter: &mut Formatter) -> fmt::Result {
        let verdict = if self.pass { "pass" } else { "FAIL" };
        let (name, expected, observed) = (self.name, &self.expected, &self.observed);
        write!(
            formatter,
            "{verdict}  {name:<WIDTH$}  {expected}; {observed}"
        )
    }
}

impl Extreme {
    /// The first sentence of the scene's file.
    fn sentence(&self) -> String {
        let mut scenes = EXTREMES.iter();
        let scene = scenes.find(|(path, _)| path.trim_start_matches(FOLDER) == self.name);
        scene.map_or_else(String::new, |(_, text)| first_sentence(text))
    }

    /// Proves the pictures.
    pub fn outcome(&self, level: Level) -> Outcome {
        let observed = self.observe(level);
        Outcome {
            name: self.name,
            expected: self.expected(),
            pass: observed.is_ok(),
            observed: observed.unwrap_or_else(|error| format!("{error:#}")),
        }
    }

    /// The expectation in words.
    fn expected(&self) -> String {
        match self.fact {
            None => "proven".to_owned(),
            Some(KnownFact::Background) => "proven, nothing is seen".to_owned(),
            Some(KnownFact::Cuboid(number)) => format!("proven, cuboid {number} alone"),
            Some(KnownFact::Everywhere(level)) => format!("proven, {level} levels"),
            Some(KnownFact::Pixel { at, levels }) => format!("proven, pixel {at:?} has {levels:?}"),
        }
    }

    /// Proves the pictures and checks the fact. Returns the largest proven errors in words.
    fn observe(&self, level: Level) -> anyhow::Result<String> {
        let mut scene = Scene::load(Some(&format!("{FOLDER}{}", self.name)))?;
        let (mut covered, mut pictures, mut worst) = (0, 0, [0.0_f64; 2]);
        for camera in &names::<Camera>(&scene.world) {
            scene.look_from(camera)?;
            for view in self.views(&mut scene.world) {
                let world = &mut scene.world;
                // No monitor: the progress of one picture among many is not shown.
                let proofs = finished(prove_at(
                    TOLERANCES,
                    world,
                    &view,
                    None,
                    level,
                    Monitor::NONE,
                ))?;
                for (index, (proof, tolerance)) in proofs.iter().zip(TOLERANCES).enumerate() {
                    let view = view.with_tolerance(tolerance);
                    let checked = self.check(proof, world, &view, level);
                    checked.with_context(|| {
                        let mode = view.shading.map_or("", ShadingMode::name);
                        let projection = view.projection.name();
                        format!("camera {camera}, {projection}, {mode}, tolerance {tolerance}")
                    })?;
                    worst[index] = worst[index].max(proof.worst);
                    covered += proof.covered;
                    pictures += 1;
                }
            }
        }
        let [exact, half] = worst;
        Ok(format!(
            "{covered} pixels in {pictures} pictures: {exact:.0e} level at tolerance 0, {half:.2} at 0.5"
        ))
    }

    /// The views of the active camera.
    fn views(&self, world: &mut World) -> Vec<View> {
        let mut views = Vec::new();
        for &projection in &self.projections {
            viewer_mut(world).projection = projection;
            let view = View::of(world, self.size);
            views.extend(self.modes.iter().map(|mode| view.shaded(*mode)));
        }
        views
    }

    /// Checks the proof of a picture, and the fact.
    fn check(
        &self,
        proof: &Proof,
        world: &mut World,
        view: &View,
        level: Level,
    ) -> anyhow::Result<()> {
        // Intervals need not decide a pixel that is known on paper.
        let known = match self.fact {
            Some(KnownFact::Pixel { at, .. }) => Some(at),
            _ => None,
        };
        let mut examples = proof.examples.iter();
        let is_wrong = |it: &&Example| it.verdict == Verdict::Refuted || Some(it.pixel) != known;
        if let Some(wrong) = examples.find(is_wrong) {
            let ([x, y], verdict) = (wrong.pixel, wrong.verdict.name());
            let (drawn, exact) = (wrong.drawn, wrong.enclosure);
            bail!("pixel {x},{y} is {verdict}: drawn {drawn:.4?}, exact {exact:.4?}");
        }
        let Some(fact) = self.fact else {
            return Ok(());
        };
        let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
        systems::draw(world, view, &mut frame)?;
        for (pixel, (id, drawn)) in frame.triangles().iter().zip(frame.levels()).enumerate() {
            let place = [pixel % view.size[0], pixel / view.size[0]];
            let cuboid = (*id != TriangleId::NONE).then_some(id.cuboid());
            ensure!(
                fact.allows(place, cuboid, *drawn, limit(view.tolerance)),
                "pixel {place:?} shows cuboid {cuboid:?}, levels {drawn:?}"
            );
        }
        Ok(())
    }
}
