//! Textures: borrowed texels, repeated or clamped, sampled nearest or filtered.

mod sampling;

pub use sampling::{Address, Bilinear, Clamp, Filter, Nearest, Repeat, Sampling};

use crate::color::PixelFormat;
use crate::math::{SMALL_CORE, high};
use core::marker::PhantomData;
use fixed::types::I16F16;

/// A texture of `width x height` texels stored as `F`, rows from the top, in flash or RAM.
///
/// Coordinates `u`, `v` are in `[0, 1]` across it, v down. Outside, it repeats, for negative ones too; where it is
/// [`clamped`](Self::clamped), its edge goes on. The nearest texel is taken; where it is [`bilinear`](Self::bilinear), four are
/// mixed. Sides need not be powers of two.
///
/// ```
/// use hither::{Gray8, I16F16, Texture, Textured};
///
/// let texture = Texture::<Gray8>::try_new(&[0, 80], 2, 1)?;
/// let u = [-0.125, 0.5, 1.125].map(I16F16::from_num);
/// let half = I16F16::from_num(0.5);
/// assert_eq!(u.map(|u| texture.sample(u, half)), [80, 80, 0].map(|g| Some(Gray8(g))));
/// let clamped = texture.clamped();
/// assert_eq!(u.map(|u| clamped.sample(u, half)), [0, 80, 80].map(|g| Some(Gray8(g))));
/// let smooth = clamped.bilinear();
/// assert_eq!(u.map(|u| smooth.sample(u, half)), [0, 40, 80].map(|g| Some(Gray8(g))));
/// let shader = Textured(smooth);
/// # Ok::<(), hither::TextureSize>(())
/// ```
#[derive(Debug)]
pub struct Texture<'a, F: PixelFormat, A = Repeat, Q = Nearest> {
    texels: &'a [F::Word],
    width: u32,
    height: u32,
    /// `2^16 width`.
    across: u32,
    kind: PhantomData<(A, Q)>,
}

impl<F: PixelFormat, A, Q> Clone for Texture<'_, F, A, Q> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<F: PixelFormat, A, Q> Copy for Texture<'_, F, A, Q> {}

impl<'a, F: PixelFormat> Texture<'a, F> {
    /// The largest side, in texels: a texel is then 2^4 steps of a coordinate, which are 2^-16.
    pub const MAX_SIDE: u32 = 4096;

    /// A texture over exactly `width * height` words, which repeats and is sampled nearest.
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
            Ok(Self { texels, width, height, across: width << 16, kind: PhantomData })
        } else {
            Err(TextureSize { width, height, words: texels.len() })
        }
    }
}

