//! The viewer: one entity with the settings of the picture.

use glam::DVec3;
use hecs::{Entity, Ref, RefMut, World};
use serde::{Deserialize, Serialize};

use super::camera::{Camera, Projection};
use super::entity::{Name, in_file_order};
use super::numbers::{array, some_two};
use super::surface::{Segments, ShadingMode};

/// The viewer, a component of one entity: the table `[view]` of a scene file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "a table")]
pub struct Viewer {
    /// The name of the active camera; `None` is the first one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<String>,
    pub projection: Projection,
    /// The largest error of a shaded pixel against the exact evaluation of its mode, in levels.
    pub tolerance: f64,
    /// The longest time of a frame, in milliseconds, in place of the tolerance. The most exact method within it draws;
    /// before times are measured it is the default tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub budget: Option<f64>,
    pub show: ViewMode,
    /// Left and right of the divider of a wipe.
    #[serde(deserialize_with = "array")]
    pub sides: [Side; 2],
    /// The place of the divider, as a share of the picture's width.
    pub divider: f64,
    /// Degrees that all cuboids have turned about their own x axes, 0..360. Whole degrees from the scene's own angle: a full
    /// turn ends where it began, bit for bit.
    pub turned: u32,
    /// The place that is explained, from the picture's middle, right and down, in heights of the picture. The field of view is
    /// vertical, so it is the same place of the scene in pictures of any size.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "some_two")]
    pub pixel: Option<[f64; 2]>,
    /// Whether the cuboids keep turning. It is not part of a scene.
    #[serde(skip)]
    pub turns: bool,
}

impl Viewer {
    /// The default tolerance, in levels. It changes a byte by at most one.
    pub const TOLERANCE: f64 = 0.5;
    /// The least tolerance above 0, in levels. Levels are f32, which near 255 are 1.5e-5 apart.
    pub const LEAST_TOLERANCE: f64 = 1e-4;

    /// Whether a tolerance is 0 or in range.
    pub fn may_have(tolerance: f64) -> bool {
        tolerance == 0.0 || (Viewer::LEAST_TOLERANCE..=255.0).contains(&tolerance)
    }

    /// The explained pixel of a picture of this size, on which the camera's height has `rows` pixels; `None` if its place lies
    /// outside.
    pub fn pixel_in(&self, size: [usize; 2], rows: f64) -> Option<[usize; 2]> {
        let place = self.pixel?;
        let pixel = [0, 1].map(|axis| {
            let at = place[axis] * rows + size[axis] as f64 / 2.0;
            let is_inside = (0.0..size[axis] as f64).contains(&at);
            is_inside.then_some(at as usize)
        });
        Some([pixel[0]?, pixel[1]?])
    }

    /// Explains a pixel of a picture of this size, on which the camera's height has `rows` pixels.
    pub fn set_pixel(&mut self, pixel: [usize; 2], size: [usize; 2], rows: f64) {
        self.pixel = Some([0, 1].map(|axis| {
            let offset = pixel[axis] as f64 + 0.5 - size[axis] as f64 / 2.0;
            // Short numbers for scene files: less than a hundredth of a pixel in the largest picture.
            (offset / rows * 1e6).round() / 1e6
        }));
    }
}

impl Default for Viewer {
    fn default() -> Self {
        Viewer {
            camera: None,
            projection: Projection::default(),
            tolerance: Viewer::TOLERANCE,
            budget: None,
            show: ViewMode::Picture,
            sides: Side::gouraud_phong(Viewer::TOLERANCE),
            divider: 0.5,
            turned: 0,
            pixel: None,
            turns: false,
        }
    }
}

/// The colour of pixels without a cuboid, in levels; a component of the viewer's entity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Background(pub DVec3);

/// The view in the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ViewMode {
    /// The picture.
    #[default]
    Picture,
    /// Two pictures, left and right of a divider.
    Wipe,
    /// The error against exact Phong.
    Error,
    /// The picture; a tint shows how each square was drawn.
    Tiles,
    /// The picture by ambient, diffuse and specular lights alone, and by all.
    Terms,
}

/// One side of a wipe.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Side {
    /// The picture of the viewer's own settings.
    Picture,
    /// One mode and number of segments for all cuboids (`None` leaves each its own), and a tolerance in levels.
    Method {
        mode: ShadingMode,
        segments: Option<Segments>,
        tolerance: f64,
    },
    /// Exact Phong in f64, drawn independently of the renderer.
    Reference,
}

