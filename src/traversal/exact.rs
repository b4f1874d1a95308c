//! An edge between two vertices of the exact tier, row by row: the first column whose centre is not left of it.
//!
//! The edge function is walked by additions: a row further it changes by one step, then the column moves until its
//! sign changes. With `p`, `q` the upper and the lower vertex, in pixels from the first centre that is not left of or
//! above `p`, as `(x, y, 2 w)` with `-2 w < x, y <= 0` for `p`:
//!
//! ```text
//! E(i, j) / 2 = a i - b j + c / 2,  a = w_p y_q - w_q y_p,  b = w_p x_q - w_q x_p,  c = y_p x_q - x_p y_q
//! ```
//!
//! `E >= 0` is right of the edge or on it; `c` may be halved with a floor. An edge that goes right moves its column right
//! only, and one that goes left moves it left: between two vertices it goes at most as far as they are apart. A row's
//! column is found when it is asked for, so that no row after the last is looked at.
//!
//! | value | bound | why |
//! | --- | --- | --- |
//! | `w` | 2^20 | the grid |
//! | `x_p`, `y_p` | 2^21 | a pixel |
//! | `x_q`, `y_q` | 2^30 + 2^21 | 512 pixels |
//! | `a`, `b` | 2^51.1 | |
//! | `c` | 2^52.1 | |
//! | `b` times the rows that are skipped | 2^60.1 | |

use super::side::Side;
use crate::math::cross;
use crate::setup::Anchored;

/// An edge on one row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stepped {
    /// Negative until the column is the row's: `E / 2` for an edge that goes right, `a - 1 - E / 2` for one that goes
    /// left.
    value: i64,
    /// What a column adds, more than 0.
    a: i64,
    /// What a row adds, at most 0.
    b: i64,
    x: i32,
    /// 1 or -1.
    direction: i32,
}

impl Side for Stepped {
    type Corner = Anchored;

    #[inline(always)]
    fn new(upper: Anchored, lower: Anchored, row: i32, _: u32) -> Self {
        let mut side = Self::between(&upper, &lower);
        let skipped = row - upper.row;
        if skipped > 0 {
            side.value += side.b * i64::from(skipped);
        }
        side
    }

    #[inline(always)]
    fn x(&mut self) -> i32 {
        while self.value < 0 {
            self.value += self.a;
            self.x += self.direction;
            // Nothing; but with it the loop is not unrolled.
            core::hint::black_box(());
        }
        self.x
    }

    #[inline(always)]
    fn step(&mut self) {
        self.value += self.b;
    }
}

