//! A scene written down in code in; the text of a scene file and a view of it out.
//!
//! Rule: every scene goes through the scene format, so that whatever is tried can be written into a file.

use glam::DVec3;

use crate::components::{
    Camera, Light, LightKind, Material, Mesh, Name, Projection, ShadingMode, Transform, View,
};
use crate::scene::{Records, Scene, SceneError};

/// A scene with one camera, and the size of its picture.
#[derive(Clone, Debug)]
pub struct SceneSpec {
    pub cuboids: Vec<CuboidSpec>,
    pub lights: Vec<LightSpec>,
    pub eye: DVec3,
    pub camera: Camera,
    /// Width and height in pixels.
    pub size: [usize; 2],
}

#[derive(Clone, Copy, Debug)]
pub struct CuboidSpec {
    /// Full edge lengths.
    pub size: DVec3,
    pub transform: Transform,
    pub material: Material,
}

#[derive(Clone, Copy, Debug)]
pub struct LightSpec {
    pub light: Light,
    pub position: DVec3,
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
pub const MODES: [ShadingMode; 2] = [ShadingMode::Gouraud, ShadingMode::Phong];

impl RenderConfig {
    /// Exact Phong in perspective.
    pub const EXACT_PHONG: RenderConfig = RenderConfig {
        projection: Projection::Perspective,
        mode: ShadingMode::Phong,
        tolerance: 0.0,
    };

    /// Every projection and mode, exactly and within half a level.
    pub fn all() -> impl Iterator<Item = RenderConfig> {
        (0..8).map(|index| RenderConfig {
            projection: Projection::ALL[index / 4],
            mode: MODES[index / 2 % 2],
            tolerance: [0.0, 0.5][index % 2],
        })
    }
}

/// The material of the assignment with the highlight of emerald.
pub const MATERIAL: Material = Material {
    ambient: DVec3::splat(0.3),
    diffuse: DVec3::new(0.07568, 0.61424, 0.07568),
    specular: DVec3::new(0.633, 0.72811, 0.66),
    shininess: 76.8,
};

/// The built-in scene's cuboid, camera and lights but the red one, in a small picture.
pub fn scene() -> SceneSpec {
    SceneSpec {
        cuboids: vec![default_cuboid()],
        lights: lights_at([10.0; 3]),
        eye: DVec3::new(7.0, 5.0, 8.0),
        camera: Camera {
            target: DVec3::ZERO,
            up: DVec3::Y,
            fov: 30.0,
            height: 6.3,
            near: None,
        },
        size: [96, 72],
    }
}

/// The cuboid of that scene.
pub fn default_cuboid() -> CuboidSpec {
    cuboid([4.0, 3.0, 2.0], [0.0; 3])
}

/// A cuboid of these edges at this place, not rotated.
pub fn cuboid(size: impl Into<DVec3>, position: impl Into<DVec3>) -> CuboidSpec {
    CuboidSpec {
        size: size.into(),
        transform: standing_at(position.into()),
        material: MATERIAL,
    }
}

/// A white light that sends so many levels.
pub fn light(kind: LightKind, levels: f64, position: impl Into<DVec3>) -> LightSpec {
    LightSpec {
        light: Light {
            kind,
            color: DVec3::ONE,
            intensity: levels,
            gain: 1.0,
            on: true,
        },
        position: position.into(),
    }
}

/// A light of every kind at one place.
pub fn lights_at(position: impl Into<DVec3>) -> Vec<LightSpec> {
    let position = position.into();
    vec![
        light(LightKind::Diffuse, 170.0, position),
        light(LightKind::Specular, 255.0, position),
        light(LightKind::Ambient, 100.0, position),
    ]
}

fn standing_at(position: DVec3) -> Transform {
    Transform {
        position,
        rotation: DVec3::ZERO,
    }
}

/// Methods that return the value with one field replaced.
macro_rules! setters {
    ($($name:ident: $type:ty => $($field:ident).+),*) => {$(
        #[must_use]
        pub fn $name(mut self, value: impl Into<$type>) -> Self {
            self.$($field).+ = value.into();
            self
        }
    )*};
}

impl CuboidSpec {
    setters!(
        rotation: DVec3 => transform.rotation,
        material: Material => material,
        shininess: f64 => material.shininess
    );

    /// The same cuboid with ambient, diffuse and specular coefficients multiplied.
    #[must_use]
    pub fn reflecting(mut self, factor: f64) -> Self {
        self.material.ambient *= factor;
        self.material.diffuse *= factor;
        self.material.specular *= factor;
        self
    }
}

impl SceneSpec {
    setters!(
        cuboids: Vec<CuboidSpec> => cuboids,
        lights: Vec<LightSpec> => lights,
        eye: DVec3 => eye,
        target: DVec3 => camera.target,
        up: DVec3 => camera.up,
        fov: f64 => camera.fov,
        height: f64 => camera.height,
        near: Option<f64> => camera.near,
        size: [usize; 2] => size
    );

    /// The same scene with another cuboid in place of all.
    #[must_use]
    pub fn cuboid(self, cuboid: CuboidSpec) -> Self {
        self.cuboids([cuboid])
    }

    /// The same scene with a change to each of its lights.
    #[must_use]
    pub fn with_lights(mut self, change: impl Fn(&mut Light)) -> Self {
        let lights = self.lights.iter_mut();
        lights.for_each(|spec| change(&mut spec.light));
        self
    }

    /// Every place and length multiplied.
    #[must_use]
    pub fn scaled(mut self, scale: f64) -> Self {
        for cuboid in &mut self.cuboids {
            cuboid.size *= scale;
        }
        self.camera.height *= scale;
        self.camera.near = self.camera.near.map(|near| near * scale);
        self.with_places(|place| place * scale)
    }

    /// Every place shifted.
    #[must_use]
    pub fn moved(self, shift: DVec3) -> Self {
        self.with_places(|place| place + shift)
    }

    fn with_places(mut self, change: impl Fn(DVec3) -> DVec3) -> Self {
        let cuboids = self
            .cuboids
            .iter_mut()
            .map(|cuboid| &mut cuboid.transform.position);
        let lights = self.lights.iter_mut().map(|light| &mut light.position);
        let camera = [&mut self.eye, &mut self.camera.target];
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

    /// The text of a scene file.
    pub fn text(&self) -> String {
        let name = |index: usize| Name(index.to_string());
        let cuboids = self.cuboids.iter().enumerate().map(|(index, cuboid)| {
            let mesh = Mesh::cuboid(cuboid.size);
            let mode = ShadingMode::Phong;
            (name(index), cuboid.transform, mesh, cuboid.material, mode)
        });
        let lights = self.lights.iter().enumerate().map(|(index, spec)| {
            let place = standing_at(spec.position);
            (name(index), place, spec.light)
        });
        let records = Records {
            background: DVec3::new(20.0, 20.0, 24.0),
            cuboids: cuboids.collect(),
            lights: lights.collect(),
            cameras: vec![(name(1), standing_at(self.eye), self.camera)],
        };
        Scene::spawn("extreme".to_owned(), records).to_toml()
    }

    /// The view that draws the parsed scene.
    pub fn view(&self, scene: &Scene, config: RenderConfig) -> View {
        View {
            size: self.size,
            viewpoint: scene.viewpoint(0),
            projection: config.projection,
            background: scene.background,
            shading: Some(config.mode),
            tolerance: config.tolerance,
        }
    }
}
