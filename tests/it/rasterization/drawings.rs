//! Coverage against known pictures.
//!
//! ```text
//!   . 1 1      a pixel is counted once for every polygon that covers its centre:
//!   1 1 2      `.` by none, `1` by one, `2` by two
//! ```

use super::counting::{assert_counts, pixels, polygon, snapped};

#[test]
fn a_concave_polygon_covers_only_pixels_inside_all_its_edges() {
    // The edges go down at x = 2, up again to (6, 4), down at x = 6, and back. In rows 4 to 9 the span ends at the edge
    // that goes up, before the second edge that goes down begins it. The last edge is at x = 12 - 3/7 y.
    let notched = polygon([
        [2.0, 0.0],
        [2.0, 10.0],
        [6.0, 4.0],
        [6.0, 14.0],
        [12.0, 0.0],
    ]);
    assert_counts(
        &[notched],
        "
        ..1111111111
        ..111111111.
        ..111111111.
        ..11111111..
        ............ ............ ............ ............ ............ ............
        ......1.....
        ......1.....
        ......1.....
        ............",
    );
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
