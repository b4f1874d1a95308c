//! Attributes across a triangle: perspective-correct per pixel, every N pixels, or not at all.
//!
//! At a pixel in front of a hither plane `h`, vertex `i` has the weight `beta_i = h k_i E_i / D`,
//! where `E_i >= 0` are the edge functions, `k_i > 0` the vertices' scales, and
//! `sum(beta_i) = h / w = q` (Olano & Greer 1997, section 4.1 and equation 4: `1/w` is set up from
//! `[k_i]`, an attribute from `[k_i u_i]`). So every weight is in `[0, 1]`, for any signs of the
//! vertices' `w`, and `u = u_0 + sum((u_i - u_0) beta_i) / q` is between the vertices' values.
//! Affine (section 6, equation 5) takes `[k_i w_i u_i]` instead: then `q` is 1.
//!
//! Formats: weights Q32; `q` and the numerators `n` Q30 in `i32`, where `n` is in units of
//! `2^e`, the power of two at or above the largest `|u_i - u_0|`; so `|n| <= q <= 1`.
//!
//! Error budget in the exact tier, in units of `2^e`, at `w = 4096 h`
//! (`q = 2^-12`):
//! - a block of [`BLOCK`] = 64 pixels starts from the exact edge functions: weights within 2^-29 of
//!   themselves and 2^-30 (see [`Factor`]), `n` and `q` within 2^-28;
//! - a pixel's step is rounded to 2^-31, so 63 steps add 2^-25 to `n` and to `q`;
//! - both divided by `q`: 2 (2^-25 + 2^-28) / 2^-12 < 2^-11.8; the reciprocal adds 2^-29.
//!
//! `2^e` is less than twice the range: within 2^-10.8 of that, where the contract says 2^-10. Farther than 4096 hither
//! distances it grows with `w`, up to the clamp: a quotient is kept between the vertices', and so is the value.
//!
//! Along a straight line a value is stepped in raw steps times 2^32, so that a pixel costs one addition
//! of 64 bits a varying, whose high word is the value.

mod arcs;
mod correction;
mod plane;
mod quotient;
mod reciprocal;

use crate::clip::{Hither, WRange};
use crate::math::{Factor, Scale, low, saturate, shr_round};
use crate::setup::Setup;
use crate::span::Span;
use crate::vertex::{Outside, Position, ScaleOf, Snap, Vertex};
pub(crate) use arcs::{Arcs, Bend};
use core::marker::PhantomData;
pub use correction::{
    Affine, Correction, DividedBy, Packed, Perspective, PerspectiveEvery, Wide, Width,
};
use fixed::types::I16F16;
pub(crate) use plane::{Line, Linear, Pieces, is_straight, nearness_of, wrapped};
pub(crate) use quotient::{Followed, Level, Quotients, Slope};
pub use reciprocal::{Division, Float, Newton, Reciprocal, Table};

/// Pixels that are stepped from one exact start, where each is divided.
pub(crate) const BLOCK: i32 = 64;

/// One, Q30.
const ONE: i32 = 1 << 30;

/// Which `w` ranges varyings can be interpolated over: a fragment with varyings needs a hither
/// plane; one without goes with any range.
pub trait Interpolates<const N: usize>: WRange {
    /// The hither plane, if there is one.
    #[doc(hidden)]
    fn hither(&self) -> Option<Hither> {
        None
    }
}

impl Interpolates<0> for crate::clip::NoHither {}
impl Interpolates<0> for crate::clip::BothSides {}

impl<const N: usize> Interpolates<N> for Hither {
    #[inline]
    fn hither(&self) -> Option<Hither> {
        Some(*self)
    }
}

/// How one triangle's varyings run along a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Linear on the screen: affine, or all `w` are the same.
    Linear,
    /// `n / q` at each pixel.
    Divided,
    /// `n / q` at the ends of straight pieces.
    Pieces,
}

/// The varyings of one triangle, as sums of the vertices' values, weighted by the edge functions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Varyings<const N: usize> {
    mode: Mode,
    /// Whether affine was asked for and could not be had.
    fallback: bool,
    /// Weight of vertex `i` is `scale[i] E_i`, at most 1.
    scale: [Factor; 3],
    /// `q` a pixel, Q30.
    q_step: i32,
    each: [Varying; N],
}

