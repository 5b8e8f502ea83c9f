//! Which pixels of a tile a polygon covers, and which tiles are whole.

use shadetrade::shading::{Coverage, TILE};
use shadetrade::systems::coverage::Scan;

use super::counting::polygon;

#[test]
fn tiles_inside_a_rectangle_are_whole_and_tiles_beside_it_are_nothing() {
    let rectangle = polygon([[8.0, 8.0], [8.0, 48.0], [56.0, 48.0], [56.0, 8.0]]);
    let mut scan = Scan::new(&rectangle, 0..64, 128);
    let begun = scan.tiles(0);
    assert_eq!(begun.extent(), 8..56);
    assert!(!begun.cover(16..32), "rows 0 to 7 are not covered");
    let whole = scan.tiles(16);
    assert_eq!(whole.extent(), 8..56);
    assert!(whole.cover(8..56) && !whole.cover(7..56) && !whole.cover(8..57));
    assert_eq!(
        [0, 16, 48, 64].map(|column| whole.coverage(column)),
        [
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
    assert_eq!(scan.tiles(0).coverage(16), Coverage::WHOLE);
    let cut = scan.tiles(16);
    let spans: Vec<_> = cut.rows().map(|row| cut.span(row)).collect();
    assert_eq!(spans[..4], [(0, 64); 4]);
    assert!(spans[4..].iter().all(|(from, to)| from >= to), "{spans:?}");
    assert!(!cut.cover(16..32));
    assert_eq!(cut.coverage(16).pixels, 4 * TILE as u32);
}

#[test]
fn the_extent_of_tiles_is_that_of_the_rows_that_are_covered() {
    // Its upper edge runs through the centres of row 3 and its lower one through those of row 5, which are not its own.
    let low = polygon([[20.0, 3.5], [20.0, 5.5], [40.0, 5.5], [40.0, 3.5]]);
    let tiles = Scan::new(&low, 0..16, 64).tiles(0);
    assert_eq!(tiles.extent(), 20..40);
    // Between two columns of centres a sliver covers nothing, and is nowhere.
    let thin = polygon([[10.75, 2.0], [10.75, 12.0], [11.25, 12.0], [11.25, 2.0]]);
    let mut scan = Scan::new(&thin, 0..16, 64);
    assert!(scan.tiles(0).extent().is_empty());
    assert_eq!(Scan::new(&thin, 0..16, 64).next_span(), None);
}
