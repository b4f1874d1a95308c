//! What a planner is told of a model: see [`hither::Scene`].

use crate::weld::{ModelVertex, scale};

/// Bounds of a model in its own units, as it is stored; none is less than the true one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The largest magnitude of a coordinate: [`hither::Scene::extent`].
    pub extent: f32,
    /// The middle of the box round all positions.
    pub center: [f32; 3],
    /// From there to the farthest position.
    pub radius: f32,
    /// The longest edge of a triangle. Seen by a camera that does not scale it, `w` differs over a triangle by this at the most:
    /// [`hither::Scene::deep`].
    pub longest_edge: f32,
    /// By how much a texture coordinate differs over one triangle at the most: [`hither::Scene::repeats`].
    pub repeats: f32,
    /// The largest magnitude of a texture coordinate: [`hither::Scene::coordinate`].
    pub coordinate: f32,
}

impl Bounds {
    pub(crate) fn of(vertices: &[ModelVertex], triangles: &[[u16; 3]], fraction_bits: u32) -> Self {
        let unit = 1.0 / scale(fraction_bits);
        let positions = || vertices.iter().map(|vertex| vertex.position.map(i64::from));
        let axis = |axis: usize| positions().map(move |position| position[axis]);
        let ends = [0, 1, 2].map(|i| [axis(i).min().unwrap_or(0), axis(i).max().unwrap_or(0)]);
        let extent = ends.iter().flatten().map(|end| end.abs()).max().unwrap_or(0);
        // In half steps the middle is a whole number.
        let middle = ends.map(|[low, high]| low + high);
        let farthest =
            positions().map(|position| squared([0, 1, 2].map(|i| 2 * position[i] - middle[i])));
        let radius = farthest.max().unwrap_or(0);
        let corners = || {
            triangles.iter().map(|triangle| triangle.map(|vertex| &vertices[usize::from(vertex)]))
        };
        let edges = corners().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        let lengths = edges.map(|edge| {
            let [from, to] = edge.map(|vertex| vertex.position.map(i64::from));
            squared([0, 1, 2].map(|i| to[i] - from[i]))
        });
        let coordinates = vertices.iter().flat_map(|vertex| vertex.coordinate);
        let coordinate = coordinates.map(i32::unsigned_abs).max().unwrap_or(0);
        let repeats = corners().flat_map(|corners| {
            [0, 1].map(|i| {
                let [a, b, c] = corners.map(|vertex| i64::from(vertex.coordinate[i]));
                a.max(b).max(c) - a.min(b).min(c)
            })
        });
        Self {
            extent: up(extent as f64 * unit),
            // 17 bits: exact.
            center: middle.map(|middle| (middle as f64 * unit / 2.0) as f32),
            radius: up((radius as f64).sqrt() * unit / 2.0),
            longest_edge: up((lengths.max().unwrap_or(0) as f64).sqrt() * unit),
            repeats: up(repeats.max().unwrap_or(0) as f64 / 65536.0),
            coordinate: up(f64::from(coordinate) / 65536.0),
        }
    }
}

fn squared(vector: [i64; 3]) -> i64 {
    vector.iter().map(|v| v * v).sum()
}

/// The least `f32` that is not below a number, which is not negative.
fn up(value: f64) -> f32 {
    let near = value as f32;
    if f64::from(near) < value { f32::from_bits(near.to_bits() + 1) } else { near }
}
