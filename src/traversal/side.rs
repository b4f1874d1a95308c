//! An edge of a projected triangle, row by row: the first column whose centre is not left of it.
//!
//! With `(x, y)` the upper corner in subpixels, `dx`, `dy` the way to the lower one and `h` half a pixel,
//! that column on a row whose centre is `f` below the corner is
//!
//! ```text
//! ceil((x + dx f / dy - h) / 2^S) = X - floor(e / dy),  e = floor(((h - fx) dy - dx f) / 2^S),  x = 2^S X + fx
//! ```
//!
//! for the first row, `f < 2^S`. A row further takes `dx` from `e`, so that all is in units of a pixel / `dy`. A
//! corner is at most 1024 px from the viewport's, so (`S = 8`):
//!
//! | value | bits |
//! | --- | --- |
//! | `dx`, `dy` | 19 |
//! | `(h - fx) dy - dx f` | 28 |
//!
//! The same columns come from four ways, and each instruction set takes the cheaper for each size: `Line` needs a
//! division an edge and an addition of 64 bits a row, `Short`, for small triangles, two divisions and an addition of 32 bits;
//! `Digital` takes no more than a division by additions, and a remainder to keep a row, and `Walked`, for small triangles,
//! neither, but a step for each column that it passes.
//!
//! Did not pay on a Cortex-M4: whole pixels and a remainder; and a half's rows drawn by a call of their own, with its
//! edges in memory.

#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
use crate::math::{low, signed, unsigned};
use crate::setup::{Corner, Place};
use crate::vertex::Rect;
#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
use core::hint::black_box;

/// An edge on one row.
pub(crate) trait Side: Copy + core::fmt::Debug {
    /// What it goes between.
    type Corner: Place;

    /// The edge from `upper` to `lower` in subpixels of `bits` bits on row `row`; anything where it does not have that row, as
    /// then it is not asked for a column.
    fn new(upper: Self::Corner, lower: Self::Corner, row: i32, bits: u32) -> Self;

    /// The first column whose centre is not left of the edge.
    fn x(&mut self) -> i32;

    /// The next row.
    fn step(&mut self);
}

/// What begins every edge: see the module.
struct Start {
    /// The corner's pixel.
    column: i32,
    dx: i32,
    dy: i32,
    /// The edge on the corner's first row is at `column - e / dy`, counted from centres.
    e: i32,
}

impl Start {
    #[inline]
    fn new(upper: Corner, lower: Corner, bits: u32) -> Self {
        let (dx, dy) = (lower.x - upper.x, lower.y - upper.y);
        let half = (1 << bits) / 2;
        let f = (upper.row(bits) << bits) + half - upper.y;
        let fx = upper.x & ((1 << bits) - 1);
        let e = ((half - fx) * dy - dx * f) >> bits;
        Self { column: upper.x >> bits, dx, dy, e }
    }
}

/// An edge as a sum in Q32 of a pixel: one addition of 64 bits a row.
///
/// Columns change at multiples of `1 / dy`. The sum begins `1 / (2 dy)` below the last of them that has its
/// column, so its floor is right while it is off by less than that, `2^31 / dy` units:
///
/// | `dy`, `\|dx\|` below | `v 2^32 / dy` is | off by, a `v` | rows | sum off by | limit |
/// | --- | --- | --- | --- | --- | --- |
/// | 24 px (`S = 8`) | `v R` | 1 | 25 | 2^17.3 | 2^18.4 |
/// | 192 px (`S = 4`) | `v R` | 1 | 193 | 2^19.2 | 2^19.4 |
/// | 2^16 | `v R`, and 14 bits more | 2^-14, and 1 | 257 (2049) | 2^10.4 (2^12.6) | 2^15 (2^16) |
/// | the guard band | divided | 0, and 1 | 2049 | 2^11 | 2^12 |
///
/// with `R = floor((2^32 - 1) / dy)`, `|v| <= dy + |dx|`.
#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    at: i64,
    slope: i64,
}

