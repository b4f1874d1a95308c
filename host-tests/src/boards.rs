//! Emulated boards with a display: what their panel shows, against what the host draws.

pub mod pico;
pub mod screen;
