//! A gesture at a place in the window -> what the session does about it.
//!
//! Rule: what lies over the picture is meant before the picture, the help before the panel.

use super::bindings::Action;
use super::hud::{Hud, Shown};
use super::input::Gesture;
use super::overlay::Pane;
use super::session::Session;
use crate::canvas::Point;

/// How far a drag across the window's shorter side turns, in degrees.
const DRAG_TURN: f64 = 200.0;

/// Does what `gesture` means in a window of `size` pixels.
pub fn respond(session: &mut Session, gesture: Gesture, size: [usize; 2]) {
    let hud = Hud::new(session, size, Shown::All);
    match gesture {
        Gesture::Command(action) => session.apply(action),
        Gesture::Released(action) => session.release(action),
        Gesture::Hover(point) => session.hover(hud.action_at(point)),
        Gesture::Click(point) => {
            if let Some(action) = hud.action_at(point) {
                session.apply(action);
                return;
            }
            match hud.board_at(point) {
                Some((Pane::Probe, _)) => session.probe(None),
                Some((Pane::Table, _)) => session.apply(Action::Measure),
                Some(_) => {}
                None if session.overlay().shows_help() => session.apply(Action::Help),
                None => session.probe(pixel_at(point, size)),
            }
        }
        Gesture::Drag { from, by } => {
            let caught = hud.legend().is_some_and(|legend| legend.catches(from));
            if hud.board_at(from).is_some() {
                return;
            }
            if session.holds_divider() || caught {
                session.drag_divider(f64::from(by[0]) / size[0].max(1) as f64);
            } else {
                let degrees = DRAG_TURN / size[0].min(size[1]).max(1) as f64;
                // The cuboid follows the mouse, so the camera goes the other way.
                session.apply(Action::Orbit {
                    azimuth: -f64::from(by[0]) * degrees,
                    elevation: f64::from(by[1]) * degrees,
                });
            }
        }
        Gesture::Drop => session.drop_divider(),
        Gesture::Wheel { at, notches } => match hud.board_at(at) {
            Some((pane, board)) => {
                if let Some(scroll) = board.scroll() {
                    let first = scroll.first.saturating_add_signed(-notches as isize);
                    session.scroll_to(pane, first.min(scroll.total - scroll.seen));
                }
            }
            None => session.apply(Action::Zoom(notches)),
        },
    }
}

/// The pixel at `point`, where it lies in the picture.
fn pixel_at(point: Point, size: [usize; 2]) -> Option<[usize; 2]> {
    let [x, y] = point.map(|at| usize::try_from(at).ok());
    let pixel = [x?, y?];
    (pixel[0] < size[0] && pixel[1] < size[1]).then_some(pixel)
}
