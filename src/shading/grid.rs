//! The grids of Gouraud shading: levels at points of a face, and their interpolation over cells.
//!
//! ```text
//!  v   2 +-----+-----+      n = 2 segments: (n + 1)^2 points in n^2 cells. Each cell is cut from its lower left to its
//!  |     |  .' |  .' |      upper right corner, parallel to the diagonal of the face. A place (s, t) of the grid is
//!  |   1 +-----+-----+      (u + 1) n / 2, (v + 1) n / 2; in the cell (i, j) the levels are linear in s - i and t - j
//!  |     |  .' |  .' |      on each triangle. They are continuous over the face, and end at its edges: a pixel centre
//!  |   0 +-----+-----+      just outside, which snapping may show, takes the nearest point of the face.
//!        0     1     2 --u
//! ```

mod linear;

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x8};
use glam::DVec3;

pub use self::linear::LinearCells;
use super::affine::Affine;
use super::{Surface, U};
use crate::components::Segments;
use crate::output::memory::{self, Content, OutOfMemory};
use crate::shading::simd::{baseline, inlined, three, two};

/// The grids of all faces in a frame.
#[derive(Debug, Default)]
pub struct Grids {
    levels: Vec<[f64; 3]>,
    faces: Vec<FaceGrid>,
}

/// What is known of the grid of a face.
#[derive(Debug)]
pub(super) struct FaceGrid {
    pub segments: usize,
    /// Those that are seen.
    cells: Cells,
    /// The indices of the levels at the points of these cells, row by row. None if each pixel lights the points of its own cell.
    lit: Range<usize>,
    /// The largest size of a level; infinite if none is lit.
    largest: f64,
    /// The largest change of a level from a point to the next, along u and along v.
    steepest: [f64; 2],
    /// Those of [`Surface::levels_in_lanes`], for pixels that light points.
    functions: [Affine; 3],
}

/// A rectangle of cells of a grid: the first of them, and their numbers along u and v.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cells {
    pub first: [usize; 2],
    pub size: [usize; 2],
}

impl Cells {
    /// The cells that places from the least to the largest (u, v) need, and one more on each side because these are rounded.
    pub fn around([least, most]: [[f64; 2]; 2], segments: Segments) -> Self {
        let count = segments.count();
        let place = |u: f64| (u + 1.0) * 0.5 * count as f64;
        let first = least.map(|u| (place(u) as usize).saturating_sub(1).min(count - 1));
        let size = two!(|axis| {
            let end = (place(most[axis]).ceil() as usize + 1).min(count);
            end.max(first[axis] + 1) - first[axis]
        });
        Cells { first, size }
    }

    /// The number of their points.
    pub fn points(&self) -> usize {
        (self.size[0] + 1) * (self.size[1] + 1)
    }
}

/// Memory for so many points, 2.4 MB, is not given back.
const KEPT: usize = 100_000;

impl Grids {
    /// The number of points of a cuboid's visible faces, which are three at most. One segment needs no grid.
    pub fn points(segments: Segments) -> usize {
        if segments.count() == 1 {
            return 0;
        }
        3 * segments.points()
    }

    /// Removes all grids, and allocates memory for those of this number of cuboids, with this number of points in all.
    ///
    /// # Errors
    /// If there is too little memory.
    pub fn reserve(&mut self, [cuboids, points]: [usize; 2]) -> Result<(), OutOfMemory> {
        memory::clear(&mut self.levels, points.max(KEPT));
        self.faces.clear();
        if points > self.levels.capacity() {
            // The old ones are given back before new ones are asked for.
            self.levels = Vec::new();
            let needed = points.saturating_mul(size_of::<[f64; 3]>());
            memory::check(Content::Grids(cuboids), needed)?;
            let reserved = self.levels.try_reserve_exact(points);
            reserved.map_err(memory::refused(Content::Grids(cuboids), needed))?;
        }
        Ok(())
    }

    /// The number of points that have levels.
    pub fn lit_points(&self) -> usize {
        self.levels.len()
    }

