//! The judgement of the rows of a picture: in squares, and pixel by pixel.

use std::ops::Range;
use std::{array, mem};

use super::pixel::UNKNOWN;
use super::{Mark, Proof, Shown, Verdict, judge, nearest};
use crate::components::TriangleId;
use crate::reference::{EnclosedSquare, Interval, Reference, Seen};
use crate::systems::frame::{Frame, display_pixel};

/// The share of the limit that the error of a square's enclosure may take. Smaller shares need smaller squares; with larger ones
/// more pixels are enclosed by themselves.
const SHARE_OF_SQUARES: f64 = 0.25;

/// The relative error of the difference of two levels and its bounds: far more than their few operations of f64 make.
const F64_ROUNDING: f64 = 1e-12;

/// A picture to be proven at several limits, and its enclosures.
pub struct Judgement<'a, const COUNT: usize> {
    pub enclosures: Reference<Interval>,
    pub reference: Reference<f64>,
    /// The picture of another program.
    pub picture: Option<&'a [u32]>,
    /// Levels and bytes of the renderer's picture, from `first_row` on.
    pub frames: [[Frame; 2]; COUNT],
    /// In levels.
    pub limits: [f64; COUNT],
    pub width: usize,
    pub first_row: usize,
}

impl<const COUNT: usize> Judgement<'_, COUNT> {
    /// A pixel as it is drawn at the limit of this index.
    fn shown(&self, at: usize, [x, y]: [usize; 2], seen: &[Seen<Interval>]) -> Shown {
        if let Some(picture) = self.picture {
            return Shown::of_bytes(picture[y * self.width + x], seen, self.limits[at]);
        }
        let [levels, display] = &self.frames[at];
        Shown::at((y - self.first_row) * self.width + x, levels, display)
    }

    /// Proves some rows, at most [`MAX_ENCLOSED_SIDE`](crate::reference::MAX_ENCLOSED_SIDE) of them: in squares, and the
    /// pixels that these leave open by themselves.
    pub fn strip(&self, rows: &Range<usize>) -> [Proof; COUNT] {
        let mut is_open = vec![true; rows.len() * self.width];
        let mut proofs = self.limits.map(|_| Proof {
            marks: vec![UNKNOWN; is_open.len()],
            ..Proof::default()
        });
        if self.picture.is_none() {
            let least = self.limits.into_iter().fold(f64::INFINITY, f64::min);
            for square in self.enclosures.squares(rows, least * SHARE_OF_SQUARES) {
                self.add_square(&square, rows.start, &mut is_open, &mut proofs);
            }
        }
        for (y, is_open) in rows.clone().zip(is_open.chunks(self.width)) {
            let first = (y - rows.start) * self.width;
            let open = (0..self.width).filter(|x| is_open[*x]);
            let mut seen_in_f64 = Vec::new();
            (self.reference).part_of_row(y, open.clone(), |_, seen| seen_in_f64.push(seen[0]));
            let mut floats = seen_in_f64.into_iter();
            self.enclosures.part_of_row(y, open, |x, seen| {
                let float = floats.next();
                let error = float.and_then(|it| nearest(it.face(), it.levels, seen));
                let most = error.map_or(255.0, |[_, most]| most);
                for (at, proof) in proofs.iter_mut().enumerate() {
                    let shown = self.shown(at, [x, y], seen);
                    proof.marks[first + x] = proof.add([x, y], shown, seen, self.limits[at]);
                    proof.reference_error = proof.reference_error.max(most);
                }
            });
        }
        proofs
    }

    /// Adds the pixels that the enclosure of their square proves at all limits. The others stay open.
    fn add_square(
        &self,
        square: &EnclosedSquare,
        first_row: usize,
        is_open: &mut [bool],
        proofs: &mut [Proof; COUNT],
    ) {
        let mark = Mark {
            verdict: Verdict::Proven,
            is_outline: false,
            is_covered: square.triangle != TriangleId::NONE,
        };
        let width = square.columns.len();
        for y in square.rows.clone() {
            let [of_frame, of_strip] = [self.first_row, first_row]
                .map(|first| (y - first) * self.width + square.columns.start);
            let rows = (self.frames.each_ref())
                .map(|frames| DrawnRow::new(frames, of_frame..of_frame + width));
            // Most rows of the background are of one colour, and are judged at once.
            let is_even = !mark.is_covered && rows.iter().all(DrawnRow::is_even);
            let count = if is_even { width } else { 1 };
            for (x, levels) in square.row(y).enumerate().step_by(count) {
                let errors: [_; COUNT] =
                    array::from_fn(|at| rows[at].error(x, square, levels, self.limits[at]));
                if errors.contains(&None) {
                    continue;
                }
                let pixels = of_strip + x..of_strip + x + count;
                is_open[pixels.clone()].fill(false);
                let pixel = [square.columns.start + x, y];
                for (proof, error) in proofs.iter_mut().zip(errors.into_iter().flatten()) {
                    proof.add_in_square(pixel, pixels.clone(), mark, error);
                }
            }
        }
    }

    /// Finds the largest error among pixels of squares: those that may have it are enclosed by themselves.
    pub fn find_worst(&self, at: usize, proof: &mut Proof) {
        let mut candidates = mem::take(&mut proof.candidates);
        candidates.sort_by(|(_, one), (_, other)| other.total_cmp(one));
        for (pixel, most) in candidates {
            if most <= proof.worst {
                return;
            }
            let seen = self.enclosures.at(pixel);
            let (_, [_, most]) = judge(self.shown(at, pixel, &seen), &seen, self.limits[at]);
            proof.worst = proof.worst.max(most);
        }
    }
}

