//! How varyings are corrected for perspective, how wide what is stepped along a row is, and what divides: each a type.

use super::reciprocal::{Newton, Reciprocal};

/// How varyings are corrected for perspective: [`Perspective`], [`PerspectiveEvery`] or [`Affine`], and each of these in
/// [`Packed`] or [`Wide`] for its width, and in [`DividedBy`] for its reciprocal.
///
/// ```
/// use hither::{DividedBy, Packed, PerspectiveEvery, Table};
///
/// // Two divisions every 16 pixels by a table alone, what is stepped packed into one word.
/// type Coarse = Packed<DividedBy<PerspectiveEvery<16>, Table>>;
/// # let _ = Coarse::default();
/// ```
pub trait Correction: Copy + Default + core::fmt::Debug {
    /// Pixels between two divisions: 1, or the length of a straight piece.
    const EVERY: i32;
    /// Whether triangles wholly in front of the hither plane are interpolated linearly on the
    /// screen.
    const AFFINE: bool;
    /// How wide what is stepped along a row is.
    const WIDTH: Width = Width::Word;
    /// What divides.
    type Reciprocal: Reciprocal;
}

/// How wide what is stepped along a row is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// All varyings in one word where they fit: see [`Packed`].
    Packed,
    /// A word of 32 bits a varying: 24 of them are value, the rest fraction of its last bit. Varyings beyond ±127 take
    /// [`Width::Long`].
    Word,
    /// 64 bits a varying: see [`Wide`].
    Long,
}

/// Each pixel is divided: within 2^-10 of an attribute's range for `w` up to 4096 hither distances.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Perspective;

/// Two divisions every `N` pixels, straight lines between: `N` is 2 to 64. Where one straight line over the whole
/// triangle is at most 2^-9 off (an eighth of a texel on a side of 64, a sixteenth of a step of 5-bit colour), there is no
/// division.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PerspectiveEvery<const N: u8>;

/// No correction: linear on the screen, for triangles with no vertex behind the hither plane.
/// Another triangle is divided at each pixel, and counted in
/// [`Counts::fallbacks`](crate::Counts::fallbacks).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Affine;

/// For speed, in the quick tiers: what a pixel is made of is stepped as one word where it fits. Colours of RGB565 take 10 or 11
/// bits each and are within 0.9 steps of the straight line they follow, in pieces of N within 1/2 + N / 32;
/// texture coordinates take 16 bits, to 2^-16. What is divided at each pixel is not packed.
///
/// With [`PerspectiveEvery<N>`] a straight line over the whole triangle may be as far off as the fragment allows
/// ([`Fragment::TOLERANCE`](crate::Fragment::TOLERANCE)): half a step of green more. Texture coordinates with `N` of 8 or more: where `1 / w` changes by
/// at most half of itself along 32 pixels, those are divided for once, and the line bends every 8, which is about as near as
/// straight lines of 8; elsewhere lines are straight and 8 long, for an `N` above as well. Triangles whose length is some hundred times
/// their width go in straight lines of `N`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Packed<C>(pub C);

/// For range, in all tiers: varyings are stepped in 64 bits, whatever they are, and triangles by their edge functions. What
/// varyings within ±127 gain by it is below what any fragment shows; it costs several times as much.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wide<C>(pub C);

/// The correction `C` with the reciprocal `R`: [`Table`](crate::Table), [`Newton`], [`Division`](crate::Division) or
/// [`Float`](crate::Float).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DividedBy<C, R>(pub C, pub R);

impl Correction for Perspective {
    const EVERY: i32 = 1;
    const AFFINE: bool = false;
    type Reciprocal = Newton<2>;
}

impl<const N: u8> Correction for PerspectiveEvery<N> {
    const EVERY: i32 = {
        assert!(N >= 2 && N <= 64, "PerspectiveEvery<N>: N is 2 to 64");
        N as i32
    };
    const AFFINE: bool = false;
    type Reciprocal = Newton<2>;
}

impl Correction for Affine {
    const EVERY: i32 = 1;
    const AFFINE: bool = true;
    type Reciprocal = Newton<2>;
}

impl<C: Correction> Correction for Packed<C> {
    const EVERY: i32 = C::EVERY;
    const AFFINE: bool = C::AFFINE;
    const WIDTH: Width = Width::Packed;
    type Reciprocal = C::Reciprocal;
}

impl<C: Correction> Correction for Wide<C> {
    const EVERY: i32 = C::EVERY;
    const AFFINE: bool = C::AFFINE;
    const WIDTH: Width = Width::Long;
    type Reciprocal = C::Reciprocal;
}

impl<C: Correction, R: Reciprocal> Correction for DividedBy<C, R> {
    const EVERY: i32 = C::EVERY;
    const AFFINE: bool = C::AFFINE;
    const WIDTH: Width = C::WIDTH;
    type Reciprocal = R;
}
