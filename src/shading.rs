//! How a face's pixels get their levels: the methods, the illumination model, and how squares of pixels are drawn.
//!
//! ```text
//! draw(square):
//!     classify the lights: each is dark, lit or crossing (n.l changes its sign) on the square, and shows a highlight or none
//!     if bounds on the interpolation errors of all lights add up to less than the tolerance:
//!         evaluate the model at nine nodes; draw the biquadratic through them, by the cheapest rows that the rest allows
//!     else if the square is larger than 16 x 16 pixels and its quarters promise more:
//!         draw each quarter
//!     else:
//!         evaluate the model at every pixel, in f32 where its rounding keeps the tolerance, in f64 elsewhere
//! ```
//! [`phong`] classifies and evaluates, [`bound`] bounds, [`interpolation`] chooses rows, [`rows`] fills them, and
//! [`crate::systems::rasterization`] cuts squares.
//!
//! A terminator is a line in which n.l of a light is 0. Snapping moves an edge by up to 1/512 pixel. On a sliver, a face
//! that is not steady, a pixel's centre can then lie more than 1/128 of the face outside it; its place is clamped to the face.
//!
//! Rule: a face is set up in f64 from unsnapped corners; what is done in f32 is done only where its rounding error is
//! bounded below the tolerance, and in f64 elsewhere.

pub mod affine;
pub mod bound;
pub mod display;
pub mod face;
pub mod field;
pub mod gloss;
pub mod gouraud;
pub mod interpolation;
pub mod kernel;
pub mod phong;
pub mod pixels;
pub mod rounding;
pub mod rows;
#[cfg(test)]
mod running;
pub mod specular;
pub mod square;
pub mod unit_vectors;

use fearless_simd::Simd;
use glam::DVec3;
use serde::Serialize;

use self::display::Rows;
use self::face::Face;
use self::field::Places;
use self::gouraud::Gouraud;
use self::interpolation::Interpolant;
use self::kernel::Light;
use self::phong::{FaceLight, Phong, TileLights};
use self::pixels::Pixels;
use self::square::{MIN_SIDE, Square};
use self::unit_vectors::UnitVectors;
use crate::components::{Illumination, Material, PointLight, ShadingMode, View, unit};
use crate::simd::outlined;

/// A way to draw: what the picture means, and how far it may err from that.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Method {
    /// What reports call it.
    pub id: &'static str,
    /// The definition the picture is held to.
    pub mode: ShadingMode,
    /// In levels, against the exact evaluation of the same mode.
    pub tolerance: f64,
}

impl Method {
    /// This mode within this tolerance, in levels; one that is not of [`METHODS`] has no id.
    pub fn of(mode: ShadingMode, tolerance: f64) -> Method {
        let mut known = METHODS.iter();
        let known = known.find(|it| (it.mode, it.tolerance) == (mode, tolerance));
        known.copied().unwrap_or(Method {
            id: "",
            mode,
            tolerance,
        })
    }

    /// `view` as this method draws it.
    pub fn view(&self, view: &View) -> View {
        View {
            tolerance: self.tolerance,
            ..view.shaded(self.mode)
        }
    }
}

/// The ladder from cheap to true that reports climb.
pub const METHODS: &[Method] = &[
    Method {
        id: "gouraud-0",
        mode: ShadingMode::Gouraud,
        tolerance: 0.0,
    },
    Method {
        id: "gouraud-0.5",
        mode: ShadingMode::Gouraud,
        tolerance: 0.5,
    },
    Method {
        id: "phong-unit-vectors",
        mode: ShadingMode::UnitVectors,
        tolerance: 0.0,
    },
    Method {
        id: "phong-4",
        mode: ShadingMode::Phong,
        tolerance: 4.0,
    },
    Method {
        id: "phong-2",
        mode: ShadingMode::Phong,
        tolerance: 2.0,
    },
    Method {
        id: "phong-1",
        mode: ShadingMode::Phong,
        tolerance: 1.0,
    },
    Method {
        id: "phong-0.5",
        mode: ShadingMode::Phong,
        tolerance: 0.5,
    },
    Method {
        id: "phong-0.25",
        mode: ShadingMode::Phong,
        tolerance: 0.25,
    },
    Method {
        id: "phong-0",
        mode: ShadingMode::Phong,
        tolerance: 0.0,
    },
];

