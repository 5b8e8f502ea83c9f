//! The panel: what is always in sight (modes, lights, why, segments, edges), and the headings of everything else.
//!
//! It shows widgets for components of the World, and writes their new values.

use std::path::Path;

use egui::{
    Align, Button, CollapsingHeader, Grid, Label, RichText, ScrollArea, TextWrapMode, Ui, vec2,
};
use hecs::{Entity, World};

use super::app::App;
use super::controls::{has_face_normals, shows_picture};
use super::desk::Desk;
use super::document::Document;
use super::help::about;
use super::inspector::{HEADINGS, content, picture_action};
use super::keys::{Action, caption, keys};
use super::widgets::{button, offer, scrolled, segment_buttons};
use crate::components::{Light, Name, ShadingMode, ViewMode, ordered, viewer};
use crate::scene::{BUILT_IN, EXTREMES, first_sentence};

/// The room of a light's key, in points.
const OF_LIGHT: f32 = 40.0;
/// The height of the list of scenes, in points.
const SCENES: f32 = 200.0;
/// The height of the list of lights, in points.
const LIGHTS: f32 = 140.0;
/// In a lower window, in points, the headings are one row.
const ONE_ROW: f32 = 650.0;

/// Lays out what is always in sight, and the headings below.
pub fn panel(ui: &mut Ui, app: &mut App) {
    let method = app.method().filter(|_| shows_picture(&app.viewer()));
    let (world, desk) = (&app.document.scene.world, &mut app.desk);
    ui.add_space(4.0);
    ui.horizontal_wrapped(|ui| {
        for mode in ShadingMode::ALL {
            let is_shown = method.is_some_and(|it| it.mode == mode);
            offer(ui, desk, Action::Shading(mode), is_shown);
        }
        let shown = picture_action(&viewer(world));
        let both = Action::View(ViewMode::Wipe);
        offer(ui, desk, both, shown == Some(both));
    });
    light_rows(ui, world);
    ui.horizontal_wrapped(|ui| {
        button(ui, desk, "Why?", Action::Worst);
        segment_buttons(ui, world, desk);
    });
    ui.horizontal_wrapped(|ui| {
        offer(ui, desk, Action::FaceNormals, has_face_normals(world));
        offer(ui, desk, Action::Help, desk.help);
    });
    ui.separator();
    headings(ui, app);
}

/// Lays out the headings, each with its content if it is open. In a low window they are one row of their keys.
fn headings(ui: &mut Ui, app: &mut App) {
    let is_low = ui.ctx().content_rect().height() < ONE_ROW;
    if is_low {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            ui.spacing_mut().button_padding.x = 3.0;
            for (tab, name, keys, says) in HEADINGS {
                let letter = keys.split(' ').next().unwrap_or(name);
                let heading = ui.selectable_label(app.desk.is_open(tab), letter);
                if heading.on_hover_text(format!("{name}. {says}")).clicked() {
                    app.desk.switch(tab);
                }
            }
        });
    }
    scrolled(ui, "headings", |ui| {
        for (tab, name, keys, says) in HEADINGS {
            let is_open = app.desk.is_open(tab);
            if !is_low {
                let arrow = if is_open { "⏷" } else { "⏵" };
                let button = Button::selectable(is_open, name)
                    .shortcut_text(format!("{keys} {arrow}"))
                    .min_size(vec2(ui.available_width(), 0.0));
                let heading = ui.add(button).on_hover_text(says);
                if heading.clicked() {
                    app.desk.switch(tab);
                }
                if app.desk.revealed.take_if(|it| *it == tab).is_some() {
                    heading.scroll_to_me(Some(Align::TOP));
                }
            }
            if is_open {
                ui.push_id(tab, |ui| content(ui, app, tab));
                ui.separator();
            }
        }
    });
}

/// A row for each light.
pub fn light_rows(ui: &mut Ui, world: &World) {
    let lights = ordered::<Light>(world);
    if lights.is_empty() {
        ui.weak("The scene has no lights.");
    }
    let scroll = ScrollArea::vertical().id_salt("lights").max_height(LIGHTS);
    scroll.show(ui, |ui| {
        // Long names are cut, so that keys keep their room.
        let name = ui.available_width() - OF_LIGHT;
        let grid = Grid::new("lights").num_columns(2).min_col_width(0.0);
        grid.max_col_width(name).show(ui, |ui| {
            ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
            for (place, light) in lights.into_iter().enumerate() {
                light_row(ui, world, light, place);
                ui.end_row();
            }
        });
    });
}

/// Lays out the switch of a light, its kind and its key.
pub fn light_row(ui: &mut Ui, world: &World, entity: Entity, place: usize) {
    let mut query = world.query_one::<(&Name, &mut Light)>(entity);
    let Ok((name, light)) = query.get() else {
        return;
    };
    let kind = light.kind.name();
    let words = if name.0 == kind {
        kind.to_owned()
    } else {
        format!("{} {kind}", name.0)
    };
    let switch = ui.checkbox(&mut light.on, words);
    switch.on_hover_text(about(kind));
    let is_named = |it: &Action| matches!(it, Action::LightNamed(own) if *own == name.0);
    let named = keys().map(|key| key.2).find(is_named);
    ui.weak(caption(named.unwrap_or(Action::Light(place))));
}

/// Rows of built-in scenes, each with its words. A click opens one.
pub fn scene_rows(
    ui: &mut Ui,
    scenes: &[(&'static str, &str)],
    words: fn(&str) -> String,
    open: &str,
    desk: &mut Desk,
) {
    for (name, text) in scenes {
        let row = ui.selectable_label(open == *name, words(name));
        if row.on_hover_text(first_sentence(text)).clicked() {
            desk.wish(Action::Open(name));
        }
    }
}

/// The list of scenes, undo, and the scene's file.
pub fn file_rows(ui: &mut Ui, document: &Document, desk: &mut Desk) {
    let scenes = CollapsingHeader::new("other scenes");
    scenes.show_unindented(ui, |ui| {
        let scroll = ScrollArea::vertical().id_salt("scenes").max_height(SCENES);
        scroll.show(ui, |ui| {
            for (group, scenes) in [("scenes", &BUILT_IN[..]), ("extremes", EXTREMES)] {
                ui.strong(group);
                scene_rows(ui, scenes, str::to_owned, &document.scene.name, desk);
            }
        });
    });
    ui.horizontal_wrapped(|ui| {
        for action in [Action::Undo, Action::Redo, Action::Save, Action::SaveAs] {
            offer(ui, desk, action, false);
        }
    });
    path_row(ui, Action::Save, &document.target(false));
    path_row(ui, Action::SaveAs, &document.target(true));
}

/// The file that a key writes, and its folder.
pub fn path_row(ui: &mut Ui, action: Action, path: &Path) {
    let key = caption(action);
    let [name, folder] = [path.file_name(), path.parent().map(Path::as_os_str)]
        .map(|it| it.unwrap_or_default().display().to_string());
    let text = RichText::new(format!("{key} writes {name} in {folder}")).weak();
    ui.add(Label::new(text).truncate());
}
