//! Rows of pixels along lines that bend: texture coordinates in perspective.

use super::Frame;
use super::lanes::Bent;
use super::projected::Rows;
use super::shade::{Pixels, tested};
use crate::depth::DepthTest;
use crate::fragment::Fragment;
use crate::framebuffer::{BEND, Pen, RunOf, Runs, Target};
use crate::interpolation::{Arcs, Bend, Correction, Reciprocal};
use crate::math::{SMALL_CORE, index, unsigned};
use crate::setup::Tier;
use crate::span::Span;
use core::hint::black_box;
use core::marker::PhantomData;

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    /// [`Self::draw_row`] where blocks bend.
    #[inline(always)]
    pub(super) fn draw_bent_row<F, R, const N: usize>(
        &mut self,
        span: Span,
        start: usize,
        [depth, depth_step]: [u32; 2],
        rows: &R,
        mut fragment: F,
    ) where
        F: Fragment<C::Color, N>,
        R: Rows<N, Block: Pixels<C::Color, F, N>>,
    {
        let (left, top) = self.viewport.origin;
        let (x, y) = (index(span.x0 + left), index(span.y + top));
        let at = start.wrapping_add(index(span.x0));
        let mut place = BentPlace { joint: rows.joint(span), span, depth, depth_step };
        // Read anew a run, and the fragment a chunk: the loop over pixels wants the registers, also those which references
        // from here would take. On a small core reading it again costs more.
        let _ = black_box(&mut place);
        if !SMALL_CORE {
            let _ = black_box(&mut fragment);
        }
        let (place, fragment) = (&mut place, &fragment);
        let row = BentRow { rows, fragment, place, kind: PhantomData::<Kind<D, N>> };
        let target = &mut self.target;
        self.depth.run(at, index(span.x1 - span.x0), move |depths| {
            target.write_bent((x, y, at), depths, row);
        });
    }

    /// Draws a block that bends where there is no depth.
    #[inline(always)]
    pub(super) fn draw_bent<F, B, const N: usize>(&mut self, span: Span, mut block: B, fragment: F)
    where
        F: Fragment<C::Color, N>,
        B: Pixels<C::Color, F, N>,
    {
        let (left, top) = self.viewport.origin;
        let (x, y) = (index(span.x0 + left), index(span.y + top));
        let colors = (span.x0..span.x1).map(move |column| {
            let color = block.color(&fragment, column, span.y);
            block.step();
            if index(column + 1 - span.x0) % BEND == 0 {
                block.bend_by(block.bend());
            }
            color
        });
        self.target.write(x, y, colors);
    }
}

/// A row of blocks that bend, as the target asks for them.
struct BentRow<'a, R, F, J, T> {
    rows: &'a R,
    fragment: &'a F,
    place: &'a mut BentPlace<J>,
    kind: PhantomData<T>,
}

/// Where in its row it is.
struct BentPlace<J> {
    joint: J,
    span: Span,
    depth: u32,
    depth_step: u32,
}

/// A block's pixels with their depths.
struct BentRun<'a, B, F, T> {
    block: B,
    fragment: F,
    /// Where the fragment is.
    source: &'a F,
    depth: [u32; 2],
    kind: PhantomData<T>,
}

/// What kind of a test there is, on how many varyings.
struct Kind<D, const N: usize>(PhantomData<D>);

impl<'a, C, D, R, F, const N: usize> Runs<D::Word, C> for BentRow<'a, R, F, R::Joint, Kind<D, N>>
where
    C: Copy,
    D: DepthTest,
    F: Fragment<C, N>,
    R: Rows<N, Block: Pixels<C, F, N>>,
{
    type Pen = BentRun<'a, R::Block, F, Kind<D, N>>;

    #[inline(always)]
    fn begin(&mut self) -> RunOf<Self::Pen> {
        let Self { fragment, kind, .. } = *self;
        let place = &mut *self.place;
        let (block, length) = self.rows.block(place.span, &mut place.joint);
        place.span.x0 += length;
        let depth = [place.depth, place.depth_step];
        place.depth = depth[0].wrapping_add(depth[1].wrapping_mul(unsigned(length)));
        RunOf {
            steps: [block.bend(), depth[1]],
            pen: BentRun { block, fragment: *fragment, source: fragment, depth, kind },
            bends: index(length) / BEND,
            last: place.span.x0 >= place.span.x1,
        }
    }
}

impl<C, D, B, F, const N: usize> Pen<D::Word, C> for BentRun<'_, B, F, Kind<D, N>>
where
    C: Copy,
    D: DepthTest,
    F: Fragment<C, N>,
    B: Pixels<C, F, N>,
{
    type Brush = F;

    #[inline(always)]
    fn brush(&self) -> F {
        if SMALL_CORE { self.fragment } else { *self.source }
    }

    #[inline(always)]
    fn color(&mut self, fragment: &F, stored: &mut D::Word) -> Option<C> {
        let color = tested::<D, F, C, N>(self.depth[0], stored, |passes| {
            if passes { self.block.color(fragment, 0, 0) } else { None }
        });
        self.depth[0] = self.depth[0].wrapping_add(self.depth[1]);
        self.block.step();
        color
    }

    #[inline(always)]
    fn bend(&mut self, [bend, step]: [u32; 2]) {
        self.block.bend_by(bend);
        self.depth[1] = step;
    }
}

impl<R: Reciprocal, const N: usize> Rows<N> for Arcs<R, N> {
    type Block = Bent;
    type Joint = Bend<N>;
    const LONGEST: i32 = 0;
    const BENT: bool = true;

    #[inline(always)]
    fn joint(&self, span: Span) -> Bend<N> {
        self.bend(span.x0, span.y)
    }

    #[inline(always)]
    fn block(&self, span: Span, joint: &mut Bend<N>) -> (Bent, i32) {
        let ([at, step, bend], length) = self.arc(joint, span.x1 - span.x0);
        (Bent { at, step, bend }, length)
    }
}
