//! A target that checks every write.

use crate::place::Place;
use core::ops::Range;
use hither::{Fragment, I16F16, Sample, Target};

/// A target that keeps, for each pixel of the viewport, what was drawn there last. It panics where
/// a pixel outside of the scissor or the target is written, or one is written twice between two
/// calls of [`take_written`](Self::take_written) (unless overdraw is allowed).
#[derive(Clone, Debug, PartialEq)]
pub struct Checked<C> {
    place: (i64, i64),
    size: (u32, u32),
    width: usize,
    shown: [Range<i64>; 2],
    /// The last colour of each of the viewport's pixels.
    pub pixels: Vec<Option<C>>,
    written: Vec<bool>,
    overdraw: bool,
}

impl<C: Clone> Checked<C> {
    /// A target on which nothing is drawn yet.
    #[must_use]
    pub fn new(place: &Place) -> Self {
        let pixels = place.size.0 as usize * place.size.1 as usize;
        Self {
            place: (i64::from(place.origin.0), i64::from(place.origin.1)),
            size: place.target,
            width: place.size.0 as usize,
            shown: place.shown(),
            pixels: vec![None; pixels],
            written: vec![false; pixels],
            overdraw: false,
        }
    }

    /// The same, where a pixel may be written any number of times.
    #[must_use]
    pub fn with_overdraw(self) -> Self {
        Self { overdraw: true, ..self }
    }

    /// Which pixels were written since the last call; all may be written again.
    pub fn take_written(&mut self) -> Vec<bool> {
        let clear = vec![false; self.written.len()];
        std::mem::replace(&mut self.written, clear)
    }
}

impl<C: Copy> Target for Checked<C> {
    type Color = C;

    fn size(&self) -> (u32, u32) {
        self.size
    }

    fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<C>>) {
        let row = i64::try_from(y).expect("a row") - self.place.1;
        let first = i64::try_from(x).expect("a column") - self.place.0;
        for (column, color) in (first..).zip(colors) {
            let shown = self.shown[0].contains(&column) && self.shown[1].contains(&row);
            assert!(shown, "pixel {column} {row} is not shown");
            let at = row as usize * self.width + column as usize;
            if let Some(color) = color {
                assert!(
                    self.overdraw || !self.written[at],
                    "pixel {column} {row} is written twice"
                );
                self.written[at] = true;
                self.pixels[at] = Some(color);
            }
        }
    }
}

/// A fragment that does not look at where it is, so that spans are filled.
#[derive(Clone, Copy, Debug)]
pub struct Mark;

impl Fragment<(), 0> for Mark {
    fn shade(&self, _: Sample<0>) {}
}

/// A fragment that shows what it was given.
#[derive(Clone, Copy, Debug)]
pub struct Probe;

impl<const N: usize> Fragment<(i32, i32, [I16F16; N]), N> for Probe {
    const UNIFORM: bool = false;

    fn shade(&self, sample: Sample<N>) -> (i32, i32, [I16F16; N]) {
        (sample.x, sample.y, sample.varyings)
    }
}
