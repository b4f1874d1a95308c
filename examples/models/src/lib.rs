//! From a model in a file to a mesh that hither draws.
//!
//! [`Model::read`] takes the text of a Wavefront OBJ through all steps, a module each:
//!
//! ```text
//! obj --> triangulate --> weld --> order --> Model
//! text    faces to        corners  triangles     |
//! to      triangles on    to       and vertices  +--> bounds: what a planner is told
//! faces   the grid        vertices               +--> module: Rust source for flash
//! ```
//!
//! [`Image::read_png`] reads a texture. Every error of a model names its line, the value and the limit.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod bounds;
mod error;
pub mod image;
mod model;
pub mod module;
mod normals;
pub mod obj;
pub mod order;
pub mod triangulate;
mod weld;

pub use bounds::Bounds;
pub use error::{ObjError, Problem};
pub use image::{Image, ImageError};
pub use model::{Counts, Model};
pub use obj::{Obj, Warning};
pub use weld::{Keep, ModelVertex};

/// An OBJ to begin with: a sailing boat, with a colour a vertex and no normals of its own.
pub const SAILBOAT: &[u8] = include_bytes!("../sailboat.obj");

/// A die, with texture coordinates for [`DIE_TEXTURE`].
pub const DIE: &[u8] = include_bytes!("../die.obj");

/// The faces of [`DIE`], a PNG.
pub const DIE_TEXTURE: &[u8] = include_bytes!("../die.png");
