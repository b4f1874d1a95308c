//! Merging: what is drawn, mixed with or added to the colour that is there.
//!
//! A [`Merge`] is a colour that needs to know what it is drawn over. It is drawn into a [`Target`](crate::Target) whose
//! colours are merges: [`Blended`] reads the framebuffer, [`Over`] mixes with one stated colour where nothing can be read.
//! Shaders of plain colours become shaders of merges by [`Translucent`] and [`Additive`]. Formulas after Porter and Duff,
//! "Compositing Digital Images", 1984: "over" with an opaque colour below, and "plus".

mod shader;
mod target;

pub use shader::{Additive, Translucent};
pub use target::{Blended, Over};

use crate::color::{Binary, Gray4, Gray8, Rgb565, Rgb888};

/// A drawn value that is merged with the colour that is there: [`Alpha`], [`Add`], or your own.
///
/// ```
/// use hither::{Gray8, Merge};
///
/// /// Keeps the brighter one.
/// #[derive(Clone, Copy)]
/// struct Lighter(Gray8);
///
/// impl Merge<Gray8> for Lighter {
///     fn over(self, under: Gray8) -> Gray8 {
///         Gray8(self.0.0.max(under.0))
///     }
/// }
/// assert_eq!(Lighter(Gray8(9)).over(Gray8(7)), Gray8(9));
/// ```
pub trait Merge<C>: Copy {
    /// What is shown where `under` was.
    #[must_use]
    fn over(self, under: C) -> C;

    /// What is shown whatever was there, where that makes no difference: runs of it are filled without a look. `None` is
    /// always right.
    #[inline]
    #[must_use]
    fn opaque(self) -> Option<C> {
        None
    }
}

/// A colour that covers a part of what is there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Alpha<C> {
    /// What is drawn, not multiplied by `alpha`.
    pub color: C,
    /// How much of it is, in 255ths: 0 nothing, 255 all.
    pub alpha: u8,
}

/// A colour that is added to what is there, each channel up to its maximum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Add<C>(pub C);

impl<C> Alpha<C> {
    /// The same over a part of the pixel, Q16; `None` where nothing is left.
    #[inline]
    pub(crate) fn part(self, covered: i32) -> Option<Self> {
        let alpha = (u32::from(self.alpha) * covered.unsigned_abs() + (1 << 15)) >> 16;
        let alpha = u8::try_from(alpha).unwrap_or(u8::MAX);
        (alpha > 0).then_some(Self { alpha, ..self })
    }
}

impl<C: Mix> Merge<C> for Alpha<C> {
    #[inline]
    fn over(self, under: C) -> C {
        self.color.mix(under, self.alpha)
    }

    #[inline]
    fn opaque(self) -> Option<C> {
        (self.alpha == u8::MAX).then_some(self.color)
    }
}

impl<C: Mix> Merge<C> for Add<C> {
    #[inline]
    fn over(self, under: C) -> C {
        self.0.add(under)
    }
}

/// A colour with channels that can be mixed and added.
pub trait Mix: Copy {
    /// `alpha` 255ths of this over `under`: each channel is the nearest to `(c alpha + u (255 - alpha)) / 255`, so that 0
    /// gives `under` and 255 gives `self`. No halves come up: 255 is odd.
    ///
    /// Two products with `alpha` for [`Rgb565`] and [`Rgb888`], one for greys and two colours, and no division.
    #[must_use]
    fn mix(self, under: Self, alpha: u8) -> Self;

    /// The sum, each channel up to its maximum: an addition of all channels of [`Rgb565`], and masks.
    #[must_use]
    fn add(self, under: Self) -> Self;
}

/// Two lanes of 8 bits, 16 apart.
const LANES: u32 = 0x00ff_00ff;

