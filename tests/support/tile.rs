//! One tile, shaded as the rasterizer shades it: with a polynomial where there is one, pixel by pixel elsewhere.

use shadetrade::shading::number::ABREAST;
use shadetrade::shading::patch::{Patch, Squares};
use shadetrade::shading::triangle::Triangle;
use shadetrade::shading::{Coverage, Scratch, Shader, Sink, TileKind};

/// Which of the tiles that are looked at together is shaded.
const INDEX: usize = 2;

/// Shades all of a tile into a sink; how it was done.
pub fn shade<S: Shader>(
    shader: &S,
    triangle: &Triangle,
    patch: &Patch,
    sink: &mut impl Sink,
) -> TileKind {
    let scratch = &mut Scratch::default();
    let tiles = Squares {
        places: [[0; 2]; ABREAST],
        covered: [Coverage::WHOLE; ABREAST],
        patches: [*patch; ABREAST],
        wanted: [patch.steady; ABREAST],
    };
    let survey = shader.survey(triangle, &tiles, scratch);
    if let Some(polynomial) = S::polynomial(&survey, INDEX) {
        sink.draw(&polynomial, patch.first(), &Coverage::WHOLE);
        return polynomial.kind;
    }
    shader
        .shade(triangle, &tiles, &survey, INDEX, scratch, sink)
        .kind
}
