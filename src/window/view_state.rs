//! What belongs to the window and not to the scene: how the scene is looked at, and what lies over it.
//!
//! Rule: plain data; none of it changes the picture that is judged.

use std::time::Duration;

use super::bindings::Action;
use super::magnifier::Magnifier;
use super::views::ViewMode;

/// How long a message stands at least.
pub const MESSAGE_TIME: Duration = Duration::from_secs(2);
/// How long one letter of a message is read.
pub const READING_TIME: Duration = Duration::from_millis(60);

/// The divider stays this share of the picture's width away from either edge, so that it can always be seen and caught.
const DIVIDER_MARGIN: f64 = 0.02;

/// What the mouse moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Drag {
    Divider,
    /// Lights that were at one place when the drag began, by their places in the file.
    Lights(Vec<usize>),
}

/// Which number of a page is changed, and what is typed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Editor {
    /// The row that keys change: the first one goes through the pages.
    pub row: usize,
    /// What is typed for the row's number, or nothing.
    pub typed: String,
    /// What the row's number may be, after it was refused.
    pub error: Option<String>,
}

/// How the scene is looked at.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ViewState {
    pub mode: ViewMode,
    /// The reference is shown instead, as long as a key is held.
    pub shows_reference: bool,
    /// Where the divider of a wipe was dragged to, as a share of the picture's width; the mouse may leave the picture.
    pub divider: f64,
    pub drag: Option<Drag>,
    /// How large pixels are seen.
    pub magnifier: Magnifier,
    /// The pixel of the picture that is probed.
    pub pixel: Option<[usize; 2]>,
    pub panel: bool,
    /// How large letters are, as [`crate::canvas::FACES`] counts; the largest that fit where that was not chosen.
    pub letters: Option<usize>,
    pub help: bool,
    /// The numbers of the scene, where they are shown.
    pub editor: Option<Editor>,
    /// Which of them the editor shows, or showed last; see [`crate::scene::Scene::page`].
    pub page: usize,
    /// The action whose row the mouse is over.
    pub hovered: Option<Action>,
    /// What is wrong with the scene's file as it is now.
    pub scene_error: Option<String>,
    /// A message, and when it goes.
    pub message: Option<(String, Duration)>,
}

impl ViewState {
    /// The first column right of the divider in a picture of this width.
    pub fn divider_column(&self, width: usize) -> usize {
        (self.seen_divider() * width as f64).round() as usize
    }

    /// Ends a drag: the divider stays where it is seen.
    pub fn end_drag(&mut self) {
        self.divider = self.seen_divider();
        self.drag = None;
    }

    /// The message that stands in the window.
    pub fn message(&self) -> Option<&str> {
        self.message.as_ref().map(|(text, _)| text.as_str())
    }

    fn seen_divider(&self) -> f64 {
        self.divider.clamp(DIVIDER_MARGIN, 1.0 - DIVIDER_MARGIN)
    }
}
