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

use std::f64::consts::PI;

use rayon::prelude::*;

use super::metrics::Picture;
use crate::frame::display_step;
use color::{distance, hunt_lab, linear_from_opponent, opponent_from_srgb};

/// Pixels per degree for a usual screen: 3840 pixels on 0.7 m, seen from 0.7 m (67.02).
pub const PIXELS_PER_DEGREE: f64 = 0.7 * (3840.0 / 0.7) * (PI / 180.0);

/// The most bytes for a pixel: the looks of 20 of both pictures, and ten planes of 4.
pub const BYTES_PER_PIXEL: usize = 2 * 20 + 10 * 4;

/// The paper's exponent of colour differences, `q_c`, and of feature differences, `q_f`.
const COLOR_EXPONENT: f32 = 0.7;
const FEATURE_EXPONENT: f32 = 0.5;
/// The paper's `p_c` and `p_t`: up to this share of the largest, colour differences fill the range up to this target.
const SHARE: f32 = 0.4;
const TARGET: f32 = 0.95;

/// Amplitude a and width b (square degrees) of the Gaussians a sqrt(pi / b) exp(-(pi x)^2 / b) of the contrast
/// sensitivity in luminance, red-green and blue-yellow, as the authors' code has them.
const CONTRAST: [&[[f64; 2]]; 3] = [
    &[[1.0, 0.0047]],
    &[[1.0, 0.0053]],
    &[[34.1, 0.04], [13.5, 0.025]],
];
/// The largest b above.
const WIDEST: f64 = 0.04;
/// The paper's w: from peak to trough of the edge filter, twice the Gaussian's standard deviation, in degrees.
const FEATURE_WIDTH: f64 = 0.082;

/// Mean FLIP, 0..=1, over the pixels that show the same face in both pictures; `None` if there is none.
///
/// The pictures have one size. Their displayed bytes are taken as sRGB. Beyond the border of the picture its outermost
/// pixels repeat. `pixels_per_degree` is at least 1.
pub fn mean(
    left: Picture<impl Into<f64> + Copy + Sync>,
    right: Picture<f64>,
    pixels_per_degree: f64,
) -> Option<f64> {
    let counts = |pixel: &usize| left.shows_as(&right, *pixel);
    let pixels: Vec<usize> = (0..left.levels.len()).filter(counts).collect();
    if pixels.is_empty() {
        return None;
    }
    let looks_left = looks(&left, pixels_per_degree);
    let looks_right = looks(&right, pixels_per_degree);
    // The largest possible colour difference is that between green and blue.
    let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(hunt_lab);
    let largest = distance(green, blue).powf(COLOR_EXPONENT);
    let flip = |pixel: &usize| {
        let [left, right] = [&looks_left, &looks_right].map(|looks| &looks[*pixel]);
        f64::from(difference(left, right, largest))
    };
    Some(pixels.iter().map(flip).sum::<f64>() / pixels.len() as f64)
}

/// The appearance of a pixel.
struct Look {
    /// Hunt-adjusted L*a*b*, after the eye's blur.
    color: [f32; 3],
    /// The strength of an edge and of a point, in shares of white's luminance.
    features: [f32; 2],
}

/// The appearance of every pixel.
fn looks<T: Into<f64> + Copy + Sync>(picture: &Picture<T>, pixels_per_degree: f64) -> Vec<Look> {
    let opponent = |levels: &[T; 3]| {
        let bytes = levels.map(|level| f64::from(display_step(level.into())));
        opponent_from_srgb(bytes.map(|byte| (byte / 255.0) as f32))
    };
    let opponent: Vec<[f32; 3]> = picture.levels.par_iter().map(opponent).collect();
    let plane = |channel: usize| opponent.iter().map(|it| it[channel]).collect::<Vec<f32>>();
    let planes = [0, 1, 2].map(plane);
    let filtered = |plane, across: &Taps, down: &Taps| filtered(plane, picture.width, across, down);
    let blurred = [0, 1, 2].map(|channel| {
        let mut sums = vec![0.0; opponent.len()];
        for taps in contrast(CONTRAST[channel], pixels_per_degree) {
            let part = filtered(&planes[channel], &taps, &taps);
            sums.iter_mut()
                .zip(part)
                .for_each(|(sum, value)| *sum += value);
        }
        sums
    });
    let [along, edge, point] = features(pixels_per_degree);
    let strengths = [edge, point].map(|derivative| {
        let across = filtered(&planes[0], &derivative, &along);
        let down = filtered(&planes[0], &along, &derivative);
        let both = across.iter().zip(down);
        both.map(|(across, down)| across.hypot(down))
            .collect::<Vec<f32>>()
    });
    let look = |pixel: usize| {
        let linear = linear_from_opponent(blurred.each_ref().map(|plane| plane[pixel]));
        Look {
            color: hunt_lab(linear.map(|it| it.clamp(0.0, 1.0))),
            features: strengths.each_ref().map(|plane| plane[pixel]),
        }
    };
    (0..opponent.len()).into_par_iter().map(look).collect()
}

