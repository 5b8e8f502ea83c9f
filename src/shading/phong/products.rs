//! Vectors that are affine over a triangle in; their dot products, as quadratics of the pixel, out.
//!
//! ```text
//!   N, L, O  affine over the triangle  -->  N.N  L.L  O.O  N.L  N.O  L.O  quadratic over the triangle, without loss
//! ```
//! Moving a quadratic to a tile takes a third of the steps of making it there, so they are made once a triangle. What is
//! lost is digits: with S = |V_0| + |V_x| |x| + |V_y| |y| a product V.W of a tile at x, y, its slopes included, errs by
//! less than 32 roundings of S_V S_W, and `stretch` is S over |V| at the tile's middle.
//!
//! Rule: where that is too much, as where a vector all but vanishes, a tile makes products of its own.

use std::cell::OnceCell;

use crate::shading::affine::Affine;
use crate::shading::series::{Cubic, Quadratic};

/// 32 roundings.
const ROUNDINGS: f64 = 32.0 * f64::EPSILON / 2.0;

/// What products may err by, for vectors of length one: far less than f32 makes of them.
const SURE: f64 = 1e-10;

/// A vector's product with itself.
#[derive(Clone, Copy, Debug)]
struct Square {
    product: Quadratic,
    /// Bounds on |V_0|, |V_x| and |V_y|: the sums of their components.
    sizes: [f64; 3],
}

impl Square {
    #[inline(always)]
    fn new(vector: &Affine) -> Self {
        Square {
            product: Quadratic::dot(vector, vector),
            sizes: [vector.centre, vector.dx, vector.dy].map(|v| v.abs().element_sum()),
        }
    }

    #[inline(always)]
    fn measure(&self, place: [f64; 2], half: [f64; 2]) -> Measure {
        let inverse = 1.0 / self.product.at(place).sqrt();
        let [centre, dx, dy] = self.sizes;
        Measure {
            inverse,
            swing: self.product.quadratic_reach(half).sqrt() * inverse,
            stretch: inverse
                * (centre + dx * (place[0].abs() + half[0]) + dy * (place[1].abs() + half[1])),
        }
    }

    /// The square over that at the middle.
    #[inline(always)]
    fn at(&self, place: [f64; 2], inverse: f64) -> Quadratic {
        self.product.moved(place).scaled(inverse * inverse)
    }
}

/// What is to be known of a vector on a tile.
#[derive(Clone, Copy, Debug)]
struct Measure {
    /// One over its length at the middle.
    inverse: f64,
    /// How far it moves, over that length.
    swing: f64,
    stretch: f64,
}

/// The products that all lights share.
#[derive(Clone, Copy, Debug)]
pub struct Shared {
    normal: Square,
    eye: Square,
    normal_eye: Quadratic,
}

impl Shared {
    /// Of the normal and the vector to the eye.
    #[inline(always)]
    pub fn new(normal: &Affine, to_eye: &Affine) -> Self {
        Shared {
            normal: Square::new(normal),
            eye: Square::new(to_eye),
            normal_eye: Quadratic::dot(normal, to_eye),
        }
    }
}

/// The products of one light.
#[derive(Clone, Copy, Debug)]
pub struct Own {
    light: Square,
    facing: Quadratic,
    light_eye: Quadratic,
}

impl Own {
    /// Of the normal and the vectors to the light and the eye.
    #[inline(always)]
    pub fn new(normal: &Affine, to_light: &Affine, to_eye: &Affine) -> Self {
        Own {
            light: Square::new(to_light),
            facing: Quadratic::dot(normal, to_light),
            light_eye: Quadratic::dot(to_light, to_eye),
        }
    }
}

/// What all lights share on a tile. All products are those of vectors of length one at its middle.
#[derive(Debug)]
pub struct Vectors<'a> {
    products: &'a Shared,
    place: [f64; 2],
    half: [f64; 2],
    normal: Measure,
    eye: Measure,
    /// N.N
    pub normal_square: Quadratic,
    shared: OnceCell<[Quadratic; 2]>,
    mirror: OnceCell<[Cubic; 2]>,
}

