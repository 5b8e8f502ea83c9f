//! Spawns a record as a [`World`], and takes a record from a world. The two are inverse.

use hecs::World;

use super::record::{CameraRecord, CuboidRecord, LightRecord, SceneRecord, ViewRecord};
use crate::components::{
    ActiveCamera, Background, Budget, Camera, FileOrder, Inspector, Light, LightKind, Material,
    Mesh, Name, Normals, Orbit, Probed, Projected, ShadingMode, Show, Spin, Tolerance, Transform,
    VertexColors, WorldTransform, active_camera, get, in_file_order, look, ordered,
};

type CuboidParts<'a> = (
    &'a Name,
    &'a Transform,
    &'a Mesh,
    &'a Material,
    &'a ShadingMode,
);
type CameraParts<'a> = (&'a Name, &'a Transform, &'a Camera, &'a Orbit);

impl SceneRecord {
    /// The record of a world. It does not tell whether the cuboids keep turning.
    ///
    /// # Panics
    /// If the world has no viewer or no camera. A spawned scene has both.
    pub fn of(world: &World) -> SceneRecord {
        let cuboid =
            in_file_order::<CuboidParts, _>(world, |(name, at, mesh, material, shading)| {
                CuboidRecord {
                    name: name.0.clone(),
                    size: mesh.size(),
                    position: at.position,
                    rotation: at.rotation,
                    shading: *shading,
                    material: *material,
                }
            });
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
            in_file_order::<CameraParts, _>(world, |(name, at, camera, orbit)| CameraRecord {
                name: name.0.clone(),
                position: at.position,
                target: camera.target,
                up: camera.up,
                fov: camera.fov,
                height: camera.height,
                near: camera.near,
                orbit: *orbit,
            });
        let active = active_camera(world);
        let is_first = ordered::<Camera>(world).first() == Some(&active);
        let name = get(world, active).map(|Name(name)| name);
        let show: Show = look(world);
        SceneRecord {
            background: look::<Background>(world).0,
            cuboid,
            light,
            camera,
            view: ViewRecord {
                camera: name.filter(|_| !is_first),
                projection: look(world),
                tolerance: look::<Tolerance>(world).0,
                budget: look::<Budget>(world).0,
                show: show.mode,
                sides: show.sides,
                divider: show.divider,
                turned: look::<Spin>(world).degrees,
                pixel: look::<Probed>(world).0,
                inspector: look::<Inspector>(world).0,
            },
        }
    }

    /// The world of this record.
    ///
    /// # Panics
    /// If there is no camera.
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
        let mut cameras = Vec::with_capacity(self.camera.len());
        for (order, it) in (0..).map(FileOrder).zip(&self.camera) {
            let camera = Camera {
                target: it.target,
                up: it.up,
                fov: it.fov,
                height: it.height,
                near: it.near,
            };
            let (name, place) = (Name(it.name.clone()), Transform::at(it.position));
            cameras.push(world.spawn((name, order, place, camera, it.orbit)));
        }
        let view = &self.view;
        world.spawn((
            ActiveCamera(cameras[self.active_camera().unwrap_or(0)]),
            Background(self.background),
            view.projection,
            Tolerance(view.tolerance),
            Budget(view.budget),
            Spin {
                degrees: view.turned,
                on: false,
            },
            Show {
                mode: view.show,
                sides: view.sides,
                divider: view.divider,
            },
            Probed(view.pixel),
            Inspector(view.inspector),
        ));
        world
    }
}
