//! The system clock, and the clocks of the peripherals.

use crate::registers::Timeout;
use crate::registers::sysctl::{
    RCC, RCC_BYPASS, RCC_MOSCDIS, RCC_OEN, RCC_OSCSRC, RCC_PWRDN, RCC_SYSDIV, RCC_USESYSDIV,
    RCC_XTAL, RCGC1, RCGC2, RIS, RIS_PLLLRIS,
};
use cortex_m::asm::delay;

/// The system clock that [`start`] sets, in hertz: the fastest of both chips.
pub const HERTZ: u32 = 50_000_000;

/// The crystal on the board, as RCC's field XTAL.
#[derive(Clone, Copy, Debug)]
pub enum Crystal {
    /// 6 MHz.
    Mhz6 = 0xB << 6,
    /// 8 MHz.
    Mhz8 = 0xE << 6,
}

/// SYSDIV for 200 MHz / 4.
const SYSDIV_4: u32 = 3 << 23;

/// System clocks that the main oscillator gets to start: 5 ms at the 12 MHz of a chip just reset.
const OSCILLATOR_START: u32 = 60_000;

/// Runs the chip from its PLL at [`HERTZ`], in the order of the datasheets' section "Initialization
/// and Configuration" of system control. The chip was just reset.
///
/// # Errors
///
/// [`Timeout`] where the PLL does not lock.
pub fn start(crystal: Crystal) -> Result<(), Timeout> {
    let mut rcc = (RCC.read() | RCC_BYPASS) & !(RCC_USESYSDIV | RCC_MOSCDIS);
    RCC.write(rcc);
    delay(OSCILLATOR_START);
    rcc &= !(RCC_XTAL | RCC_OSCSRC | RCC_PWRDN | RCC_OEN);
    rcc |= crystal as u32;
    RCC.write(rcc);
    rcc = rcc & !RCC_SYSDIV | SYSDIV_4 | RCC_USESYSDIV;
    RCC.write(rcc);
    RIS.wait_for(RIS_PLLLRIS, RIS_PLLLRIS)?;
    RCC.write(rcc & !RCC_BYPASS);
    Ok(())
}

/// Gives peripherals their clocks, as bits of RCGC1 and RCGC2.
pub fn enable(rcgc1: u32, rcgc2: u32) {
    RCGC1.set(rcgc1);
    RCGC2.set(rcgc2);
    // A peripheral can be reached three system clocks later.
    delay(3);
}
