//! Colours whose channels are stepped as one word: three additions and a conversion for one of each.
//!
//! A lane holds `u max + 1/2` in a whole number and 5 or 6 bits of fraction. Its first value is floored, and its step is
//! rounded to a part in 2^6: over [`LENGTH`] pixels that adds up to 1/32 + 23/64 of a step of the colour, beside the half
//! that rounding takes: within one. While a lane is between 0 and `max + 1` nothing is borrowed between lanes; where the
//! varyings are in `[0, 1]` at the vertices, the half gives 1/2 to spare at both ends.

use super::shade::Pixels;
use crate::fragment::Fragment;
use crate::interpolation::{Followed, Reciprocal, Run};
use crate::math::{index, signed, unsigned};
use crate::setup::{Plane, Slopes};
use crate::vertex::{Snap, Vertex};
use core::marker::PhantomData;
use fixed::types::I16F16;

/// Pixels that are stepped from one start.
pub(super) const LENGTH: i32 = 24;

/// The lanes of one triangle, which are a fragment's: each a plane of its own, its whole number at the top of 32 bits.
pub(super) struct Lanes<C, F, const N: usize> {
    each: [Plane; N],
    /// The word's step a pixel.
    step: u32,
    fragment: PhantomData<(C, F)>,
}

/// A word along a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word {
    pub(super) at: u32,
    pub(super) step: u32,
}

/// A word along a line that bends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bent {
    pub(super) at: u32,
    pub(super) step: u32,
    /// What is added to the step.
    pub(super) bend: u32,
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
pub(super) struct Divided<'a, R, const N: usize>(pub(super) Followed<'a, R, N>);

impl<C: Copy, F: Fragment<C, N>, const N: usize> Lanes<C, F, N> {
    /// The planes through three vertices whose varyings are in `[0, 1]`, where they have some.
    #[inline]
    pub(super) fn new<T: Snap, const P: usize>(
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
    ) -> Option<Self> {
        let lanes = F::LANES?;
        let mut all = Self { each: [Plane::default(); N], step: 0, fragment: PhantomData };
        let [a, b, c] = vertices.map(|v| &v.varyings);
        for ((((plane, lane), a), b), c) in all.each.iter_mut().zip(lanes).zip(a).zip(b).zip(c) {
            let [u, v, w] = [a, b, c].map(|u: &I16F16| u.to_bits());
            if unsigned(u) > 1 << 16 || unsigned(v) > 1 << 16 || unsigned(w) > 1 << 16 {
                return None;
            }
            // u max 2^(32 - bits), and a difference in twice that: both below 2^32, and 2^31 in magnitude.
            let scale = ((1 << lane.bits) - 1) << (15 - lane.bits);
            let value = ((unsigned(u) * unsigned(scale)) << 1) + (1 << (31 - lane.bits));
            *plane = slopes.plane(value, [(v - u) * scale, (w - u) * scale]);
            let cut = 32 - lane.width;
            let step = ((signed(plane.x) >> (cut - 1)) + 1) >> 1;
            all.step = all.step.wrapping_add(unsigned(step) << lane.place);
        }
        Some(all)
    }

    /// The channels from a pixel on.
    #[inline]
    pub(super) fn channels(&self, x: i32, y: i32) -> Channels<N> {
        Channels { at: self.each.map(|plane| plane.at(x, y)), step: self.each.map(|plane| plane.x) }
    }

    /// The lanes from a pixel on.
    #[inline]
    pub(super) fn word(&self, x: i32, y: i32) -> Word {
        let mut at = 0;
        for (lane, plane) in F::LANES.iter().flatten().zip(&self.each) {
            at |= plane.at(x, y) >> (32 - lane.width) << lane.place;
        }
        Word { at, step: self.step }
    }
}

/// Whether varyings have lanes, and are in `[0, 1]` at three vertices.
#[inline]
pub(super) fn within<C: Copy, F: Fragment<C, N>, T: Snap, const N: usize, const P: usize>(
    vertices: [&Vertex<T, N, P>; 3],
) -> bool {
    let unit = |u: &I16F16| unsigned(u.to_bits()) <= 1 << 16;
    F::LANES.is_some() && vertices.iter().all(|v| v.varyings.iter().all(unit))
}

/// `ceil(2^18 / n)`, 0 for 0.
const INVERSE: [i32; 65] = inverses();

#[expect(clippy::indexing_slicing, reason = "n is below the length; evaluated at compile time")]
const fn inverses() -> [i32; 65] {
    let mut table = [0; 65];
    let (mut n, mut steps) = (1, 1);
    while n < 65 {
        table[n] = ((1 << 18) + steps - 1) / steps;
        (n, steps) = (n + 1, steps + 1);
    }
    table
}

