//! What lies over the picture: the panel, the help, what is known of a pixel, what was measured, and messages.
//!
//! ```text
//! session --lines, pixel, measurements--> lines --layout (board, style)--> boards --paint--> canvas
//!    '------- legend, message --------------------------------------------------------------^
//! ```
//! Rule: pure on pixels; the help lies over the panel and the panel over the picture, a pixel looked at is never covered by
//! what is said of it, and what does not fit the window is left out step by step, down to nothing.

pub mod board;
mod ink;
mod layout;
pub mod legend;
pub mod lines;
pub mod measurements;
mod message;
mod paint;
pub mod pixel;
mod room;
pub mod style;

use super::bindings::Action;
use super::overlay::Pane;
use super::session::Session;
use crate::canvas::{Canvas, Ink, Point, Rect};
use board::Board;
use legend::Legend;
use message::Message;

const SHADE: Ink = Ink::glass(0, 120);

/// What is shown over a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// Everything.
    All,
    /// What does not pass by itself: what a saved picture shows.
    Lasting,
}

/// Everything over the picture, each in its place.
pub struct Hud {
    size: [usize; 2],
    panel: Option<Board>,
    help: Option<Board>,
    table: Option<Board>,
    probe: Option<Board>,
    cross: Option<Point>,
    legend: Option<Legend>,
    message: Option<Message>,
    hovered: Option<Action>,
    shades: bool,
}

impl Hud {
    /// Lays out what `session` shows over a picture of `size` pixels.
    pub fn new(session: &Session, size: [usize; 2], shown: Shown) -> Hud {
        let area = Rect::new(0, 0, size[0] as i32, size[1] as i32);
        let area = area.inset((area.width.min(area.height) / 60).max(2));
        let all = shown == Shown::All;
        let panel = layout::panel(session, size, area, shown);
        let covered = panel.as_ref().map(Board::rect);
        let panel_face = panel
            .as_ref()
            .map(|panel| panel.style.face)
            .or_else(|| layout::panel_face(size));
        let probe = layout::probe(session, size, area, covered);
        let beside_probe = layout::beside(area, probe.as_ref());
        let taken: Vec<Rect> = covered
            .into_iter()
            .chain(probe.as_ref().map(Board::rect))
            .collect();
        let legend = |face| Legend::new(session, size, face, &[area, beside_probe], &taken);
        Hud {
            size,
            probe,
            cross: session
                .probed()
                .map(|probe| probe.pixel.map(|at| at as i32)),
            panel,
            legend: panel_face.map(legend),
            help: layout::help(session, size, area),
            message: session
                .overlay()
                .message()
                .filter(|_| all)
                .and_then(|text| Message::new(text, size, area)),
            hovered: session.overlay().hovered().filter(|_| all),
            table: layout::table(session, size, area),
            shades: session.overlay().shows_help(),
        }
    }

    /// Draws it all over the picture in `pixels`, 0x00RRGGBB, row by row from the top.
    pub fn draw(&self, pixels: &mut [u32]) {
        let canvas = &mut Canvas::new(pixels, self.size);
        if let Some(legend) = &self.legend {
            legend.draw(canvas);
        }
        if let Some(cross) = self.cross {
            pixel::draw_cross(canvas, cross);
        }
        if let Some(panel) = &self.panel {
            panel.draw(canvas, self.hovered.filter(|_| !self.shades));
        }
        if let Some(probe) = &self.probe {
            probe.draw(canvas, None);
        }
        if let Some(table) = &self.table {
            table.draw(canvas, None);
        }
        if self.shades {
            canvas.fill(canvas.clip(), SHADE);
        }
        if let Some(help) = &self.help {
            help.draw(canvas, self.hovered);
        }
        if let Some(message) = &self.message {
            message.draw(canvas);
        }
    }

    /// The panel, or the tab that stands in for it, where there is room for it.
    pub fn panel(&self) -> Option<&Board> {
        self.panel.as_ref()
    }

    /// The help, where it is open and there is room for it.
    pub fn help(&self) -> Option<&Board> {
        self.help.as_ref()
    }

    /// What is known of a pixel, where one is looked at and there is room for it.
    pub fn probe(&self) -> Option<&Board> {
        self.probe.as_ref()
    }

    /// What is measured or was, where there is room for it.
    pub fn table(&self) -> Option<&Board> {
        self.table.as_ref()
    }

    /// What explains the view.
    pub fn legend(&self) -> Option<&Legend> {
        self.legend.as_ref()
    }

    /// The command of the uppermost board at `point`.
    pub fn action_at(&self, point: Point) -> Option<Action> {
        let (_, board) = self.board_at(point)?;
        board.action_at(point)
    }

    /// The uppermost board at `point`.
    pub fn board_at(&self, point: Point) -> Option<(Pane, &Board)> {
        [
            (Pane::Help, &self.help),
            (Pane::Table, &self.table),
            (Pane::Probe, &self.probe),
            (Pane::Panel, &self.panel),
        ]
        .into_iter()
        .filter_map(|(pane, board)| Some((pane, board.as_ref()?)))
        .find(|(_, board)| board.rect().contains(point))
    }
}
