//! Lines between projected vertices against the way that draws any.

use super::*;
use crate::depth::{Always, DepthBias};
use crate::fragment::Flat;
use crate::vertex::ClipVertex;

/// Pixels are the same, and depths within a unit and nearly all the same, of any lengths, on the screen and beyond it.
fn projected_lines_are_as_any<T: Tier>(mut seed: u32) {
    let mut below = |n: i32| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        ((u64::from(seed) * n as u64) >> 32) as i32
    };
    let (mut lines, mut pixels, mut other) = (0, 0, 0);
    for case in 0..16_000 {
        let [width, height] = [(); 2].map(|()| 1 + below(if case % 8 == 0 { 512 } else { 70 }));
        let viewport = Viewport::new(width as u32, height as u32).unwrap();
        let size = (width * height) as usize;
        let reach = 2 << below(18);
        let at = [(); 2].map(|()| below(3 << 16) - (3 << 15));
        let ends = [(); 2].map(|()| {
            let w = (1 << 16) + below(3 << 16);
            let scaled = |v: i32| I16F16::from_bits(((i64::from(v) * i64::from(w)) >> 16) as i32);
            let [x, y] = at.map(|v| scaled(v + below(2 * reach) - reach));
            let z = I16F16::from_bits(match below(8) {
                0 => 0,
                1 => w,
                _ => below(w + 1),
            });
            ClipVertex::new(x, y, z, I16F16::from_bits(w))
        });
        let bias = DepthBias([0, 0, 1, 128, u16::MAX][below(5) as usize]);
        let draw = |fast: bool, swapped: bool| {
            let (mut colors, mut depths) = (vec![0u16; size], vec![0u16; size]);
            let target = Framebuffer::<Rgb565>::try_new(&mut colors, width as u32, height as u32);
            let depth = DepthBuffer::try_new(&mut depths, width as u32, height as u32).unwrap();
            let mut frame = Frame::with_viewport(target.unwrap(), viewport)
                .with_tier(T::default())
                .with_hither(Hither::new(I16F16::ONE).unwrap())
                .with_depth(depth.with_compare(Always))
                .unwrap();
            let [a, b] = ends.map(|end| frame.snap(&end, []));
            let both = a.outside.0 & b.outside.0;
            assert!(both & Outside::RANGED != 0 || both & Outside::PROJECTED == 0, "{ends:?}");
            let order = if swapped { [&b, &a] } else { [&a, &b] };
            let white = Flat(Rgb565::WHITE);
            if fast {
                frame.draw_line(order, bias, &white);
            } else {
                let points = order.map(|v| T::in_pixels(&v.position, &viewport).point);
                frame.draw_part_of_line(order, points, bias, &white);
            }
            (colors, depths, both & Outside::PROJECTED != 0)
        };
        let (colors, depths, projected) = draw(true, case % 2 == 0);
        let any = draw(false, false);
        assert_eq!(colors, any.0, "case {case}: {ends:?} on {viewport:?}");
        for (a, b) in depths.iter().zip(&any.1) {
            assert!(
                a.abs_diff(*b) <= 1,
                "case {case}: {a} for {b}, {ends:?}, {bias:?}, {viewport:?}"
            );
            other += usize::from(a != b);
        }
        lines += usize::from(projected);
        pixels += colors.iter().filter(|color| **color != 0).count();
    }
    assert!(lines > 12_000 && pixels > 50_000 && other * 1000 < pixels, "{lines} {pixels} {other}");
}

#[test]
fn lines_of_projected_ends_are_as_any_with_4_subpixel_bits() {
    projected_lines_are_as_any::<Quick<4>>(1);
}

#[test]
fn lines_of_projected_ends_are_as_any_with_8_subpixel_bits() {
    projected_lines_are_as_any::<Quick<8>>(2);
}
