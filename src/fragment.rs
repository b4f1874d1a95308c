//! Fragments: from interpolated varyings to a colour.

use crate::color::{FromUnit, Lane, PixelFormat};
use crate::texture::{Address, Nearest, Repeat, Sampling, Texture};
use fixed::types::I16F16;

/// What is known of one covered pixel when it is shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Sample<const N: usize> {
    /// Column, in the viewport's pixels.
    pub x: i32,
    /// Row, in the viewport's pixels, 0 on top.
    pub y: i32,
    /// The interpolated varyings.
    pub varyings: [I16F16; N],
}

/// A shader: colours a pixel from `N` varyings.
///
/// The number of varyings is part of the type, so what a shader does not read costs nothing. A
/// shader with one or more needs a frame with a hither plane.
///
/// ```
/// use hither::{Fragment, Gray8, Sample};
///
/// /// Brightness by one varying in [0, 1].
/// #[derive(Clone, Copy)]
/// struct Glow;
///
/// impl Fragment<Gray8, 1> for Glow {
///     fn shade(&self, sample: Sample<1>) -> Gray8 {
///         Gray8((sample.varyings[0] * 255).round().to_num::<i32>().clamp(0, 255) as u8)
///     }
/// }
/// ```
pub trait Fragment<C: Copy, const N: usize>: Copy {
    /// Whether a whole triangle has one colour, so that spans are filled; so for all with no
    /// varyings, unless a shader looks at the pixel's position.
    const UNIFORM: bool = N == 0;

    /// How far off varyings may be, in raw steps of 2^-16, where [`Packed`](crate::Packed) takes a straight line
    /// over a triangle for a curve: 2^-9, an eighth of a texel on a side of 64.
    const TOLERANCE: u32 = 1 << 7;

    /// The colour at a pixel.
    fn shade(&self, sample: Sample<N>) -> C;

    /// Whether it leaves pixels out, as [`Keyed`] does: then [`shade_or_discard`](Self::shade_or_discard) is asked, no
    /// triangle has one colour, and depth is stored after shading where there is a colour, not before.
    const DISCARDS: bool = false;

    /// The colour at a pixel; `None` where the pixel keeps what it shows, and its depth. Only `None` where
    /// [`DISCARDS`](Self::DISCARDS).
    #[inline]
    fn shade_or_discard(&self, sample: Sample<N>) -> Option<C> {
        Some(self.shade(sample))
    }

    /// Where varyings in `[0, 1]` lie in a word that is stepped as one, if that is worth while.
    #[doc(hidden)]
    const LANES: Option<[Lane; N]> = None;

    /// Whether only the fractions of varyings matter: then they are stepped as one word too, 16 bits each.
    #[doc(hidden)]
    const WRAPS: bool = false;

    /// The colour of such a word at column `x` of row `y`, which texture coordinates are not told; where it has none, the
    /// pixel keeps what it was.
    #[doc(hidden)]
    #[inline]
    fn shade_lanes(&self, _: u32, _: i32, _: i32) -> Option<C> {
        None
    }

    /// Whether the pixel's place changes its colour by up to half a step either way, so that lanes have to be as near as
    /// those that are stepped each by itself.
    #[doc(hidden)]
    const DITHERED: bool = false;

    /// The shader of a face, by its index in the mesh; 0 for a single triangle.
    #[inline]
    #[must_use]
    fn for_face(self, _index: usize) -> Self {
        self
    }
}

/// One colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flat<C>(pub C);

impl<C: Copy> Fragment<C, 0> for Flat<C> {
    #[inline]
    fn shade(&self, _: Sample<0>) -> C {
        self.0
    }
}

/// One colour a face. Faces beyond the end of the slice take the last colour.
#[derive(Clone, Copy, Debug)]
pub struct FaceColors<'a, C> {
    colors: &'a [C],
    current: C,
}

impl<'a, C: Copy> FaceColors<'a, C> {
    /// Colours by face index; `None` where there are none.
    #[must_use]
    pub fn new(colors: &'a [C]) -> Option<Self> {
        colors.last().map(|&current| Self { colors, current })
    }
}

impl<C: Copy> Fragment<C, 0> for FaceColors<'_, C> {
    #[inline]
    fn shade(&self, _: Sample<0>) -> C {
        self.current
    }

    #[inline]
    fn for_face(self, index: usize) -> Self {
        Self { current: self.colors.get(index).copied().unwrap_or(self.current), ..self }
    }
}

/// Colour from three varyings: red, green and blue in `[0, 1]`, each rounded to nearest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Gouraud;

impl<C: FromUnit> Fragment<C, 3> for Gouraud {
    /// 2^-7: a quarter of a step of 5-bit colour.
    const TOLERANCE: u32 = 1 << 9;

    const LANES: Option<[Lane; 3]> = C::LANES;

