//! The dirty rectangle against pictures compared pixel by pixel, and against the same frames without it.

use hither::{
    Alpha, Always, Balance, Blended, ClipVertex, Correction, DepthBias, DepthBuffer, DepthTest,
    Dirty, Fidelity, Flat, Fragment, Frame, Framebuffer, Gouraud, Gray8, Hither, I16F16,
    Interpolates, Preset, Rect, Rgb565, Sample, Speed, Target, Texture, Textured, Tier, Viewport,
};
use host_tests::oracle::Rng;
use host_tests::record::{Record, clip_vertex};

const SIDE: u32 = 64;
const PIXELS: usize = 64 * 64;
const EMPTY: Rect = Rect { x0: 0, y0: 0, x1: 0, y1: 0 };

/// The smallest rectangle around pixels.
fn around(pixels: impl Iterator<Item = usize>) -> Rect {
    pixels.fold(EMPTY, |rect, at| {
        let (x, y) = (at as i32 % SIDE as i32, at as i32 / SIDE as i32);
        rect.union(Rect { x0: x, y0: y, x1: x + 1, y1: y + 1 })
    })
}

fn differences<'a>(a: &'a [u16], b: &'a [u16]) -> impl Iterator<Item = usize> + 'a {
    a.iter().zip(b).enumerate().filter(|(_, (a, b))| a != b).map(|(at, _)| at)
}

fn holds(rect: Rect, inner: Rect) -> bool {
    inner.is_empty() || rect.intersect(inner) == inner
}

/// A colour that is not the same everywhere.
#[derive(Clone, Copy)]
struct Checkers(u16);

impl Fragment<Rgb565, 0> for Checkers {
    const UNIFORM: bool = false;

    fn shade(&self, sample: Sample<0>) -> Rgb565 {
        Rgb565(self.0 ^ (sample.x + sample.y) as u16 & 1)
    }
}

/// What is drawn in a frame: everything that a target can be asked for.
#[derive(Clone, Copy, Debug)]
struct Scene {
    seed: u64,
    scissor: Rect,
    depth: Depth,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Depth {
    None,
    Always,
    Less,
}

impl Scene {
    fn random(rng: &mut Rng) -> Self {
        let mut side = || rng.range(-10, 74) as i32;
        let scissor = Rect { x0: side() - 30, y0: side() - 30, x1: side() + 30, y1: side() + 30 };
        let depth = rng.choose(&[Depth::None, Depth::Always, Depth::Less]);
        Self { seed: rng.bits(), scissor, depth }
    }

    /// Draws it, after a clear in black unless the target is for what is drawn only.
    fn draw<C: Target<Color = Rgb565>, Q: Preset>(self, target: C, preset: Q, clear: bool) -> C {
        let mut words = vec![u16::MAX; PIXELS];
        let viewport = Viewport::new(SIDE, SIDE).expect("in range").with_scissor(self.scissor);
        let frame = Frame::with_viewport(target, viewport).with_preset(preset);
        let depth = DepthBuffer::try_new(&mut words, SIDE, SIDE).expect("a word a pixel");
        let hither = Hither::new(I16F16::ONE).expect("above 0");
        match self.depth {
            Depth::None => {
                let mut frame = frame;
                if clear {
                    frame.clear(Rgb565::BLACK);
                }
                self.draw_flat(&mut frame);
                frame.into_parts().0
            }
            Depth::Always => {
                let depth = depth.with_compare(Always);
                let mut frame = frame.with_hither(hither).with_depth(depth).expect("the same size");
                if clear {
                    frame.clear(Rgb565::BLACK);
                }
                self.draw_flat(&mut frame);
                self.draw_varied(&mut frame);
                frame.into_parts().0
            }
            Depth::Less => {
                let mut frame = frame.with_hither(hither).with_depth(depth).expect("the same size");
                if clear {
                    frame.clear(Rgb565::BLACK);
                }
                self.draw_flat(&mut frame);
                self.draw_varied(&mut frame);
                frame.into_parts().0
            }
        }
    }

    /// Three corners near one another, of any size, now and then behind the eye.
    fn corners<const N: usize>(rng: &mut Rng) -> [(ClipVertex, [I16F16; N]); 3] {
        let reach = rng.magnitude(1 << 17);
        let at = [(); 2].map(|()| rng.range(-1 << 16, 1 << 16));
        let w = rng.range(1 << 16, 3 << 16);
        [(); 3].map(|()| {
            let [x, y] = at.map(|at| at + rng.range(-reach, reach));
            let w = if rng.once_in(30) { -w } else { w + rng.range(0, 1 << 15) };
            let varyings = [(); N].map(|()| I16F16::from_bits(rng.range(0, 1 << 16) as i32));
            (clip_vertex([x, y, rng.range(0, w.abs()), w]), varyings)
        })
    }