    /// Adds the grid of a face, with the levels at the points (u, v) of these cells, the only ones that are seen. Returns its
    /// index. There must be memory for it.
    #[inline(always)]
    pub fn add<S: Simd>(
        &mut self,
        simd: S,
        segments: Segments,
        cells: Cells,
        levels: impl Fn([f64x8<S>; 2]) -> [f64x8<S>; 3],
    ) -> u32 {
        let (start, count) = (self.levels.len(), segments.count());
        let splat = inlined!(|number: f64| f64x8::splat(simd, number));
        let lanes = f64x8::from_fn(simd, |lane| lane as f64);
        let (mut largest, mut steepest) = (splat(0.0), [0.0_f64; 2]);
        let [first, across] = [cells.first, two!(|axis| cells.size[axis] + 1)];
        for row in 0..across[1] {
            let v = along(splat((first[1] + row) as f64), count);
            for column in (0..across[0]).step_by(8) {
                let u = along(lanes + (first[0] + column) as f64, count);
                let [red, green, blue] = levels([u, v]);
                largest = largest.max(red.abs()).max(green.abs()).max(blue.abs());
                let own = 0..8.min(across[0] - column);
                self.levels
                    .extend(own.map(|lane| [red[lane], green[lane], blue[lane]]));
            }
            let numbers = self.levels[start..].as_flattened();
            let (before, own) = numbers.split_at(3 * row * across[0]);
            let below = before.rchunks(own.len()).next().unwrap_or_default();
            let changes = [[own, &own[3..]], [below, own]];
            steepest = two!(|axis| steepest[axis].max(largest_change(simd, changes[axis])));
        }
        self.faces.push(FaceGrid {
            segments: count,
            cells,
            lit: start..self.levels.len(),
            largest: largest.reduce_max(),
            steepest,
            functions: Default::default(),
        });
        self.faces.len() as u32 - 1
    }

    /// Adds a grid without levels, for a face with few pixels: each of them lights the three points of its cell. Returns its index.
    /// `functions` are those of [`Surface::levels_in_lanes`].
    pub fn add_unlit(&mut self, segments: Segments, cells: Cells, functions: [Affine; 3]) -> u32 {
        self.faces.push(FaceGrid {
            segments: segments.count(),
            cells,
            lit: 0..0,
            largest: f64::INFINITY,
            steepest: [0.0; 2],
            functions,
        });
        self.faces.len() as u32 - 1
    }

    /// The grid at an index; the surface is that of its face.
    pub fn get<'a>(&'a self, index: u32, surface: Surface<'a>) -> Grid<'a> {
        let face = &self.faces[index as usize];
        Grid {
            face,
            levels: &self.levels[face.lit.clone()],
            surface,
        }
    }
}

/// u or v of points of a grid. Points beyond the last one of a row repeat it.
#[inline(always)]
fn along<S: Simd>(points: f64x8<S>, segments: usize) -> f64x8<S> {
    let one = f64x8::splat(points.token(), 1.0);
    (points * 2.0 / segments as f64 - 1.0).min(one)
}

/// The largest change between numbers of two slices, as far as both go.
#[inline(always)]
fn largest_change<S: Simd>(simd: S, [a, b]: [&[f64]; 2]) -> f64 {
    let len = a.len().min(b.len());
    let [(a, rest_a), (b, rest_b)] = [&a[..len], &b[..len]].map(<[f64]>::as_chunks::<8>);
    let mut most = f64x8::splat(simd, 0.0);
    for (a, b) in a.iter().zip(b) {
        most = most.max((f64x8::from_slice(simd, b) - f64x8::from_slice(simd, a)).abs());
    }
    let rest = rest_a.iter().zip(rest_b).map(|(a, b)| (b - a).abs());
    rest.fold(most.reduce_max(), f64::max)
}

/// The grid of a face.
#[derive(Clone, Copy, Debug)]
pub struct Grid<'a> {
    pub(super) face: &'a FaceGrid,
    levels: &'a [[f64; 3]],
    surface: Surface<'a>,
}

