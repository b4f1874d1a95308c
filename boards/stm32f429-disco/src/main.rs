//! The spinning teapot on the STM32F429I-DISCO's own display, 64 frames a turn, for ever.
#![no_std]
#![no_main]

use board_support::{Blocking, Cache, Teapot};
use cortex_m::peripheral::DWT;
use defmt::{Debug2Format, error, info};
use defmt_rtt as _;
use embedded_hal_bus::spi::ExclusiveDevice;
use hither::{SwapChain, Vertex, Viewport};
use hither_scenes::spinning_teapot::{Moment, VERTEX_COUNT};
use mipidsi::Builder;
use mipidsi::interface::SpiInterface;
use mipidsi::models::ILI9341Rgb565;
use mipidsi::options::{ColorOrder, Orientation};
use panic_probe as _;
use static_cell::ConstStaticCell;
use stm32f4xx_hal::gpio::{PinState, Speed};
use stm32f4xx_hal::rcc::Config;
use stm32f4xx_hal::spi::{Mode, Phase, Polarity, Spi};
use stm32f4xx_hal::{pac, prelude::*};

/// The panel, in pixels.
const WIDTH: usize = 240;
const HEIGHT: usize = 320;
/// Rows that are drawn and sent together: an eighth of the panel.
const ROWS: usize = 40;
/// Pixels of a band.
const BAND: usize = WIDTH * ROWS;
/// Frames a turn.
const FRAMES: u32 = 64;
/// The processor's clock, in MHz.
const CORE_MHZ: u32 = 168;

static COLOR: ConstStaticCell<[u16; BAND]> = ConstStaticCell::new([0; BAND]);
static DEPTH: ConstStaticCell<[u16; BAND]> = ConstStaticCell::new([0; BAND]);
static VERTICES: ConstStaticCell<Cache> = ConstStaticCell::new([Vertex::EMPTY; VERTEX_COUNT]);
/// What the display's driver gathers before it sends.
static BATCH: ConstStaticCell<[u8; 512]> = ConstStaticCell::new([0; 512]);

#[cortex_m_rt::entry]
fn main() -> ! {
    let peripherals = pac::Peripherals::take().expect("taken once");
    let mut core = cortex_m::Peripherals::take().expect("taken once");
    core.DCB.enable_trace();
    core.DWT.enable_cycle_counter();

    let clocks = Config::hse(8.MHz()).sysclk(CORE_MHZ.MHz());
    let mut rcc = peripherals.RCC.freeze(clocks);
    let mut delay = core.SYST.delay(&rcc.clocks);
    let c = peripherals.GPIOC.split(&mut rcc);
    let d = peripherals.GPIOD.split(&mut rcc);
    let f = peripherals.GPIOF.split(&mut rcc);

    // The gyroscope is on the same bus: it is kept deselected.
    let _gyroscope = c.pc1.into_push_pull_output_in_state(PinState::High);
    let select = c.pc2.into_push_pull_output_in_state(PinState::High);
    let data_command = d.pd13.into_push_pull_output();
    let mode = Mode { polarity: Polarity::IdleLow, phase: Phase::CaptureOnFirstTransition };
    // The pads' default slope is too slow for 21 MHz.
    let sck = f.pf7.into_alternate::<5>().speed(Speed::High);
    let mosi = f.pf9.into_alternate::<5>().speed(Speed::High);
    let pins = (Some(sck), pac::SPI5::NoMiso, Some(mosi));
    let bus = Spi::new(peripherals.SPI5, pins, mode, 21.MHz(), &mut rcc);
    let device = ExclusiveDevice::new_no_delay(bus, select).expect("a pin cannot fail");
    let interface = SpiInterface::new(device, data_command, BATCH.take());

    // The glass is mounted mirrored, its stripes blue first.
    let display = Builder::new(ILI9341Rgb565, interface)
        .color_order(ColorOrder::Bgr)
        .orientation(Orientation::new().flip_horizontal())
        .init(&mut delay);
    let display = match display {
        Ok(display) => display,
        Err(why) => {
            error!("the display does not start: {}", Debug2Format(&why));
            stop()
        }
    };

    let picture = Viewport::new(WIDTH as u32, HEIGHT as u32).expect("sides up to 512");
    let chain = SwapChain::new(Blocking::new(display), COLOR.take().as_mut_slice(), None);
    let mut teapot = Teapot::new(chain, picture, DEPTH.take(), VERTICES.take());
    for number in (0..FRAMES).cycle() {
        let start = DWT::cycle_count();
        if let Err(why) = teapot.frame(Moment { number, frames: FRAMES }) {
            error!("frame {}: {}", number, Debug2Format(&why));
            stop()
        }
        let micros = DWT::cycle_count().wrapping_sub(start) / CORE_MHZ;
        info!("frame {}: {} us", number, micros);
    }
    stop()
}

/// Waits for ever. Awake: asleep, the probe could not read the end of the log.
fn stop() -> ! {
    loop {
        core::hint::spin_loop();
    }
}
