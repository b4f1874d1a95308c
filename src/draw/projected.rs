//! Projected triangles with depth or varyings that have planes: from corners to pixels, and nothing in between.

use super::Frame;
use super::divided::Separate;
use super::lanes::{self, Lanes, Word};
use super::shade::{NoVaryings, Pixels, tested};
use super::shape::Shape;
use crate::depth::{DepthTest, projected};
use crate::fragment::Fragment;
use crate::framebuffer::{BEND, Target};
use crate::interpolation::{
    Arcs, Correction, Interpolates, Line, Linear, Pieces, Width, is_straight, nearness_of, wrapped,
};
use crate::math::{SMALL_CORE, index, unsigned};
use crate::setup::{Corner, Plane, Slopes, Tier};
use crate::span::Span;
use crate::traversal::{ProjectedSide, Rows as Edges, SMALL, Side, SmallRows};
use crate::vertex::Vertex;
use core::hint::black_box;
use core::marker::PhantomData;

/// How far off a straight line may be that is not packed, in raw steps: 2^-9.
const STRAIGHT: u32 = 1 << 7;

/// A shape with its depth.
pub(super) struct Deep<C = Corner> {
    pub(super) shape: Shape<C>,
    pub(super) depth: Plane,
}

/// Where a triangle's rows are.
struct Row<'a, Frame, Edges, F> {
    frame: &'a mut Frame,
    edges: Edges,
    depth: Plane,
    fragment: F,
    y: i32,
    /// The depth in column 0 of the row, or what would be there.
    z: u32,
    /// The target's pixel that column 0 of the row is, or would be, and pixels from row to row.
    start: usize,
    width: usize,
}

/// What a triangle's pixels are made from, a block of a row at a time.
pub(super) trait Rows<const N: usize> {
    /// How the pixels of a block are made.
    type Block;
    /// What the next block of a row goes on from.
    type Joint;

    /// Pixels of a block, at the most.
    const LONGEST: i32;

    /// Whether blocks bend.
    const BENT: bool = false;

    /// A row before its first block.
    fn joint(&self, span: Span) -> Self::Joint;

    /// The block at the start of what is left of a row, and how long it is.
    fn block(&self, span: Span, joint: &mut Self::Joint) -> (Self::Block, i32);
}

/// [`Rows`] of which a block begins anywhere, whatever was before it.
pub(super) trait Begins<const N: usize> {
    /// How the pixels of a block are made.
    type Block;

    /// Pixels of a block, at the most.
    const LENGTH: i32 = i32::MAX;

