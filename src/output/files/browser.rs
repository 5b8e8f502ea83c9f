//! The files of a page in a browser: a map in memory. The page puts files in, and stores or downloads what is written.

use std::collections::BTreeMap;
use std::io::{self, Cursor, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use web_time::SystemTime;

use super::Stamp;

/// The folder of edits that are not saved. The page stores it.
pub const UNSAVED: &str = "unsaved";

#[derive(Default)]
struct Files {
    files: BTreeMap<PathBuf, (Vec<u8>, SystemTime)>,
    changed: Vec<PathBuf>,
}

static FILES: Mutex<Files> = Mutex::new(Files {
    files: BTreeMap::new(),
    changed: Vec::new(),
});

fn all() -> MutexGuard<'static, Files> {
    FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Puts a file into the map, or another content into one.
pub fn insert(path: PathBuf, content: Vec<u8>) {
    all().files.insert(path, (content, SystemTime::now()));
}

/// The files that the program has written since the last call, with their content; or removed, then `None`.
pub fn take_changes() -> Vec<(PathBuf, Option<Vec<u8>>)> {
    let mut all = all();
    let changed = std::mem::take(&mut all.changed).into_iter();
    let with_content = |path: PathBuf| {
        let content = all.files.get(&path).map(|file| file.0.clone());
        (path, content)
    };
    changed.map(with_content).collect()
}

/// Opens a file to be read.
///
/// # Errors
/// If there is none.
pub fn open(path: &Path) -> io::Result<Cursor<Vec<u8>>> {
    let all = all();
    let file = all.files.get(path).ok_or(ErrorKind::NotFound)?;
    Ok(Cursor::new(file.0.clone()))
}

/// The stamp of a file, if there is one.
pub fn stamp(path: &Path) -> Option<Stamp> {
    let all = all();
    let (content, time) = all.files.get(path)?;
    Some((*time, content.len() as u64))
}

/// Whether there is a file.
pub fn is_file(path: &Path) -> bool {
    all().files.contains_key(path)
}

/// Removes a file, if there is one.
///
/// # Errors
/// None.
pub fn remove(path: &Path) -> anyhow::Result<()> {
    let mut all = all();
    if all.files.remove(path).is_some() {
        all.changed.push(path.to_owned());
    }
    Ok(())
}

/// Every folder is there.
///
/// # Errors
/// None.
pub fn make_folders(_: &Path) -> io::Result<()> {
    Ok(())
}

/// As [`make_folders`].
///
/// # Errors
/// None.
pub fn make_folder(_: &Path) -> anyhow::Result<()> {
    Ok(())
}

/// Replaces files, or creates them.
///
/// # Errors
/// None.
pub fn write_all(files: &[(impl AsRef<Path>, impl AsRef<[u8]>)]) -> anyhow::Result<()> {
    for (path, content) in files {
        insert(path.as_ref().to_owned(), content.as_ref().to_vec());
        all().changed.push(path.as_ref().to_owned());
    }
    Ok(())
}

/// Writes a new file into `folder` under the first free name of `name(1)`, `name(2)`, ... and returns its path.
///
/// # Errors
/// None.
pub fn write_numbered(
    folder: &Path,
    name: impl Fn(u32) -> String,
    content: &[u8],
) -> anyhow::Result<PathBuf> {
    let paths = (1..).map(|number| folder.join(name(number)));
    let path = paths
        .filter(|path| !is_file(path))
        .next()
        .unwrap_or_default();
    write_all(&[(&path, content)])?;
    Ok(path)
}

/// Any name may be that of a file.
///
/// # Errors
/// None.
pub fn check_place(_: &Path) -> anyhow::Result<()> {
    Ok(())
}
