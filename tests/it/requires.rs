//! `requires`: answers known on paper, comparison with f64, and the least scene.

mod known;
mod least;
mod scenes;
mod segments;
mod sixteen;

use shadetrade::questions::requires::{Change, Part, changes, parts};
use shadetrade::scene::CuboidRecord;

use crate::support::prelude::*;

/// Reflects diffuse light fully, and half of specular light.
pub const WHITE: Material = grey([1.0, 1.0, 0.5], 20.0);

/// Cubes with edges of 2 under white lights, and the camera of a view of them.
fn cubes(places: &[Transform], lights: &[(LightKind, f64, DVec3)], view: &View) -> Scene {
    let mut record = SceneRecord::default();
    for (number, place) in places.iter().enumerate() {
        record.cuboid.push(CuboidRecord {
            rotation: place.rotation,
            material: WHITE,
            ..records::cuboid(number.to_string(), [2.0; 3], place.position)
        });
    }
    for (number, (kind, levels, position)) in lights.iter().enumerate() {
        let light = records::light(number.to_string(), *kind, *levels, *position);
        record.light.push(light);
    }
    let camera = &view.camera;
    let sees = [camera.fov, camera.height];
    record.camera = vec![records::camera("1", camera.position, camera.target, sees)];
    Scene::spawn("test".to_owned(), &record)
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
