//! Coverage of random polygons against an independent implementation in 128 bits.

use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use shadetrade::systems::coverage::is_convex;

use super::counting::{assert_twin, encloses, facing, snapped, turn};
use crate::support::prelude::*;

#[test]
fn an_edge_through_a_centre_or_nearest_to_it_agrees_with_the_definition() {
    let mut random = Random(3);
    for reach in [1000.0, 1e5, 1e8] {
        let mut covered = 0;
        for _ in 0..10 * cases(30) {
            let [across, down] = [(); 2].map(|()| random.within(-reach, reach) as i64);
            // The least distance: `down` u - `across` v = 1.
            let (divisor, u, v) = bezout(down, -across);
            if divisor != 1 {
                continue;
            }
            for miss in [-1, 0, 1] {
                let at = |right: i64, below: i64| {
                    [miss * u + right, miss * v + below].map(|c| (8 * 256 + 128 + c) as i32)
                };
                // At most one step up or down, or the edge would miss by a multiple of the least distance.
                for end in [at(-across, -down), at(across, down)] {
                    for side in [at(-down, across), at(down, -across)] {
                        let ring = [at(0, 0), end, side];
                        let twin = |x, y| encloses(&ring, x, y);
                        covered += assert_twin(&[facing(ring)], [17, 17], twin);
                    }
                }
            }
        }
        assert!(covered > 100 * cases(30) as u32, "{covered} pixels");
    }
}

/// The greatest common divisor g of two integers, and the factors of g = x a + y b (extended Euclidean algorithm).
fn bezout(a: i64, b: i64) -> (i64, i64, i64) {
    if b == 0 {
        (a.abs(), a.signum(), 0)
    } else {
        let (divisor, u, v) = bezout(b, a % b);
        (divisor, v, u - a / b * v)
    }
}

/// Triangles around a small picture in all directions: in 1/256 pixel up to `reach` long on both sides of it, and up to
/// twice `aside` wide.
#[test]
fn long_triangles_and_slivers_cover_the_centres_they_contain() {
    let limit = f64::from(1 << 30) - 4096.0;
    let mut random = Random(4);
    for (reach, aside) in [(4000.0 * 256.0, 1.0), (limit, 1000.0), (limit, 0.1 * limit)] {
        let mut covered = 0;
        for _ in 0..4000 {
            let (sin, cos) = random.within(0.0, std::f64::consts::TAU).sin_cos();
            let middle = [(); 2].map(|()| random.within(0.0, 4096.0));
            let ends = [1.0, -1.0, 1.0].map(|sign| {
                let along = sign * reach * random.within(0.5, 0.99);
                let aside = random.within(-aside, aside);
                let [x, y] = [along * cos - aside * sin, along * sin + aside * cos];
                [middle[0] + x, middle[1] + y].map(|coordinate| coordinate.round() as i32)
            });
            covered += assert_twin(&[facing(ends)], [16, 16], |x, y| encloses(&ends, x, y));
        }
        assert!(covered > 0, "some pixels are covered");
    }
}

/// The convex hull, counter-clockwise on the screen (Andrew 1979).
fn hull(mut points: Vec<[i32; 2]>) -> Vec<[i32; 2]> {
    points.sort_unstable();
    points.dedup();
    let half = |points: &mut dyn Iterator<Item = [i32; 2]>| {
        let mut chain: Vec<[i32; 2]> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && turn([a, b, point]) <= 0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut ring = half(&mut points.iter().copied());
    ring.extend(half(&mut points.iter().rev().copied()));
    ring
}

/// Convex polygons in and around a small picture; for a `unit` of 128 the vertices are pixel centres and pixel corners.
fn convex() -> impl Strategy<Value = Polygon> {
    prop_oneof![Just(1), Just(128)].prop_flat_map(|unit| {
        let coordinate = (-512 / unit..=40 * 256 / unit).prop_map(move |step| step * unit);
        prop::collection::vec([coordinate.clone(), coordinate], 3..=Polygon::MAX_VERTICES)
            .prop_map(|points| snapped(&hull(points)))
    })
}

#[test]
fn a_quadrilateral_may_go_straight_on_at_a_corner_but_is_no_point() {
    assert!(is_convex(&[[0, 256], [128, 256], [256, 256], [256, 0]]));
    // An edge without length leaves no pixel out.
    assert!(!is_convex(&[[128, 128]; 4]));
}

proptest! {
    #![proptest_config(Config {
        cases: 2000,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..Config::default()
    })]

    #[test]
    fn any_convex_polygon_covers_the_pixels_of_the_definition(polygon in convex()) {
        assert_twin(&[polygon], [36, 36], |x, y| encloses(polygon.vertices(), x, y));
    }

    #[test]
    fn a_small_quadrilateral_turns_left_exactly_if_it_is_convex(
        halves in prop::array::uniform4(prop::array::uniform2(0..8_i32)),
    ) {
        // Corners and centres of pixels.
        let corners = halves.map(|corner| corner.map(|half| 128 * half));
        let ring = snapped(&corners);
        if is_convex(&corners) {
            // `count` compares the bits of small convex faces with their spans.
            assert_twin(&[ring], [8, 8], |x, y| encloses(&corners, x, y));
        }
        let is_hull = (0..4).all(|first| {
            let rest = [1, 2, 3].map(|next| corners[(first + next) % 4]);
            turn([corners[first], rest[0], rest[1]]) > 0
                && turn([corners[first], rest[0], rest[2]]) > 0
        });
        prop_assert!(!is_hull || is_convex(&corners));
    }
}
