//! Lines of sight through pixel centres in; the triangle each meets, where on it and how far away, out.
//!
//! A ray is carried into the cuboid's own coordinates, where the six faces are planes across the axes (Kay and Kajiya
//! 1986, "Ray tracing complex scenes", section 3). It enters through the face whose four edges it passes on the inner
//! side; on which side of an edge it passes is a difference of two products, and so is where on the face it arrives:
//!
//! ```text
//!     (-, +)-----------(+, +)      k: the axis across the face, which is at K      ray: p + t d
//!        |            .'  |        i, j: the axes along it, halves h_i and h_j
//!        |     *   .'     |        t = (K - p_k) / d_k,   i = p_i + t d_i,   j = p_j + t d_j
//!        |      .'        |
//!        |   .'           |        u = i / h_i, v = j / h_j: between the ends of the diagonal and the third corner
//!     (-, -)-----------(+, -)      the weights are (1 - max(u, v)) / 2, (1 + min(u, v)) / 2 and |u - v| / 2
//! ```
//!
//! Rule: two faces compute the side of their common edge from the same numbers, with opposite sign, so a ray passes
//! between them nowhere and never enters both: one exactly on the edge belongs to what is to the right of it, or below
//! it if the edge is level (the top-left rule). A length counts only where a ray meets its end, so a cuboid a billion
//! times longer than it is wide is met as exactly as a cube.

use std::ops::Range;

use glam::{DMat3, DVec2, DVec3};

use crate::components::{Mesh, Projection, TRIANGLES, Transform, View, unit};

/// The lines of sight of a whole picture.
pub struct Rays {
    /// The eye, in world units.
    pub eye: DVec3,
    /// From world directions to right, up and depth.
    to_camera: DMat3,
    /// Distance of the near plane, in world units.
    near: f64,
    projection: Projection,
    /// Width and height in pixels.
    size: [usize; 2],
    /// From the picture's centre to its upper edge: as a slope in perspective, in world units if orthographic.
    half_height: f64,
}

/// One line of sight: the points `(offset + slope * depth, depth)` in camera coordinates.
pub struct Ray {
    /// World units.
    offset: DVec2,
    /// Dimensionless.
    slope: DVec2,
}

/// Where a ray meets a cuboid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The triangle's place in [`TRIANGLES`].
    pub triangle: usize,
    /// The weights of its corners at the point met: each 0..=1, together 1.
    pub weights: [f64; 3],
    /// The point met: from the cuboid's centre along the cuboid's axes, in world units.
    pub place: DVec3,
    /// The unit vector against the ray, along the cuboid's axes.
    pub to_eye: DVec3,
    /// Distance along the view direction, in world units.
    pub depth: f64,
}

/// A cuboid as rays meet it.
pub struct Solid {
    /// Half the lengths of its edges, in world units.
    half: DVec3,
    /// From camera coordinates to the cuboid's axes.
    to_own: DMat3,
    /// The eye from the cuboid's centre, along the cuboid's axes.
    eye: DVec3,
    /// Distances of the corners along the view direction.
    depths: [f64; 8],
    /// Distance of the near plane, in world units.
    near: f64,
    projection: Projection,
    /// The only columns of the picture it can be met in.
    pub columns: Range<usize>,
    /// The only rows of the picture it can be met in.
    pub rows: Range<usize>,
}

/// A line of sight from a cuboid's centre, along the cuboid's axes: the points `from + along * depth`.
struct Line {
    from: DVec3,
    along: DVec3,
}

/// A face: the axis across it, whether it looks along that axis or against it, and where it crosses it.
#[derive(Clone, Copy)]
struct Face {
    axis: usize,
    outwards: f64,
    at: f64,
}

impl Rays {
    /// The lines of sight that `view` asks for.
    pub fn of(view: &View) -> Self {
        let [right, up, forward] = view.viewpoint.axes();
        let camera = &view.viewpoint.camera;
        Rays {
            eye: view.viewpoint.position,
            to_camera: DMat3::from_cols(right, up, forward).transpose(),
            near: view.viewpoint.near(),
            projection: view.projection,
            size: view.size,
            half_height: match view.projection {
                Projection::Perspective => (camera.fov / 2.0).to_radians().tan(),
                Projection::Orthographic => camera.height / 2.0,
            },
        }
    }

