//! Textures: borrowed texels, sampled nearest.

use crate::color::PixelFormat;
use crate::math::{SMALL_CORE, high};
use fixed::types::I16F16;

/// A texture of `width x height` texels stored as `F`, rows from the top, in flash or RAM.
///
/// Coordinates `u`, `v` are in `[0, 1]` across it, v down; outside, it repeats, for negative ones
/// too. Sides need not be powers of two.
#[derive(Debug)]
pub struct Texture<'a, F: PixelFormat> {
    texels: &'a [F::Word],
    width: u32,
    height: u32,
    /// `2^16 width`.
    across: u32,
}

impl<F: PixelFormat> Clone for Texture<'_, F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<F: PixelFormat> Copy for Texture<'_, F> {}

impl<'a, F: PixelFormat> Texture<'a, F> {
    /// The largest side, in texels: a texel is then 2^4 steps of a coordinate, which are 2^-16.
    pub const MAX_SIDE: u32 = 4096;

    /// A texture over exactly `width * height` words.
    ///
    /// # Errors
    ///
    /// [`TextureSize`] where a side is 0 or over [`Texture::MAX_SIDE`], or the number of words
    /// differs.
    pub const fn try_new(
        texels: &'a [F::Word],
        width: u32,
        height: u32,
    ) -> Result<Self, TextureSize> {
        let sides = width >= 1 && width <= Self::MAX_SIDE && height >= 1;
        let fits = sides && height <= Self::MAX_SIDE && texels.len() == (width * height) as usize;
        if fits {
            Ok(Self { texels, width, height, across: width << 16 })
        } else {
            Err(TextureSize { width, height, words: texels.len() })
        }
    }

    /// Width and height in texels.
    #[must_use]
    pub const fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// The texel that holds `(u, v)`.
    #[inline]
    #[must_use]
    pub fn nearest(&self, u: I16F16, v: I16F16) -> Option<F::Color> {
        self.nearest_of_fractions(fraction(v) << 16 | fraction(u))
    }

    /// The texel that holds coordinates in `[0, 1)`, Q16, `v` in the upper half of a word and `u` in the lower. There
    /// always is one. All of the word is `v`: what is below its 16 bits adds less than one of them.
    #[inline]
    pub(crate) fn nearest_of_fractions(&self, vu: u32) -> Option<F::Color> {
        let at = if SMALL_CORE { self.index_by_halves(vu) } else { self.index(vu) };
        self.texels.get(at as usize).map(|word| F::decode(*word))
    }

    /// Where the texel of a word of fractions is.
    #[inline]
    fn index(&self, vu: u32) -> u32 {
        let row = high(u64::from(vu) * u64::from(self.height));
        // The row and u as one number, Q16: a whole row adds a whole number of texels.
        high(u64::from(row << 16 | vu & 0xffff) * u64::from(self.across))
    }

    /// [`Texture::index`] in products of 32 bits.
    #[inline]
    fn index_by_halves(&self, vu: u32) -> u32 {
        let (u, v) = (vu & 0xffff, vu >> 16);
        let row = (v * self.height + ((u * self.height) >> 16)) >> 16;
        row * self.width + ((u * self.width) >> 16)
    }
}

/// The fraction of a coordinate, Q16. Two's complement makes that of a negative coordinate count from the next lower
/// integer, which is what repeating means.
#[inline]
#[expect(clippy::cast_sign_loss, reason = "16 bits, masked")]
fn fraction(coordinate: I16F16) -> u32 {
    (coordinate.to_bits() & 0xffff) as u32
}

/// A texture is not the size it is said to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TextureSize {
    /// Texels.
    pub width: u32,
    /// Texels.
    pub height: u32,
    /// Words there are.
    pub words: usize,
}

impl core::fmt::Display for TextureSize {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { width, height, words } = self;
        write!(
            f,
            "a texture of {width} x {height} texels in {words} words: sides are 1 to 4096, a word a texel"
        )
    }
}

impl core::error::Error for TextureSize {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Gray8;

    #[test]
    fn coordinates_repeat_both_ways() {
        let at = |u: f64| (fraction(I16F16::from_num(u)) * 3) >> 16;
        assert_eq!([0.0, 0.34, 0.99, 1.0, 5.5].map(at), [0, 1, 2, 0, 1]);
        assert_eq!([-0.01, -0.34, -0.99, -1.0].map(at), [2, 1, 0, 0]);
    }

    /// Of all sides, and coordinates far outside of `[0, 1]`.
    #[test]
    fn texels_are_found_in_textures_of_any_size() {
        let words = std::vec![0u8; 1 << 20];
        let mut state = 3u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state.rotate_right(8)
        };
        for i in 0..20_000 {
            let sides = [1, 2, 3, 64, 255, 256, 1000, 1024];
            let [width, height] = [i % 8, i / 8 % 9].map(|i| match sides.get(i) {
                Some(&side) => side,
                None => 1 + random() % 1024,
            });
            let words = &words[..(width * height) as usize];
            let texture = Texture::<Gray8>::try_new(words, width, height).unwrap();
            let uv = [0; 2].map(|_| match random() % 4 {
                0 => 0u32.wrapping_sub(random() % 3),
                1 => (random() % 5) * (1 << 16) / height,
                _ => random(),
            } as i32);
            let [u, v] = uv.map(|c| f64::from(c).rem_euclid(65_536.0) / 65_536.0);
            let vu = fraction(I16F16::from_bits(uv[1])) << 16 | fraction(I16F16::from_bits(uv[0]));
            let at = texture.index(vu);
            assert_eq!(at, texture.index_by_halves(vu), "{width} x {height}, {vu:x}");
            let (column, row) = (at % width, at / width);
            assert_eq!(column, (u * f64::from(width)) as u32);
            let exact = v * f64::from(height);
            let past = (v + 1.0 / 65_536.0) * f64::from(height);
            assert!(exact as u32 <= row && f64::from(row) < past, "{row} for {exact}");
            assert!(texture.nearest_of_fractions(vu).is_some());
        }
    }

    #[test]
    fn sizes_are_checked() {
        let words = [1u8, 2, 3, 4, 5, 6];
        let texture = Texture::<Gray8>::try_new(&words, 3, 2).unwrap();
        let half = I16F16::from_num(0.5);
        assert_eq!(texture.nearest(half, half), Some(Gray8(5)));
        for (width, height) in [(3, 3), (0, 0), (2, 2), (4097, 1), (u32::MAX, u32::MAX)] {
            let error = Texture::<Gray8>::try_new(&words, width, height).unwrap_err();
            assert_eq!(error, TextureSize { width, height, words: 6 });
        }
    }
}
