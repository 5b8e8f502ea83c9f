//! The truth: the picture evaluated in f64, one line of sight per pixel.
//!
//! A ray through every pixel centre is met with the cuboids' faces (`intersection`) and the model is evaluated where it
//! arrives (`illumination`). Nothing is rasterised, snapped or approximated.
//!
//! ```text
//!        eye . . . . . . +---------.          near plane: what is met before it is not there
//!           ` . pixel .  |          \
//!               ` . . .  * hit       \        place on the face -> normal, weights of three corners -> colour
//!                        +------------+
//! ```
//!
//! Rule: this shares the renderer's data (`components`) and not one of its formulas. Positions are differences first
//! (cuboid - eye, light - cuboid), so a scene a billion units from the origin loses nothing, and each cuboid is met and
//! lit in its own coordinates, so its proportions do not matter. Any number of threads gives the same bits.

mod illumination;
mod real;
mod sight;
mod vector;

use std::cmp::Ordering;
use std::ops::Range;
use std::sync::atomic::{self, AtomicUsize};

use glam::DVec3;
use hecs::World;
pub use maryada::Interval;
use rayon::prelude::*;

use crate::components::{
    FACES, Light, LightKind, Material, Mesh, Name, ShadingMode, TRIANGLES, Transform, View,
};
use crate::frame::NO_TRIANGLE;
use illumination::{Incidence, Lit, Surface, blend, reflection};
pub use real::Real;
use sight::{Line, Meeting, Sight, Solid};
use vector::Vector;

/// Hits of two cuboids whose depths differ by less than this share of the depth are at one depth: the cuboid earlier in
/// the file is seen. It is far above what f64 makes of two faces in one plane and far below what can be seen.
pub const DEPTH_TIE: f64 = 1e-11;

/// Rows of a picture as they ought to be.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Pixels in a row.
    pub width: usize,
    /// The rows of the picture that are here.
    pub rows: Range<usize>,
    /// Unclamped levels, row by row from the top; the background's where nothing is hit.
    pub levels: Vec<[f64; 3]>,
    /// Cuboid * 12 + triangle seen at each pixel, or [`NO_TRIANGLE`].
    pub triangles: Vec<u32>,
}

/// What is seen at one pixel, and why it looks as it does. Vectors are of unit length, in world space.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// The cuboid's place in the file, from 0.
    pub object: usize,
    /// The triangle's place in [`TRIANGLES`].
    pub triangle: usize,
    /// The point seen, in world units.
    pub position: DVec3,
    /// n as Phong has it: interpolated and normalised.
    pub normal: DVec3,
    /// o: to the eye, or against the view direction if the projection is orthographic.
    pub to_eye: DVec3,
    /// Every light that is on, in file order.
    pub lights: Vec<LightSample>,
    /// Gouraud's levels, unclamped.
    pub gouraud: DVec3,
    /// Phong's levels, unclamped.
    pub phong: DVec3,
}

/// What one light does at a [`Sample`].
#[derive(Clone, Debug, PartialEq)]
pub struct LightSample {
    /// The light's name.
    pub name: String,
    /// The term it feeds.
    pub kind: LightKind,
    /// l; `None` for an ambient light and for one that stands at the very point.
    pub to_light: Option<DVec3>,
    /// r = 2 (n.l) n - l; exists where l does.
    pub reflected: Option<DVec3>,
    /// Its term in levels under Gouraud, unclamped.
    pub gouraud: DVec3,
    /// Its term in levels under Phong, unclamped.
    pub phong: DVec3,
}

/// A picture to be evaluated, in f64 or in intervals.
pub struct Reference<R> {
    sight: Sight<R>,
    cuboids: Vec<Cuboid<R>>,
    background: Vector<R>,
    /// The names of the lights that are on, in file order.
    names: Vec<String>,
    width: usize,
}

/// One cuboid: where its picture is, and what it looks like there.
struct Cuboid<R> {
    solid: Solid<R>,
    surface: Surface<R>,
    mesh: Mesh,
    mode: ShadingMode,
}

