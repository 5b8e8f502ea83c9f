//! Screen polygons in, shaded pixels out.
//!
//! ```text
//!  polygons --scan conversion--> spans --quadtree of 32 and 16 pixels--> squares --shader--> rows of levels --display step--> frame
//! ```
//! Rules: a pixel is covered if its centre is inside the snapped polygon, or on its top or left edge; the arithmetic is in
//! integers and exact, so pixels along a shared edge are drawn once. A depth buffer exists only while there is more than
//! one cuboid, and then only squares that are seen are shaded. Everything is made once a face and frame; squares are set up
//! from all they cover, so neither threads nor parts of a picture change a bit.

mod listing;
mod store;

use fearless_simd::Simd;
use hecs::World;

use self::listing::add;
use self::store::Store;
use crate::components::{
    FileOrder, Illumination, Lens, Material, Mesh, Normals, Projected, Projection, ShadingMode,
    VertexColors, View, WorldTransform,
};
use crate::frame::{Band, Counts, DrawList, Frame, Object, Piece, face};
use crate::shading::display::Evaluated;
use crate::shading::face::Solid;
use crate::shading::field::Places;
use crate::shading::gouraud::Gouraud;
use crate::shading::interpolation::{self, Form, Interpolant};
use crate::shading::phong::Phong;
use crate::shading::square::{MAX_SIDE, MIN_SIDE, Region, Spans, Square};
use crate::shading::unit_vectors::{self, UnitVectors};
use crate::shading::{Evaluations, Scratch, Shader, Sink, Surface, TileKind};
use crate::simd::{apart, dispatch};

/// Depths that differ by less than this share of themselves are a tie, which the cuboid earlier in the file wins.
const DEPTH_TIE: f64 = 1e-11;

/// So few pixels of a square are evaluated faster than an interpolant for them is found.
const FEW: usize = 24;

/// Draws every cuboid into the frame.
pub fn run(world: &mut World, view: &View, frame: &mut Frame) {
    let (lens, lights) = (frame.lens, std::mem::take(&mut frame.illumination));
    let illumination = &lights;
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
            mode: view.shading.unwrap_or(*own),
            gloss: 0,
        };
        let solid = Solid {
            centre: place.position - lens.eye,
            axes: place.axes,
            half: mesh.corners[7],
            normals: &normals.0,
            colors: &colors.0,
        };
        add(
            &mut list,
            object,
            &solid,
            projected,
            illumination,
            view,
            &lens,
        );
    }
    // Where depths tie the piece listed first is seen, so the file decides, and not the order in which hecs iterates.
    let in_file = |piece: &Piece| (piece.id, piece.spans.start);
    list.pieces.sort_unstable_by_key(in_file);
    let level = frame.workers().level();
    frame.paint(view.background, list, |list, band, scratch| {
        dispatch!(level, _simd => prepare(list, band, &lens));
        let mut counts = Counts::default();
        for piece in &list.pieces {
            let spans = list.spans(piece);
            if band.held(spans.rows()).is_empty() {
                continue;
            }
            let shader = shader(list, piece, illumination, view, &lens);
            let mut drawing = Drawing {
                spans,
                id: piece.id,
                picture: lens.half,
                few: if shader.interpolates() {
                    FEW
                } else {
                    usize::MAX
                },
                shader,
                band,
                scratch,
                counts: &mut counts,
            };
            dispatch!(level, simd => drawing.draw(simd));
        }
        counts
    });
    frame.illumination = lights;
}

/// What shades a piece: the one place where the mode is asked.
fn shader<'a>(
    list: &'a DrawList,
    piece: &'a Piece,
    illumination: &'a Illumination,
    view: &View,
    lens: &Lens,
) -> Shader<'a> {
    let object = &list.objects[piece.object];
    let surface = Surface {
        material: &object.material,
        illumination,
        centre: object.centre,
    };
    let (face, eye, tolerance) = (&piece.face, lens.eye, view.tolerance);
    match object.mode {
        ShadingMode::Gouraud => Shader::Gouraud(Gouraud { face, tolerance }),
        ShadingMode::Phong => {
            let gloss = &list.glosses[object.gloss];
            let lights = &list.lights[piece.lights.clone()];
            Shader::Phong(Phong::new(face, surface, eye, gloss, lights, tolerance))
        }
        ShadingMode::UnitVectors => {
            let number = (piece.id % 12 / 2) as usize;
            Shader::UnitVectors(UnitVectors {
                face,
                surface,
                eye,
                backward: (lens.projection == Projection::Orthographic).then(|| -lens.axes[2]),
                triangles: [0, 1]
                    .map(|second| unit_vectors::Triangle::new(face, number, second, piece.depths)),
                gloss: &list.glosses[object.gloss],
                power: list.glosses[object.gloss].every,
            })
        }
    }
}

