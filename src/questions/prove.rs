//! The proof of a picture: every pixel is compared with intervals that enclose its exact levels.
//!
//! ```text
//! World --FRAME--> levels, bytes, faces ---+
//!  or a PNG of any program --> bytes ------+--judge--> proven, undecided, a gap or refuted
//! World --reference over intervals--> faces that each pixel may show, and their levels
//!       --reference over f64--> the reference's own error
//! ```
//! `pixel` says when a pixel is proven.
//!
//! Under Phong, and beside the cuboids, most pixels are enclosed in squares, which takes a fraction of the time. The enclosure of a
//! square is wider, so a pixel that it leaves open is enclosed by itself: verdicts do not depend on squares.

mod cause;
pub mod command;
mod judgement;
mod pixel;

use std::ops::Range;

use fearless_simd::Level;
use hecs::World;
use serde::Serialize;

pub use self::cause::causes;
use self::judgement::Judgement;
use self::pixel::{BYTE_ROUNDING, compared, visible};
pub use self::pixel::{Mark, Shown, Verdict, judge, nearest, shown};
use crate::components::View;
use crate::output::progress::bands;
use crate::output::{Monitor, memory};
use crate::questions::metrics::{displayed, ends};
use crate::reference::{Interval, MAX_ENCLOSED_SIDE, Reference, Seen};
use crate::shading::limit;
use crate::systems;
use crate::systems::frame::{Frame, Keep, Workers};

/// The most pixels in the list of examples.
const EXAMPLES: usize = 10;

/// A pixel that is not proven.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Example {
    pub pixel: [usize; 2],
    pub verdict: Verdict,
    /// Displayed levels.
    pub drawn: [f64; 3],
    /// The least and the largest displayed level, by channel.
    pub enclosure: [[f64; 2]; 3],
    /// The least and the largest possible error, in levels of 255.
    pub error: [f64; 2],
    /// The face of the enclosure, cuboid * 6 + face; `None` is the background.
    pub face: Option<usize>,
    /// The face that is drawn, cuboid * 6 + face; `None` is the background.
    pub drawn_face: Option<usize>,
}

/// The proof of a picture. Errors and widths are between displayed levels.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Proof {
    /// The largest allowed error of a pixel, in levels of 255.
    pub limit: f64,
    pub pixels: usize,
    pub proven: u64,
    pub refuted: u64,
    pub undecided: u64,
    /// Pixels that show what touching faces hide.
    pub gaps: u64,
    /// Pixels with an edge so near that they may show either side.
    pub outline: u64,
    /// Pixels that show a cuboid.
    pub covered: u64,
    /// Pixels that may show nothing but a cuboid, and those of them that are proven.
    pub own: u64,
    pub own_proven: u64,
    /// Pixels that the enclosure of their square proves.
    pub in_squares: u64,
    /// The largest possible error of a proven pixel.
    pub worst: f64,
    /// The widest enclosure of a pixel by itself.
    pub widest_enclosure: f64,
    /// The largest possible error of the f64 reference, at pixels that are enclosed by themselves.
    pub reference_error: f64,
    /// The pixels that are not proven: the refuted ones first, then gaps, and of each the ones with the largest errors.
    pub examples: Vec<Example>,
    /// Row by row from the top.
    #[serde(skip)]
    pub marks: Vec<Mark>,
    /// The pixels of squares that may have the largest error, with their largest possible error.
    #[serde(skip)]
    candidates: Vec<([usize; 2], f64)>,
    /// The largest error of the pixels of squares is at least this.
    #[serde(skip)]
    least_worst: f64,
}

impl Proof {
    /// Whether every pixel is proven.
    pub fn is_all(&self) -> bool {
        self.proven == self.pixels as u64
    }

    /// Counts the marks.
    fn count(&mut self) {
        let count = |is: fn(&&Mark) -> bool| self.marks.iter().filter(is).count() as u64;
        self.proven = count(|mark| mark.verdict == Verdict::Proven);
        self.undecided = count(|mark| mark.verdict == Verdict::Undecided);
        self.gaps = count(|mark| mark.verdict == Verdict::Gap);
        self.refuted = count(|mark| mark.verdict == Verdict::Refuted);
        self.outline = count(|mark| mark.is_outline);
        self.covered = count(|mark| mark.is_covered);
    }

    /// The proof of this picture and another one.
    #[must_use]
    pub fn and(mut self, other: Proof) -> Proof {
        self.limit = self.limit.max(other.limit);
        self.pixels += other.pixels;
        self.append(other);
        self.count();
        self
    }

    /// Adds the proof of the rows below.
    fn append(&mut self, below: Proof) {
        self.worst = self.worst.max(below.worst);
        self.widest_enclosure = self.widest_enclosure.max(below.widest_enclosure);
        self.reference_error = self.reference_error.max(below.reference_error);
        self.own += below.own;
        self.own_proven += below.own_proven;
        self.in_squares += below.in_squares;
        self.least_worst = self.least_worst.max(below.least_worst);
        self.candidates.extend(below.candidates);
        self.examples.extend(below.examples);
        self.examples.sort_by(|one, other| {
            let by_verdict = other.verdict.cmp(&one.verdict);
            by_verdict.then(other.error[0].total_cmp(&one.error[0]))
        });
        self.examples.truncate(EXAMPLES);
        self.marks.extend(below.marks);
    }

