//! The panel: what is always in sight (modes, lights, why, segments, edges), and the headings of everything else.
//!
//! It shows widgets for components of the World, and writes their new values.

use std::path::Path;

use egui::{
    Align, Button, CollapsingHeader, ComboBox, Grid, Label, RichText, ScrollArea, TextWrapMode, Ui,
    vec2,
};
use hecs::{Entity, World};

use super::app::App;
use super::chart::chart;
use super::choice::Choice;
use super::controls::{has_face_normals, set_tolerance, shows_picture};
use super::desk::Desk;
use super::document::Document;
use super::help::about;
use super::inspector::{HEADINGS, Tab, content};
use super::keys::{Action, EXACT_SIDES, caption, keys};
use super::study::Study;
use super::widgets::{action_button, button, offer, scrolled, segment_buttons, slider};
use crate::components::range::Milliseconds;
use crate::components::{
    Camera, Light, LightKind, Name, Projection, ShadingMode, Side, ViewMode, Viewer, names,
    ordered, viewer, viewer_mut,
};
use crate::questions::job::camera_name;
use crate::scene::{BUILT_IN, EXTREMES, first_sentence};

/// The height of the outcome, in points: room for two lines, so that the rows below do not move.
const OUTCOME: f32 = 34.0;
/// The room of a light's key, in points.
const OF_LIGHT: f32 = 40.0;
/// The height of the list of scenes, in points.
const SCENES: f32 = 200.0;
/// The height of the list of lights, in points.
const LIGHTS: f32 = 140.0;
/// In a lower window, in points, the headings are one row.
const ONE_ROW: f32 = 650.0;

const NEW_NAME: &str = "The name of the next new file, without .toml; a path is allowed. \
                        A number is added if the name is taken.";

