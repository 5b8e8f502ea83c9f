//! A number of the scene by name in, its value out; a new value in, a component written.
//!
//! ```text
//! Page (a light, a cuboid's shape, its material, a camera) --> Parameters --number, set_number--> components
//! ```
//! Rule: a number is allowed here exactly where the scene file allows it, and what is refused changes nothing.

use glam::DVec3;
use hecs::{Component, Entity};

use super::Scene;
use super::keys::{Angle, Coordinate, FieldOfView, Form, Interval, Length, Shininess, Strength};
use crate::components::{Camera, Light, LightKind, Material, Mesh, Transform};

/// What of an entity can be changed, by the scene file's keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    Position,
    Rotation,
    Size,
    Ambient,
    Diffuse,
    Specular,
    Shininess,
    Color,
    Intensity,
    Gain,
    FieldOfView,
    Height,
    Near,
}

/// What the numbers of a property are called.
const SPACE: &[&str] = &[" x", " y", " z"];
const CHANNELS: &[&str] = &[" red", " green", " blue"];
const ALONE: &[&str] = &[""];

/// The number if the scene file allows it, or what it allows in words.
type Check = fn(f64) -> Result<f64, String>;

fn within<I: Interval>(number: f64) -> Result<f64, String> {
    I::number(number + 0.0).ok_or_else(I::words)
}

impl Property {
    /// Its key in the scene file, the names of its numbers, what a step changes one by, and what is allowed.
    fn key(self) -> (&'static str, &'static [&'static str], f64, Check) {
        match self {
            Property::Position => ("position", SPACE, 0.1, within::<Coordinate>),
            Property::Rotation => ("rotation", SPACE, 1.0, within::<Angle>),
            Property::Size => ("size", SPACE, 0.1, within::<Length>),
            Property::Ambient => ("ambient", CHANNELS, 0.01, within::<Strength>),
            Property::Diffuse => ("diffuse", CHANNELS, 0.01, within::<Strength>),
            Property::Specular => ("specular", CHANNELS, 0.01, within::<Strength>),
            Property::Shininess => ("shininess", ALONE, 1.0, within::<Shininess>),
            Property::Color => ("color", CHANNELS, 0.01, within::<Strength>),
            Property::Intensity => ("intensity", ALONE, 1.0, within::<Strength>),
            Property::Gain => ("gain", ALONE, 0.1, within::<Strength>),
            Property::FieldOfView => ("fov", ALONE, 1.0, within::<FieldOfView>),
            Property::Height => ("height", ALONE, 0.1, within::<Length>),
            Property::Near => ("near", ALONE, 0.01, within::<Length>),
        }
    }
}

/// One number of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parameter {
    pub entity: Entity,
    pub property: Property,
    /// Which of the property's numbers.
    pub axis: usize,
}

impl Parameter {
    /// What the scene file calls it, and which of three it is.
    pub fn name(self) -> String {
        let (key, axes, ..) = self.property.key();
        format!("{key}{}", axes[self.axis])
    }

    /// What a step changes it by.
    pub fn step(self) -> f64 {
        self.property.key().2
    }
}

/// What is shown together of a light that has a place, of a cuboid twice, and of a camera.
const LIGHT: &[Property] = &[
    Property::Position,
    Property::Color,
    Property::Intensity,
    Property::Gain,
];
const SHAPE: &[Property] = &[Property::Size, Property::Position, Property::Rotation];
const MATERIAL: &[Property] = &[
    Property::Ambient,
    Property::Diffuse,
    Property::Specular,
    Property::Shininess,
];
const CAMERA: &[Property] = &[Property::FieldOfView, Property::Height, Property::Near];

/// The numbers of an entity that are shown together.
#[derive(Clone, Debug, PartialEq)]
pub struct Page {
    pub entity: Entity,
    /// What the entity is, and what of it is shown.
    pub kind: &'static str,
    pub parameters: Vec<Parameter>,
}

/// Everything of an entity that can be changed; of a component that it lacks there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Editable {
    pub transform: Transform,
    size: Option<DVec3>,
    material: Option<Material>,
    light: Option<Light>,
    camera: Option<Camera>,
}

