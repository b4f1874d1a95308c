//! How much of a pixel's square a triangle covers, from the distances of its edges.
//!
//! The signed distance of a pixel's centre from an edge is the edge function, normalised by `1 / sqrt(a^2 + b^2)` (Olano &
//! Greer 1997, section 7.2). What a line leaves of a unit square at a distance is a ramp whose ends are parabolas: their
//! widths are the lesser of `|cos|` and `|sin|` of the line's angle, so that it is exact for any angle. A triangle covers what
//! no edge cuts off; where two edges cut the same square, what both cut off is counted once. That is known for edges
//! that are parallel or perpendicular, and taken to be linear in the cosine between.

use crate::math::{high, inverse_root, low};
use crate::setup::EdgeFunction;

/// Which edges of a triangle are smooth; the others cover the pixels whose centres are inside, by the fill rule.
///
/// ```
/// use hither::Edges;
///
/// let outline = Edges::ALL.without(1);
/// assert_eq!(outline, Edges::NONE.with(0).with(2));
/// assert!(outline.contains(2) && !outline.contains(1));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Edges(u8);

impl Edges {
    /// No edge.
    pub const NONE: Self = Self(0);
    /// All three edges.
    pub const ALL: Self = Self(7);

    /// The same and edge `i`, 0 to 2: from vertex `i` to the next one, and from the last to the first. Others are none.
    #[inline]
    #[must_use]
    pub const fn with(self, i: usize) -> Self {
        Self(self.0 | Self::bit(i))
    }

    /// The same but for edge `i`.
    #[inline]
    #[must_use]
    pub const fn without(self, i: usize) -> Self {
        Self(self.0 & !Self::bit(i))
    }

    /// Whether edge `i` is one of them.
    #[inline]
    #[must_use]
    pub const fn contains(self, i: usize) -> bool {
        self.0 & Self::bit(i) != 0
    }

    #[inline]
    const fn bit(i: usize) -> u8 {
        if i < 3 { 1 << i } else { 0 }
    }
}

/// All of a pixel, Q16.
pub(crate) const WHOLE: i32 = 1 << 16;

/// What an edge leaves of a pixel's square, by the edge function at its centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ramp {
    /// The unit normal, inwards, Q16.
    normal: [i32; 2],
    /// `(|a| + |b|) / 2`: what the edge function is below, in magnitude, where the edge cuts the square.
    reach: i64,
    /// The edge function is shifted right by this, or left where it is negative, so that it and `reach` take 31 bits.
    shift: i32,
    /// What then makes a distance of it: the reciprocal of the normal's length, and how far to shift.
    inverse: u32,
    down: u32,
    /// `1 / long`, Q16: 1 to `sqrt 2`; and `1 / short`, Q31, or 0, for the larger and the lesser part of the normal.
    inverse_long: i32,
    inverse_short: u32,
    /// Whether pixels that it cuts are left out.
    bare: bool,
}

/// A line that cuts pixels, and its ramp.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut {
    pub(crate) edge: EdgeFunction,
    pub(crate) ramp: Ramp,
}

impl Ramp {
    /// The ramp of an edge, whose `a` and `b` are even; `None` where it is the same everywhere.
    #[inline(never)]
    pub(crate) fn new(edge: &EdgeFunction) -> Option<Self> {
        let EdgeFunction { a, b, .. } = *edge;
        let largest = a.unsigned_abs().max(b.unsigned_abs());
        if largest == 0 {
            return None;
        }
        // The largest in [2^29, 2^30).
        let shift = 34 - i32::try_from(largest.leading_zeros()).unwrap_or(0);
        let [x, y] = [shifted(a, shift), shifted(b, shift)];
        // 2^58 to 2^61, then m in [2^30, 2^32).
        let square = (i64::from(x) * i64::from(x) + i64::from(y) * i64::from(y)).unsigned_abs();
        let up = square.leading_zeros() & !1;
        let inverse = inverse_root(high(square << up));
        // 1 / length is 2^(up / 2 - 62) times that.
        let mut ramp = Self {
            normal: [0; 2],
            reach: (a.abs() + b.abs()) / 2,
            shift,
            inverse,
            down: 46 - up / 2,
            inverse_long: 0,
            inverse_short: 0,
            bare: false,
        };
        ramp.normal = [ramp.normalized(x), ramp.normalized(y)];
        let [long, short] = ramp.parts();
        ramp.inverse_long = low((1i64 << 32).checked_div(i64::from(long)).unwrap_or(0));
        ramp.inverse_short = (1u32 << 31).checked_div(short.unsigned_abs()).unwrap_or(0);
        Some(ramp)
    }

    /// The larger and the lesser part of the normal, Q16.
    #[inline]
    fn parts(&self) -> [i32; 2] {
        let [x, y] = self.normal.map(i32::abs);
        [x.max(y), x.min(y)]
    }

