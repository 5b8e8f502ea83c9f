//! The bits of significand that each stage of the model requires.
//!
//! ```text
//! scene --reference in f64--> triangle, weights --textbook, one stage rounded--> levels of each pixel ---+
//!    |                                                                                                   +--> error
//!    '----reference over intervals--> levels of each pixel ----------------------------------------------+
//! ```
//! The textbook's formula is evaluated in world space, as a shader does. One stage at a time is rounded: each number of
//! the scene that it uses, and the result of each of its operations, to nearest. It takes the results of the other stages
//! as f64 has them, so every rounding belongs to one stage:
//!
//! ```text
//! positions                  P = a P1 + b P2 + c P3          (Gouraud: the corners)
//! normals                    n = unit(a n1 + b n2 + c n3)    (Gouraud: the corners')
//! vectors to light and eye   l = unit(L - P), o = unit(O - P)
//! dot products               n.l, r = 2 (n.l) n - l, o.r
//! power                      2^(rho log2(o.r))
//! sum                        sum of levels * factor          (Gouraud: and a I1 + b I2 + c I3)
//! ```
//! The error of a pixel is the upper bound of the distance from its enclosure. More bits do not always err less, so the
//! search starts at 24 bits and ends at the first number that breaks the tolerance at any pixel.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};

use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;

use super::{FaceLevels, error, rows, without};
use crate::components::{
    FACES, FileOrder, Light, LightKind, Material, Mesh, Projection, ShadingMode, TRIANGLES,
    Transform, View, in_file_order,
};
use crate::reference::{Interval, Reference, Spot};
use crate::scene::Scene;
use crate::shading::limit;
use crate::trade::metrics::ends;
use crate::trade::words::short;

/// A part of the model's formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    Positions,
    Normals,
    Vectors,
    DotProducts,
    Power,
    Sum,
}

/// The stages with their names, in the order of evaluation.
pub const STAGES: [(Stage, &str); 6] = [
    (Stage::Positions, "positions"),
    (Stage::Normals, "normals"),
    (Stage::Vectors, "vectors to light and eye"),
    (Stage::DotProducts, "dot products"),
    (Stage::Power, "power"),
    (Stage::Sum, "sum"),
];

/// The most and the fewest bits that are tried.
const MOST: u32 = 24;
const FEWEST: u32 = 2;

/// A format of floating-point numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Format {
    /// Bits of significand, the leading one included, 2..=24.
    pub bits: u32,
    /// The largest exponent of two; the least one of normal numbers is 1 minus this (IEEE 754).
    pub exponent: i32,
}

impl Format {
    pub const F16: Format = Format::new(11, 15);
    pub const BF16: Format = Format::new(8, 127);
    pub const F32: Format = Format::new(24, 127);

    const fn new(bits: u32, exponent: i32) -> Self {
        Format { bits, exponent }
    }

    /// So many bits and exponents that no scene exceeds.
    pub const fn of_bits(bits: u32) -> Self {
        Format::new(bits, 900)
    }

    /// The nearest number of the format; of two, the even one. Beyond the largest it is infinite.
    ///
    /// An operation on numbers of at most 24 bits that is rounded to f64 first is rounded as if directly (Figueroa 1995).
    pub fn round(self, value: f64) -> f64 {
        /// 1.5 * 2^52: a smaller number added to it is rounded to an integer.
        const INTEGERS: f64 = 6_755_399_441_055_744.0;
        let exponent = (value.to_bits() >> 52 & 0x7ff) as i32 - 1023;
        let last = power_of_two(exponent.max(1 - self.exponent) + 1 - self.bits as i32);
        let rounded = (value / last + INTEGERS - INTEGERS) * last;
        if rounded.abs() < power_of_two(self.exponent + 1) {
            rounded
        } else {
            rounded * f64::INFINITY
        }
    }
}

/// 2^exponent, for an exponent of a normal number.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// What a stage requires. Errors are in levels of 255, proven.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StageBits {
    pub stage: &'static str,
    /// The fewest bits from which on all numbers up to 24 keep the tolerance; `None` if 24 do not.
    pub bits: Option<u32>,
    /// The largest error with so many bits, or with 24.
    pub largest_error: f64,
    pub f16: FormatError,
    pub bf16: FormatError,
    pub f32: FormatError,
}

/// The largest error in a format, in levels of 255, and whether it keeps the tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FormatError {
    pub largest_error: f64,
    pub keeps: bool,
}

impl FormatError {
    /// "yes" or "no", and the error.
    pub fn text(&self) -> String {
        let answer = if self.keeps { "yes" } else { "no" };
        format!("{answer}, {}", short(Some(self.largest_error)))
    }
}

/// The formula with one stage in a format.
#[derive(Clone, Copy)]
struct Trial {
    stage: Stage,
    format: Format,
}

