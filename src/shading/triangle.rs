//! A cuboid and lines of sight in; what is interpolated over one of its triangles, as affine functions of the pixel, out.
//!
//! A ray o + t d meets the plane m.P = h of a face where t = (h - m.o) / (m.d), so with the positive factor w = -m.d
//!
//! ```text
//!   w P = w o + (m.o - h) d        w      -d  (towards the eye)        w (L - P)
//! ```
//! are affine on the screen: in perspective o is the eye and d moves, in orthographic projection d stays and o moves. With
//! them everything is that is linear over the face, weighted with w: the barycentric coordinates e_i (their sum is w; they
//! are proportional to those of Olano and Greer 1997, "Triangle scan conversion using 2D homogeneous coordinates",
//! section 3), the normal, the colours. No division is needed, and none of it depends on where the face ends, so
//! clipping changes no value and a face a billion times longer than wide is as exact where it is seen as any other.
//!
//! Rule: all is set up in f64, in the cuboid's own axes, and anchored at the picture's middle.

use glam::{DMat3, DVec3};

use super::affine::{Affine, Scalar};
use crate::components::{Projection, TRIANGLES, unit};

/// A cuboid as rays meet it.
#[derive(Clone, Copy, Debug)]
pub struct Solid<'a> {
    /// Its own axes in world space.
    pub axes: DMat3,
    /// Half its edges, in world units.
    pub half: DVec3,
    /// Its corners, from its centre along the world's axes, in world units.
    pub offsets: &'a [DVec3; 8],
    /// Unit normals at its corners, in world space.
    pub normals: &'a [DVec3; 8],
    /// Levels at its corners.
    pub colors: &'a [DVec3; 8],
}

/// The lines of sight.
#[derive(Clone, Copy, Debug)]
pub struct Rays {
    /// The eye, from the cuboid's centre, in world units.
    pub eye: DVec3,
    /// Right, up and forward: unit vectors in world space.
    pub axes: [DVec3; 3],
    /// From one pixel's centre to the next, in world units: at distance one in perspective.
    pub pitch: f64,
    /// Whether they leave the eye or run in parallel.
    pub projection: Projection,
}

/// A triangle of one cuboid, ready to be cut into patches; all [`Affine`]s are anchored at the picture's middle.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// The barycentric coordinates e_0, e_1, e_2 times w.
    pub(super) weights: Affine,
    /// The point seen, from the cuboid's centre, times w, in world units.
    pub(super) position: Affine,
    /// The interpolated normal times w.
    pub(super) normal: Affine,
    /// Towards the eye, of positive length.
    pub(super) to_eye: Affine,
    /// The interpolated levels times w.
    pub(super) colors: Affine,
    /// w.
    pub(super) share: Scalar,
    /// How much a coordinate e_i w moves from a pixel to the next at most.
    pub(super) pace: f64,
    /// Which vertex is not on the face's diagonal: 1 of the face's first triangle, 2 of its second.
    third: usize,
    /// Its barycentric coordinate times w, which is negative beyond the diagonal.
    pub(super) before_diagonal: Scalar,
    /// The most that the levels of the face's two triangles differ beyond the diagonal, over that coordinate.
    pub(super) crease: f64,
    /// Its vertices.
    pub own: Vertices,
    /// The vertices of the face's other triangle, beyond the diagonal.
    pub other: Vertices,
    /// The eye from the cuboid's centre, in world units; `None` where rays are parallel.
    pub eye: Option<DVec3>,
    /// The unit vector against the view direction.
    pub backward: DVec3,
}

/// What is known at the vertices of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Vertices {
    /// Their places, from the cuboid's centre, in world units.
    pub offsets: [DVec3; 3],
    /// Unit normals.
    pub normals: [DVec3; 3],
    /// Levels.
    pub levels: [DVec3; 3],
    /// Their depths, for interpolation that is linear on the screen; `None` where one is nearer than the near plane.
    pub screen: Option<[f64; 3]>,
}

impl Vertices {
    fn new(number: usize, solid: &Solid, screen: Option<[f64; 3]>) -> Self {
        let corners = TRIANGLES[number].map(usize::from);
        let [offsets, normals, levels] = [solid.offsets, solid.normals, solid.colors]
            .map(|values| corners.map(|corner| values[corner]));
        Vertices {
            offsets,
            normals,
            levels,
            screen,
        }
    }

