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

use glam::DVec3;

use crate::shading::affine::Affine;
use crate::shading::number::Number;
use crate::shading::series::{Cubic, Quadratic};
use crate::shading::triangle::Triangle;

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
    fn measure<N: Number>(&self, place: [N; 2], half: [N; 2]) -> Measure<N> {
        let product = self.product.spread(place[0]);
        let inverse = product.at(place).sqrt().inverse();
        let [centre, dx, dy] = self.sizes;
        Measure {
            inverse,
            swing: product.quadratic_reach(half).sqrt() * inverse,
            stretch: inverse
                * ((place[0].abs() + half[0]) * dx + (place[1].abs() + half[1]) * dy + centre),
        }
    }

    /// The square over that at the middle.
    #[inline(always)]
    fn at<N: Number>(&self, place: [N; 2], inverse: N) -> Quadratic<N> {
        self.product
            .spread(inverse)
            .moved(place)
            .scaled(inverse * inverse)
    }
}

/// What is to be known of a vector on a tile.
#[derive(Clone, Copy, Debug)]
struct Measure<N> {
    /// One over its length at the middle.
    inverse: N,
    /// How far it moves, over that length.
    swing: N,
    stretch: N,
}

impl<N: Number> Measure<N> {
    #[inline(always)]
    fn one(&self, index: usize) -> Measure<f64> {
        Measure {
            inverse: self.inverse.one(index),
            swing: self.swing.one(index),
            stretch: self.stretch.one(index),
        }
    }
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
    /// Over the whole of a triangle, for a light whose place is given from the cuboid's centre.
    #[inline(always)]
    pub fn of(triangle: &Triangle, light: DVec3) -> Self {
        Own::new(&triangle.normal, &triangle.towards(light), &triangle.to_eye)
    }

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
pub struct Vectors<'a, N = f64> {
    products: &'a Shared,
    place: [N; 2],
    half: [N; 2],
    normal: Measure<N>,
    eye: Measure<N>,
    /// N.N
    pub normal_square: Quadratic<N>,
}

impl<'a, N: Number> Vectors<'a, N> {
    /// For the tile whose middle lies `place` right and down of where the products are anchored, and that reaches `half`
    /// from there.
    #[inline(always)]
    pub fn new(products: &'a Shared, place: [N; 2], half: [N; 2]) -> Self {
        let normal = products.normal.measure(place, half);
        Vectors {
            products,
            place,
            half,
            normal,
            eye: products.eye.measure(place, half),
            normal_square: products.normal.at(place, normal.inverse),
        }
    }

    /// That of one of the tiles.
    #[inline(always)]
    pub fn one(&self, index: usize) -> Vectors<'a> {
        Vectors {
            products: self.products,
            place: one(&self.place, index),
            half: one(&self.half, index),
            normal: self.normal.one(index),
            eye: self.eye.one(index),
            normal_square: self.normal_square.one(index),
        }
    }

    /// Whether the products have lost too few digits to matter.
    #[inline(always)]
    pub fn are_sure(&self) -> N::Truth {
        is_sure(doubt([self.normal, self.eye]))
    }

    /// Where the tile's middle lies, in pixels right and down of where the products are anchored.
    #[inline(always)]
    pub fn place(&self) -> [N; 2] {
        self.place
    }

    /// How far the tile reaches from its middle, in pixels right and down.
    #[inline(always)]
    pub fn half(&self) -> [N; 2] {
        self.half
    }

    /// How far the normal turns on the tile; see [`crate::shading::certificate`].
    #[inline(always)]
    pub fn swing_normal(&self) -> N {
        self.normal.swing
    }

    /// The same of the vector to the eye.
    #[inline(always)]
    pub fn swing_eye(&self) -> N {
        self.eye.swing
    }

    /// N.O and O.O
    #[inline(always)]
    pub fn to_eye(&self) -> [Quadratic<N>; 2] {
        let scale = self.normal.inverse * self.eye.inverse;
        let normal_eye = self.products.normal_eye.spread(scale);
        [
            normal_eye.moved(self.place).scaled(scale),
            self.products.eye.at(self.place, self.eye.inverse),
        ]
    }

    /// 2 N.O / N.N and (O.O)^(-1/2) to third order.
    #[inline(always)]
    pub fn mirror(&self) -> [Cubic<N>; 2] {
        let [normal_eye, eye_square] = self.to_eye();
        let normal_square = Cubic::from(self.normal_square);
        let along = Cubic::from(normal_eye).times(&normal_square.inverse());
        let two = self.normal.inverse.like(2.0);
        [along.scaled(two), Cubic::from(eye_square).inverse_root()]
    }
}

