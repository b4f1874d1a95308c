//! From a plan's numbers to types.

use crate::depth::DepthWord;
use crate::interpolation::{
    Affine, Correction, DividedBy, Newton, Packed, Perspective, PerspectiveEvery, Reciprocal, Table,
};
use crate::setup::Tier;
use crate::transform::{Mat4, ShortMat4};
use crate::vertex::{Exact, Quick};

/// A number of bits, that selects a type: [`SelectTier`], [`SelectDepth`], [`SelectTransform`], [`SelectWidth`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bits<const N: u32>;

/// Pixels between two divisions, that select a correction: [`SelectCorrection`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Every<const N: u32>;

/// Steps of Newton's iteration, that select a reciprocal: [`SelectReciprocal`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Steps<const N: u32>;

/// The tier of [`Plan::snap_bits`](super::Plan::snap_bits).
pub trait SelectTier {
    /// The tier.
    type Tier: Tier;
}

/// The depth of [`Plan::depth_bits`](super::Plan::depth_bits).
pub trait SelectDepth {
    /// What a depth is stored as.
    type Depth: DepthWord;
}

/// The transform of [`Plan::transform_bits`](super::Plan::transform_bits).
pub trait SelectTransform {
    /// The vertex stage.
    type Transform: core::fmt::Debug;

    /// The vertex stage of a matrix.
    fn stage(matrix: &Mat4) -> Self::Transform;
}

/// The width of [`Plan::varying_bits`](super::Plan::varying_bits).
pub trait SelectWidth {
    /// A correction in this width.
    type Of<C: Correction>: Correction;
}

/// The correction of [`Plan::every`](super::Plan::every).
pub trait SelectCorrection {
    /// The correction.
    type Correction: Correction;
}

/// The reciprocal of [`Plan::newton_steps`](super::Plan::newton_steps).
pub trait SelectReciprocal {
    /// The reciprocal.
    type Reciprocal: Reciprocal;
}

/// The correction that [`Every`], [`Bits`] and [`Steps`] select together.
pub type Corrected<E, W, R> = DividedBy<
    <W as SelectWidth>::Of<<E as SelectCorrection>::Correction>,
    <R as SelectReciprocal>::Reciprocal,
>;

impl SelectTier for Bits<4> {
    type Tier = Quick<4>;
}

impl SelectTier for Bits<8> {
    type Tier = Quick<8>;
}

impl SelectTier for Bits<0> {
    type Tier = Exact;
}

impl SelectDepth for Bits<16> {
    type Depth = u16;
}

impl SelectDepth for Bits<32> {
    type Depth = u32;
}

impl SelectTransform for Bits<16> {
    type Transform = ShortMat4;

    #[inline]
    fn stage(matrix: &Mat4) -> ShortMat4 {
        ShortMat4::from(matrix)
    }
}

impl SelectTransform for Bits<32> {
    type Transform = Mat4;

    #[inline]
    fn stage(matrix: &Mat4) -> Mat4 {
        *matrix
    }
}

impl SelectWidth for Bits<16> {
    type Of<C: Correction> = Packed<C>;
}

impl SelectWidth for Bits<32> {
    type Of<C: Correction> = C;
}

impl SelectCorrection for Every<0> {
    type Correction = Affine;
}

impl SelectCorrection for Every<1> {
    type Correction = Perspective;
}

impl SelectCorrection for Every<8> {
    type Correction = PerspectiveEvery<8>;
}

impl SelectCorrection for Every<16> {
    type Correction = PerspectiveEvery<16>;
}

impl SelectCorrection for Every<32> {
    type Correction = PerspectiveEvery<32>;
}

impl SelectReciprocal for Steps<0> {
    type Reciprocal = Table;
}

impl SelectReciprocal for Steps<1> {
    type Reciprocal = Newton<1>;
}

impl SelectReciprocal for Steps<2> {
    type Reciprocal = Newton<2>;
}

/// A [`Preset`](crate::Preset) planned from a [`Scene`](crate::Scene), at compile time: a unit struct of this name, with its
/// [`Plan`](crate::Plan) as `PLAN`, and `stage`, which makes the vertex stage of a matrix.
///
/// ```
/// use hither::{DepthBuffer, Frame, Framebuffer, Gouraud, Hither, I16F16, Mat4, Mesh, Preset};
/// use hither::{Rgb565, Scene};
///
/// hither::plan! {
///     /// A cube's worth of space around a camera.
///     pub Room = Scene::new(96, 64).range(1.0, 9.0).model(2.0, 2.0).colors().within_pixels(0.2);
/// }
///
/// let (mut color, mut depth) = ([0; 96 * 64], [<Room as Preset>::Depth::MAX; 96 * 64]);
/// let mut frame = Frame::new(Framebuffer::<Rgb565>::try_new(&mut color, 96, 64)?)?
///     .with_preset(Room)
///     .with_hither(Hither::new(I16F16::ONE)?)
///     .with_depth(DepthBuffer::try_new(&mut depth, 96, 64)?)?;
/// frame.clear(Rgb565::BLACK);
///
/// let lens = Mat4::perspective(I16F16::ONE, I16F16::ONE, I16F16::ONE, I16F16::from_num(9))?;
/// let away = Mat4::translation([I16F16::ZERO, I16F16::ZERO, I16F16::from_num(-4)]);
/// let stage = Room::stage(&lens.times(&away)?);
/// let (positions, colors) = ([[-2_i16, -2, 0], [2, -2, 0], [0, 2, 1]], [[255_u8, 0, 0]; 3]);
/// let mesh = Mesh::try_new(&positions, 3, &colors, &[[0, 1, 2]])?;
/// let counts = frame.draw(&mesh, &stage, &Gouraud, &mut []);
/// assert_eq!(counts.drawn, 1);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// A scene that no plan serves does not compile, and `cargo check` says which of its numbers to change:
///
/// ```compile_fail
/// use hither::Scene;
///
/// hither::plan! {
///     /// No snap is within a millionth of a pixel.
///     pub Room = Scene::new(96, 64).range(1.0, 9.0).model(2.0, 2.0).colors().within_pixels(1e-6);
/// }
/// ```
#[macro_export]
macro_rules! plan {
    ($(#[$meta:meta])* $visibility:vis $name:ident = $scene:expr;) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        $visibility struct $name;

        impl $name {
            /// What was planned.
            $visibility const PLAN: $crate::Plan = $crate::Plan::new($scene);

            /// The vertex stage of a matrix.
            #[allow(dead_code, reason = "a scene may have a stage of its own")]
            $visibility fn stage(
                matrix: &$crate::Mat4,
            ) -> <$crate::Bits<{ $name::PLAN.transform_bits }> as $crate::SelectTransform>::Transform
            {
                <$crate::Bits<{ $name::PLAN.transform_bits }> as $crate::SelectTransform>::stage(matrix)
            }
        }

        impl $crate::Preset for $name {
            type Tier = <$crate::Bits<{ $name::PLAN.snap_bits }> as $crate::SelectTier>::Tier;
            type Correction = $crate::Corrected<
                $crate::Every<{ $name::PLAN.every }>,
                $crate::Bits<{ $name::PLAN.varying_bits }>,
                $crate::Steps<{ $name::PLAN.newton_steps }>,
            >;
            type Depth = <$crate::Bits<{ $name::PLAN.depth_bits }> as $crate::SelectDepth>::Depth;
        }
    };
}
