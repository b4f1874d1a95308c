//! The pixels of a line between projected vertices inside a window, one a step along its major axis, in 32 bits.
//!
//! What a window leaves is found on the exact line, as [`LineRuns`](super::LineRuns) does; see there.

use crate::math::{index, signed, steps_to_zero};
use crate::setup::ProjectedLine;
use crate::vertex::Rect;

/// A pixel of a line, and the way on from there.
#[derive(Clone, Copy, Debug)]
pub struct LineWalk {
    /// What is left above the row, less `span`: negative.
    rest: i32,
    span: i32,
    climb: i32,
    /// Steps that follow.
    left: i32,
    /// The pixel's index in the target, what a step adds to it, and what a row adds.
    at: usize,
    along: isize,
    aside: isize,
    /// Its column and row in the target, and the same for them.
    place: [i32; 2],
    along_place: [i32; 2],
    aside_place: [i32; 2],
}

/// Where a line is in a window: the first step and row, what is left above that, and the steps to draw.
struct Part {
    from: i32,
    row: i32,
    rest: i32,
    steps: i32,
}

impl LineWalk {
    /// The part inside of a window of a target of that width, where the viewport's `(0, 0)` is `origin`, and the step it begins at;
    /// `None` where there is none.
    #[inline(always)]
    pub(crate) fn new(
        line: &ProjectedLine,
        window: Rect,
        (left, top): (i32, i32),
        width: u32,
    ) -> Option<(Self, i32)> {
        let ProjectedLine { steep, falls, span, climb, from, to, row, rest, .. } = *line;
        let (columns, rows) = ([window.x0, window.x1], [window.y0, window.y1]);
        let ([u0, u1], [v0, v1]) = if steep { (rows, columns) } else { (columns, rows) };
        // As the line counts them.
        let [v0, v1] = if falls { [-v1, -v0] } else { [v0, v1] };
        let [least, most] = line.rows;
        if from >= u1 || to <= u0 || least >= v1 || most < v0 {
            return None;
        }
        let part = if from >= u0 && to <= u1 && least >= v0 && most < v1 {
            Part { from, row, rest, steps: to - from }
        } else {
            part(line, [u0, u1], [v0, v1])?
        };
        let side = if falls { -1i32 } else { 1 };
        let v = if falls { !part.row } else { part.row };
        let (x, y) = if steep { (v, part.from) } else { (part.from, v) };
        let place @ [x, y] = [x + left, y + top];
        let width = signed(width);
        let walk = Self {
            rest: part.rest - span,
            span,
            climb,
            left: part.steps - 1,
            at: index(y.wrapping_mul(width).wrapping_add(x)),
            along: if steep { width as isize } else { 1 },
            aside: if steep { side as isize } else { side.wrapping_mul(width) as isize },
            place,
            along_place: if steep { [0, 1] } else { [1, 0] },
            aside_place: if steep { [side, 0] } else { [0, side] },
        };
        Some((walk, part.from))
    }

    /// The pixel's index in the target. The mask changes none, as in [`Scan::at`](crate::traversal::Scan::at).
    #[inline(always)]
    pub(crate) const fn at(&self) -> usize {
        self.at & (usize::MAX >> 1)
    }

    /// Its column and row in the target.
    #[inline(always)]
    pub(crate) const fn place(&self) -> (i32, i32) {
        let [x, y] = self.place;
        (x, y)
    }

    /// To the next pixel, if there is one.
    #[inline(always)]
    pub(crate) fn step(&mut self) -> bool {
        let plus = |[x, y]: [i32; 2], [dx, dy]: [i32; 2]| [x + dx, y + dy];
        self.at = self.at.wrapping_add_signed(self.along);
        self.place = plus(self.place, self.along_place);
        self.rest += self.climb;
        if self.rest >= 0 {
            self.rest -= self.span;
            self.at = self.at.wrapping_add_signed(self.aside);
            self.place = plus(self.place, self.aside_place);
        }
        self.left -= 1;
        self.left >= 0
    }

    /// To the first pixel that is not in this one's row, if there is one, and before which column those end that are.
    #[inline]
    pub(crate) fn run(&mut self) -> (i32, bool) {
        let [first, row] = self.place;
        let mut end = first;
        loop {
            end += 1;
            let more = self.step();
            let [_, y] = self.place;
            if !more || y != row {
                return (end, more);
            }
        }
    }
}

/// The part of a line that a window has, of steps and of rows as the line counts them. See the bounds of [`ProjectedLine`].
#[inline(never)]
fn part(line: &ProjectedLine, [u0, u1]: [i32; 2], [v0, v1]: [i32; 2]) -> Option<Part> {
    let ProjectedLine { span, climb, .. } = *line;
    let (from, to) = (line.from.max(u0), line.to.min(u1));
    // Above the window's first row, and above the one after its last.
    let above = |v: i32| line.rest + (from - line.from) * climb + (line.row - v) * span;
    let (first, end) = (above(v0), above(v1));
    let enter = steps_to_zero(first, climb, to - from);
    let leave = steps_to_zero(end, climb, to - from);
    if enter >= leave {
        return None;
    }
    let rest = first + climb * enter;
    // As in `LineRuns`.
    let rows = steps_to_zero(!rest, span, v1 - v0) - 1;
    let (from, row, rest) = (from + enter, v0 + rows, rest - span * rows);
    Some(Part { from, row, rest, steps: leave - enter })
}
