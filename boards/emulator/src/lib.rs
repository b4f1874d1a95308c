//! What the firmwares share: the machine's clock, and its stack.
#![no_std]

pub mod clock;
pub mod stack;
#[cfg(feature = "report")]
pub mod trade;
