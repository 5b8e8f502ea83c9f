//! A bound on the rounding errors of the illumination model in f32.
//!
//! All roundings of every light and of the sum are counted, in units of U. Unit tests compare the counts with a running error
//! analysis, and `proofs/` derives the constants.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4};

use super::U;
use super::moving::MovingVector;

/// The error of n.l, in roundings, from a unit normal and a light vector of any length: `proofs/chord.g`. Of a normal of any
/// length it is 10.05: `proofs/cosine.g`.
pub const COSINE: f64 = 13.0;
/// The error of |r - o|, in roundings: `proofs/chord.g`.
pub const CHORD: f64 = 50.0;

/// The rounding errors of the levels at a pixel or node, in units of U. Rows of polynomials are counted in
/// [`super::interpolation`].
///
/// Let V = x a + (y b + c) with |c| = 1 and |x a| + |y b| <= r. The error of V is at most delta of the table. The error of
/// its direction is at most delta / (1 - |c.a| - |c.b|), because |V| is at least that denominator.
///
/// ```text
///   operation                   count       why
///   a, b, c stored              1 + r       once each, at their sizes
///   x, y                        2 r         1 / half extent, and its product with the distance in pixels; of a node one
///   products                    r           once each
///   sums                        2 + 2 r     once each, at the size of the sum, at most 1 + r
///   delta                       3 + 6 r     the error of V; divided by the least |V| it is the error of V's direction
/// ```
/// The operations that follow:
///
/// ```text
///   n.l                         13          proofs/chord.g: n as a unit vector 4.51, the rest 8.1; proofs/cosine.g: 10.05
///     from directions           delta       of n and of l
///   |r - o|                     50          proofs/chord.g: 2 (n.l) n, l, o and two differences
///     from directions           delta       twice of n, of l and of o
///   1 - s                       4           the square 3, 1 spare
///   s^rho                       6           proofs/power.v; Gloss propagates the errors of |r - o| and 1 - s
///   sum                         2 + terms   coefficient and product of each term, and each sum, at the largest sum
///   display                     3           stored in f32; the display step rounds the next larger float
/// ```
/// The rounding of f64 in the vectors at the middle is not counted. Very far from the cuboid it can exceed the tolerance, for
/// example with a shininess of 1e5 and a tolerance of 1e-4, if the eye is more than 1e7 sizes away.
pub struct Rounding<S: Simd> {
    /// Direction errors of n and o.
    normal: f64x4<S>,
    eye: f64x4<S>,
    /// Errors of the terms so far, the largest sum of their levels, and their number.
    error: f64x4<S>,
    largest: f64x4<S>,
    terms: f64x4<S>,
}

impl<S: Simd> Rounding<S> {
    /// For the normal, the eye, and a sum that starts with `ambient` levels.
    #[inline(always)]
    pub fn new(normal: &MovingVector<S>, eye: &MovingVector<S>, ambient: f64) -> Self {
        let lanes = |number| f64x4::splat(normal.radius.token(), number);
        Rounding {
            normal: normal.direction_rounding(),
            eye: eye.direction_rounding(),
            error: lanes(0.0),
            largest: lanes(ambient),
            terms: lanes(1.0),
        }
    }

    /// The error of n.l.
    #[inline(always)]
    pub fn cosine(&self, light: &MovingVector<S>) -> f64x4<S> {
        self.normal + light.direction_rounding() + COSINE
    }

    /// The error of |r - o|.
    #[inline(always)]
    pub fn chord(&self, light: &MovingVector<S>) -> f64x4<S> {
        self.normal * 2.0 + light.direction_rounding() + self.eye + CHORD
    }

    /// Adds a term: a light of this strength, in levels, times a factor of at most 1 that has this error.
    #[inline(always)]
    pub fn add(&mut self, strength: f64x4<S>, error: f64x4<S>) {
        let zero = f64x4::splat(strength.token(), 0.0);
        let any = strength.simd_gt(zero);
        self.error += any.select(strength * error, zero);
        self.largest += strength;
        self.terms += any.select(zero + 1.0, zero);
    }

    /// A bound on the error of the sum, in levels.
    #[inline(always)]
    pub fn total(&self) -> f64x4<S> {
        (self.error + self.largest * (self.terms + 5.0)) * U
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngSeed, TestRunner};

    use super::super::affine::Affine;
    use super::super::moving::{Extents, MAX_RADIUS};
    use super::super::running::{Rounded, Vector, dot, lengths, unit};
    use super::super::specular::{EXPONENT_ERROR, POWER_ERROR};
    use super::super::{interpolation, moving};
    use super::*;
    use crate::shading::simd::{Baseline, baseline};

