//! Which pixels a triangle covers, by exact arithmetic.
//!
//! With `M` the matrix of the vertices `(x, y, w)`, `d` its determinant and `e_i` the rows of its
//! adjugate, a pixel centre `P = sum(e_i . P / d * v_i)`. It is covered by the part in front of the
//! eye when every `sign(d) e_i . P` is positive, or is 0 on a left edge (the function grows to the
//! right) or a top edge (it does not change to the right and grows downwards). For the part behind
//! the eye the functions are `-sign(d) e_i . P`, with the same rule. `d = 0` covers nothing.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

use super::linear::{Form, adjugate, dot, over_pixels, to_whole};
use super::{Part, RationalVertex, Space, Vertex, Viewport};

/// Whether pixel `(x, y)` is covered: the rule word by word in rationals, as plain and slow as it
/// gets (some microseconds a call).
#[must_use]
pub fn covers_big(
    vertices: &[RationalVertex; 3],
    space: Space,
    viewport: Viewport,
    part: Part,
    (x, y): (u32, u32),
) -> bool {
    let whole = |value: u32| BigRational::from_integer(value.into());
    let (one, two) = (whole(1), whole(2));
    let (right, down) = (&two * whole(x) + &one, &two * whole(y) + &one);
    let centre = match space {
        Space::Clip => [
            right / whole(viewport.width) - &one,
            &one - down / whole(viewport.height),
            one.clone(),
        ],
        Space::Pixel => [right / &two, down / &two, one.clone()],
    };
    let rows = adjugate(vertices);
    let determinant = dot(&rows[0], &vertices[0]);
    if determinant.is_zero() {
        return false;
    }
    let facing = match part {
        Part::Front => determinant.signum(),
        Part::Behind => -determinant.signum(),
    };
    rows.iter().all(|row| {
        let value = &facing * dot(row, &centre);
        let to_right = &facing * &row[0];
        let downwards = match space {
            Space::Clip => -(&facing * &row[1]),
            Space::Pixel => &facing * &row[1],
        };
        let left = to_right.is_positive();
        let top = to_right.is_zero() && downwards.is_positive();
        value.is_positive() || (value.is_zero() && (left || top))
    })
}

/// Largest coordinate, in units of the vertices' scale, that is worked out in `i128` from the
/// start.
///
/// Proof, for viewports up to [`NARROW_VIEWPORT`] = 2^10 and coordinates up to 2^40: a minor is the
/// difference of two products, so at most 2^81; the determinant is the sum of three products of a
/// minor and a coordinate, at most 3 * 2^121 < 2^123. Over pixels (`over_pixels`) `A` and `B` are
/// at most 2^81 * 2^10 = 2^91, and `C` at most 3 * 2^81 * 2^20 < 2^103; at a pixel `2X+1 < 2^11`,
/// so a value is at most 2^102 + 2^102 + 2^103 = 2^104. All are below 2^127. The grid's 2^20, with
/// room for 2^21, is far inside: its minors are below 2^43 and, up to 512 x 512, its values below
/// 2^52 * 2^10 * 2 + 3 * 2^43 * 2^18 < 2^65.
const NARROW_COORDINATE: u64 = 1 << 40;

/// Largest viewport side, in pixels, of the proof of [`NARROW_COORDINATE`].
const NARROW_VIEWPORT: u32 = 1 << 10;

/// A triangle prepared for exact answers about many pixels; some nanoseconds a pixel where `i128`
/// does.
#[derive(Clone, Debug)]
pub struct ExactTriangle {
    /// Positive inside the part that was asked for.
    edges: [Form; 3],
    /// Whether a pixel centre on the edge is inside.
    inclusive: [bool; 3],
    /// Sign of the determinant in clip space.
    orientation: i32,
    viewport: Viewport,
}

impl ExactTriangle {
    /// A triangle with clip-space vertices `(x, y, w)` in whole units of one scale.
    #[must_use]
    pub fn new(vertices: [Vertex; 3], viewport: Viewport, part: Part) -> Self {
        Self::from_whole(vertices, Space::Clip, viewport, part)
    }

    /// A triangle with pixel-space vertices: vertex `(px, py, pw)` is at `px/pw` pixels from the
    /// left and `py/pw` from the top, so that pixel centres are at +1/2. Each vertex may have a
    /// positive scale of its own.
    #[must_use]
    pub fn from_pixel_space(vertices: [Vertex; 3], viewport: Viewport, part: Part) -> Self {
        Self::from_whole(vertices, Space::Pixel, viewport, part)
    }

