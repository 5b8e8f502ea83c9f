//! LDR-FLIP: the difference that a person sees who alternates between two pictures.
//!
//! After Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference Evaluator for Alternating
//! Images", HPG 2020, with the constants of the authors' code (github.com/NVlabs/flip).
//!
//! ```text
//! bytes --> opponent colours --+-- contrast filters -> Hunt-adjusted Lab ---- colour difference --+
//!                              |                                                                  +--> 0..=1
//!                              +-- edge and point filters of the luminance -- feature difference -+
//! ```
//!
//! A picture against itself gives exactly 0. The bits depend neither on the order of the pictures nor on the number of
//! threads.

mod color;
mod filter;

use std::ops::Range;

use rayon::prelude::*;

use super::metrics::Picture;
use crate::frame::display_step;
use color::{distance, hunt_lab, linear_from_opponent, opponent_from_srgb};
use filter::{Filter, Plane};

/// Pixels per degree for a usual screen: 3840 pixels on 0.7 m, seen from 0.7 m (67.02).
pub const PIXELS_PER_DEGREE: f64 = 0.7 * (3840.0 / 0.7) * (std::f64::consts::PI / 180.0);

/// The paper's exponent of colour differences, `q_c`, and of feature differences, `q_f`.
const COLOR_EXPONENT: f32 = 0.7;
const FEATURE_EXPONENT: f32 = 0.5;
/// The paper's `p_c` and `p_t`: up to this share of the largest, colour differences fill the range up to this target.
const SHARE: f32 = 0.4;
const TARGET: f32 = 0.95;

/// Rows evaluated at once: few enough for the cache, many more than the filters add at both ends.
const BAND: usize = 64;

/// Mean FLIP, 0..=1, over the pixels that show the same face in both pictures; `None` if there is none.
///
/// The pictures have one size. Their displayed bytes are taken as sRGB. Only the rectangle around the pixels of the mean is
/// evaluated, but all pixels within the reach of the filters have an effect. Beyond the border of the picture its outermost
/// pixels repeat. `pixels_per_degree` is at least 1.
pub fn mean<T, U>(left: Picture<T>, right: Picture<U>, pixels_per_degree: f64) -> Option<f64>
where
    T: Into<f64> + Copy + Sync,
    U: Into<f64> + Copy + Sync,
{
    let counts = |pixel: &usize| left.shows_as(&right, *pixel);
    let [columns, rows] = rectangle(left.width, (0..left.levels.len()).filter(counts))?;
    let observer = Observer::new(pixels_per_degree);
    let starts: Vec<usize> = rows.clone().step_by(BAND).collect();
    let sums: Vec<f64> = starts
        .into_par_iter()
        .map(|start| {
            let band = start..(start + BAND).min(rows.end);
            let looks_left = observer.looks(&left, &columns, &band);
            let looks_right = observer.looks(&right, &columns, &band);
            let pixels =
                band.flat_map(|row| columns.clone().map(move |column| row * left.width + column));
            pixels
                .zip(looks_left.iter().zip(&looks_right))
                .filter(|(pixel, _)| counts(pixel))
                .map(|(_, (left, right))| f64::from(observer.difference(left, right)))
                .sum()
        })
        .collect();
    let count = (0..left.levels.len()).filter(counts).count();
    Some(sums.iter().sum::<f64>() / count as f64)
}

/// The smallest range of columns and of rows that holds these pixels.
fn rectangle(width: usize, pixels: impl Iterator<Item = usize>) -> Option<[Range<usize>; 2]> {
    pixels
        .map(|pixel| [pixel % width, pixel / width].map(|at| at..at + 1))
        .reduce(|all, one| {
            std::array::from_fn(|i| all[i].start.min(one[i].start)..all[i].end.max(one[i].end))
        })
}

/// The appearance of a pixel.
struct Look {
    /// Hunt-adjusted L*a*b*, after the eye's blur.
    color: [f32; 3],
    /// The strength of an edge and of a point, in shares of white's luminance.
    features: [f32; 2],
}

/// An eye at a certain distance.
struct Observer {
    /// Contrast sensitivity in luminance, red-green and blue-yellow.
    contrast: [Filter; 3],
    /// Edges and points, each across the columns and down the rows.
    features: [[Filter; 2]; 2],
    /// The reach of the filters, in pixels.
    reach: usize,
    /// The largest possible colour difference, between green and blue, after the exponent.
    largest: f32,
}

impl Observer {
    fn new(pixels_per_degree: f64) -> Self {
        let reach = filter::contrast_radius(pixels_per_degree)
            .max(filter::feature_radius(pixels_per_degree));
        let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(hunt_lab);
        Observer {
            contrast: filter::contrast(pixels_per_degree, reach),
            features: filter::features(pixels_per_degree, reach),
            reach,
            largest: distance(green, blue).powf(COLOR_EXPONENT),
        }
    }

    /// The appearance of these pixels, row by row.
    fn looks<T: Into<f64> + Copy>(
        &self,
        picture: &Picture<T>,
        columns: &Range<usize>,
        rows: &Range<usize>,
    ) -> Vec<Look> {
        let opponent = self.opponent_colors(picture, columns, rows);
        let colors: [Plane; 3] =
            std::array::from_fn(|channel| opponent[channel].filtered(&self.contrast[channel]));
        let features = self
            .features
            .each_ref()
            .map(|ways| ways.each_ref().map(|way| opponent[0].filtered(way)));
        (0..columns.len() * rows.len())
            .map(|pixel| Look {
                color: hunt_lab(
                    linear_from_opponent(colors.each_ref().map(|plane| plane.values[pixel]))
                        .map(|linear| linear.clamp(0.0, 1.0)),
                ),
                features: features
                    .each_ref()
                    .map(|[across, down]| across.values[pixel].hypot(down.values[pixel])),
            })
            .collect()
    }

    /// The opponent colours of these pixels and of those within the reach of the filters.
    fn opponent_colors<T: Into<f64> + Copy>(
        &self,
        picture: &Picture<T>,
        columns: &Range<usize>,
        rows: &Range<usize>,
    ) -> [Plane; 3] {
        let height = picture.levels.len() / picture.width;
        let reached = |inner: &Range<usize>, end: usize| {
            let [start, length] = [inner.start, inner.len() + 2 * self.reach];
            let reach = self.reach;
            (0..length).map(move |i| (start + i).saturating_sub(reach).min(end - 1))
        };
        let mut planes = [(); 3].map(|()| Plane {
            width: columns.len() + 2 * self.reach,
            values: Vec::new(),
        });
        for row in reached(rows, height) {
            for column in reached(columns, picture.width) {
                let levels = picture.levels[row * picture.width + column];
                let bytes = levels.map(|level| f64::from(display_step(level.into())));
                let opponent = opponent_from_srgb(bytes.map(|byte| (byte / 255.0) as f32));
                for (plane, value) in planes.iter_mut().zip(opponent) {
                    plane.values.push(value);
                }
            }
        }
        planes
    }

    /// The FLIP of one pixel, 0..=1.
    fn difference(&self, left: &Look, right: &Look) -> f32 {
        let color = distance(left.color, right.color).powf(COLOR_EXPONENT);
        let knee = SHARE * self.largest;
        let color = if color < knee {
            TARGET * color / knee
        } else {
            TARGET + (1.0 - TARGET) * (color - knee) / (self.largest - knee)
        };
        let [edge, point] = [0, 1].map(|i| (left.features[i] - right.features[i]).abs());
        let feature = (edge.max(point) / 2.0_f32.sqrt()).powf(FEATURE_EXPONENT);
        color.powf(1.0 - feature)
    }
}
