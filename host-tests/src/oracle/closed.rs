//! Closed meshes round, beside and before the eye.
//!
//! Clip space without its z is the eye's own space: the eye is at `x = y = w = 0` and looks along
//! `w`. So a solid is put there directly, turned at random, and rounded to the grid. Every mesh
//! here must meet `Invariant::Closed`.

use std::f64::consts::TAU;

use super::Rng;
use super::mesh::{Invariant, Mesh};

/// A closed surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solid {
    /// 4 triangles.
    Tetrahedron,
    /// 12 triangles.
    Cube,
    /// 32 to 512 triangles: an octahedron divided one to three times, each vertex at a random
    /// distance from the middle.
    Star,
    /// 96 to 600 triangles round a hole.
    Torus,
}

impl Solid {
    /// Every solid.
    pub const ALL: [Self; 4] = [Self::Tetrahedron, Self::Cube, Self::Star, Self::Torus];
}

/// Where the eye is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Eye {
    /// Outside, the whole solid in front of it.
    Outside,
    /// Outside, the solid beside it and on both sides of the eye plane; also in the hole of a
    /// torus.
    Beside,
    /// Inside.
    Inside,
}

impl Eye {
    /// Every place.
    pub const ALL: [Self; 3] = [Self::Outside, Self::Beside, Self::Inside];
}

type Point = [f64; 3];

/// A solid within the unit sphere round the origin, faces counter-clockwise from outside in
/// right-handed axes.
struct Model {
    points: Vec<Point>,
    faces: Vec<[usize; 3]>,
    /// A point at least 0.1 away from the surface, inside.
    inside: Point,
}

/// A closed mesh in clip space: a random `solid` as seen by `eye`.
pub fn closed(solid: Solid, eye: Eye, rng: &mut Rng) -> Mesh {
    let model = match solid {
        Solid::Tetrahedron => tetrahedron(),
        Solid::Cube => cube(),
        Solid::Star => star(rng),
        Solid::Torus => torus(rng),
    };
    let in_hole = solid == Solid::Torus && eye == Eye::Beside && rng.once_in(2);
    let nearby = [(); 3].map(|()| rng.between(-0.04, 0.04));
    let turn = rotation(rng);
    let offset = match eye {
        Eye::Inside => [0, 1, 2].map(|i| nearby[i] - apply(&turn, model.inside)[i]),
        Eye::Beside if in_hole => nearby,
        Eye::Beside => {
            // So far ahead that the solid still reaches behind the eye plane, and so far away that
            // the eye is outside.
            let behind = |point: &Point| -apply(&turn, *point)[2];
            let ahead = rng.between(0.0, 0.9) * model.points.iter().map(behind).fold(0.0, f64::max);
            let distance = rng.between(1.1, 1.35);
            let sideways = (distance * distance - ahead * ahead).sqrt();
            let (up, right) = rng.between(0.0, TAU).sin_cos();
            [sideways * right, sideways * up, ahead]
        }
        Eye::Outside => {
            let ahead = rng.between(1.5, 4.0);
            [rng.between(-0.5, 0.5) * ahead, rng.between(-0.5, 0.5) * ahead, ahead]
        }
    };
    // Past 2^17 a corner (at most 5 units away, times the focal length) could leave the grid of
    // 2^20; below 2^8 the rounding would no longer be small beside the 0.03 units that the eye is
    // clear of the surface.
    let size = rng.magnitude(1 << 17).max(1 << 8) as f64;
    let focal = rng.between(0.6, 1.5);
    let stretch = [size * focal, size * focal, size];
    let place = |point: &Point| {
        let turned = apply(&turn, *point);
        [0, 1, 2].map(|i| (stretch[i] * (turned[i] + offset[i])).round() as i64)
    };
    let directions: Vec<_> = model.points.iter().map(place).collect();
    // With w away from the viewer, x, y, w are left-handed: what is counter-clockwise there is
    // clockwise in NDC.
    let triangles = model.faces.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let invariant = Invariant::Closed { eye_inside: eye == Eye::Inside };
    Mesh::from_directions(&directions, triangles, invariant, rng)
}