    /// Unit vectors to a light, whose place is given from the cuboid's centre.
    pub fn to_light(&self, light: DVec3) -> [DVec3; 3] {
        self.offsets.map(|offset| unit(light - offset))
    }
}

/// A face before the rays, in the cuboid's own axes, where its normal m is one of them.
struct Face {
    /// Which of them.
    across: usize,
    /// Its sign.
    outwards: f64,
    /// h, in world units.
    height: f64,
    /// A point of the ray through the picture's middle, from the cuboid's centre.
    origin: DVec3,
    /// That ray's direction, and what neighbouring pixels add to it in perspective, to the origin otherwise.
    ray: Affine,
    projection: Projection,
}

impl Face {
    fn new(number: usize, solid: &Solid, rays: &Rays) -> Self {
        let across = number / 4;
        let own = solid.axes.transpose();
        let [right, up, forward] = rays.axes.map(|axis| own * axis);
        Face {
            across,
            outwards: if (number / 2).is_multiple_of(2) {
                1.0
            } else {
                -1.0
            },
            height: solid.half[across],
            origin: own * rays.eye,
            ray: Affine {
                centre: forward,
                dx: right * rays.pitch,
                dy: up * -rays.pitch,
            },
            projection: rays.projection,
        }
    }

    /// -m.v
    fn against(&self, v: DVec3) -> f64 {
        -self.outwards * v[self.across]
    }

    /// m.o - h, how far the origin is before the face.
    fn before(&self) -> f64 {
        -self.against(self.origin) - self.height
    }

    /// w.
    fn share(&self) -> Scalar {
        match self.projection {
            Projection::Perspective => self.ray.measure(|direction| self.against(direction)),
            Projection::Orthographic => Scalar {
                centre: self.against(self.ray.centre),
                dx: 0.0,
                dy: 0.0,
            },
        }
    }

    /// w P.
    fn place(&self) -> Affine {
        let Affine { centre, dx, dy } = self.ray;
        let share = self.share();
        let mut place = match self.projection {
            Projection::Perspective => self
                .ray
                .map(|direction| direction * self.before() + self.origin * self.against(direction)),
            Projection::Orthographic => {
                let moved = |origin: DVec3| origin * share.centre - centre * self.against(origin);
                Affine {
                    centre: self.origin * share.centre + centre * self.before(),
                    dx: moved(dx),
                    dy: moved(dy),
                }
            }
        };
        // On the face itself by definition, whatever rounding makes of it.
        let height = self.outwards * self.height;
        place.centre[self.across] = height * share.centre;
        place.dx[self.across] = height * share.dx;
        place.dy[self.across] = height * share.dy;
        place
    }

    /// A vector towards the eye.
    fn to_eye(&self) -> Affine {
        match self.projection {
            Projection::Perspective => self.ray.map(|direction| -direction),
            Projection::Orthographic => Affine {
                centre: -self.ray.centre,
                ..Affine::default()
            },
        }
    }

    /// 1 / depth in perspective, minus the depth in orthographic projection.
    fn nearness(&self) -> Scalar {
        let share = self.share();
        match self.projection {
            Projection::Perspective => share.over(self.before()),
            Projection::Orthographic => Scalar {
                centre: -self.before(),
                dx: self.against(self.ray.dx),
                dy: self.against(self.ray.dy),
            }
            .over(share.centre),
        }
    }
}

/// What grows towards the eye and is affine in the pixel's place, all over the plane of triangle `number`: 1 / depth in
/// perspective, minus the depth in orthographic projection, depth in world units along the view direction. Anchored at
/// the picture's middle.
pub fn nearness(number: usize, solid: &Solid, rays: &Rays) -> Scalar {
    Face::new(number, solid, rays).nearness()
}