#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
impl Line {
    /// `e` and `dx` times `2^32 / dy`, of an edge that is longer than one reciprocal is exact for.
    #[cold]
    #[inline(never)]
    fn long(e: i32, dx: i32, dy: i32, inverse: u32) -> [i64; 2] {
        let side = dy.unsigned_abs();
        if (dx.unsigned_abs() | side) >> 16 == 0 {
            // 2^32 - R dy is 1 to dy: 14 bits more of the reciprocal.
            let rest = inverse.wrapping_mul(side).wrapping_neg();
            let more = (rest << 14).checked_div(side).unwrap_or(0);
            return [e, dx].map(|v| {
                let v = i64::from(v);
                v * i64::from(inverse) + ((v * i64::from(more)) >> 14)
            });
        }
        [e, dx].map(|v| divided(v, dy))
    }
}

/// `v 2^32 / d`, floored, for `d` of 1 to 2^20: in digits of at most 12 bits, as a division of 64 bits is a large
/// function.
#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
#[inline(never)]
fn divided(v: i32, d: i32) -> i64 {
    let whole = v.checked_div_euclid(d).unwrap_or(0);
    let (d, mut rest) = (unsigned(d), unsigned(v.wrapping_sub(whole.wrapping_mul(d))));
    let mut quotient = i64::from(whole);
    for bits in [12, 12, 8] {
        rest <<= bits;
        let digit = rest.checked_div(d).unwrap_or(0);
        rest -= digit * d;
        quotient = (quotient << bits) + i64::from(digit);
        black_box(());
    }
    quotient
}

#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
impl Side for Line {
    type Corner = Corner;

    #[inline(always)]
    fn new(upper: Corner, lower: Corner, row: i32, bits: u32) -> Self {
        let Start { column, dx, dy, e } = Start::new(upper, lower, bits);
        let inverse = u32::MAX.checked_div(dy.unsigned_abs()).unwrap_or(0);
        let short = if bits > 4 { 24 << bits } else { 192 << bits };
        let [e, slope] = if dy < short && unsigned(dx + short) < unsigned(2 * short) {
            [e, dx].map(|v| i64::from(v) * i64::from(inverse))
        } else {
            Self::long(e, dx, dy, inverse)
        };
        let mut at = (i64::from(column + 1) << 32) - e - i64::from(inverse >> 1);
        let rows = row - upper.row(bits);
        if rows > 0 {
            // Also past its end: a slope is at most 2^51, and a row fewer than 2^11 below the corner.
            at += slope * i64::from(rows);
        }
        Self { at, slope }
    }

    #[inline]
    fn x(&mut self) -> i32 {
        low(self.at >> 32)
    }

    #[inline]
    fn step(&mut self) {
        // One row's edge may have any slope, and is not looked at after it.
        self.at = self.at.wrapping_add(self.slope);
    }
}

/// An edge of a small triangle as a sum in Q18 of a pixel, 14 bits of whole ones: one addition of 32 bits a row, two divisions
/// an edge.
///
/// As [`Line`], it begins half a `1 / dy` below the last column that it may have, and its floor is right while it is off by less
/// than that, `2^17 / dy` units. Both quotients are off by less than one: by the `n`th row the sum is off by less than `n`.
///
/// | box below | `\|dx\|`, `dy` below | `2 \|e\| + 1`, below | off by | limit |
/// | --- | --- | --- | --- | --- |
/// | 21 px (`S = 8`) | 5376 | 2^14 | 21 | 24.4 |
/// | 21 px (`S = 4`) | 336 | 2^10 | 21 | 390 |
///
/// A pixel is at most `20 WIDEST + 20`, below 2^14.
#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Short {
    at: u32,
    step: u32,
}

/// An edge of a small triangle, followed from its first row.
///
/// Its columns are a target's pixels, a row after the other, from the left side that its corners are counted from.
pub(crate) trait SmallSide: Copy + core::fmt::Debug {
    /// The edge from `upper` to `lower`, in subpixels of `bits` bits, on its first row, in a target of that width.
    fn new(upper: Corner, lower: Corner, bits: u32, width: i32) -> Self;

