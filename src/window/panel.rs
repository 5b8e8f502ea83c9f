//! The panel on the left: shading, lights, views, camera, scene.
//!
//! It shows widgets for components of the World, and writes their new values.

use egui::{
    CollapsingHeader, ComboBox, Grid, PopupCloseBehavior, RichText, ScrollArea, TextEdit,
    TextWrapMode, Ui,
};
use hecs::{Entity, World};

use super::app::App;
use super::chart::chart;
use super::choice::Choice;
use super::controls::{has_face_normals, set_tolerance};
use super::desk::{Command, Desk};
use super::document::Document;
use super::facts::Facts;
use super::inspector::Tab;
use super::keys::{Action, EXACT_SIDES, caption, keys};
use super::varied::common_keys;
use super::widgets::{
    action_button, color_button, number, offer, slider, slider_beside, vary_button,
};
use super::words::about;
use crate::components::range::{self, Milliseconds, Strength};
use crate::components::{
    Camera, Light, LightKind, Name, Projection, Segments, ShadingMode, Side, ViewMode, Viewer,
    common, names, ordered, overwrite, viewer, viewer_mut,
};
use crate::questions::job::camera_name;
use crate::scene::key::Key;
use crate::scene::{BUILT_IN, EXTREMES, LESSONS, Scene, first_sentence, title};

const SEGMENTS: [&str; 3] = [
    "segments",
    ", .",
    "Equal parts of each edge of a face. Gouraud computes light at the corners of the grid that they make; Phong does not depend on them.",
];

/// The height of the outcome, in points: room for two lines, so that the rows below do not move.
const OUTCOME: f32 = 34.0;
/// The room of a light's colour, strength, key and button, in points.
const OF_LIGHT: f32 = 134.0;

const NEW_NAME: &str = "The name of the next new file, without .toml; a path is allowed. \
                        A number is added if the name is taken.";

/// Lays out all sections.
pub fn panel(ui: &mut Ui, app: &mut App) {
    let time = app.milliseconds();
    let App {
        document,
        study,
        choice,
        desk,
        ..
    } = app;
    let world = &mut document.scene.world;
    if desk.shows_times {
        chart(ui, study, choice, world, desk);
    }
    section(ui, "Shading", |ui| {
        shading_rows(ui, world, choice, &study.facts, time, desk);
    });
    section(ui, "Lights", |ui| light_rows(ui, world, desk));
    section(ui, "View", |ui| view_rows(ui, &viewer(world), desk));
    section(ui, "Camera", |ui| camera_rows(ui, world, desk));
    section(ui, "Scene", |ui| scene_rows(ui, document, desk));
}

/// The mode, and either the tolerance or the budget. `time` is that of a frame on screen, in milliseconds.
fn shading_rows(
    ui: &mut Ui,
    world: &mut World,
    choice: &Choice,
    facts: &Facts,
    time: Option<f64>,
    desk: &mut Desk,
) {
    let shading = choice.method(world).map(|method| method.mode);
    ui.horizontal_wrapped(|ui| {
        for mode in ShadingMode::ALL {
            offer(ui, desk, Action::Shading(mode), shading == Some(mode));
        }
        offer(ui, desk, Action::FaceNormals, has_face_normals(world));
    });
    let count = common::<Segments>(world).map_or(1.0, |it| it.count() as f64);
    let mut changed = count;
    let segments = range::of_key("segments");
    slider_beside(ui, SEGMENTS, &mut changed, segments, 1.0, |ui| {
        vary_common(ui, world, "segments", desk);
    });
    if changed != count
        && let Some(segments) = Segments::new(changed.round() as u32)
    {
        overwrite(world, &segments);
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
        slider_beside(ui, words, &mut changed, 0.0..=255.0, least, |ui| {
            vary_common(ui, world, "tolerance", desk);
        });
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
        ui.label(choice.outcome(facts, time, budget));
    });
}

/// The button that varies one of the common numbers.
fn vary_common(ui: &mut Ui, world: &World, name: &str, desk: &mut Desk) {
    if vary_button(ui) {
        let keys = common_keys(world).into_iter();
        let key = keys.filter(|it| it.0 == name).map(|it| it.1).next();
        desk.commands.extend(key.map(Command::Vary));
    }
}

