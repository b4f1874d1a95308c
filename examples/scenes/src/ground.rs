//! What the teapot stands on: a ring of stone under a lamp, dark where the teapot shades it, fading into the
//! background.
//!
//! Its shader shows how to write one's own: a texture that fades by a third varying.

use hither::{Fragment, I16F16, Mesh, Rgb565, Sample, Texture};

use crate::teapot::{BOUNDS, FRACTION_BITS};
use crate::texture;
use crate::trigonometry::{of_turn, q16, round};

/// What the ground fades into.
pub const BACKGROUND: Rgb565 = Rgb565::new(2, 6, 5);

/// Vertices around a circle.
const AROUND: usize = 16;

/// Vertices.
pub const VERTEX_COUNT: usize = AROUND * CIRCLES.len();

/// Triangles.
pub const TRIANGLE_COUNT: usize = 2 * AROUND * (CIRCLES.len() - 1);

/// Model units that one repetition of the texture spans.
const SPAN: f64 = 1.75;

/// A circle of vertices on the ground.
struct Circle {
    /// In model units.
    radius: f64,
    /// How far the middle is moved away from the light, in model units.
    away: f64,
    /// How much of the texture is seen, 0 to 1; the rest is [`BACKGROUND`].
    light: f64,
}

/// From the foot of the teapot, which hides what is inside, outwards: its shade, then the light of the lamp.
const CIRCLES: [Circle; 6] = [
    Circle { radius: 0.68, away: 0.0, light: 0.1 },
    Circle { radius: 0.96, away: 0.1, light: 0.25 },
    Circle { radius: 1.5, away: 0.24, light: 0.9 },
    Circle { radius: 2.1, away: 0.2, light: 1.0 },
    Circle { radius: 3.75, away: 0.0, light: 0.5 },
    Circle { radius: 7.0, away: 0.0, light: 0.0 },
];

/// The direction away from the light along x and z, of length 1.
const AWAY: [f64; 2] = [0.8, -0.6];

/// Positions in model units, as many fraction bits as the teapot's.
pub static POSITIONS: [[i16; 3]; VERTEX_COUNT] = positions();
/// Texture coordinates along x and z, and how much of the texture is seen (0 to 1).
pub static VARYINGS: [[I16F16; 3]; VERTEX_COUNT] = varyings();
/// Triangles, counter-clockwise seen from above.
pub static TRIANGLES: [[u16; 3]; TRIANGLE_COUNT] = triangles();

/// The ground, with three varyings: texture coordinates, and how much of the texture is seen.
pub static GROUND: Mesh<'static, [i16; 3], [I16F16; 3]> =
    match Mesh::try_new(&POSITIONS, FRACTION_BITS, &VARYINGS, &TRIANGLES) {
        Ok(mesh) => mesh,
        Err(_) => panic!("the ground's indices"),
    };

/// The stones.
pub static STONES: Texture<'static, Rgb565> =
    match Texture::try_new(&texture::GROUND, texture::SIZE as u32, texture::SIZE as u32) {
        Ok(texture) => texture,
        Err(_) => panic!("the texture's size"),
    };

/// A shader with three varyings: a texture by the first two, faded into a colour by the third (1 is all texture).
#[derive(Clone, Copy, Debug)]
pub struct Faded<'a> {
    /// What is seen at 1.
    pub texture: Texture<'a, Rgb565>,
    /// What is seen at 0.
    pub into: Rgb565,
}

impl Fragment<Rgb565, 3> for Faded<'_> {
    #[inline]
    fn shade(&self, sample: Sample<3>) -> Rgb565 {
        let [u, v, part] = sample.varyings;
        self.faded(self.texture.nearest(u, v).unwrap_or(self.into), part)
    }
}

impl Faded<'_> {
    /// A texel of which a part is seen.
    #[inline]
    fn faded(&self, texel: Rgb565, part: I16F16) -> Rgb565 {
        // Q16, 0 to 1; each channel is rounded to nearest.
        let part = part.to_bits().clamp(0, 1 << 16);
        let mix = |from: u8, to: u8| {
            let (from, to) = (i32::from(from), i32::from(to));
            (from + (((to - from) * part + (1 << 15)) >> 16)) as u8
        };
        let into = self.into;
        Rgb565::new(mix(into.r(), texel.r()), mix(into.g(), texel.g()), mix(into.b(), texel.b()))
    }
}

/// The place of vertex `index` along x and z, in model units.
const fn place(index: usize) -> [f64; 2] {
    let circle = &CIRCLES[index / AROUND];
    let (sin, cos) = of_turn(index % AROUND, AROUND);
    let [x, z] = AWAY;
    [circle.radius * cos + circle.away * x, circle.radius * sin + circle.away * z]
}

const fn positions() -> [[i16; 3]; VERTEX_COUNT] {
    let one = (1_u32 << FRACTION_BITS) as f64;
    let mut positions = [[0; 3]; VERTEX_COUNT];
    let mut at = 0;
    while at < VERTEX_COUNT {
        let [x, z] = place(at);
        positions[at] = [round(x * one) as i16, BOUNDS[0][1], round(z * one) as i16];
        at += 1;
    }
    positions
}

const fn varyings() -> [[I16F16; 3]; VERTEX_COUNT] {
    let mut varyings = [[I16F16::ZERO; 3]; VERTEX_COUNT];
    let mut at = 0;
    while at < VERTEX_COUNT {
        let [x, z] = place(at);
        varyings[at] = [q16(x / SPAN), q16(z / SPAN), q16(CIRCLES[at / AROUND].light)];
        at += 1;
    }
    varyings
}

/// Two triangles for each cell between two circles, counter-clockwise seen from above.
const fn triangles() -> [[u16; 3]; TRIANGLE_COUNT] {
    let mut triangles = [[0; 3]; TRIANGLE_COUNT];
    let mut cell = 0;
    while 2 * cell < TRIANGLE_COUNT {
        let (circle, step) = (cell / AROUND, cell % AROUND);
        // Steps go from x to z, which is clockwise seen from above.
        let inner = [vertex(circle, step + 1), vertex(circle, step)];
        let outer = [vertex(circle + 1, step + 1), vertex(circle + 1, step)];
        triangles[2 * cell] = [inner[0], outer[0], outer[1]];
        triangles[2 * cell + 1] = [inner[0], outer[1], inner[1]];
        cell += 1;
    }
    triangles
}

const fn vertex(circle: usize, step: usize) -> u16 {
    (circle * AROUND + step % AROUND) as u16
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;

    #[test]
    fn it_looks_up() {
        for triangle in TRIANGLES {
            let [a, b, c] = triangle.map(|v| POSITIONS[usize::from(v)].map(i32::from));
            // The y of the cross product of two edges.
            let up = (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]);
            assert!(up > 0, "{triangle:?}");
        }
    }

    #[test]
    fn fading_ends_at_both_colours_and_rounds_between() {
        let words = [Rgb565::new(31, 0, 3).0];
        let texture = Texture::try_new(&words, 1, 1).unwrap();
        let shader = Faded { texture, into: Rgb565::new(0, 63, 0) };
        let at = |part: f32| shader.faded(Rgb565(words[0]), I16F16::from_num(part));
        assert_eq!([0.0, 1.0, -3.0, 9.0].map(at).map(|c| c.r()), [0, 31, 0, 31]);
        assert_eq!(at(0.25), Rgb565::new(8, 47, 1));
    }
}
