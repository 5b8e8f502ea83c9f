//! Lines of text -> a box of rows on the screen, what a click on each does, and the pixels.
//!
//! ```text
//!   +-----------------------------+
//!   | shadetrade           cuboid |   title
//!   | LIGHTS                      |   heading
//!   | [1][W]  #  white         on |   command: keys, mark, label, state
//!   | frame               1.20 ms |   fact
//!   +-----------------------------+
//! ```
//! Rules: what is wider than its row is cut, so a name in a scene file never makes a board wider than it may be. Letters
//! keep a contrast of at least 4.5 to 1 whatever picture shines through the pane. Every state is told by a filled or a
//! hollow mark or by words, with colour only on top of it.

use super::lines::{Command, Line, Mark, ON};
use super::profile;
use crate::canvas::{Canvas, Face, Ink, Point, Rect, fit};
use crate::window::bindings::Action;

const PANE: Ink = Ink::glass(0x0010_1216, 236);
const EDGE: Ink = Ink::glass(0x00ff_ffff, 40);
const TEXT: Ink = Ink::solid(0x00e8_eaed);
const ALARM: Ink = Ink::solid(0x00ff_7a6b);
const DIM: Ink = Ink::solid(0x00a8_afb7);
const OFF: Ink = Ink::solid(0x008a_9199);
const KEYCAP: Ink = Ink::glass(0x00ff_ffff, 22);
const KEYCAP_EDGE: Ink = Ink::glass(0x00ff_ffff, 84);
const HOVER: Ink = Ink::glass(0x00ff_ffff, 34);
const ACCENT: Ink = Ink::solid(ON);

/// How wide the scale is, in letters.
const SCALE_LETTERS: usize = 44;

/// How the rows of a board are set: the letters, and the pixels from one row to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextStyle {
    pub face: Face,
    pub pitch: i32,
}

impl TextStyle {
    /// Rows so close that a board covers little.
    pub fn new(face: Face) -> Self {
        let pitch = face.height() * 17 / 16;
        TextStyle { face, pitch }
    }

    /// Rows as close as their letters are high.
    pub fn tight(face: Face) -> Self {
        let pitch = face.height();
        TextStyle { face, pitch }
    }

    /// From a board's edge to its rows, in pixels.
    pub fn padding(self) -> i32 {
        self.face.advance() * 3 / 4
    }

    /// Pixels across and down of a board with these lines.
    pub fn size(self, lines: &[Line]) -> [i32; 2] {
        let columns = Columns::of(lines, self.face);
        let width = lines.iter().map(|line| columns.width(line, self.face));
        [width.max().unwrap_or(0), self.height(lines)].map(|it| it + 2 * self.padding())
    }

    /// How high these lines are below one another.
    pub fn height(self, lines: &[Line]) -> i32 {
        lines.iter().map(|line| self.row_height(line)).sum()
    }

    fn row_height(self, line: &Line) -> i32 {
        match line {
            Line::Rule => self.pitch / 2,
            Line::Scale(_) => 2 * self.pitch,
            Line::Profile(_) => 6 * self.pitch,
            _ => self.pitch,
        }
    }
}

/// Where the marks and the labels of commands stand, in pixels from the row's left edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Columns {
    mark: i32,
    label: i32,
}

impl Columns {
    fn of(lines: &[Line], face: Face) -> Self {
        let (mut mark, mut label) = (0, 0);
        for line in lines {
            if let Line::Command(command) = line {
                let keys = keycaps(command, face).last().map_or(0, Rect::right);
                mark = mark.max(keys + face.advance());
                if command.mark != Mark::None {
                    label = mark_size(face) + face.advance();
                }
            }
        }
        Columns {
            mark,
            label: mark + label,
        }
    }

