//! Draws the trade's scenes at the points that say most: see `emulator::trade`.
#![no_std]
#![no_main]

use emulator::trade::Counter;
use hither_scenes::trade;

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    trade::quick(&mut Counter::start());
    semihosting::process::exit(0)
}
