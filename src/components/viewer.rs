//! The viewer: one entity with the settings of the picture and of the window.

use glam::DVec3;
use hecs::{Component, Entity, World};
use serde::{Deserialize, Serialize};

use super::camera::Camera;
use super::entity::{get, ordered};
use super::surface::ShadingMode;

/// The camera of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActiveCamera(pub Entity);

/// The colour of pixels without a cuboid, in levels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Background(pub DVec3);

/// The largest error of a shaded pixel against the exact evaluation of its mode, in levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance(pub f64);

impl Tolerance {
    /// The least tolerance above 0, in levels. Levels are f32, which near 255 are 1.5e-5 apart.
    pub const LEAST: f64 = 1e-4;

    /// Whether the tolerance is 0 or in range.
    pub fn is_legal(levels: f64) -> bool {
        levels == 0.0 || (Tolerance::LEAST..=255.0).contains(&levels)
    }
}

impl Default for Tolerance {
    /// It changes a byte by at most one.
    fn default() -> Self {
        Tolerance(0.5)
    }
}

/// The longest time of a frame, in milliseconds. The most exact method within it draws; before times are measured it is
/// the default tolerance. `None` keeps the tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Budget(pub Option<f64>);

/// The rotation of all cuboids about their own x axes since the scene was loaded.
///
/// It counts whole degrees from the scene's own angle, so a full turn ends where it began, bit for bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spin {
    /// 0..360.
    pub degrees: u32,
    /// Whether the cuboids keep turning.
    pub on: bool,
}

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
    /// The picture; a tint shows how each tile was drawn.
    Tiles,
}

/// One side of a wipe.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Side {
    /// The picture of the viewer's own settings.
    Picture,
    /// One mode for all cuboids, and a tolerance in levels.
    Method { mode: ShadingMode, tolerance: f64 },
    /// Exact Phong in f64, drawn independently of the renderer.
    Reference,
}

impl From<Side> for String {
    fn from(side: Side) -> String {
        match side {
            Side::Picture => "picture".to_owned(),
            Side::Reference => "reference".to_owned(),
            Side::Method {
                mode: ShadingMode::UnitVectors,
                ..
            } => "phong-unit-vectors".to_owned(),
            Side::Method { mode, tolerance } => format!("{}-{tolerance}", mode.name()),
        }
    }
}

impl TryFrom<String> for Side {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let method = |mode, levels: &str| {
            let tolerance = levels.parse().ok();
            let tolerance = tolerance.filter(|it| Tolerance::is_legal(*it))?;
            Some(Side::Method { mode, tolerance })
        };
        let side = match text.split_once('-') {
            None if text == "picture" => Some(Side::Picture),
            None if text == "reference" => Some(Side::Reference),
            Some(("phong", "unit-vectors")) => method(ShadingMode::UnitVectors, "0"),
            Some(("phong", levels)) => method(ShadingMode::Phong, levels),
            Some(("gouraud", levels)) => method(ShadingMode::Gouraud, levels),
            _ => None,
        };
        side.ok_or_else(|| {
            format!(
                "invalid value: string {text:?}, expected \"picture\", \"reference\", \"phong-unit-vectors\", or \
                 \"gouraud-\" or \"phong-\" and a tolerance, such as \"phong-0.5\""
            )
        })
    }
}

/// The view in the window, and its wipe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Show {
    pub mode: ViewMode,
    /// Left and right of the divider.
    pub sides: [Side; 2],
    /// The place of the divider, as a share of the picture's width, 0..=1.
    pub divider: f64,
}

impl Default for Show {
    fn default() -> Self {
        let side = |mode| Side::Method {
            mode,
            tolerance: 0.5,
        };
        Show {
            mode: ViewMode::Picture,
            sides: [ShadingMode::Gouraud, ShadingMode::Phong].map(side),
            divider: 0.5,
        }
    }
}

/// The pixel that the inspector explains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Probed(pub Option<[usize; 2]>);

/// The open tab of the window's inspector; `None` is folded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inspector(pub Option<Tab>);

/// A page of the window's inspector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Tab {
    /// The evaluation of the probed pixel.
    Pixel,
    /// Every number of the scene.
    Scene,
    /// The parts of the model that the picture requires.
    Required,
    /// The number of proven pixels.
    Proof,
}

/// The viewer.
///
/// # Panics
/// If there is none; a spawned scene has one.
pub fn viewer(world: &World) -> Entity {
    let mut viewers = world.query::<(Entity, &ActiveCamera)>();
    let (viewer, _) = viewers
        .iter()
        .next()
        .expect("a scene is spawned with a viewer");
    viewer
}

/// A component of the viewer.
///
/// # Panics
/// If there is no viewer.
pub fn look<C: Component + Clone + Default>(world: &World) -> C {
    get(world, viewer(world)).unwrap_or_default()
}

/// The camera of the picture: that of the viewer, or the first one if that was removed.
///
/// # Panics
/// If there is no camera.
pub fn active_camera(world: &World) -> Entity {
    let mut cameras = world.query::<&ActiveCamera>();
    let active = cameras.iter().next().map(|active| active.0);
    active
        .filter(|camera| world.satisfies::<&Camera>(*camera))
        .or_else(|| ordered::<Camera>(world).first().copied())
        .expect("a scene is spawned with a camera")
}
