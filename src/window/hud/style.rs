//! What a board is set in -> the measures of its rows and of their parts, all in pixels.
//!
//! Rule: names of any length in a scene file never make a board wider than it is allowed to be.

use super::lines::{Command, Line, Mark};
use crate::canvas::Face;

/// The fewest letters of a label that still say something.
const FEWEST_LETTERS: usize = 6;
/// As many letters of a label as are shown; a name in a scene file can be of any length.
const MOST_LETTERS: usize = 28;

/// From a label to its state, in letters.
const STATE_GAP: usize = 1;

/// Between rows that need not be closer, in sixteenths of a letter's height.
const USUAL_SPACING: i32 = 4;

/// What becomes of that for which there is no room.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Overflow {
    Fails,
    Scrolls,
    ScrollsAndCuts,
}

/// How a board is set: the letters, and what is given up for want of room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    pub(super) face: Face,
    pub(super) states: bool,
    pub(super) columns: usize,
    pub(super) over_letters: bool,
    /// Between two rows, in sixteenths of a letter's height.
    spacing: i32,
    overflow: Overflow,
}

impl Style {
    /// Everything shown, in one column of rows.
    pub const fn new(face: Face) -> Self {
        Style {
            face,
            states: true,
            columns: 1,
            over_letters: false,
            spacing: USUAL_SPACING,
            overflow: Overflow::Fails,
        }
    }

    /// The same with rows closer to one another.
    #[must_use]
    pub const fn close(self) -> Self {
        Style { spacing: 2, ..self }
    }

    /// The same with rows as close as they can be.
    #[must_use]
    pub const fn tight(self) -> Self {
        Style { spacing: 0, ..self }
    }

    /// The same without states in words; the marks still tell them.
    #[must_use]
    pub const fn without_states(self) -> Self {
        Style {
            states: false,
            ..self
        }
    }

    /// The same with so many columns of rows side by side, at least 1.
    #[must_use]
    pub const fn columns(self, columns: usize) -> Self {
        Style { columns, ..self }
    }

    /// The same on a thicker pane, through which the letters of another board do not show.
    #[must_use]
    pub const fn over_letters(self) -> Self {
        Style {
            over_letters: true,
            ..self
        }
    }

    /// The same, and rows for which there is no room are scrolled away.
    #[must_use]
    pub const fn scrolled(self) -> Self {
        Style {
            overflow: Overflow::Scrolls,
            ..self
        }
    }

    /// The same, and so are labels cut.
    #[must_use]
    pub const fn cut(self) -> Self {
        Style {
            overflow: Overflow::ScrollsAndCuts,
            ..self
        }
    }

    /// Whether rows may be scrolled away.
    pub fn scrolls(&self) -> bool {
        self.overflow >= Overflow::Scrolls
    }

    /// From one row to the next.
    pub fn pitch(&self) -> i32 {
        let height = self.face.height();
        height + height * self.spacing / 16
    }

    /// Between the parts of a row; as wide as a letter.
    pub fn gap(&self) -> i32 {
        self.face.advance()
    }

    /// From a board's edge to its rows, across and down.
    pub fn padding(&self) -> [i32; 2] {
        let gap = self.gap();
        if self.spacing < USUAL_SPACING {
            [gap, gap / 2]
        } else {
            [gap * 3 / 2; 2]
        }
    }

    /// The width of a key.
    pub fn keycap(&self, caption: &str) -> i32 {
        self.face.width(caption.chars().count()) + self.gap()
    }

    /// The width of keys side by side.
    pub fn keycaps(&self, captions: &[&str]) -> i32 {
        let caps: i32 = captions.iter().map(|caption| self.keycap(caption)).sum();
        caps + self.keycap_gap() * (captions.len() as i32 - 1).max(0)
    }

    /// Between keys side by side.
    pub fn keycap_gap(&self) -> i32 {
        self.gap() / 3
    }

    /// The width and height of a mark.
    pub fn mark(&self) -> i32 {
        self.face.height() * 5 / 8
    }

    /// How high a line is, with what is left above it.
    pub fn line_height(&self, line: &Line) -> i32 {
        match line {
            Line::Heading(_) if self.spacing == USUAL_SPACING => self.pitch() * 5 / 4,
            Line::Rule => self.pitch() / 2,
            _ => self.pitch(),
        }
    }

    /// How high lines below one another are.
    pub fn height(&self, lines: &[Line]) -> i32 {
        lines.iter().map(|line| self.line_height(line)).sum()
    }
}

/// Where the parts of every row stand, in pixels from its left edge.
#[derive(Clone, Copy, Debug)]
pub struct Columns {
    /// The mark's left edge.
    pub mark: i32,
    /// The label's left edge.
    pub label: i32,
    /// How many letters of it there is room for.
    pub label_letters: usize,
    row: i32,
    count: i32,
    between: i32,
}

impl Columns {
    /// As wide as `lines` need, at most `width`; `None` where that is not possible.
    pub fn of(lines: &[Line], style: &Style, width: i32) -> Option<Columns> {
        let (mut keys, mut mark, mut label, mut state, mut words) = (0, 0, 0, 0, 0);
        let (mut fact, mut text) = (0, 0);
        let states = |command: &Command| match command.state.chars().count() {
            state if style.states && state > 0 => STATE_GAP + state,
            _ => 0,
        };
        for line in lines {
            match line {
                Line::Command(command) => {
                    let letters = command.label.chars().count().min(MOST_LETTERS);
                    keys = keys.max(style.keycaps(&command.captions));
                    mark = mark.max(if command.mark == Mark::None {
                        0
                    } else {
                        style.mark()
                    });
                    label = label.max(letters);
                    state = state.max(states(command));
                    words = words.max(letters + states(command));
                }
                Line::Text(words) => text = text.max(words.chars().count()),
                Line::Fact(name, value) | Line::Alarm(name, value) => {
                    fact = fact.max(name.len() + 2 + value.chars().count());
                }
                Line::Title(..) | Line::Heading(_) | Line::Rule => {}
            }
        }
        let gap = |part: i32| if part > 0 { part + style.gap() } else { 0 };
        let count = style.columns.max(1) as i32;
        let between = 3 * style.gap();
        let widest = (width - between * (count - 1)) / count;
        let label_start = gap(keys) + gap(mark);
        let room = ((widest - label_start) / style.face.advance()).max(0) as usize;
        let cuts = style.overflow == Overflow::ScrollsAndCuts;
        let label_letters = if words <= room {
            label
        } else if cuts {
            label.min(room.saturating_sub(state))
        } else {
            return None;
        };
        let narrowest = style.face.width(if cuts { 1 } else { text });
        if label_letters < label.min(FEWEST_LETTERS) || widest < narrowest {
            return None;
        }
        let row = (label_start + style.face.width(words))
            .max(style.face.width(fact))
            .max(style.face.width(text))
            .min(widest);
        Some(Columns {
            mark: gap(keys),
            label: label_start,
            label_letters,
            row,
            count,
            between,
        })
    }

    /// The width of one column of rows.
    pub fn one(&self) -> i32 {
        self.row
    }

    /// From one column of rows to the next.
    pub fn stride(&self) -> i32 {
        self.row + self.between
    }

    /// The width of all columns of rows.
    pub fn all(&self) -> i32 {
        self.stride() * self.count - self.between
    }
}