impl Stepped {
    /// The edge on its first row. Inlined where products are instructions: returned through memory it would be copied from
    /// place to place.
    #[cfg_attr(not(all(target_arch = "arm", not(target_has_atomic = "32"))), inline(always))]
    #[cfg_attr(all(target_arch = "arm", not(target_has_atomic = "32")), inline(never))]
    fn between(upper: &Anchored, lower: &Anchored) -> Self {
        let [qx, qy] = lower.from(upper);
        let Anchored { x: px, y: py, w: pw, .. } = *upper;
        let a = cross(pw, qy, lower.w, py);
        let b = cross(pw, qx, lower.w, px);
        let value = cross(py, qx, px, qy) >> 1;
        let x = upper.column;
        if b > 0 {
            Self { value, a, b: -b, x, direction: 1 }
        } else {
            Self { value: a - 1 - value, a, b, x, direction: -1 }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::{Facing, Tier, determinant, outline};
    use crate::traversal::Rows;
    use crate::vertex::{ClipVertex, Exact, Rect, Snap, Viewport};
    use std::vec::Vec;

    /// All rows of a triangle from `y0` to `y1` against edge functions; whether it has an outline and covers anything.
    fn follows(v: [[i32; 3]; 3], viewport: &Viewport, y0: i32, y1: i32) -> bool {
        let v = v
            .map(|[x, y, w]| Exact::snap(&ClipVertex { raw: [x, y, 0, w], shift: 0 }, 1, viewport));
        let v = [&v[0], &v[1], &v[2]];
        let Some(facing) = Facing::of(determinant(v)) else {
            return false;
        };
        let setup = Exact::set_up(v, viewport).unwrap();
        assert_eq!(setup.facing, facing);
        let Some(outline) = outline(v, facing, viewport) else {
            return false;
        };
        let whole = outline.bounds();
        let bounds = Rect { y0: whole.y0.max(y0), y1: whole.y1.min(y1), ..whole };
        if bounds.is_empty() {
            return false;
        }
        let covered = |y: i32| -> Vec<i32> {
            let inside = |x: i32| {
                let edges = setup.edges_at(x, y);
                edges
                    .iter()
                    .zip(&setup.edges)
                    .all(|(&e, f)| e > 0 || (e == 0 && (f.a > 0 || (f.a == 0 && f.b > 0))))
            };
            (-1..=viewport.width).filter(|&x| inside(x)).collect()
        };
        let mut any = false;
        let mut seen = bounds.y0;
        for (x0, x1) in Rows::<Stepped>::new(&outline, bounds, 0) {
            let span: Vec<i32> = (x0..x1).collect();
            assert_eq!(span, covered(seen), "{v:?}, row {seen} of {bounds:?}");
            assert!(span.iter().all(|x| (whole.x0..whole.x1).contains(x)));
            any |= !span.is_empty();
            seen += 1;
        }
        assert_eq!(seen, bounds.y1);
        if y0 <= whole.y0 && y1 >= whole.y1 {
            assert!(covered(whole.y0 - 1).is_empty() && covered(whole.y1).is_empty());
        }
        any
    }

    /// Random triangles of all sizes, thin ones, and with vertices on centres and on rows of them.
    #[test]
    fn rows_equal_edge_functions() {
        let mut state = 3u64;
        let mut below = move |n: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            ((state >> 33) % u64::from(n.unsigned_abs())) as i32
        };
        let mut drawn = 0;
        for i in 0..6000 {
            let side = [512, 512, 240, 7, 1][i % 5];
            let viewport = Viewport::new(side, [512, 64, 320, 5, 2][i / 5 % 5]).unwrap();
            let near = 1 << below(20);
            let at = [0, 1].map(|_| below(1 << 20) - (1 << 19));
            let reach = 2 << (8 + below(12));
            let mut v = [[0; 3]; 3].map(|_| {
                let w = (1 << 20) - if i % 2 == 0 { below(near) } else { 0 };
                let to = |at: i32, n: i32| (at + n - reach).clamp(-w, w);
                [to(at[0], below(2 * reach + 1)), to(at[1], below(2 * reach + 1)), w]
            });
            match i % 7 {
                // On centres and corners of the pixels of power-of-two sides.
                0 => v = v.map(|[x, y, _]| [x & !0x7ff, y & !0x7ff, 1 << 20]),
                1 => v[2][1] = v[1][1],
                2 => v[2] = [v[1][0], v[1][1] - 1, v[1][2]],
                3 => v[2] = [0, 1, 2].map(|n| (v[0][n] + v[1][n]) / 2 + below(3) - 1),
                _ => {}
            }
            let y = below(viewport.height);
            let (y0, y1) = [(0, 512), (y, y + 1), (y, y + 40)][i % 3];
            drawn += i32::from(follows(v, &viewport, y0, y1));
        }
        assert!(drawn > 500, "{drawn} triangles covered something");
    }

    #[test]
    fn the_grids_ends_do_not_overflow() {
        const END: i32 = 1 << 20;
        let ends = [-END, 1 - END, 0, END - 1, END];
        let viewports = [(512, 512), (511, 3), (1, 1)].map(|(w, h)| Viewport::new(w, h).unwrap());
        for i in 0..5usize.pow(6) {
            let at = |n: u32| ends[i / 5usize.pow(n) % 5];
            let v = [0, 2, 4].map(|n| [at(n), at(n + 1), END]);
            let viewport = &viewports[i % 3];
            for (y0, y1) in [(0, 1), (256, 257), (511, 512)] {
                follows(v, viewport, y0, y1);
            }
        }
    }

    #[test]
    fn a_vertex_of_another_viewport_has_no_outline() {
        let snapped = |raw: [i32; 3], viewport: &Viewport| {
            let [x, y, w] = raw;
            Exact::snap(&ClipVertex { raw: [x, y, 0, w], shift: 0 }, 1, viewport)
        };
        let [small, large] = [16, 512].map(|side| Viewport::new(side, side).unwrap());
        let v = [[-9, -9, 10], [9, -8, 10], [0, 9, 10]];
        let at = |viewport: &Viewport| v.map(|v| snapped(v, viewport));
        for (from, to) in [(&small, &large), (&large, &small), (&large, &large)] {
            let [p, q, r] = &at(from);
            let has = outline([p, q, r], Facing::Front, to).is_some();
            assert_eq!(has, from == to);
        }
    }
}
