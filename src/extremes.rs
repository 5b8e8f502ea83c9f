//! The table of extreme cases: every number a scene can hold, at the ends of what it can be.
//!
//! ```text
//!   Case { name, expected, examine }
//!      |
//!      v
//!   Outcome { name, expected, observed, pass }  -->  a table, JSON, the exit status;  tests/it/extremes.rs
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
use crate::output::print;
use crate::trade::progress::{OnProgress, with_bar};
use renderer::Renderer;

/// Bytes that the cases take, without the largest picture, which asks for its own.
const MEMORY: usize = 512 << 20;

/// Columns of the terminal.
const WIDTH: u16 = 120;

/// Says what was observed, or what is wrong.
type Examine = Box<dyn Fn(&mut Renderer) -> anyhow::Result<String> + Send + Sync>;

/// One extreme.
pub struct Case {
    /// What is extreme.
    pub name: &'static str,
    /// What is right, and what decides it.
    pub expected: String,
    examine: Examine,
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

/// A case that a function decides, which says what it observed.
fn case(
    name: &'static str,
    expected: impl Into<String>,
    examine: impl Fn(&mut Renderer) -> anyhow::Result<String> + Send + Sync + 'static,
) -> Case {
    Case {
        name,
        expected: expected.into(),
        examine: Box::new(examine),
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

/// Examines the cases.
///
/// # Errors
/// When the system gives no threads, or not the memory.
pub fn examine(
    cases: &[Case],
    options: Options,
    on_progress: OnProgress,
) -> anyhow::Result<Vec<Outcome>> {
    if options.full {
        memory::check_for("the table of extremes", MEMORY)?;
    }
    let mut renderer = Renderer::new(options.level, options.threads, options.full)
        .context("cannot start the threads that draw")?;
    let outcomes = cases.iter().enumerate().map(|(index, case)| {
        on_progress("examining extremes", index as f64 / cases.len() as f64);
        let observed = (case.examine)(&mut renderer);
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
    let outcomes = with_bar(|progress| examine(&table(), options, progress))?;
    print(&outcomes, as_json, || text(&outcomes))?;
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
