//! What the numbers and names of a record must be: each within its range, and what belongs together.
//!
//! A record is checked whatever it comes from: a file, a recording, or edits in the window.

use std::collections::HashSet;

use glam::DVec3;

use super::error::{Mistake, Place};
use super::range::{
    ANGLE, COORDINATE, FIELD_OF_VIEW, LENGTH, LEVEL, ORBIT, SHARE, SHININESS, STRENGTH, ZOOM,
};
use super::record::{CameraRecord, CuboidRecord, LightRecord, SceneRecord, ViewRecord};
use crate::components::{Budget, LightKind, Magnifier, Orbit, Tolerance, length, unit};

/// An `up` is parallel to the view where the sine of the angle between them is smaller.
const PARALLEL: f64 = 1e-9;

/// The longest side of a picture, in pixels.
pub const MAX_SIDE: usize = 16_384;

impl SceneRecord {
    /// Whether everything is within its range and goes together.
    ///
    /// # Errors
    /// The first mistake.
    pub fn check(&self) -> Result<(), Mistake> {
        for (index, level) in self.background.to_array().into_iter().enumerate() {
            Place::new("background", index).number("", level, &LEVEL)?;
        }
        for (kind, count) in [("cuboid", self.cuboid.len()), ("camera", self.camera.len())] {
            let expected = format!("one or more tables, each headed `[[{kind}]]`");
            Place::new(kind, 0).is("", count, count > 0, &expected)?;
        }
        each("cuboid", &self.cuboid, |it| &it.name, CuboidRecord::check)?;
        each("light", &self.light, |it| &it.name, LightRecord::check)?;
        each("camera", &self.camera, |it| &it.name, CameraRecord::check)?;
        let place = Place::new("view", 0);
        self.view.check(&place)?;
        let names: Vec<&str> = self.camera.iter().map(|it| &*it.name).collect();
        let camera = self.view.camera.as_deref().unwrap_or(names[0]);
        let expected = format!("the name of a camera: {}", names.join(", "));
        place.is("camera", camera, names.contains(&camera), &expected)
    }

    /// The first light whose colour is written in levels, which makes it some 255 times as bright as was meant.
    pub(super) fn slip(&self) -> Option<Mistake> {
        let is_slip = |light: &LightRecord| light.color.max_element() > 1.0;
        let index = self.light.iter().position(is_slip)?;
        let most = self.light[index].color.max_element();
        let message = format!(
            "{most:?} is above 1; a colour is usually from 0 to 1, and `intensity` says how bright it is"
        );
        Some(Place::new("light", index).mistake("color", message))
    }
}

/// Whether the names of a kind are its own, and everything else about each is right.
fn each<T>(
    kind: &'static str,
    all: &[T],
    name: impl Fn(&T) -> &String,
    check: impl Fn(&T, &Place) -> Result<(), Mistake>,
) -> Result<(), Mistake> {
    let other = format!("a name that no other {kind} has");
    let mut known = HashSet::new();
    for (index, it) in all.iter().enumerate() {
        let (place, name) = (Place::new(kind, index), name(it));
        place.is("name", name, known.insert(name), &other)?;
        place.is("name", name, !name.is_empty(), "a name that is not empty")?;
        check(it, &place)?;
    }
    Ok(())
}

impl CuboidRecord {
    fn check(&self, place: &Place) -> Result<(), Mistake> {
        let material = &self.material;
        place.three("size", self.size, &LENGTH)?;
        place.three("position", self.position, &COORDINATE)?;
        place.three("rotation", self.rotation, &ANGLE)?;
        place.three("material.ambient", material.ambient, &STRENGTH)?;
        place.three("material.diffuse", material.diffuse, &STRENGTH)?;
        place.three("material.specular", material.specular, &STRENGTH)?;
        place.number("material.shininess", material.shininess, &SHININESS)
    }
}

