//! A scene and its views in; what each part of the model is worth to the picture out, proven.
//!
//! ```text
//! scene --reference over intervals--> what each pixel shows ---------------+
//!    |                                                                     +--> error --> required or not
//!    '--without a part--> reference over intervals --> what each shows ----+
//! ```
//! A part is left out alone, and the others stay as they are. Its error is between displayed levels, the largest of the
//! three channels. Both pictures are enclosed, so it lies in an interval: the largest error of the picture is at least the
//! largest of the lower ends and at most the largest of the upper ends.
//!
//! Rule: a part is required unless it is proven that the picture without it keeps the tolerance. A pixel whose centre is so
//! near an edge that it may show either side is judged as `prove` judges it: what it may show of a face is held against the
//! nearest that it may show of that face in the other picture. A face that it may show in one picture alone is held against
//! all that it may show in the other.

mod command;
mod least;
mod share;

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::Serialize;

use crate::components::{Mesh, ShadingMode, View, ordered};
use crate::frame::display_pixel;
use crate::reference::{Interval, Real, Reference, Rule, Seen};
use crate::scene::{Scene, SceneRecord};
use crate::shading::limit;
use crate::trade::metrics::{difference, ends};
pub use command::run;
pub use least::least;

/// A part of the model. Cuboids and lights are named by their place in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A light that is on; left out, it is off.
    Light(usize),
    /// A rule of the reference; see [`Rule`] for what a picture without it is.
    Rule(Rule),
    /// Phong of a cuboid; left out, it is Gouraud.
    EveryPixel(usize),
    /// A cuboid; left out, what is behind it is seen.
    Cuboid(usize),
    /// f64; left out, the reference's formula is evaluated in f32, from the scene's numbers on. No step is adapted to f32, so it
    /// errs as a textbook's does; only a cuboid's bounds on the screen are still computed in intervals.
    F64SetUp,
}

/// Pictures that are evaluated at once. Each holds every cuboid.
const AT_ONCE: usize = 16;

/// What leaving out parts does to a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Change {
    /// The largest error, in levels: at least, and at most.
    pub largest_error: [f64; 2],
    /// How many pixels err by more than the tolerance, whatever the values in their enclosures are.
    pub pixels: u64,
}

/// A face that a pixel may show, and the least and the largest displayed level of each channel.
type Shown = (Option<usize>, [[f64; 2]; 3]);

/// What each pixel of a row of a picture may show.
type Rows = Box<dyn Fn(usize) -> Vec<Vec<Shown>> + Sync>;

/// The parts of the model that a scene is drawn with and what they are called, in the order in which they are reported.
pub fn parts(scene: &Scene) -> Vec<(Part, String)> {
    let scene = SceneRecord::of(&scene.world);
    let rule = |rule, name: &str| (Part::Rule(rule), name.to_owned());
    let lights = scene.light.iter().enumerate().filter(|(_, it)| it.on);
    let cuboids = || scene.cuboid.iter().enumerate();
    let phong = cuboids().filter(|(_, it)| it.shading == ShadingMode::Phong);
    let mut parts = Vec::new();
    parts.extend(lights.map(|(i, it)| (Part::Light(i), format!("light {}", it.name))));
    parts.push(rule(Rule::SpecularGate, "specular gate"));
    parts.push(rule(Rule::UnitNormal, "unit normal"));
    parts.extend(phong.map(|(i, it)| (Part::EveryPixel(i), format!("every pixel {}", it.name))));
    let name = "perspective-correct interpolation";
    parts.push(rule(Rule::PerspectiveCorrect, name));
    parts.push(rule(Rule::DepthTest, "depth test"));
    parts.push(rule(Rule::NearPlane, "near plane"));
    parts.extend(cuboids().map(|(i, it)| (Part::Cuboid(i), format!("cuboid {}", it.name))));
    parts.push((Part::F64SetUp, "f64 set-up".to_owned()));
    parts
}

