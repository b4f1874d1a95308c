//! Colours, and how a pixel is stored: format and byte order as types.
//!
//! A [`PixelFormat`] says what word a pixel takes in memory, so that a row of them can go to a DMA
//! engine or an SPI driver as it is. The colour a shader computes is a plain value ([`Rgb565`],
//! [`Rgb888`], [`Gray8`]); the format turns it into the word, once per pixel or once per fill.

use crate::math::unsigned;
use bytemuck::Pod;
use fixed::types::I16F16;

/// 16-bit colour: 5 bits red, 6 green, 5 blue, red in the high bits. As a [`PixelFormat`], the same
/// in the processor's own byte order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rgb565(pub u16);

impl Rgb565 {
    /// All channels 0.
    pub const BLACK: Self = Self(0);
    /// All channels at their maximum.
    pub const WHITE: Self = Self(0xffff);
    /// Full red.
    pub const RED: Self = Self::new(31, 0, 0);
    /// Full green.
    pub const GREEN: Self = Self::new(0, 63, 0);
    /// Full blue.
    pub const BLUE: Self = Self::new(0, 0, 31);

    /// From channels of 5, 6 and 5 bits; higher bits are dropped.
    #[inline]
    #[must_use]
    pub const fn new(r: u8, g: u8, b: u8) -> Self {
        Self((r as u16 & 31) << 11 | (g as u16 & 63) << 5 | (b as u16 & 31))
    }

    /// Red, 0 to 31.
    #[inline]
    #[must_use]
    pub const fn r(self) -> u8 {
        (self.0 >> 11) as u8
    }

    /// Green, 0 to 63.
    #[inline]
    #[must_use]
    pub const fn g(self) -> u8 {
        (self.0 >> 5 & 63) as u8
    }

    /// Blue, 0 to 31.
    #[inline]
    #[must_use]
    pub const fn b(self) -> u8 {
        (self.0 & 31) as u8
    }
}

/// 24-bit colour, 8 bits a channel, as `0x00RRGGBB`. As a [`PixelFormat`], one `u32` a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rgb888(pub u32);

impl Rgb888 {
    /// All channels 0.
    pub const BLACK: Self = Self(0);
    /// All channels 255.
    pub const WHITE: Self = Self(0x00ff_ffff);

    /// From 8-bit channels.
    #[inline]
    #[must_use]
    pub const fn new(r: u8, g: u8, b: u8) -> Self {
        Self((r as u32) << 16 | (g as u32) << 8 | b as u32)
    }
}

/// 8-bit luminance, 0 black to 255 white; one `u8` a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Gray8(pub u8);

impl Gray8 {
    /// Luminance 0.
    pub const BLACK: Self = Self(0);
    /// Luminance 255.
    pub const WHITE: Self = Self(255);
}

/// 4-bit luminance, 0 black to 15 white, one `u8` a pixel whose upper bits are 0: [`pack_gray4`](crate::pack_gray4) makes two
/// a byte of them where they are sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Gray4(pub u8);

impl Gray4 {
    /// Luminance 0.
    pub const BLACK: Self = Self(0);
    /// Luminance 15.
    pub const WHITE: Self = Self(15);
}

/// Dark or lit, 0 or 1, one `u8` a pixel: [`pack_rows`](crate::pack_rows) and [`pack_pages`](crate::pack_pages) make eight a
/// byte of them where they are sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Binary(pub u8);

impl Binary {
    /// Dark.
    pub const BLACK: Self = Self(0);
    /// Lit.
    pub const WHITE: Self = Self(1);
}

/// A colour whose brightness is known: what [`Dithered`](crate::Dithered) makes few levels of.
pub trait Luminance: Copy {
    /// Luma in units of 2^-24, below 1: 0 for black, `1 - 2^-16` for white. By Rec. 601 for colours: 0.299 r + 0.587 g +
    /// 0.114 b, weights as 77, 150 and 29 of 256.
    #[must_use]
    fn luma(self) -> u32;
}

impl Luminance for Rgb888 {
    #[inline]
    fn luma(self) -> u32 {
        let [r, g, b] = [16, 8, 0].map(|shift| self.0 >> shift & 0xff);
        (77 * r + 150 * g + 29 * b) * 257
    }
}

impl Luminance for Gray8 {
    #[inline]
    fn luma(self) -> u32 {
        u32::from(self.0) * (257 << 8)
    }
}

