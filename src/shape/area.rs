//! Smooth edges: how much of each pixel a polygon covers, exactly but for rounding.
//!
//! An edge that goes down the left side of a pixel adds the height it takes of the row, one that goes up the right side
//! takes it away; where it crosses the pixel, by the part of the pixel that is to its right: that is the difference, a pixel on, of the
//! integral `t^2 / (2 w)` over an edge that takes a width `w` of the row. The sum is what is inside.

use super::{BITS, Polygon, Side};
use super::{Origin, fill_run, placed};
use crate::blend::Alpha;
use crate::coverage::WHOLE;
use crate::framebuffer::Target;
use crate::math::{high, low, normalized, shared_reciprocal, signed, unsigned};
use crate::vertex::Rect;

/// Fraction bits of a place in a row.
const FINE: u32 = 12;

/// All of a pixel is 2 to this: the height of a row in subpixels, by the width of a pixel.
const AREA_BITS: u32 = BITS + FINE;

/// What an edge takes of one row.
#[derive(Clone, Copy, Debug, Default)]
struct Piece {
    /// Its left end.
    x: i32,
    /// How far it goes to the right, up to 2^28.
    width: u32,
    /// The reciprocal of that, and how far it was shifted for it.
    inverse: u32,
    zeros: u8,
    /// Its height in subpixels, 1 to 256, with the sign of its winding.
    height: i16,
}

impl Piece {
    /// The first pixel it crosses.
    #[inline]
    fn first(&self) -> i32 {
        self.x >> FINE
    }

    /// The first pixel that is wholly to its right.
    #[inline]
    fn end(&self) -> i32 {
        (self.x + signed(self.width) + (1 << FINE) - 1) >> FINE
    }

    /// The area to its right and to the left of a place, by its height: how far right of it that is, on average.
    #[inline]
    fn right_of(&self, place: i32) -> i32 {
        let t = place - self.x;
        if t <= 0 {
            return 0;
        }
        if unsigned(t) >= self.width {
            return t - signed(self.width >> 1);
        }
        // t / w in Q31, then t^2 / (2 w).
        let ratio = (u64::from(unsigned(t)) * u64::from(self.inverse)) >> (32 - self.zeros);
        signed(high(u64::from(unsigned(t)) * ratio))
    }

    /// What it adds to a pixel.
    #[inline]
    fn adds(&self, column: i32) -> i32 {
        let left = column << FINE;
        let part = self.right_of(left + (1 << FINE)) - self.right_of(left);
        i32::from(self.height) * part.min(1 << FINE)
    }
}

impl Side {
    /// What it takes of a row, if anything.
    #[expect(clippy::cast_possible_truncation, reason = "heights up to 256, and zeros of 32 bits")]
    fn piece(&self, row: i32) -> Option<Piece> {
        let top = (row << BITS).max(self.y);
        let bottom = ((row + 1) << BITS).min(self.y + self.dy);
        if top >= bottom {
            return None;
        }
        let (from, to) = (self.at(top), self.at(bottom));
        let width = to.abs_diff(from);
        let (divisor, zeros) = normalized(width);
        let inverse = if width == 0 { 0 } else { shared_reciprocal(divisor) };
        let height = (self.winding * (bottom - top)) as i16;
        Some(Piece { x: from.min(to), width, inverse, zeros: zeros as u8, height })
    }

    /// Where it is at a height of its own.
    #[inline]
    fn at(&self, y: i32) -> i32 {
        // 24 bits by 24, and 4 for the fraction; places between the ends are between them.
        let across = (i64::from(self.dx) * i64::from(y - self.y)) << (FINE - BITS);
        let across = low(across.checked_div_euclid(i64::from(self.dy)).unwrap_or(0));
        (self.x << (FINE - BITS)) + across
    }
}

/// The pieces of one row, from the left.
#[derive(Debug)]
struct Pieces {
    all: [Piece; Polygon::MAX_CORNERS],
    count: usize,
}

impl Pieces {
    /// Those that edges take of a row.
    fn new(polygon: &Polygon<'_>, row: i32) -> Self {
        let mut pieces = Self { all: [Piece::default(); Polygon::MAX_CORNERS], count: 0 };
        for piece in polygon.sides().filter_map(|side| side.piece(row)) {
            pieces.insert(piece);
        }
        pieces
    }