/// What a pixel may show.
#[derive(Clone, Copy, Debug)]
pub struct Seen<R> {
    /// Cuboid * 6 + face; `None` is the background.
    pub face: Option<usize>,
    /// Unclamped.
    pub levels: [R; 3],
}

impl<R: Real> Reference<R> {
    /// The picture of `world` that `view` asks for; the view's tolerance has no say in it.
    pub fn new(world: &World, view: &View) -> Self {
        let sight = Sight::new(view);
        let enclosed = Sight::<Interval>::new(view);
        let (names, lights): (Vec<_>, Vec<_>) = world
            .query::<(&Name, &Transform, &Light)>()
            .iter()
            .filter(|(_, _, light)| light.on)
            .map(|(name, transform, light)| (name.0.clone(), (transform.position, *light)))
            .unzip();
        let cuboids = world
            .query::<(&Transform, &Mesh, &Material, &ShadingMode)>()
            .iter()
            .map(|(transform, mesh, material, mode)| {
                let solid = Solid::new(&sight, transform, mesh, enclosed.bounds(transform, mesh));
                let places = (sight.eye, transform.position);
                Cuboid {
                    surface: Surface::new(&solid, mesh, material, &lights, places),
                    solid,
                    mesh: *mesh,
                    mode: view.shading.unwrap_or(*mode),
                }
            })
            .collect();
        Reference {
            sight,
            cuboids,
            background: Vector::exact(view.background),
            names,
            width: view.size[0],
        }
    }

    /// Evaluates the pixels of row `y` from left to right. `each` hears what every one of them may show: one thing, unless
    /// an edge, a gate that may fall either way, or another cuboid at the same depth is near.
    pub fn row(&self, y: usize, mut each: impl FnMut(usize, &[Seen<R>])) {
        let here = |(_, cuboid): &(usize, &Cuboid<R>)| cuboid.solid.rows.contains(&y);
        let cuboids: Vec<_> = self.cuboids.iter().enumerate().filter(here).collect();
        let (mut met, mut seen) = (Vec::new(), Vec::new());
        for x in 0..self.width {
            self.meet([x, y], &cuboids, &mut met);
            self.see(&met, &mut seen);
            each(x, &seen);
        }
    }

    /// What pixel (`x`, `y`) may show.
    pub fn at(&self, pixel: [usize; 2]) -> Vec<Seen<R>> {
        let cuboids: Vec<_> = self.cuboids.iter().enumerate().collect();
        let (mut met, mut seen) = (Vec::new(), Vec::new());
        self.meet(pixel, &cuboids, &mut met);
        self.see(&met, &mut seen);
        seen
    }

    /// Overwrites `seen` with what the cuboids that are met look like.
    fn see(&self, met: &[Met<R>], seen: &mut Vec<Seen<R>>) {
        seen.clear();
        for met in met {
            for face in met.meeting.faces() {
                for &is_first in met.cuboid.triangles(face, &met.line) {
                    let mut see = |tied| {
                        let lit = met.cuboid.lit(face, is_first, &met.line, tied);
                        seen.push(Seen {
                            face: Some(met.object * FACES.len() + face),
                            levels: lit.levels.0,
                        });
                        lit.is_tied
                    };
                    if see(false) {
                        see(true);
                    }
                }
            }
        }
        if !met.iter().any(|met| met.meeting.is_certain) {
            seen.push(Seen {
                face: None,
                levels: self.background.0,
            });
        }
    }

    /// Overwrites `met` with what may be seen at pixel (`x`, `y`) of some cuboids, in file order.
    fn meet<'a>(
        &self,
        [x, y]: [usize; 2],
        cuboids: &[(usize, &'a Cuboid<R>)],
        met: &mut Vec<Met<'a, R>>,
    ) {
        met.clear();
        for &(object, cuboid) in cuboids {
            if !cuboid.solid.columns.contains(&x) {
                continue;
            }
            let line = cuboid.solid.line(&self.sight, x, y);
            let Some(meeting) = cuboid.solid.meet(&line) else {
                continue;
            };
            let mut is_hidden = false;
            met.retain(|other| {
                let nearest = other.meeting.depth * R::from(1.0 - DEPTH_TIE);
                match (nearest - meeting.depth).sign(0.0) {
                    Some(Ordering::Greater) => !meeting.is_certain,
                    Some(_) => {
                        is_hidden |= other.meeting.is_certain;
                        true
                    }
                    None => true,
                }
            });
            if !is_hidden {
                met.push(Met {
                    object,
                    cuboid,
                    line,
                    meeting,
                });
            }
        }
    }
}

/// A cuboid that a line of sight meets.
struct Met<'a, R> {
    object: usize,
    cuboid: &'a Cuboid<R>,
    line: Line<R>,
    meeting: Meeting<R>,
}

