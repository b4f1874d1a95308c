//! The turning teapot four times over on the EK-LM3S811's OLED.
//!
//! A turn is drawn frame after frame; then the chip resets itself and turns again. What each frame
//! took is printed over UART0.
#![no_std]
#![no_main]

mod ssd0303;

use core::fmt::{self, Write};
use cortex_m::peripheral::SCB;
use cortex_m_rt::entry;
use hither_scenes::SceneError;
use hither_scenes::oled::{CacheEntry, FRAMES, MonoBuffers, mono_96x16};
use hither_scenes::spinning_teapot::Moment;
use lm3s::clock::{self, Crystal};
use lm3s::cycles::{Cycles, Report};
use lm3s::registers::Timeout;
use lm3s::uart::Uart;
use panic_halt as _;
use ssd0303::Ssd0303;
use static_cell::ConstStaticCell;

static BUFFERS: ConstStaticCell<MonoBuffers> = ConstStaticCell::new(MonoBuffers::EMPTY);

/// Entries of the vertex cache: what RAM allows. The vertices beyond are transformed again where
/// they are used; the picture is the same.
const CACHED: usize = 64;

static CACHE: ConstStaticCell<[CacheEntry; CACHED]> =
    ConstStaticCell::new([CacheEntry::EMPTY; CACHED]);

/// Why the turn ended early.
enum Failure {
    /// The PLL did not lock.
    Clock,
    /// The picture could not be drawn.
    Scene(SceneError),
    /// The panel did not take it.
    Panel(ssd0303::Error),
    /// The peripherals or the buffers were taken before.
    Taken,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Clock => f.write_str("the PLL does not lock"),
            Self::Scene(error) => error.fmt(f),
            Self::Panel(error) => error.fmt(f),
            Self::Taken => f.write_str("the peripherals or the buffers are taken"),
        }
    }
}

impl From<Timeout> for Failure {
    fn from(Timeout: Timeout) -> Self {
        Self::Clock
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self::Scene(error)
    }
}

impl From<ssd0303::Error> for Failure {
    fn from(error: ssd0303::Error) -> Self {
        Self::Panel(error)
    }
}

#[entry]
fn main() -> ! {
    let clock = clock::start(Crystal::Mhz6);
    let mut uart = Uart::start();
    if let Err(failure) = clock.map_err(Failure::from).and_then(|()| turn(&mut uart)) {
        // A report that does not get out changes nothing: the panel keeps its last frame.
        let _ = writeln!(uart, "stopped: {failure}");
        loop {
            cortex_m::asm::wfi();
        }
    }
    uart.flush();
    // The next turn starts from a chip as new. An emulator that stops at a reset keeps the last
    // frame on its panel, to be compared.
    SCB::sys_reset()
}

/// Draws and shows each frame of a turn.
fn turn(uart: &mut Uart) -> Result<(), Failure> {
    let core = cortex_m::Peripherals::take().ok_or(Failure::Taken)?;
    let mut cycles = Cycles::start(core.SYST);
    let mut panel = Ssd0303::start()?;
    let buffers = BUFFERS.try_take().ok_or(Failure::Taken)?;
    let cache = CACHE.try_take().ok_or(Failure::Taken)?;
    for number in 0..FRAMES {
        let moment = Moment { number, frames: FRAMES };
        let (picture, draw) = cycles.count(|| mono_96x16(moment, buffers, cache));
        let picture = picture?;
        let is_faulty = cfg!(feature = "fault-skip-last-flush") && number + 1 == FRAMES;
        let pages = if is_faulty { picture.len() - 1 } else { picture.len() };
        let (shown, send) = cycles.count(|| panel.show(picture, pages));
        shown?;
        if number == 0 {
            // Not before: memory holds anything when power comes on.
            panel.light()?;
        }
        // A report that does not get out changes nothing.
        let _ = writeln!(uart, "{}", Report { number, draw, send });
    }
    Ok(())
}
