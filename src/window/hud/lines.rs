//! The state of the window and the table of bindings -> what the panel and the help say, line by line.
//!
//! Rule: a command is shown with every key that calls it up and with its present state, and each state is told by shape
//! or words, never by colour alone.

use std::path::Path;

use glam::DVec3;
use hecs::Entity;

use crate::components::{Projection, ShadingMode};
use crate::trade::words::short;
use crate::window::bindings::{Action, BINDINGS, Binding, Section};
use crate::window::examiner::{Errors, Findings};
use crate::window::session::Session;
use crate::window::views::{ViewMode, mode_label};

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
    lines.extend(facts(session));
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
    let max_error = errors(session, |it| it.errors, |errors| short_error(errors.max));
    let mut lines: Vec<Line> = commands.into_iter().map(Line::Command).collect();
    lines.push(Line::Rule);
    lines.push(Line::Fact("frame", frame_time(session)));
    lines.push(Line::Fact("max error", max_error));
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

/// The commands of a section: those that the panel has, or all.
fn commands(session: &Session, section: Section, panel: bool) -> impl Iterator<Item = Command> {
    let shown = if panel { 1 } else { usize::MAX };
    choices(session, section)
        .into_iter()
        .filter(move |&action| {
            // What the table has no key for, such as a tenth light, has nothing but its row.
            !panel
                || bindings(session, action)
                    .next()
                    .is_none_or(|binding| binding.on_panel)
        })
        .map(move |action| command(session, action, shown))
}

/// The command of `action`, each of its bindings with at most so many of its keys.
fn command(session: &Session, action: Action, keys: usize) -> Command {
    let (mark, state) = state(session, action);
    Command {
        captions: bindings(session, action)
            .flat_map(|it| it.captions.iter().take(keys).copied())
            .collect(),
        mark,
        label: label(session, action),
        state,
        action,
    }
}

/// The rows of the table whose keys lead to what the row of `shown` does.
fn bindings(session: &Session, shown: Action) -> impl Iterator<Item = &'static Binding> {
    BINDINGS
        .iter()
        .filter(move |binding| serves(session, binding.action, shown))
}

/// What can be clicked in a section: where a key steps through several states, each of them.
fn choices(session: &Session, section: Section) -> Vec<Action> {
    match section {
        Section::Lights => (0..session.scene().lights.len())
            .map(Action::Light)
            .collect(),
        Section::Camera => (0..session.scene().cameras.len())
            .map(Action::Camera)
            .collect(),
        Section::Projection => Projection::ALL.map(Action::Projection).to_vec(),
        Section::Shading => vec![
            Action::Shading(ShadingMode::Gouraud),
            Action::Shading(ShadingMode::Phong),
            Action::NextTolerance,
        ],
        Section::View => ViewMode::ALL
            .into_iter()
            .map(Action::Show)
            .chain([Action::Blink, Action::Measure])
            .collect(),
        Section::Motion | Section::Window => BINDINGS
            .iter()
            .filter(|binding| binding.section == section)
            .map(|binding| binding.action)
            .collect(),
    }
}

/// Whether a key bound to `bound` leads to what the row of `shown` does.
fn serves(session: &Session, bound: Action, shown: Action) -> bool {
    match (bound, shown) {
        (Action::LightNamed(name), Action::Light(index)) => session
            .scene()
            .lights
            .get(index)
            .is_some_and(|&light| session.is_named(light, name)),
        (Action::Tolerance(_), Action::NextTolerance)
        | (Action::NextProjection, Action::Projection(_))
        | (Action::NextCamera, Action::Camera(_))
        | (Action::NextView, Action::Show(_)) => true,
        _ => bound == shown,
    }
}

fn label(session: &Session, action: Action) -> String {
    let name = |entities: &[Entity], index: usize| {
        entities
            .get(index)
            .map_or_else(String::new, |&entity| session.name(entity))
    };
    match action {
        Action::Light(index) => name(&session.scene().lights, index),
        Action::Camera(index) => name(&session.scene().cameras, index),
        Action::Shading(mode) => mode_label(mode).to_owned(),
        Action::Show(mode) => mode.label().to_owned(),
        Action::Projection(projection) => projection.name().to_owned(),
        Action::NextTolerance => "tolerance".to_owned(),
        _ => BINDINGS
            .iter()
            .find(|binding| binding.action == action)
            .map_or_else(String::new, |binding| binding.says.to_owned()),
    }
}

