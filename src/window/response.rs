//! A gesture at a place in the window -> what the session does about it.
//!
//! Rule: what lies over the picture is meant before the picture, as it was drawn.

use super::bindings::Action;
use super::hud::{Hud, Part};
use super::input::Gesture;
use super::session::Session;
use super::view_state::Drag;

/// How far a drag across the picture's shorter side turns, in degrees.
const DRAG_TURN: f64 = 200.0;

/// Does what `gesture` means in a window that shows `hud`.
pub fn respond(session: &mut Session, gesture: Gesture, hud: &Hud) {
    let picture = hud.picture();
    match gesture {
        Gesture::Command(action) => session.apply(action),
        Gesture::Released(action) => session.release(action),
        Gesture::Hover(point) => session.hover(hud.action_at(point)),
        Gesture::Click(point) => {
            if let Some(action) = hud.action_at(point) {
                return session.apply(action);
            }
            match hud.board_at(point) {
                Some((Part::Probe | Part::Profile, _)) => session.probe(None),
                Some((Part::Table, _)) => session.apply(Action::Measure),
                Some((Part::Help, _)) => {}
                _ if session.state().help => session.apply(Action::Help),
                Some(_) => {}
                None => session.probe(hud.pixel_at(point)),
            }
        }
        Gesture::Typed(letter) => session.type_letter(letter),
        Gesture::Drag {
            from,
            by,
            modifiers,
        } => {
            let on_picture = hud.board_at(from).is_none() && picture.contains(from);
            let drag = session.state().drag.clone().or_else(|| {
                let lights = hud.lights_at(from).map(|it| Drag::Lights(it.to_vec()));
                let divider = hud.catches_divider(from).then_some(Drag::Divider);
                lights.or(divider).filter(|_| on_picture)
            });
            if let Some(Drag::Lights(lights)) = drag {
                session.drag_lights(&lights, by, modifiers.shift, picture.height as usize);
            } else if drag.is_some() {
                session.drag_divider(f64::from(by[0]) / f64::from(picture.width.max(1)));
            } else if on_picture {
                let degrees = DRAG_TURN / f64::from(picture.width.min(picture.height).max(1));
                // The cuboid follows the mouse, so the camera goes the other way.
                session.apply(Action::Orbit {
                    azimuth: -f64::from(by[0]) * degrees,
                    elevation: f64::from(by[1]) * degrees,
                });
            }
        }
        Gesture::EndDrag => session.end_drag(),
        Gesture::Wheel {
            at,
            notches,
            modifiers,
        } => match (hud.board_at(at), hud.action_at(at)) {
            (None, _) => session.apply(Action::Zoom(notches)),
            (Some(_), Some(Action::ChooseRow(row) | Action::Step { row: Some(row), .. })) => {
                session.apply(Action::Step {
                    row: Some(row),
                    steps: notches,
                    size: modifiers.step_size(),
                });
            }
            _ => {}
        },
    }
}
