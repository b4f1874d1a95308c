//! Viewports, spaces, parts, and integer linear functions over the pixels of a viewport.

use std::ops::{Add, Mul, Neg, Sub};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// A homogeneous vertex `(x, y, w)` in whole units of one scale (any scale: it cancels).
pub type Vertex = [i64; 3];

/// A homogeneous vertex `(x, y, w)` of exact rationals.
pub type RationalVertex = [BigRational; 3];

/// The size of the screen, in pixels; pixel `(0, 0)` is its top left one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Viewport {
    /// Pixels in a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
}

impl Viewport {
    /// A viewport of `width` x `height` pixels.
    #[must_use]
    pub const fn new(width: u32, height: u32) -> Self {
        Self { width, height }
    }

    /// All pixels `(x, y)`, row by row from the top.
    pub fn pixels(self) -> impl Iterator<Item = (u32, u32)> {
        (0..self.height).flat_map(move |y| (0..self.width).map(move |x| (x, y)))
    }

    /// The direction of pixel `(x, y)`'s centre in clip space: `(x_ndc, y_ndc, 1) * W * H`, whole.
    #[must_use]
    pub fn direction(self, x: u32, y: u32) -> [i64; 3] {
        let (w, h) = (i64::from(self.width), i64::from(self.height));
        [(2 * i64::from(x) + 1 - w) * h, (h - 2 * i64::from(y) - 1) * w, w * h]
    }
}

/// The space a triangle's vertices `(x, y, w)` are given in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// NDC is `x/w, y/w`, y up.
    Clip,
    /// The place on the screen is `x/w, y/w` in pixels from the top left corner, y down.
    Pixel,
}

/// Which part of an external triangle is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The part in front of the eye (`w > 0`).
    Front,
    /// The part behind the eye (`w < 0`), seen through it.
    Behind,
}

impl Part {
    /// Both parts, in the order they are listed.
    pub const ALL: [Self; 2] = [Self::Front, Self::Behind];
}

/// Three whole numbers as rationals.
#[must_use]
pub fn whole(values: [i64; 3]) -> [BigRational; 3] {
    values.map(|value| BigRational::from_integer(value.into()))
}

/// The cross product `a x b`.
pub(super) fn cross<T>(a: &[T; 3], b: &[T; 3]) -> [T; 3]
where
    T: Sub<Output = T>,
    for<'a> &'a T: Mul<&'a T, Output = T>,
{
    [&a[1] * &b[2] - &a[2] * &b[1], &a[2] * &b[0] - &a[0] * &b[2], &a[0] * &b[1] - &a[1] * &b[0]]
}

