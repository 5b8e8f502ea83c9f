//! The fewest segments with which Gouraud keeps the tolerance against exact Phong, for each cuboid alone: all others have
//! exact Phong.
//!
//! ```text
//! segments 1, 2, 3, ...  --the pixels that refuted fewer, f64--> one errs too much? --its intervals--> refuted
//!                        --all pixels, f64-------------------> one errs too much? --its intervals--> refuted
//!                        --all pixels, intervals-------------> all keep the tolerance: the answer
//! ```
//! The error is not monotone in the number of segments: a vertex in the middle of a highlight may miss the rest of it. Every
//! number is therefore tried. In most scenes a few pixels refute nearly all of them.

use std::ops::Range;

use serde::Serialize;

use super::{Change, FaceLevels, error, shown};
use crate::components::{Segments, ShadingMode, View};
use crate::reference::{Interval, Real, Reference};
use crate::report::Monitor;
use crate::scene::{Scene, SceneRecord};
use crate::shading::limit;

/// The segments that a cuboid requires under Gouraud.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FewestSegments {
    /// The cuboid's name.
    pub cuboid: String,
    /// The least number that is proven to keep the tolerance; `None` if no legal number is.
    pub segments: Option<u32>,
    /// The lower and the upper bound of the largest error with that number, or with the largest legal one.
    pub largest_error: [f64; 2],
    /// The smaller numbers that are neither proven to keep the tolerance nor to exceed it.
    #[serde(skip_serializing_if = "is_zero")]
    pub undecided: u32,
}

fn is_zero(number: &u32) -> bool {
    *number == 0
}

impl FewestSegments {
    /// The number in words.
    pub fn number(&self) -> String {
        match (self.segments, self.undecided) {
            (Some(segments), 0) => segments.to_string(),
            (Some(segments), _) => format!("at most {segments}"),
            (None, 0) => format!("> {}", Segments::RANGE.end()),
            (None, _) => "none proven".to_owned(),
        }
    }

    /// The answer as a sentence.
    pub fn sentence(&self) -> String {
        let name = &self.cuboid;
        let cells = self.segments.unwrap_or(*Segments::RANGE.end());
        let cells = format!("{cells} x {cells} cells");
        match (self.segments, self.undecided) {
            (Some(_), 0) => format!("{name}: Gouraud needs {cells}."),
            (Some(_), _) => format!("{name}: Gouraud needs at most {cells}."),
            (None, 0) => format!("{name}: Gouraud errs too much even with {cells}."),
            (None, _) => format!("{name}: no grid up to {cells} is proven to suffice."),
        }
    }
}

/// The picture under exact Phong, and with Gouraud for one cuboid.
struct Pair<R> {
    phong: Reference<R>,
    gouraud: Reference<R>,
}

impl<R: Real> Pair<R> {
    /// The bounds of the error of a pixel.
    fn error(&self, pixel: [usize; 2]) -> [f64; 2] {
        let shown = |picture: &Reference<R>| -> Vec<FaceLevels> { shown(&picture.at(pixel)) };
        error(&shown(&self.phong), &shown(&self.gouraud), true)
    }
}

/// The search for one cuboid.
struct Search<'a> {
    /// Only this cuboid has Gouraud shading.
    scene: Scene,
    view: View,
    /// The columns and rows in which it may be visible.
    columns: Range<usize>,
    rows: Range<usize>,
    monitor: Monitor<'a>,
}

