//! A snapped polygon in, the exact spans of pixels it covers out.
//!
//! ```text
//!   row 0   . . . . .      a pixel is covered if its centre is inside, or on a top or left edge
//!   row 1   . # # . .      left edges give the first pixel, right edges the first one beyond
//!   row 2   . # # # .
//! ```
//! Rule: all in integers, and exact. With coordinates below 2^30 in 1/256 pixel no product exceeds 2^62. An edge gives its
//! two triangles the same boundary, since both compute it from its upper end; so nothing is missed and nothing drawn twice.
//! A small triangle is asked at every pixel around it instead, sixteen at a time (Pineda 1988): no edge is divided.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i32x16};

use crate::components::Polygon;
use crate::simd::inlined;

/// One edge on its way down the rows: the first pixel whose centre is not left of it.
#[derive(Clone, Copy, Debug, Default)]
struct Edge {
    /// Going down as the polygon goes round: pixels begin here; otherwise they end.
    left: bool,
    rows: [i64; 2],
    /// One less than the boundary; the exact place is that plus `rest` / `divisor`.
    pixel: i64,
    rest: i64,
    /// What a row adds to both.
    step: i64,
    step_rest: i64,
    divisor: i64,
}

/// The first row (or pixel) whose centre is at or beyond a coordinate.
fn first_centre(coordinate: i64) -> i64 {
    (coordinate + 127).div_euclid(256)
}

impl Edge {
    /// `None` where the edge passes no row of pixel centres.
    fn new(from: [i32; 2], to: [i32; 2]) -> Option<Edge> {
        let left = from[1] < to[1];
        let (upper, lower) = if left { (from, to) } else { (to, from) };
        let [x, y, right, down] = [upper[0], upper[1], lower[0], lower[1]].map(i64::from);
        let rows = [first_centre(y), first_centre(down)];
        if rows[0] >= rows[1] {
            return None;
        }
        // The boundary on row r is ceil(N / D) with D = 256 (down - y) and
        // N = (x - 128) (down - y) + (right - x) (256 r + 128 - y); ceil(N / D) = floor((N - 1) / D) + 1.
        let (run, rise) = (right - x, down - y);
        let divisor = 256 * rise;
        let start = (x - 128) * rise + run * (256 * rows[0] + 128 - y) - 1;
        Some(Edge {
            left,
            rows,
            pixel: start.div_euclid(divisor),
            rest: start.rem_euclid(divisor),
            step: (256 * run).div_euclid(divisor),
            step_rest: (256 * run).rem_euclid(divisor),
            divisor,
        })
    }

    /// Goes on to the row `by` rows below the first.
    fn skip(&mut self, by: i64) {
        // In i128, once an edge and band: the walk itself never leaves 64 bits.
        let rest = i128::from(self.rest) + i128::from(self.step_rest) * i128::from(by);
        self.pixel += self.step * by + rest.div_euclid(i128::from(self.divisor)) as i64;
        self.rest = rest.rem_euclid(i128::from(self.divisor)) as i64;
    }

    /// The boundary on the present row; goes on to the next.
    #[inline]
    fn advance(&mut self) -> i64 {
        let boundary = self.pixel + 1;
        self.pixel += self.step;
        self.rest += self.step_rest;
        if self.rest >= self.divisor {
            self.rest -= self.divisor;
            self.pixel += 1;
        }
        boundary
    }
}

/// The side of the square of pixels round a small triangle.
pub const SMALL: usize = 16;

/// The pixels that a triangle covers of the [`SMALL`] columns and so many rows from `first` on, by row: a bit for each column.
/// It must lie in that square. [`Scan`] finds the same.
#[inline(always)]
pub fn covered<S: Simd>(
    simd: S,
    corners: [[i32; 2]; 3],
    first: [i32; 2],
    rows: usize,
) -> [u32; SMALL] {
    const LANES: [i32; SMALL] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
    let lanes = i32x16::simd_from(simd, LANES);
    // Twice the area of a pixel's centre and an edge: not negative inside, and positive if the edge is right or below. From
    // the centre of the first pixel no number exceeds 2^26.
    let edge = inlined!(|from: usize, to: usize| {
        let at = |corner: usize, axis: usize| corners[corner][axis] - 256 * first[axis] - 128;
        let [x, y] = [at(from, 0), at(from, 1)];
        let [run, rise] = [at(to, 0) - x, at(to, 1) - y];
        let open = rise < 0 || rise == 0 && run >= 0;
        let start = y * run - x * rise - i32::from(open);
        (lanes * (256 * rise) + start, -256 * run)
    });
    let [mut a, mut b, mut c] = [edge(0, 1), edge(1, 2), edge(2, 0)];
    let mut bits = [0; SMALL];
    for row in bits.iter_mut().take(rows) {
        *row = (a.0 | b.0 | c.0).simd_ge(0).to_bitmask() as u32;
        (a.0, b.0, c.0) = (a.0 + a.1, b.0 + b.1, c.0 + c.1);
    }
    bits
}