    /// Of a shifted value, in pixels, Q16.
    #[inline]
    fn normalized(&self, v: i32) -> i32 {
        low((i64::from(v) * i64::from(self.inverse)) >> self.down)
    }

    /// The same, but pixels that it cuts are left out.
    #[inline]
    pub(crate) const fn bare(self) -> Self {
        Self { bare: true, ..self }
    }

    /// Whether pixels that it cuts are left out.
    #[inline]
    pub(crate) const fn is_bare(&self) -> bool {
        self.bare
    }

    /// Below this the edge function is, in magnitude, where the edge cuts the square.
    #[inline]
    pub(crate) const fn reach(&self) -> i64 {
        self.reach
    }

    /// What it cuts off of a square, Q16, by the edge function at the centre.
    #[inline(never)]
    pub(crate) fn cut_off(&self, value: i64) -> i32 {
        if value >= self.reach {
            return 0;
        }
        if value <= -self.reach {
            return WHOLE;
        }
        let distance = self.normalized(shifted(value, self.shift));
        let [long, short] = self.parts();
        // A parabola ends this far away, and begins where the other side's does.
        let (end, begin) = ((long + short) >> 1, (long - short) >> 1);
        let beyond = distance.abs() - begin;
        if beyond <= 0 {
            return WHOLE / 2 - product(distance, self.inverse_long);
        }
        let rest = (end - distance.abs()).max(0).min(short);
        // rest / short, Q16; then rest^2 / (2 long short).
        let part = (rest.unsigned_abs() * self.inverse_short) >> 15;
        let corner = product(product(rest, low(part.into())), self.inverse_long) >> 1;
        if distance > 0 { corner } else { WHOLE - corner }
    }

    /// The cosine between the normals of two edges, Q16.
    #[inline]
    fn cosine(&self, other: &Self) -> i32 {
        let ([a, b], [c, d]) = (self.normal, other.normal);
        (product(a, c) + product(b, d)).clamp(-WHOLE, WHOLE)
    }
}

/// `v 2^-shift`, floored, of what takes 31 bits then.
#[inline]
fn shifted(v: i64, shift: i32) -> i32 {
    let by = shift.unsigned_abs() & 63;
    low(if shift >= 0 { v >> by } else { v << by })
}

/// A product of Q16.
#[inline]
fn product(a: i32, b: i32) -> i32 {
    low((i64::from(a) * i64::from(b)) >> 16)
}

/// How much of a pixel a triangle covers, Q16, by the edge functions at its centre, which is inside of the edges that have no
/// ramp.
///
/// It is 1 less what each edge cuts off, and what two of them do twice. All three cut off the same point only of an `external`
/// triangle: on the other side of the eye.
#[inline(never)]
pub(crate) fn covered(ramps: &[Option<Ramp>; 3], values: &[i64; 3], external: bool) -> i32 {
    let ([r, s, t], [x, y, z]) = (ramps.each_ref().map(Option::as_ref), *values);
    let cut = |ramp: Option<&Ramp>, value| ramp.map_or(0, |ramp| ramp.cut_off(value));
    let (u, v, w) = (cut(r, x), cut(s, y), cut(t, z));
    let (a, b, c) = (both(r, s, u, v), both(s, t, v, w), both(t, r, w, u));
    let thrice = if external { a.min(b).min(c) } else { 0 };
    (WHOLE - u - v - w + a + b + c - thrice).clamp(0, WHOLE)
}

/// How much of a pixel is left, Q16, by the two that cut off most of it: of a triangle's edges and of lines beside it.
#[inline(never)]
pub(crate) fn left(
    ramps: &[Option<Ramp>; 3],
    values: &[i64; 3],
    beside: &[Option<Cut>],
    (x, y): (i32, i32),
) -> i32 {
    let own = ramps.iter().zip(values).map(|(ramp, value)| (ramp.as_ref(), *value));
    let lines = beside.iter().flatten().map(|cut| (Some(&cut.ramp), cut.edge.at(x, y)));
    let (mut first, mut second) = ((None, 0), (None, 0));
    for (ramp, value) in own.chain(lines) {
        let off = ramp.map_or(0, |ramp| ramp.cut_off(value));
        if off > first.1 {
            (first, second) = ((ramp, off), first);
        } else if off > second.1 {
            second = (ramp, off);
        }
    }
    let ((one, u), (other, v)) = (first, second);
    (WHOLE - u - v + both(one, other, u, v)).clamp(0, WHOLE)
}

