//! A face in, its pixels drawn: a quadtree of squares, each by the cheapest evaluation that keeps the tolerance.
//!
//! Rule: squares are set up from all that the face covers of them, whatever part of that is seen or in the band.

use fearless_simd::{Level, Simd};
use glam::DVec3;

use super::listing::Context;
use super::store::Store;
use crate::components::ShadingMode;
use crate::frame::{Band, Counts, DrawList, Object, Piece, face};
use crate::shading::face::Face;
use crate::shading::field::Places;
use crate::shading::gouraud::Gouraud;
use crate::shading::interpolation::{self, Form, Interpolant};
use crate::shading::phong::{FaceLight, Phong};
use crate::shading::pixels::Pixels;
use crate::shading::square::{MAX_SIDE, MIN_SIDE, Spans, Square};
use crate::shading::unit_vectors::UnitVectors;
use crate::shading::{Scratch, Shader, Surface};
use crate::simd::{dispatch, outlined};

impl Context<'_> {
    /// Draws what a band shows of a piece.
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
        // What fits into the smallest square is drawn as one.
        let mut small = Square::around(&spans);
        let mut strips = 1;
        if let Some(square) = &mut small {
            let pixels = &mut scratch.pixels;
            strips =
                dispatch!(level, simd => list_seen(simd, pixels, square, &spans, piece.id, band));
            square.pixels = pixels.count();
            if square.pixels == 0 {
                return;
            }
        }
        let object = &list.objects[piece.object];
        let face = Face::new((piece.id % 12 / 2) as usize, &object.solid, self.rays);
        let (mut lights, mut to_lights) = (
            std::mem::take(&mut scratch.lights),
            std::mem::take(&mut scratch.to_lights),
        );
        let mut drawing = Drawing {
            shader: self.shader(list, object, &face, &mut lights, &mut to_lights),
            spans,
            id: piece.id,
            picture: self.lens.half,
            band,
            scratch,
            counts,
        };
        dispatch!(level, simd => match &small {
            Some(square) => drawing.small(simd, square, strips),
            None => drawing.draw(simd),
        });
        (scratch.lights, scratch.to_lights) = (lights, to_lights);
    }

    /// What shades a face, by the mode of its cuboid.
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
        let (solid, tolerance) = (&object.solid, self.view.tolerance);
        let normals = || face.linear(&solid.normals, 0);
        match object.mode {
            ShadingMode::Gouraud => Shader::Gouraud(Gouraud::new(face, &solid.colors, tolerance)),
            ShadingMode::Phong => {
                let gloss = &list.glosses[object.gloss];
                let eye = self.lens.eye;
                Shader::Phong(Phong::new(
                    face,
                    normals(),
                    surface,
                    eye,
                    gloss,
                    lights,
                    tolerance,
                ))
            }
            ShadingMode::UnitVectors => Shader::UnitVectors(UnitVectors::new(
                face,
                &normals(),
                surface,
                self.lens,
                to_lights,
            )),
        }
    }
}

/// Lists the pixels of a square in which a piece is seen; returns the number of strips in which these lie.
#[inline(always)]
fn list_seen<S: Simd>(
    simd: S,
    pixels: &mut Pixels,
    square: &Square,
    spans: &Spans,
    id: u32,
    band: &Band,
) -> u64 {
    pixels.clear();
    let [left, top] = square.first().map(|first| first as f32);
    let (mut strips, mut last) = (0, None);
    for (row, span) in spans.clipped(band.held(square.covered_rows()), square.columns) {
        if span.is_empty() {
            continue;
        }
        let x = left + (span.start - square.place[0]) as i32 as f32;
        let y = top + (row - square.place[1]) as i32 as f32;
        let indices = band.index(span.start, row)..band.index(span.end, row);
        let before = pixels.count();
        if band.triangles.is_empty() {
            pixels.extend(simd, [x, y], indices);
        } else {
            let ids = &band.triangles[indices.clone()];
            pixels.extend_seen([x, y], indices, |pixel| face(ids[pixel]) == face(id));
        }
        if pixels.count() > before && last.replace(row / MAX_SIDE) != Some(row / MAX_SIDE) {
            strips += 1;
        }
    }
    strips
}

/// A piece being drawn.
struct Drawing<'a, 'b> {
    shader: Shader<'a>,
    spans: Spans<'a>,
    /// Of its first triangle.
    id: u32,
    /// The picture's middle, in pixels from its corner.
    picture: [f64; 2],
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
        let places = Places::new(simd, squares, self.picture);
        let (interpolant, promising) = self.shader.prepare(simd, &places, true, self.scratch);
        let mut cut = [false; 4];
        for (index, square) in squares.iter().enumerate() {
            if !seen[index] {
                continue;
            }
            if let Some(interpolant) = &interpolant
                && let Some(form) = interpolant.forms[index]
            {
                self.interpolated(simd, square, interpolant, index, form);
            } else {
                let promising = promising >> index & 1 == 1;
                cut[index] =
                    square.side > MIN_SIDE && promising || !self.listed(simd, square, index);
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

    /// Draws the only square of a small piece, whose pixels are listed.
    fn small<S: Simd>(&mut self, simd: S, square: &Square, strips: u64) {
        let places = Places::single(simd, square.middle_from(self.picture), square.half());
        self.shader.prepare(simd, &places, false, self.scratch);
        self.evaluated(simd, square, 0, strips);
    }

    /// Lists the pixels of a square and draws them: see [`Drawing::evaluated`].
    fn listed<S: Simd>(&mut self, simd: S, square: &Square, index: usize) -> bool {
        let pixels = &mut self.scratch.pixels;
        let strips = outlined!(
            simd,
            list_seen(simd, pixels, square, &self.spans, self.id, self.band)
        );
        self.evaluated(simd, square, index, strips)
    }

    /// Draws the listed pixels of a square one by one; returns false where that may be cheaper on the quarters of the square.
    fn evaluated<S: Simd>(&mut self, simd: S, square: &Square, index: usize, strips: u64) -> bool {
        let evaluations = (self.shader).evaluate(simd, square, self.picture, index, self.scratch);
        let Some(evaluations) = evaluations else {
            return false;
        };
        let mut store = Store::new(self.band, &self.spans, square, self.id);
        outlined!(simd, store.draw_pixels(simd, &self.scratch.pixels));
        self.counts.covered_pixels += store.finish(evaluations.kind, &self.shader, self.picture);
        self.counts.model_evaluations += evaluations.model;
        self.counts.specular_evaluations += evaluations.specular;
        self.counts.tiles[evaluations.kind as usize] += strips;
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
