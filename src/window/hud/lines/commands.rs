//! The table of bindings and the session's state -> commands as they are shown.
//!
//! Rule: a command is shown with every key that calls it up and with its present state.

use glam::DVec3;
use hecs::Entity;

use super::{Command, Mark, ON};
use crate::components::{Projection, ShadingMode};
use crate::window::bindings::{Action, BINDINGS, Binding, Section};
use crate::window::session::Session;
use crate::window::views::{ViewMode, mode_label};

/// The commands of a section: those that the panel has, or all.
pub fn commands(session: &Session, section: Section, panel: bool) -> impl Iterator<Item = Command> {
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
pub fn command(session: &Session, action: Action, keys: usize) -> Command {
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

/// What a command is called.
pub fn label(session: &Session, action: Action) -> String {
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
        Action::Turning => switch(session.spin().on, ON),
        Action::Panel => switch(session.overlay().shows_panel(), ON),
        Action::Help => switch(session.overlay().shows_help(), ON),
        Action::Orbit { azimuth, .. } if azimuth != 0.0 => (Mark::None, degrees(orbit.azimuth)),
        Action::Orbit { .. } => (Mark::None, degrees(orbit.elevation)),
        Action::Zoom(_) => (Mark::None, format!("{:.2}\u{d7}", 1.0 / orbit.factor())),
        Action::ResetView if session.spin().degrees > 0 => {
            (Mark::None, degrees(f64::from(session.spin().degrees)))
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
