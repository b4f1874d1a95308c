//! A checksum for each of a few pictures that together go through every tier and correction: the
//! same numbers on every machine.

use crate::checksum::checksum_of_words;
use crate::spinning_teapot::Moment;
use crate::{floor, spinning_teapot};
use hither::{
    Affine, Correction, DepthBuffer, Exact, Frame, Framebuffer, Hither, Perspective,
    PerspectiveEvery, Quick, Rgb565Be, Tier, Vertex,
};

/// Width and height of the pictures, in pixels: what the buffers hold.
pub const SIDE: u32 = 64;

/// Words that each buffer has.
pub const WORDS: usize = (SIDE * SIDE) as usize;

/// Fewer than the vertices of a scene, so that both the cached and the transformed are drawn.
const CACHE: usize = 64;

/// The frame that a picture is drawn into.
type Canvas<'a, T, I> = Frame<Framebuffer<'a, Rgb565Be>, DepthBuffer<'a>, Hither, T, I>;

/// Draws each picture into the buffers that are lent, and reports its name and the checksum of its
/// colours and of its depths.
///
/// What cannot be drawn is reported as zeros; a test sees that nothing is.
pub fn draw_all(
    color: &mut [u16; WORDS],
    depth: &mut [u16; WORDS],
    mut report: impl FnMut(&str, u32, u32),
) {
    let mut picture =
        |name: &str, draw: fn(&mut [u16; WORDS], &mut [u16; WORDS]) -> Option<()>| match draw(
            color, depth,
        ) {
            Some(()) => report(name, checksum_of_words(color), checksum_of_words(depth)),
            None => report(name, 0, 0),
        };
    picture("exact", |c, d| teapot(Exact, Perspective, c, d));
    picture("exact affine", |c, d| teapot(Exact, Affine, c, d));
    picture("exact floor", |c, d| floor(Exact, Perspective, c, d));
    picture("quick8", |c, d| teapot(Quick::<8>, PerspectiveEvery::<16>, c, d));
    picture("quick8 floor", |c, d| floor(Quick::<8>, Affine, c, d));
    picture("quick4", |c, d| teapot(Quick::<4>, PerspectiveEvery::<32>, c, d));
}

/// A frame over the buffers.
fn canvas<'a, T: Tier, I: Correction>(
    (tier, correction): (T, I),
    hither: Hither,
    color: &'a mut [u16; WORDS],
    depth: &'a mut [u16; WORDS],
) -> Option<Canvas<'a, T, I>> {
    let target = Framebuffer::try_new(color, SIDE, SIDE).ok()?;
    let depth = DepthBuffer::try_new(depth, SIDE, SIDE).ok()?;
    let frame = Frame::new(target).ok()?.with_hither(hither).with_depth(depth).ok()?;
    Some(frame.with_tier(tier).with_correction(correction))
}

/// The turning teapot on its ground.
fn teapot<T: Tier, I: Correction>(
    tier: T,
    correction: I,
    color: &mut [u16; WORDS],
    depth: &mut [u16; WORDS],
) -> Option<()> {
    let mut cache = [Vertex::EMPTY; CACHE];
    let mut frame = canvas((tier, correction), spinning_teapot::HITHER, color, depth)?
        .with_cull(spinning_teapot::CULL);
    let moment = Moment { number: 5, frames: 48 };
    spinning_teapot::draw(&mut frame, moment, &mut cache).ok().map(drop)
}

/// The floor that the hither plane cuts.
fn floor<T: Tier, I: Correction>(
    tier: T,
    correction: I,
    color: &mut [u16; WORDS],
    depth: &mut [u16; WORDS],
) -> Option<()> {
    let mut frame = canvas((tier, correction), floor::HITHER, color, depth)?;
    floor::draw(&mut frame).ok().map(drop)
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate std;

    #[test]
    fn every_picture_is_another_and_shows_something() {
        let (mut color, mut depth) = ([0; WORDS], [0; WORDS]);
        let mut sums = std::vec::Vec::new();
        draw_all(&mut color, &mut depth, |name, color, depth| {
            assert!(color != 0 && depth != 0, "{name} could not be drawn");
            sums.push(color);
        });
        // The last picture covers a good part of the frame.
        assert!(depth.iter().filter(|depth| **depth != u16::MAX).count() > WORDS / 2);
        let drawn = sums.len();
        sums.sort_unstable();
        sums.dedup();
        assert_eq!((sums.len(), drawn), (6, 6));
    }
}
