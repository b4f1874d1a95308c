//! A point: a choice of every knob, as a type.

use super::draw::{Depths, HEIGHT, WIDTH};
use super::geometry::Attribute;
use crate::SceneError;
use core::marker::PhantomData;
use hither::{
    Balance, Compare, Correction, DepthBuffer, DepthTest, Dithered, Division, Exact, Fidelity,
    Float, Fragment, Frame, Gouraud, Hither, Mat4, Newton, NoDepth, Preset, Quick, Rgb565,
    ShortMat4, Speed, Table, Target, Tier, VertexStage, Width,
};

/// What a setting is called in tables.
pub trait Named {
    /// In one word.
    const NAME: &'static str;
}

macro_rules! named {
    ($($type:ty: $name:literal),* $(,)?) => {
        $(impl Named for $type { const NAME: &'static str = $name; })*
    };
}

named! {
    Quick<4>: "quick4", Quick<8>: "quick8", Exact: "exact",
    Table: "table", Newton<1>: "newton1", Newton<2>: "newton2", Division: "divide", Float: "f32",
    NoDepth: "none", u16: "depth16", u32: "depth32",
    Mat4: "mat32", ShortMat4: "mat16",
    Gouraud: "plain", Dithered<Gouraud>: "dither",
    Speed: "Speed", Balance: "Balance", Fidelity: "Fidelity",
}

/// How wide a matrix is.
pub trait Stage: Named {
    /// From the one in 32 bits.
    fn of(matrix: &Mat4) -> Self;
}

impl Stage for Mat4 {
    fn of(matrix: &Mat4) -> Self {
        *matrix
    }
}

impl Stage for ShortMat4 {
    fn of(matrix: &Mat4) -> Self {
        Self::from(matrix)
    }
}

/// A frame before it has depth.
pub type Bare<C, T, I> = Frame<C, NoDepth, Hither, T, I>;

/// A frame that keeps depth as `D` does, or the reason why there is none.
pub type Kept<'a, D, O, C, T, I> =
    Result<Frame<C, <D as DepthKnob>::Test<'a, O>, Hither, T, I>, SceneError>;

/// How depth is kept.
pub trait DepthKnob: Named {
    /// What it is kept in, with a comparison.
    type Test<'a, O: Compare>: DepthTest;

    /// A frame that keeps it.
    ///
    /// # Errors
    ///
    /// [`SceneError`] where the words are not as many as the target's pixels.
    fn with<'a, O: Compare, C: Target, T: Tier, I: Correction>(
        frame: Bare<C, T, I>,
        depths: Depths<'a>,
    ) -> Kept<'a, Self, O, C, T, I>;
}

impl DepthKnob for NoDepth {
    type Test<'a, O: Compare> = Self;

    fn with<'a, O: Compare, C: Target, T: Tier, I: Correction>(
        frame: Bare<C, T, I>,
        _: Depths<'a>,
    ) -> Kept<'a, Self, O, C, T, I> {
        Ok(frame)
    }
}

impl DepthKnob for u16 {
    type Test<'a, O: Compare> = DepthBuffer<'a, Self, O>;

    fn with<'a, O: Compare, C: Target, T: Tier, I: Correction>(
        frame: Bare<C, T, I>,
        depths: Depths<'a>,
    ) -> Kept<'a, Self, O, C, T, I> {
        let depth = DepthBuffer::try_new(depths.short, WIDTH, HEIGHT)?;
        Ok(frame.with_depth(depth.with_compare(O::default()))?)
    }
}

impl DepthKnob for u32 {
    type Test<'a, O: Compare> = DepthBuffer<'a, Self, O>;

    fn with<'a, O: Compare, C: Target, T: Tier, I: Correction>(
        frame: Bare<C, T, I>,
        depths: Depths<'a>,
    ) -> Kept<'a, Self, O, C, T, I> {
        let depth = DepthBuffer::try_new(depths.long, WIDTH, HEIGHT)?;
        Ok(frame.with_depth(depth.with_compare(O::default()))?)
    }
}

/// A choice of every knob.
pub trait Knobs {
    /// What vertices are snapped to.
    type Tier: Tier;
    /// How varyings are corrected, in which width, divided by what.
    type Correction: Correction;
    /// What depth is kept in.
    type Depth: DepthKnob;
    /// What transforms.
    type Stage: Stage + VertexStage<Attribute, 2> + VertexStage<Attribute, 3>;
    /// What colours of vertices are rounded by.
    type Shader: Fragment<Rgb565, 3> + Default;

    /// Each knob's name and setting, in the order of tables.
    const SETTINGS: [(&'static str, &'static str); 7];

    /// The preset that it is, if it is one.
    const PRESET: Option<&'static str> = None;
}

/// A point by its knobs: tier, correction, depth, transform and shader.
#[derive(Clone, Copy, Debug, Default)]
pub struct Of<T, I, D = u16, M = Mat4, S = Gouraud>(PhantomData<(T, I, D, M, S)>);

/// A preset as a point.
#[derive(Clone, Copy, Debug, Default)]
pub struct PresetPoint<Q>(PhantomData<Q>);

/// What a correction is called, without its width and its reciprocal.
const fn correction<I: Correction>() -> &'static str {
    match (I::AFFINE, I::EVERY) {
        (true, _) => "affine",
        (false, 1) => "each",
        (false, 8) => "every8",
        (false, 16) => "every16",
        (false, 32) => "every32",
        (false, _) => "every",
    }
}

/// What a correction's width is called.
const fn width<I: Correction>() -> &'static str {
    match I::WIDTH {
        Width::Packed => "packed",
        Width::Word => "word",
        Width::Long => "long",
    }
}

impl<T, I, D, M, S> Knobs for Of<T, I, D, M, S>
where
    T: Tier + Named,
    I: Correction<Reciprocal: Named>,
    D: DepthKnob,
    M: Stage + VertexStage<Attribute, 2> + VertexStage<Attribute, 3>,
    S: Fragment<Rgb565, 3> + Default + Named,
{
    type Tier = T;
    type Correction = I;
    type Depth = D;
    type Stage = M;
    type Shader = S;
    const SETTINGS: [(&'static str, &'static str); 7] = [
        ("snap", T::NAME),
        ("correction", correction::<I>()),
        ("width", width::<I>()),
        ("reciprocal", I::Reciprocal::NAME),
        ("depth", D::NAME),
        ("transform", M::NAME),
        ("dither", S::NAME),
    ];
}

impl<Q> Knobs for PresetPoint<Q>
where
    Q: Preset<Tier: Named, Correction: Correction<Reciprocal: Named>, Depth: DepthKnob> + Named,
{
    type Tier = Q::Tier;
    type Correction = Q::Correction;
    type Depth = Q::Depth;
    type Stage = Mat4;
    type Shader = Gouraud;
    const SETTINGS: [(&'static str, &'static str); 7] =
        <Of<Q::Tier, Q::Correction, Q::Depth> as Knobs>::SETTINGS;
    const PRESET: Option<&'static str> = Some(Q::NAME);
}
