//! Boards and what they should not cover -> a place and letters for each.
//!
//! Rule: a board that is placed later gives way to those that are there.

use super::board::{Board, TextStyle};
use super::lines::{self, Line};
use super::place::{Covered, place};
use super::{FACES, Part, editor, legend, measurements, pixel, profile, requires};
use crate::canvas::{Face, Point, Rect, wrapped};
use crate::window::session::Session;

/// The widths at which words are broken, in letters, the widest first.
const WRAPS: [usize; 2] = [60, 40];

/// Boards being placed.
pub struct Layout {
    pub window: Rect,
    /// The letters that may be used, the largest first.
    pub faces: Vec<Face>,
    /// Smaller letters are then used only where larger ones have no room; else where they cover less, too.
    pub size_is_chosen: bool,
    pub cuboids: Rect,
    /// What the probed pixel takes with its cross, and the lights with their names.
    pub marks: Vec<Rect>,
    pub arrows: Vec<Rect>,
    /// Those that have a place.
    pub boards: Vec<(Part, Board)>,
}

impl Layout {
    /// Adds a board near `wish` with the first of these versions of its lines, in the largest letters, that covers
    /// nothing; where none does, the one that covers least.
    pub fn add(&mut self, part: Part, versions: &[Vec<Line>], wish: Point) {
        let best = self.best(versions, wish);
        self.boards.extend(best.map(|(_, board)| (part, board)));
    }

    /// The same unless it would cover marks or other boards; whether it did not.
    pub fn add_clear(&mut self, part: Part, versions: &[Vec<Line>], wish: Point) -> bool {
        let best = self.best(versions, wish);
        let clear = best.filter(|(covered, _)| covered[..2] == [0, 0]);
        let is_clear = clear.is_some();
        self.boards.extend(clear.map(|(_, board)| (part, board)));
        is_clear
    }

    fn best(&self, versions: &[Vec<Line>], wish: Point) -> Option<(Covered, Board)> {
        let placed: Vec<Rect> = self.boards.iter().map(|(_, board)| board.rect).collect();
        let obstacles: [&[Rect]; 4] = [&self.marks, &placed, &self.arrows, &[self.cuboids]];
        let versions = versions.iter().filter(|lines| !lines.is_empty());
        let best = |faces: &[Face]| {
            let styles = faces.iter().map(|face| TextStyle::new(*face));
            let styles = styles.flat_map(|it| versions.clone().map(move |lines| (it, lines)));
            let all = styles.filter_map(|(style, lines)| {
                let size = style.size(lines);
                let corner = [wish[0] - size[0] / 2, wish[1] - size[1]];
                let (rect, covered) = place(size, self.window, corner, &obstacles)?;
                Some((covered, rect, style, lines))
            });
            // Of several that cover as much the first has the largest letters.
            all.min_by(|one, other| one.0.cmp(&other.0))
        };
        let (covered, rect, style, lines) = if self.size_is_chosen {
            self.faces.chunks(1).find_map(best)
        } else {
            best(&self.faces)
        }?;
        Some((covered, Board::new(lines.clone(), style, rect)))
    }

    /// Adds the names of both sides of a wipe beside the divider, at the upper edge; one that the edge cuts is left out.
    pub fn add_sides(&mut self, [left, right]: [String; 2], column: i32, area: Rect, face: Face) {
        let style = TextStyle::new(face);
        let gap = face.advance();
        for (text, is_left) in [(left, true), (right, false)] {
            let lines = vec![Line::Text(text)];
            let [width, height] = style.size(&lines);
            let behind = if is_left { -gap - width } else { gap };
            let rect = Rect::new(column + behind, area.y, width, height);
            if rect.intersection(&area) == rect {
                let board = Board::new(lines, style, rect);
                self.boards.push((Part::Legend, board));
            }
        }
    }
}

/// Adds what is shown beside the panel, the most important first.
pub fn add_boards(layout: &mut Layout, session: &Session, area: Rect) {
    let below = [area.x + area.width / 2, area.bottom()];
    let above = [area.right(), area.y];
    layout.add(Part::Editor, &[editor::lines(session)], above);
    layout.add(Part::Requires, &[requires::lines(session)], above);
    layout.add(Part::Legend, &[legend::lines(session)], below);
    if let Some(probe) = &session.probe {
        let lines = |worked| [false, true].map(|wide| pixel::lines(probe, wide, worked));
        if !layout.add_clear(Part::Probe, &lines(true), above) {
            layout.add(Part::Probe, &lines(false), above);
        }
    }
    layout.add_clear(Part::Profile, &[profile::lines(session)], below);
    let table = |letters| measurements::lines(&session.measuring, letters);
    layout.add(Part::Table, &WRAPS.map(table), above);
    if let Some(text) = &session.state.scene_error {
        let said = |letters| scene_error(text, letters);
        layout.add(Part::SceneError, &WRAPS.map(said), below);
    }
    if let Some(text) = session.state.message() {
        let broken = |letters| wrapped(text, letters).into_iter().map(Line::Text).collect();
        layout.add(Part::Message, &WRAPS.map(broken), below);
    }
}

/// What is wrong with the scene's file, its message broken to so many letters.
fn scene_error(text: &str, letters: usize) -> Vec<Line> {
    let title = Line::Title("the file is wrong", "the last good scene stays".to_owned());
    // What is shown of the file below the message is not broken: carets stand under it.
    let (message, place) = text.split_once('\n').unwrap_or((text, ""));
    let place = place.lines().map(str::to_owned);
    let lines = wrapped(message, letters).into_iter().chain(place);
    [title].into_iter().chain(lines.map(Line::Text)).collect()
}

/// The help in the middle of the window, in the largest letters in which both its boards fit; none where they do not.
pub fn help(session: &Session, window: Rect) -> Vec<Board> {
    let both = lines::help(session);
    let area = window.inset(FACES[0].advance());
    let style = |face: &Face| {
        let styles = [TextStyle::new(*face), TextStyle::tight(*face)];
        styles.into_iter().find_map(|style| {
            let sizes = [&both[0], &both[1]].map(|lines| style.size(lines));
            let width = sizes[0][0] + style.padding() + sizes[1][0];
            let height = sizes[0][1].max(sizes[1][1]);
            let fits = width <= area.width && height <= area.height;
            fits.then_some((style, sizes, [width, height]))
        })
    };
    let Some((style, sizes, [width, height])) = FACES.iter().rev().find_map(style) else {
        return Vec::new();
    };
    let mut x = window.x + (window.width - width) / 2;
    let y = window.y + (window.height - height) / 2;
    let boards = both.into_iter().zip(sizes).map(|(lines, [width, _])| {
        let board = Board::new(lines, style, Rect::new(x, y, width, height));
        x += width + style.padding();
        board
    });
    boards.collect()
}
