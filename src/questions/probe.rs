//! The evaluation of pixels: vectors, the term of each light, the levels of Gouraud, Phong and the reference, the cause of
//! their difference, and the cost.
//!
//! The levels under Gouraud and Phong come from the renderer at the view's tolerance. Vectors and terms come from the
//! reference in f64.

mod cause;
mod page;

use fearless_simd::Level;
use glam::DVec3;
use hecs::World;
use serde_json::{Map, Value, json};

use crate::components::{
    FileOrder, Light, Material, Mesh, Name, NormalMode, Projection, ShadingMode, Transform,
    TriangleId, View, WorldTransform, in_file_order,
};
use crate::output::memory::OutOfMemory;
use crate::reference::{self, LightSample, Reference, Sample};
use crate::scene::Scene;
use crate::shading::SquareKind;
use crate::shading::square::MAX_SIDE;
use crate::systems;
use crate::systems::frame::{Frame, Keep, SQUARE_EDGE, Workers, display_step};

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
    pub material: Material,
    /// P and N of the vertices between which the sample interpolates, in world units. N is linear along the face.
    pub vertices: [[DVec3; 2]; 3],
    /// O in world units; `None` in orthographic projection.
    pub eye: Option<DVec3>,
    /// Every light that is on, in file order.
    pub sources: Vec<Source>,
    /// The evaluation in f64. Near a diagonal it may be of the other triangle of the face; `None` if the reference sees
    /// another face, at an edge.
    pub sample: Option<Sample>,
    /// The renderer's levels under Gouraud, unclamped.
    pub gouraud: DVec3,
    /// The renderer's levels under Phong, unclamped.
    pub phong: DVec3,
    /// The levels of the picture, unclamped.
    pub drawn: [f64; 3],
    /// The way the picture was drawn: its mode, its tolerance in levels, and the kind of the square around the pixel.
    pub mode: ShadingMode,
    pub tolerance: f64,
    pub kind: SquareKind,
}

/// A light as the scene has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    pub name: String,
    pub light: Light,
    /// In world units.
    pub place: DVec3,
}

impl ProbedSurface {
    /// Every light that is on, in file order; none if the reference sees another face.
    pub fn lights(&self) -> &[LightSample] {
        self.sample.as_ref().map_or(&[], |sample| &sample.lights)
    }
}

/// The components from which vertices follow.
type Shape<'a> = (&'a WorldTransform, &'a Mesh, &'a NormalMode);

