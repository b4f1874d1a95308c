//! The frame: a target, what is tested and clipped, and the tier, put together by type.

use crate::clip::{BothSides, Hither, NoHither, Plane};
use crate::color::Rgb565Be;
use crate::depth::{Compare, DepthBuffer, DepthTest, DepthWord, NoDepth};
use crate::framebuffer::{Framebuffer, Target};
use crate::math::unsigned;
use crate::preset::{Balance, Preset};
use crate::setup::Cull;
use crate::traversal::WIDEST;
use crate::vertex::{Rect, Viewport, ViewportSize};
use core::marker::PhantomData;

/// A frame for an ST7789 or ILI9341 without depth: flat shapes.
pub type DisplayFrame<'a> = Frame<Framebuffer<'a, Rgb565Be>>;

/// A frame for an ST7789 or ILI9341 with a 16-bit depth buffer and a hither plane: meshes.
pub type DepthFrame<'a> = Frame<Framebuffer<'a, Rgb565Be>, DepthBuffer<'a>, Hither>;

/// What triangles are drawn into: a [`Target`], and by type whether there is depth (`D`), what is
/// kept along `w` (`W`), the tier (`T`), how varyings are corrected (`I`), and how many clip planes
/// there are (`P`). What is not named costs nothing.
///
/// ```
/// use hither::{ClipVertex, Flat, Frame, Framebuffer, Gray8, I16F16};
///
/// let mut words = [b' '; 64];
/// let mut frame = Frame::new(Framebuffer::<Gray8>::try_new(&mut words, 8, 8)?)?;
/// let corner = |x: f32, y: f32| {
///     let [x, y] = [x, y].map(I16F16::from_num);
///     (ClipVertex::new(x, y, I16F16::ZERO, I16F16::ONE), [])
/// };
/// let corners = [corner(-1.0, -0.9), corner(1.0, -0.9), corner(0.1, 1.0)];
/// frame.draw_triangle(corners, &Flat(Gray8(b'#')));
/// let rows: Vec<_> = words.chunks(8).map(|row| core::str::from_utf8(row).unwrap()).collect();
/// assert_eq!(rows, [
///     "    #   ",
///     "    #   ",
///     "   ###  ",
///     "  ####  ",
///     "  ##### ",
///     " ###### ",
///     " ###### ",
///     "########",
/// ]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Frame<
    C,
    D = NoDepth,
    W = NoHither,
    T = <Balance as Preset>::Tier,
    I = <Balance as Preset>::Correction,
    const P: usize = 0,
> {
    pub(super) target: C,
    pub(super) depth: D,
    pub(super) range: W,
    pub(super) planes: [Plane; P],
    pub(super) cull: Cull,
    pub(super) viewport: Viewport,
    /// What the target holds of the scissor, in the viewport's pixels; empty until it has been asked for.
    pub(super) window: Rect,
    /// The same where the target is one for [`SmallRows`](crate::traversal::SmallRows); otherwise empty.
    pub(super) small_window: Rect,
    pub(super) knobs: PhantomData<(T, I)>,
}

/// No window: the target has not been asked for its size yet.
const UNKNOWN: Rect = Rect { x0: 0, y0: 0, x1: 0, y1: 0 };

/// A frame with a depth buffer.
type WithDepth<'a, C, W, O, T, I, const P: usize> =
    Frame<C, DepthBuffer<'a, W, O>, Hither, T, I, P>;

impl<C: Target> Frame<C> {
    /// A frame over all of a target: the preset [`Balance`], no depth, no hither plane, both facings drawn.
    ///
    /// # Errors
    ///
    /// [`ViewportSize`] where the target's sides are not 1 to [`Viewport::MAX_SIDE`].
    pub fn new(target: C) -> Result<Self, ViewportSize> {
        let (width, height) = target.size();
        let viewport = Viewport::new(width, height)?;
        Ok(Self::with_viewport(target, viewport))
    }

    /// A frame over a target of any size that shows a viewport, or a part of one: see [`Viewport`].
    #[must_use]
    pub const fn with_viewport(target: C, viewport: Viewport) -> Self {
        Self {
            target,
            depth: NoDepth,
            range: NoHither,
            planes: [],
            cull: Cull::Neither,
            viewport,
            window: UNKNOWN,
            small_window: UNKNOWN,
            knobs: PhantomData,
        }
    }
}

impl<C, T, I, const P: usize> Frame<C, NoDepth, NoHither, T, I, P> {
    /// The same with a hither plane: what depth and varyings need.
    #[must_use]
    pub fn with_hither(self, hither: Hither) -> Frame<C, NoDepth, Hither, T, I, P> {
        self.rebuild(|depth, _| (depth, hither))
    }

    /// The same, drawing the part behind the eye too.
    #[must_use]
    pub fn with_both_sides(self) -> Frame<C, NoDepth, BothSides, T, I, P> {
        self.rebuild(|depth, _| (depth, BothSides))
    }
}