    /// A vector of length one at the middle of a square, which moves by that much to the right and down.
    type Moving = [[f64; 3]; 3];

    fn moving() -> impl Strategy<Value = Moving> {
        let vector = || prop::array::uniform3(-1.0..1.0_f64);
        let scaled = |vector: [f64; 3], to: f64| {
            let length = vector.iter().map(|c| c * c).sum::<f64>().sqrt();
            vector.map(|component| component / length * to)
        };
        let radii = [0.0..MAX_RADIUS / 2.0, 0.0..MAX_RADIUS / 2.0];
        ([vector(), vector(), vector()], radii, 0..3).prop_map(
            move |([middle, right, down], [x, y], way)| {
                // A third of them get as long as they may, and a third as short, where errors weigh most.
                let [right, down] = [right, down].map(|v| match way {
                    0 => middle,
                    1 => middle.map(|c| -c),
                    _ => v,
                });
                [scaled(middle, 1.0), scaled(right, x), scaled(down, y)]
            },
        )
    }

    /// The vector at a corner as the kernel forms it.
    fn formed([middle, right, down]: &Moving) -> Vector {
        // The position is a product with the stored inverse of the half extent.
        let end = Rounded::stored(1.0) * Rounded::exact(1.0);
        [0, 1, 2].map(|axis| {
            let [middle, right, down] = [middle, right, down].map(|v| Rounded::stored(v[axis]));
            right * end + (down * end + middle)
        })
    }

    fn moving_vector([centre, dx, dy]: &Moving) -> MovingVector<Baseline> {
        let [centre, dx, dy] = [centre, dx, dy].map(|v| DVec3::from_array(*v));
        let [middle, half] = [0.0, 1.0].map(|number| [f64x4::splat(baseline(), number); 2]);
        let extents = Extents { middle, half };
        MovingVector::new(&Affine { centre, dx, dy }, &extents)
    }

    fn one(lanes: f64x4<Baseline>) -> f64 {
        lanes.as_array()[0]
    }

    /// The same, taken as exact; and the error of its direction.
    fn as_formed(vector: &Moving) -> Vector {
        formed(vector).map(|component| Rounded::exact(component.value))
    }

    fn turned(vector: &Moving) -> f64 {
        one(moving_vector(vector).direction_rounding())
    }

    /// The largest share of a count that an analysis finds.
    fn largest<T: Strategy>(cases: T, share: impl Fn(T::Value) -> f64) -> f64 {
        let config = Config {
            cases: 4000,
            rng_seed: RngSeed::Fixed(1),
            failure_persistence: None,
            ..Config::default()
        };
        let most = std::cell::Cell::new(0.0_f64);
        let run = TestRunner::new(config).run(&cases, |case| {
            most.set(most.get().max(share(case)));
            Ok(())
        });
        run.expect("nothing is asserted");
        most.get()
    }

    fn assert_covers(what: &str, share: f64, least: f64) {
        println!("{what}: {share:.3} of the count");
        assert!(share <= 1.0, "{what}: the count is {share} times too small");
        assert!(share > least, "{what}: the count is loose: {share}");
    }

    #[test]
    fn counts_cover_what_a_running_error_analysis_finds() {
        let direction_share = |vector: &Moving| {
            let [_, error] = lengths(&formed(vector));
            // The count is for the shortest vector there is on the square.
            error / one(moving_vector(vector).shortest) / turned(vector)
        };
        let any = largest(moving(), |vector| direction_share(&vector));
        assert_covers("a direction", any, 0.9);
        let wide = largest(moving(), |vector| {
            let is_wide = one(moving_vector(&vector).radius) > 0.9 * MAX_RADIUS;
            if is_wide {
                direction_share(&vector)
            } else {
                0.0
            }
        });
        assert_covers("a direction that moves far", wide, 0.9);

        // The vectors are taken as they are formed: the errors of their directions turn the result by as much.
        let three = || [moving(), moving(), moving()];
        let count =
            |n: &Moving, o: &Moving| Rounding::new(&moving_vector(n), &moving_vector(o), 0.0);
        let cosine = largest(three(), |[n, l, o]| {
            let turned = [&n, &l].map(turned).iter().sum::<f64>();
            let count = one(count(&n, &o).cosine(&moving_vector(&l))) - turned;
            let [n, l] = [&n, &l].map(as_formed);
            let inverse = Rounded::exact(1.0) / dot(&l, &l).sqrt();
            (dot(&unit(&n), &l) * inverse).error / count
        });
        assert_covers("n.l", cosine, 0.5);
        let cosine = largest(three(), |[n, l, o]| {
            let turned = [&n, &l].map(turned).iter().sum::<f64>();
            let count = one(count(&n, &o).cosine(&moving_vector(&l))) - turned;
            let [n, l] = [&n, &l].map(as_formed);
            let inverse = Rounded::exact(1.0) / (dot(&n, &n) * dot(&l, &l)).sqrt();
            (dot(&n, &l) * inverse).error / count
        });
        assert_covers("n.l of a normal of any length", cosine, 0.5);

        let chord = largest(three(), |[n, l, o]| {
            let turned = [&n, &n, &l, &o].map(turned).iter().sum::<f64>();
            let count = one(count(&n, &o).chord(&moving_vector(&l))) - turned;
            let [n, l, o] = [&n, &l, &o].map(as_formed);
            let [n, o] = [&n, &o].map(unit);
            let inverse = Rounded::exact(1.0) / dot(&l, &l).sqrt();
            let cosine = dot(&n, &l) * inverse;
            let twice = cosine + cosine;
            let difference = [0, 1, 2].map(|axis| n[axis] * twice - l[axis] * inverse - o[axis]);
            lengths(&difference)[1] / count
        });
        assert_covers("|r - o|", chord, 0.5);
    }

