//! The evaluation of pixels: vectors, the term of each light, the levels of Gouraud, Phong and the reference, the cause of
//! their difference, and the cost.
//!
//! `levels` are those of the renderer at the view's tolerance. Vectors and terms come from the reference in f64. A
//! quantity that does not exist, or that is not finite, is null in JSON.

mod cause;

use fearless_simd::Level;
use glam::DVec3;
use serde::{Serialize, Serializer};

use crate::components::{FileOrder, Light, LightKind, Material, Name, ShadingMode, View};
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
    pub surface: Option<Surface>,
}

/// The evaluation of the surface at a pixel. Vectors are unit vectors in world space.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Surface {
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
    pub reference: Reference,
    /// As the picture that was asked for has it.
    #[serde(skip)]
    pub drawn: Drawn,
    /// The length of n as interpolated unit vectors have it, 0..=1; 1 where the reference sees another face.
    #[serde(skip)]
    pub normal_length: f64,
}

/// How a picture draws a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawn {
    pub mode: ShadingMode,
    /// In levels.
    pub tolerance: f64,
    /// Unclamped.
    pub levels: [f64; 3],
    /// How its square was drawn.
    pub kind: TileKind,
    /// The pixels of the face in its square.
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
pub struct Reference {
    /// The visible triangle, which near a diagonal may be the other one of the face; `None` if another face is visible.
    pub triangle: Option<u32>,
    /// Gouraud in f64; `None` if another face is visible.
    pub gouraud: Option<Levels>,
    /// Phong in f64; `None` if another face is visible.
    pub phong: Option<Levels>,
}

/// Unclamped levels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Levels {
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

/// Evaluates the pixels of row `y` on the face that is seen at (`x`, `y`), from left to right; fewer of them where the
/// scene has very many lights, and one pixel of the background.
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
            let drawn = Drawn {
                mode: view.mode(**mode),
                tolerance: view.tolerance,
                levels: levels(&own),
                kind,
                pixels,
            };
            let modes = modes.each_ref().map(levels);
            Surface::new(id % 12, material.shininess, sample.as_ref(), modes, drawn)
        });
        Probe {
            pixel: [x, y],
            object: cuboid.map(|(_, name, ..)| name.0.clone()),
            surface,
        }
    });
    Ok(probes.collect())
}

/// How the square of a pixel was drawn, and the pixels of the face in it. The frame holds one strip.
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

impl Surface {
    /// What is known where the renderer draws these levels under Gouraud and Phong.
    fn new(
        triangle: u32,
        shininess: f64,
        sample: Option<&Sample>,
        [gouraud, phong]: [[f64; 3]; 2],
        drawn: Drawn,
    ) -> Surface {
        let lights = sample.map_or(&[][..], |sample| &sample.lights);
        let shaded =
            |drawn: [f64; 3], exact: fn(&Sample) -> DVec3, term: fn(&LightSample) -> DVec3| {
                // The renderer keeps f32: what is too large for that is the model in f64 on its way to the same byte.
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
            sample.map(|sample| Levels {
                levels: exact(sample).to_array(),
            })
        };
        Surface {
            triangle,
            position: sample.map(|sample| sample.position),
            normal: sample.map(|sample| sample.normal),
            to_eye: sample.map(|sample| sample.to_eye),
            shininess,
            lights: lights.to_vec(),
            gouraud: shaded(gouraud, |it| it.gouraud, |it| it.gouraud),
            phong: shaded(phong, |it| it.phong, |it| it.phong),
            reference: Reference {
                triangle: sample.map(|sample| sample.triangle as u32),
                gouraud: levels(|sample| sample.gouraud),
                phong: levels(|sample| sample.phong),
            },
            drawn,
            normal_length: sample.map_or(1.0, |sample| sample.normal_length),
        }
    }
}

/// The column titles of [`Surface::products`].
const PRODUCT_HEADS: [[&str; 3]; 2] = [["n.l", "o.r", "factor"], ["r", "g", "b"]];

/// Levels up to this are written as 0.
const NEGLIGIBLE: f64 = 1e-6;
/// Components of a vector up to this share of the largest are written as 0: they are rounding errors.
const ROUNDING: f64 = 1e-12;

impl Surface {
    /// The rows of the table of levels: each light's term, the drawn sum, the sum of the reference, and the bytes. A
    /// row is its name and the cells of Gouraud and of Phong.
    fn table(&self) -> Vec<(String, [[String; 3]; 2])> {
        let levels = |levels: [f64; 3]| numbers(levels, NEGLIGIBLE);
        let truth = |truth: Option<Levels>| truth.map_or_else(nothing, |it| levels(it.levels));
        let modes = [&self.gouraud, &self.phong];
        let terms = self.lights.iter().enumerate();
        let terms = terms.map(|(index, light)| {
            let cells = modes.map(|mode| levels(mode.terms[index].1));
            (light.name.clone(), cells)
        });
        let references = [self.reference.gouraud, self.reference.phong];
        let sums = [
            ("drawn", modes.map(|mode| levels(mode.levels))),
            ("reference", references.map(truth)),
            (
                "bytes",
                modes.map(|mode| mode.bytes.map(|byte| byte.to_string())),
            ),
        ];
        terms
            .chain(sums.map(|(name, cells)| (name.to_owned(), cells)))
            .collect()
    }

