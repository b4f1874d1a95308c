//! Setup in the quick tiers: in pixel space, whatever the vertices.
//!
//! Bit budgets, with `S` the subpixel bits, a guard band of 1024 px and viewports up to 512 px:
//!
//! | value | three projected | mixed or homogeneous |
//! | --- | --- | --- |
//! | coordinates | 2^(10 + S), `w` 2^S | 2^24, 2^24, 2^15 |
//! | `a`, `b` | 2^(11 + 2 S) | 2^40 |
//! | edge at a pixel | 2^(22.6 + 2 S) | 2^50 |
//! | determinant | 2^(22 + 3 S) | below 2^63 |
//!
//! Coverage of three projected vertices is decided by their rows (`traversal/rows.rs`), not by these edge functions,
//! unless a plane cuts the triangle, or it has no planes (`setup/plane.rs`).
//!
//! Mixed: the matrix in pixel space is the clip-space one times a map of determinant `-2 W H`;
//! three homogeneous rows of at most `2^14 - 1` have a determinant of at most `4 (2^14 - 1)^3` (a 3
//! x 3 matrix of entries in [-1, 1] has one of at most 4), so in pixel space it is below
//! `2^19 2^44 = 2^63`. Its partial sums may pass `i64`, so they wrap; the total does not.

use super::{Facing, Tier, line};
use crate::math::Scale;
use crate::vertex::{
    GUARD_BAND, HOMOGENEOUS_BITS, PixelVertex, Quick, QuickPosition, ScaleOf, Viewport,
};

impl<const BITS: u32> Tier for Quick<BITS> {
    const SUBPIXEL_BITS: u32 = BITS;

    const PROJECTS: bool = true;

    #[inline]
    fn corners(vertices: [&QuickPosition<BITS>; 3]) -> [[i32; 2]; 3] {
        vertices.map(|v| [v.x, v.y])
    }

    #[inline]
    fn in_pixels(vertex: &QuickPosition<BITS>, viewport: &Viewport) -> PixelVertex {
        vertex.in_pixels(viewport)
    }

    #[inline]
    fn orient(
        _: [&QuickPosition<BITS>; 3],
        in_pixels: &[PixelVertex; 3],
        _: &Viewport,
    ) -> Option<(Facing, ScaleOf)> {
        let determinant = determinant(in_pixels);
        // y is down: a front face is clockwise here.
        let facing = Facing::of(determinant.wrapping_neg())?;
        let Scale { mantissa, exponent } = Scale::reciprocal_of(determinant.unsigned_abs());
        // sum(E_i w_i) is it, with w twice the snapped.
        Some((facing, ScaleOf(Scale { mantissa, exponent: exponent + 1 })))
    }
}

/// The determinant of three points of pixel space.
#[inline]
fn determinant([p, q, r]: &[PixelVertex; 3]) -> i64 {
    let [x, y, w] = p.point.map(i64::from);
    let [a, b, c] = line(&q.point, &r.point);
    // Partial sums may wrap; the total is below 2^63, as the module says.
    x.wrapping_mul(a).wrapping_add(y.wrapping_mul(b)).wrapping_add(w.wrapping_mul(c))
}

