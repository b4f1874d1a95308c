//! The outline of a triangle whose corners are all in the guard band, and how its edges are followed.

use crate::setup::{Corner, Outline};
use crate::vertex::Rect;

/// A triangle with all corners in the guard band, on its way to pixels, in the viewport's.
pub(super) struct Shape<C = Corner> {
    pub(super) outline: Outline<C>,
    /// What may be covered of the window.
    pub(super) bounds: Rect,
    /// Its edges are followed by [`SmallRows`](crate::traversal::SmallRows): it is small, and all of it is in the window.
    pub(super) short: bool,
}
