//! The turning teapot in 16 greys on the EK-LM3S6965's OLED.
//!
//! A turn is drawn frame after frame; then the chip resets itself and turns again. What each frame
//! took is printed over UART0.
#![no_std]
#![no_main]

mod ssd0323;

use core::fmt::{self, Write};
use cortex_m::peripheral::SCB;
use cortex_m_rt::entry;
use hither_scenes::SceneError;
use hither_scenes::oled::{CacheEntry, FRAMES, GRAY_WIDTH, GrayBuffers, GrayPicture, gray_128x64};
use hither_scenes::spinning_teapot::{Moment, VERTEX_COUNT};
use lm3s::clock::{self, Crystal};
use lm3s::cycles::{Cycles, Report};
use lm3s::registers::Timeout;
use lm3s::uart::Uart;
use panic_halt as _;
use ssd0323::Ssd0323;
use static_cell::ConstStaticCell;

static BUFFERS: ConstStaticCell<GrayBuffers> = ConstStaticCell::new(GrayBuffers::EMPTY);

/// An entry a vertex: each is transformed once.
static CACHE: ConstStaticCell<[CacheEntry; VERTEX_COUNT]> =
    ConstStaticCell::new([CacheEntry::EMPTY; VERTEX_COUNT]);

/// Why the turn ended early.
enum Failure {
    /// The PLL did not lock.
    Clock,
    /// The picture could not be drawn.
    Scene(SceneError),
    /// The panel did not take it.
    Panel(ssd0323::Error),
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

impl From<ssd0323::Error> for Failure {
    fn from(error: ssd0323::Error) -> Self {
        Self::Panel(error)
    }
}

#[entry]
fn main() -> ! {
    let clock = clock::start(Crystal::Mhz8);
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
    let mut panel = Ssd0323::start()?;
    let buffers = BUFFERS.try_take().ok_or(Failure::Taken)?;
    let cache = CACHE.try_take().ok_or(Failure::Taken)?;
    for number in 0..FRAMES {
        let moment = Moment { number, frames: FRAMES };
        let (picture, draw) = cycles.count(|| gray_128x64(moment, buffers, cache));
        let picture = picture?;
        let is_faulty = cfg!(feature = "fault-skip-last-flush") && number + 1 == FRAMES;
        let rows = if is_faulty { faulty(picture) } else { picture };
        let (shown, send) = cycles.count(|| panel.show(rows));
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

/// A picture without its last eight rows: a single row of the ground may well look as it did the
/// frame before.
fn faulty(picture: &GrayPicture) -> &[u8] {
    const MISSING: usize = 8 * GRAY_WIDTH as usize / 2;
    picture.split_last_chunk::<MISSING>().map_or(&[], |(rows, _)| rows)
}
