//! Snapped vertices as the oracle takes them.

use hither::Snapped;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive};

use crate::oracle::{RationalVertex, Vertex, Viewport};

/// A snapped vertex in pixel space, `(W (x + w), H (w - y), 2 w)` or a positive multiple of it.
#[must_use]
pub fn in_pixels(snapped: Snapped, viewport: Viewport) -> Vertex {
    match snapped {
        Snapped::Homogeneous { point, .. } => {
            let [x, y, w] = point.map(i64::from);
            let (width, height) = (i64::from(viewport.width), i64::from(viewport.height));
            [width * (x + w), height * (w - y), 2 * w]
        }
        Snapped::Projected { point: [x, y], subpixel_bits } => {
            [i64::from(x), i64::from(y), 1 << subpixel_bits]
        }
    }
}

/// `k`, by which [`in_pixels`] is larger than `(X w, Y w, w)` of the true vertex, whose `w` is raw
/// and which is at `(X, Y)` pixels.
#[must_use]
pub fn scale(snapped: Snapped, w: i64) -> BigRational {
    match snapped {
        Snapped::Homogeneous { shift, .. } => power_of_two(shift + 1),
        Snapped::Projected { subpixel_bits, .. } => {
            power_of_two(subpixel_bits as i32) / BigInt::from(w)
        }
    }
}

/// A snapped vertex in clip space, in the units of the true one, whose `w` is raw.
#[must_use]
pub fn in_clip(snapped: Snapped, viewport: Viewport, w: i64) -> RationalVertex {
    let k = scale(snapped, w);
    let [x, y, w] = in_pixels(snapped, viewport).map(|v| BigRational::from_integer(v.into()) / &k);
    let two = BigInt::from(2);
    [x * &two / BigInt::from(viewport.width) - &w, &w - y * &two / BigInt::from(viewport.height), w]
}

/// How far a snapped vertex is from the true one `[x, y, w]`, in grid units: the largest of its
/// coordinates.
#[must_use]
pub fn distance(snapped: Snapped, [x, y, w]: Vertex, viewport: Viewport) -> f64 {
    let k = scale(snapped, w) / BigInt::from(2);
    let off = |snapped: i64, exact: BigRational| {
        let off = BigRational::from_integer(snapped.into()) - exact;
        off.to_f64().unwrap_or(f64::NAN).abs()
    };
    let offs = match snapped {
        Snapped::Homogeneous { point, .. } => {
            let [sx, sy, sw] = point.map(i64::from);
            [(sx, x), (sy, y), (sw, w)].map(|(s, v)| off(s, &k * BigInt::from(v)))
        }
        Snapped::Projected { point, .. } => {
            let [sx, sy] = point.map(i64::from);
            let across = &k * BigInt::from(viewport.width) * BigInt::from(x + w);
            let down = &k * BigInt::from(viewport.height) * BigInt::from(w - y);
            [off(sx, across), off(sy, down), 0.0]
        }
    };
    offs.into_iter().fold(0.0, f64::max)
}

/// `2^exponent`.
#[must_use]
pub fn power_of_two(exponent: i32) -> BigRational {
    let power = BigInt::one() << exponent.unsigned_abs();
    if exponent < 0 {
        BigRational::new(BigInt::one(), power)
    } else {
        BigRational::from_integer(power)
    }
}

/// Where a snapped vertex is on the screen, in pixels.
#[must_use]
pub fn on_screen(snapped: Snapped, viewport: Viewport) -> [f64; 2] {
    let [x, y, w] = in_pixels(snapped, viewport).map(|v| v as f64);
    [x / w, y / w]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rational(numerator: i64, denominator: i64) -> BigRational {
        BigRational::new(numerator.into(), denominator.into())
    }

    const VIEWPORT: Viewport = Viewport::new(16, 8);

    #[test]
    fn homogeneous_points_are_shifted_back() {
        let snapped = Snapped::Homogeneous { point: [6, -10, 4], shift: 2 };
        let clip = in_clip(snapped, VIEWPORT, 1);
        assert_eq!(clip, [rational(3, 2), rational(-5, 2), rational(1, 1)]);
        assert_eq!(in_pixels(snapped, VIEWPORT), [160, 112, 8]);
        assert_eq!(distance(snapped, [1, -3, 1], VIEWPORT), 2.0);
    }

    #[test]
    fn projected_points_have_the_w_of_the_vertex() {
        // 12 of 16 pixels from the left is x = w / 2; 2 of 8 from the top is y = w / 2.
        let snapped = Snapped::Projected { point: [12 * 16, 2 * 16], subpixel_bits: 4 };
        let clip = in_clip(snapped, VIEWPORT, 10);
        assert_eq!(clip, [rational(5, 1), rational(5, 1), rational(10, 1)]);
        assert_eq!(distance(snapped, [5, 5, 10], VIEWPORT), 0.0);
        // 1/320 of the screen is 1/20 of a pixel, 0.8 of a subpixel.
        let off = distance(snapped, [501, 500, 1000], VIEWPORT);
        assert!((off - 0.128).abs() < 1e-9, "{off}");
    }
}
