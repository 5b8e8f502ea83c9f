//! Files that are written whole or not at all, and standard output.
//!
//! The content goes to a hidden temporary file in the same folder, which
//! takes the target's name once everything is on the disk. Devices and pipes are written directly; a symbolic link stays
//! a link and its target is replaced; a reader that closes our standard output early is no error.

mod animation;

use std::borrow::Cow;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail, ensure};
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};
use serde::Serialize;

pub use animation::Animation;

/// Where one file's content goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// Standard output.
    Stdout,
    /// The file, device or pipe of this path.
    File(PathBuf),
}

impl From<PathBuf> for Output {
    /// `-` and `/dev/stdout` are standard output, everything else is a path.
    fn from(path: PathBuf) -> Self {
        if path.as_os_str() == "-" || path.as_os_str() == "/dev/stdout" {
            Output::Stdout
        } else {
            Output::File(path)
        }
    }
}

impl Output {
    /// What messages call it.
    pub fn name(&self) -> Cow<'_, str> {
        match self {
            Output::Stdout => "standard output".into(),
            Output::File(path) => path.to_string_lossy(),
        }
    }

    /// Writes what `content` produces.
    ///
    /// # Errors
    /// When it could not be written; a file that was there is then as it was before.
    pub fn write(
        &self,
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> anyhow::Result<()> {
        match self {
            Output::Stdout => {
                // An encoder hides the kind of an error, so the content is made before it is written.
                let mut bytes = Vec::new();
                let made = content(&mut bytes).and_then(|()| standard_output());
                match made.and_then(|mut stdout| stdout.write_all(&bytes)) {
                    Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
                    written => written.context("cannot write to standard output"),
                }
            }
            Output::File(path) => write_file(path, content)
                .with_context(|| format!("cannot write {}", path.display())),
        }
    }

    /// Writes a PNG of `pixels`, 0x00RRGGBB row by row from the top.
    ///
    /// # Errors
    /// As [`Output::write`].
    pub fn write_png(&self, pixels: &[u32], size: [usize; 2]) -> anyhow::Result<()> {
        self.write(|writer| encode_png(writer, pixels, size))
    }
}

/// Makes the folder `path` unless it is there; its parent is not made.
///
/// # Errors
/// When something else has that name, or the folder cannot be made.
pub fn make_folder(path: &Path) -> anyhow::Result<()> {
    match fs::create_dir(path) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            ensure!(
                path.is_dir(),
                "{} is there already and is not a folder",
                path.display()
            );
            Ok(())
        }
        Err(error) if error.kind() == ErrorKind::NotFound => {
            bail!(
                "cannot make the folder {}: there is no folder {}",
                path.display(),
                folder_of(path).display()
            )
        }
        made => made.with_context(|| format!("cannot make the folder {}", path.display())),
    }
}

/// Prints a record to standard output: as JSON, or as `text` tells it to a person.
///
/// # Errors
/// As [`Output::write`].
pub fn print<T: Serialize>(
    record: &T,
    as_json: bool,
    text: impl FnOnce() -> String,
) -> anyhow::Result<()> {
    let text = if as_json {
        serde_json::to_string_pretty(record)?
    } else {
        printable(&text())
    };
    Output::Stdout.write(|writer| writeln!(writer, "{text}"))
}

/// One line for the user, on standard error so that standard output holds only what was asked for.
pub fn say(line: &str) {
    let line = printable(line);
    // A closed standard error is no failure.
    let _ = writeln!(io::stderr(), "{line}");
}

/// `text` as a terminal may have it: a name or a path in it moves no cursor and changes no colour.
pub fn printable(text: &str) -> String {
    let harmful = |character: char| character.is_control() && !"\n\t".contains(character);
    text.replace(harmful, "\u{fffd}")
}

