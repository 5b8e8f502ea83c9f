//! The filters of FLIP: the contrast that an eye resolves, and the edges and points that it finds.
//!
//! A filter is a sum of products of a filter across the columns and one down the rows, so its cost grows with its width and
//! not with its area. All filters of an eye have one reach, and a filtered plane is smaller by it on every side.

use std::f64::consts::PI;

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

/// One weight per pixel along one direction, from `-reach` to `reach`.
type Taps = Vec<f32>;

/// A sum of products of taps across and taps down.
pub struct Filter(Vec<[Taps; 2]>);

/// Values row by row.
pub struct Plane {
    /// Values in a row.
    pub width: usize,
    /// The values.
    pub values: Vec<f32>,
}

/// The radius of the contrast filters in pixels: three standard deviations of the widest.
pub fn contrast_radius(pixels_per_degree: f64) -> usize {
    (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as usize
}

/// The radius of the feature filters in pixels: three standard deviations.
pub fn feature_radius(pixels_per_degree: f64) -> usize {
    (3.0 * 0.5 * FEATURE_WIDTH * pixels_per_degree).ceil() as usize
}

/// The contrast sensitivity in luminance, red-green and blue-yellow; the weights of each sum to 1.
pub fn contrast(pixels_per_degree: f64, reach: usize) -> [Filter; 3] {
    let radius = contrast_radius(pixels_per_degree);
    CONTRAST.map(|gaussians| {
        let parts = gaussians.iter().map(|[a, b]| {
            let amplitude = (a * (PI / b).sqrt()).sqrt();
            let gaussian = |x: f64| (-(PI * x / pixels_per_degree).powi(2) / b).exp();
            weights(radius, reach, |x| amplitude * gaussian(x))
        });
        let parts: Vec<Vec<f64>> = parts.collect();
        let sums = parts.iter().map(|taps| taps.iter().sum::<f64>());
        let whole = sums.map(|sum| sum * sum).sum::<f64>().sqrt();
        let taps = |taps: &Vec<f64>| {
            let across: Taps = taps.iter().map(|weight| (weight / whole) as f32).collect();
            [across.clone(), across]
        };
        Filter(parts.iter().map(taps).collect())
    })
}

/// Edges and points, each across and down: the first and second derivative of a Gaussian, of values 0..=1 for a
/// luminance of -16..=100.
pub fn features(pixels_per_degree: f64, reach: usize) -> [[Filter; 2]; 2] {
    let deviation = 0.5 * FEATURE_WIDTH * pixels_per_degree;
    let radius = feature_radius(pixels_per_degree);
    let gaussian = |x: f64| (-x * x / (2.0 * deviation * deviation)).exp();
    let along = balanced(&weights(radius, reach, gaussian), 1.0);
    let edge = weights(radius, reach, |x| -x * gaussian(x));
    let point = weights(radius, reach, |x| {
        (x * x / (deviation * deviation) - 1.0) * gaussian(x)
    });
    [edge, point].map(|derivative| {
        let derivative = balanced(&derivative, 1.0 / 116.0);
        [
            Filter(vec![[derivative.clone(), along.clone()]]),
            Filter(vec![[along.clone(), derivative]]),
        ]
    })
}

/// The weight at every pixel up to `radius`, and 0 beyond.
fn weights(radius: usize, reach: usize, weight: impl Fn(f64) -> f64) -> Vec<f64> {
    let places = (0..=2 * reach).map(|index| index as f64 - reach as f64);
    places
        .map(|x| {
            if x.abs() <= radius as f64 {
                weight(x)
            } else {
                0.0
            }
        })
        .collect()
}

/// The weights scaled so that the positive sum to `sum` and the negative to `-sum`.
fn balanced(weights: &[f64], sum: f64) -> Taps {
    let positive: f64 = weights.iter().filter(|weight| **weight > 0.0).sum();
    let negative: f64 = weights.iter().filter(|weight| **weight < 0.0).sum();
    let scaled = |weight: &f64| match *weight {
        weight if weight > 0.0 => (weight / positive * sum) as f32,
        weight if weight < 0.0 => (-weight / negative * sum) as f32,
        _ => 0.0,
    };
    weights.iter().map(scaled).collect()
}

impl Plane {
    /// The filtered plane, smaller by the filter's reach on every side.
    pub fn filtered(&self, filter: &Filter) -> Plane {
        let reach = filter.0[0][0].len() - 1;
        let width = self.width - reach;
        let height = self.values.len() / self.width - reach;
        let mut filtered = Plane {
            width,
            values: vec![0.0; width * height],
        };
        for [across, down] in &filter.0 {
            let lines = self.across(across);
            for (row, sums) in filtered.values.chunks_exact_mut(width).enumerate() {
                for (line, weight) in lines.values.chunks_exact(width).skip(row).zip(down) {
                    accumulate(sums, *weight, line);
                }
            }
        }
        filtered
    }

    fn across(&self, taps: &Taps) -> Plane {
        let width = self.width + 1 - taps.len();
        let mut filtered = Plane {
            width,
            values: vec![0.0; self.values.len() / self.width * width],
        };
        for (sums, row) in filtered
            .values
            .chunks_exact_mut(width)
            .zip(self.values.chunks_exact(self.width))
        {
            for (shift, weight) in taps.iter().enumerate() {
                accumulate(sums, *weight, &row[shift..]);
            }
        }
        filtered
    }
}

fn accumulate(sums: &mut [f32], weight: f32, values: &[f32]) {
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += weight * value;
    }
}