    /// The edge some pixels further on.
    fn further(self, pixels: i32) -> Self;

    /// The first pixel of the row whose centre is not left of the edge.
    fn pixel(&mut self) -> i32;

    /// The next row.
    fn step(&mut self);
}

/// The longest side of a small triangle's box, in pixels.
pub(crate) const SMALL: i32 = 20;

/// Pixels of a target's row that a small triangle is drawn in, at the most.
pub(crate) const WIDEST: i32 = 816;

/// Whether a triangle of which this is the box is small: a side is less than a pixel longer than the box.
#[inline]
pub(crate) const fn is_small(bounds: Rect) -> bool {
    bounds.x1 - bounds.x0 <= SMALL && bounds.y1 - bounds.y0 <= SMALL
}

#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
impl Short {
    /// Fraction bits.
    const FRACTION: u32 = 18;
}

#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
impl SmallSide for Short {
    #[inline(always)]
    fn new(upper: Corner, lower: Corner, bits: u32, width: i32) -> Self {
        let Start { column, dx, dy, e } = Start::new(upper, lower, bits);
        // An edge without rows may be anything; and a division by 1 or more takes no test.
        let dy = dy.max(1);
        let back = ((2 * e + 1) << (Self::FRACTION - 1)) / dy;
        let slope = (dx << Self::FRACTION) / dy;
        Self {
            at: unsigned((column + 1) << Self::FRACTION).wrapping_sub(unsigned(back)),
            step: unsigned(slope).wrapping_add(unsigned(width) << Self::FRACTION),
        }
    }

    #[inline]
    fn further(self, pixels: i32) -> Self {
        Self { at: self.at.wrapping_add(unsigned(pixels) << Self::FRACTION), ..self }
    }

    #[inline]
    fn pixel(&mut self) -> i32 {
        signed(self.at >> Self::FRACTION)
    }

    #[inline]
    fn step(&mut self) {
        // One row's edge may have any slope, and is not looked at after it.
        self.at = self.at.wrapping_add(self.step);
    }
}

#[cfg(any(test, not(all(target_arch = "arm", not(target_has_atomic = "32")))))]
const _: () = assert!(
    SMALL * WIDEST + SMALL < 1 << (32 - Short::FRACTION),
    "a pixel of a box is beyond 14 bits"
);

/// An edge of a small triangle by a remainder, walked from column to column: no division, and no product but two.
///
/// Between rows it goes at most from one side of the box to the other, so a walk is bounded by that.
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Walked {
    pixel: i32,
    /// How far left of that pixel's centre the edge is, in pixels / `dy`: `0 <= ahead < dy` once the row is walked.
    ahead: i32,
    dx: i32,
    dy: i32,
    width: i32,
}

#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
impl SmallSide for Walked {
    #[inline]
    fn new(upper: Corner, lower: Corner, bits: u32, width: i32) -> Self {
        let Start { column, dx, dy, e } = Start::new(upper, lower, bits);
        Self { pixel: column, ahead: e, dx, dy, width }
    }

    #[inline]
    fn further(self, pixels: i32) -> Self {
        Self { pixel: self.pixel + pixels, ..self }
    }

    #[inline(always)]
    fn pixel(&mut self) -> i32 {
        while self.ahead < 0 {
            self.ahead += self.dy;
            self.pixel += 1;
            core::hint::black_box(());
        }
        while self.ahead >= self.dy {
            self.ahead -= self.dy;
            self.pixel -= 1;
            core::hint::black_box(());
        }
        self.pixel
    }

    #[inline]
    fn step(&mut self) {
        self.ahead -= self.dx;
        self.pixel += self.width;
    }
}

/// An edge by whole pixels and a remainder, without a division where there is no instruction for one.
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Digital {
    x: i32,
    /// How far left of that centre the edge is, in pixels / `height`: `0 <= ahead < height`.
    ahead: i32,
    /// The edge's way in a row: whole pixels, floored, and the rest in pixels / `height`.
    whole: i32,
    rest: i32,
    height: i32,
}

