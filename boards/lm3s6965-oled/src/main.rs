//! The turning teapot in 16 greys on the EK-LM3S6965's OLED.
//!
//! A turn is drawn frame after frame; then the chip resets itself and turns again. What each frame
//! took is printed over UART0.
#![no_std]
#![no_main]

mod ssd0323;

use core::fmt::Write;
use cortex_m_rt::entry;
use hither_scenes::oled::{CacheEntry, FRAMES, GRAY_WIDTH, GrayBuffers, GrayPicture, gray_128x64};
use hither_scenes::spinning_teapot::{Moment, VERTEX_COUNT};
use lm3s::clock::Crystal;
use lm3s::cycles::{Cycles, Report};
use lm3s::turn::{Failure, play};
use lm3s::uart::Uart;
use panic_halt as _;
use ssd0323::Ssd0323;
use static_cell::ConstStaticCell;

static BUFFERS: ConstStaticCell<GrayBuffers> = ConstStaticCell::new(GrayBuffers::EMPTY);

/// An entry a vertex: each is transformed once.
static CACHE: ConstStaticCell<[CacheEntry; VERTEX_COUNT]> =
    ConstStaticCell::new([CacheEntry::EMPTY; VERTEX_COUNT]);

#[entry]
fn main() -> ! {
    play(Crystal::Mhz8, turn)
}

/// Draws and shows each frame of a turn.
fn turn(cycles: &mut Cycles, uart: &mut Uart) -> Result<(), Failure<ssd0323::Error>> {
    let buffers = BUFFERS.try_take().ok_or(Failure::Taken)?;
    let cache = CACHE.try_take().ok_or(Failure::Taken)?;
    let mut panel = Ssd0323::start().map_err(Failure::Panel)?;
    for number in 0..FRAMES {
        let moment = Moment { number, frames: FRAMES };
        let (picture, draw) = cycles.count(|| gray_128x64(moment, buffers, cache));
        let picture = picture?;
        let is_faulty = cfg!(feature = "fault-skip-last-flush") && number + 1 == FRAMES;
        let rows = if is_faulty { faulty(picture) } else { picture };
        let (shown, send) = cycles.count(|| panel.show(rows));
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

/// A picture without its last eight rows: a single row of the ground may well look as it did the
/// frame before.
fn faulty(picture: &GrayPicture) -> &[u8] {
    const MISSING: usize = 8 * GRAY_WIDTH as usize / 2;
    picture.split_last_chunk::<MISSING>().map_or(&[], |(rows, _)| rows)
}
