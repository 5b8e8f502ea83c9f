//! A report as `trade.json`, as `trade.md` and as the terminal's table.
//!
//! JSON holds every field of the record. Markdown and the terminal show the figures of `COLUMNS`.

use serde::Serialize;

use super::live::Measurement;
use super::record::{MethodReport, Report};
use super::tables::{self, aligned, wrapped};
use super::timing::BATCHES;
use super::verdict::verdict;
use super::words::{counted, short};

/// A record as JSON text: `trade.json` of a [`Report`].
///
/// # Errors
/// Never in practice: a record has nothing that JSON cannot hold.
pub fn json<T: Serialize>(record: &T) -> anyhow::Result<String> {
    Ok(serde_json::to_string_pretty(record)? + "\n")
}

/// A column of a table for people: its head, and its cell for a method.
type Column = (&'static str, fn(&MethodReport) -> String);

const COLUMNS: [Column; 6] = [
    ("method", |one| one.method.id.to_owned()),
    ("ms a frame", |one| short(Some(one.timing.median))),
    (RANGE, |one| {
        let [low, high] = one.timing.interval.map(|end| short(Some(end)));
        format!("{low} to {high}")
    }),
    ("largest error", |one| short(one.max_error())),
    ("highlight kept", |one| percent(one.accuracy.highlight_kept)),
    ("best trade", |one| {
        if one.on_front { "yes" } else { "" }.to_owned()
    }),
];

/// One batch is a run of its own.
const RANGE: &str = "range of 8 runs";
const _: () = assert!(BATCHES == 8);

/// What a terminal shows: verdict, what was measured and where, the table, and what its columns mean.
pub fn table(report: &Report) -> String {
    let paragraphs = [
        wrapped(&said(report)),
        wrapped(&subject(report)) + "\n" + &wrapped(&place(report)),
        aligned(&head(), &rows(report)),
        wrapped(&stages(report)),
        wrapped(&legend()),
    ];
    paragraphs.join("\n\n") + "\n"
}

/// The same for a README.
pub fn markdown(report: &Report) -> String {
    format!(
        "{}\n\n{}  \n{}  \n`{}`\n\n{}\n{}\n\n{}\n",
        said(report),
        subject(report),
        place(report),
        report.subject.command,
        tables::markdown(&head(), &rows(report)),
        stages(report),
        legend()
    )
}

/// What the measurements come to, in words.
fn said(report: &Report) -> String {
    let measured: Vec<Measurement> = report.methods.iter().map(Measurement::from).collect();
    verdict(&measured)
}

fn head() -> [&'static str; COLUMNS.len()] {
    COLUMNS.map(|(head, _)| head)
}

fn rows(report: &Report) -> Vec<Vec<String>> {
    let row = |one| COLUMNS.map(|(_, cell)| cell(one)).to_vec();
    report.methods.iter().map(row).collect()
}

/// What was measured.
pub(super) fn subject(report: &Report) -> String {
    let covered = counted(report.covered_pixels as usize, "covered pixel");
    format!("{}: {covered}", report.subject.view())
}

/// Where it was measured.
pub(super) fn place(report: &Report) -> String {
    let threads = report.methods.first().map_or(1, |one| one.threads);
    report.subject.place(&counted(threads, "thread"))
}

/// How a frame of the last method divides into stages.
pub(crate) fn stages(report: &Report) -> String {
    let Some(last) = report.methods.last() else {
        return String::new();
    };
    let stage = |(name, ms): &(&str, f64)| format!("{name} {}", short(Some(*ms)));
    let stages: Vec<String> = last.stages.iter().map(stage).collect();
    format!(
        "Stages of {}, in ms: {}.",
        last.method.id,
        stages.join(", ")
    )
}

fn legend() -> String {
    format!(
        "A level is 1/255 of full brightness. ms a frame: the median time of a whole frame; {RANGE}: the least and the \
         greatest median of a run, each a process of its own; times whose ranges overlap are not told apart. Largest error: \
         in levels, against exact Phong in f64. Highlight kept: how much of the highlight of exact Phong is shown where it \
         belongs. Best trade: nothing beats it in error and time both. \
         phong-unit-vectors is evaluated in f64 by its definition: its time is not comparable. trade.json has the other \
         figures."
    )
}

fn percent(share: Option<f64>) -> String {
    share.map_or("-".to_owned(), |share| format!("{:.0} %", 100.0 * share))
}