    fn draw_flat<C, D, W, T, I>(self, frame: &mut Frame<C, D, W, T, I>)
    where
        C: Target<Color = Rgb565>,
        D: DepthTest,
        W: Interpolates<0>,
        T: Tier,
        I: Correction,
    {
        let mut rng = Rng::new(self.seed);
        for n in 0..rng.below(6) as u16 {
            let corners = Self::corners::<0>(&mut rng);
            match rng.below(3) {
                0 => frame.draw_triangle(corners, &Flat(Rgb565(2 + n))),
                1 => frame.draw_triangle(corners, &Checkers(2 + n)),
                _ => {
                    let [a, b, _] = corners.map(|(vertex, none)| frame.snap(&vertex, none));
                    frame.draw_line([&a, &b], DepthBias::NONE, &Flat(Rgb565(99 + n)))
                }
            };
        }
    }

    fn draw_varied<C, D, T, I>(self, frame: &mut Frame<C, D, Hither, T, I>)
    where
        C: Target<Color = Rgb565>,
        D: DepthTest,
        T: Tier,
        I: Correction,
    {
        static TEXELS: [u16; 16] = [0x1234; 16];
        let texture = Texture::<Rgb565>::try_new(&TEXELS, 4, 4).expect("a word a texel");
        let mut rng = Rng::new(!self.seed);
        for _ in 0..rng.below(4) {
            if rng.once_in(2) {
                frame.draw_triangle(Self::corners::<3>(&mut rng), &Gouraud);
            } else {
                frame.draw_triangle(Self::corners::<2>(&mut rng), &Textured(texture));
            }
        }
    }
}

fn check<Q: Preset>(seed: u64) {
    let mut rng = Rng::new(seed);
    let (mut words, mut plain) = (vec![0x7777; PIXELS], vec![0x7777; PIXELS]);
    let mut dirty =
        Dirty::new(Framebuffer::<Rgb565>::try_new(&mut words, SIDE, SIDE).expect("fits"));
    let mut last = Rect { x0: 0, y0: 0, x1: SIDE as i32, y1: SIDE as i32 };
    let mut sums = [0; 2];
    for n in 0..600 {
        let scene = Scene::random(&mut rng);
        let before = dirty.inner().words().to_vec();
        dirty = scene.draw(dirty, Q::default(), true);
        let changed = dirty.changed();

        let buffer = Framebuffer::<Rgb565>::try_new(&mut plain, SIDE, SIDE).expect("fits");
        scene.draw(buffer, Q::default(), true);
        assert!(dirty.inner().words() == plain, "seed {seed}, frame {n}, {scene:?}");

        let different = around(differences(&before, &plain));
        assert!(holds(changed, different), "seed {seed}, frame {n}: {different:?} in {changed:?}");
        let record = scene.draw(Record::new(SIDE, SIDE), Q::default(), false);
        let drawn = around(record.pixels.iter().map(|&(x, y, _)| (y * SIDE + x) as usize));
        if scene.depth == Depth::Less {
            assert!(holds(dirty.drawn(), drawn), "seed {seed}, frame {n}: {scene:?}");
        } else {
            assert_eq!(dirty.drawn(), drawn, "seed {seed}, frame {n}: {scene:?}");
        }
        assert_eq!(changed, last.union(dirty.drawn()), "seed {seed}, frame {n}: {scene:?}");
        last = dirty.drawn();
        sums[usize::from(different == changed)] += 1;
        // Nothing since.
        assert_eq!(dirty.changed(), EMPTY);
        assert_eq!(dirty.drawn(), last);
    }
    assert!(sums.iter().all(|&sum| sum > 10), "{sums:?}");
}

#[test]
fn what_changed_is_in_it_in_the_exact_tier() {
    check::<Fidelity>(201);
}

#[test]
fn what_changed_is_in_it_by_default() {
    check::<Balance>(202);
}

#[test]
fn what_changed_is_in_it_in_straight_pieces() {
    check::<Speed>(203);
}

/// A target that counts the pixels that are filled.
struct Filled(usize);

impl Target for Filled {
    type Color = u8;

