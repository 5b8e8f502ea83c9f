//! `requires`: answers known on paper, comparison with f64, and the least scene.

mod known;
mod least;
mod scenes;
mod segments;
mod sixteen;

use glam::DVec3;
use hecs::World;
use shadetrade::components::{
    Background, FileOrder, LightKind, Material, Name, Orbit, Projection, Transform, View, Viewer,
};
use shadetrade::output::Monitor;
use shadetrade::questions::requires::{Change, Part, changes, parts};
use shadetrade::scene::{Scene, SceneRecord};

use crate::support::scene::{done, empty, shine, spawn_cuboid, view};

/// Reflects diffuse light fully, and half of specular light.
pub const WHITE: Material = Material {
    ambient: DVec3::ONE,
    diffuse: DVec3::ONE,
    specular: DVec3::splat(0.5),
    shininess: 20.0,
};

/// The scene of a world and of the camera of a view.
fn scene_of(mut world: World, view: &View) -> Scene {
    let camera = (
        Name("1".to_owned()),
        FileOrder(0),
        view.camera,
        Orbit::default(),
    );
    world.spawn(camera);
    let viewer = Viewer {
        projection: view.projection,
        tolerance: view.tolerance,
        ..Viewer::default()
    };
    world.spawn((viewer, Background(view.background)));
    let mut scene = Scene::spawn("test".to_owned(), &SceneRecord::default());
    scene.world = world;
    scene
}

/// Cubes with edges of 2 under white lights, and a view of them.
fn cubes(places: &[Transform], lights: &[(LightKind, f64, DVec3)], view: &View) -> Scene {
    let mut world = empty();
    for place in places {
        spawn_cuboid(&mut world, DVec3::splat(2.0), *place, WHITE);
    }
    for (kind, levels, position) in lights {
        shine(&mut world, *kind, *levels, *position);
    }
    scene_of(world, view)
}

/// A view from +z towards the origin, in perspective, at half a level. Its sides are odd, so that the middle of the picture
/// is a pixel centre.
fn from_z(distance: f64, projection: Projection) -> View {
    let eye = DVec3::Z * distance;
    view([49, 37], eye, DVec3::ZERO, projection).with_tolerance(0.5)
}

/// The change of the picture without a part.
fn change(scene: &Scene, view: &View, part: Part) -> Change {
    done(changes(scene, view, &[vec![part]], Monitor::NONE))[0]
}

/// The names of all parts that the picture requires.
fn required(scene: &Scene, view: &View) -> Vec<String> {
    let parts = parts(scene).into_iter();
    let required = parts.filter(|(part, _)| !change(scene, view, *part).keeps(view.tolerance));
    required.map(|(_, name)| name).collect()
}
