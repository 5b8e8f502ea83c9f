//! The table of bindings and the session's state -> commands as they are shown.
//!
//! Rule: a command is shown with its present state and its keys: all of them in the help, the first in the panel.

use glam::DVec3;

use super::{Command, Line, Mark, ON};
use crate::window::bindings::{Action, BINDINGS, Section};
use crate::window::session::{Measuring, Session};
use crate::window::views::mode_label;

/// The commands of a section: those that the panel has, or all. Keys that are called the same have one row.
pub fn commands(session: &Session, section: Section, panel: bool) -> Vec<Line> {
    let mut rows: Vec<Command> = Vec::new();
    let bindings = BINDINGS.iter().filter(|it| it.section == section);
    for binding in bindings.filter(|it| it.on_panel || !panel) {
        let action = match binding.action {
            Action::LightNamed(_) => session.resolved(binding.action),
            action => action,
        };
        let Some(label) = label(session, action, binding.says) else {
            continue;
        };
        let captions = binding.captions.iter();
        let keys = captions
            .take(if panel { 1 } else { usize::MAX })
            .map(|caption| (*caption, binding.action));
        if let Some(command) = rows.iter_mut().find(|it| it.label == label) {
            command.keys.extend(keys);
            continue;
        }
        let (mark, state) = state(session, action);
        rows.push(Command {
            keys: keys.collect(),
            mark,
            label,
            state,
        });
    }
    let mut lines: Vec<Line> = rows.into_iter().map(Line::Command).collect();
    let shown = lines.len();
    if section == Section::LIGHTS && session.scene.lights.len() > shown {
        let more = session.scene.lights.len() - shown;
        lines.push(Line::Text(format!("and {more} more without a key")));
    }
    lines
}

/// What a command is called: lights and modes by their names; `None` for a light that the scene lacks.
fn label(session: &Session, action: Action, says: &str) -> Option<String> {
    match action {
        Action::Light(index) => Some(session.name(*session.scene.lights.get(index)?)),
        Action::LightNamed(_) => None,
        Action::Shading(mode) => Some(mode_label(mode).to_owned()),
        _ => Some(says.to_owned()),
    }
}

fn state(session: &Session, action: Action) -> (Mark, String) {
    let switch = |on: bool, color: u32| {
        let words = if on { "on" } else { "off" };
        (Mark::Switch(on, color), words.to_owned())
    };
    let words = |words: String| (Mark::None, words);
    let orbit = session.orbit();
    let state = &session.state;
    match action {
        Action::Light(index) => session.light(index).map_or_else(
            || words(String::new()),
            |light| switch(light.on, brightest(light.color)),
        ),
        Action::Shading(mode) => (Mark::Choice(session.shading() == Some(mode)), String::new()),
        Action::Tolerance(_) => words(tolerance(session.tolerance)),
        Action::NextProjection => words(session.projection.name().to_owned()),
        Action::NextCamera => words(session.name(session.scene.cameras[session.camera()])),
        Action::View(_) => words(state.mode.label().to_owned()),
        Action::Blink => switch(state.shows_reference, ON),
        Action::Measure => switch(!matches!(session.measuring, Measuring::Off), ON),
        Action::Turning => {
            let spin = session.spin();
            let (mark, _) = switch(spin.on, ON);
            (mark, degrees(f64::from(spin.degrees)))
        }
        Action::Panel => switch(state.panel, ON),
        Action::Help => switch(state.help, ON),
        Action::Editor => switch(state.editor.is_some(), ON),
        Action::Orbit { azimuth, .. } if azimuth != 0.0 => words(degrees(orbit.azimuth)),
        Action::Orbit { .. } => words(degrees(orbit.elevation)),
        Action::Zoom(_) => words(format!("{:.2}\u{d7}", 1.0 / orbit.factor())),
        _ => words(String::new()),
    }
}

/// A light's colour as bright as it can be, 0x00RRGGBB: a dim light is on too, and a black one is grey.
pub fn brightest(color: DVec3) -> u32 {
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
        format!("{levels} level{}", if levels > 1.0 { "s" } else { "" })
    }
}

fn degrees(angle: f64) -> String {
    // Adding zero takes the sign off a negative zero.
    format!("{}\u{b0}", angle.round() + 0.0)
}
