//! The evaluation of pixels: vectors, the term of each light, the levels of Gouraud, Phong and the reference, the cause of
//! their difference, and the cost.
//!
//! The levels under Gouraud and Phong come from the renderer at the view's tolerance. Vectors and terms come from the
//! reference in f64.

mod cause;
mod text;

use fearless_simd::Level;
use glam::DVec3;

use crate::components::{FileOrder, Light, Material, Name, ShadingMode, TriangleId, View};
use crate::frame::{Frame, Keep, SQUARE_EDGE, Workers};
use crate::memory::OutOfMemory;
use crate::reference::{self, LightSample, Sample};
use crate::scene::Scene;
use crate::shading::SquareKind;
use crate::shading::square::MAX_SIDE;
use crate::systems;

/// The largest number of terms in a section.
const MOST_TERMS: usize = 20_000;

/// The evaluation of a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// x right, y down, from the top left corner.
    pub pixel: [usize; 2],
    /// `None` for the background.
    pub surface: Option<ProbedSurface>,
}

/// The evaluation of the surface at a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbedSurface {
    /// The name of the visible cuboid.
    pub object: String,
    /// The index of the visible triangle in [`crate::components::TRIANGLES`].
    pub triangle: usize,
    /// The material's exponent.
    pub shininess: f64,
    /// The evaluation in f64. Near a diagonal it may be of the other triangle of the face; `None` if the reference sees
    /// another face, at an edge.
    pub sample: Option<Sample>,
    /// The renderer's levels under Gouraud, unclamped.
    pub gouraud: DVec3,
    /// The renderer's levels under Phong, unclamped.
    pub phong: DVec3,
    /// The levels of the picture, unclamped.
    pub drawn: [f64; 3],
    /// How the picture was drawn: its mode, its tolerance in levels, and the kind of the square around the pixel.
    pub mode: ShadingMode,
    pub tolerance: f64,
    pub kind: SquareKind,
}

impl ProbedSurface {
    /// Every light that is on, in file order; none if the reference sees another face.
    pub fn lights(&self) -> &[LightSample] {
        self.sample.as_ref().map_or(&[], |sample| &sample.lights)
    }
}

/// Evaluates a pixel, which must lie inside the picture for `view`.
///
/// # Errors
/// If 32 rows of the picture do not fit in memory.
pub fn at(
    scene: &mut Scene,
    view: &View,
    pixel: [usize; 2],
    level: Level,
) -> Result<Probe, OutOfMemory> {
    let mut probes = section(scene, view, pixel, level)?;
    probes.retain(|probe| probe.pixel == pixel);
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
    let gouraud = draw(&view.shaded(ShadingMode::Gouraud))?;
    let phong = draw(&view.shaded(ShadingMode::Phong))?;
    let row = (y - top) * width;
    let triangles = &own.triangles()[row..row + width];
    let is_seen = |column: &usize| {
        triangles[x] != TriangleId::NONE && triangles[*column].face_id() == triangles[x].face_id()
    };
    let first = (0..x).rev().take_while(is_seen).last().unwrap_or(x);
    let last = (x..width).take_while(is_seen).last().unwrap_or(x);
    let step = ((last + 1 - first) * lights / MOST_TERMS).max(1);
    let is_kept =
        |column: &usize| (column - first).is_multiple_of(step) || [x, last].contains(column);
    let columns: Vec<usize> = (first..=last).filter(is_kept).collect();
    let samples = reference::in_row(&scene.world, view, y, &columns);
    let mut query = (scene.world).query::<(&FileOrder, &Name, &Material, &ShadingMode)>();
    let cuboids: Vec<_> = query.iter().collect();
    let probes = columns.into_iter().zip(samples).map(|(x, sample)| {
        let id = own.triangles()[row + x];
        let cuboid = cuboids.iter().find(|(order, ..)| order.0 == id.cuboid());
        let surface = cuboid.map(|(_, name, material, mode)| {
            let levels = |frame: &Frame| frame.levels()[row + x].map(f64::from);
            let own_face = |it: &Sample| {
                let seen = TriangleId::new(it.object as u32, it.triangle);
                seen.face_id() == id.face_id()
            };
            let sample = sample.filter(own_face);
            // Levels beyond f32 come from the reference. They give the same byte.
            let finite = |frame: &Frame, exact: fn(&Sample) -> DVec3| {
                let drawn = DVec3::from(levels(frame));
                let exact = sample.as_ref().map_or(drawn, exact);
                DVec3::select(drawn.is_finite_mask(), drawn, exact)
            };
            ProbedSurface {
                object: name.0.clone(),
                triangle: id.triangle(),
                shininess: material.shininess,
                gouraud: finite(&gouraud, |it| it.gouraud),
                phong: finite(&phong, |it| it.phong),
                drawn: levels(&own),
                mode: view.mode(**mode),
                tolerance: view.tolerance,
                kind: SquareKind::ALL[usize::from(own.kinds()[row + x] & !SQUARE_EDGE)],
                sample,
            }
        });
        let pixel = [x, y];
        Probe { pixel, surface }
    });
    Ok(probes.collect())
}
