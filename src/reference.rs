//! The reference: the picture evaluated along one line of sight per pixel, in f64, f32 or intervals.
//!
//! The line through each pixel centre is intersected with the faces of the cuboids (`sight`, `geometry`), and the
//! illumination model is evaluated at the intersection (`illumination`). Nothing is rasterised or snapped.
//!
//! ```text
//!        eye . . . . . . +---------.          near plane: intersections before it do not count
//!           ` . pixel .  |          \
//!               ` . . .  * hit       \        place on the face -> normal, weights of three corners -> colour
//!                        +------------+
//! ```
//!
//! The reference shares the scene's data (`components`) with the renderer, but none of its code. Positions are
//! subtracted first (cuboid - eye, light - cuboid), so a scene a billion units from the origin loses no precision. Each
//! cuboid is intersected and lit in its own coordinates, so its proportions do not matter. The bits of the result do not
//! depend on the number of threads.

mod beside;
mod cells;
mod edge;
mod geometry;
mod illumination;
mod interpolation;
mod interval;
mod joint;
mod picture;
mod real;
mod rule;
mod sample;
mod sight;
mod square;
mod weights;

pub use self::interval::Interval;
pub use self::picture::{Reference, Seen, Truth, picture};
pub use self::real::Real;
pub use self::rule::Rule;
pub use self::sample::{LightSample, Sample, in_row};
pub use self::square::{EnclosedSquare, MAX_SIDE};
