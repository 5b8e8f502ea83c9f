//! The intersection of lines of sight with the faces of a cuboid.
//!
//! ```text
//!              eye O                 d(x, y) = forward + right x + down y, along the cuboid's axes     (perspective)
//!               .                    H = distance of the eye from the face's plane, w = -m.d           m: the face's normal
//!              /|  H                 P - O = d H / w
//!             d |                    side of an edge: the sign of d_k to_i - d_i to_k,
//!            /  |                    `to`: from the eye to the edge, which is perpendicular to the axes i and k
//!       ----P---+---- face
//! ```
//!
//! In orthographic projection d is the view direction, and O moves with the pixel. In both projections the side of an
//! edge is an affine function of the pixel.
//!
//! Points are relative to the eye, so precision does not depend on the size of the cuboid. Two faces compute the side of
//! their common edge from the same numbers with opposite signs. In f64 a line of sight therefore never passes between
//! them and never hits both: a line exactly on the edge hits the face on the right of it, or below it if the edge is
//! horizontal (the top-left rule). An interval within the margin of an edge is undecided.

use std::cmp::Ordering;
use std::ops::Range;

use glam::DVec3;

use super::edge::{self, EdgeFunction};
use super::real::{Real, RealVector};
use super::sight::{Line, Place, Sight, own_axes};
use crate::components::{Mesh, Projection, Transform};

/// The geometry of a cuboid for the lines of sight, in its own axes and world units.
pub struct CuboidGeometry<R> {
    /// The cuboid's axes in world space.
    pub axes: [RealVector<R>; 3],
    pub mesh: Mesh,
    /// The reciprocals of the lengths of its edges.
    per_edge: RealVector<R>,
    /// The eye relative to the cuboid's centre.
    pub eye: RealVector<R>,
    /// Change per pixel right and down of the line's direction in perspective, of its start in orthographic projection.
    pub step: [RealVector<R>; 2],
    pub forward: RealVector<R>,
    pub projection: Projection,
    pub near: R,
    /// The faces that may be front-facing, in the order of [`crate::components::FACES`].
    faces: [Option<FaceEdges<R>>; 6],
    /// The columns and rows of the picture in which it may be visible.
    pub columns: Range<usize>,
    pub rows: Range<usize>,
}

/// The edge functions of a face on the screen.
struct FaceEdges<R> {
    /// Positive inside: the edges at both ends of the next axis, then at both ends of the axis after it.
    edges: [EdgeFunction<R>; 4],
    /// Positive beyond the near plane.
    near: EdgeFunction<R>,
    /// Positive on the first triangle's side.
    diagonal: EdgeFunction<R>,
}

/// The points of a cuboid that a line of sight may show.
pub struct Meeting<R> {
    /// Each with the index of its face in [`crate::components::FACES`]; a single one unless an edge is near.
    pub points: Vec<(usize, FacePoint<R>)>,
    /// Whether the line certainly hits the cuboid.
    pub is_certain: bool,
    /// The depth of the intersection along the view direction, in world units.
    pub depth: R,
}

/// The part of a cuboid that a rectangle of the picture shows.
pub enum Shown {
    /// All of it this face.
    Face(usize),
    Nothing,
    /// An edge may pass through it.
    Undecided,
}

/// The intersection of a line of sight with a face.
#[derive(Clone, Copy)]
pub struct FacePoint<R> {
    /// The point relative to the eye.
    pub point: RealVector<R>,
    /// The coordinates relative to the cuboid's centre, divided by the lengths of its edges: -1/2..=1/2 within the face.
    pub share: RealVector<R>,
    /// o, a unit vector.
    pub to_eye: RealVector<R>,
    /// Whether the point is on the first triangle of the face; undecided if an interval holds the diagonal.
    pub is_on_first: Option<bool>,
}

/// `x` with the sign of `sign`, -1 or 1.
pub fn signed<R: Real>(sign: f64, x: R) -> R {
    if sign < 0.0 { -x } else { x }
}

/// The two axes within a face perpendicular to `axis`.
pub fn face_axes(axis: usize) -> [usize; 2] {
    [(axis + 1) % 3, (axis + 2) % 3]
}

/// The axis perpendicular to a face, and the sign of its outward normal.
pub fn across(face: usize) -> (usize, f64) {
    (face / 2, if face.is_multiple_of(2) { 1.0 } else { -1.0 })
}

/// A world vector in these axes.
fn in_axes<R: Real>(axes: &[RealVector<R>; 3], v: RealVector<R>) -> RealVector<R> {
    RealVector([axes[0].dot(v), axes[1].dot(v), axes[2].dot(v)])
}

/// w: the speed at which the line approaches the plane of a face. The line hits the plane only if it is positive.
pub fn descent<R: Real>(face: usize, line: &Line<R>) -> R {
    let (axis, outwards) = across(face);
    signed(-outwards, line.direction.0[axis])
}

