//! Gouraud on a grid of equal cells of a face, each cut into two triangles parallel to the face's diagonal.
//!
//! ```text
//!     (i, j+1)-----------(i+1, j+1)      s, t: the share along the two axes of the face, plus 1/2, times the segments
//!        |            .'  |
//!        |     *   .'     |              the cell holds i <= s <= i + 1 and j <= t <= j + 1
//!        |      .'        |
//!      (i, j)---------(i+1, j)
//! ```
//! A place beside the face, which snapping may show, is clamped to it. Vertices are given by their shares.

use super::geometry::{CuboidGeometry, across, face_axes, signed};
use super::illumination::{Lit, Open, interpolated};
use super::picture::ReferenceCuboid;
use super::real::{Real, RealVector};

/// A triangle of a cell: its vertices, and their barycentric weights at a place.
pub type CellTriangle<R> = ([RealVector<R>; 3], [R; 3]);

/// The triangles of cells that a place of a face may lie on: in floats one; none if its cells are more than 2 x 2. Also the
/// hull of all vertices of those cells.
pub fn touched<R: Real>(
    face: usize,
    share: RealVector<R>,
    segments: usize,
) -> (Vec<CellTriangle<R>>, RealVector<R>) {
    let (axis, outwards) = across(face);
    let axes = face_axes(axis);
    let [zero, half, count] = [R::of(0.0), R::of(0.5), R::of(segments as f64)];
    let place = axes.map(|axis| ((share.0[axis] + half) * count).max(zero).min(count));
    let cells = place.map(|it| it.endpoints().map(|end| (end as usize).min(segments - 1)));
    let at = |along: [R; 2]| {
        let mut share = RealVector([R::of(0.5 * outwards); 3]);
        [share.0[axes[0]], share.0[axes[1]]] = along;
        share
    };
    let line = |number: usize| R::of(2.0 * number as f64 - segments as f64) / (count + count);
    let hull = at(cells.map(|[first, last]| line(first).either(line(last + 1))));
    let mut triangles = Vec::new();
    if cells.iter().any(|[first, last]| last - first > 1) {
        return (triangles, hull);
    }
    let [columns, rows] = cells.map(|[first, last]| first..=last);
    for cell in columns.flat_map(|i| rows.clone().map(move |j| [i, j])) {
        let place = [0, 1].map(|k| {
            let start = R::of(cell[k] as f64);
            place[k].max(start).min(start + R::of(1.0)) - start - half
        });
        let order = signed(outwards, place[0] - place[1]).sign(0.0);
        let may_be = |is_first: &bool| order.is_none_or(|order| order.is_ge() == *is_first);
        triangles.extend([true, false].into_iter().filter(may_be).map(|is_first| {
            let (corners, weights) = CuboidGeometry::weights(face, is_first, at(place));
            let line = |corner: usize, k: usize| line(cell[k] + (corner >> axes[k] & 1));
            let vertices = corners.map(|corner| at([line(corner, 0), line(corner, 1)]));
            (vertices, weights)
        }));
    }
    (triangles, hull)
}

impl<R: Real> ReferenceCuboid<R> {
    /// Gouraud at a point that is given by its weights on a triangle of the face, and by its share.
    ///
    /// An interval may touch several triangles of cells. The exact point lies on one of them, and on a common edge both have
    /// the same levels, so the hull of them all holds the level. Where it touches many, the hull of their vertices does.
    pub fn gouraud(
        &self,
        face: usize,
        corners: [usize; 3],
        weights: [R; 3],
        share: RealVector<R>,
        open: Open,
    ) -> Lit<R> {
        if self.segments == 1 {
            return self.surface.gouraud(face, corners, weights, open);
        }
        let lit = |vertex, i: usize| {
            let place = self.solid.at_share(vertex);
            self.surface.at_vertex(face, &place, open >> i & 1 == 1)
        };
        let (triangles, hull) = touched(face, share, self.segments);
        let all = triangles
            .into_iter()
            .map(|([a, b, c], weights)| interpolated([lit(a, 0), lit(b, 1), lit(c, 2)], weights));
        let either = |one: Lit<R>, other: Lit<R>| Lit {
            levels: one.levels.zip(other.levels, R::either),
            ties: one.ties.max(other.ties),
        };
        all.reduce(either).unwrap_or_else(|| lit(hull, 0))
    }
}

#[cfg(test)]
mod tests {
    use super::super::interval::Interval;
    use super::*;

    #[test]
    fn a_place_is_the_weighted_sum_of_the_vertices_of_its_triangle() {
        for (number, segments) in [2, 3, 7, 101, 256]
            .into_iter()
            .cycle()
            .take(600)
            .enumerate()
        {
            let face = number % 6;
            let (axis, outwards) = across(face);
            // Some lie beside the face.
            let at = |step: f64| 1.1 * ((number as f64 * step).fract() - 0.5);
            let mut share = RealVector([at(0.618_034), at(0.414_214), at(0.732_051)]);
            share.0[axis] = 0.5 * outwards;
            let (triangles, hull) = touched(face, share, segments);
            let [(vertices, weights)] = triangles[..] else {
                panic!("one triangle of a float")
            };
            assert!(weights.iter().all(|weight| (0.0..=1.0).contains(weight)));
            for axis in 0..3 {
                let sum: f64 = (0..3).map(|i| weights[i] * vertices[i].0[axis]).sum();
                let clamped = share.0[axis].clamp(-0.5, 0.5);
                assert!(
                    (sum - clamped).abs() < 1e-12,
                    "{sum} at {share:?} of {segments}"
                );
            }
            // The hull of floats is the first of them.
            assert!((0..3).all(|axis| vertices.iter().any(|it| it.0[axis] == hull.0[axis])));
        }
    }

    #[test]
    fn six_triangles_meet_at_a_vertex_of_the_grid_and_two_at_an_edge() {
        let around = |middle: f64| Interval::new(middle - 1e-9, middle + 1e-9);
        for ([u, v], count) in [
            ([0.25, -0.25], 6),
            ([0.25, -0.1], 2),
            ([0.1, 0.1], 2),
            ([0.1, 0.2], 1),
            ([-0.5, 0.5], 1),
            ([-0.5, -0.5], 2),
        ] {
            let share = RealVector([Interval::of(0.5), around(u), around(v)]);
            assert_eq!(touched(0, share, 4).0.len(), count, "at {u}, {v}");
        }
        let anywhere = Interval::new(-0.4, 0.4);
        let share = RealVector([Interval::of(0.5), anywhere, anywhere]);
        let (triangles, hull) = touched(0, share, 4);
        assert!(triangles.is_empty());
        let ends = hull.0.map(Real::endpoints);
        assert_eq!(ends, [[0.5; 2], [-0.5, 0.5], [-0.5, 0.5]]);
    }
}