    /// The rows of the table of products: each light's term under Phong in f64 as n.l, o.r and their factor, then the
    /// strength by channel.
    fn products(&self) -> Vec<(String, [[String; 3]; 2])> {
        let cosine = |one: Option<DVec3>, other: Option<DVec3>| {
            let cosine = one.zip(other).map(|(one, other)| one.dot(other));
            cosine.map_or_else(|| "-".to_owned(), |it| format!("{it:.5}"))
        };
        let lights = self.lights.iter().map(|light| {
            let is_specular = light.kind == LightKind::Specular;
            let factors = [
                cosine(self.normal, light.to_light),
                cosine(self.to_eye, light.reflected.filter(|_| is_specular)),
                format!("{:.5}", light.factor),
            ];
            let strength = numbers(light.strength.to_array(), NEGLIGIBLE);
            (light.name.clone(), [factors, strength])
        });
        lights.collect()
    }

    /// The titles of both halves of [`Surface::products`].
    fn product_titles(&self) -> [String; 2] {
        let factor = format!("n.l or (o.r)^{}", self.shininess);
        [factor, "times strength".to_owned()]
    }

    /// The number of the triangle, and that of the reference if it differs.
    pub fn triangle_label(&self) -> String {
        let own = self.triangle;
        match self.reference.triangle {
            Some(other) if other != own => format!("triangle {own} (reference: {other})"),
            _ => format!("triangle {own}"),
        }
    }
}

impl Probe {
    /// The evaluation as lines of text, at most 78 characters long if names are short.
    pub fn lines(&self) -> Vec<String> {
        let [x, y] = self.pixel;
        let (Some(object), Some(surface)) = (&self.object, &self.surface) else {
            return vec![format!("pixel {x},{y}: background")];
        };
        let mut lines = vec![
            format!("pixel {x},{y}: {object}, {}", surface.triangle_label()),
            format!("  position  {}", vector(surface.position)),
            format!("  normal  n {}", vector(surface.normal)),
            format!("  to eye  o {}", vector(surface.to_eye)),
        ];
        for light in surface
            .lights
            .iter()
            .filter(|light| light.kind != LightKind::Ambient)
        {
            lines.push(format!("  {} ({})", light.name, light.kind.name()));
            lines.push(format!("    to light  l {}", vector(light.to_light)));
            lines.push(format!("    reflected r {}", vector(light.reflected)));
        }
        let joined = |cells: [String; 3]| cells.map(|cell| format!("{cell:>9}")).join(" ");
        let row = |(name, cells): (String, [[String; 3]; 2])| {
            let [left, right] = cells.map(joined);
            format!("  {name:<12} {left}  {right}")
        };
        let heads = PRODUCT_HEADS.map(|cells| cells.map(str::to_owned));
        let [factor, strength] = surface.product_titles();
        lines.push(format!(
            "  {:<12} {factor:>29}  {strength:>29}",
            "exact Phong"
        ));
        lines.push(row((String::new(), heads)));
        lines.extend(surface.products().into_iter().map(row));
        lines.push(format!(
            "  {:<12} {:>29}  {:>29}",
            "levels", "Gouraud", "Phong"
        ));
        lines.extend(surface.table().into_iter().map(row));
        lines
    }
}

fn vector(vector: Option<DVec3>) -> String {
    match vector {
        None => "-".to_owned(),
        some => parts(some).map(|part| format!("{part:>9}")).join(" "),
    }
}

/// The cells of a vector.
fn parts(vector: Option<DVec3>) -> [String; 3] {
    let numbers = |it: DVec3| numbers(it.to_array(), ROUNDING * it.abs().max_element());
    vector.map_or_else(nothing, numbers)
}

/// The cells of a quantity that does not exist.
fn nothing() -> [String; 3] {
    ["-"; 3].map(str::to_owned)
}

/// Three decimals for 0.001 to 10000, else scientific notation, nine characters at most; 0 for magnitudes up to
/// `negligible`.
fn numbers(values: [f64; 3], negligible: f64) -> [String; 3] {
    values.map(|value| match value.abs() {
        size if size <= negligible => "0".to_owned(),
        1e-3..1e4 => format!("{value:.3}"),
        _ => format!("{value:.1e}"),
    })
}
