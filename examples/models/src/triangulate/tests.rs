use super::*;
use std::collections::HashMap;

/// A linear congruential generator's upper bits.
struct Random(u64);

impl Random {
    fn below(&mut self, count: i64) -> i64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((u128::from(self.0 >> 11) * count as u128) >> 53) as i64
    }
}

/// Vector area of triangles or polygons, doubled.
fn vector_area(corners: &[[i16; 3]]) -> [i64; 3] {
    area(&corners.iter().map(|corner| corner.map(i64::from)).collect::<Vec<_>>())
}

/// Directed edges between positions, each against its reverse; those that do not cancel.
fn outline<'a>(polygons: impl Iterator<Item = &'a [[i16; 3]]>) -> HashMap<[[i16; 3]; 2], i64> {
    let mut edges = HashMap::new();
    for polygon in polygons {
        for (i, &from) in polygon.iter().enumerate() {
            let to = polygon[(i + 1) % polygon.len()];
            let (edge, sign) = if from < to { ([from, to], 1) } else { ([to, from], -1) };
            *edges.entry(edge).or_default() += if from == to { 0 } else { sign };
        }
    }
    edges.retain(|_, sum| *sum != 0);
    edges
}

/// What holds for any polygon; returns its triangles.
fn check(corners: &[[i16; 3]], what: &str) -> Vec<[[i16; 3]; 3]> {
    let places = triangulate(corners);
    let triangles: Vec<[[i16; 3]; 3]> =
        places.iter().map(|triangle| triangle.map(|i| corners[i])).collect();
    assert_eq!(
        outline(triangles.iter().map(|t| &t[..])),
        outline([corners].into_iter()),
        "{what}: {corners:?}"
    );
    let sum = triangles.iter().fold([0; 3], |sum, triangle| {
        let area = vector_area(triangle);
        [0, 1, 2].map(|i| sum[i] + area[i])
    });
    assert_eq!(sum, vector_area(corners), "{what}: {corners:?}");
    triangles
}

/// For a polygon that does not touch itself: as many triangles as it takes, all with area and turned as it is. With the
/// outline of `check`, their indicators add up to the polygon's: they cover it once and nothing else.
fn check_simple(corners: &[[i16; 3]], what: &str) {
    let triangles = check(corners, what);
    assert_eq!(triangles.len(), corners.len() - 2, "{what}: {corners:?}");
    let whole = vector_area(corners);
    for triangle in &triangles {
        let area = vector_area(triangle);
        let same_way: i128 = (0..3).map(|i| i128::from(area[i]) * i128::from(whole[i])).sum();
        assert!(same_way > 0, "{what}: {triangle:?} of {corners:?}");
    }
}