/// `d / steps`, towards 0, for `|d| <= 2^11` and up to 64 steps: the quotient is less than 2^-7 too large, and no fraction of 64ths is
/// as near to 1.
#[inline]
fn per_step(d: i32, steps: i32) -> i32 {
    let inverse = INVERSE.get(index(steps)).copied().unwrap_or(0);
    let up = (d >> 31) & ((1 << 18) - 1);
    (d * inverse + up) >> 18
}

/// The word of a piece, from raw values `first` in `[0, 2^16]` to those `steps` pixels on, 0 to 64.
///
/// A lane's step is towards 0, so that no sum passes the last value: less than a unit of its fraction too small, which over
/// 7 pixels adds up to 7/32 of a step of the colour, and over 31 to nearly one.
#[inline]
pub(super) fn through<C: Copy, F: Fragment<C, N>, const N: usize>(
    first: [i32; N],
    last: [i32; N],
    steps: i32,
) -> Word {
    let mut word = Word { at: 0, step: 0 };
    let ends = first.iter().zip(last);
    for (lane, (&first, last)) in F::LANES.iter().flatten().zip(ends) {
        // u max 2^fraction: below 2^11, from Q16.
        let fraction = lane.width - lane.bits;
        let max = (1 << lane.bits) - 1;
        let scaled = |u: i32| (u * max) >> (16 - fraction);
        let (first, last) = (scaled(first), scaled(last));
        word.at |= unsigned(first + (1 << fraction >> 1)) << lane.place;
        let step = per_step(last - first, steps);
        word.step = word.step.wrapping_add(unsigned(step) << lane.place);
    }
    word
}

impl<C: Copy, F: Fragment<C, N>, const N: usize> Pixels<C, F, N> for Word {
    const AT_ONCE: usize = 2;

    #[inline]
    fn color(&self, fragment: &F, x: i32, y: i32) -> Option<C> {
        fragment.shade_lanes(self.at, x, y)
    }

    #[inline]
    fn step(&mut self) {
        self.at = self.at.wrapping_add(self.step);
    }
}

impl<C: Copy, F: Fragment<C, N>, const N: usize> Pixels<C, F, N> for Bent {
    const AT_ONCE: usize = 1;

    #[inline]
    fn color(&self, fragment: &F, x: i32, y: i32) -> Option<C> {
        fragment.shade_lanes(self.at, x, y)
    }

    #[inline]
    fn step(&mut self) {
        self.at = self.at.wrapping_add(self.step);
    }

    #[inline]
    fn bend(&self) -> u32 {
        self.bend
    }

    #[inline]
    fn bend_by(&mut self, bend: u32) {
        self.step = self.step.wrapping_add(bend);
    }
}

impl<C: Copy, F: Fragment<C, N>, const N: usize> Pixels<C, F, N> for Channels<N> {
    const AT_ONCE: usize = 1;

    #[inline]
    fn color(&self, fragment: &F, x: i32, y: i32) -> Option<C> {
        let mut word = 0;
        for (lane, at) in F::LANES.iter().flatten().zip(self.at) {
            word |= at >> (32 - lane.width) << lane.place;
        }
        fragment.shade_lanes(word, x, y)
    }

    #[inline]
    fn step(&mut self) {
        for (at, step) in self.at.iter_mut().zip(self.step) {
            *at = at.wrapping_add(step);
        }
    }
}

