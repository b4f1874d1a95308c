//! Frames: what they count, and that any target shows the same picture.

mod filtered;
mod keyed;
mod lines;

use super::*;
use crate::color::Rgb565;
use crate::depth::{DepthBias, DepthBuffer};
use crate::fragment::{FaceColors, Flat, Sample};
use crate::framebuffer::Framebuffer;
use crate::interpolation::{Packed, PerspectiveEvery};
use crate::vertex::{Exact, Quick, Viewport};
use std::vec;
use std::vec::Vec;

/// A target that can no more than it must, of rows of any width.
struct Plain {
    words: Vec<u16>,
    width: usize,
}

impl Plain {
    fn new(width: usize, height: usize) -> Self {
        Self { words: vec![0; width * height], width }
    }
}

impl Target for Plain {
    type Color = Rgb565;

    fn size(&self) -> (u32, u32) {
        (self.width as u32, (self.words.len() / self.width) as u32)
    }

    fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<Rgb565>>) {
        let row = self.words.chunks_mut(self.width).nth(y).unwrap();
        let mut left = row[x..].iter_mut();
        for color in colors {
            let word = left.next().expect("a run is inside of its row");
            *word = color.map_or(*word, |color| color.0);
        }
    }
}

/// A colour that is not the same everywhere.
#[derive(Clone, Copy)]
struct Checkers(u16);

impl Fragment<Rgb565, 0> for Checkers {
    const UNIFORM: bool = false;

    fn shade(&self, sample: Sample<0>) -> Rgb565 {
        Rgb565(self.0 + 600 * ((sample.x ^ sample.y) & 1) as u16)
    }
}

/// Triangles of all sizes in and around a frame, each in its colour or two, without depth and with it: the words of both.
fn draw_all<C: Target<Color = Rgb565>>(
    targets: [C; 2],
    (width, height): (u32, u32),
    origin: (i16, i16),
) -> [C; 2] {
    let hither = Hither::new(I16F16::ONE).unwrap();
    let viewport = Viewport::new(64, 48).unwrap().with_origin(origin.0, origin.1);
    let mut depths = vec![u16::MAX; (width * height) as usize];
    let [flat, deep] = targets;
    let mut flat = Frame::with_viewport(flat, viewport).with_tier(Quick::<8>);
    let deep = Frame::with_viewport(deep, viewport).with_tier(Quick::<8>).with_hither(hither);
    let depth = DepthBuffer::try_new(&mut depths, width, height).unwrap();
    let mut deep = deep.with_depth(depth).unwrap().with_correction(Packed(PerspectiveEvery::<8>));
    let mut state = 1u64;
    let mut below = move |n: i32| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        ((state >> 33) % u64::from(n.unsigned_abs())) as i32
    };
    for n in 1..600u16 {
        let reach = 2 << below(16);
        let at = [0, 1].map(|_| below(1 << 17) - (1 << 16));
        let corners = [(); 3].map(|()| {
            let [x, y] = at.map(|at| at + below(2 * reach) - reach);
            let [x, y, z] = [x, y, below(1 << 16)].map(I16F16::from_bits);
            ClipVertex::new(x, y, z, I16F16::ONE)
        });
        let corners = corners.map(|corner| (corner, []));
        if n % 4 == 0 {
            flat.draw_triangle(corners, &Checkers(n));
            deep.draw_triangle(corners, &Checkers(n));
        } else {
            flat.draw_triangle(corners, &Flat(Rgb565(n)));
            deep.draw_triangle(corners, &Flat(Rgb565(n)));
        }
    }
    [flat.into_parts().0, deep.into_parts().0]
}

/// Runs of small triangles are counted in the target's rows: where those are too wide for it, and in targets that take
/// rows one by one, the picture is the same.
#[test]
fn targets_of_any_width_and_kind_have_the_same_picture() {
    let (width, height) = (64, 48);
    let mut words = [vec![0; 64 * 48], vec![0; 64 * 48]];
    let [a, b] = &mut words;
    let buffers = [a, b].map(|words| Framebuffer::<Rgb565>::try_new(words, width, height).unwrap());
    draw_all(buffers, (width, height), (0, 0));
    assert!(words.iter().all(|words| words.iter().filter(|&&word| word > 0).count() > 2500));
    let plain = draw_all([(); 2].map(|()| Plain::new(64, 48)), (width, height), (0, 0));
    assert!(words[0] == plain[0].words && words[1] == plain[1].words);
    for (wide, origin) in [(800, (730, 3)), (816, (752, 0)), (817, (0, 2)), (2000, (1900, 1))] {
        let plains = [(); 2].map(|()| Plain::new(wide, 52));
        for (words, target) in words.iter().zip(draw_all(plains, (wide as u32, 52), origin)) {
            for (y, row) in words.chunks(64).enumerate() {
                let start = (y + origin.1 as usize) * wide + origin.0 as usize;
                assert_eq!(row, &target.words[start..start + 64], "row {y} of {wide} wide");
            }
        }
    }
}

