//! Transforms: a fixed-point 4 x 4 matrix, for chips with or without an FPU.
//!
//! Entries are Q16.16: the left three columns in ±8192, the fourth (translation) in ±32768. A
//! product sums in 64 bits: a row times a column is at most `3 (2^29 2^29) + 2^31 2^31 < 2^63`, and
//! a row times a position of 32 bits at most `3 (2^29 2^31) + 2^62 < 2^63`. Each is rounded once,
//! to half a raw step (2^-17). What a product of matrices cannot hold is an error; what a position
//! cannot hold is shifted, all four coordinates together, so it stays where it is on the screen.
//!
//! Positions that are small beside the matrix, which is nearly all, are known to fit beforehand
//! ([`Mat4::narrow`]): the same numbers, from 32-bit products where those are cheaper.

mod angle;
#[cfg(feature = "micromath")]
mod float;
mod short;

pub use angle::{Angle, SinCos};
#[cfg(feature = "micromath")]
pub use float::FloatError;
pub use short::ShortMat4;

use crate::math::{low, shr_round, signed, unsigned};
use crate::vertex::ClipVertex;
use fixed::types::I16F16;

/// One, raw Q16.16.
const ONE: i32 = 1 << 16;

/// A position in model space: raw coordinates and how many of their bits are fraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ModelPosition {
    /// Coordinates, times `2^fraction_bits`.
    pub raw: [i32; 3],
    /// 0 to 31; more count as 31.
    pub fraction_bits: u32,
}

/// A vector of three coordinates.
pub type Vec3 = [I16F16; 3];

/// A 4 x 4 matrix in Q16.16 for column vectors: `a.times(&b)` applies `b` first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mat4 {
    rows: [[i32; 4]; 4],
    /// The left three entries of each row are at most `2^size` together, 15 to 28, and translations
    /// below 2^30; or [`WIDE`].
    size: u8,
}

/// The [`size`](Mat4::size) of a matrix that [`Mat4::narrow`] does not do.
const WIDE: u8 = 31;

impl Mat4 {
    /// The matrix that changes nothing.
    pub const IDENTITY: Self =
        Self::of([[ONE, 0, 0, 0], [0, ONE, 0, 0], [0, 0, ONE, 0], [0, 0, 0, ONE]]);

    /// Entries of the left three columns are at most this in magnitude, raw.
    const LIMIT: i64 = 8192 << 16;

    /// From raw rows in range.
    #[expect(clippy::cast_possible_truncation, reason = "15 to 31")]
    const fn of(rows: [[i32; 4]; 4]) -> Self {
        let mut largest = 0;
        let mut moved = 0;
        let mut rest = rows.as_slice();
        while let Some(([a, b, c, t], others)) = rest.split_first() {
            // At most 3 2^29, so the sum does not wrap.
            let sum = a.unsigned_abs() + b.unsigned_abs() + c.unsigned_abs();
            if sum > largest {
                largest = sum;
            }
            moved |= t.unsigned_abs();
            rest = others;
        }
        let size = (32 - (largest | 1 << 14).leading_zeros()) as u8;
        let size = if size > 28 || moved >= 1 << 30 { WIDE } else { size };
        Self { rows, size }
    }

    /// A matrix from its rows.
    ///
    /// # Errors
    ///
    /// [`MatrixError::Range`] where an entry of the left three columns is beyond ±8192.
    pub fn from_rows(rows: [[I16F16; 4]; 4]) -> Result<Self, MatrixError> {
        Self::checked(rows.map(|row| row.map(|v| i64::from(v.to_bits()))))
    }

    /// The rows.
    #[must_use]
    pub fn rows(&self) -> [[I16F16; 4]; 4] {
        self.rows.map(|row| row.map(I16F16::from_bits))
    }

    /// Raw entries, if they are in range.
    fn checked(raw: [[i64; 4]; 4]) -> Result<Self, MatrixError> {
        for (row, entries) in raw.iter().enumerate() {
            for (column, &entry) in entries.iter().enumerate() {
                let limit = if column < 3 { Self::LIMIT } else { i64::from(i32::MAX) };
                if entry.abs() > limit {
                    return Err(MatrixError::Range { row, column });
                }
            }
        }
        Ok(Self::of(raw.map(|row| row.map(low))))
    }

