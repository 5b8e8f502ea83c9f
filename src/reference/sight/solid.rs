//! A cuboid and lines of sight in; which of its faces a line meets, where and how far away out.
//!
//! ```text
//!              eye O                 d(x, y) = forward + right x + down y, along the cuboid's axes     (perspective)
//!               .                    H = distance of the eye from the face's plane, w = -m.d           m: the face's normal
//!              /|  H                 P - O = d H / w
//!             d |                    side of an edge: the sign of d_k to_i - d_i to_k,
//!            /  |                    where `to` goes from the eye to the edge, which lies across the axes i and k
//!       ----P---+---- face
//! ```
//!
//! In orthographic projection d is the view direction, and O moves with the pixel. Either way a side of an edge is an
//! affine function of the pixel.
//!
//! Rule: places are relative to the eye, so a corner of a cuboid of any size is as sure as any other. Two faces compute
//! the side of their common edge from the same numbers with opposite sign, so in f64 a line of sight passes between them
//! nowhere and never enters both: one exactly on the edge belongs to what is to the right of it, or below it if the edge
//! is level (the top-left rule). An interval within [`edge::EDGE`] of an edge is undecided.

use std::cmp::Ordering;
use std::ops::Range;

use glam::DVec3;

use super::super::real::Real;
use super::super::vector::Vector;
use super::edge::{self, Edge};
use super::{Line, Sight, own_axes};
use crate::components::{Mesh, Projection, TRIANGLES, Transform};

/// A cuboid before these lines of sight; everything along the cuboid's axes, in world units.
pub struct Solid<R> {
    /// The cuboid's axes in world space.
    pub axes: [Vector<R>; 3],
    /// Half the lengths of its edges.
    half: [f64; 3],
    /// The reciprocals of the lengths of its edges.
    per_edge: [R; 3],
    /// The eye from the centre.
    pub eye: Vector<R>,
    /// What one pixel right and one pixel down add to the line's direction in perspective, to its start if orthographic.
    step: [Vector<R>; 2],
    forward: Vector<R>,
    projection: Projection,
    near: R,
    /// The faces that look towards the eye, or may do so, in the order of [`crate::components::FACES`].
    faces: [Option<Face<R>>; 6],
    /// The only columns and rows of the picture it can be seen in.
    pub columns: Range<usize>,
    pub rows: Range<usize>,
}

/// A face and what bounds it on the screen.
struct Face<R> {
    /// Positive inside: the edges at either end of the next axis, and of the one after it.
    edges: [Edge<R>; 4],
    /// Whether what lies beyond the edge is certainly another face in sight.
    is_shared: [bool; 4],
    /// Positive beyond the near plane.
    near: Edge<R>,
    /// Positive on the first triangle's side.
    diagonal: Edge<R>,
}

/// Where a line of sight meets a cuboid.
#[derive(Clone, Copy)]
pub struct Meeting {
    /// The faces it may meet, one bit each; one face, unless an edge is near.
    faces: u8,
    /// Whether it certainly meets one of them.
    pub is_certain: bool,
}

/// The point of a face that a line of sight meets.
#[derive(Clone, Copy)]
pub struct Place<R> {
    /// The point from the eye.
    pub point: Vector<R>,
    /// The coordinates from the cuboid's centre over the lengths of its edges: -1/2..=1/2 within the face.
    pub share: Vector<R>,
    /// o.
    pub to_eye: Vector<R>,
    /// Whether it is on the first triangle of the face, not on the second; an interval that holds the diagonal is undecided.
    pub is_on_first: Option<bool>,
}

impl Meeting {
    /// Whether no edge is near.
    pub fn well_conditioned(self) -> bool {
        self.is_certain && self.faces.is_power_of_two()
    }

    /// The faces that may be met, by their place in [`crate::components::FACES`].
    pub fn faces(&self) -> impl Iterator<Item = usize> {
        let faces = self.faces;
        (0..6).filter(move |face| faces >> face & 1 == 1)
    }
}

/// `x` with the sign of `sign`, -1 or 1.
fn signed<R: Real>(sign: f64, x: R) -> R {
    if sign < 0.0 { -x } else { x }
}

/// The axes along the face across `axis`.
fn along(axis: usize) -> [usize; 2] {
    [(axis + 1) % 3, (axis + 2) % 3]
}

/// The axis across a face, and the sign of its outer side.
fn across(face: usize) -> (usize, f64) {
    (face / 2, if face.is_multiple_of(2) { 1.0 } else { -1.0 })
}

/// w: how fast the line approaches the plane of a face, which it never meets unless this is positive.
fn descent<R: Real>(face: usize, line: &Line<R>) -> R {
    let (axis, outwards) = across(face);
    signed(-outwards, line.along.0[axis])
}