impl Search<'_> {
    fn pair<R: Real>(&self, segments: Segments) -> Pair<R> {
        let view = View {
            segments: Some(segments),
            ..self.view
        };
        Pair {
            phong: Reference::new(&self.scene.world, &view.shaded(ShadingMode::Phong)),
            gouraud: Reference::new(&self.scene.world, &view),
        }
    }

    /// Does `work` for each row.
    fn by_row<T: Send>(
        &self,
        step: &'static str,
        work: impl Fn(&mut dyn Iterator<Item = [usize; 2]>) -> T + Sync,
    ) -> anyhow::Result<Vec<T>> {
        let done = [0, self.rows.len()];
        let row = |y| Ok(work(&mut self.columns.clone().map(|x| [x, y])));
        self.monitor.in_parallel(step, self.rows.clone(), done, row)
    }

    /// The bounds of the largest error.
    fn largest_error(&self, segments: Segments) -> anyhow::Result<[f64; 2]> {
        let pair = self.pair::<Interval>(segments);
        let change = |pixel| Change {
            largest_error: pair.error(pixel),
            pixels: 0,
        };
        let rows = self.by_row("proving segments", |row| Change::combined(row.map(change)))?;
        Ok(Change::combined(rows).largest_error)
    }

    /// The least number that keeps a tolerance, its error, and how many smaller ones are undecided.
    fn fewest(&self, limit: f64) -> anyhow::Result<(Option<u32>, [f64; 2], u32)> {
        let mut undecided = 0;
        // The pixels that refuted fewer segments, the last ones at the end.
        let mut worst: Vec<[usize; 2]> = Vec::new();
        for segments in Segments::RANGE.filter_map(Segments::new) {
            self.monitor.check()?;
            let (floats, enclosures) = (self.pair::<f64>(segments), self.pair(segments));
            let errs = |pixel: [usize; 2]| floats.error(pixel)[1] > limit;
            let is_refuted = |pixel: &[usize; 2]| {
                errs(*pixel) && Pair::<Interval>::error(&enclosures, *pixel)[0] > limit
            };
            if worst.iter().rev().any(is_refuted) {
                continue;
            }
            let errors = |pixel| (floats.error(pixel)[1], pixel);
            let rows = self.by_row("counting segments", |row| {
                row.map(errors)
                    .max_by(|one, other| one.0.total_cmp(&other.0))
            })?;
            let mut rows: Vec<_> = rows
                .into_iter()
                .flatten()
                .filter(|it| it.0 > limit)
                .collect();
            rows.sort_by(|one, other| one.0.total_cmp(&other.0));
            let found = worst.len();
            worst.extend(rows.into_iter().map(|(_, pixel)| pixel));
            if worst[found..].iter().rev().any(is_refuted) {
                continue;
            }
            if worst.len() == found {
                let [least, most] = self.largest_error(segments)?;
                if most <= limit {
                    return Ok((Some(segments.into()), [least, most], undecided));
                }
                undecided += u32::from(least <= limit);
            } else {
                undecided += 1;
            }
        }
        let most = Segments::new(*Segments::RANGE.end()).unwrap_or_default();
        Ok((None, self.largest_error(most)?, undecided))
    }
}

/// The fewest segments of each cuboid, in file order, computed on rayon's current threads. The shading and the segments of
/// the scene do not matter.
///
/// # Errors
/// If the work is cancelled.
pub fn fewest_segments(
    scene: &Scene,
    view: &View,
    monitor: Monitor,
) -> anyhow::Result<Vec<FewestSegments>> {
    let mut record = SceneRecord::of(&scene.world);
    for cuboid in &mut record.cuboid {
        cuboid.shading = ShadingMode::Phong;
    }
    let bounds = Reference::<Interval>::new(&scene.world, view).bounds();
    let fewest = |(number, [columns, rows]): (usize, [Range<usize>; 2])| {
        let mut record = record.clone();
        record.cuboid[number].shading = ShadingMode::Gouraud;
        let search = Search {
            scene: Scene::spawn(scene.name.clone(), &record),
            view: view.unshaded(),
            columns,
            rows,
            monitor,
        };
        let (segments, largest_error, undecided) = search.fewest(limit(view.tolerance))?;
        Ok(FewestSegments {
            cuboid: record.cuboid[number].name.clone(),
            segments,
            largest_error,
            undecided,
        })
    };
    bounds.into_iter().enumerate().map(fewest).collect()
}