impl LightRecord {
    fn check(&self, place: &Place) -> Result<(), Mistake> {
        // The command line writes lists of lights with commas between them.
        let is_name = !["all", "none"].contains(&&*self.name) && !self.name.contains(',');
        let expected = "a name that holds no comma and is not \"all\" or \"none\"";
        place.is("name", &self.name, is_name, expected)?;
        place.three("color", self.color, &STRENGTH)?;
        place.number("intensity", self.intensity, &STRENGTH)?;
        place.number("gain", self.gain, &STRENGTH)?;
        let is_ambient = self.kind == LightKind::Ambient;
        let message = match self.position {
            Some(position) if !is_ambient => {
                return place.three("position", position, &COORDINATE);
            }
            None if is_ambient => return Ok(()),
            Some(_) => "unknown field of an ambient light, which is everywhere alike",
            None => "missing, expected three numbers; only an ambient light has none",
        };
        Err(place.mistake("position", message.to_owned()))
    }
}

impl CameraRecord {
    fn check(&self, place: &Place) -> Result<(), Mistake> {
        let Orbit {
            azimuth,
            elevation,
            zoom,
        } = self.orbit;
        place.three("position", self.position, &COORDINATE)?;
        place.three("target", self.target, &COORDINATE)?;
        place.three("up", self.up, &COORDINATE)?;
        place.number("fov", self.fov, &FIELD_OF_VIEW)?;
        place.number("height", self.height, &LENGTH)?;
        place.number("near", self.near.unwrap_or(1.0), &LENGTH)?;
        place.number("orbit.azimuth", azimuth, &ORBIT)?;
        place.number("orbit.elevation", elevation, &ORBIT)?;
        place.number("orbit.zoom", zoom, &ZOOM)?;

        let view = self.target - self.position;
        let (target, up) = (self.target.to_array(), self.up.to_array());
        // The default near plane, a thousandth of this distance, must not underflow.
        let expected = "a point at least 1e-100 away from `camera.position`";
        place.is("target", target, length(view) >= 1e-100, expected)?;
        let is_parallel = unit(self.up).cross(unit(view)).length() < PARALLEL;
        // A usual `up` is hardly ever said, nor is it what is wrong.
        if self.up == DVec3::Y {
            let expected =
                "a point that is not above or below `camera.position`, as `camera.up` is +y";
            place.is("target", target, !is_parallel, expected)?;
        }
        let expected =
            "a direction that is neither zero nor parallel to the view, target - position";
        place.is("up", up, !is_parallel, expected)?;
        let seen = [length(view), self.height].map(|it| it * zoom);
        let is_seen = zoom == 1.0 || seen.iter().all(|it| LENGTH.contains(it));
        let expected = "a zoom that leaves distance and height from 1e-100 to 1e100";
        place.is("orbit", zoom, is_seen, expected)
    }
}

impl ViewRecord {
    fn check(&self, place: &Place) -> Result<(), Mistake> {
        let is_tolerance = Tolerance::is_legal(self.tolerance);
        let expected = "0 or a number from 0.0001 to 255";
        place.is("tolerance", self.tolerance, is_tolerance, expected)?;
        if let Some(budget) = self.budget {
            place.number("budget", budget, &Budget::RANGE)?;
            let is_alone = self.tolerance == Tolerance::default().0;
            let expected = "either a budget or a tolerance";
            place.is("budget", budget, is_alone, expected)?;
        }
        place.number("divider", self.divider, &SHARE)?;
        let expected = "a whole number of degrees from 0 to 359";
        place.is("turned", self.turned, self.turned < 360, expected)?;
        let Magnifier { scale, corner } = self.magnifier;
        let is_scale = scale.is_power_of_two() && scale <= Magnifier::MAX_SCALE;
        place.is(
            "magnifier.scale",
            scale,
            is_scale,
            "a power of two from 1 to 64",
        )?;
        for (key, pixel) in [
            ("magnifier.corner", corner),
            ("pixel", self.pixel.unwrap_or_default()),
        ] {
            let is_pixel = pixel.iter().all(|it| *it < MAX_SIDE);
            place.is(key, pixel, is_pixel, "two whole numbers from 0 to 16383")?;
        }
        Ok(())
    }
}
