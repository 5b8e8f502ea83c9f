//! One tile of one triangle: everything that is interpolated, as affine functions of the pixel, anchored at its middle.
//!
//! Rule: directions need no division at all: N, L - P and O - P are the true vectors times one positive factor a pixel,
//! and the shader normalises them.

use glam::DVec3;

use super::affine::{Affine, Scalar};
use super::number::ABREAST;
use super::polynomial::Polynomial;
use super::triangle::{Triangle, Vertices};
use super::{Coverage, TILE};

/// Overshoot, as a share of the triangle, from which a sample's weights are held inside its face: coverage is decided on
/// vertices moved by up to 1/512 pixel, which is nothing to a triangle of some pixels and everything to a sliver.
const OVERSHOOT: f64 = 1.0 / 128.0;

/// The tile's share of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Patch {
    /// The lane of the middle: lane `i` lies `i - lane` pixels right of it.
    pub lane: f64,
    /// The row of the middle.
    pub row: f64,
    /// From the middle to the outermost covered pixel centres, in pixels right and down; half a pixel at least, so that
    /// what is bounded at these places has bounded slopes too.
    pub half: [f64; 2],
    /// The middle, in pixels right and down of the picture's.
    pub middle: [f64; 2],
    /// w there.
    pub share: f64,
    /// Whether the weights are positive in sum and unclamped all over the tile; where not, each pixel asks
    /// [`Patch::point`] for its own.
    pub steady: bool,
}

/// So few pixels of a square are evaluated faster than a certificate for them is found.
const FEW: u32 = 24;

/// Squares of pixels that are certified side by side. Filled where they stand: to move them costs as much as to fill them.
#[derive(Debug)]
pub struct Squares<const SIDE: usize> {
    /// Where the first pixel of each stands, in pixels right and down of the picture's first.
    pub places: [[usize; 2]; ABREAST],
    /// What is covered of each.
    pub covered: [Coverage<SIDE>; ABREAST],
    /// Their shares of a triangle.
    pub patches: [Patch; ABREAST],
    /// Which are worth a certificate.
    pub wanted: [bool; ABREAST],
    /// What is certified of those: the cheapest colour that stays within the tolerance all over, if there is one; where it
    /// is not [whole](Polynomial::is_whole), together with what pixels have besides.
    pub polynomials: [Option<Polynomial>; ABREAST],
}

impl<const SIDE: usize> Squares<SIDE> {
    /// None yet.
    pub const NONE: Self = Squares {
        places: [[0; 2]; ABREAST],
        covered: [Coverage::NONE; ABREAST],
        patches: [Patch::NONE; ABREAST],
        wanted: [false; ABREAST],
        polynomials: [None; ABREAST],
    };

    /// Sets others up, of which nothing is certified; `middle` is the picture's, in pixels right and down of its first
    /// corner.
    #[inline(always)]
    pub fn renew(
        &mut self,
        triangle: &Triangle,
        middle: [f64; 2],
        place: impl Fn(usize) -> [usize; 2],
        covered: impl Fn(usize) -> Coverage<SIDE>,
    ) {
        for index in 0..ABREAST {
            let [column, row] = place(index);
            let corner = [column as f64 - middle[0], row as f64 - middle[1]];
            let covered = covered(index);
            let patch = Patch::new(triangle, corner, covered.lanes, covered.rows);
            self.places[index] = [column, row];
            self.patches[index] = patch;
            self.covered[index] = covered;
            self.wanted[index] = covered.pixels > FEW && patch.steady;
            self.polynomials[index] = None;
        }
    }
}

/// What a pixel shows of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Point<'a> {
    /// Of the triangle of the face that it lies in.
    pub vertices: &'a Vertices,
    /// Barycentric coordinates; their sum is one.
    pub weights: DVec3,
    /// From the cuboid's centre, in world units.
    pub offset: DVec3,
}

impl Patch {
    /// Of no triangle.
    const NONE: Self = Patch {
        lane: 0.0,
        row: 0.0,
        half: [0.0; 2],
        middle: [0.0; 2],
        share: 0.0,
        steady: false,
    };

    /// Sets up the tile whose first pixel lies `origin` pixels right and down of the picture's middle and of which the
    /// box `lanes` by `rows` (inclusive) is covered.
    #[inline(always)]
    pub fn new(triangle: &Triangle, origin: [f64; 2], lanes: [u8; 2], rows: [u8; 2]) -> Patch {
        let middle = |ends: [u8; 2]| f64::midpoint(f64::from(ends[0]), f64::from(ends[1]));
        let (lane, row) = (middle(lanes), middle(rows));
        let half = [f64::from(lanes[1]) - lane, f64::from(rows[1]) - row].map(|half| half.max(0.5));
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

    /// What the pixel `x` right and `y` down of the middle shows; on an unsteady patch held inside the face. Beyond the
    /// diagonal, where snapping may put a pixel of this triangle, that is the other triangle.
    pub fn point<'a>(&self, triangle: &'a Triangle, x: f64, y: f64) -> Point<'a> {
        let [x, y] = [self.middle[0] + x, self.middle[1] + y];
        let own = triangle.weights.at(x, y);
        let total = own.element_sum();
        if !(total > 0.0 && total.is_finite()) {
            let weights = DVec3::splat(1.0 / 3.0);
            return Point {
                vertices: &triangle.own,
                weights,
                offset: Triangle::blend(weights, &triangle.own.offsets),
            };
        }
        let held = triangle.held(own).filter(|_| !self.steady);
        let (vertices, weights) = triangle.interpolated(held.unwrap_or(own));
        let weights = weights / total;
        let offset = match held {
            Some(_) => Triangle::blend(weights, &vertices.offsets),
            None => triangle.position.at(x, y) / total,
        };
        Point {
            vertices,
            weights,
            offset,
        }
    }

    /// How far covered pixels of a steady patch lie beyond the face's diagonal at most, as a barycentric coordinate.
    #[inline(always)]
    pub fn beyond_diagonal<const SIDE: usize>(
        &self,
        triangle: &Triangle,
        coverage: &Coverage<SIDE>,
    ) -> f64 {
        let Scalar { centre, dx, dy } = triangle.before_diagonal;
        let middle = centre + dx * self.middle[0] + dy * self.middle[1];
        if middle >= dx.abs() * self.half[0] + dy.abs() * self.half[1] {
            return 0.0;
        }
        let mut least = 0.0_f64;
        for (row, &(from, to)) in coverage.spans.iter().enumerate() {
            if from < to {
                let start = middle + dy * (row as f64 - self.row);
                for lane in [from, to - 1] {
                    least = least.min(start + dx * (f64::from(lane) - self.lane));
                }
            }
        }
        // A steady patch has at least half the middle's w everywhere.
        -least / (0.5 * self.share)
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
        // Not moved here from the picture's middle: near the light that would cost digits.
        Affine {
            centre: light * self.share - self.at(&triangle.position).centre,
            ..triangle.towards(light)
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