/// Unit round-off of f32: half the distance from 1 to the next float.
pub(crate) const U: f64 = 5.960_464_477_539_063e-8;

/// What the contract calls exact: tolerance 0 errs at most this much, in levels.
pub const EXACT: f64 = 0.05;

/// How far a pixel may err, in levels: the tolerance, or what is called exact where that is 0.
pub(crate) fn limit(tolerance: f64) -> f64 {
    if tolerance > 0.0 { tolerance } else { EXACT }
}

/// What the model needs to know of an object.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a> {
    /// Its coefficients.
    pub material: &'a Material,
    /// All light that falls on it.
    pub illumination: &'a Illumination,
    /// Its centre, from which offsets are counted, in world units.
    pub centre: DVec3,
}

impl Surface<'_> {
    /// The ambient term, in levels.
    pub fn ambient(&self) -> DVec3 {
        self.material.ambient * self.illumination.ambient
    }

    /// What a point light's diffuse and specular terms are multiplied with, in levels.
    pub fn coefficients(&self, light: &PointLight) -> [DVec3; 2] {
        [
            self.material.diffuse * light.diffuse,
            self.material.specular * light.specular,
        ]
    }

    /// How many powers one evaluation of the model takes at most: the lights with a specular term here.
    pub fn powers(&self) -> usize {
        self.illumination
            .points
            .iter()
            .filter(|light| self.coefficients(light)[1] != DVec3::ZERO)
            .count()
    }

    /// The illumination model (Phong 1975, as the contract writes it) at `offset` from the centre, with unit normal and
    /// unit vector to the eye; in levels, unclamped.
    pub fn levels(&self, offset: DVec3, normal: DVec3, to_eye: DVec3) -> DVec3 {
        self.sum(normal, to_eye, |light| {
            unit(light.position - self.centre - offset)
        })
    }

    /// The same, with the unit vector to each light as it is given.
    fn sum(&self, normal: DVec3, to_eye: DVec3, to_light: impl Fn(&PointLight) -> DVec3) -> DVec3 {
        let mut levels = self.ambient();
        for light in &self.illumination.points {
            let [diffuse, specular] = self.coefficients(light);
            // A light at the very point has no direction: its l is zero, n.l is zero, and it contributes nothing.
            let to_light = to_light(light);
            let cosine = normal.dot(to_light);
            if cosine > 0.0 {
                levels += diffuse * cosine;
                if specular != DVec3::ZERO {
                    let reflected = 2.0 * cosine * normal - to_light;
                    let one_minus_cos = (reflected - to_eye).length_squared() / 2.0;
                    levels +=
                        specular * specular::power_exact(self.material.shininess, one_minus_cos);
                }
            }
        }
        levels
    }
}

/// How a square was drawn, from cheap to dear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TileKind {
    /// One colour, certified.
    Constant,
    /// A colour linear in x and y, certified.
    Linear,
    /// A biquadratic colour, certified.
    Quadratic,
    /// The same, and n.l of one light that is cut off at zero at every pixel.
    Terminator,
    /// The model at every pixel within the tolerance, in f32.
    Exact,
    /// The same with vectors in f64; powers of a shininess from 1 on stay in f32.
    Double,
}

impl TileKind {
    /// All of them, in order.
    pub const ALL: [TileKind; 6] = [
        TileKind::Constant,
        TileKind::Linear,
        TileKind::Quadratic,
        TileKind::Terminator,
        TileKind::Exact,
        TileKind::Double,
    ];

    /// The word panels and reports use.
    pub const fn name(self) -> &'static str {
        match self {
            TileKind::Constant => "constant",
            TileKind::Linear => "linear",
            TileKind::Quadratic => "quadratic",
            TileKind::Terminator => "terminator",
            TileKind::Exact => "exact",
            TileKind::Double => "exact in f64",
        }
    }
}

/// Takes the rows of a square.
pub trait Sink<S: Simd> {
    /// Takes what is covered of them.
    fn draw(&mut self, rows: &mut impl Rows<S>);
}

