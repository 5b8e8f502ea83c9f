//! Lines of text -> a box of rows on the screen: where each stands, and what a click on it does.
//!
//! ```text
//!   +-----------------------------+
//!   | shadetrade           cuboid |   head: the title
//!   | LIGHTS                      |   body: headings and commands (keys, mark, label, state), in columns or scrolled
//!   | [1][W]  #  white         on |
//!   | frame               1.20 ms |   foot: the facts at the end
//!   +-----------------------------+
//! ```
//! Rule: a board never leaves the area it was laid out for; what does not fit is cut or scrolled away where its style
//! allows that, and makes the layout fail where it does not.

use super::lines::Line;
use super::style::{Columns, Style};
use crate::canvas::{Point, Rect};
use crate::window::bindings::Action;

/// Which rows of the body are seen of those there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scroll {
    /// The first one seen.
    pub first: usize,
    /// How many are seen.
    pub seen: usize,
    /// How many there are.
    pub total: usize,
}

/// Where in its area a board stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In the upper left corner.
    Corner,
    /// In the upper right corner.
    Side,
    /// In the middle.
    Middle,
}

/// A box of rows.
#[derive(Debug)]
pub struct Board {
    pub(super) rect: Rect,
    pub(super) style: Style,
    pub(super) columns: Columns,
    pub(super) rows: Vec<(Line, Rect)>,
    /// Which rows are seen, where not all are.
    pub(super) scroll: Option<Scroll>,
}

impl Board {
    /// Sets `lines` within `area`, from row `first` on where not all are seen; `None` where they do not fit.
    pub fn lay_out(
        lines: Vec<Line>,
        style: Style,
        area: Rect,
        place: Place,
        first: usize,
    ) -> Option<Board> {
        let [across, down] = style.padding();
        let columns = Columns::of(&lines, &style, area.width - 2 * across)?;
        let Parts {
            head,
            stacks,
            foot,
            scroll,
        } = Parts::of(lines, &style, area.height - 2 * down, first)?;
        let (head_height, body_height) = (style.height(&head), tallest(&stacks, &style));
        let width = columns.all() + 2 * across;
        let height = head_height + body_height + style.height(&foot) + 2 * down;
        let (x, y) = match place {
            Place::Corner => (area.x, area.y),
            Place::Side => (area.right() - width, area.y),
            Place::Middle => (
                area.x + (area.width - width) / 2,
                area.y + (area.height - height) / 2,
            ),
        };
        let (left, top) = (x + across, y + down);
        let mut rows = Vec::new();
        let mut set = |lines: Vec<Line>, x: i32, mut y: i32, width: i32| {
            for line in lines {
                let row = Rect::new(x, y, width, style.line_height(&line));
                y = row.bottom();
                rows.push((line, row));
            }
        };
        set(head, left, top, columns.all());
        for (stack, index) in stacks.into_iter().zip(0..) {
            set(
                stack,
                left + columns.stride() * index,
                top + head_height,
                columns.one(),
            );
        }
        set(foot, left, top + head_height + body_height, columns.all());
        Some(Board {
            rect: Rect::new(x, y, width, height),
            style,
            columns,
            rows,
            scroll,
        })
    }

    /// Where it stands.
    pub fn rect(&self) -> Rect {
        self.rect
    }

    /// Which rows are seen, where not all are.
    pub fn scroll(&self) -> Option<Scroll> {
        self.scroll
    }

    /// The lines seen, and where each stands.
    pub fn rows(&self) -> &[(Line, Rect)] {
        &self.rows
    }

    /// The command at `point`.
    pub fn action_at(&self, point: Point) -> Option<Action> {
        self.rows.iter().find_map(|(line, row)| match line {
            Line::Command(command) if row.contains(point) => Some(command.action),
            _ => None,
        })
    }
}

/// The lines of a board, each where it belongs.
struct Parts {
    head: Vec<Line>,
    stacks: Vec<Vec<Line>>,
    foot: Vec<Line>,
    scroll: Option<Scroll>,
}

impl Parts {
    /// `lines` in a height of `room` pixels; `None` where they do not fit.
    fn of(lines: Vec<Line>, style: &Style, room: i32, first: usize) -> Option<Parts> {
        let mut head = lines;
        let mut body = head.split_off(usize::from(matches!(head.first(), Some(Line::Title(..)))));
        let is_foot = |line: &Line| matches!(line, Line::Fact(..) | Line::Alarm(..) | Line::Rule);
        let mut foot = body.split_off(
            body.iter()
                .rposition(|line| !is_foot(line))
                .map_or(0, |last| last + 1),
        );
        let rows_in = |head: &[Line], foot: &[Line]| {
            usize::try_from((room - style.height(head) - style.height(foot)) / style.pitch())
                .unwrap_or(0)
        };
        let stacks = stacked(&body, style.columns);
        if style.height(&head) + tallest(&stacks, style) + style.height(&foot) <= room {
            return Some(Parts {
                head,
                stacks,
                foot,
                scroll: None,
            });
        }
        if !style.scrolls() || style.columns > 1 {
            return None;
        }
        if rows_in(&head, &foot) < foot.len() {
            body.append(&mut foot);
        }
        let (total, seen) = (body.len(), rows_in(&head, &foot).min(body.len()));
        let first = first.min(total - seen);
        body.truncate(first + seen);
        body.drain(..first);
        let scroll = Some(Scroll { first, seen, total });
        (seen > 0).then_some(Parts {
            head,
            stacks: vec![body],
            foot,
            scroll,
        })
    }
}

fn tallest(stacks: &[Vec<Line>], style: &Style) -> i32 {
    stacks
        .iter()
        .map(|stack| style.height(stack))
        .max()
        .unwrap_or(0)
}

/// `lines` in at most so many stacks of about the same number; a heading stays with what follows it.
fn stacked(lines: &[Line], stacks: usize) -> Vec<Vec<Line>> {
    let sections: Vec<&[Line]> = lines
        .chunk_by(|_, next| !matches!(next, Line::Heading(_)))
        .collect();
    let fill = |limit: usize| {
        let mut filled: Vec<Vec<Line>> = vec![Vec::new()];
        for section in &sections {
            match filled.last_mut() {
                Some(stack) if stack.is_empty() || stack.len() + section.len() <= limit => {
                    stack.extend_from_slice(section);
                }
                _ => filled.push(section.to_vec()),
            }
        }
        filled
    };
    let total = lines.len();
    (total / stacks.max(1)..total)
        .map(fill)
        .find(|filled| filled.len() <= stacks)
        .unwrap_or_else(|| vec![lines.to_vec()])
}