    /// The product: `rhs` is applied first.
    ///
    /// # Errors
    ///
    /// [`MatrixError::Range`] where an entry of the product is out of range.
    pub fn times(&self, rhs: &Self) -> Result<Self, MatrixError> {
        let [r0, r1, r2, r3] = rhs.rows;
        let product = self.rows.map(|[a, b, c, d]| {
            let mut entries = [0; 4];
            let columns = r0.into_iter().zip(r1).zip(r2).zip(r3);
            for (entry, (((e, f), g), h)) in entries.iter_mut().zip(columns) {
                *entry = shr_round(wide(a, e) + wide(b, f) + wide(c, g) + wide(d, h), 16);
            }
            entries
        });
        Self::checked(product)
    }

    /// Moves by a vector.
    #[must_use]
    pub const fn translation(by: Vec3) -> Self {
        let [x, y, z] = [by[0].to_bits(), by[1].to_bits(), by[2].to_bits()];
        Self::of([[ONE, 0, 0, x], [0, ONE, 0, y], [0, 0, ONE, z], [0, 0, 0, ONE]])
    }

    /// Scales each axis.
    ///
    /// # Errors
    ///
    /// [`MatrixError::Range`] where a factor is beyond ±8192.
    pub fn scaling(by: Vec3) -> Result<Self, MatrixError> {
        let [x, y, z] = by.map(|v| i64::from(v.to_bits()));
        let one = i64::from(ONE);
        Self::checked([[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0], [0, 0, 0, one]])
    }

    /// Turns about the x axis, y towards z.
    #[must_use]
    pub fn rotation_x(by: SinCos) -> Self {
        let (s, c) = by.raw();
        Self::of([[ONE, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, ONE]])
    }

    /// Turns about the y axis, z towards x.
    #[must_use]
    pub fn rotation_y(by: SinCos) -> Self {
        let (s, c) = by.raw();
        Self::of([[c, 0, s, 0], [0, ONE, 0, 0], [-s, 0, c, 0], [0, 0, 0, ONE]])
    }