/// Whether two edges share a point: exactly.
fn touch([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let side = |a, b, p| doubled_area(a, b, p).signum();
    let on = |a: Point, b: Point, p: Point| {
        side(a, b, p) == 0 && (0..2).all(|i| p[i] >= a[i].min(b[i]) && p[i] <= a[i].max(b[i]))
    };
    (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0)
        || on(a, b, c)
        || on(a, b, d)
        || on(c, d, a)
        || on(c, d, b)
}

fn is_simple(points: &[Point]) -> bool {
    let count = points.len();
    let edge = |i: usize| [points[i % count], points[(i + 1) % count]];
    (0..count).all(|i| {
        let neighbours = {
            let ([a, b], [_, c]) = (edge(i), edge(i + 1));
            // Not folded back on itself.
            doubled_area(a, b, c) != 0
                || (0..2).map(|k| (a[k] - b[k]) * (c[k] - b[k])).sum::<i64>() < 0
        };
        neighbours
            && (i + 2..count).filter(|j| (j + 1) % count != i).all(|j| !touch(edge(i), edge(j)))
    })
}

/// A random polygon that does not touch itself, on a grid of `side`: points in a random order, and crossings undone by
/// turning what is between them round, which makes the outline shorter, until there are none.
fn simple(random: &mut Random, count: usize, side: i64) -> Option<Vec<Point>> {
    let mut points: Vec<Point> = Vec::new();
    while points.len() < count {
        let point = [random.below(side), random.below(side)];
        if !points.contains(&point) {
            points.push(point);
        }
    }
    for _ in 0..20 * count {
        let edge = |i: usize| [points[i], points[(i + 1) % count]];
        let crossing = (0..count)
            .flat_map(|i| (i + 2..count).map(move |j| (i, j)))
            .find(|&(i, j)| (j + 1) % count != i && touch(edge(i), edge(j)));
        match crossing {
            Some((i, j)) => points[i + 1..=j].reverse(),
            None => break,
        }
    }
    is_simple(&points).then_some(points)
}

/// A plane picture in space, each unit a random whole vector; turned over as often as not.
fn in_space(random: &mut Random, points: &[Point], largest: i64) -> Vec<[i16; 3]> {
    loop {
        let mut vector = |most: i64| [(); 3].map(|()| random.below(2 * most + 1) - most);
        let (u, v, origin) = (vector(largest), vector(largest), vector(1000));
        let place = |[x, y]: &Point| [0, 1, 2].map(|i| (origin[i] + x * u[i] + y * v[i]) as i16);
        let corners: Vec<[i16; 3]> = points.iter().map(place).collect();
        if vector_area(&corners) != [0; 3] {
            return corners;
        }
    }
}

#[test]
fn random_simple_polygons_are_covered_once() {
    let mut checked = 0;
    for seed in 0..4000 {
        let mut random = Random(seed);
        let count = 3 + random.below(22) as usize;
        // On a small grid many corners do not turn.
        let side = 6 + random.below(if seed % 2 == 0 { 3 } else { 60 });
        if let Some(points) = simple(&mut random, count, side) {
            let most = if seed % 3 == 0 { 1 } else { 200 };
            check_simple(&in_space(&mut random, &points, most), &format!("seed {seed}"));
            checked += 1;
        }
    }
    assert!(checked > 2000, "{checked}");
}

#[test]
fn polygons_at_the_ends_of_the_grid_are_covered_once() {
    let (low, high) = (i16::MIN, i16::MAX);
    let square = [[low, low], [high, low], [high, high], [low, high]];
    let notched = [[low, low], [high, low], [0, 0], [high, high], [low, high]];
    for polygon in [&square[..], &notched] {
        for axis in 0..3 {
            let place = |&[u, v]: &[i16; 2]| {
                let mut corner = [7; 3];
                (corner[axis], corner[(axis + 1) % 3]) = (u, v);
                corner
            };
            let mut corners: Vec<[i16; 3]> = polygon.iter().map(place).collect();
            check_simple(&corners, "a side of the grid");
            corners.reverse();
            check_simple(&corners, "its back");
        }
    }
}

#[test]
fn corners_without_turn_stay_corners() {
    // A triangle with points on all sides, and one with many on one.
    let sides = [[0, 0], [4, 0], [8, 0], [4, 4], [0, 8], [0, 4]];
    let one = [[0, 0], [1, 0], [2, 0], [3, 0], [4, 0], [5, 0], [0, 9]];
    for polygon in [&sides[..], &one] {
        for first in 0..polygon.len() {
            let mut corners: Vec<[i16; 3]> = polygon.iter().map(|&[x, y]| [x, y, 5]).collect();
            corners.rotate_left(first);
            check_simple(&corners, "on a line");
        }
    }
}

#[test]
fn a_slit_to_a_hole_is_no_obstacle() {
    // A square with a square hole, joined by an edge that is there twice.
    let outline = [[0, 0], [12, 0], [12, 12], [0, 12]];
    let hole = [[4, 4], [4, 8], [8, 8], [8, 4]];
    for (corner, first) in (0..4).flat_map(|corner| (0..4).map(move |first| (corner, first))) {
        let mut polygon: Vec<[i16; 2]> = (0..=4).map(|i| outline[(corner + i) % 4]).collect();
        polygon.extend((0..=4).map(|i| hole[(first + i) % 4]));
        let from = outline[corner].map(i64::from);
        let to = hole[first].map(i64::from);
        let crosses = (0..4).any(|i| {
            let edge = [hole[i], hole[(i + 1) % 4]].map(|p| p.map(i64::from));
            !edge.contains(&to) && touch(edge, [from, to])
        });
        if crosses {
            continue;
        }
        let corners: Vec<[i16; 3]> = polygon.iter().map(|&[x, y]| [x, 3, y]).collect();
        let triangles = check(&corners, "a hole");
        let whole = vector_area(&corners)[1];
        assert!(
            triangles.iter().all(|triangle| vector_area(triangle)[1].signum() == whole.signum()),
            "{corners:?}"
        );
        assert_eq!(triangles.len(), 8);
    }
}

#[test]
fn convex_polygons_are_fans() {
    let fan = |count: usize| {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / count as f64;
        let corners: Vec<[i16; 3]> = (0..count)
            .map(|i| [(30000.0 * angle(i).cos()) as i16, (30000.0 * angle(i).sin()) as i16, 0])
            .collect();
        check_simple(&corners, "a ring");
        triangulate(&corners)
    };
    for count in [3, 4, 5, 8, 64, 300] {
        let expected: Vec<[usize; 3]> = (2..count).map(|i| [0, i - 1, i]).collect();
        assert_eq!(fan(count), expected);
    }
    let star = [0, 2, 4, 1, 3].map(|i| {
        let angle = std::f64::consts::TAU * f64::from(i) / 5.0;
        [(1000.0 * angle.cos()) as i16, (1000.0 * angle.sin()) as i16, 0]
    });
    assert_eq!(check(&star, "a pentagram").len(), 3);
}

#[test]
fn any_corners_at_all_keep_outline_and_area() {
    assert!(triangulate(&[]).is_empty());
    for seed in 0..20_000 {
        let mut random = Random(seed);
        let count = 1 + random.below(24) as usize;
        let side = 1 + random.below(if seed % 4 == 0 { 65536 } else { 4 });
        let flat = 1 + random.below(3) as usize;
        let corners: Vec<[i16; 3]> = (0..count)
            .map(|_| {
                let corner = [(); 3].map(|()| (random.below(side) - side / 2) as i16);
                // In space, in a plane or on a line.
                [0, 1, 2].map(|i| if i < flat { corner[i] } else { 0 })
            })
            .collect();
        check(&corners, &format!("seed {seed}"));
    }
}

#[test]
fn large_polygons_end() {
    // A comb, whose every other corner turns right; a ring; a line there and back; a scribble.
    let comb: Vec<[i16; 3]> = (0..3000)
        .map(|i| [i, if i % 2 == 0 { 1000 } else { 10 + i % 7 }, 0])
        .chain([[3000, 0, 0], [-1, 0, 0]])
        .collect();
    check_simple(&comb, "a comb");
    let line: Vec<[i16; 3]> = (0..2000).chain((0..2000).rev()).map(|i| [i, i, i]).collect();
    check(&line, "a line");
    let mut random = Random(1);
    let scribble: Vec<[i16; 3]> =
        (0..1000).map(|_| [(); 3].map(|()| random.below(65536) as u16 as i16)).collect();
    check(&scribble, "a scribble");
}
