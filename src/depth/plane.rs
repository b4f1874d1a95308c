//! The depth of one triangle, as a linear function on the screen.
//!
//! Two ways lead to a row's first depth. Of a triangle whose vertices are all projected, or on the screen in the exact tier,
//! with 16-bit depths that are inside of the range it is a plane through the vertices, a [`Plane`] ([`projected`]) or a
//! [`Tiny`](crate::setup::Tiny) triangle's; that is nearly always. Otherwise it is the sum of the edge
//! functions, weighted ([`DepthPlane`]).
//!
//! Error budget of the plane, in running units, 2^16 to a stored one:
//! - a vertex's depth is within 2^-28 of the range: 2^4;
//! - the plane is off by less than 2^14 in boxes below 512 px, 10240 over a tiny triangle, 2^15.2 where a triangle reaches the
//!   guard band's ends, and 2^14.9 in the exact tier;
//! - rounding to 16 bits adds 2^15.
//!
//! So a stored depth is within a unit; and as vertices are inside of the range, with 2^15 to spare at both ends, so is
//! every running value: none is tested, and none wraps. At the guard band's ends that is 1.07 units, and an eighth of the spare
//! too little, if all that is cut went one way with the steepest gradient: 0.61 is the most that was seen (`accuracy`).
//!
//! Error budget of the weights for `N = 16` in the exact tier, in stored units of 2^16 running ones (after
//! Rossignac, section 9.3.1: the running value carries the bits that its additions lose):
//! - each row starts from the exact edge functions. Where every vertex has `|z| <= 4 w`, the three
//!   terms are at most 4 of the range, each within 2^-29 of itself and 2^-28 of the range: 2^-9 in
//!   all. Where one has not (it is behind the eye, or far beyond far) terms may cancel: then the sum
//!   is made in 128 bits, exactly but for 2^-60 of the largest term, and scaled once, within 2^-28:
//!   2^-12;
//! - the step is rounded to half a running unit: 511 steps add 2^-8;
//! - rounding to 16 bits adds 1/2.
//!
//! So a stored depth is within 1 unit of the exact plane at every covered pixel. With `N = 32` the
//! running value itself is stored, within 2^10 of its units: 2^-22 of the range.
//!
//! A row whose ends are both inside of the range is inside all along, since a row is linear and its
//! steps are exact integers. Any other row is stored pixel by pixel, each saturated; no value
//! wraps.

use crate::math::{Factor, Scale, Signed, align, combine, low, narrowed, shr_round, unsigned};
use crate::setup::{Plane, Setup, Slopes};
use crate::span::Span;
use crate::vertex::{Outside, Position, ScaleOf, Snap, Vertex};

/// The depth of a projected triangle whose depths are all inside of the range, in running units with the rounding in
/// it.
#[inline]
pub(crate) fn projected<T: Snap, const N: usize, const P: usize>(
    slopes: &Slopes,
    vertices: [&Vertex<T, N, P>; 3],
) -> Plane {
    let (value, differences) = ranged(vertices);
    slopes.plane(value, differences)
}

/// The depth at the first of three vertices whose depths are all inside of the range, in running units with the rounding in
/// it, and half of how much more it is at the other two.
#[inline]
pub(crate) fn ranged<T: Snap, const N: usize, const P: usize>(
    vertices: [&Vertex<T, N, P>; 3],
) -> (u32, [i32; 2]) {
    // Times 1 - 2^-16, Q31.
    let [d0, d1, d2] = vertices.map(|v| v.z - (v.z >> 16));
    ((unsigned(d0) << 1).wrapping_add(1 << 15), [d1 - d0, d2 - d0])
}

/// A depth plane by the edge functions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DepthPlane {
    weights: Weights,
    /// Running units a pixel along a row.
    step: i64,
    /// What rounds a running value to a stored one.
    half: i64,
}

/// What turns edge functions into running values.
#[derive(Clone, Copy, Debug)]
enum Weights {
    /// Running units a unit of each `E_i`, where none of the three terms is large.
    Each([Term; 3]),
    /// `k_i z_i` as integers on one scale, and the running units of their sum, where terms may
    /// cancel: the sum is exact, and scaled once.
    Sum([i64; 3], Scale),
}

/// Running units a unit of an edge function: a factor, and -1 where it is negative, otherwise 0.
#[derive(Clone, Copy, Debug)]
struct Term {
    factor: Factor,
    sign: i32,
}

impl Term {
    /// Of `k z` of a vertex and the running units of 1, and what a step of its edge function comes to.
    #[inline(never)]
    fn of(value: &Signed, full: Scale, step: i64) -> (Self, i64) {
        let value = value.times(full);
        let factor = Factor::new(value.scale, TERM_BITS);
        (Self { factor, sign: -i32::from(value.negative) }, value.apply(step, 0))
    }

    /// The running units where the edge function is `e`, rounded.
    #[inline(never)]
    fn apply(&self, e: i64) -> i64 {
        let product = shr_round(self.factor.apply(e), (61 - TERM_BITS).unsigned_abs());
        let sign = i64::from(self.sign);
        (product ^ sign) - sign
    }

    /// The same of an edge function that may be negative.
    #[inline]
    fn apply_signed(&self, e: i64) -> i64 {
        let value = self.apply(e.abs());
        if e < 0 { -value } else { value }
    }
}

/// The running values of vertices whose depths are all inside of the range, least and largest; otherwise the whole range.
#[inline(never)]
pub(crate) fn limits<T: Snap, const N: usize, const P: usize>(
    vertices: [&Vertex<T, N, P>; 3],
) -> [u32; 2] {
    let [a, b, c] = vertices.map(|v| v.outside.0);
    if a & b & c & Outside::RANGED == 0 {
        return [0, u32::MAX];
    }
    let [a, b, c] = vertices.map(|v| (unsigned(v.z - (v.z >> 16)) << 1).wrapping_add(1 << 15));
    [a.min(b).min(c), a.max(b).max(c)]
}