    /// Turns about the z axis, x towards y.
    #[must_use]
    pub fn rotation_z(by: SinCos) -> Self {
        let (s, c) = by.raw();
        Self::of([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, ONE, 0], [0, 0, 0, ONE]])
    }

    /// The view from `eye` towards `target`: x to the right, y up, looking along negative z.
    ///
    /// # Errors
    ///
    /// [`MatrixError::Direction`] where `eye` is `target`, or `up` is zero or along the view;
    /// [`MatrixError::Range`] where the eye is so far out that the view's translation leaves
    /// ±32768.
    pub fn look_at(eye: Vec3, target: Vec3, up: Vec3) -> Result<Self, MatrixError> {
        let raw = |v: Vec3| v.map(|v| i64::from(v.to_bits()));
        let ([ex, ey, ez], [tx, ty, tz]) = (raw(eye), raw(target));
        let back = unit([ex - tx, ey - ty, ez - tz]).ok_or(MatrixError::Direction)?;
        let up = unit(raw(up)).ok_or(MatrixError::Direction)?;
        let right = unit(cross(up, back)).ok_or(MatrixError::Direction)?;
        let up = cross(back, right);
        let row = |axis: [i64; 3]| {
            let [x, y, z] = axis;
            // Q30 times Q16, in 128 bits since three such products take 63.
            let along = i128::from(x) * i128::from(ex)
                + i128::from(y) * i128::from(ey)
                + i128::from(z) * i128::from(ez);
            let along = i64::try_from(along >> 30).unwrap_or(i64::MAX);
            let [x, y, z] = axis.map(|v| shr_round(v, 14));
            [x, y, z, -along]
        };
        Self::checked([row(right), row(up), row(back), [0, 0, 0, i64::from(ONE)]])
    }

    /// A perspective projection from view space (looking along negative z) to clip space: `w` is
    /// the distance from the eye's plane, `z / w` is 0 at `near` and 1 at `far`.
    ///
    /// `focal` is the focal length in half picture heights, `1 / tan(fov_y / 2)`; `aspect` is width
    /// by height. The frame's [`Hither`](crate::Hither) plane belongs at `near`.
    ///
    /// # Errors
    ///
    /// [`MatrixError::Perspective`] unless `0 < near < far`, `focal > 0` and `aspect > 0`;
    /// [`MatrixError::Range`] where an entry is out of range.
    pub fn perspective(
        focal: I16F16,
        aspect: I16F16,
        near: I16F16,
        far: I16F16,
    ) -> Result<Self, MatrixError> {
        let [focal, aspect, near, far] = [focal, aspect, near, far].map(|v| i64::from(v.to_bits()));
        if near <= 0 || far <= near || focal <= 0 || aspect <= 0 {
            return Err(MatrixError::Perspective);
        }
        let depth = far - near;
        let one = i64::from(ONE);
        let rounded = |n: i64, d: i64| (n + d / 2) / d;
        Self::checked([
            [rounded(focal << 16, aspect), 0, 0, 0],
            [0, focal, 0, 0],
            [0, 0, -rounded(far << 16, depth), -rounded(far * near, depth)],
            [0, 0, -one, 0],
        ])
    }

    /// A position to clip space.
    ///
    /// Three products a coordinate, rounded once.
    #[inline(always)]
    #[must_use]
    pub fn transform(&self, position: ModelPosition) -> ClipVertex {
        match self.narrow::<LONG_MULTIPLY>(position) {
            Some(vertex) => vertex,
            None => {
                // By fields, so that the usual path has all in registers.
                let ModelPosition { raw: [x, y, z], fraction_bits } = position;
                let ClipVertex { raw: [x, y, z, w], shift } =
                    self.transform_wide(x, y, z, fraction_bits);
                ClipVertex { raw: [x, y, z, w], shift }
            }
        }
    }

    /// [`transform`](Self::transform) where nothing leaves the range: sums of products in 64 bits if
    /// `LONG`, in 32 otherwise.
    ///
    /// With `f` bits of fraction and a row of at most `2^r`, in 32 bits a coordinate is split at `s =
    /// min(30 - r, f - 1)` bits (0 where `f` is 0) into `h 2^s + l`. Then `(a x + b y + c z) / 2^f`,
    /// rounded, is `(H + floor(L / 2^s) + 2^(f - 1 - s)) / 2^(f - s)`, floored, where `H` and `L` are the
    /// row's products with the high and the low parts:
    ///
    /// | | at most | |
    /// | --- | --- | --- |
    /// | `x` | `2^(30 - r + s)` | tested |
    /// | `H` | `2^r 2^(30 - r) = 2^30` | |
    /// | `L` | `2^r 2^s`: 2^30 | |
    /// | `floor(L / 2^s) + 2^(f - 1 - s)` | below 2^30 | `2^(30 - s)` each where `s > 1`; 2^29 + 1 |
    /// | the quotient | 2^30 | `f - s` is 1 or more, or `H` is all |
    /// | with the translation | 2^31 - 1 | translations are below 2^30 |
    ///
    /// If `LONG`, entries are shifted left by `e = min(31 - r, 32 - f)` and coordinates by `32 - f - e`, so
    /// that the quotient is the high word of the sum; in a loop the entries are shifted before it:
    ///
    /// | | at most | |
    /// | --- | --- | --- |
    /// | `x` | `2^(29 - r + f)` | tested |
    /// | a row, shifted | below 2^31 | |
    /// | `x`, shifted | `2^30`, or as it is | `29 - r + f + 32 - f - (31 - r)` |
    /// | the sum | `2^61`, its high word 2^29 | `r + (29 - r + f) + (32 - f)` |
    #[inline(always)]
    fn narrow<const LONG: bool>(&self, position: ModelPosition) -> Option<ClipVertex> {
        if self.size == WIDE {
            return None;
        }
        let fraction = position.fraction_bits.min(31);
        let spare = 30 - u32::from(self.size);
        let split = spare.min(fraction.saturating_sub(1));
        let room = if LONG { (spare + fraction - 1).min(30) } else { spare + split };
        // At most 2^30 and a power of two, so only what is inside stays below twice as much.
        let limit = 1 << room;
        let [x, y, z] = position.raw.map(|v| unsigned(v.wrapping_add(limit)));
        if (x | y | z) >= unsigned(limit) << 1 {
            return None;
        }
        let all = 32 - fraction;
        let entries = all.min(spare + 1);
        let shifted = position.raw.map(|v| v << (all - entries));
        let row = |[a, b, c, t]: [i32; 4]| {
            if LONG {
                quotient_long([a << entries, b << entries, c << entries], shifted, t)
            } else {
                t + quotient_split([a, b, c], position.raw, fraction, split)
            }
        };
        // Four calls: an array's `map` of this length is not inlined.
        let [r0, r1, r2, r3] = self.rows;
        Some(ClipVertex { raw: [row(r0), row(r1), row(r2), row(r3)], shift: 0 })
    }

    /// [`transform`](Self::transform) of any position, in 64 bits.
    #[inline(never)]
    fn transform_wide(&self, x: i32, y: i32, z: i32, fraction_bits: u32) -> ClipVertex {
        let fraction = fraction_bits.min(31);
        ClipVertex::from_wide(self.rows.map(|[a, b, c, t]| {
            let sum = wide(a, x) + wide(b, y) + wide(c, z) + (i64::from(t) << fraction);
            shr_round(sum, fraction)
        }))
    }

    /// A direction through the inverse of a matrix of rotations and one uniform scale, at unit
    /// length in Q30: what brings a light into model space. `None` where it vanishes.
    pub(crate) fn unturn(&self, direction: Vec3) -> Option<[i64; 3]> {
        let [r0, r1, r2, _] = self.rows;
        let [x, y, z] = unit(direction.map(|v| i64::from(v.to_bits())))?;
        // Q30 times at most 2^29, three of them: 61 bits.
        let along = |[a, b, c]: [i32; 3]| i64::from(a) * x + i64::from(b) * y + i64::from(c) * z;
        let column = |i: usize| [r0, r1, r2].map(|row| row.get(i).copied().unwrap_or(0));
        unit([along(column(0)), along(column(1)), along(column(2))])
    }
}

