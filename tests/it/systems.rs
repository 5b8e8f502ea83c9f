//! The systems of a frame, one file each, in the order of `systems::FRAME`. Entities are spawned by hand, the system
//! runs, and the resulting components or pixels are compared with values from paper.
//!
//! ```text
//! spin -> normals -> projection -> lighting -> rasterization
//! ```
//! Coverage of polygons is tested in `tests/it/rasterization`.

mod frame;
mod lighting;
mod normals;
mod projection;
mod rasterization;
mod spin;

use fearless_simd::Level;
use glam::{DVec3, dvec3};
use hecs::{Entity, World};
use shadetrade::components::{
    Light, LightKind, Material, Projection, Transform, View, WorldTransform,
};
use shadetrade::systems::frame::{Frame, Keep, Workers};

use crate::support::scene::{at, turned, view};

pub const PROJECTIONS: [Projection; 2] = Projection::ALL;

/// kA 0.1, kD 0.5 and kE 1 in every channel, and a shininess of 2.
const MATERIAL: Material = Material {
    ambient: DVec3::splat(0.1),
    diffuse: DVec3::splat(0.5),
    specular: DVec3::ONE,
    shininess: 2.0,
};

/// An empty frame, drawn by the calling thread.
fn empty_frame() -> Frame {
    Frame::new(Keep::Levels, Workers::alone(Level::new()))
}

/// From z = 10 towards the origin: 90 degrees or 20 units high, at tolerance 0, on black.
pub fn ahead(projection: Projection, size: [usize; 2]) -> View {
    let mut view = view(size, DVec3::Z * 10.0, DVec3::ZERO, projection);
    let camera = &mut view.camera;
    (camera.fov, camera.height, camera.near) = (90.0, 20.0, Some(1.0));
    view.background = DVec3::ZERO;
    view
}

/// The derived placement in the world for `transform`.
fn place(transform: Transform) -> WorldTransform {
    WorldTransform {
        position: transform.position,
        axes: transform.axes(),
    }
}

/// A white light of this many levels that is on.
fn light(kind: LightKind, levels: f64) -> Light {
    Light {
        kind,
        color: DVec3::ONE,
        intensity: levels,
        gain: 1.0,
        on: true,
    }
}

/// A component of an entity.
fn read<C: hecs::Component + Copy>(world: &World, entity: Entity) -> C {
    *world.get::<&C>(entity).expect("the entity has it")
}

/// The signs of a corner's coordinates.
fn signs(corner: usize) -> DVec3 {
    let sign = |bit: usize| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
    dvec3(sign(0), sign(1), sign(2))
}
