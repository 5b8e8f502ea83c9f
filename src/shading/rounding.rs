//! What rounding costs the illumination model: precision and extent of the vectors in, levels out.
//!
//! Rule: every rounding is counted once, per light and per term of the sum.

use super::U;
use super::field::MAX_RADIUS;
use super::specular::Power;

/// The error of n.l, in roundings, from a unit normal and a light vector of any length: `proofs/chord.g`. From two vectors of
/// any length it is less: `proofs/cosine.g`.
pub const COSINE: f64 = 13.0;
/// The error of |r - o|, in roundings: `proofs/chord.g`.
pub const CHORD: f64 = 50.0;

/// What rounding costs the model at one pixel, in levels. Rows of polynomials are counted in [`super::interpolation`].
///
/// A vector of length one at the middle is formed as a x + (b y + c): c, a and b are rounded, then both products and both
/// sums, each by at most u times its size. So its direction errs by
///
/// ```text
///   delta = u (3 + 4 radius) / shortest
/// ```
/// The operations that follow round, in units of u:
///
/// ```text
///   unit vector   4.51   proofs/unit.g
///   n.l           13     proofs/chord.g: n 4.51, the rest 8.1
///   |r - o|       50     proofs/chord.g: 2 (n.l) n, l, o and two differences
///   1 - s         4      square 3, 1 spare
/// ```
/// n.l errs by the delta of n and of l besides, |r - o| by twice that of n and by those of l and o. s^rho errs by what these errors
/// make of it ([`Power::propagated`]) and by the power's own error.
///
/// The vectors at the middle are taken as exact: f64 forms them for the whole square alike, and they err by what the
/// definition's own vectors err by. So the bound is relative to what f64 can set up, and that may err by more than a tolerance:
/// with a shininess of 1e5 and a tolerance of 1e-4, for example, from an eye 1e7 sizes away on.
#[derive(Clone, Copy, Debug)]
pub struct Rounding {
    /// Unit round-off.
    unit: f64,
    /// Direction errors of n and o.
    normal: f64,
    eye: f64,
    /// Levels that err so far, and the terms that were summed.
    error: f64,
    largest: f64,
    terms: f64,
}

impl Rounding {
    /// For numbers of a unit round-off, the normal's and the eye's [`Extent`], and a sum that starts with `ambient` levels.
    pub fn new(unit: f64, [normal, eye]: [Extent; 2], ambient: f64) -> Self {
        Rounding {
            unit,
            normal: direction(unit, normal),
            eye: direction(unit, eye),
            error: 0.0,
            largest: ambient,
            terms: 1.0,
        }
    }

    /// Adds a light's diffuse term of at most so many levels.
    pub fn diffuse(&mut self, light: Extent, levels: f64) {
        self.error += levels * self.cosine(light);
        self.count(levels);
    }

    /// What n.l errs by.
    pub fn cosine(&self, light: Extent) -> f64 {
        self.normal + direction(self.unit, light) + COSINE * self.unit
    }

    /// Adds a light's specular term of at most so many levels.
    pub fn specular(&mut self, light: Extent, levels: f64, power: &Power) {
        let propagated = power.propagated(self.chord(light), self.unit);
        self.error += levels * (propagated + power.error);
        self.count(levels);
    }

    /// What |r - o| errs by.
    fn chord(&self, light: Extent) -> f64 {
        2.0 * self.normal + direction(self.unit, light) + self.eye + CHORD * self.unit
    }

    fn count(&mut self, levels: f64) {
        self.largest += levels;
        self.terms += 1.0;
    }

    /// A bound, in levels: each term's coefficient, product and sum are rounded at the size of the largest sum there can
    /// be; the result once to f32, whose display may be that of the next float.
    pub fn levels(&self) -> f64 {
        self.error + self.largest * (self.unit * (2.0 + self.terms) + 3.0 * U)
    }
}

/// How far a vector of length one at the middle of a square gets from there, and how short it gets.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extent {
    pub radius: f64,
    pub shortest: f64,
}

impl Extent {
    /// That of any vector that nodes are sampled of.
    pub const LARGEST: Self = Extent {
        radius: MAX_RADIUS,
        shortest: 1.0 - MAX_RADIUS,
    };
}