/// One varying: its value at vertex 0, and how the numerator is made from the other two's weights.
#[derive(Clone, Copy, Debug, Default)]
struct Varying {
    /// Raw Q16.16.
    base: i32,
    /// `u_i - u_0` for vertices 1 and 2, Q30 in units of `2^exponent`.
    differences: [i32; 2],
    /// 0 to 32: units of raw Q16.16.
    exponent: u32,
    /// The numerator's step a pixel, Q30, saturated.
    step: i32,
}

impl Varying {
    /// From the vertices' values and the weights' steps along a row. Not inlined: its registers are spilt once.
    #[inline(never)]
    fn new([u0, u1, u2]: [i32; 3], weight_steps: &[i64; 3]) -> Self {
        let difference = |u: i32| i64::from(u) - i64::from(u0);
        let both = [difference(u1), difference(u2)];
        let largest = both[0].unsigned_abs().max(both[1].unsigned_abs());
        let exponent = 64 - largest.saturating_sub(1).leading_zeros();
        let differences = [in_units(both[0], exponent), in_units(both[1], exponent)];
        let mut varying = Self { base: u0, differences, exponent, step: 0 };
        varying.step = varying.numerator(weight_steps);
        varying
    }

    /// `sum((u_i - u_0) weight_i)`, Q30, saturated. Weights are Q32, below 1 + 2^-20 in magnitude.
    #[inline(never)]
    fn numerator(&self, [_, b1, b2]: &[i64; 3]) -> i32 {
        let [d1, d2] = self.differences.map(i64::from);
        saturate(shr_round(d1 * b1 + d2 * b2, 32))
    }

    /// The value for a quotient `n / q`, Q30 in `[-1, 1]`.
    #[inline]
    fn value(&self, quotient: i32) -> I16F16 {
        if let Some(shift) = 29u32.checked_sub(self.exponent) {
            let offset = ((quotient >> shift) + 1) >> 1;
            return I16F16::from_bits(self.base.saturating_add(offset));
        }
        self.wide_value(quotient)
    }

    /// [`value`](Self::value) for differences of more than 2^29 raw steps, which are 8192.
    #[cold]
    #[inline(never)]
    fn wide_value(&self, quotient: i32) -> I16F16 {
        let offset = shr_round(i64::from(quotient) << self.exponent, 30);
        I16F16::from_bits(saturate(i64::from(self.base) + offset))
    }

    /// A quotient, or its step, in raw steps times 2^32: the high word of a sum of these is a value. Modulo
    /// 2^64, as differences of the whole range take 65 bits; the sums are in range.
    #[inline]
    fn fixed(&self, quotient: i32) -> i64 {
        i64::from(quotient).wrapping_shl(self.exponent + 2)
    }

    /// The value where the quotient is 0, in raw steps times 2^32, with half a step: the high word of it plus
    /// steps is rounded to nearest. Two raw steps off the ends of the range, so that no sum leaves it.
    #[inline]
    fn start(&self) -> i64 {
        let margin = if self.exponent == 0 { 0 } else { 2 };
        let base = self.base.min(i32::MAX - margin).max(i32::MIN + margin);
        (i64::from(base) << 32) + (1 << 31)
    }

    /// A quotient's value and its step along a straight line, in raw steps times 2^32. Not inlined: there is one for each
    /// varying.
    #[inline(never)]
    fn line(&self, quotient: i32, step: i32) -> [i64; 2] {
        [self.start().wrapping_add(self.fixed(quotient)), self.fixed(step)]
    }

    /// A quotient between the vertices', which have 0 and the differences: so every value is between the
    /// vertices', however few bits of `n` and `q` are left.
    #[inline]
    fn limited(&self, quotient: i32) -> i32 {
        let [d1, d2] = self.differences;
        // Inwards by what sums along a row may be off: 511 steps of half a unit each.
        let inset = if self.exponent > 20 { 1 << 9 } else { 0 };
        let (low, high) = (d1.min(d2).min(0) + inset, d1.max(d2).max(0) - inset);
        quotient.max(low).min(high)
    }
}

/// `1 / q`, for quotients of several numerators.
#[derive(Clone, Copy)]
struct Inverse {
    q: i32,
    /// `2^63 / (q 2^zeros)`.
    reciprocal: u32,
    zeros: u32,
}

impl Inverse {
    /// Of `q`, Q30; `q <= 0` counts as 2^-30.
    #[inline]
    fn new<R: Reciprocal>(q: i32) -> Self {
        let q = q.max(1);
        let zeros = q.leading_zeros();
        Self { q, reciprocal: R::of(q.unsigned_abs() << zeros), zeros }
    }

