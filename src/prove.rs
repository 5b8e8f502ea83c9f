//! A picture and the enclosures of its exact levels in, a proof or what it lacks out.
//!
//! ```text
//! World --FRAME--> levels, bytes, triangles --+
//!       --reference over intervals--> what each pixel may show --judge--> proven, refuted or undecided
//!       --reference over f64--> truth --------+  how far it errs
//! ```
//!
//! Rule: a pixel is proven if it shows a face that it may show and every value of that face's enclosure is within the limit
//! of what is drawn: within it as levels, and half a level more as the bytes that a window gets. It is refuted if it shows a
//! face that it may not show, or no value of the face's enclosure is within the limit, and undecided otherwise. Differences
//! are rounded outwards.

mod command;

use fearless_simd::Level;
use hecs::World;
use rayon::prelude::*;
use serde::Serialize;

use crate::components::View;
use crate::frame::{Frame, Keep, NO_TRIANGLE, Workers, face};
use crate::memory::{self, OutOfMemory};
use crate::reference::{Interval, Reference, Seen};
use crate::shading::limit;
use crate::systems;
use crate::trade::metrics::{difference, displayed, ends};
pub use command::run;

/// Rows that are drawn, enclosed and judged at once.
const BAND: usize = 64;

/// How many pixels that are not proven are kept as examples.
const EXAMPLES: usize = 10;

/// The colours of pixels that are undecided and refuted, 0x00RRGGBB.
pub const UNDECIDED: u32 = 0x00ff_d500;
pub const REFUTED: u32 = 0x00ff_2020;

/// How a pixel was judged, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    Proven,
    Undecided,
    Refuted,
}

impl Verdict {
    /// Whether an error that lies between these is within the limit.
    pub fn of([least, most]: [f64; 2], limit: f64) -> Self {
        if most <= limit {
            Verdict::Proven
        } else if least > limit {
            Verdict::Refuted
        } else {
            Verdict::Undecided
        }
    }
}

/// One pixel's judgement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mark {
    pub verdict: Verdict,
    /// An edge is so near that it may show either side.
    pub is_outline: bool,
    /// It shows a cuboid.
    pub is_covered: bool,
}

/// A pixel that is not proven.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Example {
    pub pixel: [usize; 2],
    pub verdict: Verdict,
    /// Displayed levels.
    pub drawn: [f64; 3],
    /// The least and the largest displayed level, by channel.
    pub enclosure: [[f64; 2]; 3],
}

/// A picture's proof, or what it lacks. Errors and widths are between displayed levels.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Proof {
    pub proven: u64,
    pub refuted: u64,
    pub undecided: u64,
    /// How many pixels an edge is so near to that they may show either side.
    pub outline: u64,
    /// How many pixels show a cuboid.
    pub covered: u64,
    /// The largest error of a proven pixel that its enclosure leaves possible.
    pub worst: f64,
    pub widest_enclosure: f64,
    /// The largest error of the f64 reference that the enclosures leave possible.
    pub reference_error: f64,
    /// The first pixels that are not proven.
    pub examples: Vec<Example>,
    /// Row by row from the top.
    #[serde(skip)]
    pub marks: Vec<Mark>,
}

/// What a renderer made of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Shown {
    /// Cuboid * 6 + face; `None` is the background.
    pub face: Option<usize>,
    pub levels: [f64; 3],
    /// As a window gets them; `None` where there are none to judge.
    pub bytes: Option<[u8; 3]>,
}

impl Shown {
    /// What two frames of one picture show at a pixel, one of levels and one as a window gets it.
    pub fn at(pixel: usize, levels: &Frame, display: &Frame) -> Self {
        let [_, bytes @ ..] = display.pixels()[pixel].to_be_bytes();
        Shown {
            face: shown_face(levels.triangles()[pixel]),
            levels: levels.levels()[pixel].map(f64::from),
            bytes: Some(bytes),
        }
    }
}

/// The face that a triangle's id shows.
pub fn shown_face(triangle: u32) -> Option<usize> {
    (triangle != NO_TRIANGLE).then_some(face(triangle) as usize)
}

/// The least and the largest error that `levels` may have against what `seen` has of the face shown; of several, each end of
/// the nearest. `None` if the pixel may not show it.
pub fn nearest(
    shown: Option<usize>,
    levels: [f64; 3],
    seen: &[Seen<Interval>],
) -> Option<[f64; 2]> {
    let same = seen.iter().filter(|seen| seen.face() == shown);
    same.map(|seen| difference(&ends(levels), &ends(seen.levels)))
        .reduce(|one, other| [one[0].min(other[0]), one[1].min(other[1])])
}

