//! The components of a scene, of its viewer, and those that one frame derives. All of them are plain data.
//!
//! ```text
//! entity   components                                      a frame derives
//! cuboid   Name FileOrder Transform Mesh Material          WorldTransform Normals VertexColors Projected
//!          ShadingMode NormalMode Segments
//! light    Name FileOrder Transform Light
//! camera   Name FileOrder Camera Orbit
//! viewer   Viewer Background
//! ```
//! A scene has one viewer. Keys and widgets write components. [`View::of`] alone reads the viewer and its camera for
//! a picture. [`Lens`] and [`Illumination`] are derived once a frame, for all cuboids.
//!
//! | question | where |
//! |---|---|
//! | What is a cuboid made of? | `transform`, `mesh`, and `surface`: material and modes |
//! | What does a frame derive for it? | `surface`: normals, vertex colours, polygons on the screen |
//! | What is a light? | `light` |
//! | Where does a camera stand, and what does it see? | `camera`, moved by its `orbit` |
//! | How is the scene looked at? | `viewer`; `view` for one picture |
//! | Which numbers may a scene file have? | [`numbers`] |
//! | How are entities found and ordered? | `entity` |
//! | How long is a vector of any magnitude? | `vector` |
//!
//! The renderer and the reference share this module and compute everything else themselves.

mod camera;
mod entity;
mod light;
mod mesh;
pub mod numbers;
mod orbit;
mod surface;
mod transform;
mod vector;
mod view;
mod viewer;

pub use self::camera::{Camera, Lens, Projection};
pub use self::entity::{
    FileOrder, Name, alike, common, get, in_file_order, names, ordered, overwrite,
};
pub use self::light::{Illumination, Light, LightKind, PointLight};
pub use self::mesh::{FACES, Mesh, TRIANGLES, TriangleId, axes_along, outward_sign};
pub use self::orbit::Orbit;
pub use self::surface::{
    Material, NormalMode, Normals, Polygon, Projected, Segments, ShadingMode, VertexColors,
};
pub use self::transform::{Transform, WorldTransform};
pub use self::vector::{length, unit};
pub use self::view::View;
pub use self::viewer::{
    Background, Side, ViewMode, Viewer, active_camera, background, viewer, viewer_mut,
};
