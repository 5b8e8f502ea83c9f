//! The check of names and of values that belong together. Types and ranges are checked before.
//!
//! Records from files, from lessons and from edits in the window pass this check.

use std::collections::HashSet;
use std::fmt::Debug;

use glam::DVec3;

use super::read::Mistake;
use super::record::{CameraRecord, LightRecord, SceneRecord};
use crate::components::numbers::range_of;
use crate::components::{LightKind, Viewer, length, unit};

/// `up` and the view are parallel if the sine of their angle is smaller.
const PARALLEL: f64 = 1e-9;

/// Refuses the value `found` at a key unless it is legal.
fn require(is_legal: bool, key: &str, found: impl Debug, expected: &str) -> Result<(), Mistake> {
    if is_legal {
        return Ok(());
    }
    let why = format!("invalid value: {found:?}, expected {expected}");
    Err(Mistake::new(key, why))
}

impl SceneRecord {
    /// Checks every name, and the relations between values.
    ///
    /// # Errors
    /// The first mistake.
    pub fn check(&self) -> Result<(), Mistake> {
        let at = |kind: &'static str, index: usize| {
            move |mistake: Mistake| mistake.within(&index.to_string()).within(kind)
        };
        let cuboids: Vec<&str> = self.cuboid.iter().map(|it| &*it.name).collect();
        let lights: Vec<&str> = self.light.iter().map(|it| &*it.name).collect();
        let cameras: Vec<&str> = self.camera.iter().map(|it| &*it.name).collect();
        let kinds = ["cuboid", "light", "camera"].into_iter();
        for (kind, names) in kinds.zip([&cuboids, &lights, &cameras]) {
            let is_enough = kind == "light" || !names.is_empty();
            let expected = format!("one or more tables, each headed `[[{kind}]]`");
            require(is_enough, kind, names.len(), &expected)?;
            let mut known = HashSet::from([""]);
            let expected = format!("a name that is not empty and that no other {kind} has");
            for (index, name) in names.iter().enumerate() {
                let is_new = known.insert(name);
                require(is_new, "name", name, &expected).map_err(at(kind, index))?;
            }
        }
        for (index, light) in self.light.iter().enumerate() {
            light.check().map_err(at("light", index))?;
        }
        for (index, camera) in self.camera.iter().enumerate() {
            camera.check().map_err(at("camera", index))?;
        }
        check_viewer(&self.view, &cameras).map_err(|mistake| mistake.within("view"))
    }
}

impl LightRecord {
    fn check(&self) -> Result<(), Mistake> {
        // On the command line commas separate lights.
        let is_name = !["all", "none"].contains(&&*self.name) && !self.name.contains(',');
        let expected = "a name that holds no comma and is not \"all\" or \"none\"";
        require(is_name, "name", &self.name, expected)?;
        let message = match (self.position, self.kind) {
            (Some(_), LightKind::Ambient) => "an ambient light has none: it is everywhere alike",
            (None, LightKind::Diffuse | LightKind::Specular) => {
                "missing, expected three numbers; only an ambient light has none"
            }
            _ => return Ok(()),
        };
        Err(Mistake::new("position", message))
    }
}

impl CameraRecord {
    fn check(&self) -> Result<(), Mistake> {
        let view = self.target - self.position;
        // The default near plane, a thousandth of this distance, must not underflow.
        let is_apart = length(view) >= 1e-100;
        let expected = "a point at least 1e-100 away from `camera.position`";
        require(is_apart, "target", self.target.to_array(), expected)?;
        let is_across = unit(self.up).cross(unit(view)).length() >= PARALLEL;
        // The default `up` is rarely in the file, and rarely the mistake.
        let (key, found, expected) = if self.up == DVec3::Y {
            (
                "target",
                self.target,
                "a point that is not above or below `camera.position`, as `camera.up` is +y",
            )
        } else {
            (
                "up",
                self.up,
                "a direction that is neither zero nor parallel to the view, target - position",
            )
        };
        require(is_across, key, found.to_array(), expected)?;
        let zoom = self.orbit.zoom;
        let is_length = |size: f64| range_of("height").contains(&(size * zoom));
        let is_seen = zoom == 1.0 || is_length(length(view)) && is_length(self.height);
        let expected = "a zoom that leaves distance and height from 1e-100 to 1e100";
        require(is_seen, "orbit.zoom", zoom, expected)
    }
}

/// Checks the viewer against the names of the cameras.
fn check_viewer(view: &Viewer, cameras: &[&str]) -> Result<(), Mistake> {
    let tolerance = view.tolerance;
    let expected = "0 or a number from 0.0001 to 255";
    let is_legal = Viewer::may_have(tolerance);
    require(is_legal, "tolerance", tolerance, expected)?;
    let budget = view.budget.unwrap_or_default();
    let is_alone = view.budget.is_none() || tolerance == Viewer::TOLERANCE;
    require(is_alone, "budget", budget, "either a budget or a tolerance")?;
    let camera = view.camera.as_deref();
    let is_known = camera.is_none_or(|name| cameras.contains(&name));
    let expected = format!("the name of a camera: {}", cameras.join(", "));
    require(is_known, "camera", camera.unwrap_or_default(), &expected)
}
