//! The files of the system, which are written completely or not at all.
//!
//! The content goes to a hidden temporary file in the folder of the target, which is renamed to the target once all of
//! it is on the disk; of several files, once all of them are. Devices and pipes are written directly. A symbolic link
//! stays a link, and its target is replaced.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, ensure};
use tempfile::NamedTempFile;

use super::{Stamp, folder_of, one_line};

/// Opens a file to be read.
///
/// # Errors
/// If that is not possible.
pub fn open(path: &Path) -> io::Result<File> {
    File::open(path)
}

/// The stamp of a file, if there is one.
pub fn stamp(path: &Path) -> Option<Stamp> {
    let found = fs::metadata(path).ok()?;
    Some((found.modified().ok()?, found.len()))
}

/// Whether there is an ordinary file.
pub fn is_file(path: &Path) -> bool {
    path.is_file()
}

/// Removes a file, if there is one.
///
/// # Errors
/// If it cannot be removed.
pub fn remove(path: &Path) -> anyhow::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => {
            Err(error).with_context(|| format!("cannot remove {}", path.display()))
        }
        _ => Ok(()),
    }
}

/// Makes a folder and those that it lies in.
///
/// # Errors
/// If that is not possible.
pub fn make_folders(folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)
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

/// Replaces the file that each path leads to, or creates it: all of them, or none. What is no regular file, such as a device
/// or a pipe, is written directly.
///
/// # Errors
/// If one cannot be written. Existing files are then unchanged.
pub fn write_all(files: &[(impl AsRef<Path>, impl AsRef<[u8]>)]) -> anyhow::Result<()> {
    let cannot = |path: &Path| format!("cannot write {}", one_line(path));
    let mut staged = Vec::with_capacity(files.len());
    for (path, content) in files {
        let path = path.as_ref();
        let file = stage(path, content.as_ref()).with_context(|| cannot(path))?;
        staged.extend(file.map(|(file, target)| (path, file, target)));
    }
    for (path, file, target) in staged {
        let renamed = file.persist(target).map_err(|error| error.error);
        renamed.with_context(|| cannot(path))?;
    }
    Ok(())
}

/// Writes the content to a temporary file beside the one that `path` leads to. `None` if that is no regular file, and has been
/// written directly.
fn stage(path: &Path, content: &[u8]) -> anyhow::Result<Option<(NamedTempFile, PathBuf)>> {
    // A file that may not be written may not be replaced either.
    let old = match OpenOptions::new().append(true).open(path) {
        Ok(mut file) if !file.metadata()?.is_file() => {
            file.write_all(content)?;
            return Ok(None);
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
    Ok(Some((file, target)))
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
fn temporary_file(folder: &Path, content: &[u8]) -> io::Result<NamedTempFile> {
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