/// Lays out what is always in sight, and the headings below.
pub fn panel(ui: &mut Ui, app: &mut App) {
    let App {
        document,
        choice,
        desk,
        ..
    } = app;
    let world = &mut document.scene.world;
    let shading = choice.method(world).map(|method| method.mode);
    let shading = shading.filter(|_| shows_picture(&viewer(world)));
    ui.add_space(4.0);
    ui.horizontal_wrapped(|ui| {
        for mode in ShadingMode::ALL {
            offer(ui, desk, Action::Shading(mode), shading == Some(mode));
        }
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
pub fn headings(ui: &mut Ui, app: &mut App) {
    let is_low = ui.ctx().content_rect().height() < ONE_ROW;
    if is_low {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            ui.spacing_mut().button_padding.x = 3.0;
            for (tab, name, keys, says) in HEADINGS {
                let words = keys.split(' ').next().filter(|it| !it.is_empty());
                let words = words.unwrap_or(name);
                let heading = Button::selectable(app.desk.is_open(tab), words);
                let heading = ui.add(heading).on_hover_text(format!("{name}. {says}"));
                if heading.clicked() {
                    app.desk.switch(tab);
                }
            }
        });
    }
    scrolled(ui, "headings", |ui| {
        for (tab, name, keys, says) in HEADINGS {
            let is_open = app.desk.is_open(tab);
            if !is_low {
                let arrow = ["⏵", "⏷"][usize::from(is_open)];
                let heading = Button::selectable(is_open, name);
                let heading = heading.shortcut_text(format!("{keys} {arrow}"));
                let heading = heading.min_size(vec2(ui.available_width(), 0.0));
                let heading = ui.add(heading).on_hover_text(says);
                if heading.clicked() {
                    app.desk.switch(tab);
                }
                if app.desk.revealed.take_if(|it| *it == tab).is_some() {
                    heading.scroll_to_me(Some(Align::TOP));
                }
            }
            if tab == Tab::Scene && !is_open && app.document.is_edited() {
                path_row(ui, Action::Save, &app.document.target(false));
            }
            if is_open {
                ui.push_id(tab, |ui| content(ui, app, tab));
                ui.separator();
            }
        }
    });
}

/// The chart, and either the tolerance or the budget. `time` is that of a frame on screen, in milliseconds.
pub fn time_rows(
    ui: &mut Ui,
    world: &mut World,
    choice: &Choice,
    study: &Study,
    time: Option<f64>,
    desk: &mut Desk,
) {
    if desk.shows_times {
        chart(ui, study, choice, world);
    }
    let Viewer {
        budget, tolerance, ..
    } = *viewer(world);
    ui.horizontal_wrapped(|ui| {
        let error = ui.selectable_label(budget.is_none(), "hold the error");
        let says = "Every picture is drawn within the tolerance, however long it takes.";
        if error.on_hover_text(says).clicked() {
            choice.set_budget(world, None);
        }
        offer(ui, desk, Action::HoldTime, budget.is_some());
    });
    let Some(budget) = budget else {
        let mut changed = tolerance;
        let least = Viewer::LEAST_TOLERANCE;
        let words = ["tolerance", "[ ]", about("tolerance")];
        slider(ui, words, &mut changed, 0.0..=255.0, least);
        if changed != tolerance {
            set_tolerance(world, if changed < least { 0.0 } else { changed });
        }
        return;
    };
    let mut changed = budget;
    let words = ["budget, ms", "[ ]", about("budget")];
    slider(ui, words, &mut changed, Milliseconds::RANGE, 0.001);
    if changed != budget {
        choice.set_budget(world, Some(changed));
    }
    ui.scope(|ui| {
        ui.set_min_height(OUTCOME);
        ui.label(choice.outcome(&study.facts, time, budget));
    });
}

/// A row for each light.
pub fn light_rows(ui: &mut Ui, world: &World) {
    let lights = ordered::<Light>(world);
    if lights.is_empty() {
        ui.weak("The scene has no lights.");
    }
    let rows = |ui: &mut Ui, places: std::ops::Range<usize>| {
        // Long names are cut, so that keys keep their room.
        let name = ui.available_width() - OF_LIGHT;
        let grid = Grid::new("lights").num_columns(2).min_col_width(0.0);
        grid.max_col_width(name).show(ui, |ui| {
            ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
            for place in places {
                light_row(ui, world, lights[place], place);
                ui.end_row();
            }
        });
    };
    let height = ui.spacing().interact_size.y;
    let scroll = ScrollArea::vertical().id_salt("lights").max_height(LIGHTS);
    scroll.show_rows(ui, height, lights.len(), rows);
}

fn light_row(ui: &mut Ui, world: &World, entity: Entity, place: usize) {
    let mut query = world.query_one::<(&Name, &mut Light)>(entity);
    let Ok((name, light)) = query.get() else {
        return;
    };
    ui.checkbox(&mut light.on, &name.0)
        .on_hover_text(match light.kind {
            LightKind::Ambient => "Feeds the ambient term, which is the same everywhere.",
            LightKind::Diffuse => "Feeds the diffuse term, max(0, n.l).",
            LightKind::Specular => "Feeds the specular term, max(0, o.r)^shininess.",
        });
    let is_named = |it: &Action| matches!(it, Action::LightNamed(own) if *own == name.0);
    let named = keys().map(|key| key.2).find(is_named);
    ui.weak(caption(named.unwrap_or(Action::Light(place))));
}

/// The ways to show the picture, and the files of it.
pub fn picture_rows(ui: &mut Ui, world: &World, desk: &mut Desk) {
    let viewer = viewer(world);
    // Sides that the tags chose belong to none of the buttons.
    let shown = match viewer.show {
        ViewMode::Wipe if viewer.sides == EXACT_SIDES => Some(Action::WipeExact),
        ViewMode::Wipe if viewer.sides != Side::gouraud_phong(viewer.tolerance) => None,
        mode => Some(Action::View(mode)),
    };
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
pub fn camera_rows(ui: &mut Ui, world: &mut World, desk: &mut Desk) {
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
pub fn file_rows(ui: &mut Ui, document: &mut Document, desk: &mut Desk) {
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
        for action in [Action::Undo, Action::Redo, Action::Save] {
            offer(ui, desk, action, false);
        }
    });
    path_row(ui, Action::Save, &document.target(false));
    ui.horizontal(|ui| {
        offer(ui, desk, Action::SaveAs, false);
        let field = ui.text_edit_singleline(&mut document.file.new_name);
        field.on_hover_text(NEW_NAME);
    });
    path_row(ui, Action::SaveAs, &document.target(true));
}

/// The file that a key writes, and its folder.
fn path_row(ui: &mut Ui, action: Action, path: &Path) {
    let key = caption(action);
    let [name, folder] = [path.file_name(), path.parent().map(Path::as_os_str)]
        .map(|it| it.unwrap_or_default().display().to_string());
    let text = RichText::new(format!("{key} writes {name} in {folder}")).weak();
    ui.add(Label::new(text).truncate());
}