/// The rounding error of a place in the grid in f32, relative to the largest place on the square. It is counted as `COLOR_ERROR` of
/// [`super::gouraud`] is, without the rows of the wrong triangle and of the display:
///
/// ```text
///   (6 of the numerator + 3 x 6 of w + 2 of the division) / smallest w = 26 / (1/2) = 52
/// ```
/// `Grid::rounding` adds U cells: `place - cell` is exact from 0 on, but may round below 0.
const PLACE_ERROR: f64 = 52.0 * U;

/// The rounding error of an interpolated level, relative to the largest of the grid: the weights are positive, and their
/// sum is 1. A term has its stored level, a difference of two places, a product and two sums; display has four. The level at a
/// point errs relatively by 1.5e-9 at most ([`super::specular::power_in_lanes`]), a fortieth of a rounding, which is not counted.
const LEVEL_ERROR: f64 = 9.0 * U;

impl Grid<'_> {
    /// The cell in which a place of the grid lies, clamped to those that are seen.
    fn cell(&self, place: [f64; 2]) -> [usize; 2] {
        let Cells { first, size } = self.face.cells;
        two!(|axis| {
            let last = first[axis] + size[axis] - 1;
            (place[axis].max(0.0) as usize).clamp(first[axis], last)
        })
    }

    /// The index of the point at the lower left corner of a cell.
    fn point(&self, [i, j]: [usize; 2]) -> usize {
        let Cells { first, size } = self.face.cells;
        (j - first[1]) * (size[0] + 1) + i - first[0]
    }

    /// The levels at a point (u, v), or at the nearest point of the face.
    pub fn at(&self, uv: [f64; 2]) -> DVec3 {
        let place = uv.map(|u| (u + 1.0) * 0.5 * self.face.segments as f64);
        let [i, j] = self.cell(place);
        let [s, t] = [place[0] - i as f64, place[1] - j as f64].map(|it| it.clamp(0.0, 1.0));
        let third = if s > t { [i + 1, j] } else { [i, j + 1] };
        let [a, third, c] = self.levels_at([[i, j], third, [i + 1, j + 1]]);
        a * (1.0 - s.max(t)) + third * (s.max(t) - s.min(t)) + c * s.min(t)
    }

    /// The levels at three points, which are lit now if they are not yet.
    fn levels_at(&self, points: [[usize; 2]; 3]) -> [DVec3; 3] {
        if !self.levels.is_empty() {
            return points.map(|point| DVec3::from(self.levels[self.point(point)]));
        }
        let uv = two!(|axis| {
            let places = f64x8::from_fn(baseline(), |lane| points[lane % 3][axis] as f64);
            along(places, self.face.segments)
        });
        let levels = self.surface.levels_in_lanes(&self.face.functions, uv);
        three!(|point| DVec3::from(three!(|channel| levels[channel][point])))
    }

    /// How many points each pixel lights, and how many powers these take at most.
    pub fn evaluations(&self) -> [usize; 2] {
        let points = if self.levels.is_empty() { 3 } else { 0 };
        [points, points * self.surface.powers()]
    }

    /// The rounding error of [`Grid::levels`], in levels. `largest` are the largest places that are counted from the origin.
    ///
    /// Levels are continuous, and change by at most `steepest` a cell, so an error of a place costs that much of it.
    pub fn rounding(&self, largest: [f64; 2]) -> f64 {
        let [along_u, along_v] =
            two!(|axis| (largest[axis] * PLACE_ERROR + U) * self.face.steepest[axis]);
        along_u + along_v + self.face.largest * LEVEL_ERROR
    }

    /// The levels at places of the grid, which are counted from `origin`, a point of it.
    #[inline(always)]
    pub fn levels<S: Simd>(
        &self,
        simd: S,
        origin: [f64; 2],
        places: [f32x16<S>; 2],
    ) -> [f32x16<S>; 3] {
        let splat = inlined!(|number: f64| f32x16::splat(simd, number as f32));
        let [(i, s), (j, t)] = two!(|axis| {
            let first = self.face.cells.first[axis] as f64 - origin[axis];
            let last = first + self.face.cells.size[axis] as f64;
            let [start, end] = [first, last].map(splat);
            // NaN, which lanes without a pixel may hold, becomes the first place.
            let place = places[axis].simd_gt(start).select(places[axis], start);
            let place = place.simd_lt(end).select(place, end);
            let cell = place.floor().min(splat(last - 1.0));
            (cell - start, place - cell)
        });
        let across = self.face.cells.size[0] + 1;
        let start = j * splat(across as f64) + i;
        let is_right = s.simd_gt(t);
        let third = start + is_right.select(splat(1.0), splat(across as f64));
        let (least, most) = (s.min(t), s.max(t));
        let weights = [1.0 - most, most - least, least];
        let mut levels = [splat(0.0); 3];
        // Neighbours mostly lie in few triangles: one after another is evaluated in all lanes, and kept in its own.
        let mut rest = u64::from(u16::MAX);
        while rest != 0 {
            let lane = rest.trailing_zeros() as usize;
            let is_here = start.simd_eq(start[lane]) & third.simd_eq(third[lane]);
            // Whole numbers below 2^17, exact in f32.
            let [a, b] = [start[lane] as usize, third[lane] as usize];
            let corners = [a, b, a + across + 1].map(|point| self.levels[point]);
            levels = three!(|channel| {
                let [a, b, c] = three!(|corner| weights[corner] * corners[corner][channel] as f32);
                is_here.select(a + b + c, levels[channel])
            });
            rest &= !(is_here.to_bitmask() | 1 << lane);
        }
        levels
    }
}

