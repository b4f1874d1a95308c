//! Attributes, `1/w` and depth at a pixel: exact integers up to the last division, which is in
//! `f64`.
//!
//! Row `i` of the vertex matrix is `k_i (x_i, y_i, w_i)` with `k_i > 0` (up to snapping). Then
//! `P = sum(E_i / d * row_i)` with `E_i = e_i . P`, and with `S(c) = sum(k_i c_i E_i) / d`, linear
//! on the screen: `1/w = S(1)`, `z/w = S(z)`, an attribute is `S(u) / S(1)`, and `S(w u)` is `u`
//! interpolated without perspective.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use super::linear::{Form, adjugate, dot, over_pixels, pixel_scale, to_whole};
use super::{RationalVertex, Space, Vertex, Viewport, whole};

/// A triangle prepared for interpolation over the pixels of a viewport.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Row `i` over the pixels: `scale * e_i . P`.
    edges: [[BigInt; 3]; 3],
    /// `k_i`, by which row `i` of the matrix is larger than the true vertex.
    scales: [BigRational; 3],
    /// `scale * det M`.
    divisor: BigInt,
}

impl Surface {
    /// A triangle with clip-space vertices `(x, y, w)` in whole units; `w` in those units is what
    /// `1/w` is of. `None` where the determinant is 0.
    #[must_use]
    pub fn new(vertices: [Vertex; 3], viewport: Viewport) -> Option<Self> {
        let scales = whole([1, 1, 1]);
        Self::from_rationals(&vertices.map(whole), &scales, Space::Clip, viewport)
    }

    /// A triangle whose matrix row `i` is `vertices[i]`, which is (up to snapping) `scales[i]`
    /// times the true vertex. `None` where the determinant is 0.
    #[must_use]
    pub fn from_rationals(
        vertices: &[RationalVertex; 3],
        scales: &[BigRational; 3],
        space: Space,
        viewport: Viewport,
    ) -> Option<Self> {
        let integers = vertices.each_ref().map(to_whole);
        let scales = [0, 1, 2].map(|i| &scales[i] * &integers[i].1);
        let matrix = integers.map(|(vertex, _)| vertex);
        let rows = adjugate(&matrix);
        let divisor = dot(&rows[0], &matrix[0]) * pixel_scale(space, viewport);
        if divisor.is_zero() {
            return None;
        }
        Some(Self { edges: rows.map(|row| over_pixels(&row, space, viewport)), scales, divisor })
    }

    /// The whole function and the factor whose product is `S(values) * scale * d`.
    pub(super) fn combination(&self, values: &[BigRational; 3]) -> (Form, BigRational) {
        let weights = [0, 1, 2].map(|i| &values[i] * &self.scales[i]);
        let (weights, factor) = to_whole(&weights);
        (Form::combination(&self.edges, &weights), factor.recip())
    }

    /// `S(values) = sum(k_i values[i] E_i) / d`, linear on the screen.
    #[must_use]
    pub fn linear(&self, values: &[BigRational; 3]) -> ScreenFunction {
        let (form, factor) = self.combination(values);
        let factor = factor / &self.divisor;
        let factor_f64 = factor.to_f64().unwrap_or(f64::NAN);
        ScreenFunction { form, factor, factor_f64 }
    }

    /// `1/w` of the surface; negative on the part behind the eye.
    #[must_use]
    pub fn reciprocal_w(&self) -> ScreenFunction {
        self.linear(&whole([1, 1, 1]))
    }

    /// Depth `z/w`: 0 on the hither plane, 1 at far; `z` in the units of `w`, at the true vertices.
    #[must_use]
    pub fn depth(&self, z: &[BigRational; 3]) -> ScreenFunction {
        self.linear(z)
    }

    /// The perspective-correct attribute that is `u[i]` at vertex `i`.
    #[must_use]
    pub fn attribute(&self, u: &[BigRational; 3]) -> PerspectiveFunction {
        let (numerator, above) = self.combination(u);
        let (denominator, below) = self.combination(&whole([1, 1, 1]));
        let factor = (above / below).to_f64().unwrap_or(f64::NAN);
        PerspectiveFunction { numerator, denominator, factor }
    }

    /// The attribute that is `u[i]` where vertex `i` is on the screen, interpolated straight over
    /// the screen; `w[i]` are the true vertices' (meaningful where all are positive).
    #[must_use]
    pub fn affine(&self, u: &[BigRational; 3], w: &[BigRational; 3]) -> ScreenFunction {
        self.linear(&[0, 1, 2].map(|i| &u[i] * &w[i]))
    }
}

/// A function that is linear on the screen, known exactly.
#[derive(Clone, Debug)]
pub struct ScreenFunction {
    form: Form,
    factor: BigRational,
    factor_f64: f64,
}

