//! The surfaces that each pixel shows: the nearest of those that its line of sight hits, and their levels.

use std::cmp::Ordering;
use std::ops::Range;

use glam::DVec3;
use hecs::World;

use super::geometry::{CuboidGeometry, FacePoint, Meeting, across};
use super::illumination::{Lit, Open, ReferenceSurface, TIES, blend};
use super::interval::Interval;
use super::real::{Real, RealVector};
use super::rule::Rule;
use super::sight::{Place, Sight};
use crate::components::{
    FileOrder, Light, Material, Mesh, NormalMode, Segments, ShadingMode, Transform, TriangleId,
    View, in_file_order,
};
use crate::output::{Monitor, memory};

/// Relative difference of depths below which two cuboids tie; the cuboid earlier in the file is then visible. Rounding
/// in f64 separates two coplanar faces by far less, and a visible gap is far larger.
const DEPTH_TIE: f64 = 1e-11;

/// Rows of the reference picture in f64.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Pixels in a row.
    pub width: usize,
    /// Unclamped levels of 255, row by row from the top; the background level where no cuboid is hit.
    pub levels: Vec<[f64; 3]>,
    /// The visible triangle of each pixel, or [`TriangleId::NONE`].
    pub triangles: Vec<TriangleId>,
}

/// A picture that is evaluated pixel by pixel, in f64, f32 or intervals.
pub struct Reference<R> {
    /// The rule that is left out, if any.
    pub(super) without: Option<Rule>,
    pub(super) sight: Sight<R>,
    pub(super) cuboids: Vec<ReferenceCuboid<R>>,
    pub(super) background: RealVector<R>,
}

/// The components of a cuboid.
type Cuboid<'a> = (
    &'a FileOrder,
    &'a Transform,
    &'a Mesh,
    &'a Material,
    &'a NormalMode,
    &'a ShadingMode,
    &'a Segments,
);

/// A cuboid: its geometry (`solid`) and its illumination (`surface`).
pub struct ReferenceCuboid<R> {
    /// Its index in the file, which does not change when other cuboids are removed.
    pub number: usize,
    pub solid: CuboidGeometry<R>,
    pub surface: ReferenceSurface<R>,
    pub(super) mode: ShadingMode,
    /// The cells along an edge of a face under Gouraud.
    pub segments: usize,
}

/// A cuboid that a line of sight may hit.
pub struct Met<'a, R> {
    pub cuboid: &'a ReferenceCuboid<R>,
    pub meeting: Meeting<R>,
}

/// A surface, or the background, that a pixel may show.
#[derive(Clone, Copy, Debug)]
pub struct Seen<R> {
    /// `None` is the background. Under flat shading, Phong, and Gouraud with several cells, the two triangles of a face do not differ, so
    /// near the diagonal this is the first one.
    pub triangle: Option<TriangleId>,
    /// Unclamped levels of 255.
    pub levels: [R; 3],
    /// Whether other surfaces hide it all around the pixel's centre. Only a gap between those would show it.
    pub is_hidden: bool,
}

impl<R> Seen<R> {
    /// Cuboid * 6 + face; `None` is the background.
    pub fn face(&self) -> Option<usize> {
        self.triangle.map(|triangle| triangle.face_id() as usize)
    }
}

impl<R: Real> Reference<R> {
    /// The picture of `world` for `view`. The tolerance of the view is not used.
    pub fn new(world: &World, view: &View) -> Self {
        Reference::without(world, view, None)
    }

    /// The picture without one rule of the model.
    pub fn without(world: &World, view: &View, without: Option<Rule>) -> Self {
        let sight = Sight::new(view, without);
        let enclosed = Sight::<Interval>::new(view, without);
        let mut lights = in_file_order::<(&Transform, &Light), _>(world, |(transform, light)| {
            (transform.position, *light)
        });
        lights.retain(|(_, light)| light.on);
        let cuboids = in_file_order::<Cuboid, _>(
            world,
            |(order, transform, mesh, material, normals, mode, segments)| {
                let transform = &transform.turned(view.turned);
                let bounds = enclosed.bounds(transform, mesh);
                let solid = CuboidGeometry::new(&sight, transform, mesh, bounds);
                let places = (sight.eye, transform.position);
                let mode = view.mode(*mode);
                let without = match mode {
                    // The vectors of the shortcut are as short.
                    ShadingMode::UnitVectors => Some(Rule::UnitNormal),
                    // The definition of Blinn-Phong: Phong without this rule.
                    ShadingMode::BlinnPhong => Some(Rule::Reflection),
                    _ => without,
                };
                ReferenceCuboid {
                    number: order.0 as usize,
                    surface: ReferenceSurface::new(
                        &solid, material, *normals, &lights, places, without,
                    ),
                    solid,
                    mode,
                    segments: view.segments(*segments).count(),
                }
            },
        );
        Reference {
            without,
            sight,
            cuboids,
            background: RealVector::exact(view.background),
        }
    }

