//! The table of extreme cases: every number a scene can hold, at the ends of what it can be.
//!
//! ```text
//!   Case { name, rule }        rule: what decides, and what is decided
//!      | examine
//!      v
//!   Outcome { name, expected, observed, pass }  -->  a table, JSON, the exit status;  tests/extremes.rs
//! ```
//!
//! Rule: what is right never comes from what is tried. It is what encloses every pixel's exact levels, a value worked out
//! on paper, coverage decided in 128 bits, or the same scene without the extreme; and every case says so itself.

mod bench;
mod camera;
pub mod coverage;
mod crowd;
mod light;
mod numbers;
mod picture;
mod setting;
mod shape;
pub mod stability;
mod strength;

use anyhow::Context;
use comfy_table::{ContentArrangement, Table, TableComponent, presets};
use fearless_simd::Level;
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};

use crate::components::Projection;
use crate::output::Output;
use crate::shading::EXACT;
use bench::{Bench, Distance, Trouble, enough, ways};
use setting::{Setting, Way};

/// Columns of the terminal.
const WIDTH: u16 = 120;

/// One extreme.
pub struct Case {
    /// What is extreme.
    pub name: &'static str,
    rule: Rule,
}

/// What decides whether a case is right.
enum Rule {
    /// Enclosures: every pixel of each setting is proven in every projection and mode, at every tolerance.
    Proven(fn() -> Vec<Setting>),
    /// Paper: nothing is seen of any of the settings in these projections.
    Nothing(&'static [Projection], fn() -> Vec<Setting>),
    /// The same scene without the extreme, which comes first: the others have its very bits.
    SameBits(fn() -> Vec<Setting>),
    /// The same scene without the extreme, which comes first: the others are so many levels from it at most.
    SamePicture(f64, fn() -> Vec<Setting>),
    /// Paper: a pixel's levels.
    Known(fn() -> Vec<Known>),
    /// Something of its own: what, in words, and how it went.
    Own(&'static str, fn(&mut Bench) -> Result<String, Trouble>),
}

/// A pixel whose levels are known.
struct Known {
    setting: Setting,
    way: Way,
    pixel: [usize; 2],
    levels: [f64; 3],
}

/// How a case went.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// What is extreme.
    pub name: &'static str,
    /// What is right, and what decides it.
    pub expected: String,
    /// What the renderer makes of it.
    pub observed: String,
    /// Whether that is right.
    pub pass: bool,
}

/// The cases, in order.
pub fn table() -> impl Iterator<Item = &'static Case> {
    [
        camera::CASES,
        light::CASES,
        shape::CASES,
        strength::CASES,
        crowd::CASES,
        picture::CASES,
        coverage::CASES,
        numbers::CASES,
    ]
    .into_iter()
    .flatten()
}

/// Who draws.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The SIMD instructions.
    pub level: Level,
    /// At least 1.
    pub threads: usize,
    /// Whether to draw the largest picture at its full size, which takes a gigabyte, and every case in both modes and at every
    /// tolerance, not in one mode by turns and at three.
    pub full: bool,
}

