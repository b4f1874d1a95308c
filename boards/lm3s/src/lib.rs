//! What the boards with Stellaris LM3S chips share: registers, clock, UART, a cycle counter, and
//! how a turn of the scene begins and ends.
//!
//! Names are the datasheets' (LM3S811, LM3S6965); where only one of them is meant, it is said.
#![no_std]

pub mod clock;
pub mod cycles;
pub mod registers;
pub mod turn;
pub mod uart;
