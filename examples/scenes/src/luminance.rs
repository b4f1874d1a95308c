//! Colour to grey: a scene of RGB565 colours on a target of luminances.

use hither::{Gray8, Rgb565, Target};

/// A grey target that takes colours: what is drawn is written as its [`luminance`].
///
/// ```
/// use hither::{Frame, Framebuffer, Gray8, Rgb565};
/// use hither_scenes::luminance::Luminance;
///
/// let mut gray = [0; 16 * 8];
/// let mut frame = Frame::new(Luminance(Framebuffer::<Gray8>::try_new(&mut gray, 16, 8)?))?;
/// frame.clear(Rgb565::RED);
/// assert_eq!(gray, [77; 16 * 8]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Luminance<T>(pub T);

impl<T: Target<Color = Gray8>> Target for Luminance<T> {
    type Color = Rgb565;

    #[inline]
    fn size(&self) -> (u32, u32) {
        self.0.size()
    }

    #[inline]
    fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<Rgb565>>) {
        self.0.write(x, y, colors.map(|color| color.map(luminance)));
    }

    #[inline]
    fn fill(&mut self, x: usize, y: usize, length: usize, color: Rgb565) {
        self.0.fill(x, y, length, luminance(color));
    }

    fn clear(&mut self, color: Rgb565) {
        self.0.clear(luminance(color));
    }
}

/// Luma by Rec. 601, 0.299 r + 0.587 g + 0.114 b with weights of 77, 150 and 29 of 256, rounded to
/// nearest once: 0 for black, 255 for white.
#[inline]
#[must_use]
pub const fn luminance(color: Rgb565) -> Gray8 {
    /// The weights' sum times the largest red (or blue) and green: white before it is scaled.
    const WHITE: u32 = 256 * 31 * 63;
    let (r, g, b) = (color.r() as u32, color.g() as u32, color.b() as u32);
    // At most WHITE; 255 times that has 27 bits.
    let sum = (77 * r + 29 * b) * 63 + 150 * g * 31;
    Gray8(((sum * 255 + WHITE / 2) / WHITE) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hither::Framebuffer;

    #[test]
    fn every_colour_is_within_half_a_step_of_its_luma() {
        for word in 0..=u16::MAX {
            let color = Rgb565(word);
            let [r, g, b] = [(color.r(), 31.0), (color.g(), 63.0), (color.b(), 31.0)]
                .map(|(channel, max)| f64::from(channel) * 255.0 / max);
            let exact = (77.0 * r + 150.0 * g + 29.0 * b) / 256.0;
            let error = f64::from(luminance(color).0) - exact;
            assert!(error.abs() <= 0.5 + 1e-9, "{color:?}: {error}");
        }
        assert_eq!(luminance(Rgb565::BLACK), Gray8::BLACK);
        assert_eq!(luminance(Rgb565::WHITE), Gray8::WHITE);
    }

    #[test]
    fn runs_fills_and_skipped_pixels_go_through() {
        let mut gray = [9; 6];
        let mut target = Luminance(Framebuffer::<Gray8>::try_new(&mut gray, 3, 2).unwrap());
        assert_eq!(target.size(), (3, 2));
        target.write(0, 0, [Some(Rgb565::WHITE), None, Some(Rgb565::GREEN)].into_iter());
        target.fill(1, 1, 2, Rgb565::BLUE);
        assert_eq!(gray, [255, 9, 149, 9, 29, 29]);
        Luminance(Framebuffer::<Gray8>::try_new(&mut gray, 3, 2).unwrap()).clear(Rgb565::RED);
        assert_eq!(gray, [77; 6]);
    }
}
