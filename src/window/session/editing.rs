//! What the user wants of the scene's numbers -> components written, each change a step that can be taken back.
//!
//! Rule: a number that the scene file would refuse says what is allowed and changes nothing.

use glam::DVec3;

use super::Session;
use crate::components::{Lens, LightKind, Spin};
use crate::scene::Scene;
use crate::scene::edit::{Page, Parameter, Property};
use crate::window::bindings::StepSize;
use crate::window::history::{Change, History, Saved};
use crate::window::view_state::{Drag, Editor};

/// Numbers that are stepped to have so many digits: a tenth added ten times makes one.
const STEP_DIGITS: usize = 12;

impl Session {
    /// The numbers that are shown.
    pub fn page(&self) -> Option<Page> {
        let is_shown = self.state.editor.is_some();
        is_shown.then(|| self.scene.page(self.state.page))
    }

    /// Shows the numbers of the scene, or hides them.
    pub(super) fn toggle_editor(&mut self) {
        let is_hidden = self.state.editor.take().is_none();
        self.state.editor = is_hidden.then(Editor::default);
    }

    /// Goes to the row so many rows on.
    pub(super) fn go_to_row(&mut self, rows: i32) {
        if let (Some(editor), Some(page)) = (&self.state.editor, self.page()) {
            let row = editor.row as i64 + i64::from(rows);
            let count = page.parameters.len() as i64 + 1;
            self.choose_row(row.rem_euclid(count) as usize);
        }
    }

    /// Goes to this row; what was typed is taken first.
    pub(super) fn choose_row(&mut self, row: usize) {
        self.enter();
        let last = self.page().map_or(0, |page| page.parameters.len());
        self.edit(|editor| editor.row = row.min(last));
    }

    /// Takes a letter of a number.
    pub(super) fn type_letter(&mut self, letter: char) {
        if self.state.editor.as_ref().is_some_and(|it| it.row > 0) {
            self.edit_typed(|typed| typed.push(letter));
        }
    }

    /// Changes what is typed.
    pub(super) fn edit_typed(&mut self, change: impl FnOnce(&mut String)) {
        self.edit(|editor| {
            editor.error = None;
            change(&mut editor.typed);
        });
    }

    /// Takes the number that was typed.
    pub(super) fn enter(&mut self) {
        let typed = self.state.editor.as_ref().map(|it| it.typed.clone());
        let (Some(typed), Some(parameter)) = (typed, self.chosen()) else {
            return;
        };
        if typed.is_empty() {
            return;
        }
        // What is no number is in no range.
        let number = typed.parse().unwrap_or(f64::NAN);
        self.set_number(parameter, number, Change::Single);
        self.edit(|editor| editor.typed.clear());
    }

    /// Changes the number of a row by so many steps; the first row goes through the pages.
    pub(super) fn step_number(&mut self, row: Option<usize>, steps: i32, size: StepSize) {
        if self.state.editor.is_none() {
            return;
        }
        if let Some(row) = row {
            self.choose_row(row);
        }
        self.edit_typed(String::clear);
        let Some(parameter) = self.chosen() else {
            let page = self.state.page as i64 + i64::from(steps);
            self.state.page = page.rem_euclid(self.scene.pages() as i64) as usize;
            return;
        };
        let by = f64::from(steps) * parameter.step() * size.factor();
        let number = self.scene.number(parameter) + by;
        let digits = format!("{number:.*e}", STEP_DIGITS - 1);
        let rounded = digits.parse().unwrap_or(number);
        self.set_number(parameter, rounded, Change::Number(parameter));
    }