    /// The block from a pixel on.
    fn begin(&self, x: i32, y: i32) -> Self::Block;
}

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    /// The plane of a triangle's depths, which are in the range, if any are kept.
    #[inline(always)]
    pub(super) fn depth_plane<const N: usize>(
        &self,
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
    ) -> Plane {
        if D::BITS == 0 { Plane::default() } else { projected(slopes, vertices) }
    }

    /// Draws a shape with varyings, by the cheapest of what serves; `None` where it has to be drawn as any other.
    #[inline(always)]
    pub(super) fn draw_varying<F, const N: usize>(
        &mut self,
        shape: &Deep,
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
        fragment: &F,
    ) -> Option<()>
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let hither = self.range.hither()?;
        let q = nearness_of(vertices, hither);
        const { assert!(I::EVERY >= 1 && I::EVERY <= 64, "a correction divides every 1 to 64 pixels") }
        let packed = I::WIDTH == Width::Packed;
        let tolerance = match I::EVERY {
            1 => 0,
            _ if packed => F::TOLERANCE,
            _ => STRAIGHT,
        };
        if I::AFFINE || is_straight(vertices, q, tolerance) {
            if packed {
                if let Some(lanes) = Lanes::<C::Color, F, N>::new(slopes, vertices) {
                    if F::DITHERED {
                        self.draw_shape(shape, &Separate(lanes), fragment);
                    } else {
                        self.draw_shape(shape, &lanes, fragment);
                    }
                    return Some(());
                }
            }
            let linear = Linear::new(slopes, vertices)?;
            if F::WRAPS && packed {
                self.draw_shape(shape, &Wrapped(linear), fragment);
            } else {
                self.draw_shape(shape, &linear, fragment);
            }
        } else if I::EVERY > 1 {
            if F::WRAPS && packed && index(I::EVERY) >= BEND {
                let arcs = Arcs::<I::Reciprocal, N>::new(slopes, vertices, q)?;
                // Few that are short are not straight: one copy is enough.
                self.draw_edges::<ProjectedSide, _, _, N>(shape, &arcs, fragment);
                return Some(());
            }
            let pieces = Every::<_, I>(Pieces::new(slopes, vertices, q)?, PhantomData);
            if packed && !F::DITHERED && lanes::within::<C::Color, F, T, N, P>(vertices) {
                self.draw_shape(shape, &Laned(pieces, PhantomData::<(C::Color, F)>), fragment);
                return Some(());
            }
            if F::WRAPS && packed {
                self.draw_shape(shape, &Wrapped(pieces), fragment);
            } else {
                self.draw_shape(shape, &pieces, fragment);
            }
        } else {
            self.draw_divided::<ProjectedSide, _, N>(shape, slopes, vertices, fragment)?;
        }
        Some(())
    }

    /// Draws the pixels of a shape.
    #[inline(always)]
    fn draw_shape<F, R, const N: usize>(&mut self, shape: &Deep, rows: &R, fragment: &F)
    where
        F: Fragment<C::Color, N>,
        R: Rows<N, Block: Pixels<C::Color, F, N>>,
    {
        if shape.shape.short {
            self.draw_short(shape, rows, fragment);
        } else {
            self.draw_edges::<ProjectedSide, _, _, N>(shape, rows, fragment);
        }
    }

    /// Draws the pixels of a small shape.
    #[inline(never)]
    fn draw_short<F, R, const N: usize>(&mut self, shape: &Deep, rows: &R, fragment: &F)
    where
        F: Fragment<C::Color, N>,
        R: Rows<N, Block: Pixels<C::Color, F, N>>,
    {
        let Shape { outline, bounds, .. } = &shape.shape;
        let edges = SmallRows::new(outline, *bounds, T::SUBPIXEL_BITS, 0);
        self.draw_rows::<_, _, _, N, true>(edges, bounds.y0, shape.depth, rows, fragment);
    }

    /// Draws the pixels of a shape, whose edges are followed by `S`.
    #[inline(never)]
    pub(super) fn draw_edges<S, F, R, const N: usize>(
        &mut self,
        shape: &Deep<S::Corner>,
        rows: &R,
        fragment: &F,
    ) where
        S: Side,
        F: Fragment<C::Color, N>,
        R: Rows<N, Block: Pixels<C::Color, F, N>>,
    {
        let Shape { outline, bounds, .. } = &shape.shape;
        let (start, end) = (bounds.x0, bounds.x1);
        let edges = Edges::<S>::new(outline, *bounds, T::SUBPIXEL_BITS)
            .map(move |(x0, x1)| (x0.max(start), x1.min(end)));
        self.draw_rows::<_, _, _, N, false>(edges, bounds.y0, shape.depth, rows, fragment);
    }

    /// Draws the rows between edges from `y` down, which are in the window.
    #[inline(always)]
    fn draw_rows<E, F, R, const N: usize, const SHORT: bool>(
        &mut self,
        edges: E,
        y: i32,
        depth: Plane,
        rows: &R,
        fragment: &F,
    ) where
        E: Iterator<Item = (i32, i32)>,
        F: Fragment<C::Color, N>,
        R: Rows<N, Block: Pixels<C::Color, F, N>>,
    {
        let (left, top) = self.viewport.origin;
        let (width, _) = self.target.size();
        let start = index(y + top).wrapping_mul(width as usize).wrapping_add_signed(left as isize);
        let (fragment, width) = (*fragment, width as usize);
        let z = depth.at(0, y);
        let mut row = Row { frame: self, edges, depth, fragment, y, z, start, width };
        loop {
            // What is behind this reference is read anew a row: the loop over pixels wants the registers.
            let row = if SHORT { &mut row } else { black_box(&mut row) };
            let Some((x0, x1)) = row.edges.next() else {
                return;
            };
            let (y, start, z) = (row.y, row.start, row.z);
            row.y += 1;
            row.start = start.wrapping_add(row.width);
            row.z = z.wrapping_add(row.depth.y);
            if x0 < x1 {
                let span = Span { y, x0, x1 };
                let z = z.wrapping_add(row.depth.x.wrapping_mul(unsigned(x0)));
                let depth = (z, row.depth.x, &row.depth);
                row.frame.draw_row::<_, _, N, SHORT>(span, start, depth, rows, row.fragment);
            }
        }
    }

    /// Draws a row that is not empty, a block after the other. Its column 0 is pixel `start` of the target.
    #[inline(always)]
    fn draw_row<F, R, const N: usize, const SHORT: bool>(
        &mut self,
        span: Span,
        start: usize,
        (mut z, step, plane): (u32, u32, &Plane),
        rows: &R,
        fragment: F,
    ) where
        F: Fragment<C::Color, N>,
        R: Rows<N, Block: Pixels<C::Color, F, N>>,
    {
        if R::BENT && D::BITS > 0 {
            self.draw_bent_row(span, start, [z, step], rows, fragment);
            return;
        }
        let mut joint = rows.joint(span);
        if SHORT && R::LONGEST >= SMALL {
            let (block, _) = rows.block(span, &mut joint);
            self.draw_pixels::<_, _, N, SHORT>(span, start, (z, step, plane), block, fragment);
            return;
        }
        let mut rest = span;
        while rest.x0 < rest.x1 {
            let (block, length) = rows.block(rest, &mut joint);
            let now = Span { x1: rest.x0 + length, ..rest };
            if R::BENT {
                self.draw_bent(now, block, fragment);
            } else {
                self.draw_pixels::<_, _, N, SHORT>(now, start, (z, step, plane), block, fragment);
            }
            z = z.wrapping_add(step.wrapping_mul(unsigned(length)));
            rest.x0 += length;
        }
    }

    /// Draws a block of a row, whose depth is the first of three at its first pixel and steps by the second, as in the third.
    #[inline(always)]
    fn draw_pixels<F, B, const N: usize, const SHORT: bool>(
        &mut self,
        span: Span,
        start: usize,
        (mut z, mut step, plane): (u32, u32, &Plane),
        mut block: B,
        fragment: F,
    ) where
        F: Fragment<C::Color, N>,
        B: Pixels<C::Color, F, N>,
    {
        let (left, top) = self.viewport.origin;
        let Span { y, x0, x1 } = span;
        let length = index(x1 - x0);
        let mut x = x0;
        let at = (index(x0 + left), index(y + top), start.wrapping_add(index(x0)));
        let mut pixel = move |passes: bool| {
            let color = if passes { block.color(&fragment, x, y) } else { None };
            block.step();
            x += 1;
            color
        };
        let target = &mut self.target;
        if D::BITS == 0 {
            target.write(at.0, at.1, (0..length).map(move |_| pixel(true)));
            return;
        }
        let pixel = move |stored: &mut D::Word, first: bool| {
            if first {
                // Made or read anew, so that its multiples are not kept: they take more registers than there are.
                step = if SMALL_CORE {
                    black_box(step)
                } else {
                    black_box(());
                    plane.x
                };
            }
            tested::<D, F, _, N>(z, stored, |passes| {
                z = z.wrapping_add(step);
                pixel(passes)
            })
        };
        self.depth.run(at.2, length, move |depths| match B::AT_ONCE {
            4 if !SHORT => target.write_each::<_, 4>(at, depths, pixel),
            2 if !SHORT => target.write_each::<_, 2>(at, depths, pixel),
            _ => target.write_each::<_, 1>(at, depths, pixel),
        });
    }
}

