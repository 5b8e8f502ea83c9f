//! Keys: any number or setting of a scene by its name.
//!
//! ```text
//! cuboid.emerald.size.x    light."key light".on    camera.1.orbit.zoom    background.g    view.tolerance
//! ```
//! A key is a path in the [`SceneRecord`] as TOML. An entity has its name there; the numbers of a vector are x, y and z, those of
//! a colour r, g and b. serde says what a value may be, and a comment of the default scene explains it.

use std::collections::HashMap;
use std::fmt;
use std::sync::LazyLock;

use anyhow::{anyhow, bail};
use serde::Serialize;
use toml::{Table, Value};

use super::read::from_value;
use super::record::SceneRecord;
use super::{BUILT_IN, listed};
use crate::components::numbers::{Number, number_of};
use crate::output::words::joined;

/// The lists of entities.
const KINDS: [&str; 3] = ["cuboid", "light", "camera"];

/// The comments of the default scene, by keys without the names of entities.
static COMMENTS: LazyLock<Vec<(String, &str)>> = LazyLock::new(|| comments(BUILT_IN[0].1));

/// The key of a value, or of a table or an array of values.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Key(Vec<String>);

impl From<&str> for Key {
    /// Reads a dotted key of TOML. A name needs quotes only for a dot or a space.
    fn from(text: &str) -> Key {
        Key(match toml_edit::Key::parse(text) {
            Ok(parts) => parts.iter().map(|it| it.get().to_owned()).collect(),
            Err(_) => text.split('.').map(str::to_owned).collect(),
        })
    }
}

impl fmt::Display for Key {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        let is_special = |it: char| it.is_whitespace() || it.is_control() || ".=\"'#".contains(it);
        let quoted = |part: &String| {
            let needs_quotes = part.is_empty() || part.contains(is_special);
            needs_quotes.then(|| toml_edit::Key::new(part).to_string())
        };
        let part = |it: &String| quoted(it).unwrap_or_else(|| it.clone());
        formatter.write_str(&joined(self.0.iter().map(part), "."))
    }
}

/// Splits `KEY=TEXT`. A quoted name of the key may hold an `=`.
pub fn split(text: &str) -> Option<(Key, &str)> {
    let pieces = || {
        text.match_indices('=')
            .map(|(at, _)| (text[..at].trim(), &text[at + 1..]))
    };
    let is_complete = |(key, _): &(&str, &str)| toml_edit::Key::parse(key).is_ok();
    // A name without quotes may have letters that TOML quotes.
    let (key, rest) = pieces().find(is_complete).or_else(|| pieces().next())?;
    Some((Key::from(key), rest.trim()))
}

/// Reads `KEY=VALUE`. The value is one of TOML, a whole number of any size, or a bare word, which is a string.
///
/// # Errors
/// If there is no `=`.
pub fn assignment(text: &str) -> Result<(Key, Value), &'static str> {
    let (key, value) = split(text).ok_or("it is KEY=VALUE, such as light.white.on=false")?;
    let large = || value.parse().ok().map(Value::Float);
    let read = value.parse().ok().or_else(large);
    Ok((key, read.unwrap_or_else(|| Value::from(value))))
}

/// A scene with other values.
///
/// # Errors
/// If there is no such key, or a value is not legal.
pub fn set(record: &SceneRecord, values: &[(Key, Value)]) -> anyhow::Result<SceneRecord> {
    let mut changed = record.clone();
    for (key, value) in values {
        key.write(&mut changed, value.clone())?;
    }
    changed.check()?;
    Ok(changed)
}

impl Key {
    /// A key below this one.
    #[must_use]
    pub fn child(&self, part: &str) -> Key {
        Key([&self.0[..], &[part.to_owned()]].concat())
    }

    /// Its parts.
    pub fn parts(&self) -> &[String] {
        &self.0
    }

    /// Its last part.
    pub fn last(&self) -> &str {
        self.0.last().map_or("", |it| it)
    }

    /// Whether it is another key or below it.
    pub fn is_of(&self, other: &str) -> bool {
        self.0.starts_with(&Key::from(other).0)
    }

    /// The value in a scene; `None` if it is optional and left out.
    ///
    /// # Errors
    /// If there is no such key.
    pub fn read(&self, record: &SceneRecord) -> anyhow::Result<Option<Value>> {
        let mut scene = tree(record);
        let value = self.find(&mut scene)?;
        let is_left_out = value.as_table().is_some_and(Table::is_empty);
        Ok((!is_left_out).then(|| value.clone()))
    }

    /// Changes the value in a scene. Values that belong together are [checked](SceneRecord::check) after all are written.
    ///
    /// # Errors
    /// If there is no such key, or it may not have this value. The scene stays then.
    pub fn write(&self, record: &mut SceneRecord, value: Value) -> anyhow::Result<()> {
        let mut scene = tree(record);
        *self.find(&mut scene)? = value;
        *record = from_value(scene).map_err(|mistake| anyhow!("`{self}`: {}", mistake.why))?;
        Ok(())
    }