    /// `n / q`, Q30, clamped to `[-1, 1]`.
    ///
    /// Where `|n| < q`, `n 2^(zeros - 1)` is below 2^31, and its product with the reciprocal is `n / q` in Q62:
    /// the quotient is its high word.
    #[inline]
    fn quotient(&self, n: i32) -> i32 {
        if n >= self.q {
            return ONE;
        }
        if n <= -self.q {
            return -ONE;
        }
        let normal = n << (self.zeros.wrapping_sub(1) & 31);
        low((i64::from(normal) * i64::from(self.reciprocal)) >> 32)
    }

    /// [`quotient`](Self::quotient), where there is one for each varying and not for each pixel.
    #[inline(never)]
    fn any_quotient(&self, n: i32) -> i32 {
        self.quotient(n)
    }
}

/// A difference of raw values, Q30 in units of `2^exponent`.
#[inline(never)]
fn in_units(difference: i64, exponent: u32) -> i32 {
    low(shr_round(difference << 30, exponent))
}

/// Where one straight piece ends and the next begins: its quotients, so that they are divided once.
pub(crate) type Joint<const N: usize> = Option<[i32; N]>;

impl<const N: usize> Varyings<N> {
    /// Sets up a triangle's varyings for a range that has a hither plane.
    #[inline(never)]
    pub(crate) fn new<T: Snap, C: Correction, const P: usize>(
        setup: &Setup,
        vertices: [&Vertex<T, N, P>; 3],
        hither: Hither,
        outside: Outside,
    ) -> Self {
        let crosses = outside.0 & Outside::HITHER != 0;
        let mode = if (C::AFFINE && !crosses) || same_w(vertices) {
            Mode::Linear
        } else if C::EVERY > 1 {
            Mode::Pieces
        } else {
            Mode::Divided
        };
        let linear = mode == Mode::Linear;
        let ([a, b, c], [e0, e1, e2]) = (vertices, setup.across());
        let weight = |vertex, edge| weight_of(vertex, edge, linear, hither, &setup.inverse);
        let ((s0, step0), (s1, step1), (s2, step2)) = (weight(a, e0), weight(b, e1), weight(c, e2));
        let steps = [step0, step1, step2];
        let q_step = saturate(shr_round(steps[0] + steps[1] + steps[2], 2));
        let mut each = [Varying::default(); N];
        let values = a.varyings.iter().zip(&b.varyings).zip(&c.varyings);
        for (varying, ((u0, u1), u2)) in each.iter_mut().zip(values) {
            *varying = Varying::new([u0.to_bits(), u1.to_bits(), u2.to_bits()], &steps);
        }
        Self { mode, fallback: C::AFFINE && !linear, scale: [s0, s1, s2], q_step, each }
    }

    /// How they run along a row.
    #[inline]
    pub(crate) const fn mode(&self) -> Mode {
        self.mode
    }

    /// Whether affine was asked for and could not be had.
    #[inline]
    pub(crate) const fn fallback(&self) -> bool {
        self.fallback
    }

    /// Numerators and `q` at a covered pixel.
    #[inline(never)]
    fn at(&self, setup: &Setup, x: i32, y: i32) -> ([i32; N], i32) {
        let ([s0, s1, s2], [e0, e1, e2]) = (self.scale, setup.edges_at(x, y));
        let weights = [weight(s0, e0), weight(s1, e1), weight(s2, e2)];
        let q = saturate((weights[0] + weights[1] + weights[2] + 2) >> 2);
        (self.each.each_ref().map(|v| v.numerator(&weights)), q)
    }

    /// Quotients at a covered pixel, where they are linear on the screen or in pieces.
    #[inline]
    fn quotients<C: Correction>(&self, setup: &Setup, x: i32, y: i32) -> [i32; N] {
        let (n, q) = self.at(setup, x, y);
        let mut quotients = n;
        if C::EVERY > 1 && self.mode != Mode::Linear {
            let inverse = Inverse::new::<C::Reciprocal>(q);
            for quotient in &mut quotients {
                *quotient = inverse.any_quotient(*quotient);
            }
        }
        for (quotient, varying) in quotients.iter_mut().zip(&self.each) {
            *quotient = varying.limited(*quotient);
        }
        quotients
    }

