//! Where to draw: a viewport of any size with an origin and a scissor, on a target of any size.

use arbitrary::{Arbitrary, Result, Unstructured};
use core::ops::Range;
use hither::{Rect, Viewport};

/// The sides of a viewport: mostly up to 16 pixels, sometimes up to 512, seldom both.
fn sides(u: &mut Unstructured<'_>) -> Result<(u32, u32)> {
    let [kind, width, height] = u.arbitrary::<[u8; 3]>()?;
    let [width, height] = [width, height].map(u32::from);
    let small = |side: u32| 1 + side % 16;
    let large = |side: u32| 2 * side + 1 + u32::from(kind & 1);
    Ok(match kind {
        0..=247 => (small(width), small(height)),
        248..=250 => (large(width), small(height)),
        251..=253 => (small(width), large(height)),
        _ if u.arbitrary::<[u8; 2]>()? == [0xaa, 0x55] => (large(width), large(height)),
        _ => (1 + width % 64, 1 + height % 64),
    })
}

/// A viewport and the size of the target it is shown on.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The viewport's size in pixels.
    pub size: (u32, u32),
    /// Where its first pixel lies on the target.
    pub origin: (i16, i16),
    /// The scissor asked for.
    pub scissor: Option<Rect>,
    /// The target's size in pixels.
    pub target: (u32, u32),
}

impl<'a> Arbitrary<'a> for Place {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let size = sides(u)?;
        let kind: u8 = u.arbitrary()?;
        let mut place = Self { size, origin: (0, 0), scissor: None, target: size };
        if kind & 1 != 0 {
            place.origin = (i16::from(u.arbitrary::<i8>()?), i16::from(u.arbitrary::<i8>()?));
        }
        if kind & 2 != 0 {
            let [x0, y0, x1, y1] = u.arbitrary::<[i8; 4]>()?.map(i32::from);
            place.scissor = Some(Rect { x0, y0, x1, y1 });
        }
        if kind & 4 != 0 {
            place.target = (u32::from(u.arbitrary::<u8>()?), u32::from(u.arbitrary::<u8>()?));
        }
        if kind >= 0xc0 {
            place.origin = u.arbitrary()?;
            let [x0, y0, x1, y1] = u.arbitrary::<[i32; 4]>()?;
            place.scissor = Some(Rect { x0, y0, x1, y1 });
            place.target = u.arbitrary()?;
        }
        Ok(place)
    }
}

impl Place {
    /// All of a viewport on a target of its own size.
    #[must_use]
    pub const fn whole(size: (u32, u32)) -> Self {
        Self { size, origin: (0, 0), scissor: None, target: size }
    }

    /// Rows `y .. y + rows` of a viewport, on a target of that size.
    #[must_use]
    pub const fn band(size: (u32, u32), y: u32, rows: u32) -> Self {
        Self { size, origin: (0, -(y as i16)), scissor: None, target: (size.0, rows) }
    }

    /// The viewport.
    ///
    /// # Panics
    ///
    /// Where the library does not take a side of 1 to 512.
    #[must_use]
    pub fn viewport(&self) -> Viewport {
        let (width, height) = self.size;
        let viewport = Viewport::new(width, height).expect("sides of 1 to 512");
        let viewport = viewport.with_origin(self.origin.0, self.origin.1);
        self.scissor.map_or(viewport, |scissor| viewport.with_scissor(scissor))
    }

    /// Columns and rows of the viewport that are inside of the scissor and of the target.
    #[must_use]
    pub fn shown(&self) -> [Range<i64>; 2] {
        let scissor = self.scissor.map(|s| [(s.x0, s.x1), (s.y0, s.y1)]);
        let axis = |axis: usize, size: u32, origin: i16, target: u32| {
            let (origin, [from, to]) = (i64::from(origin), [0, i64::from(size)]);
            let (from, to) = (from.max(-origin), to.min(i64::from(target) - origin));
            scissor
                .map_or(from..to, |s| from.max(i64::from(s[axis].0))..to.min(i64::from(s[axis].1)))
        };
        let (width, height) = self.size;
        [
            axis(0, width, self.origin.0, self.target.0),
            axis(1, height, self.origin.1, self.target.1),
        ]
    }

    /// The viewport's pixels, row by row from the top.
    pub fn pixels(&self) -> impl Iterator<Item = (i64, i64)> + use<> {
        let (width, height) = self.size;
        (0..i64::from(height)).flat_map(move |y| (0..i64::from(width)).map(move |x| (x, y)))
    }
}
