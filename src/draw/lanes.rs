//! Colours whose channels are stepped as one word: three additions and a conversion for one of each.
//!
//! A lane holds `u max + 1/2` in a whole number and 5 or 6 bits of fraction. Its first value is floored, and its step is
//! rounded to a part in 2^6: over [`LENGTH`] pixels that adds up to 1/32 + 23/64 of a step of the colour, beside the half
//! that rounding takes: within one. While a lane is between 0 and `max + 1` nothing is borrowed between lanes; where the
//! varyings are in `[0, 1]` at the vertices, the half gives 1/2 to spare at both ends.

use super::shade::Pixels;
use crate::color::Lane;
use crate::fragment::Fragment;
use crate::interpolation::{Followed, Run};
use crate::math::{bits, unsigned};
use crate::setup::{Plane, Slopes};
use crate::vertex::{Snap, Vertex};
use fixed::types::I16F16;

/// Pixels that are stepped from one start.
pub(super) const LENGTH: i32 = 24;

/// The lanes of one triangle: each a plane of its own, its whole number at the top of 32 bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lanes<const N: usize> {
    each: [(Lane, Plane); N],
    /// The word's step a pixel.
    step: u32,
}

/// The lanes along a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word {
    at: u32,
    step: u32,
}

/// The same channels along a row, each stepped by itself with all bits of its plane: within half a step of the colour and
/// what the plane is off.
#[derive(Clone, Copy, Debug)]
pub(super) struct Channels<const N: usize> {
    at: [u32; N],
    step: [u32; N],
}

/// Channels that are divided at each pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Divided<'a, const N: usize>(pub(super) Followed<'a, N>);

impl<const N: usize> Lanes<N> {
    /// The planes through three vertices whose varyings are in `[0, 1]`, where they have some.
    #[inline]
    pub(super) fn new<T: Snap, const P: usize>(
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
        lanes: [Lane; N],
    ) -> Option<Self> {
        let mut all = Self { each: lanes.map(|lane| (lane, Plane::default())), step: 0 };
        let [a, b, c] = vertices.map(|v| &v.varyings);
        for ((((lane, plane), a), b), c) in all.each.iter_mut().zip(a).zip(b).zip(c) {
            let [u, v, w] = [a, b, c].map(|u: &I16F16| u.to_bits());
            if unsigned(u) > 1 << 16 || unsigned(v) > 1 << 16 || unsigned(w) > 1 << 16 {
                return None;
            }
            // u max 2^(32 - bits), and a difference in twice that: both below 2^32, and 2^31 in magnitude.
            let scale = ((1 << lane.bits) - 1) << (15 - lane.bits);
            let value = ((unsigned(u) * unsigned(scale)) << 1) + (1 << (31 - lane.bits));
            *plane = slopes.plane(value, [(v - u) * scale, (w - u) * scale])?;
            let cut = 32 - lane.width;
            let step = ((bits(plane.x) >> (cut - 1)) + 1) >> 1;
            all.step = all.step.wrapping_add(unsigned(step) << lane.place);
        }
        Some(all)
    }

    /// The same, some pixels further to the right and down.
    #[inline]
    pub(super) fn moved(self, columns: i32, rows: i32) -> Self {
        Self { each: self.each.map(|(lane, plane)| (lane, plane.moved(columns, rows))), ..self }
    }

    /// The channels from a pixel on.
    #[inline]
    pub(super) fn channels(&self, x: i32, y: i32) -> Channels<N> {
        Channels {
            at: self.each.map(|(_, plane)| plane.at(x, y)),
            step: self.each.map(|(_, plane)| plane.x),
        }
    }

    /// The lanes from a pixel on.
    #[inline]
    pub(super) fn word(&self, x: i32, y: i32) -> Word {
        let mut at = 0;
        for (lane, plane) in &self.each {
            at |= plane.at(x, y) >> (32 - lane.width) << lane.place;
        }
        Word { at, step: self.step }
    }
}

impl<C: Copy, F: Fragment<C, N>, const N: usize> Pixels<C, F, N> for Word {
    #[inline]
    fn color(&self, fragment: &F, _: i32, _: i32) -> C {
        fragment.shade_lanes(self.at)
    }

    #[inline]
    fn step(&mut self) {
        self.at = self.at.wrapping_add(self.step);
    }
}

impl<C: Copy, F: Fragment<C, N>, const N: usize> Pixels<C, F, N> for Channels<N> {
    #[inline]
    fn color(&self, fragment: &F, _: i32, _: i32) -> C {
        let mut word = 0;
        for (lane, at) in F::LANES.iter().flatten().zip(self.at) {
            word |= at >> (32 - lane.width) << lane.place;
        }
        fragment.shade_lanes(word)
    }

    #[inline]
    fn step(&mut self) {
        for (at, step) in self.at.iter_mut().zip(self.step) {
            *at = at.wrapping_add(step);
        }
    }
}

impl<C: Copy, F: Fragment<C, N>, const N: usize> Pixels<C, F, N> for Divided<'_, N> {
    #[inline]
    fn color(&self, fragment: &F, _: i32, _: i32) -> C {
        let mut word = 0;
        for (lane, at) in F::LANES.iter().flatten().zip(self.0.fractions()) {
            word |= at >> (24 - lane.width) << lane.place;
        }
        fragment.shade_lanes(word)
    }

    #[inline]
    fn step(&mut self) {
        Run::step(&mut self.0);
    }
}
