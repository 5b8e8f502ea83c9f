//! What the user wants, an [`Action`] -> what becomes of a [`Session`].
//!
//! Rule: whatever was wanted shows: in the picture, over it, or as words that say why not.

use super::{DEGREE_TIME, Measuring, Redraw, Request, Requires, Session};
use crate::canvas::FACES;
use crate::components::{Light, Orbit, Projection, ShadingMode, Spin};
use crate::window::bindings::Action;
use crate::window::history::{Change, History, Saved};
use crate::window::magnifier::Magnifier;
use crate::window::orbit::Limits;
use crate::window::view_state::Drag;

/// The tolerances that keys step through, in levels.
pub const TOLERANCES: [f64; 7] = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0];

impl Session {
    /// What `action` is at the moment, in terms that mean the same in another window.
    pub fn resolved(&self, action: Action) -> Action {
        let editor = self.state.editor.as_ref();
        match action {
            Action::LightNamed(name) => self.light_named(name).map_or(action, Action::Light),
            Action::Close if self.state.help => Action::Help,
            Action::Close if editor.is_some_and(|it| it.typed.is_empty()) => Action::Editor,
            Action::Close if editor.is_some() => Action::Forget,
            Action::Close if !matches!(self.measuring, Measuring::Off) => Action::Measure,
            Action::Close if self.requires.is_some() => Action::Requires,
            Action::Close if self.state.pixel.is_some() => Action::Probe(None),
            _ => action,
        }
    }

    /// Does what the user wants; what cannot be done says so.
    #[expect(clippy::too_many_lines, reason = "one arm for each command")]
    pub fn apply(&mut self, action: Action) {
        match self.resolved(action) {
            Action::Light(index) => self.switch_light(index),
            Action::LightNamed(name) => self.say(format!("no light is named {name}")),
            Action::Shading(mode) => self.shade(Some(mode)),
            Action::SceneShading => self.shade(None),
            Action::Tolerance(steps) => self.step_tolerance(steps),
            Action::Projection(projection) => {
                self.projection = projection;
                self.changed();
            }
            Action::NextProjection => self.apply(Action::Projection(match self.projection {
                Projection::Perspective => Projection::Orthographic,
                Projection::Orthographic => Projection::Perspective,
            })),
            Action::NextCamera if self.scene.cameras.len() == 1 => self.say("there is one camera"),
            Action::NextCamera => {
                self.set_orbit(Orbit::default());
                let next = (self.camera() + 1) % self.scene.cameras.len();
                self.scene.look_from(next);
            }
            Action::Orbit { azimuth, elevation } => {
                let (own, orbit) = self.scene.camera(self.camera());
                let moved = orbit.moved(&own, azimuth, elevation);
                self.move_camera(moved, "the camera stops short of the pole");
            }
            Action::Zoom(steps) => {
                let (own, orbit) = self.scene.camera(self.camera());
                let limits = Limits::of(&self.scene, &own);
                let end = if steps > 0 {
                    "no closer than this"
                } else {
                    "no further than this"
                };
                self.move_camera(orbit.zoomed(steps, &limits), end);
            }
            Action::ResetView => {
                for spin in self.scene.world.query_mut::<&mut Spin>() {
                    spin.degrees = 0;
                }
                self.state.magnifier = Magnifier::default();
                self.set_orbit(Orbit::default());
            }
            Action::View(steps) => {
                self.apply(Action::Show(self.state.mode.stepped(steps)));
            }
            Action::Show(mode) => {
                self.state.mode = mode;
                self.wants(Redraw::Picture);
            }
            Action::Blink => self.state.shows_reference ^= true,
            Action::EndBlink => self.state.shows_reference = false,
            Action::Measure if !matches!(self.measuring, Measuring::Off) => self.stop_measuring(),
            Action::Measure if self.spin().on => {
                self.say("stop the rotation (Space) before measuring");
            }
            Action::Measure => self.measure(),
            Action::Requires => {
                self.requires = self.requires.is_none().then(Requires::default);
                self.examine_again();
            }
            Action::LeaveOut(index) => self.leave_out(index),
            Action::Turning => {
                for spin in self.scene.world.query_mut::<&mut Spin>() {
                    spin.on ^= true;
                }
                self.next_degree = self.now + DEGREE_TIME;
            }
            Action::Panel => {
                self.state.panel ^= true;
                if !self.state.panel {
                    self.say("I shows the panel again");
                }
            }
            Action::Help => self.state.help ^= true,
            Action::Probe(pixel) => {
                self.state.pixel = pixel;
                (self.probe, self.profile) = (None, None);
                self.wants(Redraw::Picture);
            }
            Action::Letters(size) => {
                let size = size.min(FACES.len() - 1);
                self.state.letters = Some(size);
                self.say(format!("letters of {} pixels", FACES[size].height()));
            }
            Action::Magnify(magnifier) => self.magnify(magnifier),
            Action::DragDivider(by) => {
                self.state.divider += by;
                self.state.drag = Some(Drag::Divider);
            }
            Action::Close => self.say("Q quits"),
            Action::Editor => self.toggle_editor(),
            Action::Row(rows) => self.go_to_row(rows),
            Action::ChooseRow(row) => self.choose_row(row),
            Action::Step { row, steps, size } => self.step_number(row, steps, size),
            Action::Type(letter) => self.type_letter(letter),
            Action::Enter => self.enter(),
            Action::Erase => self.edit_typed(|typed| {
                typed.pop();
            }),
            Action::Forget => self.edit_typed(String::clear),
            Action::Undo => self.travel(History::undo, "nothing to undo"),
            Action::Redo => self.travel(History::redo, "nothing to redo"),
            Action::DragLight {
                light,
                by,
                in_depth,
            } => self.drag_light(light, by, in_depth),
            Action::EndDrag => {
                self.state.end_drag();
                return self.history.end_step();
            }
            // These need what is seen, and so are resolved in `response`; those the window does once it has drawn.
            Action::MagnifyBy(_)
            | Action::LettersBy(_)
            | Action::Save
            | Action::SavePicture
            | Action::Screenshot
            | Action::FullScreen
            | Action::Quit => return,
        }
        self.wants(Redraw::Overlay);
    }