/// Whether three multiplications with 64-bit sums are cheaper than six in 32 bits: where one
/// instruction multiplies and adds 64 bits (m4f: 68 instructions a position for 119).
const LONG_MULTIPLY: bool = cfg!(all(target_arch = "arm", target_has_atomic = "32"));

/// `t + v . position / 2^32`, rounded: [`Mat4::narrow`] says why it fits.
#[inline(always)]
fn quotient_long([a, b, c]: [i32; 3], [x, y, z]: [i32; 3], t: i32) -> i32 {
    let sum = (i64::from(t) << 32) + wide(a, x) + wide(b, y) + wide(c, z);
    // Rounded by the top bit of the low word: one instruction.
    low(sum >> 32) + signed(unsigned(low(sum)) >> 31)
}

/// `v . position / 2^fraction`, rounded, from 32-bit products.
#[inline(always)]
fn quotient_split(v: [i32; 3], position: [i32; 3], fraction: u32, split: u32) -> i32 {
    let [[a, b, c], [x, y, z]] = [v, position];
    let mask = (1 << split) - 1;
    let high = a * (x >> split) + b * (y >> split) + c * (z >> split);
    let low = a * (x & mask) + b * (y & mask) + c * (z & mask);
    // 0 where there is no fraction.
    let half = ((1u32 << fraction) >> 1) >> split;
    (high + signed(half) + (low >> split)) >> (fraction - split)
}

/// A product of two raw entries.
#[inline]
fn wide(a: i32, b: i32) -> i64 {
    i64::from(a) * i64::from(b)
}

/// The cross product of two unit vectors in Q30.
fn cross([ax, ay, az]: [i64; 3], [bx, by, bz]: [i64; 3]) -> [i64; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx].map(|v| shr_round(v, 30))
}

