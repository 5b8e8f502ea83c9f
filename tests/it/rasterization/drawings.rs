//! Coverage against known pictures.
//!
//! ```text
//!   . 1 1      a pixel is counted once for every polygon that covers its centre:
//!   1 1 2      `.` by none, `1` by one, `2` by two
//! ```

use super::counting::{assert_counts, pixels, polygon, snapped};

#[test]
fn a_pixel_is_covered_where_its_centre_is() {
    assert_counts(
        &[polygon([[2.0, 0.0], [0.0, 6.0], [12.0, 3.0]])],
        "
        ..11........
        .111111.....
        .111111111..
        .111111111..
        111111......
        11..........
        ............",
    );
}

#[test]
fn polygons_that_share_an_edge_leave_no_gap_and_draw_nothing_twice() {
    let [a, b, c, d] = [[8.0, 0.0], [0.0, 6.0], [13.0, 9.0], [18.0, 2.0]];
    let expected = "
        .......111........
        ......111111111...
        .....1111111111111
        ...11111111111111.
        ..11111111111111..
        .11111111111111...
        ..1111111111111...
        ......11111111....
        ...........11.....";
    assert_counts(&[polygon([a, b, c]), polygon([a, c, d])], expected);
    assert_counts(&[polygon([a, b, d]), polygon([b, c, d])], expected);
    assert_counts(&[polygon([a, b, c, d])], expected);
}

#[test]
fn polygons_that_overlap_are_both_drawn() {
    let [left, right] =
        [0.0, 2.0].map(|x| polygon([[x, 0.0], [x, 3.0], [x + 4.0, 3.0], [x + 4.0, 0.0]]));
    assert_counts(&[left, right], "112211 112211 112211");
}

#[test]
fn a_rectangle_of_five_by_five_is_split_into_fifteen_and_ten_pixels() {
    // The example of Microsoft's "Rasterization rules": the diagonal is a left edge of the upper triangle.
    let upper = polygon([[0.0, 0.0], [5.0, 5.0], [5.0, 0.0]]);
    let lower = polygon([[0.0, 0.0], [0.0, 5.0], [5.0, 5.0]]);
    assert_counts(&[upper], "11111 .1111 ..111 ...11 ....1");
    assert_counts(&[lower], "..... 1.... 11... 111.. 1111.");
    assert_counts(&[upper, lower], "11111 11111 11111 11111 11111");
}

#[test]
fn a_square_with_corners_on_pixel_centres_covers_its_top_and_left_edges() {
    let square = polygon([[0.5, 0.5], [0.5, 4.5], [4.5, 4.5], [4.5, 0.5]]);
    assert_counts(&[square], "1111.. 1111.. 1111.. 1111.. ...... ......");
}

#[test]
fn a_diamond_with_corners_on_pixel_centres_covers_only_its_left_corner() {
    let diamond = polygon([[3.5, 0.5], [0.5, 3.5], [3.5, 6.5], [6.5, 3.5]]);
    assert_counts(
        &[diamond],
        "
        .......
        ..11...
        .1111..
        111111.
        .1111..
        ..11...
        .......",
    );
}

#[test]
fn a_sliver_covers_exactly_the_centres_it_contains() {
    // 1/256 pixel wide and 4000 pixels long at 45 degrees: through every centre of the diagonal, or beside all of them.
    let sliver = |x: i32| {
        let end = 4000 * 256;
        snapped(&[[x, 0], [x + end, end], [x + end + 1, end], [x + 1, 0]])
    };
    assert_eq!(pixels(&sliver(0), [4000, 4000]), 4000, "on its left edge");
    assert_eq!(pixels(&sliver(-1), [4000, 4000]), 0, "on its right edge");
    assert_eq!(pixels(&sliver(1), [4000, 4000]), 0, "beside it");
}

#[test]
fn a_polygon_is_clipped_to_the_picture() {
    let square = |x: f64, y: f64| polygon([[x, y], [x, y + 4.0], [x + 4.0, y + 4.0], [x + 4.0, y]]);
    assert_counts(&[square(-2.0, -2.0)], "11.... 11.... ...... ......");
    assert_counts(&[square(4.0, 2.0)], "...... ...... ....11 ....11");
    for (x, y) in [
        (-4.0, 0.0),
        (6.0, 0.0),
        (0.0, -4.0),
        (0.0, 4.0),
        (-3e6, 0.0),
        (9.0, 3e6),
    ] {
        assert_counts(&[square(x, y)], "...... ...... ...... ......");
    }
    let all_around = polygon([[-3e6, -3e6], [-3e6, 3e6], [3e6, 3e6], [3e6, -3e6]]);
    assert_counts(&[all_around], "111111 111111 111111 111111");
}
