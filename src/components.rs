//! Plain data: what a scene holds, how it is looked at, and what one frame derives from it.
//!
//! ```text
//! entity   components                                      a frame derives
//! cuboid   Name FileOrder Transform Mesh Material          WorldTransform Normals VertexColors Projected
//!          ShadingMode
//! light    Name FileOrder Transform Light
//! camera   Name FileOrder Transform Camera Orbit
//! viewer   ActiveCamera Projection Background Tolerance
//!          Budget Spin Show Magnifier Probed Inspector
//! ```
//! A scene has one viewer. Keys and widgets write components; [`View::of`] is the one place that reads those of the viewer
//! and of its camera for a picture.
//!
//! A [`View`] says how one frame is to be drawn; [`Lens`] and [`Illumination`] are derived from it once for all cuboids.
//!
//! Nothing here computes a picture, and everything that the renderer and the reference share is here.

mod camera;
pub(crate) mod form;
mod magnifier;
mod orbit;
mod view;
mod viewer;

use glam::{DMat3, DVec3};
use hecs::{Component, DynamicBundle, Entity, World};
use serde::{Deserialize, Serialize};

pub use self::camera::{Camera, Lens, Projection, Viewpoint};
pub use self::magnifier::Magnifier;
pub use self::orbit::{Limits, Orbit};
pub use self::view::View;
pub use self::viewer::{
    ActiveCamera, Background, Budget, Inspector, Probed, Show, Side, Spin, Tab, Tolerance,
    ViewMode, active_camera, viewer,
};

/// The entities that have a component, in file order.
pub fn ordered<C: Component>(world: &World) -> Vec<Entity> {
    let mut query = world.query::<(Entity, &FileOrder)>().with::<&C>();
    in_file_order(query.iter().map(|(entity, order)| (*order, entity)))
}

/// What is said of entities, in the order of the file.
pub fn in_file_order<T>(entities: impl Iterator<Item = (FileOrder, T)>) -> Vec<T> {
    let mut entities: Vec<_> = entities.collect();
    entities.sort_by_key(|(order, _)| *order);
    entities.into_iter().map(|(_, entity)| entity).collect()
}

/// The names of the entities that have a component, in file order.
pub fn names<C: Component>(world: &World) -> Vec<String> {
    let entities = ordered::<C>(world).into_iter();
    entities
        .filter_map(|entity| get(world, entity).map(|Name(name)| name))
        .collect()
}

/// A component of an entity, where it has one such.
pub fn get<C: Component + Clone>(world: &World, entity: Entity) -> Option<C> {
    world
        .get::<&C>(entity)
        .ok()
        .map(|component| (*component).clone())
}

/// What an entity is called in the scene file: non-empty, unique within its kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name(pub String);

/// The place of a cuboid, a light or a camera among its kind in the scene file, counted from 0: cuboids are numbered and
/// ties of depth decided by it, and everything is listed in its order. Where an entity was removed there is a gap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FileOrder(pub u32);

/// Where an entity stands (world units) and how it is turned (degrees).
///
/// Lights and cameras use the position alone; an ambient light uses neither.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Transform {
    /// The centre, in world units.
    pub position: DVec3,
    /// Angles about the fixed x, y and z axes, in degrees, applied in that order: Rz * Ry * Rx.
    pub rotation: DVec3,
}

impl Transform {
    /// A place, not turned.
    pub fn at(position: DVec3) -> Self {
        Transform {
            position,
            rotation: DVec3::ZERO,
        }
    }

    /// The rotation as a matrix whose columns are the entity's own axes in world space.
    ///
    /// Angles are reduced to one turn before they become radians, so 1e9 degrees is as exact as 280, and
    /// quarter turns are exact.
    pub fn axes(&self) -> DMat3 {
        let [(sx, cx), (sy, cy), (sz, cz)] = self.rotation.to_array().map(sin_cos_degrees);
        let about_x = DMat3::from_cols_array(&[1.0, 0.0, 0.0, 0.0, cx, sx, 0.0, -sx, cx]);
        let about_y = DMat3::from_cols_array(&[cy, 0.0, -sy, 0.0, 1.0, 0.0, sy, 0.0, cy]);
        let about_z = DMat3::from_cols_array(&[cz, sz, 0.0, -sz, cz, 0.0, 0.0, 0.0, 1.0]);
        about_z * about_y * about_x
    }

