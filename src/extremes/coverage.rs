//! Polygons in; how many of them cover each pixel out, and a twin that decides pixel by pixel from the definition alone.
//!
//! Rule: the twin shares nothing with the scan conversion but the polygon, and its 128-bit integers cannot overflow.

use std::array::from_fn;

use super::renderer::CaseError;
use super::{Case, own};
use crate::components::Polygon;
use crate::systems::coverage::Scan;

/// The cases.
pub fn cases() -> Vec<Case> {
    vec![
        own(
            "all quadrilaterals of corners on a grid of half pixels",
            "two halves count each pixel inside once, and no others (i128)",
            |_| quadrilaterals(),
        ),
        own(
            "a fan of 360 triangles round a pixel's centre",
            "every pixel inside once (i128)",
            |_| fan(),
        ),
        own(
            "slivers 1/256 pixel wide and 4000 long",
            "the centres they meet (i128)",
            |_| long_triangles(4000.0 * 256.0, 1.0),
        ),
        own(
            "triangles up to 2^22 pixels from the picture",
            "the same pixels as in i128",
            |_| {
                let limit = f64::from(1 << 30) - 4096.0;
                long_triangles(limit, 1000.0)?;
                long_triangles(limit, 1e9)
            },
        ),
        own("polygons without area, and turned over", "0 pixels", |_| {
            without_area()
        }),
    ]
}

/// A polygon whose vertices are given in 1/256 pixel, counter-clockwise as seen.
///
/// # Panics
/// When there are more than a [`Polygon`] holds.
pub fn snapped(vertices: &[[i32; 2]]) -> Polygon {
    let mut polygon = Polygon {
        len: vertices.len() as u8,
        ..Polygon::default()
    };
    polygon.vertices[..vertices.len()].copy_from_slice(vertices);
    polygon
}

/// How many of the polygons cover each pixel of a picture.
pub fn count(polygons: &[Polygon], [width, height]: [usize; 2]) -> Vec<u32> {
    let mut counts = vec![0; width * height];
    for polygon in polygons {
        let mut scan = Scan::new(polygon, 0..height, width);
        while let Some((row, from, to)) = scan.next_span() {
            for pixel in &mut counts[row * width + from..row * width + to] {
                *pixel += 1;
            }
        }
    }
    counts
}

/// How many pixels a polygon covers of a picture.
pub fn pixels(polygon: &Polygon, size: [usize; 2]) -> u32 {
    count(&[*polygon], size).iter().sum()
}

/// Whether a ring of vertices in 1/256 pixel, convex or not, encloses the centre of pixel (`x`, `y`) moved right by next to
/// nothing and down by still less, which is what the top-left rule comes to: the number of edges to the left of that point
/// is odd.
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

/// Compares every pixel's count with what a twin says of it; how many are covered.
///
/// # Errors
/// The first pixel that is counted another number of times than once or, outside, not at all.
pub fn agrees(
    polygons: &[Polygon],
    [width, height]: [usize; 2],
    twin: impl Fn(usize, usize) -> bool,
) -> Result<u32, CaseError> {
    let counts = count(polygons, [width, height]);
    for (pixel, &count) in counts.iter().enumerate() {
        let (x, y) = (pixel % width, pixel / width);
        if count != u32::from(twin(x, y)) {
            let what = format!("pixel ({x}, {y}) is counted {count} times in {polygons:?}");
            return Err(CaseError::Wrong(what));
        }
    }
    Ok(counts.iter().sum())
}

/// Twice the area of a triangle; positive if it is counter-clockwise as seen.
pub fn turn([a, b, c]: [[i32; 2]; 3]) -> i128 {
    let [[ax, ay], [bx, by], [cx, cy]] = [a, b, c].map(|vertex| vertex.map(i128::from));
    (cx - ax) * (by - ay) - (bx - ax) * (cy - ay)
}

/// A triangle, turned over if it must be to face the eye.
pub fn facing([a, b, c]: [[i32; 2]; 3]) -> Polygon {
    let is_facing = turn([a, b, c]) > 0;
    snapped(&if is_facing { [a, b, c] } else { [a, c, b] })
}

fn without_area() -> Result<String, CaseError> {
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
    if counts == [0; 8] && pixels(&snapped(&[a, b, c, d]), [8, 8]) == 64 {
        Ok("0 pixels, and 64 of the whole".to_owned())
    } else {
        Err(CaseError::Wrong(format!("{counts:?} pixels")))
    }
}

/// All of four corners among 5 x 5 that are half a pixel apart, from a pixel's centre on.
fn quadrilaterals() -> Result<String, CaseError> {
    let grid = |index: usize| [index % 5, index / 5].map(|step| 128 * step as i32);
    let (mut covered, mut rings) = (0, 0);
    for number in 0..25_usize.pow(4) {
        let ring @ [a, b, c, d] =
            [25_usize.pow(3), 625, 25, 1].map(|place| grid(number / place % 25));
        if turn([a, b, c]) > 0 && turn([a, c, d]) > 0 {
            let halves = [snapped(&[a, b, c]), snapped(&[a, c, d])];
            covered += agrees(&halves, [3, 3], |x, y| encloses(&ring, x, y))?;
            rings += 1;
        }
    }
    Ok(format!("{covered} pixels of {rings} quadrilaterals"))
}

fn fan() -> Result<String, CaseError> {
    let rim: [[i32; 2]; 360] = from_fn(|degrees| {
        let (sin, cos) = (degrees as f64).to_radians().sin_cos();
        [10.5 + 9.7 * cos, 10.5 - 9.7 * sin].map(|pixels| (pixels * 256.0) as i32)
    });
    let middle = [10 * 256 + 128; 2];
    let fan: [Polygon; 360] =
        from_fn(|degrees| snapped(&[middle, rim[degrees], rim[(degrees + 1) % 360]]));
    let covered = agrees(&fan, [21, 21], |x, y| encloses(&rim, x, y))?;
    Ok(format!("{covered} pixels"))
}

/// Triangles round a small picture in all directions: up to `reach` long to both sides of it and up to twice `aside`
/// wide, in 1/256 pixel.
fn long_triangles(reach: f64, aside: f64) -> Result<String, CaseError> {
    let mut covered = 0;
    for step in 0..4000 {
        // Multiples of irrational numbers spread evenly.
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
        covered += agrees(&[triangle], [16, 16], |x, y| encloses(&ends, x, y))?;
    }
    Ok(format!("the same: {covered} pixels of 4000 triangles"))
}