/// What two edges both cut off, which cut off `u` and `v`.
#[inline]
fn both(first: Option<&Ramp>, second: Option<&Ramp>, u: i32, v: i32) -> i32 {
    let (Some(first), Some(second)) = (first, second) else {
        return 0;
    };
    if u == 0 || v == 0 {
        return 0;
    }
    let cosine = first.cosine(second);
    let apart = product(u, v);
    // The edges of a strip have nothing in common unless they cut off more than all; those of one line have the lesser.
    let aligned = if cosine < 0 { (u + v - WHOLE).max(0) } else { u.min(v) };
    apart + product(aligned - apart, cosine.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a line leaves of the unit square around 0, by the corners it passes.
    fn exact([a, b]: [f64; 2], value: f64) -> f64 {
        let corner = |i: usize| [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]][i % 4];
        let at = |i: usize| a * corner(i)[0] + b * corner(i)[1] + value;
        let mut outline = std::vec::Vec::new();
        for i in 0..4 {
            let (p, q, t) = (corner(i), corner(i + 1), at(i) / (at(i) - at(i + 1)));
            if at(i) >= 0.0 {
                outline.push(p);
            }
            if (at(i) >= 0.0) != (at(i + 1) >= 0.0) {
                outline.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
            }
        }
        let next = |i: usize| outline[(i + 1) % outline.len()];
        let doubled = |i: usize| outline[i][0] * next(i)[1] - outline[i][1] * next(i)[0];
        (0..outline.len()).map(doubled).sum::<f64>() / 2.0
    }

    /// Edges of all sizes and slopes, level, upright and diagonal among them.
    #[test]
    fn a_line_leaves_the_exact_area() {
        let mut state = 3u64;
        let mut random = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as i64
        };
        for number in 0..200_000 {
            let size = 1 + random() % 51;
            let mut part = || 2 * (random() % (1 << size) - (1 << (size - 1)));
            let [mut a, mut b] = [part(), part()];
            match number % 5 {
                0 => a = 0,
                1 => b = a,
                2 => b = (b >> (number % 50)) & !1,
                _ => {}
            }
            let Some(ramp) = Ramp::new(&EdgeFunction { a, b, c: 0 }) else {
                assert_eq!([a, b], [0, 0]);
                continue;
            };
            let reach = ramp.reach();
            assert_eq!(reach, (a.abs() + b.abs()) / 2);
            let value = random() % (2 * reach + 1) - reach;
            let length = (a as f64).hypot(b as f64);
            let left = exact([a as f64 / length, b as f64 / length], value as f64 / length);
            let got = 1.0 - f64::from(ramp.cut_off(value)) / f64::from(WHOLE);
            assert!((got - left).abs() < 2f64.powi(-12), "{a} {b} {value}: {got}, not {left}");
            assert_eq!([ramp.cut_off(reach), ramp.cut_off(-reach)], [0, WHOLE]);
        }
    }

    /// Strips, right angles and a line twice are exact.
    #[test]
    fn two_edges_that_are_aligned_or_perpendicular_are_exact() {
        let edge = |a: i64, b: i64| Ramp::new(&EdgeFunction { a, b, c: 0 });
        let share = |ramps, values| f64::from(covered(&ramps, &values, true)) / f64::from(WHOLE);
        let close =
            |got: f64, exact: f64| assert!((got - exact).abs() < 1e-3, "{got}, not {exact}");
        // A strip of 0.3 pixels, a corner of 0.75 by 0.25, and one line twice.
        close(share([edge(1000, 0), edge(-1000, 0), None], [100, 200, 0]), 0.3);
        close(share([edge(1000, 0), edge(0, 1000), None], [250, -250, 0]), 0.1875);
        close(share([edge(600, 800), edge(300, 400), None], [0, 0, 0]), 0.5);
        close(share([edge(600, 800), edge(300, 400), edge(60, 80)], [0, 0, 0]), 0.5);
    }

    /// Lines beside a triangle cut as its own edges do; of more than two the two that cut off most.
    #[test]
    fn lines_beside_cut_as_edges_do() {
        let edge = |a: i64, b: i64| Ramp::new(&EdgeFunction { a, b, c: 0 });
        let line = |a: i64, b: i64, c: i64| {
            let edge = EdgeFunction { a, b, c };
            Ramp::new(&edge).map(|ramp| Cut { edge, ramp })
        };
        let ramps = [edge(1000, 0), edge(600, 800), None];
        for c in (-3000..3000).step_by(50) {
            let beside = [line(0, 1000, c), None, line(600, 800, 9000)];
            let own = [edge(1000, 0), beside[0].map(|cut| cut.ramp), None];
            let got = left(&[ramps[0], None, None], &[100, 0, 0], &beside, (0, 0));
            assert_eq!(got, covered(&own, &[100, c, 0], false), "{c}");
            let lesser = left(&ramps, &[100, 690, 0], &beside, (0, 0));
            assert!(lesser <= got, "{c}: {lesser} of {got}");
        }
    }
}