    /// What a line takes, in pixels.
    fn width(self, line: &Line, face: Face) -> i32 {
        let count = |text: &str| text.chars().count();
        match line {
            Line::Command(command) => {
                self.label + face.width(count(&command.label) + 2 + count(&command.state))
            }
            Line::Title(name, value) | Line::Fact(name, value) | Line::Alarm(name, value) => {
                face.width(count(name) + 2 + count(value))
            }
            Line::Text(text) => face.width(count(text)),
            Line::Heading(text) => face.width(count(text)),
            Line::Rule => 0,
            Line::Scale(_) | Line::Profile(_) => face.width(SCALE_LETTERS),
            Line::Swatches(all) => {
                face.width(all.iter().map(|(_, text)| swatch_letters(text)).sum())
            }
        }
    }
}

/// What a swatch takes with its text and the gap behind it.
fn swatch_letters(text: &str) -> usize {
    text.chars().count() + 4
}

/// The keys of a command, side by side from the row's upper left corner.
fn keycaps(command: &Command, face: Face) -> Vec<Rect> {
    let mut x = 0;
    let caps = command.keys.iter().map(|(caption, _)| {
        let width = face.width(caption.chars().count() + 1);
        let cap = Rect::new(x, 0, width, face.height());
        x += width + face.advance() / 2;
        cap
    });
    caps.collect()
}

fn mark_size(face: Face) -> i32 {
    face.height() * 5 / 8
}

/// A box of rows.
#[derive(Debug)]
pub struct Board {
    /// Where it stands.
    pub rect: Rect,
    style: TextStyle,
    columns: Columns,
    /// The lines, and where each stands.
    pub rows: Vec<(Line, Rect)>,
}

impl Board {
    /// Sets `lines` in `rect`, from the top.
    pub fn new(lines: Vec<Line>, style: TextStyle, rect: Rect) -> Board {
        let inside = rect.inset(style.padding());
        let columns = Columns::of(&lines, style.face);
        let mut y = inside.y;
        let mut set = |line: Line| {
            let row = Rect::new(inside.x, y, inside.width, style.row_height(&line));
            y = row.bottom();
            (line, row)
        };
        Board {
            rect,
            style,
            columns,
            rows: lines.into_iter().map(&mut set).collect(),
        }
    }

    /// What a click at `point` does: what the key there does, or what the row does.
    pub fn action_at(&self, point: Point) -> Option<Action> {
        let (line, row) = self.rows.iter().find(|(_, row)| row.contains(point))?;
        let Line::Command(command) = line else {
            return None;
        };
        let x = point[0] - row.x;
        let caps = keycaps(command, self.style.face);
        let mut keys = command.keys.iter().zip(caps);
        let on_key = keys.find(|(_, cap)| (cap.x..cap.right()).contains(&x));
        let (_, action) = on_key.map_or(command.keys.last()?, |(key, _)| key);
        Some(*action)
    }

    /// Draws it, the row of `hovered` lit.
    pub fn draw(&self, canvas: &mut Canvas, hovered: Option<Action>) {
        let canvas = &mut canvas.clipped(self.rect);
        let radius = self.style.padding();
        canvas.rounded(self.rect, radius, PANE);
        canvas.outline(self.rect, radius, 1.0, EDGE);
        let face = self.style.face;
        for (line, row) in &self.rows {
            let y = row.y + (row.height - face.height()) / 2;
            match line {
                Line::Title(name, detail) => {
                    canvas.bold(face, [row.x, y], TEXT, name);
                    self.draw_right(canvas, *row, name.len() + 1, detail, DIM);
                }
                Line::Heading(text) => {
                    canvas.bold(face, [row.x, y], DIM, &text.to_uppercase());
                }
                Line::Command(command) => {
                    let does = |(_, action): &(_, Action)| Some(*action) == hovered;
                    if command.keys.iter().any(does) {
                        canvas.rounded(*row, face.advance() / 2, HOVER);
                    }
                    self.draw_command(canvas, *row, command);
                }
                Line::Text(text) => {
                    canvas.text(face, [row.x, y], TEXT, &fit(text, self.letters(*row)));
                }
                Line::Fact(name, value) | Line::Alarm(name, value) => {
                    let is_fact = matches!(line, Line::Fact(..));
                    let ink = if is_fact { TEXT } else { ALARM };
                    canvas.text(face, [row.x, y], DIM, name);
                    self.draw_right(canvas, *row, name.len() + 1, value, ink);
                }
                Line::Rule => {
                    canvas.fill(Rect::new(row.x, row.y + row.height / 2, row.width, 1), EDGE);
                }
                Line::Scale(scale) => scale.draw(canvas, face, *row, TEXT),
                Line::Profile(plot) => profile::draw(canvas, plot, row.inset(2)),
                Line::Swatches(all) => draw_swatches(canvas, face, [row.x, y], all),
            }
        }
    }

