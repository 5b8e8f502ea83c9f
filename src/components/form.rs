//! How values of a scene file are read where serde by itself would take more than is meant.

use std::fmt;
use std::marker::PhantomData;

use glam::DVec3;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

/// So many values. Serde would leave out what follows them.
pub fn array<'de, T: Deserialize<'de>, const N: usize, D: Deserializer<'de>>(
    from: D,
) -> Result<[T; N], D::Error> {
    let all = Vec::deserialize(from)?;
    all.try_into().map_err(|all: Vec<T>| {
        D::Error::invalid_length(all.len(), &format!("an array of {N} values").as_str())
    })
}

/// A number. Zero has no sign: -0 is within every range of 0, and another number where bits are looked at.
pub fn number<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    f64::deserialize(from).map(|number| number + 0.0)
}

/// Three numbers.
pub fn three<'de, D: Deserializer<'de>>(from: D) -> Result<DVec3, D::Error> {
    array(from).map(|three: [f64; 3]| DVec3::from(three) + 0.0)
}

/// Three numbers of a key that may be left out.
pub fn some_three<'de, D: Deserializer<'de>>(from: D) -> Result<Option<DVec3>, D::Error> {
    three(from).map(Some)
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
pub fn table<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> Result<T, D::Error> {
    Table::deserialize(from).map(|table| table.0)
}

/// Any number of tables.
pub fn tables<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> Result<Vec<T>, D::Error> {
    let tables = Vec::<Table<T>>::deserialize(from)?;
    Ok(tables.into_iter().map(|table| table.0).collect())
}
