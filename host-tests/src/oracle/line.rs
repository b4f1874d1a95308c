//! Which pixels a line draws, by its parameter: exact.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::{RationalVertex, Vertex, Viewport};

/// A line between two vertices in pixel space, with the part in front of the eye.
#[derive(Clone, Debug)]
pub struct ExactLine {
    /// `[u, v, w]`: along the axis it moves more in, and across it.
    ends: [[i128; 3]; 2],
    steep: bool,
    viewport: Viewport,
}

/// A pixel of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LinePixel {
    /// Row.
    pub y: i32,
    /// Column.
    pub x: i32,
}

impl ExactLine {
    /// From `(x, y, w)`, on the screen at `(x / w, y / w)` pixels.
    #[must_use]
    pub fn new(ends: [Vertex; 2], viewport: Viewport) -> Self {
        let [[ax, ay, aw], [bx, by, bw]] = ends.map(|v| v.map(i128::from));
        // How far the ends are apart, times both w.
        let steep = (by * aw - ay * bw).abs() > (bx * aw - ax * bw).abs();
        let order = |[x, y, w]: Vertex| if steep { [y, x, w] } else { [x, y, w] };
        Self { ends: ends.map(|v| order(v).map(i128::from)), steep, viewport }
    }

    /// `P(t) = a + t (b - a)` is on the line of centres of step `u` at this `t`, as a fraction, which may be infinite; none where all
    /// points are.
    fn parameter(&self, u: i128) -> Option<[i128; 2]> {
        let [a, b] = self.ends.map(|[x, _, w]| 2 * x - (2 * u + 1) * w);
        let (n, d) = (a, a - b);
        (n != 0 || d != 0).then_some(if d < 0 { [-n, -d] } else { [n, d] })
    }

    /// The pixel that holds an end in front of the eye, along the axis.
    fn pixel(&self, end: usize) -> Option<i128> {
        let [u, _, w] = self.ends[end];
        (w > 0).then(|| u.div_euclid(w))
    }

    /// The steps that the line has in the viewport; where both ends are one point of the screen none.
    fn steps(&self) -> Vec<i128> {
        let size = if self.steep { self.viewport.height } else { self.viewport.width };
        let [a, b] = [0, 1].map(|end| self.pixel(end));
        let between = |u: i128| {
            let Some([n, d]) = self.parameter(u) else { return false };
            let w = self.ends[0][2] * d + n * (self.ends[1][2] - self.ends[0][2]);
            (0..=d).contains(&n) && w > 0
        };
        (0..i128::from(size))
            .filter(|&u| self.parameter(u).is_some())
            .filter(|&u| Some(u) == a || Some(u) == b || between(u))
            .collect()
    }

    /// Its pixels in the viewport, in order.
    #[must_use]
    pub fn pixels(&self) -> Vec<LinePixel> {
        let [[au, av, aw], [bu, bv, bw]] = self.ends;
        if bu * aw == au * bw && bv * aw == av * bw {
            return self.dot();
        }
        let mut pixels: Vec<_> = self
            .steps()
            .into_iter()
            .filter_map(|u| {
                let [n, d] = self.parameter(u)?;
                let (v, w) = (av * d + n * (bv - av), aw * d + n * (bw - aw));
                let (v, w) = if w < 0 { (-v, -w) } else { (v, w) };
                Some(self.place(u, v.div_euclid(w)))
            })
            .filter(|pixel| self.holds(*pixel))
            .collect();
        pixels.sort_unstable();
        pixels
    }

    fn dot(&self) -> Vec<LinePixel> {
        let end = self.ends.into_iter().find(|[_, _, w]| *w > 0);
        let pixel = end.map(|[u, v, w]| self.place(u.div_euclid(w), v.div_euclid(w)));
        pixel.into_iter().filter(|pixel| self.holds(*pixel)).collect()
    }

    fn place(&self, u: i128, v: i128) -> LinePixel {
        let [u, v] = [u, v].map(|v| v.clamp(-9999, 9999) as i32);
        if self.steep { LinePixel { x: v, y: u } } else { LinePixel { x: u, y: v } }
    }

    fn holds(&self, pixel: LinePixel) -> bool {
        let Viewport { width, height } = self.viewport;
        let inside = |v: i32, size: u32| v >= 0 && v < size as i32;
        inside(pixel.x, width) && inside(pixel.y, height)
    }

    /// The step that a pixel is at.
    #[must_use]
    pub const fn step(&self, pixel: LinePixel) -> i32 {
        if self.steep { pixel.y } else { pixel.x }
    }

    /// Where a true line is at the centre of a step: `t` from its first end to its second, clamped to the line where that is in
    /// front of the eye. The ends are in pixel space, in any scales that are those of what is interpolated.
    #[must_use]
    pub fn parameter_of(&self, ends: &[RationalVertex; 2], u: i32) -> Option<BigRational> {
        let axis = usize::from(self.steep);
        let centre = BigRational::new(BigInt::from(2 * u + 1), BigInt::from(2));
        let [a, b] = ends.each_ref().map(|end| &end[axis] - &centre * &end[2]);
        let d = &a - &b;
        if !d.is_zero() {
            let t = a / d;
            let w = mix(&ends[0][2], &ends[1][2], &t);
            if w.is_positive() && !t.is_negative() && t <= BigRational::one() {
                return Some(t);
            }
        }
        // Beyond an end in front: that end. Of two it is the one on the step's side.
        let front = ends.each_ref().map(|end| end[2].is_positive());
        match front {
            [false, false] => None,
            [true, false] => Some(BigRational::zero()),
            [false, true] => Some(BigRational::one()),
            [true, true] => {
                let [pa, pb] = ends.each_ref().map(|end| &end[axis] / &end[2]);
                let nearer = (&pa - &centre).abs() <= (&pb - &centre).abs();
                Some(if nearer { BigRational::zero() } else { BigRational::one() })
            }
        }
    }
}

/// `a + t (b - a)`.
#[must_use]
pub fn mix(a: &BigRational, b: &BigRational, t: &BigRational) -> BigRational {
    a + t * (b - a)
}

/// A rational as the nearest `f64`.
#[must_use]
pub fn to_f64(v: &BigRational) -> f64 {
    v.to_f64().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(a: Vertex, b: Vertex) -> Vec<(i32, i32)> {
        let line = ExactLine::new([a, b], Viewport::new(8, 6));
        line.pixels().into_iter().map(|p| (p.x, p.y)).collect()
    }

    #[test]
    fn lines_are_drawn_by_hand() {
        // Centre to centre, along a diagonal.
        let diagonal = pixels([1, 1, 2], [7, 7, 2]);
        assert_eq!(diagonal, [(0, 0), (1, 1), (2, 2), (3, 3)]);
        // On the border of two rows: the lower one.
        assert_eq!(pixels([1, 2, 1], [3, 2, 1]), [(1, 2), (2, 2), (3, 2)]);
        // Steep, and half off the screen.
        assert_eq!(pixels([5, -4, 2], [5, 3, 2]), [(2, 0), (2, 1)]);
        assert_eq!(pixels([5, 3, 2], [10, 6, 4]), [(2, 1)]);
    }

    #[test]
    fn a_line_to_behind_the_eye_goes_on() {
        // From (6, 3) away from (2, 3), which is behind: to the right without end.
        assert_eq!(pixels([6, 3, 1], [-2, -3, -1]), [(6, 3), (7, 3)]);
        assert_eq!(pixels([6, 3, 1], [1, 0, 0]), [(6, 3), (7, 3)]);
        assert_eq!(pixels([-6, -3, -1], [-2, -3, -1]), []);
    }
}