/// `(c alpha + u (255 - alpha)) / 255`, rounded to nearest, in two lanes of 8 bits.
///
/// A lane of the sum is 0 to `255^2`, so that none is borrowed from another, whatever the difference of the words does;
/// `x / 255` is `(t + t / 2^8) / 2^8` with `t = x + 128`, all of it below `2^16`.
#[inline]
const fn mix_lanes(color: u32, under: u32, alpha: u8) -> u32 {
    let sum = color.wrapping_sub(under).wrapping_mul(alpha as u32).wrapping_add(under * 255);
    let half = sum + 0x0080_0080;
    ((half + ((half >> 8) & LANES)) >> 8) & LANES
}

/// The sums of two lanes of 8 bits, up to 255.
#[inline]
const fn add_lanes(a: u32, b: u32) -> u32 {
    let sum = a + b;
    let over = sum & !LANES;
    (sum | (over - (over >> 8))) & LANES
}

/// Green above red above blue, with room above each: 5 bits from 0 and 11, 6 bits from 21.
const SPREAD: u32 = 0x07e0_f81f;

impl Rgb565 {
    /// As [`SPREAD`] has the channels.
    #[inline]
    const fn spread(self) -> u32 {
        (self.0 as u32 | (self.0 as u32) << 16) & SPREAD
    }

    /// From channels as [`SPREAD`] has them, and 0 between.
    #[inline]
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the high half was folded into the low one"
    )]
    const fn gathered(spread: u32) -> Self {
        Self((spread | spread >> 16) as u16)
    }
}

impl Mix for Rgb565 {
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "channels are 5 and 6 bits")]
    fn mix(self, under: Self, alpha: u8) -> Self {
        // Three products of 13 or 14 bits are more than a word.
        let red_blue = |color: Self| {
            let color = u32::from(color.0);
            (color & 0xf800) << 5 | (color & 31)
        };
        let green = |color: Self| u32::from(color.0) >> 5 & 63;
        let mixed = mix_lanes(red_blue(self), red_blue(under), alpha);
        let green = mix_lanes(green(self), green(under), alpha);
        Self((mixed >> 5 | mixed | green << 5) as u16)
    }

    #[inline]
    fn add(self, under: Self) -> Self {
        let sum = self.spread() + under.spread();
        let over = sum & 0x0801_0020;
        // All bits of a channel, below the one that it has too many: 5 of them, or 6.
        let full = over - ((over & 0x0001_0020) >> 5) - ((over & 0x0800_0000) >> 6);
        Self::gathered((sum | full) & SPREAD)
    }
}

impl Mix for Rgb888 {
    #[inline]
    fn mix(self, under: Self, alpha: u8) -> Self {
        let green = mix_lanes(self.0 >> 8 & 0xff, under.0 >> 8 & 0xff, alpha);
        Self(mix_lanes(self.0 & LANES, under.0 & LANES, alpha) | green << 8)
    }

    #[inline]
    fn add(self, under: Self) -> Self {
        let green = add_lanes(self.0 >> 8 & 0xff, under.0 >> 8 & 0xff);
        Self(add_lanes(self.0 & LANES, under.0 & LANES) | green << 8)
    }
}

/// One channel of up to 8 bits, with a maximum.
macro_rules! one_channel {
    ($($color:ident),+) => {$(
        impl Mix for $color {
            #[inline]
            #[expect(clippy::cast_possible_truncation, reason = "a lane is 8 bits")]
            fn mix(self, under: Self, alpha: u8) -> Self {
                Self(mix_lanes(u32::from(self.0), u32::from(under.0), alpha) as u8)
            }

            #[inline]
            fn add(self, under: Self) -> Self {
                Self(self.0.saturating_add(under.0).min(Self::WHITE.0))
            }
        }
    )+};
}

one_channel!(Gray8, Gray4, Binary);

#[cfg(test)]
mod tests {
    use super::*;

    /// The nearest to `(c a + u (255 - a)) / 255`, by a division.
    fn mixed(c: u8, u: u8, a: u8) -> u8 {
        let [c, u, a] = [c, u, a].map(u32::from);
        ((2 * (c * a + u * (255 - a)) + 255) / 510) as u8
    }

