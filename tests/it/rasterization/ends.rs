//! Coverage at the limits of its coordinates, against the implementation in 128 bits.

use std::array::from_fn;

use shadetrade::components::Polygon;

use super::counting::{assert_twin, encloses, facing, pixels, snapped, turn};

#[test]
fn slivers_a_256th_of_a_pixel_wide_and_4000_long_cover_the_centres_they_contain() {
    assert_long_triangles(4000.0 * 256.0, 1.0);
}

#[test]
fn triangles_up_to_2_to_the_22_pixels_from_the_picture_cover_the_right_pixels() {
    let limit = f64::from(1 << 30) - 4096.0;
    assert_long_triangles(limit, 1000.0);
    assert_long_triangles(limit, 1e9);
}

#[test]
fn degenerate_and_back_facing_polygons_cover_nothing() {
    let [a, b, c, d] = [[0, 0], [0, 2048], [2048, 2048], [2048, 0]];
    let on_centres = [128, 128 + 256, 128 + 512].map(|place| [place, place]);
    let polygons: [&[[i32; 2]]; 8] = [
        &[],
        &[a, a, a],
        &[a, b, a],
        &[a, a, c, c],
        &[a, c, a, c, a],
        &on_centres,
        &[c, b, a],
        &[d, c, b, a],
    ];
    let counts = polygons.map(|vertices| pixels(&snapped(vertices), [8, 8]));
    assert_eq!(counts, [0; 8]);
    assert_eq!(pixels(&snapped(&[a, b, c, d]), [8, 8]), 64);
}

/// All choices of four corners on a grid of 5 x 5 points half a pixel apart, which starts at a pixel centre.
#[test]
fn all_quadrilaterals_on_a_grid_of_half_pixels_cover_their_pixels_once() {
    let grid = |index: usize| [index % 5, index / 5].map(|step| 128 * step as i32);
    let mut rings = 0;
    for number in 0..25_usize.pow(4) {
        let ring @ [a, b, c, d] =
            [25_usize.pow(3), 625, 25, 1].map(|place| grid(number / place % 25));
        if turn([a, b, c]) > 0 && turn([a, c, d]) > 0 {
            let halves = [snapped(&[a, b, c]), snapped(&[a, c, d])];
            assert_twin(&halves, [3, 3], |x, y| encloses(&ring, x, y));
            rings += 1;
        }
    }
    assert!(rings > 10_000, "{rings} quadrilaterals");
}

#[test]
fn a_fan_of_360_triangles_round_a_pixel_s_centre_counts_every_pixel_once() {
    let rim: [[i32; 2]; 360] = from_fn(|degrees| {
        let (sin, cos) = (degrees as f64).to_radians().sin_cos();
        [10.5 + 9.7 * cos, 10.5 - 9.7 * sin].map(|pixels| (pixels * 256.0) as i32)
    });
    let middle = [10 * 256 + 128; 2];
    let fan: [Polygon; 360] =
        from_fn(|degrees| snapped(&[middle, rim[degrees], rim[(degrees + 1) % 360]]));
    let covered = assert_twin(&fan, [21, 21], |x, y| encloses(&rim, x, y));
    assert!(covered > 200, "{covered} pixels");
}

/// Triangles around a small picture in all directions: up to `reach` long on both sides of it and up to twice `aside`
/// wide, in 1/256 pixel.
fn assert_long_triangles(reach: f64, aside: f64) {
    let mut covered = 0;
    for step in 0..4000 {
        // Multiples of irrational numbers are evenly distributed.
        let spread = |ratio: f64| (ratio * f64::from(step)).fract();
        let (sin, cos) = (std::f64::consts::TAU * spread(0.618_033_989)).sin_cos();
        let middle = [spread(0.754_877_666), spread(0.569_840_291)].map(|share| 4096.0 * share);
        let ends = [
            (1.0, 0.819_172_513),
            (-1.0, 0.671_043_607),
            (1.0, 0.549_700_478),
        ]
        .map(|(sign, ratio)| {
            let along = sign * reach * (0.5 + 0.49 * spread(ratio));
            let aside =
                (aside * (2.0 * spread(7.0 * ratio) - 1.0)).clamp(-0.1 * reach, 0.1 * reach);
            let x = middle[0] + along * cos - aside * sin;
            let y = middle[1] + along * sin + aside * cos;
            [x, y].map(|coordinate| coordinate.round() as i32)
        });
        let triangle = facing(ends);
        covered += assert_twin(&[triangle], [16, 16], |x, y| encloses(&ends, x, y));
    }
    assert!(covered > 0, "some pixels are covered");
}
