//! One value of a scene file in, the value its key allows out; and back.
//!
//! Rule: a key says here in words what it allows, and whatever else is found is an error at the smallest part of the text
//! that is wrong. NaN and the infinities are in no range.

use std::fmt;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut, Range};

use glam::DVec3;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Error, MapAccess, SeqAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use toml::Spanned;

use crate::components::{LightKind, ShadingMode};

/// What a key allows. Each kind of TOML value has a method that makes it the key's value, or `None`.
pub trait Form {
    /// What the key's value becomes.
    type Value;

    /// What is allowed, as it stands after "expected".
    fn words() -> String;

    fn number(_: f64) -> Option<Self::Value> {
        None
    }

    fn text(_: &str) -> Option<Self::Value> {
        None
    }

    fn list<'de, A: SeqAccess<'de>>(_: A) -> Result<Option<Self::Value>, A::Error> {
        Ok(None)
    }

    fn table<'de, A: MapAccess<'de>>(_: A) -> Result<Option<Self::Value>, A::Error> {
        Ok(None)
    }
}

/// The value of a key, and where it stands in the text.
pub struct Key<F: Form> {
    pub value: F::Value,
    pub span: Range<usize>,
}

/// A value that stands in no text yet.
pub fn key<F: Form>(value: F::Value) -> Key<F> {
    Key { value, span: 0..0 }
}

impl<F: Form> Deref for Key<F> {
    type Target = F::Value;

    fn deref(&self) -> &F::Value {
        &self.value
    }
}

impl<F: Form> DerefMut for Key<F> {
    fn deref_mut(&mut self) -> &mut F::Value {
        &mut self.value
    }
}

impl<F: Form<Value: Clone>> Clone for Key<F> {
    fn clone(&self) -> Self {
        Key {
            value: self.value.clone(),
            span: self.span.clone(),
        }
    }
}

impl<F: Form<Value: Default>> Default for Key<F> {
    fn default() -> Self {
        key(F::Value::default())
    }
}

impl<'de, F: Form> Deserialize<'de> for Key<F> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let spanned = Spanned::<Checked<F>>::deserialize(deserializer).map_err(|error| {
            // Serde knows that a key is missing, and TOML that a number is too large for any type; not what belongs there.
            let text = error.to_string();
            let incomplete = text.starts_with("missing field") || text.contains("overflowed");
            if incomplete && !text.contains("expected") {
                D::Error::custom(format!("{}, expected {}", text.trim_end(), F::words()))
            } else {
                error
            }
        })?;
        let span = spanned.span();
        let value = spanned.into_inner().0;
        Ok(Key { value, span })
    }
}

impl<F: Form<Value: Serialize>> Serialize for Key<F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.value.serialize(serializer)
    }
}

/// A value that its form allows.
struct Checked<F: Form>(F::Value);

impl<'de, F: Form> Deserialize<'de> for Checked<F> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer
            .deserialize_any(FormVisitor::<F>(PhantomData))
            .map(Checked)
    }
}

struct FormVisitor<F>(PhantomData<F>);