/// What one light adds to them.
#[derive(Clone, Copy, Debug)]
pub struct ToLight<'a, N = f64> {
    products: &'a Own,
    place: [N; 2],
    light: Measure<N>,
    /// N.L: the sign of n.l.
    pub facing: Quadratic<N>,
    /// L.L
    pub light_square: Quadratic<N>,
    /// What any of the products may err by.
    pub doubt: N,
}

impl<'a, N: Number> ToLight<'a, N> {
    /// As [`Vectors::new`].
    #[inline(always)]
    pub fn new(products: &'a Own, place: [N; 2], vectors: &Vectors<N>) -> Self {
        let light = products.light.measure(place, vectors.half);
        let scale = vectors.normal.inverse * light.inverse;
        ToLight {
            products,
            place,
            light,
            facing: products.facing.spread(scale).moved(place).scaled(scale),
            light_square: products.light.at(place, light.inverse),
            doubt: doubt([vectors.normal, vectors.eye, light]),
        }
    }

    /// That of one of the tiles.
    #[inline(always)]
    pub fn one(&self, index: usize) -> ToLight<'a> {
        ToLight {
            products: self.products,
            place: one(&self.place, index),
            light: self.light.one(index),
            facing: self.facing.one(index),
            light_square: self.light_square.one(index),
            doubt: self.doubt.one(index),
        }
    }

    /// Whether the products have lost too few digits to matter.
    #[inline(always)]
    pub fn is_sure(&self) -> N::Truth {
        is_sure(self.doubt)
    }

    /// How far the vector turns on the tile.
    #[inline(always)]
    pub fn swing(&self) -> N {
        self.light.swing
    }

    /// L.O
    #[inline(always)]
    pub fn light_eye(&self, vectors: &Vectors<N>) -> Quadratic<N> {
        let scale = self.light.inverse * vectors.eye.inverse;
        let light_eye = self.products.light_eye.spread(scale);
        light_eye.moved(self.place).scaled(scale)
    }

    /// 1 - o.r at the middle.
    #[inline(always)]
    pub fn lambda(&self, vectors: &Vectors<N>) -> N {
        let normal_eye = vectors.products.normal_eye.spread(vectors.normal.inverse);
        let normal_eye = normal_eye.at(vectors.place) * vectors.normal.inverse;
        let light_eye = self.products.light_eye.spread(self.light.inverse);
        let light_eye = light_eye.at(self.place) * self.light.inverse;
        let facing = self.facing.0[0];
        -((facing + facing) * normal_eye - light_eye) * vectors.eye.inverse + 1.0
    }
}

/// That of one of the tiles.
#[inline(always)]
fn one<N: Number>([x, y]: &[N; 2], index: usize) -> [f64; 2] {
    [x.one(index), y.one(index)]
}

/// What the products of these vectors may err by, for vectors of length one; NaN where one of them has none.
#[inline(always)]
fn doubt<N: Number, const COUNT: usize>(vectors: [Measure<N>; COUNT]) -> N {
    let mut stretch = vectors[0].stretch.like(0.0);
    for vector in vectors {
        stretch = stretch + vector.stretch * vector.stretch;
    }
    stretch * ROUNDINGS
}

/// Whether that is too little to matter.
#[inline(always)]
fn is_sure<N: Number>(doubt: N) -> N::Truth {
    doubt.below(doubt.like(SURE))
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
        assert!(sure > 1900 && worst > 1e-3, "{sure} sure, worst {worst}");
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