    /// The straight line through a block. `joint` is where the block before ended, if this one goes on from there;
    /// where there is `more` of the span it becomes where this one ends. Not inlined: the pixel loop after it wants
    /// the registers.
    #[inline(never)]
    pub(crate) fn ramp<C: Correction>(
        &self,
        setup: &Setup,
        block: Span,
        more: bool,
        joint: &mut Joint<N>,
    ) -> Ramp<N> {
        let at = |x: i32| self.quotients::<C>(setup, x, block.y);
        let quotients = joint.take().unwrap_or_else(|| at(block.x0));
        let mut steps = self.each.map(|v| v.step);
        if C::EVERY > 1 && self.mode != Mode::Linear {
            // To the first pixel of the next piece, or the last of this one.
            let end = if more { block.x1 } else { block.x1 - 1 };
            let last = if end > block.x0 { at(end) } else { quotients };
            for ((step, last), first) in steps.iter_mut().zip(last).zip(quotients) {
                *step = per_pixel(last, first, end - block.x0);
            }
            *joint = more.then_some(last);
        }
        let mut ramp = Ramp { at: [0; N], step: [0; N] };
        let each = self.each.iter().zip(quotients).zip(steps);
        for ((at, ramp_step), ((varying, quotient), step)) in
            ramp.at.iter_mut().zip(&mut ramp.step).zip(each)
        {
            [*at, *ramp_step] = varying.line(quotient, step);
        }
        ramp
    }

    /// The divided run of a block.
    #[inline]
    pub(crate) fn divided<R: Reciprocal>(&self, setup: &Setup, block: Span) -> Divided<'_, R, N> {
        let (n, q) = self.at(setup, block.x0, block.y);
        Divided { varyings: self, n, q, reciprocal: PhantomData }
    }
}

/// `(last - first) / steps`, rounded towards 0, so that no sum of up to `steps` of it passes `last`; 0 for a single
/// pixel.
#[inline]
fn per_pixel(last: i32, first: i32, steps: i32) -> i32 {
    /// `ceil(2^32 / n)` for n of 0 to 64; 0 and 1 are not looked up. By a division instead W5 takes 2 % more instructions on
    /// a Cortex-M4F.
    const INVERSE: [u32; 65] = inverses();
    let difference = i64::from(last) - i64::from(first);
    if steps <= 1 {
        return if steps == 1 { saturate(difference) } else { 0 };
    }
    let inverse = INVERSE.get(crate::math::index(steps)).copied().unwrap_or(0);
    // Of a negative one the ceiling.
    let up = if difference < 0 { (1 << 32) - 1 } else { 0 };
    low((difference * i64::from(inverse) + up) >> 32)
}

/// The table of [`per_pixel`].
#[expect(clippy::indexing_slicing, reason = "n is below the length; evaluated at compile time")]
#[expect(clippy::cast_possible_truncation, reason = "at most 2^31 from n = 2 on")]
const fn inverses() -> [u32; 65] {
    let mut table = [0; 65];
    let mut n = 2;
    while n <= 64 {
        table[n] = (1u64 << 32).div_ceil(n as u64) as u32;
        n += 1;
    }
    table
}

/// The weight of an edge function at a covered pixel, Q32, below 1.
#[inline]
fn weight(scale: Factor, edge: i64) -> i64 {
    i64::from(u32::try_from(scale.apply(edge) >> 29).unwrap_or(u32::MAX))
}

/// What turns a vertex's edge function into its weight, and the weight's step a pixel, Q32.
///
/// The weight of a unit is, in units of the setup's inverse, `k w` where varyings are linear on the screen, otherwise
/// `k h`. On a row of two covered pixels or more a step is at most 1 in magnitude; a steeper step is never taken, so it
/// is clamped.
#[inline(never)]
fn weight_of<T: Snap, const N: usize, const P: usize>(
    vertex: &Vertex<T, N, P>,
    edge: i64,
    linear: bool,
    hither: Hither,
    inverse: &Scale,
) -> (Factor, i64) {
    const LIMIT: i64 = (1 << 32) - 1;
    let w = if linear { vertex.position.scaled_w() } else { hither.raw() };
    let mut scale = Scale::of(u64::from(w.unsigned_abs()));
    if !linear {
        let ScaleOf(k) = vertex.position.scale();
        scale = k.times(scale);
    }
    let scale = scale.times(*inverse);
    (Factor::new(scale, 0), scale.apply(edge, 32).clamp(-LIMIT, LIMIT))
}

