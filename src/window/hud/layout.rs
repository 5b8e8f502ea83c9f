//! The session and the window's size -> each board where it fits, with as much on it as there is room for.
//!
//! Rule: a list of layouts from the most to the least generous, of which the first that fits is taken; none where even
//! the last does not.

use super::board::{Board, Place};
use super::lines::{self, Line};
use super::style::Style;
use super::{Shown, measurements, pixel};
use crate::canvas::{FACES, Face, Rect};
use crate::window::overlay::Pane;
use crate::window::session::Session;

/// A window is at least so many letters high, in those that its panel and its help are set in.
const PANEL_ROWS: i32 = 45;
const HELP_ROWS: i32 = 36;
/// And so many letters wide.
const LETTERS_ACROSS: i32 = 100;

/// The panel with as much left out as the area demands: it covers little of a large window and, where it is shown at
/// all, may cover much of a small one.
pub fn panel(session: &Session, size: [usize; 2], area: Rect, shown: Shown) -> Option<Board> {
    let first = session.overlay().scroll(Pane::Panel);
    if !session.overlay().shows_panel() {
        let style = Style::new(panel_face(size)?);
        let tab = session.overlay().shows_tab() && shown == Shown::All;
        return tab.then(|| Board::lay_out(lines::tab(session), style, area, Place::Corner, 0))?;
    }
    let full = lines::panel(session);
    let brief = lines::brief_panel(session);
    let part = |percent: i32| Rect {
        width: area.width * percent / 100,
        ..area
    };
    let large = faces(size, PANEL_ROWS).map(|face| (&full, Style::new(face), part(25)));
    let small = Style::new(FACES[0]);
    let narrow = small.without_states();
    let sparing = [
        (&full, small.close(), part(25)),
        (&full, small.tight(), part(25)),
        (&brief, narrow, part(50)),
        (&brief, narrow.close(), part(50)),
        (&brief, narrow.tight(), part(50)),
        (&brief, narrow.tight().scrolled(), part(50)),
        (&brief, narrow, area),
        (&brief, narrow.tight(), area),
        (&brief, narrow.tight().scrolled(), area),
        (&brief, narrow.tight().cut(), area),
    ];
    large.chain(sparing).find_map(|(lines, style, area)| {
        Board::lay_out(lines.clone(), style, area, Place::Corner, first)
    })
}

/// The help in letters as large as the area allows, side by side where it is wide.
pub fn help(session: &Session, size: [usize; 2], area: Rect) -> Option<Board> {
    if !session.overlay().shows_help() {
        return None;
    }
    let first = session.overlay().scroll(Pane::Help);
    let large = faces(size, HELP_ROWS)
        .map(Style::new)
        .flat_map(|style| [style.columns(2), style]);
    let small = Style::new(FACES[0]).tight();
    let narrow = small.without_states();
    let sparing = [
        small.columns(2),
        small.columns(3),
        small,
        narrow.columns(2),
        narrow,
        small.scrolled(),
        narrow.scrolled(),
        narrow.cut(),
    ];
    let lines = lines::help(session);
    large
        .chain(sparing)
        .find_map(|style| Board::lay_out(lines.clone(), style, area, Place::Middle, first))
}

/// The measurement in letters as large as the area allows.
pub fn table(session: &Session, size: [usize; 2], area: Rect) -> Option<Board> {
    let first = session.overlay().scroll(Pane::Table);
    let measuring = session.measuring();
    let small = Style::new(FACES[0]).tight();
    let sparing = [
        (small, 60),
        (small, 40),
        (small.scrolled(), 40),
        (small.cut(), 40),
    ];
    faces(size, HELP_ROWS)
        .flat_map(|face| [(Style::new(face), 60), (Style::new(face), 40)])
        .chain(sparing)
        .filter(|_| measuring.is_open())
        .find_map(|(style, letters)| {
            Board::lay_out(
                measurements::lines(measuring, letters),
                style,
                area,
                Place::Middle,
                first,
            )
        })
}

/// What is known of a pixel, beside it: at the right edge, or beside the panel where the pixel itself is there.
pub fn probe(
    session: &Session,
    size: [usize; 2],
    area: Rect,
    panel: Option<Rect>,
) -> Option<Board> {
    let probe = session.probed()?;
    let first = session.overlay().scroll(Pane::Probe);
    let [wide, narrow] = [true, false].map(|wide| pixel::lines(probe, wide));
    let part = |percent: i32| area.width * percent / 100;
    let large = faces(size, PANEL_ROWS).flat_map(|face| {
        let style = Style::new(face);
        [(&wide, style, part(45)), (&narrow, style, part(45))]
    });
    let small = Style::new(FACES[0]).tight();
    let sparing = [
        (&narrow, small, area.width),
        (&narrow, small.scrolled(), area.width),
        (&narrow, small.cut(), area.width),
    ];
    let pixel = probe.pixel.map(|at| at as i32);
    let at_right = |lines: &[Line], style, width| {
        let x = area.right() - width;
        let room = Rect { x, width, ..area };
        Board::lay_out(lines.to_vec(), style, room, Place::Side, first)
    };
    let uncovering = large.clone().find_map(|(lines, style, width)| {
        at_right(lines, style, width).filter(|board| !board.rect().contains(pixel))
    });
    let beside_panel = || {
        let x = panel.map_or(area.x, |panel| panel.right() + FACES[0].advance());
        large.clone().find_map(|(lines, style, width)| {
            let width = width.min(area.right() - x);
            let room = Rect { x, width, ..area };
            Board::lay_out(lines.clone(), style, room, Place::Corner, first)
        })
    };
    let anywhere = || {
        let mut sparing = sparing.into_iter();
        sparing.find_map(|(lines, style, width)| at_right(lines, style, width))
    };
    uncovering.or_else(beside_panel).or_else(anywhere)
}

/// What a board at the right edge of `area` leaves of it.
pub fn beside(area: Rect, board: Option<&Board>) -> Rect {
    match board.map(Board::rect) {
        Some(rect) if rect.right() == area.right() => Rect {
            width: rect.x - FACES[0].advance() - area.x,
            ..area
        },
        _ => area,
    }
}

/// The letters of the panel, and of what stands beside it.
pub fn panel_face(size: [usize; 2]) -> Option<Face> {
    faces(size, PANEL_ROWS).next()
}

/// The letters of a message.
pub fn message_faces(size: [usize; 2]) -> impl Iterator<Item = Face> {
    faces(size, HELP_ROWS)
}

/// The faces for a window, from the one of which it holds so many rows and enough letters across down to the smallest.
fn faces(size: [usize; 2], rows: i32) -> impl Iterator<Item = Face> + Clone {
    let [width, height] = size.map(|side| side as i32);
    let holds = move |face: &Face| {
        face.height() * rows <= height && face.advance() * LETTERS_ACROSS <= width
    };
    let suits = move |face: &Face| *face == FACES[0] || holds(face);
    FACES.into_iter().rev().filter(suits)
}