impl<C: Target, T, I, const P: usize> Frame<C, NoDepth, Hither, T, I, P> {
    /// The same with a depth buffer. It holds what it held: [`clear`](Self::clear) it.
    ///
    /// # Errors
    ///
    /// [`DepthSize`] where it is not the size of the target.
    pub fn with_depth<W: DepthWord, O: Compare>(
        self,
        depth: DepthBuffer<'_, W, O>,
    ) -> Result<WithDepth<'_, C, W, O, T, I, P>, DepthSize> {
        let target = self.target.size();
        let size = depth.size();
        if size == target {
            Ok(self.rebuild(|_, range| (depth, range)))
        } else {
            Err(DepthSize { target, depth: size })
        }
    }
}

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P> {
    /// The same parts under other types.
    pub(super) fn rebuild<D2, W2, T2, I2>(
        self,
        change: impl FnOnce(D, W) -> (D2, W2),
    ) -> Frame<C, D2, W2, T2, I2, P> {
        let (depth, range) = change(self.depth, self.range);
        Frame {
            target: self.target,
            depth,
            range,
            planes: self.planes,
            cull: self.cull,
            viewport: self.viewport,
            window: self.window,
            small_window: self.small_window,
            knobs: PhantomData,
        }
    }

    /// The same in another tier: [`Exact`](crate::Exact), [`Quick<4>`](crate::Quick) or
    /// [`Quick<8>`](crate::Quick).
    #[must_use]
    pub fn with_tier<T2>(self, _tier: T2) -> Frame<C, D, W, T2, I, P> {
        self.rebuild(|depth, range| (depth, range))
    }

    /// The same with a preset's tier and correction.
    #[must_use]
    pub fn with_preset<Q: Preset>(self, _preset: Q) -> Frame<C, D, W, Q::Tier, Q::Correction, P> {
        self.rebuild(|depth, range| (depth, range))
    }

    /// The same with another [`Correction`](crate::Correction) of varyings.
    #[must_use]
    pub fn with_correction<I2>(self, _correction: I2) -> Frame<C, D, W, T, I2, P> {
        self.rebuild(|depth, range| (depth, range))
    }

    /// The same with clip planes, up to 8; each costs 8 bytes a vertex.
    #[must_use]
    pub fn with_planes<const Q: usize>(self, planes: [Plane; Q]) -> Frame<C, D, W, T, I, Q> {
        const { assert!(Q <= 8, "a frame has up to 8 clip planes") }
        Frame {
            target: self.target,
            depth: self.depth,
            range: self.range,
            planes,
            cull: self.cull,
            viewport: self.viewport,
            window: self.window,
            small_window: self.small_window,
            knobs: PhantomData,
        }
    }

    /// The same, leaving out a facing.
    #[must_use]
    pub fn with_cull(self, cull: Cull) -> Self {
        Self { cull, ..self }
    }

    /// Leaves out a facing from here on, for scenes whose meshes differ.
    pub const fn set_cull(&mut self, cull: Cull) {
        self.cull = cull;
    }

    /// The viewport.
    #[must_use]
    pub const fn viewport(&self) -> &Viewport {
        &self.viewport
    }

    /// The target, to read or flush.
    #[must_use]
    pub const fn target(&self) -> &C {
        &self.target
    }

    /// The target, for other drawing into it: text, icons. Another may be put in its place; one that is not of the depth
    /// buffer's size shows nothing.
    #[must_use]
    pub const fn target_mut(&mut self) -> &mut C {
        // It may be put in another's place.
        self.window = UNKNOWN;
        self.small_window = UNKNOWN;
        &mut self.target
    }

    /// The depth buffer.
    #[must_use]
    pub const fn depth(&self) -> &D {
        &self.depth
    }

    /// The target and the depth buffer back.
    #[must_use]
    pub fn into_parts(self) -> (C, D) {
        (self.target, self.depth)
    }
}

impl<C: Target, D: DepthTest, W, T, I, const P: usize> Frame<C, D, W, T, I, P> {
    /// The part of the scissor that the target holds, in the viewport's pixels.
    #[inline]
    pub(super) fn known_window(&mut self) -> Rect {
        if self.window.is_empty() {
            self.find_window();
        }
        self.window
    }

    /// The rows of the viewport that the target holds: from the first to before the second.
    #[cfg(feature = "heapless")]
    pub(crate) fn rows(&mut self) -> (u32, u32) {
        let Rect { y0, y1, .. } = self.known_window();
        (unsigned(y0.max(0)), unsigned(y1.max(0)))
    }

    /// Where pixel (0, 0) lies in the target.
    pub(super) fn origin(&self) -> (i64, i64) {
        let (x, y) = self.viewport.origin;
        (x.into(), y.into())
    }

    /// Not inlined: it is done once a target.
    #[inline(never)]
    fn find_window(&mut self) {
        let (width, height) = self.target.size();
        if self.depth.fits((width, height)) {
            self.window = self.viewport.window(width, height);
            if width <= unsigned(WIDEST) {
                self.small_window = self.window;
            }
        }
    }

    /// Fills the whole target with one colour, whatever the scissor, and sets depth to the
    /// farthest.
    pub fn clear(&mut self, color: C::Color) {
        self.target.clear(color);
        self.depth.clear();
    }

    /// Sets depth to the farthest, and leaves the colours.
    pub fn clear_depth(&mut self) {
        self.depth.clear();
    }
}

/// A depth buffer is not the size of the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DepthSize {
    /// Width and height of the target, in pixels.
    pub target: (u32, u32),
    /// Width and height of the depth buffer, in pixels.
    pub depth: (u32, u32),
}

impl core::fmt::Display for DepthSize {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let ((w, h), (dw, dh)) = (self.target, self.depth);
        write!(
            f,
            "a depth buffer of {dw} x {dh} pixels for a target of {w} x {h}: the same are needed"
        )
    }
}

impl core::error::Error for DepthSize {}
