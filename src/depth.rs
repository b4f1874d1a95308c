//! Depth: `z / w`, 0 on the hither plane and 1 at far, stored in 16 or 32 bits.
//!
//! `z / w` is linear on the screen: `sum(k_i z_i E_i) / D`, set up from `[k_i z_i]` (Olano & Greer
//! 1997, section 4). The running value is 32 bits, `(z / w)(2^N - 1) 2^(32 - N)`; its top `N` bits
//! are stored, rounded.
//!
//! Error budget for `N = 16` in the exact tier, in stored units of 2^16 running ones (after
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

use crate::buffer::BufferSize;
use crate::math::{Factor, Scale, Signed, align, combine, index, low, narrowed};
use crate::setup::Setup;
use crate::span::Span;
use crate::vertex::{Outside, Position, ScaleOf, Snap, Vertex};
use bytemuck::Pod;
use core::marker::PhantomData;

/// A stored depth: `u16` or `u32`, the whole range of the word from 0 (hither) to its maximum
/// (far).
pub trait DepthWord: Pod + Ord + Send + core::fmt::Debug {
    /// Bits of the word.
    #[doc(hidden)]
    const BITS: u32;
    /// The farthest depth, what a cleared buffer holds.
    const FAR: Self;
    /// The top bits of a running value.
    #[doc(hidden)]
    fn from_running(running: u32) -> Self;
}

impl DepthWord for u16 {
    const BITS: u32 = 16;
    const FAR: Self = Self::MAX;

    #[inline]
    fn from_running(running: u32) -> Self {
        (running >> 16) as Self
    }
}

impl DepthWord for u32 {
    const BITS: Self = 32;
    const FAR: Self = Self::MAX;

    #[inline]
    fn from_running(running: u32) -> Self {
        running
    }
}

/// Which fragments pass the depth test, as a type: [`Less`] or [`Always`].
pub trait Compare: Copy + Default + core::fmt::Debug {
    /// Whether a new depth replaces the stored one.
    fn passes<W: DepthWord>(new: W, stored: W) -> bool;
}

/// Nearer passes: hidden surfaces are removed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Less;

/// Everything passes: depth is only recorded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Always;

impl Compare for Less {
    #[inline]
    fn passes<W: DepthWord>(new: W, stored: W) -> bool {
        new < stored
    }
}

impl Compare for Always {
    #[inline]
    fn passes<W: DepthWord>(_new: W, _stored: W) -> bool {
        true
    }
}

/// Where depth is kept, or not: [`NoDepth`] or [`DepthBuffer`].
pub trait DepthTest: core::fmt::Debug {
    /// Bits of a stored depth; 0 where there is none.
    #[doc(hidden)]
    const BITS: u32;

    /// What is stored a pixel.
    #[doc(hidden)]
    type Word: DepthWord;

    /// The stored depths of `length` pixels from `(x, y)` of the buffer; none where there is no depth.
    #[doc(hidden)]
    fn row(&mut self, x: i32, y: i32, length: i32) -> &mut [Self::Word];

    /// Tests a running value against a stored depth, and stores it where it passes.
    #[doc(hidden)]
    fn passes(running: u32, stored: &mut Self::Word) -> bool;

    /// Sets everything to the farthest depth.
    fn clear(&mut self);
}

/// No depth: every fragment is drawn, and nothing is spent on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoDepth;

impl DepthTest for NoDepth {
    const BITS: u32 = 0;
    type Word = u16;

    #[inline]
    fn row(&mut self, _: i32, _: i32, _: i32) -> &mut [u16] {
        &mut []
    }

    #[inline]
    fn passes(_: u32, _: &mut u16) -> bool {
        true
    }

    #[inline]
    fn clear(&mut self) {}
}

/// A depth buffer in words the caller lends.
#[derive(Debug)]
pub struct DepthBuffer<'a, W: DepthWord = u16, C: Compare = Less> {
    words: &'a mut [W],
    width: i32,
    height: i32,
    compare: PhantomData<C>,
}

impl<'a, W: DepthWord> DepthBuffer<'a, W> {
    /// A `width x height` buffer, nearer passing, over the first `width * height` words. They keep
    /// what they hold; see [`Frame::clear`](crate::Frame::clear).
    ///
    /// # Errors
    ///
    /// [`BufferSize`] where a side is 0 or there are fewer words.
    pub fn try_new(words: &'a mut [W], width: u32, height: u32) -> Result<Self, BufferSize> {
        let (width, height) = BufferSize::check(width, height, words.len())?;
        Ok(Self { words, width, height, compare: PhantomData })
    }
}

impl<'a, W: DepthWord, C: Compare> DepthBuffer<'a, W, C> {
    /// The same with another comparison.
    #[must_use]
    pub fn with_compare<D: Compare>(self, _compare: D) -> DepthBuffer<'a, W, D> {
        let Self { words, width, height, .. } = self;
        DepthBuffer { words, width, height, compare: PhantomData }
    }

    /// Width and height in pixels.
    #[must_use]
    pub(crate) const fn size(&self) -> (i32, i32) {
        (self.width, self.height)
    }

    /// The stored words, row by row from the top.
    #[must_use]
    pub fn words(&self) -> &[W] {
        self.words
    }

    /// The buffer back.
    #[must_use]
    pub fn into_words(self) -> &'a mut [W] {
        self.words
    }
}

