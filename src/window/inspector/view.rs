//! The tabs of what is looked at: the ways to show the picture, and the camera.

use egui::{ComboBox, Ui};
use hecs::World;

use crate::components::{Camera, Projection, Side, ViewMode, Viewer, names, viewer, viewer_mut};
use crate::questions::job::camera_name;
use crate::window::desk::Desk;
use crate::window::keys::{Action, EXACT_SIDES, caption};
use crate::window::widgets::{action_button, offer};

/// The action that shows what is shown now. Sides that the tags chose belong to none.
pub fn picture_action(viewer: &Viewer) -> Option<Action> {
    match viewer.show {
        ViewMode::Wipe if viewer.sides == EXACT_SIDES => Some(Action::WipeExact),
        ViewMode::Wipe if viewer.sides != Side::gouraud_phong(viewer.tolerance) => None,
        mode => Some(Action::View(mode)),
    }
}

/// The ways to show the picture, and the files of it.
pub fn pictures_tab(ui: &mut Ui, world: &World, desk: &mut Desk) {
    let shown = picture_action(&viewer(world));
    ui.horizontal_wrapped(|ui| {
        for action in [
            Action::View(ViewMode::Picture),
            Action::View(ViewMode::Wipe),
            Action::WipeExact,
            Action::View(ViewMode::Error),
            Action::View(ViewMode::Tiles),
            Action::View(ViewMode::Terms),
        ] {
            offer(ui, desk, action, Some(action) == shown);
        }
        let hold = action_button(ui, Action::Blink, desk.blinks.is_some());
        let is_held = hold.is_pointer_button_down_on();
        if is_held || ui.input(|input| input.pointer.any_released()) {
            desk.blink_while(is_held);
        }
        for action in [Action::SavePicture, Action::Screenshot, Action::Panel] {
            offer(ui, desk, action, false);
        }
    });
}

/// The active camera and its projection.
pub fn camera_tab(ui: &mut Ui, world: &mut World, desk: &mut Desk) {
    let cameras = names::<Camera>(world);
    let mut active = camera_name(world);
    ui.horizontal(|ui| {
        let says = "The camera that is looked through.";
        ui.label("camera").on_hover_text(says);
        let choices = ComboBox::from_id_salt("camera").selected_text(&active);
        choices.show_ui(ui, |ui| {
            for name in cameras {
                ui.selectable_value(&mut active, name.clone(), name);
            }
        });
        ui.weak(caption(Action::NextCamera));
    });
    let Viewer {
        mut projection,
        turns,
        ..
    } = *viewer(world);
    ui.horizontal_wrapped(|ui| {
        for each in Projection::ALL {
            ui.selectable_value(&mut projection, each, each.name());
        }
        ui.weak(caption(Action::NextProjection));
    });
    let mut viewer = viewer_mut(world);
    (viewer.camera, viewer.projection) = (Some(active), projection);
    ui.horizontal_wrapped(|ui| {
        offer(ui, desk, Action::Rotate, turns);
        offer(ui, desk, Action::ShowAll, false);
    });
}