impl<'de, F: Form> Visitor<'de> for FormVisitor<F> {
    type Value = F::Value;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(&F::words())
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<F::Value, E> {
        // Zero has no sign: -0 passes every comparison with 0, and is another number where bits are looked at.
        F::number(number + 0.0).ok_or_else(|| {
            // Serde itself would write 1e100 with a hundred zeros.
            let found = format!("number `{number:?}`");
            E::invalid_value(Unexpected::Other(&found), &self)
        })
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<F::Value, E> {
        F::number(number as f64).ok_or_else(|| E::invalid_value(Unexpected::Signed(number), &self))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<F::Value, E> {
        self.visit_f64(number as f64)
    }

    fn visit_i128<E: Error>(self, number: i128) -> Result<F::Value, E> {
        self.visit_f64(number as f64)
    }

    fn visit_u128<E: Error>(self, number: u128) -> Result<F::Value, E> {
        self.visit_f64(number as f64)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<F::Value, E> {
        F::text(text).ok_or_else(|| E::invalid_value(Unexpected::Str(text), &self))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<F::Value, A::Error> {
        F::list(list)?.ok_or_else(|| A::Error::invalid_value(Unexpected::Seq, &self))
    }

    fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<F::Value, A::Error> {
        F::table(table)?.ok_or_else(|| A::Error::invalid_value(Unexpected::Map, &self))
    }
}

/// A number from `MIN` to `MAX`; whole numbers may be written without a point.
pub trait Interval {
    const MIN: f64;
    const MAX: f64;
    /// The same in words.
    const WORDS: &str;
}

macro_rules! intervals {
    ($($(#[$meaning:meta])* $name:ident: $least:expr, $most:expr, $words:expr;)*) => {$(
        $(#[$meaning])*
        pub struct $name;

        impl Interval for $name {
            const MIN: f64 = $least;
            const MAX: f64 = $most;
            const WORDS: &str = $words;
        }
    )*};
}

intervals! {
    /// Levels of the display.
    Level: 0.0, 255.0, "from 0 to 255";
    /// World units.
    Length: 1e-100, 1e100, "from 1e-100 to 1e100";
    /// World units.
    Coordinate: -1e100, 1e100, "from -1e100 to 1e100";
    /// Degrees, any number of turns.
    Angle: f64::MIN, f64::MAX, "that is finite (degrees)";
    /// Coefficients, colours, intensities and gains.
    Strength: 0.0, 1e30, "from 0 to 1e30";
    /// The exponent rho.
    Shininess: 0.0, 1e6, "from 0 to 1e6";
    /// Degrees; the lower bound is the smallest number above 0.
    FieldOfView: 5e-324, 179.0, "above 0 and at most 179 (degrees)";
}

impl<I: Interval> Form for I {
    type Value = f64;

    fn words() -> String {
        format!("a number {}", I::WORDS)
    }

    fn number(number: f64) -> Option<f64> {
        (I::MIN..=I::MAX).contains(&number).then_some(number)
    }
}

/// Three numbers of one interval.
pub struct Three<I>(PhantomData<I>);

impl<I: Interval> Form for Three<I> {
    type Value = DVec3;

    fn words() -> String {
        format!("three numbers, each {}", I::WORDS)
    }

    fn list<'de, A: SeqAccess<'de>>(list: A) -> Result<Option<DVec3>, A::Error> {
        let numbers = Vec::<Key<I>>::deserialize(SeqAccessDeserializer::new(list))?;
        Ok(match &numbers[..] {
            [x, y, z] => Some(DVec3::new(x.value, y.value, z.value)),
            _ => None,
        })
    }
}

/// The name of a cuboid or a camera.
pub struct AnyName;

impl Form for AnyName {
    type Value = String;

    fn words() -> String {
        "a name that is not empty".to_owned()
    }

    fn text(text: &str) -> Option<String> {
        (!text.is_empty()).then(|| text.to_owned())
    }
}

/// The name of a light, as the command line can write it in its list of lights.
pub struct LightName;

impl Form for LightName {
    type Value = String;

    fn words() -> String {
        "a name that is not empty, holds no comma and is not \"all\" or \"none\"".to_owned()
    }

    fn text(text: &str) -> Option<String> {
        AnyName::text(text).filter(|name| !name.contains(',') && name != "all" && name != "none")
    }
}

impl Form for LightKind {
    type Value = LightKind;

    fn words() -> String {
        "\"ambient\", \"diffuse\" or \"specular\"".to_owned()
    }

    fn text(text: &str) -> Option<LightKind> {
        LightKind::ALL.into_iter().find(|kind| kind.name() == text)
    }
}

impl Form for ShadingMode {
    type Value = ShadingMode;

    fn words() -> String {
        "\"gouraud\" or \"phong\"".to_owned()
    }

    fn text(text: &str) -> Option<ShadingMode> {
        [ShadingMode::Gouraud, ShadingMode::Phong]
            .into_iter()
            .find(|mode| mode.name() == text)
    }
}

/// A table of the file that stands under a header of its own.
pub trait Headed {
    const HEADER: &str;
}

/// One such table; an array, which serde would take for one, is refused.
pub struct Table<T>(PhantomData<T>);

impl<T: Headed + for<'de> Deserialize<'de>> Form for Table<T> {
    type Value = T;

    fn words() -> String {
        format!("a table headed `{}`", T::HEADER)
    }

    fn table<'de, A: MapAccess<'de>>(table: A) -> Result<Option<T>, A::Error> {
        T::deserialize(MapAccessDeserializer::new(table)).map(Some)
    }
}

/// At least `MIN` such tables.
pub struct Tables<T, const MIN: usize>(PhantomData<T>);

impl<T: Headed + for<'de> Deserialize<'de>, const MIN: usize> Form for Tables<T, MIN> {
    type Value = Vec<T>;

    fn words() -> String {
        let count = if MIN > 0 {
            "one or more"
        } else {
            "any number of"
        };
        format!("{count} tables, each headed `{}`", T::HEADER)
    }

    fn list<'de, A: SeqAccess<'de>>(list: A) -> Result<Option<Vec<T>>, A::Error> {
        let tables = Vec::<Key<Table<T>>>::deserialize(SeqAccessDeserializer::new(list))?;
        let tables: Vec<T> = tables.into_iter().map(|table| table.value).collect();
        Ok(Some(tables).filter(|tables| tables.len() >= MIN))
    }
}
