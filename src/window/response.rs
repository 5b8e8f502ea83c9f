//! A gesture at a place in the window -> what the session does about it.
//!
//! Rule: what lies over the picture is meant before the picture, as it was drawn.

use super::bindings::Action;
use super::hud::{Hud, Part};
use super::input::Gesture;
use super::session::Session;
use super::view_state::{Drag, ViewState};
use crate::canvas::Point;

/// How far a drag across the picture's shorter side turns, in degrees.
const DRAG_TURN: f64 = 200.0;

/// Does what `gesture` means in a window that shows `hud`; returns what that was.
pub fn respond(session: &mut Session, gesture: Gesture, hud: &Hud) -> Option<Action> {
    if let Gesture::Hover(point) = gesture {
        session.hover(hud.action_at(point));
    }
    let action = session.resolved(meaning(gesture, &session.state, hud)?);
    session.apply(action);
    Some(action)
}

fn meaning(gesture: Gesture, state: &ViewState, hud: &Hud) -> Option<Action> {
    let picture = hud.picture;
    let (magnifier, size) = (hud.magnifier, picture.size());
    let magnified = |steps, at: Point| {
        let place = [at[0] - picture.x, at[1] - picture.y];
        Action::Magnify(magnifier.stepped(steps, place, size))
    };
    let action = match gesture {
        Gesture::Command(action) => Some(action),
        Gesture::Hover(_) => None,
        Gesture::Click(point) => hud.action_at(point).or_else(|| match hud.board_at(point) {
            Some((Part::Probe | Part::Profile, _)) => Some(Action::Probe(None)),
            Some((Part::Table, _)) => Some(Action::Measure),
            Some((Part::Help, _)) => None,
            _ if state.help => Some(Action::Help),
            Some(_) => None,
            None => Some(Action::Probe(hud.pixel_at(point))),
        }),
        Gesture::Drag {
            from,
            by,
            modifiers,
        } => {
            let on_picture = hud.board_at(from).is_none() && picture.contains(from);
            let [right, down] = by.map(f64::from);
            let scale = magnifier.scale as f64;
            let height = f64::from(picture.height.max(1)) * scale;
            let light = |light| Action::DragLight {
                light,
                by: [right / height, down / height],
                in_depth: modifiers.shift,
            };
            let divider = || {
                let width = f64::from(picture.width.max(1)) * scale;
                Action::DragDivider(right / width)
            };
            match &state.drag {
                Some(Drag::Lights(lights)) => Some(light(*lights.first()?)),
                Some(Drag::Divider) => Some(divider()),
                None if !on_picture => None,
                None if modifiers.control => Some(Action::Magnify(magnifier.panned(by, size))),
                None => Some(match hud.light_at(from) {
                    Some(caught) => light(caught),
                    None if hud.catches_divider(from) => divider(),
                    None => {
                        let degrees =
                            DRAG_TURN / f64::from(picture.width.min(picture.height).max(1));
                        // The cuboid follows the mouse, so the camera goes the other way.
                        Action::Orbit {
                            azimuth: -right * degrees,
                            elevation: down * degrees,
                        }
                    }
                }),
            }
        }
        Gesture::Wheel {
            at,
            notches,
            modifiers,
        } => match (hud.board_at(at), hud.action_at(at)) {
            (None, _) if modifiers.control => Some(magnified(notches, at)),
            (None, _) => Some(Action::Zoom(notches)),
            (Some(_), Some(Action::ChooseRow(row) | Action::Step { row: Some(row), .. })) => {
                Some(Action::Step {
                    row: Some(row),
                    steps: notches,
                    size: modifiers.step_size(),
                })
            }
            _ => None,
        },
    };
    action.map(|action| match action {
        Action::MagnifyBy(steps) => magnified(steps, hud.focus()),
        Action::LettersBy(steps) => {
            Action::Letters(hud.letters().saturating_add_signed(steps as isize))
        }
        other => other,
    })
}