/// A scene in world space.
struct Model {
    objects: Vec<Object>,
    /// The kind and the position of each light that is on.
    lights: Vec<(LightKind, DVec3)>,
    eye: DVec3,
    /// o in orthographic projection.
    to_eye: Option<DVec3>,
}

/// A cuboid in world space.
struct Object {
    corners: [DVec3; 8],
    normals: [DVec3; 8],
    shininess: f64,
    /// The levels of each light, times its coefficient.
    levels: Vec<DVec3>,
    mode: ShadingMode,
}

impl Model {
    fn new(scene: &Scene, view: &View) -> Self {
        let world = without(scene, &[]).world;
        let mut query = world.query::<(&FileOrder, &Transform, &Light)>();
        let lights = query.iter().filter(|(.., light)| light.on);
        let lights = in_file_order(lights.map(|(order, place, light)| (*order, (*place, *light))));
        let mut query = world.query::<(&FileOrder, &Transform, &Mesh, &Material, &ShadingMode)>();
        let objects = query.iter().map(|(order, place, mesh, material, mode)| {
            let place = place.turned(view.turned);
            let axes = place.axes();
            let levels = lights.iter().map(|(_, light)| {
                let coefficient = match light.kind {
                    LightKind::Ambient => material.ambient,
                    LightKind::Diffuse => material.diffuse,
                    LightKind::Specular => material.specular,
                };
                coefficient * light.levels()
            });
            let object = Object {
                corners: mesh.corners.map(|corner| place.position + axes * corner),
                normals: mesh
                    .corners
                    .map(|corner| axes * corner.signum().normalize()),
                shininess: material.shininess,
                levels: levels.collect(),
                mode: *mode,
            };
            (*order, object)
        });
        let viewpoint = &view.viewpoint;
        let backward = viewpoint.position - viewpoint.camera.target;
        Model {
            objects: in_file_order(objects),
            lights: (lights.iter())
                .map(|(place, light)| (light.kind, place.position))
                .collect(),
            eye: viewpoint.position,
            to_eye: (view.projection == Projection::Orthographic).then(|| backward.normalize()),
        }
    }
}

impl Trial {
    /// The result of an operation of a stage.
    fn one(self, stage: Stage, value: f64) -> f64 {
        if stage == self.stage {
            self.format.round(value)
        } else {
            value
        }
    }

    fn all(self, stage: Stage, vector: DVec3) -> DVec3 {
        if stage == self.stage {
            DVec3::from(vector.to_array().map(|value| self.format.round(value)))
        } else {
            vector
        }
    }

    fn dot(self, stage: Stage, one: DVec3, other: DVec3) -> f64 {
        let [x, y, z] = self.all(stage, one * other).to_array();
        self.one(stage, self.one(stage, x + y) + z)
    }

    fn unit(self, stage: Stage, vector: DVec3) -> DVec3 {
        let length = self.one(stage, self.dot(stage, vector, vector).sqrt());
        self.all(stage, vector / length)
    }

    /// The weighted sum of the values at three corners.
    fn blend(self, stage: Stage, values: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
        let [a, b, c] = [0, 1, 2].map(|i| self.all(stage, self.all(stage, values[i]) * weights[i]));
        self.all(stage, self.all(stage, a + b) + c)
    }

    fn power(self, base: f64, exponent: f64) -> f64 {
        if exponent == 0.0 {
            return 1.0;
        }
        let round = |value| self.one(Stage::Power, value);
        round(round(round(base.max(0.0).log2()) * round(exponent)).exp2())
    }

    /// The model at a point. A direction that is not a number, as that of a light at the point, lights nothing.
    fn lit(self, model: &Model, object: &Object, point: DVec3, normal: DVec3) -> DVec3 {
        use Stage::{DotProducts, Sum, Vectors};
        let towards = |place: DVec3| {
            let place = self.all(Vectors, place);
            self.unit(Vectors, self.all(Vectors, place - point))
        };
        let mut levels = DVec3::ZERO;
        for ((kind, place), strength) in model.lights.iter().zip(&object.levels) {
            let to_light = towards(*place);
            let cosine = self.dot(DotProducts, normal, to_light);
            let factor = match kind {
                LightKind::Ambient => 1.0,
                LightKind::Diffuse => cosine.max(0.0),
                LightKind::Specular if cosine > 0.0 => {
                    let along = self.all(DotProducts, normal * (2.0 * cosine));
                    let reflected = self.all(DotProducts, along - to_light);
                    let to_eye = model.to_eye.map(|to_eye| self.all(Vectors, to_eye));
                    let to_eye = to_eye.unwrap_or_else(|| towards(model.eye));
                    self.power(self.dot(DotProducts, to_eye, reflected), object.shininess)
                }
                LightKind::Specular => 0.0,
            };
            let term = self.all(Sum, self.all(Sum, *strength) * factor);
            levels = self.all(Sum, levels + term);
        }
        levels
    }