    /// The numbers at this key, if it has any. One number of a vector has those of the vector.
    pub fn number(&self) -> Option<&'static Number> {
        let above = || number_of(self.0.iter().rev().nth(1)?);
        number_of(self.last()).or_else(above)
    }

    /// The comment on this key, or on the one above.
    pub fn comment(&self) -> Option<&'static str> {
        let of = |key: &str| COMMENTS.iter().find(|it| it.0 == key).map(|it| it.1);
        let own = self.without_name();
        of(&own).or_else(|| of(own.rsplit_once('.')?.0))
    }

    /// The common key of two: parts that differ are `*`.
    #[must_use]
    pub fn common(self, other: &Key) -> Key {
        let common = |(one, other): (String, &String)| {
            let is_common = one == *other;
            if is_common { one } else { "*".to_owned() }
        };
        Key(self.0.into_iter().zip(&other.0).map(common).collect())
    }

    /// The place of the value in a scene. A key that is left out gets an empty table.
    fn find<'a>(&self, mut value: &'a mut Value) -> anyhow::Result<&'a mut Value> {
        for (depth, part) in self.0.iter().enumerate() {
            let parent = Key(self.0[..depth].to_vec());
            let names = parent.names(value);
            let Some(place) = names.iter().position(|it| it == part) else {
                let owner = match depth {
                    0 => "a scene".to_owned(),
                    _ => parent.to_string(),
                };
                let content = match &names[..] {
                    [] => "nothing below it".to_owned(),
                    names => listed(names),
                };
                bail!("there is no key {self}; {owner} has {content}");
            };
            value = match value {
                Value::Array(all) => &mut all[place],
                Value::Table(table) => table.entry(part).or_insert(Table::new().into()),
                // It has no names.
                value => value,
            };
        }
        Ok(value)
    }

    /// The parts that may follow this key, which has this value.
    pub fn names(&self, value: &Value) -> Vec<String> {
        match value {
            Value::Array(all) if self.is_list() => {
                let name = |entity: &Value| entity["name"].as_str().map(str::to_owned);
                all.iter().map(|it| name(it).unwrap_or_default()).collect()
            }
            Value::Array(_) => {
                let letters = number_of(self.last()).map_or("", |it| it.letters);
                if letters.is_empty() {
                    return ["left", "right"].map(str::to_owned).to_vec();
                }
                letters.chars().map(String::from).collect()
            }
            Value::Table(table) => {
                let own = self.without_name();
                let explained = COMMENTS.iter().filter_map(|(key, _)| key.rsplit_once('.'));
                let left_out = explained.filter(|it| it.0 == own && !table.contains_key(it.1));
                let left_out_names = left_out.map(|(_, name)| name.to_owned());
                table.keys().cloned().chain(left_out_names).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Whether it is the key of a list of entities.
    fn is_list(&self) -> bool {
        matches!(&self.0[..], [kind] if KINDS.contains(&&**kind))
    }

    /// The key as in [`COMMENTS`].
    fn without_name(&self) -> String {
        let mut parts = self.0.clone();
        if parts.len() > 1 && KINDS.contains(&&*parts[0]) {
            parts.remove(1);
        }
        parts.join(".")
    }

    /// Adds the keys of the values that differ: itself, or those below.
    fn compare(self, before: Option<&Value>, after: Option<&Value>, found: &mut Vec<Key>) {
        if before == after {
            return;
        }
        let [before, after] = [before, after].map(|it| self.children(it));
        if before.is_empty() || after.is_empty() {
            return found.push(self);
        }
        let [old, new] =
            [&before, &after].map(|all| all.iter().cloned().collect::<HashMap<_, _>>());
        for (name, value) in &after {
            self.child(name)
                .compare(old.get(name).copied(), Some(value), found);
        }
        for (name, value) in before.iter().filter(|it| !new.contains_key(&it.0)) {
            self.child(name).compare(Some(value), None, found);
        }
    }

    /// The values below this key, which has this value.
    fn children<'a>(&self, value: Option<&'a Value>) -> Vec<(String, &'a Value)> {
        let names = value.into_iter().flat_map(|it| self.names(it));
        match value {
            Some(Value::Array(all)) => names.zip(all).collect(),
            Some(Value::Table(table)) => names
                .filter_map(|name| Some((name.clone(), table.get(&name)?)))
                .collect(),
            _ => Vec::new(),
        }
    }
}

/// The keys of the values that differ between two scenes. An entity that is new or gone is one key.
pub fn differences(before: &SceneRecord, after: &SceneRecord) -> Vec<Key> {
    let mut found = Vec::new();
    Key::default().compare(Some(&tree(before)), Some(&tree(after)), &mut found);
    found
}

/// A record or a part of it as TOML.
///
/// # Panics
/// Never: TOML has all that a record has.
pub fn tree(part: &impl Serialize) -> Value {
    Value::try_from(part).expect("TOML has all that a record has")
}

/// The comments behind the keys of a scene's text, also behind those that are comments themselves. That a key is optional is left
/// out.
fn comments(text: &'static str) -> Vec<(String, &'static str)> {
    let mut table = "";
    let mut comments = Vec::new();
    for line in text.lines().map(|line| line.trim_start_matches("# ")) {
        let (code, comment) = line.split_once(" # ").unwrap_or((line, ""));
        let code = code.trim();
        if code.starts_with('[') && code.ends_with(']') {
            table = code.trim_matches(['[', ']']);
        } else if let Some((name, _)) = code.split_once(" = ")
            && name.bytes().all(|it| it.is_ascii_lowercase())
        {
            let dot = if table.is_empty() { "" } else { "." };
            let comment = comment.trim_start_matches("optional: ");
            comments.push((format!("{table}{dot}{name}"), comment));
        }
    }
    comments
}
