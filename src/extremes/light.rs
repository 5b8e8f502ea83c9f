//! Where lights are: on the surface, in it, in its planes, at infinity.
//!
//! Known levels are of the pixel whose centre looks straight down, in an orthographic picture whose pixels are half a unit
//! apart, on a cube from -2 to 2: at (x, y, 2) the normal is (x, y, 2) at length one.

use glam::DVec3;

use super::Case;
use super::judge::{KnownPixel, known_pixels, proven, same_picture};
use super::scene_spec::{RenderConfig, SceneSpec, around, cuboid, light, lights_at, scene};
use crate::components::{LightKind, Material, Projection};
use crate::scene::EMERALD;

/// The cases.
pub fn cases() -> Vec<Case> {
    vec![
        proven(
            "light on a face, and an ulp to either side",
            (around(1.0).map(|z| [0.3, 0.4, z]).into_iter())
                .chain([[2.0, 0.1, 0.3]])
                .map(close_to),
        ),
        proven(
            "light 1e-3, 1e-6 and 1e-9 above a face",
            [1e-3, 1e-6, 1e-9].map(|gap| close_to([0.3, 0.4, 1.0 + gap])),
        ),
        proven(
            "light on an edge",
            [[2.0, 1.5, 0.3], [0.1, 1.5, 1.0]].map(close_to),
        ),
        proven(
            "light on a vertex",
            [[2.0, 1.5, 1.0], [-2.0, 1.5, 1.0]].map(close_to),
        ),
        proven(
            "light inside the cuboid",
            [[0.0, 0.0, 0.0], [0.3, 0.4, 0.2], [1.9, 1.4, 0.9]].map(close_to),
        ),
        proven(
            "light in the plane of a face, and an ulp to either side",
            (around(1.0).map(|z| [6.0, 1.2, z]).into_iter())
                .chain([[30.0, 1.5, 20.0], [2.0, 9.0, 7.0]])
                .map(lit_from),
        ),
        known_pixels(
            "light at the very point seen adds nothing",
            [straight_down([1.0, 0.5], [1.0, 0.5, 2.0], 0.0, 30.0)],
        ),
        // l = o = (0, 0, 1) and n = (2, 1, 4) / sqrt 21, so o.r = 2 n_z^2 - 1 = 11 / 21.
        known_pixels(
            "light an ulp, and 1e-6, above the point seen",
            [2.0_f64.next_up(), 2.0 + 1e-6].map(|z| {
                let levels = 30.0 + 100.0 * (4.0 / 21.0_f64.sqrt() + 121.0 / 441.0);
                straight_down([1.0, 0.5], [1.0, 0.5, z], 2.0, levels)
            }),
        ),
        known_pixels(
            "light an ulp, and 1e-6, below the point seen adds nothing",
            [2.0_f64.next_down(), 2.0 - 1e-6]
                .map(|z| straight_down([1.0, 0.5], [1.0, 0.5, z], 0.0, 30.0)),
        ),
        known_pixels(
            "n.l = 0 exactly: neither term, not even with 0^0",
            [straight_down([0.0, 0.0], [7.0, 3.0, 2.0], 0.0, 30.0)],
        ),
        // A light 1e-4 above the plane and 10 away; rho = 0 makes the highlight whole where the gate is open.
        known_pixels(
            "n.l = +-1e-5: the highlight's gate is open, and shut",
            [(1e-4, 130.001), (-1e-4, 30.0)].map(|(height, levels)| {
                straight_down([0.0, 0.0], [10.0, 0.0, 2.0 + height], 0.0, levels)
            }),
        ),
        // At (0.5, 0, 2) n = (1, 0, 4) / sqrt 17. A light low behind it, l = (-1, 0, 0.3) / sqrt 1.09, has n.l = 0.2 / sqrt
        // 18.53 and is mirrored downwards: r_z = 2 n.l n_z - l_z = -0.2.
        known_pixels(
            "o.r negative: no highlight unless 0^0",
            [(1.0, 0.0), (0.0, 100.0)].map(|(shininess, highlight)| {
                let levels = 30.0 + 100.0 * 0.2 / 18.53_f64.sqrt() + highlight;
                straight_down([0.5, 0.0], [-4.5, 0.0, 3.5], shininess, levels)
            }),
        ),
        known_pixels(
            "light and eye above the point seen: the whole highlight",
            [0.0, 1.0, 76.8, 1000.0, 1e6]
                .map(|shininess| straight_down([0.0, 0.0], [0.0, 0.0, 9.0], shininess, 230.0)),
        ),
        proven(
            "light 1e9 and 1e100 units away",
            [[1e9, 2e9, 1e9], [1e100, 1e100, 1e100], [-1e100, 1.0, 1e100]].map(lit_from),
        ),
        same_picture(
            "light 1e100 away against the same direction from 1e12",
            1.0,
            [[1e12, 2e12, 3e12], [1e99, 2e99, 3e99]].map(lit_from),
        ),
    ]
}

/// The default cuboid with its lights at this place, from near by.
fn close_to(place: [f64; 3]) -> SceneSpec {
    let eye = DVec3::from(place) + DVec3::new(1.0, 0.9, 2.0);
    lit_from(place).target(place).eye(eye).height(1.5)
}

/// The default scene, its lights at this place.
fn lit_from(place: [f64; 3]) -> SceneSpec {
    scene().lights(lights_at(place))
}

/// A cube from -2 to 2 with kA 0.3, kD 1 and kE 1 from straight above, its lights of 100 levels at `place`: the levels of
/// the point (`x`, `y`, 2), which is a multiple of half a unit.
fn straight_down([x, y]: [f64; 2], place: [f64; 3], shininess: f64, levels: f64) -> KnownPixel {
    let kinds = [LightKind::Ambient, LightKind::Diffuse, LightKind::Specular];
    let material = Material {
        diffuse: DVec3::ONE,
        specular: DVec3::ONE,
        shininess,
        ..EMERALD
    };
    let scene = scene()
        .cuboid(cuboid([4.0; 3], [0.0; 3]).material(material))
        .lights(kinds.map(|kind| light(kind, 100.0, place)))
        .eye(DVec3::Z * 10.0)
        .height(5.5)
        .size([11, 11]);
    KnownPixel {
        scene,
        config: RenderConfig::phong(Projection::Orthographic, 0.0),
        pixel: [(5.0 + 2.0 * x) as usize, (5.0 - 2.0 * y) as usize],
        levels: [levels; 3],
    }
}
