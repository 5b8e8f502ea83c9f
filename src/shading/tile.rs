//! Squares of pixels: tiles and blocks of them, what is covered of one, and how one was drawn.
//!
//! Rule: a block is two by two tiles, and what is covered of it is what is covered of them.

/// The side of a tile, in pixels.
pub const TILE: usize = 16;

/// The side of a block of tiles, in pixels: what a polynomial is first tried on.
pub const BLOCK: usize = 2 * TILE;

/// The levels of one row of a tile, by channel and lane.
pub type TileRow = [[f32; TILE]; 3];

/// What is covered of a square, a tile or a block: for each of its rows the lanes from..to, in 0..=`SIDE`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coverage<const SIDE: usize = TILE> {
    /// Empty where from >= to.
    pub spans: [(u8, u8); SIDE],
    /// How many lanes in all.
    pub pixels: u32,
    /// The first and the last lane covered anywhere.
    pub lanes: [u8; 2],
    /// The first and the last row covered anywhere.
    pub rows: [u8; 2],
}

impl<const SIDE: usize> Coverage<SIDE> {
    /// All of a square.
    pub const WHOLE: Self = Coverage {
        spans: [(0, SIDE as u8); SIDE],
        pixels: (SIDE * SIDE) as u32,
        lanes: [0, SIDE as u8 - 1],
        rows: [0, SIDE as u8 - 1],
    };

    /// Nothing of a square.
    pub const NONE: Self = Coverage {
        spans: [(0, 0); SIDE],
        pixels: 0,
        lanes: [SIDE as u8, 0],
        rows: [SIDE as u8, 0],
    };

    /// The lanes from..to of each row.
    #[inline(always)]
    pub fn new(spans: [(u8, u8); SIDE]) -> Self {
        let mut pixels = 0;
        let (mut lanes, mut rows) = ([SIDE as u8, 0], [SIDE as u8, 0]);
        for row in 0..SIDE {
            let (from, to) = spans[row];
            let covered = from < to;
            pixels += u32::from(to.saturating_sub(from));
            lanes[0] = lanes[0].min(if covered { from } else { SIDE as u8 });
            lanes[1] = lanes[1].max(if covered { to - 1 } else { 0 });
            rows[0] = rows[0].min(if covered { row as u8 } else { SIDE as u8 });
            rows[1] = rows[1].max(if covered { row as u8 } else { 0 });
        }
        Coverage {
            spans,
            pixels,
            lanes,
            rows,
        }
    }
}

impl Coverage<BLOCK> {
    /// What is covered of one of the four tiles, which is `right` and `down` of the first.
    #[inline(always)]
    pub fn tile(&self, right: usize, down: usize) -> Coverage {
        if self.pixels == Self::WHOLE.pixels {
            return Coverage::WHOLE;
        }
        let lane = |lane: u8| lane.saturating_sub((right * TILE) as u8).min(TILE as u8);
        let mut spans = [(0, 0); TILE];
        for row in 0..TILE {
            let (from, to) = self.spans[down * TILE + row];
            spans[row] = (lane(from), lane(to));
        }
        Coverage::new(spans)
    }

    /// How many of the tiles have anything covered.
    #[inline(always)]
    pub fn tiles(&self) -> u64 {
        const MIDDLE: u8 = TILE as u8;
        let mut tiles = 0;
        for half in self.spans.as_chunks::<TILE>().0 {
            let [mut left, mut right] = [0_u8; 2];
            for &(from, to) in half {
                left |= u8::from(from < to.min(MIDDLE));
                right |= u8::from(from.max(MIDDLE) < to);
            }
            tiles += u64::from(left + right);
        }
        tiles
    }
}

/// How a tile was drawn, from cheap to dear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TileKind {
    /// One colour, certified.
    Constant,
    /// A colour linear in x and y, certified.
    Linear,
    /// A quadratic colour, certified.
    Quadratic,
    /// A certified polynomial, and terms of n.l that are cut off at 0 pixel by pixel.
    Terminator,
    /// A certified polynomial, and specular terms pixel by pixel; terminators too where there are any.
    Highlight,
    /// The definition at every pixel, in f32.
    Exact,
    /// The definition at every pixel, in f64.
    Double,
}

impl TileKind {
    /// All of them, in order.
    pub const ALL: [TileKind; 7] = [
        TileKind::Constant,
        TileKind::Linear,
        TileKind::Quadratic,
        TileKind::Terminator,
        TileKind::Highlight,
        TileKind::Exact,
        TileKind::Double,
    ];

    /// The word panels and reports use.
    pub const fn name(self) -> &'static str {
        match self {
            TileKind::Constant => "constant",
            TileKind::Linear => "linear",
            TileKind::Quadratic => "quadratic",
            TileKind::Terminator => "terminator",
            TileKind::Highlight => "highlight",
            TileKind::Exact => "exact",
            TileKind::Double => "exact in f64",
        }
    }
}
