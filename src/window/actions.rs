//! Keys and their actions. An action writes components of the World, or the state of the window alone.

use std::sync::Arc;

use egui::util::undoer::Undoer;
use egui::{Event, Key, Ui};

use super::app::App;
use super::history::State;
use super::keys::{self, Action, EXACT_SIDES, TOLERANCES};
use crate::components::{
    Camera, Light, Orbit, Projection, ShadingMode, Side, ViewMode, names, ordered, overwrite,
};
use crate::drawing::camera_name;
use crate::scene::SceneRecord;
use crate::scene::key;

impl App {
    /// Runs the actions of the keys that were pressed, unless the widget with the focus takes them.
    pub fn take_keys(&mut self, ui: &Ui) {
        let has_field = ui.ctx().text_edit_focused();
        let has_focus = ui.memory(|memory| memory.focused().is_some());
        let events = ui.input(|input| input.events.clone());
        for event in events {
            let Event::Key {
                key,
                pressed,
                repeat,
                modifiers,
                ..
            } = event
            else {
                continue;
            };
            let Some(action) = keys::action(key, modifiers) else {
                continue;
            };
            if action == Action::Blink {
                self.blink_while(pressed && !has_field);
            }
            // A text field has no use for these.
            let works_in_fields = matches!(action, Action::Save | Action::SaveAs)
                || (Key::F1..=Key::F12).contains(&key);
            let is_taken = has_focus && moves_widgets(key)
                || has_field && !works_in_fields
                || self.takes_escape && action == Action::Close;
            if pressed && !is_taken && (!repeat || goes_on(action)) {
                self.run(action);
            }
        }
    }

    /// Runs an action; one that cannot be run says so.
    pub fn run(&mut self, action: Action) {
        match action {
            Action::Light(index) => match ordered::<Light>(&self.scene.world).get(index) {
                Some(light) => {
                    let light = self.scene.world.get::<&mut Light>(*light);
                    // It was just found.
                    let _ = light.map(|mut light| light.on ^= true);
                }
                None => self.say(format!("there is no light {}", index + 1)),
            },
            Action::LightNamed(name) => {
                let names = names::<Light>(&self.scene.world);
                match names.iter().position(|own| own == name) {
                    Some(index) => self.run(Action::Light(index)),
                    None => self.say(format!("no light is named {name}")),
                }
            }
            Action::Shading(mode) => self.shade(mode),
            Action::Tolerance(steps) => {
                let budget = self.viewer().budget;
                match budget {
                    Some(budget) => self.step_budget(budget, steps),
                    None => self.step_tolerance(steps),
                }
            }
            Action::HoldTime => self.switch_budget(),
            Action::NextProjection => {
                let mut viewer = self.viewer_mut();
                viewer.projection = match viewer.projection {
                    Projection::Perspective => Projection::Orthographic,
                    Projection::Orthographic => Projection::Perspective,
                };
            }
            Action::NextCamera => self.next_camera(),
            Action::View(ViewMode::Wipe) => {
                let tolerance = self.viewer().tolerance;
                self.wipe(Side::gouraud_phong(tolerance));
            }
            Action::View(mode) => self.viewer_mut().show = mode,
            Action::WipeExact => self.wipe(EXACT_SIDES),
            Action::Worst => self.explain_worst(),
            Action::Probe(right, down) => self.step_probed([right, down]),
            // It acts while it is held.
            Action::Blink => {}
            Action::Orbit(azimuth, elevation) => self.orbit(azimuth, elevation),
            Action::Zoom(steps) => self.zoom(steps),
            Action::ResetView => {
                self.viewer_mut().turned = 0;
                self.change_orbit("the view is reset", |_| Orbit::default());
            }
            Action::Rotate => self.rotate(),
            Action::Tab(tab) => {
                let is_open = self.desk.tab == Some(tab);
                self.desk.tab = (!is_open).then_some(tab);
            }
            Action::Step(steps) => self.step_lesson(steps),
            Action::Undo => self.travel("undo", Undoer::undo),
            Action::Redo => self.travel("redo", Undoer::redo),
            Action::Save => self.save(false),
            Action::SaveAs => self.save(true),
            Action::Panel => self.desk.panel_folded ^= true,
            Action::Help => self.desk.help ^= true,
            Action::Screenshot => self.screenshot(),
            Action::Close => self.close(),
            Action::Quit => self.quits = true,
        }
    }

    /// Two pictures take turns for as long as this is called with `true`.
    pub fn blink_while(&mut self, is_held: bool) {
        let since = self.desk.blinks.unwrap_or(self.now);
        self.desk.blinks = is_held.then_some(since);
    }

