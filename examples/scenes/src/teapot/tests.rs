extern crate std;

use std::collections::{HashMap, HashSet};
use std::vec::Vec;

use super::tessellate::{cross, surface};
use super::*;

fn position(vertex: u16) -> [f64; 3] {
    POSITIONS[vertex as usize].map(|c| f64::from(c) / f64::from(1 << FRACTION_BITS))
}

fn normal(vertex: u16) -> [f64; 3] {
    NORMALS[vertex as usize].map(|c| f64::from(c) / f64::from(NORMAL_ONE))
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Twice the area of a triangle, along its face normal, in model units.
fn face([a, b, c]: [u16; 3]) -> [f64; 3] {
    let a = position(a);
    cross(sub(position(b), a), sub(position(c), a))
}

/// Edges that have one triangle only; fails on an edge that two triangles go along in the same direction.
fn open_edges() -> Vec<(u16, u16)> {
    let mut edges = HashSet::new();
    for &[a, b, c] in &TRIANGLES {
        for edge in [(a, b), (b, c), (c, a)] {
            assert!(edges.insert(edge), "{edge:?} twice in one direction");
        }
    }
    edges.iter().copied().filter(|&(from, to)| !edges.contains(&(to, from))).collect()
}

#[test]
fn counts() {
    assert_eq!(TRIANGLE_COUNT, 992);
    assert_eq!(VERTEX_COUNT, 530);
}

#[test]
fn indices_are_in_range_and_every_vertex_is_used() {
    let used: HashSet<u16> = TRIANGLES.iter().flatten().copied().collect();
    assert!(used.iter().all(|&v| usize::from(v) < VERTEX_COUNT));
    assert_eq!(used.len(), VERTEX_COUNT);
}

#[test]
fn no_triangle_is_degenerate() {
    let smallest =
        TRIANGLES.iter().map(|&t| dot(face(t), face(t)).sqrt() / 2.0).fold(f64::INFINITY, f64::min);
    // In square model units; the smallest are on the lip of the spout.
    assert!(smallest > 2.8e-4, "{smallest}");
}

#[test]
fn each_directed_edge_occurs_once_and_only_the_rims_are_open() {
    let open = open_edges();
    // Rim and lid have 16 edges each, both ends of handle and spout 8 each.
    assert_eq!(open.len(), 16 + 16 + 2 * 8 + 2 * 8);
    // Each rim is a closed line: at every vertex as many edges arrive as leave.
    let mut balance: HashMap<u16, i32> = HashMap::new();
    for (from, to) in open {
        *balance.entry(from).or_default() += 1;
        *balance.entry(to).or_default() -= 1;
    }
    assert!(balance.values().all(|&b| b == 0));
}

#[test]
fn no_position_has_two_vertices_but_where_the_handle_touches_the_body() {
    let mut seen = HashSet::new();
    let again: Vec<_> = POSITIONS.iter().filter(|&p| !seen.insert(p)).collect();
    // Newell's point (-2, 0, 0.9).
    assert_eq!(again, [&[-4096, -1382, 0]]);
}

#[test]
fn normals_are_of_unit_length() {
    // Each component is rounded by at most half a step: sqrt(3) / 2 steps together.
    let bound = 0.75_f64.sqrt() / f64::from(NORMAL_ONE);
    for vertex in 0..VERTEX_COUNT as u16 {
        let length = dot(normal(vertex), normal(vertex)).sqrt();
        assert!((length - 1.0).abs() <= bound, "vertex {vertex}: {length}");
    }
}

#[test]
fn normals_agree_with_faces_but_on_the_lip_of_the_spout() {
    let mut exceptions = 0;
    for &triangle in &TRIANGLES {
        let across = face(triangle);
        let cosines = triangle.map(|v| dot(normal(v), across) / dot(across, across).sqrt());
        if cosines.iter().any(|&c| c < 0.3) {
            // The lip curls inwards in less than a segment, so that a face there is far from the surface.
            exceptions += 1;
            assert!(cosines.iter().all(|&c| c > -0.37), "{cosines:?}");
            let is_lip = |p: [f64; 3]| p[0] > 1.65 && p[1] > 0.43;
            assert!(triangle.map(position).into_iter().all(is_lip));
        }
    }
    assert_eq!(exceptions, 4);
}

#[test]
fn poles_point_up_and_down() {
    let at = |wanted: [i16; 3]| {
        let found: Vec<_> = (0..VERTEX_COUNT).filter(|&v| POSITIONS[v] == wanted).collect();
        assert_eq!(found.len(), 1, "{wanted:?}");
        NORMALS[found[0]]
    };
    assert_eq!(at([0, BOUNDS[1][1], 0]), [0, NORMAL_ONE, 0]);
    assert_eq!(at([0, BOUNDS[0][1], 0]), [0, -NORMAL_ONE, 0]);
}

#[test]
fn bounding_box() {
    let [low, high] = BOUNDS.map(|corner| corner.map(|c| f64::from(c) / 4096.0));
    let near = |value: f64, wanted: f64| assert!((value - wanted).abs() <= 0.5 / 4096.0, "{value}");
    // The handle to the left, the spout to the right, the body's radius, half the height.
    near(low[0], -1.5);
    near(high[0], 1.714_062_5);
    near(high[1], 0.7875);
    near(low[1], -0.7875);
    near(high[2], 1.0);
    near(low[2], -1.0);
}

/// A point of a patch by de Casteljau's construction, which shares nothing with [`surface`] but the data.
fn de_casteljau(patch: usize, row: f64, column: f64) -> [f64; 3] {
    fn along(mut points: [[f64; 3]; 4], t: f64) -> [f64; 3] {
        for count in (1..4).rev() {
            for i in 0..count {
                let next = points[i + 1];
                for (c, n) in points[i].iter_mut().zip(next) {
                    *c += (n - *c) * t;
                }
            }
        }
        points[0]
    }
    let patch = &patches::PATCHES[patch];
    let rows = [0, 1, 2, 3].map(|r| {
        let points = [0, 1, 2, 3].map(|c| patches::POINTS[usize::from(patch[4 * r + c])]);
        along(points, column)
    });
    let [x, y, z] = along(rows, row);
    [x / 2.0, z / 2.0 - 0.7875, -y / 2.0]
}

#[test]
fn positions_are_on_the_patches() {
    let all: HashSet<[i16; 3]> = POSITIONS.iter().copied().collect();
    let mut found: HashSet<[i16; 3]> = HashSet::new();
    for patch in 0..patches::PATCH_COUNT {
        for step in 0..25 {
            let (row, column) = (f64::from(step / 5) / 4.0, f64::from(step % 5) / 4.0);
            let exact = de_casteljau(patch, row, column).map(|c| c * 4096.0);
            let here = all.iter().find(|p| {
                p.iter().zip(exact).all(|(&p, e)| (f64::from(p) - e).abs() <= 0.5 + 1e-9)
            });
            assert!(here.is_some(), "patch {patch} at {row} {column}: {exact:?}");
            found.extend(here.copied());
        }
    }
    assert_eq!(found.len(), all.len(), "positions that no patch has");
}

#[test]
fn normals_are_those_of_the_patches() {
    // By central differences, away from the poles, in the middle of each quarter of a patch.
    for patch in 0..patches::PATCH_COUNT {
        for (row, column) in [(0.25, 0.25), (0.25, 0.75), (0.75, 0.25), (0.75, 0.75)] {
            let h = 1e-5;
            let point = |r: f64, c: f64| de_casteljau(patch, r, c);
            let rows = sub(point(row + h, column), point(row - h, column));
            let columns = sub(point(row, column + h), point(row, column - h));
            let numeric = cross(columns, rows);
            let (_, normal) = surface(patch, row, column);
            let cosine =
                dot(numeric, normal) / (dot(numeric, numeric) * dot(normal, normal)).sqrt();
            assert!(cosine > 1.0 - 1e-8, "patch {patch}: {cosine}");
        }
    }
}
