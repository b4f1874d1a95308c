//! A checksum for each of a few pictures that together go through every tier and correction: the
//! same numbers on every machine.

use crate::checksum::checksum;
use crate::spinning_teapot::{CULL, HITHER, Moment, draw};
use hither::{
    Affine, Correction, DepthBuffer, Exact, Frame, Framebuffer, Perspective, PerspectiveEvery,
    Quick, Rgb565Be, Tier, Vertex,
};

/// Width and height of the pictures, in pixels: what the buffers hold.
pub const SIDE: u32 = 64;

/// Words that each buffer has.
pub const WORDS: usize = (SIDE * SIDE) as usize;

/// Fewer than the vertices of a scene, so that both the cached and the transformed are drawn.
const CACHE: usize = 64;

/// Draws each picture into the buffers that are lent, and reports its name and the checksum of its
/// colours and of its depths.
pub fn draw_all(
    color: &mut [u16; WORDS],
    depth: &mut [u16; WORDS],
    mut report: impl FnMut(&str, u32, u32),
) {
    let mut picture = |name: &str, draw: fn(&mut [u16; WORDS], &mut [u16; WORDS])| {
        draw(color, depth);
        let stored = checksum_of_words(depth);
        report(name, checksum_of_words(color), stored);
    };
    picture("exact", |c, d| teapot(Exact, Perspective, c, d));
    picture("exact affine", |c, d| teapot(Exact, Affine, c, d));
    picture("quick8", |c, d| teapot(Quick::<8>, PerspectiveEvery::<16>, c, d));
    picture("quick4", |c, d| teapot(Quick::<4>, PerspectiveEvery::<32>, c, d));
}

/// Of words by value: depths are numbers, whatever their byte order in memory.
fn checksum_of_words(words: &[u16]) -> u32 {
    words.iter().fold(0, |sum: u32, word| sum.rotate_left(5) ^ checksum(&word.to_le_bytes()))
}

/// The turning teapot on its ground, close enough that the ground reaches behind the eye's plane.
fn teapot<T: Tier, I: Correction>(
    tier: T,
    correction: I,
    color: &mut [u16; WORDS],
    depth: &mut [u16; WORDS],
) {
    let mut cache = [Vertex::EMPTY; CACHE];
    let Ok(target) = Framebuffer::<Rgb565Be>::try_new(color, SIDE, SIDE) else { return };
    let Ok(depth) = DepthBuffer::try_new(depth, SIDE, SIDE) else { return };
    let Ok(frame) = Frame::new(target) else { return };
    let Ok(frame) = frame.with_hither(HITHER).with_depth(depth) else { return };
    let mut frame = frame.with_tier(tier).with_correction(correction).with_cull(CULL);
    // The numbers of the scene are constants in range; the host's tests would see an error.
    let _ = draw(&mut frame, Moment { number: 5, frames: 48 }, &mut cache);
}
