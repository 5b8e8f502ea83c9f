//! The parts of the model that a scene requires, with the proven error of leaving each of them out.
//!
//! ```text
//! scene --reference over intervals--> levels of each pixel -------------------+
//!    |                                                                        +--> error --> required or not
//!    '--without a part--> reference over intervals --> levels of each pixel --+
//! ```
//! One part is left out at a time. The error of a pixel is the largest difference of displayed levels over the channels.
//! Both pictures are enclosed in intervals, so the error lies in an interval too. (Without f64 the picture is the reference
//! in f32, whose levels are known.) The largest error of the picture is at least the largest lower end and at most the
//! largest upper end.
//!
//! A part is not required if the picture without it is proven to keep the tolerance. Where intervals cannot tell a face or
//! the specular gate, a pixel may show one of several colours. Both pictures are taken to make the same choice: a colour of
//! one is compared with the nearest colour of the same face in the other. If the other cannot show that face, the colour is
//! compared with all of its colours.
//!
//! [`segments`] compares Gouraud on ever finer grids in the same way.

pub mod command;
mod parts;
pub mod segments;

use serde::Serialize;

use self::parts::rule;
pub use self::parts::{Part, parts, without};
use crate::components::{Mesh, View, ordered};
use crate::output::Monitor;
use crate::questions::metrics::{difference, ends};
use crate::reference::{Interval, Real, Reference, Seen};
use crate::scene::Scene;
use crate::shading::limit;
use crate::systems::frame::display_pixel;

/// Pictures that are evaluated together. Each takes memory for every cuboid.
const AT_ONCE: usize = 16;

/// The proven change of a picture without some parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Change {
    /// The lower and the upper bound of the largest error, in levels of 255.
    pub largest_error: [f64; 2],
    /// Pixels with an error that is proven to exceed the tolerance.
    pub pixels: u64,
}

/// A face that a pixel may show, and the least and the largest displayed level of each channel.
type FaceLevels = (Option<usize>, [[f64; 2]; 3]);

/// A function from a row to the surfaces that each of its pixels may show.
type RowSurfaces = Box<dyn Fn(usize) -> Vec<Vec<FaceLevels>> + Sync>;

impl Change {
    /// Combines changes: the maximum of their errors, the sum of their pixels.
    pub fn combined(changes: impl IntoIterator<Item = Change>) -> Change {
        let add = |sum: Change, one: Change| Change {
            largest_error: [0, 1].map(|end| sum.largest_error[end].max(one.largest_error[end])),
            pixels: sum.pixels + one.pixels,
        };
        changes.into_iter().fold(Change::default(), add)
    }

    /// The upper bound of the largest error, in levels of 255.
    pub fn most(&self) -> f64 {
        self.largest_error[1]
    }

    /// Whether it is proven that the picture keeps the tolerance.
    pub fn keeps(&self, tolerance: f64) -> bool {
        self.most() <= limit(tolerance)
    }
}

/// The picture without a part, as the reference draws it, 0x00RRGGBB.
///
/// # Errors
/// If the work is cancelled.
pub async fn picture_without(
    scene: &Scene,
    view: &View,
    part: Part,
    monitor: Monitor<'_>,
) -> anyhow::Result<Vec<u32>> {
    let (world, view) = (&without(scene, &[part]).world, &view.unshaded());
    if part == Part::F64 {
        pixels(&Reference::<f32>::without(world, view, None), view, monitor).await
    } else {
        let reference = Reference::<f64>::without(world, view, rule(&[part]));
        pixels(&reference, view, monitor).await
    }
}

/// The pixels of a picture in floats.
async fn pixels<R: Real>(
    picture: &Reference<R>,
    view: &View,
    monitor: Monitor<'_>,
) -> anyhow::Result<Vec<u32>> {
    let row = |y| {
        let mut pixels = Vec::with_capacity(view.size[0]);
        picture.row(y, |_, seen| {
            let levels = seen[0].levels.map(|level| level.endpoints()[0]);
            pixels.push(display_pixel(levels));
        });
        Ok(pixels)
    };
    let height = view.size[1];
    let rows = monitor.in_parallel("leaving out a part", 0..height, [0, height], row);
    Ok(rows.await?.concat())
}

