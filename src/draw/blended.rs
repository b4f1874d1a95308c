//! A frame whose colours are merged with those that are there.

use super::Frame;
use crate::blend::{Blended, Merge};
use crate::color::PixelFormat;
use crate::depth::TestOnly;
use crate::framebuffer::Framebuffer;
use core::marker::PhantomData;

/// A frame that merges, for as long as it borrows another.
type BlendedFrame<'a, F, M, D, W, T, I, const P: usize> =
    Frame<Blended<'a, F, M>, TestOnly<&'a mut D>, W, T, I, P>;

impl<F: PixelFormat, D, W: Copy, T, I, const P: usize> Frame<Framebuffer<'_, F>, D, W, T, I, P> {
    /// The same frame for a while, with shaders whose colours are merged with what it shows: [`Alpha`](crate::Alpha) by
    /// [`Translucent`](crate::Translucent), [`Add`](crate::Add) by [`Additive`](crate::Additive), or any other [`Merge`].
    ///
    /// The viewport, the hither plane, clip planes, culling and the tier are the same: vertices that one has snapped serve
    /// the other. Depth is tested and not stored, so that translucent surfaces do not hide each other;
    /// [`with_depth_stored`](Frame::with_depth_stored) stores it. They are merged in the order they are drawn: those that
    /// are farther away first, after all that is opaque. Where two triangles share an edge each pixel is one's or the
    /// other's, so that no seam shows.
    ///
    /// It compiles for framebuffers only, since other targets cannot be read: see [`Over`](crate::Over).
    ///
    /// ```
    /// use hither::{Alpha, ClipVertex, Flat, Frame, Framebuffer, Gray8, I16F16, Translucent};
    ///
    /// let mut words = [b'0'; 64];
    /// let mut frame = Frame::new(Framebuffer::<Gray8>::try_new(&mut words, 8, 8)?)?;
    /// let mut blended = frame.blended::<Alpha<Gray8>>();
    /// let corner = |x: f32, y: f32| {
    ///     let [x, y] = [x, y].map(I16F16::from_num);
    ///     (ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
    /// };
    /// let glass = Translucent(Flat(Gray8(b'8')), 128);
    /// blended.draw_triangle([corner(-1.0, -1.0), corner(1.0, -1.0), corner(-1.0, 1.0)], &glass);
    /// blended.draw_triangle([corner(1.0, 1.0), corner(-1.0, -1.0), corner(1.0, -1.0)], &glass);
    /// let rows: Vec<_> = words.chunks(8).map(|row| core::str::from_utf8(row).unwrap()).collect();
    /// assert_eq!(rows, [
    ///     "00000004",
    ///     "40000044",
    ///     "44000444",
    ///     "44404444",
    ///     "44464444",
    ///     "44666444",
    ///     "46666644",
    ///     "66666664",
    /// ]);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// ```compile_fail,E0599
    /// # use hither::{Add, Frame, Gray8, Target};
    /// # struct Display;
    /// # impl Target for Display {
    /// #     type Color = Gray8;
    /// #     fn size(&self) -> (u32, u32) { (8, 8) }
    /// #     fn write(&mut self, _: usize, _: usize, _: impl Iterator<Item = Option<Gray8>>) {}
    /// # }
    /// let mut frame = Frame::new(Display).unwrap();
    /// frame.blended::<Add<Gray8>>();
    /// ```
    pub fn blended<M: Merge<F::Color>>(&mut self) -> BlendedFrame<'_, F, M, D, W, T, I, P> {
        Frame {
            target: Blended::new(&mut self.target),
            depth: TestOnly(&mut self.depth),
            range: self.range,
            planes: self.planes,
            cull: self.cull,
            viewport: self.viewport,
            window: self.window,
            small_window: self.small_window,
            knobs: PhantomData,
        }
    }
}

impl<C, D, W, T, I, const P: usize> Frame<C, TestOnly<D>, W, T, I, P> {
    /// The same, storing the depth of what it draws, as an opaque surface does.
    #[must_use]
    pub fn with_depth_stored(self) -> Frame<C, D, W, T, I, P> {
        self.rebuild(|depth, range| (depth.0, range))
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        Add, Additive, Alpha, ClipVertex, Correction, DepthBuffer, Exact, FaceColors, Flat,
        Fragment, Frame, Framebuffer, Gouraud, Hither, I16F16, Interpolates, Over, Packed,
        Perspective, PerspectiveEvery, Quick, Rgb565, Target, Texture, Textured, Tier, Translucent,
        Vertex, Viewport,
    };
    use std::vec;
    use std::vec::Vec;

    const SIDE: u32 = 64;

    /// What is drawn where, that can no more than it must.
    struct Drawn(Vec<Option<Rgb565>>);

