//! Shapes and letters in, pixels out: drawing on a 0x00RRGGBB buffer, antialiased, clipped, and nothing else.
//!
//! Rule: no pixel outside of the clip rectangle is touched, and the clip rectangle never leaves the buffer.

mod letters;

pub use letters::{FACES, Face, fit, wrapped};

/// A place in a picture, in pixels right and down from its top left corner; may lie outside of it.
pub type Point = [i32; 2];

/// A rectangle of whole pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rect {
    /// The left edge.
    pub x: i32,
    /// The upper edge.
    pub y: i32,
    /// Pixels across.
    pub width: i32,
    /// Pixels down.
    pub height: i32,
}

impl Rect {
    /// The rectangle with its upper left corner there.
    pub fn new(x: i32, y: i32, width: i32, height: i32) -> Self {
        Rect {
            x,
            y,
            width,
            height,
        }
    }

    /// Its width and height, in pixels; not of an empty one.
    pub fn size(&self) -> [usize; 2] {
        [self.width as usize, self.height as usize]
    }

    /// The first column to the right of it.
    pub fn right(&self) -> i32 {
        self.x + self.width
    }

    /// The first row below it.
    pub fn bottom(&self) -> i32 {
        self.y + self.height
    }

    /// Whether the pixel at `point` belongs to it.
    pub fn contains(&self, [x, y]: Point) -> bool {
        (self.x..self.right()).contains(&x) && (self.y..self.bottom()).contains(&y)
    }

    /// Whether it has no pixels.
    pub fn is_empty(&self) -> bool {
        self.width <= 0 || self.height <= 0
    }

    /// What is left when every side moves inwards by `by` pixels; may be empty.
    #[must_use]
    pub fn inset(&self, by: i32) -> Rect {
        let [width, height] = [self.width, self.height].map(|side| side - 2 * by);
        Rect::new(self.x + by, self.y + by, width, height)
    }

    /// What both have in common; empty where they have nothing.
    #[must_use]
    pub fn intersection(&self, other: &Rect) -> Rect {
        let (x, y) = (self.x.max(other.x), self.y.max(other.y));
        let right = self.right().min(other.right());
        let bottom = self.bottom().min(other.bottom());
        Rect::new(x, y, (right - x).max(0), (bottom - y).max(0))
    }
}

/// A colour, and how much of it covers what is below: 0 nothing, 255 all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ink {
    /// 0x00RRGGBB.
    pub color: u32,
    /// 0..=255.
    pub alpha: u8,
}

impl Ink {
    /// A colour that covers what is below.
    pub const fn solid(color: u32) -> Self {
        Ink { color, alpha: 255 }
    }

    /// A colour through which what is below is seen.
    pub const fn glass(color: u32, alpha: u8) -> Self {
        Ink { color, alpha }
    }
}

/// A buffer being drawn on.
pub struct Canvas<'a> {
    pixels: &'a mut [u32],
    width: i32,
    clip: Rect,
}

impl<'a> Canvas<'a> {
    /// `pixels` are rows of `size[0]` from the top; rows that `size[1]` counts but the buffer lacks are clipped away.
    pub fn new(pixels: &'a mut [u32], size: [usize; 2]) -> Self {
        let width = size[0] as i32;
        let rows = pixels.len().checked_div(size[0]).unwrap_or(0).min(size[1]);
        Canvas {
            pixels,
            width,
            clip: Rect::new(0, 0, width, rows as i32),
        }
    }

