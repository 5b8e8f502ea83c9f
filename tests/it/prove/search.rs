//! A search for the worst scene: it climbs from random small scenes towards the largest used share of the tolerance.
//!
//! A scene is a list of numbers in 0..=1. A step changes some of them and is kept unless the share shrinks. The results
//! are stored in [`FOUND`], where the next search starts. `SHADETRADE_SEARCH` sets the minutes of search in all;
//! without it the search takes a few steps from each stored scene.

use std::f64::consts::TAU;
use std::time::{Duration, Instant};

use glam::DVec3;
use hecs::World;
use shadetrade::components::{LightKind, Material, Projection, ShadingMode, Transform, View};
use shadetrade::frame::{Keep, face};
use shadetrade::reference;
use shadetrade::trade::metrics::pixel_error;

use super::proof;
use crate::support::random::Random;
use crate::support::scene::{self, empty, shine, spawn_cuboid, spawn_light};

const SIZE: [usize; 2] = [48, 36];

/// The stored scenes, one per line: tolerance, mode, numbers.
const FOUND: &str = include_str!("search/found.txt");

/// Steps without a gain after which a climb restarts.
const PATIENCE: usize = 150;

/// Steps from each scene of [`FOUND`] without a given time.
const STEPS: usize = 20;

/// Random scenes, of which the best starts a climb.
const STARTS: usize = 20;

/// A scene's numbers, each 0..=1.
type Numbers = [f64; 21];

/// A tolerance in levels, and a mode.
type Asked = (f64, ShadingMode);

/// A number from `least` to `largest`, evenly distributed in the logarithm.
fn scaled(share: f64, [least, largest]: [f64; 2]) -> f64 {
    least * (largest / least).powf(share)
}

/// A unit vector by its height and its angle.
fn direction(height: f64, turn: f64) -> DVec3 {
    let z = 2.0 * height - 1.0;
    let (sin, cos) = (turn * TAU).sin_cos();
    DVec3::new(cos, sin, 0.0) * (1.0 - z * z).sqrt() + DVec3::Z * z
}

/// A cuboid under an ambient, a diffuse and a specular light.
fn build(numbers: &Numbers, (tolerance, mode): Asked) -> (World, View) {
    let n = |i: usize| numbers[i];
    let size = DVec3::from([0, 1, 2].map(|i| scaled(n(i), [0.3, 10.0])));
    let radius = size.length() / 2.0;
    let place = |from: usize, reach: [f64; 2]| {
        direction(n(from), n(from + 1)) * scaled(n(from + 2), reach) * radius
    };
    let mut world = empty();
    let material = Material {
        ambient: DVec3::splat(0.2),
        diffuse: DVec3::new(1.0, 0.7, 0.4),
        specular: DVec3::new(0.4, 0.7, 1.0),
        shininess: scaled(n(3), [0.5, 2000.0]),
    };
    let transform = Transform {
        position: DVec3::ZERO,
        rotation: DVec3::new(n(4), n(5), n(6)) * 360.0,
    };
    spawn_cuboid(&mut world, size, transform, material);
    shine(&mut world, LightKind::Ambient, 200.0, DVec3::ZERO);
    let lights = [(LightKind::Diffuse, 7), (LightKind::Specular, 11)];
    for (kind, from) in lights {
        let levels = DVec3::splat(scaled(n(from + 3), [0.1, 400.0]));
        spawn_light(&mut world, kind, levels, place(from, [0.6, 30.0]));
    }
    let is_perspective = n(15) < 0.5;
    let mut view = scene::view(
        SIZE,
        place(16, [1.2, 10.0]),
        DVec3::ZERO,
        if is_perspective {
            Projection::Perspective
        } else {
            Projection::Orthographic
        },
    );
    view.viewpoint.camera.up = DVec3::new(0.1, 1.0, 0.2);
    view.viewpoint.camera.fov = scaled(n(19), [2.0, 100.0]);
    view.viewpoint.camera.height = scaled(n(20), [0.1, 3.0]) * radius;
    view.shading = Some(mode);
    view.tolerance = tolerance;
    (world, view)
}

/// The largest share of the tolerance that is used according to the f64 reference.
fn estimate(world: &mut World, view: &View) -> f64 {
    let frame = scene::draw(world, view, Keep::Levels);
    let truth = reference::picture(world, view, 0..SIZE[1], &|| false, &|_| ());
    let truth = truth.expect("it is not cancelled");
    let drawn = frame.triangles().iter().zip(frame.levels());
    let exact = truth.triangles.iter().zip(&truth.levels);
    let pairs = drawn.zip(exact);
    let same = pairs.filter(|((drawn, _), (seen, _))| face(**drawn) == face(**seen));
    let errors = same.map(|((_, levels), (_, exact))| pixel_error(*levels, *exact));
    errors.fold(0.0, f64::max) / view.tolerance
}

