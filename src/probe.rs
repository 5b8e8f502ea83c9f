//! The evaluation of pixels: vectors, the term of each light, the levels of Gouraud, Phong and the reference, the cause of
//! their difference, and the cost.
//!
//! `levels` are those of the renderer at the view's tolerance. Vectors and terms come from the reference in f64. A
//! quantity that does not exist, or that is not finite, is null in JSON.

mod cause;
mod text;

use fearless_simd::Level;
use glam::DVec3;
use serde::{Serialize, Serializer};

use crate::components::{FileOrder, Light, Material, Name, ShadingMode, View};
use crate::frame::{Frame, Keep, NO_TRIANGLE, OUTLINE, Workers, display_step, face};
use crate::memory::OutOfMemory;
use crate::reference::{self, LightSample, Sample};
use crate::scene::Scene;
use crate::shading::TileKind;
use crate::shading::square::{MAX_SIDE, MIN_SIDE};
use crate::systems;

/// The largest number of terms in a section.
const MOST_TERMS: usize = 20_000;

/// The evaluation of a pixel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Probe {
    /// x right, y down, from the top left corner.
    pub pixel: [usize; 2],
    /// The name of the visible cuboid; `None` for the background.
    pub object: Option<String>,
    /// The evaluation of its surface; `None` for the background.
    #[serde(flatten)]
    pub surface: Option<ProbedSurface>,
}

/// The evaluation of the surface at a pixel. Vectors are unit vectors in world space.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProbedSurface {
    /// The index of the visible triangle in [`crate::components::TRIANGLES`].
    pub triangle: u32,
    /// The visible point in world units; `None` if the reference sees another face, at an edge. The same holds for n
    /// and o.
    pub position: Option<DVec3>,
    /// n, interpolated by Phong and normalised.
    pub normal: Option<DVec3>,
    /// o, towards the eye.
    pub to_eye: Option<DVec3>,
    /// The material's exponent.
    #[serde(skip)]
    pub shininess: f64,
    /// Every light that is on, in file order.
    pub lights: Vec<LightSample>,
    /// The pixel under Gouraud.
    pub gouraud: Shaded,
    /// The pixel under Phong.
    pub phong: Shaded,
    /// The pixel in the reference.
    pub reference: ProbedReference,
    /// The pixel in the picture.
    #[serde(skip)]
    pub drawn: DrawnPixel,
    /// The length of n under interpolated unit vectors, 0..=1; 1 if the reference sees another face.
    #[serde(skip)]
    pub normal_length: f64,
}

/// A pixel of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnPixel {
    pub mode: ShadingMode,
    /// In levels.
    pub tolerance: f64,
    /// Unclamped.
    pub levels: [f64; 3],
    /// The kind of its square.
    pub kind: TileKind,
    /// The number of pixels of the face in its square.
    pub pixels: usize,
}

/// The pixel under one shading mode.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shaded {
    /// The renderer's levels, unclamped.
    pub levels: [f64; 3],
    /// The term of each light by name, in file order, evaluated in f64, in unclamped levels.
    #[serde(serialize_with = "as_map")]
    pub terms: Vec<(String, [f64; 3])>,
    /// The levels after the display step.
    pub bytes: [u8; 3],
}

/// The pixel in the f64 reference.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProbedReference {
    /// The visible triangle, which near a diagonal may be the other one of the face; `None` if another face is visible.
    pub triangle: Option<u32>,
    /// Gouraud in f64; `None` if another face is visible.
    pub gouraud: Option<ReferenceLevels>,
    /// Phong in f64; `None` if another face is visible.
    pub phong: Option<ReferenceLevels>,
}

/// Unclamped levels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ReferenceLevels {
    /// Red, green and blue.
    pub levels: [f64; 3],
}

fn as_map<S: Serializer>(terms: &[(String, [f64; 3])], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(terms.iter().map(|(name, levels)| (name, levels)))
}

/// Evaluates pixel (`x`, `y`), which must lie inside the picture for `view`.
///
/// # Errors
/// If 32 rows of the picture do not fit in memory.
pub fn at(
    scene: &mut Scene,
    view: &View,
    [x, y]: [usize; 2],
    level: Level,
) -> Result<Probe, OutOfMemory> {
    let mut probes = look(scene, view, y, level, |_| vec![x])?;
    Ok(probes.remove(0))
}

/// Evaluates the pixels of row `y` on the face that is visible at (`x`, `y`), from left to right. Of a scene with very many
/// lights it evaluates fewer; of the background one pixel.
///
/// # Errors
/// As [`at`].
pub fn section(
    scene: &mut Scene,
    view: &View,
    [x, y]: [usize; 2],
    level: Level,
) -> Result<Vec<Probe>, OutOfMemory> {
    let lights = scene.world.query_mut::<&Light>().into_iter().count();
    look(scene, view, y, level, |triangles| {
        let is_seen = |column: &usize| face(triangles[*column]) == face(triangles[x]);
        if triangles[x] == NO_TRIANGLE {
            return vec![x];
        }
        let first = (0..x).rev().take_while(is_seen).last().unwrap_or(x);
        let last = (x..triangles.len()).take_while(is_seen).last();
        let columns = first..=last.unwrap_or(x);
        let step = (columns.clone().count() * lights / MOST_TERMS).max(1);
        let is_kept = |column: &usize| {
            (column - first).is_multiple_of(step) || *column == x || column == columns.end()
        };
        columns.clone().filter(is_kept).collect()
    })
}

