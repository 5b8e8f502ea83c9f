//! Draws a face as a quadtree of squares, each by the cheapest evaluation that keeps the tolerance. A flat face is filled.
//!
//! The evaluation is chosen from all pixels of a square that the face covers, including those that are hidden or in another
//! band, so the choice does not depend on the number of threads.

use fearless_simd::{Level, Simd};

use super::canvas::Canvas;
use crate::components::ShadingMode;
use crate::shading::face::Face;
use crate::shading::gouraud::{Gouraud, GridSquares, Source};
use crate::shading::moving::Extents;
use crate::shading::phong::{FaceLight, Phong};
use crate::shading::simd::{dispatch, four, outlined};
use crate::shading::square::{MAX_SIDE, MIN_SIDE, Square};
use crate::shading::{Scratch, Shader, SquareKind, Surface};
use crate::systems::frame::{Band, DrawList, Piece};

/// The least number of pixels of four squares for which bounds are computed. Bounds cost as much as the evaluation of about 500
/// pixels, and may fail. Without this limit the default scene at 120x90 takes 30 % more time, a scene of 18 lights and 7 cuboids
/// at 220x220 5 % more, and large pictures the same time (Phong, tolerance 0.5, one thread).
const WORTHWHILE: usize = 512;

impl DrawList {
    /// Draws the pixels of a band in which a piece is seen.
    pub fn shade(&self, level: Level, piece: &Piece, band: &mut Band, scratch: &mut Scratch) {
        let Scratch {
            lights,
            cells,
            pixels: listed,
            counts,
            ..
        } = scratch;
        let spans = self.spans(piece);
        // A piece that fits into the smallest square is drawn as one.
        let small = Square::around(&spans);
        let mut canvas = Canvas {
            band,
            spans,
            face_id: piece.id.face_id(),
            tolerance: self.tolerance,
            listed,
            counts,
        };
        if let Some(square) = &small {
            dispatch!(level, simd => canvas.list(simd, square));
            if canvas.listed.count == 0 {
                return;
            }
        }
        let object = &self.objects[piece.object];
        let face = Face::new(&piece.plane, &object.transform, object.half, &self.rays);
        if object.mode == ShadingMode::Flat {
            return canvas.fill(piece.corners[0], &face);
        }
        let shader = &mut self.shader(piece, &face, lights, cells);
        dispatch!(level, simd => match &small {
            Some(square) => {
                shader.prepare_pixels(simd, &Extents::of_one(simd, square, &self.rays.lens));
                let kind = canvas.draw_listed(simd, shader, 0, square);
                canvas.counts.add(kind, canvas.strips(), canvas.listed.count);
                canvas.mark(square, kind, &face);
            }
            None => canvas.draw_face(simd, shader),
        });
    }

    /// The shader of a face, by the mode of its cuboid.
    fn shader<'a>(
        &'a self,
        piece: &'a Piece,
        face: &'a Face,
        lights: &'a mut Vec<FaceLight>,
        cells: &'a mut GridSquares,
    ) -> Shader<'a> {
        let object = &self.objects[piece.object];
        let (material, centre) = (&object.material, object.transform.position);
        let surface = Surface {
            plane: object.has_face_normals.then_some(&piece.plane),
            ..Surface::new(material, &self.illumination, centre)
        };
        let (corners, tolerance) = (&piece.corners, self.tolerance);
        match object.mode {
            // A flat face is filled before; Gouraud between equal levels is the same.
            ShadingMode::Flat | ShadingMode::Gouraud => {
                let source = match piece.grid {
                    Some(grid) => Source::Grid(self.grids.get(grid, surface), cells),
                    None => Source::Corners(corners),
                };
                Shader::Gouraud(Gouraud::new(face, source, tolerance))
            }
            ShadingMode::UnitVectors | ShadingMode::BlinnPhong => {
                unreachable!("`systems::draw` refuses what the reference alone draws")
            }
            ShadingMode::Phong => {
                let gloss = &object.gloss;
                Shader::Phong(Phong::new(
                    face,
                    face.interpolate(corners, 0),
                    surface,
                    gloss,
                    lights,
                    tolerance,
                ))
            }
        }
    }
}

