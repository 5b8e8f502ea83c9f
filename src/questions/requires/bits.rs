//! The bits of significand that each stage of the model requires.
//!
//! ```text
//! scene --reference in f64--> triangle, weights --textbook, one stage rounded--> levels of each pixel ---+
//!    |                                                                                                   +--> error
//!    '----reference over intervals--> levels of each pixel ----------------------------------------------+
//! ```
//! The textbook's formula is evaluated in world space, as a shader does. One stage at a time is rounded to nearest:
//! the numbers of the scene that it uses, and the result of each of its operations. All other stages are computed in f64:
//!
//! ```text
//! positions                  P = a P1 + b P2 + c P3          (Gouraud: the vertices)
//! normals                    n = unit(a n1 + b n2 + c n3)    (Gouraud: those of the vertices)
//! vectors to light and eye   l = unit(L - P), o = unit(O - P)
//! dot products               n.l, r = 2 (n.l) n - l, o.r
//! power                      2^(rho log2(o.r))
//! sum                        sum of levels * factor          (Gouraud: and a I1 + b I2 + c I3)
//! ```
//! A pixel's error is its largest distance from any value of its enclosure. More bits may err more. The fewest bits are the
//! least b for which b, b + 1, ..., 24 bits all keep the tolerance.

use std::array::from_fn;

use glam::{DMat3, DVec3};
use serde::Serialize;

use super::{error, rows};
use crate::components::{
    FACES, LightKind, NormalMode, Projection, Segments, ShadingMode, Transform, View,
};
use crate::output::Monitor;
use crate::output::words::short;
use crate::questions::metrics::ends;
use crate::reference::{Interval, LightSample, Reference, Sample, in_row};
use crate::scene::{CuboidRecord, Scene, SceneRecord};
use crate::shading::limit;

/// A stage of the model, in the order of [`STAGES`].
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    Positions,
    Normals,
    Vectors,
    Products,
    Power,
    Sum,
}

/// The stages in the order of evaluation.
#[rustfmt::skip]
const STAGES: [(Stage, &str); 6] = [
    (Stage::Positions, "positions"), (Stage::Normals, "normals"), (Stage::Vectors, "vectors to light and eye"),
    (Stage::Products, "dot products"), (Stage::Power, "power"), (Stage::Sum, "sum"),
];

/// A format of floating-point numbers.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// Bits of significand, the leading one included, 2..=24.
    pub bits: u32,
    /// The largest exponent of two; the least one of normal numbers is 1 minus this (IEEE 754).
    pub exponent: i32,
}

/// The formats that are tried by name.
#[rustfmt::skip]
pub const FORMATS: [(&str, Format); 3] = [
    ("f16", Format { bits: 11, exponent: 15 }),
    ("bf16", Format { bits: 8, exponent: 127 }),
    ("f32", Format { bits: 24, exponent: 127 }),
];

impl Format {
    /// The formats that are tried: [`FORMATS`], then formats of 2 to 24 bits whose range holds every number of every scene.
    fn tried() -> Vec<Format> {
        let of_bits = (2..=24).map(|bits| Format {
            bits,
            exponent: 900,
        });
        let named = FORMATS.into_iter().map(|(_, format)| format);
        named.chain(of_bits).collect()
    }

    /// Rounds to nearest, ties to even. A number beyond the largest becomes infinite. The result of an operation is rounded
    /// twice, first to f64. This matters only within 2^-53 of a tie (Figueroa 1995).
    pub fn round(self, value: f64) -> f64 {
        /// 1.5 * 2^52: a smaller number added to it is rounded to an integer.
        const INTEGERS: f64 = 6_755_399_441_055_744.0;
        let power_of_two = |exponent: i32| f64::from_bits(((exponent + 1023) as u64) << 52);
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

/// What a stage requires. Errors are in levels of 255, proven.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StageBits {
    pub stage: &'static str,
    /// The least number of bits that keeps the tolerance, as do all larger ones up to 24; `None` if 24 do not.
    pub bits: Option<usize>,
    /// The largest error with this number of bits, or with 24.
    pub largest_error: f64,
    pub formats: [FormatError; 3],
}

/// The largest error in a format, in levels of 255, and whether it keeps the tolerance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FormatError {
    pub format: &'static str,
    pub largest_error: f64,
    pub keeps: bool,
}

