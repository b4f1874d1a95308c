//! The outline of a triangle whose corners are all in the guard band, and how its edges are followed.

use crate::math::SMALL_CORE;
use crate::setup::{Corner, Outline};
use crate::traversal::Short;
use crate::vertex::Rect;

/// A triangle with all corners in the guard band, on its way to pixels, in the target's.
pub(super) struct Shape<C = Corner> {
    pub(super) outline: Outline<C>,
    /// What may be covered of the window.
    pub(super) bounds: Rect,
    /// Its edges are followed by [`Short`]: it is small, all of it is in the window, and its outline is counted from the
    /// left side of its box.
    pub(super) short: bool,
}

impl Shape {
    /// Of an outline and what the window has of its box, which is not empty, and may be all.
    #[inline]
    pub(super) fn new(outline: Outline, bounds: Rect, inside: bool, bits: u32) -> Self {
        let short = !SMALL_CORE && inside && Short::fits(bounds);
        let left = if short { bounds.x0 } else { 0 };
        Self { outline: outline.moved(-left, bits), bounds, short }
    }
}
