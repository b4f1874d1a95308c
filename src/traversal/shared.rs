//! An edge that begins by a function of its own: one copy of it in a firmware, for triangles with so many rows that the
//! calls do not count.

use super::side::Side;

/// An edge on one row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shared<S>(S);

impl<S: Side> Side for Shared<S> {
    type Corner = S::Corner;

    #[inline(never)]
    fn new(upper: S::Corner, lower: S::Corner, row: i32, bits: u32) -> Self {
        Self(S::new(upper, lower, row, bits))
    }

    #[inline(always)]
    fn x(&mut self) -> i32 {
        self.0.x()
    }

    #[inline(always)]
    fn step(&mut self) {
        self.0.step();
    }
}
