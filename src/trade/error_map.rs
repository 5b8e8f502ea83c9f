//! Where the error of a picture lies: two pictures in, one picture of their difference out.
//!
//! Rule: one scale for every map, stated in its legend, so that colours of any two maps compare: from 0 to 255 levels,
//! even in log(1 + error / [`KNEE`]), which shows half a level as well as a missing highlight.

mod legend;

pub(crate) use legend::draw_scale;

use super::metrics::{Picture, pixel_error};
use crate::frame::{NO_TRIANGLE, display_step};

/// Well below this error, in levels, the scale is even in the error itself; well above, in its logarithm.
pub const KNEE: f64 = 0.25;

/// The colour of a pixel where neither picture shows anything.
pub const NOTHING: u32 = 0x005c_6166;

/// The colour of a pixel where the pictures show different faces, so that there is no error to show.
pub const EDGE: u32 = 0x0035_c28a;

/// Coefficients of 1, t, t^2, ... for red, green and blue, 0..=1.
///
/// Fitted by least squares to every eighth colour of magma (van der Walt and Smith 2015, matplotlib, CC0), from which
/// it differs by less than 6 of 255.
const MAGMA: [[f64; 7]; 3] = [
    [
        -0.0011, 0.2559, 8.0863, -26.0652, 48.3106, -46.6983, 17.1074,
    ],
    [0.0014, 0.6091, -2.692, 10.3584, -20.0632, 21.5885, -8.8214],
    [0.0023, 2.207, 2.4994, -20.8892, 24.8291, -5.2793, -2.6193],
];

/// How far up the scale an error in levels stands, 0..=1.
pub fn position(error: f64) -> f64 {
    ((error / KNEE).ln_1p() / (255.0 / KNEE).ln_1p()).clamp(0.0, 1.0)
}

/// The error in levels that stands so far up the scale, 0..=1.
pub fn error_at(position: f64) -> f64 {
    KNEE * (position * (255.0 / KNEE).ln_1p()).exp_m1()
}

/// The colour, 0x00RRGGBB, of an error in levels, 0..=255.
pub fn color(error: f64) -> u32 {
    color_at(position(error))
}

fn color_at(position: f64) -> u32 {
    let [red, green, blue] = MAGMA.map(|coefficients| {
        let value = coefficients
            .iter()
            .rev()
            .fold(0.0, |sum, c| sum * position + c);
        display_step(255.0 * value)
    });
    u32::from_be_bytes([0, red, green, blue])
}

/// The errors of a picture, each as one of 254 steps of the scale.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ErrorMap {
    width: usize,
    steps: Vec<u8>,
}

impl ErrorMap {
    /// Colours that tell errors apart; the two codes above are no errors.
    const STEPS: u8 = 254;
    const EDGE: u8 = 254;
    const NOTHING: u8 = 255;

    /// The map of two pictures of one size.
    pub fn between<T, U>(left: Picture<T>, right: Picture<U>) -> Self
    where
        T: Into<f64> + Copy,
        U: Into<f64> + Copy,
    {
        let step = |pixel: usize| {
            if [left.triangles[pixel], right.triangles[pixel]] == [NO_TRIANGLE; 2] {
                ErrorMap::NOTHING
            } else if left.shows_as(&right, pixel) {
                let position = position(pixel_error(left.levels[pixel], right.levels[pixel]));
                (position * f64::from(ErrorMap::STEPS - 1)).round() as u8
            } else {
                ErrorMap::EDGE
            }
        };
        ErrorMap {
            width: left.width,
            steps: (0..left.levels.len()).map(step).collect(),
        }
    }

    /// The map as pixels, 0x00RRGGBB, row by row from the top.
    pub fn pixels(&self) -> Vec<u32> {
        let mut palette = [NOTHING; 256];
        palette[usize::from(ErrorMap::EDGE)] = EDGE;
        for (step, color) in palette[..usize::from(ErrorMap::STEPS)]
            .iter_mut()
            .enumerate()
        {
            *color = color_at(step as f64 / f64::from(ErrorMap::STEPS - 1));
        }
        self.steps
            .iter()
            .map(|step| palette[usize::from(*step)])
            .collect()
    }

    /// The map with `title` and its scale below: pixels and size. A narrow map gets room for them beside it.
    pub fn with_legend(&self, title: &str) -> (Vec<u32>, [usize; 2]) {
        let width = self.width.max(legend::WIDTH);
        let height = self.steps.len() / self.width;
        let mut pixels = vec![legend::PAPER; width * (height + legend::HEIGHT)];
        for (row, line) in self.pixels().chunks_exact(self.width).enumerate() {
            pixels[row * width..][..self.width].copy_from_slice(line);
        }
        legend::draw(&mut pixels[width * height..], width, title);
        (pixels, [width, height + legend::HEIGHT])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn channels(color: u32) -> [i32; 3] {
        let [_, red, green, blue] = color.to_be_bytes();
        [red, green, blue].map(i32::from)
    }

    #[test]
    fn the_colours_are_magma() {
        // matplotlib's magma at 0, 128/255 and 1, times 255.
        for (at, expected) in [
            (0.0, [0, 0, 4]),
            (128.0 / 255.0, [183, 55, 121]),
            (1.0, [252, 253, 191]),
        ] {
            let found = channels(color_at(at));
            let near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= 6);
            assert!(near, "{found:?} is not {expected:?}");
        }
    }

    #[test]
    fn the_scale_runs_from_none_to_all_and_shows_half_a_level() {
        assert_eq!(position(0.0), 0.0);
        assert_eq!(position(255.0), 1.0);
        // ln(1 + 0.5 / 0.25) / ln(1 + 255 / 0.25) = ln 3 / ln 1021.
        assert!((error_at(position(0.5)) - 0.5).abs() < 1e-12);
        assert!((position(0.5) - 3.0_f64.ln() / 1021.0_f64.ln()).abs() < 1e-12);
        assert!(
            channels(color(0.5)).iter().sum::<i32>()
                > channels(color(0.0)).iter().sum::<i32>() + 60
        );
    }

    #[test]
    fn background_edges_and_errors_are_told_apart() {
        let levels = [[0.0; 3], [0.0; 3], [9.0; 3], [300.0; 3]];
        let left = Picture {
            width: 2,
            levels: &levels,
            triangles: &[NO_TRIANGLE, 0, 1, 1],
        };
        let right = Picture {
            levels: &[[0.0; 3]; 4],
            triangles: &[NO_TRIANGLE, 2, 1, 1],
            ..left
        };
        let map = ErrorMap::between(left, right);
        assert_eq!(map.pixels()[..2], [NOTHING, EDGE]);
        assert_eq!(map.pixels()[3], color(255.0));
        let (pixels, size) = map.with_legend("title");
        assert_eq!(size, [legend::WIDTH, 2 + legend::HEIGHT]);
        assert_eq!(pixels.len(), size[0] * size[1]);
        assert_eq!(
            pixels[legend::WIDTH..][..3],
            [map.pixels()[2], map.pixels()[3], legend::PAPER]
        );
    }
}
