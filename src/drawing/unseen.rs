//! Why a picture shows no cuboid.

use glam::{DVec3, dvec3};
use hecs::World;

use crate::components::{Lens, Mesh, Transform, View, in_file_order};
use crate::report::words::rounded;

/// The places of the cuboids in a picture in which none is seen.
pub fn reason(world: &World, view: &View) -> String {
    let lens = Lens::new(view);
    let mut places = in_file_order::<(&Mesh, &Transform), _>(world, |(mesh, transform)| {
        let transform = transform.turned(view.turned);
        let axes = transform.axes();
        let corners = mesh
            .corners
            .map(|corner| axes * corner + transform.position);
        place(&lens, corners.map(|corner| lens.seen(corner)))
    });
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

/// The place of a cuboid that is not seen. Its corners are relative to the eye, along right, up and forward.
fn place(lens: &Lens, corners: [DVec3; 8]) -> &'static str {
    let all = |is_there: &dyn Fn(&DVec3) -> bool| corners.iter().all(is_there);
    let [right, top] = lens.middle.map(|pixels| pixels * lens.pitch);
    // A point is outside of a side of the picture if its product with this vector is positive.
    let sides = [
        dvec3(1.0, 0.0, -right),
        dvec3(-1.0, 0.0, -right),
        dvec3(0.0, 1.0, -top),
        dvec3(0.0, -1.0, -top),
    ];
    let is_outside = |side: &DVec3| all(&|corner| side.dot(lens.homogeneous(*corner)) > 0.0);
    if all(&|corner| corner.z <= 0.0) {
        "behind the eye"
    } else if all(&|corner| corner.z <= lens.near) {
        "before the near plane"
    } else if sides.iter().any(is_outside) {
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
