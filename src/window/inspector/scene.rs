//! The scene's tab: every number of every entity, and entities added, duplicated and deleted.

use std::ops::RangeInclusive;

use egui::{Button, ComboBox, DragValue, Grid, ScrollArea, Slider, TextEdit, TextStyle, Ui, vec2};
use glam::DVec3;
use hecs::Entity;

use super::{color_button, format_number, keep_digits};
use crate::components::{
    Background, Camera, Light, LightKind, Material, Mesh, Name, Orbit, ShadingMode, Transform,
    Viewpoint, active_camera, get, ordered,
};
use crate::scene::{CameraRecord, LightRecord, SceneRecord, range};
use crate::window::app::App;

/// The kinds of entities that a scene holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Cuboid,
    Light,
    Camera,
}

impl Kind {
    const ALL: [Kind; 3] = [Kind::Cuboid, Kind::Light, Kind::Camera];

    fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}

/// A number of the scene, or three of them.
struct Field {
    name: &'static str,
    range: RangeInclusive<f64>,
    says: &'static str,
}

const fn field(name: &'static str, range: RangeInclusive<f64>, says: &'static str) -> Field {
    Field { name, range, says }
}

#[rustfmt::skip]
mod fields {
    use super::{Field, field, range};

    pub const BACKGROUND: Field = field("background", range::DisplayLevel::RANGE, "Levels of 255 where nothing is drawn");
    pub const SIZE: Field = field("size", range::Length::RANGE, "Edge lengths, in world units");
    pub const CENTRE: Field = field("position", range::Coordinate::RANGE, "Centre, in world units");
    pub const ROTATION: Field = field("rotation", range::Angle::RANGE, "Degrees about the x, y and z axes, in this order");
    pub const AMBIENT: Field = field("ambient", range::Strength::RANGE, "Reflected share of ambient light");
    pub const DIFFUSE: Field = field("diffuse", range::Strength::RANGE, "Reflected share of diffuse light");
    pub const SPECULAR: Field = field("specular", range::Strength::RANGE, "Reflected share of specular light");
    pub const COLOR: Field = field("color", range::Strength::RANGE, "Share of full strength by channel");
    pub const INTENSITY: Field = field("intensity", range::Strength::RANGE, "Strength of the light");
    pub const GAIN: Field = field("gain", range::Strength::RANGE, "Levels of 255 for each unit of intensity");
    pub const PLACE: Field = field("position", range::Coordinate::RANGE, "World units. Its disc in the picture can be dragged, with Shift in depth");
    pub const EYE: Field = field("position", range::Coordinate::RANGE, "The eye, in world units");
    pub const TARGET: Field = field("target", range::Coordinate::RANGE, "The point it looks at, in world units");
    pub const UP: Field = field("up", range::Coordinate::RANGE, "The direction that is up in the picture");
    pub const FOV: Field = field("fov", range::FieldOfView::RANGE, "Vertical field of view in degrees; perspective");
    pub const HEIGHT: Field = field("height", range::Length::RANGE, "World units seen vertically; orthographic");
    pub const NEAR: Field = field("near", range::Length::RANGE, "Distance of the near plane; else a thousandth of the distance to the target");
    pub const AZIMUTH: Field = field("azimuth", range::OrbitAngle::RANGE, "Degrees that the camera was moved to the right");
    pub const ELEVATION: Field = field("elevation", range::OrbitAngle::RANGE, "Degrees that the camera was moved up");
    pub const ZOOM: Field = field("zoom", range::Zoom::RANGE, "Factor of the distance and of the height");
}

impl App {
    pub fn scene_tab(&mut self, ui: &mut Ui) {
        self.entity_list(ui);
        self.entity_buttons(ui);
        ui.separator();
        if let Some((kind, name)) = self.desk.selected.clone()
            && let Some(entity) = self.find(kind, &name)
        {
            self.name_row(ui, kind, entity, &name);
            match kind {
                Kind::Cuboid => self.cuboid_numbers(ui, entity),
                Kind::Light => self.light_numbers(ui, entity),
                Kind::Camera => self.camera_numbers(ui, entity),
            }
            ui.separator();
        }
        let Background(before) = self.look();
        let mut levels = before;
        Grid::new("background").show(ui, |ui| fields::BACKGROUND.vector(ui, &mut levels));
        if levels != before {
            self.set_look(Background(levels));
        }
    }

