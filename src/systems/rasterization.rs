//! Screen polygons in, shaded pixels out.
//!
//! ```text
//!  polygons --scan conversion--> spans --quadtree of 32 and 16 pixels--> squares --shader--> rows of levels --display step--> frame
//!                                  '-- of a face of at most 16 x 16 pixels: those that are seen, one by one --'
//! ```
//! Rules: a pixel is covered if its centre is inside the snapped polygon, or on its top or left edge; the arithmetic is in
//! integers and exact, so pixels along a shared edge are drawn once. A depth buffer exists only while there is more than
//! one cuboid, and then only faces and squares that are seen are shaded. Strips of the picture are cleared, compared in depth
//! and shaded one after another, so that they stay in a cache. Faces and squares are set up from all they cover, so neither
//! threads, strips nor parts of a picture change a bit.

mod listing;
mod store;

use std::ops::Range;

use fearless_simd::Simd;
use glam::DVec3;
use hecs::World;

use self::listing::Listing;
use self::store::Store;
use crate::components::{
    FileOrder, Illumination, Lens, Material, Mesh, Normals, Projected, Projection, ShadingMode,
    VertexColors, View, WorldTransform,
};
use crate::frame::{Band, Counts, DrawList, Frame, Object, Piece, face};
use crate::shading::affine::Affine;
use crate::shading::display::{Evaluated, Listed};
use crate::shading::face::{Face, Rays, Solid, places};
use crate::shading::field::Places;
use crate::shading::gouraud::Gouraud;
use crate::shading::interpolation::{self, Form, Interpolant};
use crate::shading::phong::{FaceLight, Phong};
use crate::shading::square::{MAX_SIDE, MIN_SIDE, Region, Spans, Square};
use crate::shading::unit_vectors::{self, UnitVectors};
use crate::shading::{Effort, Evaluations, Scratch, Shader, Sink, Surface, TileKind};
use crate::simd::{dispatch, outlined};

/// Depths that differ by less than this share of themselves are a tie, which the cuboid earlier in the file wins.
const DEPTH_TIE: f64 = 1e-11;

/// Draws every cuboid into the frame.
pub fn run(world: &mut World, view: &View, frame: &mut Frame) {
    let (lens, lights) = (frame.lens, std::mem::take(&mut frame.illumination));
    let illumination = &lights;
    let level = frame.workers().level();
    let rays = &Rays::new(&lens);
    let listing = Listing {
        illumination,
        view,
        lens: &lens,
        rays,
    };
    let mut list = frame.take_list();
    list.clear();
    for (order, place, mesh, material, own, normals, colors, projected) in world.query_mut::<(
        &FileOrder,
        &WorldTransform,
        &Mesh,
        &Material,
        &ShadingMode,
        &Normals,
        &VertexColors,
        &Projected,
    )>() {
        let object = Object {
            id: 12 * order.0,
            material: *material,
            centre: place.position,
            mode: view.mode(*own),
            gloss: 0,
            solid: Solid {
                centre: place.position - lens.eye,
                axes: place.axes,
                half: mesh.corners[7],
                normals: normals.0,
                colors: colors.0,
            },
        };
        dispatch!(level, simd => listing.add(simd, &mut list, object, projected));
    }
    list.sort(view.size[1]);
    frame.paint(view.background, list, |list, band, scratch| {
        let mut counts = Counts::default();
        for (strip, row) in (0..band.rows.end).step_by(MAX_SIDE).enumerate() {
            let rows = band.held(row..row + MAX_SIDE);
            if rows.is_empty() {
                continue;
            }
            dispatch!(level, _simd => prepare(list, strip, &rows, band, &lens));
            for &piece in &list.strips[strip] {
                let piece = &list.pieces[piece as usize];
                let spans = list.spans(piece);
                // Drawn once all of it in this band is prepared.
                if band.held(spans.rows()).end > rows.end {
                    continue;
                }
                // What fits into the smallest square is drawn as one.
                let mut small = Square::around(&spans);
                let mut strips = 1;
                if let Some(square) = &mut small {
                    let listed = &mut scratch.levels.listed;
                    strips = list_seen(listed, square, &spans, piece, band);
                    square.pixels = listed.count();
                    if square.pixels == 0 {
                        continue;
                    }
                }
                let object = &list.objects[piece.object];
                let face = Face::new((piece.id % 12 / 2) as usize, &object.solid, rays);
                let mut lights = std::mem::take(&mut scratch.lights);
                let shader = shader(list, object, &face, &mut lights, illumination, view, &lens);
                let mut drawing = Drawing {
                    spans,
                    id: piece.id,
                    picture: lens.half,
                    strips,
                    shader,
                    band,
                    scratch,
                    counts: &mut counts,
                };
                dispatch!(level, simd => match &small {
                    Some(square) => drawing.listed(simd, square),
                    None => drawing.draw(simd),
                });
                scratch.lights = lights;
            }
        }
        counts
    });
    frame.illumination = lights;
}