/// The scene without some of its lights, cuboids and ways of shading. What remains keeps its place in the file.
pub fn without(scene: &Scene, parts: &[Part]) -> Scene {
    let mut record = SceneRecord::of(&scene.world);
    for part in parts {
        match *part {
            Part::Light(light) => record.light[light].on = false,
            Part::EveryPixel(cuboid) => record.cuboid[cuboid].shading = ShadingMode::Gouraud,
            Part::Rule(_) | Part::Cuboid(_) | Part::F64SetUp => {}
        }
    }
    let mut scene = Scene::spawn(scene.name.clone(), &record);
    for (number, entity) in ordered::<Mesh>(&scene.world).into_iter().enumerate() {
        if parts.contains(&Part::Cuboid(number)) {
            // It has just been spawned.
            let _ = scene.world.despawn(entity);
        }
    }
    scene
}

impl Change {
    /// All of them together.
    pub fn sum(changes: impl IntoIterator<Item = Change>) -> Change {
        let add = |sum: Change, one: Change| Change {
            largest_error: [0, 1].map(|end| sum.largest_error[end].max(one.largest_error[end])),
            pixels: sum.pixels + one.pixels,
        };
        changes.into_iter().fold(Change::default(), add)
    }

    /// The upper end of the largest error.
    pub fn most(&self) -> f64 {
        self.largest_error[1]
    }

    /// Whether it is proven that the picture keeps the tolerance.
    pub fn keeps(&self, tolerance: f64) -> bool {
        self.most() <= limit(tolerance)
    }
}

/// What a picture of the scene errs without each of these lists of parts, on rayon's current threads; `None` as soon as
/// `cancelled` says yes. `progress` is told which share of it is done.
///
/// Each cuboid has its own shading, whatever the view's.
pub fn changes(
    scene: &Scene,
    view: &View,
    left_out: &[Vec<Part>],
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(f64) + Sync),
) -> Option<Vec<Change>> {
    let view = &View {
        shading: None,
        ..*view
    };
    let full = rows(Reference::<Interval>::new(&without(scene, &[]).world, view));
    let limit = limit(view.tolerance);
    let all = left_out.len().div_ceil(AT_ONCE) * view.size[1];
    let done = AtomicUsize::new(0);
    let mut changes = Vec::with_capacity(left_out.len());
    for some in left_out.chunks(AT_ONCE) {
        let picture = |parts: &Vec<Part>| {
            let (world, rule) = (&without(scene, parts).world, rule(parts));
            if parts.contains(&Part::F64SetUp) {
                (rows(Reference::<f32>::without(world, view, rule)), false)
            } else {
                let picture = Reference::<Interval>::without(world, view, rule);
                (rows(picture), true)
            }
        };
        let pictures: Vec<(Rows, bool)> = some.iter().map(picture).collect();
        let row = |y: usize| {
            if cancelled() {
                return None;
            }
            let full = full(y);
            let change = |(picture, is_enclosed): &(Rows, bool)| {
                let pixels = full.iter().zip(picture(y));
                Change::sum(pixels.map(|(full, without)| {
                    let largest_error = error(full, &without, *is_enclosed);
                    Change {
                        largest_error,
                        pixels: u64::from(largest_error[0] > limit),
                    }
                }))
            };
            let changes = pictures.iter().map(change).collect();
            progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / all as f64);
            Some(changes)
        };
        let by_row = (0..view.size[1]).into_par_iter().map(row);
        let by_row: Vec<Vec<Change>> = by_row.collect::<Option<_>>()?;
        let of_picture = |number: usize| Change::sum(by_row.iter().map(|row| row[number]));
        changes.extend((0..pictures.len()).map(of_picture));
    }
    Some(changes)
}

/// A part, what it is called, and what the picture errs without it.
#[derive(Clone, Debug, PartialEq)]
pub struct PartChange {
    pub part: Part,
    pub name: String,
    pub change: Change,
}