/// The same of red, green and blue in `[0, 1]`, which are clamped.
#[inline]
pub(crate) fn luma([r, g, b]: [I16F16; 3]) -> u32 {
    let unit = |channel: I16F16| unsigned(channel.to_bits().clamp(0, 0xffff));
    77 * unit(r) + 150 * unit(g) + 29 * unit(b)
}

/// Rounds a channel in `[0, 1]` to `0 ..= max`, below 2^16; outside, it is clamped. To just below 1: 16 bits
/// are one instruction where 17 are three, and round to the same.
#[inline]
#[expect(clippy::cast_sign_loss, reason = "clamped to 16 bits first")]
fn channel(unit: I16F16, max: u32) -> u32 {
    let unit = unit.to_bits().clamp(0, 0xffff) as u32;
    (unit * max + (1 << 15)) >> 16
}

/// A colour that can be made from red, green and blue in `[0, 1]`, each channel rounded to nearest
/// and clamped: what [`Gouraud`](crate::Gouraud) needs.
pub trait FromUnit: Copy {
    /// The nearest colour to `[r, g, b]`, each in `[0, 1]`.
    fn from_unit(rgb: [I16F16; 3]) -> Self;

    /// Where the channels lie in a word that is stepped as one, if that is worth while.
    #[doc(hidden)]
    const LANES: Option<[Lane; 3]> = None;

    /// The colour of such a word.
    #[doc(hidden)]
    #[inline]
    #[must_use]
    fn from_lanes(_: u32) -> Self {
        Self::from_unit([I16F16::ZERO; 3])
    }
}

/// Where a varying in `[0, 1]` lies in a word of several: `u max + 1/2` with some bits of fraction.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Lane {
    /// Bits of the whole number; its largest value is `max = 2^bits - 1`.
    pub(crate) bits: u32,
    /// Bits of whole number and fraction.
    pub(crate) width: u32,
    /// The lowest bit's place.
    pub(crate) place: u32,
}

impl FromUnit for Rgb565 {
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "channels are 5 and 6 bits")]
    fn from_unit([r, g, b]: [I16F16; 3]) -> Self {
        Self((channel(r, 31) << 11 | channel(g, 63) << 5 | channel(b, 31)) as u16)
    }

    /// Green above red above blue, so that whole numbers are 5 above where they are in a colour, or 21.
    const LANES: Option<[Lane; 3]> = Some([
        Lane { bits: 5, width: 11, place: 10 },
        Lane { bits: 6, width: 11, place: 21 },
        Lane { bits: 5, width: 10, place: 0 },
    ]);

    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the high half was folded into the low one"
    )]
    fn from_lanes(word: u32) -> Self {
        let spread = (word >> 5) & 0x07e0_f81f;
        Self((spread | spread >> 16) as u16)
    }
}

impl FromUnit for Rgb888 {
    #[inline]
    fn from_unit([r, g, b]: [I16F16; 3]) -> Self {
        Self(channel(r, 255) << 16 | channel(g, 255) << 8 | channel(b, 255))
    }
}

impl FromUnit for Gray8 {
    /// Luma by Rec. 601: 0.299 r + 0.587 g + 0.114 b, weights as 77, 150 and 29 of 256.
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "a weighted mean of 8-bit values")]
    fn from_unit([r, g, b]: [I16F16; 3]) -> Self {
        let luma = 77 * channel(r, 65_280) + 150 * channel(g, 65_280) + 29 * channel(b, 65_280);
        Self(((luma + (1 << 15)) >> 16) as u8)
    }
}

/// The nearest of a few levels to a luma, as [`Luminance::luma`] has it.
macro_rules! levels {
    ($color:ident, $max:literal) => {
        impl FromUnit for $color {
            /// The level that is nearest to [`Luminance::luma`]'s.
            #[inline]
            fn from_unit(rgb: [I16F16; 3]) -> Self {
                Self(((luma(rgb) * $max + (1 << 23)) >> 24) as u8)
            }
        }
    };
}

levels!(Gray4, 15);
levels!(Binary, 1);

/// How a pixel is stored: the colour a shader gives, and the word that goes into memory.
pub trait PixelFormat: Copy + core::fmt::Debug {
    /// What is drawn with.
    type Color: Copy;
    /// What is stored: a plain word, so that a row of them can be sent as bytes.
    type Word: Pod + core::fmt::Debug;

