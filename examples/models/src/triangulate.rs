//! Polygons to triangles, in exact integers.
//!
//! Corners are on the grid they are stored in, so what is decided is right for what is drawn. A polygon is looked at along the
//! axis that its plane faces most: an affine picture of its own plane, in which what is convex stays so. Corners without turn,
//! which are common where neighbours are finer, stay corners: no neighbour's vertex is left on an edge.
//!
//! A strictly convex polygon is a fan. Of any other, ears are cut (Meisters 1975, "Polygons have ears"), and only the two neighbours
//! of one are looked at again (O'Rourke 1998, "Computational Geometry in C", section 1.4): `O(n r)` for `n` corners of which `r`
//! turn outwards or not at all. A polygon that crosses itself may run out of ears: then any corner is cut. Whatever the polygon,
//! `n` corners give `n - 2` triangles; their directed edges add up to its outline, and so their areas to its area.

use std::collections::VecDeque;

/// The triangles of a polygon, as places in `corners`, each wound as the polygon is.
///
/// Consecutive corners at one position count as one. What has fewer than three is no triangle. A triangle without area comes out
/// only of a polygon that crosses or touches itself, or that has no area itself.
#[must_use]
pub fn triangulate(corners: &[[i16; 3]]) -> Vec<[usize; 3]> {
    let mut ring: Vec<usize> = Vec::with_capacity(corners.len());
    for (place, corner) in corners.iter().enumerate() {
        if ring.last().is_none_or(|&last| corners[last] != *corner) {
            ring.push(place);
        }
    }
    while ring.len() > 1 && corners[ring[0]] == corners[ring[ring.len() - 1]] {
        ring.pop();
    }
    if ring.len() < 3 {
        return Vec::new();
    }
    let points =
        flatten(&ring.iter().map(|&place| corners[place].map(i64::from)).collect::<Vec<_>>());
    let triangles = if is_strictly_convex(&points) {
        (2..points.len()).map(|i| [0, i - 1, i]).collect()
    } else {
        Ears::new(&points).cut()
    };
    triangles.into_iter().map(|triangle| triangle.map(|corner| ring[corner])).collect()
}

type Point = [i64; 2];

/// Twice the area of a triangle, positive where it is counter-clockwise. Coordinates take 17 bits at most, so this takes 36.
fn doubled_area([ax, ay]: Point, [bx, by]: Point, [cx, cy]: Point) -> i64 {
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

/// The polygon along the axis that it faces most, counter-clockwise.
fn flatten(corners: &[[i64; 3]]) -> Vec<Point> {
    let [x, y, z] = area(corners).map(i64::abs);
    // One whose areas cancel, or that has none, is looked at where its triangles are largest.
    let [x, y, z] = if [x, y, z] == [0; 3] { spread(corners) } else { [x, y, z] };
    let (u, v) = if z >= x && z >= y {
        (0, 1)
    } else if x >= y {
        (1, 2)
    } else {
        (2, 0)
    };
    let points: Vec<Point> = corners.iter().map(|corner| [corner[u], corner[v]]).collect();
    let first = points[0];
    let turn: i64 = points.windows(2).map(|edge| doubled_area(first, edge[0], edge[1])).sum();
    if turn < 0 { points.into_iter().map(|[u, v]| [-u, v]).collect() } else { points }
}

/// Twice the polygon's area along each axis: 36 bits a triangle, and a sum of up to 2^26 of them fits.
fn area(corners: &[[i64; 3]]) -> [i64; 3] {
    fan(corners).fold([0; 3], |sum, area| [0, 1, 2].map(|i| sum[i] + area[i]))
}

/// The same of its triangles without their signs.
fn spread(corners: &[[i64; 3]]) -> [i64; 3] {
    fan(corners).fold([0; 3], |sum, area| [0, 1, 2].map(|i| sum[i] + area[i].abs()))
}

fn fan(corners: &[[i64; 3]]) -> impl Iterator<Item = [i64; 3]> {
    let first = corners[0];
    corners.windows(2).map(move |edge| {
        let [a, b] = [0, 1].map(|end| [0, 1, 2].map(|i| edge[end][i] - first[i]));
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    })
}

/// Whether every corner turns left. A star that winds round more than once does so too; it crosses itself, and a fan serves it
/// as well as anything.
fn is_strictly_convex(points: &[Point]) -> bool {
    let count = points.len();
    let at = |i: usize| points[i % count];
    (0..count).all(|i| doubled_area(at(i), at(i + 1), at(i + 2)) > 0)
}

/// A polygon whose ears are being cut: corners in a ring.
struct Ears<'a> {
    points: &'a [Point],
    next: Vec<usize>,
    previous: Vec<usize>,
    cut: Vec<bool>,
    /// Corners that turned right or not at all at the beginning; those cut are taken out now and then.
    blunt: Vec<usize>,
    left: usize,
    /// Points that may still be looked at: more than a polygon takes that does not cross itself. Then any corner is an ear.
    looks: u64,
}

