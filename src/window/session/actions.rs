//! What the user wants, an [`Action`] -> what becomes of a [`Session`].
//!
//! Rule: whatever was wanted shows: in the picture, over it, or as words that say why not.

use super::{DEGREE_TIME, Redraw, Request, Session};
use crate::components::{Light, Orbit, Projection, ShadingMode, Spin};
use crate::window::bindings::Action;
use crate::window::measuring::Measuring;
use crate::window::orbit::Limits;
use crate::window::overlay::Pane;

/// The tolerances that keys step through, in levels.
pub const TOLERANCES: [f64; 7] = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0];

impl Session {
    /// Does what the user wants; what cannot be done says so for two seconds.
    pub fn apply(&mut self, action: Action) {
        match action {
            Action::Light(index) => self.switch_light(index),
            Action::LightNamed(name) => match self.light_named(name) {
                Some(index) => self.switch_light(index),
                None => self.say(format!("no light is named {name}")),
            },
            Action::Shading(mode) => self.shade(Some(mode)),
            Action::SceneShading => self.shade(None),
            Action::Tolerance(steps) => self.step_tolerance(steps),
            Action::NextTolerance if self.next_tolerance(1).is_none() => {
                self.shade_within(TOLERANCES[0]);
            }
            Action::NextTolerance => self.step_tolerance(1),
            Action::Projection(projection) => {
                self.projection = projection;
                self.changed();
            }
            Action::NextProjection => self.apply(Action::Projection(match self.projection {
                Projection::Perspective => Projection::Orthographic,
                Projection::Orthographic => Projection::Perspective,
            })),
            Action::Camera(index) => self.look_from(index),
            Action::NextCamera if self.scene.cameras.len() == 1 => self.say("there is one camera"),
            Action::NextCamera => self.look_from((self.camera() + 1) % self.scene.cameras.len()),
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
                self.set_orbit(Orbit::default());
            }
            Action::Show(mode) => {
                self.looking.mode = mode;
                self.wants(Redraw::Picture);
            }
            Action::NextView => self.apply(Action::Show(self.looking.mode.next())),
            Action::Blink => {
                self.looking.blinks ^= true;
                self.wants(Redraw::Overlay);
            }
            Action::Measure if self.measuring.is_open() => self.stop_measuring(),
            Action::Measure if self.spin().on => {
                self.say("what turns cannot be measured");
            }
            Action::Measure => {
                self.measuring = Measuring::Running(None);
                self.requests.push(Request::Measure);
                self.wants(Redraw::Overlay);
            }
            Action::Turning => {
                for spin in self.scene.world.query_mut::<&mut Spin>() {
                    spin.on ^= true;
                }
                self.next_degree = self.now + DEGREE_TIME;
                self.wants(Redraw::Overlay);
            }
            Action::Panel => {
                self.overlay.switch_panel();
                self.wants(Redraw::Overlay);
            }
            Action::Help => {
                self.overlay.switch_help();
                self.wants(Redraw::Overlay);
            }
            Action::Close if self.overlay.shows_help() => self.apply(Action::Help),
            Action::Close if self.measuring.is_open() => self.stop_measuring(),
            Action::Close if self.probing.is_open() => self.probe(None),
            Action::Close | Action::Quit => self.requests.push(Request::Quit),
            Action::Screenshot => self.requests.push(Request::Screenshot),
        }
    }

    /// The key of `action` went up, and what lasted as long ends.
    pub fn release(&mut self, action: Action) {
        if action == Action::Blink && self.looking.blinks {
            self.apply(action);
        }
    }

    /// Moves the divider by this share of the picture's width to the right.
    pub fn drag_divider(&mut self, by: f64) {
        self.looking.drag(by);
        self.wants(Redraw::Overlay);
    }

    /// Lets the divider stand where it is.
    pub fn drop_divider(&mut self) {
        self.looking.let_go();
    }

    /// Looks at this pixel from now on, or no longer at any.
    pub fn probe(&mut self, pixel: Option<[usize; 2]>) {
        self.probing.look_at(pixel);
        self.overlay.scroll_to(Pane::Probe, 0);
        self.wants(Redraw::Picture);
    }

    fn stop_measuring(&mut self) {
        self.requests.retain(|request| *request != Request::Measure);
        self.measuring = Measuring::Off;
        self.wants(Redraw::Overlay);
    }

    fn switch_light(&mut self, index: usize) {
        let Some(&entity) = self.scene.lights.get(index) else {
            return self.say(format!("there is no light {}", index + 1));
        };
        if let Ok(mut light) = self.scene.world.get::<&mut Light>(entity) {
            light.on = !light.on;
        }
        self.changed();
    }

    /// The nearest of [`TOLERANCES`] in the direction of `steps`.
    fn next_tolerance(&self, steps: i32) -> Option<f64> {
        let mut tolerances = TOLERANCES.into_iter();
        if steps > 0 {
            tolerances.find(|next| *next > self.tolerance)
        } else {
            tolerances.rfind(|next| *next < self.tolerance)
        }
    }

    fn step_tolerance(&mut self, steps: i32) {
        for _ in 0..steps.abs() {
            match self.next_tolerance(steps) {
                Some(tolerance) => self.shade_within(tolerance),
                None if steps > 0 => return self.say("no coarser than this"),
                None => return self.say("no finer than exact"),
            }
        }
    }

    fn shade(&mut self, mode: Option<ShadingMode>) {
        self.scene.shade(mode);
        self.changed();
    }

    fn shade_within(&mut self, tolerance: f64) {
        self.tolerance = tolerance;
        self.changed();
    }

    fn look_from(&mut self, camera: usize) {
        self.set_orbit(Orbit::default());
        self.scene.look_from(camera);
    }

    /// Moves the camera, or says what keeps it from moving.
    fn move_camera(&mut self, orbit: Orbit, end: &str) {
        if orbit == self.orbit() {
            return self.say(end);
        }
        self.set_orbit(orbit);
    }

    fn set_orbit(&mut self, orbit: Orbit) {
        let camera = self.scene.cameras[self.camera()];
        if let Ok(mut old) = self.scene.world.get::<&mut Orbit>(camera) {
            *old = orbit;
        }
        self.changed();
    }
}
