//! The proof of a picture: every pixel is compared with intervals that enclose its exact levels.
//!
//! ```text
//! World --FRAME--> levels, bytes, faces ---+
//!  or a PNG of any program --> bytes ------+--judge--> proven, undecided, a gap or refuted
//! World --reference over intervals--> faces that each pixel may show, and their levels
//!       --reference over f64--> the reference's own error
//! ```
//! `pixel` says when a pixel is proven. Each is enclosed by itself: a proof rests on no bound of the renderer's.

mod cause;
pub mod command;
mod pixel;

use fearless_simd::Level;
use hecs::World;
use serde::Serialize;

pub use self::cause::causes;
pub use self::pixel::{Mark, Shown, Verdict, judge, nearest, shown};
use self::pixel::{ROUNDING, compared, visible};
use crate::components::View;
use crate::output::progress::bands;
use crate::output::{Monitor, memory};
use crate::questions::metrics::{displayed, ends};
use crate::reference::{Interval, Reference, Seen};
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
    /// The largest possible error of a proven pixel.
    pub worst: f64,
    /// The widest enclosure of a pixel.
    pub widest_enclosure: f64,
    /// The largest possible error of the f64 reference.
    pub reference_error: f64,
    /// The pixels that are not proven: the refuted ones first, then gaps, and of each the ones with the largest errors.
    pub examples: Vec<Example>,
    /// Row by row from the top.
    #[serde(skip)]
    pub marks: Vec<Mark>,
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
        self.examples.extend(below.examples);
        self.examples.sort_by(|one, other| {
            let by_verdict = other.verdict.cmp(&one.verdict);
            by_verdict.then(other.error[0].total_cmp(&one.error[0]))
        });
        self.examples.truncate(EXAMPLES);
        self.marks.extend(below.marks);
    }

    /// Adds one pixel.
    fn add(&mut self, pixel: [usize; 2], shown: Shown, seen: &[Seen<Interval>], limit: f64) {
        let (mark, error) = judge(shown, seen, limit);
        self.marks.push(mark);
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
    }
}

/// A picture to be proven at several limits, and its enclosures.
struct Judgement<'a, const COUNT: usize> {
    enclosures: Reference<Interval>,
    reference: Reference<f64>,
    /// The picture of another program.
    picture: Option<&'a [u32]>,
    /// Levels and bytes of the renderer's picture, from `first_row` on.
    frames: [[Frame; 2]; COUNT],
    /// In levels.
    limits: [f64; COUNT],
    width: usize,
    first_row: usize,
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

    /// Proves a row.
    fn row(&self, y: usize) -> [Proof; COUNT] {
        let mut floats = Vec::with_capacity(self.width);
        self.reference.row(y, |_, seen| floats.push(seen[0]));
        let mut proofs = self.limits.map(|_| Proof::default());
        self.enclosures.row(y, |x, seen| {
            let float = &floats[x];
            let error = nearest(float.face(), float.levels, seen);
            let most = error.map_or(255.0, |[_, most]| most);
            for (at, proof) in proofs.iter_mut().enumerate() {
                proof.add([x, y], self.shown(at, [x, y], seen), seen, self.limits[at]);
                proof.reference_error = proof.reference_error.max(most);
            }
        });
        proofs
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
    let rounding = if picture.is_some() { ROUNDING } else { 0.0 };
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
        let done = [rows.start, height];
        let row = |y| Ok(judgement.row(y));
        let found = monitor.in_parallel("proving", rows, done, row);
        for row in found.await? {
            for (proof, row) in proofs.iter_mut().zip(row) {
                proof.append(row);
            }
        }
    }
    proofs.iter_mut().for_each(Proof::count);
    Ok(proofs)
}

#[cfg(test)]
mod tests;
