//! Setup in the quick tiers: pixel space, from 32-bit corners where all three vertices are projected.
//!
//! Bit budgets, with `S` the subpixel bits, a guard band of 1024 px and viewports up to 512 px:
//!
//! | value | three projected | mixed or homogeneous |
//! | --- | --- | --- |
//! | coordinates | 2^(10 + S) | 2^24, 2^24, 2^15 |
//! | `a`, `b` | 2^(11 + S) | 2^40 |
//! | edge at a pixel | 2^(22.6 + 2 S) | 2^51 in half pixels |
//! | determinant | 2^(22 + 2 S) | below 2^63 |
//!
//! Three projected: differences of corners are the steps, in 32 bits; the rest has 64. Coverage is decided by
//! their rows (`traversal/rows.rs`), not by these edge functions, unless a plane cuts the triangle, or it has no
//! planes (`setup/plane.rs`).
//!
//! Mixed: the matrix in pixel space is the clip-space one times a map of determinant `-2 W H`;
//! three homogeneous rows of at most `2^14 - 1` have a determinant of at most `4 (2^14 - 1)^3` (a 3
//! x 3 matrix of entries in [-1, 1] has one of at most 4), so in pixel space it is below
//! `2^19 2^44 = 2^63`. Its partial sums may pass `i64`, so they wrap; the total does not.

use super::{Extent, Facing, Outline, Setup, Tier, bounds, doubled_area, facing};
use crate::math::{Scale, bits};
use crate::vertex::{GUARD_BAND, HOMOGENEOUS_BITS, Quick, QuickPosition, Rect, Viewport};

impl<const BITS: u32> Tier for Quick<BITS> {
    const SUBPIXEL_BITS: u32 = BITS;

    const PROJECTS: bool = true;

    #[inline]
    fn corners(vertices: [&QuickPosition<BITS>; 3]) -> [[i32; 2]; 3] {
        vertices.map(|v| [v.x, v.y])
    }

    #[inline(never)]
    fn set_up(vertices: [&QuickPosition<BITS>; 3], viewport: &Viewport) -> Option<Setup> {
        if vertices.iter().all(|v| v.projected) {
            projected::<BITS>(&Self::corners(vertices))
        } else {
            mixed_setup(vertices, viewport)
        }
    }
}

/// Three projected vertices: edges in square subpixels, the determinant their sum, which is twice the signed
/// area.
#[inline]
fn projected<const BITS: u32>(corners: &[[i32; 2]; 3]) -> Option<Setup> {
    let area = doubled_area(corners);
    let facing = facing(area)?;
    let [p, q, r] = corners;
    let clockwise = facing == Facing::Back;
    let half = 1 << (BITS - 1);
    let edge = |p: &[i32; 2], q: &[i32; 2]| {
        let (a, b) = (p[1] - q[1], q[0] - p[0]);
        let (a, b) = if clockwise { (a, b) } else { (-a, -b) };
        // 0 at `p`, which is at most 2^(10 + S) + 2^S away from the centre of pixel (0, 0).
        let at_origin =
            i64::from(a) * i64::from(half - p[0]) + i64::from(b) * i64::from(half - p[1]);
        (i64::from(a), i64::from(b), at_origin)
    };
    let ((a0, b0, c0), (a1, b1, c1), (a2, b2, c2)) = (edge(q, r), edge(r, p), edge(p, q));
    // sum(k_i E_i) with k = 2^(S - 1) / w is 2^(S - 1) / w times the doubled area.
    let magnitude = Scale::of(area.unsigned_abs()).reciprocal();
    let front = Outline::new(corners, clockwise).bounds(BITS);
    Some(Setup {
        a: [a0, a1, a2],
        b: [b0, b1, b2],
        c: [c0, c1, c2],
        step: BITS,
        facing,
        inverse: Scale { exponent: magnitude.exponent + 1 - bits(BITS), ..magnitude },
        bounds: [front, Rect { x0: 0, y0: 0, x1: 0, y1: 0 }],
    })
}

