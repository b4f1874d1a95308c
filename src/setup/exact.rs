//! Setup in the exact tier: minors of the clip-space matrix in 64 bits.
//!
//! Bit budget, for coordinates up to `2^20` and viewports up to `512 x 512`:
//!
//! | value | bound | why |
//! | --- | --- | --- |
//! | minor | 2^41 | two products of 2^40 |
//! | determinant | 2^62.4 | Hadamard: `(sqrt(3) 2^20)^3`; its partial sums at most 3 x 2^61 |
//! | pixel space | 2^30, 2^30, 2^21 | `W (x + w)`, `H (w - y)`, `2 w` |
//! | `a`, `b` | 2^51 | `2 H` and `2 W` times a minor |
//! | the constant of a line in pixel space | 2^61 | two products of 2^60 |
//! | edge at a pixel | 2^61 | `W H` times clip space's: 2^18 2^41 (1 + 1 + 1) < 2^60.6 |
//!
//! One pixel outside of the viewport, as far as a walk looks, adds less than 2^52. All fit `i64`.

use super::{Facing, Outline, Place, Tier};
use crate::math::{Scale, cross, unsigned};
use crate::vertex::{Exact, ExactPosition, PixelVertex, Rect, ScaleOf, Viewport};

/// How the edge function of two vertices grows along a row of the screen.
#[inline]
pub(super) fn row_minor(p: &ExactPosition, q: &ExactPosition) -> i64 {
    cross(p.y, q.w, p.w, q.y)
}

/// How the edge function of two vertices grows up a column of the screen.
#[inline]
pub(super) fn column_minor(p: &ExactPosition, q: &ExactPosition) -> i64 {
    cross(p.w, q.x, p.x, q.w)
}

/// The cross product of two vertices: the line through both.
#[inline]
fn minor(p: &ExactPosition, q: &ExactPosition) -> [i64; 3] {
    [row_minor(p, q), column_minor(p, q), cross(p.x, q.y, p.y, q.x)]
}

/// The determinant of three vertices: its sign is the facing. Of all that setup makes it is the first, since half of
/// a mesh's triangles look away.
#[inline(never)]
pub(crate) fn determinant([p, q, r]: [&ExactPosition; 3]) -> i64 {
    let [a, b, c] = minor(q, r);
    i64::from(p.x) * a + i64::from(p.y) * b + i64::from(p.w) * c
}

impl ExactPosition {
    /// How far past the centre of its pixel it is, in pixels times `2 w`: within `-2 w < x, y <= 0` where the vertex is on the screen.
    ///
    /// Each is a difference of two terms of at most `2^30 + 2^20`, neither of them negative there.
    #[inline]
    pub(super) const fn past_centre(&self, viewport: &Viewport) -> [i32; 2] {
        let (column, row) = (self.column as i32, self.row as i32);
        [
            viewport.width * (self.x + self.w) - (2 * column + 1) * self.w,
            viewport.height * (self.w - self.y) - (2 * row + 1) * self.w,
        ]
    }
}

/// A vertex on the screen, from the pixel that it is in or just before: it is `(x, y) / (2 w)` pixels from the centre
/// of pixel `(column, row)`, exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Anchored {
    /// `-2 w < x <= 0`, and `y` as well: no centre is between.
    pub(crate) x: i32,
    pub(crate) y: i32,
    /// 1 to `2^20`.
    pub(crate) w: i32,
    /// In pixels; at most 512 from those of other vertices.
    pub(crate) column: i32,
    pub(crate) row: i32,
}

impl Anchored {
    /// A vertex with `w > 0`; `None` where its column or row is not its own: it is off the screen, or was snapped for
    /// another viewport.
    #[inline]
    fn new(p: &ExactPosition, viewport: &Viewport) -> Option<Self> {
        let [x, y] = p.past_centre(viewport);
        let before = |v: i32| unsigned(v.wrapping_neg()) < unsigned(2 * p.w);
        let (column, row) = (i32::from(p.column), i32::from(p.row));
        (before(x) && before(y)).then_some(Self { x, y, w: p.w, column, row })
    }

    /// From another vertex's pixel, in half units of `1 / w`: at most `2^30 + 2^21`.
    #[inline]
    pub(crate) const fn from(&self, other: &Self) -> [i32; 2] {
        let (columns, rows) = (self.column - other.column, self.row - other.row);
        [self.x + 2 * self.w * columns, self.y + 2 * self.w * rows]
    }
}

impl Place for Anchored {
    #[inline]
    fn row(self, _: u32) -> i32 {
        self.row
    }

    #[inline]
    fn moved(self, columns: i32, _: u32) -> Self {
        Self { column: self.column + columns, ..self }
    }
}

/// The outline of a triangle of three vertices with `w > 0`; `None` where one is not [`Anchored`].
#[inline(never)]
pub(crate) fn outline(
    vertices: [&ExactPosition; 3],
    facing: Facing,
    viewport: &Viewport,
) -> Option<Outline<Anchored>> {
    // Those of a row have no centre between them, and any may be the highest.
    let Outline { top, left, right } =
        Outline::from_top(vertices, facing == Facing::Back, |v| i32::from(v.row));
    let [top, left, right] = [top, left, right].map(|v| Anchored::new(v, viewport));
    Some(Outline { top: top?, left: left?, right: right? })
}