    /// Puts one more in its place.
    fn insert(&mut self, new: Piece) {
        let mut carried = new;
        let Some(room) = self.all.get_mut(..=self.count) else { return };
        let Some((last, before)) = room.split_last_mut() else { return };
        for piece in before {
            if carried.x < piece.x {
                core::mem::swap(&mut carried, piece);
            }
        }
        *last = carried;
        self.count += 1;
    }
}

/// The first pieces of some that cross pixels next to each other, where those end, and the other pieces.
fn split(pieces: &[Piece]) -> Option<(&[Piece], i32, &[Piece])> {
    let mut end = pieces.first()?.end();
    let mut count = 0;
    for piece in pieces {
        if piece.first() > end {
            break;
        }
        end = end.max(piece.end());
        count += 1;
    }
    let (these, others) = pieces.split_at_checked(count)?;
    Some((these, end, others))
}

/// What part of a pixel it is, Q16; where the outline winds around twice it is all.
#[inline]
fn part_of(sum: i32) -> i32 {
    (sum.abs() >> (AREA_BITS - 16)).min(WHOLE)
}

/// Fills the pixels of `window` by how much of them is inside; `origin` is where pixel (0, 0) lies in the target.
pub(crate) fn fill_smooth<T, C: Copy>(
    target: &mut T,
    polygon: &Polygon<'_>,
    window: Rect,
    origin: Origin,
    color: Alpha<C>,
) where
    T: Target<Color = Alpha<C>>,
{
    let (first, end) = polygon.rows();
    for row in first.max(window.y0)..end.min(window.y1) {
        let Pieces { all, count } = &Pieces::new(polygon, row);
        let mut rest = all.get(..*count).unwrap_or_default();
        // What is to the left adds to all of the row.
        let (mut x, mut sum) = (window.x0, 0);
        while let Some((pieces, end, others)) = split(rest) {
            // Not `clamp`, which keeps a panic in the binary.
            let start = pieces.first().map_or(x, Piece::first).max(x).min(window.x1);
            let end = end.max(start).min(window.x1);
            fill_run(target, (x, start, row), origin, color.part(part_of(sum)));
            let before = sum;
            let colors = (start..end).map(|column| {
                let added = pieces.iter().map(|piece| piece.adds(column)).sum::<i32>();
                color.part(part_of(before + added))
            });
            if start < end {
                let (x, y) = placed((start, row), origin);
                target.write(x, y, colors);
            }
            sum += pieces.iter().map(|piece| i32::from(piece.height) << FINE).sum::<i32>();
            (x, rest) = (end.max(x), others);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fixed::types::I16F16;

    /// Windows of every kind: without columns, far off and with no end.
    #[test]
    fn only_the_window_is_drawn() {
        struct Count(usize);
        impl Target for Count {
            type Color = Alpha<()>;

            fn size(&self) -> (u32, u32) {
                (u32::MAX, u32::MAX)
            }

            fn write(
                &mut self,
                _: usize,
                _: usize,
                colors: impl Iterator<Item = Option<Alpha<()>>>,
            ) {
                self.0 += colors.flatten().count();
            }
        }
        let corners = [[-9, 1], [9, 2], [1, 8]].map(|p| p.map(I16F16::from_num::<i32>));
        let polygon = Polygon::try_new(&corners).unwrap();
        let count = |x0: i32, x1: i32| {
            let window = Rect { x0, y0: -100, x1, y1: 100 };
            let mut target = Count(0);
            fill_smooth(&mut target, &polygon, window, (0, 0), Alpha { color: (), alpha: 255 });
            target.0
        };
        let all = count(-20, 20);
        assert!(all > 60, "{all}");
        assert_eq!(count(i32::MIN, i32::MAX), all);
        assert_eq!(count(-20, 3) + count(3, 20), all);
        for (x0, x1) in
            [(5, 5), (5, 4), (9, -9), (i32::MAX, i32::MIN), (-5000, -4000), (1 << 30, i32::MAX)]
        {
            assert_eq!(count(x0, x1), 0, "{x0} to {x1}");
        }
    }
}