/// What shades the squares of a face: one of the definitions.
pub enum Shader<'a> {
    Gouraud(Gouraud<'a>),
    Phong(Phong<'a>),
    UnitVectors(UnitVectors<'a>),
}

impl Shader<'_> {
    /// Prepares four squares for being interpolated or evaluated.
    #[inline(always)]
    pub fn prepare<S: Simd>(
        &self,
        simd: S,
        places: &Places<S>,
        effort: Effort,
        scratch: &mut Scratch,
    ) -> Prepared<S> {
        match self {
            Shader::Gouraud(gouraud) if effort != Effort::Pixels => Prepared {
                interpolant: Some(outlined!(simd, gouraud.interpolate(simd, places))),
                promising: 0b1111,
            },
            // Compiled apart, without what bounds and samples: 5 % of the instructions of a crowd of small faces.
            Shader::Phong(phong) if effort == Effort::Pixels => {
                let tile = &mut scratch.tile;
                outlined!(simd, phong.prepare(simd, places, Effort::Pixels, tile))
            }
            Shader::Phong(phong) => {
                outlined!(simd, phong.prepare(simd, places, effort, &mut scratch.tile))
            }
            _ => Prepared {
                interpolant: None,
                promising: 0,
            },
        }
    }

    /// What is worth trying for squares of a side of so many pixels.
    pub fn effort(&self, side: usize) -> Effort {
        let interpolates = match self {
            Shader::Gouraud(gouraud) => gouraud.tolerance > 0.0,
            Shader::Phong(phong) => phong.tolerance > 0.0,
            Shader::UnitVectors(_) => false,
        };
        match side {
            _ if !interpolates => Effort::Pixels,
            MIN_SIDE => Effort::Squares,
            _ => Effort::Quarters,
        }
    }

    /// Evaluates the pixels in the scratch in lanes, if that keeps the tolerance. The square is the one at `index` of those
    /// prepared last.
    pub fn evaluate<S: Simd>(
        &self,
        simd: S,
        square: &Square,
        picture: [f64; 2],
        index: usize,
        scratch: &mut Scratch,
    ) -> Option<Evaluations> {
        match self {
            Shader::Gouraud(gouraud) => gouraud.evaluate(simd, square, picture, scratch),
            Shader::Phong(phong) => phong.evaluate(simd, square, picture, index, scratch),
            Shader::UnitVectors(_) => None,
        }
    }

    /// The definition, in f64, at the pixel `x` right and `y` down of the picture's middle, in levels.
    pub fn define(&self, x: f64, y: f64) -> DVec3 {
        match self {
            Shader::Gouraud(gouraud) => gouraud.define(x, y),
            Shader::Phong(phong) => phong.define(x, y),
            Shader::UnitVectors(vectors) => vectors.define(x, y),
        }
    }

    /// What is drawn.
    pub fn face(&self) -> &Face<'_> {
        match self {
            Shader::Gouraud(gouraud) => gouraud.face,
            Shader::Phong(phong) => phong.face,
            Shader::UnitVectors(vectors) => vectors.face,
        }
    }

    /// How many powers one evaluation takes at most.
    pub fn powers(&self) -> usize {
        match self {
            Shader::Gouraud(_) => 0,
            Shader::Phong(phong) => phong.surface.powers(),
            Shader::UnitVectors(vectors) => vectors.surface.powers(),
        }
    }
}

/// How squares may be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Pixel by pixel.
    Pixels,
    /// As colours too.
    Squares,
    /// Or as four squares each.
    Quarters,
}

/// What is known of four squares before they are drawn.
pub struct Prepared<S: Simd> {
    /// Colours that keep the tolerance where they leave something of it.
    pub interpolant: Option<Interpolant<S>>,
    /// The set of squares, a bit each, whose quarters may have such colours where they themselves have none.
    pub promising: u64,
}

/// What a shader has done to a square.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Evaluations {
    /// How it was drawn.
    pub kind: TileKind,
    /// Evaluations of the illumination model.
    pub model: u64,
    /// Evaluations of the specular power.
    pub specular: u64,
}

