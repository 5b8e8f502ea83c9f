//! The check of names and of values that belong together. serde has checked types and ranges before.
//!
//! Records from files, from recordings and from edits in the window pass this check.

use std::collections::HashSet;
use std::fmt::Debug;
use std::ops::Range;

use glam::DVec3;

use super::record::{CameraRecord, LightRecord, SceneRecord, ViewRecord};
use crate::components::range::Length;
use crate::components::{LightKind, Tolerance, length, unit};

/// `up` and the view are parallel if the sine of their angle is smaller.
const PARALLEL: f64 = 1e-9;

/// The longest side of a picture, in pixels.
pub const MAX_SIDE: usize = 16_384;

/// An illegal value, and its place: a key of a table, which is given by its kind and its index.
#[derive(Debug, thiserror::Error)]
#[error("`{kind}{}{key}`: {message}", if key.is_empty() { "" } else { "." })]
pub struct Mistake {
    kind: &'static str,
    index: usize,
    /// Its parts are separated by dots; empty is the whole table.
    key: &'static str,
    message: String,
}

/// The kind and the index of a table.
type At = (&'static str, usize);

impl Mistake {
    fn new((kind, index): At, key: &'static str, message: impl Into<String>) -> Self {
        Mistake {
            kind,
            index,
            key,
            message: message.into(),
        }
    }

    /// The bytes of the value in the text, or those of its table if the key is missing.
    pub(super) fn span(&self, text: &str) -> Range<usize> {
        let span = toml_edit::Document::parse(text).ok().and_then(|document| {
            let all = document.get(self.kind)?;
            let table = all.get(self.index).unwrap_or(all);
            let item = self
                .key
                .split('.')
                .fold(table, |item, key| item.get(key).unwrap_or(item));
            item.span()
        });
        span.unwrap_or_default()
    }
}

/// Refuses the value `found` at a key unless it is legal.
fn require(
    is_legal: bool,
    at: At,
    key: &'static str,
    found: impl Debug,
    expected: &str,
) -> Result<(), Mistake> {
    if is_legal {
        return Ok(());
    }
    let message = format!("invalid value: {found:?}, expected {expected}");
    Err(Mistake::new(at, key, message))
}

impl SceneRecord {
    /// Checks every name, and the relations between values.
    ///
    /// # Errors
    /// The first mistake.
    pub fn check(&self) -> Result<(), Mistake> {
        for (kind, count) in [("cuboid", self.cuboid.len()), ("camera", self.camera.len())] {
            let expected = format!("one or more tables, each headed `[[{kind}]]`");
            require(count > 0, (kind, 0), "", count, &expected)?;
        }
        check_names("cuboid", self.cuboid.iter().map(|it| &*it.name))?;
        check_names("light", self.light.iter().map(|it| &*it.name))?;
        check_names("camera", self.camera.iter().map(|it| &*it.name))?;
        for (index, light) in self.light.iter().enumerate() {
            light.check(("light", index))?;
        }
        for (index, camera) in self.camera.iter().enumerate() {
            camera.check(("camera", index))?;
        }
        self.view.check()?;
        let names: Vec<&str> = self.camera.iter().map(|it| &*it.name).collect();
        let expected = format!("the name of a camera: {}", names.join(", "));
        let found = self.view.camera.as_deref().unwrap_or_default();
        let is_known = self.active_camera().is_some();
        require(is_known, ("view", 0), "camera", found, &expected)
    }
}

/// Checks that the names of a kind are unique and not empty.
fn check_names<'a>(
    kind: &'static str,
    names: impl Iterator<Item = &'a str>,
) -> Result<(), Mistake> {
    let mut known = HashSet::from([""]);
    for (index, name) in names.enumerate() {
        let expected = format!("a name that is not empty and that no other {kind} has");
        require(known.insert(name), (kind, index), "name", name, &expected)?;
    }
    Ok(())
}

impl LightRecord {
    fn check(&self, at: At) -> Result<(), Mistake> {
        // On the command line commas separate lights.
        let is_name = !["all", "none"].contains(&&*self.name) && !self.name.contains(',');
        let expected = "a name that holds no comma and is not \"all\" or \"none\"";
        require(is_name, at, "name", &self.name, expected)?;
        let message = match (self.position, self.kind) {
            (Some(_), LightKind::Ambient) => "an ambient light has none: it is everywhere alike",
            (None, LightKind::Diffuse | LightKind::Specular) => {
                "missing, expected three numbers; only an ambient light has none"
            }
            _ => return Ok(()),
        };
        Err(Mistake::new(at, "position", message))
    }
}

impl CameraRecord {
    fn check(&self, at: At) -> Result<(), Mistake> {
        let view = self.target - self.position;
        // The default near plane, a thousandth of this distance, must not underflow.
        let is_apart = length(view) >= 1e-100;
        let expected = "a point at least 1e-100 away from `camera.position`";
        require(is_apart, at, "target", self.target.to_array(), expected)?;
        let is_across = unit(self.up).cross(unit(view)).length() >= PARALLEL;
        // The default `up` is rarely in the file, and rarely the mistake.
        let (key, found, expected) = if self.up == DVec3::Y {
            let expected =
                "a point that is not above or below `camera.position`, as `camera.up` is +y";
            ("target", self.target, expected)
        } else {
            let expected =
                "a direction that is neither zero nor parallel to the view, target - position";
            ("up", self.up, expected)
        };
        require(is_across, at, key, found.to_array(), expected)?;
        let zoom = self.orbit.zoom;
        let is_seen = zoom == 1.0
            || [length(view), self.height]
                .iter()
                .all(|it| Length::RANGE.contains(&(it * zoom)));
        let expected = "a zoom that leaves distance and height from 1e-100 to 1e100";
        require(is_seen, at, "orbit.zoom", zoom, expected)
    }
}

impl ViewRecord {
    fn check(&self) -> Result<(), Mistake> {
        let at = ("view", 0);
        let is_legal = Tolerance::is_legal(self.tolerance);
        let expected = "0 or a number from 0.0001 to 255";
        require(is_legal, at, "tolerance", self.tolerance, expected)?;
        let is_alone = self.budget.is_none() || self.tolerance == Tolerance::default().0;
        let expected = "either a budget or a tolerance";
        require(
            is_alone,
            at,
            "budget",
            self.budget.unwrap_or_default(),
            expected,
        )?;
        let expected = "a whole number of degrees from 0 to 359";
        require(self.turned < 360, at, "turned", self.turned, expected)?;
        let pixel = self.pixel.unwrap_or_default();
        let is_pixel = pixel.iter().all(|it| *it < MAX_SIDE);
        let expected = "two whole numbers from 0 to 16383";
        require(is_pixel, at, "pixel", pixel, expected)?;
        Ok(())
    }
}
