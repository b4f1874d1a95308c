//! The spinning teapot as full frames, through mipidsi's draw target: plain, and it blocks.
#![no_std]
#![no_main]

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::Dimensions;
use embedded_graphics_core::pixelcolor;
use embedded_hal::digital::OutputPin;
use hither::{Framebuffer, Rgb565, Viewport};
use pico_st7789::board::Board;
use pico_st7789::panel::{HEIGHT, WIDTH, initialise, interface};
use pico_st7789::scene::{Cached, FRAMES, draw};
use static_cell::ConstStaticCell;

const PIXELS: usize = WIDTH as usize * HEIGHT as usize;

/// About half of the vertices: beside colour and depth RAM is short. The others are transformed again
/// where they are used.
const CACHED: usize = 256;

/// Bytes that mipidsi gathers before it sends them.
const GATHERED: usize = 512;

static COLOR: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
static DEPTH: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
static CACHE: ConstStaticCell<[Cached; CACHED]> = ConstStaticCell::new([Cached::EMPTY; CACHED]);
static GATHER: ConstStaticCell<[u8; GATHERED]> = ConstStaticCell::new([0; GATHERED]);

#[rp2040_hal::entry]
fn main() -> ! {
    let Board { spi, cs, dc, reset, mut marker, mut timer, .. } = Board::take();
    let panel = interface(spi, cs, dc, GATHER.take()).expect("pins do not fail");
    let mut display = initialise(panel, reset, &mut timer)
        .expect("pins do not fail, and the size is the panel's");

    let (color, depth, cache) = (COLOR.take(), DEPTH.take(), CACHE.take());
    let picture = Viewport::new(WIDTH.into(), HEIGHT.into()).expect("at most 512 x 512");
    let mut number = 0;
    loop {
        let start = timer.get_counter();
        marker.set_high().expect("pins do not fail");
        let drawn = Framebuffer::<Rgb565>::try_new(color, WIDTH.into(), HEIGHT.into())
            .map_err(Into::into)
            .and_then(|buffer| draw(buffer, picture, depth, number, cache));
        let all = display.bounding_box();
        let colors = color.iter().map(|&word| pixelcolor::Rgb565::from(Rgb565(word)));
        let sent = display.fill_contiguous(&all, colors);
        marker.set_low().expect("pins do not fail");
        let microseconds = (timer.get_counter() - start).to_micros();
        match (drawn, sent) {
            (Ok(_), Ok(())) => defmt::info!("frame {}: {} us", number, microseconds),
            (Err(error), _) => defmt::error!("frame {}: {}", number, defmt::Display2Format(&error)),
            (_, Err(error)) => defmt::error!("frame {}: {}", number, defmt::Debug2Format(&error)),
        }
        number = (number + 1) % FRAMES;
    }
}
