//! One tile of one triangle: everything that is interpolated, as affine functions of the pixel.
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
//! Rule: directions need no division at all: N, L - P and O - P are the true vectors times one positive factor a pixel,
//! and the shader normalises them.

use glam::{DMat3, DVec3};

use super::TILE;
use crate::components::{Projection, TRIANGLES, unit};

/// A vector that is affine in the pixel's place: `centre + dx * x + dy * y`, x and y in pixels from the tile's middle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Affine {
    /// At the middle.
    pub centre: DVec3,
    /// Per pixel to the right.
    pub dx: DVec3,
    /// Per pixel down.
    pub dy: DVec3,
}

impl Affine {
    /// The value `x` pixels right and `y` pixels down of the middle.
    #[inline(always)]
    pub fn at(&self, x: f64, y: f64) -> DVec3 {
        self.centre + self.dx * x + self.dy * y
    }

    /// Applies a linear form.
    fn measure(&self, form: impl Fn(DVec3) -> f64) -> Scalar {
        Scalar {
            centre: form(self.centre),
            dx: form(self.dx),
            dy: form(self.dy),
        }
    }

    /// Applies a linear map.
    #[inline(always)]
    #[must_use]
    pub fn map(&self, f: impl Fn(DVec3) -> DVec3) -> Affine {
        Affine {
            centre: f(self.centre),
            dx: f(self.dx),
            dy: f(self.dy),
        }
    }

    /// The difference.
    #[inline(always)]
    #[must_use]
    pub fn minus(&self, other: &Affine) -> Affine {
        Affine {
            centre: self.centre - other.centre,
            dx: self.dx - other.dx,
            dy: self.dy - other.dy,
        }
    }

    /// How far the value moves within `half` pixels of the middle, over its length there: below 1 the vector cannot
    /// vanish on the tile. Infinite or not a number where the middle itself vanishes.
    #[inline(always)]
    pub fn swing(&self, half: [f64; 2]) -> f64 {
        let reach = self.dx.length() * half[0] + self.dy.length() * half[1];
        reach / self.centre.length()
    }

    /// One row in f32, `y` pixels below the middle: what stands at the middle column, and the step to the right.
    #[inline(always)]
    pub fn row(&self, y: f64) -> Ramp {
        Ramp {
            middle: (self.centre + self.dy * y).as_vec3().to_array(),
            step: self.dx.as_vec3().to_array(),
        }
    }
}

/// A number that is affine in the pixel's place, as [`Affine`] is.
#[derive(Clone, Copy, Debug)]
pub struct Scalar {
    /// At the middle.
    pub centre: f64,
    /// Per pixel to the right.
    pub dx: f64,
    /// Per pixel down.
    pub dy: f64,
}

impl Scalar {
    fn over(&self, divisor: f64) -> Self {
        Scalar {
            centre: self.centre / divisor,
            dx: self.dx / divisor,
            dy: self.dy / divisor,
        }
    }
}

/// One row of an [`Affine`] in f32.
#[derive(Clone, Copy, Debug)]
pub struct Ramp {
    middle: [f32; 3],
    step: [f32; 3],
}

impl Ramp {
    /// The value `x` pixels right of the middle column.
    #[inline(always)]
    pub fn at(&self, x: f32) -> [f32; 3] {
        [0, 1, 2].map(|axis| self.middle[axis] + self.step[axis] * x)
    }
}

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
    weights: Affine,
    /// The point seen, from the cuboid's centre, times w, in world units.
    position: Affine,
    /// The interpolated normal times w.
    normal: Affine,
    /// Towards the eye, of positive length.
    to_eye: Affine,
    /// The interpolated levels times w.
    colors: Affine,
    /// w.
    share: Scalar,
    /// How much a coordinate e_i w moves from a pixel to the next at most.
    pace: f64,
    /// Its vertices, from the cuboid's centre, in world units.
    pub offsets: [DVec3; 3],
    /// Unit normals at its vertices.
    pub normals: [DVec3; 3],
    /// Levels at its vertices.
    pub levels: [DVec3; 3],
    /// Vertices' depth, for interpolation that is linear on the screen; `None` where one is nearer than the near plane.
    pub screen: Option<[f64; 3]>,
    /// The eye from the cuboid's centre, in world units; `None` where rays are parallel.
    pub eye: Option<DVec3>,
    /// The unit vector against the view direction.
    pub backward: DVec3,
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
    /// Triangle `number` of a solid, on the side that is seen; `screen` as in the field.
    pub fn new(number: usize, solid: &Solid, rays: &Rays, screen: Option<[f64; 3]>) -> Self {
        let corners = TRIANGLES[number].map(usize::from);
        let [offsets, normals, levels] = [solid.offsets, solid.normals, solid.colors]
            .map(|values| corners.map(|corner| values[corner]));
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
        let turned = |vector: &Affine| vector.map(|vector| solid.axes * vector);
        Triangle {
            position: turned(&place),
            normal: blend(&normals),
            to_eye: turned(&face.to_eye()),
            colors: blend(&levels),
            share,
            pace: (weights.dx.abs() + weights.dy.abs()).max_element(),
            weights,
            offsets,
            normals,
            levels,
            screen,
            eye: match rays.projection {
                Projection::Perspective => Some(rays.eye),
                Projection::Orthographic => None,
            },
            backward: -rays.axes[2],
        }
    }

    /// Unit vectors from the vertices to the eye.
    pub fn to_eye(&self) -> [DVec3; 3] {
        self.offsets
            .map(|offset| self.eye.map_or(self.backward, |eye| unit(eye - offset)))
    }

    /// Unit vectors from the vertices to a light, whose place is given from the cuboid's centre.
    pub fn to_light(&self, light: DVec3) -> [DVec3; 3] {
        self.offsets.map(|offset| unit(light - offset))
    }

    /// A linear combination of three vertex values.
    #[inline(always)]
    pub fn blend(weights: DVec3, values: &[DVec3; 3]) -> DVec3 {
        values[0] * weights.x + values[1] * weights.y + values[2] * weights.z
    }
}