/// A word as a shell has to be given it.
pub fn quoted(word: &str) -> String {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "_-+=:,./@%".contains(letter);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// Standard output as a file: the standard library's own handle says nothing when it cannot be written.
fn standard_output() -> io::Result<File> {
    let stdout = io::stdout();
    #[cfg(unix)]
    let handle = std::os::fd::AsFd::as_fd(&stdout).try_clone_to_owned()?;
    #[cfg(windows)]
    let handle = std::os::windows::io::AsHandle::as_handle(&stdout).try_clone_to_owned()?;
    Ok(File::from(handle))
}

/// Writes `content` through a buffer, and notices what fails only when it is emptied.
fn buffered(
    writer: impl Write,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut writer = BufWriter::new(writer);
    content(&mut writer)?;
    writer.flush()
}

/// Puts a new file in the place of what `path` leads to, which need not exist; what is no file is written as it is.
fn write_file(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> anyhow::Result<()> {
    let old = match fs::metadata(path) {
        Ok(found) if found.is_dir() => bail!("it is a folder; give the name of a file"),
        Ok(found) if found.is_file() => {
            // What a plain write would be refused, a replacement is refused too.
            OpenOptions::new().write(true).open(path)?;
            Some(found)
        }
        Ok(_) => {
            let file = OpenOptions::new().append(true).open(path)?;
            return Ok(buffered(file, content)?);
        }
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(error) => return Err(error.into()),
    };
    let mut target = path.to_path_buf();
    while let Ok(next) = fs::read_link(&target) {
        target = folder_of(&target).join(next);
    }
    ensure!(
        !target.to_string_lossy().ends_with(std::path::is_separator),
        "that is the name of a folder"
    );
    let folder = folder_of(&target);
    ensure!(folder.is_dir(), "there is no folder {}", folder.display());
    let file = temporary_file(folder)?;
    buffered(file.as_file(), content)?;
    if let Some(old) = old {
        file.as_file().set_permissions(old.permissions())?;
    }
    file.as_file().sync_all()?;
    file.persist(&target).map_err(|error| error.error)?;
    Ok(())
}

/// Writes a new file into `folder` under the first of the names that `name` gives for 1, 2, ... and nobody has taken;
/// returns the file made.
///
/// # Errors
/// When the folder cannot be written to, or the first 9999 names are taken.
pub fn write_numbered(
    folder: &Path,
    name: impl Fn(u32) -> String,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<PathBuf> {
    let mut file = temporary_file(folder)?;
    buffered(file.as_file(), content)?;
    for number in 1..=9999 {
        let path = folder.join(name(number));
        // The system refuses a name that is taken, so that two programs never get the same one.
        match file.persist_noclobber(&path) {
            Ok(_) => return Ok(path),
            Err(taken) if taken.error.kind() == ErrorKind::AlreadyExists => file = taken.file,
            Err(other) => return Err(other.error),
        }
    }
    Err(io::Error::new(
        ErrorKind::AlreadyExists,
        "every number is taken",
    ))
}

/// A hidden file that goes when it is dropped, with the permissions any new file gets.
fn temporary_file(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    tempfile::Builder::new()
        .prefix(".shadetrade-")
        .suffix(".tmp")
        // Opened here, so that an error is the system's: the library's would name the temporary file.
        .make_in(folder, |path| {
            OpenOptions::new().write(true).create_new(true).open(path)
        })
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// A PNG of 0x00RRGGBB pixels, which are held a second time meanwhile, as bytes of red, green and blue.
pub(crate) fn encode_png(
    writer: &mut dyn Write,
    pixels: &[u32],
    [width, height]: [usize; 2],
) -> io::Result<()> {
    PngEncoder::new(writer)
        .write_image(
            &rgb(pixels)?,
            width as u32,
            height as u32,
            ExtendedColorType::Rgb8,
        )
        .map_err(|error| match error {
            ImageError::IoError(error) => error,
            other => io::Error::other(other),
        })
}

/// Red, green and blue of every pixel.
fn rgb(pixels: &[u32]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(3 * pixels.len())?;
    bytes.extend(pixels.iter().flat_map(|pixel| {
        let [_, red, green, blue] = pixel.to_be_bytes();
        [red, green, blue]
    }));
    Ok(bytes)
}
