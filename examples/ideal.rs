//! The spinning teapot in `f64`: the same numbers and the same meshes as
//! [`spinning_teapot`](hither_scenes::spinning_teapot), through matrices, a light and a rasterizer of its own.
//!
//! What stays between its pictures and hither's, all of it small:
//! - hither's matrices are Q16.16, an angle's sine is within 2^-16, and clip coordinates are rounded to 2^-16: vertices
//!   are off by some 1/100 of a pixel, so a pixel centre may change sides of an edge (at a silhouette that is another
//!   colour, and the largest difference);
//! - texture coordinates are off by as much, so that a pixel between two texels may take the other one;
//! - brightness is a product of Q14 and Q16, so that a channel next to half a step of RGB565 may round the other way;
//! - depth has 16 bits here: where two surfaces cross, the nearer is not always told.

use std::f64::consts::TAU;

use hither::{I16F16, Rgb565};
use hither_scenes::ground::{self, BACKGROUND};
use hither_scenes::spinning_teapot::{self as scene, Moment};
use hither_scenes::{teapot, texture};

use crate::reference::{Canvas, Cull, Vertex};

/// A 4 x 4 matrix for column vectors, by rows.
type Matrix = [[f64; 4]; 4];

/// A vector of three coordinates.
type Vector = [f64; 3];

/// Draws the scene at a moment of the turn.
#[must_use]
pub fn draw(moment: Moment, width: usize, height: usize) -> Canvas {
    // Nothing but the angle is rounded: frames need not divide a turn.
    let turn = TAU * f64::from(moment.number) / f64::from(moment.frames.max(1));
    let world = camera(width as f64 / height as f64, turn);
    let first = f64::from(scene::FIRST_ANGLE.0) / 65536.0 * TAU;
    let mut canvas = Canvas::new(width, height, float(scene::NEAR), unit(BACKGROUND));
    canvas.draw(&teapot_triangles(&world, first + turn), Cull::None, |rgb| rgb);
    canvas.draw(&ground_triangles(&world), Cull::None, faded);
    canvas
}

/// The teapot's triangles, turned and lit; varyings are red, green and blue.
fn teapot_triangles(world: &Matrix, angle: f64) -> Vec<[Vertex; 3]> {
    let model = rotation_y(angle);
    let transform = product(world, &model);
    let light = normalized(scene::TOWARDS_LIGHT.map(float));
    let (ambient, diffuse) = (float(scene::AMBIENT), float(scene::DIFFUSE));
    let glaze = scene::GLAZE.map(|channel| f64::from(channel) / 255.0);
    let vertices: Vec<Vertex> = teapot::POSITIONS
        .iter()
        .zip(&teapot::NORMALS)
        .map(|(&position, &normal)| {
            let [x, y, z] = normal.map(|c| f64::from(c) / f64::from(teapot::NORMAL_ONE));
            let [x, y, z, _] = apply(&model, [x, y, z, 0.0]);
            let brightness = (ambient + diffuse * dot([x, y, z], light).max(0.0)).min(1.0);
            let varyings = glaze.map(|channel| channel * brightness);
            Vertex { clip: apply(&transform, point(position)), varyings }
        })
        .collect();
    triangles(&vertices, &teapot::TRIANGLES)
}

/// The ground's triangles; varyings are texture coordinates and how much of the texture is seen.
fn ground_triangles(world: &Matrix) -> Vec<[Vertex; 3]> {
    let vertices: Vec<Vertex> = ground::POSITIONS
        .iter()
        .zip(&ground::VARYINGS)
        .map(|(&position, varyings)| Vertex {
            clip: apply(world, point(position)),
            varyings: varyings.map(float),
        })
        .collect();
    triangles(&vertices, &ground::TRIANGLES)
}

/// The ground's colour: the nearest texel, faded into the background.
fn faded([u, v, part]: Vector) -> Vector {
    let texel = |coordinate: f64| {
        (coordinate.rem_euclid(1.0) * texture::SIZE as f64) as usize % texture::SIZE
    };
    let stone = unit(Rgb565(texture::GROUND[texel(v) * texture::SIZE + texel(u)]));
    let into = unit(BACKGROUND);
    [0, 1, 2].map(|i| into[i] + (stone[i] - into[i]) * part.clamp(0.0, 1.0))
}

/// From the world to clip space.
fn camera(aspect: f64, turn: f64) -> Matrix {
    let [x, y, z] = scene::EYE.map(float);
    let eye = [x, y + float(scene::SWAY) * turn.sin(), z];
    let view = look_at(eye, scene::TARGET.map(float));
    product(&perspective(float(scene::FOCAL), aspect, float(scene::NEAR), float(scene::FAR)), &view)
}

/// The view from `eye` towards `target`, y up: x to the right, y up, looking along negative z.
fn look_at(eye: Vector, target: Vector) -> Matrix {
    let back = normalized([0, 1, 2].map(|i| eye[i] - target[i]));
    let right = normalized(cross([0.0, 1.0, 0.0], back));
    let up = cross(back, right);
    let row = |axis: Vector| {
        let [x, y, z] = axis;
        [x, y, z, -dot(axis, eye)]
    };
    [row(right), row(up), row(back), [0.0, 0.0, 0.0, 1.0]]
}

