//! Pixels of a key colour: neither drawn nor stored, whatever way a triangle takes to its pixels.

use super::{Checkers, Plain};
use crate::clip::Hither;
use crate::color::Rgb565;
use crate::depth::DepthBuffer;
use crate::draw::Frame;
use crate::fragment::{FaceColors, Fragment, Gouraud, Keyed, Textured};
use crate::framebuffer::Framebuffer;
use crate::interpolation::{Correction, Interpolates, Packed, Perspective, PerspectiveEvery};
use crate::setup::Tier;
use crate::texture::Texture;
use crate::vertex::{ClipVertex, Exact, Quick, Viewport};
use fixed::types::I16F16;
use std::vec;
use std::vec::Vec;

const SIDE: u32 = 64;
const KEY: Rgb565 = Rgb565(0x7be0);

/// A triangle: tiny, small or large, cut by the hither plane or not.
fn corners<const N: usize>(below: &mut impl FnMut(i32) -> i32) -> [(ClipVertex, [I16F16; N]); 3] {
    let reach = 2 << below(18);
    let at = [0, 1].map(|_| below(1 << 17) - (1 << 16));
    let (near, level) = (below(4) == 0, below(3) == 0);
    [(); 3].map(|()| {
        let w = match (near, level) {
            (true, _) => below(5 << 16) - (1 << 15),
            (_, true) => 1 << 16,
            _ => (1 << 16) + below(1 << 16),
        };
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

/// A frame over all of a viewport that is not the target's.
macro_rules! frame {
    ($target:expr, $tier:ty, $correction:ty) => {
        Frame::with_viewport($target, Viewport::new(70, 60).unwrap().with_origin(-3, 2))
            .with_tier(<$tier>::default())
            .with_hither(Hither::new(I16F16::ONE).unwrap())
            .with_correction(<$correction>::default())
    };
}

fn buffer(words: &mut [u16]) -> Framebuffer<'_, Rgb565> {
    Framebuffer::try_new(words, SIDE, SIDE).unwrap()
}

fn depth(words: &mut [u16]) -> DepthBuffer<'_> {
    DepthBuffer::try_new(words, SIDE, SIDE).unwrap()
}

/// Draws random triangles over each other, of which pixels of the key are left out. The same triangles are drawn here with
/// all of their pixels, over what there was, and what is not the key is kept. Returned is how many pixels were the key and how
/// many were not.
fn check<T: Tier, I: Correction, F: Fragment<Rgb565, N>, const N: usize>(
    below: &mut impl FnMut(i32) -> i32,
    fragment: F,
) -> [usize; 2]
where
    Hither: Interpolates<N>,
{
    let size = (SIDE * SIDE) as usize;
    let (mut words, mut depths) = (vec![0u16; size], vec![0xffffu16; size]);
    let (mut shown, mut stored) = (words.clone(), depths.clone());
    let mut frame = frame!(buffer(&mut words), T, I).with_depth(depth(&mut depths)).unwrap();
    frame.draw_triangle(unseen(), &Keyed(fragment, KEY));
    let mut counts = [0, 0];
    for n in 0..400 {
        let triangle = corners::<N>(below);
        let (mut whole, mut whole_depths) = (shown.clone(), stored.clone());
        let all = frame!(buffer(&mut whole), T, I).with_depth(depth(&mut whole_depths));
        let mut all = all.unwrap();
        all.draw_triangle(unseen(), &fragment);
        let outcome = all.draw_triangle(triangle, &fragment);
        for i in 0..size {
            // Nearer is drawn.
            if whole_depths[i] != stored[i] {
                let key = whole[i] == KEY.0;
                counts[usize::from(!key)] += 1;
                if !key {
                    (shown[i], stored[i]) = (whole[i], whole_depths[i]);
                }
            }
        }
        assert_eq!(frame.draw_triangle(triangle, &Keyed(fragment, KEY)), outcome);
        assert!(frame.target().words() == shown, "{n}: {triangle:?}");
        assert!(frame.depth().words() == stored, "{n}: {triangle:?}");
    }
    counts
}

/// The same without depth, and with it in a target that can no more than it must.
fn check_others<F: Fragment<Rgb565, N>, const N: usize>(
    below: &mut impl FnMut(i32) -> i32,
    fragment: F,
) where
    Hither: Interpolates<N>,
{
    type Every = Packed<PerspectiveEvery<8>>;
    let size = (SIDE * SIDE) as usize;
    let (mut words, mut shown) = (vec![0u16; size], vec![0u16; size]);
    let mut depths = [vec![0xffffu16; size], vec![0xffffu16; size]];
    let [one, other] = &mut depths;
    let mut deep_words = vec![0u16; size];
    let deep = frame!(buffer(&mut deep_words), Quick<8>, Every).with_depth(depth(one));
    let plain = Plain::new(SIDE as usize, SIDE as usize);
    let plain = frame!(plain, Quick<8>, Every).with_depth(depth(other));
    let (mut deep, mut plain) = (deep.unwrap(), plain.unwrap());
    let mut flat = frame!(buffer(&mut words), Quick<8>, Every);
    let keyed = Keyed(fragment, KEY);
    for n in 0..400 {
        let triangle = corners::<N>(below);
        let mut whole = shown.clone();
        frame!(buffer(&mut whole), Quick<8>, Every).draw_triangle(triangle, &fragment);
        for (shown, color) in shown.iter_mut().zip(whole) {
            *shown = if color == KEY.0 { *shown } else { color };
        }
        flat.draw_triangle(triangle, &keyed);
        assert!(flat.target().words() == shown, "{n}: {triangle:?}");
        deep.draw_triangle(triangle, &keyed);
        plain.draw_triangle(triangle, &keyed);
        assert!(deep.target().words() == plain.target().words, "{n}: {triangle:?}");
        assert!(deep.depth().words() == plain.depth().words(), "{n}: {triangle:?}");
    }
}

#[test]
fn the_key_is_neither_drawn_nor_stored() {
    let mut state = 31u64;
    let mut below = move |n: i32| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        ((state >> 33) % u64::from(n.unsigned_abs())) as i32
    };
    let texels: Vec<u16> =
        (0..64).map(|i| if (i ^ i >> 3) & 1 == 0 { KEY.0 } else { i * 977 + 1 }).collect();
    let texture = Textured(Texture::<Rgb565>::try_new(&texels, 8, 8).unwrap());
    let keys = FaceColors::new(&[KEY]).unwrap();
    let mut counts = [0; 2];
    macro_rules! all {
        ($tier:ty, $correction:ty) => {{
            let each = [
                check::<$tier, $correction, _, 2>(&mut below, texture),
                check::<$tier, $correction, _, 0>(&mut below, Checkers(KEY.0)),
                check::<$tier, $correction, _, 3>(&mut below, Gouraud),
            ];
            for [keys, others] in each {
                counts = [counts[0] + keys, counts[1] + others];
            }
        }};
    }
    all!(Exact, Perspective);
    all!(Quick<8>, Packed<PerspectiveEvery<8>>);
    all!(Quick<4>, PerspectiveEvery<4>);
    assert!(counts[0] > 50_000 && counts[1] > 50_000, "{counts:?}");
    check_others::<_, 2>(&mut below, texture);
    check_others::<_, 0>(&mut below, Checkers(KEY.0));
    // A colour for all of a triangle is left out as a whole.
    check_others::<_, 0>(&mut below, keys);
}
