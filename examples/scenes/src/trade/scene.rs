//! What the scenes are: integers, and a camera each.

use super::geometry::{Attribute, Geometry};
use crate::{SceneError, torus};
use hither::{Angle, Cull, Hither, I16F16, Mat4, Mesh};

/// A scene; see the [module](super).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the module's table says what each is")]
pub enum Scene {
    Card,
    Torus,
    Floor,
    Wall,
    Range,
    Specks,
    Repeat,
    Steep,
}

/// A number of 2^-8.
const fn q8(v: i32) -> I16F16 {
    I16F16::from_bits(v << 8)
}

impl Scene {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Card,
        Self::Torus,
        Self::Floor,
        Self::Wall,
        Self::Range,
        Self::Specks,
        Self::Repeat,
        Self::Steep,
    ];

    /// The name, in small letters.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Card => "card",
            Self::Torus => "torus",
            Self::Floor => "floor",
            Self::Wall => "wall",
            Self::Range => "range",
            Self::Specks => "specks",
            Self::Repeat => "repeat",
            Self::Steep => "steep",
        }
    }

    /// Whether its picture has a texture; otherwise a colour a vertex.
    #[must_use]
    pub const fn is_textured(self) -> bool {
        !matches!(self, Self::Torus | Self::Specks)
    }

    /// Fraction bits of the positions, which are below 2^15: such that a coordinate of clip space, in units of 2^-16 of one of
    /// theirs, takes 32 bits and a sign.
    #[must_use]
    pub const fn fraction_bits(self) -> u32 {
        match self {
            Self::Card | Self::Torus | Self::Specks | Self::Repeat => 12,
            Self::Floor | Self::Wall | Self::Range | Self::Steep => 8,
        }
    }

    /// The near plane: `w` there.
    #[must_use]
    pub const fn near(self) -> I16F16 {
        q8(match self {
            Self::Range => 8,
            Self::Wall | Self::Floor | Self::Steep => 64,
            _ => 192,
        })
    }

    /// The far plane: `w` there.
    const fn far(self) -> i32 {
        match self {
            Self::Card | Self::Torus | Self::Specks | Self::Repeat => 8,
            _ => 255,
        }
    }

    /// The frame's hither plane.
    ///
    /// # Errors
    ///
    /// None in practice: it is in front of the eye.
    pub fn hither(self) -> Result<Hither, SceneError> {
        Ok(Hither::new(self.near())?)
    }

    /// The facing that is left out: only the torus is closed.
    #[must_use]
    pub const fn cull(self) -> Cull {
        if matches!(self, Self::Torus) { Cull::Back } else { Cull::Neither }
    }

    /// The camera.
    ///
    /// # Errors
    ///
    /// None in practice: the numbers are constants in range.
    pub fn transform(self) -> Result<Mat4, SceneError> {
        let focal = q8(384);
        // 4 : 3.
        let aspect = I16F16::from_bits(87_381);
        let far = I16F16::from_bits(self.far() << 16);
        let lens = Mat4::perspective(focal, aspect, self.near(), far)?;
        let view = match self {
            Self::Torus => {
                let away = Mat4::translation([I16F16::ZERO, I16F16::ZERO, q8(-3 * 256)]);
                let turn = Mat4::rotation_y(Angle(9000).sin_cos());
                away.times(&turn.times(&Mat4::rotation_x(Angle(6000).sin_cos()))?)?
            }
            Self::Wall => Mat4::rotation_y(Angle(4200).sin_cos()),
            _ => Mat4::IDENTITY,
        };
        Ok(lens.times(&view)?)
    }

    /// Makes the mesh.
    ///
    /// # Errors
    ///
    /// None in practice: the indices are those of the vertices.
    pub fn build(self, into: &mut Geometry) -> Result<Mesh<'_, [i16; 3], Attribute>, SceneError> {
        into.clear();
        match self {
            Self::Card => card(into, [0, 1]),
            Self::Repeat => card(into, [-100, 100]),
            Self::Torus => ring(into),
            Self::Floor => floor(into),
            Self::Wall => corridor(into),
            Self::Range => ramp(into),
            Self::Specks => specks(into),
            Self::Steep => fan(into),
        }
        Ok(into.mesh(self.fraction_bits())?)
    }
}

/// A bright colour, another one for each number.
fn color(number: usize) -> [I16F16; 3] {
    let hash = (number as u32 + 1).wrapping_mul(2_654_435_769);
    [0, 10, 20].map(|shift| I16F16::from_bits(((hash >> shift) & 0x3ff) as i32 * 64 + 32))
}

