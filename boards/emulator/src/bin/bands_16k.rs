//! Draws the teapot at 240 x 240 in a micro:bit's 16 kB of RAM, and prints a line each for some frames: its number, the checksum
//! of its bands, and the bytes of stack that it took.
#![no_std]
#![no_main]

use emulator::stack;
use hither_scenes::bands_16k::{Memory, draw};
use hither_scenes::checksum::Checksum;
use hither_scenes::spinning_teapot::Moment;
use semihosting::println;
use static_cell::ConstStaticCell;

static MEMORY: ConstStaticCell<Memory> = ConstStaticCell::new(Memory::new());

/// Words of stack that are painted: what the memory leaves.
const STACK: usize = 600;

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    let memory = MEMORY.take();
    for number in [0, 21, 42] {
        let painted = stack::paint(STACK);
        let sum = sum(memory, number);
        match (sum, painted.deepest()) {
            (Some(sum), Some(stack)) => println!("{number} {sum:08x} {stack}"),
            _ => println!("{number} failed"),
        }
    }
    semihosting::process::exit(0)
}

/// The checksum of a frame's bands.
#[inline(never)]
fn sum(memory: &mut Memory, number: u32) -> Option<u32> {
    let mut sum = Checksum::new();
    draw(memory, Moment { number, frames: 64 }, |_, words| sum = sum.with_words(words)).ok()?;
    Some(sum.value())
}
