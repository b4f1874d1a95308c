//! Matrices from `f32`, for scenes that are built with floating point; trigonometry is micromath's.
#![expect(clippy::float_arithmetic, reason = "this file is the edge where f32 comes in")]

use super::{Mat4, MatrixError, SinCos};
use fixed::types::I16F16;
use micromath::F32Ext;

/// A floating-point number cannot be taken.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum FloatError {
    /// NaN, infinite, or beyond ±32768.
    Value(f32),
    /// The matrix cannot be made from such numbers.
    Matrix(MatrixError),
}

impl core::fmt::Display for FloatError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Value(value) => write!(f, "{value} is not a number within ±32768"),
            Self::Matrix(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for FloatError {}

impl From<MatrixError> for FloatError {
    fn from(error: MatrixError) -> Self {
        Self::Matrix(error)
    }
}

/// The nearest Q16.16.
fn fixed(value: f32) -> Result<I16F16, FloatError> {
    // NaN and infinities have no fixed-point value either.
    I16F16::checked_from_num(value).ok_or(FloatError::Value(value))
}

impl SinCos {
    /// The sine and cosine of an angle in radians, by micromath: within 2^-9.
    ///
    /// # Errors
    ///
    /// [`FloatError::Value`] for NaN, infinities and angles beyond ±32768.
    pub fn from_radians(angle: f32) -> Result<Self, FloatError> {
        fixed(angle)?;
        Ok(Self { sin: fixed(F32Ext::sin(angle))?, cos: fixed(F32Ext::cos(angle))? })
    }
}

impl Mat4 {
    /// A matrix from rows of `f32`.
    ///
    /// # Errors
    ///
    /// [`FloatError`] where an entry is NaN, infinite or out of range.
    pub fn from_f32(rows: [[f32; 4]; 4]) -> Result<Self, FloatError> {
        let mut entries = [[I16F16::ZERO; 4]; 4];
        for (entry, value) in entries.iter_mut().flatten().zip(rows.into_iter().flatten()) {
            *entry = fixed(value)?;
        }
        Ok(Self::from_rows(entries)?)
    }

    /// [`Mat4::perspective`] from a vertical field of view in radians.
    ///
    /// # Errors
    ///
    /// [`FloatError`] for numbers that are not finite, and where [`Mat4::perspective`] fails.
    pub fn perspective_f32(
        fov_y: f32,
        aspect: f32,
        near: f32,
        far: f32,
    ) -> Result<Self, FloatError> {
        let half = fixed(fov_y)?.to_num::<f32>() / 2.0;
        let focal = fixed(F32Ext::cos(half) / F32Ext::sin(half))?;
        Ok(Self::perspective(focal, fixed(aspect)?, fixed(near)?, fixed(far)?)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_numbers_are_taken() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 32768.0, -40000.0] {
            assert!(SinCos::from_radians(bad).is_err());
            assert!(Mat4::perspective_f32(1.0, bad, 1.0, 2.0).is_err());
            assert!(Mat4::perspective_f32(bad, 1.0, 1.0, 2.0).is_err());
            let mut rows = [[0.0; 4]; 4];
            rows[2][1] = bad;
            assert!(matches!(Mat4::from_f32(rows), Err(FloatError::Value(_))));
        }
        assert!(matches!(
            Mat4::perspective_f32(0.0, 1.0, 1.0, 2.0),
            Err(FloatError::Value(_) | FloatError::Matrix(_))
        ));
    }

    #[test]
    fn angles_are_close() {
        for i in -100..100 {
            let angle = i as f32 * 0.1;
            let got = SinCos::from_radians(angle).unwrap();
            let (sin, cos) = f64::from(angle).sin_cos();
            assert!((got.sin.to_num::<f64>() - sin).abs() < 2f64.powi(-9));
            assert!((got.cos.to_num::<f64>() - cos).abs() < 2f64.powi(-9));
        }
    }
}