/// One change for each list of parts. All parts of a list, at most one of them a [`Part::Rule`], are left out together.
/// Computed on rayon's current threads. Each cuboid keeps its own shading, which a part may change.
///
/// # Errors
/// If the work is cancelled.
pub async fn changes(
    scene: &Scene,
    view: &View,
    left_out: &[Vec<Part>],
    monitor: Monitor<'_>,
) -> anyhow::Result<Vec<Change>> {
    let view = &view.unshaded();
    let full = rows(Reference::<Interval>::new(&scene.world, view));
    let limit = limit(view.tolerance);
    let height = view.size[1];
    let all = left_out.len().div_ceil(AT_ONCE) * height;
    let mut changes = Vec::with_capacity(left_out.len());
    for (index, some) in left_out.chunks(AT_ONCE).enumerate() {
        let done = index * height;
        // The picture without some parts, and whether its levels are enclosed.
        let picture = |parts: &Vec<Part>| {
            let world = &without(scene, parts).world;
            let rule = rule(parts);
            if parts.contains(&Part::F64) {
                (rows(Reference::<f32>::without(world, view, rule)), false)
            } else {
                let enclosures = Reference::<Interval>::without(world, view, rule);
                (rows(enclosures), true)
            }
        };
        let pictures: Vec<(RowSurfaces, bool)> = some.iter().map(picture).collect();
        let row = |y| {
            let full = full(y);
            let change = |(picture, is_enclosed): &(RowSurfaces, bool)| {
                let pixels = full.iter().zip(picture(y));
                Change::combined(pixels.map(|(full, without)| {
                    let largest_error = error(full, &without, *is_enclosed);
                    let pixels = u64::from(largest_error[0] > limit);
                    Change {
                        largest_error,
                        pixels,
                    }
                }))
            };
            Ok(pictures.iter().map(change).collect::<Vec<Change>>())
        };
        let by_row = monitor
            .in_parallel("leaving out parts", 0..height, [done, all], row)
            .await?;
        let of_picture = |number: usize| Change::combined(by_row.iter().map(|row| row[number]));
        changes.extend((0..pictures.len()).map(of_picture));
    }
    Ok(changes)
}

/// A part and the change of the picture without it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartChange {
    #[serde(skip)]
    pub part: Part,
    #[serde(rename = "part")]
    pub name: String,
    #[serde(flatten)]
    pub change: Change,
    /// False if the picture without it is proven to keep the tolerance.
    pub required: bool,
}

/// The changes of the picture without the first parts, in the order of [`parts`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartChanges {
    pub rows: Vec<PartChange>,
    /// Whether these are all parts.
    pub is_all: bool,
}

/// Adds `count` parts to those that are `known` in the same picture.
///
/// # Errors
/// If the work is cancelled.
pub async fn more_changes(
    scene: &Scene,
    view: &View,
    mut known: Vec<PartChange>,
    count: usize,
    monitor: Monitor<'_>,
) -> anyhow::Result<PartChanges> {
    let parts = parts(scene);
    let all = parts.len();
    let next: Vec<_> = parts.into_iter().skip(known.len()).take(count).collect();
    let left_out: Vec<_> = next.iter().map(|(part, _)| vec![*part]).collect();
    let changes = changes(scene, view, &left_out, monitor).await?;
    let part_change = |((part, name), change): (_, Change)| PartChange {
        part,
        name,
        change,
        required: !change.keeps(view.tolerance),
    };
    known.extend(next.into_iter().zip(changes).map(part_change));
    Ok(PartChanges {
        is_all: known.len() == all,
        rows: known,
    })
}

/// The change of the picture without each part, in the order of [`parts`].
///
/// # Errors
/// If the work is cancelled.
pub async fn part_changes(
    scene: &Scene,
    view: &View,
    monitor: Monitor<'_>,
) -> anyhow::Result<Vec<PartChange>> {
    let all = more_changes(scene, view, Vec::new(), usize::MAX, monitor);
    Ok(all.await?.rows)
}

/// Sorts the parts by their errors, the largest first.
pub fn ranked(mut parts: Vec<PartChange>) -> Vec<PartChange> {
    parts.sort_by(|one, other| other.change.most().total_cmp(&one.change.most()));
    parts
}