/// Each of three terms that are not summed exactly is at most `2^TERM_BITS` running units: 4 of the
/// range.
const TERM_BITS: i32 = 34;

/// No step that is taken is larger, in running units: the range.
const STEEPEST: i64 = 1 << 32;

/// A run of depths along a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DepthRun {
    /// At the first pixel, with the rounding in it; any size.
    first: i64,
    step: i64,
    /// Whether all of the run is inside the range.
    pub(crate) inside: bool,
}

impl DepthPlane {
    /// A triangle's depth for words of `bits` bits, 1 to 32.
    #[inline(never)]
    pub(crate) fn new<T: Snap, const N: usize, const P: usize>(
        setup: &Setup,
        vertices: [&Vertex<T, N, P>; 3],
        bits: u32,
        outside: Outside,
    ) -> Self {
        let full = Scale::of(((1 << bits) - 1) << (32 - bits)).times(setup.inverse);
        let [a, b, c] = vertices;
        let values = [scaled_z(a), scaled_z(b), scaled_z(c)];
        let steps = setup.across();
        let half = (1i64 << (32 - bits)) >> 1;
        // A steeper step belongs to a single pixel, and is not taken.
        let limited = |step: i64| step.clamp(-STEEPEST, STEEPEST);
        if outside.0 & Outside::STEEP == 0 {
            let ([u, v, w], [x, y, z]) = (values, steps);
            let ((u, x), (v, y), (w, z)) =
                (Term::of(&u, full, x), Term::of(&v, full, y), Term::of(&w, full, z));
            let step = limited(x.saturating_add(y).saturating_add(z));
            Self { weights: Weights::Each([u, v, w]), step, half }
        } else {
            let (values, exponent) = align(&values);
            let scale = full.times(Scale::power_of_two(exponent));
            let step = limited(sum(&values, scale, &steps));
            Self { weights: Weights::Sum(values, scale), step, half }
        }
    }

    /// The running value at a pixel that may be a bit outside of the triangle, where the plane goes on; with the rounding in
    /// it, saturated.
    #[inline(never)]
    pub(crate) fn beyond(&self, setup: &Setup, x: i32, y: i32) -> u32 {
        let edges = setup.edges_at(x, y);
        let value = match &self.weights {
            Weights::Each([u, v, w]) => {
                let [x, y, z] = edges;
                u.apply_signed(x) + v.apply_signed(y) + w.apply_signed(z)
            }
            Weights::Sum(values, scale) => sum(values, *scale, &edges),
        };
        let (running, _) =
            DepthRun { first: value.saturating_add(self.half), ..DepthRun::NONE }.running();
        running
    }

    /// The run of a span. Not inlined: few triangles are drawn by it.
    #[inline(never)]
    pub(crate) fn run(&self, setup: &Setup, span: Span) -> DepthRun {
        let edges = setup.edges_at(span.x0, span.y);
        let first = self.weights.apply(&edges).saturating_add(self.half);
        let pixels = i64::from(span.x1 - 1 - span.x0);
        let last = first.saturating_add(self.step * pixels);
        let fits = |v: i64| v >= 0 && v <= i64::from(u32::MAX);
        DepthRun { first, step: self.step, inside: fits(first) && fits(last) }
    }
}

/// `k z` of a vertex.
#[inline(never)]
pub(super) fn scaled_z<T: Snap, const N: usize, const P: usize>(v: &Vertex<T, N, P>) -> Signed {
    if v.outside.0 & Outside::RANGED != 0 {
        // z / w times k w.
        let w = Scale::of(u64::from(v.position.scaled_w().unsigned_abs()));
        return Signed::of(i64::from(v.z)).times(w).times(Scale::power_of_two(-31));
    }
    let ScaleOf(k) = v.position.scale();
    let raw = Scale::power_of_two(i32::from(v.shift));
    Signed::of(i64::from(v.z)).times(k).times(raw)
}

impl DepthRun {
    /// The run where there is no depth.
    pub(crate) const NONE: Self = Self { first: 0, step: 0, inside: true };

    /// The running value at the first pixel, saturated, and the step. Where a run is inside the
    /// range, a step that does not fit 32 bits belongs to a single pixel, and is not taken.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "clamped to 32 bits")]
    #[expect(clippy::cast_sign_loss, reason = "clamped to positive; the step wraps by intent")]
    pub(crate) fn running(&self) -> (u32, u32) {
        (self.first.clamp(0, i64::from(u32::MAX)) as u32, low(self.step) as u32)
    }
}

impl Weights {
    /// The running value where the edge functions are `edges`, rounded, saturating.
    #[inline]
    fn apply(&self, edges: &[i64; 3]) -> i64 {
        match self {
            Self::Each([u, v, w]) => {
                let [x, y, z] = *edges;
                u.apply(x) + v.apply(y) + w.apply(z)
            }
            Self::Sum(values, scale) => sum(values, *scale, edges),
        }
    }
}

/// The running value of an exact sum, rounded, saturating. Not inlined: few triangles need it.
#[inline(never)]
fn sum(values: &[i64; 3], scale: Scale, edges: &[i64; 3]) -> i64 {
    let (sum, exponent) = narrowed(combine(values, edges));
    scale.apply(sum, exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn running_values_saturate() {
        let run = |first: i64| DepthRun { first, step: -3, inside: false }.running();
        assert_eq!(run(-1), (0, 3u32.wrapping_neg()));
        assert_eq!(run(i64::MAX).0, u32::MAX);
    }
}
