//! The numbers of a scene file, each with its range. serde reads them by these types.

use std::ops::RangeInclusive;

use glam::DVec3;
use serde::de::Error;
use serde::{Deserialize, Deserializer};

use super::surface::Segments;

/// Levels of the display.
pub type DisplayLevel = Within<{ 0.0_f64.to_bits() }, { 255.0_f64.to_bits() }>;
/// World units.
pub type Length = Within<{ 1e-100_f64.to_bits() }, { 1e100_f64.to_bits() }>;
/// World units.
pub type Coordinate = Within<{ (-1e100_f64).to_bits() }, { 1e100_f64.to_bits() }>;
/// Degrees, of any number of turns.
pub type Angle = Within<{ f64::MIN.to_bits() }, { f64::MAX.to_bits() }>;
/// Coefficients, colours, intensities and gains.
pub type Strength = Within<{ 0.0_f64.to_bits() }, { 1e30_f64.to_bits() }>;
/// The exponent rho.
pub type Shininess = Within<{ 0.0_f64.to_bits() }, { 1e6_f64.to_bits() }>;
/// Degrees above 0.
pub type FieldOfView = Within<{ 5e-324_f64.to_bits() }, { 179.0_f64.to_bits() }>;
/// Degrees of an orbit.
pub type OrbitAngle = Within<{ (-180.0_f64).to_bits() }, { 180.0_f64.to_bits() }>;
/// The factor of a camera's distance and height.
pub type Zoom = Within<{ 1e-200_f64.to_bits() }, { 1e200_f64.to_bits() }>;
/// A share of a whole.
pub type Share = Within<{ 0.0_f64.to_bits() }, { 1.0_f64.to_bits() }>;
/// Heights of the picture from its middle: the largest picture is 16384 pixels wide and one high.
pub type Offset = Within<{ (-8192.0_f64).to_bits() }, { 8192.0_f64.to_bits() }>;
/// Milliseconds a frame.
pub type Milliseconds = Within<{ 0.001_f64.to_bits() }, { 10_000.0_f64.to_bits() }>;

/// The range of the numbers at a key of a scene file, outside of `[view]`.
pub fn of_key(key: &str) -> RangeInclusive<f64> {
    match key {
        "background" => DisplayLevel::RANGE,
        "size" | "height" | "near" => Length::RANGE,
        "position" | "target" | "up" => Coordinate::RANGE,
        "rotation" => Angle::RANGE,
        "segments" => {
            let (least, most) = Segments::RANGE.into_inner();
            least.into()..=most.into()
        }
        "shininess" => Shininess::RANGE,
        "fov" => FieldOfView::RANGE,
        "azimuth" | "elevation" => OrbitAngle::RANGE,
        "zoom" => Zoom::RANGE,
        _ => Strength::RANGE,
    }
}

/// A number from `LEAST` to `MOST`, which are the bits of f64. NaN and infinities are in no range.
#[derive(Deserialize)]
#[serde(try_from = "f64")]
pub struct Within<const LEAST: u64, const MOST: u64>(f64);

impl<const LEAST: u64, const MOST: u64> TryFrom<f64> for Within<LEAST, MOST> {
    type Error = String;

    /// Reads -0 as 0: pictures are compared bit by bit.
    fn try_from(number: f64) -> Result<Self, String> {
        let (least, most) = Self::RANGE.into_inner();
        if Self::RANGE.contains(&number) {
            return Ok(Within(number + 0.0));
        }
        let range = if least == f64::from_bits(1) {
            format!("above 0, at most {most:?}")
        } else {
            format!("from {least:?} to {most:?}")
        };
        Err(format!(
            "invalid value: {number:?}, expected a number {range}"
        ))
    }
}

impl<const LEAST: u64, const MOST: u64> Within<LEAST, MOST> {
    pub const RANGE: RangeInclusive<f64> = f64::from_bits(LEAST)..=f64::from_bits(MOST);

    /// Reads a number.
    pub(crate) fn one<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
        Self::deserialize(from).map(|number| number.0)
    }

    /// Reads three numbers.
    pub(crate) fn three<'de, D: Deserializer<'de>>(from: D) -> Result<DVec3, D::Error> {
        array(from).map(|three: [Self; 3]| three.map(|number| number.0).into())
    }

    /// Reads the number of an optional key.
    pub(crate) fn some<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
        Self::one(from).map(Some)
    }

    /// Reads the two numbers of an optional key.
    pub(crate) fn some_two<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<[f64; 2]>, D::Error> {
        array(from).map(|two: [Self; 2]| Some(two.map(|number| number.0)))
    }

    /// Reads the three numbers of an optional key.
    pub(crate) fn some_three<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<DVec3>, D::Error> {
        Self::three(from).map(Some)
    }
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
