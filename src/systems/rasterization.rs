//! Draws projected polygons: finds the pixels that they cover, compares depths and shades the visible pixels.
//!
//! ```text
//!  polygons --scan conversion--> spans --quadtree--> squares of 32 or 16 pixels --shader--> rows of levels --display--> frame
//!                                  '-- of a face of at most 16 x 16 pixels: the visible pixels, one by one --'
//! ```
//! A pixel is covered if its centre is inside the snapped polygon, or on its top or left edge. The arithmetic is in integers
//! and exact, so each pixel along a shared edge is drawn once. Depths are compared only in strips of 32 rows in which faces
//! overlap, and then only visible faces and squares are shaded. A picture is cleared, compared in depth and shaded strip by
//! strip, so that a strip stays in a cache. Shading is set up from all the pixels that a face or square covers, so the bits of
//! a picture do not depend on threads, strips or the part of the picture that is drawn.

mod canvas;
mod listing;
mod quadtree;

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask32x8, mask64x8, u32x8};
use hecs::World;

use crate::components::{TriangleId, View};
use crate::shading::Scratch;
use crate::shading::affine::Affine;
use crate::shading::simd::{dispatch, inlined};
use crate::shading::square::MAX_SIDE;
use crate::systems::frame::{Band, DrawList, Frame, Piece};

/// Depths whose relative difference is smaller than this tie, and the cuboid earlier in the file wins. Without this rule
/// rounding would make coplanar faces flicker. Each face is compared with the nearest one so far, in the
/// order of the file. If a face ties with two others that do not tie with each other, that order decides which is visible.
const DEPTH_TIE: f64 = 1e-11;

/// The depth key of the background: less than that of any surface.
const FARTHEST: f64 = f64::MIN;

/// Draws every cuboid into the frame in four steps. Lists the faces and their pixels, and sorts them into strips of the
/// picture. Then, in each strip, compares depths and shades.
pub fn run(world: &mut World, view: &View, frame: &mut Frame) {
    let level = frame.workers().level();
    dispatch!(level, simd => frame.list.fill(simd, world, view));
    frame.list.sort(view.size[1]);
    frame.paint(view.background, |list, band, scratch| {
        for strip in band.rows.start / MAX_SIDE..band.rows.end.div_ceil(MAX_SIDE) {
            let rows = band.held(strip * MAX_SIDE..(strip + 1) * MAX_SIDE);
            dispatch!(level, simd => compare(simd, list, strip, &rows, band, scratch));
            for piece in list.strip(strip) {
                // A piece is shaded once, when all its strips in this band have been compared: only then is it known which
                // of its pixels are hidden. So pieces are not shaded in the order of the list.
                if band.held(list.spans(piece).rows()).end <= rows.end {
                    list.shade(level, piece, band, scratch);
                }
            }
        }
    });
}

/// Clears the rows of a strip, and writes the id of the visible piece at each pixel: where pieces overlap in the strip, or the frame
/// keeps ids.
#[inline(always)]
fn compare<S: Simd>(
    simd: S,
    list: &DrawList,
    strip: usize,
    rows: &Range<usize>,
    band: &mut Band,
    scratch: &mut Scratch,
) {
    let overlaps = find_overlap(list, strip, rows, band, &mut scratch.covered);
    band.clear(rows.clone(), overlaps);
    let depths = &mut scratch.depths;
    if overlaps {
        depths.resize(depths.len().max(rows.len() * band.width), FARTHEST);
    } else if band.levels.is_empty() {
        return;
    }
    let lens = &list.rays.lens;
    for piece in list.strip(strip) {
        let depth_key = piece.plane.depth_key(lens.projection);
        for (row, span) in list.spans(piece).within(rows) {
            let pixels = band.indices(row, &span);
            let ids = &mut band.triangles[pixels];
            if overlaps {
                let x = span.start as f64 + 0.5 - lens.middle[0];
                let y = row as f64 + 0.5 - lens.middle[1];
                let start = (row - rows.start) * band.width;
                let depths = &mut depths[start + span.start..start + span.end];
                write_nearest(simd, piece, &depth_key, [x, y], depths, ids);
                band.drawn[row - band.rows.start].drew(&span);
            } else {
                ids.fill(piece.id);
            }
        }
    }
}

