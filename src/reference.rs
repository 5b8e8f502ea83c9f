//! The truth: the picture evaluated in f64, one line of sight per pixel.
//!
//! A ray through every pixel centre is met with the cuboids' faces (`sight`) and the model is evaluated where it
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
mod interval;
mod real;
mod rule;
mod sample;
mod sight;
mod vector;

use std::cmp::Ordering;
use std::ops::Range;
use std::sync::atomic::{self, AtomicUsize};

use hecs::World;
use rayon::prelude::*;

use crate::components::{
    FileOrder, Light, Material, Mesh, ShadingMode, TRIANGLES, Transform, View, in_file_order,
};
use crate::frame::NO_TRIANGLE;
use illumination::{Lit, Open, Surface, TIES, blend};
pub use interval::Interval;
pub use real::Real;
pub use rule::Rule;
pub use sample::{LightSample, Sample, at_pixel, in_row};
use sight::{Line, Meeting, Place, Sight, Solid};
use vector::Vector;

/// Hits of two cuboids whose depths differ by less than this share of the depth are at one depth: the cuboid earlier in
/// the file is seen. It is far above what f64 makes of two faces in one plane and far below what can be seen.
pub const DEPTH_TIE: f64 = 1e-11;

/// Rows of the exact picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Pixels in a row.
    pub width: usize,
    /// Unclamped levels, row by row from the top; the background's where nothing is hit.
    pub levels: Vec<[f64; 3]>,
    /// Cuboid * 12 + triangle seen at each pixel, or [`NO_TRIANGLE`].
    pub triangles: Vec<u32>,
}

/// A picture to be evaluated, in f64, in f32 or in intervals.
pub struct Reference<R> {
    /// The rule that is left out, if any.
    without: Option<Rule>,
    sight: Sight<R>,
    cuboids: Vec<Cuboid<R>>,
    background: Vector<R>,
    width: usize,
}

/// One cuboid: where its picture is, and what it looks like there.
struct Cuboid<R> {
    /// Its place in the file, which it keeps when others are gone.
    number: usize,
    solid: Solid<R>,
    surface: Surface<R>,
    mesh: Mesh,
    mode: ShadingMode,
    is_perspective_correct: bool,
}

/// What a pixel may show.
#[derive(Clone, Copy, Debug)]
pub struct Seen<R> {
    /// Cuboid * 12 + triangle; `None` is the background. Phong's triangles of a face are one: it is the first where both
    /// may be seen.
    pub triangle: Option<usize>,
    /// Unclamped.
    pub levels: [R; 3],
}

impl<R> Seen<R> {
    /// Cuboid * 6 + face; `None` is the background.
    pub fn face(&self) -> Option<usize> {
        self.triangle.map(|triangle| triangle / 2)
    }
}

impl<R: Real> Reference<R> {
    /// The picture of `world` that `view` asks for; the view's tolerance is not used.
    pub fn new(world: &World, view: &View) -> Self {
        Reference::without(world, view, None)
    }

    /// The same picture without one of the model's rules.
    pub fn without(world: &World, view: &View, without: Option<Rule>) -> Self {
        let sight = Sight::new(view, without);
        let enclosed = Sight::<Interval>::new(view, without);
        let mut query = world.query::<(&FileOrder, &Transform, &Light)>();
        let lights = query.iter().filter(|(_, _, light)| light.on);
        let lights = in_file_order(
            lights.map(|(order, transform, light)| (*order, (transform.position, *light))),
        );
        let mut query = world.query::<(&FileOrder, &Transform, &Mesh, &Material, &ShadingMode)>();
        let cuboids = query
            .iter()
            .map(|(order, transform, mesh, material, mode)| {
                let transform = &transform.turned(view.turned);
                let solid = Solid::new(&sight, transform, mesh, enclosed.bounds(transform, mesh));
                let places = (sight.eye, transform.position);
                let cuboid = Cuboid {
                    number: order.0 as usize,
                    surface: Surface::new(&solid, mesh, material, &lights, places, without),
                    solid,
                    mesh: *mesh,
                    mode: view.mode(*mode),
                    is_perspective_correct: without != Some(Rule::PerspectiveCorrect),
                };
                (*order, cuboid)
            });
        let cuboids = in_file_order(cuboids);
        Reference {
            without,
            sight,
            cuboids,
            background: Vector::exact(view.background),
            width: view.size[0],
        }
    }

