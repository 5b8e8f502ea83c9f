//! The session and the window's size -> each board where it fits, with as much on it as there is room for.
//!
//! Rule: a list of layouts from the most to the least generous, of which the first that fits is taken; none where even
//! the last does not.

use std::cmp::Reverse;

use super::board::{Board, Place};
use super::lines::{self, Line};
use super::style::Style;
use super::{Shown, measurements, pixel, room};
use crate::canvas::{FACES, Face, Point, Rect};
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

/// What is known of a pixel, where it leaves the pixel to be seen, and the panel as long as it can be read beside it.
pub fn probe(
    session: &Session,
    size: [usize; 2],
    area: Rect,
    panel: Option<Rect>,
) -> Option<Board> {
    let probe = session.probed()?;
    let first = session.overlay().scroll(Pane::Probe);
    let lines = [true, false].map(|wide| pixel::lines(probe, wide));
    let pixel = probe.pixel.map(|at| at as i32);
    place_probe(&lines, first, size, area, pixel, panel)
}

/// The lines about a pixel, for a wide and for a narrow board, from row `first` on where not all fit, off the pixel.
fn place_probe(
    [wide, narrow]: &[Vec<Line>; 2],
    first: usize,
    size: [usize; 2],
    area: Rect,
    pixel: Point,
    panel: Option<Rect>,
) -> Option<Board> {
    let mark = pixel::mark(pixel);
    let panel = panel.map(|panel| panel.inset(-FACES[0].advance()));
    let beside_panel = room::parts(area, &[[mark].as_slice(), panel.as_slice()].concat());
    let anywhere = room::parts(area, &[mark]);
    let set = |lines: &[Line], style: Style, part: Rect, most: i32| {
        let width = part.width.min(most);
        let at_right = part.right() == area.right();
        let (x, place) = if at_right {
            (part.right() - width, Place::Side)
        } else {
            (part.x, Place::Corner)
        };
        let room = Rect { x, width, ..part };
        Board::lay_out(lines.to_vec(), style, room, place, first)
    };
    let small = Style::new(FACES[0]).tight();
    let whole = faces(size, PANEL_ROWS)
        .flat_map(|face| [(wide, face), (narrow, face)])
        .map(|(lines, face)| (lines, Style::new(face), area.width * 45 / 100))
        .chain([(narrow, small, area.width)])
        .find_map(|(lines, style, most)| {
            let mut parts = beside_panel.iter();
            parts.find_map(|part| set(lines, style, *part, most))
        });
    let longest = |parts: &[Rect], style: Style| {
        let boards = parts
            .iter()
            .filter_map(|part| set(narrow, style, *part, area.width));
        boards.min_by_key(|board| Reverse(board.rows().len()))
    };
    whole
        .or_else(|| longest(&beside_panel, small.scrolled()))
        .or_else(|| longest(&anywhere, small.scrolled()))
        .or_else(|| longest(&anywhere, small.cut()))
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

#[cfg(test)]
mod tests {
    use super::*;

    /// As long and as wide as those about a pixel lit by three lights.
    fn about_a_pixel() -> [Vec<Line>; 2] {
        let lines = |rows: usize, letters: usize| {
            let mut lines = vec![Line::Title("pixel", "0,0".to_owned())];
            lines.resize(rows, Line::Text("x".repeat(letters)));
            lines
        };
        [lines(22, 66), lines(31, 37)]
    }

    #[test]
    fn what_is_known_of_a_pixel_never_covers_it() {
        let lines = about_a_pixel();
        for size in [
            [1, 1],
            [40, 30],
            [200, 900],
            [320, 240],
            [500, 1100],
            [640, 480],
            [960, 720],
            [1920, 1080],
            [5000, 20],
        ] {
            let [width, height] = size.map(|side| side as i32);
            let area = Rect::new(0, 0, width, height).inset(2);
            let panels = [2, 3, 4, 8].map(|part| {
                let panel = Rect::new(2, 2, width / part, height - 4);
                Some(panel).filter(|panel| !panel.is_empty())
            });
            for panel in panels.into_iter().chain([None]) {
                for (x, y) in (0..16).flat_map(|x| (0..16).map(move |y| (x, y))) {
                    let pixel = [width * x / 16, height * y / 16];
                    let Some(board) = place_probe(&lines, 0, size, area, pixel, panel) else {
                        assert!(width < 320 || height < 240, "no room at {size:?} {pixel:?}");
                        continue;
                    };
                    let (rect, mark) = (board.rect(), pixel::mark(pixel));
                    assert!(rect.intersection(&mark).is_empty(), "{size:?} {pixel:?}");
                    assert_eq!(rect.intersection(&area), rect, "{size:?} {pixel:?}");
                }
            }
        }
    }

    #[test]
    fn in_a_common_window_all_lines_about_a_pixel_stand_beside_the_panel() {
        let lines = about_a_pixel();
        for size in [[960, 720], [1280, 720], [1920, 1080]] {
            let [width, height] = size.map(|side| side as i32);
            let area = Rect::new(12, 12, width - 24, height - 24);
            let panel = Rect::new(12, 12, width / 4, height - 24);
            for x in (panel.right()..width).step_by(20) {
                let board = place_probe(&lines, 0, size, area, [x, height / 2], Some(panel))
                    .unwrap_or_else(|| panic!("no room at {size:?} {x}"));
                assert!(board.rect().intersection(&panel).is_empty(), "{size:?} {x}");
                assert!(board.rows().len() >= 22, "{size:?} {x}");
            }
        }
    }
}
