//! Spawns a record as a [`World`], and takes a record from a world.

use hecs::World;

use super::record::{CameraRecord, CuboidRecord, LightRecord, SceneRecord};
use crate::components::{
    Background, Camera, FileOrder, Light, LightKind, Material, Mesh, Name, NormalMode, Normals,
    Orbit, Projected, Segments, ShadingMode, Transform, VertexColors, Viewer, WorldTransform,
    background, in_file_order, viewer,
};

impl SceneRecord {
    /// The record of a world. It does not tell whether the cuboids keep turning.
    ///
    /// # Panics
    /// If the world has no viewer or no camera. A spawned scene has both.
    pub fn of(world: &World) -> SceneRecord {
        type Parts<'a> = (
            &'a Name,
            &'a Transform,
            &'a Mesh,
            &'a Material,
            &'a ShadingMode,
            &'a NormalMode,
            &'a Segments,
        );
        let cuboid = in_file_order::<Parts, _>(
            world,
            |(name, at, mesh, material, shading, normals, segments)| CuboidRecord {
                name: name.0.clone(),
                size: mesh.size(),
                position: at.position,
                rotation: at.rotation,
                shading: *shading,
                normals: *normals,
                segments: *segments,
                material: *material,
            },
        );
        let light = in_file_order::<(&Name, &Transform, &Light), _>(world, |(name, at, light)| {
            LightRecord {
                name: name.0.clone(),
                kind: light.kind,
                color: light.color,
                intensity: light.intensity,
                gain: light.gain,
                position: (light.kind != LightKind::Ambient).then_some(at.position),
                on: light.on,
            }
        });
        let camera =
            in_file_order::<(&Name, &Camera, &Orbit), _>(world, |(name, camera, orbit)| {
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
            });
        let mut view = Viewer::clone(&viewer(world));
        view.turns = false;
        // A camera that is gone, or the first one, has no name here.
        view.camera = view
            .camera
            .filter(|name| camera.iter().skip(1).any(|it| it.name == *name));
        SceneRecord {
            background: background(world),
            cuboid,
            light,
            camera,
            view,
        }
    }

    /// The world of this record.
    pub fn spawn(&self) -> World {
        let mut world = World::new();
        for (order, it) in (0..).map(FileOrder).zip(&self.cuboid) {
            let transform = Transform {
                position: it.position,
                rotation: it.rotation,
            };
            let (name, mesh) = (Name(it.name.clone()), Mesh::cuboid(it.size));
            world.spawn((
                name,
                order,
                transform,
                mesh,
                it.material,
                it.shading,
                it.normals,
                it.segments,
                WorldTransform::default(),
                Normals::default(),
                VertexColors::default(),
                Projected::default(),
            ));
        }
        for (order, it) in (0..).map(FileOrder).zip(&self.light) {
            let light = Light {
                kind: it.kind,
                color: it.color,
                intensity: it.intensity,
                gain: it.gain,
                on: it.on,
            };
            let place = Transform::at(it.position.unwrap_or_default());
            world.spawn((Name(it.name.clone()), order, place, light));
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
            world.spawn((Name(it.name.clone()), order, camera, it.orbit));
        }
        world.spawn((self.view.clone(), Background(self.background)));
        world
    }
}