impl<R: Real> CuboidGeometry<R> {
    /// The cuboid of this transform and mesh, which may be visible in these columns and rows.
    pub fn new(
        sight: &Sight<R>,
        transform: &Transform,
        mesh: &Mesh,
        [columns, rows]: [Range<usize>; 2],
    ) -> Self {
        let axes = own_axes(transform);
        let [right, up, forward] = sight.axes.map(|axis| in_axes(&axes, axis));
        let eye = RealVector::exact(sight.eye) - RealVector::exact(transform.position);
        let mut solid = CuboidGeometry {
            axes,
            mesh: *mesh,
            per_edge: RealVector([R::of(0.5); 3]).zip(RealVector::exact(mesh.corners[7]), R::div),
            eye: in_axes(&axes, eye),
            step: [right * sight.pitch, -up * sight.pitch],
            forward,
            projection: sight.projection,
            near: sight.near,
            faces: [const { None }; 6],
            columns,
            rows,
        };
        solid.faces = std::array::from_fn(|face| {
            let is_away = matches!(solid.front(face), Some(Ordering::Less | Ordering::Equal));
            (!is_away).then(|| solid.face(face))
        });
        solid
    }

    /// Half the length of the edges along an axis.
    fn half(&self, axis: usize) -> R {
        R::of(self.mesh.corners[7][axis])
    }

    /// A world vector in the cuboid's axes.
    pub fn own(&self, v: RealVector<R>) -> RealVector<R> {
        in_axes(&self.axes, v)
    }

    /// o at a point given relative to the eye.
    pub fn to_eye(&self, place: RealVector<R>) -> RealVector<R> {
        match self.projection {
            Projection::Perspective => -place.unit(),
            Projection::Orthographic => -self.forward,
        }
    }

    /// The eye's height above the plane of a face.
    pub fn height(&self, face: usize) -> R {
        let (axis, outwards) = across(face);
        signed(outwards, self.eye.0[axis]) - self.half(axis)
    }

    /// `Greater` if a face is front-facing.
    fn front(&self, face: usize) -> Option<Ordering> {
        let (axis, outwards) = across(face);
        match self.projection {
            Projection::Perspective => self.height(face).sign(0.0),
            Projection::Orthographic => (R::of(-outwards) * self.forward.0[axis]).sign(0.0),
        }
    }

    fn face(&self, number: usize) -> FaceEdges<R> {
        let (k, outwards) = across(number);
        let [i, j] = face_axes(k);
        // From the eye to a point of the face: on the edge at this end of `axis`, or in the middle of the face for 0.
        let to = |axis: usize, end: f64| {
            let mut way = -self.eye;
            way.0[k] = self.end(k, outwards);
            way.0[axis] = self.end(axis, end);
            way
        };
        // The distance along `axis` at which a line passes that point, times the line's speed towards the face.
        let passing = |axis: usize, to: RealVector<R>, direction: RealVector<R>| {
            direction.0[k] * to.0[axis] - direction.0[axis] * to.0[k]
        };
        let ends = [(i, -1.0), (i, 1.0), (j, -1.0), (j, 1.0)];
        let edges = ends.map(|(axis, end)| {
            let inwards = R::of(-end * outwards);
            self.edge(to(axis, end), |to, ahead| {
                inwards * passing(axis, to, ahead)
            })
        });
        let sign = R::of(outwards);
        // Ratios, because products of lengths may overflow f64.
        let [half_i, half_j] = [self.half(i), self.half(j)];
        let longer = half_i.max(half_j);
        let diagonal = self.edge(to(i, 0.0), |to, direction| {
            passing(i, to, direction) * (half_j / longer)
                - passing(j, to, direction) * (half_i / longer)
        });
        // The eye's height above the face, minus the line's descent up to the near plane.
        let pace = match self.projection {
            Projection::Perspective => self.near,
            Projection::Orthographic => R::of(1.0),
        };
        let near = EdgeFunction::new(
            self.height(number) + sign * self.forward.0[k] * self.near,
            self.step.map(|step| sign * step.0[k] * pace),
        );
        FaceEdges {
            edges,
            near,
            diagonal,
        }
    }

    /// The edge function of the edge at `to` relative to the eye; `of` is linear in `to` and in the line's direction.
    fn edge(
        &self,
        to: RealVector<R>,
        of: impl Fn(RealVector<R>, RealVector<R>) -> R,
    ) -> EdgeFunction<R> {
        let steps = self.step.map(|step| match self.projection {
            Projection::Perspective => of(to, step),
            Projection::Orthographic => of(-step, self.forward),
        });
        EdgeFunction::new(of(to, self.forward), steps)
    }

    /// The line of sight through a place, in the cuboid's axes.
    pub fn line(&self, place: Place) -> Line<R> {
        let [right, down] = place.offset;
        let moved = self.step[0] * R::of(right) + self.step[1] * R::of(down);
        let (start, direction) = match self.projection {
            Projection::Perspective => (RealVector::exact(DVec3::ZERO), self.forward + moved),
            Projection::Orthographic => (moved, self.forward),
        };
        Line {
            start,
            direction,
            place,
        }
    }