/// A vector at unit length in Q30, within 2^-28; `None` for zero. Coordinates of any size.
#[expect(clippy::cast_possible_wrap, reason = "a square root of 62 bits is 31")]
fn unit(v: [i64; 3]) -> Option<[i64; 3]> {
    let largest = v.iter().fold(0, |all, v| all | v.unsigned_abs());
    if largest == 0 {
        return None;
    }
    // The largest to 30 bits, so that three squares fit.
    let length = 64 - largest.leading_zeros();
    let v = v.map(|v| if length > 30 { v >> (length - 30) } else { v << (30 - length) });
    let squares = v.iter().fold(0, |sum, v| sum + v.unsigned_abs() * v.unsigned_abs());
    let norm = squares.isqrt() as i64;
    (norm > 0).then(|| v.map(|v| (v << 30) / norm))
}

/// A matrix cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum MatrixError {
    /// An entry is beyond ±8192 (±32768 in the fourth column).
    Range {
        /// From 0, from the top.
        row: usize,
        /// From 0, from the left.
        column: usize,
    },
    /// The view has no direction: the eye is the target, or `up` is zero or along the view.
    Direction,
    /// A light has no direction.
    Light,
    /// Not `0 < near < far`, or a focal length or aspect that is not positive.
    Perspective,
}

impl core::fmt::Display for MatrixError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Range { row, column } => {
                let limit = if *column < 3 { 8192 } else { 32768 };
                write!(f, "the matrix entry in row {row}, column {column} is beyond ±{limit}")
            }
            Self::Direction => {
                f.write_str("the view has no direction: eye, target and up are in line")
            }
            Self::Light => f.write_str("the light has no direction: a vector of length 0"),
            Self::Perspective => f.write_str(
                "a perspective needs 0 < near < far, and a focal length and aspect above 0",
            ),
        }
    }
}

impl core::error::Error for MatrixError {}

#[cfg(test)]
mod tests {
    use super::*;

    fn fixed(v: f64) -> I16F16 {
        I16F16::from_num(v)
    }

    fn apply(m: &Mat4, p: [f64; 3]) -> [f64; 4] {
        let raw = p.map(|v| (v * 4096.0).round() as i32);
        let v = m.transform(ModelPosition { raw, fraction_bits: 12 });
        v.raw.map(|c| f64::from(c) / 65536.0 * f64::from(u32::from(v.shift)).exp2())
    }

