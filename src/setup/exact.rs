//! Setup in the exact tier: minors of the clip-space matrix in 64 bits.
//!
//! Bit budget, for coordinates up to `2^20` and viewports up to `512 x 512`:
//!
//! | value | bound | why |
//! | --- | --- | --- |
//! | minor | 2^41 | two products of 2^40 |
//! | determinant | 2^62.4 | Hadamard: `(sqrt(3) 2^20)^3`; its partial sums at most 3 x 2^61 |
//! | `a = H a'`, `b = -W b'` | 2^50 | a minor times 2^9 |
//! | edge at a pixel, in half pixels | 2^61 | `W H (a' x + b' y + c')`: 2^41 2^18 (1 + 1 + 1) < 2^60.6 |
//!
//! One pixel outside of the viewport, as far as a walk looks, adds less than 2^52. All fit `i64`.

use super::{Extent, Facing, Setup, Tier, bounds};
use crate::math::Scale;
use crate::vertex::{Exact, ExactPosition, Viewport};

/// The cross product of two vertices: the line through both.
#[inline]
fn minor(p: &ExactPosition, q: &ExactPosition) -> [i64; 3] {
    let [px, py, pw] = [p.x, p.y, p.w].map(i64::from);
    let [qx, qy, qw] = [q.x, q.y, q.w].map(i64::from);
    [py * qw - pw * qy, pw * qx - px * qw, px * qy - py * qx]
}

/// What the bounding box needs of a vertex: pixel space, `(W (x + w), H (w - y), 2 w)`.
#[inline]
fn extent(p: &ExactPosition, viewport: &Viewport) -> Extent {
    let [x, y, w] = [p.x, p.y, p.w].map(i64::from);
    let (width, height) = (i64::from(viewport.width), i64::from(viewport.height));
    Extent {
        point: [width * (x + w), height * (w - y), 2 * w],
        first: [i32::from(p.column), i32::from(p.row)],
    }
}

impl Tier for Exact {
    const SUBPIXEL_BITS: u32 = 0;
    const APPROXIMATE: bool = false;

    #[inline]
    fn projected(_: [&ExactPosition; 3]) -> Option<[[i32; 2]; 3]> {
        None
    }

    #[inline(never)]
    fn set_up([p, q, r]: [&ExactPosition; 3], viewport: &Viewport) -> Option<Setup> {
        let minors = [minor(q, r), minor(r, p), minor(p, q)];
        let [a, b, c] = minors[0];
        let determinant = i64::from(p.x) * a + i64::from(p.y) * b + i64::from(p.w) * c;
        if determinant == 0 {
            return None;
        }
        let facing = if determinant > 0 { Facing::Front } else { Facing::Back };
        let (w, h) = (i64::from(viewport.width), i64::from(viewport.height));
        let sign = determinant.signum();
        // E = W H e . P in half pixels: a H (2 X + 1 - W) + b W (H - 1 - 2 Y) + c W H.
        let edges = minors.map(|[a, b, c]| {
            let (a, b) = (sign * a * h, -sign * b * w);
            [a, b, a * (1 - w) + b * (1 - h) + sign * c * w * h]
        });
        let column = |i: usize| edges.map(|e| e.get(i).copied().unwrap_or(0));
        Some(Setup {
            a: column(0),
            b: column(1),
            c: column(2),
            step: 1,
            facing,
            // sum(E_i w_i) = W H det.
            inverse: Scale::of(determinant.unsigned_abs())
                .reciprocal()
                .times(viewport.inverse_area),
            bounds: bounds(&[p, q, r].map(|v| extent(v, viewport)), viewport),
        })
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