/// Which points keep a corner from being an ear.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Blocked {
    /// Those in the triangle or on its edges.
    Closed,
    /// Those inside of it.
    Open,
}

impl<'a> Ears<'a> {
    fn new(points: &'a [Point]) -> Self {
        let count = points.len();
        let next: Vec<usize> = (0..count).map(|i| (i + 1) % count).collect();
        let previous: Vec<usize> = (0..count).map(|i| (i + count - 1) % count).collect();
        let blunt = |&i: &usize| doubled_area(points[previous[i]], points[i], points[next[i]]) <= 0;
        let blunt = (0..count).filter(blunt).collect();
        let looks = 2 * (count as u64).pow(2);
        Self { points, next, previous, cut: vec![false; count], blunt, left: count, looks }
    }

    fn cut(mut self) -> Vec<[usize; 3]> {
        let count = self.points.len();
        let mut triangles = Vec::with_capacity(count - 2);
        // Every other corner first: triangles are less thin so.
        let mut candidates: VecDeque<usize> =
            (0..count).step_by(2).chain((1..count).step_by(2)).collect();
        let mut somewhere = 0;
        while self.left > 3 {
            let corner = match candidates.pop_front() {
                Some(corner) if self.cut[corner] || !self.is_ear(corner, Blocked::Closed) => {
                    continue;
                }
                Some(corner) => corner,
                None => self.least_bad(somewhere),
            };
            let (before, after) = (self.previous[corner], self.next[corner]);
            triangles.push([before, corner, after]);
            (self.next[before], self.previous[after]) = (after, before);
            self.cut[corner] = true;
            self.left -= 1;
            somewhere = after;
            candidates.extend([before, after]);
        }
        triangles.push([self.previous[somewhere], somewhere, self.next[somewhere]]);
        triangles
    }

    /// Whether a corner turns left and nothing that is left of the polygon is in its triangle.
    fn is_ear(&mut self, corner: usize, blocked: Blocked) -> bool {
        let around = [self.previous[corner], corner, self.next[corner]];
        let [a, b, c] = around.map(|i| self.points[i]);
        if doubled_area(a, b, c) <= 0 {
            return false;
        }
        if self.blunt.len() > 2 * self.left {
            let cut = &self.cut;
            self.blunt.retain(|&i| !cut[i]);
        }
        let least = if blocked == Blocked::Closed { 0 } else { 1 };
        for &other in &self.blunt {
            if self.looks == 0 {
                return true;
            }
            self.looks -= 1;
            let p = self.points[other];
            // The two sides of a slit share positions: those are no obstacle.
            let elsewhere = !self.cut[other] && p != a && p != b && p != c;
            let inside = || {
                [(a, b), (b, c), (c, a)]
                    .iter()
                    .all(|&(from, to)| doubled_area(from, to, p) >= least)
            };
            if elsewhere && inside() {
                return false;
            }
        }
        true
    }

    /// A corner to cut where there is no ear: one with a point on its edges only, else one that turns left, else any.
    fn least_bad(&mut self, start: usize) -> usize {
        let mut left_turn = None;
        let mut corner = start;
        for _ in 0..self.left {
            let [a, b, c] =
                [self.previous[corner], corner, self.next[corner]].map(|i| self.points[i]);
            if doubled_area(a, b, c) > 0 {
                left_turn = left_turn.or(Some(corner));
                if self.is_ear(corner, Blocked::Open) {
                    return corner;
                }
            }
            corner = self.next[corner];
        }
        left_turn.unwrap_or(start)
    }
}

#[cfg(test)]
mod tests;
