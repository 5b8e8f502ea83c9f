//! A report in; text for a terminal and Markdown out.
//!
//! Rule: pure, at most [`WIDTH`] columns on a terminal as far as names allow, and "-" for what does not exist.

use comfy_table::{CellAlignment, Table, TableComponent, presets};

use super::machine::Machine;
use super::timing::Timing;
use super::verdict::verdict;
use super::{Measurement, Report, flip, front};
use crate::components::{Projection, ShadingMode};

/// Columns of the terminal.
pub const WIDTH: usize = 100;

/// Between two columns of a table.
const GAP: u16 = 2;

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
        report.command,
        markdown_table(&head(), &rows(report)),
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

/// A table for a terminal, its first column to the left and the others to the right.
pub(super) fn aligned(head: &[String], rows: &[Vec<String>]) -> String {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING);
    table.set_style(TableComponent::HeaderLines, '\u{2500}');
    table.set_style(TableComponent::MiddleHeaderIntersections, '\u{2500}');
    table.set_header(head);
    table.add_rows(rows);
    for (index, column) in table.column_iter_mut().enumerate() {
        let gap = if index == 0 { 0 } else { GAP };
        column.set_padding((gap, 0));
        if index > 0 {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table.trim_fmt()
}

/// The same in Markdown.
pub(super) fn markdown_table(head: &[String], rows: &[Vec<String>]) -> String {
    let row = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let rule = format!("|---{}|\n", "|---:".repeat(head.len() - 1));
    let rows: Vec<String> = rows.iter().map(|cells| row(cells)).collect();
    row(head) + &rule + &rows.concat()
}

/// What was measured.
pub(super) fn subject(report: &Report) -> String {
    let [width, height] = report.size;
    format!(
        "{}, camera {}, {}, {width}x{height}: {}",
        report.scene,
        report.camera,
        projection_name(report.projection),
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
    machine(&report.machine, &counted(threads, "thread", "threads"))
}

/// The machine, and how many of its threads drew.
pub(super) fn machine(machine: &Machine, threads: &str) -> String {
    // The name and the number; what follows is a commit.
    let rustc: Vec<&str> = machine.rustc.split(' ').take(2).collect();
    format!(
        "{}, {}, {}, {threads}, {}, {}, {} build",
        machine.cpu,
        counted(machine.cores, "core", "cores"),
        machine.lanes,
        machine.os,
        rustc.join(" "),
        machine.profile
    )
}

/// A number with its noun.
pub(super) fn counted(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
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

/// As the command line calls it.
pub(super) fn projection_name(projection: Projection) -> &'static str {
    match projection {
        Projection::Perspective => "perspective",
        Projection::Orthographic => "orthographic",
    }
}

/// As the command line calls it; the assignment's shortcut is a way to draw Phong.
pub(super) fn mode_name(mode: ShadingMode) -> &'static str {
    match mode {
        ShadingMode::Gouraud => "gouraud",
        ShadingMode::Phong | ShadingMode::UnitVectors => "phong",
    }
}

/// Three digits that matter, or fewer; "-" for what does not exist.
pub(crate) fn short(value: Option<f64>) -> String {
    match value {
        None => "-".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(value) if value < 0.001 => "<0.001".to_owned(),
        Some(value) if value < 1.0 => format!("{value:.3}"),
        Some(value) if value < 10.0 => format!("{value:.2}"),
        Some(value) if value < 100.0 => format!("{value:.1}"),
        Some(value) => format!("{value:.0}"),
    }
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

/// An error in words.
pub(super) fn levels(error: f64) -> String {
    let number = if error < 10.0 {
        short(Some(error))
    } else {
        format!("{error:.0}")
    };
    format!("{number} levels")
}

/// "a", "a and b", "a, b and c".
pub(super) fn listed(clauses: &[String]) -> String {
    match clauses {
        [start @ .., last] if !start.is_empty() => format!("{} and {last}", start.join(", ")),
        _ => clauses.concat(),
    }
}

/// How many times `base` goes into `value`, as text; `None` where it has no end.
pub(super) fn ratio(value: f64, base: f64) -> Option<String> {
    let ratio = value / base;
    ratio.is_finite().then(|| {
        if (0.9..1.1).contains(&ratio) {
            format!("{ratio:.2}")
        } else {
            format!("{ratio:.1}")
        }
    })
}

/// The same words in lines of at most [`WIDTH`] columns, but for longer words.
pub(super) fn wrapped(text: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines.join("\n")
}