/// Direction error of an interpolated vector.
fn direction(unit: f64, Extent { radius, shortest }: Extent) -> f64 {
    if shortest > 0.0 {
        unit * (3.0 + 4.0 * radius) / shortest
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngSeed, TestRunner};

    use super::super::kernel::DOUBLE;
    use super::super::running::{Rounded, Vector, dot, lengths, unit};
    use super::super::specular::{POWER_ERROR, QUADRATIC};
    use super::super::{bound, field, interpolation};
    use super::*;

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
        [0, 1, 2].map(|axis| {
            let [middle, right, down] = [middle, right, down].map(|v| Rounded::stored(v[axis]));
            right * Rounded::exact(1.0) + (down * Rounded::exact(1.0) + middle)
        })
    }

    fn extent([middle, right, down]: &Moving) -> Extent {
        let along = |v: &[f64; 3]| (0..3).map(|i| middle[i] * v[i]).sum::<f64>().abs();
        let length = |v: &[f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
        Extent {
            radius: length(right) + length(down),
            shortest: 1.0 - along(right) - along(down),
        }
    }

    /// The same, taken as exact; and what its direction errs by.
    fn as_formed(vector: &Moving) -> Vector {
        formed(vector).map(|component| Rounded::exact(component.value))
    }

    fn turned(vector: &Moving) -> f64 {
        direction(1.0, extent(vector))
    }

    /// The largest share of what is said that an analysis finds.
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
            let (count, [_, error]) = (turned(vector), lengths(&formed(vector)));
            // The count is for the shortest vector there is on the square.
            error / extent(vector).shortest / count
        };
        let any = largest(moving(), |vector| direction_share(&vector));
        assert_covers("a direction", any, 0.9);
        let wide = largest(moving(), |vector| {
            let is_wide = extent(&vector).radius > 0.9 * MAX_RADIUS;
            if is_wide {
                direction_share(&vector)
            } else {
                0.0
            }
        });
        assert_covers("a direction that moves far", wide, 0.9);

        // The vectors are taken as they are formed: what their directions err by turns the result by as much.
        let three = || [moving(), moving(), moving()];
        let count = |n: &Moving, o: &Moving| Rounding::new(1.0, [extent(n), extent(o)], 0.0);
        let cosine = largest(three(), |[n, l, o]| {
            let count = count(&n, &o).cosine(extent(&l)) - [&n, &l].map(turned).iter().sum::<f64>();
            let [n, l] = [&n, &l].map(as_formed);
            let plain = dot(&n, &l) / (dot(&n, &n) * dot(&l, &l)).sqrt();
            let inverse = Rounded::exact(1.0) / dot(&l, &l).sqrt();
            let shining = dot(&unit(&n), &l) * inverse;
            plain.error.max(shining.error) / count
        });
        assert_covers("n.l", cosine, 0.5);

        let chord = largest(three(), |[n, l, o]| {
            let turned = [&n, &n, &l, &o].map(turned).iter().sum::<f64>();
            let count = count(&n, &o).chord(extent(&l)) - turned;
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
    fn the_sum_over_lights_is_counted_whatever_their_number() {
        let terms = prop::collection::vec(0.0..100.0_f64, 1..60);
        let steady = Extent {
            radius: 0.0,
            shortest: 1.0,
        };
        let share = |(ambient, terms): (f64, Vec<f64>)| {
            // Of lights that do not err themselves, and in f32 alone.
            let mut count = Rounding::new(U, [steady; 2], ambient);
            let mut sum = Rounded::stored(ambient);
            for &levels in &terms {
                count.diffuse(steady, levels);
                sum = sum + Rounded::stored(levels) * Rounded::exact(1.0);
            }
            let own = terms.iter().sum::<f64>() * count.cosine(steady);
            // To f32, and on to the display of the next float.
            (sum.error + 3.0 * sum.value) * U / (count.levels() - own)
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
        let quadratic = goal(include_str!("../../proofs/squarings.g"), "->");
        assert!(quadratic.contains(&format!("|p - P| <= {QUADRATIC}b-24 }}")));
        let power = goal(include_str!("../../proofs/power.v"), "Goal");
        assert!(power.contains(&format!("<= {}/1.", POWER_ERROR / U)));
        let rows = goal(include_str!("../../proofs/rows.v"), "Goal");
        let thousandths = (1000.0 * interpolation::ROUNDING / U).round();
        assert!(rows.contains(&format!("- 1) <= {thousandths}/1000 * u.")));
        let fixed = goal(include_str!("../../proofs/fixed.g"), "->");
        assert!(fixed.contains(&format!(
            "(M + v + w)| <= {}b-9",
            512.0 * interpolation::FIXED
        )));
        let side = goal(include_str!("../../proofs/side.g"), "->");
        assert!(side.contains(&format!("<= {}b-53 }}", bound::ROUNDING / DOUBLE)));
        let cross = goal(include_str!("../../proofs/cross.g"), "->");
        assert!(cross.contains("<= 34b-53 }"));
        assert!((6e-8..field::CROSS_ERROR).contains(&(34.0 * DOUBLE).sqrt()));
    }
}