/// Lists the pixels of a square in which a piece is seen; in how many strips of rows these lie.
fn list_seen(
    listed: &mut Listed,
    square: &Square,
    spans: &Spans,
    piece: &Piece,
    band: &Band,
) -> u64 {
    listed.clear();
    let [left, top] = square.first().map(|first| first as f32);
    let (mut strips, mut last) = (0, None);
    for (row, span) in spans.within(&band.rows) {
        let x = left + (span.start - square.place[0]) as i32 as f32;
        let y = top + (row - square.place[1]) as i32 as f32;
        let pixels = band.index(span.start, row)..band.index(span.end, row);
        let before = listed.count();
        if band.triangles.is_empty() {
            listed.extend([x, y], pixels, |_| true);
        } else {
            let ids = &band.triangles[pixels.clone()];
            listed.extend([x, y], pixels, |pixel| face(ids[pixel]) == face(piece.id));
        }
        if listed.count() > before && last.replace(row / MAX_SIDE) != Some(row / MAX_SIDE) {
            strips += 1;
        }
    }
    strips
}

/// What shades a face, by the mode of its cuboid.
fn shader<'a>(
    list: &'a DrawList,
    object: &'a Object,
    face: &'a Face,
    lights: &'a mut Vec<FaceLight>,
    illumination: &'a Illumination,
    view: &View,
    lens: &Lens,
) -> Shader<'a> {
    let surface = Surface {
        material: &object.material,
        illumination,
        centre: object.centre,
    };
    let (eye, tolerance) = (lens.eye, view.tolerance);
    let solid = &object.solid;
    match object.mode {
        ShadingMode::Gouraud => Shader::Gouraud(Gouraud::new(face, &solid.colors, tolerance)),
        ShadingMode::Phong => {
            let gloss = &list.glosses[object.gloss];
            let normals = face.linear(&solid.normals, 0);
            lights.clear();
            let points = illumination.points.iter();
            lights.extend(
                points.filter_map(|light| FaceLight::new(face, &normals, &surface, light, eye)),
            );
            Shader::Phong(Phong::new(
                face, normals, surface, eye, gloss, lights, tolerance,
            ))
        }
        ShadingMode::UnitVectors => {
            let normals = face.linear(&solid.normals, 0);
            // w of the corners on the screen, where they have a place there.
            let depths = places(face.number).map(|place| {
                let corner = face.from_eye(place);
                let seen = DVec3::from_array(lens.axes.map(|axis| axis.dot(corner)));
                (seen.z >= lens.near).then(|| lens.homogeneous(seen).z)
            });
            Shader::UnitVectors(UnitVectors {
                face,
                surface,
                eye,
                backward: (lens.projection == Projection::Orthographic).then(|| -lens.axes[2]),
                triangles: [0, 1]
                    .map(|second| unit_vectors::Triangle::new(face, &normals, second, depths)),
                gloss: &list.glosses[object.gloss],
                power: list.glosses[object.gloss].every,
            })
        }
    }
}

