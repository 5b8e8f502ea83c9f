//! Metrics: every figure against a value computed by hand or by another program.

use shadetrade::components::TriangleId;
use shadetrade::questions::metrics::{
    Difference, ErrorStatistics, Picture, Pixel, compare, compared, difference, pixel_error,
};

const GRAY: [f64; 3] = [100.0; 3];

/// A picture that shows one triangle everywhere.
fn whole<'a, T>(width: usize, levels: &'a [[T; 3]], triangles: &'a [TriangleId]) -> Picture<'a, T> {
    Picture {
        width,
        levels,
        triangles,
    }
}

/// The comparison with a flat grey picture of one row that shows one triangle.
fn against_gray(levels: &[[f64; 3]]) -> Difference {
    let triangles = vec![TriangleId(0); levels.len()];
    compare(
        whole(levels.len(), levels, &triangles),
        whole(levels.len(), &vec![GRAY; levels.len()], &triangles),
    )
}

#[test]
fn the_figures_of_four_pixels_are_those_computed_by_hand() {
    // Errors 0, 3, 4 and 1: mean 8 / 4, root mean square sqrt(26 / 4), two of four above one level.
    let levels = [
        GRAY,
        [100.0, 103.0, 98.0],
        [99.5, 100.0, 96.0],
        [101.0, 100.0, 100.0],
    ];
    let difference = against_gray(&levels);
    assert_eq!(difference.edge_pixels, 0);
    let expected = ErrorStatistics {
        max: 4.0,
        max_pixel: [2, 0],
        mean: 2.0,
        rmse: 6.5_f64.sqrt(),
        p999: 4.0,
        over_1_level: 0.5,
    };
    assert_eq!(difference.error, Some(expected));
}

#[test]
fn the_largest_error_has_its_column_and_row_and_the_first_wins() {
    let mut levels = [GRAY; 6];
    levels[4] = [0.0, 100.0, 100.0];
    levels[5] = [100.0, 200.0, 100.0];
    let difference = compare(
        whole(3, &levels, &[TriangleId(7); 6]),
        whole(3, &[GRAY; 6], &[TriangleId(7); 6]),
    );
    let error = difference.error.expect("six pixels are compared");
    assert_eq!((error.max, error.max_pixel), (100.0, [1, 1]));
}

#[test]
fn one_error_in_a_thousand_is_beyond_the_percentile_and_two_are_not() {
    // Of 1000 errors in ascending order the 999th is the percentile.
    let mut levels = vec![[102.0; 3]; 1000];
    for (pixel, level, p999) in [(500, 150.0, 2.0), (501, 140.0, 40.0)] {
        levels[pixel] = [level; 3];
        let error = against_gray(&levels).error;
        assert_eq!(error.map(|error| error.p999), Some(p999));
    }
}

#[test]
fn levels_are_compared_as_they_are_displayed_without_rounding() {
    let infinite = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    for (left, right, error) in [
        ([300.0, -7.0, 1e30], [255.0, 0.0, 9e9], 0.0),
        ([254.75, 0.0, 0.0], [1000.0, 0.25, 0.0], 0.25),
        (infinite, [3.0, 250.0, 1.0], 5.0),
    ] {
        assert_eq!(pixel_error(left, right), error, "{left:?}");
    }
    let error = against_gray(&[[f64::NAN; 3], [f64::INFINITY; 3]]).error;
    assert_eq!(error.map(|it| (it.max, it.mean)), Some((155.0, 127.5)));
}

#[test]
fn pixels_of_one_face_are_compared_and_others_are_edge_pixels() {
    const NOTHING: u32 = TriangleId::NONE.0;
    // Both triangles; the number of compared pixels and of edge pixels.
    for (left, right, compared_pixels, edge_pixels) in [
        // Triangles 5 and 6 belong to two faces, 11 and 12 to two cuboids.
        ([3, 3, 6, 11], [3, NOTHING, 5, 12], 1, 3),
        ([3, NOTHING, NOTHING, 3], [NOTHING, 3, NOTHING, 3], 1, 2),
        // The halves of the first cuboid's first face, and of the fourth's last.
        ([0, 46, 1, 47], [1, 47, 0, 46], 4, 0),
        ([NOTHING; 4], [NOTHING; 4], 0, 0),
    ] {
        let [left, right] = [left, right].map(|ids: [u32; 4]| ids.map(TriangleId));
        let (zeros, nines) = ([[0.0; 3]; 4], [[9.0; 3]; 4]);
        let (left, right) = (whole(2, &zeros, &left), whole(2, &nines, &right));
        let found = compare(left, right);
        assert_eq!(found.edge_pixels, edge_pixels);
        let error = (compared_pixels > 0).then_some(9.0);
        assert_eq!(found.error.map(|error| error.max), error);
        let kinds = compared(left, right).filter(|it| matches!(it, Pixel::Error(_)));
        assert_eq!(kinds.count(), compared_pixels);
    }
}

#[test]
fn a_difference_is_at_least_the_gap_and_at_most_the_span() {
    for (left, right, known) in [
        ([0.0, 1.0], [3.0, 4.5], [2.0, 4.5]),
        ([3.0, 4.5], [0.0, 1.0], [2.0, 4.5]),
        ([0.0, 10.0], [5.0, 20.0], [0.0, 20.0]),
        ([5.0, 6.0], [0.0, 20.0], [0.0, 15.0]),
        ([7.0, 7.0], [7.0, 7.0], [0.0, 0.0]),
    ] {
        let found = difference(&[left; 3], &[right; 3]);
        assert_eq!(found, known, "{left:?} {right:?}");
    }
    // The channel with the largest difference decides.
    for channel in 0..3 {
        let mut channels = [[1.0, 1.0]; 3];
        channels[channel] = [6.0, 7.0];
        assert_eq!(difference(&[[1.0; 2]; 3], &channels), [5.0, 6.0]);
    }
    // 0.1 - 0.7 is not a float, so the floats on both sides are given.
    let [least, most] = difference(&[[0.1; 2]; 3], &[[0.7; 2]; 3]);
    assert_eq!(least.next_up().next_up(), most);
    assert_eq!(difference(&[[1e-20; 2]; 3], &[[255.0; 2]; 3])[1], 255.0);
}