impl ScreenFunction {
    /// The value at the centre of pixel `(x, y)`; relative error at most 2^-51 (three roundings).
    #[must_use]
    pub fn at(&self, x: u32, y: u32) -> f64 {
        self.form.at_f64(x, y) * self.factor_f64
    }

    /// The exact value at the centre of pixel `(x, y)`.
    #[must_use]
    pub fn exact(&self, x: u32, y: u32) -> BigRational {
        BigRational::from_integer(self.form.at(x, y)) * &self.factor
    }
}

/// The quotient of two functions that are linear on the screen, both known exactly.
#[derive(Clone, Debug)]
pub struct PerspectiveFunction {
    numerator: Form,
    denominator: Form,
    factor: f64,
}

impl PerspectiveFunction {
    /// The value at the centre of pixel `(x, y)`; relative error at most 2^-50 (five roundings).
    /// Not finite where the surface goes to infinity, which is at no covered pixel.
    #[must_use]
    pub fn at(&self, x: u32, y: u32) -> f64 {
        self.numerator.at_f64(x, y) / self.denominator.at_f64(x, y) * self.factor
    }
}

/// The scale `k` for which `k * given` is nearest to `snapped` (least squares): exact where the
/// snapped vertex is a multiple of the given one, else off by as much as the vertex was moved,
/// relative to its length. 1 for a zero vertex.
#[must_use]
pub fn scale_of(snapped: &RationalVertex, given: &RationalVertex) -> BigRational {
    let length = dot(given, given);
    if length.is_zero() {
        return BigRational::one();
    }
    dot(snapped, given) / length
}

#[cfg(test)]
mod tests {
    use num_traits::Signed;

    use super::*;
    use crate::oracle::{Category, ExactTriangle, Part, Rng, random_viewport, triangle};

    fn rational(numerator: i64, denominator: i64) -> BigRational {
        BigRational::new(numerator.into(), denominator.into())
    }

    fn near(a: f64, b: f64, relative: f64) -> bool {
        (a - b).abs() <= relative * a.abs().max(b.abs())
    }

    #[test]
    fn a_wall_facing_the_eye_interpolates_straight() {
        // Pixel (X, Y) of 8 x 8 has x_ndc = (2X+1)/8 - 1; the attribute is x_ndc + 2 y_ndc, times
        // 8.
        let viewport = Viewport::new(8, 8);
        let corners = [[-4, -4, 4], [4, -4, 4], [-4, 4, 4]];
        let surface = Surface::new(corners, viewport).expect("not degenerate");
        let u = whole([-24, -8, 8]);
        let affine = surface.affine(&u, &whole([4, 4, 4]));
        let depth = surface.depth(&whole([1, 2, 3]));
        for (x, y) in viewport.pixels() {
            let (right, up) = (2.0 * f64::from(x) - 7.0, 7.0 - 2.0 * f64::from(y));
            assert_eq!(surface.attribute(&u).at(x, y), right + 2.0 * up);
            assert_eq!(affine.at(x, y), right + 2.0 * up);
            assert_eq!(surface.reciprocal_w().exact(x, y), rational(1, 4));
            let expected = ((right + 8.0) / 16.0 + 2.0 * (up + 8.0) / 16.0 + 1.0) / 4.0;
            assert_eq!(depth.at(x, y), expected);
        }
    }

    #[test]
    fn a_floor_has_the_attributes_of_its_own_coordinates() {
        // On a floor 1 below the eye, the point under y_ndc has w = -1/y_ndc and x = x_ndc * w.
        let viewport = Viewport::new(12, 10);
        let corners = [[-900, -1, 1], [900, -1, 1], [0, -1, 500]];
        let surface = Surface::new(corners, viewport).expect("not degenerate");
        let (along, across) = (whole([1, 1, 500]), whole([-900, 900, 0]));
        let mut seen = 0;
        for (x, y) in ExactTriangle::new(corners, viewport, Part::Front).pixels() {
            let x_ndc = f64::from(2 * x + 1) / 12.0 - 1.0;
            let y_ndc = 1.0 - f64::from(2 * y + 1) / 10.0;
            assert!(near(surface.attribute(&along).at(x, y), -1.0 / y_ndc, 1e-14));
            let error = surface.attribute(&across).at(x, y) + x_ndc / y_ndc;
            assert!(error.abs() < 1e-13);
            assert!(near(surface.reciprocal_w().at(x, y), -y_ndc, 1e-14));
            seen += 1;
        }
        assert_eq!(seen, 60);
    }

