//! Colours to and from embedded-graphics' own, at the edge: those are not plain words, so they
//! cannot be what is stored.

use crate::color::{Gray8, Rgb565, Rgb888};
use embedded_graphics_core::pixelcolor::raw::{RawU8, RawU16, RawU24};
use embedded_graphics_core::pixelcolor::{self, RgbColor};
use embedded_graphics_core::prelude::{GrayColor, RawData};

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
    }
}
