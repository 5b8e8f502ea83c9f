//! Draws a face as a quadtree of squares, each by the cheapest evaluation that keeps the tolerance.
//!
//! The evaluation is chosen from all pixels of a square that the face covers, including those that are hidden or in another
//! band, so the choice does not depend on the number of threads.

use fearless_simd::{Level, Simd};
use glam::DVec3;

use super::listing::Context;
use super::store::Store;
use crate::components::ShadingMode;
use crate::frame::{Band, Counts, DrawList, Object, Piece};
use crate::shading::face::Face;
use crate::shading::field::Places;
use crate::shading::gouraud::Gouraud;
use crate::shading::interpolation;
use crate::shading::phong::{FaceLight, Phong};
use crate::shading::square::{MAX_SIDE, MIN_SIDE, Square};
use crate::shading::unit_vectors::UnitVectors;
use crate::shading::{Evaluations, Scratch, Shader, Surface};
use crate::simd::{dispatch, four, outlined};

impl Context<'_> {
    /// Draws the pixels of a band in which a piece is seen.
    pub fn shade(
        &self,
        level: Level,
        list: &DrawList,
        piece: &Piece,
        band: &mut Band,
        scratch: &mut Scratch,
        counts: &mut Counts,
    ) {
        let spans = list.spans(piece);
        let small = Square::around(&spans);
        let mut store = Store {
            band,
            spans,
            id: piece.id,
            square: small.unwrap_or_default(),
            drawn: 0,
        };
        // A piece that fits into the smallest square is drawn as one.
        let mut strips = 1;
        if small.is_some() {
            let pixels = &mut scratch.pixels;
            strips = dispatch!(level, simd => store.list(simd, pixels));
            store.square.pixels = pixels.count();
            if store.square.pixels == 0 {
                return;
            }
        }
        let object = &list.objects[piece.object];
        let face = Face::new((piece.id % 12 / 2) as usize, &object.solid, self.rays);
        let mut lights = std::mem::take(&mut scratch.lights);
        let mut to_lights = std::mem::take(&mut scratch.to_lights);
        let mut painter = PiecePainter {
            shader: self.shader(list, object, &face, &mut lights, &mut to_lights),
            picture: self.lens.half,
            store,
            scratch,
            counts,
        };
        dispatch!(level, simd => match &small {
            Some(_) => painter.small(simd, strips),
            None => painter.draw(simd),
        });
        painter.counts.covered_pixels += painter.store.drawn;
        (scratch.lights, scratch.to_lights) = (lights, to_lights);
    }

    /// The shader of a face, by the mode of its cuboid.
    fn shader<'a>(
        &'a self,
        list: &'a DrawList,
        object: &'a Object,
        face: &'a Face,
        lights: &'a mut Vec<FaceLight>,
        to_lights: &'a mut Vec<[DVec3; 4]>,
    ) -> Shader<'a> {
        let surface = Surface {
            material: &object.material,
            illumination: self.illumination,
            centre: object.centre,
        };
        let (corners, tolerance) = (&object.corners, self.view.tolerance);
        match object.mode {
            ShadingMode::Gouraud => Shader::Gouraud(Gouraud::new(face, corners, tolerance)),
            ShadingMode::Phong => {
                let (normals, gloss) = (face.interpolate(corners, 0), &list.glosses[object.gloss]);
                let phong = Phong::new(face, normals, surface, gloss, lights, tolerance);
                Shader::Phong(phong)
            }
            ShadingMode::UnitVectors => {
                let normals = face.interpolate(corners, 0);
                let vectors = UnitVectors::new(face, &normals, surface, self.lens, to_lights);
                Shader::UnitVectors(vectors)
            }
        }
    }
}

/// Draws one piece with its shader.
struct PiecePainter<'a, 'b> {
    shader: Shader<'a>,
    /// The picture's middle, in pixels from its corner.
    picture: [f64; 2],
    store: Store<'a, 'b>,
    scratch: &'a mut Scratch,
    counts: &'a mut Counts,
}

