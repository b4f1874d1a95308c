//! The viewport: how large the picture is, where in the buffer it lies, and what part may be drawn.

use crate::math::Scale;
use fixed::types::I16F16;

/// A rectangle of pixels: `x0 <= x < x1`, `y0 <= y < y1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rect {
    /// First column.
    pub x0: i32,
    /// First row.
    pub y0: i32,
    /// One past the last column.
    pub x1: i32,
    /// One past the last row.
    pub y1: i32,
}

impl Rect {
    /// What two rectangles share; possibly empty.
    #[inline]
    #[must_use]
    pub fn intersect(self, other: Self) -> Self {
        Self {
            x0: self.x0.max(other.x0),
            y0: self.y0.max(other.y0),
            x1: self.x1.min(other.x1),
            y1: self.y1.min(other.y1),
        }
    }

    /// The smallest rectangle that holds both; the other one, where one is empty.
    #[inline]
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        if other.is_empty() {
            return self;
        }
        if self.is_empty() {
            return other;
        }
        Self {
            x0: self.x0.min(other.x0),
            y0: self.y0.min(other.y0),
            x1: self.x1.max(other.x1),
            y1: self.y1.max(other.y1),
        }
    }

    /// The same, `x` columns to the right and `y` rows down.
    #[inline]
    pub(crate) const fn moved(self, x: i32, y: i32) -> Self {
        Self { x0: self.x0 + x, y0: self.y0 + y, x1: self.x1 + x, y1: self.y1 + y }
    }

    /// The same with a pixel more on each side.
    #[inline]
    pub(crate) const fn grown(self) -> Self {
        Self { x0: self.x0 - 1, y0: self.y0 - 1, x1: self.x1 + 1, y1: self.y1 + 1 }
    }

    /// Whether all of a box is in it.
    #[inline]
    pub(crate) const fn holds(&self, other: Self) -> bool {
        other.x0 >= self.x0 && other.y0 >= self.y0 && other.x1 <= self.x1 && other.y1 <= self.y1
    }

    /// Whether it holds no pixel.
    #[inline]
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.x0 >= self.x1 || self.y0 >= self.y1
    }
}

/// The picture's size in pixels, its place in the buffer, and its scissor.
///
/// The size is what `[-1, 1]` is stretched over: pixel `(X, Y)` is sampled at its centre,
/// `x_ndc = (2 X + 1) / width - 1` and `y_ndc = 1 - (2 Y + 1) / height`. The origin is where pixel
/// (0, 0) lies in the buffer, possibly outside of it: a band that starts at row 60 of a frame is
/// the frame's viewport with origin (0, -60), and is the same picture to the bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Viewport {
    pub(crate) width: i32,
    pub(crate) height: i32,
    pub(crate) origin: (i32, i32),
    pub(crate) scissor: Rect,
    /// 1 / (width height).
    pub(crate) inverse_area: Scale,
}

impl Viewport {
    /// The largest width and height, in pixels: what the bit budgets of the tiers are proved for.
    pub const MAX_SIDE: u16 = 512;