impl<const N: usize, B: Begins<N>> Rows<N> for B {
    type Block = B::Block;
    type Joint = ();
    const LONGEST: i32 = B::LENGTH;

    #[inline]
    fn joint(&self, _: Span) {}

    #[inline]
    fn block(&self, span: Span, (): &mut ()) -> (B::Block, i32) {
        (self.begin(span.x0, span.y), (span.x1 - span.x0).min(B::LENGTH))
    }
}

impl<const N: usize> Begins<N> for NoVaryings {
    type Block = Self;

    #[inline]
    fn begin(&self, _: i32, _: i32) -> Self {
        Self
    }
}

impl<const N: usize> Begins<N> for Linear<N> {
    type Block = Line<N>;

    #[inline]
    fn begin(&self, x: i32, y: i32) -> Line<N> {
        self.line(x, y)
    }
}

impl<C: Copy, F: Fragment<C, N>, const N: usize> Begins<N> for Lanes<C, F, N> {
    type Block = Word;
    const LENGTH: i32 = lanes::LENGTH;

    #[inline]
    fn begin(&self, x: i32, y: i32) -> Word {
        self.word(x, y)
    }
}

/// Varyings of which only the fractions matter, in one word.
struct Wrapped<R>(R);

impl<const N: usize> Begins<N> for Wrapped<Linear<N>> {
    type Block = Word;
    /// A step is rounded to a raw one: 2^-12 at most over these.
    const LENGTH: i32 = 32;

