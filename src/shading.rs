//! Shading of a face: the methods, the illumination model, and the evaluation of squares of pixels within a tolerance.
//!
//! A face is drawn in squares of 32 x 32 pixels, each by the cheapest way whose error is proven to stay within the tolerance.
//! A face that fits into 16 x 16 pixels is evaluated at every pixel. So are squares with few pixels, and all at tolerance 0.
//!
//! ```text
//! draw(square):
//!     classify each light: is n.l > 0 all over the square, n.l <= 0 all over, or neither? is its highlight visible?
//!     if there are enough pixels, and the bounds on all interpolation and rounding errors add up to less than the tolerance:
//!         evaluate the model at nine nodes; draw the biquadratic polynomial through them, without terms that are negligible
//!         (of one light n.l, or the logarithm of its highlight, is a polynomial of its own)
//!     else if the square is larger than 16 x 16 pixels, and either bounds were computed or f32 is too coarse:
//!         draw each quarter
//!     else:
//!         evaluate the model at every pixel, in f32 where its rounding error keeps the tolerance, else in f64
//!         evaluate a pixel again in f64 if f32 cannot decide the sign of n.l, or if |s| < 1/256 and 0 < rho < 1
//! ```
//! A polynomial is drawn only if this holds in each channel, in levels; each term is bounded in the file beside it:
//!
//! ```text
//! tolerance >=   sum over diffuse lights of the interpolation error of n.l                 bound
//!              + sum over the highlights drawn of the interpolation error of s^rho,
//!                or of its error from that of its logarithm                                bound
//!              + sum over the highlights left out of their largest s^rho                   bound, phong
//!              + 25/9 times the rounding error of a sample                                 rounding, interpolation
//!              + the rounding error of a row, and the polynomial's terms that are left out  interpolation
//! ```
//! | question | files |
//! |---|---|
//! | What is the model at a point? | `surface`, [`specular`], [`display`] (levels to bytes) |
//! | How do quantities change across a face? | [`affine`], [`face`] |
//! | How is a mode evaluated? | `shader` chooses: [`phong`], [`gouraud`] with the cells of [`grid`]; flat is Gouraud with one colour |
//! | Why is the error within the tolerance? | [`moving`], [`bound`], [`gloss`], [`rounding`], [`interpolation`] |
//! | Which pixels, and in which lanes? | [`square`], [`lanes`], [`rows`], [`listed`], [`simd`] |
//! | Where is a pixel written? | `draw` of `systems/rasterization/canvas.rs`, and [`listed`] for pixels that are evaluated one by one |
//! | Which methods are compared? | `method` |
//!
//! Terms: a *node* is one of the nine points of a square at which the model is sampled. A *terminator* is a line on which
//! n.l of a light is 0. A *highlight* is the term of a light with s^rho, s = o.r. A *sliver* is a face so thin on the
//! screen that the centre of a covered pixel may lie outside it by more than 1/128 of its size. The cause is snapping,
//! which moves a vertex by up to 1/512 pixel along each axis. Such a pixel shows the nearest point of the face, or the far
//! end if its line of sight passes beyond that.
//!
//! A face is set up in f64 from unsnapped corners. f32 is used only where its rounding error is bounded below the
//! tolerance. The tolerance holds for levels before they are rounded to bytes. The bounds do not count roundings of f64:
//! docs/limits.md says where these exceed a tolerance.

pub mod affine;
pub mod bound;
pub mod display;
pub mod face;
pub mod gloss;
pub mod gouraud;
pub mod grid;
pub mod interpolation;
pub mod lanes;
pub mod listed;
mod method;
pub mod moving;
pub mod phong;
pub mod rounding;
pub mod rows;
#[cfg(test)]
mod running;
mod shader;
pub mod simd;
pub mod specular;
pub mod square;
mod surface;

pub use self::method::{METHODS, Method, methods};
pub use self::shader::{Scratch, Shader};
pub use self::surface::Surface;

use std::ops::AddAssign;

use serde::Serialize;

/// Unit round-off of f32: half the distance from 1 to the next float.
pub(crate) const U: f64 = 5.960_464_477_539_063e-8;

/// The largest error at tolerance 0, in levels.
pub const LIMIT_0: f64 = 0.05;

/// The largest permitted error of a pixel, in levels: the tolerance, or [`LIMIT_0`] where that is 0.
pub(crate) fn limit(tolerance: f64) -> f64 {
    if tolerance > 0.0 { tolerance } else { LIMIT_0 }
}

/// How a square was drawn, from the cheapest to the most expensive way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SquareKind {
    /// A colour linear in x and y, proven.
    Linear,
    /// A biquadratic colour, proven.
    Quadratic,
    /// A biquadratic colour plus max(0, n.l) of one light, n.l being another biquadratic; proven.
    Terminator,
    /// A biquadratic colour plus s^rho of one light, log2(s^rho) being another biquadratic; proven.
    Highlight,
    /// Every pixel by itself, in f32; in f64 where f32 does not suffice.
    PerPixel,
    /// Every pixel by itself, in f64.
    InF64,
}

impl SquareKind {
    /// All of them, in order.
    pub const ALL: [SquareKind; 6] = {
        use SquareKind::{Highlight, InF64, Linear, PerPixel, Quadratic, Terminator};
        [Linear, Quadratic, Terminator, Highlight, PerPixel, InF64]
    };

    /// Its name in panels and reports.
    pub const fn name(self) -> &'static str {
        match self {
            SquareKind::Linear => "linear",
            SquareKind::Quadratic => "quadratic",
            SquareKind::Terminator => "terminator",
            SquareKind::Highlight => "highlight",
            SquareKind::PerPixel => "per pixel",
            SquareKind::InF64 => "per pixel in f64",
        }
    }
}

/// Counts of the work for one frame. They are the same for any number of threads. On another machine a few squares may be drawn in
/// another way, because another libm may round the limit of faint highlights ([`gloss`]) differently.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Pixels covered by a triangle.
    #[serde(skip)]
    pub covered_pixels: u64,
    /// Evaluations of the illumination model at vertices and pixels, without the samples of polynomials.
    pub model_evaluations: u64,
    /// Evaluations of a specular power there.
    pub specular_evaluations: u64,
    /// Squares drawn, by [`SquareKind`] in the order of [`SquareKind::ALL`]. A small face counts once in each strip of rows in
    /// which a pixel of it is seen, since the strips of a frame may belong to different threads.
    #[serde(skip)]
    pub squares: [u64; SquareKind::ALL.len()],
}

impl Counts {
    /// Adds squares of a kind, with this number of pixels in all.
    pub fn add(&mut self, kind: SquareKind, squares: u64, pixels: usize) {
        self.squares[kind as usize] += squares;
        if kind == SquareKind::Highlight {
            self.specular_evaluations += pixels as u64;
        }
        self.covered_pixels += pixels as u64;
    }
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        self.covered_pixels += other.covered_pixels;
        self.model_evaluations += other.model_evaluations;
        self.specular_evaluations += other.specular_evaluations;
        for (squares, more) in self.squares.iter_mut().zip(other.squares) {
            *squares += more;
        }
    }
}
