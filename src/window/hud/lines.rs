//! The state of the window and the table of bindings -> what the panel and the help say, line by line.
//!
//! Rule: each state is told by shape or words, never by colour alone.

mod commands;
mod facts;

use std::path::Path;

use crate::components::ShadingMode;
use crate::window::bindings::{Action, Section};
use crate::window::session::Session;
use crate::window::views::mode_label;
use commands::{command, commands, label};

pub use commands::tolerance;

/// The sign before a command that has a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// The command has no state.
    None,
    /// On or off by itself, filled with this colour (0x00RRGGBB) where it is on.
    Switch(bool, u32),
    /// One of several of which one holds, or none where they differ from cuboid to cuboid.
    Choice(bool),
}

/// A command as it is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// The keys that call it up.
    pub captions: Vec<&'static str>,
    /// Its state as a sign.
    pub mark: Mark,
    /// What it is called.
    pub label: String,
    /// Its state in words; empty where the sign says it all.
    pub state: String,
    /// What a click does.
    pub action: Action,
}

/// One line of a board.
#[derive(Clone, Debug, PartialEq)]
pub enum Line {
    /// The first line: what it is, and of what.
    Title(&'static str, String),
    /// What the next lines have in common.
    Heading(&'static str),
    /// Something to click.
    Command(Command),
    /// Words and numbers whose columns stand below one another.
    Text(String),
    /// Something to know: its name and its value.
    Fact(&'static str, String),
    /// The same, and something is wrong.
    Alarm(&'static str, String),
    /// A line drawn between what can be clicked and what can be known.
    Rule,
}

/// The colour of what is on.
pub const ON: u32 = 0x0034_d399;

/// The panel: what is used most, and below it the facts.
pub fn panel(session: &Session) -> Vec<Line> {
    let name = &session.scene().name;
    let file = Path::new(name)
        .file_name()
        .map_or_else(|| name.clone(), |it| it.to_string_lossy().into_owned());
    let mut lines = vec![Line::Title("shadetrade", file)];
    for section in Section::ALL {
        let commands: Vec<_> = commands(session, section, true).collect();
        if !commands.is_empty() {
            lines.push(Line::Heading(section.title()));
            lines.extend(commands.into_iter().map(Line::Command));
        }
    }
    lines.push(Line::Rule);
    lines.extend(facts::all(session));
    lines
}

/// The panel where room is short: one row where a key steps through states, which tells the present one.
pub fn brief_panel(session: &Session) -> Vec<Line> {
    let short = |action| command(session, action, 1);
    let named = |action, label: String| Command {
        label,
        state: String::new(),
        ..short(action)
    };
    let lights = (0..session.scene().lights.len()).map(Action::Light);
    let camera = label(session, Action::Camera(session.camera()));
    let mut commands: Vec<Command> = lights.map(short).collect();
    commands.extend([
        short(Action::Shading(ShadingMode::Gouraud)),
        short(Action::Shading(ShadingMode::Phong)),
        named(
            Action::NextTolerance,
            match session.tolerance() {
                0.0 => "exact".to_owned(),
                levels => format!("within {levels}"),
            },
        ),
        named(
            Action::NextProjection,
            session.projection().name().to_owned(),
        ),
        named(Action::NextCamera, format!("camera {camera}")),
        named(Action::NextView, session.view_mode().label().to_owned()),
        short(Action::Panel),
        short(Action::Help),
    ]);
    let mut lines: Vec<Line> = commands.into_iter().map(Line::Command).collect();
    lines.push(Line::Rule);
    lines.extend(facts::brief(session));
    lines
}

/// What stands in for the hidden panel: how to get it back, and the help.
pub fn tab(session: &Session) -> Vec<Line> {
    let wanted = |command: &Command| matches!(command.action, Action::Panel | Action::Help);
    commands(session, Section::Window, true)
        .filter(wanted)
        .map(Line::Command)
        .collect()
}

/// The help: every command there is.
pub fn help(session: &Session) -> Vec<Line> {
    let mut lines = vec![Line::Title("keys", "every row can be clicked".to_owned())];
    for section in Section::ALL {
        lines.push(Line::Heading(section.title()));
        lines.extend(commands(session, section, false).map(Line::Command));
    }
    lines
}

/// What the window's title says.
pub fn title(session: &Session) -> String {
    let scene = &session.scene().name;
    let shading = session.shading().map_or("mixed shading", mode_label);
    let projection = session.projection().name();
    let camera = label(session, Action::Camera(session.camera()));
    let title =
        format!("shadetrade: {scene}, {shading}, {projection}, camera {camera} - H for help");
    // What no window system could show.
    title.replace(char::is_control, " ")
}
