//! What is evaluated at a pixel: the methods, the illumination model, and the seam between tiles and shaders.
//!
//! ```text
//!  triangle + tile --Patch--> weights, normal, position as affine functions of the pixel --Shader--> levels, tile row by row
//! ```
//! Rule: a [`patch::Patch`] is set up in f64 from unsnapped vertices and anchored at the middle of what the tile covers; what a
//! shader does in f32 it may do only where its rounding error is bounded below the tolerance, and in f64 elsewhere.

pub mod affine;
pub mod certificate;
pub mod display;
mod doubles;
pub mod gouraud;
pub mod number;
pub mod patch;
pub mod phong;
pub mod polynomial;
pub mod rows;
pub mod series;
pub mod specular;
pub mod tile;
pub mod triangle;
pub mod unit_vectors;

use glam::DVec3;

use self::display::Row;
use self::number::ABREAST;
use self::patch::Squares;
pub use self::rows::Sink;
pub use self::tile::{BLOCK, Coverage, TILE, TileKind, TileRow};
use self::triangle::Triangle;
use crate::components::{Illumination, Material, PointLight, ShadingMode, unit};

/// A way to draw: what the picture means, and how far it may stray from that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Method {
    /// What reports call it.
    pub id: &'static str,
    /// The definition the picture is held to.
    pub mode: ShadingMode,
    /// In levels, against the exact evaluation of the same mode.
    pub tolerance: f64,
    /// One line for a person.
    pub help: &'static str,
}

/// The ladder from cheap to true that reports climb.
pub const METHODS: &[Method] = &[
    Method {
        id: "gouraud-0",
        mode: ShadingMode::Gouraud,
        tolerance: 0.0,
        help: "lit at the vertices, exact",
    },
    Method {
        id: "gouraud-0.5",
        mode: ShadingMode::Gouraud,
        tolerance: 0.5,
        help: "lit at the vertices, within half a level",
    },
    Method {
        id: "phong-unit-vectors",
        mode: ShadingMode::UnitVectors,
        tolerance: 0.0,
        help: "the assignment's shortcut: unit n, l, o interpolated, not renormalised",
    },
    Method {
        id: "phong-4",
        mode: ShadingMode::Phong,
        tolerance: 4.0,
        help: "lit at every pixel, within four levels",
    },
    Method {
        id: "phong-2",
        mode: ShadingMode::Phong,
        tolerance: 2.0,
        help: "lit at every pixel, within two levels",
    },
    Method {
        id: "phong-1",
        mode: ShadingMode::Phong,
        tolerance: 1.0,
        help: "lit at every pixel, within one level",
    },
    Method {
        id: "phong-0.5",
        mode: ShadingMode::Phong,
        tolerance: 0.5,
        help: "lit at every pixel, within half a level",
    },
    Method {
        id: "phong-0.25",
        mode: ShadingMode::Phong,
        tolerance: 0.25,
        help: "lit at every pixel, within a quarter of a level",
    },
    Method {
        id: "phong-0",
        mode: ShadingMode::Phong,
        tolerance: 0.0,
        help: "lit at every pixel, exact",
    },
];

/// Unit round-off of f32: half the distance from 1 to the next float.
pub(crate) const U: f64 = 5.960_464_477_539_063e-8;

/// What the contract calls exact: tolerance 0 errs at most this much, in levels.
pub const EXACT: f64 = 0.05;

/// The least tolerance but 0, in levels: levels are f32, which near 255 are 1.5e-5 apart.
pub const MIN_TOLERANCE: f64 = 1e-4;

/// How far a pixel may stray, in levels: the tolerance, or what is called exact where that is 0.
#[inline(always)]
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

    /// What the sum of all terms errs by in f32, over the sum of their sizes: an addition for each, and four roundings
    /// of a term.
    pub fn rounding(&self) -> f64 {
        let lights = self.illumination.points.iter();
        let terms = lights.flat_map(|light| self.coefficients(light));
        U * (4 + terms.filter(|levels| *levels != DVec3::ZERO).count()) as f64
    }

    /// The illumination model (Phong 1975, as the contract writes it) at `offset` from the centre, with unit normal and
    /// unit vector to the eye; in levels, unclamped.
    pub fn levels(&self, offset: DVec3, normal: DVec3, to_eye: DVec3) -> DVec3 {
        let mut levels = self.ambient();
        for light in &self.illumination.points {
            let [diffuse, specular] = self.coefficients(light);
            // A light at the very point has no direction: its l is zero, n.l is zero, and it contributes nothing.
            let to_light = unit(light.position - self.centre - offset);
            let cosine = normal.dot(to_light);
            if cosine > 0.0 {
                levels += diffuse * cosine;
                if specular != DVec3::ZERO {
                    let reflected = 2.0 * cosine * normal - to_light;
                    let lambda = (reflected - to_eye).length_squared() / 2.0;
                    levels += specular * specular::power_exact(self.material.shininess, lambda);
                }
            }
        }
        levels
    }
}

/// Draws the tiles of triangles.
pub trait Shader {
    /// Finds for each block that is wanted the cheapest polynomial that keeps the tolerance with all of its light. None
    /// stands there yet, and none is left where there is none or every pixel is to be exact.
    fn certify_blocks(&self, triangle: &Triangle, blocks: &mut Squares<BLOCK>);

    /// The same for tiles, but a polynomial may leave out light whose levels are then in the scratch, pixel by pixel; its
    /// kind says so ([`Polynomial::is_whole`](polynomial::Polynomial::is_whole)).
    fn certify_tiles(&self, triangle: &Triangle, tiles: &mut Squares<TILE>, scratch: &mut Scratch);

    /// Shades the covered pixels of one of the tiles that were certified last and that have no whole polynomial.
    fn shade(
        &self,
        triangle: &Triangle,
        tiles: &Squares<TILE>,
        index: usize,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) -> Evaluations;
}

/// What a shader has done to a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Evaluations {
    /// How the tile was drawn.
    pub kind: TileKind,
    /// Evaluations of the illumination model.
    pub model: u64,
    /// Evaluations of the specular power.
    pub specular: u64,
}

impl Evaluations {
    /// A tile of a kind, nothing counted yet.
    #[inline(always)]
    pub fn of(kind: TileKind) -> Self {
        Evaluations {
            kind,
            model: 0,
            specular: 0,
        }
    }

    /// The same, with the whole model evaluated at every covered pixel.
    #[inline(always)]
    #[must_use]
    fn of_every_pixel(self, coverage: &Coverage, surface: &Surface) -> Self {
        let pixels = u64::from(coverage.pixels);
        Evaluations {
            model: pixels,
            specular: pixels * surface.powers() as u64,
            ..self
        }
    }
}

/// Room for tiles' intermediate values, kept so that no tile has to clear it.
pub struct Scratch {
    /// Unit normals and unit vectors to the eye, by component, row and lane.
    pub(crate) vectors: [[[f32; TILE]; TILE]; 6],
    /// Levels so far, by tile and row.
    pub(crate) levels: [[TileRow; TILE]; ABREAST],
    /// How many highlights are in those of the tiles that were certified last, where their polynomial is not whole.
    pub(crate) highlights: [u64; ABREAST],
}

impl Default for Scratch {
    fn default() -> Self {
        Scratch {
            vectors: [[[0.0; TILE]; TILE]; 6],
            levels: [[[[0.0; TILE]; 3]; TILE]; ABREAST],
            highlights: [0; ABREAST],
        }
    }
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