fn tetrahedron() -> Model {
    let third = 3_f64.sqrt().recip();
    Model {
        points: [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]
            .map(|corner: [i32; 3]| corner.map(|value| f64::from(value) * third))
            .to_vec(),
        faces: vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]],
        inside: [0.0; 3],
    }
}

fn cube() -> Model {
    let half = 3_f64.sqrt().recip();
    let side = |corner: usize, axis: usize| if corner >> axis & 1 == 1 { half } else { -half };
    let mut faces = Vec::new();
    for axis in 0..3 {
        let (next, last) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        let far = 1 << axis;
        // Corners of the face at +axis, counter-clockwise from outside; the other one the other
        // way.
        let ring = [far, far + next, far + next + last, far + last];
        faces.extend([[ring[0], ring[1], ring[2]], [ring[0], ring[2], ring[3]]]);
        let ring = ring.map(|corner| corner - far);
        faces.extend([[ring[0], ring[2], ring[1]], [ring[0], ring[3], ring[2]]]);
    }
    Model {
        points: (0..8).map(|corner| [0, 1, 2].map(|axis| side(corner, axis))).collect(),
        faces,
        inside: [0.0; 3],
    }
}

fn star(rng: &mut Rng) -> Model {
    let mut points: Vec<Point> = vec![
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    let mut faces = Vec::new();
    for quarter in 0..4 {
        let next = (quarter + 1) % 4;
        faces.extend([[quarter, next, 4], [next, quarter, 5]]);
    }
    for _ in 0..rng.range(1, 3) {
        faces = divide(&mut points, &faces);
    }
    for point in &mut points {
        let radius = rng.between(0.7, 1.0);
        *point = point.map(|value| value * radius);
    }
    Model { points, faces, inside: [0.0; 3] }
}

/// Each triangle in four, the new points on the unit sphere and shared between neighbours.
fn divide(points: &mut Vec<Point>, faces: &[[usize; 3]]) -> Vec<[usize; 3]> {
    let mut middles = std::collections::HashMap::new();
    let mut middle = |a: usize, b: usize| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let sum = [0, 1, 2].map(|i| points[a][i] + points[b][i]);
            let length = sum.iter().map(|value| value * value).sum::<f64>().sqrt();
            points.push(sum.map(|value| value / length));
            points.len() - 1
        })
    };
    let mut divided = Vec::new();
    for &[a, b, c] in faces {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        divided.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    divided
}

