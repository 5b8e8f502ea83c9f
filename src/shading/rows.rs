//! Rows of a square, from what evaluates them to what stores them.
//!
//! Rule: a sink takes covered rows only; who knows that a square is covered all over may take its rows from their source.

use std::ops::Range;

use super::display::Row;
use super::{Coverage, TILE};

/// Takes the shaded rows of a tile or block and stores the lanes that are covered.
pub trait Sink<const SIDE: usize = TILE> {
    /// Takes row `row` (0..`SIDE`).
    fn take(&mut self, row: usize, levels: &impl Row);

    /// Takes the covered rows of a source.
    #[inline(always)]
    fn draw(&mut self, source: &impl Source<SIDE>, coverage: &Coverage<SIDE>)
    where
        Self: Sized,
    {
        source.send(coverage, self);
    }
}

/// Takes the rows of a square. A trait, not a closure, because only a function can be told to become part of the loop
/// it is called from, whose SIMD level it then has.
pub trait Rows {
    /// Takes a row.
    fn take(&mut self, row: usize, levels: &impl Row);
}

/// What the rows of a square come from.
pub trait Source<const SIDE: usize> {
    /// Evaluates `rows` of the square and hands them on one by one.
    fn for_rows(&self, rows: Range<usize>, target: &mut impl Rows);

    /// Hands the covered rows to a sink.
    #[inline(always)]
    fn send(&self, coverage: &Coverage<SIDE>, sink: &mut impl Sink<SIDE>) {
        let rows = usize::from(coverage.rows[0])..usize::from(coverage.rows[1]) + 1;
        self.for_rows(rows, &mut Covered { coverage, sink });
    }
}

/// Hands the covered rows of a square to its sink.
struct Covered<'a, S, const SIDE: usize> {
    coverage: &'a Coverage<SIDE>,
    sink: &'a mut S,
}

impl<S: Sink<SIDE>, const SIDE: usize> Rows for Covered<'_, S, SIDE> {
    #[inline(always)]
    fn take(&mut self, row: usize, levels: &impl Row) {
        let (from, to) = self.coverage.spans[row];
        if from < to {
            self.sink.take(row, levels);
        }
    }
}