impl<W: DepthWord, C: Compare> DepthTest for DepthBuffer<'_, W, C> {
    const BITS: u32 = W::BITS;
    type Word = W;

    #[inline]
    fn row(&mut self, x: i32, y: i32, length: i32) -> &mut [W] {
        let start = index(y * self.width + x);
        let words = self.words.get_mut(start..start.saturating_add(index(length)));
        words.unwrap_or_default()
    }

    #[inline]
    fn passes(running: u32, stored: &mut W) -> bool {
        let depth = W::from_running(running);
        let passes = C::passes(depth, *stored);
        if passes {
            *stored = depth;
        }
        passes
    }

    fn clear(&mut self) {
        self.words.fill(W::FAR);
    }
}

/// The depth of one triangle: `z / w` as a linear function of the edge functions.
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
    /// Running units a unit of each `E_i`, where none of the three terms is large: a factor, and
    /// whether it is negative.
    Each([(Factor, bool); 3]),
    /// `k_i z_i` as integers on one scale, and the running units of their sum, where terms may
    /// cancel: the sum is exact, and scaled once.
    Sum([i128; 3], Scale),
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
        let values = vertices.map(|v| {
            let ScaleOf(k) = v.position.scale();
            let raw = Scale::power_of_two(i32::from(v.shift));
            Signed::of(i64::from(v.z)).times(k).times(raw)
        });
        let steps = setup.a.map(|a| a << setup.step);
        let (weights, step) = if outside.0 & Outside::STEEP == 0 {
            let values = values.map(|value| value.times(full));
            let ([u, v, w], [x, y, z]) = (values, steps);
            let step = u.apply(x, 0).saturating_add(v.apply(y, 0)).saturating_add(w.apply(z, 0));
            let factor = |v: Signed| (Factor::new(v.scale, TERM_BITS), v.negative);
            (Weights::Each(values.map(factor)), step)
        } else {
            let (values, exponent) = align(values);
            let scale = full.times(Scale::power_of_two(exponent));
            (Weights::Sum(values, scale), sum(&values, scale, steps))
        };
        // A steeper step belongs to a single pixel, and is not taken.
        let step = step.clamp(-STEEPEST, STEEPEST);
        Self { weights, step, half: (1i64 << (32 - bits)) >> 1 }
    }

    /// The run of a span whose edge functions at its first pixel are `edges`.
    #[inline]
    pub(crate) fn run(&self, span: Span, edges: [i64; 3]) -> DepthRun {
        let first = self.weights.apply(edges).saturating_add(self.half);
        let pixels = i64::from(span.x1 - 1 - span.x0);
        let last = first.saturating_add(self.step * pixels);
        let fits = |v: i64| v >= 0 && v <= i64::from(u32::MAX);
        DepthRun { first, step: self.step, inside: fits(first) && fits(last) }
    }
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
    fn apply(&self, edges: [i64; 3]) -> i64 {
        match self {
            Self::Each([u, v, w]) => {
                let [x, y, z] = edges;
                // Three terms of at most 2^59 (saturated, 2^61), in units of 2^-25.
                let term = |&(factor, negative): &(Factor, bool), e: i64| {
                    let product = factor.apply(e) >> 2;
                    if negative { -product } else { product }
                };
                (term(u, x) + term(v, y) + term(w, z)) >> (59 - TERM_BITS)
            }
            Self::Sum(values, scale) => sum(values, *scale, edges),
        }
    }
}

/// The running value of an exact sum, rounded, saturating. Not inlined: few triangles need it.
#[inline(never)]
fn sum(values: &[i128; 3], scale: Scale, edges: [i64; 3]) -> i64 {
    let (sum, exponent) = narrowed(combine(*values, edges));
    scale.apply(sum, exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// Tests a run of pixels.
    fn test<D: DepthTest>(
        buffer: &mut D,
        (x, y): (i32, i32),
        length: i32,
        running: u32,
        step: u32,
    ) -> Vec<bool> {
        let runs = (0..).map(|i: u32| running.wrapping_add(i.wrapping_mul(step)));
        buffer.row(x, y, length).iter_mut().zip(runs).map(|(d, r)| D::passes(r, d)).collect()
    }

    #[test]
    fn nearer_passes_and_is_stored() {
        let mut words = [100u16, 100, 100, 100, 7];
        let mut buffer = DepthBuffer::try_new(&mut words, 2, 2).unwrap();
        assert_eq!(test(&mut buffer, (0, 1), 2, 99 << 16, 1 << 16), [true, false]);
        assert_eq!(buffer.into_words(), [100, 100, 99, 100, 7]);
    }

    #[test]
    fn always_stores_the_farthest_too() {
        let mut words = [u32::FAR; 4];
        let mut buffer = DepthBuffer::try_new(&mut words, 4, 1).unwrap().with_compare(Always);
        assert_eq!(test(&mut buffer, (1, 0), 2, u32::MAX, 0), [true, true]);
    }

    #[test]
    fn outside_of_the_buffer_nothing_is_touched() {
        let mut words = [9u16; 4];
        let mut buffer = DepthBuffer::try_new(&mut words, 2, 2).unwrap();
        assert_eq!(test(&mut buffer, (0, 2), 2, 0, 0), []);
        assert_eq!(test(&mut buffer, (-1, 0), 2, 0, 0), []);
        buffer.clear();
        assert_eq!(words, [u16::MAX; 4]);
    }

    #[test]
    fn running_values_saturate() {
        let run = |first: i64| DepthRun { first, step: -3, inside: false }.running();
        assert_eq!(run(-1), (0, 3u32.wrapping_neg()));
        assert_eq!(run(i64::MAX).0, u32::MAX);
    }
}
