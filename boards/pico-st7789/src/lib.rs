//! A Raspberry Pi Pico with a 240 x 240 ST7789 on SPI0: what its firmwares share.
#![no_std]

use defmt_rtt as _;
use panic_probe as _;

pub mod board;
pub mod dma;
pub mod panel;
pub mod scene;
