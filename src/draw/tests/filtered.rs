//! Textures through whole frames, against `f64`: repeated and clamped, nearest and filtered.

use crate::clip::Hither;
use crate::color::Rgb888;
use crate::depth::DepthBuffer;
use crate::draw::Frame;
use crate::fragment::{Fragment, Textured};
use crate::framebuffer::Framebuffer;
use crate::interpolation::{Correction, Packed, Perspective, PerspectiveEvery};
use crate::setup::Tier;
use crate::texture::Texture;
use crate::vertex::{ClipVertex, Exact, Quick};
use fixed::types::I16F16;
use std::vec;
use std::vec::Vec;

const SIDE: u32 = 64;

/// A triangle over all of the screen: `w`, `u` and `v` of its corners, exact on every grid.
#[derive(Clone, Copy, Debug)]
struct Wall {
    w: [f64; 3],
    uv: [[f64; 2]; 3],
}

impl Wall {
    /// A texture's pixels, row by row.
    fn drawn<T: Tier, I: Correction>(&self, fragment: &impl Fragment<Rgb888, 2>) -> Vec<u32> {
        let size = (SIDE * SIDE) as usize;
        let (mut words, mut depths) = (vec![0xffff_ffff; size], vec![0xffffu16; size]);
        let buffer = Framebuffer::<Rgb888>::try_new(&mut words, SIDE, SIDE).unwrap();
        let frame = Frame::new(buffer).unwrap().with_hither(Hither::new(I16F16::ONE).unwrap());
        let frame = frame.with_tier(T::default()).with_correction(I::default());
        let depth = DepthBuffer::try_new(&mut depths, SIDE, SIDE).unwrap();
        let mut frame = frame.with_depth(depth).unwrap();
        let mut corners = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]].iter().zip(self.w).zip(self.uv);
        let corners = [(); 3].map(|()| {
            let ((at, w), uv) = corners.next().unwrap();
            let [x, y, w] = [at[0] * w, at[1] * w, w].map(I16F16::from_num);
            (ClipVertex::new(x, y, I16F16::ZERO, w), uv.map(I16F16::from_num))
        });
        frame.draw_triangle(corners, fragment);
        words
    }

    /// The coordinates at a pixel's centre.
    fn at(&self, pixel: usize) -> [f64; 2] {
        let centre = |v: usize| (v as f64 + 0.5) / f64::from(SIDE);
        let (p, q) = (centre(pixel % SIDE as usize) / 2.0, centre(pixel / SIDE as usize) / 2.0);
        let q = 0.5 - q;
        let parts = [(1.0 - p - q) / self.w[0], p / self.w[1], q / self.w[2]];
        let sum: f64 = parts.iter().sum();
        [0, 1].map(|i| (0..3).map(|k| self.uv[k][i] * parts[k]).sum::<f64>() / sum)
    }
}

/// The greens of a texture whose other channels are 0.
struct Reference<'a> {
    texels: &'a [u32],
    size: [usize; 2],
    clamps: bool,
}

impl Reference<'_> {
    fn texel(&self, at: [f64; 2]) -> f64 {
        let [x, y] = [0, 1].map(|i| {
            let side = self.size[i] as f64;
            if self.clamps { at[i].clamp(0.0, side - 1.0) } else { at[i].rem_euclid(side) }
        });
        f64::from(self.texels[y as usize * self.size[0] + x as usize] >> 8)
    }

    /// Filtered.
    fn filtered(&self, uv: [f64; 2]) -> f64 {
        let [x, y] = [0, 1].map(|i| uv[i] * self.size[i] as f64 - 0.5);
        let ([a, b], [x, y]) = ([x - x.floor(), y - y.floor()], [x.floor(), y.floor()]);
        let row = |y: f64| self.texel([x, y]) * (1.0 - a) + self.texel([x + 1.0, y]) * a;
        row(y) * (1.0 - b) + row(y + 1.0) * b
    }

    /// The texel that holds the place, if it is not within `margin` of a texel of another.
    fn nearest(&self, uv: [f64; 2], margin: f64) -> Option<f64> {
        let at = [0, 1].map(|i| uv[i] * self.size[i] as f64);
        let sure = at.iter().all(|at| (margin..1.0 - margin).contains(&at.rem_euclid(1.0)));
        sure.then(|| self.texel(at.map(f64::floor)))
    }
}

const WALLS: [Wall; 4] = [
    Wall { w: [1.0; 3], uv: [[0.0, 1.0], [2.0, 1.0], [0.0, -1.0]] },
    Wall { w: [1.0, 2.0, 4.0], uv: [[-0.75, 1.5], [2.5, 1.25], [0.5, -1.75]] },
    Wall { w: [2.0, 1.0, 1.5], uv: [[3.25, -2.5], [-1.0, 0.5], [0.25, 2.0]] },
    Wall { w: [1.0, 1.0, 8.0], uv: [[0.25, 0.75], [0.75, 0.75], [0.25, -0.5]] },
];

/// Every wall in a tier and a correction: `slack` is how far a coordinate may be off.
fn check<T: Tier, I: Correction>(slack: f64) {
    for (width, height) in [(8, 8), (5, 3), (1, 1), (64, 2), (1, 7)] {
        let mut state = 77u32;
        let texels: Vec<u32> = (0..width * height)
            .map(|_| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                state >> 16 & 0xff00
            })
            .collect();
        let texture = Texture::<Rgb888>::try_new(&texels, width, height).unwrap();
        for wall in &WALLS {
            for clamps in [false, true] {
                let size = [width as usize, height as usize];
                let reference = Reference { texels: &texels, size, clamps };
                let (clamped, smooth) = (texture.clamped(), texture.bilinear());
                let (nearest, smooth) = if clamps {
                    let nearest = wall.drawn::<T, I>(&Textured(clamped));
                    (nearest, wall.drawn::<T, I>(&Textured(clamped.bilinear())))
                } else {
                    let nearest = wall.drawn::<T, I>(&Textured(texture));
                    (nearest, wall.drawn::<T, I>(&Textured(smooth)))
                };
                let side = f64::from(width.max(height));
                // A texel's difference is at most 255 along each side.
                let bound = 1.5 + 255.0 * slack * f64::from(width + height);
                for (i, (near, smooth)) in nearest.into_iter().zip(smooth).enumerate() {
                    let uv = wall.at(i);
                    let exact = reference.filtered(uv);
                    let off = (f64::from(smooth >> 8) - exact).abs();
                    let got = smooth >> 8;
                    assert!(off <= bound, "{i}: {got}, not {exact}, {wall:?} {size:?} {clamps}");
                    if let Some(exact) = reference.nearest(uv, slack * side) {
                        assert_eq!(
                            f64::from(near >> 8),
                            exact,
                            "{i}: {uv:?} {wall:?} {size:?} {clamps}"
                        );
                    }
                }
            }
        }
    }
}

/// A varying is off by up to 1.7e-4 of its range, and no coordinate here by more than that.
#[test]
fn textures_in_the_exact_tier_are_near_the_reference() {
    check::<Exact, Perspective>(3e-4);
}

/// Pieces of 8 pixels, and of 4, where `w` changes by up to 8 over two screens.
#[test]
fn textures_in_quick_tiers_are_near_the_reference() {
    check::<Quick<8>, Packed<PerspectiveEvery<8>>>(0.008);
    check::<Quick<4>, PerspectiveEvery<4>>(0.008);
}
