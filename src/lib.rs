//! shadetrade draws lit cuboids with Gouraud and Phong shading and measures what every shortcut costs.
//!
//! # From scene to pixel
//!
//! ```text
//! assets/scenes/x.toml --scene--> World --FRAME--> Frame
//!                                   |  normals -> projection -> lighting -> rasterization(mode, tolerance)
//!                                   |                                         |--> window            (view)
//!                                   |                                         |--> PNG               (render, figures)
//!                                   '--reference (f64)--> truth --metrics--> table, front, error map (trade, window)
//! ```
//!
//! 1. [`scene`] turns a TOML file into a [`hecs::World`]: cuboids, lights and cameras are entities with the plain
//!    [`components`].
//! 2. [`systems::FRAME`] names the stages of a frame in order. [`systems::normals`] averages face normals at the corners;
//!    [`systems::projection`] subtracts the eye, turns, clips at the near plane, divides and snaps to 1/256 pixel;
//!    [`systems::lighting`] gathers the lights that are on and evaluates the model at the vertices;
//!    [`systems::rasterization`] finds the pixels ([`systems::coverage`]) and hands tiles of 16 x 16 to a shader.
//! 3. [`shading`] is the model ([`shading::Surface::levels`]) and the ways to draw it: [`shading::gouraud`],
//!    [`shading::phong`], [`shading::unit_vectors`]. [`shading::certificate`] bounds what a polynomial costs in place of
//!    the model; with a tolerance above 0 a tile takes the cheapest evaluation that provably keeps it.
//! 4. [`frame`] holds the pixels and applies the display step, once and last.
//! 5. [`mod@reference`] draws the same picture in f64 by rays, written on its own; [`trade`] sets the two side by side, with
//!    the time of each method; [`probe`] does so for one pixel; [`window`] shows all of it live.
//!
//! # What to touch to add ...
//!
//! - a method: a variant of [`components::ShadingMode`], a file under `shading/`, an arm of the one `match` in
//!   [`systems::rasterization`], a row of [`shading::METHODS`];
//! - a light kind: a variant of [`components::LightKind`], its sum in [`systems::lighting::gather`], its term in
//!   [`shading::Surface::levels`] and, written anew, in the reference;
//! - a step of the frame: a row of [`systems::FRAME`];
//! - a metric: a pure function in [`trade::metrics`], its column in [`trade::report`];
//! - a key: a row of [`window::bindings::BINDINGS`], and an arm where [`window::session`] applies actions.
//!
//! # Who may import whom
//!
//! components -> glam. shading -> components. frame -> shading's tiles. systems -> components, shading, frame. scene ->
//! components. reference -> components: it shares no formula with the renderer. drawing -> scene, frame. probe ->
//! systems, reference. trade -> drawing, systems, reference, [`shading::METHODS`]. window -> the same; only it names
//! minifb. output, lettering and simd -> none of these. pictures -> drawing, systems, reference, output, lettering. cli ->
//! drawing, output, trade's request; main -> cli and the commands. Nothing points back up.
//!
//! # What is not modelled, and why
//!
//! Only what a scene of lit cuboids requires: no textures, no shadows, no interreflection, no attenuation with distance,
//! no transparency, no antialiasing, no gamma (levels are display-referred, as in the fixed-function pipeline the
//! assignment comes from), no far plane. A light that is off is not evaluated, and one convex body needs no depth buffer
//! and gets none.

pub mod cli;
pub mod components;
pub mod drawing;
pub mod extremes;
pub mod frame;
pub mod lettering;
pub mod output;
pub mod pictures;
pub mod probe;
pub mod reference;
pub mod scene;
pub mod shading;
pub mod simd;
pub mod systems;
pub mod trade;
pub mod window;