    /// The points that the line may show beyond the near plane; `None` if it certainly misses the cuboid.
    pub fn meet(&self, line: &Line<R>) -> Option<Meeting<R>> {
        let inside = |(number, face): (usize, &FaceEdges<R>)| {
            let edges = face.edges.iter().chain([&face.near]);
            (number, edge::inside(edges, line.place))
        };
        let is_near = |(_, inside): &(_, Option<bool>)| *inside != Some(false);
        let hit: Vec<_> = self.faces().map(inside).filter(is_near).collect();
        if let [(number, Some(true))] = hit[..] {
            return Some(Meeting {
                points: vec![(number, self.place(number, line))],
                is_certain: true,
                depth: self.depth(number, line),
            });
        }
        // The centre may lie just outside a face, whose plane the line meets far beyond it, or not at all.
        let beside = |&(number, _): &(usize, _)| {
            let places = self.beside(number, line).into_iter();
            places.map(move |place| (number, place))
        };
        let points: Vec<_> = hit.iter().flat_map(beside).collect();
        // `beside` finds a point of each face, so there is a depth if a face is hit.
        let depths = points
            .iter()
            .map(|(_, place)| place.point.dot(self.forward));
        Some(Meeting {
            depth: depths.reduce(R::either)?,
            points,
            is_certain: hit.iter().any(|(_, inside)| *inside == Some(true)),
        })
    }

    /// The part of the cuboid that a rectangle of the picture with these corners shows. Edge functions are affine, so one that
    /// has the same sign at all corners has it in all of the rectangle.
    pub fn shown(&self, corners: &[Place; 4]) -> Shown {
        let mut shown = Shown::Nothing;
        for (number, face) in self.faces() {
            let edges = || face.edges.iter().chain([&face.near]);
            let is_all = |edge: &EdgeFunction<R>, side| {
                corners
                    .iter()
                    .all(|corner| edge.side(*corner) == Some(side))
            };
            if edges().all(|edge| is_all(edge, true)) {
                shown = Shown::Face(number);
            } else if !edges().any(|edge| is_all(edge, false)) {
                return Shown::Undecided;
            }
        }
        shown
    }

    /// The edges of the faces, those at the near plane too.
    pub fn edges(&self) -> impl Iterator<Item = &EdgeFunction<R>> {
        self.faces()
            .flat_map(|(_, face)| face.edges.iter().chain([&face.near]))
    }

    /// The faces that may be front-facing, with their indices.
    fn faces(&self) -> impl Iterator<Item = (usize, &FaceEdges<R>)> {
        let faces = self.faces.iter().enumerate();
        faces.filter_map(|(number, face)| Some((number, face.as_ref()?)))
    }

    /// The depth along the view direction at which the line hits the plane of a face: H / w.
    fn depth(&self, face: usize, line: &Line<R>) -> R {
        let (axis, outwards) = across(face);
        let height = self.height(face) + signed(outwards, line.start.0[axis]);
        height / descent(face, line)
    }

    /// The coordinate of the cuboid's end along an axis, on the side of this sign (0 for its middle), relative to the eye.
    pub fn end(&self, axis: usize, sign: f64) -> R {
        R::of(sign * self.mesh.corners[7][axis]) - self.eye.0[axis]
    }

    /// The intersection of the line with the plane of a face.
    pub fn place(&self, number: usize, line: &Line<R>) -> FacePoint<R> {
        let (axis, outwards) = across(number);
        let mut point = line.start + line.direction * self.depth(number, line);
        point.0[axis] = self.end(axis, outwards);
        let face = self.faces[number].as_ref();
        FacePoint {
            point,
            share: self.share(number, point),
            to_eye: -line.direction.unit(),
            is_on_first: face.and_then(|face| {
                face.diagonal.side(Place {
                    margin: 0.0,
                    ..line.place
                })
            }),
        }
    }

    /// [`FacePoint::share`] of a point of a face, which is given relative to the eye.
    pub fn share(&self, face: usize, point: RealVector<R>) -> RealVector<R> {
        let (axis, outwards) = across(face);
        let mut share = (self.eye + point).zip(self.per_edge, R::mul);
        share.0[axis] = R::of(0.5 * outwards);
        share
    }

    /// [`FacePoint::share`] of a corner.
    pub fn corner_share(&self, corner: usize) -> RealVector<R> {
        RealVector::exact(self.mesh.corners[corner].signum() / 2.0)
    }

    /// The point with this share.
    pub fn at_share(&self, share: RealVector<R>) -> FacePoint<R> {
        let half = RealVector::exact(self.mesh.corners[7]);
        let point = (share + share).zip(half, R::mul) - self.eye;
        FacePoint {
            point,
            share,
            to_eye: self.to_eye(point),
            is_on_first: None,
        }
    }
}

#[cfg(test)]
mod tests;