    fn size(&self) -> (u32, u32) {
        (10, 8)
    }

    fn write(&mut self, _: usize, _: usize, colors: impl Iterator<Item = Option<u8>>) {
        self.0 += colors.flatten().count();
    }
}

#[test]
fn a_clear_fills_what_was_drawn() {
    let all = Rect { x0: 0, y0: 0, x1: 10, y1: 8 };
    let mut dirty = Dirty::new(Filled(0));
    let mut filled = 0;
    let mut clear = |dirty: &mut Dirty<Filled>, color| {
        dirty.clear(color);
        let before = std::mem::replace(&mut filled, dirty.inner().0);
        filled - before
    };
    assert_eq!(clear(&mut dirty, 1), 80);
    assert_eq!((dirty.changed(), dirty.drawn()), (all, EMPTY));
    assert_eq!(clear(&mut dirty, 1), 0);
    assert_eq!(dirty.changed(), EMPTY);
    // Drawn over two frames without a clear.
    dirty.write(2, 3, [None, Some(7), None].into_iter());
    assert_eq!(dirty.changed(), Rect { x0: 3, y0: 3, x1: 4, y1: 4 });
    dirty.fill(5, 5, 2, 9);
    assert_eq!(dirty.changed(), Rect { x0: 5, y0: 5, x1: 7, y1: 6 });
    assert_eq!(dirty.drawn(), Rect { x0: 3, y0: 3, x1: 7, y1: 6 });
    filled_is(&mut clear, &mut dirty);
    // Another colour is everywhere.
    assert_eq!(clear(&mut dirty, 2), 80);
    assert_eq!(dirty.changed(), all);
    // What others draw inside, of which the target has a part.
    dirty.inner_within(Rect { x0: -4, y0: 7, x1: 2, y1: 99 });
    dirty.inner_within(Rect { x0: 4, y0: 7, x1: 2, y1: 9 });
    dirty.inner_within(Rect { x0: 10, y0: 0, x1: 12, y1: 2 });
    assert_eq!(dirty.changed(), Rect { x0: 0, y0: 7, x1: 2, y1: 8 });
    assert_eq!(dirty.into_inner().0, 80 + 1 + 2 + 12 + 80);
}

/// Of 4 columns and 3 rows; it changed.
fn filled_is(clear: &mut impl FnMut(&mut Dirty<Filled>, u8) -> usize, dirty: &mut Dirty<Filled>) {
    // The three pixels drawn are counted too.
    assert_eq!(clear(dirty, 1), 12 + 3);
    assert_eq!((dirty.changed(), dirty.drawn()), (Rect { x0: 3, y0: 3, x1: 7, y1: 6 }, EMPTY));
}

#[test]
fn a_rectangles_rows_are_those_of_the_buffer() {
    let mut words: Vec<u16> = (0..14).collect();
    let buffer = Framebuffer::<Rgb565>::try_new(&mut words, 4, 3).expect("fits");
    let rows = |x0, y0, x1, y1| {
        let rect = Rect { x0, y0, x1, y1 };
        let rows: Vec<_> = buffer.rect_words(rect).map(<[u16]>::to_vec).collect();
        let bytes: Vec<_> = buffer.rect_bytes(rect).map(<[u8]>::len).collect();
        assert_eq!(bytes, rows.iter().map(|row| 2 * row.len()).collect::<Vec<_>>());
        rows
    };
    assert_eq!(rows(1, 1, 3, 3), [[5, 6], [9, 10]]);
    assert_eq!(rows(-5, -5, 1, 2), [[0], [4]]);
    assert_eq!(rows(3, 2, i32::MAX, i32::MAX), [[11]]);
    for (x0, y0, x1, y1) in [(0, 0, 0, 0), (2, 0, 1, 3), (0, 3, 4, 9), (4, 0, 9, 3), (0, 2, 4, 1)] {
        assert!(rows(x0, y0, x1, y1).is_empty());
    }
}

/// Over a target that merges, a clear is drawn as often as it is asked for.
#[test]
fn clears_that_merge_are_drawn_everywhere() {
    let mut words = [200; 16];
    let mut buffer = Framebuffer::<Gray8>::try_new(&mut words, 4, 4).unwrap();
    let mut dirty = Dirty::new(Blended::<Gray8>::new(&mut buffer));
    for _ in 0..3 {
        dirty.clear(Alpha { color: Gray8(0), alpha: 128 });
    }
    assert_eq!(words, [25; 16]);
}