/// A row for each light.
pub fn light_rows(ui: &mut Ui, world: &World, desk: &mut Desk) {
    let lights = ordered::<Light>(world);
    if lights.is_empty() {
        ui.weak("The scene has no lights.");
    }
    let rows = |ui: &mut Ui, places: std::ops::Range<usize>| {
        // Long names are cut, so that colour, strength and key keep their room.
        let name = ui.available_width() - OF_LIGHT;
        let grid = Grid::new("lights").num_columns(5).min_col_width(0.0);
        grid.max_col_width(name).show(ui, |ui| {
            ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
            for place in places {
                light_row(ui, world, lights[place], place, desk);
                ui.end_row();
            }
        });
    };
    let height = ui.spacing().interact_size.y;
    let scroll = ScrollArea::vertical().id_salt("lights").max_height(260.0);
    scroll.show_rows(ui, height, lights.len(), rows);
}

fn light_row(ui: &mut Ui, world: &World, entity: Entity, place: usize, desk: &mut Desk) {
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
    color_button(ui, &mut light.color);
    let says = "Intensity of the light, 0 to 1e30: a factor of its term.";
    number(ui, &mut light.intensity, Strength::RANGE).on_hover_text(says);
    if vary_button(ui) {
        let key = Key::from("light").child(&name.0).child("intensity");
        desk.commands.push(Command::Vary(key));
    }
}

/// The ways to show the picture.
fn view_rows(ui: &mut Ui, viewer: &Viewer, desk: &mut Desk) {
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
    });
}

/// The active camera and its projection.
fn camera_rows(ui: &mut Ui, world: &mut World, desk: &mut Desk) {
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
        ui.label("distance");
        vary_common(ui, world, "distance", desk);
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

/// The list of scenes, and the scene's file.
fn scene_rows(ui: &mut Ui, document: &mut Document, desk: &mut Desk) {
    let scenes = ComboBox::from_id_salt("scene").selected_text(document.scene.name.clone());
    let scenes = scenes.close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let scenes = scenes.width(ui.available_width() - 8.0).height(400.0);
    let chosen = scenes.show_ui(ui, |ui| scene_list(ui, &document.scene.name));
    match chosen.inner.flatten().map(|name| Scene::load(Some(name))) {
        Some(Ok(scene)) => desk.commands.push(Command::Open(Box::new(scene))),
        Some(Err(error)) => desk.say(error.to_string()),
        None => {}
    }
    ui.horizontal_wrapped(|ui| {
        for action in [
            Action::Tab(Tab::Scene),
            Action::Undo,
            Action::Redo,
            Action::Save,
            Action::Help,
        ] {
            offer(ui, desk, action, false);
        }
    });
    ui.horizontal(|ui| {
        offer(ui, desk, Action::SaveAs, false);
        let field = ui.text_edit_singleline(&mut document.file.new_name);
        field.on_hover_text(NEW_NAME);
    });
}

/// Lays out the built-in scenes, lessons and extremes whose name or sentence has the typed words. Returns the chosen name.
fn scene_list(ui: &mut Ui, open: &str) -> Option<&'static str> {
    let id = ui.id().with("search");
    let mut words: String = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    ui.add(TextEdit::singleline(&mut words).hint_text("search"));
    let mut chosen = None;
    for (group, scenes) in [
        ("lessons", &LESSONS[..]),
        ("scenes", &BUILT_IN[..]),
        ("extremes", EXTREMES),
    ] {
        ui.strong(group);
        for (name, text) in scenes {
            let says = first_sentence(text);
            let is_lesson = group == "lessons";
            let shown = if is_lesson {
                title(name)
            } else {
                (*name).to_owned()
            };
            let lower = format!("{name} {shown} {says}").to_lowercase();
            if words
                .split_whitespace()
                .any(|word| !lower.contains(&word.to_lowercase()))
            {
                continue;
            }
            let row = ui
                .selectable_label(open == *name, shown)
                .on_hover_text(says);
            if row.clicked() {
                chosen = Some(*name);
                ui.close();
            }
        }
    }
    if chosen.is_some() {
        words.clear();
    }
    ui.data_mut(|data| data.insert_temp(id, words));
    chosen
}

/// A section of the panel that can be folded.
fn section(ui: &mut Ui, title: &str, rows: impl FnOnce(&mut Ui)) {
    let header = CollapsingHeader::new(RichText::new(title).strong()).default_open(true);
    header.show_unindented(ui, rows);
}