    /// Evaluates the pixels of row `y` from left to right. `each` is told what every one of them may show: one thing, unless
    /// an edge, a gate that may fall either way, or another cuboid at the same depth is near.
    pub fn row(&self, y: usize, mut each: impl FnMut(usize, &[Seen<R>])) {
        let here = |cuboid: &&Cuboid<R>| cuboid.solid.rows.contains(&y);
        let cuboids: Vec<_> = self.cuboids.iter().filter(here).collect();
        let (mut met, mut seen) = (Vec::new(), Vec::new());
        for x in 0..self.width {
            self.meet([x, y], &cuboids, &mut met);
            self.see(&met, &mut seen);
            each(x, &seen);
        }
    }

    /// What pixel (`x`, `y`) may show.
    pub fn at(&self, pixel: [usize; 2]) -> Vec<Seen<R>> {
        let cuboids: Vec<_> = self.cuboids.iter().collect();
        let (mut met, mut seen) = (Vec::new(), Vec::new());
        self.meet(pixel, &cuboids, &mut met);
        self.see(&met, &mut seen);
        seen
    }

    /// Overwrites `seen` with what the cuboids that are met look like.
    fn see(&self, met: &[Met<R>], seen: &mut Vec<Seen<R>>) {
        seen.clear();
        for met in met {
            let Met {
                cuboid,
                line,
                meeting,
                ..
            } = met;
            for face in meeting.faces() {
                // Where an edge is near, the centre may lie beside the face.
                if meeting.well_conditioned() {
                    cuboid.see(face, &cuboid.solid.place(face, line), seen);
                } else {
                    for place in cuboid.solid.beside(face, line) {
                        cuboid.see(face, &place, seen);
                    }
                }
            }
        }
        if !met.iter().any(|met| met.meeting.is_certain) {
            seen.push(Seen {
                triangle: None,
                levels: self.background.0,
            });
        }
    }

    /// Overwrites `met` with what may be seen at pixel (`x`, `y`) of some cuboids, in file order.
    fn meet<'a>(&self, [x, y]: [usize; 2], cuboids: &[&'a Cuboid<R>], met: &mut Vec<Met<'a, R>>) {
        met.clear();
        for &cuboid in cuboids {
            if !cuboid.solid.columns.contains(&x) {
                continue;
            }
            let line = cuboid.solid.line(&self.sight, x, y);
            let Some(meeting) = cuboid.solid.meet(&line) else {
                continue;
            };
            let depth = |met: &Met<R>| met.cuboid.solid.depth(met.meeting, &met.line);
            let new = Met {
                cuboid,
                line,
                meeting,
            };
            let mut is_hidden = false;
            met.retain(|other| {
                let order = depth(other)
                    .zip(depth(&new))
                    .and_then(|(other, new)| (other * R::of(1.0 - DEPTH_TIE) - new).sign(0.0));
                let is_painted_over = self.without == Some(Rule::DepthTest);
                match order {
                    _ if is_painted_over => !meeting.is_certain,
                    Some(Ordering::Greater) => !meeting.is_certain,
                    Some(_) => {
                        is_hidden |= other.meeting.is_certain;
                        true
                    }
                    None => true,
                }
            });
            if !is_hidden {
                met.push(new);
            }
        }
    }
}

/// A cuboid that a line of sight meets.
struct Met<'a, R> {
    cuboid: &'a Cuboid<R>,
    line: Line<R>,
    meeting: Meeting,
}

