//! What belongs to the window and not to the scene: how the scene is looked at, and what lies over it.
//!
//! Rule: plain data; none of it changes the picture that is judged.

use std::time::Duration;

use super::bindings::Action;
use super::views::ViewMode;

/// How long a message stands.
pub const MESSAGE_TIME: Duration = Duration::from_secs(2);

/// The divider stays this share of the picture's width away from either edge, so that it can always be seen and caught.
const DIVIDER_MARGIN: f64 = 0.02;

/// How the scene is looked at.
#[derive(Clone, Debug, PartialEq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is switched by itself, and all together are no state machine"
)]
pub struct ViewState {
    pub mode: ViewMode,
    /// The reference is shown instead, as long as a key is held.
    pub shows_reference: bool,
    /// Where the divider of a wipe was dragged to, as a share of the picture's width; the mouse may leave the picture.
    pub divider: f64,
    pub drags_divider: bool,
    /// The pixel of the picture that is probed.
    pub pixel: Option<[usize; 2]>,
    pub panel: bool,
    pub help: bool,
    /// The action whose row the mouse is over.
    pub hovered: Option<Action>,
    /// A message, and when it goes.
    pub message: Option<(String, Duration)>,
}

impl Default for ViewState {
    /// The picture and the panel, and nothing else.
    fn default() -> Self {
        ViewState {
            mode: ViewMode::default(),
            shows_reference: false,
            divider: 0.5,
            drags_divider: false,
            pixel: None,
            panel: true,
            help: false,
            hovered: None,
            message: None,
        }
    }
}

impl ViewState {
    /// The first column right of the divider in a picture of this width.
    pub fn divider_column(&self, width: usize) -> usize {
        (self.seen_divider() * width as f64).round() as usize
    }

    /// Ends a drag: the divider stays where it is seen.
    pub fn end_drag(&mut self) {
        self.divider = self.seen_divider();
        self.drags_divider = false;
    }

    /// The message that stands in the window.
    pub fn message(&self) -> Option<&str> {
        self.message.as_ref().map(|(text, _)| text.as_str())
    }

    fn seen_divider(&self) -> f64 {
        self.divider.clamp(DIVIDER_MARGIN, 1.0 - DIVIDER_MARGIN)
    }
}
