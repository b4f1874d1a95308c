//! The SSD0303 on the EK-LM3S811: an OSRAM Pictiva of 96 x 16 pixels in black and white, over I2C0.
//!
//! Commands are those of the SSD0303's datasheet, table "Command Table". Pins: I2CSCL PB2, I2CSDA
//! PB3.

use core::fmt;
use cortex_m::asm::delay;
use hither_scenes::oled::{MONO_WIDTH, MonoPicture};
use lm3s::clock::{HERTZ, enable};
use lm3s::registers::i2c0::{
    MCR, MCR_MFE, MCS, MCS_ARBLST, MCS_BUSY, MCS_ERROR, MCS_RUN, MCS_START, MCS_STOP, MDR, MSA,
    MTPR,
};
use lm3s::registers::sysctl::{RCGC1_I2C0, RCGC2_GPIOB};
use lm3s::registers::{GPIO_B, Timeout};

/// PB2, the clock.
const SCL: u8 = 1 << 2;

/// PB3, the data.
const SDA: u8 = 1 << 3;

/// The panel's address: 7 bits.
const ADDRESS: u32 = 0x3D;

/// Bits a second on the bus.
const BAUD: u32 = 100_000;

/// Turns of the waiting loop, three clocks each on a Cortex-M3, that the SSD0303 gets between bytes:
/// 0.1 ms, as long as a byte takes. It misses bytes that follow at once.
const REST: u32 = HERTZ / 10_000 / 3;

/// Control byte: one byte of a command follows, then another control byte.
const COMMAND: u8 = 0x80;

/// Control byte: what follows is for the memory, up to the stop.
const DATA: u8 = 0x40;

/// The controller's first column that the panel has: its 96 are the last of 132.
const FIRST_COLUMN: u8 = 132 - MONO_WIDTH as u8;

/// What the panel is set to while it is off, command after command: what OSRAM gives for it.
const SETUP: [&[u8]; 14] = [
    // Display off.
    &[0xAE],
    // Contrast: 43 of 255.
    &[0x81, 43],
    // Segments from the other end.
    &[0xA1],
    // Start line 0.
    &[0x40],
    // Display offset.
    &[0xD3, 0],
    // Multiplex ratio, less 1.
    &[0xA8, 15],
    // What memory holds.
    &[0xA4],
    // Not inverted.
    &[0xA6],
    // Lines from the other end.
    &[0xC8],
    // Clock divider and oscillator frequency.
    &[0xD5, 0x72],
    // One colour.
    &[0xD8, 0x00],
    // Precharge period.
    &[0xD9, 0x22],
    // How lines are connected.
    &[0xDA, 0x12],
    // VCOM deselect level.
    &[0xDB, 0x0F],
];

/// Why the panel did not take a command or a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// The I2C master did not end a byte.
    BusStuck,
    /// Another master took the bus.
    ArbitrationLost,
    /// The panel did not acknowledge.
    NotAcknowledged,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::BusStuck => "the I2C bus to the SSD0303 is stuck",
            Self::ArbitrationLost => "another master took the I2C bus to the SSD0303",
            Self::NotAcknowledged => "the SSD0303 did not acknowledge",
        })
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
pub struct Ssd0303(());

impl Ssd0303 {
    /// Sets the bus and the panel up; the panel is off.
    ///
    /// # Errors
    ///
    /// What the bus says.
    pub fn start() -> Result<Self, Error> {
        enable(RCGC1_I2C0, RCGC2_GPIOB);
        GPIO_B.give(SCL | SDA);
        GPIO_B.odr().set((SCL | SDA).into());
        MCR.write(MCR_MFE);
        MTPR.write(HERTZ / (20 * BAUD) - 1);
        MSA.write(ADDRESS << 1);
        let mut panel = Self(());
        for command in SETUP {
            panel.command(command)?;
        }
        // DC-DC converter on.
        panel.command(&[0xAD, 0x8B])?;
        Ok(panel)
    }

    /// Lights the panel.
    ///
    /// # Errors
    ///
    /// What the bus says.
    pub fn light(&mut self) -> Result<(), Error> {
        self.command(&[0xAF])
    }

    /// Shows pages of a picture, from the top; pages that are missing stay.
    ///
    /// # Errors
    ///
    /// What the bus says.
    pub fn show(&mut self, picture: &MonoPicture, pages: usize) -> Result<(), Error> {
        for (number, page) in (0..).zip(picture.iter().take(pages)) {
            // The page, then the column's low four bits and its high ones.
            self.command(&[0xB0 | number])?;
            self.command(&[FIRST_COLUMN & 0xF])?;
            self.command(&[0x10 | FIRST_COLUMN >> 4])?;
            self.send(DATA, MCS_START)?;
            let (last, columns) = page.split_last().unwrap_or((&0, &[]));
            for column in columns {
                self.send(*column, 0)?;
            }
            self.send(*last, MCS_STOP)?;
        }
        Ok(())
    }

    /// Sends a command in a transfer of its own.
    ///
    /// QEMU's panel wants that: after a command's second byte it takes no other in the same
    /// transfer. To the chip it is the same.
    fn command(&mut self, bytes: &[u8]) -> Result<(), Error> {
        for (at, byte) in bytes.iter().enumerate() {
            self.send(COMMAND, if at == 0 { MCS_START } else { 0 })?;
            self.send(*byte, if at + 1 == bytes.len() { MCS_STOP } else { 0 })?;
        }
        Ok(())
    }

    /// Sends a byte, with a start before it or a stop behind it.
    fn send(&mut self, byte: u8, conditions: u32) -> Result<(), Error> {
        MDR.write(byte.into());
        MCS.write(conditions | MCS_RUN);
        let status = MCS.wait_for(MCS_BUSY, 0)?;
        delay(REST);
        if status & MCS_ARBLST != 0 {
            return Err(Error::ArbitrationLost);
        }
        if status & MCS_ERROR != 0 {
            // The bus is freed, whatever the panel says: without, no next transfer could start.
            MCS.write(MCS_STOP);
            return Err(Error::NotAcknowledged);
        }
        Ok(())
    }
}