    /// Turned further about the entity's own x axis, which is the one that Rz * Ry * Rx turns about first.
    #[must_use]
    pub fn turned(mut self, degrees: u32) -> Self {
        self.rotation.x += f64::from(degrees);
        self
    }
}

/// Where a cuboid stands in this frame: its [`Transform`] turned by the viewer's [`Spin`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorldTransform {
    /// The centre, in world units.
    pub position: DVec3,
    /// The cuboid's own axes in world space: see [`Transform::axes`].
    pub axes: DMat3,
}

/// Sine and cosine of an angle in degrees, exact at quarter turns.
fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    // The remainder of a float division is exact, whatever the size of the angle.
    let turn = degrees % 360.0;
    let quarter = (turn / 90.0).round();
    let (sin, cos) = (turn - 90.0 * quarter).to_radians().sin_cos();
    match quarter.rem_euclid(4.0) as u8 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// A cuboid's eight corners, relative to its centre in world units, and its unit vertex normals; both before rotation.
///
/// Corner `i` lies at +x if bit 0 of `i` is set, at +y if bit 1 is, at +z if bit 2 is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mesh {
    pub corners: [DVec3; 8],
    pub normals: [DVec3; 8],
}

/// The faces +x, -x, +y, -y, +z, -z as corner indices, counter-clockwise seen from outside.
///
/// The first and the third corner are the ends of the diagonal along which the face is cut: the third has the largest
/// sum of local signs.
pub const FACES: [[u8; 4]; 6] = [
    [1, 3, 7, 5],
    [0, 4, 6, 2],
    [2, 6, 7, 3],
    [0, 1, 5, 4],
    [4, 5, 7, 6],
    [0, 2, 3, 1],
];

/// The twelve triangles, two to a face in the order of [`FACES`], counter-clockwise seen from outside.
pub const TRIANGLES: [[u8; 3]; 12] = {
    let mut triangles = [[0; 3]; 12];
    let mut face = 0;
    while face < 6 {
        let [a, b, c, d] = FACES[face];
        triangles[2 * face] = [a, b, c];
        triangles[2 * face + 1] = [a, c, d];
        face += 1;
    }
    triangles
};

impl Mesh {
    /// A cuboid with the given full edge lengths (world units, > 0).
    pub fn cuboid(size: DVec3) -> Self {
        let half = size * 0.5;
        let sign = |corner: usize, bit: usize| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let corners =
            std::array::from_fn(|i| half * DVec3::new(sign(i, 0), sign(i, 1), sign(i, 2)));
        let normals = vertex_normals(&corners);
        Mesh { corners, normals }
    }

    /// The full edge lengths, in world units: those that [`Mesh::cuboid`] was given.
    pub fn size(&self) -> DVec3 {
        self.corners[7] - self.corners[0]
    }
}

/// The unit normals of the faces in the order of [`FACES`], pointing outwards.
///
/// The edges are normalised before they are crossed, so that neither needles nor sheets nor sizes of 1e±100 lose them.
fn face_normals(corners: &[DVec3; 8]) -> [DVec3; 6] {
    FACES.map(|[a, b, _, d]| {
        let corner = |index: u8| corners[usize::from(index)];
        unit(unit(corner(b) - corner(a)).cross(unit(corner(d) - corner(a))))
    })
}

/// The unit normals at a cuboid's corners: the normalised sum of the unit normals of the faces that meet there, each counted
/// once (not once a triangle), whatever the cuboid's proportions. A face's normal comes from its own corners.
fn vertex_normals(corners: &[DVec3; 8]) -> [DVec3; 8] {
    let mut sums = [DVec3::ZERO; 8];
    for (face, normal) in FACES.iter().zip(face_normals(corners)) {
        for &corner in face {
            sums[usize::from(corner)] += normal;
        }
    }
    sums.map(unit)
}

/// How a surface answers light: one coefficient per channel and term, and the exponent of the highlight.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// kappa A, >= 0.
    #[serde(deserialize_with = "form::three")]
    pub ambient: DVec3,
    /// kappa D, >= 0.
    #[serde(deserialize_with = "form::three")]
    pub diffuse: DVec3,
    /// kappa E, >= 0.
    #[serde(deserialize_with = "form::three")]
    pub specular: DVec3,
    /// rho, 0..=1e6.
    #[serde(deserialize_with = "form::number")]
    pub shininess: f64,
}