/// Whether pieces overlap in a strip. Those of one cuboid do not. Records the pixels that will be drawn: all of them if there is no
/// overlap. `covered` is memory for a bit a pixel.
#[inline(always)]
fn find_overlap(
    list: &DrawList,
    strip: usize,
    rows: &Range<usize>,
    band: &mut Band,
    covered: &mut Vec<u64>,
) -> bool {
    let has_many_objects = list.objects.len() > 1;
    let words = band.width.div_ceil(64);
    covered.clear();
    if has_many_objects {
        covered.resize(rows.len() * words, 0);
    }
    let covered = covered.as_mut_slice();
    for piece in list.strip(strip) {
        for (row, span) in list.spans(piece).within(rows) {
            band.will_draw(row, &span, !has_many_objects);
            let first = (row - rows.start) * words;
            if has_many_objects && set_bits(&mut covered[first..first + words], span) {
                return true;
            }
        }
    }
    false
}

/// Sets the bits of a span in a row of pixels. Returns whether one of them was set.
#[inline(always)]
fn set_bits(row: &mut [u64], span: Range<usize>) -> bool {
    let [first, last] = [span.start, span.end - 1];
    let mut overlap = 0;
    for word in first / 64..=last / 64 {
        let mut bits = u64::MAX;
        if word == first / 64 {
            bits <<= first % 64;
        }
        if word == last / 64 {
            bits &= u64::MAX >> (63 - last % 64);
        }
        overlap |= row[word] & bits;
        row[word] |= bits;
    }
    overlap != 0
}

/// Writes a span of a piece into the depth buffer of a strip where it is nearest. Its first pixel is at `left`, `y` from the
/// middle of the picture. Where no id is set, the depth is that of an earlier strip, and counts as the farthest.
#[inline(always)]
fn write_nearest<S: Simd>(
    simd: S,
    piece: &Piece,
    Affine { centre, dx, dy }: &Affine<f64>,
    [left, y]: [f64; 2],
    depths: &mut [f64],
    ids: &mut [TriangleId],
) {
    let range = piece.range;
    let start = centre + dy * y;
    let splat = inlined!(|number: f64| f64x8::splat(simd, number));
    let mut x = splat(left) + f64x8::from_fn(simd, |lane| lane as f64);
    let (eights, depths) = depths.as_chunks_mut::<8>();
    let (id_eights, ids) = ids.as_chunks_mut::<8>();
    for (olds, ids) in eights.iter_mut().zip(id_eights) {
        let new = splat(start) + splat(*dx) * x;
        // NaN becomes the least.
        let new = new.simd_gt(range[0]).select(new, splat(range[0]));
        let new = new.simd_lt(range[1]).select(new, splat(range[1]));
        let old_ids = u32x8::simd_from(simd, ids.map(|id| id.0));
        let is_free =
            mask64x8::from_bitmask(simd, old_ids.simd_eq(TriangleId::NONE.0).to_bitmask());
        let old = is_free.select(splat(FARTHEST), f64x8::simd_from(simd, *olds));
        let nearer = (new - old).simd_gt(splat(DEPTH_TIE) * old.abs());
        *olds = *nearer.select(new, old);
        let nearer = mask32x8::from_bitmask(simd, nearer.to_bitmask());
        let new_ids = nearer.select(u32x8::splat(simd, piece.id.0), old_ids);
        *ids = new_ids.as_array().map(TriangleId);
        x += 8.0;
    }
    // The rest of the span, by the same operations.
    let mut x = x[0];
    for (old, id) in depths.iter_mut().zip(ids) {
        let new = start + dx * x;
        let new = if new > range[0] { new } else { range[0] };
        let new = if new < range[1] { new } else { range[1] };
        let is_free = *id == TriangleId::NONE;
        let depth = if is_free { FARTHEST } else { *old };
        if new - depth > DEPTH_TIE * depth.abs() {
            (*old, *id) = (new, piece.id);
        }
        x += 1.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_overlaps_another_exactly_if_they_share_a_pixel() {
        // They begin and end at the borders of words and beside them.
        let ends = [0, 1, 62, 63, 64, 65, 127, 128, 129, 190, 191, 192];
        let spans = ends.into_iter().flat_map(|from| ends.map(|to| from..to));
        let spans: Vec<Range<usize>> = spans.filter(|span| !span.is_empty()).collect();
        for one in &spans {
            for other in &spans {
                let mut row = [0; 3];
                assert!(!set_bits(&mut row, one.clone()));
                let both = (0..192).filter(|x| one.contains(x) && other.contains(x));
                let shares_pixels = both.count() > 0;
                assert_eq!(
                    set_bits(&mut row, other.clone()),
                    shares_pixels,
                    "{one:?} {other:?}"
                );
                for x in 0..192 {
                    let is_covered = one.contains(&x) || other.contains(&x);
                    assert_eq!(row[x / 64] >> (x % 64) & 1 == 1, is_covered, "{x}");
                }
            }
        }
    }
}
