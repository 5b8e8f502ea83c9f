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
mod quadtree;
mod store;

use std::ops::Range;

use hecs::World;

use self::listing::Context;
use crate::components::{Lens, View};
use crate::frame::{Band, Counts, DrawList, Frame, Piece};
use crate::shading::affine::Affine;
use crate::shading::face::Rays;
use crate::shading::square::MAX_SIDE;
use crate::simd::dispatch;

/// Depths whose relative difference is smaller than this tie, and the cuboid earlier in the file wins. Without this rule
/// rounding would make coplanar faces flicker. Each face is compared with what is nearest so far, in the
/// order of the file; where one ties with two that do not tie with each other, that order decides which of the two is seen.
const DEPTH_TIE: f64 = 1e-11;

/// Draws every cuboid into the frame: lists the pixels of its faces, sorts the faces into strips of the picture, and in each
/// strip first compares depths, then shades.
pub fn run(world: &mut World, view: &View, frame: &mut Frame) {
    let (lens, illumination) = (frame.lens, std::mem::take(&mut frame.illumination));
    let context = Context {
        illumination: &illumination,
        view,
        lens: &lens,
        rays: &Rays::new(&lens),
    };
    let level = frame.workers().level();
    let mut list = frame.take_list();
    context.list(level, world, &mut list);
    list.sort(view.size[1]);
    frame.paint(view.background, list, |list, band, scratch| {
        let mut counts = Counts::default();
        for strip in band.rows.start / MAX_SIDE..band.rows.end.div_ceil(MAX_SIDE) {
            let rows = band.held(strip * MAX_SIDE..(strip + 1) * MAX_SIDE);
            dispatch!(level, _simd => compare(list, strip, &rows, band, &lens));
            for piece in list.strip(strip) {
                // Drawn once all of it in this band is compared.
                if band.held(list.spans(piece).rows()).end <= rows.end {
                    context.shade(level, list, piece, band, scratch, &mut counts);
                }
            }
        }
        counts
    });
    frame.illumination = illumination;
}

/// Clears the rows of a strip that are in a band, and writes the id of the piece seen at each pixel, if the band keeps ids.
#[inline(always)]
fn compare(list: &DrawList, strip: usize, rows: &Range<usize>, band: &mut Band, lens: &Lens) {
    let deep = !band.depths.is_empty();
    if !deep {
        for piece in list.strip(strip) {
            for (row, span) in list.spans(piece).within(rows) {
                band.will_draw(row, span.start, span.end);
            }
        }
    }
    band.clear(rows.clone());
    if band.triangles.is_empty() {
        return;
    }
    for piece in list.strip(strip) {
        for (row, span) in list.spans(piece).within(rows) {
            let pixels = band.index(span.start, row)..band.index(span.end, row);
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