/// Evaluates some columns of row `y`. `choose` picks them by the triangles that the row shows.
fn look(
    scene: &mut Scene,
    view: &View,
    y: usize,
    level: Level,
    choose: impl FnOnce(&[u32]) -> Vec<usize>,
) -> Result<Vec<Probe>, OutOfMemory> {
    let [width, height] = view.size;
    // Squares lie in strips of this height.
    let top = y / MAX_SIDE * MAX_SIDE;
    let rows = top..(top + MAX_SIDE).min(height);
    let mut draw = |view: &View| {
        let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
        systems::draw_rows(&mut scene.world, view, rows.clone(), &mut frame)?;
        Ok(frame)
    };
    let own = draw(view)?;
    let modes = [
        draw(&view.shaded(ShadingMode::Gouraud))?,
        draw(&view.shaded(ShadingMode::Phong))?,
    ];
    let row = (y - top) * width;
    let columns = choose(&own.triangles()[row..row + width]);
    let samples = reference::in_row(&scene.world, view, y, &columns);
    let mut query = (scene.world).query::<(&FileOrder, &Name, &Material, &ShadingMode)>();
    let cuboids: Vec<_> = query.iter().collect();
    let probes = columns.into_iter().zip(samples).map(|(x, sample)| {
        let id = own.triangles()[row + x];
        let cuboid = cuboids.iter().find(|(order, ..)| order.0 == id / 12);
        let surface = cuboid.map(|(_, _, material, mode)| {
            let levels = |frame: &Frame| frame.levels()[row + x].map(f64::from);
            let sample =
                sample.filter(|it| face((12 * it.object + it.triangle) as u32) == face(id));
            let (kind, pixels) = square(&own, [x, y]);
            let drawn = DrawnPixel {
                mode: view.mode(**mode),
                tolerance: view.tolerance,
                levels: levels(&own),
                kind,
                pixels,
            };
            let modes = modes.each_ref().map(levels);
            ProbedSurface::new(id % 12, material.shininess, sample.as_ref(), modes, drawn)
        });
        Probe {
            pixel: [x, y],
            object: cuboid.map(|(_, name, ..)| name.0.clone()),
            surface,
        }
    });
    Ok(probes.collect())
}

/// The kind of the square of a pixel, and the number of pixels of the face in it. The frame holds one strip.
fn square(frame: &Frame, [x, y]: [usize; 2]) -> (TileKind, usize) {
    let (width, rows) = (frame.size()[0], frame.rows());
    let index = |x: usize, y: usize| (y - rows.start) * width + x;
    let seen = face(frame.triangles()[index(x, y)]);
    // The pixels of the face in the square of this side around the pixel.
    let pixels = |side: usize| {
        let [left, top] = [x, y].map(|it| it / side * side);
        let rows = top..rows.end.min(top + side);
        let all = rows.flat_map(move |y| (left..width.min(left + side)).map(move |x| [x, y]));
        all.filter(|[x, y]| face(frame.triangles()[index(*x, *y)]) == seen)
    };
    let kind = |x: usize, y: usize| frame.kinds()[index(x, y)];
    let own = kind(x, y) & !OUTLINE;
    // A large square that was cut has outlines across its middle, or quarters of several kinds.
    let is_cut = pixels(MAX_SIDE).any(|[x, y]| {
        let [column, row] = [x, y].map(|it| it % MAX_SIDE);
        let is_middle = column == MIN_SIDE && row > 0 || row == MIN_SIDE && column > 0;
        kind(x, y) & !OUTLINE != own || is_middle && kind(x, y) & OUTLINE != 0
    });
    let kind = TileKind::ALL[usize::from(own)];
    let side = if is_cut { MIN_SIDE } else { MAX_SIDE };
    (kind, pixels(side).count())
}

impl ProbedSurface {
    /// The evaluation of a pixel with these levels of the renderer under Gouraud and Phong.
    fn new(
        triangle: u32,
        shininess: f64,
        sample: Option<&Sample>,
        [gouraud, phong]: [[f64; 3]; 2],
        drawn: DrawnPixel,
    ) -> ProbedSurface {
        let lights = sample.map_or(&[][..], |sample| &sample.lights);
        let shaded =
            |drawn: [f64; 3], exact: fn(&Sample) -> DVec3, term: fn(&LightSample) -> DVec3| {
                // Levels beyond f32 come from the reference. They give the same byte.
                let levels = [0, 1, 2].map(|channel: usize| match sample {
                    Some(sample) if !drawn[channel].is_finite() => exact(sample)[channel],
                    _ => drawn[channel],
                });
                let terms = lights.iter();
                let terms = terms.map(|light| (light.name.clone(), term(light).to_array()));
                Shaded {
                    levels,
                    terms: terms.collect(),
                    bytes: levels.map(display_step),
                }
            };
        let levels = |exact: fn(&Sample) -> DVec3| {
            sample.map(|sample| ReferenceLevels {
                levels: exact(sample).to_array(),
            })
        };
        ProbedSurface {
            triangle,
            position: sample.map(|sample| sample.position),
            normal: sample.map(|sample| sample.normal),
            to_eye: sample.map(|sample| sample.to_eye),
            shininess,
            lights: lights.to_vec(),
            gouraud: shaded(gouraud, |it| it.gouraud, |it| it.gouraud),
            phong: shaded(phong, |it| it.phong, |it| it.phong),
            reference: ProbedReference {
                triangle: sample.map(|sample| sample.triangle as u32),
                gouraud: levels(|sample| sample.gouraud),
                phong: levels(|sample| sample.phong),
            },
            drawn,
            normal_length: sample.map_or(1.0, |sample| sample.normal_length),
        }
    }
}
