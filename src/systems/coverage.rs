//! Scan conversion: finds the span of pixels that a snapped polygon covers on each row.
//!
//! ```text
//!   row 0   . . . . .      a pixel is covered if its centre is inside, or on a top or left edge
//!   row 1   . # # . .      left edges give the first pixel, right edges the first one beyond
//!   row 2   . # # # .
//! ```
//! The arithmetic is in integers and exact: with coordinates below 2^30 in 1/256 pixel no product exceeds 2^62. Two faces
//! compute a shared edge from its upper end and get the same boundary, so each pixel along it is drawn once.
//!
//! Snapping moves a vertex by up to half a unit and may bend a face that is seen edge-on. A row still meets one left and one
//! right edge of it: snapping keeps the order of coordinates, so a vertex is above the row's centres exactly if it was above
//! a certain height before, and any height meets two edges of a convex outline. Where snapping puts the right edge of a face
//! left of its left edge, the face covers nothing in that row, and yet its neighbours do not overlap. In a row the right
//! edge of a face is the left edge of the next, so the signed lengths of all front faces add up to that of the outline. A
//! reversed face counts negatively. Its neighbours could overlap only if both its edges were inside the outline. Of the
//! three edges at a corner of a cuboid no two can be in line on the screen on the same side of the corner, so a face that
//! is seen edge-on has the outline on one side.
//!
//! A small convex face is tested at each pixel of a square around it instead, sixteen at a time (Pineda 1988), which needs no
//! division.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i32x16};

use crate::components::Polygon;
use crate::shading::simd::inlined;

/// The first row (or pixel) whose centre is at or beyond a coordinate.
fn first_centre(coordinate: i32) -> i64 {
    (i64::from(coordinate) + 127).div_euclid(256)
}

/// Appends the range from..to of the pixels that a polygon covers on each row of a picture whose centres lie between its highest
/// and its lowest vertex. It is empty if `to` <= `from`. Returns the first of these rows.
pub fn scan(
    polygon: &Polygon,
    [width, height]: [usize; 2],
    from: &mut Vec<i32>,
    to: &mut Vec<i32>,
) -> usize {
    let vertices = polygon.vertices();
    let heights = vertices.iter().map(|vertex| vertex[1]);
    let [first, end] = [heights.clone().min(), heights.max()]
        .map(|y| first_centre(y.unwrap_or_default()).clamp(0, height as i64) as usize);
    let (rows, start) = (first..end, from.len());
    from.resize(start + rows.len(), 0);
    to.resize(start + rows.len(), width as i32);
    for (index, &vertex) in vertices.iter().enumerate() {
        let next = vertices[(index + 1) % vertices.len()];
        // Edges on the left go down. If snapping reversed the polygon, left and right are exchanged and its spans are empty.
        if vertex[1] < next[1] {
            narrow([vertex, next], &rows, width, &mut from[start..], i32::max);
        } else {
            narrow([next, vertex], &rows, width, &mut to[start..], i32::min);
        }
    }
    first
}

/// Narrows the spans of some rows at one end to an edge, given from its upper end.
fn narrow(
    [[x, top], [right, bottom]]: [[i32; 2]; 2],
    rows: &Range<usize>,
    width: usize,
    ends: &mut [i32],
    nearer: impl Fn(i32, i32) -> i32,
) {
    let [first, end] =
        [top, bottom].map(|y| first_centre(y).clamp(rows.start as i64, rows.end as i64));
    if first >= end {
        return;
    }
    // The boundary on row r is ceil(N / D) with D = 256 (bottom - top) and
    // N = (x - 128) (bottom - top) + (right - x) (256 r + 128 - top); ceil(N / D) = floor((N - 1) / D) + 1.
    let [x, top, right, bottom] = [x, top, right, bottom].map(i64::from);
    let (run, rise) = (right - x, bottom - top);
    let divisor = 256 * rise;
    let start = (x - 128) * rise + run * (256 * first + 128 - top) - 1;
    let (mut boundary, mut rest) = (start.div_euclid(divisor) + 1, start.rem_euclid(divisor));
    let step = 256 * run;
    let (step, step_rest) = (step.div_euclid(divisor), step.rem_euclid(divisor));
    for old in &mut ends[first as usize - rows.start..end as usize - rows.start] {
        *old = nearer(*old, boundary.clamp(0, width as i64) as i32);
        boundary += step;
        rest += step_rest;
        if rest >= divisor {
            rest -= divisor;
            boundary += 1;
        }
    }
}

/// The side of the square of pixels round a small face.
pub const SMALL: usize = 16;

/// Whether a quadrilateral turns left at its corners, or goes straight on at some. Corners may coincide; not all may lie on a
/// line. It has to be within the square of [`covered`].
#[inline(always)]
pub fn is_convex(corners: &[[i32; 2]; 4]) -> bool {
    let way = [0, 1, 2, 3].map(|corner| {
        let [from, to] = [corners[corner], corners[(corner + 1) % 4]];
        [to[0] - from[0], to[1] - from[1]]
    });
    // Down is positive.
    let turn = |[x, y]: [i32; 2], [next_x, next_y]: [i32; 2]| next_x * y - x * next_y;
    let turns = [0, 1, 2, 3].map(|corner| turn(way[corner], way[(corner + 1) % 4]));
    turns.iter().all(|turn| *turn >= 0) && turns != [0; 4]
}

/// The pixels that a convex quadrilateral covers in [`SMALL`] columns and `rows` rows that start at pixel `first`: for each row
/// a bit per column. It must lie in that square. [`scan`] finds the same pixels.
#[inline(always)]
pub fn covered<S: Simd>(
    simd: S,
    corners: &[[i32; 2]; 4],
    first: [i32; 2],
    rows: usize,
) -> [u32; SMALL] {
    debug_assert!(is_convex(corners) && rows <= SMALL);
    let lanes = i32x16::from_fn(simd, |lane| lane as i32);
    // Twice the signed area between a pixel's centre and an edge. It is not negative inside. On a right or bottom
    // edge 1 is subtracted, so that the edge itself is outside. An edge without length leaves nothing out. Coordinates are from
    // the centre of the first pixel, so no number exceeds 2^26.
    let edge = inlined!(|from: usize, to: usize| {
        let at = |corner: usize, axis: usize| corners[corner][axis] - 256 * first[axis] - 128;
        let [x, y] = [at(from, 0), at(from, 1)];
        let [run, rise] = [at(to, 0) - x, at(to, 1) - y];
        let open = rise < 0 || rise == 0 && run > 0;
        let start = y * run - x * rise - i32::from(open);
        (lanes * (256 * rise) + start, -256 * run)
    });
    let [mut a, mut b, mut c, mut d] = [edge(0, 1), edge(1, 2), edge(2, 3), edge(3, 0)];
    let mut bits = [0; SMALL];
    for row in bits.iter_mut().take(rows) {
        *row = (a.0 | b.0 | c.0 | d.0).simd_ge(0).to_bitmask() as u32;
        (a.0, b.0, c.0, d.0) = (a.0 + a.1, b.0 + b.1, c.0 + c.1, d.0 + d.1);
    }
    bits
}
