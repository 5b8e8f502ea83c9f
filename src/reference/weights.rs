//! The weights of the corners of a triangle at a point of a face, on the triangle and on the screen.

use std::cmp::Ordering;

use super::geometry::{CuboidGeometry, across, face_axes};
use super::real::{Real, RealVector};
use crate::components::{Projection, TRIANGLES};

impl<R: Real> CuboidGeometry<R> {
    /// The corners of one triangle of a face and their barycentric weights at a point: their sum is 1, and inside the
    /// triangle each is in 0..=1.
    ///
    /// ```text
    ///     d (-, +)-----------c (+, +)      u, v: the share along the two axes of the face
    ///        |            .'  |
    ///        |     *   .'     |        here a: 1/2 - v     c: 1/2 + u     d: v - u
    ///        |      .'        |
    ///     a (-, -)-----------(+, -)
    /// ```
    pub fn weights(face: usize, is_first: bool, share: RealVector<R>) -> ([usize; 3], [R; 3]) {
        let (axis, outwards) = across(face);
        let [u_axis, v_axis] = face_axes(axis);
        let [u, v] = [share.0[u_axis], share.0[v_axis]];
        let half = R::of(0.5);
        let is_swapped = is_first != (outwards > 0.0);
        let (larger, smaller) = if is_swapped { (v, u) } else { (u, v) };
        let [a, c, third] = [half - larger, half + smaller, larger - smaller];
        let corners = TRIANGLES[2 * face + usize::from(!is_first)].map(usize::from);
        let weights = if is_first {
            [a, third, c]
        } else {
            [a, c, third]
        };
        (corners, weights)
    }

    /// Barycentric weights on the screen from those on the triangle: a za : b zb : c zc with the depths z of the corners.
    ///
    /// A weight is the area opposite its corner, which perspective divides by the depths of the other two corners.
    pub fn weights_on_screen(&self, corners: [usize; 3], weights: [R; 3]) -> [R; 3] {
        if self.projection == Projection::Orthographic {
            return weights;
        }
        let depths = RealVector(corners.map(|corner| self.corner_depth(corner)));
        let [a, b, c] = RealVector(weights).zip(depths, R::mul).0;
        let sum = a + b + c;
        [a / sum, b / sum, c / sum]
    }

    /// The weights of unit vectors: those on the screen, where no corner is nearer than the near plane.
    pub fn shortcut_weights(&self, corners: [usize; 3], weights: [R; 3]) -> [R; 3] {
        let depths = corners.map(|corner| (self.corner_depth(corner) - self.near).sign(0.0));
        if depths.contains(&Some(Ordering::Less)) {
            return weights;
        }
        let on_screen = self.weights_on_screen(corners, weights);
        if depths.contains(&None) {
            return RealVector(on_screen).zip(RealVector(weights), R::either).0;
        }
        on_screen
    }

    /// The depth of a corner along the view direction.
    pub(super) fn corner_depth(&self, corner: usize) -> R {
        (RealVector::exact(self.mesh.corners[corner]) - self.eye).dot(self.forward)
    }
}