/// Judges a pixel by what it may show; also the largest error that is possible.
pub fn judge(shown: Shown, seen: &[Seen<Interval>], limit: f64) -> (Mark, f64) {
    let levels = nearest(shown.face, shown.levels, seen);
    let bytes = shown.bytes.map(|bytes| bytes.map(f64::from));
    let bytes = bytes.and_then(|bytes| nearest(shown.face, bytes, seen));
    let of_levels = levels.map_or(Verdict::Refuted, |error| Verdict::of(error, limit));
    let of_bytes = bytes.map_or(of_levels, |error| Verdict::of(error, limit + 0.5));
    let mark = Mark {
        verdict: of_levels.max(of_bytes),
        is_outline: seen.iter().any(|other| other.face() != seen[0].face()),
        is_covered: shown.face.is_some(),
    };
    (mark, levels.map_or(255.0, |[_, most]| most))
}

impl Proof {
    /// Adds what follows below.
    fn append(&mut self, below: Proof) {
        self.proven += below.proven;
        self.refuted += below.refuted;
        self.undecided += below.undecided;
        self.outline += below.outline;
        self.covered += below.covered;
        self.worst = self.worst.max(below.worst);
        self.widest_enclosure = self.widest_enclosure.max(below.widest_enclosure);
        self.reference_error = self.reference_error.max(below.reference_error);
        self.examples.extend(below.examples);
        self.examples.truncate(EXAMPLES);
        self.marks.extend(below.marks);
    }

    /// Adds one pixel.
    fn add(&mut self, pixel: [usize; 2], shown: Shown, seen: &[Seen<Interval>], limit: f64) {
        let (mark, error) = judge(shown, seen, limit);
        match mark.verdict {
            Verdict::Proven => {
                self.proven += 1;
                self.worst = self.worst.max(error);
            }
            Verdict::Undecided => self.undecided += 1,
            Verdict::Refuted => self.refuted += 1,
        }
        self.outline += u64::from(mark.is_outline);
        self.covered += u64::from(mark.is_covered);
        let widths = seen
            .iter()
            .flat_map(|seen| ends(seen.levels))
            .map(|[least, largest]| largest - least);
        self.widest_enclosure = widths.fold(self.widest_enclosure, f64::max);
        if mark.verdict != Verdict::Proven && self.examples.len() < EXAMPLES {
            let same = seen.iter().find(|seen| seen.face() == shown.face);
            self.examples.push(Example {
                pixel,
                verdict: mark.verdict,
                drawn: shown.levels.map(displayed),
                enclosure: ends(same.unwrap_or(&seen[0]).levels),
            });
        }
        self.marks.push(mark);
    }

    /// Notes what the f64 reference makes of a pixel.
    fn add_reference(&mut self, face: Option<usize>, levels: [f64; 3], seen: &[Seen<Interval>]) {
        let error = nearest(face, levels, seen).map_or(255.0, |[_, most]| most);
        self.reference_error = self.reference_error.max(error);
    }
}

/// Draws the picture that `view` asks for with the instructions of `level`, and proves what can be proven of it on rayon's
/// current threads.
///
/// `cancelled` is asked before every row, and a yes makes the result `None`; `progress` is told which share of
/// the rows is done.
///
/// # Errors
/// When the picture does not fit in memory.
pub fn prove(
    world: &mut World,
    view: &View,
    level: Level,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Option<Proof>, OutOfMemory> {
    let [width, height] = view.size;
    let [mut drawn, mut displayed] =
        [Keep::Levels, Keep::Display].map(|keep| Frame::new(keep, Workers::alone(level)));
    let enclosures = Reference::<Interval>::new(world, view);
    let reference = Reference::<f64>::new(world, view);
    let mut proof = Proof {
        marks: memory::reserve_pixels(view.size)?,
        ..Proof::default()
    };
    for start in (0..height).step_by(BAND) {
        let rows = start..height.min(start + BAND);
        systems::draw_rows(world, view, rows.clone(), &mut drawn)?;
        systems::draw_rows(world, view, rows.clone(), &mut displayed)?;
        let Some(truth) = reference.picture(rows.clone(), cancelled, &|_| ()) else {
            return Ok(None);
        };
        let prove_row = |y: usize| {
            if cancelled() {
                return None;
            }
            let mut row = Proof::default();
            enclosures.row(y, |x, seen| {
                let pixel = (y - start) * width + x;
                let shown = Shown::at(pixel, &drawn, &displayed);
                row.add([x, y], shown, seen, limit(view.tolerance));
                row.add_reference(
                    shown_face(truth.triangles[pixel]),
                    truth.levels[pixel],
                    seen,
                );
            });
            Some(row)
        };
        let proven: Option<Vec<Proof>> = rows.clone().into_par_iter().map(prove_row).collect();
        let Some(proven) = proven else {
            return Ok(None);
        };
        for row in proven {
            proof.append(row);
        }
        progress(rows.end as f64 / height as f64);
    }
    Ok(Some(proof))
}