/// Tries each candidate together with those left out so far, because errors of parts add up or cancel. It stays out if the
/// picture keeps its tolerance and a cuboid remains. Returns the parts left out and the change of the picture.
///
/// # Errors
/// If the work is cancelled.
pub async fn least(
    scene: &Scene,
    view: &View,
    candidates: &[Part],
    monitor: Monitor<'_>,
) -> anyhow::Result<(Vec<Part>, Change)> {
    let (mut left_out, mut change) = (Vec::new(), Change::default());
    for part in candidates {
        let tried = [&left_out[..], &[*part]].concat();
        if ordered::<Mesh>(&without(scene, &tried).world).is_empty() {
            continue;
        }
        let without_it = changes(scene, view, std::slice::from_ref(&tried), monitor).await?[0];
        if without_it.keeps(view.tolerance) {
            (left_out, change) = (tried, without_it);
        }
    }
    Ok((left_out, change))
}

/// The rows of a picture as displayed levels. In intervals a pixel may show several surfaces, in floats it shows one.
fn rows<R: Real + 'static>(picture: Reference<R>) -> RowSurfaces {
    Box::new(move |y| {
        let mut row = Vec::new();
        picture.row(y, |_, seen| row.push(shown(seen)));
        row
    })
}

/// The surfaces of a pixel that it may show.
fn shown<R: Real>(seen: &[Seen<R>]) -> Vec<FaceLevels> {
    let visible = seen.iter().filter(|seen| !seen.is_hidden);
    let levels = |seen: &Seen<R>| (seen.face(), ends(seen.levels));
    visible.map(levels).collect()
}

/// The lower and the upper bound of a pixel's error. `full` and `without` are the surfaces that it may show in the full
/// picture and in the one without a part. A picture in floats (`is_enclosed` false) shows one surface, so only that one is
/// compared.
fn error(full: &[FaceLevels], without: &[FaceLevels], is_enclosed: bool) -> [f64; 2] {
    let mut error = [f64::INFINITY, 0.0_f64];
    let mut compare = |pixel: &[FaceLevels], others: &[FaceLevels]| {
        for shown in pixel {
            let (mut nearest, mut farthest) = (f64::INFINITY, 0.0_f64);
            for other in others {
                let [least, most] = difference(&shown.1, &other.1);
                error[0] = error[0].min(least);
                farthest = farthest.max(most);
                if shown.0 == other.0 {
                    nearest = nearest.min(most);
                }
            }
            error[1] = error[1].max(nearest.min(farthest));
        }
    };
    compare(without, full);
    if is_enclosed {
        compare(full, without);
    }
    error
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(face: usize, least: f64, most: f64) -> FaceLevels {
        (Some(face), [[least, most]; 3])
    }

    #[test]
    fn near_an_edge_a_face_is_compared_with_itself_or_with_all_where_it_is_missing() {
        let [front, darker] = [grey(0, 100.0, 101.0), grey(0, 90.0, 92.0)];
        let behind = (None, [[20.0, 20.0]; 3]);
        let cases = [
            (vec![front, behind], vec![darker, behind], [0.0, 11.0]),
            (vec![front, behind], vec![behind], [0.0, 81.0]),
            (vec![behind], vec![front, behind], [0.0, 81.0]),
            (vec![front], vec![behind], [80.0, 81.0]),
            // Rounding outwards ends at the largest difference of displayed levels.
            (
                vec![grey(0, 255.0, 255.0)],
                vec![grey(0, 1e-99, 1e-99)],
                [255.0_f64.next_down(), 255.0],
            ),
            // The nearest possible colour of the same face counts.
            (vec![front, darker], vec![darker], [0.0, 11.0]),
        ];
        for (full, without, known) in cases {
            assert_eq!(error(&full, &without, true), known, "{full:?} {without:?}");
        }
        // A picture in f32 shows one surface, which may be any of the possible ones.
        assert_eq!(error(&[front, behind], &[behind], false), [0.0, 0.0]);
        let drawn = grey(0, 30.0, 30.0);
        assert_eq!(error(&[front, behind], &[drawn], false), [10.0, 71.0]);
    }
}
