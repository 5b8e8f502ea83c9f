//! The proof of a picture: every pixel is compared with intervals that hold its exact levels.
//!
//! ```text
//! World --FRAME--> levels, bytes, faces ---+
//!  or a PNG of any program --> bytes ------+--judge--> proven, refuted or undecided
//! World --reference over intervals--> faces that each pixel may show, and their levels
//!       --reference over f64--> its own error
//! ```
//! A pixel is proven if it shows a face that it may show, and every value of that face's interval is within the limit of
//! the drawn levels; bytes have half a level more, for their rounding. It is refuted if it shows another face, or no value
//! is within the limit. Else it is undecided. A PNG does not say which face a pixel shows: each one that the pixel may
//! show is tried. Differences are rounded outwards.

mod command;
mod png;

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
pub use png::{Picture, read as read_png};

/// Rows that are drawn, enclosed and judged at once.
const BAND: usize = 64;

/// The most pixels that are kept as examples.
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
    /// The least and the largest error that the enclosure leaves possible, in levels of 255.
    pub error: [f64; 2],
    /// Cuboid * 6 + face whose enclosure this is; `None` is the background.
    pub face: Option<usize>,
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
    /// The pixels that are not proven and err most, the worst first.
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

    /// A pixel of a picture without faces, 0x00RRGGBB: it shows the face that suits its bytes best.
    fn of_bytes(pixel: u32, seen: &[Seen<Interval>], limit: f64) -> Self {
        let [_, levels @ ..] = pixel.to_be_bytes().map(f64::from);
        let faces = seen.iter().map(Seen::face);
        let judged = faces.filter_map(|face| {
            let error = nearest(face, levels, seen)?;
            Some((Verdict::of(error, limit), error[1], face))
        });
        let best = judged.min_by(|one, other| one.0.cmp(&other.0).then(one.1.total_cmp(&other.1)));
        Shown {
            face: best.and_then(|(.., face)| face),
            levels,
            bytes: None,
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
        self.examples
            .sort_by(|one, other| other.error[0].total_cmp(&one.error[0]));
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
        if mark.verdict != Verdict::Proven {
            let same = seen.iter().find(|seen| seen.face() == shown.face);
            let nearest = nearest(shown.face, shown.levels, seen);
            let of = same.unwrap_or(&seen[0]);
            self.examples.push(Example {
                pixel,
                verdict: mark.verdict,
                drawn: shown.levels.map(displayed),
                enclosure: ends(of.levels),
                error: nearest.unwrap_or([255.0; 2]),
                face: of.face(),
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

/// The largest error that a pixel may have, in levels of 255. A byte is a level that was rounded.
fn limit_of(view: &View, is_bytes: bool) -> f64 {
    limit(view.tolerance) + if is_bytes { 0.5 } else { 0.0 }
}

/// Proves `picture`, 0x00RRGGBB row by row from the top, on rayon's current threads. Without one, draws the picture that
/// `view` asks for with the instructions of `level`, and proves that.
///
/// `cancelled` is asked before every row, and a yes makes the result `None`; `progress` is told the share of the rows that
/// is done.
///
/// # Errors
/// When the picture does not fit in memory.
pub fn prove(
    world: &mut World,
    view: &View,
    picture: Option<&[u32]>,
    level: Level,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Option<Proof>, OutOfMemory> {
    let [width, height] = view.size;
    let [mut drawn, mut displayed] =
        [Keep::Levels, Keep::Display].map(|keep| Frame::new(keep, Workers::alone(level)));
    let enclosures = Reference::<Interval>::new(world, view);
    let reference = Reference::<f64>::new(world, view);
    let limit = limit_of(view, picture.is_some());
    let mut proof = Proof {
        marks: memory::reserve_pixels(view.size)?,
        ..Proof::default()
    };
    for start in (0..height).step_by(BAND) {
        let rows = start..height.min(start + BAND);
        if picture.is_none() {
            systems::draw_rows(world, view, rows.clone(), &mut drawn)?;
            systems::draw_rows(world, view, rows.clone(), &mut displayed)?;
        }
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
                let shown = match picture {
                    Some(picture) => Shown::of_bytes(picture[y * width + x], seen, limit),
                    None => Shown::at(pixel, &drawn, &displayed),
                };
                row.add([x, y], shown, seen, limit);
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