    #[test]
    fn few_levels_mix_and_add_too() {
        for alpha in 0..=255 {
            for c in 0..16 {
                for u in 0..16 {
                    let (color, under) = (Gray4(c), Gray4(u));
                    assert_eq!(color.mix(under, alpha), Gray4(mixed(c, u, alpha)));
                    assert_eq!(color.add(under), Gray4((c + u).min(15)));
                }
            }
            let lit = Binary::WHITE.mix(Binary::BLACK, alpha);
            assert_eq!(lit, Binary(u8::from(alpha >= 128)));
        }
        assert_eq!(Binary::WHITE.add(Binary::WHITE), Binary::WHITE);
    }

    /// Every channel's every value over every other with every alpha, beside different ones in the other channels.
    #[test]
    fn mixes_are_the_nearest() {
        for alpha in 0..=255 {
            for c in 0..=255u8 {
                for u in 0..=255u8 {
                    let (d, v) = (c.wrapping_mul(89) ^ 0x5a, u.wrapping_mul(151).wrapping_add(7));
                    let gray = Gray8(c).mix(Gray8(u), alpha);
                    assert_eq!(gray, Gray8(mixed(c, u, alpha)), "{c} over {u}, {alpha}");
                    let color = Rgb888::new(c, d, 255 - c).mix(Rgb888::new(u, v, c), alpha);
                    let exact = [(c, u), (d, v), (255 - c, c)].map(|(c, u)| mixed(c, u, alpha));
                    let [r, g, b] = exact;
                    assert_eq!(color, Rgb888::new(r, g, b), "{c} over {u}, {alpha}");
                    if c < 64 && u < 64 {
                        let (d, v) = (d & 31, v & 31);
                        let [over, under] = [Rgb565::new(d, c, c & 31), Rgb565::new(v, u, u & 31)];
                        let color = over.mix(under, alpha);
                        let exact = [(d, v), (c, u), (c & 31, u & 31)];
                        let [r, g, b] = exact.map(|(c, u)| mixed(c, u, alpha));
                        assert_eq!(color, Rgb565::new(r, g, b), "{over:?} {under:?} {alpha}");
                    }
                }
            }
        }
    }

    #[test]
    fn nothing_and_all_are_exact() {
        for word in 0..=u16::MAX {
            let (one, other) = (Rgb565(word), Rgb565(word.wrapping_mul(40_503)));
            assert_eq!(Alpha { color: one, alpha: 255 }.over(other), one);
            assert_eq!(Alpha { color: one, alpha: 0 }.over(other), other);
            assert_eq!(Alpha { color: one, alpha: word as u8 }.over(one), one);
            assert_eq!(Add(one).over(Rgb565::BLACK), one);
            assert_eq!(Add(one).over(Rgb565::WHITE), Rgb565::WHITE);
        }
        // What is above 24 bits is no colour.
        let stray = Rgb888(0xff12_3456);
        assert_eq!(stray.mix(Rgb888::WHITE, 255), Rgb888(0x12_3456));
        assert_eq!(Rgb888::BLACK.mix(stray, 0), Rgb888(0x12_3456));
        assert_eq!(stray.add(stray), Rgb888(0x24_68ac));
    }

    #[test]
    fn sums_stop_at_the_maximum_of_each_channel() {
        for c in 0..=255u8 {
            for u in 0..=255u8 {
                let (d, v) = (c.wrapping_mul(89), u.wrapping_mul(151));
                let sum =
                    |c: u8, u: u8, max: u8| (u32::from(c) + u32::from(u)).min(max.into()) as u8;
                assert_eq!(Gray8(c).add(Gray8(u)), Gray8(sum(c, u, 255)));
                let exact = Rgb888::new(sum(c, u, 255), sum(d, v, 255), sum(u, d, 255));
                assert_eq!(Rgb888::new(c, d, u).add(Rgb888::new(u, v, d)), exact);
                let ([c, d], [u, v]) = ([c & 63, d & 31], [u & 63, v & 31]);
                let exact = Rgb565::new(sum(d, v, 31), sum(c, u, 63), sum(c & 31, d, 31));
                assert_eq!(Rgb565::new(d, c, c).add(Rgb565::new(v, u, d)), exact);
            }
        }
    }
}