#[cfg(test)]
mod tests {
    use std::array::from_fn;

    use super::super::running::{Rounded, at_corner, w_at_corner};
    use super::*;
    use crate::components::{Illumination, Material, PointLight};

    const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

    static MATERIAL: Material = Material {
        ambient: DVec3::ONE,
        diffuse: DVec3::ONE,
        specular: DVec3::ONE,
        shininess: 5.0,
    };

    /// A number from 0 to 1 that looks random.
    fn part(index: usize, step: f64) -> f64 {
        (index as f64 * step + 0.1).fract()
    }

    /// Adds a grid with these levels at the points (u, v).
    fn add(grids: &mut Grids, segments: u32, level: impl Fn([f64; 2]) -> DVec3) -> u32 {
        let segments = Segments::new(segments).expect("it is legal");
        let cells = Cells::around([[-1.0; 2], [1.0; 2]], segments);
        grids.add(baseline(), segments, cells, |[u, v]| {
            let levels: [DVec3; 8] = from_fn(|lane| level([u[lane], v[lane]]));
            three!(|channel| f64x8::from_fn(baseline(), |lane| levels[lane][channel]))
        })
    }

    /// The grid at an index, of a face without light.
    fn get(grids: &Grids, index: u32) -> Grid<'_> {
        static DARK: Illumination = Illumination {
            ambient: DVec3::ZERO,
            points: Vec::new(),
        };
        grids.get(index, Surface::new(&MATERIAL, &DARK, DVec3::ZERO))
    }

    /// Grids of these segments. The levels are up to 200 and differ by up to `bump` from a linear function.
    fn grids(segments: u32, bump: f64) -> Grids {
        let mut grids = Grids::default();
        add(&mut grids, segments, |[u, v]| {
            let noise = (37.0 * u + 59.0 * v).sin() * bump;
            DVec3::new(
                100.0 + 50.0 * u + noise,
                20.0 * v - noise,
                80.0 - 10.0 * u + 30.0 * v,
            )
        });
        grids
    }

    #[test]
    fn levels_are_those_at_the_points_and_linear_on_each_triangle() {
        // A cell is [0, 1] x [0, 1]; its levels there are 0, 8, 2 and 5, counter-clockwise from the origin.
        let mut grids = Grids::default();
        let index = add(&mut grids, 2, |[u, v]| {
            DVec3::splat(match [u, v] {
                [0.0, 0.0] | [-1.0, _] | [_, -1.0] => 0.0,
                [1.0, 0.0] => 8.0,
                [1.0, 1.0] => 2.0,
                _ => 5.0,
            })
        });
        let grid = get(&grids, index);
        for ([u, v], level) in [
            ([0.0, 0.0], 0.0),
            ([1.0, 0.0], 8.0),
            ([0.5, 0.0], 4.0),
            ([0.5, 0.5], 1.0),
            // (8 + 1) / 2 between (1, 0) and the middle, (5 + 1) / 2 between (0, 1) and the middle.
            ([0.75, 0.25], 4.5),
            ([0.25, 0.75], 3.0),
            // Beside the face: the nearest point.
            ([1.25, 0.5], 5.0),
            ([1.1, 1.2], 2.0),
            ([-1.5, -1.5], 0.0),
        ] {
            assert_eq!(grid.at([u, v]), DVec3::splat(level), "at {u}, {v}");
        }
    }

    #[test]
    fn a_pixel_lights_points_as_they_are_lit_in_advance() {
        let mut grids = Grids::default();
        let light = PointLight {
            position: DVec3::new(0.3, 0.2, 1.5),
            diffuse: DVec3::new(30.0, 60.0, 90.0),
            specular: DVec3::splat(100.0),
        };
        let illumination = Illumination {
            ambient: DVec3::ONE,
            points: vec![light],
        };
        let surface = Surface::new(&MATERIAL, &illumination, DVec3::ZERO);
        let functions = [
            Affine::new(DVec3::ZERO, DVec3::X, DVec3::Y),
            Affine::new(DVec3::Z, DVec3::X * 0.5, DVec3::Y * 0.5),
            Affine::new(DVec3::Z * 3.0, -DVec3::X, -DVec3::Y),
        ];
        let segments = Segments::new(9).expect("it is legal");
        let cells = Cells::around([[-0.4; 2], [1.0; 2]], segments);
        let of_points = |uv| surface.levels_in_lanes(&functions, uv);
        grids.add(baseline(), segments, cells, of_points);
        grids.add_unlit(segments, cells, functions);
        let [lit, unlit] = [0, 1].map(|index| grids.get(index, surface));
        assert_eq!([lit, unlit].map(|it| it.evaluations()[0]), [0, 3]);
        for number in 0..200 {
            let uv = [0.618, 0.414].map(|step| 1.6 * part(number, step) - 0.5);
            assert_eq!(lit.at(uv), unlit.at(uv), "{uv:?}");
            assert!(lit.at(uv).x > 1.0, "{uv:?}");
        }
    }

    #[test]
    fn an_error_of_a_place_costs_as_much_as_levels_change() {
        let mut grids = Grids::default();
        add(&mut grids, 9, |_| DVec3::ONE);
        let grid = get(&grids, 0);
        assert_eq!(grid.rounding([100.0; 2]), grid.rounding([0.0; 2]));
    }

    #[test]
    fn the_largest_level_of_any_channel_counts() {
        for axis in DVec3::AXES {
            let mut grids = Grids::default();
            add(&mut grids, 9, |_| 100.0 * axis);
            assert_eq!(get(&grids, 0).rounding([0.0; 2]), 100.0 * LEVEL_ERROR);
        }
    }

    #[test]
    fn places_need_one_more_cell_on_each_side() {
        let segments = Segments::new(10).expect("it is legal");
        let [first, size] = [[4; 2]; 2];
        let cells = Cells::around([[0.1; 2], [0.3; 2]], segments);
        assert_eq!(cells, Cells { first, size });
    }

    #[test]
    fn places_in_one_cell_have_its_levels_without_an_error() {
        let grids = grids(9, 40.0);
        for tolerance in [0.0, 2.0] {
            let patch = get(&grids, 0).patch([[3.2; 2], [3.8; 2]], &CORNERS, tolerance);
            let patch = patch.expect("one cell needs no function for several");
            assert_eq!((patch.cells.size, patch.error), ([1, 1], 0.0));
        }
    }

    #[test]
    fn levels_in_f32_are_as_near_as_their_bound_says() {
        let mut most = 0.0_f64;
        for segments in [2, 3, 16, 255, 256] {
            let grids = grids(segments, 40.0);
            let grid = get(&grids, 0);
            for number in 0..400 {
                // Some are beside the face, and some on points and diagonals.
                let origin =
                    [0.618, 0.414].map(|step| (part(number, step) * f64::from(segments)).floor());
                let place = |lane: usize, step: f64| match lane % 4 {
                    0 => (6.0 * part(number + lane, step)).floor() - 2.0,
                    1 => 6.0 * part(number, step) - 3.0,
                    _ => 6.0 * part(number + 31 * lane, step) - 3.0,
                };
                let places = [0.732, 0.236].map(|step| from_fn(|lane| place(lane, step) as f32));
                let drawn = grid.levels(
                    baseline(),
                    origin,
                    places.map(|it: [f32; 16]| f32x16::simd_from(baseline(), it)),
                );
                for lane in 0..16 {
                    let uv = two!(|axis| {
                        let place = f64::from(places[axis][lane]) + origin[axis];
                        place / f64::from(segments) * 2.0 - 1.0
                    });
                    let exact = grid.at(uv);
                    for channel in 0..3 {
                        let error = (f64::from(drawn[channel][lane]) - exact[channel]).abs();
                        // A place is exact here, but for the rounding below 0.
                        let bound = grid.rounding([0.0; 2]);
                        most = most.max(error / bound);
                    }
                }
            }
        }
        assert!(most <= 1.0, "the bound is {most} times too small");
        assert!(most > 0.1, "the bound is loose: {most}");
    }

    #[test]
    fn the_count_of_roundings_of_a_place_covers_what_a_running_error_analysis_finds() {
        let mut most = 0.0_f64;
        for step in 0..=1000 {
            let part = |factor: f64| (f64::from(step) * factor).sin();
            let w = w_at_corner(step);
            let [place, right, down] = [part(0.7), part(1.1), part(1.7)];
            let largest = place.abs() + right.abs() + down.abs();
            let place = at_corner([place, right, down]) * (Rounded::exact(1.0) / w);
            most = most.max(place.error * U / (PLACE_ERROR * largest));
        }
        assert!(most <= 1.0, "the count is {most} times too small");
        assert!(most > 0.5, "the count is loose: {most}");
    }

    #[test]
    fn a_function_for_several_cells_errs_by_no_more_than_it_says() {
        let mut refused = 0;
        for number in 0..300 {
            let segments = [2, 5, 40, 256][number % 4];
            let grids = grids(segments, 3.0 * part(number, 0.618));
            let grid = get(&grids, 0);
            let count = f64::from(segments);
            // From just outside of the face.
            let least = [0.732, 0.236].map(|step| part(number, step) * count - 0.5);
            let most = least.map(|it| (it + 6.0 * part(number, 0.414)).min(count + 0.5));
            let Some(patch) = grid.patch([least, most], &CORNERS, 2.0) else {
                refused += 1;
                continue;
            };
            assert!(patch.error <= 2.0);
            let mut largest = 0.0_f64;
            for step in 0..=40 * 40 {
                let share = [step % 41, step / 41].map(|it| f64::from(it) / 40.0);
                let place = two!(|axis| {
                    let place = least[axis] + share[axis] * (most[axis] - least[axis]);
                    place.clamp(0.0, count)
                });
                let local = two!(|axis| {
                    let Cells { first, size } = patch.cells;
                    (place[axis] - first[axis] as f64) / size[axis] as f64
                });
                let [a, b, c, d] = patch.levels;
                let [s, t] = local;
                let third = if s > t { b } else { d };
                let function = a * (1.0 - s.max(t)) + third * (s - t).abs() + c * s.min(t);
                let exact = grid.at(place.map(|it| it / count * 2.0 - 1.0));
                largest = largest.max((function - exact).abs().max_element());
            }
            assert!(
                largest <= patch.error + 1e-9,
                "{largest} of {}",
                patch.error
            );
            assert!(patch.cells.size != [1, 1] || patch.error < 1e-9 || !patch.is_cut);
        }
        assert!((10..200).contains(&refused), "{refused}");
    }
}
