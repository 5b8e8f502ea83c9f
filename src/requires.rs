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
//! near an edge that it may show either side is judged as `prove` judges it: each value it may show without the part is held
//! against the nearest of those it may show with it.

mod command;
mod least;
mod share;

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::components::{Light, Name, ShadingMode, View};
use crate::reference::{Interval, Real, Reference, Rule, Seen};
use crate::scene::Scene;
use crate::shading::limit;
use crate::trade::metrics::displayed;
pub use command::run;
pub use least::Least;

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
    /// f64; left out, the reference's formula is evaluated in f32, from the scene's numbers on. No formula of it is chosen
    /// for f32, so it errs as a textbook's does.
    F64SetUp,
}

/// What leaving out parts does to a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Change {
    /// The largest error, in levels: at least, and at most.
    pub largest_error: [f64; 2],
    /// How many pixels err by more than the tolerance, whatever the values in their enclosures are.
    pub pixels: u64,
}

/// The least and the largest displayed level, by channel.
type Ends = [[f64; 2]; 3];

/// A picture that is compared with the full one.
enum Picture {
    Enclosed(Reference<Interval>),
    Single(Reference<f32>),
}

/// The parts of the model that a scene is drawn with, in the order in which they are reported.
pub fn parts(scene: &Scene) -> Vec<Part> {
    let is_on = |&light: &usize| {
        let light = scene.world.get::<&Light>(scene.lights[light]);
        light.is_ok_and(|light| light.on)
    };
    let is_phong = |&cuboid: &usize| {
        let mode = scene.world.get::<&ShadingMode>(scene.cuboids[cuboid]);
        mode.is_ok_and(|mode| *mode == ShadingMode::Phong)
    };
    let (lights, cuboids) = (0..scene.lights.len(), 0..scene.cuboids.len());
    let mut parts: Vec<Part> = lights.filter(is_on).map(Part::Light).collect();
    parts.extend([Rule::SpecularGate, Rule::UnitNormal].map(Part::Rule));
    parts.extend(cuboids.clone().filter(is_phong).map(Part::EveryPixel));
    let rules = [Rule::PerspectiveCorrect, Rule::DepthTest, Rule::NearPlane];
    parts.extend(rules.map(Part::Rule));
    parts.extend(cuboids.map(Part::Cuboid));
    parts.push(Part::F64SetUp);
    parts
}

impl Part {
    /// What reports call it.
    pub fn name(self, scene: &Scene) -> String {
        let name = |entity| {
            let name = scene.world.get::<&Name>(entity);
            name.map_or_else(|_| String::new(), |name| name.0.clone())
        };
        match self {
            Part::Light(light) => format!("light {}", name(scene.lights[light])),
            Part::Rule(Rule::SpecularGate) => "specular gate".to_owned(),
            Part::Rule(Rule::UnitNormal) => "unit normal".to_owned(),
            Part::EveryPixel(cuboid) => format!("every pixel {}", name(scene.cuboids[cuboid])),
            Part::Rule(Rule::PerspectiveCorrect) => "perspective-correct interpolation".to_owned(),
            Part::Rule(Rule::DepthTest) => "depth test".to_owned(),
            Part::Rule(Rule::NearPlane) => "near plane".to_owned(),
            Part::Cuboid(cuboid) => format!("cuboid {}", name(scene.cuboids[cuboid])),
            Part::F64SetUp => "f64 set-up".to_owned(),
        }
    }
}

/// The scene without some of its lights, cuboids and ways of shading.
pub fn without(scene: &Scene, parts: &[Part]) -> Scene {
    let mut record = scene.to_record();
    for part in parts {
        match *part {
            Part::Light(light) => record.light[light].on = false,
            Part::EveryPixel(cuboid) => *record.cuboid[cuboid].shading = ShadingMode::Gouraud,
            Part::Rule(_) | Part::Cuboid(_) | Part::F64SetUp => {}
        }
    }
    let mut cuboids = (0..).map(Part::Cuboid);
    let is_kept = |_: &_| !cuboids.next().is_some_and(|cuboid| parts.contains(&cuboid));
    record.cuboid.value.retain(is_kept);
    Scene::spawn(scene.name.clone(), &record)
}

