//! Pixel by pixel in f64: what is left where f32 cannot keep its promise, and for slivers.
//!
//! Rule: a sliver's weights are held inside its face, so no colour leaves what its vertices span.

use glam::DVec3;

use super::display::Exact;
use super::patch::{Patch, Point};
use super::triangle::Triangle;
use super::{Coverage, Sink, TILE};

/// Shades the covered pixels of a tile; `levels` makes a colour of the point a pixel shows.
pub fn shade(
    triangle: &Triangle,
    patch: &Patch,
    coverage: &Coverage,
    sink: &mut impl Sink,
    levels: impl Fn(&Point) -> DVec3,
) {
    let mut line = [[0.0; TILE]; 3];
    for (row, &(from, to)) in coverage.spans.iter().enumerate() {
        if from < to {
            for lane in from..to {
                let (x, y) = (f64::from(lane) - patch.lane, row as f64 - patch.row);
                let color = levels(&patch.point(triangle, x, y)).as_vec3().to_array();
                for (line, level) in line.iter_mut().zip(color) {
                    line[usize::from(lane)] = level;
                }
            }
            sink.take(row, &Exact(&line));
        }
    }
}
