//! Setup in the quick tiers: pixel space, narrow where all three vertices are projected.
//!
//! Bit budgets, with `S` the subpixel bits, a guard band of 1024 px and viewports up to 512 px:
//!
//! | value | three projected | mixed or homogeneous |
//! | --- | --- | --- |
//! | coordinates | 2^(10 + S) | 2^24, 2^24, 2^15 |
//! | `a`, `b` | 2^(11 + S) | 2^40 |
//! | edge at a pixel | 2^(22.6 + 2 S), 2^(22.6 + S) after `>> S` | 2^51 in half pixels |
//! | determinant | 2^(22 + 2 S) | below 2^63 |
//!
//! Three projected: `E >> S`, floored, has the sign of `E` at every pixel, since a pixel's step is
//! a multiple of `2^S`; with 8 bits it stays below 2^30.7, so the walk is in `i32` in both tiers.
//!
//! Mixed: the matrix in pixel space is the clip-space one times a map of determinant `-2 W H`;
//! three homogeneous rows of at most `2^14 - 1` have a determinant of at most `4 (2^14 - 1)^3` (a 3
//! x 3 matrix of entries in [-1, 1] has one of at most 4), so in pixel space it is below
//! `2^19 2^44 = 2^63`. Its partial sums may pass `i64`, so they wrap; the total does not.

use super::{Extent, Facing, Setup, Tier, bounds};
use crate::math::Scale;
use crate::vertex::{GUARD_BAND, HOMOGENEOUS_BITS, Quick, QuickPosition, Viewport};

impl<const BITS: u32> Tier for Quick<BITS> {
    const NARROW: bool = true;
    const SUBPIXEL_BITS: u32 = BITS;

    #[inline]
    fn projected([p, q, r]: [&QuickPosition<BITS>; 3]) -> Option<[[i32; 2]; 3]> {
        let all = p.projected && q.projected && r.projected;
        all.then_some([[p.x, p.y], [q.x, q.y], [r.x, r.y]])
    }

    #[inline(never)]
    fn set_up(vertices: [&QuickPosition<BITS>; 3], viewport: &Viewport) -> Option<Setup> {
        let points = vertices.map(|v| v.in_pixels(viewport));
        let narrow = vertices.iter().all(|v| v.projected);
        let lines = if narrow { projected::<BITS>(&points) } else { mixed(&points) };
        if lines.determinant == 0 {
            return None;
        }
        // y is down: a front face is clockwise here.
        let facing = if lines.determinant < 0 { Facing::Front } else { Facing::Back };
        let sign = lines.determinant.signum();
        let column = |i: usize| lines.edges.map(|e| sign * e.get(i).copied().unwrap_or(0));
        let magnitude = Scale::of(lines.determinant.unsigned_abs());
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
            step: lines.step,
            narrow,
            facing,
            inverse: magnitude.reciprocal().times(Scale::power_of_two(lines.weight_shift)),
            bounds: bounds(&extents, viewport),
        })
    }
}

/// Edge functions before they are oriented.
struct Lines {
    /// `[a, b, c]` each, as in [`Setup`].
    edges: [[i64; 3]; 3],
    step: u32,
    determinant: i64,
    /// `1 / w = sum(k_i E_i) 2^weight_shift / |determinant|`.
    weight_shift: i32,
}

/// Three points in subpixels: edges in square subpixels, the determinant their sum, which is twice
/// the signed area.
#[inline]
fn projected<const BITS: u32>([p, q, r]: &[[i64; 3]; 3]) -> Lines {
    let half = 1 << (BITS - 1);
    let edge = |p: &[i64; 3], q: &[i64; 3]| {
        let (a, b) = (p[1] - q[1], q[0] - p[0]);
        [a, b, p[0] * q[1] - p[1] * q[0] + (a + b) * half]
    };
    let edges = [edge(q, r), edge(r, p), edge(p, q)];
    let [[_, _, c0], [_, _, c1], [_, _, c2]] = edges;
    // sum(k_i E_i) with k = 2^(S - 1) / w is 2^(S - 1) / w times the doubled area.
    Lines {
        edges,
        step: BITS,
        determinant: c0 + c1 + c2,
        weight_shift: 1 - crate::math::bits(BITS),
    }
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
    Lines { edges: lines.map(|[a, b, c, _]| [a, b, c]), step: 1, determinant, weight_shift: 0 }
}

const _: () = {
    let band = (2 * GUARD_BAND) << 8;
    let reach = (GUARD_BAND + Viewport::MAX_SIDE as i64 + 1) << 8;
    assert!((2 * band * reach) >> 8 <= i32::MAX as i64, "projected edge functions overflow i32");
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
        let (narrow, wide) = (projected::<4>(&points), mixed(&points));
        for (n, w) in narrow.edges.iter().zip(&wide.edges) {
            for (x, y) in [(0, 0), (17, 200), (239, 319)] {
                let at = |e: &[i64; 3], step: u32| ((e[0] * x + e[1] * y) << step) + e[2];
                // In half pixels and times the pixel's 16 subpixels' w: 2.
                assert_eq!(2 * at(n, 4), at(w, 1));
            }
        }
        assert_eq!(16 * narrow.determinant, wide.determinant);
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
