//! Drawings, and assertions of how many polygons cover each pixel.

use shadetrade::components::Polygon;
use shadetrade::shading::simd::baseline;
use shadetrade::systems::coverage::{SMALL, covered, is_convex, scan};

/// A polygon whose vertices are given in 1/256 pixel, counter-clockwise as seen.
pub fn snapped(vertices: &[[i32; 2]]) -> Polygon {
    let mut polygon = Polygon {
        len: vertices.len() as u8,
        ..Polygon::default()
    };
    polygon.vertices[..vertices.len()].copy_from_slice(vertices);
    polygon
}

/// The rows of a picture that a polygon covers, each with its pixels from..to.
pub fn spans(polygon: &Polygon, size: [usize; 2]) -> impl Iterator<Item = (usize, usize, usize)> {
    let (mut from, mut to) = (Vec::new(), Vec::new());
    let first = scan(polygon, size, &mut from, &mut to);
    let spans = (first..).zip(from.into_iter().zip(to));
    spans
        .filter(|(_, (from, to))| from < to)
        .map(|(row, (from, to))| (row, from as usize, to as usize))
}

/// The number of polygons that cover each pixel of a picture.
///
/// Small convex faces are counted in two ways.
pub fn count(polygons: &[Polygon], [width, height]: [usize; 2]) -> Vec<u32> {
    for polygon in polygons {
        assert_small(polygon, [width, height]);
    }
    let mut counts = vec![0; width * height];
    for polygon in polygons {
        for (row, from, to) in spans(polygon, [width, height]) {
            for pixel in &mut counts[row * width + from..row * width + to] {
                *pixel += 1;
            }
        }
    }
    counts
}

/// Asserts that a convex face within a small square at the first pixels covers the same pixels if each is tested alone.
fn assert_small(polygon: &Polygon, [width, height]: [usize; 2]) {
    let is_small = |coordinate: &i32| (-128..16 * 256).contains(coordinate);
    let Ok(corners) = polygon.vertices().try_into() else {
        return;
    };
    if !polygon.vertices().as_flattened().iter().all(is_small) || !is_convex(corners) {
        return;
    }
    let simd = baseline();
    let bits = covered(simd, corners, [0, 0], SMALL);
    let mut expected = [0; SMALL];
    for (row, from, to) in spans(polygon, [width, height].map(|side| side.min(SMALL))) {
        expected[row] = (1 << to) - (1 << from);
    }
    for (bits, expected) in bits.into_iter().zip(expected).take(height) {
        let in_picture = (1_u32 << width.min(SMALL)) - 1;
        assert_eq!(bits & in_picture, expected, "{polygon:?}");
    }
}

/// The number of pixels of a picture that a polygon covers.
pub fn pixels(polygon: &Polygon, size: [usize; 2]) -> u32 {
    count(&[*polygon], size).iter().sum()
}

/// Whether a ring of vertices in 1/256 pixel, convex or not, encloses the centre of pixel (`x`, `y`). The centre is
/// moved right by an infinitesimal and down by a smaller one, which is equivalent to the top-left rule. It is enclosed
/// if the number of edges to its left is odd.
pub fn encloses(ring: &[[i32; 2]], x: usize, y: usize) -> bool {
    let [x, y] = [x, y].map(|pixels| 256 * pixels as i128 + 128);
    let crossed = (0..ring.len()).filter(|&index| {
        let ends = [ring[index], ring[(index + 1) % ring.len()]];
        let mut ends = ends.map(|vertex| vertex.map(i128::from));
        ends.sort_by_key(|vertex| vertex[1]);
        let [upper, lower] = ends;
        let [right, down] = [lower[0] - upper[0], lower[1] - upper[1]];
        upper[1] <= y && y < lower[1] && right * (y - upper[1]) <= (x - upper[0]) * down
    });
    crossed.count() % 2 == 1
}

/// Twice the area of a triangle; positive if it is counter-clockwise as seen.
pub fn turn([a, b, c]: [[i32; 2]; 3]) -> i128 {
    let [[ax, ay], [bx, by], [cx, cy]] = [a, b, c].map(|vertex| vertex.map(i128::from));
    (cx - ax) * (by - ay) - (bx - ax) * (cy - ay)
}

/// A triangle, with its vertices reversed if it is back-facing.
pub fn facing([a, b, c]: [[i32; 2]; 3]) -> Polygon {
    let is_facing = turn([a, b, c]) > 0;
    snapped(&if is_facing { [a, b, c] } else { [a, c, b] })
}

/// A polygon whose vertices are given in pixels, right and down, counter-clockwise as seen.
pub fn polygon<const LEN: usize>(vertices: [[f64; 2]; LEN]) -> Polygon {
    snapped(&vertices.map(|vertex| vertex.map(|pixels| (pixels * 256.0) as i32)))
}

/// Compares the counts with a drawing of the whole picture.
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

/// Compares the count of every pixel with that of an independent implementation; returns the number of covered pixels.
#[track_caller]
pub fn assert_twin(
    polygons: &[Polygon],
    size: [usize; 2],
    twin: impl Fn(usize, usize) -> bool,
) -> u32 {
    let counts = count(polygons, size);
    for (pixel, &count) in counts.iter().enumerate() {
        let (x, y) = (pixel % size[0], pixel / size[0]);
        assert_eq!(count, u32::from(twin(x, y)), "({x}, {y}) of {polygons:?}");
    }
    counts.iter().sum()
}