/// Any three vertices: pixel space, in 64 bits.
#[inline(never)]
fn mixed_setup<const BITS: u32>(
    vertices: [&QuickPosition<BITS>; 3],
    viewport: &Viewport,
) -> Option<Setup> {
    let points = vertices.map(|v| v.in_pixels(viewport));
    let lines = mixed(&points);
    if lines.determinant == 0 {
        return None;
    }
    // y is down: a front face is clockwise here.
    let facing = if lines.determinant < 0 { Facing::Front } else { Facing::Back };
    let sign = lines.determinant.signum();
    let column = |i: usize| lines.edges.map(|e| sign * e.get(i).copied().unwrap_or(0));
    let extents = [0, 1, 2].map(|i: usize| {
        let zero = Extent { point: [0; 3], first: [0; 2] };
        points
            .get(i)
            .zip(vertices.get(i))
            .map_or(zero, |(&point, v)| Extent { point, first: v.first_pixel(viewport) })
    });
    Some(Setup {
        a: column(0),
        b: column(1),
        c: column(2),
        step: 1,
        facing,
        inverse: Scale::of(lines.determinant.unsigned_abs()).reciprocal(),
        bounds: bounds(&extents, viewport),
    })
}

/// Edge functions before they are oriented.
struct Lines {
    /// `[a, b, c]` each, as in [`Setup`].
    edges: [[i64; 3]; 3],
    determinant: i64,
}

/// Any three points of pixel space: edges in half pixels.
fn mixed([p, q, r]: &[[i64; 3]; 3]) -> Lines {
    let edge = |p: &[i64; 3], q: &[i64; 3]| {
        let a = p[1] * q[2] - p[2] * q[1];
        let b = p[2] * q[0] - p[0] * q[2];
        let c = p[0] * q[1] - p[1] * q[0];
        [a, b, a + b + 2 * c, c]
    };
    let lines = [edge(q, r), edge(r, p), edge(p, q)];
    let [a, b, _, c] = lines[0];
    // Partial sums may wrap; the total is below 2^63, as the module says.
    let determinant =
        p[0].wrapping_mul(a).wrapping_add(p[1].wrapping_mul(b)).wrapping_add(p[2].wrapping_mul(c));
    Lines { edges: lines.map(|[a, b, c, _]| [a, b, c]), determinant }
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
    use crate::vertex::{ClipVertex, Snap};

    fn snap<const S: u32>(v: [[i32; 3]; 3], viewport: &Viewport) -> [QuickPosition<S>; 3] {
        v.map(|[x, y, w]| Quick::snap(&ClipVertex { raw: [x, y, 0, w], shift: 0 }, 1, viewport))
    }

    #[test]
    fn three_projected_and_mixed_setups_have_the_same_edges() {
        let viewport = Viewport::new(240, 320).unwrap();
        let v = snap::<4>([[-900, 310, 1000], [2000, 1500, 2700], [-77, -3000, 4000]], &viewport);
        let points = [0, 1, 2].map(|i: usize| v[i].in_pixels(&viewport));
        let corners = Quick::corners([&v[0], &v[1], &v[2]]);
        let (short, wide) = (projected::<4>(&corners).unwrap(), mixed(&points));
        for (x, y) in [(0, 0), (17, 200), (239, 319)] {
            let at = |e: &[i64; 3]| 2 * (e[0] * i64::from(x) + e[1] * i64::from(y)) + e[2];
            // In half pixels and times the pixel's 16 subpixels' w: 2.
            let sign = wide.determinant.signum();
            assert_eq!(short.edges_at(x, y).map(|e| 2 * e), wide.edges.map(|e| sign * at(&e)));
        }
        assert_eq!(16 * doubled_area(&corners), wide.determinant);
        assert_eq!(short.facing, facing(wide.determinant).unwrap());
    }

    #[test]
    fn homogeneous_corners_do_not_overflow() {
        let viewport = Viewport::new(512, 512).unwrap();
        const END: i32 = (1 << 14) - 1;
        let sign = |i: u32, n: u32| if i >> n & 1 == 0 { END } else { -END };
        for i in 0..512 {
            let v = [0, 1, 2].map(|k| [0, 1, 2].map(|n| sign(i, 3 * k + n)));
            let determinant = |m: [[i32; 3]; 3]| {
                let m = m.map(|r| r.map(i128::from));
                m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
                    + m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2])
                    + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
            };
            let points = v.map(|[x, y, w]| {
                QuickPosition::<8> { x, y, w, ..Default::default() }.in_pixels(&viewport)
            });
            let lines = mixed(&points);
            assert_eq!(i128::from(lines.determinant), -2 * 512 * 512 * determinant(v));
            for (x, y) in [(0, 0), (512, 512), (0, 512)] {
                for e in lines.edges {
                    assert!((2 * (e[0] * x + e[1] * y) + e[2]).abs() < 1 << 52);
                }
            }
        }
    }
}
