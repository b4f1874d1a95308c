//! Shaders of plain colours as shaders of merges.

use super::{Add, Alpha};
use crate::color::Lane;
use crate::fragment::{Fragment, Sample};

/// A shader whose colours cover a part of what is there, in 255ths: 0 nothing, 255 all. It is shaded as it is, in the same
/// way and at the same cost; the mixing is the target's ([`Blended`](crate::Blended), [`Over`](crate::Over)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Translucent<S>(pub S, pub u8);

/// A shader whose colours are added to what is there. It is shaded as it is; the adding is the target's
/// ([`Blended`](crate::Blended)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Additive<S>(pub S);

impl<C: Copy, S: Fragment<C, N>, const N: usize> Fragment<Alpha<C>, N> for Translucent<S> {
    const UNIFORM: bool = S::UNIFORM;
    const TOLERANCE: u32 = S::TOLERANCE;
    const DISCARDS: bool = S::DISCARDS;
    const LANES: Option<[Lane; N]> = S::LANES;
    const WRAPS: bool = S::WRAPS;
    const DITHERED: bool = S::DITHERED;

    #[inline]
    fn shade(&self, sample: Sample<N>) -> Alpha<C> {
        Alpha { color: self.0.shade(sample), alpha: self.1 }
    }

    #[inline]
    fn shade_or_discard(&self, sample: Sample<N>) -> Option<Alpha<C>> {
        Some(Alpha { color: self.0.shade_or_discard(sample)?, alpha: self.1 })
    }

    #[inline]
    fn shade_lanes(&self, word: u32, x: i32, y: i32) -> Option<Alpha<C>> {
        Some(Alpha { color: self.0.shade_lanes(word, x, y)?, alpha: self.1 })
    }

    #[inline]
    fn for_face(self, index: usize) -> Self {
        Self(self.0.for_face(index), self.1)
    }
}

impl<C: Copy, S: Fragment<C, N>, const N: usize> Fragment<Add<C>, N> for Additive<S> {
    const UNIFORM: bool = S::UNIFORM;
    const TOLERANCE: u32 = S::TOLERANCE;
    const DISCARDS: bool = S::DISCARDS;
    const LANES: Option<[Lane; N]> = S::LANES;
    const WRAPS: bool = S::WRAPS;
    const DITHERED: bool = S::DITHERED;

    #[inline]
    fn shade(&self, sample: Sample<N>) -> Add<C> {
        Add(self.0.shade(sample))
    }

    #[inline]
    fn shade_or_discard(&self, sample: Sample<N>) -> Option<Add<C>> {
        self.0.shade_or_discard(sample).map(Add)
    }

    #[inline]
    fn shade_lanes(&self, word: u32, x: i32, y: i32) -> Option<Add<C>> {
        self.0.shade_lanes(word, x, y).map(Add)
    }

    #[inline]
    fn for_face(self, index: usize) -> Self {
        Self(self.0.for_face(index))
    }
}