    /// A viewport over the whole of a `width x height` buffer.
    ///
    /// # Errors
    ///
    /// [`ViewportSize`] where a side is 0 or over [`Viewport::MAX_SIDE`].
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "sides that pass are at most MAX_SIDE")]
    pub fn new(width: u32, height: u32) -> Result<Self, ViewportSize> {
        let fits = |side: u32| side >= 1 && side <= u32::from(Self::MAX_SIDE);
        if !fits(width) || !fits(height) {
            return Err(ViewportSize { width, height });
        }
        let (w, h) = (i32::from(width as u16), i32::from(height as u16));
        Ok(Self {
            width: w,
            height: h,
            origin: (0, 0),
            scissor: Rect { x0: 0, y0: 0, x1: w, y1: h },
            inverse_area: Scale::of(u64::from(width) * u64::from(height)).reciprocal(),
        })
    }

    /// The same, with pixel (0, 0) at `(x, y)` of the buffer.
    #[inline]
    #[must_use]
    pub fn with_origin(self, x: i16, y: i16) -> Self {
        Self { origin: (i32::from(x), i32::from(y)), ..self }
    }

    /// The same, drawing only inside `scissor`, which is in the viewport's own pixels.
    #[inline]
    #[must_use]
    pub fn with_scissor(self, scissor: Rect) -> Self {
        let whole = Rect { x0: 0, y0: 0, x1: self.width, y1: self.height };
        let shown = whole.intersect(scissor);
        // An empty one may have its sides anywhere.
        let none = Rect { x0: 0, y0: 0, x1: 0, y1: 0 };
        Self { scissor: if shown.is_empty() { none } else { shown }, ..self }
    }

    /// Width in pixels.
    #[inline]
    #[must_use]
    #[expect(clippy::cast_sign_loss, reason = "1 to MAX_SIDE")]
    pub const fn width(&self) -> u32 {
        self.width as u32
    }

    /// Height in pixels.
    #[inline]
    #[must_use]
    #[expect(clippy::cast_sign_loss, reason = "1 to MAX_SIDE")]
    pub const fn height(&self) -> u32 {
        self.height as u32
    }

    /// Width by height, as [`Mat4::perspective`](crate::Mat4::perspective) takes it: 1/512 to 512,
    /// rounded down to 2^-16.
    #[inline]
    #[must_use]
    pub const fn aspect(&self) -> I16F16 {
        I16F16::from_bits((self.width << 16) / self.height)
    }

    /// The part of the scissor that a `width x height` buffer holds, in the viewport's pixels.
    pub(crate) fn window(&self, width: u32, height: u32) -> Rect {
        // An origin moves a side by at most 2^15; beyond 2^30 a target is as good as endless.
        let side = |v: u32| i32::try_from(v).unwrap_or(i32::MAX).min(1 << 30);
        let (x, y) = self.origin;
        let buffer = Rect { x0: 0, y0: 0, x1: side(width), y1: side(height) };
        self.scissor.intersect(buffer.moved(-x, -y))
    }
}

/// A viewport's side is 0 or too long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ViewportSize {
    /// The width asked for, in pixels.
    pub width: u32,
    /// The height asked for, in pixels.
    pub height: u32,
}

impl core::fmt::Display for ViewportSize {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { width, height } = self;
        write!(f, "a viewport of {width} x {height} pixels: sides are 1 to {}", Viewport::MAX_SIDE)
    }
}

impl core::error::Error for ViewportSize {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn sizes_are_checked() {
        assert!(Viewport::new(1, 512).is_ok());
        assert!(Viewport::new(0, 1).is_err());
        let error = Viewport::new(240, 513).unwrap_err();
        assert_eq!(error.to_string(), "a viewport of 240 x 513 pixels: sides are 1 to 512");
    }

    #[test]
    fn aspect_is_width_by_height() {
        let aspect = |w, h| Viewport::new(w, h).unwrap().aspect();
        assert_eq!(aspect(320, 240), I16F16::from_bits(4 * 65_536 / 3));
        assert_eq!(
            (aspect(512, 1), aspect(1, 512)),
            (I16F16::from_num(512), I16F16::from_bits(128))
        );
    }

    #[test]
    fn a_band_sees_its_rows_only() {
        let band = Viewport::new(240, 240).unwrap().with_origin(0, -60);
        assert_eq!(band.window(240, 20), Rect { x0: 0, y0: 60, x1: 240, y1: 80 });
        assert_eq!(band.window(100, 240), Rect { x0: 0, y0: 60, x1: 100, y1: 240 });
        let off = band.with_scissor(Rect { x0: -9, y0: 0, x1: 999, y1: 60 });
        assert!(off.window(240, 20).is_empty());
        let far = Rect { x0: i32::MAX, y0: i32::MIN, x1: i32::MIN, y1: i32::MAX };
        assert!(band.with_origin(i16::MAX, 9).with_scissor(far).window(240, 20).is_empty());
    }
}