    #[inline]
    fn shade_lanes(&self, word: u32, _: i32, _: i32) -> Option<C> {
        Some(C::from_lanes(word))
    }

    #[inline]
    fn shade(&self, sample: Sample<3>) -> C {
        C::from_unit(sample.varyings)
    }
}

/// Colour from a texture, sampled as it says, by two varyings `u` and `v`: see [`Texture`].
///
/// With [`Packed`](crate::Packed) a coordinate is stepped by whole 2^-16: up to `N` of those off at the end of a
/// straight piece for an `N` below 8, up to 64 along a line that bends, of which 32 are at its end, and up to 16 where the whole
/// triangle is straight. A texel of a side of 1024 is 64. Beside a whole number, as at the sides of a texture that is shown
/// once, a pixel of a triangle's edge may so be one of the texture's other side.
#[derive(Debug)]
pub struct Textured<'a, F: PixelFormat, A = Repeat, Q = Nearest>(pub Texture<'a, F, A, Q>);

impl<F: PixelFormat, A, Q> Clone for Textured<'_, F, A, Q> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<F: PixelFormat, A, Q> Copy for Textured<'_, F, A, Q> {}

impl<F, A, Q> Fragment<F::Color, 2> for Textured<'_, F, A, Q>
where
    F: PixelFormat<Color: Default>,
    A: Address,
    Q: Sampling<F>,
{
    #[inline]
    fn shade(&self, sample: Sample<2>) -> F::Color {
        let [u, v] = sample.varyings;
        self.0.sample(u, v).unwrap_or_default()
    }

    const WRAPS: bool = A::WRAPS;

    #[inline]
    fn shade_lanes(&self, word: u32, _: i32, _: i32) -> Option<F::Color> {
        Q::at_fractions(&self.0, word)
    }
}

/// A shader whose pixels of one colour, the key, are left out: they keep what they show, and their depth. For cut-outs: leaves,
/// fences, sprites.
///
/// A comparison a pixel, of colours as they are drawn: a texture in a format of the target's colour, sampled nearest. A
/// filtered one is mixed with the key at the cut's edge, and only what is all key is left out.
///
/// ```
/// use hither::{ClipVertex, Frame, Framebuffer, Gray8, Hither, I16F16, Keyed, Texture, Textured};
///
/// let texels = b"#.#..#.##.#..#.#";
/// let texture = Texture::<Gray8>::try_new(texels, 4, 4)?;
/// let mut words = [b' '; 64];
/// let frame = Frame::new(Framebuffer::<Gray8>::try_new(&mut words, 8, 8)?)?;
/// let mut frame = frame.with_hither(Hither::new(I16F16::ONE)?);
/// let corner = |x: f32, y: f32| {
///     let [u, v] = [(x + 1.0) / 2.0, (1.0 - y) / 2.0].map(I16F16::from_num);
///     let [x, y] = [x, y].map(I16F16::from_num);
///     (ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [u, v])
/// };
/// let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(-1.0, 1.0)];
/// frame.draw_triangle(corners, &Keyed(Textured(texture), Gray8(b'.')));
/// let rows: Vec<_> = words.chunks(8).map(|row| core::str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, [
///     "        ",
///     "#       ",
///     "        ",
///     "  #     ",
///     "##      ",
///     "##  #   ",
///     "  ##    ",
///     "  ##  # ",
/// ]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Keyed<S, C>(pub S, pub C);

impl<C: Copy + PartialEq, S: Fragment<C, N>, const N: usize> Fragment<C, N> for Keyed<S, C> {
    const UNIFORM: bool = false;
    const TOLERANCE: u32 = S::TOLERANCE;
    const DISCARDS: bool = true;
    const LANES: Option<[Lane; N]> = S::LANES;
    const WRAPS: bool = S::WRAPS;
    const DITHERED: bool = S::DITHERED;

    #[inline]
    fn shade(&self, sample: Sample<N>) -> C {
        self.0.shade(sample)
    }

    #[inline]
    fn shade_or_discard(&self, sample: Sample<N>) -> Option<C> {
        self.0.shade_or_discard(sample).filter(|color| *color != self.1)
    }

    #[inline]
    fn shade_lanes(&self, word: u32, x: i32, y: i32) -> Option<C> {
        self.0.shade_lanes(word, x, y).filter(|color| *color != self.1)
    }

    #[inline]
    fn for_face(self, index: usize) -> Self {
        Self(self.0.for_face(index), self.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_have_their_colours() {
        assert!(FaceColors::<u8>::new(&[]).is_none());
        let colors = FaceColors::new(&[3u8, 5]).unwrap();
        let at = |i: usize| colors.for_face(i).shade(Sample { x: 0, y: 0, varyings: [] });
        assert_eq!([0, 1, 2].map(at), [3, 5, 5]);
    }
}