    /// Adds one pixel, and returns its judgement.
    fn add(
        &mut self,
        pixel: [usize; 2],
        shown: Shown,
        seen: &[Seen<Interval>],
        limit: f64,
    ) -> Mark {
        let (mark, error) = judge(shown, seen, limit);
        let enclosures = visible(seen).flat_map(|seen| ends(seen.levels));
        let widths = enclosures.map(|[least, largest]| largest - least);
        self.widest_enclosure = widths.fold(self.widest_enclosure, f64::max);
        if visible(seen).all(|seen| seen.face().is_some()) {
            self.own += 1;
            self.own_proven += u64::from(mark.verdict == Verdict::Proven);
        }
        if mark.verdict == Verdict::Proven {
            self.worst = self.worst.max(error[1]);
        } else {
            let face = compared(shown.face, seen);
            // The hull of the face's enclosures.
            let enclosure = [0, 1, 2].map(|channel| {
                let same = seen.iter().filter(|seen| seen.face() == face);
                let levels = same.map(|seen| ends(seen.levels)[channel]);
                levels.fold([255.0, 0.0], |[a, b], [c, d]| [c.min(a), d.max(b)])
            });
            self.examples.push(Example {
                pixel,
                verdict: mark.verdict,
                drawn: shown.levels.map(displayed),
                enclosure,
                error,
                face,
                drawn_face: shown.face,
            });
        }
        mark
    }

    /// Adds pixels that the enclosure of their square proves, all with this least and this largest possible error: the first
    /// of them, and their indices.
    fn add_in_square(
        &mut self,
        first: [usize; 2],
        indices: Range<usize>,
        mark: Mark,
        error: [f64; 2],
    ) {
        let count = indices.len() as u64;
        self.marks[indices].fill(mark);
        self.in_squares += count;
        let own = if mark.is_covered { count } else { 0 };
        self.own += own;
        self.own_proven += own;
        let [least, most] = error;
        self.least_worst = self.least_worst.max(least);
        if most > self.least_worst {
            self.candidates.push((first, most));
        }
    }
}

/// Proves `picture`, 0x00RRGGBB row by row from the top, on rayon's current threads. Without one, proves the picture that
/// the renderer draws of `view` at the SIMD level.
///
/// # Errors
/// If the picture does not fit in memory, or the work is cancelled.
pub async fn prove(
    world: &mut World,
    view: &View,
    picture: Option<&[u32]>,
    level: Level,
    monitor: Monitor<'_>,
) -> anyhow::Result<Proof> {
    let [proof] = prove_at([view.tolerance], world, view, picture, level, monitor).await?;
    Ok(proof)
}

/// As [`prove`], at each of these tolerances instead of the view's. Pixels are enclosed once for all of them.
///
/// # Errors
/// If the picture does not fit in memory, or the work is cancelled.
pub async fn prove_at<const COUNT: usize>(
    tolerances: [f64; COUNT],
    world: &mut World,
    view: &View,
    picture: Option<&[u32]>,
    level: Level,
    monitor: Monitor<'_>,
) -> anyhow::Result<[Proof; COUNT]> {
    let [width, height] = view.size;
    // Bytes are rounded levels.
    let rounding = if picture.is_some() {
        BYTE_ROUNDING
    } else {
        0.0
    };
    let mut proofs = tolerances.map(|tolerance| Proof {
        limit: limit(tolerance) + rounding,
        pixels: width * height,
        ..Proof::default()
    });
    for proof in &mut proofs {
        proof.marks = memory::reserve_pixels(view.size)?;
    }
    let frame = |keep| Frame::new(keep, Workers::alone(level));
    let mut judgement = Judgement {
        enclosures: Reference::<Interval>::new(world, view),
        reference: Reference::<f64>::new(world, view),
        picture,
        frames: tolerances.map(|_| [Keep::Levels, Keep::Display].map(frame)),
        limits: tolerances.map(limit),
        width,
        first_row: 0,
    };
    for rows in bands(height) {
        judgement.first_row = rows.start;
        if picture.is_none() {
            for (tolerance, frames) in tolerances.iter().zip(&mut judgement.frames) {
                let view = view.with_tolerance(*tolerance);
                for frame in frames {
                    systems::draw_rows(world, &view, rows.clone(), frame)?;
                }
            }
        }
        let strips: Vec<_> = (rows.clone().step_by(MAX_ENCLOSED_SIDE))
            .map(|start| start..rows.end.min(start + MAX_ENCLOSED_SIDE))
            .collect();
        let done = [rows.start, height].map(|row| row.div_ceil(MAX_ENCLOSED_SIDE));
        let strip = |number: usize| Ok(judgement.strip(&strips[number]));
        let found = monitor.in_parallel("proving", 0..strips.len(), done, strip);
        for strip in found.await? {
            for (proof, strip) in proofs.iter_mut().zip(strip) {
                proof.append(strip);
            }
        }
        for (at, proof) in proofs.iter_mut().enumerate() {
            judgement.find_worst(at, proof);
        }
    }
    proofs.iter_mut().for_each(Proof::count);
    Ok(proofs)
}

#[cfg(test)]
mod tests;
