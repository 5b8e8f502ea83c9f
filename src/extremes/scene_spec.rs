//! A scene written down in code in; the text of a scene file and a view of it out.
//!
//! Rule: every scene goes through the scene format, so that whatever is tried can be written into a file.

use std::borrow::Borrow;

use glam::DVec3;

use crate::components::{LightKind, Material, Projection, ShadingMode, View};
use crate::scene::{
    CameraRecord, CuboidRecord, LightRecord, Scene, SceneError, SceneRecord, ViewRecord, updated,
};

/// A scene with one camera, and the size of its picture.
#[derive(Clone)]
pub struct SceneSpec {
    pub cuboids: Vec<CuboidRecord>,
    pub lights: Vec<LightRecord>,
    pub camera: CameraRecord,
    /// Width and height in pixels.
    pub size: [usize; 2],
}

/// How a scene is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderConfig {
    pub projection: Projection,
    pub mode: ShadingMode,
    /// In levels.
    pub tolerance: f64,
}

/// The modes that a scene can ask for.
const MODES: [ShadingMode; 2] = [ShadingMode::Gouraud, ShadingMode::Phong];

impl RenderConfig {
    pub fn phong(projection: Projection, tolerance: f64) -> RenderConfig {
        RenderConfig {
            projection,
            mode: ShadingMode::Phong,
            tolerance,
        }
    }

    /// Every projection and mode, exactly and within half a level.
    pub fn all() -> impl Iterator<Item = RenderConfig> {
        (0..8).map(|index| RenderConfig {
            projection: Projection::ALL[index / 4],
            mode: MODES[index / 2 % 2],
            tolerance: [0.0, 0.5][index % 2],
        })
    }
}

/// The built-in scene's cuboid, camera and lights but the red one, in a small picture.
pub fn scene() -> SceneSpec {
    SceneSpec {
        cuboids: vec![default_cuboid()],
        lights: lights_at([10.0; 3]),
        camera: CameraRecord::new("1", [7.0, 5.0, 8.0], DVec3::ZERO, [30.0, 6.3]),
        size: [96, 72],
    }
}

/// The cuboid of that scene.
pub fn default_cuboid() -> CuboidRecord {
    cuboid([4.0, 3.0, 2.0], [0.0; 3])
}

/// A cuboid of these edges at this place, not rotated.
pub fn cuboid(size: impl Into<DVec3>, position: impl Into<DVec3>) -> CuboidRecord {
    CuboidRecord::new("", size, position)
}

/// A white light that sends so many levels.
pub fn light(kind: LightKind, levels: f64, position: impl Into<DVec3>) -> LightRecord {
    LightRecord::new("", kind, levels, position)
}

/// A number, and an ulp to either side of it.
pub fn around(number: f64) -> [f64; 3] {
    [number.next_down(), number, number.next_up()]
}

/// A light of every kind at one place.
pub fn lights_at(position: impl Into<DVec3>) -> Vec<LightRecord> {
    let position = position.into();
    vec![
        light(LightKind::Diffuse, 170.0, position),
        light(LightKind::Specular, 255.0, position),
        light(LightKind::Ambient, 100.0, position),
    ]
}

/// Methods that return the value changed by another.
macro_rules! setters {
    ($($name:ident: $type:ty => |$this:ident, $value:ident| $change:expr;)*) => {$(
        pub fn $name(mut self, $value: impl Into<$type>) -> Self {
            let ($this, $value) = (&mut self, $value.into());
            $change;
            self
        }
    )*};
}

impl CuboidRecord {
    setters!(
        rotation: DVec3 => |cuboid, degrees| cuboid.rotation = degrees;
        material: Material => |cuboid, material| cuboid.material = material.into();
        shininess: f64 => |cuboid, shininess| cuboid.material.shininess = shininess;
    );

    /// The same cuboid with ambient, diffuse and specular coefficients multiplied.
    pub fn reflecting(mut self, factor: f64) -> Self {
        self.material.ambient *= factor;
        self.material.diffuse *= factor;
        self.material.specular *= factor;
        self
    }
}

impl SceneSpec {
    setters!(
        lights: Vec<LightRecord> => |scene, lights| scene.lights = lights;
        eye: DVec3 => |scene, eye| scene.camera.position = eye;
        target: DVec3 => |scene, target| scene.camera.target = target;
        up: DVec3 => |scene, up| scene.camera.up = up;
        fov: f64 => |scene, degrees| scene.camera.fov = degrees;
        height: f64 => |scene, height| scene.camera.height = height;
        near: f64 => |scene, near| scene.camera.near = Some(near);
        size: [usize; 2] => |scene, size| scene.size = size;
    );

    pub fn cuboids(mut self, all: impl IntoIterator<Item: Borrow<CuboidRecord>>) -> Self {
        self.cuboids = all.into_iter().map(|it| it.borrow().clone()).collect();
        self
    }

    /// The same scene with another cuboid in place of all.
    pub fn cuboid(self, cuboid: CuboidRecord) -> Self {
        self.cuboids([cuboid])
    }

    /// The same scene with a change to each of its lights.
    pub fn with_lights(mut self, change: impl Fn(&mut LightRecord)) -> Self {
        self.lights.iter_mut().for_each(change);
        self
    }

    /// Every place and length multiplied.
    pub fn scaled(mut self, scale: f64) -> Self {
        for cuboid in &mut self.cuboids {
            cuboid.size *= scale;
        }
        self.camera.height *= scale;
        self.camera.near = self.camera.near.map(|near| near * scale);
        self.with_places(|place| place * scale)
    }

    /// Every place shifted.
    pub fn moved(self, shift: DVec3) -> Self {
        self.with_places(|place| place + shift)
    }

    fn with_places(mut self, change: impl Fn(DVec3) -> DVec3) -> Self {
        let cuboids = self.cuboids.iter_mut().map(|it| &mut it.position);
        let lights = self.lights.iter_mut().filter_map(|it| it.position.as_mut());
        let camera = [&mut self.camera.position, &mut self.camera.target];
        for place in cuboids.chain(lights).chain(camera) {
            *place = change(*place);
        }
        self
    }

    /// Reads the scene's text as a file is read.
    ///
    /// # Errors
    /// When the format does not allow it.
    pub fn parse(&self) -> Result<Scene, SceneError> {
        Scene::parse("extreme", &self.text())
    }

    /// The text of a scene file, in which cuboids and lights are named by their numbers.
    pub fn text(&self) -> String {
        let mut record = SceneRecord {
            background: DVec3::new(20.0, 20.0, 24.0),
            cuboid: self.cuboids.clone(),
            light: self.lights.clone(),
            camera: vec![self.camera.clone()],
            view: ViewRecord::default(),
        };
        for (index, cuboid) in record.cuboid.iter_mut().enumerate() {
            cuboid.name = index.to_string();
        }
        for (index, light) in record.light.iter_mut().enumerate() {
            light.name = index.to_string();
        }
        updated("", &record)
    }

    /// The view that draws the parsed scene.
    pub fn view(&self, scene: &Scene, config: RenderConfig) -> View {
        View {
            projection: config.projection,
            tolerance: config.tolerance,
            ..View::of(&scene.world, self.size).shaded(config.mode)
        }
    }
}
