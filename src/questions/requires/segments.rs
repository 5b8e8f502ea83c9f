//! The fewest segments with which Gouraud keeps the tolerance against exact Phong, for each cuboid alone: all others have
//! exact Phong.
//!
//! ```text
//! segments 1, 2, 3, ...  --pixels that erred with fewer, intervals--> one errs too much: the next number
//!                        --all pixels, f64---------------------------> one errs too much: the next number
//!                        --all pixels, intervals---------------------> all are proven to keep the tolerance: the answer
//! ```
//! The error is not monotone in the number of segments: a vertex in the middle of a highlight may miss the rest of it. Every
//! number is therefore tried. In most scenes a few pixels err with nearly all of them.

use std::ops::Range;

use serde::Serialize;

use super::{FaceLevels, error, shown};
use crate::components::{Segments, ShadingMode, View};
use crate::output::Monitor;
use crate::reference::{Interval, Real, Reference};
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
}

impl FewestSegments {
    /// The number in words.
    pub fn count(&self) -> String {
        match self.segments {
            Some(count) => count.to_string(),
            None => format!("more than {}", Segments::RANGE.end()),
        }
    }
}

/// The picture under exact Phong, and with Gouraud for one cuboid.
struct Pair<'a, R> {
    segments: Segments,
    phong: &'a Reference<R>,
    gouraud: Reference<R>,
}

impl<R: Real> Pair<'_, R> {
    /// The bounds of the error of a pixel.
    fn error(&self, pixel: [usize; 2]) -> [f64; 2] {
        let shown = |picture: &Reference<R>| -> Vec<FaceLevels> { shown(&picture.at(pixel)) };
        error(&shown(self.phong), &shown(&self.gouraud), true)
    }
}

/// The search for one cuboid.
struct Search<'a> {
    /// Only this cuboid has Gouraud shading.
    scene: Scene,
    view: View,
    /// The columns and rows in which it may be visible.
    bounds: [Range<usize>; 2],
    /// Exact Phong of all cuboids.
    floats: &'a Reference<f64>,
    enclosures: &'a Reference<Interval>,
    monitor: Monitor<'a>,
}

/// The bounds of the largest error of a row, and its pixel with the largest upper bound.
type WorstOfRow = ([f64; 2], [usize; 2]);

impl Search<'_> {
    fn pair<'a, R: Real>(&self, phong: &'a Reference<R>, segments: Segments) -> Pair<'a, R> {
        let view = View {
            segments: Some(segments),
            ..self.view
        };
        Pair {
            segments,
            phong,
            gouraud: Reference::new(&self.scene.world, &view),
        }
    }

    async fn by_row<R: Real>(&self, pair: &Pair<'_, R>) -> anyhow::Result<Vec<WorstOfRow>> {
        let [columns, rows] = self.bounds.clone();
        let done = [pair.segments.count() - 1, Segments::RANGE.count()].map(|it| it * rows.len());
        let step = "counting segments";
        let row = |y| {
            let mut worst = ([0.0; 2], [0, y]);
            for x in columns.clone() {
                let error = pair.error([x, y]);
                if error[1] > worst.0[1] {
                    worst.1 = [x, y];
                }
                worst.0 = [0, 1].map(|end| error[end].max(worst.0[end]));
            }
            Ok(worst)
        };
        self.monitor.in_parallel(step, rows, done, row).await
    }

    /// The bounds of the largest error of the picture, and the pixels that intervals do not prove to keep the limit.
    async fn proof(
        &self,
        pair: &Pair<'_, Interval>,
        limit: f64,
    ) -> anyhow::Result<([f64; 2], Vec<[usize; 2]>)> {
        let rows = self.by_row(pair).await?;
        let largest = |end: usize| rows.iter().map(|row| row.0[end]).fold(0.0, f64::max);
        Ok(([largest(0), largest(1)], above(&rows, limit)))
    }

    /// The least number that is proven to keep a limit, and its error.
    async fn fewest(&self, limit: f64) -> anyhow::Result<(Option<u32>, [f64; 2])> {
        // Pixels that erred too much with fewer segments.
        let mut worst: Vec<[usize; 2]> = Vec::new();
        for segments in Segments::RANGE.filter_map(Segments::new) {
            self.monitor.check()?;
            self.monitor.rest().await;
            let enclosures = self.pair(self.enclosures, segments);
            let errs = |pixel: &[usize; 2]| enclosures.error(*pixel)[1] > limit;
            if worst.iter().rev().any(errs) {
                continue;
            }
            let floats = self.by_row(&self.pair(self.floats, segments)).await?;
            let mut found = above(&floats, limit);
            if found.is_empty() {
                let (error, pixels) = self.proof(&enclosures, limit).await?;
                if pixels.is_empty() {
                    return Ok((Some(segments.into()), error));
                }
                found = pixels;
            }
            worst.extend(found);
        }
        let most = Segments::new(*Segments::RANGE.end()).unwrap_or_default();
        let pair = self.pair(self.enclosures, most);
        Ok((None, self.proof(&pair, limit).await?.0))
    }
}

/// The worst pixels of the rows whose error may exceed the limit.
fn above(rows: &[WorstOfRow], limit: f64) -> Vec<[usize; 2]> {
    let rows = rows.iter().filter(|row| row.0[1] > limit);
    rows.map(|row| row.1).collect()
}

/// The fewest segments of each cuboid, in file order, computed on rayon's current threads. The shading and the segments of
/// the scene do not matter.
///
/// # Errors
/// If the work is cancelled.
pub async fn fewest_segments(
    scene: &Scene,
    view: &View,
    monitor: Monitor<'_>,
) -> anyhow::Result<Vec<FewestSegments>> {
    let mut record = SceneRecord::of(&scene.world);
    for cuboid in &mut record.cuboid {
        cuboid.shading = ShadingMode::Phong;
    }
    let view = view.unshaded();
    let phong = view.shaded(ShadingMode::Phong);
    let (floats, enclosures) = (
        &Reference::new(&scene.world, &phong),
        &Reference::new(&scene.world, &phong),
    );
    let mut fewest = Vec::new();
    for (number, bounds) in enclosures.bounds().into_iter().enumerate() {
        let mut record = record.clone();
        record.cuboid[number].shading = ShadingMode::Gouraud;
        let search = Search {
            scene: Scene::spawn(scene.name.clone(), &record),
            view,
            bounds,
            floats,
            enclosures,
            monitor,
        };
        let (segments, largest_error) = search.fewest(limit(view.tolerance)).await?;
        fewest.push(FewestSegments {
            cuboid: record.cuboid[number].name.clone(),
            segments,
            largest_error,
        });
    }
    Ok(fewest)
}
