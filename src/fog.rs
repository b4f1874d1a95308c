//! Fog, or a depth cue: what is far away fades into one colour.
//!
//! How far along `w` a vertex is between two distances is one more varying. It is linear in `w`, as are all varyings over a
//! triangle, so that a perspective-correct one is right at every pixel; beyond the distances it is clamped at the pixel, not
//! at the vertex, where that would bend it.

use crate::blend::Mix;
use crate::fragment::{Fragment, Sample};
use crate::math::{Scale, saturate, unsigned};
use crate::mesh::VertexStage;
use crate::transform::ModelPosition;
use crate::vertex::ClipVertex;
use fixed::types::I16F16;

/// A vertex stage with one more varying behind its own, up to 7 in all: `(w - near) / (far - near)`, for [`Fogged`].
///
/// It is not clamped, but within the range of [`I16F16`]. Two products of 32 by 32 bits a vertex, and no division.
///
/// ```
/// use hither::{ClipVertex, FogDistance, Fogged, Gouraud, I16F16, Mat4, ModelPosition, Rgb565, VertexStage};
///
/// let num = |v: f32| I16F16::from_num(v);
/// let stage = FogDistance::try_new(Mat4::IDENTITY, num(0.5), num(2.5))?;
/// let origin = ModelPosition { raw: [0; 3], fraction_bits: 0 };
/// // The identity's w is 1: a quarter of the way.
/// let (_, varyings) = VertexStage::<[u8; 3], 4>::vertex(&stage, origin, &[255, 0, 0]);
/// assert_eq!(varyings, [num(1.0), num(0.0), num(0.0), num(0.25)]);
/// let shader = Fogged(Gouraud, Rgb565::new(20, 40, 20));
/// # fn takes<const N: usize>(_: impl hither::Fragment<Rgb565, N>) {}
/// # takes::<4>(shader);
/// # Ok::<(), hither::FogRange>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FogDistance<S> {
    stage: S,
    /// Raw.
    near: i64,
    /// One by the range.
    scale: Scale,
}

impl<S> FogDistance<S> {
    /// Varyings of `stage` with one more, which is 0 where `w` is `near` and 1 where it is `far`.
    ///
    /// # Errors
    ///
    /// [`FogRange`] where `far` is not beyond `near`.
    pub fn try_new(stage: S, near: I16F16, far: I16F16) -> Result<Self, FogRange> {
        let [first, last] = [near, far].map(|distance| i64::from(distance.to_bits()));
        if last <= first {
            return Err(FogRange { near, far });
        }
        let scale = Scale::of(last.abs_diff(first)).reciprocal();
        Ok(Self { stage, near: first, scale })
    }

    /// How far a vertex is.
    #[inline(never)]
    fn along(&self, vertex: &ClipVertex) -> I16F16 {
        let [_, _, _, w] = vertex.raw;
        // Raw coordinates that were shifted are at most 2^30.
        let w = i64::from(w) << vertex.shift.min(32);
        I16F16::from_bits(saturate(self.scale.apply(w - self.near, 16)))
    }
}

/// A shader of the varyings before the last, whose colours are mixed with fog by the last: see [`FogDistance`]. 0 and below
/// is none of it, 1 and above nothing else.
///
/// One product for the part, and what mixing takes ([`Mix::mix`]). The part is the nearest 255th to the varying, so that a
/// channel is within 1/510 of its range, beside what the varying is off: as any other, that is in proportion to its range over
/// the triangle, so `far` is best near where the scene ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fogged<S, C>(pub S, pub C);

/// `v 255`, rounded to nearest, of a varying in `[0, 1]`; outside, it is clamped.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "0 to 255")]
fn part(varying: I16F16) -> u8 {
    ((unsigned(varying.to_bits().clamp(0, 1 << 16)) * 255 + (1 << 15)) >> 16) as u8
}

