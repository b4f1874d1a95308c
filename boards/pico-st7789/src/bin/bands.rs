//! The spinning teapot in bands: one is drawn while DMA sends the one before.
#![no_std]
#![no_main]

use embedded_hal::digital::OutputPin;
use hither::{Rgb565Be, SwapChain, Viewport};
use hither_scenes::spinning_teapot::VERTEX_COUNT;
use pico_st7789::board::Board;
use pico_st7789::dma::{DmaPanel, Words};
use pico_st7789::panel::{HEIGHT, WIDTH, initialise, interface};
use pico_st7789::scene::{Cached, FRAMES, draw};
use static_cell::ConstStaticCell;

/// Rows of a band; the last of a frame has the 48 that are left.
const ROWS: usize = 64;

const BAND: usize = WIDTH as usize * ROWS;

static FIRST: ConstStaticCell<[u16; BAND]> = ConstStaticCell::new([0; BAND]);
static SECOND: ConstStaticCell<[u16; BAND]> = ConstStaticCell::new([0; BAND]);
static DEPTH: ConstStaticCell<[u16; BAND]> = ConstStaticCell::new([0; BAND]);
static CACHE: ConstStaticCell<[Cached; VERTEX_COUNT]> =
    ConstStaticCell::new([Cached::EMPTY; VERTEX_COUNT]);

#[rp2040_hal::entry]
fn main() -> ! {
    let Board { mut spi, mut cs, mut dc, reset, mut marker, dma, mut timer } = Board::take();
    let panel = interface(&mut spi, &mut cs, &mut dc, &mut []).expect("pins do not fail");
    initialise(panel, reset, &mut timer).expect("pins do not fail, and the size is the panel's");

    let (first, second): (Words, Words) = (FIRST.take(), SECOND.take());
    let mut chain = SwapChain::new(DmaPanel::new(dma, spi, cs, dc), first, Some(second));
    let (depth, cache) = (DEPTH.take(), CACHE.take());
    let picture = Viewport::new(WIDTH.into(), HEIGHT.into()).expect("at most 512 x 512");
    let mut number = 0;
    loop {
        let start = timer.get_counter();
        marker.set_high().expect("pins do not fail");
        let sent = chain.frame(&picture, |band, words| {
            let drawn = band
                .framebuffer::<Rgb565Be>(words)
                .map_err(Into::into)
                .and_then(|buffer| draw(buffer, band.viewport(), depth, number, cache));
            if let Err(error) = drawn {
                defmt::error!("band at row {}: {}", band.y(), defmt::Display2Format(&error));
            }
        });
        marker.set_low().expect("pins do not fail");
        let microseconds = (timer.get_counter() - start).to_micros();
        match sent {
            Ok(()) => defmt::info!("frame {}: {} us", number, microseconds),
            Err(error) => defmt::error!("frame {}: {}", number, defmt::Debug2Format(&error)),
        }
        number = (number + 1) % FRAMES;
    }
}
