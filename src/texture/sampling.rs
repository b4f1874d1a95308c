//! What is outside of a texture, and what is between its texels.

use super::Texture;
use crate::color::{Gray8, PixelFormat, Rgb565, Rgb888};
use crate::math::{signed, unsigned};
use fixed::types::I16F16;

/// What a texture shows outside of `[0, 1]`, as a type: [`Repeat`] or [`Clamp`].
pub trait Address: Copy + core::fmt::Debug + Default {
    /// Whether only the fractions of coordinates matter.
    #[doc(hidden)]
    const WRAPS: bool;

    /// Where a coordinate is within `[0, 1)`, Q16.
    #[doc(hidden)]
    fn fraction(coordinate: I16F16) -> u32;

    /// Where a coordinate is within `[0, 1]`, Q16.
    #[doc(hidden)]
    fn unit(coordinate: I16F16) -> u32;

    /// The texel `at`, -1 to `side - 1`, and the next, both within the side.
    #[doc(hidden)]
    fn neighbours(at: i32, side: u32) -> [u32; 2];
}

/// It is shown again, for negative coordinates too.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repeat;

/// Its edge texels go on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Clamp;

impl Address for Repeat {
    const WRAPS: bool = true;

    /// Two's complement makes that of a negative coordinate count from the next lower integer, which is what repeating
    /// means.
    #[inline]
    fn fraction(coordinate: I16F16) -> u32 {
        unsigned(coordinate.to_bits() & 0xffff)
    }

    #[inline]
    fn unit(coordinate: I16F16) -> u32 {
        Self::fraction(coordinate)
    }

    #[inline]
    fn neighbours(at: i32, side: u32) -> [u32; 2] {
        let (at, next) = (unsigned(at), unsigned(at + 1));
        [if at < side { at } else { side - 1 }, if next < side { next } else { 0 }]
    }
}

impl Address for Clamp {
    const WRAPS: bool = false;

    #[inline]
    fn fraction(coordinate: I16F16) -> u32 {
        unsigned(coordinate.to_bits().clamp(0, 0xffff))
    }

    #[inline]
    fn unit(coordinate: I16F16) -> u32 {
        unsigned(coordinate.to_bits().clamp(0, 1 << 16))
    }

    #[inline]
    fn neighbours(at: i32, side: u32) -> [u32; 2] {
        [unsigned(at.max(0)), unsigned(at + 1).min(side - 1)]
    }
}

