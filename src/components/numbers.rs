//! The numbers of a scene file: one table with their keys, the letters of their parts, and their ranges.

use std::ops::RangeInclusive;

use glam::DVec3;
use serde::de::Error;
use serde::{Deserialize, Deserializer};

use self::First::{Around, Ends, Times};

/// The numbers at a key of a scene file.
#[derive(Debug)]
pub struct Number {
    /// The last part of the key.
    pub key: &'static str,
    /// The letters of a vector or of a colour; none of a single number.
    pub letters: &'static str,
    /// The legal values. NaN is in no range.
    pub range: RangeInclusive<f64>,
    /// The range that people look at first.
    pub first: First,
    pub is_whole: bool,
}

/// A range of values to look at.
#[derive(Debug)]
pub enum First {
    /// From one value to another.
    Ends([f64; 2]),
    /// The present value times these factors.
    Times([f64; 2]),
    /// From below the present value to above it, as far as it is from 0, and at least 1.
    Around,
}

const LENGTH: [f64; 2] = [1e-100, 1e100];
const COORDINATE: [f64; 2] = [-1e100, 1e100];
const STRENGTH: [f64; 2] = [0.0, 1e30];
const ANY: [f64; 2] = [f64::MIN, f64::MAX];
/// The least float above 0: a range that begins here does not hold 0.
const ABOVE_0: f64 = 5e-324;
const TENFOLD: First = Times([0.1, 10.0]);

/// Lengths are in world units, angles in degrees, strengths in levels. Heights of a picture count from its middle: the largest
/// picture is 16384 pixels wide and one high.
const NUMBERS: [Number; 25] = [
    number("background", "rgb", [0.0, 255.0], Ends([0.0, 255.0])),
    number("size", "xyz", LENGTH, TENFOLD),
    number("position", "xyz", COORDINATE, Around),
    number("rotation", "xyz", ANY, Ends([-180.0, 180.0])),
    whole("segments", [1.0, 256.0]),
    number("ambient", "rgb", STRENGTH, Ends([0.0, 1.0])),
    number("diffuse", "rgb", STRENGTH, Ends([0.0, 1.0])),
    number("specular", "rgb", STRENGTH, Ends([0.0, 1.0])),
    number("shininess", "", [0.0, 1e6], TENFOLD),
    number("color", "rgb", STRENGTH, Ends([0.0, 1.0])),
    number("intensity", "", STRENGTH, TENFOLD),
    number("gain", "", STRENGTH, TENFOLD),
    number("target", "xyz", COORDINATE, Around),
    number("up", "xyz", COORDINATE, Around),
    number("fov", "", [ABOVE_0, 179.0], Ends([5.0, 150.0])),
    number("height", "", LENGTH, TENFOLD),
    number("near", "", LENGTH, TENFOLD),
    number("azimuth", "", [-180.0, 180.0], Ends([-180.0, 180.0])),
    number("elevation", "", [-180.0, 180.0], Ends([-80.0, 80.0])),
    // From where pictures of the cuboids are large to where they are a pixel.
    number("zoom", "", [1e-200, 1e200], Times([0.5, 1000.0])),
    number("tolerance", "", [0.0, 255.0], Ends([0.1, 255.0])),
    number("budget", "", [0.001, 10_000.0], TENFOLD),
    number("divider", "", [0.0, 1.0], Ends([0.0, 1.0])),
    whole("turned", [0.0, 359.0]),
    number("pixel", "xy", [-8192.0, 8192.0], Around),
];

const fn number(
    key: &'static str,
    letters: &'static str,
    [least, most]: [f64; 2],
    first: First,
) -> Number {
    Number {
        key,
        letters,
        range: least..=most,
        first,
        is_whole: false,
    }
}

/// A whole number.
const fn whole(key: &'static str, ends: [f64; 2]) -> Number {
    Number {
        is_whole: true,
        ..number(key, "", ends, Ends(ends))
    }
}

/// The numbers at the keys with this last part.
pub fn number_of(key: &str) -> Option<&'static Number> {
    const { &NUMBERS }.iter().find(|it| it.key == key)
}

/// The range of the numbers at the keys with this last part; all numbers if there are none.
pub fn range_of(key: &str) -> RangeInclusive<f64> {
    number_of(key).map_or(f64::MIN..=f64::MAX, |it| it.range.clone())
}

impl Number {
    pub fn is_legal(&self, value: f64) -> bool {
        self.range.contains(&value) && !(self.is_whole && value.fract() != 0.0)
    }

    /// The legal values in words.
    pub fn words(&self) -> String {
        let [least, most] = [self.range.start(), self.range.end()];
        if self.is_whole {
            format!("a whole number from {least} to {most}")
        } else if *least == ABOVE_0 {
            format!("a number above 0, at most {most:?}")
        } else {
            format!("a number from {least:?} to {most:?}")
        }
    }

    /// The range around a value that people look at first.
    pub fn first_around(&self, value: f64) -> [f64; 2] {
        let ends = match self.first {
            Ends(ends) => ends,
            Times(_) if value == 0.0 => [0.0, 1.0],
            Times(factors) => factors.map(|factor| factor * value),
            Around => [-1.0, 1.0].map(|way| value + way * value.abs().max(1.0)),
        };
        let [from, to] = ends.map(|end| end.clamp(*self.range.start(), *self.range.end()));
        [from.min(value), to.max(value)]
    }
}

/// Reads three numbers.
pub(crate) fn three<'de, D: Deserializer<'de>>(from: D) -> Result<DVec3, D::Error> {
    array(from).map(|three: [f64; 3]| three.into())
}

/// Reads the three numbers of an optional key.
pub(crate) fn some_three<'de, D: Deserializer<'de>>(from: D) -> Result<Option<DVec3>, D::Error> {
    three(from).map(Some)
}

/// Reads the two numbers of an optional key.
pub(crate) fn some_two<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[f64; 2]>, D::Error> {
    array(from).map(Some)
}

/// Reads an array of exactly `N` values. serde alone ignores further ones.
pub(crate) fn array<'de, T: Deserialize<'de>, const N: usize, D: Deserializer<'de>>(
    from: D,
) -> Result<[T; N], D::Error> {
    let all = Vec::deserialize(from)?;
    all.try_into().map_err(|all: Vec<T>| {
        D::Error::invalid_length(all.len(), &format!("an array of {N} values").as_str())
    })
}
