//! One linear function for a cell of a grid, or for several cells whose levels it keeps within a tolerance.

use glam::DVec3;

use super::{Cells, Grid};
use crate::shading::simd::two;

/// A cell, or several with one linear function instead of theirs.
#[derive(Clone, Copy, Debug)]
pub struct LinearCells {
    pub cells: Cells,
    /// The levels at its corners, in the order of the face's.
    pub levels: [DVec3; 4],
    /// Whether its two triangles differ.
    pub is_cut: bool,
    /// The largest error of the function.
    pub error: f64,
    /// The largest change of a level for one cell along u and one along v; 0 for a single cell.
    pub slope: f64,
}

/// Cells with more points than this are not replaced by one function: to look up each pixel's cell costs less.
const MOST_POINTS: usize = 256;

impl Grid<'_> {
    /// The cell in which all these places of the grid lie, from the least to the largest along each axis; `corners` are (u, v) of
    /// the face's corners. If there are several cells, a linear function for all of them that errs by at most `tolerance`.
    pub fn patch(
        &self,
        [least, most]: [[f64; 2]; 2],
        corners: &[[f64; 2]; 4],
        tolerance: f64,
    ) -> Option<LinearCells> {
        if self.levels.is_empty() {
            return None;
        }
        let first = self.cell(least);
        let size = two!(|axis| {
            let last = self.face.cells.first[axis] + self.face.cells.size[axis];
            (most[axis].max(0.0).ceil() as usize).clamp(first[axis] + 1, last) - first[axis]
        });
        let level =
            |i: usize, j: usize| DVec3::from(self.levels[self.point([first[0] + i, first[1] + j])]);
        let cells = Cells { first, size };
        let is_inside = |axis: usize| 0.0 <= least[axis] && most[axis] <= self.face.segments as f64;
        if size == [1, 1] && is_inside(0) && is_inside(1) {
            let at = |[u, v]: [f64; 2]| level(usize::from(u > 0.0), usize::from(v > 0.0));
            return Some(LinearCells {
                cells,
                levels: corners.map(at),
                is_cut: true,
                error: 0.0,
                slope: 0.0,
            });
        }
        if tolerance <= 0.0 || (size[0] + 1) * (size[1] + 1) > MOST_POINTS {
            return None;
        }
        // The slopes are those between the sides. The largest error is at a point, since levels and function are linear between.
        let [i, j] = size;
        let [a, b, c, d] = [level(0, 0), level(i, 0), level(i, j), level(0, j)];
        let right = (b - a + (c - d)) / (2.0 * i as f64);
        let up = (d - a + (c - b)) / (2.0 * j as f64);
        let (mut lowest, mut highest) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for row in 0..=j {
            let left = self.point([first[0], first[1] + row]);
            let below = up * row as f64;
            for (column, levels) in self.levels[left..=left + i].iter().enumerate() {
                let rest = DVec3::from(*levels) - right * column as f64 - below;
                (lowest, highest) = (lowest.min(rest), highest.max(rest));
            }
        }
        let (start, error) = (
            (lowest + highest) / 2.0,
            ((highest - lowest) / 2.0).max_element(),
        );
        let at = |[u, v]: [f64; 2]| {
            let end = |u: f64, size: usize| if u > 0.0 { size as f64 } else { 0.0 };
            start + right * end(u, i) + up * end(v, j)
        };
        (error <= tolerance).then_some(LinearCells {
            cells,
            levels: corners.map(at),
            is_cut: false,
            error,
            slope: right.abs().max_element() + up.abs().max_element(),
        })
    }
}
