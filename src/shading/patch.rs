//! One tile of one triangle: everything that is interpolated, as affine functions of the pixel.
//!
//! With u the vertices in homogeneous screen coordinates and p = (X, Y, 1) a point of the screen, the three numbers
//! e_i = p . (u_j x u_k) are proportional to the perspective-correct barycentric coordinates (Olano and Greer 1997,
//! "Triangle scan conversion using 2D homogeneous coordinates", section 3). They are affine in X and Y, need no division
//! and hold for vertices behind the eye, so clipping changes no value.
//!
//! Rule: the sum of e_i at the middle of the tile is one. Directions need no division at all: N, L - P and O - P, each
//! weighted by e_i, are the true vectors times one positive factor a pixel, and the shader normalises them.

use glam::DVec3;

use super::TILE;
use crate::components::unit;

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

/// A triangle of one cuboid, ready to be cut into patches.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// Its vertices' homogeneous screen coordinates, crossed: u_j x u_k for i = 0, 1, 2.
    pub planes: [DVec3; 3],
    /// Distance of pixel centres in those coordinates.
    pub pitch: f64,
    /// Its vertices, from the cuboid's centre, in world units.
    pub offsets: [DVec3; 3],
    /// Unit normals at its vertices.
    pub normals: [DVec3; 3],
    /// Levels at its vertices.
    pub colors: [DVec3; 3],
    /// Vertices' w, for interpolation that is linear on the screen; `None` where one is nearer than the near plane.
    pub screen: Option<[f64; 3]>,
    /// The eye from the cuboid's centre, in world units; `None` where rays are parallel.
    pub eye: Option<DVec3>,
    /// The unit vector against the view direction.
    pub backward: DVec3,
}

impl Triangle {
    /// The planes for vertices in homogeneous screen coordinates. The difference is formed first: it is exact where the
    /// triangle is small against its distance.
    pub fn planes(vertices: [DVec3; 3]) -> [DVec3; 3] {
        let [a, b, c] = vertices;
        [b.cross(c - b), c.cross(a - c), a.cross(b - a)]
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
    /// e_0, e_1, e_2.
    pub weights: Affine,
    /// Whether the weights are positive in sum and unclamped all over the tile; where not, each pixel asks
    /// [`Patch::weights_at`] for its own.
    pub steady: bool,
}

impl Patch {
    /// Sets up the tile whose first pixel lies `origin` pixels right and down of the picture's middle and of which the
    /// box `lanes` by `rows` (inclusive) is covered.
    #[inline(always)]
    pub fn new(triangle: &Triangle, origin: [f64; 2], lanes: [u8; 2], rows: [u8; 2]) -> Patch {
        let middle = |ends: [u8; 2]| f64::midpoint(f64::from(ends[0]), f64::from(ends[1]));
        let (lane, row) = (middle(lanes), middle(rows));
        let half = [f64::from(lanes[1]) - lane, f64::from(rows[1]) - row];
        let x = (origin[0] + lane + 0.5) * triangle.pitch;
        let y = -(origin[1] + row + 0.5) * triangle.pitch;
        let [a, b, c] = triangle.planes;
        let at = |x: f64, y: f64, z: f64| {
            DVec3::new(
                a.x * x + a.y * y + a.z * z,
                b.x * x + b.y * y + b.z * z,
                c.x * x + c.y * y + c.z * z,
            )
        };
        let weights = Affine {
            centre: at(x, y, 1.0),
            dx: at(triangle.pitch, 0.0, 0.0),
            dy: at(0.0, -triangle.pitch, 0.0),
        };
        let sum = |e: DVec3| e.x + e.y + e.z;
        let total = sum(weights.centre);
        let scale = if total > 0.0 {
            total
        } else {
            weights.centre.abs().max_element()
        };
        let weights = weights.map(|e| e / scale);
        let sway = sum(weights.dx).abs() * half[0] + sum(weights.dy).abs() * half[1];
        let overshoot = (weights.dx.abs() + weights.dy.abs()).max_element() / 512.0;
        let steady = total > 0.0 && sway < 0.5 && overshoot < OVERSHOOT;
        Patch {
            lane,
            row,
            half,
            weights,
            steady,
        }
    }

    /// Weights that sum to one at a pixel `x` right and `y` down of the middle; on an unsteady patch held inside the
    /// triangle.
    pub fn weights_at(&self, x: f64, y: f64) -> DVec3 {
        let own = self.weights.at(x, y);
        let weights = if self.steady {
            own
        } else {
            own.max(DVec3::ZERO)
        };
        let total = weights.x + weights.y + weights.z;
        if total > 0.0 && total.is_finite() {
            weights / total
        } else {
            DVec3::splat(1.0 / 3.0)
        }
    }

    /// Vertex values, weighted: the value itself at the middle, times the sum of the weights elsewhere.
    #[inline(always)]
    pub fn blend(&self, values: &[DVec3; 3]) -> Affine {
        self.weights.map(|weights| Triangle::blend(weights, values))
    }

    /// A constant vector, weighted.
    #[inline(always)]
    pub fn constant(&self, value: DVec3) -> Affine {
        self.weights
            .map(|weights| value * (weights.x + weights.y + weights.z))
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