    #[test]
    fn no_vector_on_a_square_is_shorter_than_the_shortest() {
        let most = largest(moving(), |vector| {
            let [middle, right, down] = vector.map(DVec3::from_array);
            let corners = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];
            let lengths = corners.map(|[x, y]| (middle + right * x + down * y).length());
            // f64 rounds both.
            (one(moving_vector(&vector).shortest) - 1e-12) / lengths.into_iter().fold(1.0, f64::min)
        });
        assert_covers("the shortest vector", most, 0.9);
    }

    #[test]
    fn a_vector_that_may_vanish_has_no_direction() {
        let vanishing = [[1.0, 0.0, 0.0], [-0.6, 0.0, 0.0], [0.4, 0.0, 0.0]];
        assert_eq!(turned(&vanishing), f64::INFINITY);
    }

    #[test]
    fn the_sum_over_lights_is_counted_whatever_their_number() {
        let terms = prop::collection::vec(0.0..100.0_f64, 1..60);
        let steady = moving_vector(&[[1.0, 0.0, 0.0], [0.0; 3], [0.0; 3]]);
        let share = |(ambient, terms): (f64, Vec<f64>)| {
            // Of lights that do not err themselves.
            let mut count = Rounding::new(&steady, &steady, ambient);
            let mut sum = Rounded::stored(ambient);
            for &levels in &terms {
                count.add(f64x4::splat(baseline(), levels), count.cosine(&steady));
                sum = sum + Rounded::stored(levels) * Rounded::exact(1.0);
            }
            let own = terms.iter().sum::<f64>() * one(count.cosine(&steady)) * U;
            // To f32, and on to the display of the next float.
            (sum.error + 3.0 * sum.value) * U / (one(count.total()) - own)
        };
        let bright = largest((500.0..1000.0, terms.clone()), share);
        assert_covers("a bright ambient light", bright, 0.8);
        let single = share((0.0, vec![1.0]));
        assert_covers("a single light", single, 0.8);
    }

    #[test]
    fn the_constants_are_those_of_the_proofs() {
        let goal = |text: &'static str, arrow| text.split(arrow).nth(1).unwrap_or_default();
        let chord = goal(include_str!("../../proofs/chord.g"), "->");
        assert!(chord.contains(&format!("cosine + unit <= {COSINE}b-24")));
        assert!(chord.contains(&format!("+ unit <= {CHORD}b-24 }}")));
        let cosine = goal(include_str!("../../proofs/cosine.g"), "->");
        assert!(cosine.contains("<= 2573b-32 }"));
        const { assert!(2573.0 / 256.0 < COSINE) };
        let power = goal(include_str!("../../proofs/power.v"), "Goal");
        assert!(power.contains(&format!("<= {POWER_ERROR}/1.")));
        assert!(power.contains(&format!("({}/10 * z", 10.0 * EXPONENT_ERROR)));
        let rows = goal(include_str!("../../proofs/rows.v"), "Goal");
        let thousandths = (1000.0 * interpolation::ROW_ERROR / U).round();
        assert!(rows.contains(&format!("- 1) <= {thousandths}/1000 * u.")));
        let fixed = goal(include_str!("../../proofs/fixed.g"), "->");
        assert!(fixed.contains(&format!(
            "(M + v + w + t)| <= {}b-9",
            512.0 * interpolation::FIXED_ERROR
        )));
        let cross = goal(include_str!("../../proofs/cross.g"), "->");
        assert!(cross.contains("<= 34b-53 }"));
        assert!((6e-8..moving::CROSS_ERROR).contains(&(34.0 / (1_u64 << 53) as f64).sqrt()));
    }
}
