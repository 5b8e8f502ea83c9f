//! Where lights are: on the surface, in it, in its planes, at infinity.
//!
//! Known levels are of the pixel whose centre looks straight down, in an orthographic picture whose pixels are half a unit
//! apart, on a cube from -2 to 2: at (x, y, 2) the normal is (x, y, 2) at length one.

use glam::DVec3;

use super::setting::{Body, Lamp, MATERIAL, Setting, Way, lights_at};
use super::{Case, Known, Rule};
use crate::components::{LightKind, Material, Projection, ShadingMode};

/// The cases.
pub const CASES: &[Case] = &[
    Case {
        name: "light on a face, and an ulp to either side",
        rule: Rule::Proven(|| {
            close_to(&[
                [0.3, 0.4, 1.0],
                [0.3, 0.4, 1.0_f64.next_up()],
                [0.3, 0.4, 1.0_f64.next_down()],
                [2.0, 0.1, 0.3],
            ])
        }),
    },
    Case {
        name: "light 1e-3, 1e-6 and 1e-9 above a face",
        rule: Rule::Proven(|| close_to(&[1e-3, 1e-6, 1e-9].map(|gap| [0.3, 0.4, 1.0 + gap]))),
    },
    Case {
        name: "light on an edge",
        rule: Rule::Proven(|| close_to(&[[2.0, 1.5, 0.3], [0.1, 1.5, 1.0]])),
    },
    Case {
        name: "light on a vertex",
        rule: Rule::Proven(|| close_to(&[[2.0, 1.5, 1.0], [-2.0, 1.5, 1.0]])),
    },
    Case {
        name: "light inside the cuboid",
        rule: Rule::Proven(|| close_to(&[[0.0, 0.0, 0.0], [0.3, 0.4, 0.2], [1.9, 1.4, 0.9]])),
    },
    Case {
        name: "light in the plane of a face, and an ulp to either side",
        rule: Rule::Proven(|| {
            lit_from(&[
                [6.0, 1.2, 1.0],
                [6.0, 1.2, 1.0_f64.next_up()],
                [6.0, 1.2, 1.0_f64.next_down()],
                [30.0, 1.5, 20.0],
                [2.0, 9.0, 7.0],
            ])
        }),
    },
    Case {
        name: "light at the very point seen adds nothing",
        rule: Rule::Known(|| vec![straight_down([1.0, 0.5], [1.0, 0.5, 2.0], 0.0, 30.0)]),
    },
    Case {
        name: "light an ulp, and 1e-6, above the point seen",
        // l = o = (0, 0, 1) and n = (2, 1, 4) / sqrt 21, so o.r = 2 n_z^2 - 1 = 11 / 21.
        rule: Rule::Known(|| {
            let levels = 30.0 + 100.0 * (4.0 / 21.0_f64.sqrt() + 121.0 / 441.0);
            [2.0_f64.next_up(), 2.0 + 1e-6]
                .map(|z| straight_down([1.0, 0.5], [1.0, 0.5, z], 2.0, levels))
                .into()
        }),
    },
    Case {
        name: "light an ulp, and 1e-6, below the point seen adds nothing",
        rule: Rule::Known(|| {
            [2.0_f64.next_down(), 2.0 - 1e-6]
                .map(|z| straight_down([1.0, 0.5], [1.0, 0.5, z], 0.0, 30.0))
                .into()
        }),
    },
    Case {
        name: "n.l = 0 exactly: neither term, not even with 0^0",
        rule: Rule::Known(|| vec![straight_down([0.0, 0.0], [7.0, 3.0, 2.0], 0.0, 30.0)]),
    },
    Case {
        name: "n.l = +-1e-5: the highlight's gate is open, and shut",
        // A light 1e-4 above the plane and 10 away; rho = 0 makes the highlight whole where the gate is open.
        rule: Rule::Known(|| {
            vec![
                straight_down([0.0, 0.0], [10.0, 0.0, 2.0 + 1e-4], 0.0, 130.001),
                straight_down([0.0, 0.0], [10.0, 0.0, 2.0 - 1e-4], 0.0, 30.0),
            ]
        }),
    },
    Case {
        name: "o.r negative: no highlight unless 0^0",
        // At (0.5, 0, 2) n = (1, 0, 4) / sqrt 17. A light low behind it, l = (-1, 0, 0.3) / sqrt 1.09, has n.l = 0.2 / sqrt
        // 18.53 and is mirrored downwards: r_z = 2 n.l n_z - l_z = -0.2.
        rule: Rule::Known(|| {
            let lit = 30.0 + 100.0 * 0.2 / 18.53_f64.sqrt();
            vec![
                straight_down([0.5, 0.0], [-4.5, 0.0, 3.5], 1.0, lit),
                straight_down([0.5, 0.0], [-4.5, 0.0, 3.5], 0.0, lit + 100.0),
            ]
        }),
    },
    Case {
        name: "light and eye above the point seen: the whole highlight",
        rule: Rule::Known(|| {
            [0.0, 1.0, 76.8, 1000.0, 1e6]
                .map(|shininess| straight_down([0.0, 0.0], [0.0, 0.0, 9.0], shininess, 230.0))
                .into()
        }),
    },
    Case {
        name: "light 1e9 and 1e100 units away",
        rule: Rule::Proven(|| {
            lit_from(&[[1e9, 2e9, 1e9], [1e100, 1e100, 1e100], [-1e100, 1.0, 1e100]])
        }),
    },
    Case {
        name: "light 1e100 away against the same direction from 1e12",
        rule: Rule::SamePicture(1.0, || lit_from(&[[1e12, 2e12, 3e12], [1e99, 2e99, 3e99]])),
    },
];

/// The default cuboid with its lights at each of these places, from near by.
fn close_to(places: &[[f64; 3]]) -> Vec<Setting> {
    let close = |setting: Setting| {
        setting.and(|setting| {
            setting.target = setting.lights[0].position;
            setting.eye = setting.target + DVec3::new(1.0, 0.9, 2.0);
            setting.height = 1.5;
        })
    };
    lit_from(places).into_iter().map(close).collect()
}

/// The default setting, its lights at each of these places.
fn lit_from(places: &[[f64; 3]]) -> Vec<Setting> {
    let lit =
        |place: &[f64; 3]| Setting::with(|setting| setting.lights = lights_at(DVec3::from(*place)));
    places.iter().map(lit).collect()
}

/// A cube from -2 to 2 with kA 0.3, kD 1 and kE 1 from straight above, its lights of 100 levels at `light`: what is known
/// of the point (`x`, `y`, 2), which is a multiple of half a unit.
fn straight_down([x, y]: [f64; 2], light: [f64; 3], shininess: f64, levels: f64) -> Known {
    let kinds = [LightKind::Ambient, LightKind::Diffuse, LightKind::Specular];
    let setting = Setting::with(|setting| {
        setting.cuboids = vec![Body {
            size: DVec3::splat(4.0),
            material: Material {
                diffuse: DVec3::ONE,
                specular: DVec3::ONE,
                shininess,
                ..MATERIAL
            },
            ..Body::default()
        }];
        setting.lights = kinds
            .map(|kind| Lamp::new(kind, 100.0, light.into()))
            .into();
        setting.eye = DVec3::Z * 10.0;
        setting.height = 5.5;
        setting.size = [11, 11];
    });
    Known {
        setting,
        way: Way {
            projection: Projection::Orthographic,
            mode: ShadingMode::Phong,
            tolerance: 0.0,
        },
        pixel: [(5.0 + 2.0 * x) as usize, (5.0 - 2.0 * y) as usize],
        levels: [levels; 3],
    }
}
