//! W6 in `f64`: the same torus, through numbers of its own.

use hither_examples::reference::{Canvas, Cull, Vertex};
use hither_scenes::torus as scene;
use hither_scenes::workloads::SIDE;
use std::f64::consts::TAU;

/// Segments around the axis and around the tube.
const AROUND: usize = 32;
const ACROSS: usize = 16;

/// The distance of the torus, of the near plane, and of the far plane.
const DISTANCE: f64 = 3.2;
const NEAR: f64 = 1.0;
const FAR: f64 = 10.0;

/// The picture with a colour a face.
#[must_use]
pub fn faces() -> Canvas {
    draw(|face, _| {
        let color = scene::FACE_COLORS[face];
        [f64::from(color.r()) / 31.0, f64::from(color.g()) / 63.0, f64::from(color.b()) / 31.0]
    })
}

/// The picture with a colour a vertex.
#[must_use]
pub fn gouraud() -> Canvas {
    draw(|_, (i, j)| {
        let ((sin_a, cos_a), (sin_b, cos_b)) = angles(i, j);
        [cos_b * cos_a, cos_b * sin_a, sin_b].map(|v| 0.5 + 0.5 * v)
    })
}

/// Where vertex `index` is, in pixels of a picture with this side.
#[must_use]
pub fn on_screen(index: usize, side: f64) -> [f64; 2] {
    let [x, y, _, w] = clip(index / ACROSS, index % ACROSS);
    [(x / w + 1.0) / 2.0 * side, (1.0 - y / w) / 2.0 * side]
}

/// Draws the faces, coloured by face and vertex.
fn draw(color: impl Fn(usize, (usize, usize)) -> [f64; 3]) -> Canvas {
    let mut triangles = Vec::new();
    for cell in 0..AROUND * ACROSS {
        let (i, j) = (cell / ACROSS, cell % ACROSS);
        let corner = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        for (half, places) in [[0, 1, 2], [0, 2, 3]].into_iter().enumerate() {
            triangles.push(places.map(|place| {
                let (i, j) = corner[place];
                Vertex { clip: clip(i, j), varyings: color(2 * cell + half, (i, j)) }
            }));
        }
    }
    let mut canvas = Canvas::new(SIDE as usize, SIDE as usize, NEAR, [0.0; 3]);
    canvas.draw(&triangles, Cull::Back, |rgb| rgb);
    canvas
}

/// Sines and cosines around the axis and around the tube.
fn angles(i: usize, j: usize) -> ((f64, f64), (f64, f64)) {
    let turn = |step: usize, steps: usize| (TAU * step as f64 / steps as f64).sin_cos();
    (turn(i, AROUND), turn(j, ACROSS))
}

/// A vertex in clip space.
fn clip(i: usize, j: usize) -> [f64; 4] {
    let ((sin_a, cos_a), (sin_b, cos_b)) = angles(i, j);
    let radius = 1.0 + 0.45 * cos_b;
    let [x, y, z] = [radius * cos_a, radius * sin_a, 0.45 * sin_b];
    // About x, then y, then z.
    let (sin, cos) = 0.6_f64.sin_cos();
    let [y, z] = [cos * y - sin * z, sin * y + cos * z];
    let (sin, cos) = 0.9_f64.sin_cos();
    let [x, z] = [cos * x + sin * z, cos * z - sin * x];
    let (sin, cos) = 0.3_f64.sin_cos();
    let [x, y] = [cos * x - sin * y, sin * x + cos * y];
    let w = DISTANCE - z;
    let focal = 3_f64.sqrt();
    [focal * x, focal * y, FAR * (w - NEAR) / (FAR - NEAR), w]
}