impl Picture {
    fn new(scene: &Scene, view: &View, left_out: &[Part]) -> Picture {
        let world = without(scene, left_out).world;
        let rule = left_out.iter().find_map(|part| match part {
            Part::Rule(rule) => Some(*rule),
            _ => None,
        });
        if left_out.contains(&Part::F64SetUp) {
            Picture::Single(Reference::without(&world, view, rule))
        } else {
            Picture::Enclosed(Reference::without(&world, view, rule))
        }
    }

    /// Adds what row `y` of this picture errs against what the full one may show in each of its columns.
    fn compare(&self, y: usize, full: &[Vec<Ends>], limit: f64, change: &mut Change) {
        match self {
            Picture::Enclosed(picture) => picture.row(y, |x, seen| {
                change.add(error(&full[x], seen), limit);
            }),
            Picture::Single(picture) => picture.row(y, |x, seen| {
                change.add(error(&full[x], seen), limit);
            }),
        }
    }
}

impl Change {
    /// Adds what one pixel errs.
    fn add(&mut self, error: [f64; 2], limit: f64) {
        self.append(Change {
            largest_error: error,
            pixels: u64::from(error[0] > limit),
        });
    }

    /// Adds what other pixels err.
    pub fn append(&mut self, other: Change) {
        let [ours, theirs] = [self.largest_error, other.largest_error];
        self.largest_error = [0, 1].map(|end| ours[end].max(theirs[end]));
        self.pixels += other.pixels;
    }

    /// Whether it is proven that the picture keeps the tolerance.
    pub fn keeps(&self, tolerance: f64) -> bool {
        self.largest_error[1] <= limit(tolerance)
    }
}

fn ends<R: Real>(seen: &Seen<R>) -> Ends {
    seen.levels.map(|level| level.endpoints().map(displayed))
}

/// The least and the largest error of a pixel by what it may show in full and without a part.
fn error<R: Real>(full: &[Ends], without: &[Seen<R>]) -> [f64; 2] {
    let mut error = [f64::INFINITY, 0.0];
    for seen in without {
        let seen = ends(seen);
        let mut nearest = [f64::INFINITY; 2];
        for full in full {
            let between = difference(full, &seen);
            nearest = [0, 1].map(|end| nearest[end].min(between[end]));
        }
        error = [error[0].min(nearest[0]), error[1].max(nearest[1])];
    }
    error
}

/// The least and the largest difference of two enclosures, over the channels.
fn difference(left: &Ends, right: &Ends) -> [f64; 2] {
    let mut largest = [0.0_f64; 2];
    for (left, right) in left.iter().zip(right) {
        let [left, right] = [left, right].map(|[least, most]| Interval::new(*least, *most));
        let [below, above] = (left - right).endpoints();
        largest = [
            largest[0].max(below).max(-above),
            largest[1].max(above).max(-below),
        ];
    }
    largest
}

/// What the pictures of a scene err without each of these lists of parts, by view, on rayon's current threads. `progress`
/// is told the share that is done, 0..=1.
pub fn changes(
    scene: &Scene,
    views: &[View],
    left_out: &[Vec<Part>],
    progress: &(dyn Fn(f64) + Sync),
) -> Vec<Vec<Change>> {
    let rows: usize = views.iter().map(|view| view.size[1]).sum();
    let done = AtomicUsize::new(0);
    let row_done = || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress(done as f64 / rows as f64);
    };
    let of_view = |view| changes_of_view(scene, view, left_out, &row_done);
    views.iter().map(of_view).collect()
}

fn changes_of_view(
    scene: &Scene,
    view: &View,
    left_out: &[Vec<Part>],
    row_done: &(dyn Fn() + Sync),
) -> Vec<Change> {
    let full = Reference::<Interval>::new(&scene.world, view);
    let picture = |parts: &Vec<Part>| Picture::new(scene, view, parts);
    let pictures: Vec<Picture> = left_out.iter().map(picture).collect();
    let limit = limit(view.tolerance);
    let none = || vec![Change::default(); pictures.len()];
    let row = |y: usize| {
        let mut shown: Vec<Vec<Ends>> = Vec::with_capacity(view.size[0]);
        full.row(y, |_, seen| shown.push(seen.iter().map(ends).collect()));
        let mut changes = none();
        for (picture, change) in pictures.iter().zip(&mut changes) {
            picture.compare(y, &shown, limit, change);
        }
        row_done();
        changes
    };
    let add = |mut sum: Vec<Change>, row| {
        for (sum, change) in sum.iter_mut().zip(row) {
            sum.append(change);
        }
        sum
    };
    (0..view.size[1]).into_par_iter().map(row).reduce(none, add)
}