impl<'a, F: PixelFormat, A, Q> Texture<'a, F, A, Q> {
    /// The same, whose edge texels go on outside of `[0, 1]`: for what is shown once, so that no pixel of an edge is one of
    /// the other side.
    ///
    /// A comparison or two more a coordinate; with [`Packed`](crate::Packed) coordinates are stepped each by itself, as those
    /// that are not packed are, since more of them matters than their fractions.
    #[must_use]
    pub const fn clamped(self) -> Texture<'a, F, Clamp, Q> {
        self.with()
    }

    /// The same, mixed from the four texels around a place, whose centres are at halves: where it is larger on the screen
    /// than it is, it is smooth.
    ///
    /// Four texels are read for one, and a channel takes two products; no division. See [`Bilinear`] for how far off it is.
    #[must_use]
    pub const fn bilinear(self) -> Texture<'a, F, A, Bilinear> {
        self.with()
    }

    /// The same texels, sampled in another way.
    const fn with<A2, Q2>(self) -> Texture<'a, F, A2, Q2> {
        let Self { texels, width, height, across, .. } = self;
        Texture { texels, width, height, across, kind: PhantomData }
    }

    /// Width and height in texels.
    #[must_use]
    pub const fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// The texel that holds `(u, v)`. There always is one.
    #[inline]
    #[must_use]
    pub fn nearest(&self, u: I16F16, v: I16F16) -> Option<F::Color>
    where
        A: Address,
    {
        self.nearest_of_fractions(A::fraction(v) << 16 | A::fraction(u))
    }

    /// The colour at `(u, v)`, sampled as the texture is. There always is one.
    #[inline(always)]
    #[must_use]
    pub fn sample(&self, u: I16F16, v: I16F16) -> Option<F::Color>
    where
        A: Address,
        Q: Sampling<F>,
    {
        Q::at(self, u, v)
    }

    /// The texel in a column and a row.
    #[inline]
    fn texel(&self, column: u32, row: u32) -> Option<F::Color> {
        self.texels.get((row * self.width + column) as usize).map(|word| F::decode(*word))
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
    use crate::color::{Gray8, Rgb565, Rgb888};

    fn fraction(coordinate: I16F16) -> u32 {
        Repeat::fraction(coordinate)
    }

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

    /// Coordinates of all kinds: near the sides, beyond them, and anywhere.
    fn coordinate(random: &mut impl FnMut() -> u32, side: u32) -> I16F16 {
        let whole = (random() % 5).wrapping_sub(2) << 16;
        I16F16::from_bits(match random() % 5 {
            0 => whole.wrapping_add(random() % 5).wrapping_sub(2),
            1 => whole.wrapping_add((random() % (2 * side) * (1 << 15)) / side),
            2 => whole.wrapping_add(random() % (1 << 16)),
            3 => [0, 1, 0x7fff_ffff, 0x8000_0000][random() as usize % 4],
            _ => random(),
        } as i32)
    }

    /// What is a texel's column or row from one that may be outside.
    fn addressed(at: f64, side: u32, clamps: bool) -> usize {
        let side = f64::from(side);
        (if clamps { at.clamp(0.0, side - 1.0) } else { at.rem_euclid(side) }) as usize
    }

    /// A filtered texel's channel in `f64`.
    fn filtered(
        [u, v]: [I16F16; 2],
        (width, height): (u32, u32),
        clamps: bool,
        channel: impl Fn(usize) -> u8,
    ) -> f64 {
        let axis = |c: I16F16, side: u32| {
            let place = c.to_num::<f64>() * f64::from(side) - 0.5;
            let at = [place.floor(), place.floor() + 1.0].map(|at| addressed(at, side, clamps));
            (at, place - place.floor())
        };
        let (([x0, x1], a), ([y0, y1], b)) = (axis(u, width), axis(v, height));
        let at = |x: usize, y: usize| f64::from(channel(y * width as usize + x));
        let row = |y: usize| at(x0, y) * (1.0 - a) + at(x1, y) * a;
        row(y0) * (1.0 - b) + row(y1) * b
    }

    /// Every way to sample, of all formats, on sides of 1 to 4096, at coordinates of all kinds, against `f64`.
    #[test]
    fn samples_are_those_of_a_reference() {
        let mut state = 9u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state.rotate_right(8)
        };
        let words: std::vec::Vec<u32> = (0..1 << 14).map(|_| random() & 0xff_ffff).collect();
        let greys: std::vec::Vec<u8> = words.iter().map(|&word| word as u8).collect();
        let shorts: std::vec::Vec<u16> = words.iter().map(|&word| word as u16).collect();
        let sides = [1, 2, 3, 4, 5, 16, 33, 64, 100, 128, 4095, 4096];
        for i in 0..60_000 {
            let (width, height) = loop {
                let [width, height] =
                    [sides[random() as usize % 12], sides[random() as usize % 12]];
                if width * height <= 1 << 14 {
                    break (width, height);
                }
            };
            let size = (width * height) as usize;
            let (words, greys, shorts) = (&words[..size], &greys[..size], &shorts[..size]);
            let full = Texture::<Rgb888>::try_new(words, width, height).unwrap();
            let grey = Texture::<Gray8>::try_new(greys, width, height).unwrap();
            let short = Texture::<Rgb565>::try_new(shorts, width, height).unwrap();
            let uv = [coordinate(&mut random, width), coordinate(&mut random, height)];
            let [u, v] = uv;
            let shown = std::format!("{width} x {height} at {u}, {v}");
            for clamps in [false, true] {
                let place = |c: I16F16, side| {
                    addressed((c.to_num::<f64>() * f64::from(side)).floor(), side, clamps)
                };
                // Nearest: where v is not within a step below a row's end.
                let next = I16F16::from_bits(v.to_bits().wrapping_add(1));
                if place(v, height) == place(next, height) && next > v {
                    let at = place(v, height) * width as usize + place(u, width);
                    let got = if clamps { grey.clamped().sample(u, v) } else { grey.sample(u, v) };
                    assert_eq!(got, Some(Gray8(greys[at])), "{i}: {shown}");
                }
                let (full, grey, short) = if clamps {
                    let (full, grey) = (full.clamped().bilinear(), grey.bilinear().clamped());
                    (full.sample(u, v), grey.sample(u, v), short.clamped().bilinear().sample(u, v))
                } else {
                    let (full, grey) = (full.bilinear(), grey.bilinear());
                    (full.sample(u, v), grey.sample(u, v), short.bilinear().sample(u, v))
                };
                let (full, grey, short) = (full.unwrap().0, grey.unwrap().0, short.unwrap());
                let near = |got: u8, channel: &dyn Fn(usize) -> u8, range: f64| {
                    let exact = filtered(uv, (width, height), clamps, channel);
                    let off = (f64::from(got) - exact).abs();
                    assert!(off <= 0.5 + range / 256.0 + 1e-9, "{i}: {got}, not {exact}, {shown}");
                };
                near(grey, &|at| greys[at], 255.0);
                for shift in [0, 8, 16] {
                    near((full >> shift) as u8, &|at| (words[at] >> shift) as u8, 255.0);
                }
                near(short.r(), &|at| Rgb565(shorts[at]).r(), 31.0);
                near(short.g(), &|at| Rgb565(shorts[at]).g(), 63.0);
                near(short.b(), &|at| Rgb565(shorts[at]).b(), 31.0);
            }
        }
    }

    /// At texels' centres filtered ones are as they are, on sides that have them on the grid.
    #[test]
    fn filtered_texels_are_exact_at_their_centres() {
        let texels: std::vec::Vec<u16> =
            (0..64 * 16).map(|i: u16| i.wrapping_mul(40_503)).collect();
        let texture = Texture::<Rgb565>::try_new(&texels, 64, 16).unwrap().bilinear();
        for (at, &texel) in texels.iter().enumerate() {
            let centre = |at: usize, side: usize| {
                I16F16::from_bits(((2 * at + 1) << 15) as i32 / side as i32)
            };
            let [u, v] = [centre(at % 64, 64), centre(at / 64, 16)];
            assert_eq!(texture.sample(u, v), Some(Rgb565(texel)));
            assert_eq!(texture.clamped().sample(u, v), Some(Rgb565(texel)));
            let repeated = [u - I16F16::from_num(3), v + I16F16::from_num(7)];
            assert_eq!(texture.sample(repeated[0], repeated[1]), Some(Rgb565(texel)));
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
