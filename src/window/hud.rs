//! What lies over the picture: the panel, the help and messages, laid out for the window's size; and what a gesture at
//! a place in the window means there.
//!
//! Rule: panel and help come before the picture, the help before the panel; what does not fit the window is left out
//! step by step, down to nothing.

use super::bindings::Action;
use super::board::{Board, Place};
use super::canvas::{Canvas, FACES, Face, Ink, Point, Rect};
use super::input::Gesture;
use super::legend::Legend;
use super::lines::{self, Line};
use super::overlay::Pane;
use super::probing;
use super::session::Session;
use super::style::Style;

/// A window is at least so many letters high, in those that its panel and its help are set in.
const PANEL_ROWS: i32 = 45;
const HELP_ROWS: i32 = 36;
/// How far a drag across the window's shorter side turns, in degrees.
const DRAG_TURN: f64 = 200.0;
const SHADE: Ink = Ink::glass(0, 120);
const MESSAGE_PANE: Ink = Ink::glass(0x0010_1216, 236);
const MESSAGE_EDGE: Ink = Ink::glass(0x00fb_bf24, 200);
const MESSAGE_TEXT: Ink = Ink::solid(0x00fd_e68a);

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

/// Words in a box at the window's lower edge.
struct Message {
    lines: Vec<String>,
    face: Face,
    rect: Rect,
}

impl Hud {
    /// Lays out what `session` shows over a picture of `size` pixels.
    pub fn new(session: &Session, size: [usize; 2], shown: Shown) -> Hud {
        let area = Rect::new(0, 0, size[0] as i32, size[1] as i32);
        let area = area.inset((area.width.min(area.height) / 60).max(2));
        let all = shown == Shown::All;
        let panel = panel(session, size, area, shown);
        let covered = panel.as_ref().map(Board::rect);
        let probe = probe(session, size, area, covered);
        let free = beside(area, probe.as_ref());
        let legend = |face| Legend::new(session, size, face, free, covered);
        Hud {
            size,
            probe,
            cross: session
                .probed()
                .map(|probe| probe.pixel.map(|at| at as i32)),
            panel,
            legend: faces(size, PANEL_ROWS).next().map(legend),
            help: help(session, size, area),
            message: session
                .overlay()
                .message()
                .filter(|_| all)
                .and_then(|text| message(text, size, area)),
            hovered: session.overlay().hovered().filter(|_| all),
            table: table(session, size, area),
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
            probing::draw_cross(canvas, cross, FACES[0].advance());
        }
        if let Some(probe) = &self.probe {
            probe.draw(canvas, None);
        }
        if let Some(panel) = &self.panel {
            panel.draw(canvas, self.hovered.filter(|_| !self.shades));
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
    fn action_at(&self, point: Point) -> Option<Action> {
        let (_, board) = self.board_at(point)?;
        board.action_at(point)
    }

    /// The uppermost board at `point`.
    fn board_at(&self, point: Point) -> Option<(Pane, &Board)> {
        [
            (Pane::Help, &self.help),
            (Pane::Table, &self.table),
            (Pane::Panel, &self.panel),
            (Pane::Probe, &self.probe),
        ]
        .into_iter()
        .filter_map(|(pane, board)| Some((pane, board.as_ref()?)))
        .find(|(_, board)| board.rect().contains(point))
    }
}

/// Does what `gesture` means in a window of `size` pixels.
pub fn respond(session: &mut Session, gesture: Gesture, size: [usize; 2]) {
    let hud = Hud::new(session, size, Shown::All);
    match gesture {
        Gesture::Command(action) => session.apply(action),
        Gesture::Released(action) => session.release(action),
        Gesture::Hover(point) => session.hover(hud.action_at(point)),
        Gesture::Click(point) => {
            if let Some(action) = hud.action_at(point) {
                session.apply(action);
                return;
            }
            match hud.board_at(point) {
                Some((Pane::Probe, _)) => session.probe(None),
                Some((Pane::Table, _)) => session.apply(Action::Measure),
                Some(_) => {}
                None if session.overlay().shows_help() => session.apply(Action::Help),
                None => session.probe(pixel_at(point, size)),
            }
        }
        Gesture::Drag { from, by } => {
            let caught = hud.legend().is_some_and(|legend| legend.catches(from));
            if hud.board_at(from).is_some() {
                return;
            }
            if session.holds_divider() || caught {
                session.drag_divider(f64::from(by[0]) / size[0].max(1) as f64);
            } else {
                let degrees = DRAG_TURN / size[0].min(size[1]).max(1) as f64;
                // The cuboid follows the mouse, so the camera goes the other way.
                session.apply(Action::Orbit {
                    azimuth: -f64::from(by[0]) * degrees,
                    elevation: f64::from(by[1]) * degrees,
                });
            }
        }
        Gesture::Drop => session.drop_divider(),
        Gesture::Wheel { at, notches } => match hud.board_at(at) {
            Some((pane, board)) => {
                if let Some(scroll) = board.scroll() {
                    let first = scroll.first.saturating_add_signed(-notches as isize);
                    session.scroll_to(pane, first.min(scroll.total - scroll.seen));
                }
            }
            None => session.apply(Action::Zoom(notches)),
        },
    }
}

/// The measurement in letters as large as the area allows.
fn table(session: &Session, size: [usize; 2], area: Rect) -> Option<Board> {
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
            Board::lay_out(measuring.lines(letters), style, area, Place::Middle, first)
        })
}

