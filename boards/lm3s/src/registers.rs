//! The registers that the boards use, by the datasheet's names and offsets, and the one place that
//! reads and writes them.

use core::ptr::{read_volatile, write_volatile};

/// A 32-bit register.
#[derive(Clone, Copy, Debug)]
pub struct Register(usize);

/// A register did not read as it was waited for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timeout;

/// Reads before a wait is given up: over 8 ms at 50 MHz, where the slowest of what is waited for,
/// a byte on the I2C bus, takes 0.1 ms, and the PLL 0.5 ms.
const PATIENCE: u32 = 100_000;

impl Register {
    /// Its value.
    pub fn read(self) -> u32 {
        // SAFETY: a `Register` is only made in this module, from addresses of 32-bit registers that
        // both chips have. Reading them touches no memory that Rust knows of.
        unsafe { read_volatile(self.0 as *const u32) }
    }

    /// Sets all of it.
    pub fn write(self, value: u32) {
        // SAFETY: as for `read`; no register here makes the chip write to memory by itself.
        unsafe { write_volatile(self.0 as *mut u32, value) }
    }

    /// Sets these bits to 1.
    pub fn set(self, bits: u32) {
        self.write(self.read() | bits);
    }

    /// Sets these bits to 0.
    pub fn clear(self, bits: u32) {
        self.write(self.read() & !bits);
    }

    /// Waits until these bits read as `value`; its last value.
    ///
    /// # Errors
    ///
    /// [`Timeout`] after 100,000 reads.
    pub fn wait_for(self, bits: u32, value: u32) -> Result<u32, Timeout> {
        for _ in 0..PATIENCE {
            let read = self.read();
            if read & bits == value {
                return Ok(read);
            }
        }
        Err(Timeout)
    }
}

/// System control (datasheets, chapter "System Control").
pub mod sysctl {
    use super::Register;

    /// Raw interrupt status.
    pub const RIS: Register = Register(0x400F_E050);
    /// RIS: the PLL has locked.
    pub const RIS_PLLLRIS: u32 = 1 << 6;

    /// Run-mode clock configuration.
    pub const RCC: Register = Register(0x400F_E060);
    /// RCC: the system clock's divisor less 1, of the PLL's 200 MHz.
    pub const RCC_SYSDIV: u32 = 0xF << 23;
    /// RCC: SYSDIV is used.
    pub const RCC_USESYSDIV: u32 = 1 << 22;
    /// RCC: the PLL is off.
    pub const RCC_PWRDN: u32 = 1 << 13;
    /// RCC: the PLL's output is off (LM3S811; reserved on the LM3S6965, where Luminary's own
    /// library clears it too).
    pub const RCC_OEN: u32 = 1 << 12;
    /// RCC: the system clock is the oscillator, not the PLL.
    pub const RCC_BYPASS: u32 = 1 << 11;
    /// RCC: which crystal there is.
    pub const RCC_XTAL: u32 = 0xF << 6;
    /// RCC: the oscillator's source; 0 is the main one.
    pub const RCC_OSCSRC: u32 = 0x3 << 4;
    /// RCC: the main oscillator is off.
    pub const RCC_MOSCDIS: u32 = 1 << 0;

    /// Run-mode clock gating 1: UART0, SSI0 and I2C0 among others.
    pub const RCGC1: Register = Register(0x400F_E104);
    /// RCGC1: UART0 has a clock.
    pub const RCGC1_UART0: u32 = 1 << 0;
    /// RCGC1: SSI0 has a clock.
    pub const RCGC1_SSI0: u32 = 1 << 4;
    /// RCGC1: I2C0 has a clock.
    pub const RCGC1_I2C0: u32 = 1 << 12;

    /// Run-mode clock gating 2: a bit a GPIO port, A in bit 0.
    pub const RCGC2: Register = Register(0x400F_E108);
    /// RCGC2: port A has a clock.
    pub const RCGC2_GPIOA: u32 = 1 << 0;
    /// RCGC2: port B has a clock.
    pub const RCGC2_GPIOB: u32 = 1 << 1;
    /// RCGC2: port C has a clock.
    pub const RCGC2_GPIOC: u32 = 1 << 2;
    /// RCGC2: port D has a clock.
    pub const RCGC2_GPIOD: u32 = 1 << 3;
}

/// A GPIO port; pins are bits (datasheets, chapter "General-Purpose Input/Outputs").
#[derive(Clone, Copy, Debug)]
pub struct Gpio(usize);

/// GPIO port A.
pub const GPIO_A: Gpio = Gpio(0x4000_4000);
/// GPIO port B.
pub const GPIO_B: Gpio = Gpio(0x4000_5000);
/// GPIO port C.
pub const GPIO_C: Gpio = Gpio(0x4000_6000);
/// GPIO port D.
pub const GPIO_D: Gpio = Gpio(0x4000_7000);