impl<R: Real> Cuboid<R> {
    /// Which triangles of a face the line may see: both where the diagonal is near, and Phong's are one.
    fn triangles(&self, face: usize, line: &Line<R>) -> &'static [bool] {
        match self.solid.is_on_first(face, line) {
            None if self.mode != ShadingMode::Phong => &[true, false],
            Some(false) => &[false],
            _ => &[true],
        }
    }

    /// What the line sees on a triangle of a face, or on its plane beyond the diagonal, with tied gates open if `tied`.
    fn lit(&self, face: usize, is_first: bool, line: &Line<R>, tied: bool) -> Lit<R> {
        let place = self.solid.place(face, line);
        if self.mode == ShadingMode::Phong {
            return self.surface.phong(&place, line, tied);
        }
        let weights = Solid::weights(face, is_first, &place);
        let (corners, weights) = arrange(face, is_first, weights);
        if self.mode != ShadingMode::UnitVectors {
            return self.surface.gouraud(corners, weights, tied);
        }
        let weights = match self.solid.depths(corners, &self.mesh) {
            Some(depths) => on_screen(weights, depths),
            None => weights,
        };
        self.surface.unit_vectors(corners, weights)
    }
}

/// The corners of one of a face's two triangles, and the weights of a, c and the third corner in their order.
fn arrange<R: Copy>(face: usize, is_first: bool, [a, c, third]: [R; 3]) -> ([usize; 3], [R; 3]) {
    let corners = TRIANGLES[2 * face + usize::from(!is_first)].map(usize::from);
    (
        corners,
        if is_first {
            [a, third, c]
        } else {
            [a, c, third]
        },
    )
}

/// Weights in linear interpolation on the screen instead of on the triangle.
///
/// Areas shrink with both depths of their edge: bc / (zb zc) : ca / (zc za) : ab / (za zb).
fn on_screen<R: Real>(weights: [R; 3], depths: [R; 3]) -> [R; 3] {
    let [a, b, c] = Vector(weights).zip(Vector(depths), R::mul).0;
    [a, b, c].map(|weight| weight / (a + b + c))
}

/// Evaluates `rows` of the picture of `world` that `view` asks for; the view's tolerance has no say in it.
///
/// It works on rayon's current threads and takes 28 bytes a pixel of `rows`: ask for a very large picture in bands.
/// `cancelled` is asked before every row, and a yes makes the result `None`; `progress` hears, from any thread, how
/// many rows are done.
pub fn picture(
    world: &World,
    view: &View,
    rows: Range<usize>,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &(dyn Fn(usize) + Sync),
) -> Option<Truth> {
    Reference::new(world, view).picture(rows, cancelled, progress)
}

/// What is seen at pixel (`x`, `y`) of the picture that `view` asks for; `None` is background, or outside of it.
pub fn at_pixel(world: &World, view: &View, x: usize, y: usize) -> Option<Sample> {
    Reference::new(world, view).at_pixel(x, y)
}

