//! The desk: what is open, selected and said. Nothing of it changes the picture that is judged.

use std::time::Duration;

use super::inspector::{Tab, Varied};
use super::keys::Action;
use crate::questions::requires::Part;

/// How long each of two pictures is shown while they take turns.
pub const TURN: Duration = Duration::from_millis(500);

/// An entity of the scene: the key of its kind in scene files, and its place among those, counted from 0.
pub type EntityPlace = (&'static str, usize);

/// The state of the window that is not the scene's.
#[expect(clippy::struct_excessive_bools, reason = "each stands for itself")]
#[derive(Default)]
pub struct Desk {
    /// The time of the present step.
    pub now: Duration,
    /// Whether times are shown; they are the machine's, and differ from run to run.
    pub shows_times: bool,
    pub quits: bool,
    /// Whether it was said that edits are not saved.
    pub is_warned: bool,
    pub help: bool,
    pub panel_folded: bool,
    /// Whether everything else is shown beside a lesson.
    pub shows_rest: bool,
    /// The answer that was chosen to the question of a lesson's step, counted from 0.
    pub answer: Option<usize>,
    /// Whether the window is so high that several headings of the panel are open at once.
    pub is_high: bool,
    /// The open headings of the panel, the last opened one last.
    pub tabs: Vec<Tab>,
    /// The heading that comes in sight with the next layout.
    pub revealed: Option<Tab>,
    /// The number that is varied.
    pub varied: Option<Varied>,
    /// The part of the model without which the picture is shown, while the required parts are shown.
    pub left_out: Option<Part>,
    /// Two pictures take turns since this time, while a key is held.
    pub blinks: Option<Duration>,
    /// Of the status line, and when it goes.
    pub message: Option<(String, Duration)>,
    /// The error in the scene's file.
    pub file_error: Option<String>,
    /// The entity whose numbers are shown.
    pub selected: Option<EntityPlace>,
    /// Whether a click waits until it is known which cuboid it shows. That one is selected then.
    pub has_clicked: bool,
    /// The divider before it was moved off the worst pixel.
    pub divider: Option<f64>,
    /// Whether the worst pixel is explained as soon as it is known.
    pub awaits_worst: bool,
    /// Whether the keyboard's focus is in a field, or came from one.
    pub has_field: bool,
    /// Whether a field or a popup of the last layout takes Escape.
    pub takes_escape: bool,
    /// The actions that the widgets of the present layout wish for. They run after it.
    pub wishes: Vec<Action>,
}

impl Desk {
    /// Shows a message for as long as it takes to read.
    pub fn say(&mut self, text: impl Into<String>) {
        let text = text.into();
        let until = self.now + reading_time(&text);
        self.message = Some((text, until));
    }

    /// Shows a message if there is one.
    pub fn say_any(&mut self, text: Option<impl Into<String>>) {
        if let Some(text) = text {
            self.say(text);
        }
    }

    pub fn wish(&mut self, action: Action) {
        self.wishes.push(action);
    }

    /// Two pictures take turns for as long as this is called with `true`.
    pub fn blink_while(&mut self, is_held: bool) {
        let since = self.blinks.unwrap_or(self.now);
        self.blinks = is_held.then_some(since);
    }

    /// The place of the picture that has its turn while two of them blink: the sides of a wipe, else exact Phong and the
    /// picture.
    pub fn turn(&self) -> Option<usize> {
        let passed = self.now.saturating_sub(self.blinks?);
        Some((passed.as_millis() / TURN.as_millis()) as usize % 2)
    }

    /// The part without which the picture is shown.
    pub fn shown_without(&self) -> Option<Part> {
        self.left_out.filter(|_| self.is_open(Tab::Required))
    }

    pub fn is_open(&self, tab: Tab) -> bool {
        self.tabs.contains(&tab)
    }

    /// Opens a heading of the panel, unless that is folded. In a low window the others close.
    pub fn open(&mut self, tab: Tab) {
        if self.panel_folded {
            return;
        }
        self.tabs.retain(|it| self.is_high && *it != tab);
        self.tabs.push(tab);
        self.revealed = Some(tab);
    }

    /// Opens a heading of the panel, or closes it.
    pub fn switch(&mut self, tab: Tab) {
        match self.tabs.iter().position(|it| *it == tab) {
            Some(place) => drop(self.tabs.remove(place)),
            None => self.open(tab),
        }
    }

    /// Closes the uppermost thing that can be closed. Returns whether there was one.
    pub fn close(&mut self) -> bool {
        std::mem::take(&mut self.help)
            || self.file_error.take().is_some()
            || std::mem::take(&mut self.awaits_worst)
    }
}

/// The time for which a message stands.
pub fn reading_time(text: &str) -> Duration {
    const LEAST: Duration = Duration::from_secs(3);
    const LETTER: Duration = Duration::from_millis(60);
    LEAST.max(LETTER * text.len() as u32)
}