    /// How many letters there is room for in a row.
    fn letters(&self, row: Rect) -> usize {
        (row.width / self.style.face.advance()).max(0) as usize
    }

    /// `text` at the right end of a row, cut to what the first letters leave.
    fn draw_right(&self, canvas: &mut Canvas, row: Rect, taken: usize, text: &str, ink: Ink) {
        let face = self.style.face;
        let text = fit(text, self.letters(row).saturating_sub(taken));
        let x = row.right() - face.width(text.chars().count());
        let y = row.y + (row.height - face.height()) / 2;
        canvas.text(face, [x, y], ink, &text);
    }

    fn draw_command(&self, canvas: &mut Canvas, row: Rect, command: &Command) {
        let face = self.style.face;
        let y = row.y + (row.height - face.height()) / 2;
        for ((caption, _), cap) in command.keys.iter().zip(keycaps(command, face)) {
            let cap = Rect::new(row.x + cap.x, y, cap.width, cap.height - 1);
            canvas.rounded(cap, face.advance() / 2, KEYCAP);
            canvas.outline(cap, face.advance() / 2, 1.0, KEYCAP_EDGE);
            canvas.text(face, [cap.x + face.advance() / 2, y], TEXT, caption);
        }
        let size = mark_size(face);
        let top = row.y + (row.height - size) / 2;
        let mark = Rect::new(row.x + self.columns.mark, top, size, size);
        draw_mark(canvas, mark, command.mark);
        let ink = match command.mark {
            Mark::Switch(false, _) | Mark::Choice(false) => DIM,
            _ => TEXT,
        };
        let left = self.columns.label;
        let words = Rect::new(row.x + left, row.y, row.width - left, row.height);
        let taken = command.state.chars().count() + 1;
        let label = fit(&command.label, self.letters(words).saturating_sub(taken));
        canvas.text(face, [words.x, y], ink, &label);
        let taken = label.chars().count() + 1;
        self.draw_right(canvas, words, taken, &command.state, ink);
    }
}

fn draw_mark(canvas: &mut Canvas, rect: Rect, mark: Mark) {
    let stroke = rect.width as f32 / 7.0;
    let (square, round) = (rect.width / 4, rect.width / 2);
    match mark {
        Mark::None => {}
        Mark::Switch(on, color) => {
            if on {
                canvas.rounded(rect, square, Ink::solid(color));
            }
            canvas.outline(rect, square, stroke, OFF);
        }
        Mark::Choice(true) => {
            canvas.outline(rect, round, stroke, ACCENT);
            let dot = rect.inset(rect.width / 4);
            canvas.rounded(dot, dot.width / 2, ACCENT);
        }
        Mark::Choice(false) => canvas.outline(rect, round, stroke, OFF),
    }
}

fn draw_swatches(canvas: &mut Canvas, face: Face, [mut x, y]: Point, all: &[(u32, String)]) {
    let size = mark_size(face);
    for (color, text) in all {
        let swatch = Rect::new(x, y + (face.height() - size) / 2, size, size);
        canvas.rounded(swatch, size / 4, Ink::solid(*color));
        canvas.outline(swatch, size / 4, 1.0, EDGE);
        canvas.text(face, [x + face.width(2), y], TEXT, text);
        x += face.width(swatch_letters(text));
    }
}