    /// Moves a light, and those that stood where it stood when the drag began, `by` heights of the picture right and down:
    /// on the plane that faces the viewer, or away from the viewer by what is up.
    pub(super) fn drag_light(&mut self, light: usize, by: [f64; 2], in_depth: bool) {
        let Some(lights) = self.dragged_lights(light) else {
            return self.say(format!("there is no light {}", light.saturating_add(1)));
        };
        let lens = Lens::new(&self.view([1, 1]));
        let [right, up, forward] = lens.axes;
        let [across, down] = by;
        let way = if in_depth {
            forward * -down
        } else {
            right * across - up * down
        };
        let moved = |place: DVec3| {
            let w = lens.homogeneous(lens.seen(place)).z;
            place + way * (lens.pitch * w)
        };
        let entities = lights.iter().map(|it| self.scene.lights[*it]);
        let before: Vec<_> = entities.map(|it| (it, self.scene.editable(it))).collect();
        self.state.drag = Some(Drag::Lights(lights));
        for (entity, editable) in before.clone() {
            let place = moved(editable.transform.position);
            for axis in 0..3 {
                let parameter = Parameter {
                    entity,
                    property: Property::Position,
                    axis,
                };
                // A light that would leave the range of the format stays.
                let _ = self.scene.set_number(parameter, place[axis]);
            }
        }
        let before = Saved::Entities(before);
        self.history.note(before, Change::Drag, self.now);
        self.changed();
    }

    /// The lights that are dragged, or those at the place of this one, which are from now on.
    fn dragged_lights(&self, light: usize) -> Option<Vec<usize>> {
        if let Some(Drag::Lights(lights)) = &self.state.drag {
            return Some(lights.clone());
        }
        let place = |index: usize| {
            let is_somewhere = self.light(index)?.kind != LightKind::Ambient;
            let entity = self.scene.lights[index];
            is_somewhere.then(|| self.scene.editable(entity).transform.position)
        };
        let dragged = place(light)?;
        let lights = 0..self.scene.lights.len();
        Some(lights.filter(|it| place(*it) == Some(dragged)).collect())
    }

    /// Goes back or forth in the history of the scene, or says that there is `nothing` to go to.
    pub(super) fn travel(&mut self, go: fn(&mut History, &mut Scene) -> bool, nothing: &str) {
        if go(&mut self.history, &mut self.scene) {
            self.scene_changed();
        } else {
            self.say(nothing);
        }
    }

    /// Takes the scene's file as it was read again: the camera, its orbit, how all cuboids are shaded and that they turn
    /// stay.
    pub(super) fn reload(&mut self, mut scene: Scene) {
        let camera = self.scene.cameras[self.camera()];
        if let Some(same) = scene.find_camera(&self.name(camera)) {
            scene.look_from(same);
            scene.set_orbit(same, self.orbit());
        }
        if self.scene.is_shaded_otherwise() {
            scene.shade(self.shading());
        }
        for spin in scene.world.query_mut::<&mut Spin>() {
            *spin = self.spin();
        }
        let old = Saved::Scene(Box::new(std::mem::replace(&mut self.scene, scene)));
        self.history.note(old, Change::Single, self.now);
        self.state.scene_error = None;
        self.scene_changed();
        self.say("read the scene's file again");
    }

    /// The number of the chosen row.
    fn chosen(&self) -> Option<Parameter> {
        let row = self.state.editor.as_ref()?.row;
        let page = self.page()?;
        page.parameters.get(row.checked_sub(1)?).copied()
    }

    fn set_number(&mut self, parameter: Parameter, number: f64, change: Change) {
        let before = self.scene.editable(parameter.entity);
        let error = self.scene.set_number(parameter, number).err();
        if self.scene.editable(parameter.entity) != before {
            let before = Saved::Entities(vec![(parameter.entity, before)]);
            self.history.note(before, change, self.now);
            self.changed();
        }
        self.edit(|editor| editor.error = error);
    }

    /// The scene is another one than its history says: what was shown of it may be gone.
    pub(super) fn scene_changed(&mut self) {
        self.edit_typed(String::clear);
        self.state.page = self.state.page.min(self.scene.pages() - 1);
        self.state.drag = None;
        self.changed();
    }

    fn edit(&mut self, change: impl FnOnce(&mut Editor)) {
        self.state.editor.as_mut().map(change);
    }
}