    /// The word for a colour.
    fn encode(color: Self::Color) -> Self::Word;

    /// The colour of a word.
    fn decode(word: Self::Word) -> Self::Color;
}

/// [`Rgb565`] with the high byte first in memory: what ST7789 and ILI9341 panels take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rgb565Be;

impl PixelFormat for Rgb565Be {
    type Color = Rgb565;
    type Word = u16;

    #[inline]
    fn encode(color: Rgb565) -> u16 {
        color.0.to_be()
    }

    #[inline]
    fn decode(word: u16) -> Rgb565 {
        Rgb565(u16::from_be(word))
    }
}

/// A colour that is stored as the word it is.
macro_rules! native {
    ($color:ident, $word:ty) => {
        impl PixelFormat for $color {
            type Color = Self;
            type Word = $word;

            #[inline]
            fn encode(color: Self) -> $word {
                color.0
            }

            #[inline]
            fn decode(word: $word) -> Self {
                Self(word)
            }
        }
    };
}

native!(Rgb565, u16);
native!(Rgb888, u32);
native!(Gray8, u8);
native!(Gray4, u8);
native!(Binary, u8);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unit_channels_round_to_nearest() {
        for i in 0..=62 {
            // i / 62 is k / 31 or half way between two of them.
            let unit = I16F16::from_num(f64::from(i) / 62.0 + 1e-5);
            let color = Rgb565::from_unit([unit, I16F16::ZERO, unit]);
            assert_eq!(color, Rgb565::new((i + 1) as u8 / 2, 0, (i + 1) as u8 / 2));
        }
    }

    #[test]
    fn unit_channels_clamp() {
        let low = I16F16::from_num(-0.5);
        let high = I16F16::from_num(1.5);
        assert_eq!(Rgb565::from_unit([high, low, high]), Rgb565::new(31, 0, 31));
        assert_eq!(Rgb888::from_unit([I16F16::MIN, I16F16::MAX, low]), Rgb888::new(0, 255, 0));
        assert_eq!(Gray8::from_unit([high; 3]), Gray8::WHITE);
        assert_eq!(Gray8::from_unit([low; 3]), Gray8::BLACK);
    }

    #[test]
    fn few_levels_are_the_nearest() {
        for i in 0..=1 << 12 {
            let [r, g, b] = [i << 4, (i * 77) % 65_537, 65_536 - (i << 4)];
            let luma = f64::from(77 * r + 150 * g + 29 * b) / f64::from(1 << 24);
            let unit = [r, g, b].map(I16F16::from_bits);
            let off = (f64::from(Gray4::from_unit(unit).0) - 15.0 * luma).abs();
            assert!(off < 0.5 + 1e-3, "{unit:?}");
            let off = (f64::from(Binary::from_unit(unit).0) - luma).abs();
            assert!(off < 0.5 + 1e-3, "{unit:?}");
            // Of bytes as the channels they stand for.
            let [r, g, b] = [i & 255, i >> 4, i % 251].map(|v| v as u8);
            let exact =
                (77.0 * f64::from(r) + 150.0 * f64::from(g) + 29.0 * f64::from(b)) / 65_280.0;
            let got = f64::from(Rgb888::new(r, g, b).luma()) / f64::from(1 << 24);
            assert!((got - exact).abs() < 2e-5);
            let got = f64::from(Gray8(r).luma()) / f64::from(1 << 24);
            assert!((got - f64::from(r) / 255.0).abs() < 2e-5);
        }
        for white in [I16F16::ONE, I16F16::MAX].map(|unit| [unit; 3]) {
            assert_eq!(
                (Gray4::from_unit(white), Binary::from_unit(white)),
                (Gray4::WHITE, Binary::WHITE)
            );
        }
        for black in [I16F16::ZERO, I16F16::MIN].map(|unit| [unit; 3]) {
            assert_eq!(
                (Gray4::from_unit(black), Binary::from_unit(black)),
                (Gray4::BLACK, Binary::BLACK)
            );
        }
    }

    #[test]
    fn big_endian_words_send_the_high_byte_first() {
        let word = Rgb565Be::encode(Rgb565::new(31, 0, 1));
        assert_eq!(bytemuck::bytes_of(&word), [0xf8, 0x01]);
        assert_eq!(Rgb565Be::decode(word), Rgb565::new(31, 0, 1));
    }
}