    fn measure(&mut self) {
        self.examine_again();
        if let Some(requires) = &mut self.requires {
            // What is not there yet is asked for again after the measurement.
            requires.is_asked = !requires.parts.is_empty();
            requires.left_out = None;
        }
        self.measuring = Measuring::Running("starting", 0.0);
        self.requests.push(Request::Measure);
    }

    fn magnify(&mut self, magnifier: Magnifier) {
        let before = std::mem::replace(&mut self.state.magnifier, magnifier);
        match magnifier.scale {
            scale if before == magnifier && scale > 1 => self.say("no larger than this"),
            1 if before == magnifier => self.say("no smaller than this"),
            _ => {}
        }
    }

    /// The job that runs is cancelled; the comparison with the reference is asked for again where it had not ended.
    fn examine_again(&mut self) {
        if self.reference.as_ref().is_none_or(|it| it.proof.is_none()) {
            self.to_be_examined = Some(self.now);
        }
    }

    fn leave_out(&mut self, index: usize) {
        let Some(requires) = &mut self.requires else {
            return;
        };
        let is_left_out = requires.left_out == Some(index);
        let part = requires.parts.get(index).filter(|_| !is_left_out);
        let request = part.map(|it| Request::LeaveOut(it.part));
        requires.left_out = part.map(|_| index);
        requires.picture = None;
        if request.is_some() && matches!(self.measuring, Measuring::Running(..)) {
            // Its job is cancelled by this one.
            self.stop_measuring();
        }
        self.requests.extend(request);
    }

    /// Ends a measurement or closes its table.
    fn stop_measuring(&mut self) {
        self.requests.retain(|request| *request != Request::Measure);
        self.measuring = Measuring::Off;
    }

    fn switch_light(&mut self, index: usize) {
        let Some(&entity) = self.scene.lights.get(index) else {
            return self.say(format!("there is no light {}", index.saturating_add(1)));
        };
        let before = Saved::Entities(vec![(entity, self.scene.editable(entity))]);
        self.history.note(before, Change::Single, self.now);
        if let Ok(mut light) = self.scene.world.get::<&mut Light>(entity) {
            light.on = !light.on;
        }
        self.changed();
    }

    /// Takes the nearest of [`TOLERANCES`] in the direction of `steps`, so often.
    fn step_tolerance(&mut self, steps: i32) {
        for _ in 0..steps.unsigned_abs() {
            let mut tolerances = TOLERANCES.into_iter();
            let (next, end) = if steps > 0 {
                let coarser = tolerances.find(|next| *next > self.tolerance);
                (coarser, "no coarser than this")
            } else {
                let finer = tolerances.rfind(|next| *next < self.tolerance);
                (finer, "no finer than exact")
            };
            let Some(tolerance) = next else {
                return self.say(end);
            };
            self.tolerance = tolerance;
            self.changed();
        }
    }

    fn shade(&mut self, mode: Option<ShadingMode>) {
        self.scene.shade(mode);
        self.changed();
    }

    /// Moves the camera, or says what keeps it from moving.
    fn move_camera(&mut self, orbit: Orbit, end: &str) {
        if orbit == self.orbit() {
            return self.say(end);
        }
        self.set_orbit(orbit);
    }

    fn set_orbit(&mut self, orbit: Orbit) {
        self.scene.set_orbit(self.camera(), orbit);
        self.changed();
    }
}