    /// The view direction, a unit vector in world space.
    pub fn forward(&self) -> DVec3 {
        self.to_camera.row(2)
    }

    /// The line of sight through the centre of pixel (`x`, `y`).
    pub fn through(&self, x: usize, y: usize) -> Ray {
        let [width, height] = self.size.map(|pixels| pixels as f64);
        let from_centre = DVec2::new((2 * x + 1) as f64 - width, height - (2 * y + 1) as f64);
        let place = from_centre / height * self.half_height;
        match self.projection {
            Projection::Perspective => Ray {
                offset: DVec2::ZERO,
                slope: place,
            },
            Projection::Orthographic => Ray {
                offset: place,
                slope: DVec2::ZERO,
            },
        }
    }

    /// Where a point in camera coordinates is seen: pixels from the picture's top left corner.
    fn pixel(&self, point: DVec3) -> DVec2 {
        let [width, height] = self.size.map(|pixels| pixels as f64);
        let place = match self.projection {
            Projection::Perspective => point.truncate() / point.z,
            Projection::Orthographic => point.truncate(),
        };
        let from_centre = place / self.half_height * height;
        DVec2::new(width + from_centre.x, height - from_centre.y) / 2.0
    }

    /// The columns and rows that points in camera coordinates can be seen in.
    fn bounds(&self, corners: &[DVec3; 8]) -> [Range<usize>; 2] {
        let [width, height] = self.size;
        let before = corners.iter().filter(|corner| corner.z < self.near).count();
        if before == corners.len() {
            return [0..0, 0..0];
        }
        if before > 0 && self.projection == Projection::Perspective {
            return [0..width, 0..height];
        }
        let pixels = corners.map(|corner| self.pixel(corner));
        let least = pixels.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let most = pixels.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        // A coordinate errs by a rounding of the largest one, which moves a corner on the screen by up to this much.
        let largest = corners.iter().map(|corner| corner.abs().max_element());
        let largest = largest.fold(0.0, f64::max);
        let error = 8.0 * f64::EPSILON * largest;
        let moved = match self.projection {
            Projection::Perspective => {
                let nearest = corners.iter().map(|corner| corner.z);
                let nearest = nearest.fold(f64::INFINITY, f64::min);
                error / nearest * (1.0 + largest / nearest)
            }
            Projection::Orthographic => error,
        };
        let slack = 1.0 + moved / self.half_height * height as f64;
        // The conversion to integers saturates.
        let range = |least: f64, most: f64, end: usize| {
            (least - slack) as usize..((most + slack + 1.0) as usize).min(end)
        };
        [
            range(least.x, most.x, width),
            range(least.y, most.y, height),
        ]
    }
}

impl Solid {
    /// The cuboid of this place and shape, before these rays.
    pub fn new(rays: &Rays, transform: &Transform, mesh: &Mesh) -> Self {
        let axes = transform.axes();
        let centre = transform.position - rays.eye;
        let corners = mesh
            .corners
            .map(|corner| rays.to_camera * (centre + axes * corner));
        let [columns, rows] = rays.bounds(&corners);
        Solid {
            half: mesh.corners[7],
            to_own: axes.transpose() * rays.to_camera.transpose(),
            eye: axes.transpose() * -centre,
            depths: corners.map(|corner| corner.z),
            near: rays.near,
            projection: rays.projection,
            columns,
            rows,
        }
    }

    /// Where the ray enters the cuboid, unless that is before the near plane.
    pub fn hit(&self, ray: &Ray) -> Option<Hit> {
        let line = Line {
            from: self.eye + self.to_own * ray.offset.extend(0.0),
            along: self.to_own * ray.slope.extend(1.0),
        };
        let (number, face) = (0..6)
            .map(|number| (number, self.face(number)))
            .find(|(_, face)| self.enters(&line, face))?;
        let depth = (face.at - line.from[face.axis]) / line.along[face.axis];
        if depth < self.near {
            return None;
        }
        let mut place = (line.from + line.along * depth).clamp(-self.half, self.half);
        place[face.axis] = face.at;
        let [u, v] = face.along().map(|axis| place[axis] / self.half[axis]);
        let first = (face.outwards > 0.0) == self.is_right_of_diagonal(&line, &face);
        let [low, aside, high] = [1.0 - u.max(v), (u - v).abs(), 1.0 + u.min(v)];
        // The corners of the two triangles: low, aside, high and low, high, aside.
        let weights = if first {
            [low, aside, high]
        } else {
            [low, high, aside]
        };
        Some(Hit {
            triangle: 2 * number + usize::from(!first),
            weights: weights.map(|weight| weight / 2.0),
            place,
            to_eye: -unit(line.along),
            depth,
        })
    }