impl<R: Real> Solid<R> {
    /// The cuboid of this place and shape, to be looked for in these columns and rows.
    pub fn new(
        sight: &Sight<R>,
        transform: &Transform,
        mesh: &Mesh,
        [columns, rows]: [Range<usize>; 2],
    ) -> Self {
        let axes = own_axes(transform);
        let own = |v: Vector<R>| Vector(axes.map(|axis| axis.dot(v)));
        let [right, up, forward] = sight.axes.map(own);
        let half = mesh.corners[7].to_array();
        let mut solid = Solid {
            axes,
            half,
            per_edge: half.map(|half| R::of(0.5) / R::of(half)),
            eye: own(Vector::exact(sight.eye) - Vector::exact(transform.position)),
            step: [right * sight.pitch, -up * sight.pitch],
            forward,
            projection: sight.projection,
            near: sight.near,
            faces: [const { None }; 6],
            columns,
            rows,
        };
        let fronts: [Option<Ordering>; 6] = std::array::from_fn(|face| solid.front(face));
        solid.faces = std::array::from_fn(|face| {
            let is_away = matches!(fronts[face], Some(Ordering::Less | Ordering::Equal));
            (!is_away).then(|| solid.face(face, fronts))
        });
        solid
    }

    /// A world vector along the cuboid's axes.
    pub fn own(&self, v: Vector<R>) -> Vector<R> {
        Vector(self.axes.map(|axis| axis.dot(v)))
    }

    /// o at a place from the eye.
    pub fn to_eye(&self, place: Vector<R>) -> Vector<R> {
        match self.projection {
            Projection::Perspective => -place.unit(),
            Projection::Orthographic => -self.forward,
        }
    }

    /// The eye's height above the plane of a face.
    fn height(&self, face: usize) -> R {
        let (axis, outwards) = across(face);
        signed(outwards, self.eye.0[axis]) - R::of(self.half[axis])
    }

    /// Greater: a face looks towards the eye.
    fn front(&self, face: usize) -> Option<Ordering> {
        let (axis, outwards) = across(face);
        match self.projection {
            Projection::Perspective => self.height(face).sign(0.0),
            Projection::Orthographic => (R::of(-outwards) * self.forward.0[axis]).sign(0.0),
        }
    }

    fn face(&self, number: usize, fronts: [Option<Ordering>; 6]) -> Face<R> {
        let (k, outwards) = across(number);
        let [i, j] = along(k);
        // The way from the eye to a place on the face: where an edge across `axis` is, or the middle.
        let to = |axis: usize, end: f64| {
            let mut way = -self.eye;
            way.0[k] = self.end(k, outwards);
            way.0[axis] = self.end(axis, end);
            way
        };
        // How far a line passes that place along `axis`, times its pace towards the face.
        let passing = |axis: usize, to: Vector<R>, along: Vector<R>| {
            along.0[k] * to.0[axis] - along.0[axis] * to.0[k]
        };
        let ends = [(i, -1.0), (i, 1.0), (j, -1.0), (j, 1.0)];
        let edges = ends.map(|(axis, end)| {
            let sign = R::of(-end * outwards);
            self.edge(to(axis, end), |to, along| sign * passing(axis, to, along))
        });
        let is_shared = ends.map(|(axis, end)| {
            fronts[2 * axis + usize::from(end < 0.0)] == Some(Ordering::Greater)
        });
        let sign = R::of(outwards);
        // Proportions, because products of lengths leave the range of f64.
        let [half_i, half_j] = [i, j].map(|axis| R::of(self.half[axis]));
        let longer = half_i.max(half_j);
        let diagonal = self.edge(to(i, 0.0), |to, along| {
            let [of_i, of_j] = [i, j].map(|axis| passing(axis, to, along));
            of_i * (half_j / longer) - of_j * (half_i / longer)
        });
        // The height over the face, less what the line loses of it up to the near plane.
        let pace = match self.projection {
            Projection::Perspective => self.near,
            Projection::Orthographic => R::of(1.0),
        };
        let near = Edge::new(
            self.height(number) + sign * self.forward.0[k] * self.near,
            self.step.map(|step| sign * step.0[k] * pace),
        );
        Face {
            edges,
            is_shared,
            near,
            diagonal,
        }
    }

    /// The edge at a place `to` from the eye; `of` is linear both in the way to that place and in the line's direction.
    fn edge(&self, to: Vector<R>, of: impl Fn(Vector<R>, Vector<R>) -> R) -> Edge<R> {
        let steps = self.step.map(|step| match self.projection {
            Projection::Perspective => of(to, step),
            Projection::Orthographic => of(-step, self.forward),
        });
        Edge::new(of(to, self.forward), steps)
    }