    /// The entities of a kind, in the order of the file.
    fn entities(&self, kind: Kind) -> Vec<(Entity, String)> {
        let world = &self.scene.world;
        let entities = match kind {
            Kind::Cuboid => ordered::<Mesh>(world),
            Kind::Light => ordered::<Light>(world),
            Kind::Camera => ordered::<Camera>(world),
        };
        let named = entities.into_iter().filter_map(|entity| {
            let Name(name) = get(world, entity)?;
            Some((entity, name))
        });
        named.collect()
    }

    fn find(&self, kind: Kind, name: &str) -> Option<Entity> {
        let mut entities = self.entities(kind).into_iter();
        let (entity, _) = entities.find(|(_, own)| own == name)?;
        Some(entity)
    }

    fn entity_list(&mut self, ui: &mut Ui) {
        let of_kind = |kind| {
            let entities = self.entities(kind).into_iter();
            entities.map(move |(_, name)| (kind, name))
        };
        let all: Vec<(Kind, String)> = Kind::ALL.into_iter().flat_map(of_kind).collect();
        let selected = self.desk.selected.get_or_insert_with(|| all[0].clone());
        let height = ui.text_style_height(&TextStyle::Body) + 4.0;
        let scroll = ScrollArea::vertical().id_salt("entities").max_height(150.0);
        scroll.show_rows(ui, height, all.len(), |ui, rows| {
            for each in &all[rows] {
                let row = Button::selectable(selected == each, &each.1);
                let row = row.shortcut_text(each.0.name());
                let row = row.min_size(vec2(ui.available_width(), 0.0));
                if ui.add(row).clicked() {
                    each.clone_into(selected);
                }
            }
        });
    }

    /// Buttons that add and delete. They write a record, from which the World is spawned.
    fn entity_buttons(&mut self, ui: &mut Ui) {
        let selected = self.desk.selected.clone();
        ui.horizontal_wrapped(|ui| {
            for kind in Kind::ALL {
                let add = ui.small_button(format!("add {}", kind.name()));
                let says = "Adds a copy of the selected one beside it, or of the last. A camera is added where the \
                            picture is seen from now.";
                if add.on_hover_text(says).clicked() {
                    self.add(kind, selected.as_ref());
                }
            }
            let Some((kind, name)) = selected.as_ref() else {
                return;
            };
            let is_last = *kind != Kind::Light && self.entities(*kind).len() == 1;
            let delete = ui.add_enabled(!is_last, Button::new("delete").small());
            let says = "A scene has at least one.";
            if delete.on_disabled_hover_text(says).clicked() {
                self.delete(*kind, name);
            }
        });
    }

    fn add(&mut self, kind: Kind, selected: Option<&(Kind, String)>) {
        let world = &self.scene.world;
        let mut record = SceneRecord::of(world);
        let seen = Viewpoint::of(world, active_camera(world));
        let own = self.entities(kind);
        let numbered = (2..).map(|number| format!("{} {number}", kind.name()));
        let mut names = std::iter::once(kind.name()).chain(numbered);
        let is_free = |name: &String| own.iter().all(|(_, taken)| taken != name);
        let name = names.find(is_free).unwrap_or_default();
        let place =
            selected.and_then(|it| own.iter().position(|own| (kind, &own.1) == (it.0, &it.1)));
        let place = place.unwrap_or(own.len().saturating_sub(1));
        match kind {
            Kind::Cuboid => {
                let mut copy = record.cuboid[place].clone();
                copy.position.x += 1.25 * copy.size.x;
                copy.name.clone_from(&name);
                record.cuboid.push(copy);
            }
            Kind::Light => {
                let new = || LightRecord::new("", LightKind::Diffuse, 100.0, seen.position);
                let copy = record.light.get(place).cloned().unwrap_or_else(new);
                let name = name.clone();
                record.light.push(LightRecord { name, ..copy });
            }
            Kind::Camera => {
                let sees = [seen.camera.fov, seen.camera.height];
                let camera = CameraRecord::new(&name, seen.position, seen.camera.target, sees);
                record.camera.push(CameraRecord {
                    up: seen.camera.up,
                    near: seen.camera.near,
                    ..camera
                });
            }
        }
        self.restore(&record);
        self.desk.selected = Some((kind, name));
    }

