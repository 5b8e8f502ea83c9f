//! The state of the window that is not the scene's: nothing of it changes the picture that is judged.

use std::path::PathBuf;
use std::time::Duration;

/// An entity of the scene: the key of its kind in scene files, and its place among those, counted from 0.
pub type EntityPlace = (&'static str, usize);

/// A message in the status line.
pub struct Message {
    pub text: String,
    /// When it goes.
    pub until: Duration,
}

/// The switches and choices of the user.
#[derive(Default)]
pub struct Desk {
    pub help: bool,
    pub panel_folded: bool,
    /// Whether the panel and the inspector have room together. In a narrow window the inspector takes the panel's place.
    pub has_both: bool,
    /// Two pictures take turns since this time, while a key is held.
    pub blinks: Option<Duration>,
    pub message: Option<Message>,
    /// The error in the scene's file.
    pub file_error: Option<String>,
    /// The folder of the file that was open before another scene was chosen.
    pub last_folder: Option<PathBuf>,
    /// The entity that the scene's tab shows.
    pub selected: Option<EntityPlace>,
    /// The side of a wipe whose worst pixel is sought, 0 for the picture, until the errors are known.
    pub sought: Option<usize>,
    /// The pixel that was clicked, until it is known which cuboid it shows. That one is selected then.
    pub clicked: Option<[usize; 2]>,
}