    impl Target for Drawn {
        type Color = Rgb565;

        fn size(&self) -> (u32, u32) {
            (SIDE, SIDE)
        }

        fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<Rgb565>>) {
            for (shown, color) in self.0[y * SIDE as usize + x..].iter_mut().zip(colors) {
                *shown = color.or(*shown);
            }
        }
    }

    fn random() -> impl FnMut(i32) -> i32 {
        let mut state = 11u64;
        move |n| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        }
    }

    /// A triangle of any size, some of them tiny, cut or off the screen.
    fn corners<const N: usize>(
        below: &mut impl FnMut(i32) -> i32,
    ) -> [(ClipVertex, [I16F16; N]); 3] {
        let reach = 2 << below(18);
        let at = [0, 1].map(|_| below(1 << 17) - (1 << 16));
        let near = below(4) == 0;
        [(); 3].map(|()| {
            let w = if near { below(5 << 16) - (1 << 15) } else { (1 << 16) + below(1 << 16) };
            let scale = |v: i32| I16F16::from_bits(((i64::from(v) * i64::from(w)) >> 16) as i32);
            let [x, y] = at.map(|at| scale(at + below(2 * reach) - reach));
            let vertex = ClipVertex::new(x, y, scale(below(1 << 16)), I16F16::from_bits(w));
            (vertex, [(); N].map(|()| I16F16::from_bits(below(65_537))))
        })
    }

    /// A triangle at the far end, which passes nowhere: after it a frame knows its window, and tiny triangles go their own way.
    fn unseen<const N: usize>() -> [(ClipVertex, [I16F16; N]); 3] {
        [[-1, -1], [1, -1], [0, 1]].map(|[x, y]| {
            let [x, y] = [x, y].map(I16F16::from_num);
            (ClipVertex::new(x, y, I16F16::ONE, I16F16::ONE), [I16F16::ZERO; N])
        })
    }

    /// The nearest of a channel, in `f64`.
    fn mixed(color: Rgb565, under: Rgb565, alpha: u8) -> Rgb565 {
        let part = f64::from(alpha) / 255.0;
        let [r, g, b] = [(color.r(), under.r()), (color.g(), under.g()), (color.b(), under.b())]
            .map(|(c, u)| (f64::from(c) * part + f64::from(u) * (1.0 - part)).round() as u8);
        Rgb565::new(r, g, b)
    }

    fn sum(color: Rgb565, under: Rgb565) -> Rgb565 {
        let [r, g, b] = [(color.r(), under.r()), (color.g(), under.g()), (color.b(), under.b())]
            .map(|(c, u)| c + u);
        Rgb565::new(r.min(31), g.min(63), b.min(31))
    }

    /// Draws random triangles merged, and the same by themselves where nobody looks, and merges those here.
    fn check<T: Tier, I: Correction, S: Fragment<Rgb565, N>, const N: usize>(
        below: &mut impl FnMut(i32) -> i32,
        shader: S,
    ) -> usize
    where
        Hither: Interpolates<N>,
    {
        let size = (SIDE * SIDE) as usize;
        let hither = Hither::new(I16F16::ONE).unwrap();
        let viewport = Viewport::new(70, 60).unwrap().with_origin(-3, 2);
        macro_rules! frame {
            ($words:expr, $depths:expr) => {{
                let buffer = Framebuffer::<Rgb565>::try_new($words, SIDE, SIDE).unwrap();
                let frame = Frame::with_viewport(buffer, viewport).with_hither(hither);
                let depth = DepthBuffer::try_new($depths, SIDE, SIDE).unwrap();
                let frame = frame.with_depth(depth).unwrap();
                frame.with_tier(T::default()).with_correction(I::default())
            }};
        }
        let mut words: Vec<u16> = (0..size).map(|_| below(1 << 16) as u16).collect();
        let (mut depths, mut shown) = (vec![0xffffu16; size], words.clone());
        let mut frame = frame!(&mut words, &mut depths);
        frame.draw_triangle(unseen(), &shader);
        let mut count = 0;
        for n in 0..400 {
            let vertices = corners::<N>(below);
            let alpha = if n % 7 == 0 { 255 * (n % 2) as u8 } else { below(256) as u8 };
            let before = frame.depth().words().to_vec();
            let (mut alone, mut after) = (shown.clone(), before.clone());
            let mut other = frame!(&mut alone, &mut after);
            other.draw_triangle(unseen(), &shader);
            let outcome = other.draw_triangle(vertices, &shader);
            let adds = n % 3 == 0;
            for i in 0..size {
                // Nearer is drawn.
                if before[i] != after[i] {
                    count += 1;
                    let (color, under) = (Rgb565(alone[i]), Rgb565(shown[i]));
                    let merged = if adds { sum(color, under) } else { mixed(color, under, alpha) };
                    shown[i] = merged.0;
                }
            }
            // From vertices that the frame itself has snapped.
            let [a, b, c]: [Vertex<T, N>; 3] =
                vertices.map(|(vertex, varyings)| frame.snap(&vertex, varyings));
            let got = if adds {
                let mut lit = frame.blended::<Add<_>>().with_depth_stored();
                lit.draw_snapped([&a, &b, &c], &Additive(shader))
            } else {
                let mut glass = frame.blended::<Alpha<_>>();
                glass.draw_snapped([&a, &b, &c], &Translucent(shader, alpha))
            };
            assert_eq!(outcome, got, "{vertices:?}");
            assert!(frame.target().words() == shown, "{n}: {vertices:?}, {alpha}");
            assert!(
                frame.depth().words() == if adds { after } else { before },
                "{n}: {vertices:?}"
            );
        }
        count
    }

    #[test]
    fn merged_triangles_are_those_that_are_merged_by_hand() {
        let mut below = random();
        let texels: Vec<u16> = (0..64).map(|i| i * 977).collect();
        let texture = Textured(Texture::<Rgb565>::try_new(&texels, 8, 8).unwrap());
        let faces = [Rgb565(0x1234), Rgb565(0x4321)];
        let faces = FaceColors::new(&faces).unwrap();
        let mut count = 0;
        macro_rules! all {
            ($tier:ty, $correction:ty) => {{
                count += check::<$tier, $correction, _, 0>(&mut below, faces);
                count += check::<$tier, $correction, _, 3>(&mut below, Gouraud);
                count += check::<$tier, $correction, _, 2>(&mut below, texture);
            }};
        }
        all!(Exact, Perspective);
        all!(Quick<8>, Packed<PerspectiveEvery<8>>);
        all!(Quick<4>, PerspectiveEvery<4>);
        assert!(count > 100_000, "{count} pixels");
    }

    /// Without depth, where spans are filled.
    #[test]
    fn fills_are_merged_once_a_pixel() {
        let mut words = vec![0u16; (SIDE * SIDE) as usize];
        let buffer = Framebuffer::<Rgb565>::try_new(&mut words, SIDE, SIDE).unwrap();
        let mut frame = Frame::new(buffer).unwrap();
        let corner = |x: i32, y: i32| {
            let [x, y] = [x, y].map(I16F16::from_num);
            (ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
        };
        let glass = Additive(Flat(Rgb565::new(3, 5, 7)));
        let mut blended = frame.blended();
        blended.draw_triangle([corner(-1, -1), corner(1, -1), corner(-1, 1)], &glass);
        blended.draw_triangle([corner(1, 1), corner(-1, 1), corner(1, -1)], &glass);
        blended.clear(Add(Rgb565::new(1, 1, 1)));
        assert!(words.iter().all(|&word| Rgb565(word) == Rgb565::new(4, 6, 8)));
    }

    /// What is drawn over one colour is the same as in a buffer that was cleared to it, in any target.
    #[test]
    fn one_background_is_a_cleared_buffer() {
        let (mut below, mut count) = (random(), 0);
        let background = Rgb565(0x8c51);
        for n in 0..300 {
            let mut words = vec![background.0; (SIDE * SIDE) as usize];
            let buffer = Framebuffer::<Rgb565>::try_new(&mut words, SIDE, SIDE).unwrap();
            let hither = Hither::new(I16F16::ONE).unwrap();
            let frame = Frame::new(buffer).unwrap().with_hither(hither);
            let mut frame = frame.with_tier(Quick::<8>);
            let over = Over::new(Drawn(vec![None; (SIDE * SIDE) as usize]), background);
            let direct = Frame::new(over).unwrap().with_hither(hither);
            let mut direct = direct.with_tier(Quick::<8>);
            let alpha = [0, 255, 128, below(256)][n % 4] as u8;
            if n % 2 == 0 {
                let triangle = corners::<3>(&mut below);
                frame.blended().draw_triangle(triangle, &Translucent(Gouraud, alpha));
                direct.draw_triangle(triangle, &Translucent(Gouraud, alpha));
            } else {
                let (triangle, flat) = (corners::<0>(&mut below), Flat(Rgb565(1234)));
                frame.blended().draw_triangle(triangle, &Translucent(flat, alpha));
                direct.draw_triangle(triangle, &Translucent(flat, alpha));
            }
            let drawn = direct.into_parts().0.into_target().0;
            for (word, drawn) in words.iter().zip(drawn) {
                assert_eq!(*word, drawn.unwrap_or(background).0);
                assert!(alpha > 0 || drawn.is_none());
                count += usize::from(drawn.is_some());
            }
        }
        assert!(count > 20_000, "{count} pixels");
    }
}
