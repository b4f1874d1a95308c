//! Hard edges: the pixels whose centres are inside, by the same rule as a triangle's.

use super::{BITS, PIXEL, Polygon, Side};
use super::{Origin, fill_run};
use crate::framebuffer::Target;
use crate::math::saturate;
use crate::vertex::Rect;

/// Where a row of pixels goes over an edge.
#[derive(Clone, Copy, Debug, Default)]
struct Crossing {
    /// The first column whose centre is not left of it.
    column: i32,
    winding: i32,
}

/// The crossings of one row, from the left.
#[derive(Debug)]
struct Crossings {
    all: [Crossing; Polygon::MAX_CORNERS],
    count: usize,
}

impl Crossings {
    /// Puts one more in its place.
    fn insert(&mut self, new: Crossing) {
        let mut carried = new;
        let Some(room) = self.all.get_mut(..=self.count) else { return };
        let Some((last, before)) = room.split_last_mut() else { return };
        for crossing in before {
            if carried.column < crossing.column {
                core::mem::swap(&mut carried, crossing);
            }
        }
        *last = carried;
        self.count += 1;
    }

    /// Those there are.
    fn iter(&self) -> impl Iterator<Item = &Crossing> {
        self.all.iter().take(self.count)
    }
}

impl Side {
    /// Its crossing with the centres of a row, if it has one: from its upper end on to before its lower one.
    #[inline]
    fn crossing(&self, row: i32) -> Option<Crossing> {
        let down = (row << BITS) + PIXEL / 2 - self.y;
        if down < 0 || down >= self.dy {
            return None;
        }
        // The column c with (c - 1) PIXEL + PIXEL / 2 < x + dx down / dy <= c PIXEL + PIXEL / 2: 49 bits by 33.
        let (dx, down, dy) = (i64::from(self.dx), i64::from(down), i64::from(self.dy));
        let past = (i64::from(self.x) + i64::from(PIXEL / 2 - 1)) * dy + dx * down + dy - 1;
        let column = saturate(past.checked_div_euclid(dy << BITS).unwrap_or(0));
        Some(Crossing { column, winding: self.winding })
    }
}

/// Fills the pixels of `window` whose centres are inside; `origin` is where pixel (0, 0) lies in the target.
pub(crate) fn fill<T: Target>(
    target: &mut T,
    polygon: &Polygon<'_>,
    window: Rect,
    origin: Origin,
    color: T::Color,
) {
    let (first, end) = polygon.rows();
    for row in first.max(window.y0)..end.min(window.y1) {
        let mut crossings =
            Crossings { all: [Crossing::default(); Polygon::MAX_CORNERS], count: 0 };
        for crossing in polygon.sides().filter_map(|side| side.crossing(row)) {
            crossings.insert(crossing);
        }
        let (mut around, mut x0) = (0, 0);
        for Crossing { column, winding } in crossings.iter() {
            let before = around;
            around += winding;
            if before == 0 {
                x0 = *column;
            } else if around == 0 {
                let (x0, x1) = (x0.max(window.x0), (*column).min(window.x1));
                fill_run(target, (x0, x1, row), origin, Some(color));
            }
        }
    }
}