/// For so many varyings and one more: const generics cannot add.
macro_rules! one_more {
    ($($n:literal + 1 = $all:literal),*) => {
        $(
            impl<A, S: VertexStage<A, $n>> VertexStage<A, $all> for FogDistance<S> {
                #[inline]
                fn vertex(
                    &self,
                    position: ModelPosition,
                    attribute: &A,
                ) -> (ClipVertex, [I16F16; $all]) {
                    let (vertex, varyings): (_, [I16F16; $n]) =
                        self.stage.vertex(position, attribute);
                    let mut all = [self.along(&vertex); $all];
                    for (to, from) in all.iter_mut().zip(varyings) {
                        *to = from;
                    }
                    (vertex, all)
                }
            }

            impl<C: Mix, S: Fragment<C, $n>> Fragment<C, $all> for Fogged<S, C> {
                /// 2^-8 for the fog, which is a step of its part.
                const TOLERANCE: u32 = if S::TOLERANCE < 1 << 8 { S::TOLERANCE } else { 1 << 8 };
                const DISCARDS: bool = S::DISCARDS;

                #[inline]
                fn shade(&self, sample: Sample<$all>) -> C {
                    let Sample { x, y, varyings: [varyings @ .., fog] } = sample;
                    self.1.mix(self.0.shade(Sample { x, y, varyings }), part(fog))
                }

                #[inline]
                fn shade_or_discard(&self, sample: Sample<$all>) -> Option<C> {
                    let Sample { x, y, varyings: [varyings @ .., fog] } = sample;
                    let color = self.0.shade_or_discard(Sample { x, y, varyings })?;
                    Some(self.1.mix(color, part(fog)))
                }

                #[inline]
                fn for_face(self, index: usize) -> Self {
                    Self(self.0.for_face(index), self.1)
                }
            }
        )*
    };
}

one_more!(0 + 1 = 1, 1 + 1 = 2, 2 + 1 = 3, 3 + 1 = 4, 4 + 1 = 5, 5 + 1 = 6, 6 + 1 = 7);

/// Fog does not end beyond where it begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FogRange {
    /// Where it begins.
    pub near: I16F16,
    /// Where it ends.
    pub far: I16F16,
}

impl core::fmt::Display for FogRange {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "fog from {} to {}: far must be beyond near", self.near, self.far)
    }
}