impl Reference<f64> {
    /// Evaluates rows of the picture: see [`picture`].
    pub fn picture(
        &self,
        rows: Range<usize>,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &(dyn Fn(usize) + Sync),
    ) -> Option<Truth> {
        let width = self.width;
        let mut levels = vec![self.background.0; width * rows.len()];
        let mut triangles = vec![NO_TRIANGLE; width * rows.len()];
        let done = AtomicUsize::new(0);
        levels
            .par_chunks_mut(width)
            .zip(triangles.par_chunks_mut(width))
            .zip(rows.clone())
            .try_for_each(|((levels, triangles), y)| {
                if cancelled() {
                    return None;
                }
                let here = |(_, cuboid): &(usize, &Cuboid<f64>)| cuboid.solid.rows.contains(&y);
                let cuboids: Vec<_> = self.cuboids.iter().enumerate().filter(here).collect();
                let mut met = Vec::new();
                for x in 0..width {
                    self.meet([x, y], &cuboids, &mut met);
                    if let Some((met, face, triangle)) = first(&met) {
                        let is_first = triangle % 2 == 0;
                        levels[x] = met.cuboid.lit(face, is_first, &met.line, false).levels.0;
                        triangles[x] = (met.object * TRIANGLES.len() + triangle) as u32;
                    }
                }
                progress(done.fetch_add(1, atomic::Ordering::Relaxed) + 1);
                Some(())
            })?;
        Some(Truth {
            width,
            rows,
            levels,
            triangles,
        })
    }

    fn at_pixel(&self, x: usize, y: usize) -> Option<Sample> {
        let cuboids: Vec<_> = self.cuboids.iter().enumerate().collect();
        let mut met = Vec::new();
        self.meet([x, y], &cuboids, &mut met);
        let (
            Met {
                object,
                cuboid,
                line,
                ..
            },
            face,
            triangle,
        ) = first(&met)?;
        let Cuboid { solid, surface, .. } = cuboid;
        let place = solid.place(face, line);
        let is_first = triangle % 2 == 0;
        let weights = Solid::weights(face, is_first, &place);
        let (corners, weights) = arrange(face, is_first, weights);
        let [normal, to_eye] = [place.share.unit(), -line.along.unit()];
        let world = |v: Vector<f64>| {
            let [x, y, z] = v.0;
            (solid.axes[0] * x + solid.axes[1] * y + solid.axes[2] * z).to_dvec3()
        };
        let lights = surface.lamps.iter().zip(&self.names).map(|(lamp, name)| {
            let term = |incidence: Incidence<f64>| match lamp.kind {
                LightKind::Ambient => lamp.levels,
                LightKind::Diffuse => lamp.levels * incidence.diffuse,
                LightKind::Specular => lamp.levels * incidence.specular,
            };
            let to_light = lamp
                .source
                .map(|source| surface.to_light(source, &place, line));
            let to_light = to_light.filter(|to_light| to_light.to_dvec3() != DVec3::ZERO);
            let nothing = Incidence {
                diffuse: 0.0,
                specular: 0.0,
            };
            let at_point = to_light.map_or(nothing, |to_light| {
                surface.incidence(normal, to_eye, to_light, false)
            });
            let at_corners = corners.map(|corner| {
                let source = lamp.source;
                term(source.map_or(nothing, |source| surface.at_corner(corner, source)))
            });
            LightSample {
                name: name.clone(),
                kind: lamp.kind,
                to_light: to_light.map(world),
                reflected: to_light.map(|to_light| world(reflection(normal, to_light))),
                gouraud: blend(at_corners, weights).to_dvec3(),
                phong: term(at_point).to_dvec3(),
            }
        });
        Some(Sample {
            object: *object,
            triangle,
            position: self.sight.eye
                + world(line.offset + line.along * (place.height / place.slope)),
            normal: world(normal),
            to_eye: world(to_eye),
            lights: lights.collect(),
            gouraud: surface.gouraud(corners, weights, false).levels.to_dvec3(),
            phong: surface.phong(&place, line, false).levels.to_dvec3(),
        })
    }
}

/// The cuboid seen, its face and its triangle: in f64 there is one of each, or nothing.
fn first<'a, 'b>(met: &'b [Met<'a, f64>]) -> Option<(&'b Met<'a, f64>, usize, usize)> {
    let met = met.first()?;
    let face = met.meeting.faces().next()?;
    let is_first = met.cuboid.solid.is_on_first(face, &met.line)?;
    Some((met, face, 2 * face + usize::from(!is_first)))
}
