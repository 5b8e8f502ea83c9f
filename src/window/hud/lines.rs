//! The state of the window and the table of bindings -> what the panel and the help say, line by line.
//!
//! Rules: each state is told by shape or words, never by colour alone. The panel has as many lines whatever the state, so
//! that the picture beside it keeps its size.

mod commands;
mod facts;

use std::path::Path;

use super::profile::Plot;
use crate::trade::error_map::Scale;
use crate::window::bindings::{Action, BINDINGS, Section};
use crate::window::session::Session;
use crate::window::views::mode_label;
use commands::commands;

pub use commands::{brightest, tolerance};
pub use facts::{quartiles, shaded_by};

/// The sign before a command that has a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    None,
    /// On or off by itself, filled with this colour (0x00RRGGBB) where it is on.
    Switch(bool, u32),
    /// One of several of which one holds, or none where they differ from cuboid to cuboid.
    Choice(bool),
}

/// A command as it is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// The keys, and what each does; a click on the row does what the last one does.
    pub keys: Vec<(&'static str, Action)>,
    pub mark: Mark,
    pub label: String,
    /// Its state in words; empty where the mark says it all.
    pub state: String,
}

/// One line of a board.
#[derive(Clone, Debug, PartialEq)]
pub enum Line {
    /// The first line: what it is, and of what.
    Title(&'static str, String),
    /// What the next lines have in common.
    Heading(&'static str),
    Command(Command),
    /// Words and numbers whose columns stand below one another.
    Text(String),
    /// A name at the left and its value at the right.
    Fact(&'static str, String),
    /// The same, and something is wrong.
    Alarm(&'static str, String),
    /// A line drawn between what can be clicked and what can be known.
    Rule,
    /// The colours of the error map with errors in levels below them; two rows high.
    Scale(Scale),
    /// The levels along a row of the picture; six rows high.
    Profile(Plot),
    /// Colours (0x00RRGGBB) and what they stand for.
    Swatches(Vec<(u32, String)>),
}

/// The colour of what is on.
pub const ON: u32 = 0x0034_d399;

/// The panel: what is used most, and below it the facts.
pub fn panel(session: &Session) -> Vec<Line> {
    let name = &session.scene.name;
    let file = Path::new(name)
        .file_name()
        .map_or_else(|| name.clone(), |it| it.to_string_lossy().into_owned());
    let mut lines = vec![Line::Title("shadetrade", file)];
    for sections in PANEL {
        lines.extend(under_heading(session, sections, true));
    }
    lines.push(Line::Rule);
    lines.extend(facts::all(session));
    lines
}

/// The sections of the panel, those together that have one heading.
const PANEL: [&[Section]; 4] = [
    &[Section::LIGHTS],
    &[Section::SHADING],
    &[Section::VIEW, Section::CAMERA],
    &[Section::WINDOW, Section::SCENE, Section::MOTION],
];

/// The commands of these sections under the heading of the first: those that the panel has, or all.
fn under_heading(session: &Session, sections: &[Section], panel: bool) -> Vec<Line> {
    let mut lines = vec![Line::Heading(sections[0].0)];
    lines.extend(sections.iter().flat_map(|it| commands(session, *it, panel)));
    lines
}

/// The help: every command there is, in two boards side by side.
pub fn help(session: &Session) -> [Vec<Line>; 2] {
    let mut sections: Vec<Section> = BINDINGS.iter().map(|it| it.section).collect();
    sections.dedup();
    let (left, right) = sections.split_at(5);
    let halves = [("help", "", left), ("", "H or Esc closes it", right)];
    let mut lines = halves.map(|(name, detail, sections)| {
        let mut lines = vec![Line::Title(name, detail.to_owned())];
        for section in sections.chunks(1) {
            lines.extend(under_heading(session, section, false));
        }
        lines
    });
    let mouse = [
        ("click on a row", "does what its key does"),
        ("click on the picture", "probes the pixel"),
        ("drag the picture", "orbits"),
        ("drag divider or light", "moves it"),
        ("wheel", "zooms"),
        ("Ctrl drag", "moves what is magnified"),
    ];
    lines[1].push(Line::Heading("mouse"));
    lines[1].extend(mouse.map(|(name, does)| Line::Fact(name, does.to_owned())));
    lines
}

/// What the window's title says; `panel` is whether there is room for it.
pub fn title(session: &Session, panel: bool) -> String {
    let scene = &session.scene.name;
    let shading = session.shading().map_or("mixed shading", mode_label);
    let projection = session.projection.name();
    let camera = session.name(session.scene.cameras[session.camera()]);
    let hint = match (session.state.panel, panel) {
        (false, _) => "I for the panel, H for help",
        (true, false) => "no room for the panel, H for help",
        (true, true) => "H for help",
    };
    let title = format!("shadetrade: {scene}, {shading}, {projection}, camera {camera} - {hint}");
    // What no window system could show.
    title.replace(char::is_control, " ")
}
