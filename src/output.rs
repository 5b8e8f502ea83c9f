//! Output to standard output and to files, which are written completely or not at all.
//!
//! The content goes to a hidden temporary file in the folder of the target, which is renamed to the target once all of
//! it is on the disk. Devices, pipes and open descriptors such as /dev/fd/3 are written directly. A symbolic link stays a
//! link, and its target is replaced.
//! It is no error if the reader of standard output closes it early.

mod png;

use std::ffi::{OsStr, OsString};
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process;

use anyhow::{Context, ensure};
use serde::Serialize;

pub use png::{Animation, encode_png};

/// The destination of a file's content.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// Standard output.
    Stdout,
    /// The file, device or pipe at this path.
    File(PathBuf),
}

impl From<OsString> for Output {
    /// `-` and the system's names are standard output, everything else is a path.
    fn from(path: OsString) -> Self {
        if path == "-" || descriptor(path.as_ref()) == Some(1) {
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
            Output::File(path) => write_file(path, content)
                .with_context(|| format!("cannot write {}", one_line(path))),
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

/// Creates the folder `path` unless it exists, and checks that files can be written into it. Its parent must exist.
///
/// # Errors
/// If the folder cannot be created or written to.
pub fn make_folder(path: &Path) -> anyhow::Result<()> {
    if !path.is_dir() {
        ensure!(!path.exists(), "{} is a file, not a folder", one_line(path));
        check_folder(folder_of(path))
            .and_then(|()| Ok(fs::create_dir(path)?))
            .with_context(|| format!("cannot make the folder {}", one_line(path)))?;
    }
    tempfile::tempfile_in(path).with_context(|| format!("cannot write into {}", one_line(path)))?;
    Ok(())
}

/// Writes texts, each with the name of its file, into an existing folder.
///
/// # Errors
/// As [`Output::write`].
pub fn write_texts(folder: &Path, files: &[(&str, String)]) -> anyhow::Result<()> {
    let mut files = files.iter();
    files.try_for_each(|(name, text)| Output::File(folder.join(name)).write(text))
}

/// A record as JSON text with a final line break.
///
/// # Errors
/// None in practice: the records contain nothing that JSON cannot express.
pub fn json<T: Serialize>(record: &T) -> anyhow::Result<String> {
    Ok(serde_json::to_string_pretty(record)? + "\n")
}

/// Prints a record to standard output, as JSON or as `text`. Text goes to standard error if `file` takes standard output.
///
/// # Errors
/// As [`Output::write`].
pub fn print<T: Serialize>(
    record: &T,
    as_json: bool,
    file: Option<&Output>,
    text: impl FnOnce() -> String,
) -> anyhow::Result<()> {
    if as_json {
        return Output::Stdout.write(json(record)?);
    }
    if file == Some(&Output::Stdout) {
        say(&text());
        return Ok(());
    }
    Output::Stdout.write(printable(&text()) + "\n")
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

/// A name or path for a message, on one line.
pub fn one_line(name: impl AsRef<OsStr>) -> String {
    name.as_ref().to_string_lossy().replace('\n', "\\n")
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

/// The number of this process' open descriptor that a path leads to: 1 for /dev/stdout.
fn descriptor(path: &Path) -> Option<u32> {
    // A circle of links leads nowhere.
    path.metadata().ok()?;
    let mut path = path.to_owned();
    loop {
        let folder = folder_of(&path).canonicalize().ok()?;
        let own = format!("/proc/{}", process::id());
        if folder == Path::new("/dev/fd") || folder.starts_with(own) && folder.ends_with("fd") {
            return path.file_name()?.to_str()?.parse().ok();
        }
        path = folder.join(fs::read_link(&path).ok()?);
    }
}

/// Replaces the file that `path` leads to, or creates it. Devices, pipes and descriptors are written directly.
fn write_file(path: &Path, content: &[u8]) -> anyhow::Result<()> {
    let descriptor = descriptor(path);
    if descriptor == Some(2) {
        return Ok(io::stderr().write_all(content)?);
    }
    // A file that may not be written may not be replaced either.
    let old = match OpenOptions::new().append(true).open(path) {
        Ok(mut file) if descriptor.is_some() || !file.metadata()?.is_file() => {
            return Ok(file.write_all(content)?);
        }
        Ok(file) => Some(file.metadata()?.permissions()),
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(error) => return Err(error.into()),
    };
    let mut target = path.to_path_buf();
    while let Ok(next) = fs::read_link(&target) {
        target = folder_of(&target).join(next);
    }
    let folder = folder_of(&target);
    check_folder(folder)?;
    let file = temporary_file(folder, content)?;
    if let Some(permissions) = old {
        file.as_file().set_permissions(permissions)?;
    }
    file.as_file().sync_all()?;
    file.persist(&target).map_err(|error| error.error)?;
    Ok(())
}

/// Writes a new file into `folder` under the first free name of `name(1)`, `name(2)`, ... and returns its path.
///
/// # Errors
/// If the folder cannot be written to.
pub fn write_numbered(
    folder: &Path,
    name: impl Fn(u32) -> String,
    content: &[u8],
) -> anyhow::Result<PathBuf> {
    let cannot = || format!("cannot write {}", one_line(folder.join(name(1))));
    let mut file = temporary_file(folder, content).with_context(cannot)?;
    let mut number = 1;
    loop {
        let path = folder.join(name(number));
        // The system refuses an existing name, so two programs never get the same one.
        match file.persist_noclobber(&path) {
            Ok(_) => return Ok(path),
            Err(taken) if taken.error.kind() == ErrorKind::AlreadyExists => file = taken.file,
            Err(other) => return Err(other.error).with_context(cannot),
        }
        number += 1;
    }
}

/// A hidden file with the content and the default permissions of a new file. It is deleted on drop.
fn temporary_file(folder: &Path, content: &[u8]) -> io::Result<tempfile::NamedTempFile> {
    let mut name = tempfile::Builder::new();
    name.prefix(".shadetrade-").suffix(".tmp");
    // Opened here, because an error of the library would name the temporary file.
    let file = name.make_in(folder, |path| File::create_new(path))?;
    file.as_file().write_all(content)?;
    Ok(file)
}

/// Checks that a file may be at `path`.
///
/// # Errors
/// If it is a directory, or its folder does not exist.
pub fn check_place(path: &Path) -> anyhow::Result<()> {
    ensure!(
        !path.is_dir(),
        "cannot write {}: it is a directory",
        one_line(path)
    );
    check_folder(folder_of(path)).with_context(|| format!("cannot write {}", one_line(path)))
}

fn check_folder(folder: &Path) -> anyhow::Result<()> {
    ensure!(folder.is_dir(), "there is no folder {}", one_line(folder));
    Ok(())
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
