//! The session and the window's size -> where everything stands: the panel, the picture, and the boards over it.
//!
//! ```text
//!   +-------+---------------------------+
//!   | panel |  picture      +---------+ |   The panel has a strip of its own, the picture the rest.
//!   |       |     /\        |  probe  | |   Boards stand where they cover neither the probed pixel nor
//!   |       |    /  \       +---------+ |   each other and the panel nor the cuboids, in this order of
//!   |       |    \  /   [message]       |   importance, as far as the window allows.
//!   +-------+---------------------------+
//! ```
//! Rules: pure; every text is set in the largest letters for which there is room. A board for which the smallest are too
//! large is left out. What was drawn is what is clicked: the [`Hud`] that was drawn answers where a click goes.

pub mod arrows;
pub mod board;
pub mod editor;
mod layout;
pub mod legend;
pub mod lines;
pub mod markers;
pub mod measurements;
pub mod pixel;
mod place;
pub mod profile;
pub mod requires;

use super::bindings::Action;
use super::magnifier::{MAX_SCALE, Magnifier};
use super::session::Session;
use crate::canvas::{Canvas, FACES, Face, Ink, Point, Rect};
use crate::components::{Polygon, Projected};
use arrows::{Arrow, arrows};
use board::{Board, TextStyle};
use layout::{Layout, add_boards, help};
use markers::{Marker, markers};

/// How many letters wide the panel is; values that change never change it.
const PANEL_LETTERS: usize = 33;
/// The panel takes at most this share of the window's width, in percent.
const PANEL_SHARE: i32 = 38;

const SHADE: Ink = Ink::glass(0, 120);
const DIVIDER: Ink = Ink::glass(0x00ff_ffff, 230);
const DIVIDER_EDGE: Ink = Ink::glass(0, 110);
const GRIP: Ink = Ink::solid(0x0055_5b62);

/// How far the divider can be missed and is still caught, in pixels.
pub const REACH: i32 = 14;

/// What a board is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Panel,
    /// What explains the view.
    Legend,
    /// What is known of a pixel.
    Probe,
    /// The levels along its row.
    Profile,
    /// What is measured.
    Table,
    Message,
    Help,
    /// What the scene requires.
    Requires,
    /// The numbers of the scene.
    Editor,
    /// What is wrong with the scene's file.
    SceneError,
}

/// Everything in the window, each in its place.
#[derive(Debug)]
pub struct Hud {
    size: [usize; 2],
    /// Where the picture stands.
    pub picture: Rect,
    /// How large pixels are seen.
    pub magnifier: Magnifier,
    /// The upper ones last.
    boards: Vec<(Part, Board)>,
    /// The divider's column in the window.
    divider: Option<i32>,
    /// The probed pixel in the window.
    cross: Option<Point>,
    /// The vectors at the probed pixel.
    arrows: Vec<Arrow>,
    /// The lights, while the numbers of the scene are shown.
    markers: Vec<Marker>,
    face: Face,
    hovered: Option<Action>,
}

/// The panel where it is wanted and there is room for it, and the picture beside it.
fn strips(session: &Session, size: [usize; 2]) -> (Option<Board>, Rect, Face) {
    let window = Rect::new(0, 0, size[0] as i32, size[1] as i32);
    let lines = lines::panel(session);
    let width = |face: Face| {
        let padding = TextStyle::new(face).padding();
        face.width(PANEL_LETTERS) + 2 * padding
    };
    let style = |face: &Face| {
        let tight = TextStyle::tight(*face);
        let room = window.height - 2 * tight.padding();
        let fits = width(*face) <= window.width * PANEL_SHARE / 100 && tight.height(&lines) <= room;
        let rows = tight.height(&lines) / tight.pitch + 1;
        let pitch = (room / rows).clamp(tight.pitch, face.height() * 5 / 4);
        fits.then_some(TextStyle { pitch, ..tight })
    };
    let chosen = session.state.letters;
    let faces = chosen.map_or(&FACES[..], |size| &FACES[size..=size]);
    let Some(style) = faces.iter().rev().find_map(style) else {
        return (None, window, faces[0]);
    };
    if !session.state.panel {
        return (None, window, style.face);
    }
    let strip = Rect {
        width: width(style.face),
        ..window
    };
    let picture = Rect::new(strip.right(), 0, window.width - strip.width, window.height);
    (Some(Board::new(lines, style, strip)), picture, style.face)
}

/// Where the picture stands in a window of `size` pixels.
pub fn picture(session: &Session, size: [usize; 2]) -> Rect {
    strips(session, size).1
}

