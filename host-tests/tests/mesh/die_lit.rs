//! die.obj, for hither: 24 vertices, 12 triangles, 360 bytes of flash.
//!
//! Made by `cargo run -p host-tests --release --bin mesh -- die.obj`.
//!
//! | data | bytes |
//! | --- | --- |
//! | positions | 144 |
//! | normals and colours | 144 |
//! | triangles | 72 |
//!
//! A position is up to 2^-15 units off along each axis, by rounding.
//! The surface is closed: from outside, `Cull::Back` hides nothing.
//!
//! Vertices are numbered most used first. Transforms a triangle, by entries of the vertex cache:
//!
//! | entries | transforms |
//! | --- | --- |
//! | 24 | 2.00 |
//! | 12 | 2.00 |
//! | 6 | 2.50 |
//! | 0 | 3.00 |
//!
//! To draw it, with a cache of all vertices:
//!
//! ```text
//! let lit = Lit::new(transform, &model, towards_light, ambient, diffuse)?;
//! frame.draw(&MESH, &lit, &Gouraud, &mut [Vertex::EMPTY; VERTEX_COUNT]);
//! ```
//!
//! To plan a frame for it, seen by a camera that does not scale it (`near` and `far` are along its view):
//!
//! ```text
//! hither::plan! {
//!     pub Planned = Scene::new(width, height)
//!         .range(near, far)
//!         .model(EXTENT, stretch)
//!         .triangle(LONGEST_EDGE, f32::INFINITY)
//!         .colors();
//! }
//! ```

use hither::{Mesh, NormalColor};

/// Vertices: entries of a cache that transforms each once.
pub const VERTEX_COUNT: usize = 24;

/// Triangles.
pub const TRIANGLE_COUNT: usize = 12;

/// Bits of fraction of a position.
pub const FRACTION_BITS: u32 = 14;

/// The largest magnitude of a coordinate, in units: for `Scene::model`.
pub const EXTENT: f32 = 1.0;

/// The middle of the box round the mesh, in units.
pub const CENTER: [f32; 3] = [0.0, 0.0, 0.0];

/// From there to the farthest vertex, in units: for `Scene::range`.
#[allow(clippy::approx_constant, reason = "a length")]
pub const RADIUS: f32 = 1.7320509;

/// The longest edge, in units, by which `w` differs over a triangle at the most: for `Scene::triangle`.
#[allow(clippy::approx_constant, reason = "a length")]
pub const LONGEST_EDGE: f32 = 2.8284273;

/// The mesh.
pub static MESH: Mesh<'static, [i16; 3], NormalColor> =
    match Mesh::try_new(&POSITIONS, FRACTION_BITS, &ATTRIBUTES, &TRIANGLES) {
        Ok(mesh) => mesh,
        Err(_) => panic!("the mesh's data"),
    };

/// Positions in units of 2^-14.
#[rustfmt::skip]
pub static POSITIONS: [[i16; 3]; VERTEX_COUNT] = [
    [-16384, -16384, 16384], [16384, 16384, 16384], [-16384, 16384, -16384],
    [16384, -16384, -16384], [-16384, 16384, -16384], [16384, 16384, 16384],
    [16384, -16384, -16384], [-16384, -16384, 16384], [16384, -16384, -16384],
    [16384, 16384, 16384], [-16384, -16384, 16384], [-16384, 16384, -16384], [16384, -16384, 16384],
    [-16384, 16384, 16384], [16384, 16384, -16384], [-16384, -16384, -16384],
    [-16384, 16384, 16384], [16384, 16384, -16384], [16384, -16384, 16384],
    [-16384, -16384, -16384], [16384, 16384, -16384], [16384, -16384, 16384],
    [-16384, 16384, 16384], [-16384, -16384, -16384],
];

/// Normals of length 127, and colours.
#[rustfmt::skip]
pub static ATTRIBUTES: [NormalColor; VERTEX_COUNT] = [
    lit([0, 0, 127], [255, 255, 255]), lit([0, 0, 127], [255, 255, 255]),
    lit([0, 0, -127], [255, 255, 255]), lit([0, 0, -127], [255, 255, 255]),
    lit([0, 127, 0], [255, 255, 255]), lit([0, 127, 0], [255, 255, 255]),
    lit([0, -127, 0], [255, 255, 255]), lit([0, -127, 0], [255, 255, 255]),
    lit([127, 0, 0], [255, 255, 255]), lit([127, 0, 0], [255, 255, 255]),
    lit([-127, 0, 0], [255, 255, 255]), lit([-127, 0, 0], [255, 255, 255]),
    lit([0, 0, 127], [255, 255, 255]), lit([0, 0, 127], [255, 255, 255]),
    lit([0, 0, -127], [255, 255, 255]), lit([0, 0, -127], [255, 255, 255]),
    lit([0, 127, 0], [255, 255, 255]), lit([0, 127, 0], [255, 255, 255]),
    lit([0, -127, 0], [255, 255, 255]), lit([0, -127, 0], [255, 255, 255]),
    lit([127, 0, 0], [255, 255, 255]), lit([127, 0, 0], [255, 255, 255]),
    lit([-127, 0, 0], [255, 255, 255]), lit([-127, 0, 0], [255, 255, 255]),
];

/// Three vertices a triangle, counter-clockwise from the front.
#[rustfmt::skip]
pub static TRIANGLES: [[u16; 3]; TRIANGLE_COUNT] = [
    [0, 12, 1], [0, 1, 13], [2, 14, 3], [2, 3, 15], [4, 16, 5], [4, 5, 17], [6, 18, 7], [6, 7, 19],
    [8, 20, 9], [8, 9, 21], [10, 22, 11], [10, 11, 23],
];

const fn lit(normal: [i8; 3], color: [u8; 3]) -> NormalColor {
    NormalColor { normal, color }
}
