//! embedded-graphics in both directions: any of its draw targets is a [`Target`](crate::Target), and
//! framebuffers and bands are draw targets.

mod color;
mod filled;
mod framebuffer;
mod on_band;
mod on_display;

pub use color::{AsPixelColor, DisplayColor};
pub use filled::{Fill, Filled};
pub use on_band::OnBand;
pub use on_display::OnDisplay;