impl StageBits {
    /// The cells of a table: stage, bits, largest error, formats.
    pub fn cells(&self) -> [String; 6] {
        let bits = self.bits.map_or("> 24".to_owned(), |bits| bits.to_string());
        let [f16, bf16, f32] = self.formats.each_ref().map(|format| {
            let answer = if format.keeps { "yes" } else { "no" };
            format!("{answer}, {}", short(format.largest_error))
        });
        let error = short(self.largest_error);
        [self.stage.to_owned(), bits, error, f16, bf16, f32]
    }
}

/// The formula at a pixel, with one stage in a format.
#[derive(Clone, Copy)]
struct Trial<'a> {
    stage: Stage,
    format: Format,
    /// The lights that are on, and the cuboids.
    scene: &'a SceneRecord,
    view: &'a View,
    sample: &'a Sample,
}

impl Trial<'_> {
    /// Rounds the result of an operation, if it belongs to the stage that is tried.
    fn rounded(self, stage: Stage, value: f64) -> f64 {
        if stage == self.stage {
            self.format.round(value)
        } else {
            value
        }
    }

    fn rounded_vector(self, stage: Stage, vector: DVec3) -> DVec3 {
        DVec3::from(vector.to_array().map(|value| self.rounded(stage, value)))
    }

    fn dot(self, stage: Stage, one: DVec3, other: DVec3) -> f64 {
        let [x, y, z] = self.rounded_vector(stage, one * other).to_array();
        self.rounded(stage, self.rounded(stage, x + y) + z)
    }

    fn unit(self, stage: Stage, vector: DVec3) -> DVec3 {
        let length = self.rounded(stage, self.dot(stage, vector, vector).sqrt());
        self.rounded_vector(stage, vector / length)
    }

    /// The weighted sum of the values at three corners.
    fn blend(self, stage: Stage, values: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
        let [a, b, c] = from_fn(|i| {
            self.rounded_vector(stage, self.rounded_vector(stage, values[i]) * weights[i])
        });
        self.rounded_vector(stage, self.rounded_vector(stage, a + b) + c)
    }

    /// The model at a point of the cuboid that a pixel shows. A light at the point itself has no
    /// direction; it adds nothing.
    fn lit(self, [point, normal]: [DVec3; 2]) -> DVec3 {
        use Stage::{Power, Products, Sum, Vectors};
        let towards = |place: DVec3| {
            let way = self.rounded_vector(Vectors, self.rounded_vector(Vectors, place) - point);
            self.unit(Vectors, way)
        };
        let power = |base: f64| {
            let shininess = self.scene.cuboid[self.sample.object].material.shininess;
            let [log, rho] = [base.max(0.0).log2(), shininess].map(|it| self.rounded(Power, it));
            // 0^0 is 1.
            let exponent = if rho == 0.0 { 0.0 } else { log * rho };
            self.rounded(Power, self.rounded(Power, exponent).exp2())
        };
        let mut levels = DVec3::ZERO;
        for (light, LightSample { strength, .. }) in
            self.scene.light.iter().zip(&self.sample.lights)
        {
            let to_light = towards(light.position.unwrap_or_default());
            let cosine = self.dot(Products, normal, to_light);
            let factor = match light.kind {
                LightKind::Ambient => 1.0,
                LightKind::Diffuse => cosine.max(0.0),
                LightKind::Specular if cosine > 0.0 => {
                    let along = self.rounded_vector(Products, normal * (2.0 * cosine));
                    let reflected = self.rounded_vector(Products, along - to_light);
                    let to_eye = match self.view.projection {
                        Projection::Perspective => towards(self.view.camera.position),
                        Projection::Orthographic => {
                            self.rounded_vector(Vectors, self.sample.to_eye)
                        }
                    };
                    power(self.dot(Products, to_eye, reflected))
                }
                LightKind::Specular => 0.0,
            };
            let term = self.rounded_vector(Sum, self.rounded_vector(Sum, *strength) * factor);
            levels = self.rounded_vector(Sum, levels + term);
        }
        levels
    }

    /// The levels of a pixel. `vertices` are the positions and the normals of [`Sample::vertices`].
    fn levels(self, vertices: [[DVec3; 2]; 3]) -> DVec3 {
        use Stage::{Normals, Positions, Sum};
        let weights = self.sample.weights;
        if self.scene.cuboid[self.sample.object].shading == ShadingMode::Gouraud {
            let lit = vertices.map(|[point, normal]| {
                self.lit([
                    self.rounded_vector(Positions, point),
                    self.rounded_vector(Normals, normal),
                ])
            });
            return self.blend(Sum, lit, weights);
        }
        let point = self.blend(Positions, vertices.map(|[point, _]| point), weights);
        let normal = self.blend(Normals, vertices.map(|[_, normal]| normal), weights);
        self.lit([point, self.unit(Normals, normal)])
    }
}

