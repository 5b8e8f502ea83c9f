//! What a scene requires: answers known on paper, against an evaluation in f64, and of the least scene.

mod known;
mod least;
mod scenes;
mod sixteen;

use glam::DVec3;
use hecs::{Component, Entity, World};
use shadetrade::components::{FileOrder, Light, Material, Mesh, Name, Orbit, Transform, View};
use shadetrade::requires::{Change, Part, changes, parts};
use shadetrade::scene::Scene;

/// Reflects diffuse light as it is, and half of specular light.
const WHITE: Material = Material {
    ambient: DVec3::ONE,
    diffuse: DVec3::ONE,
    specular: DVec3::splat(0.5),
    shininess: 20.0,
};

/// The scene of a world, and of the camera of a view.
fn scene_of(mut world: World, view: &View) -> Scene {
    let camera = (
        Name("1".to_owned()),
        Transform::at(view.viewpoint.position),
        view.viewpoint.camera,
        Orbit::default(),
    );
    let cameras = vec![world.spawn(camera)];
    Scene {
        name: "test".to_owned(),
        path: None,
        background: view.background,
        warning: None,
        cuboids: in_file_order::<Mesh>(&world),
        lights: in_file_order::<Light>(&world),
        cameras,
        world,
    }
}

fn in_file_order<C: Component>(world: &World) -> Vec<Entity> {
    let mut query = world.query::<(Entity, &FileOrder, &C)>();
    let mut entities: Vec<_> = query
        .iter()
        .map(|(entity, order, _)| (*order, entity))
        .collect();
    entities.sort_by_key(|(order, _)| *order);
    entities.into_iter().map(|(_, entity)| entity).collect()
}

/// What the picture errs without a part.
fn change(scene: &Scene, view: &View, part: Part) -> Change {
    let changes = changes(scene, view, &[vec![part]], &|| false, &|_| ());
    changes.expect("nobody cancels it")[0]
}

/// Every part of a scene that the picture requires, by name.
fn required(scene: &Scene, view: &View) -> Vec<String> {
    let parts = parts(scene).into_iter();
    let required = parts.filter(|(part, _)| !change(scene, view, *part).keeps(view.tolerance));
    required.map(|(_, name)| name).collect()
}