/// The box of the pixel centres that a triangle of three vertices with `w > 0` may cover.
#[cfg(feature = "heapless")]
#[inline]
pub(crate) fn first_centres([a, b, c]: [&ExactPosition; 3]) -> Rect {
    let [columns, rows] = [[a.column, b.column, c.column], [a.row, b.row, c.row]];
    let [x, y] = [columns, rows].map(|[a, b, c]| [a.min(b).min(c), a.max(b).max(c)].map(i32::from));
    Rect { x0: x[0], y0: y[0], x1: x[1], y1: y[1] }
}

impl Outline<Anchored> {
    /// The box of the pixel centres it may cover.
    #[inline]
    pub(crate) fn bounds(&self) -> Rect {
        let Self { top, left, right } = self;
        Rect {
            x0: top.column.min(left.column).min(right.column),
            y0: top.row,
            x1: top.column.max(left.column).max(right.column),
            y1: left.row.max(right.row),
        }
    }
}

impl Tier for Exact {
    const SUBPIXEL_BITS: u32 = 0;

    #[inline]
    fn corners(_: [&ExactPosition; 3]) -> [[i32; 2]; 3] {
        [[0; 2]; 3]
    }

    #[inline]
    fn homogeneous(vertices: [&ExactPosition; 3]) -> Option<[&ExactPosition; 3]> {
        Some(vertices)
    }

    #[inline(never)]
    fn in_pixels(vertex: &ExactPosition, viewport: &Viewport) -> PixelVertex {
        let first = [i32::from(vertex.column), i32::from(vertex.row)];
        PixelVertex::of_clip([vertex.x, vertex.y, vertex.w], first, viewport)
    }

    #[inline]
    fn orient(
        vertices: [&ExactPosition; 3],
        _: &[PixelVertex; 3],
        viewport: &Viewport,
    ) -> Option<(Facing, ScaleOf)> {
        let determinant = determinant(vertices);
        let facing = Facing::of(determinant)?;
        let inverse = Scale::reciprocal_of(determinant.unsigned_abs());
        // sum(E_i w_i) = W H det.
        Some((facing, ScaleOf(inverse.times(viewport.inverse_area))))
    }
}

const _: () = {
    let minor = 2i128 << (2 * Exact::COORDINATE_BITS);
    let side = Viewport::MAX_SIDE as i128;
    assert!(3 * minor * side * side < 1 << 61, "an edge function takes 61 bits");
    let outside = 3 * minor * side * side + 4 * minor * side;
    assert!(outside < i64::MAX as i128, "an edge function one pixel outside overflows i64");
    assert!(3 * (minor << Exact::COORDINATE_BITS) <= i64::MAX as i128, "a partial determinant");
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::Setup;
    use crate::vertex::{ClipVertex, Snap};

    fn set_up(v: [[i32; 3]; 3], width: u32, height: u32) -> Option<Setup> {
        let viewport = Viewport::new(width, height).unwrap();
        let v = v.map(|[x, y, w]| {
            Exact::snap(&ClipVertex { raw: [x, y, 0, w], shift: 0 }, 1, &viewport)
        });
        Exact::set_up([&v[0], &v[1], &v[2]], &viewport)
    }

    #[test]
    fn edges_sum_to_the_determinant() {
        // sum(E_i w_i) = W H |det| at every pixel. The snap scales each of these vertices by 2^19,
        // so every w is 2^20; their own determinant is 8.
        let v = [[-1, -1, 2], [1, -1, 2], [0, 1, 2]];
        let setup = set_up(v, 7, 5).unwrap();
        assert_eq!(setup.facing, Facing::Front);
        for i in 0..35 {
            let sum: i64 = setup.edges_at(i % 7, i / 7).iter().sum();
            assert_eq!(i128::from(sum) << 20, (7 * 5 * 8) << (3 * 19));
        }
    }

    #[test]
    fn facing_is_the_sign_of_the_determinant() {
        let ccw = [[-1, -1, 2], [1, -1, 2], [0, 1, 2]];
        assert_eq!(set_up(ccw, 8, 8).unwrap().facing, Facing::Front);
        assert_eq!(set_up([ccw[1], ccw[0], ccw[2]], 8, 8).unwrap().facing, Facing::Back);
        assert!(set_up([ccw[0], ccw[0], ccw[2]], 8, 8).is_none());
        assert!(set_up([[0, 0, 0], ccw[0], ccw[2]], 8, 8).is_none());
    }

    #[test]
    fn the_grids_ends_do_not_overflow() {
        const END: i32 = 1 << 20;
        let signs = |i: u32, n: u32| if i >> n & 1 == 0 { END } else { -END };
        for i in 0..512 {
            let v = [0, 1, 2].map(|k| [0, 1, 2].map(|n| signs(i, 3 * k + n)));
            for (w, h) in [(512, 512), (1, 1), (511, 3)] {
                if let Some(setup) = set_up(v, w, h) {
                    for (x, y) in [(0, 0), (w, h), (w, 0), (0, h)] {
                        let edges = setup.edges_at(x as i32, y as i32);
                        assert!(edges.iter().all(|e| e.abs() < 1 << 62));
                    }
                }
            }
        }
    }
}