/// Clears the rows of a strip that are in a band, and writes the id of the piece seen at each pixel, if the band keeps ids.
#[inline(always)]
fn prepare(list: &DrawList, strip: usize, rows: &Range<usize>, band: &mut Band, lens: &Lens) {
    let deep = !band.depths.is_empty();
    let pieces = || {
        let indices = list.strips[strip].iter();
        indices.map(|&index| &list.pieces[index as usize])
    };
    if !deep {
        for piece in pieces() {
            for (row, span) in list.spans(piece).within(rows) {
                band.will_draw(row, span.start, span.end);
            }
        }
    }
    band.clear(rows.clone());
    if band.triangles.is_empty() {
        return;
    }
    for piece in pieces() {
        for (row, span) in list.spans(piece).within(rows) {
            let first = band.index(span.start, row);
            let pixels = first..first + span.len();
            let ids = &mut band.triangles[pixels.clone()];
            if deep {
                band.drawn[row - band.rows.start].drew(span.start, span.end);
                let place = [
                    span.start as f64 + 0.5 - lens.half[0],
                    row as f64 + 0.5 - lens.half[1],
                ];
                see(piece, place, &mut band.depths[pixels], ids);
            } else {
                ids.fill(piece.id);
            }
        }
    }
}

/// Enters a span of a piece into the depth buffer wherever it is nearest; `place` is its first pixel, from the picture's
/// middle.
#[inline(always)]
fn see(piece: &Piece, [left, y]: [f64; 2], depths: &mut [f64], ids: &mut [u32]) {
    let [least, most] = piece.range;
    let Affine { centre, dx, dy } = piece.nearness;
    let start = centre + dy * y;
    let mut x = left;
    for (old, id) in depths.iter_mut().zip(ids) {
        let new = start + dx * x;
        // One instruction each; what is not a number becomes the least.
        let new = if new > least { new } else { least };
        let new = if new < most { new } else { most };
        if new - *old > DEPTH_TIE * old.abs() {
            (*old, *id) = (new, piece.id);
        }
        x += 1.0;
    }
}

/// A piece being drawn.
struct Drawing<'a, 'b> {
    shader: Shader<'a>,
    spans: Spans<'a>,
    /// Of its first triangle.
    id: u32,
    /// The picture's middle, in pixels from its corner.
    picture: [f64; 2],
    /// As how many tiles a listed square counts.
    strips: u64,
    band: &'a mut Band<'b>,
    scratch: &'a mut Scratch,
    counts: &'a mut Counts,
}

impl Drawing<'_, '_> {
    /// Draws all of it that is in the band.
    fn draw<S: Simd>(&mut self, simd: S) {
        let rows = self.band.held(self.spans.rows());
        for row in (rows.start / MAX_SIDE * MAX_SIDE..rows.end).step_by(MAX_SIDE) {
            let (extent, common) = self.spans.extents(row..row + MAX_SIDE);
            for column in (extent.start / MAX_SIDE * MAX_SIDE..extent.end).step_by(4 * MAX_SIDE) {
                let square = |index| {
                    let place = [column + index * MAX_SIDE, row];
                    if extent.end <= place[0] {
                        Square::default()
                    } else if common.start <= place[0] && place[0] + MAX_SIDE <= common.end {
                        Square::whole(place, MAX_SIDE)
                    } else {
                        Square::new(&self.spans, place, MAX_SIDE)
                    }
                };
                self.squares(simd, &[square(0), square(1), square(2), square(3)]);
            }
        }
    }