impl PiecePainter<'_, '_> {
    /// Draws all of it that is in the band.
    fn draw<S: Simd>(&mut self, simd: S) {
        let rows = self.store.band.held(self.store.spans.rows());
        for row in (rows.start / MAX_SIDE * MAX_SIDE..rows.end).step_by(MAX_SIDE) {
            let (extent, common) = self.store.spans.extents(row..row + MAX_SIDE);
            for column in (extent.start / MAX_SIDE * MAX_SIDE..extent.end).step_by(4 * MAX_SIDE) {
                let squares = four!(|index| {
                    let place = [column + index * MAX_SIDE, row];
                    if extent.end <= place[0] {
                        Square::default()
                    } else if common.start <= place[0] && place[0] + MAX_SIDE <= common.end {
                        Square::whole(place, MAX_SIDE)
                    } else {
                        Square::new(&self.store.spans, place, MAX_SIDE)
                    }
                });
                self.squares(simd, &squares);
            }
        }
    }

    /// Draws four squares. Each is interpolated if that keeps the tolerance. Otherwise it is cut into quarters, or drawn pixel
    /// by pixel if it is small or its quarters are unlikely to be cheaper.
    fn squares<S: Simd>(&mut self, simd: S, squares: &[Square; 4]) {
        let seen = squares.each_ref().map(|square| self.store.is_seen(square));
        if !seen.contains(&true) {
            return;
        }
        let places = Places::new(simd, squares, self.picture);
        let (interpolant, promising) = self.shader.prepare(simd, &places, true, self.scratch);
        let mut cut = [false; 4];
        for (index, square) in squares.iter().enumerate() {
            if !seen[index] {
                continue;
            }
            self.store.square = *square;
            if let Some(interpolant) = &interpolant
                && let Some(form) = interpolant.forms[index]
            {
                let store = &mut self.store;
                outlined!(
                    simd,
                    interpolation::draw(simd, interpolant, index, form, square, store)
                );
                let work = Evaluations {
                    kind: form.kind,
                    model: 0,
                    specular: 0,
                };
                self.finish(work, 1);
            } else {
                let promising = promising >> index & 1 == 1;
                cut[index] = square.side > MIN_SIDE && promising || !self.listed(simd, index);
            }
        }
        // Last, because this overwrites what is prepared for the four squares.
        for (index, square) in squares.iter().enumerate() {
            if cut[index] {
                self.squares(simd, &square.quarters(&self.store.spans));
            }
        }
    }

    /// Draws the only square of a small piece, whose pixels are listed and lie in `strips` strips.
    fn small<S: Simd>(&mut self, simd: S, strips: u64) {
        let square = &self.store.square;
        let places = Places::single(simd, square.middle_from(self.picture), square.half());
        self.shader.prepare(simd, &places, false, self.scratch);
        self.evaluated(simd, 0, strips);
    }

    /// Draws one of the four prepared squares pixel by pixel, by rows or from a list. Returns false, and draws nothing, if the
    /// square is to be cut into quarters.
    fn listed<S: Simd>(&mut self, simd: S, index: usize) -> bool {
        let PiecePainter {
            shader,
            store,
            scratch,
            ..
        } = self;
        let square = store.square;
        if store.is_whole()
            && let Some(evaluations) = shader.fill(simd, &square, index, scratch, store)
        {
            self.finish(evaluations, 1);
            return true;
        }
        let pixels = &mut scratch.pixels;
        let strips = outlined!(simd, store.list(simd, pixels));
        self.evaluated(simd, index, strips)
    }

    /// Draws the listed pixels of one of the four prepared squares and counts it as `tiles` tiles. Returns false, and draws
    /// nothing, if that may be cheaper for its quarters.
    fn evaluated<S: Simd>(&mut self, simd: S, index: usize, tiles: u64) -> bool {
        let store = &mut self.store;
        let evaluations =
            (self.shader).evaluate(simd, &store.square, self.picture, index, self.scratch);
        let Some(evaluations) = evaluations else {
            return false;
        };
        outlined!(simd, store.draw_pixels(simd, &self.scratch.pixels));
        self.finish(evaluations, tiles);
        true
    }

    /// Counts the work on the square as `tiles` tiles, and records its kind if the frame keeps that.
    fn finish(&mut self, work: Evaluations, tiles: u64) {
        self.counts.model_evaluations += work.model;
        self.counts.specular_evaluations += work.specular;
        self.counts.tiles[work.kind as usize] += tiles;
        if !self.store.band.kinds.is_empty() {
            self.store.mark(work.kind, self.shader.face(), self.picture);
        }
    }
}