/// How a cuboid's surface is shaded: what its picture means, whatever the tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ShadingMode {
    /// The model at the vertices, its colours interpolated perspective-correctly (Gouraud 1971).
    #[default]
    Gouraud,
    /// Position and normal interpolated perspective-correctly, the model at every pixel (Phong 1975).
    Phong,
    /// The assignment's shortcut: unit n, l and o of the vertices interpolated linearly on the screen and not renormalised.
    #[serde(rename(serialize = "phong"), skip_deserializing)]
    UnitVectors,
}

impl ShadingMode {
    /// What scene files, the command line and reports call it; the assignment's shortcut is a way to draw Phong.
    pub const fn name(self) -> &'static str {
        match self {
            ShadingMode::Gouraud => "gouraud",
            ShadingMode::Phong | ShadingMode::UnitVectors => "phong",
        }
    }
}

/// The one term of the model that a light feeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LightKind {
    /// Everywhere alike.
    Ambient,
    /// max(0, n.l), from a point.
    Diffuse,
    /// max(0, o.r)^rho, from a point.
    Specular,
}

impl LightKind {
    pub const ALL: [LightKind; 3] = [LightKind::Ambient, LightKind::Diffuse, LightKind::Specular];

    /// What scene files and reports call it.
    pub const fn name(self) -> &'static str {
        match self {
            LightKind::Ambient => "ambient",
            LightKind::Diffuse => "diffuse",
            LightKind::Specular => "specular",
        }
    }
}

/// A light; its place is its [`Transform`]'s position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// The term it feeds.
    pub kind: LightKind,
    /// Per channel, >= 0.
    pub color: DVec3,
    /// Lambda, >= 0.
    pub intensity: f64,
    /// Levels per unit of intensity, >= 0.
    pub gain: f64,
    /// A light that is off appears nowhere.
    pub on: bool,
}

impl Light {
    /// What the light sends, per channel, in levels: color * intensity * gain.
    pub fn levels(&self) -> DVec3 {
        self.color * (self.intensity * self.gain)
    }
}

/// Unit vertex normals in world space, one per corner of the [`Mesh`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Normals(pub [DVec3; 8]);

/// The model at each corner, in levels, unclamped.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VertexColors(pub [DVec3; 8]);

/// What all lights that are on send, gathered once a frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Illumination {
    /// Sum over the ambient lights, in levels per unit of kappa A.
    pub ambient: DVec3,
    /// The point lights, those at one position together, ordered by position.
    pub points: Vec<PointLight>,
}

/// All diffuse and specular lights at one position: they share l and r.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// In world units.
    pub position: DVec3,
    /// Levels per unit of kappa D.
    pub diffuse: DVec3,
    /// Levels per unit of kappa E.
    pub specular: DVec3,
}

/// Where a cuboid's corners fall, and the screen polygons of its triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Projected {
    /// The corners relative to the eye, along right, up and forward, in world units.
    pub seen: [DVec3; 8],
    /// The visible part of each of [`TRIANGLES`], empty where it faces away or is clipped.
    pub polygons: [Polygon; 12],
}

/// A convex polygon on the screen, its vertices snapped to 1/256 pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Polygon {
    /// x right and y down from the picture's top left corner, in 1/256 pixel, within +-2^30, counter-clockwise as seen.
    pub vertices: [[i32; 2]; Polygon::MAX_VERTICES],
    /// How many of them count: 0, or 3..=8.
    pub len: u8,
}

impl Polygon {
    /// A triangle, cut by the near plane and by the four sides of the guard band.
    pub const MAX_VERTICES: usize = 8;

    /// The vertices that count.
    pub fn vertices(&self) -> &[[i32; 2]] {
        &self.vertices[..usize::from(self.len)]
    }
}

/// Every component of a cuboid: what the scene says of it, and room for what a frame derives.
pub fn cuboid(
    order: usize,
    name: Name,
    transform: Transform,
    mesh: Mesh,
    material: Material,
    shading: ShadingMode,
) -> impl DynamicBundle {
    (
        name,
        FileOrder(order as u32),
        transform,
        mesh,
        material,
        shading,
        WorldTransform::default(),
        Normals::default(),
        VertexColors::default(),
        Projected::default(),
    )
}

