//! Emulated boards with a display: what their panel shows, against what the host draws.

pub mod oled;
pub mod pico;
pub mod screen;