impl<'a> Vectors<'a> {
    /// For the tile whose middle lies `place` right and down of where the products are anchored, and that reaches `half`
    /// from there.
    #[inline(always)]
    pub fn new(products: &'a Shared, place: [f64; 2], half: [f64; 2]) -> Self {
        let normal = products.normal.measure(place, half);
        Vectors {
            products,
            place,
            half,
            normal,
            eye: products.eye.measure(place, half),
            normal_square: products.normal.at(place, normal.inverse),
            shared: OnceCell::new(),
            mirror: OnceCell::new(),
        }
    }

    /// Whether the products have lost too few digits to matter.
    #[inline(always)]
    pub fn are_sure(&self) -> bool {
        doubt([self.normal, self.eye]) <= SURE
    }

    /// How far the normal turns on the tile; see [`crate::shading::certificate`].
    #[inline(always)]
    pub fn swing_normal(&self) -> f64 {
        self.normal.swing
    }

    /// The same of the vector to the eye.
    #[inline(always)]
    pub fn swing_eye(&self) -> f64 {
        self.eye.swing
    }

    /// N.O and O.O, worked out when the first light asks for them.
    #[inline(always)]
    pub fn to_eye(&self) -> &[Quadratic; 2] {
        self.shared.get_or_init(|| {
            let scale = self.normal.inverse * self.eye.inverse;
            [
                self.products.normal_eye.moved(self.place).scaled(scale),
                self.products.eye.at(self.place, self.eye.inverse),
            ]
        })
    }

    /// 2 N.O / N.N and (O.O)^(-1/2) to third order, worked out when the first light asks for them.
    #[inline(always)]
    pub fn mirror(&self) -> &[Cubic; 2] {
        self.mirror.get_or_init(|| {
            let [normal_eye, eye_square] = self.to_eye().map(Cubic::from);
            let normal_square = Cubic::from(self.normal_square);
            [
                normal_eye.times(&normal_square.inverse()).scaled(2.0),
                eye_square.inverse_root(),
            ]
        })
    }
}

/// What one light adds to them.
#[derive(Clone, Copy, Debug)]
pub struct ToLight<'a> {
    products: &'a Own,
    place: [f64; 2],
    light: Measure,
    /// N.L: the sign of n.l.
    pub facing: Quadratic,
    /// L.L
    pub light_square: Quadratic,
    /// What any of the products may err by.
    pub doubt: f64,
}

impl<'a> ToLight<'a> {
    /// As [`Vectors::new`].
    #[inline(always)]
    pub fn new(products: &'a Own, place: [f64; 2], vectors: &Vectors) -> Self {
        let light = products.light.measure(place, vectors.half);
        let scale = vectors.normal.inverse * light.inverse;
        ToLight {
            products,
            place,
            light,
            facing: products.facing.moved(place).scaled(scale),
            light_square: products.light.at(place, light.inverse),
            doubt: doubt([vectors.normal, vectors.eye, light]),
        }
    }

    /// Whether the products have lost too few digits to matter.
    #[inline(always)]
    pub fn is_sure(&self) -> bool {
        self.doubt <= SURE
    }

    /// How far the vector turns on the tile.
    #[inline(always)]
    pub fn swing(&self) -> f64 {
        self.light.swing
    }

    /// L.O
    #[inline(always)]
    pub fn light_eye(&self, vectors: &Vectors) -> Quadratic {
        let scale = self.light.inverse * vectors.eye.inverse;
        self.products.light_eye.moved(self.place).scaled(scale)
    }

    /// 1 - o.r at the middle.
    #[inline(always)]
    pub fn lambda(&self, vectors: &Vectors) -> f64 {
        let normal_eye = vectors.products.normal_eye.at(vectors.place) * vectors.normal.inverse;
        let light_eye = self.products.light_eye.at(self.place) * self.light.inverse;
        1.0 - (2.0 * self.facing.0[0] * normal_eye - light_eye) * vectors.eye.inverse
    }
}

