//! One tile, shaded as the rasterizer shades it: with a polynomial where one is all of its light, by its shader
//! elsewhere.

use shadetrade::shading::number::ABREAST;
use shadetrade::shading::patch::{Patch, Squares};
use shadetrade::shading::triangle::Triangle;
use shadetrade::shading::{Coverage, Scratch, Shader, Sink, TileKind};

/// Which of the tiles that are looked at together is shaded.
const INDEX: usize = 2;

/// Shades all of a tile into a sink; how it was done.
pub fn shade(
    shader: &impl Shader,
    triangle: &Triangle,
    patch: &Patch,
    sink: &mut impl Sink,
) -> TileKind {
    let scratch = &mut Scratch::default();
    let mut tiles = Squares {
        covered: [Coverage::WHOLE; ABREAST],
        patches: [*patch; ABREAST],
        wanted: [patch.steady; ABREAST],
        ..Squares::NONE
    };
    shader.certify_tiles(triangle, &mut tiles, scratch);
    if let Some(polynomial) = &tiles.polynomials[INDEX]
        && polynomial.is_whole()
    {
        sink.draw(&polynomial.placed(patch.first()), &Coverage::WHOLE);
        return polynomial.kind;
    }
    shader.shade(triangle, &tiles, INDEX, scratch, sink).kind
}
