//! Numbers and vertices from arbitrary bytes, that meet the ends of ranges and the screen often.

use arbitrary::{Arbitrary, Result, Unstructured};
use hither::{ClipVertex, I16F16, Plane};

/// A 64-bit number: of any length, often a power of two give or take a little.
#[derive(Clone, Copy, Debug)]
pub struct Wide(pub i64);

impl<'a> Arbitrary<'a> for Wide {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let kind: u8 = u.arbitrary()?;
        Ok(Self(match kind % 8 {
            0 => i64::from(u.arbitrary::<i8>()?),
            1 | 2 => i64::from(u.arbitrary::<i16>()?),
            3 | 4 => i64::from(u.arbitrary::<i32>()?),
            5 => u.arbitrary()?,
            sign => {
                let power = 1i64 << (kind >> 3) << (u.arbitrary::<u8>()? % 32);
                let near = power.wrapping_add(i64::from(u.arbitrary::<i8>()?));
                if sign == 6 { near } else { near.wrapping_neg() }
            }
        }))
    }
}

/// A 32-bit number of the same kind; its low word.
#[derive(Clone, Copy, Debug)]
pub struct Raw(pub i32);

impl<'a> Arbitrary<'a> for Raw {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        Wide::arbitrary(u).map(|wide| Self(wide.0 as i32))
    }
}

impl Raw {
    /// As a fixed-point number.
    #[must_use]
    pub fn fixed(self) -> I16F16 {
        I16F16::from_bits(self.0)
    }
}

/// Three numbers as a vector.
#[must_use]
pub fn vector(raw: [Raw; 3]) -> [I16F16; 3] {
    raw.map(Raw::fixed)
}

/// A clip plane's coefficients; below 2^28, so that they are taken as they are.
#[derive(Arbitrary, Clone, Copy, Debug)]
pub struct Coefficients([Raw; 4]);

impl Coefficients {
    /// The plane, and the one that faces the other way.
    #[must_use]
    pub fn planes(self) -> [Plane; 2] {
        let bits = self.0.map(|raw| raw.0 % (1 << 28));
        [bits, bits.map(|v| -v)].map(|bits| Plane::new(bits.map(I16F16::from_bits)))
    }
}

/// A vertex, before it is known on which viewport.
#[derive(Arbitrary, Clone, Copy, Debug)]
pub enum Point {
    /// Any 32-bit coordinates.
    Narrow([Raw; 4]),
    /// Any 64-bit coordinates.
    Wide([Wide; 4]),
    /// On or about the screen: x, y and z in units of `w / 2^14`.
    Near([i16; 3], Raw),
    /// In eighths of a pixel from the corner, so often on a pixel's centre, scaled by the third.
    Eighths(i16, i16, i16, i16),
}

impl Point {
    /// The vertex on a `width x height` viewport.
    #[must_use]
    pub fn vertex(self, width: u32, height: u32) -> ClipVertex {
        match self {
            Self::Narrow(raw) => {
                let [x, y, z, w] = raw.map(Raw::fixed);
                ClipVertex::new(x, y, z, w)
            }
            Self::Wide(raw) => ClipVertex::from_wide(raw.map(|v| v.0)),
            Self::Near(offset, w) => {
                let w = i64::from(w.0);
                let [x, y, z] = offset.map(|v| (w * i64::from(v)) >> 14);
                ClipVertex::from_wide([x, y, z, w])
            }
            Self::Eighths(x, y, scale, z) => {
                let (x, y, scale) = (i64::from(x) % 8192, i64::from(y) % 8192, i64::from(scale));
                let (across, down) = (i64::from(width), i64::from(height));
                let across_w = (2 * x - 8 * across) * down * scale;
                let down_w = (8 * down - 2 * y) * across * scale;
                let w = 8 * across * down * scale;
                ClipVertex::from_wide([across_w, down_w, w / 0x8000 * i64::from(z), w])
            }
        }
    }
}