/// What a picture errs without each part, the largest error first; `None` as soon as `cancelled` says yes. `progress` is told
/// which share of it is done.
pub fn ranked(
    scene: &Scene,
    view: &View,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(f64) + Sync),
) -> Option<Vec<PartChange>> {
    let parts = parts(scene);
    let left_out: Vec<_> = parts.iter().map(|(part, _)| vec![*part]).collect();
    let changes = changes(scene, view, &left_out, cancelled, progress)?;
    let part_change = |((part, name), change)| PartChange { part, name, change };
    let mut ranked: Vec<_> = parts.into_iter().zip(changes).map(part_change).collect();
    ranked.sort_by(|one, other| other.change.most().total_cmp(&one.change.most()));
    Some(ranked)
}

/// The picture without a part, by the reference, 0x00RRGGBB; `None` as soon as `cancelled` says yes.
pub fn picture_without(
    scene: &Scene,
    view: &View,
    part: Part,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<u32>> {
    let (world, rule) = (&without(scene, &[part]).world, rule(&[part]));
    let picture = match part {
        Part::F64SetUp => rows(Reference::<f32>::without(world, view, rule)),
        _ => rows(Reference::<f64>::without(world, view, rule)),
    };
    let row = |y| {
        let pixels = picture(y).into_iter();
        let pixel = |seen: Vec<Shown>| display_pixel(seen[0].1.map(|[least, _]| least));
        (!cancelled()).then(|| pixels.map(pixel).collect())
    };
    let rows = (0..view.size[1]).into_par_iter().map(row);
    let rows: Vec<Vec<u32>> = rows.collect::<Option<_>>()?;
    Some(rows.concat())
}

/// The rule among parts that are left out, if any.
fn rule(left_out: &[Part]) -> Option<Rule> {
    left_out.iter().find_map(|part| match part {
        Part::Rule(rule) => Some(*rule),
        _ => None,
    })
}

/// The rows of a picture, for their displayed levels alone: an enclosed one may show several things at a pixel, any other shows
/// one.
fn rows<R: Real + 'static>(picture: Reference<R>) -> Rows {
    Box::new(move |y| {
        let mut row = Vec::new();
        let shown = |seen: &Seen<R>| (seen.face(), ends(seen.levels));
        picture.row(y, |_, seen| row.push(seen.iter().map(shown).collect()));
        row
    })
}

/// The least and the largest error of a pixel by what it may show in full and without a part; without enclosures it shows one
/// of what it may show in full.
fn error(full: &[Shown], without: &[Shown], is_enclosed: bool) -> [f64; 2] {
    let mut error = [f64::INFINITY, 0.0_f64];
    let mut compare = |pixel: &[Shown], other: &[Shown]| {
        for shown in pixel {
            let (mut nearest, mut farthest) = (f64::INFINITY, 0.0_f64);
            for other in other {
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

    fn grey(face: usize, least: f64, most: f64) -> Shown {
        (Some(face), [[least, most]; 3])
    }

    #[test]
    fn near_an_edge_a_face_is_held_against_itself_and_against_all_where_it_is_gone() {
        let [front, darker] = [grey(0, 100.0, 101.0), grey(0, 90.0, 92.0)];
        let behind = (None, [[20.0, 20.0]; 3]);
        let cases = [
            (vec![front, behind], vec![darker, behind], [0.0, 11.0]),
            (vec![front, behind], vec![behind], [0.0, 81.0]),
            (vec![behind], vec![front, behind], [0.0, 81.0]),
            (vec![front], vec![behind], [80.0, 81.0]),
            // Of what may be seen of one face the nearest counts.
            (vec![front, darker], vec![darker], [0.0, 11.0]),
        ];
        for (full, without, known) in cases {
            assert_eq!(error(&full, &without, true), known, "{full:?} {without:?}");
        }
        // In f32 one thing is drawn, and it may be any of those that may be seen.
        assert_eq!(error(&[front, behind], &[behind], false), [0.0, 0.0]);
        let drawn = grey(0, 30.0, 30.0);
        assert_eq!(error(&[front, behind], &[drawn], false), [10.0, 71.0]);
    }
}
