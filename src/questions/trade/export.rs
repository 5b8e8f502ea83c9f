//! A report as `trade.md` and as the table of the terminal. Both show the figures of `COLUMNS`.

use super::timing::BATCHES;
use super::verdict::verdict;
use super::{LeftOut, Measurement, Report, is_timed};
use crate::output::words::{self, aligned, counted, interval, joined, short, wrapped};

/// The head of a column, and its cell for a method.
type Column = (&'static str, fn(&Measurement) -> String);

const COLUMNS: [Column; 6] = [
    ("method", |one| one.method.id.to_owned()),
    ("ms a frame", |one| timed(one, short(one.timing.median))),
    (RANGE, |one| {
        timed(one, interval(one.timing.interval, short))
    }),
    ("largest error", |one| short(one.largest_error())),
    ("highlight kept", |one| percent(one.highlight_kept)),
    ("best trade", |one| {
        if one.on_front { "yes" } else { "" }.to_owned()
    }),
];

/// A time, or a dash where none was measured.
fn timed(one: &Measurement, text: String) -> String {
    if one.timing.samples > 0 {
        text
    } else {
        "-".to_owned()
    }
}

/// A batch of a report is a run of a process of its own.
const RANGE: &str = "range of 8 runs";
const _: () = assert!(BATCHES == 8);

/// The text for a terminal: the verdict, the view and the machine, the table, and the meaning of its columns.
pub fn table(report: &Report) -> String {
    let mut paragraphs = vec![
        wrapped(&verdict(&report.methods)),
        wrapped(&subject(report)) + "\n" + &wrapped(&place(report)),
        aligned(&head(), rows(report)),
        wrapped(&left_out(report)),
        wrapped(&legend(report)),
    ];
    // The verdict may have nothing to say, and mostly nothing is left out.
    paragraphs.retain(|paragraph| !paragraph.is_empty());
    paragraphs.join("\n\n") + "\n"
}

/// The same text in Markdown, with the command line.
pub fn markdown(report: &Report) -> String {
    let mut left_out = left_out(report);
    if !left_out.is_empty() {
        left_out += "\n\n";
    }
    format!(
        "{}\n\n{}  \n{}  \n`{}`\n\n{}\n{}{} trade.json has the other figures.\n",
        verdict(&report.methods),
        subject(report),
        place(report),
        report.command,
        words::markdown(&head(), rows(report)),
        left_out,
        legend(report)
    )
}

fn head() -> [&'static str; COLUMNS.len()] {
    COLUMNS.map(|(head, _)| head)
}

fn rows(report: &Report) -> impl Iterator<Item = [String; COLUMNS.len()]> {
    let methods = report.methods.iter();
    methods.map(|one| COLUMNS.map(|(_, cell)| cell(one)))
}

/// A sentence for each method that is left out.
fn left_out(report: &Report) -> String {
    let sentence = |it: &LeftOut| format!("{} is left out: {}.", it.method.id, it.reason);
    joined(report.left_out.iter().map(sentence), " ")
}

/// The view in words.
pub fn subject(report: &Report) -> String {
    let pixels = counted(report.covered_pixels as usize, "covered pixel");
    format!("{}: {pixels}", report.heading)
}

/// The machine in words.
pub fn place(report: &Report) -> String {
    let machine = &report.machine;
    let threads = report.methods.first().map_or(1, |one| one.threads);
    // The name and the version, without the commit.
    let rustc: Vec<&str> = machine.rustc.split(' ').take(2).collect();
    format!(
        "{}, {}, {}, {}, {}, {}, {} build",
        machine.cpu,
        counted(machine.cores, "core"),
        machine.lanes,
        counted(threads, "thread"),
        machine.os,
        rustc.join(" "),
        machine.profile
    )
}

fn legend(report: &Report) -> String {
    let note = if report.methods.iter().all(|it| is_timed(it.method)) {
        ""
    } else {
        " Without a time: evaluated in f64 by its definition."
    };
    format!(
        "A level is 1/255 of full brightness. ms a frame: the median time of a whole frame; {RANGE}: the least and the \
         greatest median of a run, each a process of its own. Largest error: \
         in levels, against exact Phong in f64. Highlight kept: how much of the highlight of exact Phong is shown where it \
         belongs. Best trade: no other method is both faster and more exact.{note}"
    )
}

fn percent(share: Option<f64>) -> String {
    share.map_or("-".to_owned(), |share| format!("{:.0} %", 100.0 * share))
}
