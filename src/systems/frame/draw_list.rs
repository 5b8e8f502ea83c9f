//! The list of one frame: its cuboids, and the pixels that their faces cover.
//!
//! The list is made once per frame, all threads read it, and its memory is reused for the next frame. Shaders of faces
//! are not part of it: they are made when a face is drawn, because only then is it known to be visible.

use std::ops::Range;

use glam::DVec3;

use crate::components::{Illumination, Material, ShadingMode, TriangleId, WorldTransform};
use crate::shading::face::{Plane, Rays};
use crate::shading::gloss::Gloss;
use crate::shading::grid::Grids;
use crate::shading::square::{MAX_SIDE, Spans};

/// Everything that is drawn in a frame.
#[derive(Debug, Default)]
pub(crate) struct DrawList {
    pub rays: Rays,
    /// The lights that are on.
    pub illumination: Illumination,
    /// In levels.
    pub tolerance: f64,
    /// In the order of drawing.
    pub pieces: Vec<Piece>,
    pub objects: Vec<Object>,
    /// The grids of the faces that have several segments.
    pub grids: Grids,
    /// For each strip of [`MAX_SIDE`] rows of the picture the indices of its pieces, in the order of drawing.
    pub strips: Vec<Vec<u32>>,
    /// The rows of the picture at which its bands end; see [`DrawList::cut`].
    pub cuts: Vec<usize>,
    /// The pixels from..to of each row of each piece.
    pub from: Vec<i32>,
    pub to: Vec<i32>,
}

/// The data of a cuboid that its shaders use.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Object {
    pub material: Material,
    pub transform: WorldTransform,
    /// Half its edges, in world units.
    pub half: DVec3,
    pub mode: ShadingMode,
    /// Whether each face has its own normal, and not those of the corners.
    pub has_face_normals: bool,
    pub gloss: Gloss,
}

/// A face, and the pixels that it covers.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    /// Its first triangle.
    pub id: TriangleId,
    /// Its index in [`DrawList::objects`].
    pub object: usize,
    /// The row of the picture of its first span, and the range of its spans in the list.
    pub row: usize,
    pub spans: Range<usize>,
    pub plane: Plane,
    /// The values that are interpolated, at its corners: levels under Gouraud shading, unit normals in world space otherwise.
    pub corners: [DVec3; 4],
    /// The index of its grid, if it is shaded with one.
    pub grid: Option<u32>,
    /// The least and the largest depth_key on the visible part of the face. Samples are clamped to it: snapping may put
    /// one just outside an edge-on face, where the depth_key of its plane is far off.
    pub range: [f64; 2],
}

impl DrawList {
    /// Removes the cuboids and their faces, and keeps their memory.
    pub fn clear(&mut self) {
        self.pieces.clear();
        self.objects.clear();
        self.strips.iter_mut().for_each(Vec::clear);
        self.from.clear();
        self.to.clear();
    }

    /// The pixels that a piece covers, by row.
    pub fn spans(&self, piece: &Piece) -> Spans<'_> {
        Spans {
            first: piece.row,
            from: &self.from[piece.spans.clone()],
            to: &self.to[piece.spans.clone()],
        }
    }

    /// Sorts the pieces into the order of drawing and into the strips of a picture with `height` rows.
    pub fn sort(&mut self, height: usize) {
        // If depths tie, the first piece is visible. So the file decides, not the order in which hecs iterates.
        self.pieces.sort_unstable_by_key(|piece| piece.id);
        self.strips.resize_with(height.div_ceil(MAX_SIDE), Vec::new);
        for (index, piece) in self.pieces.iter().enumerate() {
            let last = piece.row + piece.spans.len() - 1;
            for strip in &mut self.strips[piece.row / MAX_SIDE..=last / MAX_SIDE] {
                strip.push(index as u32);
            }
        }
    }

    /// The pieces in a strip, in the order of drawing.
    pub fn strip(&self, strip: usize) -> impl Iterator<Item = &Piece> {
        let indices = self.strips[strip].iter();
        indices.map(|&index| &self.pieces[index as usize])
    }

    /// Cuts these rows of the picture into bands: one, or with many threads several that have at least the work of
    /// [`BAND`] pixels each.
    pub fn cut(&mut self, rows: &Range<usize>, many_threads: bool) {
        self.cuts.clear();
        let mut work = 0;
        let strips = rows.start / MAX_SIDE..rows.end / MAX_SIDE;
        for strip in strips.filter(|_| many_threads) {
            let end = (strip + 1) * MAX_SIDE;
            let own = rows.start.max(end - MAX_SIDE)..end;
            for piece in self.strip(strip) {
                let spans = self.spans(piece);
                let covered = spans.within(&own);
                work += PIECE + covered.map(|(_, span)| span.len()).sum::<usize>();
            }
            if work >= BAND && end < rows.end {
                self.cuts.push(end);
                work = 0;
            }
        }
        self.cuts.push(rows.end);
    }
}

/// The least work of a band, in pixels that are interpolated: about 10 us.
const BAND: usize = 16_000;

/// The work of setting up a face, in such pixels.
const PIECE: usize = 1_000;

#[cfg(test)]
mod tests {
    use super::*;

    /// The cuts of some rows of a picture of 96 rows, in which a piece covers so many pixels of each.
    fn cuts(pixels: i32, rows: &Range<usize>, many_threads: bool) -> Vec<usize> {
        let piece = Piece {
            id: TriangleId(0),
            object: 0,
            row: 0,
            spans: 0..96,
            plane: Plane::default(),
            corners: [DVec3::ZERO; 4],
            grid: None,
            range: [0.0; 2],
        };
        let mut list = DrawList {
            pieces: vec![piece],
            from: vec![0; 96],
            to: vec![pixels; 96],
            ..DrawList::default()
        };
        list.sort(96);
        list.cut(rows, many_threads);
        list.cuts
    }

    #[test]
    fn a_band_has_whole_strips_and_at_least_its_work() {
        assert_eq!(cuts(1000, &(0..96), true), [32, 64, 96]);
        assert_eq!(cuts(1000, &(0..96), false), [96]);
        // 24 rows of the first strip have enough, 6 have not.
        assert_eq!(cuts(1000, &(40..70), true), [64, 70]);
        assert_eq!(cuts(1000, &(58..96), true), [96]);
        // 32 rows of 469 pixels are 15,008 pixels; setting up the face is the work of 1,000 more.
        assert_eq!(cuts(469, &(0..64), true), [32, 64]);
        assert_eq!(cuts(468, &(0..64), true), [64]);
    }
}