/// The FLIP of one pixel, 0..=1. `largest` is the largest possible colour difference.
fn difference(left: &Look, right: &Look, largest: f32) -> f32 {
    let color = distance(left.color, right.color).powf(COLOR_EXPONENT);
    let knee = SHARE * largest;
    let color = if color < knee {
        TARGET * color / knee
    } else {
        TARGET + (1.0 - TARGET) * (color - knee) / (largest - knee)
    };
    let [edge, point] = [0, 1].map(|i| (left.features[i] - right.features[i]).abs());
    let feature = (edge.max(point) / 2.0_f32.sqrt()).powf(FEATURE_EXPONENT);
    color.powf(1.0 - feature)
}

/// One weight for each pixel along one direction. The middle one belongs to the pixel itself.
type Taps = Vec<f32>;

/// The Gaussians of a contrast sensitivity, up to three standard deviations of the widest. The weights of their products
/// across and down sum to 1.
fn contrast(gaussians: &[[f64; 2]], pixels_per_degree: f64) -> Vec<Taps> {
    let radius = 3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * pixels_per_degree;
    let parts = gaussians.iter().map(|[a, b]| {
        let amplitude = (a * (PI / b).sqrt()).sqrt();
        let gaussian = |x: f64| (-(PI * x / pixels_per_degree).powi(2) / b).exp();
        weights(radius, |x| amplitude * gaussian(x))
    });
    let parts: Vec<Vec<f64>> = parts.collect();
    let square = |weights: &Vec<f64>| weights.iter().sum::<f64>().powi(2);
    let whole = parts.iter().map(square).sum::<f64>().sqrt();
    let taps = |weights: Vec<f64>| weights.into_iter().map(|it| (it / whole) as f32).collect();
    parts.into_iter().map(taps).collect()
}

/// A Gaussian and its first and second derivative, which find edges and points: of values 0..=1 for a luminance of
/// -16..=100.
fn features(pixels_per_degree: f64) -> [Taps; 3] {
    let deviation = 0.5 * FEATURE_WIDTH * pixels_per_degree;
    let gaussian = |x: f64| (-x * x / (2.0 * deviation * deviation)).exp();
    let point = |x: f64| (x * x / (deviation * deviation) - 1.0) * gaussian(x);
    [
        balanced(&weights(3.0 * deviation, gaussian), 1.0),
        balanced(&weights(3.0 * deviation, |x| -x * gaussian(x)), 1.0 / 116.0),
        balanced(&weights(3.0 * deviation, point), 1.0 / 116.0),
    ]
}

fn weights(radius: f64, weight: impl Fn(f64) -> f64) -> Vec<f64> {
    let radius = radius.ceil() as i32;
    (-radius..=radius).map(|x| weight(f64::from(x))).collect()
}

/// The weights scaled so that the positive sum to `sum` and the negative to `-sum`.
fn balanced(weights: &[f64], sum: f64) -> Taps {
    let whole = |sign: f64| weights.iter().map(|it| (sign * it).max(0.0)).sum::<f64>();
    let [positive, negative] = [1.0, -1.0].map(whole);
    let scaled = |weight: &f64| {
        let whole = if *weight < 0.0 { negative } else { positive };
        (weight / whole * sum) as f32
    };
    weights.iter().map(scaled).collect()
}

/// The values of a picture after a filter across the columns and one down the rows.
fn filtered(values: &[f32], width: usize, across: &Taps, down: &Taps) -> Vec<f32> {
    let height = values.len() / width;
    transposed(&transposed(values, width, across), height, down)
}

/// The values of a picture after a filter across the columns, column by column.
fn transposed(values: &[f32], width: usize, taps: &Taps) -> Vec<f32> {
    let reach = taps.len() / 2;
    let filtered = |row: &[f32]| {
        let place = |x: usize| row[x.saturating_sub(reach).min(width - 1)];
        let padded: Vec<f32> = (0..width + 2 * reach).map(place).collect();
        let mut sums = vec![0.0; width];
        for (weight, shifted) in taps.iter().zip(padded.windows(width)) {
            let sums = sums.iter_mut().zip(shifted);
            sums.for_each(|(sum, value)| *sum += weight * value);
        }
        sums
    };
    let rows: Vec<Vec<f32>> = values.par_chunks_exact(width).map(filtered).collect();
    let column = |x: usize| rows.iter().map(move |row| row[x]);
    (0..width).flat_map(column).collect()
}
