//! Line setup: two snapped vertices in, one pixel a column or row out, as a linear function and a range.
//!
//! A line is walked along its major axis `u`, the one in which it moves more on the screen (columns where both are the
//! same), and has one pixel for each step: the one whose centre is nearest to where the line through the vertices is
//! at that step's centre, on a tie the lower one, or the one to the right. With `Q` the point at the centre of step `U`
//! and `(u, v, w)` a vertex in pixel space, `Q` is the sum of the vertices `A` and `B` times
//!
//! ```text
//! alpha = 2 B.u - (2 U + 1) B.w        beta = (2 U + 1) A.w - 2 A.u
//! ```
//!
//! whose `w` is `span = 2 (B.u A.w - A.u B.w)` at any `U`: edge functions in one dimension (Olano & Greer 1997, section 5.1),
//! so that no vertex is divided by its `w` and none needs to be in front of the eye. The pixel is `V = floor(Q.v / span)`.
//!
//! The ends are ordered by the sign of `span`, which is exact and changes with their order: that is all that decides which
//! is first, so that a line is the same pixels, and the same depths, whichever end came first.
//!
//! Bit budget, in the exact tier (any other has less):
//!
//! | value | bound | why |
//! | --- | --- | --- |
//! | `u`, `v`, `w` | 2^30, 2^30, 2^21 | `W (x + w)`, `H (w - y)`, `2 w` |
//! | `span`, what a step adds to `Q.v` | 2^52 | twice `2 W` or `2 H` times a minor of 2^41 |
//! | `alpha`, `beta` in the viewport | 2^31 | `2 W x + 2 w (W - 2 U - 1)`; of a dot 2^32 |
//! | `Q.v` | 2^62 | two products of 2^31 and 2^30 |
//! | `V span` in the viewport | 2^61 | 2^9 rows |

mod projected;

pub(crate) use projected::ProjectedLine;

use crate::math::{MOST_STEPS, product, steps_to_zero};
use crate::vertex::{Rect, Viewport};

/// A line segment between two vertices in pixel space, in order along its major axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    /// `[u, v, w]`: along the major axis, across it, and `w`.
    ends: [[i32; 3]; 2],
    /// Whether the major axis is `y`.
    pub(crate) steep: bool,
    /// Whether the vertices are in another order than they came in.
    pub(crate) exchanged: bool,
    /// Positive.
    pub(crate) span: i64,
    /// What a step adds to `Q.v`: at most `span` in magnitude.
    pub(crate) climb: i64,
    /// The steps that are drawn: a part of the viewport's, whatever the window.
    pub(crate) from: i32,
    pub(crate) to: i32,
}

impl Segment {
    /// The part in front of the eye of a line between two vertices in pixel space: from the pixel of one to that of the other,
    /// both included, or on to the viewport's side where the other is behind. `None` where both are the same point of the
    /// screen, or all of it is at infinity.
    #[inline(never)]
    pub(crate) fn new(a: [i32; 3], b: [i32; 3], viewport: &Viewport) -> Option<Self> {
        let cross = |axis: fn([i32; 3]) -> i32| product(axis(b), a[2]) - product(axis(a), b[2]);
        let (across, down) = (cross(|[x, _, _]| x), cross(|[_, y, _]| y));
        let steep = down.abs() > across.abs();
        let (span, climb) = if steep { (down, across) } else { (across, down) };
        if span == 0 {
            return None;
        }
        let exchanged = span < 0;
        let order = |[x, y, w]: [i32; 3]| if steep { [y, x, w] } else { [x, y, w] };
        let ends = if exchanged { [b, a] } else { [a, b] }.map(order);
        let size = if steep { viewport.height } else { viewport.width };
        let [from, to] = steps(&ends, size);
        // Both change sign with the order.
        let (span, climb) = if exchanged { (-span, -climb) } else { (span, climb) };
        Some(Self { ends, steep, exchanged, span: 2 * span, climb: 2 * climb, from, to })
    }

    /// The pixel of one vertex with `w > 0`: a segment from there to the right, of which one step is drawn.
    #[inline(never)]
    pub(crate) fn dot([x, y, w]: [i32; 3], viewport: &Viewport) -> Self {
        let span = 2 * product(w, w);
        let ends = [[x, y, w], [x + w, y, w]];
        let [from, to] = steps(&[[x, y, w]; 2], viewport.width);
        Self { ends, steep: false, exchanged: false, span, climb: 0, from, to }
    }

    /// The weights of the vertices at the centre of a step, and a third that is 0.
    #[inline]
    pub(crate) fn weights(&self, u: i32) -> [i64; 3] {
        let [[a, _, aw], [b, _, bw]] = self.ends;
        let u = 2 * u + 1;
        [2 * i64::from(b) - product(u, bw), product(u, aw) - 2 * i64::from(a), 0]
    }

    /// What a step adds to them.
    #[inline]
    pub(crate) fn weight_steps(&self) -> [i64; 3] {
        let [[_, _, a], [_, _, b]] = self.ends;
        [-2 * i64::from(b), 2 * i64::from(a), 0]
    }

    /// `w` of both vertices in pixel space.
    #[inline]
    pub(crate) const fn w(&self) -> [i32; 2] {
        let [[_, _, a], [_, _, b]] = self.ends;
        [a, b]
    }

    /// `Q.v - v span` at a step: 0 or more where the line is not above (left of) the corner of pixel `v`.
    #[inline]
    pub(crate) fn below(&self, u: i32, v: i32) -> i64 {
        let [alpha, beta, _] = self.weights(u);
        let [[_, a, _], [_, b, _]] = self.ends;
        alpha * i64::from(a) + beta * i64::from(b) - i64::from(v) * self.span
    }

    /// Leaves the steps where a linear function is 0 or more: one that is `value` at the first step, and grows by `step >= 0`
    /// for each; or, where it ends them, those before that.
    #[inline]
    pub(crate) fn cut(&mut self, value: i128, step: i128, begins: bool) {
        let at = self.from + steps_to_zero(value, step, self.to - self.from);
        if begins {
            self.from = at;
        } else {
            self.to = at;
        }
    }

    /// The steps and the pixels across them that a window has: `[from, to]` of both.
    #[inline]
    pub(crate) const fn axes(&self, window: Rect) -> [[i32; 2]; 2] {
        let (x, y) = ([window.x0, window.x1], [window.y0, window.y1]);
        if self.steep { [y, x] } else { [x, y] }
    }
}

/// The steps from the pixel of the first end to that of the second, both included, as many as are in `0 .. size`. An end with
/// `w <= 0` is beyond all of them; where both are, nothing is in front of the eye.
#[inline]
fn steps([[a, _, aw], [b, _, bw]]: &[[i32; 3]; 2], size: i32) -> [i32; 2] {
    // One more than the pixel that holds `u / w`, or 0 to the left of all.
    let after = |u: i32, w: i32| steps_to_zero(-i64::from(u) - 1, i64::from(w), size + 1);
    match (*aw > 0, *bw > 0) {
        (true, true) => [(after(*a, *aw) - 1).max(0), after(*b, *bw).min(size)],
        (true, false) => [(after(*a, *aw) - 1).max(0), size],
        (false, true) => [0, after(*b, *bw).min(size)],
        (false, false) => [0, 0],
    }
}

const _: () =
    assert!((Viewport::MAX_SIDE as i32) < MOST_STEPS, "the steps over a viewport can be counted");
