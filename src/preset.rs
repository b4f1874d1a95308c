//! Presets: the knobs that are types, set together.
//!
//! What each costs and how far off it is comes from the command `trade`, over scenes made to hurt.

use crate::depth::DepthWord;
use crate::interpolation::{Correction, Packed, Perspective, PerspectiveEvery};
use crate::setup::Tier;
use crate::vertex::{Exact, Quick};

/// The knobs of a frame, chosen together. Take [`Balance`] unless something speaks for another: [`Speed`] where most pixels
/// have a colour a vertex, [`Fidelity`] for pictures that are compared, at several times the cost a pixel.
/// [`plan!`](crate::plan) makes one for a scene's bounds.
///
/// Presets are [`Speed`], [`Balance`], [`Fidelity`], or one of your own.
/// [`Frame::with_preset`](crate::Frame::with_preset) takes one: its tier and its correction. A depth buffer is of its
/// [`Depth`](Self::Depth).
pub trait Preset: Copy + Default + core::fmt::Debug {
    /// What vertices are snapped to.
    type Tier: Tier;
    /// How varyings are corrected for perspective.
    type Correction: Correction;
    /// What a depth is stored as, for a [`DepthBuffer`](crate::DepthBuffer) of it.
    type Depth: DepthWord;
}

/// For frame rate: as [`Balance`], divided for every 32 pixels instead of 8. Large triangles with a colour a vertex take about half
/// of the instructions; textures in perspective take the same, and are coarser on very thin triangles only.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Speed;

/// For most scenes, and what a [`Frame`](crate::Frame) begins with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Balance;

/// For pictures that are compared with others: coverage of vertices that are not moved by more than 2^-11 of a pixel, and
/// varyings that are divided at each pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fidelity;

impl Preset for Speed {
    type Tier = Quick<8>;
    type Correction = Packed<PerspectiveEvery<32>>;
    type Depth = u16;
}

impl Preset for Balance {
    type Tier = Quick<8>;
    type Correction = Packed<PerspectiveEvery<8>>;
    type Depth = u16;
}

impl Preset for Fidelity {
    type Tier = Exact;
    type Correction = Perspective;
    type Depth = u16;
}