/// Examines every case; `progress` hears the name of the next one.
///
/// # Errors
/// When the system gives no threads.
pub fn examine(options: Options, progress: &dyn Fn(&'static str)) -> anyhow::Result<Vec<Outcome>> {
    let mut bench = Bench::new(options.level, options.threads, options.full)
        .context("cannot start the threads that draw")?;
    let outcomes = table().map(|case| {
        progress(case.name);
        case.examine(&mut bench)
    });
    Ok(outcomes.collect())
}

/// The command: examines every case and prints how it went; how many failed.
///
/// # Errors
/// When the cases could not be examined or the result not be printed.
pub fn run(options: Options, as_json: bool) -> anyhow::Result<usize> {
    let bar = ProgressBar::new(table().count() as u64).with_style(
        ProgressStyle::with_template("{msg:40!} {wide_bar} {pos}/{len}")
            .context("the progress bar's template is wrong")?,
    );
    let outcomes = examine(options, &|name| {
        bar.set_message(name);
        bar.inc(1);
    })?;
    bar.finish_and_clear();
    let text = if as_json {
        json(&outcomes)
    } else {
        text(&outcomes)
    };
    Output::Stdout.write(|writer| writeln!(writer, "{text}"))?;
    Ok(outcomes.iter().filter(|outcome| !outcome.pass).count())
}

/// The outcomes as a JSON array of objects with `name`, `expected`, `observed` and `pass`.
pub fn json(outcomes: &[Outcome]) -> String {
    let objects: Vec<Value> = outcomes
        .iter()
        .map(|outcome| {
            json!({
                "name": outcome.name,
                "expected": outcome.expected,
                "observed": outcome.observed,
                "pass": outcome.pass,
            })
        })
        .collect();
    format!("{:#}", Value::Array(objects))
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

impl Case {
    /// Examines it.
    fn examine(&self, bench: &mut Bench) -> Outcome {
        let observed = self.rule.examine(bench);
        Outcome {
            name: self.name,
            expected: self.rule.expected(),
            pass: observed.is_ok(),
            observed: observed.unwrap_or_else(|trouble| trouble.to_string()),
        }
    }
}

impl Rule {
    fn expected(&self) -> String {
        match self {
            Rule::Proven(_) => "every pixel proven".to_owned(),
            Rule::Nothing(..) => "nothing is seen".to_owned(),
            Rule::SameBits(_) => "the same bits as without it".to_owned(),
            Rule::SamePicture(levels, _) => {
                format!("within {levels} level of the picture without it")
            }
            Rule::Known(known) => {
                let known = known();
                let levels: Vec<String> = known.iter().map(|known| three(known.levels)).collect();
                format!("on paper {}", levels.join(", "))
            }
            Rule::Own(expected, _) => (*expected).to_owned(),
        }
    }

    fn examine(&self, bench: &mut Bench) -> Result<String, Trouble> {
        match self {
            Rule::Proven(settings) => {
                let mut distance = Distance::default();
                for (turn, setting) in settings().iter().enumerate() {
                    distance += bench.proven(setting, turn)?;
                }
                Ok(format!(
                    "{} pixels, {} on edges: {:.1e} levels at 0, else up to {:.0} % of the tolerance",
                    distance.covered,
                    distance.outline,
                    distance.exact,
                    100.0 * distance.share
                ))
            }
            Rule::Nothing(projections, settings) => {
                for setting in settings() {
                    for way in ways().filter(|way| projections.contains(&way.projection)) {
                        bench.expect_nothing(&setting, way)?;
                    }
                }
                Ok("nothing".to_owned())
            }
            Rule::SameBits(settings) => {
                let (settings, mut seen) = (settings(), 0);
                for way in ways() {
                    let expected = bench.picture(&settings[0], way)?;
                    seen += expected.seen();
                    for (index, setting) in settings.iter().enumerate().skip(1) {
                        if let Some(pixel) = bench.picture(setting, way)?.first_other(&expected) {
                            let what = format!("pixel {pixel} of scene {index} differs, {way:?}");
                            return Err(Trouble::Wrong(what));
                        }
                    }
                }
                enough(seen)?;
                Ok(format!(
                    "the same: {seen} pixels, {} scenes",
                    settings.len()
                ))
            }
            Rule::SamePicture(levels, settings) => {
                let (settings, mut worst) = (settings(), 0.0_f64);
                for way in ways() {
                    for setting in &settings[1..] {
                        worst = worst
                            .max(bench.difference([(&settings[0], way), (setting, way)], *levels)?);
                    }
                }
                Ok(format!("{worst:.2e} levels in {} scenes", settings.len()))
            }
            Rule::Known(known) => {
                let known = known();
                let found: Result<Vec<String>, Trouble> =
                    known.iter().map(|known| known.examine(bench)).collect();
                Ok(found?.join(", "))
            }
            Rule::Own(_, examine) => examine(bench),
        }
    }
}

impl Known {
    fn examine(&self, bench: &mut Bench) -> Result<String, Trouble> {
        let drawn = bench.picture(&self.setting, self.way)?;
        let [x, y] = self.pixel;
        let levels = drawn.levels[y * self.setting.size[0] + x];
        let found = three(levels.map(f64::from));
        let right = levels
            .iter()
            .zip(self.levels)
            .all(|(level, expected)| (f64::from(*level) - expected).abs() <= EXACT);
        if right {
            Ok(found)
        } else {
            Err(Trouble::Wrong(format!(
                "{found} at {x},{y}, {:?}",
                self.way
            )))
        }
    }
}

fn three(levels: [f64; 3]) -> String {
    let [red, green, blue] = levels.map(|level| format!("{level:.3}"));
    if red == green && green == blue {
        red
    } else {
        format!("({red} {green} {blue})")
    }
}