impl Triangle {
    /// Triangle `number` of a solid, on the side that is seen; `screen` as in [`Vertices`], by number.
    pub fn new(
        number: usize,
        solid: &Solid,
        rays: &Rays,
        screen: impl Fn(usize) -> Option<[f64; 3]>,
    ) -> Self {
        let corners = TRIANGLES[number].map(usize::from);
        let [own, other] =
            [number, number ^ 1].map(|number| Vertices::new(number, solid, screen(number)));
        let face = Face::new(number, solid, rays);
        let (share, place) = (face.share(), face.place());
        // On the face, from -1 to 1 along both of its axes; at a corner the sign of its bit.
        let along = [(face.across + 1) % 3, (face.across + 2) % 3];
        let coordinates = |place: DVec3, share: f64| {
            DVec3::new(
                place[along[0]] / solid.half[along[0]],
                place[along[1]] / solid.half[along[1]],
                share,
            )
        };
        let sign = |corner: usize, axis: usize| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
        let [a, b, c] =
            corners.map(|corner| DVec3::new(sign(corner, along[0]), sign(corner, along[1]), 1.0));
        let to_weights = DMat3::from_cols(a, b, c).inverse();
        let weights = Affine {
            centre: to_weights * coordinates(place.centre, share.centre),
            dx: to_weights * coordinates(place.dx, share.dx),
            dy: to_weights * coordinates(place.dy, share.dy),
        };
        let blend = |values: &[DVec3; 3]| weights.map(|weights| Triangle::blend(weights, values));
        let third = 1 + number % 2;
        let [a, b, c] = own.levels;
        let turned = |vector: &Affine| vector.map(|vector| solid.axes * vector);
        Triangle {
            position: turned(&place),
            normal: blend(&own.normals),
            to_eye: turned(&face.to_eye()),
            colors: blend(&own.levels),
            share,
            pace: (weights.dx.abs() + weights.dy.abs()).max_element(),
            weights,
            before_diagonal: weights.measure(|weights| weights[third]),
            crease: (a + b + c - 2.0 * own.levels[third] - other.levels[3 - third])
                .abs()
                .max_element(),
            third,
            own,
            other,
            eye: match rays.projection {
                Projection::Perspective => Some(rays.eye),
                Projection::Orthographic => None,
            },
            backward: -rays.axes[2],
        }
    }

    /// Unit vectors from the vertices to the eye.
    pub fn to_eye(&self, vertices: &Vertices) -> [DVec3; 3] {
        let eye = |offset| self.eye.map_or(self.backward, |eye| unit(eye - offset));
        vertices.offsets.map(eye)
    }

    /// Barycentric coordinates times w as those of the diagonal's ends and of the third vertex, or these as the former.
    fn arranged(third: usize, [a, b, c]: [f64; 3]) -> [f64; 3] {
        if third == 1 { [a, c, b] } else { [a, b, c] }
    }

    /// The vertices that are interpolated where the barycentric coordinates times w are `weights`, and theirs.
    ///
    /// The fourth corner of the face is A + C - B where A and C are the diagonal's ends and B is the third.
    pub(super) fn interpolated(&self, weights: DVec3) -> (&Vertices, DVec3) {
        let [a, c, b] = Self::arranged(self.third, weights.to_array());
        if b >= 0.0 {
            return (&self.own, weights);
        }
        let weights = Self::arranged(3 - self.third, [a + b, c + b, -b]);
        (&self.other, DVec3::from(weights))
    }

    /// Barycentric coordinates times w, held inside the face along each of its axes; `None` where they are inside.
    pub(super) fn held(&self, weights: DVec3) -> Option<DVec3> {
        let [a, c, b] = Self::arranged(self.third, weights.to_array());
        if a.min(c).min(a + b).min(c + b) >= 0.0 {
            return None;
        }
        // From A to C, along B's side first: the shares of either axis.
        let [first, second] = [c + b, c].map(|share| share.max(0.0).min(a + b + c));
        let held = [a + b + c - first, second, first - second];
        Some(DVec3::from(Self::arranged(self.third, held)))
    }

    /// The vector to a light, whose place is given from the cuboid's centre, times w.
    #[inline(always)]
    pub(super) fn towards(&self, light: DVec3) -> Affine {
        Affine {
            centre: light * self.share.centre - self.position.centre,
            dx: light * self.share.dx - self.position.dx,
            dy: light * self.share.dy - self.position.dy,
        }
    }

    /// A linear combination of three vertex values.
    #[inline(always)]
    pub fn blend(weights: DVec3, values: &[DVec3; 3]) -> DVec3 {
        values[0] * weights.x + values[1] * weights.y + values[2] * weights.z
    }
}
