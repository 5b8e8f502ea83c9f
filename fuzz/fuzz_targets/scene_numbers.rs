//! Fuzzes the numbers of a scene over the ranges of the scene format: the pictures of every mode, projection and
//! tolerance keep their promises.
//!
//! `SHADETRADE_SHOW=1 cargo +nightly fuzz run scene_numbers ARTIFACT` prints the scene of an artifact.
#![no_main]

#[path = "../promises.rs"]
mod promises;

use arbitrary::{Arbitrary, Result, Unstructured};
use glam::DVec3;
use hecs::World;
use libfuzzer_sys::fuzz_target;
use shadetrade::components::{
    Camera, FileOrder, Light, LightKind, Material, Mesh, Name, Normals, Projected, Projection,
    ShadingMode, Transform, VertexColors, View, WorldTransform, length, unit,
};

const LENGTHS: [f64; 2] = [1e-100, 1e100];
const COORDINATES: [f64; 2] = [-1e100, 1e100];
const STRENGTHS: [f64; 2] = [0.0, 1e30];

/// Numbers that are likely to expose a fault.
const DELICATE: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    2.0,
    10.0,
    90.0,
    1e-9,
    f64::EPSILON,
    1.0 + f64::EPSILON,
    1.0 - f64::EPSILON / 2.0,
    1e-38,
    1e9,
    f64::MIN_POSITIVE,
    255.0,
];

/// A number in the range: delicate, of any magnitude, or ordinary.
fn number(u: &mut Unstructured, [least, most]: [f64; 2]) -> Result<f64> {
    let number = match u.int_in_range(0..=7_u8)? {
        0 => *u.choose(&DELICATE)?,
        1 => f64::arbitrary(u)?,
        2 => *u.choose(&[least, most])?,
        3 => f64::from(i16::arbitrary(u)?) * 10.0_f64.powi(u.int_in_range(-100..=100)?),
        4 => f64::from(i8::arbitrary(u)?) / 8.0,
        _ => f64::from(i16::arbitrary(u)?) / 4096.0,
    };
    // As in a scene file, zero has no sign.
    Ok(if number.is_nan() { 1.0 } else { number + 0.0 }.clamp(least, most) + 0.0)
}

fn three(u: &mut Unstructured, range: [f64; 2]) -> Result<DVec3> {
    Ok(DVec3::new(
        number(u, range)?,
        number(u, range)?,
        number(u, range)?,
    ))
}

/// A position or size in multiples of `scale`, most often near the origin.
fn scaled(u: &mut Unstructured, scale: f64, range: [f64; 2]) -> Result<DVec3> {
    let plain = three(u, COORDINATES)? * scale;
    Ok(plain.clamp(DVec3::splat(range[0]), DVec3::splat(range[1])))
}

fn cuboid(u: &mut Unstructured, scale: f64, world: &mut World) -> Result<()> {
    let transform = Transform {
        position: scaled(u, scale, COORDINATES)?,
        rotation: three(u, [f64::MIN, f64::MAX])? * *u.choose(&[1.0, 0.0, 0.0])?,
    };
    let material = Material {
        ambient: three(u, STRENGTHS)?,
        diffuse: three(u, STRENGTHS)?,
        specular: three(u, STRENGTHS)?,
        shininess: number(u, [0.0, 1e6])?,
    };
    let size = if u.arbitrary()? {
        scaled(u, scale, LENGTHS)?.abs()
    } else {
        DVec3::splat(scale)
    };
    let order = world.query_mut::<&Mesh>().into_iter().count();
    let (name, mesh) = (Name("cuboid".into()), Mesh::cuboid(size));
    world.spawn((
        name,
        FileOrder(order as u32),
        transform,
        mesh,
        material,
        ShadingMode::Phong,
        WorldTransform::default(),
        Normals::default(),
        VertexColors::default(),
        Projected::default(),
    ));
    Ok(())
}

fn light(u: &mut Unstructured, scale: f64, world: &mut World) -> Result<()> {
    let light = Light {
        kind: *u.choose(&[LightKind::Ambient, LightKind::Diffuse, LightKind::Specular])?,
        color: three(u, STRENGTHS)?,
        intensity: number(u, STRENGTHS)?,
        gain: *u.choose(&[1.0, 100.0, 1e30])?,
        on: true,
    };
    let transform = Transform::at(scaled(u, scale, COORDINATES)?);
    let order = FileOrder(world.query_mut::<&Light>().into_iter().count() as u32);
    world.spawn((Name("light".into()), order, transform, light));
    Ok(())
}

/// A legal scene and a view of it; `None` if the camera has no direction.
fn scene(u: &mut Unstructured) -> Result<Option<(World, View)>> {
    let scale = *u.choose(&[1.0, 1.0, 1.0, 1e90, 1e-90, 1e-3, 1e6])?;
    let mut world = World::new();
    for _ in 0..u.int_in_range(1..=3)? {
        cuboid(u, scale, &mut world)?;
    }
    for _ in 0..u.int_in_range(0..=4)? {
        light(u, scale, &mut world)?;
    }
    let any_up = three(u, COORDINATES)?;
    let [height, near] = [number(u, LENGTHS)?, number(u, LENGTHS)?]
        .map(|length| (length * scale).clamp(LENGTHS[0], LENGTHS[1]));
    let camera = Camera {
        position: scaled(u, scale, COORDINATES)?,
        target: scaled(u, scale, COORDINATES)?,
        up: *u.choose(&[DVec3::Y, DVec3::Z, any_up])?,
        fov: number(u, [5e-324, 179.0])?.max(*u.choose(&[0.0, 30.0])?),
        height,
        near: *u.choose(&[None, Some(near)])?,
    };
    let forward = camera.target - camera.position;
    let parallel = unit(camera.up).cross(unit(forward)).length() < 1e-9;
    if length(forward) < LENGTHS[0] || parallel {
        return Ok(None);
    }
    let view = View {
        size: [u.int_in_range(1..=40)?, u.int_in_range(1..=30)?],
        camera,
        projection: *u.choose(&[Projection::Perspective, Projection::Orthographic])?,
        background: DVec3::new(20.0, 0.0, 255.0),
        turned: 0,
        shading: None,
        tolerance: *u.choose(&[0.5, 0.05, 1e-6, 4.0, 255.0])?,
    };
    Ok(Some((world, view)))
}

fn show(world: &mut World, view: &View) {
    for (transform, mesh, material) in world.query_mut::<(&Transform, &Mesh, &Material)>() {
        let size = mesh.corners[7] * 2.0;
        println!("size {size:?}, {transform:?}, {material:?}");
    }
    for (transform, light) in world.query_mut::<(&Transform, &Light)>() {
        println!("{:?}, {light:?}", transform.position);
    }
    println!("{view:?}");
}

fuzz_target!(|bytes: &[u8]| {
    if let Ok(Some((mut world, view))) = scene(&mut Unstructured::new(bytes)) {
        if std::env::var_os("SHADETRADE_SHOW").is_some() {
            show(&mut world, &view);
        }
        promises::check(&mut world, &view);
    }
});
