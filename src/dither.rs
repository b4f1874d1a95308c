//! Ordered dithering: what a colour of few bits loses, spread over a 4 x 4 pattern of pixels.
//!
//! A channel is `floor(u max + t)`, with a threshold `t` of `1/32, 3/32 ... 31/32` from the pixel's place instead of the half
//! that rounds to nearest: so the mean over any 4 x 4 pixels of one `u` is within 1/32 of a step of `u max`, where rounding is
//! off by up to half of one; each pixel is off by up to 31/32. The pattern is Bayer's (1973): each
//! threshold is as far as can be from those next to it.

use crate::color::{Binary, Gray4, Lane, Luminance, PixelFormat, Rgb565, Rgb888, luma};
use crate::fragment::{Fragment, Gouraud, Sample, Textured};
use crate::math::unsigned;
use crate::texture::{Address, Sampling};
use fixed::types::I16F16;

/// A shader whose colours are dithered: [`Gouraud`], or [`Textured`], to RGB565, or in luminance to [`Gray4`] or [`Binary`].
/// Texels are [`Rgb888`], and for luminance [`Gray8`](crate::Gray8) too.
///
/// ```
/// use hither::{Binary, Dithered, Fragment, Gouraud, Gray4, Gray8, Rgb565, Rgb888, Texture, Textured};
///
/// fn takes<C: Copy, const N: usize>(_: impl Fragment<C, N>) {}
/// takes::<Rgb565, 3>(Dithered(Gouraud));
/// takes::<Gray4, 3>(Dithered(Gouraud));
/// takes::<Binary, 3>(Dithered(Gouraud));
/// let texture = Texture::<Rgb888>::try_new(&[0], 1, 1)?;
/// takes::<Rgb565, 2>(Dithered(Textured(texture)));
/// takes::<Gray4, 2>(Dithered(Textured(texture)));
/// let texture = Texture::<Gray8>::try_new(&[0], 1, 1)?;
/// takes::<Binary, 2>(Dithered(Textured(texture.clamped().bilinear())));
/// # Ok::<(), hither::TextureSize>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dithered<F>(pub F);

/// Bayer's order of 4 x 4 pixels, row by row: each 0 to 15.
const ORDER: [u8; 16] = [0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5];

/// How far the threshold of a pixel is from a half, in 32nds: odd, -15 to 15.
#[inline]
fn offset(x: i32, y: i32) -> i32 {
    let at = ((y & 3) << 2) | (x & 3);
    2 * ORDER.get(unsigned(at) as usize).map_or(0, |&n| i32::from(n)) - 15
}

/// A channel of 16 bits, `u 2^16` below 2^16, with an offset in 32nds.
#[inline]
fn channel(unit: u32, max: u32, offset: i32) -> u32 {
    (unit * max + unsigned((1 << 15) + (offset << 11))) >> 16
}

/// Channels in units of 2^-16, below 1.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "channels are 5 and 6 bits")]
fn dithered([r, g, b]: [u32; 3], x: i32, y: i32) -> Rgb565 {
    let offset = offset(x, y);
    let [r, g, b] = [channel(r, 31, offset), channel(g, 63, offset), channel(b, 31, offset)];
    Rgb565((r << 11 | g << 5 | b) as u16)
}

impl Fragment<Rgb565, 3> for Dithered<Gouraud> {
    const TOLERANCE: u32 = <Gouraud as Fragment<Rgb565, 3>>::TOLERANCE;
    const LANES: Option<[Lane; 3]> = <Gouraud as Fragment<Rgb565, 3>>::LANES;
    const DITHERED: bool = true;

    #[inline]
    fn shade(&self, sample: Sample<3>) -> Rgb565 {
        let unit = |u: I16F16| unsigned(u.to_bits().clamp(0, 0xffff));
        dithered(sample.varyings.map(unit), sample.x, sample.y)
    }

    /// A lane is at most 1/32 too small, by what is cut, and is `u max + 1/2`: with an offset of -15/32 to 15/32 it is
    /// between 0 and `max + 1`, so that nothing is borrowed from another.
    #[inline]
    fn shade_lanes(&self, word: u32, x: i32, y: i32) -> Option<Rgb565> {
        /// A 32nd in each lane of RGB565.
        const EACH: u32 = 1 << 21 | 1 << 11 | 1;
        let offset = unsigned(offset(x, y)).wrapping_mul(EACH);
        Gouraud.shade_lanes(word.wrapping_add(offset), x, y)
    }
}

impl<F, A, Q> Fragment<Rgb565, 2> for Dithered<Textured<'_, F, A, Q>>
where
    F: PixelFormat<Color = Rgb888>,
    A: Address,
    Q: Sampling<F>,
{
    #[inline]
    fn shade(&self, sample: Sample<2>) -> Rgb565 {
        let Rgb888(texel) = self.0.shade(sample);
        // 255 as just below 1.
        let unit = |byte: u32| (byte & 0xff) * 257;
        dithered([unit(texel >> 16), unit(texel >> 8), unit(texel)], sample.x, sample.y)
    }
}

