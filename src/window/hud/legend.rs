//! The session's view -> what explains it: the divider of a wipe with what is on either side, the scale of the error map,
//! the tints of tiles.
//!
//! Rule: nothing here can be clicked, what does not fit beside panel and pixel is left out, and the words for what is not
//! computed yet say so.

use std::cmp::Reverse;

use super::ink::{self, DIM, PANE, TEXT};
use super::lines;
use crate::canvas::{Canvas, Face, Ink, Point, Rect};
use crate::components::ShadingMode;
use crate::prove::{REFUTED, UNDECIDED};
use crate::shading::TileKind;
use crate::trade::error_map::{self, EDGE, NOTHING};
use crate::window::session::Session;
use crate::window::views::{TINTS, ViewMode, mode_label};

const DIVIDER: Ink = Ink::glass(0x00ff_ffff, 230);
const DIVIDER_EDGE: Ink = Ink::glass(0, 110);
const GRIP: Ink = Ink::solid(0x0055_5b62);

/// The errors named on the scale, in levels, from the top.
const TICKS: [f64; 11] = [255.0, 128.0, 64.0, 32.0, 16.0, 8.0, 4.0, 2.0, 1.0, 0.5, 0.0];

/// How far the divider can be missed and is still caught, in pixels.
pub const REACH: i32 = 14;

/// What the user waits for.
const WAITING: &str = "computing ...";

/// What explains a view.
#[derive(Debug)]
pub struct Legend {
    face: Face,
    divider: Option<i32>,
    chips: Vec<(Rect, String)>,
    key: Option<Key>,
}

/// A box that says what colours mean.
#[derive(Debug)]
struct Key {
    rect: Rect,
    heading: Vec<String>,
    scale: bool,
    rows: Vec<(u32, String)>,
}

impl Legend {
    /// What explains the view that `session` shows, in letters of `face`: at the edges of the first of `areas` where it
    /// is off what is `taken`.
    pub fn new(
        session: &Session,
        size: [usize; 2],
        face: Face,
        areas: &[Rect],
        taken: &[Rect],
    ) -> Legend {
        let mode = session.view_mode();
        let known = session.findings().is_some();
        let blinks = session.blinks();
        let column = session.divider_column(size[0]) as i32;
        let divider = (mode.is_wipe() && !(blinks && known)).then_some(column);
        let is_free = |rect: &Rect, area: &Rect| {
            rect.intersection(area) == *rect
                && taken.iter().all(|it| it.intersection(rect).is_empty())
        };
        let height = face.height() + face.height() / 2;
        let width = |text: &str| face.width(text.chars().count()) + 2 * face.advance();
        let gap = face.advance();
        let wanted = |area: &Rect, y: i32| -> Vec<(Rect, String)> {
            let chip = |text: String, x: i32| (Rect::new(x, y, width(&text), height), text);
            if divider.is_some() {
                let [left, right] = sides(session);
                let x = column - gap - width(&left);
                vec![chip(left, x), chip(right, column + gap)]
            } else {
                let words = words(mode, blinks, known).map(str::to_owned);
                let at_right = |words: String| {
                    let x = area.right() - width(&words);
                    chip(words, x)
                };
                words.map(at_right).into_iter().collect()
            }
        };
        // In one row, at the upper edge or, where more of them are free there, at the lower one.
        let chips = areas
            .iter()
            .flat_map(|area| [(area, area.y), (area, area.bottom() - height)])
            .map(|(area, y)| {
                let mut chips = wanted(area, y);
                chips.retain(|(rect, _)| is_free(rect, area));
                chips
            })
            .min_by_key(|chips| Reverse(chips.len()))
            .unwrap_or_default();
        let key = areas
            .iter()
            .find_map(|area| key(session, face, *area).filter(|key| is_free(&key.rect, area)));
        Legend {
            face,
            divider,
            chips,
            key: key.filter(|_| !(blinks && known)),
        }
    }

    /// Where the box that says what colours mean stands.
    pub fn key(&self) -> Option<Rect> {
        self.key.as_ref().map(|key| key.rect)
    }

    /// What is said at an edge, and where.
    pub fn chips(&self) -> &[(Rect, String)] {
        &self.chips
    }

    /// Whether a press at `point` catches the divider.
    pub fn catches(&self, point: Point) -> bool {
        self.divider
            .is_some_and(|column| (point[0] - column).abs() <= REACH)
    }

    /// Draws it over a picture.
    pub fn draw(&self, canvas: &mut Canvas) {
        if let Some(column) = self.divider {
            draw_divider(canvas, column, self.face);
        }
        for (rect, text) in &self.chips {
            draw_pane(canvas, *rect, self.face);
            let at = [
                rect.x + self.face.advance(),
                rect.y + (rect.height - self.face.height()) / 2,
            ];
            canvas.text(self.face, at, TEXT, text);
        }
        if let Some(key) = &self.key {
            key.draw(canvas, self.face);
        }
    }
}

/// What stands at the upper edge where no divider is.
fn words(mode: ViewMode, blinks: bool, known: bool) -> Option<&'static str> {
    match (blinks, known) {
        (true, true) => Some("reference"),
        (_, false) if blinks || mode == ViewMode::ErrorMap => Some(WAITING),
        _ => None,
    }
}