impl<R: Real> Cuboid<R> {
    /// Adds what a place on a face looks like.
    fn see(&self, face: usize, place: &Place<R>, seen: &mut Vec<Seen<R>>) {
        for &is_first in self.triangles(place) {
            let mut see = |open| {
                let lit = self.lit(face, is_first, place, open);
                let triangle = 2 * face + usize::from(!is_first);
                seen.push(Seen {
                    triangle: Some(self.number * TRIANGLES.len() + triangle),
                    levels: lit.levels.0,
                });
                lit.is_tied
            };
            if see(0) {
                for open in 1..1 << TIES {
                    see(open);
                }
            }
        }
    }

    /// Which triangles of its face a place may be on: both where the diagonal is near, and Phong's are one.
    fn triangles(&self, place: &Place<R>) -> &'static [bool] {
        match place.is_on_first {
            None if self.mode != ShadingMode::Phong || !self.is_perspective_correct => {
                &[true, false]
            }
            Some(false) => &[false],
            _ => &[true],
        }
    }

    /// What is seen at a place on a triangle of a face, or on its plane beyond the diagonal.
    fn lit(&self, face: usize, is_first: bool, place: &Place<R>, open: Open) -> Lit<R> {
        if self.mode == ShadingMode::Phong && self.is_perspective_correct {
            return self.surface.phong(place, open);
        }
        let (corners, weights) = Solid::weights(face, is_first, place);
        if self.mode == ShadingMode::UnitVectors {
            let weights = self.shortcut_weights(corners, weights);
            return self.surface.unit_vectors(corners, weights);
        }
        let depths = self.solid.depths(corners, &self.mesh);
        let depths = depths.filter(|_| !self.is_perspective_correct);
        let weights = depths.map_or(weights, |depths| on_screen(weights, depths));
        if self.mode == ShadingMode::Gouraud {
            return self.surface.gouraud(corners, weights, open);
        }
        self.surface.phong(&self.blended(corners, weights), open)
    }

    /// The weights of unit vectors: those on the screen, where all corners have a place there.
    fn shortcut_weights(&self, corners: [usize; 3], weights: [R; 3]) -> [R; 3] {
        let depths = self.solid.depths(corners, &self.mesh);
        let depths = depths.filter(|depths| self.solid.are_beyond_near(depths));
        depths.map_or(weights, |depths| on_screen(weights, depths))
    }

    /// The place that interpolation of the corners gives.
    fn blended(&self, corners: [usize; 3], weights: [R; 3]) -> Place<R> {
        let [a, b, c] = corners.map(|corner| Vector::exact(self.mesh.corners[corner]));
        let share = |corner: usize| Vector::exact(self.mesh.corners[corner].signum() / 2.0);
        // The eye may be so far away that it must not be weighted.
        let point = a - self.solid.eye + (b - a) * weights[1] + (c - a) * weights[2];
        Place {
            point,
            share: blend(corners.map(share), weights),
            to_eye: self.solid.to_eye(point),
            is_on_first: None,
        }
    }
}

/// Weights in linear interpolation on the screen instead of on the triangle.
///
/// Areas shrink with both depths of their edge: bc / (zb zc) : ca / (zc za) : ab / (za zb).
fn on_screen<R: Real>(weights: [R; 3], depths: [R; 3]) -> [R; 3] {
    let [a, b, c] = Vector(weights).zip(Vector(depths), R::mul).0;
    [a, b, c].map(|weight| weight / (a + b + c))
}

/// Evaluates `rows` of the picture of `world` that `view` asks for; the view's tolerance is not used.
///
/// It works on rayon's current threads and takes 28 bytes a pixel of `rows`: ask for a very large picture in bands.
/// `cancelled` is asked before every row, and a yes makes the result `None`; `progress` is told, from any thread, how
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
            .zip(rows)
            .try_for_each(|((levels, triangles), y)| {
                if cancelled() {
                    return None;
                }
                self.row(y, |x, seen| {
                    if let [first, ..] = seen
                        && let Some(triangle) = first.triangle
                    {
                        levels[x] = first.levels;
                        triangles[x] = triangle as u32;
                    }
                });
                progress(done.fetch_add(1, atomic::Ordering::Relaxed) + 1);
                Some(())
            })?;
        Some(Truth {
            width,
            levels,
            triangles,
        })
    }
}