impl core::error::Error for FogRange {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Affine, Correction, DepthBuffer, Exact, Flat, Frame, Framebuffer, Gouraud, Hither,
        Interpolates, Keyed, Mesh, Packed, Perspective, PerspectiveEvery, Quick, Rgb888, Texture,
        Textured, Tier,
    };
    use std::string::ToString;
    use std::vec;
    use std::vec::Vec;

    const SIDE: u32 = 48;

    /// A vertex stage that has its vertices.
    #[derive(Debug)]
    struct Given;

    impl<const N: usize> VertexStage<([i32; 4], [I16F16; N]), N> for Given {
        fn vertex(
            &self,
            _: ModelPosition,
            (at, varyings): &([i32; 4], [I16F16; N]),
        ) -> (ClipVertex, [I16F16; N]) {
            let [x, y, z, w] = at.map(I16F16::from_bits);
            (ClipVertex::new(x, y, z, w), *varyings)
        }
    }

    #[test]
    fn ranges_are_checked() {
        let [near, far] = [3, 2].map(I16F16::from_num::<i32>);
        let error = FogDistance::try_new(Given, near, far).unwrap_err();
        assert_eq!(error.to_string(), "fog from 3 to 2: far must be beyond near");
        assert!(FogDistance::try_new(Given, near, near).is_err());
        assert!(FogDistance::try_new(Given, I16F16::MIN, I16F16::MAX).is_ok());
        assert!(FogDistance::try_new(Given, near, near + I16F16::DELTA).is_ok());
    }

    /// Distances of all kinds against `f64`, those outside of the range of a varying at its ends.
    #[test]
    fn distances_are_the_nearest() {
        let mut state = 21u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 32) as u32
        };
        for _ in 0..100_000 {
            let [a, b, w] = [(); 3].map(|()| random() as i32 >> (random() % 31));
            if a == b {
                continue;
            }
            let (near, far) = (a.min(b), a.max(b));
            let stage = FogDistance::try_new((), I16F16::from_bits(near), I16F16::from_bits(far));
            let wide = i64::from(w) << (random() % 34);
            let vertex = ClipVertex::from_wide([0, 0, 0, wide]);
            let exact = (wide as f64 - f64::from(near)) / (f64::from(far) - f64::from(near));
            let exact = exact.clamp(-32_768.0, 32_768.0 - 2f64.powi(-16));
            let got = stage.unwrap().along(&vertex).to_num::<f64>();
            let bound = 2f64.powi(-17) + (exact.abs() + 1.0) * 2f64.powi(-27);
            assert!((got - exact).abs() <= bound, "{near} {far} {wide}: {got}, not {exact}");
        }
        // Shifted as far as can be.
        let stage = FogDistance::try_new((), I16F16::ZERO, I16F16::ONE).unwrap();
        let vertex = ClipVertex::from_wide([0, 0, 0, i64::MAX]);
        assert_eq!(stage.along(&vertex), I16F16::MAX);
    }

    /// A triangle over all of the screen, whose `w` are these, in fog from `near` to `far`: the largest and the RMS error of
    /// all channels, in steps of 255.
    fn error<T: Tier, I: Correction, S: Fragment<Rgb888, N>, const N: usize, const M: usize>(
        (shader, fog): (S, Rgb888),
        ws: [f64; 3],
        (near, far): (f64, f64),
        colors: [[f64; N]; 3],
        of: impl Fn([f64; N]) -> [f64; 3],
    ) -> [f64; 2]
    where
        Hither: Interpolates<M>,
        FogDistance<Given>: VertexStage<([i32; 4], [I16F16; N]), M>,
        Fogged<S, Rgb888>: Fragment<Rgb888, M>,
    {
        let size = (SIDE * SIDE) as usize;
        let (mut words, mut depths) = (vec![0; size], vec![0u16; size]);
        let buffer = Framebuffer::<Rgb888>::try_new(&mut words, SIDE, SIDE).unwrap();
        let frame = Frame::new(buffer).unwrap().with_hither(Hither::new(I16F16::ONE).unwrap());
        let depth = DepthBuffer::try_new(&mut depths, SIDE, SIDE).unwrap();
        let frame = frame.with_depth(depth).unwrap();
        let mut frame = frame.with_tier(T::default()).with_correction(I::default());
        frame.clear(Rgb888::BLACK);
        let places = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]];
        let attributes: Vec<_> = (0..3)
            .map(|i| {
                let at = [places[i][0] * ws[i], places[i][1] * ws[i], 0.0, ws[i]];
                let raw = at.map(|v| (v * 65_536.0) as i32);
                (raw, colors[i].map(I16F16::from_num))
            })
            .collect();
        let mesh = Mesh::try_new(&[[0i16; 3]; 3], 0, &attributes, &[[0, 1, 2]]).unwrap();
        let [first, last] = [near, far].map(I16F16::from_num);
        let stage = FogDistance::try_new(Given, first, last).unwrap();
        let counts = frame.draw(&mesh, &stage, &Fogged(shader, fog), &mut []);
        assert_eq!(counts.drawn, 1);
        let (mut largest, mut sum) = (0.0f64, 0.0);
        for (i, word) in words.iter().enumerate() {
            let side = f64::from(SIDE);
            let x = (2.0 * (i % SIDE as usize) as f64 + 1.0) / side - 1.0;
            let y = 1.0 - (2.0 * (i / SIDE as usize) as f64 + 1.0) / side;
            let (p, q) = ((x + 1.0) / 4.0, (y + 1.0) / 4.0);
            let parts = [(1.0 - p - q) / ws[0], p / ws[1], q / ws[2]];
            let w = 1.0 / parts.iter().sum::<f64>();
            let varying = |n: usize| (0..3).map(|i| colors[i][n] * parts[i] * w).sum::<f64>();
            let inner = of(core::array::from_fn(varying));
            let fogged = ((w - near) / (far - near)).clamp(0.0, 1.0);
            for (shift, inner) in [16, 8, 0].into_iter().zip(inner) {
                let fog = f64::from(fog.0 >> shift & 0xff);
                let exact = inner * (1.0 - fogged) + fog * fogged;
                let off = (f64::from(word >> shift & 0xff) - exact).abs();
                largest = largest.max(off);
                sum += off * off;
            }
        }
        [largest, (sum / (3 * size) as f64).sqrt()]
    }

    /// Every correction in its tiers: what is left is that the part is one of 255, a colour of 255, and what the varying is
    /// off. Straight pieces and lines are off where `w` bends.
    #[test]
    fn fog_is_linear_in_w() {
        let fog = Rgb888::new(255, 200, 3);
        let inner = Rgb888::new(0, 60, 250);
        let flat = |_: [f64; 0]| [0.0, 60.0, 250.0];
        let smooth = |color: [f64; 3]| color.map(|c| c * 255.0);
        let colors = [[1.0, 0.0, 0.5], [0.0, 1.0, 0.25], [0.25, 0.75, 1.0]];
        let none = [[]; 3];
        for (ws, range) in [
            ([1.0, 8.0, 4.0], (1.0, 6.0)),
            ([2.0, 2.5, 3.0], (2.0, 2.5)),
            ([1.0, 1.0, 30.0], (1.0, 1.75)),
            ([3.0; 3], (2.0, 5.0)),
        ] {
            macro_rules! all {
                ($tier:ty, $correction:ty, $bounds:expr) => {{
                    let flats = error::<$tier, $correction, _, 0, 1>(
                        (Flat(inner), fog),
                        ws,
                        range,
                        none,
                        flat,
                    );
                    let smooths = error::<$tier, $correction, _, 3, 4>(
                        (Gouraud, fog),
                        ws,
                        range,
                        colors,
                        smooth,
                    );
                    let (largest, rms) = $bounds;
                    for got in [flats, smooths] {
                        assert!(got[0] <= largest && got[1] <= rms, "{got:?} in {ws:?}");
                    }
                }};
            }
            all!(Exact, Perspective, (1.3, 0.45));
            all!(Quick<8>, Perspective, (1.3, 0.45));
            all!(Quick<8>, Packed<PerspectiveEvery<8>>, (5.5, 0.7));
            if ws[0] == ws[1] && ws[1] == ws[2] {
                all!(Quick<8>, Packed<Affine>, (1.3, 0.45));
            }
        }
    }

    #[test]
    fn the_ends_are_exact() {
        let (inner, fog) = (Rgb888::new(1, 2, 3), Rgb888::new(250, 251, 252));
        let at = |bits: i32| {
            let varyings = [I16F16::from_bits(bits)];
            Fogged(Flat(inner), fog).shade(Sample { x: 0, y: 0, varyings })
        };
        for bits in [0, -1, i32::MIN] {
            assert_eq!(at(bits), inner);
        }
        for bits in [1 << 16, (1 << 16) + 1, i32::MAX] {
            assert_eq!(at(bits), fog);
        }
        for bits in 0..=1 << 16 {
            let exact = f64::from(bits) / 65_536.0 * 255.0;
            let part = f64::from(part(I16F16::from_bits(bits)));
            assert!((part - exact).abs() <= 0.5, "{bits}");
        }
    }

    /// A texture's key is looked at before there is fog, and faces have their colours.
    #[test]
    fn fog_goes_over_any_shader() {
        let texels = [0x12_3456, 0x65_4321];
        let texture = Texture::<Rgb888>::try_new(&texels, 2, 1).unwrap();
        let shader = Fogged(Keyed(Textured(texture), Rgb888(0x12_3456)), Rgb888::WHITE);
        let at = |u: f32, fog: f32| {
            let varyings = [u, 0.0, fog].map(I16F16::from_num);
            shader.shade_or_discard(Sample { x: 0, y: 0, varyings })
        };
        assert_eq!([at(0.25, 0.0), at(0.25, 1.0)], [None; 2]);
        assert_eq!([at(0.75, 0.0), at(0.75, 1.0)], [Some(Rgb888(0x65_4321)), Some(Rgb888::WHITE)]);
        let colors = [Rgb888::BLACK, Rgb888(7)];
        let faces = Fogged(crate::FaceColors::new(&colors).unwrap(), Rgb888::WHITE);
        let sample = Sample { x: 0, y: 0, varyings: [I16F16::ZERO] };
        assert_eq!([0, 1].map(|face| faces.for_face(face).shade(sample)), colors);
    }
}
