//! Drawings and assertions of how many polygons cover each pixel.

use shadetrade::components::Polygon;
use shadetrade::extremes::coverage::agrees;
pub use shadetrade::extremes::coverage::{count, encloses, facing, pixels, snapped, turn};

/// A polygon whose vertices are given in pixels, right and down, counter-clockwise as seen.
pub fn polygon<const LEN: usize>(vertices: [[f64; 2]; LEN]) -> Polygon {
    snapped(&vertices.map(|vertex| vertex.map(|pixels| (pixels * 256.0) as i32)))
}

/// Compares the counts with a drawing, whose size is the picture's.
#[track_caller]
pub fn assert_counts(polygons: &[Polygon], expected: &str) {
    let rows: Vec<&str> = expected.split_whitespace().collect();
    let counts = count(polygons, [rows[0].len(), rows.len()]);
    let drawn: Vec<String> = counts
        .chunks(rows[0].len())
        .map(|row| row.iter().map(u32::to_string).collect::<String>())
        .map(|row| row.replace('0', "."))
        .collect();
    let [drawn, expected] = [drawn.join("\n"), rows.join("\n")];
    assert!(drawn == expected, "covered\n{drawn}\n\nnot\n{expected}");
}

/// Compares every pixel's count with what a twin says of it; returns how many are covered.
#[track_caller]
pub fn assert_twin(
    polygons: &[Polygon],
    size: [usize; 2],
    twin: impl Fn(usize, usize) -> bool,
) -> u32 {
    agrees(polygons, size, twin).unwrap_or_else(|wrong| panic!("{wrong}"))
}

/// The definition: a convex polygon covers what lies on the inner side of each edge, and of what lies on an edge that on a
/// left one (which goes down) or a top one (level, to the left). In 128 bits nothing overflows.
pub fn covers(polygon: &Polygon, x: usize, y: usize) -> bool {
    let [x, y] = [x, y].map(|pixels| 256 * pixels as i128 + 128);
    let ring = polygon.vertices();
    (0..ring.len()).all(|index| {
        let ends = [ring[index], ring[(index + 1) % ring.len()]];
        let [from, to] = ends.map(|vertex| vertex.map(i128::from));
        let [right, down] = [to[0] - from[0], to[1] - from[1]];
        let inwards = down * (x - from[0]) - right * (y - from[1]);
        from == to || inwards > 0 || (inwards == 0 && (down > 0 || (down == 0 && right < 0)))
    })
}
