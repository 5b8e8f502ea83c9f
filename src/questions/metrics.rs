//! The difference of two pictures.
//!
//! The error of a pixel is the largest difference of its three channels as displayed: both clamped to 0..=255, neither
//! rounded. All figures are statistics of this error over the pixels at which both pictures show the same face. The other
//! pixels are edge pixels and have no error. The diagonal of a face is no edge.
//!
//! A level that is NaN is displayed, and compared, as 0. So every figure is finite.

use serde::Serialize;

use crate::components::TriangleId;
use crate::reference::{Interval, Real, Truth};
use crate::systems::frame::Frame;

/// A picture to compare, row by row from the top.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a, T> {
    /// Pixels in a row.
    pub width: usize,
    /// Red, green and blue in levels, unclamped.
    pub levels: &'a [[T; 3]],
    /// The triangle seen at each pixel, or [`TriangleId::NONE`].
    pub triangles: &'a [TriangleId],
}

impl<'a> From<&'a Frame> for Picture<'a, f32> {
    fn from(frame: &'a Frame) -> Self {
        Picture {
            width: frame.size()[0],
            levels: frame.levels(),
            triangles: frame.triangles(),
        }
    }
}

impl<'a> From<&'a Truth> for Picture<'a, f64> {
    fn from(truth: &'a Truth) -> Self {
        Picture {
            width: truth.width,
            levels: &truth.levels,
            triangles: &truth.triangles,
        }
    }
}

/// The comparison of one pixel of two pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pixel {
    /// The error in levels, 0..=255.
    Error(f64),
    /// The pictures show different faces.
    Edge,
    /// Neither picture shows a cuboid.
    Nothing,
}

/// The comparison of two pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// `None` if no pixel shows the same face in both.
    pub error: Option<ErrorStatistics>,
    /// Pixels that show different faces, or a face in one picture and the background in the other.
    pub edge_pixels: u64,
}

/// Statistics of the errors of pixels, in levels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ErrorStatistics {
    /// The largest.
    pub max: f64,
    /// Column and row of the first pixel that has it.
    pub max_pixel: [usize; 2],
    /// The mean.
    pub mean: f64,
    /// The root of the mean square.
    pub rmse: f64,
    /// The 99.9th percentile: the smallest error that at least 99.9 % of the pixels do not exceed (nearest rank).
    pub p999: f64,
    /// The share of pixels that err by more than one level, 0..=1.
    pub over_1_level: f64,
}

/// A level as it is displayed, before rounding; NaN gives 0.
pub fn displayed(level: f64) -> f64 {
    if level.is_nan() {
        0.0
    } else {
        level.clamp(0.0, 255.0)
    }
}

/// The displayed endpoints of levels, by channel. Those of a float are equal.
pub fn ends<R: Real>(levels: [R; 3]) -> [[f64; 2]; 3] {
    levels.map(|level| level.endpoints().map(displayed))
}

/// The least and the largest difference of two enclosures, 0..=255, over the channels; rounded outwards.
pub fn difference(left: &[[f64; 2]; 3], right: &[[f64; 2]; 3]) -> [f64; 2] {
    let mut largest = [0.0_f64; 2];
    for (left, right) in left.iter().zip(right) {
        let [left, right] = [left, right].map(|[least, most]| Interval::new(*least, *most));
        let [below, above] = (left - right).endpoints();
        let [least, most] = [below.max(-above), above.max(-below)];
        largest = [largest[0].max(least), largest[1].max(displayed(most))];
    }
    largest
}

/// The error of one pixel in levels, 0..=255.
pub fn pixel_error<T: Into<f64>, U: Into<f64>>(left: [T; 3], right: [U; 3]) -> f64 {
    let channels = left.into_iter().zip(right);
    let errors = channels.map(|(left, right)| displayed(left.into()) - displayed(right.into()));
    errors.map(f64::abs).fold(0.0, f64::max)
}

impl<T> Picture<'_, T> {
    /// Whether both pictures show the same face at this pixel, counted row by row.
    pub fn shows_as<U>(&self, other: &Picture<U>, pixel: usize) -> bool {
        self.triangles[pixel].face_id() == other.triangles[pixel].face_id()
            && self.triangles[pixel] != TriangleId::NONE
    }
}

/// Compares two pictures of one size, pixel by pixel. Their order does not matter.
pub fn compared(
    left: Picture<impl Into<f64> + Copy>,
    right: Picture<f64>,
) -> impl Iterator<Item = Pixel> {
    (0..left.levels.len()).map(move |pixel| {
        if [left.triangles[pixel], right.triangles[pixel]] == [TriangleId::NONE; 2] {
            Pixel::Nothing
        } else if left.shows_as(&right, pixel) {
            Pixel::Error(pixel_error(left.levels[pixel], right.levels[pixel]))
        } else {
            Pixel::Edge
        }
    })
}

/// Compares two pictures of one size. Their order does not matter.
pub fn compare(left: Picture<impl Into<f64> + Copy>, right: Picture<f64>) -> Difference {
    let (mut errors, mut edge_pixels) = (Vec::new(), 0);
    let (mut max, mut max_pixel) = (-1.0, [0; 2]);
    for (index, pixel) in compared(left, right).enumerate() {
        match pixel {
            Pixel::Error(error) => {
                if error > max {
                    (max, max_pixel) = (error, [index % left.width, index / left.width]);
                }
                errors.push(error);
            }
            Pixel::Edge => edge_pixels += 1,
            Pixel::Nothing => {}
        }
    }
    Difference {
        error: (!errors.is_empty()).then(|| statistics(&mut errors, max, max_pixel)),
        edge_pixels,
    }
}

/// The statistics of one or more errors, the largest of which is `max`, at `max_pixel`. Changes their order.
fn statistics(errors: &mut [f64], max: f64, max_pixel: [usize; 2]) -> ErrorStatistics {
    let count = errors.len() as f64;
    let over_1_level = errors.iter().filter(|error| **error > 1.0).count();
    let mean = errors.iter().sum::<f64>() / count;
    let mean_square = errors.iter().map(|error| error * error).sum::<f64>() / count;
    let rank = (errors.len() * 999).div_ceil(1000) - 1;
    let (_, p999, _) = errors.select_nth_unstable_by(rank, f64::total_cmp);
    ErrorStatistics {
        max,
        max_pixel,
        mean,
        rmse: mean_square.sqrt(),
        p999: *p999,
        over_1_level: over_1_level as f64 / count,
    }
}
