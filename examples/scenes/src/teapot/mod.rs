//! The Utah teapot: a mesh of 992 triangles in flash, tessellated by the compiler from Newell's Bezier patches.
//!
//! Model space is right-handed with `y` up, the spout to `+x`, and the lid's axis on the `y` axis. The body's radius is
//! 1; the teapot stands on `y = -0.7875` and is as high above zero. Front faces are counter-clockwise seen from outside.
//!
//! Vertices are shared by the triangles of all patches that meet there, as patches meet smoothly everywhere. Only where
//! the handle's lower end touches the body, one position has two vertices. As Newell made it, the teapot is not closed:
//! the rim and the lid leave a narrow gap between them, the spout is open, and handle and spout end inside the body
//! without a seam. Seen through the gap or into the spout, the faces behind show their backs.

mod patches;
mod tessellate;

use tessellate::{Sample, Welded};

/// Fraction bits of [`POSITIONS`]: Q3.12, so that 4096 is one model unit.
pub const FRACTION_BITS: u32 = 12;

/// The length 1 in [`NORMALS`]: read as Q0.7, a normal's length is 127/128.
pub const NORMAL_ONE: i8 = 127;

/// Number of vertices after welding.
pub const VERTEX_COUNT: usize = MESH.sample_count;

/// Number of triangles: 32 patches of 4 x 4 x 2, less 32 that a pole of lid or bottom would leave without area.
pub const TRIANGLE_COUNT: usize = MESH.triangle_count;

/// Positions in model units, Q3.12 (see [`FRACTION_BITS`]), rounded to nearest.
pub static POSITIONS: [[i16; 3]; VERTEX_COUNT] = MESH.positions();

/// Outward unit normals scaled by [`NORMAL_ONE`], rounded to nearest; one for each of [`POSITIONS`].
///
/// They are the surface's own, from the derivatives of the patches, not means over triangles.
pub static NORMALS: [[i8; 3]; VERTEX_COUNT] = MESH.normals();

/// Triangles, as indices into [`POSITIONS`] and [`NORMALS`], counter-clockwise seen from outside.
pub static TRIANGLES: [[u16; 3]; TRIANGLE_COUNT] = MESH.triangles();

/// The smallest and the largest coordinates in [`POSITIONS`], same format.
pub const BOUNDS: [[i16; 3]; 2] = bounds(&POSITIONS);

const SAMPLES: [Sample; 800] = tessellate::sample_all();
const MESH: Welded = tessellate::weld(&SAMPLES);

const _: () = assert!(
    TRIANGLE_COUNT == 32 * (4 * 4 * 2) - 2 * (4 * 4),
    "the triangle count is not that of the doc comment"
);
const _: () = assert!(
    size_of_val(&POSITIONS) + size_of_val(&NORMALS) + size_of_val(&TRIANGLES) <= 11_000,
    "the teapot takes more flash than 11,000 bytes"
);

const fn bounds(positions: &[[i16; 3]]) -> [[i16; 3]; 2] {
    let mut low = positions[0];
    let mut high = positions[0];
    let mut at = 0;
    while at < 3 * positions.len() {
        let axis = at % 3;
        let value = positions[at / 3][axis];
        if value < low[axis] {
            low[axis] = value;
        }
        if value > high[axis] {
            high[axis] = value;
        }
        at += 1;
    }
    [low, high]
}

#[cfg(test)]
mod tests;
