//! Material and shading mode of a cuboid, and what a frame derives for it.

use std::ops::RangeInclusive;

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use super::mesh::{FACES, Mesh, outward_sign};
use super::numbers::three;

/// The reflection of a surface: one coefficient for each channel and term, and the exponent of the highlight.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct Material {
    /// kappa A, >= 0.
    #[serde(deserialize_with = "three")]
    pub ambient: DVec3,
    /// kappa D, >= 0.
    #[serde(deserialize_with = "three")]
    pub diffuse: DVec3,
    /// kappa E, >= 0.
    #[serde(deserialize_with = "three")]
    pub specular: DVec3,
    /// rho, 0..=1e6.
    pub shininess: f64,
}

/// The definition of the levels of a cuboid's surface. The tolerance allows an error against it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ShadingMode {
    /// The model once a face: at its middle, with the mean of its corner normals, normalised.
    Flat,
    /// The model at the vertices; its levels are interpolated perspective-correctly (Gouraud 1971).
    #[default]
    Gouraud,
    /// The model at every pixel; position and normal are interpolated perspective-correctly (Phong 1975).
    Phong,
    /// The assignment's shortcut: unit n, l and o are interpolated linearly on the screen and not normalised again.
    /// The reference draws it.
    #[serde(rename(serialize = "phong"), skip_deserializing)]
    UnitVectors,
    /// Phong with max(0, n.h)^(4 rho) in place of max(0, o.r)^rho, h = unit(l + o) (Blinn 1977). The reference draws it.
    #[serde(rename(serialize = "phong"), skip_deserializing)]
    BlinnPhong,
}

impl ShadingMode {
    /// The modes of scene files. The renderer draws them.
    pub const ALL: [ShadingMode; 3] = [ShadingMode::Flat, ShadingMode::Gouraud, ShadingMode::Phong];

    /// Whether the renderer draws it. The reference alone draws the others, in f64, and their time says nothing.
    pub fn is_drawn(self) -> bool {
        ShadingMode::ALL.contains(&self)
    }

    /// The name in scene files, on the command line and in reports. Those that the reference draws count as Phong.
    pub const fn name(self) -> &'static str {
        match self {
            ShadingMode::Flat => "flat",
            ShadingMode::Gouraud => "gouraud",
            ShadingMode::Phong | ShadingMode::UnitVectors | ShadingMode::BlinnPhong => "phong",
        }
    }
}

/// The definition of a cuboid's vertex normals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum NormalMode {
    /// The normalised sum of the normals of the three faces that meet at the corner: edges look smooth.
    #[default]
    Corner,
    /// The normal of the face itself, at its four corners: edges look sharp.
    Face,
}

impl NormalMode {
    pub const ALL: [NormalMode; 2] = [NormalMode::Corner, NormalMode::Face];

    /// The name in scene files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            NormalMode::Corner => "corner",
            NormalMode::Face => "face",
        }
    }
}

/// The number of cells along an edge of a face at whose corners Gouraud shading evaluates the model: 1..=256.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "u32")]
pub struct Segments(u32);

impl Segments {
    /// The legal numbers.
    pub const RANGE: RangeInclusive<u32> = 1..=256;

    /// This number of cells; `None` if it is not legal.
    pub const fn new(cells: u32) -> Option<Self> {
        if *Segments::RANGE.start() <= cells && cells <= *Segments::RANGE.end() {
            Some(Segments(cells))
        } else {
            None
        }
    }

    /// The number of cells along an edge.
    pub fn count(self) -> usize {
        self.0 as usize
    }

    /// The number of a face's grid points.
    pub fn points(self) -> usize {
        (self.count() + 1).pow(2)
    }

    /// The grid points of a face, row by row: their numbers along its axes, from 0, and (u, v), -1 to 1.
    pub fn grid(self) -> impl Iterator<Item = ([usize; 2], [f64; 2])> {
        let count = self.count();
        let at = move |index: usize| 2.0 * index as f64 / count as f64 - 1.0;
        let rows = (0..=count).flat_map(move |j| (0..=count).map(move |i| [i, j]));
        rows.map(move |point| (point, point.map(at)))
    }
}

impl Default for Segments {
    fn default() -> Self {
        Segments(1)
    }
}

impl TryFrom<f64> for Segments {
    type Error = String;

    fn try_from(number: f64) -> Result<Self, String> {
        let cells = Segments::new(number as u32);
        cells.ok_or_else(|| format!("{number} is out of range"))
    }
}

impl From<Segments> for u32 {
    fn from(segments: Segments) -> u32 {
        segments.0
    }
}