    fn delete(&mut self, kind: Kind, name: &str) {
        let mut record = SceneRecord::of(&self.scene.world);
        match kind {
            Kind::Cuboid => record.cuboid.retain(|it| it.name != name),
            Kind::Light => record.light.retain(|it| it.name != name),
            Kind::Camera => {
                record.camera.retain(|it| it.name != name);
                record.view.camera.take_if(|camera| camera == name);
            }
        }
        self.restore(&record);
        self.desk.selected = None;
    }

    fn name_row(&mut self, ui: &mut Ui, kind: Kind, entity: Entity, name: &str) {
        ui.horizontal(|ui| {
            ui.label("name")
                .on_hover_text("Unique among entities of its kind.");
            let id = ui.id().with(("name", name));
            let typed = ui.data_mut(|data| data.get_temp::<String>(id));
            let mut text = typed.unwrap_or_else(|| name.to_owned());
            let field = ui.add(TextEdit::singleline(&mut text).desired_width(140.0));
            if field.lost_focus() {
                ui.data_mut(|data| data.remove::<String>(id));
                self.rename(kind, entity, name, &text);
            } else {
                ui.data_mut(|data| data.insert_temp(id, text));
            }
        });
    }

    fn rename(&mut self, kind: Kind, entity: Entity, before: &str, name: &str) {
        if name == before {
            return;
        }
        let is_list = name.contains(',') || name == "all" || name == "none";
        let is_name = !name.is_empty() && (kind != Kind::Light || !is_list);
        if !is_name || self.find(kind, name).is_some() {
            return self.say(format!("{name:?} is taken, or cannot be a name"));
        }
        // The entity was just found.
        let _ = self.scene.world.insert_one(entity, Name(name.to_owned()));
        self.desk.selected = Some((kind, name.to_owned()));
    }

    fn cuboid_numbers(&self, ui: &mut Ui, entity: Entity) {
        let world = &self.scene.world;
        let mut query =
            world.query_one::<(&mut Transform, &mut Mesh, &mut Material, &mut ShadingMode)>(entity);
        let Ok((transform, mesh, material, mode)) = query.get() else {
            return;
        };
        let mut size = mesh.size();
        Grid::new("cuboid").show(ui, |ui| {
            fields::SIZE.vector(ui, &mut size);
            fields::CENTRE.vector(ui, &mut transform.position);
            fields::ROTATION.vector(ui, &mut transform.rotation);
            fields::AMBIENT.color(ui, &mut material.ambient);
            fields::DIFFUSE.color(ui, &mut material.diffuse);
            fields::SPECULAR.color(ui, &mut material.specular);
        });
        if size != mesh.size() {
            *mesh = Mesh::cuboid(size);
        }
        shininess_row(ui, material);
        ui.horizontal(|ui| {
            ui.label("shading");
            ui.radio_value(mode, ShadingMode::Gouraud, "gouraud");
            ui.radio_value(mode, ShadingMode::Phong, "phong");
        });
    }

