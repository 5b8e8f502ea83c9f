//! The state of the window that is not the scene's: nothing of it changes the picture that is judged.

use std::time::Duration;

use glam::DVec3;

/// An entity of the scene: the key of its kind in scene files, and its name.
pub type Entity = (&'static str, String);

/// The thing that a drag over the picture moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Grab {
    #[default]
    Nothing,
    Camera,
    Divider,
    /// A light, by its name and its place before that is rounded.
    Light(String, DVec3),
}

/// A message in the status line.
pub struct Message {
    pub text: String,
    /// When it goes.
    pub until: Duration,
}

/// The switches and choices of the user.
#[derive(Default)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own")]
pub struct Desk {
    pub help: bool,
    pub panel_folded: bool,
    /// Whether the panel and the inspector have room together. In a narrow window the inspector takes the panel's place.
    pub has_both: bool,
    /// Two pictures take turns since this time, while a key is held.
    pub blinks: Option<Duration>,
    /// Asks whether to save before the program ends.
    pub asks_to_save: bool,
    pub message: Option<Message>,
    /// The error in the scene's file.
    pub file_error: Option<String>,
    /// The entity that the scene's tab shows.
    pub selected: Option<Entity>,
    pub grab: Grab,
}
