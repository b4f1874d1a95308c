//! Draws the checked pictures and prints a line each: name, colours' checksum, depths' checksum.
#![no_std]
#![no_main]

use hither_scenes::pictures::{WORDS, draw_all};
use semihosting::println;
use static_cell::ConstStaticCell;

static COLOR: ConstStaticCell<[u16; WORDS]> = ConstStaticCell::new([0; WORDS]);
static DEPTH: ConstStaticCell<[u16; WORDS]> = ConstStaticCell::new([0; WORDS]);

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    draw_all(COLOR.take(), DEPTH.take(), |name, color, depth| {
        println!("{name}: {color:08x} {depth:08x}");
    });
    semihosting::process::exit(0)
}
