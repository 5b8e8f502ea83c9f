//! One table of a scene file in, its values key by key out, each in the form its key allows.
//!
//! Rule: whatever is not allowed becomes a [`Fault`] at the smallest part of the text that is wrong, and every such
//! message is made here: the key, what it must be, what was found.

use std::collections::HashMap;
use std::ops::{Range, RangeInclusive};

use glam::DVec3;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{Fault, found, position};
use crate::components::Name;

/// What a key allows: said in words that follow "must be", and read from a value.
pub trait Form {
    /// What the value becomes.
    type Value;

    /// What is allowed.
    fn words(&self) -> String;

    /// The value, or the place of what is not allowed.
    fn read(&self, value: &Spanned<DeValue>) -> Result<Self::Value, Range<usize>>;
}

/// One number of a range; whole numbers may be written without a point.
pub struct Number {
    /// The range as the message says it.
    pub words: &'static str,
    /// The same; NaN and the infinities are in no range.
    pub range: RangeInclusive<f64>,
}

impl Form for Number {
    type Value = f64;

    fn words(&self) -> String {
        format!("a number {}", self.words)
    }

    fn read(&self, value: &Spanned<DeValue>) -> Result<f64, Range<usize>> {
        let number = match value.get_ref() {
            DeValue::Float(float) => float.as_str().parse().ok(),
            // Beyond 64 bits a whole number is rounded like any other.
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
            DeValue::Integer(integer) => u128::from_str_radix(integer.as_str(), integer.radix())
                .ok()
                .map(|integer| integer as f64),
            _ => None,
        };
        // Zero has no sign: -0 passes every comparison with 0, and is another number where bits are looked at.
        number
            .map(|number| number + 0.0)
            .filter(|number| self.range.contains(number))
            .ok_or(value.span())
    }
}

/// Three numbers of one range.
pub struct Three<'a>(pub &'a Number);

impl Form for Three<'_> {
    type Value = DVec3;

    fn words(&self) -> String {
        format!("three numbers, each {}", self.0.words)
    }

    fn read(&self, value: &Spanned<DeValue>) -> Result<DVec3, Range<usize>> {
        match value.get_ref().as_array().map(AsRef::as_ref) {
            Some([x, y, z]) => Ok(DVec3::new(
                self.0.read(x)?,
                self.0.read(y)?,
                self.0.read(z)?,
            )),
            _ => Err(value.span()),
        }
    }
}

/// Yes or no.
pub struct Switch;

impl Form for Switch {
    type Value = bool;

    fn words(&self) -> String {
        "true or false".to_owned()
    }

    fn read(&self, value: &Spanned<DeValue>) -> Result<bool, Range<usize>> {
        value.get_ref().as_bool().ok_or(value.span())
    }
}

