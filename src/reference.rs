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
//! | question | where |
//! |---|---|
//! | What may a number be? | `real`: a float, or an `interval` around the exact value |
//! | Which line of sight does a pixel have? | `sight` |
//! | Where does it hit a cuboid? | `geometry`, `edge`; `weights` of the corners there |
//! | What may a pixel near an edge show? | `beside` the face; `joint`: nothing that touching faces hide |
//! | What is the model at a point? | `illumination`; `cells` under Gouraud; `rule` has the parts that can be left out |
//! | What does each pixel show? | `picture`; `sample` with vectors and terms |
//! | How is a square enclosed at once? | `square`, with the bound of `interpolation` |
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
pub use self::square::{EnclosedSquare, MAX_ENCLOSED_SIDE};
