//! Spawns a record as a [`World`], and takes a record from a world.

use hecs::{EntityBuilder, World};

use super::record::{CameraRecord, CuboidRecord, LightRecord, SceneRecord};
use crate::components::{
    Background, Camera, FileOrder, Light, LightKind, Material, Mesh, Name, NormalMode, Normals,
    Orbit, Projected, Segments, ShadingMode, Transform, VertexColors, Viewer, WorldTransform,
    background, in_file_order, viewer,
};

type CuboidParts<'a> = (
    &'a Name,
    &'a Transform,
    &'a Mesh,
    &'a Material,
    &'a ShadingMode,
    &'a NormalMode,
    &'a Segments,
);
type LightParts<'a> = (&'a Name, &'a Transform, &'a Light);
type CameraParts<'a> = (&'a Name, &'a Camera, &'a Orbit);

fn cuboid((name, at, mesh, material, shading, normals, segments): CuboidParts) -> CuboidRecord {
    CuboidRecord {
        name: name.0.clone(),
        size: mesh.size(),
        position: at.position,
        rotation: at.rotation,
        shading: *shading,
        normals: *normals,
        segments: *segments,
        material: *material,
    }
}

fn light((name, at, light): LightParts) -> LightRecord {
    LightRecord {
        name: name.0.clone(),
        kind: light.kind,
        color: light.color,
        intensity: light.intensity,
        gain: light.gain,
        position: (light.kind != LightKind::Ambient).then_some(at.position),
        on: light.on,
    }
}

fn camera((name, camera, orbit): CameraParts) -> CameraRecord {
    CameraRecord {
        name: name.0.clone(),
        position: camera.position,
        target: camera.target,
        up: camera.up,
        fov: camera.fov,
        height: camera.height,
        near: camera.near,
        orbit: *orbit,
    }
}

/// The viewer of a world with these cameras. One that is gone, or the first one, has no name here.
fn view(world: &World, cameras: &[CameraRecord]) -> Viewer {
    let mut view = Viewer::clone(&viewer(world));
    view.turns = false;
    let is_named = |name: &String| cameras.iter().skip(1).any(|it| it.name == *name);
    view.camera = view.camera.filter(is_named);
    view
}

impl SceneRecord {
    /// The record of a world. It does not tell whether the cuboids keep turning.
    ///
    /// # Panics
    /// If the world has no viewer or no camera. A spawned scene has both.
    pub fn of(world: &World) -> SceneRecord {
        let cameras = in_file_order::<CameraParts, _>(world, camera);
        SceneRecord {
            background: background(world),
            cuboid: in_file_order::<CuboidParts, _>(world, cuboid),
            light: in_file_order::<LightParts, _>(world, light),
            view: view(world, &cameras),
            camera: cameras,
        }
    }

    /// The world of this record.
    ///
    /// Each type of tuple would be compiled by itself, so entities are spawned by a builder.
    pub fn spawn(&self) -> World {
        let mut world = World::new();
        let mut entity = EntityBuilder::new();
        for (order, it) in (0..).map(FileOrder).zip(&self.cuboid) {
            let at = Transform {
                position: it.position,
                rotation: it.rotation,
            };
            entity.add(Name(it.name.clone())).add(order).add(at);
            entity.add(Mesh::cuboid(it.size)).add(it.material);
            entity.add(it.shading).add(it.normals).add(it.segments);
            entity.add(WorldTransform::default());
            entity.add(Normals::default());
            entity.add(VertexColors::default());
            entity.add(Projected::default());
            world.spawn(entity.build());
        }
        for (order, it) in (0..).map(FileOrder).zip(&self.light) {
            let light = Light {
                kind: it.kind,
                color: it.color,
                intensity: it.intensity,
                gain: it.gain,
                on: it.on,
            };
            let at = Transform::at(it.position.unwrap_or_default());
            entity.add(Name(it.name.clone())).add(order);
            world.spawn(entity.add(at).add(light).build());
        }
        for (order, it) in (0..).map(FileOrder).zip(&self.camera) {
            let camera = Camera {
                position: it.position,
                target: it.target,
                up: it.up,
                fov: it.fov,
                height: it.height,
                near: it.near,
            };
            entity.add(Name(it.name.clone())).add(order);
            world.spawn(entity.add(camera).add(it.orbit).build());
        }
        let background = Background(self.background);
        world.spawn(entity.add(self.view.clone()).add(background).build());
        world
    }
}
