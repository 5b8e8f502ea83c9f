//! shadetrade draws lit cuboids with flat, Gouraud and Phong shading and measures the time that each shortcut saves
//! and the error that it causes.
//!
//! ```text
//! scene.toml <--SceneRecord--> World --FRAME--> Frame
//!                               |  spin -> normals -> projection -> lighting -> rasterization
//!                               |                                         |--> window            (view)
//!                               |                                         |--> PNG               (render, figures)
//!                               |--reference (f64)--> truth --metrics--> table, best trades (trade), error map (window)
//!                               '--reference (intervals)--> enclosures --> a proof (prove, extremes, requires, window)
//! ```
//!
//! # From scene to pixel
//!
//! **Entities, components, systems.** A scene and its view are a [`hecs::World`]. Its entities are cuboids, lights,
//! cameras and one viewer; [`components`] lists what each is made of. Keys and the editor write components;
//! [`systems`] query them and draw.
//!
//! **[`scene::SceneRecord`] is that world as data.** [`scene::SceneRecord::spawn`] makes a world of it, and
//! [`scene::SceneRecord::of`] takes it from a world. serde reads it from a TOML file and writes it to JSON;
//! [`scene::updated`] writes it into the text of its file and keeps the comments. A mistake in a file gets its line
//! and column in `scene/read.rs`. [`scene::key`] addresses each value by name, such as `light.white.intensity`:
//! the option `--set`, lessons, tooltips and undo use these names. `components/numbers.rs` has the range of each
//! number.
//!
//! [`components::View::of`] is the one place that reads the viewer for a picture. A view says from where, how large
//! and how precisely a frame is drawn. Code that measures or proves changes a copy of the view, never the viewer.
//!
//! **A frame runs five systems**, in the order of [`systems::FRAME`]. Each is a function of the world, the view and
//! the frame. `tests/it/systems` runs them one by one; normals are tested by the proofs of `tests/it/prove`.
//!
//! 1. [`systems::spin`]: a cuboid's place and axes in the world, from its transform and the common rotation angle.
//! 2. [`systems::normals`]: the mesh's vertex normals, turned; or the faces' own. A corner normal is the normalised
//!    sum of the unit normals of the adjacent faces (Gouraud 1971, "Continuous Shading of Curved Surfaces", IEEE
//!    Transactions on Computers 20(6)). In the cuboid's own axes a corner has the normal (±1, ±1, ±1) / √3.
//! 3. [`systems::projection`]: corners are seen from the eye, cut at the near plane (Sutherland and Hodgman 1974),
//!    divided by depth and snapped to 1/256 pixel. [`components::Camera::of`] says where a camera stands once its
//!    orbit has moved it.
//! 4. [`systems::lighting`]: gathers the lights that are on, and evaluates the model where a mode needs it before
//!    pixels:
//!    - flat: once a face, at its middle;
//!    - Gouraud: at the eight corners; with face normals at the four corners of each visible face;
//!    - Gouraud with several segments along an edge: at the points of a grid ([`shading::grid`]).
//! 5. [`systems::rasterization`]: [`systems::coverage`] finds each covered pixel once, in integers, by the top-left
//!    rule. Flat faces are filled; squares of 32 or 16 pixels a side, or the pixels of a small face, go to a shader.
//!    `systems/rasterization/canvas.rs` writes squares, [`shading::listed`] pixels that are evaluated one by one. The
//!    display step comes once and last: `byte = floor(clamp(I, 0, 255) + 0.5)`.
//!
//! ```
//! use shadetrade::components::{ShadingMode, View, overwrite, viewer_mut};
//! use shadetrade::systems::frame::{Frame, Keep, Workers};
//! use shadetrade::scene::Scene;
//! use shadetrade::systems;
//!
//! let mut scene = Scene::load(None)?; // the built-in cuboid
//! overwrite(&mut scene.world, &ShadingMode::Phong); // of all cuboids
//! viewer_mut(&mut scene.world).tolerance = 0.5; // levels of 255
//! let view = View::of(&scene.world, [320, 240]);
//! let mut frame = Frame::new(Keep::Display, Workers::new(1, fearless_simd::Level::new())?);
//! systems::draw(&mut scene.world, &view, &mut frame)?;
//! assert_eq!(frame.pixels().len(), 320 * 240); // 0x00RRGGBB, row by row from the top
//! assert!(frame.counts().covered_pixels > 20_000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The model, and its modes
//!
//! At a point P with unit normal n, in levels a channel (Phong 1975, "Illumination for Computer Generated
//! Pictures", Communications of the ACM 18(6)). [`shading::Surface::levels`] evaluates this formula in f64,
//! [`shading::phong`] in f32:
//!
//! ```text
//! I = sum over ambient lights   kA color intensity gain
//!   + sum over diffuse lights   kD color intensity gain max(0, n.l)
//!   + sum over specular lights  kE color intensity gain max(0, o.r)^rho    where n.l > 0
//!
//! r = 2 (n.l) n - l      l = unit(L - P)      o = unit(O - P)
//! ```
//!
//! Let w be proportional to 1 / depth. The product of w and a quantity that is linear on the face is affine in the
//! pixel ([`shading::face`]; Heckbert and Moreton 1991; Olano and Greer 1997). Gouraud and Phong use this:
//!
//! - flat shading evaluates I once a face, at its middle, and fills the face;
//! - [`shading::gouraud`] evaluates I at the vertices and interpolates I: `I = w I / w`;
//! - [`shading::phong`] interpolates P and n, normalises n, and evaluates I at every pixel. Directions need no
//!   division: w n, w (L - P) and w (O - P) have the directions of n, L - P and O - P;
//! - the assignment's shortcut interpolates unit n, l and o linearly on the screen and does not normalise them. It
//!   and Blinn-Phong with four times the exponent (`docs/blinn.md`) are drawn by the reference alone.
//!
//! [`questions::probe`] explains one pixel: it evaluates every light's term, and both modes beside the reference.
//!
//! ```
//! # use shadetrade::components::View;
//! # use shadetrade::questions::probe;
//! # use shadetrade::scene::Scene;
//! # let mut scene = Scene::load(None)?;
//! # let view = View::of(&scene.world, [960, 720]);
//! // The middle of the highlight. Gouraud misses it, because no vertex lies in it.
//! let level = fearless_simd::Level::new();
//! let found = probe::at(&mut scene, &view, [565, 327], level)?.surface.expect("a cuboid is there");
//! assert_eq!(found.gouraud.z.round(), 46.0); // blue, in levels
//! assert!(found.phong.z > 190.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What a tolerance buys
//!
//! Most pixels do not need the formula. The model is evaluated at nine Chebyshev nodes of a square, and a
//! biquadratic goes through them. [`shading::bound`] bounds the third derivatives, and so the error of the
//! interpolation. The square is drawn from the polynomial if the bound is within the tolerance; else it is cut into
//! quarters, and the smallest squares are evaluated pixel by pixel. [`shading`] has this in pseudo code, with the
//! sum that must stay within the tolerance. [`shading::SquareKind`] lists the ways, and the window's tiles view
//! shows them.
//!
//! The nearest published method is that of Hu, Yuan, Wang, Yang and Bao (Computer Graphics Forum 41(7), 2022):
//! samples at the vertices of a subdivision, linear pieces and a bound of their error, on a GPU. `docs/compare.md`
//! names others.
//!
//! Rounding is part of the tolerance ([`shading::rounding`] counts it, with constants that `proofs/` checks by
//! machine). At tolerance 0 the model is evaluated at every pixel. Highlights are left out only if all of them
//! together are proven to stay below a quarter of the tolerance; at tolerance 0, of the 0.05 that it permits. 1 - o.r is
//! computed as |r - o|² / 2, because 1 - o.r itself loses digits near the highlight (Lyon 1993;
//! [`shading::specular`]).
//!
//! # An independent check
//!
//! [`mod@reference`] draws the same picture by lines of sight through the pixels and shares no code with the
//! renderer. `reference/illumination.rs` has its model, in f64, f32 or intervals ([`reference::Real`]).
//!
//! - In f64 it is the truth of [`questions::trade`], which measures the error and the time of each method.
//!   [`questions::metrics`] has the errors: the largest, the mean and others, in levels before they become bytes.
//! - In intervals, rounded outwards, it encloses the exact level of every pixel, from the scene's numbers on.
//!   [`mod@questions::prove`] compares the drawn picture with that. `reference/square.rs` encloses most pixels
//!   under Phong in squares of 16 to 4 pixels a side: nine enclosed samples, and a bound on the error of their
//!   biquadratic. A pixel that its square does not prove is enclosed by itself.
//! - In the window proofs follow the picture while it moves, if one takes less than 0.3 s.
//!
//! ```
//! # use shadetrade::components::{ShadingMode, View};
//! # use shadetrade::systems::frame::{Frame, Keep, Workers};
//! # use shadetrade::scene::Scene;
//! # use shadetrade::systems;
//! use shadetrade::reference;
//! use shadetrade::output::Monitor;
//! use shadetrade::output::finished;
//! use shadetrade::questions::metrics::{Picture, compare};
//! # let mut scene = Scene::load(None)?;
//! # let view = View::of(&scene.world, [320, 240]).shaded(ShadingMode::Phong);
//! # let mut frame = Frame::new(Keep::Levels, Workers::new(1, fearless_simd::Level::new())?);
//! # systems::draw(&mut scene.world, &view, &mut frame)?;
//! // `view` as above: Phong within half a level; `frame` keeps its levels.
//! let truth = finished(reference::picture(&scene.world, &view, 0..240, Monitor::NONE))?;
//! let error = compare(Picture::from(&frame), Picture::from(&truth)).error.expect("a cuboid is there");
//! assert!(error.max <= 0.5 && error.mean < 0.05);
//! # use shadetrade::questions::prove::prove;
//!
//! // The same, proven: an interval encloses each exact level, and the drawn level is within half a level of all of it.
//! let level = fearless_simd::Level::new();
//! let proof = finished(prove(&mut scene.world, &view, None, level, Monitor::NONE))?;
//! assert_eq!(proof.proven, 320 * 240);
//! # Ok::<(), anyhow::Error>(())
//! ```
//!
//! What a command prints, its JSON included, is in the file of its question, or in `command.rs` or `export.rs`
//! below it; `docs/json.md` explains the fields.
//!
//! [`mod@questions::requires`] encloses two pictures, with and without a part of the model. Their difference bounds
//! the error of leaving that part out. It tries each light, each cuboid, the normalisation of normals,
//! perspective-correct interpolation and others in turn, and says which of them the tolerance requires. It also
//! finds the coarsest grid on which Gouraud keeps the tolerance. [`reference::Rule`] lists the parts that no scene
//! file can leave out.
//!
//! # Extreme numbers
//!
//! `assets/extremes` holds scenes with extreme numbers: the near plane through a corner, a light an ulp off a face,
//! edges with a ratio of 1e100, sums beyond the largest float. Each is built in and opens by its name.
//! [`questions::extremes`] proves every pixel of them, and compares levels with those that are known on paper.
//! [`questions::vary`] varies one number of a scene and shows where methods, f32 and f64 cease to keep the
//! tolerance. All is computed from differences to the eye, and no threshold is an absolute length: a scene that is
//! moved, or scaled by a power of two, has the same bits if none of its numbers is rounded.
//!
//! # What to touch to add ...
//!
//! - a method: a variant of [`components::ShadingMode`] and of [`shading::Shader`], a file under `shading/`, a row
//!   of [`shading::METHODS`], and its own definition in the reference. The compiler shows the matches; `rg 'Mode::'`
//!   shows the conditions on the mode, such as that of [`shading::Method`] on the tolerance;
//! - a light kind: a variant of [`components::LightKind`] and its name, its sum in `gather` of
//!   `systems/lighting.rs`, its term in `shading/surface.rs` (f64) and `shading/phong.rs` (f32, with its bound),
//!   and, written anew, in `reference/illumination.rs`. An ambient light needs its sum alone;
//! - a system: a file under `systems/` with its `run`, its row of [`systems::FRAME`], and a file under
//!   `tests/it/systems`; a component that it derives joins the others in [`scene::SceneRecord::spawn`];
//! - an extreme that must be drawn right: a scene in `assets/extremes`, and what is known of it in the index there;
//! - a metric: a field of [`questions::metrics::ErrorStatistics`], which JSON has automatically, and a row of
//!   `COLUMNS` in [`questions::trade::export`] if the table is to show it;
//! - a value of a scene: a component; its key in the records of [`scene`]; for a number, its range in
//!   `components/numbers.rs`; and the two places where [`scene::SceneRecord`] spawns it and takes it from a world. The window's editor shows it by itself. Its
//!   comment in `assets/scenes/cuboid.toml` is its tooltip;
//! - a lesson: a file in `assets/lessons`, and its row of [`scene::LESSONS`];
//! - a key: a [`window::keys::Action`] with its row of [`window::keys::BINDINGS`], and an arm of `App::run` in
//!   `window/actions.rs` that writes components; help and tooltips show it by themselves;
//! - a command: a variant of [`cli::Command`] with its examples, and an arm in `main.rs`; in `cli.rs`, a row of
//!   `start_threads` if it evaluates the reference.
//!
//! # Who may import whom: nine rooms
//!
//! ```text
//! main
//! cli          window
//! questions
//! systems      reference
//! shading      scene
//! components   output
//! ```
//!
//! A room imports from lower lines only; `tests/it/layers.rs` reads this drawing, and the one of [`questions`]
//! inside that room. Beyond that: [`mod@reference`] takes components, [`output::memory`] and [`output::progress`],
//! and no code of the renderer; [`output`] imports nothing else of this crate; [`cli`] imports what it needs to
//! convert and check options; minifb is named in [`window`] alone, egui in [`output::paint`], [`window`] and
//! [`questions::figures`], which draws letters; only [`scene`] parses and formats scene files.
//!
//! # What is not modelled, and why
//!
//! Only what a scene of lit cuboids requires: no textures, no shadows, no interreflection, no attenuation with
//! distance, no transparency, no antialiasing, no gamma (levels are display-referred, as in the fixed-function
//! pipeline the assignment comes from), no far plane.

pub mod cli;
pub mod components;
pub mod output;
pub mod questions;
pub mod reference;
pub mod scene;
pub mod shading;
pub mod systems;
pub mod window;