impl<C: Copy, F: Fragment<C, N>, R: Reciprocal, const N: usize> Pixels<C, F, N>
    for Divided<'_, R, N>
{
    const AT_ONCE: usize = 1;

    #[inline]
    fn color(&self, fragment: &F, x: i32, y: i32) -> Option<C> {
        let mut word = 0;
        for (lane, at) in F::LANES.iter().flatten().zip(self.0.fractions()) {
            word |= at >> (24 - lane.width) << lane.place;
        }
        fragment.shade_lanes(word, x, y)
    }

    #[inline]
    fn step(&mut self) {
        Run::step(&mut self.0);
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        ClipVertex, DepthBuffer, Fragment, Frame, Framebuffer, Gouraud, Hither, I16F16, Outcome,
        Packed, PerspectiveEvery, Quick, Rgb565, Snapped, Target, Texture, Textured, Vertex,
    };
    use std::vec::Vec;

    #[test]
    fn steps_are_quotients_towards_zero() {
        for d in -2048..=2048 {
            assert_eq!(super::per_step(d, 0), 0);
            for steps in 1..=64 {
                assert_eq!(super::per_step(d, steps), d / steps, "{d} / {steps}");
            }
        }
    }

    /// Every lane of every pixel of a piece, against the line through its ends.
    #[test]
    fn pieces_are_near_their_lines_and_between_their_ends() {
        let mut below = random();
        let lanes = <Rgb565 as crate::FromUnit>::LANES.unwrap();
        for i in 0..200_000 {
            let end = |n: i32, below: &mut dyn FnMut(i32) -> i32| match n % 4 {
                0 => 0,
                1 => 1 << 16,
                _ => below(65_537),
            };
            let first = [0, 1, 2].map(|n| end(i + n, &mut below));
            let last = [0, 1, 2].map(|n| end(i / 4 + n, &mut below));
            let steps = below(65);
            let word = super::through::<Rgb565, Gouraud, 3>(first, last, steps);
            for k in 0..=steps {
                let sum = word.at.wrapping_add(word.step.wrapping_mul(k as u32));
                for (lane, (u, v)) in lanes.iter().zip(first.into_iter().zip(last)) {
                    let got = sum >> lane.place & ((1 << lane.width) - 1);
                    let unit = f64::from(1 << (lane.width - lane.bits));
                    let got = f64::from(got) / unit - 0.5;
                    let max = f64::from((1 << lane.bits) - 1) / 65_536.0;
                    let at = f64::from(k) / f64::from(steps.max(1));
                    let exact = max * (f64::from(u) + at * f64::from(v - u));
                    assert!(
                        (got - exact).abs() <= f64::from(k + 1) / unit,
                        "{first:?} {last:?} {k}"
                    );
                    let ends = [u, v].map(|u| max * f64::from(u));
                    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
                    assert!(got <= high && got > low - 1.0 / unit, "{first:?} {last:?} {k}");
                }
            }
        }
    }

    const SIDE: u32 = 128;

    /// A triangle's pixels, and the varyings at their centres, linear on the screen, in `f64`: of those that are
    /// surely inside.
    fn drawn<F: Fragment<Rgb565, N>, const N: usize>(
        corners: [([i32; 2], [I16F16; N]); 3],
        fragment: &F,
    ) -> Vec<(Rgb565, [f64; N])> {
        let mut words = [0; (SIDE * SIDE) as usize];
        let buffer = Framebuffer::<Rgb565>::try_new(&mut words, SIDE, SIDE).unwrap();
        let hither = Hither::new(I16F16::ONE).unwrap();
        let frame = Frame::new(buffer).unwrap().with_tier(Quick::<8>).with_hither(hither);
        let mut frame = frame.with_correction(Packed(PerspectiveEvery::<16>));
        let vertices: [Vertex<_, N>; 3] = corners.map(|([x, y], varyings)| {
            let at = |v: i32| I16F16::from_bits(v << 9);
            frame.snap(&ClipVertex::new(at(x), at(y), I16F16::ZERO, I16F16::ONE), varyings)
        });
        let [a, b, c] = &vertices;
        let outcome = frame.draw_snapped([a, b, c], fragment);
        assert!(matches!(outcome, Outcome::Drawn | Outcome::OffScreen | Outcome::ZeroArea));
        let points = vertices.map(|v| match v.snapped() {
            Snapped::Projected { point, .. } => point.map(|v| f64::from(v) / 256.0),
            Snapped::Homogeneous { .. } => panic!("not projected"),
        });
        let cross = |o: [f64; 2], a: [f64; 2], b: [f64; 2]| {
            (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
        };
        let [p, q, r] = points;
        let area = cross(p, q, r);
        let mut pixels = Vec::new();
        for y in 0..SIDE {
            for x in 0..SIDE {
                let at = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                let weights = [cross(at, q, r), cross(at, r, p), cross(at, p, q)].map(|w| w / area);
                if weights.iter().all(|&w| w > 1e-3) {
                    let value = |i: usize| {
                        let of = |k: usize| corners[k].1[i].to_num::<f64>() * weights[k];
                        of(0) + of(1) + of(2)
                    };
                    let color = frame.target().pixel(x, y).unwrap();
                    pixels.push((color, core::array::from_fn(value)));
                }
            }
        }
        pixels
    }

    /// Corners in 2^-7 of half the screen, of triangles of all sizes, some of them thin.
    fn corners(i: u32, mut below: impl FnMut(i32) -> i32) -> [[i32; 2]; 3] {
        let reach = 8 << (i % 5);
        let at = [0, 1].map(|_| below(256) - 128);
        let mut p =
            [[0; 2]; 3].map(|_| at.map(|at| (at + below(2 * reach) - reach).clamp(-128, 127)));
        if i % 4 == 0 {
            p[2] = [p[1][0] + below(3) - 1, p[1][1] + 1];
        }
        p
    }

    fn random() -> impl FnMut(i32) -> i32 {
        let mut state = 5u64;
        move |n| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        }
    }

    #[test]
    fn colours_are_within_a_step_of_the_plane() {
        let (mut below, mut count, mut worst) = (random(), 0, 0.0f64);
        for i in 0..800 {
            let points = corners(i, &mut below);
            let corners = points.map(|point| {
                let channel = [0; 3].map(|_| match below(4) {
                    0 => I16F16::ZERO,
                    1 => I16F16::ONE,
                    _ => I16F16::from_bits(below(65_537)),
                });
                (point, channel)
            });
            for (color, [r, g, b]) in drawn(corners, &Gouraud) {
                for (got, exact) in
                    [(color.r(), 31.0 * r), (color.g(), 63.0 * g), (color.b(), 31.0 * b)]
                {
                    worst = worst.max((f64::from(got) - exact).abs());
                }
                count += 1;
            }
        }
        assert!(count > 100_000, "{count} pixels");
        assert!(worst < 1.0 && worst > 0.5, "{worst} steps");
    }

    /// Texture coordinates far outside of `[0, 1]` and of both signs, on the fractions alone.
    #[test]
    fn wrapped_coordinates_find_their_texels() {
        let texels: Vec<u16> = (0..64 * 32).collect();
        let texture = Texture::<Rgb565>::try_new(&texels, 64, 32).unwrap();
        let (mut below, mut count) = (random(), 0);
        for i in 0..400 {
            let points = corners(i, &mut below);
            let corners = points.map(|point| {
                let repeats = 1 << (16 + i % 6);
                (point, [0; 2].map(|_| I16F16::from_bits(below(2 * repeats) - repeats)))
            });
            for (color, [u, v]) in drawn(corners, &Textured(texture)) {
                // Within an eighth of a texel of a side of 64.
                let near = |got: u32, exact: f64, side: f64| {
                    let off = (f64::from(got) + 0.5 - exact * side).rem_euclid(side);
                    off.min(side - off) < 0.5 + side / 512.0
                };
                let (column, row) = (u32::from(color.0) % 64, u32::from(color.0) / 64);
                assert!(near(column, u, 64.0), "{column} for {u}: {corners:?}");
                assert!(near(row, v, 32.0), "{row} for {v}: {corners:?}");
                count += 1;
            }
        }
        assert!(count > 60_000, "{count} pixels");
    }

    /// A target that has but what it needs.
    struct Bare<'a>(Framebuffer<'a, Rgb565>);

    impl Target for Bare<'_> {
        type Color = Rgb565;

        fn size(&self) -> (u32, u32) {
            self.0.size()
        }

        fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<Rgb565>>) {
            self.0.write(x, y, colors);
        }
    }

    /// Lines that bend are the same without depth, and in a target that steps pixel by pixel.
    #[test]
    fn bent_lines_are_the_same_everywhere() {
        let texels: Vec<u16> = (1..=64 * 64).collect();
        let texture = Textured(Texture::<Rgb565>::try_new(&texels, 64, 64).unwrap());
        let size = (SIDE * SIDE) as usize;
        let (mut below, mut drawn) = (random(), 0);
        for i in 0..90 {
            let points = corners(i, &mut below);
            let clips = points.map(|[x, y]| {
                let w = 1 + below(7);
                let at = |v: i32| I16F16::from_bits(w * (v << 9));
                let uv = [0; 2].map(|_| I16F16::from_bits(below(1 << 17)));
                (ClipVertex::new(at(x), at(y), I16F16::ZERO, I16F16::from_num(w)), uv)
            });
            let hither = Hither::new(I16F16::ONE).unwrap();
            let (mut with, mut without, mut bare) =
                (std::vec![0; size], std::vec![0; size], std::vec![0; size]);
            let (mut one, mut two) = (std::vec![0xffffu16; size], std::vec![0xffffu16; size]);
            let target = |words| Framebuffer::<Rgb565>::try_new(words, SIDE, SIDE).unwrap();
            macro_rules! draw {
                ($target:expr, $depth:expr) => {{
                    let frame = Frame::new($target).unwrap().with_tier(Quick::<8>);
                    let frame =
                        frame.with_hither(hither).with_correction(Packed(PerspectiveEvery::<8>));
                    $depth(frame).draw_triangle(clips, &texture);
                }};
            }
            draw!(target(&mut without), |frame| frame);
            let depth = DepthBuffer::<u16>::try_new(&mut one, SIDE, SIDE).unwrap();
            draw!(target(&mut with), |frame: Frame<_, _, _, _, _>| frame
                .with_depth(depth)
                .unwrap());
            let depth = DepthBuffer::<u16>::try_new(&mut two, SIDE, SIDE).unwrap();
            draw!(Bare(target(&mut bare)), |frame: Frame<_, _, _, _, _>| frame
                .with_depth(depth)
                .unwrap());
            assert!(with == without && with == bare, "{clips:?}");
            drawn += with.iter().filter(|&&word| word != 0).count();
        }
        assert!(drawn > 10_000, "{drawn} pixels");
    }
}