const _: () = {
    let band = (2 * GUARD_BAND) << 8;
    assert!(band <= i32::MAX as i64, "differences of projected corners overflow i32");
    let side = Viewport::MAX_SIDE as i128;
    let entry = (1i128 << HOMOGENEOUS_BITS) - 1;
    assert!(2 * side * side * 4 * entry * entry * entry < 1 << 63, "a determinant overflows i64");
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::{Outline, doubled_area, facing};
    use crate::vertex::{ClipVertex, Rect, Snap};

    fn snap<const S: u32>(v: [[i32; 3]; 3], viewport: &Viewport) -> [QuickPosition<S>; 3] {
        v.map(|[x, y, w]| Quick::snap(&ClipVertex { raw: [x, y, 0, w], shift: 0 }, 1, viewport))
    }

    /// Of projected corners they are what square subpixels make them, at any centre.
    #[test]
    fn projected_edges_are_those_of_the_corners() {
        let viewport = Viewport::new(240, 320).unwrap();
        let v = snap::<4>([[-900, 310, 1000], [2000, 1500, 2700], [-77, -3000, 4000]], &viewport);
        let corners = Quick::corners([&v[0], &v[1], &v[2]]);
        let area = doubled_area(&corners);
        for back in [false, true] {
            let order = if back { [0, 2, 1] } else { [0, 1, 2] };
            let setup = Quick::set_up(order.map(|i: usize| &v[i]), &viewport).unwrap();
            let sign = if back { -1 } else { 1 } * area.signum();
            assert_eq!(setup.facing, facing(sign).unwrap());
            for (x, y) in [(0, 0), (17, 200), (239, 319)] {
                let [x_sub, y_sub] = [x, y].map(|v| i64::from(16 * v + 8));
                let edge = |i: usize, j: usize| {
                    let ([px, py], [qx, qy]) =
                        (corners[order[i]].map(i64::from), corners[order[j]].map(i64::from));
                    sign * ((qx - px) * (y_sub - py) - (qy - py) * (x_sub - px))
                };
                assert_eq!(setup.edges_at(x, y), [edge(1, 2), edge(2, 0), edge(0, 1)]);
            }
        }
    }

    /// The guard band's ends: no step overflows, and the box is the outline's.
    #[test]
    fn projected_corners_do_not_overflow() {
        let viewport = Viewport::new(512, 512).unwrap();
        let ends = [-(1024 << 8), -1, 511 << 8, 1024 << 8];
        for i in 0..4usize.pow(6) {
            let corner = |n: u32| [0, 1].map(|axis| ends[i >> (4 * n + 2 * axis) & 3]);
            let corners = [0, 1, 2].map(corner);
            let v = corners.map(|[x, y]| QuickPosition::<8> {
                x,
                y,
                w: 256,
                projected: true,
                ..Default::default()
            });
            let setup = Quick::set_up([&v[0], &v[1], &v[2]], &viewport);
            let area = doubled_area(&corners);
            let Some(setup) = setup else {
                assert_eq!(area, 0);
                continue;
            };
            assert_eq!(setup.facing, facing(area).unwrap());
            let whole = Outline::new(&corners, area > 0).bounds(8);
            let shown = Rect { x0: 0, y0: 0, x1: 512, y1: 512 };
            let [front, behind] = setup.bounds.map(|bounds| bounds.intersect(shown));
            assert!(behind.is_empty());
            let same = whole.intersect(shown);
            assert!(front == same || (front.is_empty() && same.is_empty()), "{corners:?}");
            for (x, y) in [(-1, -1), (512, 512), (-1, 512)] {
                assert!(setup.edges_at(x, y).iter().all(|e| e.abs() < 1 << 41));
                let sum: i64 = setup.edges_at(x, y).iter().sum();
                assert_eq!(sum, area.abs());
            }
        }
    }

    #[test]
    fn homogeneous_corners_do_not_overflow() {
        let viewport = Viewport::new(512, 512).unwrap();
        const END: i32 = (1 << 14) - 1;
        let sign = |i: u32, n: u32| if i >> n & 1 == 0 { END } else { -END };
        for i in 0..512 {
            let v = [0, 1, 2].map(|k| [0, 1, 2].map(|n| sign(i, 3 * k + n)));
            let exact = |m: [[i32; 3]; 3]| {
                let m = m.map(|r| r.map(i128::from));
                m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
                    + m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2])
                    + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
            };
            let positions = v.map(|[x, y, w]| QuickPosition::<8> { x, y, w, ..Default::default() });
            let points = positions.each_ref().map(|v| v.in_pixels(&viewport));
            assert_eq!(i128::from(determinant(&points)), -2 * 512 * 512 * exact(v));
            if let Some(setup) =
                Quick::set_up([&positions[0], &positions[1], &positions[2]], &viewport)
            {
                for (x, y) in [(0, 0), (512, 512), (0, 512)] {
                    let edges = setup.edges_at(x, y);
                    assert!(edges.iter().all(|e| e.abs() < 1 << 51));
                    // sum(E_i w_i) is the determinant.
                    let sum: i128 =
                        (0..3).map(|i| i128::from(edges[i]) * i128::from(points[i].point[2])).sum();
                    assert_eq!(sum, i128::from(determinant(&points)).abs());
                }
            }
        }
    }
}