/// Overwrites a component of the entities that have one such.
pub fn overwrite<C: Component + Clone>(world: &mut World, component: &C) {
    for own in world.query_mut::<&mut C>() {
        *own = component.clone();
    }
}

/// The length of `v`, right for every finite vector however large or small (numerics: safe normalise).
pub fn length(v: DVec3) -> f64 {
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() {
        (v / largest).length() * largest
    } else {
        0.0
    }
}

/// `v` at length one; zero where `v` is zero or not finite, so that what it lights is unlit rather than undefined.
pub fn unit(v: DVec3) -> DVec3 {
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() {
        let scaled = v / largest;
        scaled / scaled.length()
    } else {
        DVec3::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(rotation: [f64; 3]) -> DMat3 {
        let transform = Transform {
            position: DVec3::ZERO,
            rotation: rotation.into(),
        };
        transform.axes()
    }

    #[test]
    fn quarter_turns_are_exact_in_both_directions_and_any_number_of_times() {
        let [x, y, z] = DVec3::AXES;
        // Where +x, +y and +z come to lie after none, one, two and three quarters about each axis.
        let about_x = [[x, y, z], [x, z, -y], [x, -y, -z], [x, -z, y]];
        let about_y = [[x, y, z], [-z, y, x], [-x, y, -z], [z, y, -x]];
        let about_z = [[x, y, z], [y, -x, z], [-x, -y, z], [-y, x, z]];
        for quarters in -9..=9_i32 {
            let degrees = 90.0 * f64::from(quarters);
            let place = quarters.rem_euclid(4) as usize;
            for (rotation, expected) in [
                ([degrees, 0.0, 0.0], about_x[place]),
                ([0.0, degrees, 0.0], about_y[place]),
                ([0.0, 0.0, degrees], about_z[place]),
            ] {
                let [right, up, towards] = expected;
                let expected = DMat3::from_cols(right, up, towards);
                assert_eq!(turned(rotation), expected, "{rotation:?}");
            }
        }
    }

    #[test]
    fn angles_between_quarter_turns_are_those_of_a_table() {
        // Of 60 degrees: a half, and half the root of three.
        let (half, root) = (0.5, 3.0_f64.sqrt() / 2.0);
        for (degrees, cos, sin) in [
            (60.0, half, root),
            (120.0, -half, root),
            (150.0, -root, half),
            (210.0, -root, -half),
            (300.0, half, -root),
            (-60.0, half, -root),
            // 2,777,777 turns and 280 degrees.
            (1e9, 0.173_648_177_666_930_33, -0.984_807_753_012_208),
        ] {
            let seen = turned([0.0, 0.0, degrees]).x_axis;
            assert!(
                (seen - DVec3::new(cos, sin, 0.0)).length() < 1e-15,
                "{degrees}: {seen}"
            );
        }
    }

    #[test]
    fn faces_point_outwards_along_the_axes() {
        let expected = [
            DVec3::X,
            DVec3::NEG_X,
            DVec3::Y,
            DVec3::NEG_Y,
            DVec3::Z,
            DVec3::NEG_Z,
        ];
        assert_eq!(
            face_normals(&Mesh::cuboid(DVec3::new(4.0, 3.0, 2.0)).corners),
            expected
        );
    }

    #[test]
    fn a_length_is_right_however_large_or_small() {
        for scale in [1e-300, 1e-100, 1.0, 1e100, 1e300] {
            let long = length(DVec3::new(-3.0, 0.0, 4.0) * scale);
            assert!((long / scale - 5.0).abs() < 1e-14, "{long} at {scale}");
        }
        assert_eq!(length(DVec3::ZERO), 0.0);
    }

    #[test]
    fn what_has_no_direction_has_no_unit_vector() {
        for vector in [
            DVec3::ZERO,
            DVec3::new(f64::INFINITY, 1.0, 0.0),
            DVec3::NEG_INFINITY,
            DVec3::NAN,
        ] {
            assert_eq!(unit(vector), DVec3::ZERO, "{vector}");
        }
    }
}