    /// Phong's levels, with P and n interpolated between these corners.
    fn phong(
        self,
        model: &Model,
        object: &Object,
        corners: [usize; 3],
        weights: [f64; 3],
    ) -> DVec3 {
        let point = corners.map(|corner| object.corners[corner]);
        let normal = corners.map(|corner| object.normals[corner]);
        let point = self.blend(Stage::Positions, point, weights);
        let normal = self.unit(Stage::Normals, self.blend(Stage::Normals, normal, weights));
        self.lit(model, object, point, normal)
    }

    /// Gouraud's levels at a corner.
    fn at_corner(self, model: &Model, object: &Object, corner: usize) -> DVec3 {
        let point = self.all(Stage::Positions, object.corners[corner]);
        let normal = self.all(Stage::Normals, object.normals[corner]);
        self.lit(model, object, point, normal)
    }
}

/// Trials of one stage: with f16, bf16 and f32, then with [`FEWEST`] to [`MOST`] bits.
const TRIALS: usize = 3 + (MOST - FEWEST + 1) as usize;

/// The trials of all stages, by stage.
fn trials() -> [[Trial; TRIALS]; 6] {
    STAGES.map(|(stage, _)| {
        std::array::from_fn(|index| {
            let formats = [Format::F16, Format::BF16, Format::F32];
            let bits = || Format::of_bits(FEWEST + index as u32 - 3);
            let format = formats.get(index).copied().unwrap_or_else(bits);
            Trial { stage, format }
        })
    })
}

/// The bits that each stage of the picture requires, computed on rayon's current threads. `None` as soon as `cancelled`
/// returns true. `progress` receives the finished share, 0..=1.
///
/// Each cuboid keeps its own shading; that of the view is not used.
pub fn bits(
    scene: &Scene,
    view: &View,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(f64) + Sync),
) -> Option<Vec<StageBits>> {
    let view = &View {
        shading: None,
        ..*view
    };
    let world = &without(scene, &[]).world;
    let enclosures = rows(Reference::<Interval>::new(world, view));
    let places = Reference::<f64>::new(world, view);
    let (model, trials, limit) = (Model::new(scene, view), trials(), limit(view.tolerance));
    // The fewest bits that no pixel has ruled out so far, by stage.
    let fewest = STAGES.map(|_| AtomicU32::new(FEWEST));
    let done = AtomicUsize::new(0);
    let row = |y: usize| {
        if cancelled() {
            return None;
        }
        let mut errors = [[0.0_f64; TRIALS]; 6];
        let mut at_corners = HashMap::new();
        for (full, spot) in enclosures(y).iter().zip(places.spots(y)) {
            let Some(Spot {
                cuboid,
                triangle,
                weights,
            }) = spot
            else {
                continue;
            };
            let object = &model.objects[cuboid];
            let corners = TRIANGLES[triangle].map(usize::from);
            let face = Some(cuboid * FACES.len() + triangle / 2);
            for (stage, trials) in trials.iter().enumerate() {
                let mut breaks = |index: usize| {
                    let trial = trials[index];
                    let levels = if object.mode == ShadingMode::Gouraud {
                        let lit = corners.map(|corner| {
                            let lit = at_corners.entry([stage, index, cuboid, corner]);
                            *lit.or_insert_with(|| trial.at_corner(&model, object, corner))
                        });
                        trial.blend(Stage::Sum, lit, weights)
                    } else {
                        trial.phong(&model, object, corners, weights)
                    };
                    let shown: FaceLevels = (face, ends(levels.to_array()));
                    let [_, error] = error(full, &[shown], false);
                    errors[stage][index] = errors[stage][index].max(error);
                    error > limit
                };
                for format in 0..3 {
                    breaks(format);
                }
                let left = fewest[stage].load(Ordering::Relaxed)..=MOST;
                let index = |bits: u32| 3 + (bits - FEWEST) as usize;
                if let Some(bits) = left.rev().find(|bits| breaks(index(*bits))) {
                    fewest[stage].fetch_max(bits + 1, Ordering::Relaxed);
                }
            }
        }
        progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / view.size[1] as f64);
        Some(errors)
    };
    let by_row = (0..view.size[1]).into_par_iter().map(row);
    let by_row: Vec<_> = by_row.collect::<Option<_>>()?;
    let of_stage = |(stage, fewest): (usize, &AtomicU32)| {
        let largest = |index: usize| {
            let errors = by_row.iter().map(|row| row[stage][index]);
            errors.fold(0.0, f64::max)
        };
        let format = |index| FormatError {
            largest_error: largest(index),
            keeps: largest(index) <= limit,
        };
        let bits = fewest.load(Ordering::Relaxed);
        StageBits {
            stage: STAGES[stage].1,
            bits: (bits <= MOST).then_some(bits),
            largest_error: largest(3 + (bits.min(MOST) - FEWEST) as usize),
            f16: format(0),
            bf16: format(1),
            f32: format(2),
        }
    };
    Some(fewest.iter().enumerate().map(of_stage).collect())
}
