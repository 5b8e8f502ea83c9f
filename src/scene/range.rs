//! The numbers that each key of a scene file allows, and how they are read.
//!
//! NaN and the infinities are in no range.

use std::fmt;
use std::marker::PhantomData;
use std::ops::RangeInclusive;

use glam::DVec3;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer};

/// Levels of the display.
pub const LEVEL: RangeInclusive<f64> = 0.0..=255.0;
/// World units.
pub const LENGTH: RangeInclusive<f64> = 1e-100..=1e100;
/// World units.
pub const COORDINATE: RangeInclusive<f64> = -1e100..=1e100;
/// Degrees, any number of turns.
pub const ANGLE: RangeInclusive<f64> = f64::MIN..=f64::MAX;
/// Coefficients, colours, intensities and gains.
pub const STRENGTH: RangeInclusive<f64> = 0.0..=1e30;
/// The exponent rho.
pub const SHININESS: RangeInclusive<f64> = 0.0..=1e6;
/// Degrees; the lower bound is the smallest number above 0.
pub const FIELD_OF_VIEW: RangeInclusive<f64> = 5e-324..=179.0;
/// Degrees of an orbit.
pub const ORBIT: RangeInclusive<f64> = -180.0..=180.0;
/// The factor of a camera's distance and height.
pub const ZOOM: RangeInclusive<f64> = 1e-200..=1e200;
/// A part of a whole.
pub const SHARE: RangeInclusive<f64> = 0.0..=1.0;

/// A range by name, for the attributes of records.
pub(super) trait Range {
    const RANGE: RangeInclusive<f64>;
    /// The same in words.
    fn words() -> String {
        let end = |end: f64| match end.abs() {
            1e-3..1e5 | 0.0 => end.to_string(),
            _ => format!("{end:e}"),
        };
        let (least, most) = Self::RANGE.into_inner();
        format!("a number from {} to {}", end(least), end(most))
    }
}

macro_rules! ranges {
    ($($name:ident: $range:ident $(, $words:expr)?;)*) => {$(
        pub(super) struct $name;

        impl Range for $name {
            const RANGE: RangeInclusive<f64> = $range;
            $(fn words() -> String {
                $words.to_owned()
            })?
        }
    )*};
}

ranges! {
    Level: LEVEL;
    Length: LENGTH;
    Coordinate: COORDINATE;
    Angle: ANGLE, "a number that is finite (degrees)";
    Strength: STRENGTH;
    Shininess: SHININESS;
    FieldOfView: FIELD_OF_VIEW, "a number above 0 and at most 179 (degrees)";
    OrbitAngle: ORBIT;
    Zoom: ZOOM;
    Share: SHARE;
}

/// A number within `R`. Whole numbers may be written without a point.
struct Within<R>(f64, PhantomData<R>);

impl<'de, R: Range> Deserialize<'de> for Within<R> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let within = deserializer.deserialize_f64(Within::<R>(0.0, PhantomData))?;
        Ok(Within(within, PhantomData))
    }
}

// Checked while it is visited: an error then points at the number, also at one in an array.
impl<R: Range> Visitor<'_> for Within<R> {
    type Value = f64;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(&R::words())
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<f64, E> {
        if R::RANGE.contains(&number) {
            // Zero has no sign: -0 is within every range of 0, and another number where bits are looked at.
            Ok(number + 0.0)
        } else {
            // Serde itself would write 1e100 with a hundred zeros.
            let found = format!("number `{number:?}`");
            Err(E::invalid_value(Unexpected::Other(&found), &self))
        }
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<f64, E> {
        self.visit_f64(number as f64)
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<f64, E> {
        self.visit_f64(number as f64)
    }

    fn visit_i128<E: Error>(self, number: i128) -> Result<f64, E> {
        self.visit_f64(number as f64)
    }

    fn visit_u128<E: Error>(self, number: u128) -> Result<f64, E> {
        self.visit_f64(number as f64)
    }
}

/// A number within `R`.
pub(super) fn number<'de, R: Range, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Within::<R>::deserialize(from).map(|within| within.0)
}

/// A number within `R` of a key that may be left out.
pub(super) fn some_number<'de, R: Range, D: Deserializer<'de>>(
    from: D,
) -> Result<Option<f64>, D::Error> {
    number::<R, D>(from).map(Some)
}

/// So many values. Serde would leave out what follows them.
pub(super) fn array<'de, T: Deserialize<'de>, const N: usize, D: Deserializer<'de>>(
    from: D,
) -> Result<[T; N], D::Error> {
    let all = Vec::deserialize(from)?;
    all.try_into().map_err(|all: Vec<T>| {
        D::Error::invalid_length(all.len(), &format!("an array of {N} values").as_str())
    })
}

/// Three numbers within `R`.
pub(super) fn three<'de, R: Range, D: Deserializer<'de>>(from: D) -> Result<DVec3, D::Error> {
    let three: [Within<R>; 3] = array(from)?;
    Ok(three.map(|within| within.0).into())
}

/// Three numbers within `R` of a key that may be left out.
pub(super) fn some_three<'de, R: Range, D: Deserializer<'de>>(
    from: D,
) -> Result<Option<DVec3>, D::Error> {
    three::<R, D>(from).map(Some)
}

/// A table. Serde would also take an array for one, by the order of its keys.
struct Table<T>(T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Table<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct TableVisitor<T>(PhantomData<T>);

        impl<'de, T: Deserialize<'de>> Visitor<'de> for TableVisitor<T> {
            type Value = T;

            fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
                formatter.write_str("a table")
            }

            fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<T, A::Error> {
                T::deserialize(MapAccessDeserializer::new(table))
            }
        }

        let visitor = TableVisitor(PhantomData);
        deserializer.deserialize_map(visitor).map(Table)
    }
}

/// A table.
pub(super) fn table<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    from: D,
) -> Result<T, D::Error> {
    Table::deserialize(from).map(|table| table.0)
}

/// Any number of tables.
pub(super) fn tables<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    from: D,
) -> Result<Vec<T>, D::Error> {
    let tables = Vec::<Table<T>>::deserialize(from)?;
    Ok(tables.into_iter().map(|table| table.0).collect())
}