/// A luma of 24 bits, below 1, as one of `max + 1` levels; `max` is at most 15.
#[inline]
fn level(luma: u32, max: u32, x: i32, y: i32) -> u8 {
    ((luma * max + unsigned((1 << 23) + (offset(x, y) << 19))) >> 24) as u8
}

/// Dithering of luminance to a few levels: one product for a luma of three, and one for the level.
macro_rules! to_levels {
    ($color:ident, $max:literal) => {
        impl Fragment<$color, 3> for Dithered<Gouraud> {
            const TOLERANCE: u32 = <Gouraud as Fragment<$color, 3>>::TOLERANCE;
            const DITHERED: bool = true;

            #[inline]
            fn shade(&self, sample: Sample<3>) -> $color {
                $color(level(luma(sample.varyings), $max, sample.x, sample.y))
            }
        }

        impl<F, A, Q> Fragment<$color, 2> for Dithered<Textured<'_, F, A, Q>>
        where
            F: PixelFormat<Color: Luminance + Default>,
            A: Address,
            Q: Sampling<F>,
        {
            #[inline]
            fn shade(&self, sample: Sample<2>) -> $color {
                $color(level(self.0.shade(sample).luma(), $max, sample.x, sample.y))
            }
        }
    };
}

to_levels!(Gray4, 15);
to_levels!(Binary, 1);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Gray8;
    use crate::{
        Affine, ClipVertex, Correction, DividedBy, Exact, Frame, Framebuffer, Hither, Packed,
        Perspective, PerspectiveEvery, Quick, Table, Tier,
    };

    /// The mean over each 4 x 4 pixels of a quad of one colour.
    fn means<T: Tier, I: Correction>(color: [i32; 3]) -> [f64; 3] {
        let mut words = [0; 64];
        let buffer = Framebuffer::<Rgb565>::try_new(&mut words, 8, 8).unwrap();
        let frame = Frame::new(buffer).unwrap().with_hither(Hither::new(I16F16::ONE).unwrap());
        let mut frame = frame.with_tier(T::default()).with_correction(I::default());
        let corner = |x: i32, y: i32, w: i32| {
            let at = |v: i32| I16F16::from_num(v * w);
            let vertex = ClipVertex::new(at(x), at(y), I16F16::ZERO, I16F16::from_num(w));
            (vertex, color.map(I16F16::from_bits))
        };
        frame.draw_triangle(
            [corner(-1, -1, 1), corner(3, -1, 2), corner(-1, 3, 2)],
            &Dithered(Gouraud),
        );
        let mut means = [0.0; 3];
        for word in words {
            let color = Rgb565(word);
            for (mean, channel) in means.iter_mut().zip([color.r(), color.g(), color.b()]) {
                *mean += f64::from(channel) / 64.0;
            }
        }
        means
    }

    /// From bright to dark and back in one grey, with a short reciprocal: no channel passes an end and goes on at the other.
    #[test]
    fn channels_at_their_ends_stay_there() {
        for i in 0..600 {
            let mut words = [0; 32 * 32];
            let buffer = Framebuffer::<Rgb565>::try_new(&mut words, 32, 32).unwrap();
            let frame = Frame::new(buffer).unwrap().with_hither(Hither::new(I16F16::ONE).unwrap());
            let mut frame = frame.with_tier(Exact).with_correction(DividedBy(Perspective, Table));
            let corner = |x: i32, y: i32, w: i32, u: i32| {
                let at = |v: i32| I16F16::from_bits((v * w) << 10);
                let w = I16F16::from_num(w);
                (ClipVertex::new(at(x), at(y), I16F16::ZERO, w), [I16F16::from_bits(u); 3])
            };
            let (right, left) = if i % 2 == 0 { (1 << 16, 0) } else { (0, 1 << 16) };
            let (x, w) = (i % 37 - 60, 2 + i % 11);
            let corners = [
                corner(60, -60, 1 + i % 13, right),
                corner(x, 60 - i % 7, w, left),
                corner(x, -60, w + i % 3, left),
            ];
            frame.draw_triangle(corners, &Dithered(Gouraud));
            for word in words {
                let color = Rgb565(word);
                let level = [color.r(), color.g() / 2, color.b()].map(i32::from);
                let spread = level.iter().max().unwrap() - level.iter().min().unwrap();
                assert!(spread <= 1, "{color:?} in {i}");
            }
        }
    }

    #[test]
    fn means_are_within_a_32nd_of_a_step() {
        for u in (0..=1 << 16).step_by(331).chain([1, 65_535, 65_536]) {
            let color = [u, 65_536 - u, u / 2];
            let exact = [31, 63, 31].map(f64::from);
            for means in [
                means::<Exact, Perspective>(color),
                means::<Exact, Affine>(color),
                means::<Quick<8>, Perspective>(color),
                means::<Quick<8>, Packed<Affine>>(color),
                means::<Quick<4>, Packed<PerspectiveEvery<8>>>(color),
                means::<Quick<8>, PerspectiveEvery<16>>(color),
            ] {
                for i in 0..3 {
                    let exact = exact[i] * f64::from(color[i]) / 65_536.0;
                    let off = (means[i] - exact).abs();
                    // Lanes cut 1/32 more.
                    assert!(off <= 2.0 / 32.0 + 1e-3, "{color:?}: {means:?}");
                }
            }
        }
    }

    /// The mean over each 4 x 4 pixels of a quad of one colour, of few levels.
    fn level_mean<F: PixelFormat<Word = u8, Color: Copy>, T: Tier, I: Correction>(
        color: [i32; 3],
    ) -> f64
    where
        Dithered<Gouraud>: Fragment<F::Color, 3>,
    {
        let mut words = [0; 64];
        let buffer = Framebuffer::<F>::try_new(&mut words, 8, 8).unwrap();
        let frame = Frame::new(buffer).unwrap().with_hither(Hither::new(I16F16::ONE).unwrap());
        let mut frame = frame.with_tier(T::default()).with_correction(I::default());
        let corner = |x: i32, y: i32, w: i32| {
            let at = |v: i32| I16F16::from_num(v * w);
            let vertex = ClipVertex::new(at(x), at(y), I16F16::ZERO, I16F16::from_num(w));
            (vertex, color.map(I16F16::from_bits))
        };
        let corners = [corner(-1, -1, 1), corner(3, -1, 2), corner(-1, 3, 2)];
        frame.draw_triangle(corners, &Dithered(Gouraud));
        words.into_iter().map(f64::from).sum::<f64>() / 64.0
    }

    /// As for colours: a varying is up to 2^-14 off, and a threshold is the middle of a 16th.
    #[test]
    fn means_of_few_levels_are_within_a_32nd_of_a_step() {
        for u in (0..=1 << 16).step_by(463).chain([1, 65_535, 65_536]) {
            let color = [u, 65_536 - u, u / 2];
            let [r, g, b] = color.map(f64::from);
            for (color, luma) in [
                (color, (77.0 * r + 150.0 * g + 29.0 * b) / f64::from(1 << 24)),
                ([u; 3], r / 65_536.0),
            ] {
                for (max, mean) in [
                    (15.0, level_mean::<Gray4, Exact, Perspective>(color)),
                    (15.0, level_mean::<Gray4, Quick<8>, Packed<PerspectiveEvery<8>>>(color)),
                    (1.0, level_mean::<Binary, Exact, Perspective>(color)),
                    (1.0, level_mean::<Binary, Quick<4>, Packed<Affine>>(color)),
                ] {
                    let off = (mean - luma * max).abs();
                    assert!(off <= 1.0 / 32.0 + max / 4096.0, "{color:?}: {mean} of {max}");
                }
            }
        }
        for (color, black) in [([0; 3], true), ([65_536; 3], false)] {
            let mean = level_mean::<Gray4, Exact, Perspective>(color);
            assert_eq!(mean, if black { 0.0 } else { 15.0 });
            let mean = level_mean::<Binary, Exact, Perspective>(color);
            assert_eq!(mean, if black { 0.0 } else { 1.0 });
        }
    }

    #[test]
    fn texels_are_dithered_to_few_levels() {
        for grey in 0..=255u8 {
            let texels = [grey];
            let texture = crate::Texture::<Gray8>::try_new(&texels, 1, 1).unwrap();
            let shader = Dithered(Textured(texture));
            let (mut levels, mut lit) = (0.0, 0.0);
            for at in 0..16 {
                let sample = Sample { x: at & 3, y: at >> 2, varyings: [I16F16::ZERO; 2] };
                let color: Gray4 = shader.shade(sample);
                levels += f64::from(color.0) / 16.0;
                let color: Binary = shader.shade(sample);
                lit += f64::from(color.0) / 16.0;
            }
            let unit = f64::from(grey) / 255.0;
            assert!((levels - unit * 15.0).abs() <= 1.0 / 32.0 + 1e-3, "{grey}: {levels}");
            assert!((lit - unit).abs() <= 1.0 / 32.0 + 1e-4, "{grey}: {lit}");
            assert!((grey > 0 || levels + lit == 0.0) && (grey < 255 || levels + lit == 16.0));
        }
    }

    #[test]
    fn texels_of_24_bits_are_dithered() {
        let texels = [0xff_80_04_u32];
        let texture = crate::Texture::<Rgb888>::try_new(&texels, 1, 1).unwrap();
        let shader = Dithered(Textured(texture));
        let mut sums = [0; 3];
        for at in 0..16 {
            let sample = Sample { x: at & 3, y: at >> 2, varyings: [I16F16::ZERO; 2] };
            let color: Rgb565 = shader.shade(sample);
            for (sum, channel) in sums.iter_mut().zip([color.r(), color.g(), color.b()]) {
                *sum += u32::from(channel);
            }
        }
        let exact = [255.0 * 31.0, 128.0 * 63.0, 4.0 * 31.0].map(|v| v / 255.0 * 16.0);
        for (sum, exact) in sums.into_iter().zip(exact) {
            assert!((f64::from(sum) - exact).abs() <= 1.0, "{sums:?}");
        }
    }
}