/// Perspective with `w` the distance and `z / w` 0 at `near` and 1 at `far`.
fn perspective(focal: f64, aspect: f64, near: f64, far: f64) -> Matrix {
    let depth = far - near;
    [
        [focal / aspect, 0.0, 0.0, 0.0],
        [0.0, focal, 0.0, 0.0],
        [0.0, 0.0, -far / depth, -far * near / depth],
        [0.0, 0.0, -1.0, 0.0],
    ]
}

/// Turns about the y axis, z towards x.
fn rotation_y(angle: f64) -> Matrix {
    let (sin, cos) = angle.sin_cos();
    [[cos, 0.0, sin, 0.0], [0.0, 1.0, 0.0, 0.0], [-sin, 0.0, cos, 0.0], [0.0, 0.0, 0.0, 1.0]]
}

/// The product: `b` is applied first.
fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let column = |j: usize| [0, 1, 2, 3].map(|i| b[i][j]);
    a.map(|row| [0, 1, 2, 3].map(|j| (0..4).map(|k| row[k] * column(j)[k]).sum()))
}

fn apply(matrix: &Matrix, vector: [f64; 4]) -> [f64; 4] {
    matrix.map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum())
}

/// A stored position in model units.
fn point(position: [i16; 3]) -> [f64; 4] {
    let [x, y, z] = position.map(|c| f64::from(c) / f64::from(1_u32 << teapot::FRACTION_BITS));
    [x, y, z, 1.0]
}

fn triangles(vertices: &[Vertex], indices: &[[u16; 3]]) -> Vec<[Vertex; 3]> {
    indices.iter().map(|triangle| triangle.map(|index| vertices[usize::from(index)])).collect()
}

/// A colour's channels from 0 to 1.
fn unit(color: Rgb565) -> Vector {
    [f64::from(color.r()) / 31.0, f64::from(color.g()) / 63.0, f64::from(color.b()) / 31.0]
}

fn float(value: I16F16) -> f64 {
    value.to_num()
}

fn normalized(vector: Vector) -> Vector {
    let length = dot(vector, vector).sqrt();
    vector.map(|c| c / length)
}

fn dot([ax, ay, az]: Vector, [bx, by, bz]: Vector) -> f64 {
    ax * bx + ay * by + az * bz
}

fn cross([ax, ay, az]: Vector, [bx, by, bz]: Vector) -> Vector {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::compare;
    use hither::{
        Correction, DepthBuffer, Exact, Frame, Framebuffer, Perspective, PerspectiveEvery, Quick,
        Tier,
    };
    use hither_scenes::spinning_teapot::VERTEX_COUNT;

    const SIDE: u32 = 120;

    /// How many of 14,400 pixels differ from the reference, at the most over a few frames, and the largest mean.
    fn farthest<T: Tier, I: Correction>(tier: T, correction: I) -> (usize, f64) {
        let differences = [0, 5, 11].map(|number| {
            let moment = Moment { number, frames: 12 };
            let (mut words, mut depths) =
                ([0; (SIDE * SIDE) as usize], [0_u16; (SIDE * SIDE) as usize]);
            let buffer = Framebuffer::<Rgb565>::try_new(&mut words, SIDE, SIDE).unwrap();
            let depth = DepthBuffer::try_new(&mut depths, SIDE, SIDE).unwrap();
            let frame =
                Frame::new(buffer).unwrap().with_hither(scene::HITHER).with_depth(depth).unwrap();
            let mut frame =
                frame.with_cull(scene::CULL).with_tier(tier).with_correction(correction);
            let mut cache = [hither::Vertex::EMPTY; VERTEX_COUNT];
            let drawn = scene::draw(&mut frame, moment, &mut cache).unwrap();
            assert!(drawn.teapot.drawn > 900 && drawn.ground.drawn > 100, "{drawn:?}");
            let ideal = draw(moment, SIDE as usize, SIDE as usize).to_rgb565();
            compare(&words, &ideal)
        });
        let differing = differences.iter().map(|d| d.differing).max();
        (differing.unwrap_or(0), differences.iter().map(|d| d.mean).fold(0.0, f64::max))
    }

    #[test]
    fn the_exact_tier_is_next_to_the_reference() {
        let (differing, mean) = farthest(Exact, Perspective);
        assert!(differing <= 50 && mean < 0.03, "{differing} pixels, {mean} in the mean");
    }

    #[test]
    fn the_quick_tiers_are_near_the_reference() {
        let (differing, mean) = farthest(Quick::<8>, PerspectiveEvery::<16>);
        assert!(differing <= 144 && mean < 0.08, "{differing} pixels, {mean} in the mean");
        let (differing, mean) = farthest(Quick::<4>, Perspective);
        assert!(differing <= 600 && mean < 0.35, "{differing} pixels, {mean} in the mean");
    }
}