    /// Shades every cuboid in this mode, whatever time that takes.
    pub(super) fn shade(&mut self, mode: ShadingMode) {
        self.viewer_mut().budget = None;
        overwrite(&mut self.scene.world, &mode);
    }

    /// Goes to the next of [`TOLERANCES`], coarser if `steps` is positive.
    fn step_tolerance(&mut self, steps: i32) {
        let present = self.viewer().tolerance;
        let mut tolerances = TOLERANCES.into_iter();
        let next = if steps > 0 {
            tolerances.find(|next| *next > present)
        } else {
            tolerances.rfind(|next| *next < present)
        };
        match next {
            Some(next) => self.set_tolerance(next),
            None if steps > 0 => self.say("the keys end here; the slider goes on"),
            None => self.say("the tolerance is 0 already"),
        }
    }

    /// Draws within this many levels. The sides of a wipe that had the tolerance before follow.
    pub fn set_tolerance(&mut self, levels: f64) {
        let mut viewer = self.viewer_mut();
        let before = viewer.tolerance;
        for side in viewer.sides.iter_mut() {
            if let Side::Method { mode, tolerance } = side
                && *tolerance == before
                && *mode != ShadingMode::UnitVectors
            {
                *tolerance = levels;
            }
        }
        (viewer.tolerance, viewer.budget) = (levels, None);
    }

    fn next_camera(&mut self) {
        let cameras = names::<Camera>(&self.scene.world);
        if cameras.len() == 1 {
            return self.say("there is one camera");
        }
        let active = camera_name(&self.scene.world);
        let place = cameras.iter().position(|camera| *camera == active);
        let next = (place.unwrap_or_default() + 1) % cameras.len();
        self.viewer_mut().camera = Some(cameras[next].clone());
    }

    /// Shows a wipe between these sides.
    pub fn wipe(&mut self, sides: [Side; 2]) {
        let mut viewer = self.viewer_mut();
        (viewer.show, viewer.sides) = (ViewMode::Wipe, sides);
    }

    /// Moves the probed pixel within the picture; the first one is in the middle.
    fn step_probed(&mut self, steps: [i32; 2]) {
        let size = self.picture_size();
        let before = self.pixel();
        let moved = |pixel: [usize; 2], axis: usize| {
            let moved = pixel[axis].saturating_add_signed(steps[axis] as isize);
            moved.min(size[axis] - 1)
        };
        self.probe([0, 1].map(|axis| before.map_or(size[axis] / 2, |it| moved(it, axis))));
    }

    /// Goes to the state that `find` finds in the history, and says what that changes.
    fn travel(
        &mut self,
        verb: &str,
        find: for<'a> fn(&'a mut Undoer<State>, &State) -> Option<&'a State>,
    ) {
        let present = State(Arc::clone(&self.state));
        let Some(found) = find(&mut self.history, &present) else {
            return self.say(format!("nothing to {verb}"));
        };
        let mut record = SceneRecord::clone(&found.0);
        record.view = found.view_as(&present.0.view);
        self.restore(&record);
        self.say(format!("{verb}: {}", change(&present.0, &record)));
    }

    /// Closes the uppermost thing that can be closed.
    fn close(&mut self) {
        let desk = &mut self.desk;
        let is_closed = std::mem::take(&mut desk.help) || desk.file_error.take().is_some();
        if is_closed {
            return;
        }
        let had_pixel = self.viewer_mut().pixel.take().is_some();
        if !had_pixel && (self.desk.has_room || self.desk.tab.take().is_none()) {
            self.say("Q quits");
        }
    }
}

/// The key of the values that differ, in words.
fn change(before: &SceneRecord, after: &SceneRecord) -> String {
    let keys = key::differences(before, after);
    // The sides of a wipe follow the tolerance and the view, which name the change.
    let (sides, others): (Vec<_>, Vec<_>) = keys.into_iter().partition(|it| it.is_of("view.sides"));
    let keys = if others.is_empty() { sides } else { others };
    let common = keys.into_iter().reduce(|one, other| one.common(&other));
    let common = common.filter(|it| !it.is_of("*"));
    common.map_or_else(|| "several changes".to_owned(), |key| key.to_string())
}

/// Whether a key presses or moves the widget with the focus, or goes to the next one.
fn moves_widgets(key: Key) -> bool {
    use Key::{ArrowDown, ArrowLeft, ArrowRight, ArrowUp, Enter, Space};
    matches!(
        key,
        ArrowDown | ArrowLeft | ArrowRight | ArrowUp | Enter | Space
    )
}

/// Whether an action goes on while its key is held.
fn goes_on(action: Action) -> bool {
    matches!(
        action,
        Action::Orbit(..) | Action::Zoom(_) | Action::Probe(..) | Action::Undo | Action::Redo
    )
}
