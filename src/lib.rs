//! A `#![no_std]`, allocation-free triangle rasterizer with exact coverage, for microcontrollers
//! with displays.
//!
//! Work in progress docs.
#![no_std]
#![cfg_attr(
    test,
    allow(
        clippy::cast_lossless,
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_precision_loss,
        clippy::cast_sign_loss,
        clippy::float_arithmetic,
        reason = "tests compare with f64 and count with small numbers"
    )
)]

#[cfg(test)]
extern crate std;

mod clip;
mod color;
mod depth;
mod draw;
mod fragment;
mod framebuffer;
mod interpolation;
mod math;
mod mesh;
mod setup;
mod span;
mod texture;
mod transform;
mod traversal;
mod vertex;

pub use clip::{BothSides, Hither, HitherDistance, NoHither, Plane, WRange};
pub use color::{FromUnit, Gray8, PixelFormat, Rgb565, Rgb565Be, Rgb888};
pub use depth::{Always, Compare, DepthBuffer, DepthTest, DepthWord, Less, NoDepth};
pub use draw::{Counts, DepthFrame, DepthSize, DisplayFrame, Frame, Outcome};
pub use fixed;
pub use fixed::types::I16F16;
pub use fragment::{FaceColors, Flat, Fragment, Gouraud, Sample, Textured};
pub use framebuffer::{BufferSize, Framebuffer, Target};
pub use interpolation::{Affine, Correction, Interpolates, Perspective, PerspectiveEvery};
pub use mesh::{AsVaryings, Lit, Mesh, MeshError, NormalColor, StoredPosition, VertexStage};
pub use setup::{Cull, Facing, Tier};
pub use texture::{Texture, TextureSize};
#[cfg(feature = "micromath")]
pub use transform::FloatError;
pub use transform::{Angle, Mat4, MatrixError, ModelPosition, SinCos, Vec3};
pub use vertex::{
    ClipVertex, Exact, ExactPosition, Position, Quick, QuickPosition, Rect, Snap, Snapped, Vertex,
    Viewport, ViewportSize,
};
