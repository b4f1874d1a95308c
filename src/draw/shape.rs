//! The outline of a triangle on the screen, and how its edges are followed.

use crate::math::SMALL_CORE;
use crate::setup::{Corner, Outline};
use crate::traversal::Short;
use crate::vertex::Rect;

/// A triangle on the screen on its way to pixels, in the target's.
pub(super) struct Shape<C = Corner> {
    pub(super) outline: Outline<C>,
    /// What may be covered of the window.
    pub(super) bounds: Rect,
    pub(super) follow: Follow,
}

/// How the edges of a shape are followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Follow {
    /// By [`Short`]: it is small, all of it is in the window, and its outline is counted from the left side of its box.
    Short,
    /// By what the instruction set does best; all columns are in the window.
    Whole,
    /// The same, and some columns are not.
    Clipped,
}

impl Shape {
    /// Of an outline, its box, and what the window has of that, which is not empty.
    #[inline]
    pub(super) fn new(outline: Outline, whole: Rect, bounds: Rect, bits: u32) -> Self {
        let follow = if !SMALL_CORE && bounds == whole && Short::fits(bounds) {
            Follow::Short
        } else if bounds.x0 == whole.x0 && bounds.x1 == whole.x1 {
            Follow::Whole
        } else {
            Follow::Clipped
        };
        let left = if follow == Follow::Short { bounds.x0 } else { 0 };
        Self { outline: outline.moved(-left, bits), bounds, follow }
    }
}
