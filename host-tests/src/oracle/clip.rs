//! On which side of a clip plane the surface at a pixel lies, by exact arithmetic.
//!
//! Row `i` of the vertex matrix is `k_i (x_i, y_i, w_i)` (up to snapping), so the surface point
//! that is seen at pixel `P` is `sum(k_i E_i p_i) / sum(k_i E_i)` with `E_i = e_i . P`, and a
//! plane's value there is `sum(k_i E_i c_i) / sum(k_i E_i)` with `c_i = n . p_i`.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::interpolate::Surface;
use super::linear::Form;

/// Where the surface at a pixel lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaneSide {
    /// Farther inside than the band: the pixel must be kept.
    Inside,
    /// Within the band, its ends included: the pixel may fall either way.
    Near,
    /// Farther outside than the band: the pixel must not be drawn.
    Outside,
}

/// The exact value of a plane over the surface of a triangle.
#[derive(Clone, Debug)]
pub struct PlaneFunction {
    numerator: Form,
    denominator: Form,
    /// Multiplies `numerator / denominator`; positive.
    factor: BigRational,
    /// The contract's band, in units of `numerator / denominator`.
    band: BigRational,
    largest: BigRational,
}

impl PlaneFunction {
    /// The plane that is `values[i]` = `n . p_i` at the true vertex `i`.
    #[must_use]
    pub fn new(surface: &Surface, values: &[BigRational; 3]) -> Self {
        let (numerator, above) = surface.combination(values);
        let (denominator, below) = surface.combination(&super::whole([1, 1, 1]));
        let largest = values.iter().map(Signed::abs).max().unwrap_or_else(BigRational::zero);
        let factor = above / below;
        Self {
            numerator,
            denominator,
            band: &largest / BigInt::from(1 << 12) / &factor,
            factor,
            largest,
        }
    }

    /// The largest magnitude of the plane at a vertex, `max |n . p_i|`.
    #[must_use]
    pub fn largest(&self) -> &BigRational {
        &self.largest
    }

    /// The plane's value `n . p` at the surface point seen at pixel `(x, y)`, in the units of the
    /// vertices' values. `None` where the surface goes to infinity, which is at no covered pixel.
    #[must_use]
    pub fn value(&self, x: u32, y: u32) -> Option<BigRational> {
        let denominator = self.denominator.at(x, y);
        if denominator.is_zero() {
            return None;
        }
        Some(BigRational::new(self.numerator.at(x, y), denominator) * &self.factor)
    }

    /// The side at pixel `(x, y)`, with the contract's band of 2^-12 of [`Self::largest`].
    #[must_use]
    pub fn side(&self, x: u32, y: u32) -> Option<PlaneSide> {
        self.side_of_quotient(x, y, &self.band)
    }

    /// The side at pixel `(x, y)`, with a band of `band` units of the plane's value on either side.
    #[must_use]
    pub fn side_within(&self, x: u32, y: u32, band: &BigRational) -> Option<PlaneSide> {
        self.side_of_quotient(x, y, &(band / &self.factor))
    }

