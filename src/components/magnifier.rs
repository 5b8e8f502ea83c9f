//! The magnified picture in an area of the window: every pixel is a square of one size.

use serde::{Deserialize, Serialize};

use super::range;

/// The size of a pixel in the window, and the pixel in the upper left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Magnifier {
    /// Pixels of the window across one of the picture: a power of two up to [`Magnifier::MAX_SCALE`].
    pub scale: usize,
    /// The pixel of the picture in the upper left corner.
    #[serde(deserialize_with = "range::array")]
    pub corner: [usize; 2],
}

impl Default for Magnifier {
    fn default() -> Self {
        Magnifier {
            scale: 1,
            corner: [0, 0],
        }
    }
}

impl Magnifier {
    /// The largest scale. It has room for the bytes of a pixel.
    pub const MAX_SCALE: usize = 64;

    /// The nearest magnifier that fills an area of `size` pixels with a picture of that size.
    #[must_use]
    pub fn within(self, size: [usize; 2]) -> Self {
        let scale = 1 << self.scale.clamp(1, Self::MAX_SCALE).ilog2();
        let last = size.map(|side| side - side.div_ceil(scale));
        Magnifier {
            scale,
            corner: [0, 1].map(|axis| self.corner[axis].min(last[axis])),
        }
    }

    /// The pixel at `place`, counted from the area's upper left corner.
    pub fn pixel(self, place: [i32; 2]) -> [usize; 2] {
        [0, 1].map(|axis| self.corner[axis] + place[axis].max(0) as usize / self.scale)
    }

    /// The place of the middle of a pixel, which may lie outside the area.
    pub fn place(self, pixel: [i32; 2]) -> [i32; 2] {
        let scale = self.scale as i32;
        [0, 1].map(|axis| (pixel[axis] - self.corner[axis] as i32) * scale + scale / 2)
    }

    /// The magnifier with a scale of `steps` more powers of two. The pixel at `place` stays there.
    #[must_use]
    pub fn stepped(self, steps: i32, place: [i32; 2], size: [usize; 2]) -> Self {
        let power = (self.scale.ilog2() as i32).saturating_add(steps);
        let scale = 1 << power.clamp(0, Self::MAX_SCALE.ilog2() as i32);
        let pixel = self.pixel(place);
        let before = place.map(|it| it.max(0) as usize / scale);
        let corner = [0, 1].map(|axis| pixel[axis].saturating_sub(before[axis]));
        Magnifier { scale, corner }.within(size)
    }

    /// The magnifier with the picture moved right and down, in pixels of the window.
    #[must_use]
    pub fn panned(self, by: [i32; 2], size: [usize; 2]) -> Self {
        let scale = self.scale as i32;
        let corner = [0, 1].map(|axis| {
            let moved =
                self.corner[axis] as i32 - (f64::from(by[axis]) / f64::from(scale)).round() as i32;
            moved.max(0) as usize
        });
        Magnifier {
            scale: self.scale,
            corner,
        }
        .within(size)
    }
}
