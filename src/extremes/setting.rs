//! A scene written down in code in, the text of a scene file and a view of it out.
//!
//! Rule: every scene of the table goes through the scene format, so that what is tried is what can be written into a file.

use glam::DVec3;

use crate::components::{LightKind, Material, Projection, ShadingMode, View};
use crate::scene::{Scene, SceneError};

/// A scene with one camera, and the size of its picture.
#[derive(Clone, Debug)]
pub struct Setting {
    /// In the order of the file.
    pub cuboids: Vec<Body>,
    /// In the order of the file.
    pub lights: Vec<Lamp>,
    /// The eye, in world units.
    pub eye: DVec3,
    /// What it looks at, in world units.
    pub target: DVec3,
    /// The direction that is up in the picture.
    pub up: DVec3,
    /// In degrees.
    pub fov: f64,
    /// World units seen vertically.
    pub height: f64,
    /// Distance of the near plane; `None` is the format's default.
    pub near: Option<f64>,
    /// Width and height in pixels.
    pub size: [usize; 2],
}

/// A cuboid.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Full edge lengths, in world units.
    pub size: DVec3,
    /// The centre, in world units.
    pub position: DVec3,
    /// In degrees.
    pub rotation: DVec3,
    /// What it is made of.
    pub material: Material,
}

/// A light that is on.
#[derive(Clone, Copy, Debug)]
pub struct Lamp {
    /// The term it feeds.
    pub kind: LightKind,
    /// Per channel.
    pub color: DVec3,
    /// Lambda.
    pub intensity: f64,
    /// Levels per unit of intensity.
    pub gain: f64,
    /// In world units; of no meaning for an ambient light.
    pub position: DVec3,
}

/// A picture's projection, mode and tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Perspective or orthographic.
    pub projection: Projection,
    /// Gouraud or Phong.
    pub mode: ShadingMode,
    /// In levels.
    pub tolerance: f64,
}

/// The material of the assignment with the highlight of emerald.
pub const MATERIAL: Material = Material {
    ambient: DVec3::splat(0.3),
    diffuse: DVec3::new(0.07568, 0.61424, 0.07568),
    specular: DVec3::new(0.633, 0.72811, 0.66),
    shininess: 76.8,
};

impl Default for Setting {
    /// The built-in scene's cuboid, camera and lights but the red one, in a small picture.
    fn default() -> Self {
        Setting {
            cuboids: vec![Body::default()],
            lights: lights_at(DVec3::splat(10.0)),
            eye: DVec3::new(7.0, 5.0, 8.0),
            target: DVec3::ZERO,
            up: DVec3::Y,
            fov: 30.0,
            height: 6.3,
            near: None,
            size: [96, 72],
        }
    }
}

impl Default for Body {
    fn default() -> Self {
        Body {
            size: DVec3::new(4.0, 3.0, 2.0),
            position: DVec3::ZERO,
            rotation: DVec3::ZERO,
            material: MATERIAL,
        }
    }
}

impl Lamp {
    /// A white light that sends so many levels.
    pub fn new(kind: LightKind, levels: f64, position: DVec3) -> Self {
        Lamp {
            kind,
            color: DVec3::ONE,
            intensity: levels,
            gain: 1.0,
            position,
        }
    }
}

/// A light of every kind at one place.
pub fn lights_at(position: DVec3) -> Vec<Lamp> {
    vec![
        Lamp::new(LightKind::Diffuse, 170.0, position),
        Lamp::new(LightKind::Specular, 255.0, position),
        Lamp::new(LightKind::Ambient, 100.0, position),
    ]
}

impl Setting {
    /// The default setting with changes.
    pub fn with(change: impl FnOnce(&mut Setting)) -> Self {
        Setting::default().and(change)
    }

    /// This setting with changes.
    #[must_use]
    pub fn and(mut self, change: impl FnOnce(&mut Setting)) -> Self {
        change(&mut self);
        self
    }

    /// Every place and length multiplied.
    #[must_use]
    pub fn scaled(self, scale: f64) -> Self {
        self.and(|setting| {
            for cuboid in &mut setting.cuboids {
                cuboid.size *= scale;
                cuboid.position *= scale;
            }
            for light in &mut setting.lights {
                light.position *= scale;
            }
            setting.eye *= scale;
            setting.target *= scale;
            setting.height *= scale;
            setting.near = setting.near.map(|near| near * scale);
        })
    }

    /// Every place shifted.
    #[must_use]
    pub fn moved(self, shift: DVec3) -> Self {
        self.and(|setting| {
            for cuboid in &mut setting.cuboids {
                cuboid.position += shift;
            }
            for light in &mut setting.lights {
                light.position += shift;
            }
            setting.eye += shift;
            setting.target += shift;
        })
    }

    /// Reads the scene's text as a file would be read.
    ///
    /// # Errors
    /// When the format does not allow it.
    pub fn scene(&self) -> Result<Scene, SceneError> {
        Scene::parse("extreme", &self.text())
    }

    /// How a picture of the scene is drawn in this way.
    pub fn view(&self, scene: &Scene, way: Way) -> View {
        View {
            size: self.size,
            viewpoint: scene.viewpoint(0),
            projection: way.projection,
            background: scene.background,
            shading: Some(way.mode),
            tolerance: way.tolerance,
        }
    }

    /// The scene as a file has it; floats are written so that reading them gives the same bits.
    pub fn text(&self) -> String {
        let cuboids = self.cuboids.iter().enumerate().map(cuboid_text);
        let lights = self.lights.iter().enumerate().map(light_text);
        std::iter::once("background = [20, 20, 24]\n".to_owned())
            .chain(cuboids)
            .chain(lights)
            .chain([self.camera_text()])
            .collect()
    }

    fn camera_text(&self) -> String {
        let [eye, target, up] = [self.eye, self.target, self.up].map(|place| place.to_array());
        let near = self.near.map(|near| format!("near = {near:?}\n"));
        format!(
            "[[camera]]\nname = \"1\"\nposition = {eye:?}\ntarget = {target:?}\nup = {up:?}\n\
             fov = {:?}\nheight = {:?}\n{}",
            self.fov,
            self.height,
            near.unwrap_or_default()
        )
    }
}

fn cuboid_text((index, cuboid): (usize, &Body)) -> String {
    let [size, position, rotation] =
        [cuboid.size, cuboid.position, cuboid.rotation].map(|vector| vector.to_array());
    let material = &cuboid.material;
    let [ambient, diffuse, specular] =
        [material.ambient, material.diffuse, material.specular].map(|vector| vector.to_array());
    format!(
        "[[cuboid]]\nname = \"{index}\"\nsize = {size:?}\nposition = {position:?}\nrotation = {rotation:?}\n\
         [cuboid.material]\nambient = {ambient:?}\ndiffuse = {diffuse:?}\nspecular = {specular:?}\n\
         shininess = {:?}\n",
        material.shininess
    )
}

fn light_text((index, light): (usize, &Lamp)) -> String {
    let position = format!("position = {:?}\n", light.position.to_array());
    let (kind, position) = match light.kind {
        LightKind::Ambient => ("ambient", String::new()),
        LightKind::Diffuse => ("diffuse", position),
        LightKind::Specular => ("specular", position),
    };
    format!(
        "[[light]]\nname = \"{index}\"\nkind = \"{kind}\"\ncolor = {:?}\nintensity = {:?}\n\
         gain = {:?}\n{position}",
        light.color.to_array(),
        light.intensity,
        light.gain
    )
}
