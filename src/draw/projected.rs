//! Projected triangles with depth or varyings that have planes: from corners to pixels, and nothing in between.

use super::lanes::{self, Lanes, Word};
use super::shade::{NoVaryings, Pixels};
use super::shape::Shape;
use super::{Frame, Outcome};
use crate::clip::Hither;
use crate::depth::{DepthTest, projected};
use crate::fragment::Fragment;
use crate::framebuffer::Target;
use crate::interpolation::{
    Correction, Interpolates, Line, Linear, Pieces, is_straight, nearness_of, wrapped,
};
use crate::math::{index, unsigned};
use crate::setup::{Corner, Plane, Slopes, Tier};
use crate::span::Span;
use crate::traversal::{Half, Halves, ProjectedSide, Short, Side};
use crate::vertex::{Outside, Vertex};
use core::hint::black_box;
use core::marker::PhantomData;

/// How far off a straight line may be that is not packed, in raw steps: 2^-9.
const STRAIGHT: u32 = 1 << 7;

/// A shape with its depth.
pub(super) struct Deep<C = Corner> {
    pub(super) shape: Shape<C>,
    pub(super) depth: Plane,
}

/// Where a shape's rows are.
struct Row<'a, F, S: Side> {
    frame: &'a mut F,
    shape: &'a Deep<S::Corner>,
    half: Half<S>,
    y: i32,
}

/// What a triangle's pixels are made from, a block of a row at a time.
pub(super) trait Rows<const N: usize> {
    /// How the pixels of a block are made.
    type Block;
    /// What the next block of a row goes on from.
    type Joint;

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
    /// Draws a shape with depth or varyings, if all it needs has planes.
    #[inline]
    pub(super) fn shade_shape<F, const N: usize>(
        &mut self,
        shape: Shape,
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
        fragment: &F,
    ) -> Option<Outcome>
    where
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let [a, b, c] = vertices.map(|v| v.outside.0);
        if D::BITS > 16 || (D::BITS > 0 && a & b & c & Outside::RANGED == 0) {
            return None;
        }
        let depth = if D::BITS > 0 { projected(slopes, vertices) } else { Plane::default() };
        let shape = &Deep { shape, depth };
        match self.range.hither() {
            Some(hither) if N > 0 => {
                self.draw_varying(shape, slopes, vertices, hither, fragment)?;
            }
            _ => self.draw_shape(shape, &NoVaryings, fragment),
        }
        Some(Outcome::Drawn)
    }

    /// Draws a shape with varyings, by the cheapest of what serves.
    #[inline]
    fn draw_varying<F, const N: usize>(
        &mut self,
        shape: &Deep,
        slopes: &Slopes,
        vertices: [&Vertex<T, N, P>; 3],
        hither: Hither,
        fragment: &F,
    ) -> Option<()>
    where
        F: Fragment<C::Color, N>,
    {
        let q = nearness_of(vertices, hither);
        let tolerance = match I::EVERY {
            1 => 0,
            _ if I::PACKED => F::TOLERANCE,
            _ => STRAIGHT,
        };
        if I::AFFINE || is_straight(vertices, q, tolerance) {
            if let Some(lanes) = F::LANES.filter(|_| I::PACKED) {
                if let Some(lanes) = Lanes::new(slopes, vertices, lanes) {
                    self.draw_shape(shape, &lanes, fragment);
                    return Some(());
                }
            }
            let linear = Linear::new(slopes, vertices)?;
            if F::WRAPS && I::PACKED {
                self.draw_shape(shape, &Wrapped(linear), fragment);
            } else {
                self.draw_shape(shape, &linear, fragment);
            }
        } else if I::EVERY > 1 {
            let pieces = Every::<_, I>(Pieces::new(slopes, vertices, q)?, PhantomData);
            if F::WRAPS && I::PACKED {
                self.draw_shape(shape, &Wrapped(pieces), fragment);
            } else {
                self.draw_shape(shape, &pieces, fragment);
            }
        } else {
            return None;
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
            self.draw_halves::<Short, _, _, N>(shape, rows, fragment);
        } else {
            self.draw_halves::<ProjectedSide, _, _, N>(shape, rows, fragment);
        }
    }

    /// Draws the pixels of a shape, whose edges are followed by `S`.
    #[inline(never)]
    pub(super) fn draw_halves<S, F, R, const N: usize>(
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
        let mut halves = Halves::<S>::new(outline, *bounds, T::SUBPIXEL_BITS);
        while let Some((y, half)) = halves.next() {
            let mut row = Row { frame: &mut *self, shape, half, y };
            loop {
                // What is behind this reference is read anew a row: the loop over pixels wants the registers.
                let row = black_box(&mut row);
                let Some((x0, x1)) = row.half.next() else {
                    break;
                };
                let bounds = row.shape.shape.bounds;
                let (y, x0, x1) = if S::WINDOWED {
                    (row.y, x0.max(bounds.x0), x1.min(bounds.x1))
                } else {
                    (row.y, bounds.x0 + x0, bounds.x0 + x1)
                };
                row.y += 1;
                if x0 < x1 {
                    row.frame.draw_row(Span { y, x0, x1 }, row.shape.depth, rows, fragment);
                }
            }
            halves.resume(row.half);
        }
    }

    /// Draws a row that is not empty, a block after the other.
    #[inline(always)]
    fn draw_row<F, R, const N: usize>(&mut self, span: Span, depth: Plane, rows: &R, fragment: &F)
    where
        F: Fragment<C::Color, N>,
        R: Rows<N, Block: Pixels<C::Color, F, N>>,
    {
        let (left, top) = self.viewport.origin;
        let mut running = depth.at(span.x0, span.y);
        let mut joint = rows.joint(span);
        let mut rest = span;
        while rest.x0 < rest.x1 {
            let (mut block, length) = rows.block(rest, &mut joint);
            let (x, y) = (index(rest.x0), index(rest.y));
            let mut column = rest.x0 - left;
            let fragment = *fragment;
            let mut pixel = move |passes: bool| {
                let color = passes.then(|| block.color(&fragment, column, span.y - top));
                block.step();
                column += 1;
                color
            };
            if D::BITS == 0 {
                self.target.write(x, y, (0..length).map(move |_| pixel(true)));
            } else {
                let Some(depths) = self.depth.row(x, y, index(length)) else {
                    return;
                };
                let mut at = running;
                let pixel = move |stored: &mut D::Word| {
                    let passes = D::passes(at, stored);
                    at = at.wrapping_add(depth.x);
                    pixel(passes)
                };
                match R::Block::AT_ONCE {
                    4 => self.target.write_each::<_, 4>(x, y, depths, pixel),
                    2 => self.target.write_each::<_, 2>(x, y, depths, pixel),
                    _ => self.target.write_each::<_, 1>(x, y, depths, pixel),
                }
                running = running.wrapping_add(depth.x.wrapping_mul(unsigned(length)));
            }
            rest.x0 += length;
        }
    }
}

impl<const N: usize, B: Begins<N>> Rows<N> for B {
    type Block = B::Block;
    type Joint = ();

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

impl<const N: usize> Begins<N> for Lanes<N> {
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

impl<I: Correction, const N: usize> Every<Pieces<N>, I> {
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

impl<I: Correction, const N: usize> Rows<N> for Wrapped<Every<Pieces<N>, I>> {
    type Block = Word;
    type Joint = [i32; N];

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

impl<I: Correction, const N: usize> Rows<N> for Every<Pieces<N>, I> {
    type Block = Line<N>;
    /// The values where the next piece begins.
    type Joint = [i32; N];

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