/// What the cuboids take of the picture as it was last drawn, in its pixels; empty where nothing is seen.
fn seen_part(session: &Session) -> Rect {
    let mut seen: Option<[i32; 4]> = None;
    let mut cuboids = session.scene.world.query::<&Projected>();
    let polygons = cuboids.iter().flat_map(|projected| &projected.polygons);
    for [x, y] in polygons.flat_map(Polygon::vertices) {
        // Vertices are in 1/256 pixel.
        let [x, y] = [x >> 8, y >> 8];
        let [left, top, right, bottom] = seen.unwrap_or([x, y, x, y]);
        seen = Some([left.min(x), top.min(y), right.max(x), bottom.max(y)]);
    }
    seen.map_or(Rect::default(), |[left, top, right, bottom]| {
        Rect::new(left, top, right - left + 1, bottom - top + 1)
    })
}

impl Hud {
    /// Lays out what `session` shows in a window of `size` pixels, after its picture was drawn.
    pub fn new(session: &Session, size: [usize; 2]) -> Hud {
        let (panel, picture, face) = strips(session, size);
        let state = &session.state;
        let size_of_picture = picture.size();
        let magnifier = state.magnifier.within(size_of_picture);
        let seen = seen_part(session);
        let corner = magnifier.place([seen.x, seen.y]);
        let scale = magnifier.scale as i32;
        let moved = Rect::new(
            picture.x + corner[0],
            picture.y + corner[1],
            seen.width * scale,
            seen.height * scale,
        );
        let in_window = |pixel: Point| {
            let [x, y] = magnifier.place(pixel);
            let place = [picture.x + x, picture.y + y];
            picture.contains(place).then_some(place)
        };
        let probed = session.probe.as_ref();
        let cross = probed.and_then(|it| in_window(it.pixel.map(|at| at as i32)));
        let lights = match state.editor {
            Some(_) => markers(session, size_of_picture),
            None => Vec::new(),
        };
        let in_place = |it: Marker| in_window(it.at).map(|at| Marker { at, ..it });
        let markers: Vec<Marker> = lights.into_iter().filter_map(in_place).collect();
        let arrows = arrows(session, &session.scene.viewpoint(session.camera()));
        let discs = markers.iter().map(|it| it.rect(picture, face));
        let window = Rect::new(0, 0, size[0] as i32, size[1] as i32);
        let margin = FACES[0].advance();
        let faces = FACES.into_iter().rev();
        let mut layout = Layout {
            window: window.inset(margin),
            faces: faces.skip_while(|it| *it != face).collect(),
            size_is_chosen: state.letters.is_some(),
            cuboids: moved.intersection(&picture),
            marks: cross.map(pixel::mark).into_iter().chain(discs).collect(),
            arrows: cross.map_or(Vec::new(), |from| {
                arrows.iter().map(|it| it.rect(from, face)).collect()
            }),
            boards: panel.map(|it| (Part::Panel, it)).into_iter().collect(),
        };
        let area = picture.inset(margin);
        let mut divider = None;
        if let Some(names) = legend::sides(session) {
            let column = state.divider_column(size_of_picture[0]) as i32;
            let [middle, _] = magnifier.place([column, 0]);
            let column = picture.x + middle - scale / 2;
            layout.add_sides(names, column, area, face);
            let is_seen = (picture.x..picture.right()).contains(&column);
            divider = is_seen.then_some(column);
        }
        add_boards(&mut layout, session, area);
        let mut boards = layout.boards;
        if state.help {
            boards.extend(help(session, window).into_iter().map(|it| (Part::Help, it)));
        }
        Hud {
            size,
            picture,
            magnifier,
            arrows,
            markers,
            face,
            boards,
            divider,
            cross,
            hovered: state.hovered,
        }
    }

    /// The boards of this kind.
    pub fn boards(&self, part: Part) -> impl Iterator<Item = &Board> {
        let boards = self.boards.iter();
        boards
            .filter(move |(it, _)| *it == part)
            .map(|(_, board)| board)
    }

    /// Puts the picture in its place, and everything over it; `lasting` leaves out what passes by itself.
    pub fn draw(&self, picture: &[u32], lasting: bool, pixels: &mut Vec<u32>) {
        let [width, height] = self.size;
        pixels.clear();
        pixels.resize(width * height, 0);
        let left = self.picture.x as usize;
        let rows = pixels.chunks_exact_mut(width);
        for (y, row) in rows.enumerate().take(self.picture.height as usize) {
            let [x, y] = self.magnifier.pixel([0, y as i32]);
            let drawn = &picture[y * (width - left)..][x..width - left];
            let row = &mut row[left..];
            if self.magnifier.scale == 1 {
                // Squares of one pixel are slow to fill.
                row.copy_from_slice(drawn);
                continue;
            }
            let squares = row.chunks_mut(self.magnifier.scale);
            squares
                .zip(drawn)
                .for_each(|(square, pixel)| square.fill(*pixel));
        }
        let canvas = &mut Canvas::new(pixels, self.size);
        let over_picture = &mut canvas.clipped(self.picture);
        if self.magnifier.scale == MAX_SCALE {
            self.draw_bytes(over_picture, picture);
        }
        if let Some(column) = self.divider {
            draw_divider(over_picture, column, FACES[0]);
        }
        if let Some(cross) = self.cross {
            for arrow in &self.arrows {
                arrows::draw(over_picture, arrow, cross, self.face);
            }
            pixel::draw_cross(over_picture, cross, self.magnifier.scale as i32 / 2);
        }
        for marker in self.markers.iter().rev() {
            marker.draw(over_picture, self.picture, self.face);
        }
        let hovered = self.hovered.filter(|_| !lasting);
        let has_help = self.boards(Part::Help).next().is_some();
        let shown = |part: Part| !(lasting && part == Part::Message);
        for (part, board) in self.boards.iter().filter(|(part, _)| shown(*part)) {
            if *part != Part::Help {
                board.draw(canvas, hovered.filter(|_| !has_help));
            }
        }
        if has_help {
            canvas.fill(canvas.clip(), SHADE);
        }
        for board in self.boards(Part::Help) {
            board.draw(canvas, hovered);
        }
    }

