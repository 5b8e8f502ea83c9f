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
mod intersection;

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DMat3, DVec3};
use hecs::World;
use rayon::prelude::*;

use crate::components::{
    Light, LightKind, Material, Mesh, Name, Projection, ShadingMode, TRIANGLES, Transform, View,
};
use crate::frame::NO_TRIANGLE;
use illumination::{Eye, Lamp, Surface, blend, reflection};
use intersection::{Hit, Ray, Rays, Solid};

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
    let width = view.size[0];
    let subjects = Subjects::of(world, view);
    let mut levels = vec![view.background.to_array(); width * rows.len()];
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
            subjects.row(y, levels, triangles);
            progress(done.fetch_add(1, Ordering::Relaxed) + 1);
            Some(())
        })?;
    Some(Truth {
        width,
        rows,
        levels,
        triangles,
    })
}

/// What is seen at pixel (`x`, `y`) of the picture that `view` asks for; `None` is background, or outside of it.
pub fn at_pixel(world: &World, view: &View, x: usize, y: usize) -> Option<Sample> {
    let subjects = Subjects::of(world, view);
    let ray = subjects.rays.through(x, y);
    let mut nearest = None;
    for (object, subject) in subjects.list.iter().enumerate() {
        if subject.solid.rows.contains(&y) && subject.solid.columns.contains(&x) {
            subject.meet(object, &ray, &mut nearest);
        }
    }
    let (object, hit) = nearest?;
    let Subject {
        surface,
        position,
        axes,
        ..
    } = &subjects.list[object];
    let corners = TRIANGLES[hit.triangle].map(usize::from);
    let point = surface.point(hit.place, hit.to_eye);
    let lights =
        surface
            .lamps
            .iter()
            .zip(&subjects.names)
            .enumerate()
            .map(|(index, (lamp, name))| {
                let to_light = lamp.from(point.place);
                let exists = to_light != DVec3::ZERO;
                LightSample {
                    name: name.clone(),
                    kind: lamp.kind,
                    to_light: exists.then(|| *axes * to_light),
                    reflected: exists.then(|| *axes * reflection(point.normal, to_light)),
                    gouraud: blend(
                        corners.map(|corner| surface.corner_terms[index][corner]),
                        hit.weights,
                    ),
                    phong: surface.term(lamp, point.normal, to_light, point.to_eye),
                }
            });
    Some(Sample {
        object,
        triangle: hit.triangle,
        position: *position + *axes * point.place,
        normal: *axes * point.normal,
        to_eye: *axes * point.to_eye,
        lights: lights.collect(),
        gouraud: surface.gouraud(corners, hit.weights),
        phong: surface.phong(&point),
    })
}

/// One cuboid: where its picture is, and what it looks like there.
struct Subject {
    solid: Solid,
    surface: Surface,
    position: DVec3,
    axes: DMat3,
    mode: ShadingMode,
}

/// Every cuboid in file order, the names of the lights that are on, and the rays that meet them.
struct Subjects {
    rays: Rays,
    list: Vec<Subject>,
    names: Vec<String>,
    background: [f64; 3],
}

impl Subjects {
    fn of(world: &World, view: &View) -> Self {
        let rays = Rays::of(view);
        let (names, lights): (Vec<_>, Vec<_>) = world
            .query::<(&Name, &Transform, &Light)>()
            .iter()
            .filter(|(_, _, light)| light.on)
            .map(|(name, transform, light)| (name.0.clone(), (transform.position, *light)))
            .unzip();
        let list = world
            .query::<(&Transform, &Mesh, &Material, &ShadingMode)>()
            .iter()
            .map(|(transform, mesh, material, mode)| {
                let axes = transform.axes();
                let along_own = |vector: DVec3| axes.transpose() * vector;
                let eye = match view.projection {
                    Projection::Perspective => Eye::At(along_own(rays.eye - transform.position)),
                    Projection::Orthographic => Eye::Towards(along_own(-rays.forward())),
                };
                let lamps = lights.iter().map(|(position, light)| Lamp {
                    kind: light.kind,
                    levels: light.color * light.intensity * light.gain,
                    position: along_own(*position - transform.position),
                });
                Subject {
                    solid: Solid::new(&rays, transform, mesh),
                    surface: Surface::new(mesh, *material, &eye, lamps.collect()),
                    position: transform.position,
                    axes,
                    mode: view.shading.unwrap_or(*mode),
                }
            })
            .collect();
        Subjects {
            rays,
            list,
            names,
            background: view.background.to_array(),
        }
    }

    /// Evaluates row `y`.
    fn row(&self, y: usize, levels: &mut [[f64; 3]], triangles: &mut [u32]) {
        let mut nearest = vec![None; levels.len()];
        for (object, subject) in self
            .list
            .iter()
            .enumerate()
            .filter(|(_, subject)| subject.solid.rows.contains(&y))
        {
            for x in subject.solid.columns.clone() {
                subject.meet(object, &self.rays.through(x, y), &mut nearest[x]);
            }
        }
        for ((nearest, levels), triangle) in nearest.into_iter().zip(levels).zip(triangles) {
            (*levels, *triangle) = match nearest {
                Some((object, hit)) => (
                    self.list[object].levels(&hit),
                    (object * TRIANGLES.len() + hit.triangle) as u32,
                ),
                None => (self.background, NO_TRIANGLE),
            };
        }
    }
}

impl Subject {
    /// Takes the ray's hit on this cuboid for the nearest if it is nearer than what cuboids earlier in the file gave.
    fn meet(&self, object: usize, ray: &Ray, nearest: &mut Option<(usize, Hit)>) {
        if let Some(hit) = self.solid.hit(ray)
            && nearest
                .as_ref()
                .is_none_or(|(_, best)| hit.depth < best.depth * (1.0 - DEPTH_TIE))
        {
            *nearest = Some((object, hit));
        }
    }

    fn levels(&self, hit: &Hit) -> [f64; 3] {
        let corners = TRIANGLES[hit.triangle].map(usize::from);
        let levels = match self.mode {
            ShadingMode::Gouraud => self.surface.gouraud(corners, hit.weights),
            ShadingMode::Phong => self
                .surface
                .phong(&self.surface.point(hit.place, hit.to_eye)),
            ShadingMode::UnitVectors => self
                .surface
                .unit_vectors(corners, self.solid.screen_weights(hit)),
        };
        levels.to_array()
    }
}