    /// The same buffer, drawn on only within `clip`.
    pub fn clipped(&mut self, clip: Rect) -> Canvas<'_> {
        Canvas {
            pixels: self.pixels,
            width: self.width,
            clip: self.clip.intersection(&clip),
        }
    }

    /// Where it is drawn on.
    pub fn clip(&self) -> Rect {
        self.clip
    }

    /// A plain rectangle.
    pub fn fill(&mut self, rect: Rect, ink: Ink) {
        let rect = rect.intersection(&self.clip);
        if rect.is_empty() {
            return;
        }
        let alpha = weight(ink.alpha);
        for y in rect.y..rect.bottom() {
            let start = (y * self.width + rect.x) as usize;
            for pixel in &mut self.pixels[start..start + rect.width as usize] {
                *pixel = mix(*pixel, ink.color, alpha);
            }
        }
    }

    /// A rectangle with round corners; a disc where `radius` is half its size.
    pub fn rounded(&mut self, rect: Rect, radius: i32, ink: Ink) {
        let border = radius + 1;
        self.fill(rect.inset(border), ink);
        self.edge(rect, radius, border, ink, |distance| 0.5 - distance);
    }

    /// The line along the inside of such a rectangle's edge, `stroke` pixels wide.
    pub fn outline(&mut self, rect: Rect, radius: i32, stroke: f32, ink: Ink) {
        let border = radius.max(stroke as i32) + 1;
        let coverage = |distance: f32| (0.5 - distance).min(distance + stroke + 0.5);
        self.edge(rect, radius, border, ink, coverage);
    }

    /// A line with round ends between two points, `width` pixels wide.
    pub fn line(&mut self, from: [f32; 2], to: [f32; 2], width: f32, ink: Ink) {
        let reach = width / 2.0 + 1.0;
        let ends = |axis: usize| {
            let (low, high) = (from[axis].min(to[axis]), from[axis].max(to[axis]));
            [(low - reach) as i32, (high + reach) as i32 + 1]
        };
        let ([left, right], [top, bottom]) = (ends(0), ends(1));
        let seen = Rect::new(left, top, right - left, bottom - top).intersection(&self.clip);
        let way = [to[0] - from[0], to[1] - from[1]];
        let squared = (way[0] * way[0] + way[1] * way[1]).max(f32::MIN_POSITIVE);
        for y in seen.y..seen.bottom() {
            for x in seen.x..seen.right() {
                let at = [x as f32 + 0.5 - from[0], y as f32 + 0.5 - from[1]];
                let share = ((at[0] * way[0] + at[1] * way[1]) / squared).clamp(0.0, 1.0);
                let distance = (at[0] - share * way[0]).hypot(at[1] - share * way[1]);
                self.blend(x, y, ink, width / 2.0 + 0.5 - distance);
            }
        }
    }

    /// Every pixel of `rect` less than `border` from its edge, as `coverage` says of the signed distance, in pixels, of
    /// its centre from the rounded edge.
    fn edge(
        &mut self,
        rect: Rect,
        radius: i32,
        border: i32,
        ink: Ink,
        coverage: impl Fn(f32) -> f32,
    ) {
        let radius = radius.min(rect.width / 2).min(rect.height / 2) as f32;
        let half = [rect.width as f32 / 2.0, rect.height as f32 / 2.0];
        let inside = rect.inset(border);
        let seen = rect.intersection(&self.clip);
        for y in seen.y..seen.bottom() {
            let dy = ((y - rect.y) as f32 + 0.5 - half[1]).abs() - half[1] + radius;
            let mut x = seen.x;
            while x < seen.right() {
                if inside.contains([x, y]) {
                    x = inside.right();
                    continue;
                }
                let dx = ((x - rect.x) as f32 + 0.5 - half[0]).abs() - half[0] + radius;
                let distance = dx.max(0.0).hypot(dy.max(0.0)) + dx.max(dy).min(0.0) - radius;
                self.blend(x, y, ink, coverage(distance));
                x += 1;
            }
        }
    }

    fn blend(&mut self, x: i32, y: i32, ink: Ink, coverage: f32) {
        if coverage > 0.0 && self.clip.contains([x, y]) {
            let alpha = (coverage.min(1.0) * f32::from(ink.alpha)).round() as u8;
            let pixel = &mut self.pixels[(y * self.width + x) as usize];
            *pixel = mix(*pixel, ink.color, weight(alpha));
        }
    }
}

/// 0..=255 as 0..=256, so that the division that follows is a shift.
fn weight(alpha: u8) -> u32 {
    u32::from(alpha) + u32::from(alpha >> 7)
}

/// `below` covered by `weight` / 256 of `above`: red and blue in one multiplication, green in another.
pub fn mix(below: u32, above: u32, weight: u32) -> u32 {
    let part = |mask: u32, shift: u32| {
        let (below, above) = (below >> shift & mask, above >> shift & mask);
        ((below * (256 - weight) + above * weight) >> 8 & mask) << shift
    };
    part(0x00ff_00ff, 0) | part(0xff, 8)
}