    /// The side with a band in units of `numerator / denominator`, compared without a division.
    fn side_of_quotient(&self, x: u32, y: u32, band: &BigRational) -> Option<PlaneSide> {
        let (numerator, denominator) = (self.numerator.at(x, y), self.denominator.at(x, y));
        if denominator.is_zero() {
            return None;
        }
        let is_positive = numerator.is_positive() == denominator.is_positive();
        let near = numerator.abs() * band.denom() <= denominator.abs() * band.numer();
        Some(match (near, is_positive) {
            (true, _) => PlaneSide::Near,
            (false, true) => PlaneSide::Inside,
            (false, false) => PlaneSide::Outside,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::{
        Category, ExactTriangle, Part, Rng, Space, Viewport, random_viewport, triangle, whole,
    };

    fn rational(numerator: i64, denominator: i64) -> BigRational {
        BigRational::new(numerator.into(), denominator.into())
    }

    /// A floor 1 below the eye: at row centre `y_ndc` the surface has `w = -1 / y_ndc`.
    const FLOOR: [[i64; 3]; 3] = [[-4000, -1, -1000], [4000, -1, -1000], [0, -1, 1000]];

    #[test]
    fn the_distance_along_a_floor_is_a_reciprocal() {
        let viewport = Viewport::new(16, 16);
        let surface = Surface::new(FLOOR, viewport).expect("not degenerate");
        let plane = PlaneFunction::new(&surface, &whole(FLOOR.map(|[_, _, w]| w)));
        let covered = ExactTriangle::new(FLOOR, viewport, Part::Front);
        assert_eq!(covered.pixels().len(), 16 * 8);
        for (x, y) in covered.pixels() {
            let below = i64::from(2 * y + 1 - 16);
            assert_eq!(plane.value(x, y), Some(rational(16, below)));
        }
    }

    #[test]
    fn a_hither_plane_keeps_what_is_beyond_it() {
        let viewport = Viewport::new(16, 16);
        let surface = Surface::new(FLOOR, viewport).expect("not degenerate");
        // w >= 16/5: met exactly in row 10, whose centre is 5/16 below the middle.
        let hither = rational(16, 5);
        let values = whole(FLOOR.map(|[_, _, w]| w)).map(|w| w - &hither);
        let plane = PlaneFunction::new(&surface, &values);
        let thin = rational(1, 1_000_000);
        for x in 0..16 {
            assert_eq!(plane.side_within(x, 9, &thin), Some(PlaneSide::Inside));
            assert_eq!(plane.side_within(x, 10, &thin), Some(PlaneSide::Near));
            assert_eq!(plane.side_within(x, 11, &thin), Some(PlaneSide::Outside));
        }
        assert_eq!(plane.largest(), &rational(5016, 5));
        // 5016/5/4096 is 0.245 units: row 8 (w = 16) is far inside, row 15 (w = 16/15) far outside.
        assert_eq!(plane.side(0, 8), Some(PlaneSide::Inside));
        assert_eq!(plane.side(0, 10), Some(PlaneSide::Near));
        assert_eq!(plane.side(0, 15), Some(PlaneSide::Outside));
    }

    #[test]
    fn the_scale_of_a_vertex_does_not_matter() {
        let viewport = Viewport::new(9, 7);
        let values = [rational(3, 1), rational(-1, 2), rational(5, 3)];
        let plain = Surface::new(FLOOR, viewport).expect("not degenerate");
        let plain = PlaneFunction::new(&plain, &values);
        let scales = [rational(1, 7), rational(12, 1), rational(5, 2)];
        let scaled = [0, 1, 2].map(|i| whole(FLOOR[i]).map(|value| value * &scales[i]));
        let scaled = Surface::from_rationals(&scaled, &scales, Space::Clip, viewport);
        let scaled = PlaneFunction::new(&scaled.expect("not degenerate"), &values);
        for (x, y) in viewport.pixels() {
            assert_eq!(plain.value(x, y), scaled.value(x, y));
        }
    }
    #[test]
    fn the_side_is_the_side_of_the_value() {
        let mut rng = Rng::new(13);
        let mut seen = [0; 3];
        for round in 0..600 {
            let category = Category::ALL[round % Category::ALL.len()];
            let viewport = random_viewport(&mut rng);
            let corners = triangle(category, viewport, &mut rng);
            let Some(surface) = Surface::new(corners, viewport) else {
                continue;
            };
            let values = whole([(); 3].map(|()| rng.signed(1 << 30)));
            let plane = PlaneFunction::new(&surface, &values);
            let band = plane.largest() / BigInt::from(rng.choose(&[2, 16, 4096]));
            for _ in 0..8 {
                let x = rng.below(u64::from(viewport.width)) as u32;
                let y = rng.below(u64::from(viewport.height)) as u32;
                let expected = plane.value(x, y).map(|value| match value {
                    value if value > band => PlaneSide::Inside,
                    value if value < -&band => PlaneSide::Outside,
                    _ => PlaneSide::Near,
                });
                assert_eq!(plane.side_within(x, y, &band), expected, "{corners:?} {x} {y}");
                if let Some(side) = expected {
                    seen[side as usize] += 1;
                }
            }
        }
        assert!(seen.iter().all(|&count| count > 100), "{seen:?}");
    }
}
