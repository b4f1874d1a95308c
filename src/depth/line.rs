//! The depth of a line, linear along its major axis on the screen.
//!
//! At the centre of a step it is that of the line's point there; beyond an end, where the end's pixel has its centre, the
//! end's own. So no depth is beyond those of the ends.
//!
//! Error budget, in running units, 2^16 to a stored one of 16 bits. Both ends in front of the hither plane, `|z| <= 4 w`:
//! - a vertex's depth is within 2^-28 of itself: 2^6;
//! - the slope is an exact sum of terms within 2^-29 of themselves, and is within a part in 2^28: 2^7 over a line of up to 8 of
//!   the range;
//! - a step is rounded to 2^-9: 1 over 512;
//! - rounding to 16 bits adds 2^15.
//!
//! So a stored depth is within 0.51 units of 16 bits, and 2^8 of 32 (`check_depths` in `host-tests/tests/lines.rs`, which also
//! holds lines with an end behind the hither plane to that). Where an end is behind, the line starts from the other one, and the
//! slope's terms may cancel: on paper, that has no bound.
//!
//! A walk starts from what planes leave of the line in the viewport, not in the window, so that a band has the same depths.
//!
//! Lines between projected vertices have [`ProjectedDepths`]: by their own ends, so that a line has the same ones in any window.

mod projected;

pub(crate) use projected::ProjectedDepths;

use super::plane::scaled_z;
use crate::math::{Scale, Signed, align, combine, low, narrowed, unsigned};
use crate::setup::Segment;
use crate::vertex::{Outside, Snap, Vertex};

/// How far lines are moved towards the eye before their depths are tested and stored, in 2^-16 of the range from hither to far: so
/// that those on the edges of filled faces show. 0 where they are not.
///
/// A line is at its own depth, but its pixels' centres are up to half a pixel beside it, where a face that is steep is nearer. What
/// hides a line from further away than that still does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DepthBias(pub u16);

impl DepthBias {
    /// Lines are where they are.
    pub const NONE: Self = Self(0);
    /// 2^-9 of the range, for lines on the edges of faces.
    pub const WIREFRAME: Self = Self(128);
}

/// The depths of a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DepthLine {
    /// The step that `first` is at.
    at: i32,
    /// Running units, Q8.
    first: i64,
    step: i64,
    /// What no running value is beyond: those of the ends, or of the range.
    least: i64,
    most: i64,
    /// What rounds a running value to a stored one.
    half: i64,
}

/// Fraction bits of a running value's units.
const FRACTION: i32 = 8;

/// Steps are clamped to this, 2^13 of the range, so that 512 of them fit `i64`. A line that is steeper is shorter than 2^-10 of a
/// pixel, or is cut there: of two steps one is beyond an end.
const STEEPEST: i64 = 1 << 53;

/// The value to step from is clamped to this: what is beyond an end is so by half a pixel, at most; and a steepest step leads
/// from there to beyond the other end.
const LIMIT: i64 = STEEPEST / 2 + (1 << 44);

impl DepthLine {
    /// For words of `bits` bits, 1 to 32, of two vertices in the segment's order.
    #[inline(never)]
    pub(crate) fn new<T: Snap, const N: usize, const P: usize>(
        segment: &Segment,
        [a, b]: [&Vertex<T, N, P>; 2],
        bits: u32,
        DepthBias(bias): DepthBias,
    ) -> Self {
        let range = ((1i64 << bits) - 1) << (32 - bits);
        let full = Scale::of(range.unsigned_abs());
        let slope = slope(segment, [a, b], full);
        let step = slope.apply(1, FRACTION).clamp(-STEEPEST, STEEPEST);
        let [aw, bw] = segment.w();
        let (za, zb) = (depth_of(a, aw, full), depth_of(b, bw, full));
        // From the first end, unless that is behind: at the step next to it, since those far away may be beyond the limit.
        let from_first = aw > 0 && (bw <= 0 || a.outside.0 & Outside::HITHER == 0);
        let at = if from_first { segment.from } else { segment.to - 1 };
        let [alpha, beta, _] = segment.weights(at);
        let (z, w, offset) = if from_first { (za, aw, beta) } else { (zb, bw, -alpha) };
        let w = Scale::reciprocal_of(2 * u64::from(unsigned(w.max(1))));
        let first = z.saturating_add(slope.times(w).apply(offset, FRACTION));
        let bias = i64::from(bias) << 16;
        let limit = |z: i64, w: i32, open: i64| {
            let z = if w > 0 { (z >> FRACTION).max(0).min(range) } else { open };
            (z - bias).max(0)
        };
        let rises = step >= 0;
        let [nearest, farthest] = if rises { [0, range] } else { [range, 0] };
        let (first_end, last_end) = (limit(za, aw, nearest), limit(zb, bw, farthest));
        let (least, most) = if rises { (first_end, last_end) } else { (last_end, first_end) };
        Self {
            at,
            first: first.clamp(-LIMIT, LIMIT) - (bias << FRACTION),
            step,
            least,
            most,
            half: (1 << (32 - bits)) >> 1,
        }
    }

    /// The value at a step, to go on from by [`step`](Self::step).
    #[inline]
    pub(crate) fn value(&self, u: i32) -> i64 {
        self.first + self.step * i64::from(u - self.at)
    }

    /// The value a step on.
    #[inline]
    pub(crate) const fn step(&self, value: i64) -> i64 {
        value + self.step
    }

    /// The running value, of 32 bits, with the rounding in it.
    #[inline]
    pub(crate) fn running(&self, value: i64) -> u32 {
        unsigned(low((value >> FRACTION).max(self.least).min(self.most) + self.half))
    }

    /// The nearer of two lines that are one pixel.
    #[inline]
    pub(crate) fn nearer(self, other: Self) -> Self {
        if other.most < self.most { other } else { self }
    }
}

/// Running units that a step adds: `z / w` is twice the sum of the segment's weights times `k z`, over its span.
#[inline]
fn slope<T: Snap, const N: usize, const P: usize>(
    segment: &Segment,
    [a, b]: [&Vertex<T, N, P>; 2],
    full: Scale,
) -> Signed {
    let (values, exponent) = align(&[scaled_z(a), scaled_z(b), Signed::of(0)]);
    let (sum, more) = narrowed(combine(&values, &segment.weight_steps()));
    Signed::of(sum)
        .times(Scale::power_of_two(exponent + more + 1))
        .times(Scale::reciprocal_of(segment.span.unsigned_abs()))
        .times(full)
}

/// The depth of a vertex with `w > 0` in pixel space, running units, Q8, saturating; 0 of any other.
#[inline(never)]
fn depth_of<T: Snap, const N: usize, const P: usize>(
    v: &Vertex<T, N, P>,
    w: i32,
    full: Scale,
) -> i64 {
    if w <= 0 {
        return 0;
    }
    let half_w = Scale::reciprocal_of(u64::from(unsigned(w))).times(Scale::power_of_two(1));
    scaled_z(v).times(half_w).times(full).apply(1, FRACTION)
}
