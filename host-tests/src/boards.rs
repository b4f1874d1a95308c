//! The boards: built, and run on emulated machines where there are any, what their panel shows against what the host
//! draws.

pub mod cases;
pub mod oled;
pub mod pico;
pub mod screen;
pub mod table;