    #[test]
    fn the_affine_reference_meets_the_attribute_at_the_vertices() {
        // Vertices on the centres of pixels (0, 0), (3, 0) and (0, 3) of 4 x 4, with three
        // different w.
        let viewport = Viewport::new(4, 4);
        let corners = [[-3, 3, 4], [30, 30, 40], [-75, -75, 100]];
        let surface = Surface::new(corners, viewport).expect("not degenerate");
        let u = [rational(7, 3), rational(-5, 1), rational(1, 9)];
        let affine = surface.affine(&u, &whole([4, 40, 100]));
        for (i, (x, y)) in [(0, 0), (3, 0), (0, 3)].into_iter().enumerate() {
            assert_eq!(affine.exact(x, y), u[i]);
            assert!(near(surface.attribute(&u).at(x, y), u[i].to_f64().expect("finite"), 1e-14));
        }
        // A third of the way along the top edge the affine value is a third of the way.
        assert_eq!(affine.exact(1, 0), (&u[0] * rational(2, 1) + &u[1]) / rational(3, 1));
    }

    #[test]
    fn pixel_space_and_clip_space_say_the_same() {
        let viewport = Viewport::new(30, 20);
        let corners = [[-30, -17, 40], [50, 11, 60], [1, 70, 70]];
        let to_pixels = |[x, y, w]: [i64; 3]| [30 * (x + w), 20 * (w - y), 2 * w];
        let clip = Surface::new(corners, viewport).expect("not degenerate");
        let twice = whole([2, 2, 2]);
        let pixel = corners.map(|corner| whole(to_pixels(corner)));
        let pixel = Surface::from_rationals(&pixel, &twice, Space::Pixel, viewport);
        let pixel = pixel.expect("not degenerate");
        let z = whole([5, -6, 7]);
        for (x, y) in viewport.pixels() {
            assert_eq!(clip.depth(&z).exact(x, y), pixel.depth(&z).exact(x, y));
            assert_eq!(clip.reciprocal_w().exact(x, y), pixel.reciprocal_w().exact(x, y));
        }
    }

    #[test]
    fn attributes_stay_between_the_vertices_values_on_nasty_triangles() {
        let mut rng = Rng::new(11);
        for round in 0..400 {
            let category = Category::ALL[round % Category::ALL.len()];
            let viewport = random_viewport(&mut rng);
            let corners = triangle(category, viewport, &mut rng);
            let Some(surface) = Surface::new(corners, viewport) else {
                continue;
            };
            let part = Part::ALL[round & 1];
            let exact = ExactTriangle::new(corners, viewport, part);
            let attribute = surface.attribute(&whole([-3, 5, 40]));
            let reciprocal_w = surface.reciprocal_w();
            for _ in 0..50 {
                let x = rng.below(u64::from(viewport.width)) as u32;
                let y = rng.below(u64::from(viewport.height)) as u32;
                if exact.covers(x, y) {
                    let value = attribute.at(x, y);
                    assert!((-3.0..=40.0).contains(&value), "{corners:?} {x} {y} {value}");
                    let ahead = reciprocal_w.at(x, y) > 0.0;
                    assert_eq!(ahead, part == Part::Front, "{corners:?} {x} {y}");
                }
            }
        }
    }

    #[test]
    fn the_last_roundings_are_as_small_as_stated() {
        let mut rng = Rng::new(14);
        for round in 0..300 {
            let category = Category::ALL[round % Category::ALL.len()];
            let viewport = random_viewport(&mut rng);
            let corners = triangle(category, viewport, &mut rng);
            let Some(surface) = Surface::new(corners, viewport) else {
                continue;
            };
            let u = [(); 3].map(|()| rational(rng.signed(1 << 40), rng.magnitude(1 << 20)));
            let (linear, attribute) = (surface.linear(&u), surface.attribute(&u));
            let reciprocal_w = surface.reciprocal_w();
            let x = rng.below(u64::from(viewport.width)) as u32;
            let y = rng.below(u64::from(viewport.height)) as u32;
            let is_within = |value: f64, exact: &BigRational, bits: u32| {
                let value = BigRational::from_float(value).expect("finite");
                (value - exact).abs() * BigInt::from(1_u64 << bits) <= exact.abs()
            };
            let exact = linear.exact(x, y);
            assert!(is_within(linear.at(x, y), &exact, 51), "{corners:?} {x} {y}");
            if !reciprocal_w.exact(x, y).is_zero() {
                let exact = exact / reciprocal_w.exact(x, y);
                assert!(is_within(attribute.at(x, y), &exact, 50), "{corners:?} {x} {y}");
            }
        }
    }

    #[test]
    fn the_scale_of_a_multiple_is_exact() {
        let given = whole([3, -4, 12]);
        let snapped = given.clone().map(|value| value * rational(5, 8));
        assert_eq!(scale_of(&snapped, &given), rational(5, 8));
    }
}