/// The dot product `a . b`.
pub(super) fn dot<T>(a: &[T; 3], b: &[T; 3]) -> T
where
    T: Add<Output = T>,
    for<'a> &'a T: Mul<&'a T, Output = T>,
{
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

/// The rows of the adjugate of the matrix with the three vertices as columns: row `i` is zero on
/// the edge opposite to vertex `i`, and is the determinant at vertex `i`.
pub(super) fn adjugate<T>(vertices: &[[T; 3]; 3]) -> [[T; 3]; 3]
where
    T: Sub<Output = T>,
    for<'a> &'a T: Mul<&'a T, Output = T>,
{
    let [v0, v1, v2] = vertices;
    [cross(v1, v2), cross(v2, v0), cross(v0, v1)]
}

/// The coefficients `[A, B, C]` of `scale * row . P` as a function `A (2X+1) + B (2Y+1) + C` of the
/// pixel, `scale` being [`pixel_scale`]. Derivation, clip space: `P = (x_ndc, y_ndc, 1)` times
/// `W H` is `((2X+1-W) H, (H-(2Y+1)) W, W H)`; pixel space: `P = (X+1/2, Y+1/2, 1)` times 2 is
/// `(2X+1, 2Y+1, 2)`.
pub(super) fn over_pixels<T>(row: &[T; 3], space: Space, viewport: Viewport) -> [T; 3]
where
    T: Clone + From<i64> + Add<Output = T> + Sub<Output = T> + Neg<Output = T>,
    for<'a> &'a T: Mul<&'a T, Output = T>,
{
    let [a, b, c] = row;
    match space {
        Space::Clip => {
            let width = T::from(i64::from(viewport.width));
            let height = T::from(i64::from(viewport.height));
            let centre = c.clone() - a.clone() + b.clone();
            [a * &height, -(b * &width), &(&centre * &width) * &height]
        }
        Space::Pixel => [a.clone(), b.clone(), c * &T::from(2)],
    }
}

/// The positive factor that [`over_pixels`] puts on `row . P`.
pub(super) fn pixel_scale(space: Space, viewport: Viewport) -> i64 {
    match space {
        Space::Clip => i64::from(viewport.width) * i64::from(viewport.height),
        Space::Pixel => 2,
    }
}

/// The least whole multiple of a rational vertex by a positive number, and that number.
pub(super) fn to_whole(vertex: &[BigRational; 3]) -> ([BigInt; 3], BigRational) {
    let mut denominator = BigInt::one();
    for value in vertex {
        denominator *= value.denom() / gcd(&denominator, value.denom());
    }
    let mut integers = vertex.clone().map(|value| (value * &denominator).to_integer());
    let divisor = gcd(&gcd(&integers[0], &integers[1]), &integers[2]);
    if !divisor.is_zero() {
        integers.iter_mut().for_each(|value| *value /= &divisor);
        return (integers, BigRational::new(denominator, divisor));
    }
    (integers, BigRational::from_integer(denominator))
}

/// The greatest common divisor of two whole numbers, 0 where both are 0 (Euclid).
fn gcd(a: &BigInt, b: &BigInt) -> BigInt {
    let (mut a, mut b) = (a.abs(), b.abs());
    while !b.is_zero() {
        (a, b) = (b.clone(), a % b);
    }
    a
}

/// A linear function `A (2X+1) + B (2Y+1) + C` over the pixels with whole coefficients `[A, B, C]`.
#[derive(Clone, Debug)]
pub(super) enum Form {
    /// Coefficients below 2^100 in magnitude: over pixels below 2^16 (so `2X+1 < 2^17`) each
    /// product is below 2^117 and the sum below 2^119.
    Narrow([i128; 3]),
    /// Any coefficients.
    Wide([BigInt; 3]),
}

impl Form {
    /// The narrow form where it fits.
    pub(super) fn new(coefficients: [BigInt; 3]) -> Self {
        if coefficients.iter().all(|value| value.bits() <= 100) {
            let narrow = coefficients.clone().map(|value| value.to_i128().unwrap_or_default());
            return Self::Narrow(narrow);
        }
        Self::Wide(coefficients)
    }

    /// The function whose value is the sum of `weights[i]` times `forms[i]`.
    pub(super) fn combination(forms: &[[BigInt; 3]; 3], weights: &[BigInt; 3]) -> Self {
        let column = |j: usize| (0..3).map(|i| &forms[i][j] * &weights[i]).sum();
        Self::new([column(0), column(1), column(2)])
    }

    /// The sign of the value at pixel `(x, y)`: -1, 0 or 1.
    pub(super) fn sign_at(&self, x: u32, y: u32) -> i32 {
        match self {
            Self::Narrow(form) => narrow_at(form, x, y).signum() as i32,
            Self::Wide(form) => match wide_at(form, x, y) {
                value if value.is_positive() => 1,
                value if value.is_negative() => -1,
                _ => 0,
            },
        }
    }

    /// The exact value at pixel `(x, y)`.
    pub(super) fn at(&self, x: u32, y: u32) -> BigInt {
        match self {
            Self::Narrow(form) => narrow_at(form, x, y).into(),
            Self::Wide(form) => wide_at(form, x, y),
        }
    }

    /// The value at pixel `(x, y)`, rounded once.
    pub(super) fn at_f64(&self, x: u32, y: u32) -> f64 {
        match self {
            Self::Narrow(form) => narrow_at(form, x, y) as f64,
            Self::Wide(form) => wide_at(form, x, y).to_f64().unwrap_or(f64::NAN),
        }
    }
}

fn narrow_at(form: &[i128; 3], x: u32, y: u32) -> i128 {
    debug_assert!(x < 1 << 16 && y < 1 << 16, "pixel ({x}, {y}) is past the proof");
    form[0] * (2 * i128::from(x) + 1) + form[1] * (2 * i128::from(y) + 1) + form[2]
}

fn wide_at(form: &[BigInt; 3], x: u32, y: u32) -> BigInt {
    &form[0] * (2 * u64::from(x) + 1) + &form[1] * (2 * u64::from(y) + 1) + &form[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rational(numerator: i64, denominator: i64) -> BigRational {
        BigRational::new(numerator.into(), denominator.into())
    }

    #[test]
    fn a_rational_vertex_becomes_the_least_whole_one() {
        let vertex = [rational(1, 6), rational(-3, 4), rational(0, 1)];
        let (integers, factor) = to_whole(&vertex);
        assert_eq!(integers, [2, -9, 0].map(BigInt::from));
        assert_eq!(factor, rational(12, 1));

        let (integers, factor) = to_whole(&whole([-6, 4, 10]));
        assert_eq!(integers, [-3, 2, 5].map(BigInt::from));
        assert_eq!(factor, rational(1, 2));

        let (integers, _) = to_whole(&whole([0, 0, 0]));
        assert_eq!(integers, [0, 0, 0].map(BigInt::from));
    }

    #[test]
    fn a_row_over_pixels_is_the_row_at_the_centre() {
        let viewport = Viewport::new(5, 3);
        let row = [3_i128, -7, 11];
        for (x, y) in viewport.pixels() {
            let clip = over_pixels(&row, Space::Clip, viewport);
            let direction = viewport.direction(x, y).map(i128::from);
            assert_eq!(narrow_at(&clip, x, y), dot(&row, &direction));

            let pixel = over_pixels(&row, Space::Pixel, viewport);
            let centre = [2 * i128::from(x) + 1, 2 * i128::from(y) + 1, 2];
            assert_eq!(narrow_at(&pixel, x, y), dot(&row, &centre));
        }
    }

    #[test]
    fn narrow_and_wide_forms_agree() {
        let small = [BigInt::from(-5), BigInt::from(7), BigInt::from(-2)];
        let narrow = Form::new(small.clone());
        assert!(matches!(narrow, Form::Narrow(_)));
        let wide = Form::Wide(small);
        for (x, y) in Viewport::new(6, 6).pixels() {
            assert_eq!(narrow.at(x, y), wide.at(x, y));
            assert_eq!(narrow.sign_at(x, y), wide.sign_at(x, y));
            assert_eq!(narrow.at_f64(x, y), wide.at_f64(x, y));
        }
        let large: BigInt = BigInt::from(1) << 100;
        assert!(matches!(Form::new([large.clone(), large.clone(), large]), Form::Wide(_)));
    }

    #[test]
    fn directions_name_pixel_centres_from_the_top_left() {
        let viewport = Viewport::new(2, 4);
        assert_eq!(viewport.direction(0, 0), [-4, 6, 8]);
        assert_eq!(viewport.direction(1, 3), [4, -6, 8]);
    }
}