    fn close(a: [f64; 4], b: [f64; 4], bound: f64) {
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= bound), "{a:?} is not {b:?}");
    }

    #[test]
    fn products_apply_the_right_one_first() {
        let turn = Mat4::rotation_z(Angle::from_turns(fixed(0.25)).sin_cos());
        let shift = Mat4::translation([fixed(5.0), fixed(0.0), fixed(-2.0)]);
        let both = shift.times(&turn).unwrap();
        close(apply(&both, [1.0, 2.0, 3.0]), [3.0, 1.0, 1.0, 1.0], 1e-4);
        assert_eq!(both.times(&Mat4::IDENTITY).unwrap(), both);
    }

    #[test]
    fn views_look_along_negative_z() {
        let at = |v: [f64; 3]| v.map(fixed);
        let view = Mat4::look_at(at([3.0, 2.0, 5.0]), at([0.0, 2.0, 1.0]), at([0.0, 1.0, 0.0]));
        let view = view.unwrap();
        close(apply(&view, [3.0, 2.0, 5.0]), [0.0, 0.0, 0.0, 1.0], 1e-3);
        close(apply(&view, [0.0, 2.0, 1.0]), [0.0, 0.0, -5.0, 1.0], 1e-3);
        close(apply(&view, [0.0, 3.0, 1.0]), [0.0, 1.0, -5.0, 1.0], 1e-3);
        let nowhere = Mat4::look_at(at([1.0; 3]), at([1.0; 3]), at([0.0, 1.0, 0.0]));
        assert_eq!(nowhere, Err(MatrixError::Direction));
        let along = Mat4::look_at(at([0.0; 3]), at([0.0, 4.0, 0.0]), at([0.0, 1.0, 0.0]));
        assert_eq!(along, Err(MatrixError::Direction));
    }

    #[test]
    fn perspective_spans_depth_from_near_to_far() {
        let m = Mat4::perspective(fixed(1.5), fixed(1.5), fixed(1.0), fixed(10.0)).unwrap();
        close(apply(&m, [1.0, 1.0, -1.0]), [1.0, 1.5, 0.0, 1.0], 1e-4);
        close(apply(&m, [1.0, 1.0, -10.0]), [1.0, 1.5, 10.0, 10.0], 1e-3);
        for (focal, near, far) in [(0.0, 1.0, 2.0), (1.0, 0.0, 2.0), (1.0, 2.0, 2.0)] {
            let bad = Mat4::perspective(fixed(focal), fixed(1.0), fixed(near), fixed(far));
            assert_eq!(bad, Err(MatrixError::Perspective));
        }
    }

    /// Matrices of any size, and positions of any size and fraction, at the ends of each as well.
    #[test]
    fn narrow_and_wide_agree() {
        let mut seed = 5u64;
        let mut draw = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695);
            (seed >> 32) as i32
        };
        let mut narrow = [0; 32];
        for i in 0..400_000u32 {
            let (entry, moved, size) = (2 + i % 19, i % 5, i % 31);
            let rows = core::array::from_fn(|_| {
                let t = draw().max(-i32::MAX) >> moved;
                let [a, b, c] = core::array::from_fn(|_| match draw() & 7 {
                    0 => 1 << (31 - entry),
                    1 => -1 << (31 - entry),
                    2 => 0,
                    _ => draw() >> entry,
                });
                [a, b, c, t]
            });
            let m = Mat4::of(rows);
            let raw = core::array::from_fn(|_| match draw() & 7 {
                0 => i32::MIN >> size,
                1 => i32::MAX >> size,
                2 => (i32::MAX >> size).saturating_add(1),
                _ => draw() >> size,
            });
            for fraction_bits in [0, 1, 2, 8, 14, 16, 20, 30, 31, 99] {
                let position = ModelPosition { raw, fraction_bits };
                let [x, y, z] = raw;
                let wide = m.transform_wide(x, y, z, fraction_bits);
                let [split, long] = [m.narrow::<false>(position), m.narrow::<true>(position)];
                assert_eq!(split.unwrap_or(wide), wide, "{m:?} {position:?}");
                assert_eq!(long.unwrap_or(wide), wide, "{m:?} {position:?}");
                let both = split.is_some() && long.is_some();
                narrow[fraction_bits.min(31) as usize] += u32::from(both);
            }
        }
        assert!([0, 1, 2, 8, 14, 16, 20, 30, 31].map(|f| narrow[f]).iter().all(|&n| n > 40_000));
    }

    #[test]
    fn usual_positions_are_narrow() {
        let m = Mat4::perspective(fixed(1.7), fixed(1.0), fixed(1.0), fixed(100.0)).unwrap();
        let scale = |by: f64| Mat4::scaling([fixed(by); 3]).unwrap();
        let fits = |m: &Mat4, v: i32, fraction_bits| {
            let position = ModelPosition { raw: [v, -v, v], fraction_bits };
            [m.narrow::<false>(position), m.narrow::<true>(position)].map(|v| v.is_some())
        };
        // 16 bits from 3 of fraction on, and Q16.16 to 512 units, by a matrix of entries below 2.
        assert!((3..32).all(|fraction| fits(&m, 32767, fraction) == [true; 2]));
        assert_eq!(fits(&m, 512 << 16, 16), [true; 2]);
        // 32-bit products fit fewer bits of a position than 64-bit sums where entries are large.
        assert_eq!(fits(&scale(30.0), 32767, 12), [true; 2]);
        assert_eq!(fits(&scale(100.0), 32767, 12), [false, true]);
    }

    #[test]
    fn what_does_not_fit_is_an_error_or_shifted() {
        let large = Mat4::scaling([fixed(8192.0); 3]).unwrap();
        let error = large.times(&large).unwrap_err();
        assert_eq!(error, MatrixError::Range { row: 0, column: 0 });
        assert!(Mat4::scaling([fixed(8193.0); 3]).is_err());
        let raw = [i32::MIN, i32::MAX, 1];
        let v = large.transform(ModelPosition { raw, fraction_bits: 0 });
        let unit = f64::from(u32::from(v.shift)).exp2() / 65536.0;
        let x = f64::from(v.raw[0]) * unit;
        assert!((x / (f64::from(i32::MIN) * 8192.0) - 1.0).abs() < 1e-8);
    }
}
