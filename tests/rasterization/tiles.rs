//! Which pixels of a tile a polygon covers, and which tiles are whole.

use shadetrade::shading::{Coverage, TILE};
use shadetrade::systems::coverage::Scan;

use super::counting::polygon;

#[test]
fn tiles_inside_a_rectangle_are_whole_and_tiles_beside_it_are_nothing() {
    let rectangle = polygon([[24.0, 8.0], [24.0, 48.0], [72.0, 48.0], [72.0, 8.0]]);
    let mut scan = Scan::new(&rectangle, 0..64, 128);
    let begun = scan.spans::<TILE>(0);
    assert_eq!(begun.extent(), 24..72);
    assert!(!begun.cover(32..48), "rows 0 to 7 are not covered");
    let whole = scan.spans::<TILE>(16);
    assert_eq!(whole.extent(), 24..72);
    assert!(whole.cover(24..72) && !whole.cover(23..72) && !whole.cover(24..73));
    assert_eq!(
        [0, 16, 32, 64, 80].map(|column| whole.coverage(column)),
        [
            Coverage::NONE,
            Coverage::new([(8, 16); TILE]),
            Coverage::WHOLE,
            Coverage::new([(0, 8); TILE]),
            Coverage::NONE,
        ]
    );
}

#[test]
fn tiles_of_some_rows_have_those_rows_and_no_others() {
    let rectangle = polygon([[0.0, 0.0], [0.0, 64.0], [64.0, 64.0], [64.0, 0.0]]);
    let mut scan = Scan::new(&rectangle, 0..20, 64);
    assert_eq!(scan.spans::<TILE>(0).coverage(16), Coverage::WHOLE);
    let cut = scan.spans::<TILE>(16);
    assert!(!cut.cover(16..32));
    let coverage = cut.coverage(16);
    assert_eq!((coverage.rows, coverage.lanes), ([0, 3], [0, 15]));
    assert_eq!(coverage.pixels, 4 * TILE as u32);
}

#[test]
fn the_extent_of_tiles_is_that_of_the_rows_that_are_covered() {
    // Its upper edge runs through the centres of row 3 and its lower one through those of row 5, which are not its own.
    let low = polygon([[20.0, 3.5], [20.0, 5.5], [40.0, 5.5], [40.0, 3.5]]);
    assert_eq!(Scan::new(&low, 0..16, 64).spans::<TILE>(0).extent(), 20..40);
    // In row 2 it reaches from 3.02 to 3.20, between two centres; in row 3 from 6.1 to 7.0, in row 7 from 18.5 to 22.1.
    let tip = polygon([[2.25, 2.25], [20.0, 8.0], [24.0, 8.0]]);
    assert_eq!(Scan::new(&tip, 0..16, 64).spans::<TILE>(0).extent(), 6..22);
    assert_eq!(Scan::new(&tip, 0..16, 64).next_span(), Some((3, 6, 7)));
    // Between two columns of centres a sliver covers nothing, and is nowhere.
    let thin = polygon([[10.75, 2.0], [10.75, 12.0], [11.25, 12.0], [11.25, 2.0]]);
    assert!(
        Scan::new(&thin, 0..16, 64)
            .spans::<TILE>(0)
            .extent()
            .is_empty()
    );
    assert_eq!(Scan::new(&thin, 0..16, 64).next_span(), None);
}

#[test]
fn where_a_polygon_is_not_convex_only_what_is_inside_all_its_edges_is_covered() {
    // Down at x = 2, up again to (6, 4), down at x = 6, and back: in rows 4 to 9 the edge that comes up ends the span
    // before the second one that goes down begins it. The last edge is at x = 12 - 3/7 y.
    let notched = polygon([
        [2.0, 0.0],
        [2.0, 10.0],
        [6.0, 4.0],
        [6.0, 14.0],
        [12.0, 0.0],
    ]);
    let mut scan = Scan::new(&notched, 0..16, 64);
    let spans: Vec<_> = std::iter::from_fn(|| scan.next_span()).collect();
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
