//! `requires`: answers known on paper, comparison with f64, and the least scene.

mod bits;
mod known;
mod least;
mod scenes;
mod sixteen;

use glam::DVec3;
use hecs::World;
use shadetrade::components::{
    ActiveCamera, Background, Budget, FileOrder, Inspector, Material, Name, Orbit, Probed, Show,
    Spin, Tolerance, Transform, View,
};
use shadetrade::report::Monitor;
use shadetrade::requires::{Change, Part, changes, parts};
use shadetrade::scene::Scene;

/// Reflects diffuse light fully, and half of specular light.
const WHITE: Material = Material {
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
        Transform::at(view.viewpoint.position),
        view.viewpoint.camera,
        Orbit::default(),
    );
    let camera = world.spawn(camera);
    world.spawn((
        ActiveCamera(camera),
        view.projection,
        Background(view.background),
        Tolerance(view.tolerance),
        Budget::default(),
        Spin::default(),
        Show::default(),
        Probed::default(),
        Inspector::default(),
    ));
    Scene {
        name: "test".to_owned(),
        path: None,
        text: String::new(),
        warning: None,
        world,
    }
}

/// The change of the picture without a part.
fn change(scene: &Scene, view: &View, part: Part) -> Change {
    let changes = changes(scene, view, &[vec![part]], Monitor::NONE);
    changes.expect("nobody cancels it")[0]
}

/// The names of all parts that the picture requires.
fn required(scene: &Scene, view: &View) -> Vec<String> {
    let parts = parts(scene).into_iter();
    let required = parts.filter(|(part, _)| !change(scene, view, *part).keeps(view.tolerance));
    required.map(|(_, name)| name).collect()
}