/// P and N of a sample's vertices in world units.
fn vertices(sample: &Sample, (place, mesh, normals): Shape) -> [[DVec3; 2]; 3] {
    let size = mesh.corners[7] - mesh.corners[0];
    sample.vertices.map(|share| {
        let normal = match normals {
            // At a corner each share is 1/2, and N has length 1.
            NormalMode::Corner => share * (2.0 / 3.0_f64.sqrt()),
            NormalMode::Face => 2.0 * share * DVec3::AXES[sample.triangle / 4],
        };
        let point = place.position + place.axes * (share * size);
        [point, place.axes * normal]
    })
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
    // In a picture of the reference the squares are those of Phong.
    let is_drawn = view.shading.is_none_or(ShadingMode::is_drawn);
    let by_reference = (!is_drawn).then(|| Reference::<f64>::new(&scene.world, view));
    let [as_gouraud, as_phong] =
        [ShadingMode::Gouraud, ShadingMode::Phong].map(|it| view.shaded(it));
    let model = if is_drawn { *view } else { as_phong };
    let mut draw = |view: &View| {
        let mut frame = Frame::new(Keep::Levels, Workers::alone(level));
        systems::draw_rows(&mut scene.world, view, rows.clone(), &mut frame)?;
        Ok(frame)
    };
    let (own, gouraud, phong) = (draw(&model)?, draw(&as_gouraud)?, draw(&as_phong)?);
    let row = (y - top) * width;
    let columns = columns(&own.triangles()[row..row + width], x, lights);
    let samples = reference::in_row(&scene.world, &model, y, &columns);
    let sources = sources(&scene.world);
    let eye = (view.projection == Projection::Perspective).then_some(view.camera.position);
    let mut query = (scene.world).query::<(&FileOrder, &Name, &Material, &ShadingMode, Shape)>();
    let cuboids: Vec<_> = query.iter().collect();
    let probes = columns.into_iter().zip(samples).map(|(x, sample)| {
        let id = own.triangles()[row + x];
        let cuboid = cuboids.iter().find(|(order, ..)| order.0 == id.cuboid());
        let surface = cuboid.map(|(_, name, material, mode, shape)| {
            let levels = |frame: &Frame| frame.levels()[row + x].map(f64::from);
            let own_face = |it: &Sample| {
                let seen = TriangleId::new(it.object as u32, it.triangle);
                seen.face_id() == id.face_id()
            };
            let sample = sample.filter(own_face);
            let of_sample = |of: fn(&Sample) -> DVec3| sample.as_ref().map(of);
            ProbedSurface {
                object: name.0.clone(),
                triangle: id.triangle(),
                material: **material,
                vertices: sample
                    .as_ref()
                    .map_or_else(Default::default, |it| vertices(it, *shape)),
                eye,
                sources: sources.clone(),
                gouraud: finite(levels(&gouraud), of_sample(|it| it.gouraud)),
                phong: finite(levels(&phong), of_sample(|it| it.phong)),
                drawn: by_reference
                    .as_ref()
                    .map_or_else(|| levels(&own), |it| it.at([x, y])[0].levels),
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

/// The drawn levels. Those beyond f32 come from the reference, and give the same byte.
fn finite(drawn: [f64; 3], exact: Option<DVec3>) -> DVec3 {
    let drawn = DVec3::from(drawn);
    DVec3::select(drawn.is_finite_mask(), drawn, exact.unwrap_or(drawn))
}

/// The columns of a row on the face that is visible at column `x`, fewer with very many lights.
fn columns(row: &[TriangleId], x: usize, lights: usize) -> Vec<usize> {
    let is_seen =
        |column: &usize| row[x] != TriangleId::NONE && row[*column].face_id() == row[x].face_id();
    let first = (0..x).rev().take_while(is_seen).last().unwrap_or(x);
    let last = (x..row.len()).take_while(is_seen).last().unwrap_or(x);
    let step = ((last + 1 - first) * lights / MOST_TERMS).max(1);
    let is_kept =
        |column: &usize| (column - first).is_multiple_of(step) || [x, last].contains(column);
    (first..=last).filter(is_kept).collect()
}

/// The lights that are on, in the order of their file.
fn sources(world: &World) -> Vec<Source> {
    let source = |(name, light, transform): (&Name, &Light, Option<&Transform>)| Source {
        name: name.0.clone(),
        light: *light,
        place: transform.map_or(DVec3::ZERO, |it| it.position),
    };
    let mut sources = in_file_order::<(&Name, &Light, Option<&Transform>), _>(world, source);
    sources.retain(|source| source.light.on);
    sources
}

/// The levels under one mode.
type Levels<T> = fn(&T) -> DVec3;

impl Probe {
    /// The evaluation as JSON. A quantity that does not exist or is not finite is null.
    pub fn json(&self) -> Value {
        let Some(surface) = &self.surface else {
            return json!({"pixel": self.pixel, "object": null});
        };
        let sample = surface.sample.as_ref();
        let shaded = |levels: DVec3, term: Levels<LightSample>| {
            let named_term = |light: &LightSample| (light.name.clone(), json!(term(light)));
            let terms = surface.lights().iter().map(named_term);
            json!({
                "levels": levels,
                "terms": terms.collect::<Map<_, _>>(),
                "bytes": bytes(levels),
            })
        };
        json!({
            "pixel": self.pixel,
            "object": surface.object,
            "triangle": surface.triangle,
            "position": sample.map(|it| it.position),
            "normal": sample.map(|it| it.normal),
            "to_eye": sample.map(|it| it.to_eye),
            "lights": surface.lights(),
            "gouraud": shaded(surface.gouraud, |light| light.gouraud),
            "phong": shaded(surface.phong, |light| light.phong),
            "reference": {
                "triangle": sample.map(|it| it.triangle),
                "gouraud": sample.map(|it| json!({"levels": it.gouraud})),
                "phong": sample.map(|it| json!({"levels": it.phong})),
                "blinn_phong": sample.map(|it| json!({"levels": it.blinn_phong})),
            },
        })
    }
}

/// The levels after the display step.
fn bytes(levels: DVec3) -> [u8; 3] {
    levels.to_array().map(display_step)
}
