//! Colours to and from embedded-graphics' own, at the edge: those are not plain words, so they
//! cannot be what is stored.

use crate::color::{Binary, Gray4, Gray8, Rgb565, Rgb888};
use embedded_graphics_core::pixelcolor::raw::{RawU8, RawU16, RawU24};
use embedded_graphics_core::pixelcolor::{self, BinaryColor, PixelColor, RgbColor};
use embedded_graphics_core::prelude::{GrayColor, RawData};

/// A colour that displays take, and which of ours is drawn for it: [`Rgb565`] for those of 15 or 16 bits, [`Rgb888`] for 18
/// or 24, [`Gray8`] for 256 or 4 greys, [`Gray4`] for 16, and [`Binary`] for two, converted as embedded-graphics does.
///
/// For a colour that is not among these there is embedded-graphics' `color_converted`, which makes another display of one.
pub trait DisplayColor: PixelColor + From<Self::Drawn> {
    /// What is drawn with.
    type Drawn: Copy;
}

/// A colour of ours that is one of embedded-graphics', bit for bit: a [`Framebuffer`](crate::Framebuffer) of it, in whatever
/// [`PixelFormat`](crate::PixelFormat), is a draw target.
pub trait AsPixelColor: Copy + From<Self::PixelColor> {
    /// embedded-graphics' own.
    type PixelColor: PixelColor;
}

impl From<pixelcolor::Rgb565> for Rgb565 {
    #[inline]
    fn from(color: pixelcolor::Rgb565) -> Self {
        Self(RawU16::from(color).into_inner())
    }
}

impl From<Rgb565> for pixelcolor::Rgb565 {
    #[inline]
    fn from(color: Rgb565) -> Self {
        RawU16::new(color.0).into()
    }
}

impl From<pixelcolor::Rgb888> for Rgb888 {
    #[inline]
    fn from(color: pixelcolor::Rgb888) -> Self {
        Self::new(color.r(), color.g(), color.b())
    }
}

impl From<Rgb888> for pixelcolor::Rgb888 {
    #[inline]
    fn from(color: Rgb888) -> Self {
        RawU24::new(color.0).into()
    }
}

impl From<pixelcolor::Gray8> for Gray8 {
    #[inline]
    fn from(color: pixelcolor::Gray8) -> Self {
        Self(color.luma())
    }
}

impl From<Gray8> for pixelcolor::Gray8 {
    #[inline]
    fn from(color: Gray8) -> Self {
        RawU8::new(color.0).into()
    }
}

impl From<pixelcolor::Gray4> for Gray4 {
    #[inline]
    fn from(color: pixelcolor::Gray4) -> Self {
        Self(color.luma())
    }
}

impl From<Gray4> for pixelcolor::Gray4 {
    #[inline]
    fn from(color: Gray4) -> Self {
        Self::new(color.0)
    }
}

impl From<BinaryColor> for Binary {
    #[inline]
    fn from(color: BinaryColor) -> Self {
        Self(color.is_on().into())
    }
}

impl From<Binary> for BinaryColor {
    #[inline]
    fn from(color: Binary) -> Self {
        (color.0 != 0).into()
    }
}

/// Colours that are the same bits there and here.
macro_rules! drawn_as_the_same {
    ($($color:ident),+) => {$(
        impl DisplayColor for pixelcolor::$color {
            type Drawn = $color;
        }

        impl AsPixelColor for $color {
            type PixelColor = pixelcolor::$color;
        }
    )+};
}

drawn_as_the_same!(Rgb565, Rgb888, Gray8, Gray4);

impl DisplayColor for BinaryColor {
    type Drawn = Binary;
}

impl AsPixelColor for Binary {
    type PixelColor = BinaryColor;
}

/// Colours that embedded-graphics converts to from the one of the same bits as ours.
macro_rules! drawn_as {
    ($drawn:ident: $($color:ident),+) => {$(
        impl From<$drawn> for pixelcolor::$color {
            #[inline]
            fn from(color: $drawn) -> Self {
                pixelcolor::$drawn::from(color).into()
            }
        }

        impl DisplayColor for pixelcolor::$color {
            type Drawn = $drawn;
        }
    )+};
}

drawn_as!(Rgb565: Bgr565, Rgb555, Bgr555);
drawn_as!(Rgb888: Bgr888, Rgb666, Bgr666);
drawn_as!(Gray8: Gray2);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_go_there_and_back() {
        for word in 0..=u16::MAX {
            let ours = Rgb565(word);
            let theirs = pixelcolor::Rgb565::from(ours);
            assert_eq!((theirs.r(), theirs.g(), theirs.b()), (ours.r(), ours.g(), ours.b()));
            assert_eq!(Rgb565::from(theirs), ours);
        }
        let color = pixelcolor::Rgb888::new(1, 2, 3);
        assert_eq!(Rgb888::from(color), Rgb888::new(1, 2, 3));
        assert_eq!(pixelcolor::Rgb888::from(Rgb888::new(1, 2, 3)), color);
        assert_eq!(Gray8::from(pixelcolor::Gray8::from(Gray8(77))), Gray8(77));
        for level in 0..16 {
            let theirs = pixelcolor::Gray4::from(Gray4(level));
            assert_eq!((theirs.luma(), Gray4::from(theirs)), (level, Gray4(level)));
        }
        assert_eq!(
            [Binary::BLACK, Binary::WHITE].map(|v| BinaryColor::from(v).is_on()),
            [false, true]
        );
        assert_eq!(Binary::from(BinaryColor::On), Binary::WHITE);
    }

    #[test]
    fn displays_take_the_nearest() {
        let color = Rgb565::new(3, 41, 30);
        let theirs = pixelcolor::Bgr565::from(color);
        assert_eq!((theirs.r(), theirs.g(), theirs.b()), (3, 41, 30));
        let theirs = pixelcolor::Rgb555::from(color);
        // 41 of 63 is 20.2 of 31.
        assert_eq!((theirs.r(), theirs.g(), theirs.b()), (3, 20, 30));
        let theirs = pixelcolor::Bgr666::from(Rgb888::new(255, 100, 7));
        // 100 and 7 of 255 are 24.7 and 1.7 of 63.
        assert_eq!((theirs.r(), theirs.g(), theirs.b()), (63, 25, 2));
        assert_eq!(pixelcolor::Gray2::from(Gray8(0x7f)).luma(), 1);
    }
}
