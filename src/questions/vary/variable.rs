//! A number of a scene and the range over which it varies.

use anyhow::{Context, bail, ensure};
use hecs::World;
use serde::{Serialize, Serializer};
use toml::Value;

use crate::output::chart::ticks;
use crate::questions::job::camera_name;
use crate::scene::SceneRecord;
use crate::scene::key::{self, Key};

/// The ratio of the ends from which on steps are those of the logarithm.
const LOGARITHMIC_FROM: f64 = 10.0;

/// The present value of a key.
///
/// # Errors
/// If the scene has no such number.
pub fn present(key: &Key, record: &SceneRecord) -> anyhow::Result<f64> {
    match key.read(record)? {
        Some(Value::Integer(whole)) => Ok(whole as f64),
        Some(Value::Float(number)) => Ok(number),
        Some(_) => bail!("`{key}` is no number"),
        None => bail!("`{key}` is left out"),
    }
}

/// A key of a scene, and the ends of its range.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Variable {
    #[serde(serialize_with = "as_text")]
    pub key: Key,
    pub from: f64,
    pub to: f64,
    /// Whether steps are those of the logarithm: the ends have one sign, and a ratio of 10 or more.
    pub logarithmic: bool,
    /// Whether the key has whole numbers.
    #[serde(skip)]
    is_whole: bool,
}

fn as_text<S: Serializer>(key: &Key, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(key)
}

impl Variable {
    /// Reads `KEY=FROM..TO` for a scene.
    ///
    /// # Errors
    /// If the text has another form, the scene has no such number, or an end is not legal.
    pub fn parse(text: &str, record: &SceneRecord) -> anyhow::Result<Self> {
        let form = || format!("{text:?} is not KEY=FROM..TO, such as light.white.intensity=1..100");
        let (key, range) = key::split(text).with_context(form)?;
        ensure!(
            !range.contains("..."),
            "`{key}`: {range:?} has three dots, and FROM..TO has two"
        );
        let (from, to) = range.split_once("..").with_context(form)?;
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|it| it.is_finite());
        let ends = number(from).zip(number(to));
        let (from, to) = ends.with_context(form)?;
        Variable::new(key, [from, to], record)
    }

    /// A range of a key, from the lower end to the upper one.
    ///
    /// # Errors
    /// As [`Variable::parse`].
    pub fn new(key: Key, [from, to]: [f64; 2], record: &SceneRecord) -> anyhow::Result<Self> {
        let is_whole = match key.read(record)? {
            Some(Value::Integer(_)) => true,
            // An optional number may be left out.
            Some(Value::Float(_)) | None => false,
            Some(_) => bail!("`{key}` is no number"),
        };
        let (from, to) = (from.min(to), from.max(to));
        ensure!(
            from != to,
            "`{key}`: the range from {from} to {to} has one value"
        );
        let is_legal = |end: &f64| !is_whole || end.fract() == 0.0;
        ensure!(
            [from, to].iter().all(is_legal),
            "`{key}` has whole numbers, and {from} to {to} are not"
        );
        let variable = Variable {
            key,
            from,
            to,
            logarithmic: (from > 0.0 || to < 0.0) && (to / from).max(from / to) >= LOGARITHMIC_FROM,
            is_whole,
        };
        for end in [from, to] {
            variable.scene(record, end)?;
        }
        Ok(variable)
    }

    /// The range of a key that people look at first.
    ///
    /// # Errors
    /// If the scene has no such number.
    pub fn around(key: Key, record: &SceneRecord) -> anyhow::Result<Self> {
        let value = present(&key, record)?;
        let known = key.number();
        let ends = known.map_or([value; 2], |it| it.first_around(value));
        Variable::new(key, ends, record)
    }

    /// Whether it is the zoom of the camera in use.
    pub fn is_zoom(&self, world: &World) -> bool {
        let camera = Key::from("camera").child(&camera_name(world));
        self.key == camera.child("orbit").child("zoom")
    }

    /// A value on a scale on which steps are even. The ratio of two legal values may overflow, their logarithms do not.
    fn scaled(&self, value: f64) -> f64 {
        if self.logarithmic {
            value.abs().log10()
        } else {
            value
        }
    }

    /// The place of a value in the range, 0..=1 in steps.
    pub fn share(&self, value: f64) -> f64 {
        let [value, from, to] = [value, self.from, self.to].map(|it| self.scaled(it));
        (value - from) / (to - from)
    }

    /// The value at a place of the range.
    pub fn at(&self, share: f64) -> f64 {
        let [from, to] = [self.from, self.to].map(|it| self.scaled(it));
        let place = from + (to - from) * share;
        let value = if self.logarithmic {
            10.0_f64.powf(place).copysign(self.from)
        } else {
            place
        };
        match share {
            0.0 => self.from,
            1.0 => self.to,
            _ if self.is_whole => value.round(),
            _ => value,
        }
    }

    /// The values from one end to the other in even steps, without repetitions.
    pub fn values(&self, steps: usize) -> Vec<f64> {
        let last = steps.max(2) - 1;
        let value = |step| self.at(step as f64 / last as f64);
        let mut values: Vec<f64> = (0..=last).map(value).collect();
        values.dedup();
        values
    }

    /// The scene with a value of the key.
    ///
    /// # Errors
    /// If the key may not have it.
    pub fn scene(&self, record: &SceneRecord, value: f64) -> anyhow::Result<SceneRecord> {
        let value = if self.is_whole {
            Value::Integer(value.round() as i64)
        } else {
            Value::Float(value)
        };
        key::set(record, &[(self.key.clone(), value)])
    }

    /// Round values of the range, for an axis.
    pub fn marks(&self) -> Vec<f64> {
        if !self.logarithmic {
            return even(self.from, self.to);
        }
        let (least, most) = (
            self.from.abs().min(self.to.abs()),
            self.from.abs().max(self.to.abs()),
        );
        let marks = ticks(&(least..most)).into_iter();
        marks.map(|mark| mark * self.from.signum()).collect()
    }
}

/// At most seven round numbers in even steps.
fn even(from: f64, to: f64) -> Vec<f64> {
    let least = (to - from) / 6.0;
    let power = 10.0_f64.powf(least.log10().floor());
    let mut steps = [1.0, 2.0, 5.0, 10.0].into_iter().map(|digit| digit * power);
    let round = steps.find(|step| *step >= least).unwrap_or(10.0 * power);
    // The smallest float, where a sixth of the range is below it.
    let step = round.max(f64::from_bits(1));
    let first = (from / step).ceil() as i64;
    let numbers = (first..).map(|number| number as f64 * step);
    numbers.take_while(|value| *value <= to).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_marks_are_round() {
        assert_eq!(even(0.0, 30.0), [0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0]);
        assert_eq!(even(-1.0, 1.0), [-1.0, -0.5, 0.0, 0.5, 1.0]);
        assert_eq!(even(3.0, 4.4), [3.0, 3.5, 4.0]);
    }
}