    /// Evaluates the pixels of row `y` from left to right. `each` receives the column and the surfaces that the pixel
    /// may show: one, or several near an edge, at a tied specular gate, or where cuboids tie in depth.
    pub fn row(&self, y: usize, each: impl FnMut(usize, &[Seen<R>])) {
        self.part_of_row(y, 0..self.sight.size[0], each);
    }

    /// As [`Self::row`], only in these columns.
    pub fn part_of_row(
        &self,
        y: usize,
        columns: impl IntoIterator<Item = usize>,
        mut each: impl FnMut(usize, &[Seen<R>]),
    ) {
        let cuboids = self.in_row(y);
        let (mut met, mut seen) = (Vec::new(), Vec::new());
        for x in columns {
            self.meet([x, y], &cuboids, &mut met);
            self.see([x, y], &met, &mut seen);
            each(x, &seen);
        }
    }

    /// The columns and rows in which each cuboid may be visible, in file order.
    pub fn bounds(&self) -> Vec<[Range<usize>; 2]> {
        let bounds = |it: &ReferenceCuboid<R>| [it.solid.columns.clone(), it.solid.rows.clone()];
        self.cuboids.iter().map(bounds).collect()
    }

    /// The cuboids that may be visible in row `y`, in file order.
    pub(super) fn in_row(&self, y: usize) -> Vec<&ReferenceCuboid<R>> {
        let here = |cuboid: &&ReferenceCuboid<R>| cuboid.solid.rows.contains(&y);
        self.cuboids.iter().filter(here).collect()
    }

    /// The surfaces that the pixel [x, y] may show.
    pub fn at(&self, pixel: [usize; 2]) -> Vec<Seen<R>> {
        let cuboids = self.in_row(pixel[1]);
        let (mut met, mut seen) = (Vec::new(), Vec::new());
        self.meet(pixel, &cuboids, &mut met);
        self.see(pixel, &met, &mut seen);
        seen
    }

    /// Overwrites `seen` with the surfaces of these cuboids at a pixel, and the background unless one of them is certainly
    /// hit.
    fn see(&self, pixel: [usize; 2], met: &[Met<R>], seen: &mut Vec<Seen<R>>) {
        seen.clear();
        for met in met {
            for (face, place) in &met.meeting.points {
                met.cuboid.see(*face, place, seen);
            }
        }
        if shows(met, None) {
            seen.push(Seen {
                triangle: None,
                levels: self.background.0,
                is_hidden: false,
            });
        }
        if seen.iter().any(|it| it.face() != seen[0].face()) {
            self.mark_hidden(self.sight.centre(pixel), met, seen);
        }
    }

    /// Overwrites `met` with those of the cuboids that may be visible at pixel (`x`, `y`), in file order.
    pub(super) fn meet<'a>(
        &self,
        [x, y]: [usize; 2],
        cuboids: &[&'a ReferenceCuboid<R>],
        met: &mut Vec<Met<'a, R>>,
    ) {
        let cuboids = cuboids.iter().copied();
        let here = cuboids.filter(|cuboid| cuboid.solid.columns.contains(&x));
        self.meet_at(self.sight.centre([x, y]), here, met);
    }

    /// Overwrites `met` with those of the cuboids that may be visible at a place, in file order.
    pub(super) fn meet_at<'a>(
        &self,
        place: Place,
        cuboids: impl Iterator<Item = &'a ReferenceCuboid<R>>,
        met: &mut Vec<Met<'a, R>>,
    ) {
        met.clear();
        for cuboid in cuboids {
            let Some(meeting) = cuboid.solid.meet(&cuboid.solid.line(place)) else {
                continue;
            };
            // Whether the new cuboid, where it is hit, replaces another that is visible so far: the other is farther by
            // more than a tie.
            let replaces = |other: &Met<R>| {
                if self.without == Some(Rule::DepthTest) {
                    return Some(true);
                }
                let times = |factor| other.meeting.depth * R::of(factor);
                let least = times(1.0 - DEPTH_TIE).min(times(1.0 + DEPTH_TIE));
                let order = (least - meeting.depth).sign(0.0);
                order.map(|order| order == Ordering::Greater)
            };
            // One of `met` is visible so far, or the background. It is not known which: ties are not transitive.
            let may_be_background = !met.iter().any(|other| other.meeting.is_certain);
            let may_be_visible =
                may_be_background || met.iter().any(|other| replaces(other) != Some(false));
            if meeting.is_certain {
                met.retain(|other| replaces(other) != Some(true));
            }
            if may_be_visible {
                met.push(Met { cuboid, meeting });
            }
        }
    }
}