    /// Draws four squares: interpolated where that keeps the tolerance, else as four squares each, or pixel by pixel where
    /// they are small or their quarters promise no more.
    fn squares<S: Simd>(&mut self, simd: S, squares: &[Square; 4]) {
        let seen = squares.each_ref().map(|square| self.is_seen(square));
        if !seen.contains(&true) {
            return;
        }
        let effort = self.shader.effort(squares[0].side);
        let places = Places::new(simd, squares, self.picture);
        let prepared = self.shader.prepare(simd, &places, effort, self.scratch);
        let mut cut = [false; 4];
        for (index, square) in squares.iter().enumerate() {
            if !seen[index] {
                continue;
            }
            if let Some(interpolant) = &prepared.interpolant
                && let Some(form) = interpolant.forms[index]
            {
                self.interpolated(simd, square, interpolant, index, form);
            } else {
                let promising = prepared.promising >> index & 1 == 1;
                cut[index] = effort == Effort::Quarters && promising
                    || !self.evaluated(simd, square, Some(index));
            }
        }
        // Last, for what is known of these squares goes with it.
        for (index, square) in squares.iter().enumerate() {
            if cut[index] {
                self.squares(simd, &square.quarters(&self.spans));
            }
        }
    }

    /// Draws one of the squares of an interpolant.
    fn interpolated<S: Simd>(
        &mut self,
        simd: S,
        square: &Square,
        interpolant: &Interpolant<S>,
        index: usize,
        form: Form,
    ) {
        let mut store = Store::new(self.band, &self.spans, square, self.id);
        outlined!(
            simd,
            interpolation::draw(simd, interpolant, index, form, square, &mut store)
        );
        self.counts.covered_pixels += store.finish(form.kind, &self.shader, self.picture);
        self.counts.tiles[form.kind as usize] += 1;
    }

    /// Draws what is listed of a square.
    fn listed<S: Simd>(&mut self, simd: S, square: &Square) {
        let [x, y] = square.middle();
        let middle = [x - self.picture[0], y - self.picture[1]];
        let places = Places::single(simd, middle, square.half());
        self.shader
            .prepare(simd, &places, Effort::Pixels, self.scratch);
        self.evaluated(simd, square, None);
    }

    /// Draws a square, or what is listed of it where it has no index, pixel by pixel; whether that can be done in lanes, or
    /// is done without where the square is small.
    fn evaluated<S: Simd>(&mut self, simd: S, square: &Square, index: Option<usize>) -> bool {
        let listed = index.is_none();
        let region = Region {
            square,
            spans: &self.spans,
            picture: self.picture,
            listed,
        };
        let index = index.unwrap_or(0);
        let evaluations = match self.shader.evaluate(simd, &region, index, self.scratch) {
            None if square.side > MIN_SIDE => return false,
            None => {
                let levels = &mut self.scratch.levels;
                levels.fill_each(&region, |[x, y]| self.shader.define(x, y));
                let pixels = square.pixels as u64;
                Evaluations {
                    kind: TileKind::Double,
                    model: pixels,
                    specular: pixels * self.shader.powers() as u64,
                }
            }
            Some(evaluations) => evaluations,
        };
        let mut store = Store::new(self.band, &self.spans, square, self.id);
        let levels = &self.scratch.levels;
        outlined!(simd, {
            if listed {
                store.draw_listed(simd, &levels.listed);
            } else {
                store.draw(&mut Evaluated::new(simd, levels));
            }
        });
        self.counts.covered_pixels += store.finish(evaluations.kind, &self.shader, self.picture);
        self.counts.model_evaluations += evaluations.model;
        self.counts.specular_evaluations += evaluations.specular;
        self.counts.tiles[evaluations.kind as usize] += self.strips;
        true
    }

    /// Whether any pixel of a square is drawn here: in this band, and not hidden.
    fn is_seen(&self, square: &Square) -> bool {
        let rows = self.band.held(square.covered_rows());
        if square.pixels == 0 || rows.is_empty() {
            return false;
        }
        if self.band.depths.is_empty() {
            return true;
        }
        self.spans.clipped(rows, square.columns).any(|(row, span)| {
            let first = self.band.index(0, row);
            !span.is_empty()
                && self.band.triangles[first + span.start..first + span.end]
                    .iter()
                    .any(|id| face(*id) == face(self.id))
        })
    }
}
