//! A torus of 1024 triangles in flash, seen at an angle: the measuring workload W6.
//!
//! 32 segments around and 16 across, radii 1 and 0.45, turned by 0.6 about x, then 0.9 about y, then 0.3 about z (in
//! radians), 3.2 in front of the eye; focal length `sqrt(3)` half picture heights, near 1, far 10. At 240 x 240 pixels
//! 456 faces look front and cover about 22,223 pixels before depth (that many in `f64`; two fewer through Q16.16 clip
//! coordinates).

use hither::{Cull, Hither, I16F16, Mat4, MatrixError, Mesh, ModelPosition, Rgb565, SinCos};

use crate::trigonometry::{of_turn, q16, rotation, round};

/// Segments around the axis.
const AROUND: usize = 32;

/// Segments around the tube.
const ACROSS: usize = 16;

/// From the axis to the middle of the tube, in model units; the tube's own radius is [`TUBE`].
const RING: f64 = 1.0;

/// The tube's radius.
const TUBE: f64 = 0.45;

/// Fraction bits of the positions. Some faces are seen nearly edge-on: with 16-bit positions (Q1.14) one of them turns
/// away, and 455 look front.
const FRACTION_BITS: u32 = 20;

/// Vertices.
pub const VERTEX_COUNT: usize = AROUND * ACROSS;

/// Triangles.
pub const TRIANGLE_COUNT: usize = 2 * VERTEX_COUNT;

/// The distance of the near plane, and of the frame's hither plane.
pub const NEAR: I16F16 = I16F16::ONE;

/// The frame's hither plane.
pub const HITHER: Hither = match Hither::new(NEAR) {
    Ok(hither) => hither,
    Err(_) => panic!("the hither plane is not in front of the eye"),
};

/// The facing that is left out: a torus is closed.
pub const CULL: Cull = Cull::Back;

static POSITIONS: [[i32; 3]; VERTEX_COUNT] = positions();
static COLORS: [[u8; 3]; VERTEX_COUNT] = colors();
static TRIANGLES: [[u16; 3]; TRIANGLE_COUNT] = triangles();

/// The torus with a colour a vertex.
pub static TORUS: Mesh<'static, [i32; 3], [u8; 3]> =
    match Mesh::try_new(&POSITIONS, FRACTION_BITS, &COLORS, &TRIANGLES) {
        Ok(mesh) => mesh,
        Err(_) => panic!("the torus' indices"),
    };

/// The torus without varyings, for a colour a face.
pub static BARE_TORUS: Mesh<'static, [i32; 3], ()> =
    match Mesh::try_new(&POSITIONS, FRACTION_BITS, &[(); VERTEX_COUNT], &TRIANGLES) {
        Ok(mesh) => mesh,
        Err(_) => panic!("the torus' indices"),
    };

/// A colour a face: the mean of its vertices' colours.
pub static FACE_COLORS: [Rgb565; TRIANGLE_COUNT] = face_colors();

/// Where vertex `index` is in model space; past the last one, the origin.
#[must_use]
pub fn model_position(index: usize) -> ModelPosition {
    let raw = POSITIONS.get(index).copied().unwrap_or_default();
    ModelPosition { raw, fraction_bits: FRACTION_BITS }
}

/// The model-view-projection for a square picture.
///
/// # Errors
///
/// None in practice: the numbers are constants in range.
#[inline(never)]
pub fn transform() -> Result<Mat4, MatrixError> {
    const ABOUT_X: SinCos = rotation(0.6);
    const ABOUT_Y: SinCos = rotation(0.9);
    const ABOUT_Z: SinCos = rotation(0.3);
    const AWAY: I16F16 = q16(-3.2);
    const FAR: I16F16 = q16(10.0);
    const SQRT_3: I16F16 = q16(1.732_050_807_568_877_2);
    let turned = Mat4::rotation_z(ABOUT_Z)
        .times(&Mat4::rotation_y(ABOUT_Y))?
        .times(&Mat4::rotation_x(ABOUT_X))?;
    let moved = Mat4::translation([I16F16::ZERO, I16F16::ZERO, AWAY]).times(&turned)?;
    Mat4::perspective(SQRT_3, I16F16::ONE, NEAR, FAR)?.times(&moved)
}

/// Sine and cosine around the axis and around the tube, of vertex `index`: `(sin a, cos a, sin b, cos b)`.
const fn angles(index: usize) -> (f64, f64, f64, f64) {
    let (sin_a, cos_a) = of_turn(index / ACROSS, AROUND);
    let (sin_b, cos_b) = of_turn(index % ACROSS, ACROSS);
    (sin_a, cos_a, sin_b, cos_b)
}

const fn positions() -> [[i32; 3]; VERTEX_COUNT] {
    const ONE: f64 = (1_u32 << FRACTION_BITS) as f64;
    let mut positions = [[0; 3]; VERTEX_COUNT];
    let mut at = 0;
    while at < VERTEX_COUNT {
        let (sin_a, cos_a, sin_b, cos_b) = angles(at);
        let radius = RING + TUBE * cos_b;
        positions[at] =
            [round(radius * cos_a * ONE), round(radius * sin_a * ONE), round(TUBE * sin_b * ONE)];
        at += 1;
    }
    positions
}