/// What a board at the right edge of `area` leaves of it.
fn beside(area: Rect, board: Option<&Board>) -> Rect {
    match board.map(Board::rect) {
        Some(rect) if rect.right() == area.right() => Rect {
            width: rect.x - FACES[0].advance() - area.x,
            ..area
        },
        _ => area,
    }
}

/// The pixel at `point`, where it lies in the picture.
fn pixel_at(point: Point, size: [usize; 2]) -> Option<[usize; 2]> {
    let [x, y] = point.map(|at| usize::try_from(at).ok());
    let pixel = [x?, y?];
    (pixel[0] < size[0] && pixel[1] < size[1]).then_some(pixel)
}

/// What is known of a pixel, beside it: at the right edge, or beside the panel where the pixel itself is there.
fn probe(session: &Session, size: [usize; 2], area: Rect, panel: Option<Rect>) -> Option<Board> {
    let probe = session.probed()?;
    let first = session.overlay().scroll(Pane::Probe);
    let [wide, narrow] = [true, false].map(|wide| probing::lines(probe, wide));
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

/// The faces for a window, from the one of which it holds so many rows down to the smallest.
fn faces(size: [usize; 2], rows: i32) -> impl Iterator<Item = Face> + Clone {
    let suits = move |face: &Face| *face == FACES[0] || face.height() * rows <= size[1] as i32;
    FACES.into_iter().rev().filter(suits)
}

/// The panel with as much left out as the area demands: it covers little of a large window and, where it is shown at
/// all, may cover much of a small one.
fn panel(session: &Session, size: [usize; 2], area: Rect, shown: Shown) -> Option<Board> {
    let first = session.overlay().scroll(Pane::Panel);
    if !session.overlay().shows_panel() {
        let style = Style::new(faces(size, PANEL_ROWS).next()?);
        let tab = session.overlay().shows_tab() && shown == Shown::All;
        return tab.then(|| Board::lay_out(lines::tab(session), style, area, Place::Corner, 0))?;
    }
    let full = lines::panel(session);
    let short = lines::shortened(&full);
    let part = |percent: i32| Rect {
        width: area.width * percent / 100,
        ..area
    };
    let large = faces(size, PANEL_ROWS).map(|face| (&full, Style::new(face), part(30)));
    let small = Style::new(FACES[0]);
    let narrow = small.without_states();
    let sparing = [
        (&full, small, part(45)),
        (&full, small.close(), part(45)),
        (&full, small.tight(), part(45)),
        (&short, small.tight(), part(45)),
        (&short, small.tight().scrolled(), part(30)),
        (&full, narrow, area),
        (&full, narrow.tight(), area),
        (&short, narrow.tight(), area),
        (&short, narrow.tight().scrolled(), area),
        (&short, narrow.tight().cut(), area),
    ];
    large.chain(sparing).find_map(|(lines, style, area)| {
        Board::lay_out(lines.clone(), style, area, Place::Corner, first)
    })
}

/// The help in letters as large as the area allows, side by side where it is wide.
fn help(session: &Session, size: [usize; 2], area: Rect) -> Option<Board> {
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

/// `text` in as many lines as it takes, where there is room for them.
fn message(text: &str, size: [usize; 2], area: Rect) -> Option<Message> {
    faces(size, HELP_ROWS).find_map(|face| {
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

impl Message {
    fn draw(&self, canvas: &mut Canvas) {
        let canvas = &mut canvas.clipped(self.rect);
        let padding = self.face.advance();
        canvas.rounded(self.rect, padding, MESSAGE_PANE);
        canvas.outline(self.rect, padding, 1.0, MESSAGE_EDGE);
        let mut y = self.rect.y + padding;
        for line in &self.lines {
            canvas.text(
                self.face,
                [self.rect.x + 2 * padding, y],
                MESSAGE_TEXT,
                line,
            );
            y += self.face.height();
        }
    }
}

/// `text` in lines of at most `letters`, broken between words where that is possible.
pub(super) fn wrapped(text: &str, letters: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut room = letters;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if room < letters && length < room {
            if let Some(line) = lines.last_mut() {
                line.push(' ');
            }
            room -= 1;
        } else if room < letters {
            lines.push(String::new());
            room = letters;
        }
        for letter in word.chars() {
            if room == 0 {
                lines.push(String::new());
                room = letters;
            }
            if let Some(line) = lines.last_mut() {
                line.push(letter);
            }
            room -= 1;
        }
    }
    lines
}