#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
impl Digital {
    /// Goes `rows` further, 1,536 at most: a remainder times that takes 30 bits.
    #[cold]
    fn skip(&mut self, rows: i32) {
        let (back, ahead) = divide(self.ahead - self.rest * rows, self.height);
        self.x += self.whole * rows - back;
        self.ahead = ahead;
    }
}

#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
impl Side for Digital {
    type Corner = Corner;

    #[inline]
    fn new(upper: Corner, lower: Corner, row: i32, bits: u32) -> Self {
        if lower.row(bits) <= row {
            return Self::default();
        }
        let Start { column, dx, dy, e } = Start::new(upper, lower, bits);
        let (back, ahead) = divide(e, dy);
        let (whole, rest) = divide(dx, dy);
        let mut side = Self { x: column - back, ahead, whole, rest, height: dy };
        let rows = row - upper.row(bits);
        if rows > 0 {
            side.skip(rows);
        }
        side
    }

    #[inline]
    fn x(&mut self) -> i32 {
        self.x
    }

    #[inline]
    fn step(&mut self) {
        self.x += self.whole;
        self.ahead -= self.rest;
        // -1 where the edge has passed the centre.
        let passed = self.ahead >> 31;
        self.x -= passed;
        self.ahead += self.height & passed;
    }
}

/// `n / d` floored, and the remainder; `d > 0`, or both results are meaningless. A division is a call of some
/// 200 instructions; most quotients here are small.
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
#[inline]
fn divide(n: i32, d: i32) -> (i32, i32) {
    if n >= -8 * d && n < 8 * d {
        return walk(n, d);
    }
    let q = n.checked_div(d).unwrap_or(0);
    let r = n - q * d;
    // The processor's division rounds towards 0.
    let below = r >> 31;
    (q + below, r + (d & below))
}