/// An attribute: texture coordinates in 2^-8, and a colour by number.
fn attribute(uv: [i32; 2], number: usize) -> Attribute {
    Attribute { uv: uv.map(q8), color: color(number) }
}

/// A quad inside of the screen that leans away from it, with texture coordinates from one number to another.
fn card(into: &mut Geometry, [low, high]: [i32; 2]) {
    const CORNERS: [[i16; 3]; 4] = [
        [-3276, -2457, -4096],
        [3276, -2457, -4096],
        [-9830, 7372, -12_288],
        [9830, 7372, -12_288],
    ];
    into.grid([1, 1], |x, y| {
        let at = CORNERS.get(2 * y + x).copied().unwrap_or_default();
        let uv = [x, y].map(|end| 256 * if end == 0 { low } else { high });
        (at, attribute(uv, 2 * y + x))
    });
}

/// The measured torus, with its colours, and a texture around it.
fn ring(into: &mut Geometry) {
    const ACROSS: usize = 16;
    into.grid([ACROSS, 32], |x, y| {
        let model = torus::model_position((y % 32) * ACROSS + x % ACROSS);
        // A normal's direction is near enough to the place on the ring.
        let at = model.raw.map(|v| (v >> (model.fraction_bits - 12)) as i16);
        let uv = [x as i32 * 64, y as i32 * 64].map(q8);
        let color = at.map(|v| I16F16::from_bits((i32::from(v) * 5 + (1 << 15)).clamp(0, 1 << 16)));
        (at, Attribute { uv, color })
    });
}

/// Three wide, 120 long, in three parts.
fn floor(into: &mut Geometry) {
    const AWAY: [i16; 4] = [-192, -8 * 256, -40 * 256, -120 * 256];
    into.grid([2, 3], |x, y| {
        let (across, z) = (384 * (x as i16 - 1), AWAY.get(y).copied().unwrap_or(0));
        ([across, -256, z], attribute([i32::from(across), i32::from(z) / 2], 3 * y + x))
    });
}

/// Two walls, a floor and a ceiling, from behind the eye to far away.
fn corridor(into: &mut Geometry) {
    const EDGES: [[i16; 2]; 5] = [[-160, -120], [100, -120], [100, 140], [-160, 140], [-160, -120]];
    into.grid([4, 4], |x, y| {
        let [right, up] = EDGES.get(x).copied().unwrap_or_default();
        let z = 640 - 900 * y as i16;
        ([right, up, z], attribute([256 * x as i32, i32::from(z)], 5 * y + x))
    });
}

/// From just beyond the hither plane to the far one.
fn ramp(into: &mut Geometry) {
    const CORNERS: [[i16; 3]; 4] = [
        [-6, 5, -8],
        [6, 5, -8],
        [-90 * 256, -100 * 256, -127 * 256],
        [90 * 256, -100 * 256, -127 * 256],
    ];
    into.grid([1, 1], |x, y| {
        let at = CORNERS.get(2 * y + x).copied().unwrap_or_default();
        (at, attribute([1024 * x as i32, 4096 * y as i32], 2 * y + x))
    });
}

/// Waves of 32 by 16 cells, each 0.8 pixels.
fn specks(into: &mut Geometry) {
    into.grid([32, 16], |x, y| {
        let wave = ((x * 37 + y * 53) % 29) as i16 * 12;
        let at = [(x as i16 - 16) * 146 + wave / 4, (y as i16 - 8) * 146, -16_384 + wave];
        (at, attribute([x as i32 * 32, y as i32 * 32], y * 33 + x))
    });
}

/// Planes that the eye is nearly in.
fn fan(into: &mut Geometry) {
    for plane in 0..6 {
        // In 2^-8, of a height of 2 at a distance of 1.5 : 1 is 3 a.
        let a = (2 * plane - 5) * 12;
        let lean = if plane % 2 == 0 { 5 } else { -9 };
        into.grid([1, 1], |x, y| {
            let side = 2 * x as i32 - 1;
            let (reach, height, z) = if y == 0 {
                (80, a + 4 * side, -128)
            } else {
                (60 * 256, 200 * a + (lean + 3 * side) * 256, -100 * 256)
            };
            let at = [side * reach, height, z].map(|v| v as i16);
            (at, attribute([512 * x as i32, 2048 * y as i32], (6 * plane) as usize + 2 * y + x))
        });
    }
}
