//! The parts of the model that can be left out, and a scene without some of them.

use crate::components::{Mesh, NormalMode, ShadingMode, ordered};
use crate::reference::Rule;
use crate::scene::{Scene, SceneRecord};

/// A part of the model. Cuboids and lights are given by their index in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A light that is on. Without the part it is off.
    Light(usize),
    /// A rule of the reference. [`Rule`] defines the picture without it.
    Rule(Rule),
    /// Corner normals of a cuboid. Without the part it has face normals.
    CornerNormals(usize),
    /// Phong shading of a cuboid. Without the part it is shaded by Gouraud.
    EveryPixel(usize),
    /// A cuboid. Without the part the surfaces behind it are visible.
    Cuboid(usize),
    /// f64. Without the part the reference is evaluated in f32; only a cuboid's bounds on the screen stay intervals.
    F64,
}

impl Part {
    /// Whether a scene file can leave the part out.
    pub fn is_in_file(self) -> bool {
        !matches!(self, Part::Rule(_) | Part::F64)
    }

    /// A sentence about the picture without the part.
    pub fn says(self) -> &'static str {
        match self {
            Part::Light(_) => "Without it this light is off.",
            Part::Rule(Rule::SpecularGate) => "Without it highlights are seen where n.l <= 0, too.",
            Part::Rule(Rule::DiffuseClamp) => "Without it a light behind a face takes light away.",
            Part::Rule(Rule::Reflection) => {
                "Without it every highlight is by n.h, with four times the shininess (Blinn-Phong)."
            }
            Part::Rule(Rule::UnitNormal) => "Without it interpolated normals are shorter than 1.",
            Part::Rule(Rule::PerspectiveCorrect) => {
                "Without it all is interpolated linearly on the screen."
            }
            Part::Rule(Rule::DepthTest) => "Without it the last cuboid of the file is in front.",
            Part::Rule(Rule::NearPlane) => "Without it nothing is cut at the near plane.",
            Part::CornerNormals(_) => {
                "Without it this cuboid has face normals: its edges are sharp."
            }
            Part::EveryPixel(_) => "Without it this cuboid is shaded by Gouraud.",
            Part::Cuboid(_) => "Without it this cuboid is not drawn.",
            Part::F64 => "Without it all is computed in f32.",
        }
    }
}

/// The parts of the model that a scene uses, with their names, in the order of the report.
pub fn parts(scene: &Scene) -> Vec<(Part, String)> {
    let scene = SceneRecord::of(&scene.world);
    let rule = |rule: Rule| (Part::Rule(rule), rule.name().to_owned());
    let lights = scene.light.iter().enumerate().filter(|(_, it)| it.on);
    let cuboids = || scene.cuboid.iter().enumerate();
    let phong = cuboids().filter(|(_, it)| it.shading == ShadingMode::Phong);
    let mut parts = Vec::new();
    parts.extend(lights.map(|(i, it)| (Part::Light(i), format!("light {}", it.name))));
    parts.extend([Rule::SpecularGate, Rule::DiffuseClamp, Rule::Reflection].map(rule));
    let smooth = || cuboids().filter(|(_, it)| it.normals == NormalMode::Corner);
    if smooth().next().is_some() {
        parts.push(rule(Rule::UnitNormal));
    }
    let name = |name: &str| format!("corner normals {name}");
    parts.extend(smooth().map(|(i, it)| (Part::CornerNormals(i), name(&it.name))));
    parts.extend(phong.map(|(i, it)| (Part::EveryPixel(i), format!("every pixel {}", it.name))));
    parts.extend([Rule::PerspectiveCorrect, Rule::DepthTest, Rule::NearPlane].map(rule));
    parts.extend(cuboids().map(|(i, it)| (Part::Cuboid(i), format!("cuboid {}", it.name))));
    parts.push((Part::F64, "f64 set-up".to_owned()));
    parts
}

/// The scene without some of its lights, cuboids and Phong shading. The remaining entities keep their index in the file.
pub fn without(scene: &Scene, parts: &[Part]) -> Scene {
    let mut record = SceneRecord::of(&scene.world);
    for part in parts {
        match *part {
            Part::Light(light) => record.light[light].on = false,
            Part::CornerNormals(cuboid) => record.cuboid[cuboid].normals = NormalMode::Face,
            Part::EveryPixel(cuboid) => record.cuboid[cuboid].shading = ShadingMode::Gouraud,
            Part::Rule(_) | Part::Cuboid(_) | Part::F64 => {}
        }
    }
    let mut scene = Scene::spawn(scene.name.clone(), &record);
    for (number, entity) in ordered::<Mesh>(&scene.world).into_iter().enumerate() {
        if parts.contains(&Part::Cuboid(number)) {
            // Cannot fail: the entity has just been spawned.
            let _ = scene.world.despawn(entity);
        }
    }
    scene
}

/// The rule among parts.
pub(super) fn rule(parts: &[Part]) -> Option<Rule> {
    parts.iter().find_map(|part| match part {
        Part::Rule(rule) => Some(*rule),
        _ => None,
    })
}
