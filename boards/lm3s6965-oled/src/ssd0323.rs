//! The SSD0323 on the EK-LM3S6965: an OSRAM Pictiva of 128 x 64 pixels in 16 greys, over SSI0.
//!
//! Commands are those of the SSD0323's datasheet, table "Command Table". Pins: SSI0Clk PA2, SSI0Fss
//! (chip select) PA3, SSI0Tx PA5, D/C PC7. PD0, the chip select of the SD card on the same bus, is
//! held high.

use core::fmt;
use hither_scenes::oled::{GRAY_HEIGHT, GRAY_WIDTH};
use lm3s::clock::{HERTZ, enable};
use lm3s::registers::ssi0::{
    CPSR, CR0, CR0_SPH_SPO_8_BITS, CR1, CR1_SSE, DR, SR, SR_BSY, SR_RNE, SR_TNF,
};
use lm3s::registers::sysctl::{RCGC1_SSI0, RCGC2_GPIOA, RCGC2_GPIOC, RCGC2_GPIOD};
use lm3s::registers::{GPIO_A, GPIO_C, GPIO_D, Timeout};

/// PA2, PA3 and PA5: clock, chip select and data.
const SSI_PINS: u8 = 1 << 2 | 1 << 3 | 1 << 5;

/// PC7: high for data, low for commands.
const DATA_COMMAND: u8 = 1 << 7;

/// PD0: the SD card's chip select, active low. (QEMU selects the panel by it, when it is high.)
const CARD_SELECT: u8 = 1 << 0;

/// The system clock by 20: 2.5 MHz. The SSD0323 takes 4 MHz (a clock cycle of 250 ns).
const PRESCALE: u32 = 20;

const _: () = assert!(HERTZ / PRESCALE <= 4_000_000, "the SSD0323's clock is too fast");

/// What the panel is set to while it is off, command after command: what OSRAM gives for it
/// (application note AN018).
const SETUP: [&[u8]; 16] = [
    // Display off.
    &[0xAE],
    // Contrast: 50 of 127.
    &[0x81, 50],
    // Half of the current range.
    &[0x85],
    // Re-map: the left pixel in the high bits (bit 1), row after row (bit 2 is 0), the panel's lines
    // connected from the other end (bit 4), odd ones apart from even ones (bit 6).
    &[0xA0, 0x52],
    // Start line.
    &[0xA1, 0],
    // Display offset, in lines.
    &[0xA2, 76],
    // What memory holds, not inverted.
    &[0xA4],
    // Multiplex ratio, less 1.
    &[0xA8, 63],
    // Phase lengths.
    &[0xB1, 0x22],
    // Row period.
    &[0xB2, 70],
    // Clock divider and oscillator frequency.
    &[0xB3, 0xF1],
    // Segment low voltage.
    &[0xBF, 0x0D],
    // VCOMH voltage.
    &[0xBE, 0x02],
    // Precharge voltage.
    &[0xBC, 0x10],
    // Grey scale table.
    &[0xB8, 0x01, 0x11, 0x22, 0x32, 0x43, 0x54, 0x65, 0x76],
    // DC-DC converter on.
    &[0xAD, 0x03],
];

/// Why the panel did not take a command or a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// The SSI did not send what it had.
    BusStuck,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BusStuck => f.write_str("the SSI to the SSD0323 is stuck"),
        }
    }
}

impl core::error::Error for Error {}

impl From<Timeout> for Error {
    fn from(Timeout: Timeout) -> Self {
        Self::BusStuck
    }
}

/// The panel.
#[derive(Debug)]
pub struct Ssd0323(());

impl Ssd0323 {
    /// Sets the bus and the panel up; the panel is off.
    ///
    /// # Errors
    ///
    /// [`Error::BusStuck`].
    pub fn start() -> Result<Self, Error> {
        enable(RCGC1_SSI0, RCGC2_GPIOA | RCGC2_GPIOC | RCGC2_GPIOD);
        GPIO_D.output(CARD_SELECT);
        GPIO_D.data(CARD_SELECT).write(CARD_SELECT.into());
        GPIO_C.output(DATA_COMMAND);
        // An edge first: QEMU's panel hears of edges only, and after a reset of the chip it is
        // still in its last state. To the panel it is nothing, since no clock comes with it.
        GPIO_C.data(DATA_COMMAND).write(DATA_COMMAND.into());
        GPIO_C.data(DATA_COMMAND).write(0);
        GPIO_A.give(SSI_PINS);
        CR1.write(0);
        CPSR.write(PRESCALE);
        // The SSD0323 takes a bit on the rising edge. With SPH set, chip select stays low from byte
        // to byte.
        CR0.write(CR0_SPH_SPO_8_BITS);
        CR1.write(CR1_SSE);
        let mut panel = Self(());
        for command in SETUP {
            panel.send(false, command)?;
        }
        Ok(panel)
    }

    /// Lights the panel.
    ///
    /// # Errors
    ///
    /// [`Error::BusStuck`].
    pub fn light(&mut self) -> Result<(), Error> {
        self.send(false, &[0xAF])
    }

    /// Shows rows of a picture, from the top, 64 bytes each; rows that are missing stay.
    ///
    /// # Errors
    ///
    /// [`Error::BusStuck`].
    pub fn show(&mut self, rows: &[u8]) -> Result<(), Error> {
        const LAST_COLUMN: u8 = (GRAY_WIDTH / 2 - 1) as u8;
        const LAST_ROW: u8 = (GRAY_HEIGHT - 1) as u8;
        // The window's columns, two pixels each, then its rows.
        self.send(false, &[0x15, 0, LAST_COLUMN])?;
        self.send(false, &[0x75, 0, LAST_ROW])?;
        self.send(true, rows)
    }

    /// Sends bytes of a command or of the picture.
    fn send(&mut self, data: bool, bytes: &[u8]) -> Result<(), Error> {
        // D/C belongs to a byte's last bit: it may change when the bytes before are out.
        SR.wait_for(SR_BSY, 0)?;
        let level = if data { DATA_COMMAND } else { 0 };
        GPIO_C.data(DATA_COMMAND).write(level.into());
        for byte in bytes {
            SR.wait_for(SR_TNF, SR_TNF)?;
            DR.write((*byte).into());
            // What comes back is nothing: nobody drives the line. On the chip it could be left, and
            // would overrun the receive FIFO; QEMU's SSI stops sending when that is full.
            while SR.read() & SR_RNE != 0 {
                DR.read();
            }
        }
        Ok(())
    }
}