    /// Face `number` in the order of [`crate::components::FACES`].
    fn face(&self, number: usize) -> Face {
        let axis = number / 2;
        let outwards = if number.is_multiple_of(2) { 1.0 } else { -1.0 };
        Face {
            axis,
            outwards,
            at: outwards * self.half[axis],
        }
    }

    /// Whether the line comes from outside of this face and passes within its four edges.
    fn enters(&self, line: &Line, face: &Face) -> bool {
        let from_outside = face.outwards * line.along[face.axis] < 0.0
            && match self.projection {
                Projection::Perspective => {
                    face.outwards * self.eye[face.axis] > self.half[face.axis]
                }
                // It comes from infinitely far.
                Projection::Orthographic => true,
            };
        from_outside
            && face.along().iter().all(|&axis| {
                self.is_beyond(line, face, axis, -self.half[axis])
                    && !self.is_beyond(line, face, axis, self.half[axis])
            })
    }

    /// Whether the line passes the plane of a face beyond the edge at `edge` on `axis`.
    fn is_beyond(&self, line: &Line, face: &Face, axis: usize, edge: f64) -> bool {
        let mut on_edge = face.middle();
        on_edge[axis] = edge;
        self.is_positive(line, on_edge, |to, along| face.passing(to, along, axis))
    }

    /// Whether the line passes the plane of a face where i / h_i is larger than j / h_j.
    fn is_right_of_diagonal(&self, line: &Line, face: &Face) -> bool {
        let [i, j] = face.along();
        self.is_positive(line, face.middle(), |to, along| {
            face.passing(to, along, i) * self.half[j] - face.passing(to, along, j) * self.half[i]
        })
    }

    /// Whether `of` is positive for the line or, where it is zero, would be for one a little to the right of it or,
    /// where that makes no difference, for one a little below.
    ///
    /// `of` is linear both in the way from the line's start to `point` and in the line's direction.
    fn is_positive(&self, line: &Line, point: DVec3, of: impl Fn(DVec3, DVec3) -> f64) -> bool {
        let change = |towards: DVec3| {
            let step = self.to_own * towards;
            match self.projection {
                Projection::Perspective => of(point - line.from, step),
                Projection::Orthographic => of(-step, line.along),
            }
        };
        let value = of(point - line.from, line.along);
        if value != 0.0 {
            return value > 0.0;
        }
        let (right, down) = (change(DVec3::X), change(DVec3::NEG_Y));
        right > 0.0 || right == 0.0 && down > 0.0
    }

    /// The corners' weights in linear interpolation on the screen instead of on the triangle.
    ///
    /// A triangle with a corner nearer than the near plane has no three places on the screen: its weights stay as they
    /// are on the triangle.
    pub fn screen_weights(&self, hit: &Hit) -> [f64; 3] {
        let depths = TRIANGLES[hit.triangle].map(|corner| self.depths[usize::from(corner)]);
        if self.projection == Projection::Orthographic
            || depths.iter().any(|depth| *depth < self.near)
        {
            return hit.weights;
        }
        // Areas shrink with both depths of their edge: bc / (zb zc) : ca / (zc za) : ab / (za zb).
        let weighed: [f64; 3] = std::array::from_fn(|i| hit.weights[i] * depths[i]);
        weighed.map(|weight| weight / weighed.iter().sum::<f64>())
    }
}

impl Face {
    /// The axes along the face.
    fn along(&self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }

    /// Its middle, from the cuboid's centre.
    fn middle(&self) -> DVec3 {
        let mut middle = DVec3::ZERO;
        middle[self.axis] = self.at;
        middle
    }

