//! The scene files that were opened last, kept from one session to the next.

use std::path::{Path, PathBuf};
use std::{env, fs};

use crate::output::Output;

/// The files opened last, the latest first.
#[derive(Default)]
pub struct Recent {
    pub files: Vec<PathBuf>,
    /// The file that keeps them, a path a line; `None` keeps them for this session.
    list: Option<PathBuf>,
}

impl Recent {
    /// The files in the user's state folder.
    pub fn of_user() -> Self {
        let state = env::var_os("XDG_STATE_HOME").filter(|state| !state.is_empty());
        let home = || Some(Path::new(&env::var_os("HOME")?).join(".local/state"));
        let folder = state.map(PathBuf::from).or_else(home);
        folder.map_or_else(Recent::default, |it| {
            Recent::kept_in(&it.join("shadetrade"))
        })
    }

    /// The files that the list in `folder` names. A list that cannot be read is empty.
    pub fn kept_in(folder: &Path) -> Self {
        let list = folder.join("recent");
        let text = fs::read_to_string(&list).unwrap_or_default();
        Recent {
            files: text.lines().map(PathBuf::from).collect(),
            list: Some(list),
        }
    }

    /// Puts a file first, of ten. They are a convenience: where they cannot be kept, nothing is said.
    pub fn add(&mut self, file: &Path) {
        let file = std::path::absolute(file).unwrap_or_else(|_| file.to_path_buf());
        self.files.retain(|other| *other != file);
        self.files.insert(0, file);
        self.files.truncate(10);
        if let Some(list) = &self.list {
            let _ = list.parent().map(fs::create_dir_all);
            let lines: Vec<_> = self.files.iter().map(|it| it.to_string_lossy()).collect();
            let text = lines.join("\n");
            let _ = Output::File(list.clone()).write(|writer| writer.write_all(text.as_bytes()));
        }
    }
}
