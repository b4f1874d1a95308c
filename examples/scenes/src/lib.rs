//! The scenes that the examples, tests and boards all draw.
//!
//! Everything here is data in flash and integer code: no allocation, and no floating point after compilation.
#![no_std]

pub mod bands_16k;
pub mod checksum;
mod error;
pub mod floor;
pub mod ground;
pub mod luminance;
pub mod oled;
pub mod packing;
pub mod pictures;
pub mod spinning_teapot;
pub mod teapot;
pub mod texture;
pub mod torus;
pub mod trade;
mod trigonometry;
pub mod workloads;

pub use error::SceneError;
