//! Matrices from arbitrary numbers, by every way the library has to make one.

use crate::number::{Raw, vector};
use arbitrary::Arbitrary;
use hither::{Angle, I16F16, Mat4, SinCos};

/// One matrix of a product.
#[derive(Arbitrary, Debug)]
pub enum Step {
    /// Any sixteen numbers.
    Rows([[Raw; 4]; 4]),
    /// Any sixteen numbers, whole ones that are likely to be in range.
    Small([[i8; 4]; 4]),
    /// Eye, target and up.
    LookAt([[Raw; 3]; 3]),
    /// Focal length, aspect, near and far.
    Perspective([Raw; 4]),
    /// Any vector.
    Translation([Raw; 3]),
    /// Any factors.
    Scaling([Raw; 3]),
    /// About an axis, by an angle.
    Turn(u8, u16),
    /// About an axis, by what may not be a sine and a cosine.
    SinCos(u8, [Raw; 2]),
    /// About an axis, by radians.
    Radians(u8, f32),
    /// Any sixteen floats.
    Floats([[f32; 4]; 4]),
    /// Field of view, aspect, near and far in floats.
    PerspectiveFloats([f32; 4]),
    /// A camera that sees the origin: angle about y, distance in eighths.
    Camera(u16, u8),
}

/// A rotation about one of three axes.
fn turn(axis: u8, by: SinCos) -> Mat4 {
    match axis % 3 {
        0 => Mat4::rotation_x(by),
        1 => Mat4::rotation_y(by),
        _ => Mat4::rotation_z(by),
    }
}

/// A camera in the distance.
fn camera(angle: u16, distance: u8) -> Option<Mat4> {
    let eighth = I16F16::from_num(0.125);
    let distance = eighth * i32::from(distance);
    let near = eighth;
    let perspective =
        Mat4::perspective(I16F16::from_num(1.5), I16F16::ONE, near, I16F16::from_num(50)).ok()?;
    let back = Mat4::translation([I16F16::ZERO, I16F16::ZERO, -distance]);
    let turn = Mat4::rotation_y(Angle(angle).sin_cos());
    perspective.times(&back).ok()?.times(&turn).ok()
}

impl Step {
    /// The matrix, if the library makes one of these numbers.
    ///
    /// # Panics
    ///
    /// Where the library takes entries out of its range, or refuses some in range.
    #[must_use]
    pub fn matrix(&self) -> Option<Mat4> {
        match *self {
            Self::Rows(raw) => {
                let rows = raw.map(|row| row.map(Raw::fixed));
                let limit = 8192i64 << 16;
                let fits = raw.iter().all(|row| {
                    row[..3].iter().all(|v| i64::from(v.0).abs() <= limit) && row[3].0 != i32::MIN
                });
                let matrix = Mat4::from_rows(rows);
                assert_eq!(matrix.map(|m| m.rows()).ok(), fits.then_some(rows));
                matrix.ok()
            }
            Self::Small(raw) => Mat4::from_rows(raw.map(|row| row.map(I16F16::from))).ok(),
            Self::LookAt([eye, target, up]) => {
                Mat4::look_at(vector(eye), vector(target), vector(up)).ok()
            }
            Self::Perspective(raw) => {
                let [focal, aspect, near, far] = raw.map(Raw::fixed);
                Mat4::perspective(focal, aspect, near, far).ok()
            }
            Self::Translation(by) => Some(Mat4::translation(vector(by))),
            Self::Scaling(by) => Mat4::scaling(vector(by)).ok(),
            Self::Turn(axis, angle) => Some(turn(axis, Angle(angle).sin_cos())),
            Self::SinCos(axis, [sin, cos]) => {
                Some(turn(axis, SinCos { sin: sin.fixed(), cos: cos.fixed() }))
            }
            Self::Radians(axis, angle) => Some(turn(axis, SinCos::from_radians(angle).ok()?)),
            Self::Floats(rows) => Mat4::from_f32(rows).ok(),
            Self::PerspectiveFloats([fov, aspect, near, far]) => {
                Mat4::perspective_f32(fov, aspect, near, far).ok()
            }
            Self::Camera(angle, distance) => camera(angle, distance),
        }
    }
}

/// The product of up to four of them: those that cannot be made are left out. `None` where no
/// matrix is left.
#[must_use]
pub fn product(steps: &[Step]) -> Option<Mat4> {
    let matrices = steps.iter().take(4).filter_map(Step::matrix);
    matrices.reduce(|product, matrix| product.times(&matrix).unwrap_or(matrix))
}