/// The largest share of the tolerance that the proof leaves possible; infinite if a pixel is not proven.
fn proven(numbers: &Numbers, asked: Asked) -> f64 {
    let (mut world, view) = build(numbers, asked);
    let proof = proof(&mut world, &view);
    if proof.refuted + proof.undecided > 0 {
        let examples = &proof.examples;
        println!("{asked:?} {numbers:?} is not proven: {examples:?}");
        return f64::INFINITY;
    }
    proof.worst / view.tolerance
}

/// The state of a climb, and the number of steps since its last gain.
#[derive(Clone)]
struct Climb {
    asked: Asked,
    numbers: Numbers,
    share: f64,
    stale: usize,
}

impl Climb {
    fn from(numbers: Numbers, asked: Asked) -> Self {
        Climb {
            asked,
            numbers,
            share: proven(&numbers, asked),
            stale: 0,
        }
    }

    fn anew(random: &mut Random, asked: Asked) -> Self {
        let scenes = (0..STARTS).map(|_| {
            let numbers = std::array::from_fn(|_| random.within(0.0, 1.0));
            let (mut world, view) = build(&numbers, asked);
            (estimate(&mut world, &view), numbers)
        });
        let best = scenes.max_by(|(left, _), (right, _)| left.total_cmp(right));
        let (_, numbers) = best.expect("there are some");
        Self::from(numbers, asked)
    }

    fn step(&mut self, random: &mut Random) {
        let mut numbers = self.numbers;
        let reach = scaled(random.within(0.0, 1.0), [1e-4, 0.5]);
        let chance = random.within(0.05, 0.5);
        for number in &mut numbers {
            if random.within(0.0, 1.0) < chance {
                *number = (*number + random.within(-reach, reach)).clamp(0.0, 1.0);
            }
        }
        self.stale += 1;
        let (mut world, view) = build(&numbers, self.asked);
        // A proof takes ten times as long as an estimate.
        if estimate(&mut world, &view) < self.share {
            return;
        }
        let share = proven(&numbers, self.asked);
        if share >= self.share {
            if share > self.share + 1e-4 {
                self.stale = 0;
            }
            (self.numbers, self.share) = (numbers, share);
        }
    }
}

/// Climbs while `more` returns true. Returns the best proven scene, and whether all pictures were proven.
fn search(climb: Climb, mut more: impl FnMut() -> bool, random: &mut Random) -> (Climb, bool) {
    let asked = climb.asked;
    let (mut best, mut climb, mut is_proven) = (climb.clone(), climb, true);
    while more() {
        climb.step(random);
        if climb.share.is_infinite() {
            is_proven = false;
        } else if climb.share > best.share {
            best = climb.clone();
        }
        if climb.stale > PATIENCE || climb.share.is_infinite() {
            climb = Climb::anew(random, asked);
        }
    }
    (best, is_proven)
}

/// A line of [`FOUND`].
fn parse(line: &str) -> Climb {
    let mut words = line.split_whitespace();
    let number = |word: Option<&str>| -> f64 {
        let word = word.expect("a word more");
        word.parse().expect("a number")
    };
    let tolerance = number(words.next());
    let mode = match words.next() {
        Some("gouraud") => ShadingMode::Gouraud,
        _ => ShadingMode::Phong,
    };
    let numbers = std::array::from_fn(|_| number(words.next()));
    Climb::from(numbers, (tolerance, mode))
}

#[test]
fn the_search_for_the_worst_comes_near_the_tolerance_and_never_exceeds_it() {
    let minutes = std::env::var("SHADETRADE_SEARCH").ok().map(|minutes| {
        let minutes: f64 = minutes.parse().expect("SHADETRADE_SEARCH is a number");
        minutes
    });
    let climbs: Vec<Climb> = FOUND.lines().map(parse).collect();
    let share = climbs.len() as f64;
    let time = minutes.map(|minutes| Duration::from_secs_f64(60.0 * minutes / share));
    let mut random = Random(14);
    let found: Vec<_> = climbs
        .into_iter()
        .map(|climb| {
            let (begin, mut steps) = (Instant::now(), 0);
            let more = || {
                steps += 1;
                time.map_or(steps <= STEPS, |time| begin.elapsed() < time)
            };
            let (best, is_proven) = search(climb, more, &mut random);
            let (tolerance, mode) = best.asked;
            let numbers = best.numbers.map(|number| format!("{number:.9}")).join(" ");
            println!("{:.4}: {tolerance} {} {numbers}", best.share, mode.name());
            (best, is_proven)
        })
        .collect();
    for (Climb { asked, share, .. }, is_proven) in &found {
        assert!(is_proven, "a picture is not proven at {asked:?}");
        // At the least tolerances roundings of f32 leave little to interpolation.
        let least = match asked.0 {
            ..0.001 => 0.05,
            ..0.01 => 0.4,
            _ => 0.6,
        };
        assert!(*share > least, "at {asked:?} only {share} of it was found");
    }
    let near = found.iter().filter(|(climb, _)| climb.share > 0.95).count();
    assert!(near >= 8, "{near} climbs come near the tolerance");
}
