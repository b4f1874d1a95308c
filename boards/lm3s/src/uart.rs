//! UART0 for text: 115,200 baud, 8 bits, no parity, pin PA1. The evaluation boards' debugger shows
//! it as a serial port over USB.

use crate::clock::{HERTZ, enable};
use crate::registers::GPIO_A;
use crate::registers::sysctl::{RCGC1_UART0, RCGC2_GPIOA};
use crate::registers::uart0::{
    CTL, CTL_TXE_UARTEN, DR, FBRD, FR, FR_BUSY, FR_TXFF, IBRD, LCRH, LCRH_WLEN_8_FEN,
};
use core::fmt;

/// In bits a second.
const BAUD: u32 = 115_200;

/// The baud rate's divisor in 64ths, rounded: `HERTZ / (16 BAUD)`.
const DIVISOR: u32 = (HERTZ * 4 + BAUD / 2) / BAUD;

/// UART0's receiver and transmitter.
const PINS: u8 = 1 << 0 | 1 << 1;

/// What is written goes out.
#[derive(Debug)]
pub struct Uart(());

impl Uart {
    /// Sets it up, for a system clock of [`HERTZ`].
    pub fn start() -> Self {
        enable(RCGC1_UART0, RCGC2_GPIOA);
        GPIO_A.give(PINS);
        CTL.write(0);
        IBRD.write(DIVISOR / 64);
        FBRD.write(DIVISOR % 64);
        LCRH.write(LCRH_WLEN_8_FEN);
        CTL.write(CTL_TXE_UARTEN);
        Self(())
    }

    /// Waits until all is sent: a reset would cut it off. One that never is, is left.
    pub fn flush(&mut self) {
        let _ = FR.wait_for(FR_BUSY, 0);
    }
}

impl fmt::Write for Uart {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            FR.wait_for(FR_TXFF, 0).map_err(|_| fmt::Error)?;
            DR.write(u32::from(byte));
        }
        Ok(())
    }
}