impl Gpio {
    /// GPIODATA, of which a write changes these pins only: its address has the mask in bits 9:2.
    pub const fn data(self, pins: u8) -> Register {
        Register(self.0 + ((pins as usize) << 2))
    }

    /// GPIODIR: 1 is an output.
    pub const fn dir(self) -> Register {
        Register(self.0 + 0x400)
    }

    /// GPIOAFSEL: 1 gives the pin to its peripheral.
    pub const fn afsel(self) -> Register {
        Register(self.0 + 0x420)
    }

    /// GPIOODR: 1 is an open drain.
    pub const fn odr(self) -> Register {
        Register(self.0 + 0x50C)
    }

    /// GPIODEN: 1 is a digital pin.
    pub const fn den(self) -> Register {
        Register(self.0 + 0x51C)
    }

    /// Gives digital pins to their peripheral.
    pub fn give(self, pins: u8) {
        self.afsel().set(u32::from(pins));
        self.den().set(u32::from(pins));
    }

    /// Makes digital pins outputs.
    pub fn output(self, pins: u8) {
        self.dir().set(u32::from(pins));
        self.den().set(u32::from(pins));
    }
}

/// UART0 (datasheets, chapter "Universal Asynchronous Receivers/Transmitters").
pub mod uart0 {
    use super::Register;

    /// Data.
    pub const DR: Register = Register(0x4000_C000);
    /// Flags.
    pub const FR: Register = Register(0x4000_C018);
    /// FR: the transmit FIFO is full.
    pub const FR_TXFF: u32 = 1 << 5;
    /// FR: a byte is on its way.
    pub const FR_BUSY: u32 = 1 << 3;
    /// The baud rate's divisor: its whole part.
    pub const IBRD: Register = Register(0x4000_C024);
    /// The baud rate's divisor: 64ths.
    pub const FBRD: Register = Register(0x4000_C028);
    /// Line control.
    pub const LCRH: Register = Register(0x4000_C02C);
    /// LCRH: eight data bits, FIFOs on.
    pub const LCRH_WLEN_8_FEN: u32 = 0b11 << 5 | 1 << 4;
    /// Control.
    pub const CTL: Register = Register(0x4000_C030);
    /// CTL: the UART and its transmitter are on.
    pub const CTL_TXE_UARTEN: u32 = 1 << 8 | 1 << 0;
}

/// SSI0 (datasheets, chapter "Synchronous Serial Interface").
pub mod ssi0 {
    use super::Register;

    /// Control 0.
    pub const CR0: Register = Register(0x4000_8000);
    /// CR0: clock high when idle (SPO), sampled on its second edge (SPH), eight bits (DSS).
    pub const CR0_SPH_SPO_8_BITS: u32 = 1 << 7 | 1 << 6 | 0x7;
    /// Control 1; all 0 is a master that is off.
    pub const CR1: Register = Register(0x4000_8004);
    /// CR1: on.
    pub const CR1_SSE: u32 = 1 << 1;
    /// Data.
    pub const DR: Register = Register(0x4000_8008);
    /// Status.
    pub const SR: Register = Register(0x4000_800C);
    /// SR: a byte is on its way or waits.
    pub const SR_BSY: u32 = 1 << 4;
    /// SR: the receive FIFO is not empty.
    pub const SR_RNE: u32 = 1 << 2;
    /// SR: the transmit FIFO is not full.
    pub const SR_TNF: u32 = 1 << 1;
    /// The clock's even divisor.
    pub const CPSR: Register = Register(0x4000_8010);
}

/// I2C0 as a master (datasheets, chapter "Inter-Integrated Circuit (I2C) Interface").
pub mod i2c0 {
    use super::Register;

    /// Slave address in bits 7:1; bit 0 is 0 to send.
    pub const MSA: Register = Register(0x4002_0000);
    /// Written, control; read, status.
    pub const MCS: Register = Register(0x4002_0004);
    /// MCS, written: a stop condition follows the byte.
    pub const MCS_STOP: u32 = 1 << 2;
    /// MCS, written: a start condition and the address precede the byte.
    pub const MCS_START: u32 = 1 << 1;
    /// MCS, written: go.
    pub const MCS_RUN: u32 = 1 << 0;
    /// MCS, read: the other arbitrating master won.
    pub const MCS_ARBLST: u32 = 1 << 4;
    /// MCS, read: the last byte went wrong.
    pub const MCS_ERROR: u32 = 1 << 1;
    /// MCS, read: a byte is on its way.
    pub const MCS_BUSY: u32 = 1 << 0;
    /// Data.
    pub const MDR: Register = Register(0x4002_0008);
    /// The clock's period less 1, in units of 20 system clocks.
    pub const MTPR: Register = Register(0x4002_000C);
    /// Configuration.
    pub const MCR: Register = Register(0x4002_0020);
    /// MCR: the master is on.
    pub const MCR_MFE: u32 = 1 << 4;
}