impl Editable {
    fn slot(&mut self, property: Property, axis: usize) -> Option<&mut f64> {
        let material = self.material.as_mut();
        let light = self.light.as_mut();
        Some(match property {
            Property::Position => &mut self.transform.position[axis],
            Property::Rotation => &mut self.transform.rotation[axis],
            Property::Size => &mut self.size.as_mut()?[axis],
            Property::Ambient => &mut material?.ambient[axis],
            Property::Diffuse => &mut material?.diffuse[axis],
            Property::Specular => &mut material?.specular[axis],
            Property::Shininess => &mut material?.shininess,
            Property::Color => &mut light?.color[axis],
            Property::Intensity => &mut light?.intensity,
            Property::Gain => &mut light?.gain,
            Property::FieldOfView => &mut self.camera.as_mut()?.fov,
            Property::Height => &mut self.camera.as_mut()?.height,
            Property::Near => {
                let camera = self.camera.as_mut()?;
                let near = camera.near_from(self.transform.position);
                camera.near.get_or_insert(near)
            }
        })
    }
}

impl Scene {
    /// Every page by its entity, its kind and its properties: lights come first, then cuboids, then cameras, each in file
    /// order.
    fn all_pages(&self) -> impl Iterator<Item = (Entity, &'static str, &'static [Property])> {
        let light = |&entity: &Entity| match self.copy::<&Light, _>(entity, |light| light.kind) {
            LightKind::Ambient => (entity, "ambient light", &LIGHT[1..]),
            LightKind::Diffuse => (entity, "diffuse light", LIGHT),
            LightKind::Specular => (entity, "specular light", LIGHT),
        };
        let cuboid = |&entity: &Entity| [(entity, "cuboid", SHAPE), (entity, "material", MATERIAL)];
        let camera = |&entity: &Entity| (entity, "camera", CAMERA);
        let cuboids = self.cuboids.iter().flat_map(cuboid);
        let cameras = self.cameras.iter().map(camera);
        self.lights.iter().map(light).chain(cuboids).chain(cameras)
    }

    /// How many pages there are: one a light, two a cuboid, one a camera.
    pub fn pages(&self) -> usize {
        self.all_pages().count()
    }

    /// The page of this number.
    ///
    /// # Panics
    /// When there are no more than `index` pages.
    pub fn page(&self, index: usize) -> Page {
        let page = self.all_pages().nth(index);
        let (entity, kind, properties) = page.expect("there are more pages");
        let numbers = |&property: &Property| {
            let axes = 0..property.key().1.len();
            axes.map(move |axis| Parameter {
                entity,
                property,
                axis,
            })
        };
        Page {
            entity,
            kind,
            parameters: properties.iter().flat_map(numbers).collect(),
        }
    }

    /// The value of a number; 0 where the entity has none such.
    pub fn number(&self, parameter: Parameter) -> f64 {
        let mut editable = self.editable(parameter.entity);
        let slot = editable.slot(parameter.property, parameter.axis);
        slot.map_or(0.0, |slot| *slot)
    }

    /// Changes a number.
    ///
    /// # Errors
    /// What is allowed, in words, where the scene file does not allow the number; nothing is changed then.
    pub fn set_number(&mut self, parameter: Parameter, number: f64) -> Result<(), String> {
        let (_, _, _, check) = parameter.property.key();
        let number = check(number)?;
        let mut editable = self.editable(parameter.entity);
        if let Some(slot) = editable.slot(parameter.property, parameter.axis) {
            *slot = number;
        }
        self.restore(parameter.entity, editable);
        Ok(())
    }

    /// Everything of an entity that can be changed, to be [restored](Scene::restore) later.
    pub fn editable(&self, entity: Entity) -> Editable {
        Editable {
            transform: self.copy::<&Transform, _>(entity, |transform| *transform),
            size: self.get(entity).map(|mesh: Mesh| mesh.size()),
            material: self.get(entity),
            light: self.get(entity),
            camera: self.get(entity),
        }
    }

    /// Makes of an entity what it was.
    pub fn restore(&mut self, entity: Entity, to: Editable) {
        self.put(entity, Some(to.transform));
        self.put(entity, to.size.map(Mesh::cuboid));
        self.put(entity, to.material);
        self.put(entity, to.light);
        self.put(entity, to.camera);
    }

    fn put<T: Component>(&mut self, entity: Entity, component: Option<T>) {
        if let Some(component) = component {
            let inserted = self.world.insert_one(entity, component);
            inserted.expect("a scene's entities are never despawned");
        }
    }
}