fn torus(rng: &mut Rng) -> Model {
    let (around, across) = (rng.range(8, 25) as usize, rng.range(6, 12) as usize);
    let mut points = Vec::new();
    let mut faces = Vec::new();
    for i in 0..around {
        for j in 0..across {
            let (sine, cosine) = (TAU * i as f64 / around as f64).sin_cos();
            let (up, out) = (TAU * j as f64 / across as f64).sin_cos();
            let radius = 0.7 + 0.3 * out;
            points.push([radius * cosine, radius * sine, 0.3 * up]);
            let at = |i: usize, j: usize| i % around * across + j % across;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    Model { points, faces, inside: [0.7, 0.0, 0.0] }
}

/// A random rotation: three products of plane turns.
fn rotation(rng: &mut Rng) -> [Point; 3] {
    let mut rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for (i, j) in [(0, 1), (1, 2), (0, 1)] {
        let (sine, cosine) = rng.between(0.0, TAU).sin_cos();
        let (first, second): (Point, Point) = (rows[i], rows[j]);
        rows[i] = [0, 1, 2].map(|k| cosine * first[k] - sine * second[k]);
        rows[j] = [0, 1, 2].map(|k| sine * first[k] + cosine * second[k]);
    }
    rows
}

fn apply(rows: &[Point; 3], point: Point) -> Point {
    rows.map(|row| row[0] * point[0] + row[1] * point[1] + row[2] * point[2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::generate::GRID;
    use crate::oracle::linear::{cross, dot};
    use crate::oracle::mesh::tests::snapped_triangles;
    use crate::oracle::{ExactTriangle, Part, Vertex, Viewport};

    /// How often a mesh winds round the eye: the solid angles of its triangles (van Oosterom &
    /// Strackee 1983, eq. 8) over a full sphere, positive where they are counter-clockwise in NDC.
    fn winding(mesh: &Mesh) -> f64 {
        let solid_angle = |corners: [Vertex; 3]| {
            let [a, b, c] = corners.map(|corner| {
                let [x, y, w] = corner.map(|value| value as f64);
                let length = (x * x + y * y + w * w).sqrt();
                [x / length, y / length, w / length]
            });
            let triple = dot(&cross(&a, &b), &c);
            2.0 * triple.atan2(1.0 + dot(&a, &b) + dot(&b, &c) + dot(&c, &a))
        };
        mesh.all_corners().map(solid_angle).sum::<f64>() / (2.0 * TAU)
    }

    fn every_mesh(seeds: std::ops::Range<u64>, mut check: impl FnMut(&Mesh, Eye, &str)) {
        for seed in seeds {
            let mut rng = Rng::new(seed);
            for solid in Solid::ALL {
                for eye in Eye::ALL {
                    let mesh = closed(solid, eye, &mut rng);
                    check(&mesh, eye, &format!("seed {seed} {solid:?} {eye:?}"));
                }
            }
        }
    }

    #[test]
    fn every_edge_has_two_faces_that_run_along_it_in_both_directions() {
        every_mesh(0..6, |mesh, _, what| {
            let mut edges = std::collections::HashMap::new();
            for &[a, b, c] in &mesh.triangles {
                for edge in [(a, b), (b, c), (c, a)] {
                    assert!(edges.insert(edge, ()).is_none(), "{what}: edge {edge:?} twice");
                }
            }
            assert!(edges.keys().all(|&(a, b)| edges.contains_key(&(b, a))), "{what}");
        });
    }

    #[test]
    fn the_eye_is_where_it_is_said_to_be() {
        every_mesh(0..60, |mesh, eye, what| {
            assert!(mesh.vertices.iter().flatten().all(|value| value.abs() <= GRID), "{what}");
            let expected = f64::from(mesh.expected_sum());
            assert!((winding(mesh) - expected).abs() < 1e-6, "{what}: {}", winding(mesh));
            let behind = mesh.vertices.iter().filter(|vertex| vertex[3] < 0).count();
            match eye {
                Eye::Outside => assert_eq!(behind, 0, "{what}"),
                Eye::Beside | Eye::Inside => {
                    assert!(behind > 0 && behind < mesh.vertices.len(), "{what}");
                }
            }
        });
    }

    #[test]
    fn closed_meshes_cover_every_pixel_evenly() {
        let viewport = Viewport::new(23, 17);
        let mut covered = 0;
        every_mesh(0..4, |mesh, eye, what| {
            for part in Part::ALL {
                let prepare = |corners| ExactTriangle::new(corners, viewport, part);
                let prepared: Vec<_> = mesh.all_corners().map(prepare).collect();
                let counted = check_evenness(mesh, &prepared, viewport, what);
                covered += if eye == Eye::Inside { 0 } else { counted };
            }
        });
        assert!(covered > 1500, "{covered}");
    }

    #[test]
    fn a_snap_keeps_closed_meshes_closed() {
        for viewport in [Viewport::new(16, 9), Viewport::new(512, 3), Viewport::new(4, 4)] {
            every_mesh(10..16, |mesh, _, what| {
                for part in Part::ALL {
                    let prepared = snapped_triangles(mesh, viewport, part);
                    check_evenness(mesh, &prepared, viewport, what);
                }
            });
        }
    }

    /// Checks the invariant; returns how many pixels are covered.
    fn check_evenness(
        mesh: &Mesh,
        prepared: &[ExactTriangle],
        viewport: Viewport,
        what: &str,
    ) -> usize {
        let mut covered = 0;
        for (x, y) in viewport.pixels() {
            let count = prepared.iter().filter(|one| one.covers(x, y)).count();
            let sum: i32 = prepared.iter().map(|one| one.signed_coverage(x, y)).sum();
            assert_eq!(sum, mesh.expected_sum(), "{what} {viewport:?} {x} {y}");
            assert_eq!(count & 1, sum.unsigned_abs() as usize, "{what} {viewport:?} {x} {y}");
            covered += usize::from(count > 0);
        }
        covered
    }
}
