//! A target that records what is drawn, and fragments that show what they were given.

use hither::{
    ClipVertex, Exact, Fidelity, Fragment, Frame, I16F16, NoDepth, NoHither, Perspective, Sample,
    Target,
};

use crate::oracle::Viewport;

/// A target that keeps every pixel written, in the order of the writing.
#[derive(Clone, Debug)]
pub struct Record<C> {
    size: (u32, u32),
    /// Column, row and colour of each pixel written.
    pub pixels: Vec<(u32, u32, C)>,
}

impl<C> Record<C> {
    /// A target of `width x height` pixels on which nothing is drawn yet.
    #[must_use]
    pub const fn new(width: u32, height: u32) -> Self {
        Self { size: (width, height), pixels: Vec::new() }
    }

    /// How often each pixel was written, row by row from the top; what was recorded is forgotten.
    pub fn take_counts(&mut self) -> Vec<u8> {
        let (width, height) = self.size;
        let mut counts = vec![0u8; width as usize * height as usize];
        for (x, y, _) in self.pixels.drain(..) {
            let count = &mut counts[(y * width + x) as usize];
            *count = count.saturating_add(1);
        }
        counts
    }
}

impl<C: Copy> Target for Record<C> {
    type Color = C;

    fn size(&self) -> (u32, u32) {
        self.size
    }

    fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<C>>) {
        let (width, height) = self.size;
        assert!(y < height as usize, "row {y} of {height}");
        for (x, color) in (x..).zip(colors) {
            assert!(x < width as usize, "column {x} of {width}");
            if let Some(color) = color {
                self.pixels.push((x as u32, y as u32, color));
            }
        }
    }
}

/// Marks a pixel as covered.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mark;

impl Fragment<(), 0> for Mark {
    fn shade(&self, _: Sample<0>) {}
}

/// Shows the varyings.
#[derive(Clone, Copy, Debug, Default)]
pub struct Probe;

impl<const N: usize> Fragment<[I16F16; N], N> for Probe {
    const UNIFORM: bool = false;

    fn shade(&self, sample: Sample<N>) -> [I16F16; N] {
        sample.varyings
    }
}

/// Shows the pixel that the fragment believes it is at.
#[derive(Clone, Copy, Debug, Default)]
pub struct Place;

impl<const N: usize> Fragment<(i32, i32), N> for Place {
    const UNIFORM: bool = false;

    fn shade(&self, sample: Sample<N>) -> (i32, i32) {
        (sample.x, sample.y)
    }
}

/// What [`frame`] makes.
pub type Exactly<C> = Frame<Record<C>, NoDepth, NoHither, Exact, Perspective>;

/// A frame of the exact tier over a recording target.
///
/// # Panics
///
/// Where a side is not 1 to 512.
#[must_use]
pub fn frame<C: Copy>(viewport: Viewport) -> Exactly<C> {
    let target = Record::new(viewport.width, viewport.height);
    let frame = Frame::new(target).expect("sides of 1 to 512");
    frame.with_preset(Fidelity)
}

/// A vertex from raw coordinates `[x, y, z, w]`.
///
/// # Panics
///
/// Where one does not fit 32 bits.
#[must_use]
pub fn clip_vertex(raw: [i64; 4]) -> ClipVertex {
    let [x, y, z, w] = raw.map(|v| I16F16::from_bits(i32::try_from(v).expect("raw Q16.16")));
    ClipVertex::new(x, y, z, w)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn skipped_pixels_are_not_recorded() {
        let mut record = Record::new(4, 2);
        record.write(1, 1, [Some(7), None, Some(9)].into_iter());
        record.fill(0, 0, 2, 3);
        assert_eq!(record.pixels, [(1, 1, 7), (3, 1, 9), (0, 0, 3), (1, 0, 3)]);
        record.fill(3, 1, 1, 5);
        assert_eq!(record.take_counts(), [1, 1, 0, 0, 0, 1, 0, 2]);
        assert!(record.pixels.is_empty());
    }

    #[test]
    #[should_panic(expected = "column 4 of 4")]
    fn a_pixel_outside_is_an_error() {
        Record::new(4, 2).fill(2, 0, 3, ());
    }
}