/// [`divide`] by additions, for quotients of -8 to 7.
#[cfg(any(test, all(target_arch = "arm", not(target_has_atomic = "32"))))]
#[inline]
fn walk(n: i32, d: i32) -> (i32, i32) {
    let (mut q, mut r) = (0, n);
    while r < 0 {
        r += d;
        q -= 1;
    }
    while r >= d {
        r -= d;
        q += 1;
    }
    (q, r)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_by_digits_are_quotients() {
        for d in (1..40).chain((0..40).map(|i| (1 << 20) - i)).chain((4..20).map(|n| 1 << n)) {
            let ends = [0, 1, d - 1, d, 3 * d, (1 << 20) - 1, 1 << 20].into_iter();
            for v in ends.chain((0..100).map(|i| i * 10_477)).flat_map(|v| [v, -v]) {
                let exact = (i64::from(v) << 32).div_euclid(i64::from(d));
                assert_eq!(divided(v, d), exact, "{v} / {d}");
            }
        }
    }

    #[test]
    fn quotients_by_additions_are_quotients() {
        for d in 1..40 {
            for n in -20 * d..20 * d {
                assert_eq!(divide(n, d), (n.div_euclid(d), n.rem_euclid(d)));
                assert_eq!(walk(n, d), divide(n, d));
            }
        }
    }

    /// Both ways on every row from a first one, against the formula in 64 bits.
    fn follows(upper: [i32; 2], lower: [i32; 2], bits: u32, skipped: i32) {
        let half = (1 << bits) / 2;
        let [upper, lower] = [upper, lower].map(|[x, y]: [i32; 2]| Corner { x, y });
        let first = upper.row(bits) + skipped;
        let end = lower.row(bits);
        if first >= end {
            return;
        }
        let mut line = Line::new(upper, lower, first, bits);
        let mut digital = Digital::new(upper, lower, first, bits);
        let (dx, dy) = (i64::from(lower.x - upper.x), i64::from(lower.y - upper.y));
        for row in first..end.min(first + 512) {
            let f = i64::from((row << bits) + half - upper.y);
            let n = i64::from(upper.x - half) * dy + dx * f;
            let exact = -(-n).div_euclid(dy << bits);
            assert_eq!(i64::from(line.x()), exact, "{upper:?} {lower:?}, {bits} bits, row {row}");
            assert_eq!(
                i64::from(digital.x()),
                exact,
                "{upper:?} {lower:?}, {bits} bits, row {row}"
            );
            line.step();
            digital.step();
        }
    }

    /// Edges of every length on both sides of each limit, through centres, and to the guard band's ends.
    #[test]
    fn both_ways_are_exact() {
        let mut state = 1u64;
        let mut below = move |n: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        };
        let lengths = [24, 192, 256, 1024, 2047];
        for i in 0..40_000 {
            let bits = if i % 2 == 0 { 4 } else { 8 };
            let end = 1024 << bits;
            let length = |i: i32, n: i32| ((lengths[i as usize] << bits) + n).min(2 * end);
            let mut size = [(); 2].map(|()| {
                let digits = below(11 + bits);
                below(2 << digits)
            });
            if i % 3 == 0 {
                size[below(2) as usize] = length(below(5), below(5) - 2);
            }
            if i % 7 == 0 {
                size = [(); 2].map(|()| length(below(5), -below(40)));
            }
            let size = size.map(|v| v.min(2 * end));
            let upper = size.map(|v| below(2 * end - v + 1) - end);
            let (dx, x) = if i % 5 < 2 { (size[0], upper[0]) } else { (-size[0], -upper[0]) };
            let mut upper = [x, upper[1]];
            let mut lower = [x + dx, upper[1] + size[1]];
            if i % 11 == 0 {
                // Many centres on the edge.
                let grid = |v: i32| (v & !((1 << bits) - 1)) + (1 << bits) / 2;
                (upper, lower) = (upper.map(grid), lower.map(grid));
            }
            follows(upper, lower, bits as u32, 0);
            follows(upper, lower, bits as u32, below(1536));
        }
    }

    /// Small edges of all lengths, half of them as long as they may be, on every row.
    #[test]
    fn short_edges_are_exact() {
        let mut state = 1u64;
        let mut below = move |n: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        };
        for i in 0..100_000 {
            let bits = if i % 2 == 0 { 4 } else { 8 };
            let end = 21 << bits;
            let mut length = |i: i32| end - 1 - below(if i % 2 == 0 { end } else { 40 });
            let (dx, dy) = (length(i / 2) * [1, -1][i as usize / 8 % 2], length(i / 4));
            let mut upper = [0; 2].map(|_| below(512 << bits));
            if i % 5 == 0 {
                // Many centres on the edge.
                upper = upper.map(|v| (v & !((1 << bits) - 1)) + (1 << bits) / 2);
            }
            let [x, y] = upper;
            let [upper, lower] = [Corner { x, y }, Corner { x: x + dx, y: y + dy }];
            let left = upper.x.min(lower.x) >> bits;
            let [from, to] = [upper, lower].map(|corner| corner.moved(-left, bits));
            let mut side = Short::new(from, to, bits, 800);
            let mut walked = Walked::new(from, to, bits, 800);
            for (n, row) in (upper.row(bits)..lower.row(bits)).enumerate() {
                let half = (1 << bits) / 2;
                let f = i64::from((row << bits) + half - y);
                let n_half = i64::from(x - half) * i64::from(dy) + i64::from(dx) * f;
                let exact = -(-n_half).div_euclid(i64::from(dy) << bits);
                for pixel in [side.pixel(), walked.pixel()] {
                    let column = pixel - 800 * n as i32 + left;
                    assert_eq!(i64::from(column), exact, "{upper:?} {lower:?}, row {row}");
                }
                side.step();
                walked.step();
            }
        }
    }

    #[test]
    fn the_guard_bands_ends_are_exact() {
        for bits in [4, 8] {
            let end = 1024 << bits;
            let ends = [-end, 1 - end, -1, 0, 1, (1 << bits) / 2, end - 1, end];
            for i in 0..8usize.pow(4) {
                let at = |n: usize| ends[i >> (3 * n) & 7];
                for skipped in [0, 1, 1000, 1535] {
                    follows([at(0), at(1)], [at(2), at(3)], bits, skipped);
                }
            }
        }
    }
}