    #[inline]
    fn begin(&self, x: i32, y: i32) -> Word {
        let [at, step] = self.0.wrapped(x, y);
        Word { at, step }
    }
}

/// Pieces of a correction's length.
struct Every<R, I>(R, PhantomData<I>);

/// A piece: raw values at its first pixel and `steps` further.
struct Piece<const N: usize> {
    first: [i32; N],
    last: [i32; N],
    steps: i32,
    length: i32,
}

impl<I: Correction, const N: usize> Every<Pieces<I::Reciprocal, N>, I> {
    /// The piece at the start of what is left of a row; `joint` has the values there, and then those of the next.
    #[inline]
    fn piece(&self, span: Span, joint: &mut [i32; N]) -> Piece<N> {
        let length = (span.x1 - span.x0).min(I::EVERY);
        // To the first pixel of the next piece, or the last of this one.
        let steps = if length < span.x1 - span.x0 { length } else { length - 1 };
        let first = *joint;
        if steps > 0 {
            *joint = self.0.at(span.x0 + steps, span.y);
        }
        Piece { first, last: *joint, steps, length }
    }
}

impl<I: Correction, const N: usize> Rows<N> for Wrapped<Every<Pieces<I::Reciprocal, N>, I>> {
    type Block = Word;
    type Joint = [i32; N];
    const LONGEST: i32 = I::EVERY;

    #[inline]
    fn joint(&self, span: Span) -> [i32; N] {
        self.0.joint(span)
    }

    #[inline]
    fn block(&self, span: Span, joint: &mut [i32; N]) -> (Word, i32) {
        let Piece { first, last, steps, length } = self.0.piece(span, joint);
        let [at, step] = wrapped(first, last, steps);
        (Word { at, step }, length)
    }
}

/// Pieces of channels in one word.
struct Laned<R, K>(R, PhantomData<K>);

impl<I, C, F, const N: usize> Rows<N> for Laned<Every<Pieces<I::Reciprocal, N>, I>, (C, F)>
where
    I: Correction,
    C: Copy,
    F: Fragment<C, N>,
{
    type Block = Word;
    type Joint = [i32; N];
    const LONGEST: i32 = I::EVERY;

    #[inline]
    fn joint(&self, span: Span) -> [i32; N] {
        self.0.joint(span)
    }

    #[inline]
    fn block(&self, span: Span, joint: &mut [i32; N]) -> (Word, i32) {
        let Piece { first, last, steps, length } = self.0.piece(span, joint);
        (lanes::through::<C, F, N>(first, last, steps), length)
    }
}

impl<I: Correction, const N: usize> Rows<N> for Every<Pieces<I::Reciprocal, N>, I> {
    type Block = Line<N>;
    /// The values where the next piece begins.
    type Joint = [i32; N];
    const LONGEST: i32 = I::EVERY;

    #[inline]
    fn joint(&self, span: Span) -> [i32; N] {
        self.0.at(span.x0, span.y)
    }

    #[inline]
    fn block(&self, span: Span, joint: &mut [i32; N]) -> (Line<N>, i32) {
        let Piece { first, last, steps, length } = self.piece(span, joint);
        (Line::through(first, last, steps), length)
    }
}
