//! The scene files that were opened last, kept from one session to the next.

use std::env;
use std::path::{Path, PathBuf};

use crate::output::Output;

/// The most files that are kept.
const MOST: usize = 10;

/// The files opened last, the latest first.
#[derive(Default)]
pub struct Recent {
    pub files: Vec<PathBuf>,
    /// The list is kept there, a path a line.
    list: Option<PathBuf>,
}

impl Recent {
    /// The list in the user's folder for such things; what cannot be read is no file.
    pub fn of_user() -> Self {
        let state = env::var_os("XDG_STATE_HOME").map(PathBuf::from);
        let home = env::var_os("HOME").map(|home| Path::new(&home).join(".local/state"));
        match state.filter(|path| path.is_absolute()).or(home) {
            Some(folder) => Recent::kept_in(&folder.join("shadetrade")),
            None => Recent::default(),
        }
    }

    /// The list in this folder.
    pub fn kept_in(folder: &Path) -> Self {
        let list = folder.join("recent");
        let text = std::fs::read_to_string(&list).unwrap_or_default();
        Recent {
            files: text.lines().take(MOST).map(PathBuf::from).collect(),
            list: Some(list),
        }
    }

    /// Puts a file first. The list is a convenience: where it cannot be written, the session goes on without.
    pub fn add(&mut self, file: &Path) {
        let Ok(file) = std::path::absolute(file) else {
            return;
        };
        self.files.retain(|other| *other != file);
        self.files.insert(0, file);
        self.files.truncate(MOST);
        if let Some(list) = &self.list {
            let _ = list.parent().map(std::fs::create_dir_all);
            let lines: Vec<&str> = self.files.iter().filter_map(|file| file.to_str()).collect();
            let text = lines.join("\n");
            let _ = Output::File(list.clone()).write(|writer| writer.write_all(text.as_bytes()));
        }
    }
}
