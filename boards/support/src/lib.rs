//! What boards share that send their bands through an embedded-graphics display: a transfer that
//! blocks, and the frames of the spinning teapot.
//!
//! Tested on the host against a model of a panel, down to the bytes on its wires (`tests/panel.rs`).
#![no_std]
#![forbid(unsafe_code)]

mod blocking;
mod teapot;

pub use blocking::Blocking;
pub use teapot::{Cache, Teapot, TeapotError};