/// Room for the lights of one face, for the pixels of one square, and for the lights that are evaluated there.
#[derive(Debug, Default)]
pub struct Scratch {
    pub pixels: Pixels,
    /// The lights that reach the face being drawn, and the unit vectors to all lights at its corners.
    pub lights: Vec<FaceLight>,
    pub to_lights: Vec<[DVec3; 4]>,
    tile: TileLights,
    single: Vec<Light<f32>>,
    double: Vec<Light<f64>>,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One light of each kind, 10 above the origin of a surface that lies in the plane z = 0.
    fn levels(kind: &str, normal: DVec3, to_eye: DVec3) -> DVec3 {
        let material = Material {
            ambient: DVec3::new(0.1, 0.2, 0.3),
            diffuse: DVec3::new(0.5, 0.25, 1.0),
            specular: DVec3::new(1.0, 0.5, 0.25),
            shininess: 2.0,
        };
        let share = |own: &str| {
            if own == kind {
                DVec3::splat(100.0)
            } else {
                DVec3::ZERO
            }
        };
        let points = vec![PointLight {
            position: DVec3::new(5.0, 5.0, 15.0),
            diffuse: share("diffuse"),
            specular: share("specular"),
        }];
        let illumination = Illumination {
            ambient: share("ambient"),
            points,
        };
        Surface {
            material: &material,
            illumination: &illumination,
            centre: DVec3::splat(5.0),
        }
        .levels(DVec3::ZERO, normal, to_eye)
    }

    fn assert_near(found: DVec3, expected: [f64; 3]) {
        assert!(
            (found - DVec3::from_array(expected)).length() < 1e-12,
            "{found} is not {expected:?}"
        );
    }

    #[test]
    fn ambient_light_is_the_same_everywhere() {
        assert_near(levels("ambient", DVec3::Z, DVec3::Z), [10.0, 20.0, 30.0]);
        assert_near(
            levels("ambient", DVec3::NEG_Z, DVec3::X),
            [10.0, 20.0, 30.0],
        );
    }

    #[test]
    fn diffuse_light_goes_with_the_cosine() {
        assert_near(levels("diffuse", DVec3::Z, DVec3::X), [50.0, 25.0, 100.0]);
        // n is 60 degrees off: cos 60 = 1/2.
        assert_near(
            levels("diffuse", DVec3::new(0.75_f64.sqrt(), 0.0, 0.5), DVec3::X),
            [25.0, 12.5, 50.0],
        );
        assert_near(levels("diffuse", DVec3::X, DVec3::X), [0.0; 3]);
        assert_near(levels("diffuse", DVec3::NEG_Z, DVec3::X), [0.0; 3]);
    }

    #[test]
    fn specular_light_goes_with_the_power_of_the_mirror_direction() {
        // l = n = z, so r = z; the eye 45 degrees off sees cos 45 squared = 1/2.
        let slanted = DVec3::new(0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt());
        assert_near(levels("specular", DVec3::Z, DVec3::Z), [100.0, 50.0, 25.0]);
        assert_near(levels("specular", DVec3::Z, slanted), [50.0, 25.0, 12.5]);
        // n at 45 degrees sends r to x: an eye there sees it whole, one at z not at all.
        assert_near(levels("specular", slanted, DVec3::X), [100.0, 50.0, 25.0]);
        assert_near(levels("specular", slanted, DVec3::Z), [0.0; 3]);
    }

    #[test]
    fn the_specular_term_needs_the_light_in_front_of_the_surface() {
        // n = -z turned so that r = 2(n.l)n - l would point at the eye: without the gate it would shine through.
        assert_near(levels("specular", DVec3::NEG_Z, DVec3::Z), [0.0; 3]);
        assert_near(levels("specular", DVec3::X, DVec3::NEG_Z), [0.0; 3]);
    }

    #[test]
    fn the_ladder_has_unique_names_and_ends_with_the_truth() {
        let mut ids: Vec<_> = METHODS.iter().map(|method| method.id).collect();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), METHODS.len());
        assert_eq!(
            METHODS.last().map(|method| (method.mode, method.tolerance)),
            Some((ShadingMode::Phong, 0.0))
        );
    }
}
