//! embedded-graphics in both directions: any of its draw targets is a [`Target`](crate::Target), and
//! framebuffers and bands are draw targets.

mod color;
mod on_display;

pub use color::DisplayColor;
pub use on_display::OnDisplay;
