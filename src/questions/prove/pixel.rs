//! The verdict on one pixel.
//!
//! An enclosure holds the exact levels of a face. Where the sign of n.l is undecided, a face has several, with and without
//! highlights, and a pixel may show any of them. A pixel is proven if it shows a face that it may show, and every value of
//! one of that face's enclosures is within the limit of the drawn levels. It is refuted if it shows another face, or no
//! value is within the limit. Else it is undecided. A pixel is a gap if it fits only a face that others hide all around its
//! centre, as at a joint of touching faces. Each byte must be the display step of a level within the limit. A PNG
//! does not say which face a pixel shows: each one that the pixel may show is tried. Differences are rounded outwards.

use std::cmp::Ordering::Equal;

use serde::Serialize;

use crate::components::TriangleId;
use crate::questions::metrics::{difference, ends};
use crate::reference::{Interval, Real, Seen};
use crate::systems::frame::{Frame, display_step};

/// The largest distance of a level from its byte, in levels.
pub(super) const BYTE_ROUNDING: f64 = 0.5;

/// The judgement of a pixel, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    Proven,
    Undecided,
    Gap,
    Refuted,
}

impl Verdict {
    /// The name in messages and in JSON.
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }

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

    /// Whether bytes are the display steps of levels within `limit` of an enclosure: of all its values, or of some.
    fn of_bytes(bytes: [u8; 3], seen: &Seen<Interval>, limit: f64) -> Self {
        let limit = Interval::of(limit);
        let verdict = |(byte, ends): (u8, [f64; 2])| {
            let [least, largest] = ends.map(Interval::of);
            let byte_of = |level: Interval, end: usize| display_step(level.endpoints()[end]);
            let of_all = byte_of(largest - limit, 1)..=byte_of(least + limit, 0);
            let of_some = byte_of(least - limit, 0)..=byte_of(largest + limit, 1);
            match (of_all.contains(&byte), of_some.contains(&byte)) {
                (true, _) => Verdict::Proven,
                (false, true) => Verdict::Undecided,
                (false, false) => Verdict::Refuted,
            }
        };
        let channels = bytes.into_iter().zip(ends(seen.levels));
        channels.map(verdict).fold(Verdict::Proven, Verdict::max)
    }
}

/// The judgement of a pixel and its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mark {
    pub verdict: Verdict,
    /// Whether an edge is so near that the pixel may show either side.
    pub is_outline: bool,
    /// Whether the pixel shows a cuboid.
    pub is_covered: bool,
}

/// The mark of a pixel before it is judged.
pub(super) const UNKNOWN: Mark = Mark {
    verdict: Verdict::Undecided,
    is_outline: false,
    is_covered: false,
};

/// A pixel as a renderer draws it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shown {
    /// Cuboid * 6 + face; `None` is the background.
    pub face: Option<usize>,
    pub levels: [f64; 3],
    /// The bytes for a window; `None` if there are none to judge.
    pub bytes: Option<[u8; 3]>,
    /// The largest rounding of the levels: `BYTE_ROUNDING` if they are bytes, else 0.
    pub rounding: f64,
}

impl Shown {
    /// A pixel of two frames of one picture, one with levels and one with the bytes for a window.
    pub fn at(pixel: usize, levels: &Frame, display: &Frame) -> Self {
        let [_, bytes @ ..] = display.pixels()[pixel].to_be_bytes();
        let (face, levels) = shown(levels, pixel);
        Shown {
            face,
            levels,
            bytes: Some(bytes),
            rounding: 0.0,
        }
    }

    /// A pixel of a picture without faces, 0x00RRGGBB. Its face is the one that fits its bytes best.
    pub(super) fn of_bytes(pixel: u32, seen: &[Seen<Interval>], limit: f64) -> Self {
        let [_, bytes @ ..] = pixel.to_be_bytes();
        let of_face = |face| Shown {
            face,
            levels: bytes.map(f64::from),
            bytes: Some(bytes),
            rounding: BYTE_ROUNDING,
        };
        let judged = |face: &Option<usize>| {
            let (mark, [_, most]) = judge(of_face(*face), seen, limit);
            (mark.verdict, most)
        };
        let faces = seen.iter().map(Seen::face);
        let best =
            faces.min_by(|one, other| judged(one).partial_cmp(&judged(other)).unwrap_or(Equal));
        of_face(best.flatten())
    }
}

/// The face at a pixel of a frame, cuboid * 6 + face, and its levels.
pub fn shown(frame: &Frame, pixel: usize) -> (Option<usize>, [f64; 3]) {
    let triangle = frame.triangles()[pixel];
    let face = (triangle != TriangleId::NONE).then_some(triangle.face_id() as usize);
    (face, frame.levels()[pixel].map(f64::from))
}

/// The least and the largest possible error of `levels` against the enclosures of the face shown. Of several enclosures, the
/// nearest decides each end. `None` if the pixel may not show this face.
pub fn nearest(
    shown: Option<usize>,
    levels: [f64; 3],
    seen: &[Seen<Interval>],
) -> Option<[f64; 2]> {
    let same = seen.iter().filter(|seen| seen.face() == shown);
    same.map(|seen| difference(&ends(levels), &ends(seen.levels)))
        .reduce(|one, other| [one[0].min(other[0]), one[1].min(other[1])])
}

/// The face with which a pixel is compared: the one that it shows if it may show it, else the first that it may show.
pub(super) fn compared(shown: Option<usize>, seen: &[Seen<Interval>]) -> Option<usize> {
    let mut faces = visible(seen).map(Seen::face);
    let first = faces.clone().next().flatten();
    faces.find(|face| *face == shown).unwrap_or(first)
}

/// The surfaces that a pixel may show.
pub(super) fn visible(seen: &[Seen<Interval>]) -> impl Iterator<Item = &Seen<Interval>> + Clone {
    seen.iter().filter(|seen| !seen.is_hidden)
}

/// Judges a pixel by the surfaces that it may show. Returns also its least and its largest possible error against the face
/// with which it is compared.
pub fn judge(shown: Shown, seen: &[Seen<Interval>], limit: f64) -> (Mark, [f64; 2]) {
    let face = compared(shown.face, seen);
    let error = nearest(face, shown.levels, seen).unwrap_or([0.0, 255.0]);
    let limit_of_levels = limit + shown.rounding;
    let level_verdict = if face == shown.face {
        Verdict::of(error, limit_of_levels)
    } else if let Some(error) = nearest(shown.face, shown.levels, seen) {
        // It shows a face that others hide.
        Verdict::of(error, limit_of_levels).max(Verdict::Gap)
    } else {
        Verdict::Refuted
    };
    let same = seen.iter().filter(|seen| seen.face() == shown.face);
    let best = |bytes| same.map(|seen| Verdict::of_bytes(bytes, seen, limit)).min();
    let byte_verdict = shown.bytes.and_then(best);
    let mark = Mark {
        verdict: level_verdict.max(byte_verdict.unwrap_or(level_verdict)),
        is_outline: visible(seen).any(|other| other.face() != face),
        is_covered: shown.face.is_some(),
    };
    (mark, error)
}
