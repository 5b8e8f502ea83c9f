//! The table of extreme cases: every number a scene can hold, at the ends of what it can be.
//!
//! ```text
//!   Case { name, expected, judge }
//!      | examine
//!      v
//!   Outcome { name, expected, observed, pass }  -->  a table, JSON, the exit status;  tests/extremes.rs
//! ```
//!
//! Rule: what is right never comes from what is tried. It comes from enclosures of every pixel's exact levels, a value
//! worked out on paper, or the same scene without the extreme; every case says which.

mod camera;
mod crowd;
mod judge;
mod light;
mod numbers;
mod picture;
mod renderer;
mod scene_spec;
mod shape;
pub mod stability;
mod strength;

use anyhow::Context;
use comfy_table::{ContentArrangement, Table, TableComponent, presets};
use fearless_simd::Level;
use serde::Serialize;

use crate::memory;
use crate::output::Output;
use crate::trade::Progress;
use crate::trade::export::json;
use crate::trade::progress::with_bar;
use judge::{Fact, Judge, Known, levels_text};
use renderer::{CaseError, Renderer};
use scene_spec::{RenderConfig, SceneSpec};

/// Bytes that the cases take, without the largest picture, which asks for its own.
const MEMORY: usize = 512 << 20;

/// Columns of the terminal.
const WIDTH: u16 = 120;

/// One extreme.
pub struct Case {
    /// What is extreme.
    pub name: &'static str,
    /// What is right, and what decides it.
    pub expected: String,
    judge: Judge,
}

/// How a case went.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Outcome {
    /// What is extreme.
    pub name: &'static str,
    /// What is right, and what decides it.
    pub expected: String,
    /// What the renderer makes of it, or what is wrong.
    pub observed: String,
    pub pass: bool,
}

/// The cases, in order.
pub fn table() -> Vec<Case> {
    [
        camera::cases(),
        light::cases(),
        shape::cases(),
        strength::cases(),
        crowd::cases(),
        picture::cases(),
        numbers::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// A case whose every pixel is proven in every projection and mode, at every tolerance.
fn proven(name: &'static str, scenes: impl IntoIterator<Item = SceneSpec>) -> Case {
    Case {
        name,
        expected: "every pixel proven".to_owned(),
        judge: Judge::Proven(scenes.into_iter().collect()),
    }
}

/// A case whose scenes have the same bits as the first one, which is not extreme.
fn same_bits(name: &'static str, scenes: impl IntoIterator<Item = SceneSpec>) -> Case {
    Case {
        name,
        expected: "the same bits as without it".to_owned(),
        judge: Judge::SameBits(scenes.into_iter().collect()),
    }
}

/// A case whose scenes are within so many levels of the first one, which is not extreme.
fn same_picture(
    name: &'static str,
    levels: f64,
    scenes: impl IntoIterator<Item = SceneSpec>,
) -> Case {
    Case {
        name,
        expected: format!("within {levels} level of the picture without it"),
        judge: Judge::SamePicture(levels, scenes.into_iter().collect()),
    }
}

/// A case of which one fact is known about every scene, however it is drawn.
fn known(
    name: &'static str,
    expected: &str,
    fact: Fact,
    scenes: impl IntoIterator<Item = SceneSpec>,
) -> Case {
    let known = |scene: SceneSpec| {
        RenderConfig::all().map(move |config| Known {
            scene: scene.clone(),
            config,
            fact,
        })
    };
    Case {
        name,
        expected: expected.to_owned(),
        judge: Judge::Known(scenes.into_iter().flat_map(known).collect()),
    }
}

/// A case of pictures of each of which the levels of one pixel are known.
fn known_pixels(name: &'static str, pictures: impl IntoIterator<Item = Known>) -> Case {
    let pictures: Vec<Known> = pictures.into_iter().collect();
    let levels = pictures.iter().filter_map(|known| match known.fact {
        Fact::Pixel(_, levels) => Some(levels_text(levels)),
        _ => None,
    });
    let levels: Vec<String> = levels.collect();
    Case {
        name,
        expected: format!("on paper {}", levels.join(", ")),
        judge: Judge::Known(pictures),
    }
}

/// A case that is decided by a function of its own.
fn own(
    name: &'static str,
    expected: &str,
    examine: fn(&mut Renderer) -> Result<String, CaseError>,
) -> Case {
    Case {
        name,
        expected: expected.to_owned(),
        judge: Judge::Own(examine),
    }
}

/// Who draws.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    pub level: Level,
    /// At least 1.
    pub threads: usize,
    /// Whether to draw the largest picture at its full size, which takes a gigabyte, and every case in both modes and at
    /// every tolerance, not in one mode by turns and at three.
    pub full: bool,
}

/// Examines every case; `progress` is told how many are done.
///
/// # Errors
/// When the system gives no threads, or not the memory.
pub fn examine(options: Options, progress: &dyn Fn(Progress)) -> anyhow::Result<Vec<Outcome>> {
    if options.full {
        memory::check_for(|| "the table of extremes".to_owned(), MEMORY)?;
    }
    let mut renderer = Renderer::new(options.level, options.threads, options.full)
        .context("cannot start the threads that draw")?;
    let cases = table();
    let outcomes = cases.iter().enumerate().map(|(index, case)| {
        progress(Progress {
            step: "examining extremes",
            share: index as f64 / cases.len() as f64,
        });
        let observed = case.judge.examine(&mut renderer);
        Outcome {
            name: case.name,
            expected: case.expected.clone(),
            pass: observed.is_ok(),
            observed: observed.unwrap_or_else(|error| error.to_string()),
        }
    });
    Ok(outcomes.collect())
}

/// The command: examines every case and prints how it went; how many failed.
///
/// # Errors
/// When the cases could not be examined or the result not be printed.
pub fn run(options: Options, as_json: bool) -> anyhow::Result<usize> {
    let outcomes = with_bar(|progress| examine(options, progress))?;
    let text = if as_json {
        json(&outcomes)?
    } else {
        text(&outcomes) + "\n"
    };
    Output::Stdout.write(|writer| writer.write_all(text.as_bytes()))?;
    Ok(outcomes.iter().filter(|outcome| !outcome.pass).count())
}

/// The outcomes as a table, and how many passed.
pub fn text(outcomes: &[Outcome]) -> String {
    let mut table = Table::new();
    table
        .load_preset(presets::NOTHING)
        .set_style(TableComponent::HeaderLines, '-')
        .set_style(TableComponent::MiddleHeaderIntersections, ' ')
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(WIDTH)
        .set_header(["case", "expected", "observed", ""]);
    for outcome in outcomes {
        let verdict = if outcome.pass { "pass" } else { "FAIL" };
        table.add_row([outcome.name, &outcome.expected, &outcome.observed, verdict]);
    }
    let passed = outcomes.iter().filter(|outcome| outcome.pass).count();
    format!(
        "{}\n\n{passed} of {} pass",
        table.trim_fmt(),
        outcomes.len()
    )
}
