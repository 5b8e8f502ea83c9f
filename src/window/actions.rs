//! The keys that were pressed, and their actions. An action writes components of the World, or the state of the window alone.

use egui::{Event, Key, Ui};

use super::app::App;
use super::controls;
use super::facts::Worst;
use super::inspector::Tab;
use super::keys::{self, Action, EXACT_SIDES};
use super::marks::CROSS;
use super::pictures::sides;
use crate::components::ViewMode;

impl App {
    /// Runs the actions of the keys that were pressed, unless the widget with the focus takes them.
    pub(super) fn take_keys(&mut self, ui: &Ui) {
        let has_focus = ui.memory(|memory| memory.focused().is_some());
        // Tab may have gone on from a field to the next one, which is not open yet.
        let was_field = self.desk.has_field && has_focus;
        let has_field = ui.ctx().text_edit_focused() || was_field;
        self.desk.has_field = has_field;
        let events = ui.input(|input| input.events.clone());
        let mut has_run = false;
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
                self.desk.blink_while(pressed && !has_field);
            }
            // A text field has no use for these.
            let works_in_fields = matches!(action, Action::Save | Action::SaveAs)
                || (Key::F1..=Key::F12).contains(&key);
            let is_taken = has_focus && moves_widgets(key)
                || has_field && !works_in_fields
                || self.desk.takes_escape && action == Action::Close;
            if pressed && !is_taken && (!repeat || goes_on(action)) {
                self.run(action);
                has_run = true;
            }
        }
        if has_run {
            // The panels show the state after the keys.
            self.note_changes();
        }
    }

    /// Runs an action; one that cannot be run says so.
    pub fn run(&mut self, action: Action) {
        let is_lesson = !self.document.scene.lesson.is_empty();
        if matches!(action, Action::Tab(_) | Action::Worst | Action::HoldTime) {
            // They need room beside the picture.
            (self.desk.shows_rest, self.desk.panel_folded) = (true, false);
        }
        let world = &mut self.document.scene.world;
        match action {
            Action::Light(index) => self.desk.say_any(controls::switch_light(world, index)),
            Action::LightNamed(name) => {
                self.desk.say_any(controls::switch_light_named(world, name));
            }
            Action::Shading(mode) => controls::shade(world, mode),
            Action::FaceNormals => controls::switch_normals(world),
            Action::Segments(steps) => self.desk.say_any(controls::step_segments(world, steps)),
            Action::Tolerance(steps) => self.desk.say_any(controls::step_tolerance(world, steps)),
            Action::HoldTime => {
                controls::switch_budget(world, &self.study.facts);
                self.desk.open(Tab::Time);
            }
            Action::NextProjection => controls::next_projection(world),
            Action::NextCamera => self.desk.say_any(controls::next_camera(world)),
            Action::View(mode) => controls::show(world, mode),
            Action::WipeExact => controls::wipe(world, EXACT_SIDES),
            Action::Worst => self.explain_worst(),
            Action::Probe(right, down) => self.step_probed([right, down]),
            // It acts while it is held.
            Action::Blink => {}
            Action::Orbit(azimuth, elevation) => controls::orbit(world, azimuth, elevation),
            Action::Zoom(steps) => {
                controls::zoom(world, steps);
            }
            Action::ShowAll => {
                self.canvas.fit_again();
                let size = self.canvas.wide_size();
                controls::show_all(world, size);
            }
            Action::Rotate => self.rotation.switch(world, self.desk.now),
            Action::Tab(tab) => self.desk.switch(tab),
            Action::Open(name) => self.open(name),
            Action::Step(steps) => {
                self.canvas.fit_again();
                self.step_lesson(steps);
            }
            Action::Undo | Action::Redo => {
                let message = self.document.travel(action == Action::Undo);
                self.desk.say(message);
            }
            Action::Save => self.save(false),
            Action::SaveAs => self.save(true),
            Action::Panel if is_lesson => self.desk.shows_rest ^= true,
            Action::Panel => self.desk.panel_folded ^= true,
            Action::Help => self.desk.help ^= true,
            Action::Screenshot => self.save_pixels(&self.pixels.clone(), self.size),
            Action::SavePicture => {
                self.save_pixels(&self.labelled_picture(), self.canvas.size());
            }
            Action::Close => self.close_uppermost(),
            Action::Quit => self.quit(),
        }
    }

    /// Quits; with unsaved edits at the second press.
    fn quit(&mut self) {
        self.desk.quits = self.desk.is_warned || !self.document.is_edited();
        if !self.desk.quits {
            self.desk.is_warned = true;
            self.desk.say(
                "There are unsaved edits. Ctrl S saves them; Q again quits and offers them at the next start.",
            );
        }
    }

    /// Closes the uppermost thing that can be closed. A lesson that is alone is left for the scene before it.
    fn close_uppermost(&mut self) {
        if self.desk.close() {
            return;
        }
        if self.is_lesson_alone() {
            return self.leave_lesson();
        }
        if let Some(divider) = self.desk.divider.take() {
            self.viewer_mut().divider = divider;
        }
        let is_closed = self.viewer_mut().pixel.take().is_some() || self.desk.tabs.pop().is_some();
        if !is_closed {
            self.desk.say("Q quits");
        }
    }

    /// Explains a pixel, and opens its heading.
    pub fn probe(&mut self, pixel: [usize; 2]) {
        let (size, rows) = (self.canvas.size(), self.canvas.rows());
        self.viewer_mut().set_pixel(pixel, size, rows);
        self.desk.awaits_worst = false;
        // The scene's numbers stay: a click selects the cuboid there.
        if self.desk.is_open(Tab::Scene) && !self.desk.is_high {
            self.desk.say("\"Numbers\" explains it");
        } else if !self.desk.is_open(Tab::Pixel) {
            self.desk.open(Tab::Pixel);
        }
    }

    /// Moves the probed pixel within the picture; the first one is in the middle.
    fn step_probed(&mut self, steps: [i32; 2]) {
        let (size, before) = (self.canvas.size(), self.pixel());
        let moved = |pixel: [usize; 2], axis: usize| {
            let moved = pixel[axis].saturating_add_signed(steps[axis] as isize);
            moved.min(size[axis] - 1)
        };
        self.probe([0, 1].map(|axis| before.map_or(size[axis] / 2, |it| moved(it, axis))));
    }

    /// The side of a wipe that errs more, left (0) or right (1), and its worst pixel; in a single picture the picture's. `None` is
    /// not known yet.
    pub(super) fn worst(&self) -> Option<(usize, Option<Worst>)> {
        let worst = |side| self.study.facts.worst(&side, self.method());
        let [left, right] = sides(&self.viewer()).map(worst);
        let both = [left?, right?];
        let [left, right] = both.map(|worst| worst.map(|it| it.error));
        let index = usize::from(right > left);
        Some((index, both[index]))
    }

    /// Explains the worst pixel of the picture, or of the side that errs more. Where the other side hides it the divider moves, until
    /// the pixel is closed. What is not known yet is awaited.
    pub(super) fn explain_worst(&mut self) {
        let Some((index, worst)) = self.worst() else {
            self.desk.awaits_worst = true;
            return self.desk.say("measuring; the worst pixel opens by itself");
        };
        let Some(Worst { pixel: [x, y], .. }) = worst else {
            return self.desk.say("the picture has no worst pixel");
        };
        let viewer = self.viewer();
        let column = self.canvas.divider_column(&viewer);
        let is_hidden = viewer.show == ViewMode::Wipe && usize::from(x >= column) != index;
        drop(viewer);
        if is_hidden {
            // Beside the cross, so that the other side is seen near it, too.
            let beside = f64::from(CROSS * self.canvas.scale);
            let column = x as f64 + if index == 0 { beside } else { -beside };
            let divider = self.canvas.divider_at(column);
            let before = std::mem::replace(&mut self.viewer_mut().divider, divider);
            self.desk.divider.get_or_insert(before);
        }
        self.probe([x, y]);
        self.desk.open(Tab::Pixel);
    }
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
