//! Lights, and the sums over all of them in one frame.

use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The one term of the model that a light feeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LightKind {
    /// The same everywhere.
    Ambient,
    /// max(0, n.l), from a point.
    Diffuse,
    /// max(0, o.r)^rho, from a point.
    Specular,
}

impl LightKind {
    pub const ALL: [LightKind; 3] = [LightKind::Ambient, LightKind::Diffuse, LightKind::Specular];

    /// The name in scene files and reports.
    pub const fn name(self) -> &'static str {
        match self {
            LightKind::Ambient => "ambient",
            LightKind::Diffuse => "diffuse",
            LightKind::Specular => "specular",
        }
    }
}

/// A light. Its [`Transform`](super::Transform) has its position.
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
    /// Its strength in levels of 255, by channel: color * intensity * gain.
    pub fn strength(&self) -> DVec3 {
        self.color * (self.intensity * self.gain)
    }
}

/// The sums over all lights that are on, gathered once a frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Illumination {
    /// Sum over the ambient lights, in levels per unit of kappa A.
    pub ambient: DVec3,
    /// The point lights, ordered by position. Lights at one position are summed.
    pub points: Vec<PointLight>,
}

/// The sums over the diffuse and specular lights at one position, which share l and r.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// In world units.
    pub position: DVec3,
    /// Levels per unit of kappa D.
    pub diffuse: DVec3,
    /// Levels per unit of kappa E.
    pub specular: DVec3,
}
