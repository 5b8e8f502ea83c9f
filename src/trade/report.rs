//! A report in; text for a terminal and Markdown out.
//!
//! Rule: pure; a row for each method, the verdict above them, and "-" for what does not exist.

use super::tables::{self, aligned, wrapped};
use super::timing::Timing;
use super::verdict::verdict;
use super::words::{counted, short};
use super::{Measurement, Report, flip, front};

/// A column of a table for people.
struct Column {
    head: &'static str,
    cell: fn(&Measurement) -> String,
}

const COLUMNS: [Column; 10] = [
    Column {
        head: "method",
        cell: |one| one.method.id.to_owned(),
    },
    Column {
        head: "ms",
        cell: |one| short(Some(one.timing.median)),
    },
    Column {
        head: "\u{b1}",
        cell: |one| uncertainty(&one.timing),
    },
    Column {
        head: "ns/px",
        cell: |one| short(one.ns_per_covered_pixel()),
    },
    Column {
        head: "max",
        cell: |one| short(one.max_error()),
    },
    Column {
        head: "RMSE",
        cell: |one| short(one.accuracy.error.error.map(|error| error.rmse)),
    },
    Column {
        head: "FLIP",
        cell: |one| short(one.accuracy.flip_mean),
    },
    Column {
        head: "own",
        cell: |one| short(one.accuracy.own_error.error.map(|error| error.max)),
    },
    Column {
        head: "kept",
        cell: |one| percent(one.accuracy.highlight_kept),
    },
    Column {
        head: "front",
        cell: |one| if one.on_front { "yes" } else { "" }.to_owned(),
    },
];

/// What a terminal shows: verdict, what was measured and where, the table, and what its columns mean.
pub fn table(report: &Report) -> String {
    let paragraphs = [
        wrapped(&verdict(report)),
        wrapped(&subject(report)) + "\n" + &wrapped(&place(report)),
        aligned(&head(), &rows(report)),
        wrapped(&differences(report)),
        wrapped(&legend()),
    ];
    paragraphs.join("\n\n") + "\n"
}

/// The same for a README.
pub fn markdown(report: &Report) -> String {
    format!(
        "{}\n\n{}  \n{}  \n`{}`\n\n{}\n{}\n\n{}\n",
        verdict(report),
        subject(report),
        place(report),
        report.subject.command,
        tables::markdown(&head(), &rows(report)),
        differences(report),
        legend()
    )
}

fn head() -> Vec<String> {
    COLUMNS.map(|column| column.head.to_owned()).to_vec()
}

fn rows(report: &Report) -> Vec<Vec<String>> {
    let row = |one| COLUMNS.map(|column| (column.cell)(one)).to_vec();
    report.methods.iter().map(row).collect()
}

/// What was measured.
pub(super) fn subject(report: &Report) -> String {
    format!(
        "{}: {}",
        report.subject.view(),
        counted(
            report.covered_pixels as usize,
            "pixel covered",
            "pixels covered"
        )
    )
}

/// Where it was measured.
pub(super) fn place(report: &Report) -> String {
    let threads = report.methods.first().map_or(1, |one| one.threads);
    report.subject.place(&counted(threads, "thread", "threads"))
}

/// Which times cannot be told apart.
fn differences(report: &Report) -> String {
    let timings: Vec<_> = report.methods.iter().map(|one| one.timing).collect();
    let names = |group: &Vec<usize>| -> String {
        let names: Vec<_> = group.iter().map(|i| report.methods[*i].method.id).collect();
        names.join(", ")
    };
    let groups: Vec<String> = front::indistinguishable(&timings)
        .iter()
        .map(names)
        .collect();
    if groups.is_empty() {
        "Every difference in time is measurable.".to_owned()
    } else {
        format!("No measurable difference in time: {}.", groups.join("; "))
    }
}

fn legend() -> String {
    format!(
        "ms: the median time of a whole frame, and how far off it may be. ns/px: the same for each covered pixel. max, \
         RMSE: error in levels of 255 against exact Phong in f64. FLIP: its mean at {:.0} pixels per degree. own: largest \
         error against the method's own definition. kept: how much of the highlight is shown where it belongs. front: \
         nothing beats it in error and time both.",
        flip::PIXELS_PER_DEGREE
    )
}

/// How far the median may be off, in percent of it.
fn uncertainty(timing: &Timing) -> String {
    let percent = 100.0 * (timing.interval()[1] - timing.median) / timing.median;
    match percent {
        _ if !percent.is_finite() => "-".to_owned(),
        100.0.. => format!("{percent:.0}%"),
        _ => format!("{percent:.1}%"),
    }
}

fn percent(share: Option<f64>) -> String {
    share.map_or("-".to_owned(), |share| format!("{:.0} %", 100.0 * share))
}