/// The normal as a colour: -1 to 1 becomes 0 to 255.
const fn colors() -> [[u8; 3]; VERTEX_COUNT] {
    let mut colors = [[0; 3]; VERTEX_COUNT];
    let mut at = 0;
    while at < VERTEX_COUNT {
        let (sin_a, cos_a, sin_b, cos_b) = angles(at);
        colors[at] = [channel(cos_b * cos_a), channel(cos_b * sin_a), channel(sin_b)];
        at += 1;
    }
    colors
}

const fn channel(component: f64) -> u8 {
    round((0.5 + 0.5 * component) * 255.0) as u8
}

/// Two triangles for each cell, counter-clockwise seen from outside.
const fn triangles() -> [[u16; 3]; TRIANGLE_COUNT] {
    let mut triangles = [[0; 3]; TRIANGLE_COUNT];
    let mut cell = 0;
    while cell < VERTEX_COUNT {
        let (i, j) = (cell / ACROSS, cell % ACROSS);
        let near = vertex(i, j);
        let opposite = vertex(i + 1, j + 1);
        triangles[2 * cell] = [near, vertex(i + 1, j), opposite];
        triangles[2 * cell + 1] = [near, opposite, vertex(i, j + 1)];
        cell += 1;
    }
    triangles
}

const fn vertex(i: usize, j: usize) -> u16 {
    (i % AROUND * ACROSS + j % ACROSS) as u16
}

const fn face_colors() -> [Rgb565; TRIANGLE_COUNT] {
    let mut colors = [Rgb565::BLACK; TRIANGLE_COUNT];
    let mut at = 0;
    while at < TRIANGLE_COUNT {
        let [a, b, c] = TRIANGLES[at];
        let [a, b, c] = [COLORS[a as usize], COLORS[b as usize], COLORS[c as usize]];
        colors[at] = Rgb565::new(
            mean([a[0], b[0], c[0]], 31),
            mean([a[1], b[1], c[1]], 63),
            mean([a[2], b[2], c[2]], 31),
        );
        at += 1;
    }
    colors
}

/// The mean of three bytes, 255 becoming `most`, rounded to nearest.
const fn mean([a, b, c]: [u8; 3], most: u32) -> u8 {
    let sum = a as u32 + b as u32 + c as u32;
    ((2 * sum * most + 3 * 255) / (2 * 3 * 255)) as u8
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use hither::{FaceColors, Fidelity, Frame, Gouraud, Target, Vertex};

    /// Counts the pixels that are written.
    struct Tally(usize);

    impl Target for Tally {
        type Color = Rgb565;

        fn size(&self) -> (u32, u32) {
            (240, 240)
        }

        fn write(&mut self, _: usize, _: usize, colors: impl Iterator<Item = Option<Rgb565>>) {
            self.0 += colors.flatten().count();
        }
    }

    #[test]
    fn it_is_the_workload() {
        let frame = Frame::new(Tally(0)).unwrap().with_preset(Fidelity).with_hither(HITHER);
        let mut frame = frame.with_cull(CULL);
        let transform = transform().unwrap();
        let faces = FaceColors::new(&FACE_COLORS).unwrap();
        let mut cache = [Vertex::EMPTY; VERTEX_COUNT];
        let counts = frame.draw(&BARE_TORUS, &transform, &faces, &mut cache);
        assert_eq!(counts.drawn + counts.off_screen, 456, "{counts:?}");
        assert_eq!(counts.culled, 568, "{counts:?}");
        let fragments = frame.target().0;
        assert!(fragments.abs_diff(22_223) <= 3, "{fragments} fragments");

        let mut cache = [Vertex::EMPTY; VERTEX_COUNT];
        assert_eq!(frame.draw(&TORUS, &transform, &Gouraud, &mut cache), counts);
        assert_eq!(frame.target().0, 2 * fragments);
    }

    #[test]
    fn faces_have_the_mean_colour() {
        assert_eq!(mean([0, 0, 0], 31), 0);
        assert_eq!(mean([255, 255, 255], 63), 63);
        assert_eq!(mean([0, 255, 0], 63), 21);
    }

    #[test]
    fn faces_look_outwards() {
        for triangle in TRIANGLES {
            let [a, b, c] = triangle.map(|v| POSITIONS[usize::from(v)].map(f64::from));
            let edge = |to: [f64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
            let ([ux, uy, uz], [vx, vy, vz]) = (edge(b), edge(c));
            let normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
            let (sin_a, cos_a, sin_b, cos_b) = angles(usize::from(triangle[0]));
            let outward = [cos_b * cos_a, cos_b * sin_a, sin_b];
            let along: f64 = normal.iter().zip(outward).map(|(n, o)| n * o).sum();
            assert!(along > 0.0, "{triangle:?}");
        }
    }
}
