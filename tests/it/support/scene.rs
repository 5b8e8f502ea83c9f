//! Worlds built by hand with the components of a scene file, and pictures of them.

use std::future::Future;

use fearless_simd::Level;
use glam::DVec3;
use hecs::{Entity, World};
use shadetrade::components::{
    Camera, FileOrder, Light, LightKind, Material, Mesh, Name, NormalMode, Normals, Projected,
    Projection, Segments, ShadingMode, Transform, VertexColors, View, WorldTransform, ordered,
};
use shadetrade::output::{Monitor, finished};
use shadetrade::reference::{Truth, picture};
use shadetrade::scene::{Scene, SceneRecord};
use shadetrade::shading::LIMIT_0;
use shadetrade::systems;
use shadetrade::systems::frame::{Frame, Keep, Workers};

/// The built-in scene.
pub fn built_in() -> Scene {
    Scene::load(None).expect("it is built in")
}

/// The built-in scene after a change.
pub fn changed(change: impl FnOnce(&mut SceneRecord)) -> Scene {
    let mut record = built_in_record();
    change(&mut record);
    Scene::spawn("changed".to_owned(), &record)
}

pub fn built_in_record() -> SceneRecord {
    SceneRecord::of(&built_in().world)
}

/// The result of work on a small picture, which nobody cancels.
#[track_caller]
pub fn done<T>(work: impl Future<Output = anyhow::Result<T>>) -> T {
    finished(work).expect("it fits, and nobody cancels it")
}

/// Cancels work at once.
pub const CANCEL: Monitor = Monitor {
    is_cancelled: &|| true,
    ..Monitor::NONE
};

/// An empty world.
pub fn empty() -> World {
    World::new()
}

/// Adds a cuboid, which is shaded as the view says.
pub fn spawn_cuboid(
    world: &mut World,
    size: DVec3,
    transform: Transform,
    material: Material,
) -> Entity {
    let order = world.query_mut::<&Mesh>().into_iter().count();
    world.spawn((
        Name("cuboid".into()),
        FileOrder(order as u32),
        transform,
        Mesh::cuboid(size),
        material,
        ShadingMode::Phong,
        NormalMode::Corner,
        Segments::default(),
        WorldTransform::default(),
        Normals::default(),
        VertexColors::default(),
        Projected::default(),
    ))
}

/// Adds a light of `levels` per channel.
pub fn spawn_light(world: &mut World, kind: LightKind, levels: DVec3, position: DVec3) {
    let light = Light {
        kind,
        color: levels / 100.0,
        intensity: 50.0,
        gain: 2.0,
        on: true,
    };
    let order = FileOrder(world.len());
    world.spawn((Name(format!("{kind:?}")), order, at(position), light));
}

/// Adds a white light of `levels`.
pub fn shine(world: &mut World, kind: LightKind, levels: f64, position: DVec3) {
    spawn_light(world, kind, DVec3::splat(levels), position);
}

/// A material with these kA, kD and kE in every channel.
pub const fn grey([ambient, diffuse, specular]: [f64; 3], shininess: f64) -> Material {
    Material {
        ambient: DVec3::splat(ambient),
        diffuse: DVec3::splat(diffuse),
        specular: DVec3::splat(specular),
        shininess,
    }
}

/// A material that reflects all light.
pub const fn white(shininess: f64) -> Material {
    grey([1.0; 3], shininess)
}

/// A position without rotation.
pub fn at(position: DVec3) -> Transform {
    Transform::at(position)
}

/// A position and a rotation in degrees.
pub fn placed(position: impl Into<DVec3>, rotation: impl Into<DVec3>) -> Transform {
    let (position, rotation) = (position.into(), rotation.into());
    Transform { position, rotation }
}

/// A rotation at the origin, in degrees.
pub fn turned(rotation: impl Into<DVec3>) -> Transform {
    placed(DVec3::ZERO, rotation)
}

/// A view from `eye` towards `target`, 30 degrees or 6 units high, at tolerance 0.
pub fn view(size: [usize; 2], eye: DVec3, target: DVec3, projection: Projection) -> View {
    let camera = Camera {
        position: eye,
        target,
        up: DVec3::Y,
        fov: 30.0,
        height: 6.0,
        near: None,
    };
    View {
        size,
        camera,
        projection,
        background: DVec3::new(20.0, 20.0, 24.0),
        turned: 0,
        shading: None,
        segments: None,
        tolerance: 0.0,
    }
}

/// The view of the camera with this index in the file, at tolerance 0.
pub fn view_from(scene: &Scene, camera: usize, size: [usize; 2]) -> View {
    View {
        camera: Camera::of(&scene.world, ordered::<Camera>(&scene.world)[camera]),
        ..View::of(&scene.world, size).with_tolerance(0.0)
    }
}

/// A picture drawn by the calling thread at the best SIMD level.
pub fn draw(world: &mut World, view: &View, keep: Keep) -> Frame {
    let mut frame = Frame::new(keep, Workers::alone(Level::new()));
    systems::draw(world, view, &mut frame).expect("a small picture fits");
    frame
}

/// The largest error that a tolerance allows.
pub fn limit(tolerance: f64) -> f64 {
    if tolerance > 0.0 { tolerance } else { LIMIT_0 }
}

/// The picture of the reference in f64.
pub fn truth(world: &World, view: &View) -> Truth {
    done(picture(world, view, 0..view.size[1], Monitor::NONE))
}

/// The text of the built-in scene, without its view.
pub fn text_without_view() -> String {
    let text = shadetrade::scene::BUILT_IN[0].1;
    let (head, view) = text.split_once("[view]").expect("it has a view");
    let (_, rest) = view.split_once("\n[[cuboid]]").expect("it has a cuboid");
    format!("{head}\n[[cuboid]]{rest}")
}
