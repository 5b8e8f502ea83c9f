//! Results on their way out: text, files and pictures.
//!
//! | question | where |
//! |---|---|
//! | Where does a result go? | [`Output`]: standard output, or [`files`] written whole or not at all |
//! | How are numbers, tables and paragraphs told? | [`words`] |
//! | How is a picture stored? | `png` |
//! | What draws letters, shapes and charts? | [`paint`] over pixels, [`chart`] in SVG |
//! | How long does the work take? | [`progress`] |
//! | Does it fit in memory? | [`memory`] |
//!
//! It is no error if the reader of standard output closes it early.

pub mod chart;
pub mod files;
pub mod memory;
pub mod paint;
mod png;
pub mod progress;
pub mod words;

use std::ffi::OsString;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use serde::Serialize;

pub use self::progress::{CANCELLED, Monitor, finished};
pub use crate::output::files::one_line;
pub use png::{MAX_PICTURE_SIDE, PngPicture, encode_png, read_png};

/// The destination of a file's content.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// Standard output.
    Stdout,
    /// The file, device or pipe at this path.
    File(PathBuf),
}

impl From<OsString> for Output {
    /// `-` and `/dev/stdout` are standard output, everything else is a path.
    fn from(path: OsString) -> Self {
        if path == "-" || path == "/dev/stdout" {
            Output::Stdout
        } else {
            Output::File(path.into())
        }
    }
}

impl Output {
    /// Its name in messages.
    pub fn name(&self) -> String {
        match self {
            Output::Stdout => "standard output".to_owned(),
            Output::File(path) => one_line(path),
        }
    }

    /// Writes the whole content.
    ///
    /// # Errors
    /// If it cannot be written. An existing file is then unchanged.
    pub fn write(&self, content: impl AsRef<[u8]>) -> anyhow::Result<()> {
        let content = content.as_ref();
        match self {
            Output::Stdout => {
                let mut stdout = io::stdout().lock();
                match stdout.write_all(content).and_then(|()| stdout.flush()) {
                    Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
                    written => written.context("cannot write to standard output"),
                }
            }
            Output::File(path) => files::write_all(&[(path, content)]),
        }
    }

    /// Writes a PNG of `pixels`, 0x00RRGGBB row by row from the top.
    ///
    /// # Errors
    /// As [`Output::write`], or if the encoded picture does not fit in memory.
    pub fn write_png(&self, pixels: &[u32], size: [usize; 2]) -> anyhow::Result<()> {
        let encoded = encode_png(pixels, size);
        self.write(encoded.with_context(|| format!("cannot write {}", self.name()))?)
    }
}

/// Writes files that belong together, each with its name, into an existing folder: all of them, or none.
///
/// # Errors
/// As [`Output::write`].
pub fn write_into<C: AsRef<[u8]>>(
    folder: &Path,
    files: impl IntoIterator<Item = (impl AsRef<Path>, C)>,
) -> anyhow::Result<()> {
    let in_folder = |(name, content)| (folder.join(name), content);
    files::write_all(&files.into_iter().map(in_folder).collect::<Vec<_>>())
}

/// A record as JSON text with a final line break.
///
/// # Errors
/// None in practice: the records contain nothing that JSON cannot express.
pub fn json<T: Serialize>(record: &T) -> anyhow::Result<String> {
    Ok(serde_json::to_string_pretty(record)? + "\n")
}

/// Prints a record to standard output, as JSON or as `text`; to standard error if `file` takes standard output.
///
/// # Errors
/// As [`Output::write`].
pub fn print<T: Serialize>(
    record: &T,
    as_json: bool,
    file: Option<&Output>,
    text: impl FnOnce() -> String,
) -> anyhow::Result<()> {
    let text = if as_json {
        json(record)?
    } else {
        printable(&text()) + "\n"
    };
    if file == Some(&Output::Stdout) {
        say(text.trim_end());
        return Ok(());
    }
    Output::Stdout.write(text)
}

/// Prints a line to standard error, so that standard output holds the result alone.
pub fn say(line: &str) {
    let line = printable(line);
    // It is no failure if standard error is closed.
    let _ = writeln!(io::stderr(), "{line}");
}

/// `text` with control characters replaced, so that a name or path cannot move the cursor or change colours.
pub fn printable(text: &str) -> String {
    let harmful = |character: char| character.is_control() && !"\n\t".contains(character);
    text.replace(harmful, "\u{fffd}")
}

/// A word quoted for a POSIX shell.
pub fn quoted(word: &str) -> String {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "_-+=:,./@%".contains(letter);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}