/// A polygon being scanned downwards.
pub struct Scan {
    edges: [Edge; Polygon::MAX_VERTICES],
    len: usize,
    row: i64,
    end: i64,
    width: i64,
    /// The left and the right edge, where there is just one of each, as there is from vertex to vertex of a convex polygon.
    sides: Option<[usize; 2]>,
    /// The row up to which that holds.
    until: i64,
}

impl Scan {
    /// Scans the rows of a picture `width` pixels wide that lie in `rows`.
    pub fn new(polygon: &Polygon, rows: Range<usize>, width: usize) -> Scan {
        let mut scan = Scan {
            edges: [Edge::default(); Polygon::MAX_VERTICES],
            len: 0,
            row: rows.end as i64,
            end: 0,
            width: width as i64,
            sides: None,
            until: i64::MIN,
        };
        let vertices = polygon.vertices();
        for (index, &from) in vertices.iter().enumerate() {
            if let Some(edge) = Edge::new(from, vertices[(index + 1) % vertices.len()]) {
                scan.edges[scan.len] = edge;
                scan.len += 1;
                scan.row = scan.row.min(edge.rows[0]);
                scan.end = scan.end.max(edge.rows[1]);
            }
        }
        scan.row = scan.row.max(rows.start as i64);
        scan.end = scan.end.min(rows.end as i64);
        for edge in &mut scan.edges[..scan.len] {
            let late = scan.row - edge.rows[0];
            if late > 0 {
                edge.skip(late);
            }
        }
        scan
    }

    /// Finds the sides of the present row, and how far they go. Outlined, as [`Scan::span_of_all`] is: else every row of a
    /// large polygon loads all edges for them.
    #[inline(never)]
    fn settle(&mut self) {
        let [mut left, mut right] = [None; 2];
        let mut one_each = true;
        self.until = self.end;
        for (index, edge) in self.edges[..self.len].iter().enumerate() {
            if self.row < edge.rows[0] {
                self.until = self.until.min(edge.rows[0]);
            } else if self.row < edge.rows[1] {
                self.until = self.until.min(edge.rows[1]);
                let side = if edge.left { &mut left } else { &mut right };
                one_each &= side.replace(index).is_none();
            }
        }
        self.sides = match (left, right) {
            (Some(left), Some(right)) if one_each => Some([left, right]),
            _ => None,
        };
    }

    /// The span of the present row, which may be empty, and on to the next.
    #[inline]
    fn span(&mut self) -> (i64, i64) {
        if self.row >= self.until {
            self.settle();
        }
        let (from, to) = if let Some([left, right]) = self.sides {
            (self.edges[left].advance(), self.edges[right].advance())
        } else {
            self.span_of_all()
        };
        self.row += 1;
        (from.clamp(0, self.width), to.clamp(0, self.width))
    }

    /// The span of the present row, whatever edges there are.
    #[inline(never)]
    fn span_of_all(&mut self) -> (i64, i64) {
        let (mut from, mut to) = (i64::MIN, i64::MAX);
        let (mut begins, mut ends) = (false, false);
        for edge in &mut self.edges[..self.len] {
            if edge.rows[0] <= self.row && self.row < edge.rows[1] {
                let boundary = edge.advance();
                if edge.left {
                    from = from.max(boundary);
                    begins = true;
                } else {
                    to = to.min(boundary);
                    ends = true;
                }
            }
        }
        // A polygon that snapping turned over has its sides exchanged: its spans are empty.
        if begins && ends { (from, to) } else { (0, 0) }
    }

    /// The next row that is covered, and its pixels from..to.
    #[inline]
    pub fn next_span(&mut self) -> Option<(usize, usize, usize)> {
        while self.row < self.end {
            let row = self.row as usize;
            let (from, to) = self.span();
            if from < to {
                return Some((row, from as usize, to as usize));
            }
        }
        None
    }
}