    /// The line of sight through the centre of pixel (`x`, `y`).
    pub fn line(&self, sight: &Sight<R>, x: usize, y: usize) -> Line<R> {
        let [width, height] = sight.size.map(|pixels| pixels as f64 / 2.0);
        let pixel = [x as f64 + 0.5 - width, y as f64 + 0.5 - height];
        let moved = self.step[0] * R::of(pixel[0]) + self.step[1] * R::of(pixel[1]);
        let (offset, along) = match self.projection {
            Projection::Perspective => (Vector::exact(DVec3::ZERO), self.forward + moved),
            Projection::Orthographic => (moved, self.forward),
        };
        Line {
            offset,
            along,
            pixel,
        }
    }

    /// Where the line meets the cuboid beyond the near plane; `None`: certainly nowhere.
    pub fn meet(&self, line: &Line<R>) -> Option<Meeting> {
        let mut faces = 0;
        let mut is_certain = false;
        for (number, face) in self.faces() {
            let edges = face.edges.iter().chain([&face.near]);
            let inside = edge::inside(edges, line.pixel);
            if inside != Some(false) {
                faces |= 1 << number;
                is_certain |= inside == Some(true);
            }
        }
        let mut meeting = Meeting { faces, is_certain };
        if faces > 0 && !is_certain {
            // Near an edge between two faces one of them is met if the line passes within the outline of both.
            let outline = self.faces().flat_map(|(_, face)| {
                let edges = face.edges.iter().zip(face.is_shared);
                edges.filter_map(|(edge, is_shared)| (!is_shared).then_some(edge))
            });
            let near = meeting
                .faces()
                .filter_map(|number| self.faces[number].as_ref());
            let edges = outline.chain(near.map(|face| &face.near));
            let inside = edge::inside(edges, line.pixel);
            meeting.is_certain = inside == Some(true);
        }
        (faces > 0).then_some(meeting)
    }

    /// How far away the line meets the cuboid, along the view direction, in world units.
    pub fn depth(&self, meeting: Meeting, line: &Line<R>) -> Option<R> {
        let depths = meeting.faces().map(|face| self.depth_of_face(face, line));
        depths.reduce(R::either)
    }

    /// The faces that may be seen.
    fn faces(&self) -> impl Iterator<Item = (usize, &Face<R>)> {
        let faces = self.faces.iter().enumerate();
        faces.filter_map(|(number, face)| Some((number, face.as_ref()?)))
    }

    /// How far away the line meets the plane of a face, along the view direction: H / w.
    fn depth_of_face(&self, face: usize, line: &Line<R>) -> R {
        let (axis, outwards) = across(face);
        let height = self.height(face) + signed(outwards, line.offset.0[axis]);
        height / descent(face, line)
    }

    /// From the eye to where the cuboid ends along an axis, on the side of this sign.
    fn end(&self, axis: usize, sign: f64) -> R {
        R::of(sign * self.half[axis]) - self.eye.0[axis]
    }

    /// Where the line meets the plane of a face.
    pub fn place(&self, number: usize, line: &Line<R>) -> Place<R> {
        let (axis, outwards) = across(number);
        let mut point = line.offset + line.along * self.depth_of_face(number, line);
        point.0[axis] = self.end(axis, outwards);
        let face = self.faces[number].as_ref();
        Place {
            point,
            share: self.share(number, point),
            to_eye: -line.along.unit(),
            is_on_first: face.and_then(|face| face.diagonal.side(line.pixel, 0.0)),
        }
    }

    /// Where a line that passes beside a face may see it: on its plane, and where that is held inside the face. A line beyond
    /// the plane's horizon sees the end of the face that is turned into it.
    pub fn beside(&self, face: usize, line: &Line<R>) -> Vec<Place<R>> {
        let turned = self.turned(face, line);
        let mut places = match descent(face, line).sign(0.0) {
            Some(Ordering::Greater) => {
                let place = self.place(face, line);
                vec![place, self.held(face, place.point)]
            }
            Some(_) if !turned.is_empty() => Vec::new(),
            _ => {
                let [from, to] = self.ends();
                vec![self.held(face, from.zip(to, R::either))]
            }
        };
        places.extend(turned);
        places
    }

