//! The pixels of a line inside a window: one a step along its major axis, by additions.
//!
//! What a window, a scissor or a band leaves of a line is found on the exact line, and the value that decides where the next
//! pixel is (`Q.v`, modulo `span`) is the same wherever the walk begins: the part is drawn as it is in the whole.

mod walk;

pub(crate) use walk::LineWalk;

use crate::math::steps_to_zero;
use crate::setup::Segment;
use crate::span::Span;
use crate::vertex::Rect;

/// The runs of a line's pixels that share a row, along its major axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineRuns {
    u: i32,
    to: i32,
    v: i32,
    /// `Q.v - v span`: 0 to `span - 1`.
    rest: i64,
    span: i64,
    climb: i64,
    steep: bool,
}

impl LineRuns {
    /// The part of a segment that a window holds, which is in the viewport; `None` where it holds none.
    #[inline(never)]
    pub(crate) fn new(segment: &Segment, window: Rect) -> Option<Self> {
        let Segment { span, climb, steep, .. } = *segment;
        let [[u0, u1], [v0, v1]] = segment.axes(window);
        let (from, to) = (segment.from.max(u0), segment.to.min(u1));
        if from >= to || v0 >= v1 {
            return None;
        }
        let (first, end) = (segment.below(from, v0), segment.below(from, v1));
        let length = to - from;
        // The line is in the window from where it is not above the first row to before it is not above the one after.
        let [enter, leave] = if climb >= 0 {
            [steps_to_zero(first, climb, length), steps_to_zero(end, climb, length)]
        } else {
            // `!v` is `-v - 1`: 0 or more where `v` is negative.
            [steps_to_zero(!end, -climb, length), steps_to_zero(!first, -climb, length)]
        };
        if enter >= leave {
            return None;
        }
        let rest = first + climb * i64::from(enter);
        // The last `v` with `v span` not above it: one before the first that is.
        let rows = steps_to_zero(!rest, span, v1 - v0) - 1;
        let rest = rest - span * i64::from(rows);
        Some(Self { u: from + enter, to: from + leave, v: v0 + rows, rest, span, climb, steep })
    }

    /// To the next pixel.
    #[inline]
    fn step(&mut self) {
        self.u += 1;
        self.rest += self.climb;
        if self.rest >= self.span {
            self.rest -= self.span;
            self.v += 1;
        } else if self.rest < 0 {
            self.rest += self.span;
            self.v -= 1;
        }
    }
}

impl Iterator for LineRuns {
    type Item = Span;

    #[inline]
    fn next(&mut self) -> Option<Span> {
        if self.u >= self.to {
            return None;
        }
        let (u, v) = (self.u, self.v);
        self.step();
        if self.steep {
            return Some(Span { y: u, x0: v, x1: v + 1 });
        }
        while self.v == v && self.u < self.to {
            self.step();
        }
        Some(Span { y: v, x0: u, x1: self.u })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vertex::Viewport;
    use std::vec::Vec;

    /// All lines between points of a small grid of half pixels, in all windows of two sizes: the pixels by division.
    #[test]
    fn pixels_are_the_nearest_of_each_step() {
        let viewport = Viewport::new(6, 5).unwrap();
        let points = || (-3..14).flat_map(|x| (-3..12).step_by(2).map(move |y| [x, y, 2]));
        for (a, b) in points().flat_map(|a| points().map(move |b| (a, b))) {
            let Some(segment) = Segment::new(a, b, &viewport) else {
                assert_eq!(a, b);
                continue;
            };
            let steep = (b[1] - a[1]).abs() > (b[0] - a[0]).abs();
            let swap = |[x, y, _]: [i32; 3]| if steep { [y, x] } else { [x, y] };
            let ([u0, v0], [u1, v1]) = (swap(a), swap(b));
            let steps = u0.min(u1).div_euclid(2)..=u0.max(u1).div_euclid(2);
            let pixel = |u: i32| {
                let run = u1 - u0;
                let exact = v0 * run + (v1 - v0) * (2 * u + 1 - u0);
                // Floored, whatever the sign of the run.
                let v = (exact * run.signum()).div_euclid(2 * run.abs());
                if steep { (v, u) } else { (u, v) }
            };
            let all: Vec<_> = steps.map(pixel).collect();
            for window in [[0, 0, 6, 5], [1, 2, 5, 3], [3, 0, 4, 5], [2, 2, 2, 4]] {
                let [x0, y0, x1, y1] = window;
                let inside = |&&(x, y): &&(i32, i32)| x >= x0 && x < x1 && y >= y0 && y < y1;
                let runs = LineRuns::new(&segment, Rect { x0, y0, x1, y1 }).into_iter().flatten();
                let drawn: Vec<_> =
                    runs.flat_map(|run| (run.x0..run.x1).map(move |x| (x, run.y))).collect();
                let expected: Vec<_> = all.iter().filter(inside).copied().collect();
                assert_eq!(drawn, expected, "{a:?} {b:?} in {window:?}");
            }
        }
    }
}
