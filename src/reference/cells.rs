//! The cells of a face under Gouraud: a grid of equal ones, each cut into two triangles parallel to the face's diagonal.
//!
//! ```text
//!     (i, j+1)-----------(i+1, j+1)      s, t: the share along the two axes of the face, plus 1/2, times the segments
//!        |            .'  |
//!        |     *   .'     |              a cell holds i <= s <= i + 1 and j <= t <= j + 1
//!        |      .'        |
//!      (i, j)---------(i+1, j)
//! ```
//! A place beside the face, which snapping may show, is clamped to it. Vertices are given by their shares.

use std::ops::RangeInclusive;

use super::geometry::{CuboidGeometry, across, face_axes, signed};
use super::real::{Real, RealVector};

/// A triangle of a cell: its vertices, and their barycentric weights at a place.
pub type CellTriangle<R> = ([RealVector<R>; 3], [R; 3]);

/// The most cells along an axis that are told apart.
const FEW: usize = 2;

/// s and t of a place of a face, clamped to the face, and the cells that it may lie in.
fn cells<R: Real>(
    face: usize,
    share: RealVector<R>,
    segments: usize,
) -> [(R, RangeInclusive<usize>); 2] {
    let count = R::of(segments as f64);
    face_axes(across(face).0).map(|axis| {
        let place = (share.0[axis] + R::of(0.5)) * count;
        let place = place.max(R::of(0.0)).min(count);
        let [first, last] = place
            .endpoints()
            .map(|end| (end as usize).min(segments - 1));
        (place, first..=last)
    })
}

/// The share of a point of a face whose coordinates along the face's axes are these.
fn shared<R: Real>(face: usize, [u, v]: [R; 2]) -> RealVector<R> {
    let (axis, outwards) = across(face);
    let mut share = RealVector([R::of(0.5 * outwards); 3]);
    let [i, j] = face_axes(axis);
    (share.0[i], share.0[j]) = (u, v);
    share
}

/// The coordinate of a line of the grid.
fn line<R: Real>(number: usize, segments: usize) -> R {
    R::of(2.0 * number as f64 - segments as f64) / R::of(2.0 * segments as f64)
}

/// The triangles of cells that a place with this share may lie on: in floats one; none if there are many.
pub fn touched<R: Real>(
    face: usize,
    share: RealVector<R>,
    segments: usize,
) -> Vec<CellTriangle<R>> {
    let [(s, columns), (t, rows)] = cells(face, share, segments);
    let mut triangles = Vec::new();
    if columns.clone().count().max(rows.clone().count()) > FEW {
        return triangles;
    }
    for cell in columns.flat_map(|i| rows.clone().map(move |j| [i, j])) {
        let within = |place: R, cell: usize| {
            let start = R::of(cell as f64);
            place.max(start).min(start + R::of(1.0)) - start - R::of(0.5)
        };
        let place = [within(s, cell[0]), within(t, cell[1])];
        let (axis, outwards) = across(face);
        let order = signed(outwards, place[0] - place[1]).sign(0.0);
        let may_be = |is_first: &bool| order.is_none_or(|order| order.is_ge() == *is_first);
        for is_first in [true, false].into_iter().filter(may_be) {
            let place = shared(face, place);
            let (corners, weights) = CuboidGeometry::weights(face, is_first, place);
            let vertex = |corner: usize| {
                let axes = face_axes(axis);
                shared(
                    face,
                    [0, 1].map(|i| line(cell[i] + (corner >> axes[i] & 1), segments)),
                )
            };
            triangles.push((corners.map(vertex), weights));
        }
    }
    triangles
}

/// The hull of all vertices of the cells that a place with this share may lie in.
pub fn around<R: Real>(face: usize, share: RealVector<R>, segments: usize) -> RealVector<R> {
    let hull = cells(face, share, segments).map(|(_, cells)| {
        let [from, to] = [*cells.start(), cells.end() + 1];
        line::<R>(from, segments).either(line(to, segments))
    });
    shared(face, hull)
}
