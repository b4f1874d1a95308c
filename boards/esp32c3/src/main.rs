//! The spinning teapot on an ESP32-C3 with a 240 x 240 ST7789, 64 frames a turn, for ever.
#![no_std]
#![no_main]

use board_support::{Blocking, Cache, Teapot};
use embedded_hal_bus::spi::ExclusiveDevice;
use esp_backtrace as _;
use esp_hal::clock::CpuClock;
use esp_hal::delay::Delay;
use esp_hal::gpio::{Level, Output, OutputConfig};
use esp_hal::spi::Mode;
use esp_hal::spi::master::{Config, Spi};
use esp_hal::time::{Instant, Rate};
use esp_println::println;
use hither::{SwapChain, Vertex, Viewport};
use hither_scenes::spinning_teapot::{Moment, VERTEX_COUNT};
use mipidsi::Builder;
use mipidsi::interface::SpiInterface;
use mipidsi::models::ST7789;
use mipidsi::options::ColorInversion;
use static_cell::ConstStaticCell;

/// The panel's sides, in pixels.
const SIDE: u16 = 240;
/// Rows that are drawn and sent together: a sixth of the panel.
const ROWS: usize = 40;
/// Pixels of a band.
const BAND: usize = SIDE as usize * ROWS;
/// Frames a turn.
const FRAMES: u32 = 64;

static COLOR: ConstStaticCell<[u16; BAND]> = ConstStaticCell::new([0; BAND]);
static DEPTH: ConstStaticCell<[u16; BAND]> = ConstStaticCell::new([0; BAND]);
static VERTICES: ConstStaticCell<Cache> = ConstStaticCell::new([Vertex::EMPTY; VERTEX_COUNT]);
/// What the display's driver gathers before it sends.
static BATCH: ConstStaticCell<[u8; 512]> = ConstStaticCell::new([0; 512]);

esp_bootloader_esp_idf::esp_app_desc!();

#[esp_hal::main]
fn main() -> ! {
    let peripherals = esp_hal::init(esp_hal::Config::default().with_cpu_clock(CpuClock::max()));
    let mut delay = Delay::new();

    let output = OutputConfig::default();
    let select = Output::new(peripherals.GPIO10, Level::High, output);
    let data_command = Output::new(peripherals.GPIO4, Level::Low, output);
    let reset = Output::new(peripherals.GPIO5, Level::High, output);
    let clock = Config::default().with_frequency(Rate::from_mhz(40)).with_mode(Mode::_0);
    let bus = Spi::new(peripherals.SPI2, clock)
        .expect("40 MHz divides the 80 MHz of the bus")
        .with_sck(peripherals.GPIO6)
        .with_mosi(peripherals.GPIO7);
    let device = ExclusiveDevice::new_no_delay(bus, select).expect("a pin cannot fail");
    let interface = SpiInterface::new(device, data_command, BATCH.take());

    // Panels of this size are IPS, which show inverted words.
    let display = Builder::new(ST7789, interface)
        .display_size(SIDE, SIDE)
        .invert_colors(ColorInversion::Inverted)
        .reset_pin(reset)
        .init(&mut delay);
    let display = match display {
        Ok(display) => display,
        Err(why) => {
            println!("the display does not start: {why:?}");
            stop()
        }
    };

    let picture = Viewport::new(SIDE.into(), SIDE.into()).expect("sides up to 512");
    let chain = SwapChain::new(Blocking::new(display), COLOR.take().as_mut_slice(), None);
    let mut teapot = Teapot::new(chain, picture, DEPTH.take(), VERTICES.take());
    for number in (0..FRAMES).cycle() {
        let start = Instant::now();
        if let Err(why) = teapot.frame(Moment { number, frames: FRAMES }) {
            println!("frame {number}: {why:?}");
            stop()
        }
        println!("frame {number}: {} us", start.elapsed().as_micros());
    }
    stop()
}

/// Waits for ever: the picture stays.
fn stop() -> ! {
    loop {
        core::hint::spin_loop();
    }
}
