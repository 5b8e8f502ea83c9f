//! Whether a picture shows all cuboids, and why nothing is seen in it.

use glam::{DVec3, dvec3};
use hecs::World;

use crate::components::{Lens, Light, LightKind, Material, Mesh, Transform, View, in_file_order};
use crate::output::words::rounded;

/// The reason why nothing is seen in a picture with so many pixels of cuboids: their places, or light that is too weak. `None`
/// if something is.
pub fn reason(world: &World, view: &View, covered_pixels: u64) -> Option<String> {
    if covered_pixels == 0 {
        return Some(places(world, view));
    }
    let most = most_light(world);
    let dark = "almost nothing is seen: no light adds more than 1 level of 255; gain = 255 makes an intensity of 1 full brightness";
    (most > 0.0 && most <= 1.0).then(|| dark.to_owned())
}

/// The most that one light may add to the colour of a cuboid, in levels of 255.
fn most_light(world: &World) -> f64 {
    let materials = in_file_order::<&Material, _>(world, |material| *material);
    let strongest = |of: fn(&Material) -> DVec3| {
        let coefficients = materials.iter().map(of);
        coefficients.fold(DVec3::ZERO, DVec3::max)
    };
    let lights = in_file_order::<&Light, _>(world, |light| {
        let sent = light.color * light.intensity * light.gain;
        let coefficient = strongest(match light.kind {
            LightKind::Ambient => |it| it.ambient,
            LightKind::Diffuse => |it| it.diffuse,
            LightKind::Specular => |it| it.specular,
        });
        light.on.then(|| (coefficient * sent).max_element())
    });
    lights.into_iter().flatten().fold(0.0, f64::max)
}

/// The places of the cuboids in a picture in which none is seen.
fn places(world: &World, view: &View) -> String {
    let lens = Lens::new(view);
    let corners = corners(world, view, &lens).into_iter();
    let mut places: Vec<_> = corners.map(|corners| place(&lens, corners)).collect();
    let lie = if places.len() == 1 {
        "the cuboid lies"
    } else {
        "all cuboids lie"
    };
    places.sort_unstable();
    places.dedup();
    let near = format!("the near plane ({:?})", rounded(lens.near, 2));
    let places = places.join(" or ").replace("the near plane", &near);
    format!("nothing is seen: {lie} {places}")
}

/// Whether the whole of every cuboid lies within the picture.
pub fn shows_all(world: &World, view: &View) -> bool {
    let lens = Lens::new(view);
    let is_inside = |corner: &DVec3| {
        let point = lens.homogeneous(*corner);
        corner.z > lens.near && sides(&lens).iter().all(|side| side.dot(point) <= 0.0)
    };
    let corners = corners(world, view, &lens);
    corners.as_flattened().iter().all(is_inside)
}

/// The height of all cuboids in the picture, in pixels; `None` if a part of one is not before the eye.
pub fn height(world: &World, view: &View) -> Option<f64> {
    let lens = Lens::new(view);
    let row = |corner: &DVec3| {
        let point = lens.homogeneous(*corner);
        (point.z > 0.0).then(|| lens.pixel(point)[1])
    };
    let corners = corners(world, view, &lens);
    let rows: Vec<f64> = corners
        .as_flattened()
        .iter()
        .map(row)
        .collect::<Option<_>>()?;
    let [least, most] = [
        rows.iter().copied().reduce(f64::min)?,
        rows.into_iter().reduce(f64::max)?,
    ];
    Some(most - least)
}

/// The corners of each cuboid relative to the eye, along right, up and forward.
fn corners(world: &World, view: &View, lens: &Lens) -> Vec<[DVec3; 8]> {
    in_file_order::<(&Mesh, &Transform), _>(world, |(mesh, transform)| {
        corners_of(mesh, transform, view, lens)
    })
}

/// The corners of a cuboid relative to the eye, along right, up and forward.
pub fn corners_of(mesh: &Mesh, transform: &Transform, view: &View, lens: &Lens) -> [DVec3; 8] {
    let transform = transform.turned(view.turned);
    let axes = transform.axes();
    mesh.corners
        .map(|corner| lens.seen(axes * corner + transform.position))
}

/// For each side of the picture a vector whose product with a homogeneous point is positive outside of it.
fn sides(lens: &Lens) -> [DVec3; 4] {
    let [right, top] = lens.middle.map(|pixels| pixels * lens.pitch);
    [
        dvec3(1.0, 0.0, -right),
        dvec3(-1.0, 0.0, -right),
        dvec3(0.0, 1.0, -top),
        dvec3(0.0, -1.0, -top),
    ]
}

/// The place of a cuboid that is not seen.
fn place(lens: &Lens, corners: [DVec3; 8]) -> &'static str {
    let all = |is_there: &dyn Fn(&DVec3) -> bool| corners.iter().all(is_there);
    let is_outside = |side: &DVec3| all(&|corner| side.dot(lens.homogeneous(*corner)) > 0.0);
    if all(&|corner| corner.z <= 0.0) {
        "behind the eye"
    } else if all(&|corner| corner.z <= lens.near) {
        "before the near plane"
    } else if sides(lens).iter().any(is_outside) {
        "beside the picture"
    } else if all(&|corner| corner.z > lens.near) {
        "beside the picture or between the centres of pixels"
    } else {
        "open at the near plane, and its inside is not drawn"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::components::Projection;

    #[test]
    fn the_place_of_a_cuboid_follows_from_its_corners() {
        // Two units are seen at distance 1 in perspective, and two units everywhere.
        for projection in Projection::ALL {
            let lens = Lens {
                near: 0.5,
                projection,
                pitch: 0.1,
                middle: [10.0, 10.0],
                ..Lens::default()
            };
            let of = |centre: DVec3, half: f64| {
                place(
                    &lens,
                    Mesh::cuboid(DVec3::splat(2.0 * half))
                        .corners
                        .map(|it| it + centre),
                )
            };
            assert_eq!(of(DVec3::NEG_Z, 0.5), "behind the eye");
            assert_eq!(of(DVec3::Z * 0.2, 0.25), "before the near plane");
            for aside in [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y] {
                assert_eq!(of(DVec3::Z + aside * 3.0, 0.4), "beside the picture");
            }
            assert!(of(DVec3::Z, 1e-3).contains("centres of pixels"));
            assert!(of(DVec3::ZERO, 1.0).contains("open at the near plane"));
        }
    }
}
