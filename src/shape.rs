//! Filled shapes on the screen: polygons and triangles whose corners are in pixels.
//!
//! A shape is filled by rows, as a whole, and never cut into triangles: so edges are smooth where a shape is thinner than a
//! pixel too, and there is nothing inside that could show. It is inside where its outline winds around ("non-zero"): that may
//! cross itself.

mod area;
mod rows;

pub(crate) use area::fill_smooth;
pub(crate) use rows::fill;

use crate::framebuffer::Target;
use crate::math::index;
use fixed::types::I16F16;

/// Where pixel (0, 0) lies in a target: from -2^31 to 2^31, as a display's first pixel may be anywhere.
type Origin = (i64, i64);

/// A pixel in a target that holds it.
#[inline]
fn placed((x, y): (i32, i32), (left, top): Origin) -> (usize, usize) {
    // A target that is not endless has no such place.
    let place =
        |at: i32, origin: i64| usize::try_from(i64::from(at) + origin).unwrap_or(usize::MAX);
    (place(x, left), place(y, top))
}

/// Fills a run of a row with one colour, if any.
fn fill_run<T: Target>(
    target: &mut T,
    (x0, x1, row): (i32, i32, i32),
    origin: Origin,
    color: Option<T::Color>,
) {
    if let Some(color) = color.filter(|_| x0 < x1) {
        let (x, y) = placed((x0, row), origin);
        target.fill(x, y, index(x1.saturating_sub(x0)), color);
    }
}

/// A place on the screen in pixels: see [`Polygon`].
type Corner = [I16F16; 2];

/// A shape with an outline of straight lines: [`Polygon`], [`Triangle`], or your own.
pub trait Shape {
    /// The corners, in either order around.
    fn polygon(&self) -> Polygon<'_>;
}

/// A polygon of up to [`Polygon::MAX_CORNERS`] corners, convex or not, in either orientation. With fewer than three it
/// is nothing.
///
/// A corner is `[x, y]` in pixels from the top left corner of the viewport or the display, y down, so that the centre of the first
/// pixel is `[0.5, 0.5]`; it is rounded to a 256th of a pixel.
///
/// It may cross or touch itself: it is filled where its outline winds around. In pixels that its parts share, smooth edges
/// are wrong: what is wound around twice there counts twice, and what is wound around both ways not at all.
///
/// ```
/// use hither::{Frame, Framebuffer, Gray8, I16F16, Polygon};
///
/// let arrow = [[0, 3], [4, 3], [4, 1], [8, 4], [4, 7], [4, 5], [0, 5]].map(|p| p.map(I16F16::from_num));
/// let mut words = [b' '; 64];
/// let mut frame = Frame::new(Framebuffer::<Gray8>::try_new(&mut words, 8, 8)?)?;
/// frame.fill_shape(&Polygon::try_new(&arrow)?, Gray8(b'#'));
/// let rows: Vec<_> = words.chunks(8).map(|row| core::str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, [
///     "        ",
///     "    #   ",
///     "    ##  ",
///     "####### ",
///     "####### ",
///     "    ##  ",
///     "    #   ",
///     "        ",
/// ]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Polygon<'a> {
    corners: &'a [Corner],
}

impl<'a> Polygon<'a> {
    /// The most corners: what is known of a row's edges is on the stack, 1 kB.
    pub const MAX_CORNERS: usize = 64;

    /// A polygon of these corners.
    ///
    /// # Errors
    ///
    /// [`PolygonError`] where there are more than [`MAX_CORNERS`](Self::MAX_CORNERS).
    pub const fn try_new(corners: &'a [Corner]) -> Result<Self, PolygonError> {
        if corners.len() > Self::MAX_CORNERS {
            return Err(PolygonError { corners: corners.len() });
        }
        Ok(Self { corners })
    }

    /// The corners.
    #[must_use]
    pub const fn corners(&self) -> &'a [Corner] {
        self.corners
    }

    /// The edges, from above.
    fn sides(&self) -> impl Iterator<Item = Side> + 'a {
        let after = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(after).filter_map(|(from, to)| Side::new(*from, *to))
    }

    /// The rows it may touch, and one past the last.
    fn rows(&self) -> (i32, i32) {
        let ends =
            self.sides().map(|side| (side.y >> BITS, (side.y + side.dy + PIXEL - 1) >> BITS));
        ends.reduce(|(a, b), (c, d)| (a.min(c), b.max(d))).unwrap_or((0, 0))
    }
}

impl Shape for Polygon<'_> {
    fn polygon(&self) -> Polygon<'_> {
        *self
    }
}

/// A triangle on the screen, in either orientation; corners as a [`Polygon`]'s.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle(pub [Corner; 3]);

impl Shape for Triangle {
    fn polygon(&self) -> Polygon<'_> {
        Polygon { corners: &self.0 }
    }
}

/// A polygon has too many corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PolygonError {
    /// Corners there are.
    pub corners: usize,
}

impl core::fmt::Display for PolygonError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(
            f,
            "a polygon of {} corners: up to {} are possible",
            self.corners,
            Polygon::MAX_CORNERS
        )
    }
}

impl core::error::Error for PolygonError {}

/// Fraction bits of a corner.
const BITS: u32 = 8;

/// A pixel in subpixels.
const PIXEL: i32 = 1 << BITS;

/// An edge that is not level, from its upper end, in subpixels: at most 2^23 from the origin.
#[derive(Clone, Copy, Debug)]
struct Side {
    x: i32,
    y: i32,
    dx: i32,
    /// Above 0.
    dy: i32,
    /// 1 where the outline goes down, -1 where it goes up.
    winding: i32,
}

impl Side {
    /// The edge between two corners; `None` where it is level.
    #[inline]
    fn new(from: Corner, to: Corner) -> Option<Self> {
        let snapped = |v: I16F16| ((v.to_bits() >> (15 - BITS)) + 1) >> 1;
        let ([x0, y0], [x1, y1]) = (from.map(snapped), to.map(snapped));
        let down = Self { x: x0, y: y0, dx: x1 - x0, dy: y1 - y0, winding: 1 };
        match down.dy {
            0 => None,
            1.. => Some(down),
            _ => Some(Self { x: x1, y: y1, dx: -down.dx, dy: -down.dy, winding: -1 }),
        }
    }
}