/// Unit vertex normals in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Normals {
    /// One per corner of the [`super::Mesh`], shared by the faces there.
    Corner([DVec3; 8]),
    /// The normals of the faces +x, +y and +z.
    Face([DVec3; 3]),
}

impl Normals {
    /// The normals of a cuboid with these axes in world space.
    pub fn new(mode: NormalMode, mesh: &Mesh, axes: DMat3) -> Self {
        match mode {
            NormalMode::Corner => Normals::Corner(mesh.normals.map(|normal| axes * normal)),
            NormalMode::Face => Normals::Face([0, 1, 2].map(|axis| axes.col(axis))),
        }
    }

    /// The normals at the corners of a face, in the order of [`FACES`].
    pub fn of_face(&self, face: usize) -> [DVec3; 4] {
        match self {
            Normals::Corner(normals) => FACES[face].map(|corner| normals[usize::from(corner)]),
            Normals::Face(normals) => [normals[face / 2] * outward_sign(face); 4],
        }
    }
}

impl Default for Normals {
    fn default() -> Self {
        Normals::Corner([DVec3::ZERO; 8])
    }
}

/// The model at the vertices, or at the middle of each face, in levels, unclamped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VertexColors {
    /// One per corner of the [`super::Mesh`], shared by the faces there.
    Corner([DVec3; 8]),
    /// The levels at the corners of the visible face across each axis. A face and the one opposite are never seen together.
    /// Under flat shading all four are the level at its middle.
    Face([[DVec3; 4]; 3]),
    /// For several segments the index of the visible face's grid in the frame, across each axis.
    Grid([u32; 3]),
}

impl VertexColors {
    /// The levels at the corners of a visible face, in the order of [`FACES`]; those of a grid are in the frame.
    pub fn of_face(&self, face: usize) -> [DVec3; 4] {
        match self {
            VertexColors::Corner(levels) => FACES[face].map(|corner| levels[usize::from(corner)]),
            VertexColors::Face(levels) => levels[face / 2],
            VertexColors::Grid(_) => [DVec3::ZERO; 4],
        }
    }

    /// All levels, to be changed, but those of a grid.
    pub fn all_mut(&mut self) -> &mut [DVec3] {
        match self {
            VertexColors::Corner(levels) => levels,
            VertexColors::Face(levels) => levels.as_flattened_mut(),
            VertexColors::Grid(_) => &mut [],
        }
    }
}

impl Default for VertexColors {
    fn default() -> Self {
        VertexColors::Corner([DVec3::ZERO; 8])
    }
}

/// The corners of a cuboid as the camera sees them, and the polygons of its faces on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Projected {
    /// The corners relative to the eye, along right, up and forward, in world units.
    pub seen: [DVec3; 8],
    /// The visible part of each of [`FACES`](super::FACES), empty where it faces away or is clipped.
    pub polygons: [Polygon; 6],
}

/// A polygon on the screen: a convex one, its vertices snapped to 1/256 pixel. Snapping may bend a sliver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Polygon {
    /// x right and y down from the picture's top left corner, in 1/256 pixel, within +-2^30, counter-clockwise as seen.
    pub vertices: [[i32; 2]; Polygon::MAX_VERTICES],
    /// The number of vertices in use: 0, or 3..=9.
    pub len: u8,
}

impl Polygon {
    /// Snapping moves a coordinate of a vertex by at most this, in pixels.
    pub const SNAP: f64 = 1.0 / 512.0;

    /// A face, cut by the near plane and by the four sides of the guard band.
    pub const MAX_VERTICES: usize = 9;

    /// The vertices in use.
    pub fn vertices(&self) -> &[[i32; 2]] {
        &self.vertices[..usize::from(self.len)]
    }

    /// Whether its bounding box meets a picture of this size in pixels. Else it covers none of them.
    pub fn meets(&self, size: [usize; 2]) -> bool {
        (0..2).all(|axis| {
            let places = self.vertices().iter().map(|vertex| i64::from(vertex[axis]));
            let end = 256 * size[axis] as i64;
            places.clone().any(|place| place < end) && places.clone().any(|place| place > 0)
        })
    }

    /// The least and the largest x and y of its bounding box in the picture, in pixels.
    pub fn bounds(&self, size: [usize; 2]) -> [[f64; 2]; 2] {
        [i32::min, i32::max].map(|nearer: fn(i32, i32) -> i32| {
            [0, 1].map(|axis| {
                let places = self.vertices().iter().map(|vertex| vertex[axis]);
                let end = places.reduce(nearer).unwrap_or_default();
                f64::from(end.clamp(0, 256 * size[axis] as i32)) / 256.0
            })
        })
    }
}