/// Pixels of the renderer's picture beside one another.
struct DrawnRow<'a> {
    triangles: &'a [TriangleId],
    levels: &'a [[f32; 3]],
    pixels: &'a [u32],
}

impl<'a> DrawnRow<'a> {
    fn new([levels, display]: &'a [Frame; 2], pixels: Range<usize>) -> Self {
        DrawnRow {
            triangles: &levels.triangles()[pixels.clone()],
            levels: &levels.levels()[pixels.clone()],
            pixels: &display.pixels()[pixels],
        }
    }

    /// Whether all are drawn alike.
    fn is_even(&self) -> bool {
        are_equal(self.triangles) && are_equal(self.levels) && are_equal(self.pixels)
    }

    /// Bounds of the error of pixel `x`, the least and the largest, over the channels. `enclosed` is the square's polynomial at
    /// the pixel; exact levels differ from it by at most `square.error`. `None` if the square does not prove the pixel: it
    /// shows another face, its bytes are not the display step of its levels, or the bound exceeds `limit`. Because of the
    /// second condition a proof of the levels is one of the bytes.
    fn error(
        &self,
        x: usize,
        square: &EnclosedSquare,
        enclosed: [f64; 3],
        limit: f64,
    ) -> Option<[f64; 2]> {
        let drawn = self.levels[x].map(f64::from);
        if self.triangles[x].face_id() != square.triangle.face_id()
            || self.pixels[x] != display_pixel(drawn)
        {
            return None;
        }
        let mut errors = [0.0_f64; 2];
        for channel in 0..3 {
            let [one, other] = [drawn, enclosed].map(|it| it[channel].clamp(0.0, 255.0));
            let (distance, error) = ((one - other).abs(), square.error[channel]);
            let rounding = (distance + error) * F64_ROUNDING;
            let most = distance + error + rounding;
            // A level that is not a number has no error.
            if most.is_nan() || most > limit {
                return None;
            }
            errors = [
                errors[0].max(distance - error - rounding),
                errors[1].max(most),
            ];
        }
        Some(errors)
    }
}

fn are_equal<T: PartialEq>(values: &[T]) -> bool {
    values.iter().all(|value| *value == values[0])
}
