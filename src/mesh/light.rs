//! A vertex stage with one directional and an ambient light, in fixed point.

use super::{VertexStage, unit};
use crate::math::{low, shr_round, signed, unsigned};
use crate::transform::{Mat4, MatrixError, ModelPosition, Vec3};
use crate::vertex::ClipVertex;
use fixed::types::I16F16;

/// What [`Lit`] reads of a vertex: 6 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NormalColor {
    /// The unit normal in model space, times 127.
    pub normal: [i8; 3],
    /// The surface's red, green and blue, 255 for 1.
    pub color: [u8; 3],
}

/// Transforms, and lights each vertex: its colour times `ambient + diffuse max(0, n . l)`, at most
/// the colour itself. The three varyings are red, green and blue in `[0, 1]`, as
/// [`Gouraud`](crate::Gouraud) takes them.
///
/// The light is brought into model space once, so a vertex costs three products for it, in Q14: the
/// brightness is within 2^-7 of the exact one for the stored normal.
#[derive(Clone, Copy, Debug)]
pub struct Lit {
    transform: Mat4,
    /// Towards the light, in model space, Q14 / 127.
    light: [i32; 3],
    /// Q16.
    ambient: i32,
    /// Q16.
    diffuse: i32,
}

impl Lit {
    /// A stage for a mesh that `model` (rotations, one uniform scale, a translation) brings into
    /// the world and `transform` into clip space. `towards_light` is in world space, any length;
    /// `ambient` and `diffuse` are brightnesses, clamped to `[0, 1]`.
    ///
    /// # Errors
    ///
    /// [`MatrixError::Light`] where the light has no direction, or `model` leaves none of it.
    pub fn new(
        transform: Mat4,
        model: &Mat4,
        towards_light: Vec3,
        ambient: I16F16,
        diffuse: I16F16,
    ) -> Result<Self, MatrixError> {
        let light = model.unturn(towards_light).ok_or(MatrixError::Light)?;
        let light = light.map(|v| low(shr_round(v / 127, 9)));
        let brightness = |v: I16F16| v.to_bits().clamp(0, 1 << 16);
        let (ambient, diffuse) = (brightness(ambient), brightness(diffuse));
        Ok(Self { transform, light, ambient, diffuse })
    }

    /// Brightness of a normal, Q16 in `[0, 1]`.
    #[inline]
    fn brightness(&self, normal: [i8; 3]) -> i32 {
        let [x, y, z] = normal.map(i32::from);
        let [lx, ly, lz] = self.light;
        // Q21 with the normal's 127 divided out: at most 2^22.
        let facing = (x * lx + y * ly + z * lz).max(0) >> 7;
        // Q14 times Q16.
        (self.ambient + ((facing * (self.diffuse >> 2)) >> 12)).min(1 << 16)
    }
}

impl VertexStage<NormalColor, 3> for Lit {
    #[inline(always)]
    fn vertex(
        &self,
        position: ModelPosition,
        attribute: &NormalColor,
    ) -> (ClipVertex, [I16F16; 3]) {
        let brightness = self.brightness(attribute.normal);
        let color = attribute.color.map(|channel| lit(unit(channel), brightness));
        (self.transform.transform(position), color)
    }
}

/// A channel of `[0, 1]` at a brightness of `[0, 1]`, Q16, rounded to nearest.
#[inline]
fn lit(channel: I16F16, brightness: i32) -> I16F16 {
    let (channel, brightness) = (unsigned(channel.to_bits()), unsigned(brightness));
    // Full light would not fit: 2^16 2^16.
    let full = brightness >> 16 != 0;
    let part = (channel * (brightness & 0xffff) + (1 << 15)) >> 16;
    I16F16::from_bits(signed(if full { channel } else { part }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transform::Angle;

    #[test]
    fn brightness_is_the_cosine_to_the_light() {
        let fixed = I16F16::from_num::<f64>;
        let model = Mat4::rotation_y(Angle::from_degrees(fixed(30.0)).sin_cos());
        let light = [0.3, 0.8, 0.5];
        let (ambient, diffuse) = (0.2, 0.7);
        let lit =
            Lit::new(model, &model, light.map(fixed), fixed(ambient), fixed(diffuse)).unwrap();
        let norm = light.iter().map(|v| v * v).sum::<f64>().sqrt();
        for i in 0..2000 {
            let (a, b) = (f64::from(i) * 0.37, f64::from(i) * 0.11);
            let normal = [a.cos() * b.cos(), b.sin(), a.sin() * b.cos()];
            let stored = normal.map(|v| (v * 127.0).round() as i8);
            let (sin, cos) = 30f64.to_radians().sin_cos();
            let [x, y, z] = stored.map(|v| f64::from(v) / 127.0);
            let turned = [cos * x + sin * z, y, -sin * x + cos * z];
            let facing: f64 = turned.iter().zip(light).map(|(n, l)| n * l / norm).sum();
            let exact = (ambient + diffuse * facing.max(0.0)).min(1.0);
            let got = f64::from(lit.brightness(stored)) / 65536.0;
            assert!((got - exact).abs() < 1.0 / 128.0, "{stored:?}: {got}, not {exact}");
        }
    }

    #[test]
    fn lit_channels_are_rounded_to_nearest() {
        for byte in 0..=255 {
            let channel = unit(byte);
            for brightness in (0..=65536).step_by(77).chain([1, 32767, 32768, 65535, 65536]) {
                let exact = shr_round(i64::from(channel.to_bits()) * i64::from(brightness), 16);
                assert_eq!(i64::from(lit(channel, brightness).to_bits()), exact);
            }
        }
    }

    #[test]
    fn a_light_needs_a_direction() {
        let dark =
            Lit::new(Mat4::IDENTITY, &Mat4::IDENTITY, [I16F16::ZERO; 3], I16F16::ONE, I16F16::ONE);
        assert_eq!(dark.err(), Some(MatrixError::Light));
    }
}
