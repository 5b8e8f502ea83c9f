//! A material in, what its highlights need in every square out: the power, its bound, and how faint one is left out.
//!
//! Rule: what is left out or evaluated more cheaply keeps its share of the tolerance.

use super::bound::Highlight;
use super::specular::Power;
use super::{Surface, limit};
use crate::components::Material;

/// The part of the tolerance that dropped highlights may use up together. More drops more of them and leaves less to all else:
/// a tenth or a half changes the instructions of a frame by 1 to 2 % (default scene and bench-far, tolerance 0.5).
const DROPPED: f64 = 0.25;

/// The part of the tolerance that cheaper powers may use up together. From a thirtieth to a third it makes no difference; without
/// cheaper powers a frame takes 3.5 % more instructions (default scene and bench-far, tolerance 0.5).
const POWERED: f64 = 0.125;

/// What the highlights of one material need in every square.
#[derive(Clone, Copy, Debug)]
pub struct Gloss {
    pub material: Material,
    /// What it was made for, in levels.
    pub tolerance: f64,
    /// For any s.
    pub full: Power,
    /// Perhaps cheaper, and nothing where s is below `least`.
    pub truncated: Power,
    /// What bounds are worked out with.
    pub bound: Highlight,
    /// A highlight whose s stays below this is too faint to be drawn.
    pub least: f64,
    /// What one highlight may lose by that, in levels.
    pub faint: f64,
}

impl Gloss {
    /// For an object under its light.
    pub fn new(surface: &Surface, tolerance: f64) -> Self {
        let shininess = surface.material.shininess;
        let powers = surface.powers().max(1) as f64;
        let brightest = surface
            .illumination
            .points
            .iter()
            .map(|light| surface.coefficients(light)[1].max_element())
            .fold(0.0, f64::max);
        let share = limit(tolerance) / powers;
        let faint = DROPPED * share;
        let least = if brightest <= faint {
            f64::INFINITY
        } else if shininess == 0.0 {
            f64::NEG_INFINITY
        } else {
            // Another libm may differ in the last bit, and then a picture may: only one machine's are the same bits.
            (faint / brightest).powf(1.0 / shininess)
        };
        Gloss {
            material: *surface.material,
            tolerance,
            full: Power::new(shininess, 0.0, 0.0),
            truncated: Power::new(shininess, least, POWERED * share / brightest),
            bound: Highlight::new(shininess),
            least,
            faint,
        }
    }
}
