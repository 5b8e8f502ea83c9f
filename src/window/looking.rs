//! How the scene is looked at: the view, where its divider stands, and whether the reference blinks.
//!
//! Rule: none of it changes the picture that is judged, so nothing found out about that picture is lost by looking.

use super::views::ViewMode;

/// How the scene is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Looking {
    /// What is shown.
    pub mode: ViewMode,
    /// Whether the reference is to be seen.
    pub blinks: bool,
    /// Share of the width left of the divider; while it is dragged the mouse may have left the picture.
    divider: f64,
    held: bool,
}

impl Default for Looking {
    fn default() -> Self {
        Looking {
            mode: ViewMode::default(),
            blinks: false,
            divider: 0.5,
            held: false,
        }
    }
}

impl Looking {
    /// The first column right of the divider, 0..=width.
    pub fn column(&self, width: usize) -> usize {
        (self.divider.clamp(0.0, 1.0) * width as f64).round() as usize
    }

    /// Whether the divider is being moved.
    pub fn is_held(&self) -> bool {
        self.held
    }

    /// Moves the divider by this share of the width to the right.
    pub fn drag(&mut self, by: f64) {
        self.divider += by;
        self.held = true;
    }

    /// Lets it stand where it is seen.
    pub fn let_go(&mut self) {
        self.divider = self.divider.clamp(0.0, 1.0);
        self.held = false;
    }
}
