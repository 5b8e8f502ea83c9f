//! Coverage of polygons that are not convex.

use super::counting::{polygon, spans};

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
    let spans: Vec<_> = spans(&notched, 0..16, 64).collect();
    let expected = [
        (0, 2, 12),
        (1, 2, 11),
        (2, 2, 11),
        (3, 2, 10),
        (10, 6, 7),
        (11, 6, 7),
        (12, 6, 7),
    ];
    assert_eq!(spans, expected);
}