impl Side {
    /// Gouraud and Phong, both within this tolerance.
    pub fn gouraud_phong(tolerance: f64) -> [Side; 2] {
        [ShadingMode::Gouraud, ShadingMode::Phong].map(|mode| Side::Method {
            mode,
            segments: None,
            tolerance,
        })
    }
}

impl From<Side> for String {
    fn from(side: Side) -> String {
        let (mode, segments, tolerance) = match side {
            Side::Picture => return "picture".to_owned(),
            Side::Reference => return "reference".to_owned(),
            Side::Method {
                mode,
                segments,
                tolerance,
            } => (mode, segments, tolerance),
        };
        match mode {
            ShadingMode::Flat => "flat".to_owned(),
            ShadingMode::UnitVectors => "phong-unit-vectors".to_owned(),
            ShadingMode::BlinnPhong => "blinn-phong".to_owned(),
            ShadingMode::Gouraud | ShadingMode::Phong => {
                let count = segments.map(Segments::count);
                let cells = count.map_or_else(String::new, |it| format!("-{it}x{it}"));
                format!("{}{cells}-{tolerance}", mode.name())
            }
        }
    }
}

impl TryFrom<String> for Side {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let of = |mode, segments, levels: &str| {
            let tolerance = levels.parse().ok().filter(|it| Viewer::may_have(*it))?;
            Some(Side::Method {
                mode,
                segments,
                tolerance,
            })
        };
        let method = |mode, levels: &str| of(mode, None, levels);
        let gouraud = |rest: &str| {
            let Some((cells, levels)) = rest.split_once('-').filter(|(it, _)| it.contains('x'))
            else {
                return method(ShadingMode::Gouraud, rest);
            };
            let (one, other) = cells.split_once('x')?;
            let segments = Segments::new(one.parse().ok()?);
            (one == other).then(|| of(ShadingMode::Gouraud, Some(segments?), levels))?
        };
        let side = match text.split_once('-') {
            None if text == "picture" => Some(Side::Picture),
            None if text == "reference" => Some(Side::Reference),
            None if text == "flat" => method(ShadingMode::Flat, "0"),
            Some(("blinn", "phong")) => method(ShadingMode::BlinnPhong, "0"),
            Some(("phong", "unit-vectors")) => method(ShadingMode::UnitVectors, "0"),
            Some(("phong", levels)) => method(ShadingMode::Phong, levels),
            Some(("gouraud", rest)) => gouraud(rest),
            _ => None,
        };
        side.ok_or_else(|| {
            format!(
                "invalid value: string {text:?}, expected \"picture\", \"reference\", \"flat\", \"blinn-phong\", \"phong-unit-vectors\", or \
                 \"gouraud-\" or \"phong-\" and a tolerance, such as \"phong-0.5\" or \"gouraud-8x8-0.5\""
            )
        })
    }
}

fn viewer_entity(world: &World) -> Entity {
    let mut viewers = world.query::<(Entity, &Viewer)>();
    let found = viewers.iter().next().map(|(entity, _)| entity);
    found.expect("a scene is spawned with a viewer")
}

/// The viewer.
///
/// # Panics
/// If there is none; a spawned scene has one.
pub fn viewer(world: &World) -> Ref<'_, Viewer> {
    let viewer = world.get::<&Viewer>(viewer_entity(world));
    viewer.expect("it was just found")
}

/// The viewer, to be changed.
///
/// # Panics
/// As [`viewer`].
pub fn viewer_mut(world: &mut World) -> RefMut<'_, Viewer> {
    let viewer = world.get::<&mut Viewer>(viewer_entity(world));
    viewer.expect("it was just found")
}

/// The colour of pixels without a cuboid, in levels; black if there is no viewer.
pub fn background(world: &World) -> DVec3 {
    let mut backgrounds = world.query::<&Background>();
    backgrounds.iter().next().copied().unwrap_or_default().0
}

/// The active camera of the viewer, or the first one if there is no camera of its name.
///
/// # Panics
/// If there is no camera.
pub fn active_camera(world: &World) -> Entity {
    let active = &viewer(world).camera;
    let cameras = in_file_order::<(Entity, &Name, &Camera), _>(world, |(entity, name, _)| {
        (active.as_ref() != Some(&name.0), entity)
    });
    let first = cameras.into_iter().min_by_key(|(is_other, _)| *is_other);
    first.expect("a scene is spawned with a camera").1
}
