//! The turning teapot, at four moments side by side, on the EK-LM3S811's OLED.
//!
//! A turn is drawn frame after frame; then the chip resets itself and turns again. What each frame
//! took is printed over UART0.
#![no_std]
#![no_main]

mod ssd0303;

use core::fmt::Write;
use cortex_m_rt::entry;
use hither_scenes::oled::{CacheEntry, FRAMES, MonoBuffers, mono_96x16};
use hither_scenes::spinning_teapot::Moment;
use lm3s::clock::Crystal;
use lm3s::cycles::{Cycles, Report};
use lm3s::turn::{Failure, play};
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

#[entry]
fn main() -> ! {
    play(Crystal::Mhz6, turn)
}

/// Draws and shows each frame of a turn.
fn turn(cycles: &mut Cycles, uart: &mut Uart) -> Result<(), Failure<ssd0303::Error>> {
    let buffers = BUFFERS.try_take().ok_or(Failure::Taken)?;
    let cache = CACHE.try_take().ok_or(Failure::Taken)?;
    let mut panel = Ssd0303::start().map_err(Failure::Panel)?;
    for number in 0..FRAMES {
        let moment = Moment { number, frames: FRAMES };
        let (picture, draw) = cycles.count(|| mono_96x16(moment, buffers, cache));
        let picture = picture?;
        let is_faulty = cfg!(feature = "fault-skip-last-flush") && number + 1 == FRAMES;
        let pages = if is_faulty { picture.len() - 1 } else { picture.len() };
        let (shown, send) = cycles.count(|| panel.show(picture, pages));
        shown.map_err(Failure::Panel)?;
        if number == 0 {
            // Not before: memory holds anything when power comes on.
            panel.light().map_err(Failure::Panel)?;
        }
        // A report that does not get out changes nothing.
        let _ = writeln!(uart, "{}", Report { number, draw, send });
    }
    Ok(())
}
