//! The systems of a frame, in the order of `systems::FRAME`. Entities are spawned by hand, the system runs, and the
//! resulting components or pixels are compared with values from paper.
//!
//! ```text
//! spin -> normals -> projection -> lighting -> rasterization
//! ```
//! Normals are tested by proofs in `tests/it/prove`, coverage of polygons in `tests/it/rasterization`.

mod frame;
mod lighting;
mod projection;
mod rasterization;
mod spin;

use hecs::Entity;

use crate::support::prelude::*;

const PROJECTIONS: [Projection; 2] = Projection::ALL;

const MATERIAL: Material = grey([0.1, 0.5, 1.0], 2.0);

/// An empty frame, drawn by the calling thread.
fn empty_frame() -> Frame {
    Frame::new(Keep::Levels, Workers::alone(Level::new()))
}

/// From z = 10 towards the origin: 90 degrees or 20 units high, at tolerance 0, on black.
fn ahead(projection: Projection, size: [usize; 2]) -> View {
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