fn state(session: &Session, action: Action) -> (Mark, String) {
    let switch = |on: bool, color: u32| {
        (
            Mark::Switch(on, color),
            if on { "on" } else { "off" }.to_owned(),
        )
    };
    let choice = |chosen: bool| (Mark::Choice(chosen), String::new());
    let orbit = session.orbit();
    match action {
        Action::Light(index) => session
            .light(index)
            .map_or((Mark::None, String::new()), |light| {
                switch(light.on, brightest(light.color))
            }),
        Action::Shading(mode) => choice(session.shading() == Some(mode)),
        Action::NextTolerance => (Mark::None, tolerance(session.tolerance())),
        Action::Projection(projection) => choice(session.projection() == projection),
        Action::Camera(index) => choice(session.camera() == index),
        Action::Show(mode) => choice(session.view_mode() == mode),
        Action::Blink => switch(session.blinks(), ON),
        Action::Measure => switch(session.measuring().is_open(), ON),
        Action::Turning => switch(session.turning().is_on(), ON),
        Action::Panel => switch(session.overlay().shows_panel(), ON),
        Action::Help => switch(session.overlay().shows_help(), ON),
        Action::Orbit { azimuth, .. } if azimuth != 0.0 => (Mark::None, degrees(orbit.azimuth)),
        Action::Orbit { .. } => (Mark::None, degrees(orbit.elevation)),
        Action::Zoom(_) => (Mark::None, format!("{:.2}\u{d7}", 1.0 / orbit.factor())),
        Action::ResetView if session.turning().degrees() > 0 => {
            (Mark::None, degrees(f64::from(session.turning().degrees())))
        }
        _ => (Mark::None, String::new()),
    }
}

/// A light's colour as bright as it can be, 0x00RRGGBB: a dim light is on too, and a black one is grey.
fn brightest(color: DVec3) -> u32 {
    let largest = color.max_element();
    if largest <= 0.0 {
        return 0x0080_8080;
    }
    let [red, green, blue] = (color / largest * 255.0).round().to_array();
    (red as u32) << 16 | (green as u32) << 8 | blue as u32
}

/// A tolerance in levels, or what 0 means.
pub fn tolerance(levels: f64) -> String {
    if levels == 0.0 {
        "exact".to_owned()
    } else {
        levels.to_string()
    }
}

fn degrees(angle: f64) -> String {
    // Adding zero takes the sign off a negative zero.
    format!("{}\u{b0}", angle.round() + 0.0)
}

fn facts(session: &Session) -> [Line; 6] {
    let statistics = session.statistics();
    let [width, height] = statistics.size();
    let columns = |max: &str, mean: &str| format!("{max:>6}{mean:>7}");
    let both = |errors: Errors| columns(&short_error(errors.max), &short_error(errors.mean));
    [
        Line::Fact("frame", frame_time(session)),
        Line::Fact(
            "shaded",
            format!("{} px", grouped(statistics.shaded_pixels())),
        ),
        Line::Fact("window", format!("{width}\u{d7}{height}")),
        Line::Fact("error", columns("max", "mean")),
        Line::Fact("vs Phong", errors(session, |it| it.errors, both)),
        Line::Fact("vs own mode", errors(session, |it| it.own_errors, both)),
    ]
}

fn frame_time(session: &Session) -> String {
    session.statistics().frame_time().map_or_else(
        || "-".to_owned(),
        |time| format!("{:.2} ms", time.as_secs_f64() * 1e3),
    )
}

/// Errors in levels as `told`, or why there are none.
fn errors(
    session: &Session,
    of: fn(&Findings) -> Option<Errors>,
    told: impl Fn(Errors) -> String,
) -> String {
    match session.findings().map(of) {
        None => "...".to_owned(),
        Some(None) => "-".to_owned(),
        Some(Some(errors)) => told(errors),
    }
}

fn short_error(levels: f64) -> String {
    short(Some(levels))
}

/// A number with its digits in threes.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}
