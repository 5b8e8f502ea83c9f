//! The levels of a face's pixels: the methods, the illumination model, and the evaluation of squares of pixels.
//!
//! ```text
//! draw(square):
//!     classify the lights: each is dark, lit or crossing (n.l changes its sign) on the square, and shows a highlight or none
//!     if bounds on the interpolation errors of all lights add up to less than the tolerance:
//!         evaluate the model at nine nodes; draw the biquadratic through them, by the cheapest rows that the rest allows
//!     else if the square is larger than 16 x 16 pixels, and its quarters promise more or f32 does not suffice:
//!         draw each quarter
//!     else:
//!         evaluate the model at every pixel, in f32 where its rounding keeps the tolerance, in f64 elsewhere
//!         evaluate pixels again, in f64, where a highlight may jump and f32 has no sign of n.l or s
//! ```
//! [`phong`] classifies the lights, [`kernel`] evaluates nodes and pixels, [`bound`] bounds interpolation and [`rounding`]
//! rounding errors, [`interpolation`] chooses rows, [`rows`] fills them, and [`crate::systems::rasterization`] cuts squares.
//!
//! A terminator is a line in which n.l of a light is 0. Snapping moves a vertex by up to 1/512 pixel along each axis. On a
//! sliver, a face that is not steady, a pixel's centre can then lie more than 1/128 of the face outside it; its place is
//! clamped to the face.
//!
//! A face is set up in f64 from unsnapped corners. f32 is used only where its rounding error is bounded below the tolerance;
//! f64 stands behind everything. The tolerance holds for levels before they are rounded to bytes.

pub mod affine;
pub mod bound;
pub mod display;
pub mod face;
pub mod field;
pub mod gloss;
pub mod gouraud;
pub mod interpolation;
pub mod kernel;
pub mod lanes;
mod method;
pub mod phong;
pub mod pixels;
pub mod rounding;
pub mod rows;
#[cfg(test)]
mod running;
mod shader;
pub mod specular;
pub mod square;
mod surface;
pub mod unit_vectors;

pub use self::method::{METHODS, Method};
pub use self::shader::{Evaluations, Scratch, Shader};
pub use self::surface::Surface;

/// Unit round-off of f32: half the distance from 1 to the next float.
pub(crate) const U: f64 = 5.960_464_477_539_063e-8;

/// The largest error at tolerance 0, which the contract calls exact, in levels.
pub const EXACT: f64 = 0.05;

/// The largest permitted error of a pixel, in levels: the tolerance, or [`EXACT`] where that is 0.
pub(crate) fn limit(tolerance: f64) -> f64 {
    if tolerance > 0.0 { tolerance } else { EXACT }
}

/// How a square was drawn, from the simplest colour to the definition in f64.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TileKind {
    /// One colour, certified.
    Constant,
    /// A colour linear in x and y, certified.
    Linear,
    /// A biquadratic colour, certified.
    Quadratic,
    /// The same, and n.l of one light that is cut off at zero at every pixel.
    Terminator,
    /// The definition at every pixel within the tolerance, in f32; in f64 where a sign is in doubt.
    Exact,
    /// The definition at every pixel, in f64.
    Double,
}

impl TileKind {
    /// All of them, in order.
    pub const ALL: [TileKind; 6] = [
        TileKind::Constant,
        TileKind::Linear,
        TileKind::Quadratic,
        TileKind::Terminator,
        TileKind::Exact,
        TileKind::Double,
    ];

    /// The word panels and reports use.
    pub const fn name(self) -> &'static str {
        match self {
            TileKind::Constant => "constant",
            TileKind::Linear => "linear",
            TileKind::Quadratic => "quadratic",
            TileKind::Terminator => "terminator",
            TileKind::Exact => "exact",
            TileKind::Double => "exact in f64",
        }
    }
}