/// What the products of these vectors may err by, for vectors of length one; NaN where one of them has none.
#[inline(always)]
fn doubt<const COUNT: usize>(vectors: [Measure; COUNT]) -> f64 {
    let mut stretch = 0.0;
    for vector in vectors {
        stretch += vector.stretch * vector.stretch;
    }
    ROUNDINGS * stretch
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// A vector of about this length, from a row of numbers that looks random.
    fn vector(seed: &mut u64, length: f64) -> DVec3 {
        let mut number = || {
            *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0) * length
        };
        DVec3::new(number(), number(), number())
    }

    fn affine(seed: &mut u64) -> Affine {
        Affine {
            centre: vector(seed, 1.0),
            dx: vector(seed, 3e-3),
            dy: vector(seed, 3e-3),
        }
    }

    #[test]
    fn products_moved_to_a_tile_are_those_made_there_within_the_doubt() {
        const HALF: [f64; 2] = [7.5, 7.5];
        let seed = &mut 5;
        let (mut sure, mut worst) = (0, 0.0_f64);
        for _ in 0..2000 {
            let [n, l, o] = [affine(seed), affine(seed), affine(seed)];
            let place = (vector(seed, 900.0)).truncate().to_array();
            let here = [&n, &l, &o].map(|vector| Affine {
                centre: vector.at(place[0], place[1]),
                ..*vector
            });
            let (shared, own) = (Shared::new(&n, &o), Own::new(&n, &l, &o));
            let vectors = Vectors::new(&shared, place, HALF);
            let light = ToLight::new(&own, place, &vectors);
            sure += usize::from(light.is_sure());
            let (shared, own) = (
                Shared::new(&here[0], &here[2]),
                Own::new(&here[0], &here[1], &here[2]),
            );
            let made = Vectors::new(&shared, [0.0; 2], HALF);
            let made_light = ToLight::new(&own, [0.0; 2], &made);
            assert!(made.are_sure(), "made where it is used, nothing is lost");
            let pairs = [
                (vectors.normal_square, made.normal_square),
                (vectors.to_eye()[0], made.to_eye()[0]),
                (vectors.to_eye()[1], made.to_eye()[1]),
                (light.facing, made_light.facing),
                (light.light_square, made_light.light_square),
                (light.light_eye(&vectors), made_light.light_eye(&made)),
            ];
            for (moved, made) in pairs {
                let mut error = moved;
                error.add(&made, -1.0);
                let error =
                    error.0[0].abs() + error.linear_reach(HALF) + error.quadratic_reach(HALF);
                assert!(error <= light.doubt, "{error} of {}", light.doubt);
                worst = worst.max(error / light.doubt);
            }
            let lambda = (light.lambda(&vectors) - made_light.lambda(&made)).abs();
            assert!(lambda <= 8.0 * light.doubt, "{lambda}");
            assert!((vectors.swing_normal() / made.swing_normal() - 1.0).abs() < 1e-9);
        }
        assert!(sure > 1900 && worst > 1e-4, "{sure} sure, worst {worst}");
    }

    #[test]
    fn a_vector_that_all_but_vanishes_is_not_sure() {
        let still = |v| Affine {
            centre: v,
            ..Affine::default()
        };
        // Zero at x = 1.
        let gone = Affine {
            dx: DVec3::NEG_X,
            ..still(DVec3::X)
        };
        let up = still(DVec3::Z);
        let sure = |place| {
            let shared = Shared::new(&gone, &up);
            Vectors::new(&shared, [place, 0.0], [0.5, 0.5]).are_sure()
        };
        assert!(sure(0.0) && sure(0.9) && !sure(1.0 + 1e-5) && !sure(1.0));
        let shared = Shared::new(&up, &up);
        let vectors = Vectors::new(&shared, [0.0; 2], [0.5, 0.5]);
        let own = Own::new(&up, &gone, &up);
        assert!(ToLight::new(&own, [0.9, 0.0], &vectors).is_sure());
        assert!(!ToLight::new(&own, [1.0, 0.0], &vectors).is_sure());
    }
}
