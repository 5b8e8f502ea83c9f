//! Where the error of a picture lies: two pictures in, one picture of their difference out.
//!
//! Rule: a map's scale is stated in its legend: from 0 to its top, even in log(1 + 1020 error / top), which shows half of
//! 255 levels as well as a thousandth. Maps in files have the widest one, so that colours of any two of them compare; a
//! window takes the narrowest that holds what it shows.

mod legend;

use super::metrics::{Picture, pixel_error};
use crate::frame::{NO_TRIANGLE, display_pixel};

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

/// What a pixel of two pictures says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pixel {
    /// How far they are apart, in levels, 0..=255.
    Error(f32),
    /// They show different faces there.
    Edge,
    /// Neither shows anything there.
    Nothing,
}

/// Which colours errors have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// The largest error that has a colour of its own, in levels.
    top: f64,
}

impl Scale {
    /// All errors there are.
    pub const WIDEST: Scale = Scale { top: 255.0 };
    const NARROW_TOPS: [f64; 5] = [0.001, 0.01, 0.1, 1.0, 10.0];
    /// The top over the error well below which the scale is even in the error itself, and above in its logarithm.
    const RANGE: f64 = 1020.0;

    /// The narrowest one that holds errors up to this one.
    pub fn holding(error: f64) -> Scale {
        let mut tops = Scale::NARROW_TOPS.into_iter();
        let top = tops.find(|top| error <= *top);
        top.map_or(Scale::WIDEST, |top| Scale { top })
    }

    /// The errors that are written beside the colours, in levels.
    pub fn ticks(self) -> Vec<f64> {
        if self == Scale::WIDEST {
            vec![0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 255.0]
        } else {
            [0.0, 5.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0]
                .map(|thousandths| thousandths * self.top / 1000.0)
                .to_vec()
        }
    }

    /// How far up the scale an error in levels stands, 0..=1.
    pub fn position(self, error: f64) -> f64 {
        ((error / self.top * Scale::RANGE).ln_1p() / Scale::RANGE.ln_1p()).clamp(0.0, 1.0)
    }

    /// The colour of a pixel, 0x00RRGGBB.
    pub fn color(self, pixel: Pixel) -> u32 {
        match pixel {
            Pixel::Error(error) => color_at(self.position(f64::from(error))),
            Pixel::Edge => EDGE,
            Pixel::Nothing => NOTHING,
        }
    }
}

/// What two pictures of one size say, pixel by pixel.
pub fn compared<T, U>(left: Picture<T>, right: Picture<U>) -> impl Iterator<Item = Pixel>
where
    T: Into<f64> + Copy,
    U: Into<f64> + Copy,
{
    (0..left.levels.len()).map(move |pixel| {
        if [left.triangles[pixel], right.triangles[pixel]] == [NO_TRIANGLE; 2] {
            Pixel::Nothing
        } else if left.shows_as(&right, pixel) {
            Pixel::Error(pixel_error(left.levels[pixel], right.levels[pixel]) as f32)
        } else {
            Pixel::Edge
        }
    })
}

fn color_at(position: f64) -> u32 {
    display_pixel(MAGMA.map(|coefficients| {
        let powers = coefficients.iter().rev();
        255.0 * powers.fold(0.0, |sum, c| sum * position + c)
    }))
}

/// The errors of a picture, each as one of 254 steps of the widest scale.
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
        let width = left.width;
        let step = |pixel| match pixel {
            Pixel::Error(error) => {
                let position = Scale::WIDEST.position(f64::from(error));
                (position * f64::from(ErrorMap::STEPS - 1)).round() as u8
            }
            Pixel::Edge => ErrorMap::EDGE,
            Pixel::Nothing => ErrorMap::NOTHING,
        };
        ErrorMap {
            width,
            steps: compared(left, right).map(step).collect(),
        }
    }

    /// The map as pixels, 0x00RRGGBB, row by row from the top.
    pub fn pixels(&self) -> Vec<u32> {
        let palette: [u32; 256] = std::array::from_fn(|step| match step as u8 {
            ErrorMap::EDGE => EDGE,
            ErrorMap::NOTHING => NOTHING,
            step => color_at(f64::from(step) / f64::from(ErrorMap::STEPS - 1)),
        });
        let steps = self.steps.iter();
        steps.map(|step| palette[usize::from(*step)]).collect()
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
        let scale = Scale::WIDEST;
        assert_eq!(scale.position(0.0), 0.0);
        assert_eq!(scale.position(255.0), 1.0);
        // ln(1 + 1020 0.5 / 255) / ln(1 + 1020) = ln 3 / ln 1021.
        assert!((scale.position(0.5) - 3.0_f64.ln() / 1021.0_f64.ln()).abs() < 1e-12);
        let sum = |error| {
            channels(scale.color(Pixel::Error(error)))
                .iter()
                .sum::<i32>()
        };
        assert!(sum(0.5) > sum(0.0) + 60);
    }

    #[test]
    fn the_narrowest_scale_that_holds_an_error_shows_it_and_ends_with_a_tick() {
        for (error, top, first) in [
            (0.0, 0.001, "0.000005"),
            (0.001, 0.001, "0.000005"),
            (0.06, 0.1, "0.0005"),
            (1.0, 1.0, "0.005"),
            (1.1, 10.0, "0.05"),
            (10.1, 255.0, "0.5"),
        ] {
            let scale = Scale::holding(error);
            assert_eq!(scale.top, top, "{error}");
            assert_eq!(scale.ticks()[1].to_string(), first);
            assert_eq!(scale.ticks().last(), Some(&top));
            assert_eq!(scale.position(top), 1.0);
        }
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
        assert_eq!(map.pixels()[3], Scale::WIDEST.color(Pixel::Error(255.0)));
        let (pixels, size) = map.with_legend("title");
        assert_eq!(size, [legend::WIDTH, 2 + legend::HEIGHT]);
        assert_eq!(pixels.len(), size[0] * size[1]);
        assert_eq!(
            pixels[legend::WIDTH..][..3],
            [map.pixels()[2], map.pixels()[3], legend::PAPER]
        );
    }
}
