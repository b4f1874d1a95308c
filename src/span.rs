//! Spans: what a triangle covers of one row is one interval, whatever planes clip it.

/// A run of covered pixels, in the viewport's coordinates: row `y`, `x0 <= x < x1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) y: i32,
    pub(crate) x0: i32,
    pub(crate) x1: i32,
}

impl Span {
    /// The span in pieces of at most `length` pixels, from the left.
    #[inline]
    pub(crate) fn blocks(self, length: i32) -> impl Iterator<Item = Self> {
        let mut x0 = self.x0;
        core::iter::from_fn(move || {
            let x1 = self.x1.min(x0.saturating_add(length));
            let block = Self { x0, x1, ..self };
            x0 = x1;
            (block.x0 < block.x1).then_some(block)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    #[test]
    fn blocks_cover_the_span_once() {
        let span = Span { y: 3, x0: 5, x1: 22 };
        let blocks: Vec<_> = span.blocks(8).map(|b| (b.y, b.x0, b.x1)).collect();
        assert_eq!(blocks, [(3, 5, 13), (3, 13, 21), (3, 21, 22)]);
        assert_eq!(span.blocks(i32::MAX).count(), 1);
        assert_eq!(Span { x1: 5, ..span }.blocks(8).count(), 0);
    }
}
