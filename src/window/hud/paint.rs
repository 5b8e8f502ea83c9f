//! A laid out [`Board`] -> pixels: its pane, its rows, their marks and keys.
//!
//! Rule: nothing is drawn outside of the board's edge, and every state is told by a filled or a hollow mark, with colour
//! only on top of it.

use super::board::{Board, Scroll};
use super::ink::{ALARM, DIM, EDGE, PANE, TEXT, THICK_PANE};
use super::lines::{Command, Line, Mark, ON};
use crate::canvas::{Canvas, Ink, Rect, fit};
use crate::window::bindings::Action;

const OFF: Ink = Ink::solid(0x008a_9199);
const KEYCAP: Ink = Ink::glass(0x00ff_ffff, 22);
const KEYCAP_EDGE: Ink = Ink::glass(0x00ff_ffff, 84);
const HOVER: Ink = Ink::glass(0x00ff_ffff, 34);
const ACCENT: Ink = Ink::solid(ON);

impl Board {
    /// Draws it, the row of `hovered` lit.
    pub fn draw(&self, canvas: &mut Canvas, hovered: Option<Action>) {
        let canvas = &mut canvas.clipped(self.rect);
        let radius = self.style.gap();
        let pane = if self.style.over_letters {
            THICK_PANE
        } else {
            PANE
        };
        canvas.rounded(self.rect, radius, pane);
        canvas.outline(self.rect, radius, 1.0, EDGE);
        for (line, row) in &self.rows {
            match line {
                Line::Title(name, detail) => self.draw_title(canvas, *row, name, detail),
                Line::Heading(text) => {
                    let at = [
                        row.x,
                        row.bottom() - i32::midpoint(self.style.pitch(), self.style.face.height()),
                    ];
                    canvas.bold(self.style.face, at, DIM, &text.to_uppercase());
                }
                Line::Command(command) => {
                    if hovered == Some(command.action) {
                        let reach = self.style.padding()[0] / 2;
                        let lit =
                            Rect::new(row.x - reach, row.y, row.width + 2 * reach, row.height);
                        canvas.rounded(lit, self.style.gap() / 2, HOVER);
                    }
                    self.draw_command(canvas, *row, command);
                }
                Line::Text(words) => {
                    let letters = (row.width / self.style.face.advance()).max(0) as usize;
                    let at = [row.x, self.text_top(*row)];
                    canvas.text(self.style.face, at, TEXT, &fit(words, letters));
                }
                Line::Fact(name, value) => self.draw_fact(canvas, *row, name, (value, TEXT)),
                Line::Alarm(name, value) => self.draw_fact(canvas, *row, name, (value, ALARM)),
                Line::Rule => {
                    canvas.fill(Rect::new(row.x, row.y + row.height / 2, row.width, 1), EDGE);
                }
            }
        }
        self.draw_scroll(canvas);
    }

    /// The program's name, and as much of the detail as there is room for.
    fn draw_title(&self, canvas: &mut Canvas, row: Rect, name: &str, detail: &str) {
        let (face, y) = (self.style.face, self.text_top(row));
        let letters = (row.width / face.advance()).max(0) as usize;
        let detail = fit(detail, letters.saturating_sub(name.len() + 1));
        canvas.bold(face, [row.x, y], TEXT, &fit(name, letters));
        let left = row.right() - face.width(detail.chars().count());
        canvas.text(face, [left, y], DIM, &detail);
    }

    /// A value, and its name where there is room for both.
    fn draw_fact(&self, canvas: &mut Canvas, row: Rect, name: &str, (value, ink): (&str, Ink)) {
        let (face, y) = (self.style.face, self.text_top(row));
        let letters = (row.width / face.advance()).max(0) as usize;
        let value = fit(value, letters);
        let value_letters = value.chars().count();
        canvas.text(
            face,
            [row.right() - face.width(value_letters), y],
            ink,
            &value,
        );
        if name.len() + 1 + value_letters <= letters {
            canvas.text(face, [row.x, y], DIM, name);
        }
    }

    fn draw_command(&self, canvas: &mut Canvas, row: Rect, command: &Command) {
        let (style, face, y) = (&self.style, self.style.face, self.text_top(row));
        let mut x = row.x;
        for caption in &command.captions {
            let height = face.height() * 15 / 16;
            let cap = Rect::new(
                x,
                row.y + (row.height - height) / 2,
                style.keycap(caption),
                height,
            );
            canvas.rounded(cap, style.gap() / 2, KEYCAP);
            canvas.outline(cap, style.gap() / 2, 1.0, KEYCAP_EDGE);
            canvas.text(face, [x + style.gap() / 2, y], TEXT, caption);
            x = cap.right() + style.keycap_gap();
        }
        let size = style.mark();
        let mark = Rect::new(
            row.x + self.columns.mark,
            row.y + (row.height - size) / 2,
            size,
            size,
        );
        draw_mark(canvas, mark, command.mark);
        let ink = match command.mark {
            Mark::Switch(false, _) | Mark::Choice(false) => DIM,
            _ => TEXT,
        };
        let label = fit(&command.label, self.columns.label_letters);
        canvas.text(face, [row.x + self.columns.label, y], ink, &label);
        if style.states {
            let x = row.right() - face.width(command.state.chars().count());
            canvas.text(face, [x, y], ink, &command.state);
        }
    }

    /// A bar at the right edge, as long as the part that is seen.
    fn draw_scroll(&self, canvas: &mut Canvas) {
        let Some(Scroll { first, seen, total }) = self.scroll else {
            return;
        };
        let [across, down] = self.style.padding();
        let (top, height) = (self.rect.y + down, self.rect.height - 2 * down);
        let part = |rows: usize| height * rows as i32 / total as i32;
        let width = (across / 3).max(2);
        let left = self.rect.right() - across + (across - width) / 2;
        let bar = Rect::new(left, top + part(first), width, part(seen));
        canvas.rounded(bar, width / 2, OFF);
    }

    /// The top of the letters in a row.
    fn text_top(&self, row: Rect) -> i32 {
        row.y + (row.height - self.style.face.height()) / 2
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
