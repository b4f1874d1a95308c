//! A `#![no_std]`, allocation-free triangle rasterizer for microcontrollers with displays, with exact
//! coverage: which pixels a triangle covers is decided by integers, so the triangles of a mesh
//! neither gap nor overlap, at any angle and on both sides of the eye plane.
//!
//! It sets triangles up homogeneously (Olano and Greer, "Triangle Scan Conversion using 2D
//! Homogeneous Coordinates", 1997), so no triangle is ever cut by a clipper, and no vertex is
//! divided by its `w` in the exact tier.
//!
//! # Data flows one way
//!
//! ```text
//! vertex --> setup --> traversal --> span --> fragment --> target --> display
//! snapped    edges,    rows and      x0..x1   varyings,    fill,      DMA, SPI
//! to a grid  planes    intervals              depth        write
//! ```
//!
//! A [`Frame`] joins the stages. What a scene uses is in its type, and what it does not use costs
//! nothing: the [`Target`] and pixel format, depth ([`NoDepth`] or [`DepthBuffer`]), the range of `w`
//! ([`NoHither`], [`BothSides`], [`Hither`]), clip [`Plane`]s, the tier ([`Exact`], [`Quick`]) and the
//! correction of varyings ([`Perspective`], [`PerspectiveEvery`], [`Affine`]). Presets set the last two: [`Speed`],
//! [`Balance`], which is what a frame begins with, and [`Fidelity`].
//!
//! [`plan!`] picks them from a [`Scene`]'s bounds and how far off it may be, at compile time.
//!
//! # A mesh
//!
//! ```
//! use hither::{Angle, Cull, DepthBuffer, Frame, Framebuffer, Gouraud, Hither, I16F16, Mat4, Mesh};
//! use hither::{Rgb565, Rgb565Be, Vertex};
//!
//! // In flash: positions in quarters of a unit, a colour a vertex, indices.
//! static TETRAHEDRON: Mesh<[i16; 3], [u8; 3]> = match Mesh::try_new(
//!     &[[4, 4, 4], [-4, -4, 4], [-4, 4, -4], [4, -4, -4]],
//!     2,
//!     &[[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0]],
//!     &[[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]],
//! ) {
//!     Ok(mesh) => mesh,
//!     Err(_) => panic!("an index is out of range"),
//! };
//!
//! let (mut color_words, mut depth_words) = ([0; 24 * 24], [0u16; 24 * 24]);
//! let near = I16F16::ONE;
//! let mut frame = Frame::new(Framebuffer::<Rgb565Be>::try_new(&mut color_words, 24, 24)?)?
//!     .with_hither(Hither::new(near)?)
//!     .with_depth(DepthBuffer::try_new(&mut depth_words, 24, 24)?)?
//!     .with_cull(Cull::Back);
//! frame.clear(Rgb565::BLACK);
//!
//! let turn = Mat4::rotation_y(Angle::from_degrees(I16F16::from_num(20)).sin_cos());
//! let away = Mat4::translation([I16F16::ZERO, I16F16::ZERO, I16F16::from_num(-4)]);
//! let lens = Mat4::perspective(I16F16::from_num(2), I16F16::ONE, near, I16F16::from_num(9))?;
//! let transform = lens.times(&away.times(&turn)?)?;
//!
//! // Vertices are transformed once each, into what the caller lends.
//! let mut cache = [Vertex::EMPTY; 4];
//! let counts = frame.draw(&TETRAHEDRON, &transform, &Gouraud, &mut cache);
//! assert_eq!(counts.drawn + counts.culled, 4);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```
//!
//! # Features
//!
//! - `embedded-graphics`: its draw targets are targets, by `OnDisplay`, and framebuffers and bands are
//!   draw targets; colours convert to and from its own.
//! - `heapless`: exact bins, for frames that are drawn in bands.
//! - `micromath`: matrices from `f32` angles and numbers.
//! - `defmt`: `defmt::Format` on outcomes, counts, colours and errors.
//!
//! # Limits
//!
//! Viewports are up to 512 x 512 pixels. Varyings, perspective and depth need a hither plane: their
//! types ask for it.
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

mod band;
#[cfg(feature = "heapless")]
mod bin;
mod blend;
mod buffer;
mod clip;
mod color;
mod coverage;
mod depth;
mod dirty;
mod dither;
mod draw;
#[cfg(feature = "embedded-graphics")]
mod eg;
mod fog;
mod fragment;
mod framebuffer;
mod interpolation;
mod math;
mod mesh;
mod pack;
mod plan;
mod preset;
mod setup;
mod shape;
mod span;
mod texture;
mod transform;
mod traversal;
mod vertex;

pub use band::{Band, Bands, FrameError, SwapChain, Transfer};
#[cfg(feature = "heapless")]
pub use bin::Bins;
pub use blend::{Add, Additive, Alpha, Blended, Merge, Mix, Over, Translucent};
pub use buffer::BufferSize;
pub use clip::{BothSides, Hither, HitherDistance, NoHither, Plane, WRange};
#[doc(hidden)]
pub use color::Lane;
pub use color::{Binary, FromUnit, Gray4, Gray8, Luminance, PixelFormat, Rgb565, Rgb565Be, Rgb888};
pub use coverage::Edges;
pub use depth::{
    Always, Compare, DepthBias, DepthBuffer, DepthTest, DepthWord, Less, NoDepth, TestOnly,
};
pub use dirty::Dirty;
pub use dither::Dithered;
pub use draw::{Counts, DepthFrame, DepthSize, DisplayFrame, Frame, Outcome};
#[cfg(feature = "embedded-graphics")]
pub use eg::{AsPixelColor, DisplayColor, Fill, Filled, OnBand, OnDisplay};
pub use fixed;
pub use fixed::types::I16F16;
pub use fog::{FogDistance, FogRange, Fogged};
pub use fragment::{FaceColors, Flat, Fragment, Gouraud, Keyed, Sample, Textured};
pub use framebuffer::{Framebuffer, Target};
pub use interpolation::{
    Affine, Correction, DividedBy, Division, Float, Interpolates, Newton, Packed, Perspective,
    PerspectiveEvery, Reciprocal, Table, Wide, Width,
};
pub use mesh::{AsVaryings, Lit, Mesh, MeshError, NormalColor, StoredPosition, VertexStage};
pub use pack::{PackedSize, pack_gray4, pack_pages, pack_rows};
pub use plan::{
    Bits, Budget, Corrected, Every, Plan, PlanError, Promise, Scene, SelectCorrection, SelectDepth,
    SelectReciprocal, SelectTier, SelectTransform, SelectWidth, Steps,
};
pub use preset::{Balance, Fidelity, Preset, Speed};
pub use setup::{Cull, Facing, Tier};
pub use shape::{Polygon, PolygonError, Shape, Triangle};
pub use texture::{
    Address, Bilinear, Clamp, Filter, Nearest, Repeat, Sampling, Texture, TextureSize,
};
#[cfg(feature = "micromath")]
pub use transform::FloatError;
pub use transform::{Angle, Mat4, MatrixError, ModelPosition, ShortMat4, SinCos, Vec3};
pub use vertex::{
    ClipVertex, Exact, ExactPosition, Position, Quick, QuickPosition, Rect, Snap, Snapped, Vertex,
    Viewport, ViewportSize,
};