/// The bits that each stage of the picture requires, computed on rayon's current threads. Each cuboid keeps its own shading.
///
/// # Errors
/// If the work is cancelled.
pub async fn bits(
    scene: &Scene,
    view: &View,
    monitor: Monitor<'_>,
) -> anyhow::Result<Vec<StageBits>> {
    let view = &view.unshaded();
    let mut record = SceneRecord::of(&scene.world);
    record.light.retain(|light| light.on);
    // Phong interpolates between the corners of the face. It does not depend on the segments.
    let phong = |it: &&mut CuboidRecord| it.shading == ShadingMode::Phong;
    for cuboid in record.cuboid.iter_mut().filter(phong) {
        cuboid.segments = Segments::default();
    }
    let sampled = Scene::spawn(scene.name.clone(), &record);
    let axes_of = |cuboid: &CuboidRecord| {
        let (position, rotation) = (cuboid.position, cuboid.rotation);
        Transform { position, rotation }.turned(view.turned).axes()
    };
    let axes: Vec<DMat3> = record.cuboid.iter().map(axes_of).collect();
    let vertex = |sample: &Sample, share: DVec3| {
        let (cuboid, axes) = (&record.cuboid[sample.object], axes[sample.object]);
        let normal = match cuboid.normals {
            NormalMode::Corner => share.normalize(),
            NormalMode::Face => 2.0 * share * DVec3::AXES[sample.triangle / 4],
        };
        [
            cuboid.position + axes * (share * cuboid.size),
            axes * normal,
        ]
    };
    let enclosures = rows(Reference::<Interval>::new(&scene.world, view));
    let columns: Vec<usize> = (0..view.size[0]).collect();
    let formats = Format::tried();
    let trials_of = |(stage, _)| formats.iter().map(move |format| (stage, *format));
    let trials: Vec<(Stage, Format)> = STAGES.into_iter().flat_map(trials_of).collect();
    // The largest error of a row in each trial.
    let row = |y: usize| {
        let mut errors = vec![0.0_f64; trials.len()];
        let samples = in_row(&sampled.world, view, y, &columns);
        for (full, sample) in enclosures(y).iter().zip(&samples) {
            let Some(sample) = sample else { continue };
            let vertices = sample.vertices.map(|share| vertex(sample, share));
            let face = Some(sample.object * FACES.len() + sample.triangle / 2);
            for (largest, &(stage, format)) in errors.iter_mut().zip(&trials) {
                let trial = Trial {
                    stage,
                    format,
                    scene: &record,
                    view,
                    sample,
                };
                let levels = ends(trial.levels(vertices).to_array());
                let [_, error] = error(full, &[(face, levels)], false);
                *largest = largest.max(error);
            }
        }
        Ok(errors)
    };
    let height = view.size[1];
    let by_row = monitor.in_parallel("rounding", 0..height, [0, height], row);
    let by_row = by_row.await?;
    let of_trial = |trial: usize| by_row.iter().map(|row| row[trial]).fold(0.0, f64::max);
    let errors: Vec<f64> = (0..trials.len()).map(of_trial).collect();
    let limit = limit(view.tolerance);
    let result_of = |((_, stage), errors): ((Stage, &'static str), &[f64])| {
        let (named, by_bits) = errors.split_at(FORMATS.len());
        let breaking = by_bits.iter().rposition(|error| *error > limit);
        let fewest = breaking.map_or(0, |index| index + 1);
        StageBits {
            stage,
            bits: (fewest < by_bits.len()).then_some(fewest + 2),
            largest_error: by_bits[fewest.min(by_bits.len() - 1)],
            formats: from_fn(|index| FormatError {
                format: FORMATS[index].0,
                largest_error: named[index],
                keeps: named[index] <= limit,
            }),
        }
    };
    let stages = STAGES.into_iter().zip(errors.chunks(formats.len()));
    Ok(stages.map(result_of).collect())
}
