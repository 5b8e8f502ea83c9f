//! What one frame draws: faces, the lights that reach them, and the pixels they cover.
//!
//! Rule: all of it is made once a frame, read by every thread, and its memory kept for the next frame.

use std::ops::Range;

use glam::DVec3;

use crate::components::{Material, ShadingMode};
use crate::shading::face::Face;
use crate::shading::gloss::Gloss;
use crate::shading::phong::FaceLight;
use crate::shading::square::{MAX_SIDE, Spans};

/// The faces of a frame.
#[derive(Debug, Default)]
pub(crate) struct DrawList {
    /// What is drawn, in the order of drawing.
    pub pieces: Vec<Piece>,
    /// The lights of all faces, one face's after another's.
    pub lights: Vec<FaceLight>,
    pub objects: Vec<Object>,
    /// Of objects one after another with different materials.
    pub glosses: Vec<Gloss>,
    /// The pixels from..to of each row of each piece.
    pub from: Vec<i32>,
    pub to: Vec<i32>,
}

/// A cuboid as its pixels are shaded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Object {
    /// The number of its first triangle.
    pub id: u32,
    pub material: Material,
    /// Its centre, in world units.
    pub centre: DVec3,
    pub mode: ShadingMode,
    /// Which of the list's.
    pub gloss: usize,
}

/// A face, or one triangle of a face whose two do not meet on the screen, as snapped.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    pub face: Face,
    /// The number of its first triangle: cuboid * 12 + triangle.
    pub id: u32,
    /// Which of the list's.
    pub object: usize,
    pub lights: Range<usize>,
    /// The picture's row of its first span, and its spans.
    pub row: usize,
    pub spans: Range<usize>,
    /// The least and the most nearness of what is seen of the face. Samples are held to it: one that snapping put just
    /// outside an edge-on face would else be as near or as far as the face is steep.
    pub nearness: [f64; 2],
    /// w of the face's corners on the screen, where they have a place there.
    pub depths: [Option<f64>; 4],
}

impl Piece {
    /// The number of the triangle at a place from the picture's middle, in pixels.
    #[inline]
    pub fn triangle(&self, x: f64, y: f64) -> u32 {
        self.id + u32::from(self.face.diagonal.at(x, y) < 0.0)
    }
}

impl DrawList {
    /// Nothing, but the memory is kept.
    pub fn clear(&mut self) {
        self.pieces.clear();
        self.lights.clear();
        self.objects.clear();
        self.glosses.clear();
        self.from.clear();
        self.to.clear();
    }

    /// The pixels that a piece covers.
    pub fn spans(&self, piece: &Piece) -> Spans<'_> {
        Spans {
            first: piece.row,
            from: &self.from[piece.spans.clone()],
            to: &self.to[piece.spans.clone()],
        }
    }

    /// How many pixels all pieces cover.
    pub fn covered(&self) -> usize {
        let spans = self.from.iter().zip(&self.to);
        spans.map(|(from, to)| (to - from).max(0) as usize).sum()
    }

    /// The rows of a picture at which to cut it into so many parts of about the same work: where squares meet.
    pub fn cuts(&self, rows: &Range<usize>, parts: usize) -> Vec<usize> {
        let first = rows.start / MAX_SIDE;
        let mut work = vec![0; rows.end.div_ceil(MAX_SIDE) - first];
        for piece in &self.pieces {
            let spans = self.spans(piece);
            for (row, span) in spans.within(rows) {
                work[row / MAX_SIDE - first] += span.len();
            }
        }
        let share = work.iter().sum::<usize>() / parts + 1;
        let mut cuts = Vec::new();
        let mut done = 0;
        for (strip, work) in work.iter().enumerate().skip(1) {
            let (before, row) = (done, (first + strip) * MAX_SIDE);
            done += work;
            if before / share != done / share && row < rows.end {
                cuts.push(row);
            }
        }
        cuts
    }
}
