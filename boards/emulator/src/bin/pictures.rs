//! Draws the checked pictures and prints a line each: name, colours' checksum, depths' checksum.
#![no_std]
#![no_main]

use hither_scenes::pictures::{SIDE, WORDS, draw_all};
use semihosting::println;
use static_cell::ConstStaticCell;

/// On a micro:bit in bands of 16 rows; a whole picture elsewhere.
const LENT: usize = if cfg!(feature = "microbit") { 16 * SIDE as usize } else { WORDS };

static COLOR: ConstStaticCell<[u16; LENT]> = ConstStaticCell::new([0; LENT]);
static DEPTH: ConstStaticCell<[u16; LENT]> = ConstStaticCell::new([0; LENT]);

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    draw_all(COLOR.take(), DEPTH.take(), |name, color, depth| {
        println!("{name}: {color:08x} {depth:08x}");
    });
    semihosting::process::exit(0)
}