/// What is left and right of the divider.
fn sides(session: &Session) -> [String; 2] {
    if session.view_mode() == ViewMode::GouraudPhong {
        return [ShadingMode::Gouraud, ShadingMode::Phong].map(|mode| mode_label(mode).to_owned());
    }
    let mode = session.shading().map_or("mixed", mode_label);
    let right = if session.findings().is_some() {
        "reference"
    } else {
        WAITING
    };
    [
        format!("{mode}, {}", lines::tolerance(session.tolerance())),
        right.to_owned(),
    ]
}

fn key(session: &Session, face: Face, area: Rect) -> Option<Key> {
    let (heading, scale, rows) = match session.view_mode() {
        ViewMode::ErrorMap => (
            vec![
                "error in levels".to_owned(),
                "against exact Phong".to_owned(),
            ],
            true,
            error_rows(session),
        ),
        ViewMode::Tiles => (vec!["squares drawn".to_owned()], false, tile_rows(session)),
        ViewMode::Picture | ViewMode::GouraudPhong | ViewMode::MethodReference => return None,
    };
    let letters = heading
        .iter()
        .map(|line| line.chars().count())
        .chain(rows.iter().map(|(_, text)| text.chars().count() + 3))
        .max()?;
    let lines = heading.len() + rows.len() + if scale { TICKS.len() + 1 } else { 0 };
    let size = [
        face.width(letters + 2),
        pitch(face) * lines as i32 + face.height(),
    ];
    let rect = Rect::new(
        area.right() - size[0],
        area.bottom() - size[1],
        size[0],
        size[1],
    );
    Some(Key {
        rect,
        heading,
        scale,
        rows,
    })
}

/// What is no error: edges, the background, and pixels that are not proven where there are any.
fn error_rows(session: &Session) -> Vec<(u32, String)> {
    let proof = session.findings().and_then(|it| it.proof.as_ref());
    let [undecided, refuted] = proof.map_or([0; 2], |proof| [proof.undecided, proof.refuted]);
    [
        (EDGE, "other face", true),
        (NOTHING, "nothing drawn", true),
        (UNDECIDED, "undecided", undecided > 0),
        (REFUTED, "refuted", refuted > 0),
    ]
    .into_iter()
    .filter(|(_, _, is_there)| *is_there)
    .map(|(color, text, _)| (color, text.to_owned()))
    .collect()
}

/// Every kind of tile, and how many of them were drawn.
fn tile_rows(session: &Session) -> Vec<(u32, String)> {
    let counts = session.statistics().tiles();
    TileKind::ALL
        .iter()
        .zip(TINTS)
        .zip(counts)
        .map(|((kind, tint), count)| (tint, format!("{:<12}{count:>7}", kind.name())))
        .collect()
}

impl Key {
    fn draw(&self, canvas: &mut Canvas, face: Face) {
        draw_pane(canvas, self.rect, face);
        let x = self.rect.x + face.advance();
        let mut y = self.rect.y + face.height() / 2;
        for line in &self.heading {
            canvas.text(face, [x, y], DIM, line);
            y += pitch(face);
        }
        if self.scale {
            draw_scale(canvas, face, [x, y]);
            y += pitch(face) * (TICKS.len() as i32 + 1);
        }
        let swatch = face.height() * 3 / 4;
        for (color, text) in &self.rows {
            let rect = Rect::new(x, y + (face.height() - swatch) / 2, swatch, swatch);
            canvas.rounded(rect, swatch / 4, Ink::solid(*color));
            canvas.outline(rect, swatch / 4, 1.0, ink::EDGE);
            canvas.text(face, [x + 3 * face.advance(), y], TEXT, text);
            y += pitch(face);
        }
    }
}

/// From one row of a key to the next.
fn pitch(face: Face) -> i32 {
    face.height() + face.height() / 8
}

/// The error map's colours from the top of `at` down, and what errors they stand for.
fn draw_scale(canvas: &mut Canvas, face: Face, at: Point) {
    let [x, y] = [at[0], at[1] + face.height() / 2];
    let length = pitch(face) * TICKS.len() as i32;
    let width = 2 * face.advance();
    for row in 0..length {
        let share = f64::from(length - 1 - row) / f64::from(length - 1);
        let color = error_map::color(error_map::error_at(share));
        canvas.fill(Rect::new(x, y + row, width, 1), Ink::solid(color));
    }
    for tick in TICKS {
        let row = ((1.0 - error_map::position(tick)) * f64::from(length - 1)).round() as i32;
        let mark = Rect::new(x + width, y + row, face.advance() / 2, 1);
        canvas.fill(mark, TEXT);
        let at = [x + width + face.advance(), y + row - face.height() / 2];
        canvas.text(face, at, TEXT, &tick.to_string());
    }
}

fn draw_pane(canvas: &mut Canvas, rect: Rect, face: Face) {
    canvas.rounded(rect, face.advance(), PANE);
    canvas.outline(rect, face.advance(), 1.0, ink::EDGE);
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