/// Whether the vertices have the same `w`, to the bit, so that `q` is constant.
#[inline]
pub(crate) fn same_w<T: Snap, const N: usize, const P: usize>(
    [a, b, c]: [&Vertex<T, N, P>; 3],
) -> bool {
    let w = |v: &Vertex<T, N, P>| {
        let ScaleOf(k) = v.position.scale();
        (k, v.position.scaled_w())
    };
    w(a) == w(b) && w(b) == w(c)
}

/// A run of pixels with varyings: what the fragment loop steps along.
pub(crate) trait Run<const N: usize> {
    /// The varyings at this pixel.
    fn varyings(&self) -> [I16F16; N];
    /// To the next pixel.
    fn step(&mut self);
}

/// Varyings along a straight line, in raw steps times 2^32.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ramp<const N: usize> {
    at: [i64; N],
    step: [i64; N],
}

/// Varyings divided at each pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Divided<'a, R, const N: usize> {
    varyings: &'a Varyings<N>,
    n: [i32; N],
    q: i32,
    reciprocal: PhantomData<R>,
}

impl<const N: usize> Run<N> for Ramp<N> {
    #[inline]
    fn varyings(&self) -> [I16F16; N] {
        self.at.map(|at| I16F16::from_bits(low(at >> 32)))
    }

    #[inline]
    fn step(&mut self) {
        for (at, step) in self.at.iter_mut().zip(self.step) {
            // After the last pixel the sum may pass the range; it is not looked at.
            *at = at.wrapping_add(step);
        }
    }
}

impl<R: Reciprocal, const N: usize> Run<N> for Divided<'_, R, N> {
    #[inline]
    fn varyings(&self) -> [I16F16; N] {
        let inverse = Inverse::new::<R>(self.q);
        let mut values = [I16F16::ZERO; N];
        for ((value, varying), n) in values.iter_mut().zip(&self.varyings.each).zip(self.n) {
            *value = varying.value(varying.limited(inverse.quotient(n)));
        }
        values
    }

    #[inline]
    fn step(&mut self) {
        for (n, varying) in self.n.iter_mut().zip(&self.varyings.each) {
            *n = n.wrapping_add(varying.step);
        }
        self.q = self.q.wrapping_add(self.varyings.q_step);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quotient(n: i32, q: i32) -> i32 {
        Inverse::new::<Newton<2>>(q).quotient(n)
    }

    #[test]
    fn quotients_are_close_and_clamped() {
        for i in 0..60_000i64 {
            let q = (1 + (i * 7_919_777) % i64::from(ONE)) >> (i % 20);
            let n = (i * 104_729_777) % (q + 1);
            for n in [n, -n] {
                let (n, q) = (n as i32, (q as i32).max(1));
                let exact = f64::from(n) / f64::from(q);
                let got = f64::from(quotient(n, q)) / f64::from(ONE);
                assert!((exact - got).abs() < 2f64.powi(-28), "{n} / {q} = {got}");
            }
        }
        assert_eq!(quotient(ONE, 1), ONE);
        assert_eq!(quotient(i32::MIN, 7), -ONE);
        assert_eq!(quotient(5, -3), ONE);
        assert_eq!(quotient(0, 0), 0);
    }

    #[test]
    fn constant_varyings_stay_constant() {
        for u in [i32::MIN, -1, 0, 1, i32::MAX] {
            let varying = Varying::new([u; 3], &[1 << 32, -(1 << 31), 77]);
            for weights in [[0, 0, 0], [1 << 32, 0, 0], [5, 1 << 31, 1 << 31]] {
                let n = varying.numerator(&weights) + varying.step;
                assert_eq!(varying.value(quotient(n, 12_345)).to_bits(), u);
            }
        }
    }

    #[test]
    fn differences_of_the_whole_range_reach_both_ends() {
        let varying = Varying::new([i32::MIN, i32::MAX, 0], &[0; 3]);
        let at = |b1: i64, b2: i64| {
            let n = varying.numerator(&[0, b1, b2]);
            i64::from(varying.value(n).to_bits())
        };
        assert!((at(1 << 32, 0) - i64::from(i32::MAX)).abs() <= 4);
        assert!(at(0, 1 << 32).abs() <= 4);
        assert_eq!(at(0, 0), i64::from(i32::MIN));
    }

    #[test]
    fn pieces_end_where_they_should() {
        for steps in 1..=64 {
            for difference in [-ONE, -1, 0, 1, 77_777, ONE] {
                let step = per_pixel(difference, 0, steps);
                assert!((i64::from(step) * i64::from(steps) - i64::from(difference)).abs() <= 64);
            }
        }
    }
}