/// Overshoot, as a share of the triangle, from which a sample's weights are held inside it: coverage is decided on
/// vertices moved by up to 1/512 pixel, which is nothing to a triangle of some pixels and everything to a sliver.
const OVERSHOOT: f64 = 1.0 / 128.0;

/// The tile's share of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Patch {
    /// The lane of the middle: lane `i` lies `i - lane` pixels right of it.
    pub lane: f64,
    /// The row of the middle.
    pub row: f64,
    /// From the middle to the outermost covered pixel centres, in pixels right and down.
    pub half: [f64; 2],
    /// The middle, in pixels right and down of the picture's.
    pub middle: [f64; 2],
    /// w there.
    pub share: f64,
    /// Whether the weights are positive in sum and unclamped all over the tile; where not, each pixel asks
    /// [`Patch::point`] for its own.
    pub steady: bool,
}

/// What a pixel shows of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Barycentric coordinates; their sum is one.
    pub weights: DVec3,
    /// From the cuboid's centre, in world units.
    pub offset: DVec3,
}

impl Patch {
    /// Sets up the tile whose first pixel lies `origin` pixels right and down of the picture's middle and of which the
    /// box `lanes` by `rows` (inclusive) is covered.
    #[inline(always)]
    pub fn new(triangle: &Triangle, origin: [f64; 2], lanes: [u8; 2], rows: [u8; 2]) -> Patch {
        let middle = |ends: [u8; 2]| f64::midpoint(f64::from(ends[0]), f64::from(ends[1]));
        let (lane, row) = (middle(lanes), middle(rows));
        let half = [f64::from(lanes[1]) - lane, f64::from(rows[1]) - row];
        let [x, y] = [origin[0] + lane + 0.5, origin[1] + row + 0.5];
        let Scalar { centre, dx, dy } = triangle.share;
        let share = centre + dx * x + dy * y;
        let sway = dx.abs() * half[0] + dy.abs() * half[1];
        let steady = share > 0.0 && sway < 0.5 * share && triangle.pace < 512.0 * OVERSHOOT * share;
        Patch {
            lane,
            row,
            half,
            middle: [x, y],
            share,
            steady,
        }
    }

    /// What the pixel `x` right and `y` down of the middle shows; on an unsteady patch held inside the triangle.
    pub fn point(&self, triangle: &Triangle, x: f64, y: f64) -> Point {
        let [x, y] = [self.middle[0] + x, self.middle[1] + y];
        let own = triangle.weights.at(x, y);
        let inside = own.max(DVec3::ZERO);
        let held = !self.steady && own != inside;
        let weights = if held { inside } else { own };
        let total = weights.x + weights.y + weights.z;
        if !(total > 0.0 && total.is_finite()) {
            let weights = DVec3::splat(1.0 / 3.0);
            let offset = Triangle::blend(weights, &triangle.offsets);
            return Point { weights, offset };
        }
        let weights = weights / total;
        let offset = if held {
            Triangle::blend(weights, &triangle.offsets)
        } else {
            triangle.position.at(x, y) / total
        };
        Point { weights, offset }
    }

    /// The barycentric coordinates times w.
    #[inline(always)]
    pub fn weights(&self, triangle: &Triangle) -> Affine {
        self.at(&triangle.weights)
    }

    /// The normal times w.
    #[inline(always)]
    pub fn normal(&self, triangle: &Triangle) -> Affine {
        self.at(&triangle.normal)
    }

    /// A vector towards the eye.
    #[inline(always)]
    pub fn to_eye(&self, triangle: &Triangle) -> Affine {
        self.at(&triangle.to_eye)
    }

    /// The vector to a light, whose place is given from the cuboid's centre, times w.
    #[inline(always)]
    pub fn to_light(&self, triangle: &Triangle, light: DVec3) -> Affine {
        let position = self.at(&triangle.position);
        Affine {
            centre: light * self.share - position.centre,
            dx: light * triangle.share.dx - position.dx,
            dy: light * triangle.share.dy - position.dy,
        }
    }

    /// The interpolated levels times w, and w, both over w at the middle.
    #[inline(always)]
    pub fn colors(&self, triangle: &Triangle) -> (Affine, Scalar) {
        let scale = 1.0 / self.share;
        let share = Scalar {
            centre: 1.0,
            dx: triangle.share.dx * scale,
            dy: triangle.share.dy * scale,
        };
        (
            self.at(&triangle.colors).map(|levels| levels * scale),
            share,
        )
    }

    /// Anchors a function at the tile's middle.
    #[inline(always)]
    fn at(&self, whole: &Affine) -> Affine {
        Affine {
            centre: whole.at(self.middle[0], self.middle[1]),
            ..*whole
        }
    }

    /// The place of the tile's first pixel, right and down of the middle, in pixels.
    #[inline(always)]
    pub fn first(&self) -> [f64; 2] {
        [-self.lane, -self.row]
    }

    /// Distance from the middle of each lane, in pixels.
    #[inline(always)]
    pub fn lanes(&self) -> [f32; TILE] {
        let first = -self.lane as f32;
        let mut lanes = [0.0; TILE];
        for (lane, x) in lanes.iter_mut().enumerate() {
            *x = first + lane as f32;
        }
        lanes
    }
}