    fn light_numbers(&self, ui: &mut Ui, entity: Entity) {
        let mut query = self
            .scene
            .world
            .query_one::<(&mut Transform, &mut Light)>(entity);
        let Ok((transform, light)) = query.get() else {
            return;
        };
        ui.horizontal(|ui| {
            ui.checkbox(&mut light.on, "on");
            let kinds = ComboBox::from_id_salt("kind").selected_text(light.kind.name());
            kinds.show_ui(ui, |ui| {
                for kind in LightKind::ALL {
                    ui.selectable_value(&mut light.kind, kind, kind.name());
                }
            });
        });
        Grid::new("light").show(ui, |ui| {
            fields::COLOR.color(ui, &mut light.color);
            fields::INTENSITY.number(ui, &mut light.intensity);
            fields::GAIN.number(ui, &mut light.gain);
            if light.kind != LightKind::Ambient {
                fields::PLACE.vector(ui, &mut transform.position);
            }
        });
    }

    fn camera_numbers(&self, ui: &mut Ui, entity: Entity) {
        let world = &self.scene.world;
        let mut query = world.query_one::<(&mut Transform, &mut Camera, &mut Orbit)>(entity);
        let Ok((transform, camera, orbit)) = query.get() else {
            return;
        };
        Grid::new("camera").show(ui, |ui| {
            fields::EYE.vector(ui, &mut transform.position);
            fields::TARGET.vector(ui, &mut camera.target);
            fields::UP.vector(ui, &mut camera.up);
            fields::FOV.number(ui, &mut camera.fov);
            fields::HEIGHT.number(ui, &mut camera.height);
            let mut near = camera.near_from(transform.position);
            let before = near;
            fields::NEAR.number(ui, &mut near);
            if near != before {
                camera.near = Some(near);
            }
            fields::AZIMUTH.number(ui, &mut orbit.azimuth);
            fields::ELEVATION.number(ui, &mut orbit.elevation);
            fields::ZOOM.number(ui, &mut orbit.zoom);
        });
    }
}

impl Field {
    /// A row with one number.
    fn number(&self, ui: &mut Ui, value: &mut f64) {
        ui.label(self.name).on_hover_text(self.says);
        self.drag(ui, value);
        ui.end_row();
    }

    /// A row with three numbers.
    fn vector(&self, ui: &mut Ui, value: &mut DVec3) {
        ui.label(self.name).on_hover_text(self.says);
        for axis in 0..3 {
            self.drag(ui, &mut value[axis]);
        }
        ui.end_row();
    }

    /// A row with three channels and their colour.
    fn color(&self, ui: &mut Ui, value: &mut DVec3) {
        ui.horizontal(|ui| {
            ui.label(self.name).on_hover_text(self.says);
            color_button(ui, value);
        });
        for channel in 0..3 {
            self.drag(ui, &mut value[channel]);
        }
        ui.end_row();
    }

    /// A number that is dragged, or clicked and typed. A drag changes it by a share of itself, to reach any magnitude.
    fn drag(&self, ui: &mut Ui, value: &mut f64) {
        let [least, most] =
            [self.range.start(), self.range.end()].map(|it| format_number(*it, 0..=0));
        let (before, speed) = (*value, (value.abs() * 0.01).max(0.01));
        let drag = DragValue::new(value).speed(speed).range(self.range.clone());
        let drag = ui.add(drag.custom_formatter(format_number));
        drag.on_hover_text(format!(
            "{}.\nDrag it, or click and type a number, {least} to {most}.",
            self.says
        ));
        keep_digits(before, value);
    }
}

/// The strength of a light.
pub fn intensity(ui: &mut Ui, value: &mut f64) {
    fields::INTENSITY.drag(ui, value);
}

/// A slider for the exponent of the highlight.
pub fn shininess_row(ui: &mut Ui, material: &mut Material) {
    ui.horizontal(|ui| {
        ui.label("shininess");
        let before = material.shininess;
        let slider =
            Slider::new(&mut material.shininess, range::Shininess::RANGE).logarithmic(true);
        let slider = slider
            .smallest_positive(0.1)
            .custom_formatter(format_number);
        ui.add(slider)
            .on_hover_text("The exponent of the highlight, 0 to 1e6.");
        keep_digits(before, &mut material.shininess);
    });
}
