//! Words that stand in the window for a while -> a box at its lower edge.
//!
//! Rule: the words are broken into as many lines as they take, and left out where those do not fit.

use super::layout;
use crate::canvas::{Canvas, Face, Ink, Rect, wrapped};

const PANE: Ink = Ink::glass(0x0010_1216, 236);
const EDGE: Ink = Ink::glass(0x00fb_bf24, 200);
const TEXT: Ink = Ink::solid(0x00fd_e68a);

/// Words in a box.
pub struct Message {
    lines: Vec<String>,
    face: Face,
    rect: Rect,
}

impl Message {
    /// `text` in as many lines as it takes, where there is room for them.
    pub fn new(text: &str, size: [usize; 2], area: Rect) -> Option<Self> {
        layout::message_faces(size).find_map(|face| {
            let padding = face.advance();
            let letters = usize::try_from((area.width - 4 * padding) / face.advance())
                .ok()
                .filter(|it| *it > 0)?;
            let lines = wrapped(text, letters);
            let longest = lines.iter().map(|line| line.chars().count()).max()?;
            let size = [
                face.width(longest) + 4 * padding,
                face.height() * lines.len() as i32 + 2 * padding,
            ];
            let corner = [area.x + (area.width - size[0]) / 2, area.bottom() - size[1]];
            let rect = Rect::new(corner[0], corner[1], size[0], size[1]);
            (size[1] <= area.height).then_some(Message { lines, face, rect })
        })
    }

    /// Draws it.
    pub fn draw(&self, canvas: &mut Canvas) {
        let canvas = &mut canvas.clipped(self.rect);
        let padding = self.face.advance();
        canvas.rounded(self.rect, padding, PANE);
        canvas.outline(self.rect, padding, 1.0, EDGE);
        let mut y = self.rect.y + padding;
        for line in &self.lines {
            canvas.text(self.face, [self.rect.x + 2 * padding, y], TEXT, line);
            y += self.face.height();
        }
    }
}