impl Canvas<'_, '_> {
    /// Draws all of the piece that is in the band.
    fn draw_face<S: Simd>(&mut self, simd: S, shader: &mut Shader) {
        let rows = self.band.held(self.spans.rows());
        for row in (rows.start / MAX_SIDE * MAX_SIDE..rows.end).step_by(MAX_SIDE) {
            let (extent, common) = self.spans.columns(row..row + MAX_SIDE);
            for column in (extent.start / MAX_SIDE * MAX_SIDE..extent.end).step_by(4 * MAX_SIDE) {
                let squares = four!(|index| {
                    let corner = [column + index * MAX_SIDE, row];
                    if extent.end <= corner[0] {
                        Square::default()
                    } else if common.start <= corner[0] && corner[0] + MAX_SIDE <= common.end {
                        Square::whole(corner, MAX_SIDE)
                    } else {
                        Square::new(&self.spans, corner, MAX_SIDE)
                    }
                });
                self.draw_squares(simd, shader, &squares);
            }
        }
    }

    /// Draws four squares. Each is interpolated if that keeps the tolerance and may be cheaper. Otherwise it is cut into
    /// quarters, or drawn pixel by pixel if it is small or its quarters cannot be cheaper.
    fn draw_squares<S: Simd>(&mut self, simd: S, shader: &mut Shader, squares: &[Square; 4]) {
        let seen = outlined!(simd, four!(|index| self.seen_pixels(&squares[index])));
        if seen == [0; 4] {
            return;
        }
        let covered: usize = squares.iter().map(|square| square.covered).sum();
        let interpolate = self.tolerance > 0.0 && covered >= WORTHWHILE;
        let lens = &shader.face().rays.lens;
        let extents = outlined!(simd, Extents::new(simd, squares, lens));
        let interpolant = if interpolate {
            outlined!(simd, shader.prepare(simd, &extents, true))
        } else {
            shader.prepare_pixels(simd, &extents);
            None
        };
        let mut cut = [false; 4];
        for (index, (square, seen)) in squares.iter().zip(seen).enumerate() {
            if seen == 0 {
                continue;
            }
            let kind = if let Some(interpolant) = &interpolant
                && let Some(kind) = interpolant.kinds[index]
            {
                outlined!(simd, {
                    if let Some(mut ramp) = interpolant.linear_rows(simd, index, square) {
                        self.draw(simd, square, seen, &mut ramp);
                    } else {
                        let mut curve = interpolant.quadratic_rows(simd, index, square);
                        self.draw(simd, square, seen, &mut curve);
                    }
                });
                kind
            } else if square.side > MIN_SIDE && (interpolate || !shader.in_f32(index)) {
                cut[index] = true;
                continue;
            } else {
                self.draw_exactly(simd, shader, index, square, seen)
            };
            self.counts.add(kind, 1, seen);
            self.mark(square, kind, shader.face());
        }
        // Last, because this overwrites what is prepared for the four squares.
        for (index, square) in squares.iter().enumerate() {
            if cut[index] {
                self.draw_squares(simd, shader, &square.quarters(&self.spans));
            }
        }
    }

    /// Draws the square at `index` of those prepared last pixel by pixel, by rows or from a list.
    fn draw_exactly<S: Simd>(
        &mut self,
        simd: S,
        shader: &Shader,
        index: usize,
        square: &Square,
        seen: usize,
    ) -> SquareKind {
        let is_whole = self.is_whole(square, seen);
        if is_whole && let Some(mut rows) = shader.rows(simd, square, index) {
            outlined!(simd, self.draw_whole(square, &mut rows));
        } else if is_whole && let Some(mut rows) = shader.grid_rows(simd, square, index) {
            outlined!(simd, self.draw_whole(square, &mut rows));
        } else {
            outlined!(simd, self.list(simd, square));
            return self.draw_listed(simd, shader, index, square);
        }
        shader.count(index, seen, self.counts)
    }

    /// Draws the listed pixels of the square at `index` of those prepared last.
    fn draw_listed<S: Simd>(
        &mut self,
        simd: S,
        shader: &Shader,
        index: usize,
        square: &Square,
    ) -> SquareKind {
        shader.evaluate(simd, square, index, self.listed);
        outlined!(simd, self.write_listed(simd));
        shader.count(index, self.listed.count, self.counts)
    }
}