/// A colour of many is drawn where one is: small triangles too, without depth.
#[test]
fn colours_of_any_kind_are_drawn_without_depth() {
    let frame = || Frame::new(Plain::new(16, 16)).unwrap().with_tier(Quick::<8>);
    let (mut flat, mut checkers) = (frame(), frame());
    let corner = |x: i32, y: i32| {
        let [x, y] = [x, y].map(|v| I16F16::from_bits(v << 12));
        (ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
    };
    let corners = [corner(-9, -8), corner(7, -5), corner(2, 11)];
    flat.draw_triangle(corners, &Flat(Rgb565(1)));
    checkers.draw_triangle(corners, &Checkers(1));
    let (flat, checkers) = (flat.into_parts().0.words, checkers.into_parts().0.words);
    assert!(flat.iter().filter(|&&word| word > 0).count() > 30);
    for (n, (flat, checkers)) in flat.iter().zip(checkers).enumerate() {
        let odd = ((n % 16) ^ (n / 16)) & 1 == 1;
        assert_eq!(checkers, flat * if odd { 601 } else { 1 }, "pixel {n}");
    }
}

#[test]
fn a_target_of_another_size_than_the_depth_buffer_shows_nothing() {
    let (mut words, mut others, mut depths) = ([0; 64], [0; 64], [u16::MAX; 64]);
    let buffer = Framebuffer::<Rgb565>::try_new(&mut words, 8, 8).unwrap();
    let hither = Hither::new(I16F16::ONE).unwrap();
    let frame = Frame::new(buffer).unwrap().with_tier(Quick::<8>).with_hither(hither);
    let depth = DepthBuffer::try_new(&mut depths, 8, 8).unwrap();
    let mut frame = frame.with_depth(depth).unwrap();
    let corner = |x: i32, y: i32| {
        let [x, y] = [x, y].map(I16F16::from_num);
        (ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
    };
    let corners = [corner(-1, -1), corner(1, -1), corner(0, 1)];
    assert_eq!(frame.draw_triangle(corners, &Flat(Rgb565(7))), Outcome::Drawn);
    *frame.target_mut() = Framebuffer::<Rgb565>::try_new(&mut others, 4, 4).unwrap();
    assert_eq!(frame.draw_triangle(corners, &Flat(Rgb565(7))), Outcome::OffScreen);
    assert!(words.contains(&7) && !others.contains(&7));
}

#[test]
fn an_empty_vertex_draws_nothing() {
    let mut words = [0; 64];
    let buffer = Framebuffer::<Rgb565>::try_new(&mut words, 8, 8).unwrap();
    let mut frame = Frame::new(buffer).unwrap().with_tier(Quick::<8>);
    let corner = |x: i32, y: i32| {
        let [x, y] = [x, y].map(I16F16::from_num);
        frame.snap(&ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
    };
    let [a, b] = [corner(1, 1), corner(1, -1)];
    let colors = [Rgb565(7)];
    let fragment = FaceColors::new(&colors).unwrap();
    let outcome = frame.draw_snapped([&a, &Vertex::EMPTY, &b], &fragment);
    assert_eq!(outcome, Outcome::ZeroArea);
    assert_eq!(words, [0; 64]);
}

#[test]
fn counts_add_up() {
    let all = [
        Outcome::Drawn,
        Outcome::DrawnByFallback,
        Outcome::Culled,
        Outcome::Behind,
        Outcome::Clipped,
        Outcome::OffScreen,
        Outcome::ZeroArea,
    ];
    let mut counts = Counts::default();
    for outcome in all {
        counts.add(outcome);
    }
    assert_eq!((counts.drawn, counts.fallbacks, counts.total()), (2, 1, 7));
    counts += counts;
    assert_eq!((counts.drawn, counts.fallbacks, counts.total()), (4, 2, 14));
    counts += Counts { drawn: u32::MAX, ..Counts::default() };
    assert_eq!(counts.drawn, u32::MAX);
}

/// A tiny triangle has the same depths whether it is the first that a frame draws, as in a band, or not.
#[test]
fn the_first_triangle_of_a_frame_is_as_any_other() {
    let mut state = 7u64;
    let mut below = |n: i64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as i64 % n
    };
    let hither = Hither::new(I16F16::ONE).unwrap();
    let mut drawn = 0;
    for _ in 0..20_000 {
        let corners = [0; 3].map(|_| {
            let w = (1 << 16) + below(9 << 16);
            let [x, y] = [0; 2].map(|_| ((below(1 << 16) - (1 << 15)) * w) >> 18);
            let [x, y, z, w] = [x, y, below(w), w].map(|v| I16F16::from_bits(v as i32));
            (ClipVertex::new(x, y, z, w), [])
        });
        let depths = [false, true].map(|seen| {
            let (mut color, mut depth) = ([0; 32 * 32], [u16::MAX; 32 * 32]);
            let target = Framebuffer::<Rgb565>::try_new(&mut color, 32, 32).unwrap();
            let depths = DepthBuffer::try_new(&mut depth, 32, 32).unwrap();
            let frame = Frame::new(target).unwrap().with_hither(hither);
            let mut frame = frame.with_depth(depths).unwrap();
            if seen {
                let _ = frame.known_window();
            }
            frame.draw_triangle(corners, &Flat(Rgb565(1)));
            depth
        });
        assert_eq!(depths[0], depths[1], "{corners:?}");
        drawn += usize::from(depths[0].iter().any(|&depth| depth != u16::MAX));
    }
    assert!(drawn > 10_000, "{drawn}");
}

/// Dashes of a line that are left out are neither drawn nor stored, in either way of lines, with depth and without.
#[test]
fn lines_leave_out_what_is_discarded() {
    #[derive(Clone, Copy)]
    struct Dashes;

    impl Fragment<Rgb565, 0> for Dashes {
        const UNIFORM: bool = false;
        const DISCARDS: bool = true;

        fn shade(&self, _: Sample<0>) -> Rgb565 {
            Rgb565(1)
        }

        fn shade_or_discard(&self, sample: Sample<0>) -> Option<Rgb565> {
            (sample.x % 2 == 0).then_some(Rgb565(1))
        }
    }

    fn drawn<T: Tier>() -> [Vec<u32>; 3] {
        let corner = |x: i32, y: i32| {
            let [x, y] = [x, y].map(|v| I16F16::from_bits(v << 12));
            ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE)
        };
        let ends = [corner(-15, 2), corner(15, -2)];
        let hither = Hither::new(I16F16::ONE).unwrap();
        let (mut bare, mut color, mut depth) = ([0; 256], [0; 256], [u16::MAX; 256]);
        let target = Framebuffer::<Rgb565>::try_new(&mut bare, 16, 16).unwrap();
        let mut frame = Frame::new(target).unwrap().with_tier(T::default());
        let [a, b] = ends.map(|end| frame.snap(&end, []));
        frame.draw_line([&a, &b], DepthBias::NONE, &Dashes);
        let target = Framebuffer::<Rgb565>::try_new(&mut color, 16, 16).unwrap();
        let depths = DepthBuffer::try_new(&mut depth, 16, 16).unwrap();
        let frame = Frame::new(target).unwrap().with_tier(T::default()).with_hither(hither);
        let mut frame = frame.with_depth(depths).unwrap();
        let [a, b] = ends.map(|end| frame.snap(&end, []));
        frame.draw_line([&a, &b], DepthBias::NONE, &Dashes);
        let columns = |changed: &dyn Fn(usize) -> bool| {
            (0..256).filter(|&at| changed(at)).map(|at| at as u32 % 16).collect::<Vec<_>>()
        };
        let mut all = [
            columns(&|at| bare[at] != 0),
            columns(&|at| color[at] != 0),
            columns(&|at| depth[at] != u16::MAX),
        ];
        all.iter_mut().for_each(|columns| columns.sort_unstable());
        all
    }
    let even: Vec<u32> = (0..8).map(|x| 2 * x).collect();
    for columns in [drawn::<Quick<8>>(), drawn::<Quick<4>>(), drawn::<Exact>()] {
        assert!(columns.iter().all(|columns| *columns == even), "{columns:?}");
    }
}
