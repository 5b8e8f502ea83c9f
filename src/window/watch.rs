//! A scene file -> whether it has changed since it was last looked at.
//!
//! Rule: a file that is gone for the moment, as while an editor replaces it, has not changed.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// The time from one look to the next.
const INTERVAL: Duration = Duration::from_millis(200);

/// A file that is looked at again and again.
pub struct Watch {
    path: PathBuf,
    /// When it was last written, and its length in bytes.
    seen: Option<(SystemTime, u64)>,
    next: Duration,
}

impl Watch {
    /// A file as it is now.
    pub fn new(path: PathBuf) -> Self {
        let seen = state(&path);
        Watch {
            path,
            seen,
            next: Duration::ZERO,
        }
    }

    /// The file's path if it is another one than at the last look, at the time `now`.
    pub fn changed(&mut self, now: Duration) -> Option<&Path> {
        if now < self.next {
            return None;
        }
        self.next = now + INTERVAL;
        let state = state(&self.path)?;
        (self.seen.replace(state) != Some(state)).then_some(&self.path)
    }
}

fn state(path: &Path) -> Option<(SystemTime, u64)> {
    let found = fs::metadata(path).ok()?;
    Some((found.modified().ok()?, found.len()))
}