/// One of a few words, each with what it stands for.
pub struct Choice<T: 'static>(pub &'static [(&'static str, T)]);

impl<T: Copy> Form for Choice<T> {
    type Value = T;

    fn words(&self) -> String {
        let quoted: Vec<String> = self.0.iter().map(|(word, _)| format!("{word:?}")).collect();
        quoted.join(" or ")
    }

    fn read(&self, value: &Spanned<DeValue>) -> Result<T, Range<usize>> {
        let text = value.get_ref().as_str();
        self.0
            .iter()
            .find_map(|(word, meaning)| (text == Some(word)).then_some(*meaning))
            .ok_or(value.span())
    }
}

/// A text that can be a name.
pub struct NameForm {
    /// What is allowed.
    pub words: &'static str,
    /// The same.
    pub allowed: fn(&str) -> bool,
}

impl Form for NameForm {
    type Value = Name;

    fn words(&self) -> String {
        self.words.to_owned()
    }

    fn read(&self, value: &Spanned<DeValue>) -> Result<Name, Range<usize>> {
        let text = value.get_ref().as_str();
        text.filter(|text| (self.allowed)(text))
            .map(|text| Name(text.to_owned()))
            .ok_or(value.span())
    }
}

/// A table of the file, and where it is.
pub struct Section<'a> {
    text: &'a str,
    path: String,
    header: Range<usize>,
    table: &'a DeTable<'a>,
}

impl<'a> Section<'a> {
    /// The whole of the file, which has none but these keys.
    pub fn top(text: &'a str, table: &'a DeTable<'a>, keys: &[&str]) -> Result<Self, Fault> {
        let section = Section {
            text,
            path: String::new(),
            header: 0..0,
            table,
        };
        section.only(keys)?;
        Ok(section)
    }

    /// The value of a key that may be left out.
    pub fn optional<F: Form>(&self, key: &str, form: &F) -> Result<Option<F::Value>, Fault> {
        self.table
            .get(key)
            .map(|value| {
                form.read(value)
                    .map_err(|span| self.wrong_part(key, &form.words(), span))
            })
            .transpose()
    }

    /// The value of a key that may not be left out.
    pub fn required<F: Form>(&self, key: &str, form: &F) -> Result<F::Value, Fault> {
        self.optional(key, form)?
            .ok_or_else(|| self.missing(key, &form.words()))
    }

    /// The table of that key, which may not be left out and has none but these keys.
    pub fn section(&self, key: &str, keys: &[&str]) -> Result<Section<'a>, Fault> {
        let words = format!("a table headed `[{}]`", self.path(key));
        match self.table.get(key) {
            None => Err(self.missing(key, &words)),
            Some(value) => self.enter(key, &words, value, keys),
        }
    }

    /// The tables of that key, at least `least` of them, each with its name, which no other has, and none but these keys.
    pub fn named(
        &self,
        key: &str,
        least: usize,
        form: &NameForm,
        keys: &[&str],
    ) -> Result<Vec<(Name, Section<'a>)>, Fault> {
        let mut places = HashMap::new();
        let named = |section: Section<'a>| {
            let name = section.required("name", form)?;
            if let Some(first) = places.insert(name.0.clone(), section.place("name")) {
                let (line, _) = position(self.text, first.start);
                let words = format!("a name that no other {key} has, and line {line} has it");
                return Err(section.wrong("name", &words));
            }
            Ok((name, section))
        };
        let sections = self.sections(key, least, keys)?;
        sections.into_iter().map(named).collect()
    }

    fn sections(&self, key: &str, least: usize, keys: &[&str]) -> Result<Vec<Section<'a>>, Fault> {
        let count = if least > 0 {
            "one or more"
        } else {
            "any number of"
        };
        let words = format!("{count} tables, each headed `[[{key}]]`");
        match self.table.get(key).map(|value| value.get_ref().as_array()) {
            None if least > 0 => Err(self.missing(key, &words)),
            None => Ok(Vec::new()),
            Some(Some(tables)) if tables.len() >= least => tables
                .iter()
                .map(|table| self.enter(key, &words, table, keys))
                .collect(),
            Some(_) => Err(self.wrong(key, &words)),
        }
    }

    /// Refuses that key, which does not go with `place`.
    pub fn absent(&self, key: &str, place: &str) -> Result<(), Fault> {
        if self.table.contains_key(key) {
            Err(self.wrong(key, &format!("left out of {place}")))
        } else {
            Ok(())
        }
    }

    /// The fault of a key whose value is not what it must be.
    pub fn wrong(&self, key: &str, words: &str) -> Fault {
        self.wrong_part(key, words, self.place(key))
    }

    fn wrong_part(&self, key: &str, words: &str, span: Range<usize>) -> Fault {
        let found = found(self.text, &span);
        Fault::new(
            span,
            format!("`{}` must be {words}; found {found}", self.path(key)),
        )
    }

    fn place(&self, key: &str) -> Range<usize> {
        self.table
            .get(key)
            .map_or(self.header.clone(), Spanned::span)
    }

    fn missing(&self, key: &str, words: &str) -> Fault {
        let message = format!("`{}` is missing; it must be {words}", self.path(key));
        Fault::new(self.header.clone(), message)
    }

    fn enter(
        &self,
        key: &str,
        words: &str,
        value: &'a Spanned<DeValue<'a>>,
        keys: &[&str],
    ) -> Result<Section<'a>, Fault> {
        let Some(table) = value.get_ref().as_table() else {
            return Err(self.wrong_part(key, words, value.span()));
        };
        let section = Section {
            text: self.text,
            path: self.path(key),
            header: value.span(),
            table,
        };
        section.only(keys)?;
        Ok(section)
    }

    fn only(&self, keys: &[&str]) -> Result<(), Fault> {
        let unknown = self
            .table
            .keys()
            .filter(|key| !keys.contains(&key.get_ref().as_ref()));
        let Some(key) = unknown.min_by_key(|key| key.span().start) else {
            return Ok(());
        };
        let found = found(self.text, &key.span());
        let place = if self.path.is_empty() {
            "a scene"
        } else {
            &self.path
        };
        let allowed = keys.join(", ");
        let message = format!("unknown key {found}; the keys of {place} are {allowed}");
        Err(Fault::new(key.span(), message))
    }

    fn path(&self, key: &str) -> String {
        if self.path.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.path)
        }
    }
}
