//! The pixels of a tiny triangle's box, row by row, each looked at until the row's run of covered ones ends.
//!
//! What costs is an addition a value and pixel, and nothing is set up for an edge but its value ([`Tiny`]). So a step is
//! short: two of the edge functions, 16 bits each, are in the halves of a word, and the third shares one with the
//! number of pixels that are left in the row. A half that is negative borrows from the one above, which is then off by
//! one; but as a negative half is outside or beyond the row's end already, nothing is decided by that.
//!
//! [`Tiny`]: crate::setup::Tiny

use crate::math::{index, signed, unsigned};
use crate::setup::{EdgeSteps, PlaneSteps};
use core::hint::black_box;

/// What is stepped from pixel to pixel, modulo 2^32.
#[derive(Clone, Copy, Debug)]
struct State {
    /// The first edge function, and the second in the lower half.
    pair: u32,
    /// The third, and the pixels to the right of this one in the lower half: -1 beyond the row's end.
    third: u32,
    /// The plane.
    value: u32,
}

/// The top bits of two halves.
const SIGNS: u32 = 0x8000_8000;

impl State {
    #[inline(always)]
    fn new([first, second, third]: [i32; 3], left: i32, value: u32) -> Self {
        let halves = |high: i32, low: i32| (unsigned(high) << 16).wrapping_add(unsigned(low));
        Self { pair: halves(first, second), third: halves(third, left), value }
    }

    /// This with a step, a number of times.
    #[inline(always)]
    fn plus(self, step: Self, times: i32) -> Self {
        let plus = |v: u32, step: u32| v.wrapping_add(step.wrapping_mul(unsigned(times)));
        Self {
            pair: plus(self.pair, step.pair),
            third: plus(self.third, step.third),
            value: plus(self.value, step.value),
        }
    }

    #[inline(always)]
    fn left(self) -> i32 {
        signed(self.third << 16) >> 16
    }
}

/// A pixel of a tiny triangle's box, and the way on from there.
#[derive(Clone, Copy, Debug)]
pub struct Scan {
    state: State,
    across: State,
    /// From a row's last pixel to the next one's first.
    turn: State,
    /// The pixel's index in the target, and that of the first one below the box.
    at: usize,
    end: usize,
    /// From the index of a row's last pixel to that of the next one's first.
    gap: usize,
    row: i32,
    last_column: i32,
}

impl Scan {
    /// From the first pixel of a box of columns and rows, which is pixel `at` of a target of that width.
    #[inline(always)]
    pub(crate) fn new(
        edges: EdgeSteps,
        plane: PlaneSteps,
        [columns, rows]: [i32; 2],
        at: usize,
        width: usize,
    ) -> Self {
        let last_column = columns - 1;
        let across = State::new(edges.across, -1, plane.across);
        let down = State::new(edges.down, 0, plane.down);
        Self {
            state: State::new(edges.at, last_column, plane.at),
            across,
            turn: down.plus(across, -last_column),
            at,
            end: at.wrapping_add(index(rows).wrapping_mul(width)),
            gap: width.wrapping_sub(index(last_column)),
            row: 0,
            last_column,
        }
    }

    /// The pixel's index in the target. The mask changes none: without it the compiler works out before each run which index
    /// would leave a slice.
    #[inline(always)]
    pub(crate) const fn at(&self) -> usize {
        self.at & (usize::MAX >> 1)
    }

    /// Its column in the box, and its row.
    #[inline(always)]
    pub(crate) fn place(&self) -> (i32, i32) {
        (self.last_column - self.state.left(), self.row)
    }

    /// The plane's value.
    #[inline(always)]
    pub(crate) const fn value(&self) -> u32 {
        self.state.value
    }

    /// Whether the pixel is covered.
    #[inline(always)]
    pub(crate) const fn is_covered(&self) -> bool {
        (self.state.pair | self.state.third) & SIGNS == 0
    }

    /// To the next pixel of the row, or beyond its end, which is not covered.
    #[inline(always)]
    pub(crate) fn step(&mut self) {
        self.state = self.state.plus(self.across, 1);
        self.at = self.at.wrapping_add(1);
    }

    /// To the row's first covered pixel, if there is one. Pixels right of its run are not looked at.
    #[inline(always)]
    pub(crate) fn enter(&mut self) -> bool {
        while !self.is_covered() {
            self.step();
            // By the bit, not by an index: the compiler would work out all values at the end beforehand.
            if self.state.third & 0x8000 != 0 {
                return false;
            }
            black_box(());
        }
        true
    }

    /// To the next row's first pixel, if there is one.
    #[inline(always)]
    pub(crate) fn turn(&mut self) -> bool {
        let left = self.state.left();
        self.state = self.state.plus(self.turn, 1).plus(self.across, left);
        self.at = self.at.wrapping_add_signed(left as isize).wrapping_add(self.gap);
        self.row += 1;
        self.at < self.end
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::{Tiny, tiny_triangles};
    use crate::traversal::rows::covered;
    use std::vec::Vec;

    /// A plane that tells the column and the row.
    const PLACES: PlaneSteps = PlaneSteps { at: 1 << 16, across: 1, down: 1 << 8 };

    #[test]
    fn covered_pixels_are_those_of_edge_functions() {
        const WIDTH: usize = 816;
        let mut seen = 0;
        tiny_triangles(11, |p, bounds, bits| {
            let size = [bounds.x1 - bounds.x0, bounds.y1 - bounds.y0];
            let edges = Tiny::new(&p, bounds, bits).unwrap().edges();
            let mut scan = Scan::new(edges, PLACES, size, 5000, WIDTH);
            for y in bounds.y0..bounds.y1 {
                let row = y - bounds.y0;
                let mut columns = Vec::new();
                if scan.enter() {
                    while scan.is_covered() {
                        let (column, of) = scan.place();
                        assert_eq!(of, row);
                        assert_eq!(scan.at(), 5000 + row as usize * WIDTH + column as usize);
                        assert_eq!(scan.value(), 1 << 16 | (row << 8 | column) as u32);
                        columns.push(bounds.x0 + column);
                        scan.step();
                    }
                }
                let sign = crate::setup::doubled_area(&p).signum();
                assert_eq!(columns, covered(&p, sign, y, bits, bounds.x0 - 1..bounds.x1 + 1));
                seen += columns.len();
                assert_eq!(scan.turn(), y + 1 < bounds.y1, "{p:?}, row {y} of {bounds:?}");
            }
        });
        assert!(seen > 50_000, "{seen} pixels were covered");
    }
}
