//! The components of a scene, of its viewer, and those that one frame derives. All of them are plain data.
//!
//! ```text
//! entity   components                                      a frame derives
//! cuboid   Name FileOrder Transform Mesh Material          WorldTransform Normals VertexColors Projected
//!          ShadingMode
//! light    Name FileOrder Transform Light
//! camera   Name FileOrder Transform Camera Orbit
//! viewer   ActiveCamera Projection Background Tolerance
//!          Budget Spin Show Magnifier Probed Inspector
//! ```
//! A scene has one viewer. Keys and widgets write components. [`View::of`] alone reads those of the viewer and of its
//! camera for a picture. [`Lens`] and [`Illumination`] are derived once a frame, for all cuboids.
//!
//! The renderer and the reference share this module and compute everything else themselves.

mod camera;
mod light;
mod magnifier;
mod mesh;
mod orbit;
pub mod range;
pub(crate) mod table;
mod transform;
mod view;
mod viewer;

use glam::DVec3;
use hecs::{Component, DynamicBundle, Entity, World};
use serde::{Deserialize, Serialize};

pub use self::camera::{Camera, Lens, Projection, Viewpoint};
pub use self::light::{Illumination, Light, LightKind, PointLight};
pub use self::magnifier::Magnifier;
pub use self::mesh::{FACES, Mesh, TRIANGLES};
pub use self::orbit::{Limits, Orbit};
use self::range::{Shininess, Strength};
pub use self::transform::{Transform, WorldTransform};
pub use self::view::View;
pub use self::viewer::{
    ActiveCamera, Background, Budget, Inspector, Probed, Show, Side, Spin, Tab, Tolerance,
    ViewMode, active_camera, viewer,
};

/// The entities that have a component, in file order.
pub fn ordered<C: Component>(world: &World) -> Vec<Entity> {
    let mut query = world.query::<(Entity, &FileOrder)>().with::<&C>();
    in_file_order(query.iter().map(|(entity, order)| (*order, entity)))
}

/// Values of entities, in file order.
pub fn in_file_order<T>(entities: impl Iterator<Item = (FileOrder, T)>) -> Vec<T> {
    let mut entities: Vec<_> = entities.collect();
    entities.sort_by_key(|(order, _)| *order);
    entities.into_iter().map(|(_, entity)| entity).collect()
}

/// The names of the entities that have a component, in file order.
pub fn names<C: Component>(world: &World) -> Vec<String> {
    let entities = ordered::<C>(world).into_iter();
    entities
        .filter_map(|entity| get(world, entity).map(|Name(name)| name))
        .collect()
}

/// A copy of a component; `None` if the entity has no such component.
pub fn get<C: Component + Clone>(world: &World, entity: Entity) -> Option<C> {
    world
        .get::<&C>(entity)
        .ok()
        .map(|component| (*component).clone())
}

/// The name in the scene file: not empty, unique within its kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name(pub String);

/// The index of a cuboid, a light or a camera among its kind in the scene file. It numbers cuboids, decides ties of depth
/// and orders lists. A removed entity leaves a gap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FileOrder(pub u32);

/// The reflection of a surface: one coefficient for each channel and term, and the exponent of the highlight.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// kappa A, >= 0.
    #[serde(deserialize_with = "Strength::three")]
    pub ambient: DVec3,
    /// kappa D, >= 0.
    #[serde(deserialize_with = "Strength::three")]
    pub diffuse: DVec3,
    /// kappa E, >= 0.
    #[serde(deserialize_with = "Strength::three")]
    pub specular: DVec3,
    /// rho, 0..=1e6.
    #[serde(deserialize_with = "Shininess::one")]
    pub shininess: f64,
}

/// The definition of the levels of a cuboid's surface. The tolerance allows an error against it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ShadingMode {
    /// The model at the vertices; its levels are interpolated perspective-correctly (Gouraud 1971).
    #[default]
    Gouraud,
    /// The model at every pixel; position and normal are interpolated perspective-correctly (Phong 1975).
    Phong,
    /// The assignment's shortcut: unit n, l and o are interpolated linearly on the screen and not normalised again.
    #[serde(rename(serialize = "phong"), skip_deserializing)]
    UnitVectors,
}

impl ShadingMode {
    /// The name in scene files, on the command line and in reports. The assignment's shortcut counts as Phong.
    pub const fn name(self) -> &'static str {
        match self {
            ShadingMode::Gouraud => "gouraud",
            ShadingMode::Phong | ShadingMode::UnitVectors => "phong",
        }
    }
}

/// Unit vertex normals in world space, one per corner of the [`Mesh`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Normals(pub [DVec3; 8]);

/// The model at each corner, in levels, unclamped.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VertexColors(pub [DVec3; 8]);

/// The corners of a cuboid as the camera sees them, and the polygons of its triangles on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Projected {
    /// The corners relative to the eye, along right, up and forward, in world units.
    pub seen: [DVec3; 8],
    /// The visible part of each of [`TRIANGLES`], empty where it faces away or is clipped.
    pub polygons: [Polygon; 12],
}

/// A convex polygon on the screen, its vertices snapped to 1/256 pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Polygon {
    /// x right and y down from the picture's top left corner, in 1/256 pixel, within +-2^30, counter-clockwise as seen.
    pub vertices: [[i32; 2]; Polygon::MAX_VERTICES],
    /// The number of vertices in use: 0, or 3..=8.
    pub len: u8,
}

impl Polygon {
    /// A triangle, cut by the near plane and by the four sides of the guard band.
    pub const MAX_VERTICES: usize = 8;

    /// The vertices in use.
    pub fn vertices(&self) -> &[[i32; 2]] {
        &self.vertices[..usize::from(self.len)]
    }
}

/// Every component of a cuboid: those of the scene, and empty ones for a frame to derive.
pub fn cuboid(
    order: usize,
    name: Name,
    transform: Transform,
    mesh: Mesh,
    material: Material,
    shading: ShadingMode,
) -> impl DynamicBundle {
    (
        name,
        FileOrder(order as u32),
        transform,
        mesh,
        material,
        shading,
        WorldTransform::default(),
        Normals::default(),
        VertexColors::default(),
        Projected::default(),
    )
}

/// Overwrites a component of all entities that have it.
pub fn overwrite<C: Component + Clone>(world: &mut World, component: &C) {
    for own in world.query_mut::<&mut C>() {
        *own = component.clone();
    }
}

/// The length of `v`. Squares of very large and very small vectors neither overflow nor underflow.
pub fn length(v: DVec3) -> f64 {
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() {
        (v / largest).length() * largest
    } else {
        0.0
    }
}

/// `v` scaled to length 1; zero if `v` is zero or not finite.
pub fn unit(v: DVec3) -> DVec3 {
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() {
        let scaled = v / largest;
        scaled / scaled.length()
    } else {
        DVec3::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_is_right_however_large_or_small() {
        for scale in [1e-300, 1e-100, 1.0, 1e100, 1e300] {
            let long = length(DVec3::new(-3.0, 0.0, 4.0) * scale);
            assert!((long / scale - 5.0).abs() < 1e-14, "{long} at {scale}");
        }
        assert_eq!(length(DVec3::ZERO), 0.0);
    }

    #[test]
    fn what_has_no_direction_has_no_unit_vector() {
        for vector in [
            DVec3::ZERO,
            DVec3::new(f64::INFINITY, 1.0, 0.0),
            DVec3::NEG_INFINITY,
            DVec3::NAN,
        ] {
            assert_eq!(unit(vector), DVec3::ZERO, "{vector}");
        }
    }
}
