//! What lies over the picture: whether panel and help are shown, where they are scrolled to, and what is being said.
//!
//! Rule: what passes by itself, a message or the tab, passes at a time set when it came.

use std::time::Duration;

use super::bindings::Action;

/// How long a message stands.
const MESSAGE_TIME: Duration = Duration::from_secs(2);
/// How long the hidden panel's tab stays after the mouse has come to rest.
const TAB_TIME: Duration = Duration::from_secs(2);

/// The boxes of rows that can be too long for the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pane {
    /// The panel at the side.
    Panel,
    /// The help in the middle.
    Help,
    /// What is known of a pixel.
    Probe,
    /// What was measured.
    Table,
}

/// Words that stand in the window for a while.
#[derive(Debug)]
struct Message {
    text: String,
    until: Duration,
}

/// What lies over the picture.
#[derive(Debug)]
pub struct Overlay {
    panel: bool,
    help: bool,
    scroll: [usize; 4],
    hovered: Option<Action>,
    tab_until: Option<Duration>,
    message: Option<Message>,
}

impl Default for Overlay {
    /// The panel, and nothing else.
    fn default() -> Self {
        Overlay {
            panel: true,
            help: false,
            scroll: [0; 4],
            hovered: None,
            tab_until: None,
            message: None,
        }
    }
}

impl Overlay {
    /// Whether the panel is shown.
    pub fn shows_panel(&self) -> bool {
        self.panel
    }

    /// Whether a tab stands in for the hidden panel.
    pub fn shows_tab(&self) -> bool {
        !self.panel && self.tab_until.is_some()
    }

    /// Whether the help is shown.
    pub fn shows_help(&self) -> bool {
        self.help
    }

    /// The first row shown of a pane.
    pub fn scroll(&self, pane: Pane) -> usize {
        self.scroll[pane as usize]
    }

    /// The action whose row the mouse is over.
    pub fn hovered(&self) -> Option<Action> {
        self.hovered
    }

    /// The words that stand in the window.
    pub fn message(&self) -> Option<&str> {
        self.message.as_ref().map(|message| message.text.as_str())
    }

    pub(super) fn switch_panel(&mut self) {
        self.panel = !self.panel;
    }

    pub(super) fn switch_help(&mut self) {
        self.help = !self.help;
        self.scroll[Pane::Help as usize] = 0;
    }

    pub(super) fn scroll_to(&mut self, pane: Pane, row: usize) {
        self.scroll[pane as usize] = row;
    }

    pub(super) fn say(&mut self, text: String, now: Duration) {
        self.message = Some(Message {
            text,
            until: now + MESSAGE_TIME,
        });
    }

    /// Returns whether something else is to be seen now that the mouse is over the row of `action`, or over none.
    pub(super) fn hover(&mut self, action: Option<Action>, now: Duration) -> bool {
        let before = (self.hovered, self.shows_tab());
        self.hovered = action;
        self.tab_until = Some(now + TAB_TIME);
        before != (self.hovered, self.shows_tab())
    }

    /// Returns whether something has passed.
    pub(super) fn tick(&mut self, now: Duration) -> bool {
        let before = (self.message.is_some(), self.shows_tab());
        self.message.take_if(|message| message.until <= now);
        self.tab_until.take_if(|until| *until <= now);
        before != (self.message.is_some(), self.shows_tab())
    }
}