    /// Writes the bytes of each pixel into it, below one another.
    fn draw_bytes(&self, canvas: &mut Canvas, picture: &[u32]) {
        let face = FACES[0];
        let [width, height] = self.picture.size();
        let [last_x, last_y] = self.magnifier.pixel([width as i32 - 1, height as i32 - 1]);
        for y in self.magnifier.corner[1]..=last_y {
            for x in self.magnifier.corner[0]..=last_x {
                let [_, red, green, blue] = picture[y * width + x].to_be_bytes();
                let place = self.magnifier.place([x as i32, y as i32]);
                let middle = [self.picture.x + place[0], self.picture.y + place[1]];
                for (row, byte) in (-1..).zip([red, green, blue]) {
                    let text = byte.to_string();
                    let left = middle[0] - face.width(text.len()) / 2;
                    let top = middle[1] + row * face.height() - face.height() / 2;
                    let ink = Ink::solid(if green > 127 { 0 } else { 0x00ff_ffff });
                    canvas.text(face, [left, top], ink, &text);
                }
            }
        }
    }

    /// How large letters are at most, as [`FACES`] counts.
    pub fn letters(&self) -> usize {
        FACES.iter().take_while(|it| **it != self.face).count()
    }

    /// The probed pixel in the window, or the middle of the picture.
    pub fn focus(&self) -> Point {
        let picture = self.picture;
        let middle = [
            picture.x + picture.width / 2,
            picture.y + picture.height / 2,
        ];
        self.cross.unwrap_or(middle)
    }

    /// The uppermost board at `point`.
    pub fn board_at(&self, point: Point) -> Option<(Part, &Board)> {
        let mut boards = self.boards.iter().rev();
        let at = boards.find(|(_, board)| board.rect.contains(point));
        at.map(|(part, board)| (*part, board))
    }

    /// What a click at `point` does.
    pub fn action_at(&self, point: Point) -> Option<Action> {
        let (_, board) = self.board_at(point)?;
        board.action_at(point)
    }

    /// Whether a press at `point` catches the divider.
    pub fn catches_divider(&self, point: Point) -> bool {
        let near = |column: i32| (point[0] - column).abs() <= REACH;
        self.picture.contains(point) && self.divider.is_some_and(near)
    }

    /// The light, by its place in the file, whose disc a press at `point` catches.
    pub fn light_at(&self, point: Point) -> Option<usize> {
        let reach = markers::radius(self.face) + 2;
        let caught = |marker: &&Marker| {
            let [x, y] = [0, 1].map(|axis| point[axis] - marker.at[axis]);
            x * x + y * y <= reach * reach
        };
        self.markers.iter().find(caught).map(|marker| marker.light)
    }

    /// The pixel of the picture at `point` of the window.
    pub fn pixel_at(&self, point: Point) -> Option<[usize; 2]> {
        let place = [point[0] - self.picture.x, point[1] - self.picture.y];
        let inside = self.picture.contains(point);
        inside.then(|| self.magnifier.pixel(place))
    }
}

/// A thin line from top to bottom, and something to hold it by.
fn draw_divider(canvas: &mut Canvas, column: i32, face: Face) {
    let clip = canvas.clip();
    for (x, width, ink) in [(column - 2, 4, DIVIDER_EDGE), (column - 1, 2, DIVIDER)] {
        canvas.fill(Rect::new(x, clip.y, width, clip.height), ink);
    }
    let [width, height] = [face.advance() * 2, face.height() * 2];
    let middle = clip.y + clip.height / 2;
    let handle = Rect::new(column - width / 2, middle - height / 2, width, height);
    canvas.rounded(handle, width / 2, DIVIDER);
    canvas.outline(handle, width / 2, 1.0, DIVIDER_EDGE);
    for x in [column - width / 8 - 1, column + width / 8] {
        let line = Rect::new(x, middle - height / 5, 1, height * 2 / 5);
        canvas.fill(line, GRIP);
    }
}