    /// Where the line sees the far end of the face if it is turned towards the plane, by no more pixels than edges are near.
    ///
    /// It then moves over the plane from afar towards the point under the eye; of the two ends that it reaches, the first is
    /// the face's.
    fn turned(&self, face: usize, line: &Line<R>) -> Vec<Place<R>> {
        if self.projection == Projection::Orthographic {
            return Vec::new();
        }
        let (across, outwards) = across(face);
        let descent = descent(face, line);
        let steps = self.step.map(|step| step.0[across]);
        let near = Vector([steps[0], steps[1], R::of(0.0)])
            .length_squared()
            .sqrt();
        let end = |axis: usize| {
            let ahead = line.along.0[axis];
            let end = self.end(
                axis,
                if ahead.sign(0.0)? == Ordering::Less {
                    -1.0
                } else {
                    1.0
                },
            );
            // One over how far it is to the end, times the length of the line's direction.
            let pace = ahead / end;
            let turn = self.height(face) * pace - descent;
            let is_ahead = pace.sign(0.0)? == Ordering::Greater;
            let may_be = |number: R| number.sign(0.0) != Some(Ordering::Less);
            (is_ahead && may_be(turn) && may_be(R::of(edge::EDGE) * near - turn))
                .then_some((axis, end, pace))
        };
        let ends: Vec<_> = along(across).into_iter().filter_map(end).collect();
        let is_first = |(_, _, pace): &&(usize, R, R)| {
            let mut others = ends.iter();
            others.all(|(_, _, other)| (*pace - *other).sign(0.0) != Some(Ordering::Less))
        };
        let place = |&(axis, end, pace): &(usize, R, R)| {
            let mut point = line.along.zip(Vector([pace; 3]), R::div);
            point.0[across] = self.end(across, outwards);
            point.0[axis] = end;
            self.held(face, point)
        };
        ends.iter().filter(is_first).map(place).collect()
    }

    /// From the eye to where the cuboid ends, along all axes.
    fn ends(&self) -> [Vector<R>; 2] {
        [-1.0, 1.0].map(|sign| Vector([0, 1, 2].map(|axis| self.end(axis, sign))))
    }

    /// A point held inside the face: each coordinate along it stops at the edge.
    fn held(&self, face: usize, point: Vector<R>) -> Place<R> {
        let (axis, outwards) = across(face);
        let [from, to] = self.ends();
        let point = point.zip(from, R::max).zip(to, R::min);
        let share = self.share(face, point);
        let [u, v] = along(axis).map(|axis| share.0[axis]);
        let order = signed(outwards, u - v).sign(0.0);
        Place {
            point,
            share,
            to_eye: self.to_eye(point),
            is_on_first: order.map(|order| order != Ordering::Less),
        }
    }

    /// The coordinates of a point of a face, given from the eye, as shares of the edges.
    fn share(&self, face: usize, point: Vector<R>) -> Vector<R> {
        let (axis, outwards) = across(face);
        let mut share = (self.eye + point).zip(Vector(self.per_edge), R::mul);
        share.0[axis] = R::of(0.5 * outwards);
        share
    }

    /// The corners of one of a face's two triangles, and their weights at a place: together 1, each 0..=1 within it.
    ///
    /// ```text
    ///     d (-, +)-----------c (+, +)      u, v: the share along the two axes of the face
    ///        |            .'  |
    ///        |     *   .'     |        here a: 1/2 - v     c: 1/2 + u     d: v - u
    ///        |      .'        |
    ///     a (-, -)-----------(+, -)
    /// ```
    pub fn weights(face: usize, is_first: bool, place: &Place<R>) -> ([usize; 3], [R; 3]) {
        let (axis, outwards) = across(face);
        let [u, v] = along(axis).map(|axis| place.share.0[axis]);
        let half = R::of(0.5);
        let (larger, smaller) = if is_first == (outwards > 0.0) {
            (u, v)
        } else {
            (v, u)
        };
        let [a, c, third] = [half - larger, half + smaller, larger - smaller];
        let corners = TRIANGLES[2 * face + usize::from(!is_first)].map(usize::from);
        (
            corners,
            if is_first {
                [a, third, c]
            } else {
                [a, c, third]
            },
        )
    }

    /// Distances of corners along the view direction, where they matter: in perspective.
    pub fn depths(&self, corners: [usize; 3], mesh: &Mesh) -> Option<[R; 3]> {
        let depth =
            |corner: usize| (Vector::exact(mesh.corners[corner]) - self.eye).dot(self.forward);
        (self.projection == Projection::Perspective).then(|| corners.map(depth))
    }

    /// Whether no depth is certainly nearer than the near plane.
    pub fn are_beyond_near(&self, depths: &[R; 3]) -> bool {
        let is_beyond = |depth: &R| (*depth - self.near).sign(0.0) != Some(Ordering::Less);
        depths.iter().all(is_beyond)
    }
}
