//! A turn of the scene, from reset to reset.

use crate::clock::{self, Crystal};
use crate::cycles::Cycles;
use crate::registers::Timeout;
use crate::uart::Uart;
use core::fmt::{self, Write};
use cortex_m::asm::wfi;
use cortex_m::peripheral::{Peripherals, SCB};
use hither_scenes::SceneError;

/// Why a turn ended early; `E` is what the panel says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Failure<E> {
    /// The PLL did not lock.
    Clock,
    /// The peripherals or the buffers were taken before.
    Taken,
    /// The picture could not be drawn.
    Scene(SceneError),
    /// The panel did not take it.
    Panel(E),
}

impl<E: fmt::Display> fmt::Display for Failure<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Clock => f.write_str("the PLL does not lock"),
            Self::Taken => f.write_str("the peripherals or the buffers are taken"),
            Self::Scene(error) => error.fmt(f),
            Self::Panel(error) => error.fmt(f),
        }
    }
}

impl<E: core::error::Error> core::error::Error for Failure<E> {}

impl<E> From<SceneError> for Failure<E> {
    fn from(error: SceneError) -> Self {
        Self::Scene(error)
    }
}

/// Starts clock, counter and UART, has a turn drawn and shown, and resets the chip.
///
/// The next turn starts from a chip as new. An emulator that stops at a reset keeps the last frame
/// on its panel, to be compared. After a failure, which is printed, the panel keeps what it shows
/// and the chip sleeps.
pub fn play<E: fmt::Display>(
    crystal: Crystal,
    turn: impl FnOnce(&mut Cycles, &mut Uart) -> Result<(), Failure<E>>,
) -> ! {
    let clock = clock::start(crystal);
    let mut uart = Uart::start();
    if let Err(failure) = counted(clock, &mut uart, turn) {
        // A report that does not get out changes nothing.
        let _ = writeln!(uart, "stopped: {failure}");
        loop {
            wfi();
        }
    }
    uart.flush();
    SCB::sys_reset()
}

/// A turn with a counter, once the clock runs.
fn counted<E>(
    clock: Result<(), Timeout>,
    uart: &mut Uart,
    turn: impl FnOnce(&mut Cycles, &mut Uart) -> Result<(), Failure<E>>,
) -> Result<(), Failure<E>> {
    clock.map_err(|Timeout| Failure::Clock)?;
    let core = Peripherals::take().ok_or(Failure::Taken)?;
    turn(&mut Cycles::start(core.SYST), uart)
}
