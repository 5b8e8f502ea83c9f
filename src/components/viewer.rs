//! The viewer: one entity whose components say how the scene is looked at.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use glam::DVec3;
use hecs::{Entity, World};
use serde::{Deserialize, Serialize};

use super::{Camera, ShadingMode, ordered};

/// The camera that is looked through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActiveCamera(pub Entity);

/// The colour where nothing is drawn, in levels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Background(pub DVec3);

/// The largest error of a shaded pixel against the exact evaluation of its mode, in levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance(pub f64);

impl Tolerance {
    /// The least but 0, in levels: levels are f32, which near 255 are 1.5e-5 apart.
    pub const LEAST: f64 = 1e-4;

    /// Whether a picture can be drawn within this many levels.
    pub fn is_legal(levels: f64) -> bool {
        levels == 0.0 || (Tolerance::LEAST..=255.0).contains(&levels)
    }
}

impl Default for Tolerance {
    /// It changes a byte by one at most.
    fn default() -> Self {
        Tolerance(0.5)
    }
}

/// The longest time of a frame, in milliseconds: where there is one, the most exact method that holds it draws, and the
/// tolerance is the usual one where no time was measured. `None` holds the tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Budget(pub Option<f64>);

impl Budget {
    /// In milliseconds.
    pub const RANGE: RangeInclusive<f64> = 0.001..=10_000.0;
}

/// How far all cuboids have turned about their own x axes since the scene was loaded.
///
/// Whole degrees counted from the scene's own angle: nothing drifts, and a full turn ends where it began, bit for bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spin {
    /// 0..360.
    pub degrees: u32,
    /// Whether they go on turning.
    pub on: bool,
}

/// What the window shows of the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ViewMode {
    /// The picture as it is shaded.
    #[default]
    Picture,
    /// One side left of a divider, the other right of it.
    Wipe,
    /// How far the picture errs from exact Phong.
    Error,
    /// The difference to exact Phong, amplified until it is seen.
    Difference,
    /// The picture, each tile tinted by how it was drawn.
    Tiles,
}

impl ViewMode {
    pub const ALL: [ViewMode; 5] = [
        ViewMode::Picture,
        ViewMode::Wipe,
        ViewMode::Error,
        ViewMode::Difference,
        ViewMode::Tiles,
    ];

    /// What scene files call it.
    pub const fn name(self) -> &'static str {
        match self {
            ViewMode::Picture => "picture",
            ViewMode::Wipe => "wipe",
            ViewMode::Error => "error",
            ViewMode::Difference => "difference",
            ViewMode::Tiles => "tiles",
        }
    }
}

/// One side of a wipe.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Side {
    /// The picture as the rest of the state says.
    Picture,
    /// Every cuboid shaded so, within so many levels.
    Method { mode: ShadingMode, tolerance: f64 },
    /// Exact Phong in f64, drawn independently of the renderer.
    Reference,
}

/// What a side's text calls the modes that take a tolerance.
const MODES: [(&str, ShadingMode); 2] = [
    ("gouraud-", ShadingMode::Gouraud),
    ("phong-", ShadingMode::Phong),
];

impl fmt::Display for Side {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Side::Picture => formatter.write_str("picture"),
            Side::Reference => formatter.write_str("reference"),
            Side::Method {
                mode: ShadingMode::UnitVectors,
                ..
            } => formatter.write_str("phong-unit-vectors"),
            Side::Method { mode, tolerance } => write!(formatter, "{}-{tolerance}", mode.name()),
        }
    }
}

impl FromStr for Side {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "picture" => return Ok(Side::Picture),
            "reference" => return Ok(Side::Reference),
            "phong-unit-vectors" => {
                return Ok(Side::Method {
                    mode: ShadingMode::UnitVectors,
                    tolerance: 0.0,
                });
            }
            _ => {}
        }
        let method = |(prefix, mode): (&str, ShadingMode)| {
            let tolerance = text.strip_prefix(prefix)?.parse().ok()?;
            Tolerance::is_legal(tolerance).then_some(Side::Method { mode, tolerance })
        };
        MODES.into_iter().find_map(method).ok_or_else(|| {
            format!(
                "invalid value: string {text:?}, expected \"picture\", \"reference\", \"phong-unit-vectors\", or \
                 \"gouraud-\" or \"phong-\" and a tolerance, such as \"phong-0.5\""
            )
        })
    }
}

impl From<Side> for String {
    fn from(side: Side) -> String {
        side.to_string()
    }
}

impl TryFrom<String> for Side {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

/// What the window shows, and its wipe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Show {
    pub mode: ViewMode,
    /// Left and right of the divider.
    pub sides: [Side; 2],
    /// Where the divider is, as a share of the picture's width, 0..=1.
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

/// The pixel of the picture that is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Probed(pub Option<[usize; 2]>);

/// The tab that the window's inspector shows; `None` is folded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inspector(pub Option<Tab>);

/// A page of the window's inspector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Tab {
    /// What happened at the probed pixel.
    Pixel,
    /// Every number of the scene.
    Scene,
    /// What the picture requires.
    Required,
    /// How many pixels are proven.
    Proof,
}

impl Tab {
    pub const ALL: [Tab; 4] = [Tab::Pixel, Tab::Scene, Tab::Required, Tab::Proof];

    /// What scene files call it.
    pub const fn name(self) -> &'static str {
        match self {
            Tab::Pixel => "pixel",
            Tab::Scene => "scene",
            Tab::Required => "required",
            Tab::Proof => "proof",
        }
    }
}

/// The viewer.
///
/// # Panics
/// When there is none: a scene is spawned with it.
pub fn viewer(world: &World) -> Entity {
    let mut viewers = world.query::<(Entity, &ActiveCamera)>();
    let (viewer, _) = viewers
        .iter()
        .next()
        .expect("a scene is spawned with a viewer");
    viewer
}

/// The camera that is looked through: the viewer's, or the first where that one is gone.
///
/// # Panics
/// When there is no viewer or no camera.
pub fn active_camera(world: &World) -> Entity {
    let mut cameras = world.query::<&ActiveCamera>();
    let active = cameras.iter().next().map(|active| active.0);
    active
        .filter(|camera| world.satisfies::<&Camera>(*camera))
        .or_else(|| ordered::<Camera>(world).first().copied())
        .expect("a scene is spawned with a camera")
}