/// What a texture shows between its texels' centres, as a type: [`Nearest`] or [`Bilinear`].
pub trait Sampling<F: PixelFormat>: Copy + core::fmt::Debug + Default {
    /// The colour at a place.
    #[doc(hidden)]
    fn at<A: Address>(texture: &Texture<'_, F, A, Self>, u: I16F16, v: I16F16) -> Option<F::Color>;

    /// The colour at coordinates in `[0, 1)`, Q16, `v` in the upper half of a word and `u` in the lower.
    #[doc(hidden)]
    fn at_fractions<A: Address>(texture: &Texture<'_, F, A, Self>, vu: u32) -> Option<F::Color>;
}

/// The texel that holds the place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nearest;

/// The four texels around the place, mixed by how near their centres are.
///
/// Weights are the nearest 8 bits, so that each is within 2^-9 and a channel within 2^-8 of its range, beside the half of a
/// step that rounding takes: 1.5 steps of 255, 0.75 of 63, 0.63 of 31. A coordinate is 2^-16 fine, which is the last of the 8
/// bits for a side of 256, and a 16th of a texel for one of 4096.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bilinear;

impl<F: PixelFormat> Sampling<F> for Nearest {
    #[inline(always)]
    fn at<A: Address>(texture: &Texture<'_, F, A, Self>, u: I16F16, v: I16F16) -> Option<F::Color> {
        texture.nearest(u, v)
    }

    #[inline(always)]
    fn at_fractions<A: Address>(texture: &Texture<'_, F, A, Self>, vu: u32) -> Option<F::Color> {
        texture.nearest_of_fractions(vu)
    }
}

impl<F: PixelFormat<Color: Filter>> Sampling<F> for Bilinear {
    #[inline]
    fn at<A: Address>(texture: &Texture<'_, F, A, Self>, u: I16F16, v: I16F16) -> Option<F::Color> {
        filtered(texture, A::unit(u), A::unit(v))
    }

    #[inline]
    fn at_fractions<A: Address>(texture: &Texture<'_, F, A, Self>, vu: u32) -> Option<F::Color> {
        filtered(texture, vu & 0xffff, vu >> 16)
    }
}

/// The two texels of a side around a place in `[0, 1]`, Q16, and the second one's weight, in 256ths.
#[inline]
fn around<A: Address>(unit: u32, side: u32) -> ([u32; 2], u32) {
    // From the first texel's centre, half of a 256th more: at most 2^28.
    let place = signed(unit * side) - (1 << 15) + (1 << 7);
    (A::neighbours(place >> 16, side), unsigned(place) >> 8 & 0xff)
}

/// The mix of the four texels around a place in `[0, 1]`, Q16.
#[inline]
fn filtered<F: PixelFormat<Color: Filter>, A: Address>(
    texture: &Texture<'_, F, A, Bilinear>,
    u: u32,
    v: u32,
) -> Option<F::Color> {
    let (width, height) = texture.size();
    let ([left, right], x) = around::<A>(u, width);
    let ([top, bottom], y) = around::<A>(v, height);
    let above = [texture.texel(left, top)?, texture.texel(right, top)?];
    let below = [texture.texel(left, bottom)?, texture.texel(right, bottom)?];
    Some(Filter::mixed(above, below, [x, y]))
}

/// A colour with channels that [`Bilinear`] mixes.
pub trait Filter: Copy {
    /// The mix of two colours above and two below, left ones first, by the weights of the right ones and of the lower ones,
    /// in 256ths below 256: each channel rounded to nearest.
    #[must_use]
    fn mixed(above: [Self; 2], below: [Self; 2], weights: [u32; 2]) -> Self;
}

/// A channel of up to 8 bits of that. Above and below are mixed in one word, 16 bits each, so that it takes two products.
#[inline]
fn channel<C: Copy>(above: [C; 2], below: [C; 2], [x, y]: [u32; 2], of: impl Fn(C) -> u32) -> u32 {
    let ([a, b], [c, d]) = (above, below);
    let (left, right) = (of(a) | of(c) << 16, of(b) | of(d) << 16);
    // A sum is at most 255 2^8, whatever the difference of the words does.
    let across = (left << 8).wrapping_add(right.wrapping_sub(left).wrapping_mul(x));
    let (above, below) = (across & 0xffff, across >> 16);
    let sum = (above << 8).wrapping_add(below.wrapping_sub(above).wrapping_mul(y));
    (sum + (1 << 15)) >> 16
}

impl Filter for Rgb565 {
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "channels are 5 and 6 bits")]
    fn mixed(above: [Self; 2], below: [Self; 2], weights: [u32; 2]) -> Self {
        let r = channel(above, below, weights, |color| u32::from(color.0) >> 11);
        let g = channel(above, below, weights, |color| u32::from(color.0) >> 5 & 63);
        let b = channel(above, below, weights, |color| u32::from(color.0) & 31);
        Self((r << 11 | g << 5 | b) as u16)
    }
}

impl Filter for Rgb888 {
    #[inline]
    fn mixed(above: [Self; 2], below: [Self; 2], weights: [u32; 2]) -> Self {
        let [r, g, b] = [16, 8, 0]
            .map(|shift| channel(above, below, weights, |color: Self| color.0 >> shift & 0xff));
        Self(r << 16 | g << 8 | b)
    }
}

impl Filter for Gray8 {
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "a channel is 8 bits")]
    fn mixed(above: [Self; 2], below: [Self; 2], weights: [u32; 2]) -> Self {
        Self(channel(above, below, weights, |color| u32::from(color.0)) as u8)
    }
}