/// Whether a line of sight that meets these cuboids may show a face, or the background.
pub(super) fn shows<R>(met: &[Met<R>], face: Option<usize>) -> bool {
    match face {
        None => !met.iter().any(|met| met.meeting.is_certain),
        Some(face) => met.iter().any(|met| {
            let mut faces = met.meeting.points.iter();
            met.cuboid.number == face / 6 && faces.any(|(number, _)| *number == face % 6)
        }),
    }
}

impl<R: Real> ReferenceCuboid<R> {
    /// Adds the levels at a place on a face, once for each state of the tied gates.
    fn see(&self, face: usize, place: &FacePoint<R>, seen: &mut Vec<Seen<R>>) {
        for &is_first in self.triangles(place) {
            let mut see = |open| {
                let lit = self.lit(face, is_first, place, open);
                let triangle = 2 * face + usize::from(!is_first);
                seen.push(Seen {
                    triangle: Some(TriangleId::new(self.number as u32, triangle)),
                    levels: lit.levels.0,
                    is_hidden: false,
                });
                lit.ties > 0
            };
            if see(0) {
                for open in 1..1 << TIES {
                    see(open);
                }
            }
        }
    }

    /// Whether the place may be on the first triangle of its face, on the second, or on both (near the diagonal). Under
    /// flat shading, perspective-correct Phong, and Gouraud with several cells, the triangles do not differ, and the first stands for both.
    fn triangles(&self, place: &FacePoint<R>) -> &'static [bool] {
        let differ = match self.mode {
            ShadingMode::Flat => false,
            _ if !self.surface.is_perspective_correct() => true,
            ShadingMode::Phong | ShadingMode::BlinnPhong => false,
            ShadingMode::Gouraud => self.segments == 1,
            ShadingMode::UnitVectors => true,
        };
        match place.is_on_first {
            Some(false) => &[false],
            None if differ => &[true, false],
            Some(true) | None => &[true],
        }
    }

    /// The levels at a place on a triangle of a face, or on the triangle's plane beyond the diagonal.
    fn lit(&self, face: usize, is_first: bool, place: &FacePoint<R>, open: Open) -> Lit<R> {
        if self.mode == ShadingMode::Flat {
            let (axis, outwards) = across(face);
            let share = RealVector::exact(DVec3::AXES[axis] * outwards / 2.0);
            let middle = self.solid.at_share(share);
            return self.surface.at_vertex(face, &middle, open & 1 == 1);
        }
        let is_phong = matches!(self.mode, ShadingMode::Phong | ShadingMode::BlinnPhong);
        if is_phong && self.surface.is_perspective_correct() {
            return self.surface.phong(face, place, open);
        }
        let (corners, mut weights) = CuboidGeometry::weights(face, is_first, place.share);
        if self.mode == ShadingMode::UnitVectors {
            let weights = self.solid.shortcut_weights(corners, weights);
            return self.surface.unit_vectors(face, corners, weights, open);
        }
        let mut share = place.share;
        if !self.surface.is_perspective_correct() {
            // The weights on the screen give the point of the face. Its cell is that of the point.
            weights = self.solid.weights_on_screen(corners, weights);
            let shares = corners.map(|corner| self.solid.corner_share(corner));
            share = blend(shares, weights);
        }
        if self.mode == ShadingMode::Gouraud {
            return self.gouraud(face, corners, weights, share, open);
        }
        self.surface.phong(face, &self.solid.at_share(share), open)
    }
}

/// Evaluates `rows` of the picture of `world` for `view`. The tolerance of the view is not used. The monitor receives the
/// share of the whole picture, whose rows are drawn from the top.
///
/// Runs on rayon's current threads and allocates 60 bytes per pixel of `rows`, so draw a very large picture in bands.
///
/// # Errors
/// If the work is cancelled, or the picture does not fit in memory.
pub async fn picture(
    world: &World,
    view: &View,
    rows: Range<usize>,
    monitor: Monitor<'_>,
) -> anyhow::Result<Truth> {
    let reference = Reference::<f64>::new(world, view);
    let [width, height] = view.size;
    let size = [width, rows.len()];
    let mut levels = memory::reserve_pixels(size)?;
    let mut triangles = memory::reserve_pixels(size)?;
    let row = |y: usize| {
        let mut row = Vec::with_capacity(width);
        // In floats a pixel shows exactly one surface.
        reference.row(y, |_, seen| row.push((seen[0].levels, seen[0].triangle)));
        Ok(row)
    };
    let done = [rows.start, height];
    let found = monitor.in_parallel("drawing the reference", rows, done, row);
    for (level, triangle) in found.await?.into_iter().flatten() {
        levels.push(level);
        triangles.push(triangle.unwrap_or(TriangleId::NONE));
    }
    Ok(Truth {
        width,
        levels,
        triangles,
    })
}