/// Clears a band, and finds what is seen of each piece where the band has room to say so.
#[inline(always)]
fn prepare(list: &DrawList, band: &mut Band, lens: &Lens) {
    let deep = !band.depths.is_empty();
    let rows = band.rows.clone();
    if !deep {
        for piece in &list.pieces {
            for (row, span) in list.spans(piece).within(&rows) {
                band.announce(row, span.start, span.end);
            }
        }
    }
    band.clear();
    if band.triangles.is_empty() {
        return;
    }
    for piece in &list.pieces {
        for (row, span) in list.spans(piece).within(&rows) {
            let first = band.index(span.start, row);
            let pixels = first..first + span.len();
            let ids = &mut band.triangles[pixels.clone()];
            let place = [
                span.start as f64 + 0.5 - lens.half[0],
                row as f64 + 0.5 - lens.half[1],
            ];
            if deep {
                band.drawn[row - rows.start].touch(span.start, span.end);
                see(piece, place, &mut band.depths[pixels], ids);
            } else {
                for (id, x) in ids.iter_mut().zip(0..) {
                    *id = piece.triangle(place[0] + f64::from(x), place[1]);
                }
            }
        }
    }
}

/// Enters a span of a piece into the depth buffer wherever it is nearest; `place` is its first pixel, from the picture's
/// middle.
#[inline(always)]
fn see(piece: &Piece, [left, y]: [f64; 2], depths: &mut [f64], ids: &mut [u32]) {
    let plane = piece.face.nearness();
    let [least, most] = piece.nearness;
    for ((old, id), x) in depths.iter_mut().zip(ids).zip(0..) {
        let x = left + f64::from(x);
        let new = plane.at(x, y).max(least).min(most);
        let nearer = new - *old > DEPTH_TIE * old.abs();
        *old = if nearer { new } else { *old };
        *id = if nearer { piece.triangle(x, y) } else { *id };
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
    /// Squares of at most so many pixels are evaluated at once.
    few: usize,
    band: &'a mut Band<'b>,
    scratch: &'a mut Scratch,
    counts: &'a mut Counts,
}

impl Drawing<'_, '_> {
    /// Draws all of it that is in the band.
    fn draw<S: Simd>(&mut self, simd: S) {
        if let Some(square) = Square::around(&self.spans) {
            if self.is_seen(&square) {
                self.evaluated(simd, &square);
            }
            return;
        }
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
    /// they are small or hold few pixels.
    fn squares<S: Simd>(&mut self, simd: S, squares: &[Square; 4]) {
        let seen = squares.each_ref().map(|square| self.is_seen(square));
        let tried = squares.each_ref().map(|square| square.pixels > self.few);
        let interpolant = if (0..4).any(|index| seen[index] && tried[index]) {
            let places = Places::new(simd, squares, self.picture);
            self.shader.interpolate(simd, &places)
        } else {
            None
        };
        for (index, square) in squares.iter().enumerate() {
            if !seen[index] {
                continue;
            }
            if tried[index]
                && let Some(interpolant) = &interpolant
                && let Some(form) = interpolant.forms[index]
            {
                self.interpolated(simd, square, interpolant, index, form);
            } else if square.side > MIN_SIDE && tried[index] {
                self.squares(simd, &square.quarters(&self.spans));
            } else {
                self.evaluated(simd, square);
            }
        }
    }

    /// Draws one of the squares of an interpolant: as its quarters where the colour is too curved for linear rows.
    fn interpolated<S: Simd>(
        &mut self,
        simd: S,
        square: &Square,
        interpolant: &Interpolant<S>,
        index: usize,
        form: Form,
    ) {
        if form.kind == TileKind::Quadratic && square.side > MIN_SIDE {
            let quarters = square.quarters(&self.spans);
            let interpolant = apart(
                simd,
                #[inline(always)]
                || interpolant.on_quarters(index, square, &quarters),
            );
            for (index, quarter) in quarters.iter().enumerate() {
                if !self.is_seen(quarter) {
                    continue;
                }
                match interpolant.forms[index] {
                    Some(form) => self.interpolated(simd, quarter, &interpolant, index, form),
                    None => self.evaluated(simd, quarter),
                }
            }
            return;
        }
        let mut store = Store::new(self.band, &self.spans, square, self.id);
        apart(
            simd,
            #[inline(always)]
            || interpolation::draw(simd, interpolant, index, form, square, &mut store),
        );
        self.counts.covered_pixels += store.finish(form.kind);
        self.counts.tiles[form.kind as usize] += 1;
    }

    /// Draws a square pixel by pixel, or its quarters where that cannot be done in lanes.
    fn evaluated<S: Simd>(&mut self, simd: S, square: &Square) {
        let region = Region {
            square,
            spans: &self.spans,
            picture: self.picture,
        };
        let evaluations = match self.shader.evaluate(simd, &region, self.scratch) {
            None if square.side > MIN_SIDE => {
                return self.squares(simd, &square.quarters(&self.spans));
            }
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
        let mut rows = Evaluated::new(simd, &self.scratch.levels);
        apart(
            simd,
            #[inline(always)]
            || store.draw(&mut rows),
        );
        self.counts.covered_pixels += store.finish(evaluations.kind);
        self.counts.model_evaluations += evaluations.model;
        self.counts.specular_evaluations += evaluations.specular;
        self.counts.tiles[evaluations.kind as usize] += 1;
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