    /// How far along `axis` a line passes a point of the face, times the line's pace towards the face; `to` is the way
    /// from the line's start to that point.
    fn passing(&self, to: DVec3, along: DVec3, axis: usize) -> f64 {
        self.outwards * (along[self.axis] * to[axis] - along[axis] * to[self.axis])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::components::{Camera, Viewpoint};

    /// Columns and rows in which a box is looked for that goes from `least` to `most`, given right, up and forward of an
    /// eye that sees one up for every one forward; 4 up if the projection is orthographic.
    fn looked_for(view: &View, least: DVec3, most: DVec3) -> [Range<usize>; 2] {
        let transform = Transform {
            position: (least + most) / 2.0 * DVec3::new(1.0, 1.0, -1.0),
            rotation: DVec3::ZERO,
        };
        let solid = Solid::new(&Rays::of(view), &transform, &Mesh::cuboid(most - least));
        [solid.columns, solid.rows]
    }

    fn view(projection: Projection) -> View {
        let camera = Camera {
            target: DVec3::NEG_Z,
            up: DVec3::Y,
            fov: 90.0,
            height: 8.0,
            near: Some(0.5),
        };
        View {
            size: [100, 80],
            viewpoint: Viewpoint {
                position: DVec3::ZERO,
                camera,
            },
            projection,
            background: DVec3::ZERO,
            shading: None,
            tolerance: 0.0,
        }
    }

    #[test]
    fn a_cuboid_is_looked_for_within_a_pixel_of_its_corners() {
        let (least, most) = (DVec3::new(-1.02, -0.33, 2.0), DVec3::new(1.02, 1.52, 5.0));
        // At depth 2 a unit is 20 pixels: from 29.6 and 9.6 to 70.4 and 46.6, and a pixel more.
        assert_eq!(
            looked_for(&view(Projection::Perspective), least, most),
            [28..72, 8..48]
        );
        // A unit is 10 pixels: from 39.8 and 24.8 to 60.2 and 43.3.
        assert_eq!(
            looked_for(&view(Projection::Orthographic), least, most),
            [38..62, 23..45]
        );
    }

    #[test]
    fn a_cuboid_whose_corners_round_to_other_pixels_is_looked_for_there_too() {
        // The farthest corner is 2^23 away and errs by 8 * 2^-52 * 2^23 = 2^-26; at depth 2 that is 2^-27 of a slope, and
        // 2^-27 * 2^22 = 2^-5 where the depth errs: 1.25 pixels of 40, allowed for twice. From 39.6 and 19.6 to
        // 60.4 and 60.4.
        let (least, most) = (
            DVec3::new(-0.52, -1.02, 2.0),
            DVec3::new(0.52, 1.02, 8_388_608.0),
        );
        assert_eq!(
            looked_for(&view(Projection::Perspective), least, most),
            [36..64, 16..64]
        );
        // 2^48 away it errs by 1/2: 5 pixels of 10 to a unit, allowed for twice. From 39.8 and 19.8 to 60.2 and 60.2.
        let (least, most) = (
            DVec3::new(-1.02, -2.02, 1.0),
            DVec3::new(1.02, 2.02, 2.0_f64.powi(48)),
        );
        assert_eq!(
            looked_for(&view(Projection::Orthographic), least, most),
            [28..72, 8..72]
        );
    }

    #[test]
    fn a_cuboid_that_the_near_plane_cuts_is_looked_for_everywhere_and_one_before_it_nowhere() {
        let (least, most) = (DVec3::new(-1.02, -0.33, 0.25), DVec3::new(1.02, 1.52, 5.0));
        assert_eq!(
            looked_for(&view(Projection::Perspective), least, most),
            [0..100, 0..80]
        );
        // Parallel lines of sight meet it where its corners are, cut or not.
        assert_eq!(
            looked_for(&view(Projection::Orthographic), least, most),
            [38..62, 23..45]
        );
        let most = DVec3::new(1.02, 1.52, 0.375);
        for projection in [Projection::Perspective, Projection::Orthographic] {
            assert_eq!(looked_for(&view(projection), least, most), [0..0, 0..0]);
        }
    }
}