    /// A triangle with vertices of exact rationals, such as snapped ones. Each is multiplied by the
    /// positive number that makes it whole, which does not move it on the screen.
    #[must_use]
    pub fn from_rationals(
        vertices: &[RationalVertex; 3],
        space: Space,
        viewport: Viewport,
        part: Part,
    ) -> Self {
        let integers = vertices.each_ref().map(|vertex| to_whole(vertex).0);
        let small = integers.each_ref().map(|vertex| vertex.each_ref().map(ToPrimitive::to_i64));
        if small.iter().flatten().all(Option::is_some) {
            let vertices = small.map(|vertex| vertex.map(Option::unwrap_or_default));
            return Self::from_whole(vertices, space, viewport, part);
        }
        Self::wide(&integers, space, viewport, part)
    }

    fn from_whole(vertices: [Vertex; 3], space: Space, viewport: Viewport, part: Part) -> Self {
        let narrow =
            vertices.iter().flatten().all(|value| value.unsigned_abs() <= NARROW_COORDINATE)
                && viewport.width <= NARROW_VIEWPORT
                && viewport.height <= NARROW_VIEWPORT;
        if narrow {
            Self::narrow(&vertices.map(|vertex| vertex.map(i128::from)), space, viewport, part)
        } else {
            Self::wide(&vertices.map(|vertex| vertex.map(BigInt::from)), space, viewport, part)
        }
    }

    fn narrow(vertices: &[[i128; 3]; 3], space: Space, viewport: Viewport, part: Part) -> Self {
        let rows = adjugate(vertices);
        let determinant = dot(&rows[0], &vertices[0]).signum() as i32;
        let inward = i128::from(inward_sign(determinant, part));
        let forms = rows.map(|row| over_pixels(&row, space, viewport).map(|value| value * inward));
        Self {
            inclusive: forms.map(|[a, b, _]| a > 0 || (a == 0 && b > 0)),
            edges: forms.map(Form::Narrow),
            orientation: orientation(determinant, space),
            viewport,
        }
    }

    fn wide(vertices: &[[BigInt; 3]; 3], space: Space, viewport: Viewport, part: Part) -> Self {
        let rows = adjugate(vertices);
        let sign = dot(&rows[0], &vertices[0]).signum();
        let determinant = sign.to_i32().unwrap_or_default();
        let inward = BigInt::from(inward_sign(determinant, part));
        let forms = rows.map(|row| over_pixels(&row, space, viewport).map(|value| value * &inward));
        let is_inclusive =
            |[a, b, _]: &[BigInt; 3]| a.is_positive() || (a.is_zero() && b.is_positive());
        Self {
            inclusive: forms.each_ref().map(is_inclusive),
            edges: forms.map(Form::Wide),
            orientation: orientation(determinant, space),
            viewport,
        }
    }

    /// Whether pixel `(x, y)` of the viewport is covered.
    #[must_use]
    pub fn covers(&self, x: u32, y: u32) -> bool {
        debug_assert!(x < self.viewport.width && y < self.viewport.height);
        self.orientation != 0
            && (0..3).all(|i| match self.edges[i].sign_at(x, y) {
                0 => self.inclusive[i],
                sign => sign > 0,
            })
    }

    /// The facing: 1 where the determinant in clip space is positive (counter-clockwise in NDC
    /// where all `w > 0`), -1 where it is negative, 0 where the triangle covers nothing.
    #[must_use]
    pub fn orientation(&self) -> i32 {
        self.orientation
    }

    /// The signed coverage of pixel `(x, y)`: the facing where it is covered, else 0.
    #[must_use]
    pub fn signed_coverage(&self, x: u32, y: u32) -> i32 {
        i32::from(self.covers(x, y)) * self.orientation
    }

    /// The covered pixels `(x, y)`, row by row from the top.
    #[must_use]
    pub fn pixels(&self) -> Vec<(u32, u32)> {
        let covered = |&(x, y): &(u32, u32)| self.covers(x, y);
        self.viewport.pixels().filter(covered).collect()
    }

    /// The rows as text, `#` for a covered pixel and a space for another.
    #[must_use]
    pub fn picture(&self) -> Vec<String> {
        let mark = |x, y| if self.covers(x, y) { '#' } else { ' ' };
        let row = |y| (0..self.viewport.width).map(|x| mark(x, y)).collect();
        (0..self.viewport.height).map(row).collect()
    }
}

/// What the adjugate's rows are multiplied by to be positive inside a part.
fn inward_sign(determinant: i32, part: Part) -> i32 {
    match part {
        Part::Front => determinant,
        Part::Behind => -determinant,
    }
}

/// The sign of the determinant in clip space; y runs the other way in pixel space.
fn orientation(determinant: i32, space: Space) -> i32 {
    match space {
        Space::Clip => determinant,
        Space::Pixel => -determinant,
    }
}

#[cfg(test)]
#[path = "coverage_tests.rs"]
mod tests;
