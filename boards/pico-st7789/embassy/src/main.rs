//! The spinning teapot in bands, under embassy: a band is drawn while the one before is sent.
#![no_std]
#![no_main]

mod panel;

use defmt_rtt as _;
use embassy_executor::Spawner;
use embassy_futures::join::join;
use embassy_rp::gpio::{Level, Output};
use embassy_rp::peripherals::DMA_CH0;
use embassy_rp::spi::{Config, Spi};
use embassy_rp::{bind_interrupts, dma};
use embassy_time::{Delay, Instant};
use hither::{Band, PerspectiveEvery, Quick, Rgb565Be, Vertex, Viewport};
use hither_scenes::SceneError;
use hither_scenes::spinning_teapot::{Drawn, Moment, VERTEX_COUNT, draw_onto};
use panel::{HEIGHT, Panel, WIDTH};
use panic_probe as _;
use static_cell::ConstStaticCell;

/// Frames a turn.
const FRAMES: u32 = 64;

/// The fastest clock that an ST7789 is specified for (16 ns a bit); it is half of the chip's.
const SPI_HZ: u32 = 62_500_000;

/// Rows of a band.
const ROWS: usize = 60;

const BAND: usize = WIDTH as usize * ROWS;

/// A transformed vertex, as the cache holds it: coordinates to 1/256 pixel.
type Cached = Vertex<Quick<8>, 3>;

static FIRST: ConstStaticCell<[u16; BAND]> = ConstStaticCell::new([0; BAND]);
static SECOND: ConstStaticCell<[u16; BAND]> = ConstStaticCell::new([0; BAND]);
static DEPTH: ConstStaticCell<[u16; BAND]> = ConstStaticCell::new([0; BAND]);
static CACHE: ConstStaticCell<[Cached; VERTEX_COUNT]> =
    ConstStaticCell::new([Cached::EMPTY; VERTEX_COUNT]);

bind_interrupts!(struct Interrupts {
    DMA_IRQ_0 => dma::InterruptHandler<DMA_CH0>;
});

/// What drawing needs besides the words of a band.
struct Scene {
    depth: &'static mut [u16],
    cache: &'static mut [Cached],
}

impl Scene {
    /// Draws a band.
    fn draw(&mut self, band: &Band, words: &mut [u16], number: u32) -> Result<Drawn, SceneError> {
        let buffer = band.framebuffer::<Rgb565Be>(words)?;
        let knobs = (Quick::<8>, PerspectiveEvery::<16>);
        let moment = Moment { number, frames: FRAMES };
        draw_onto(buffer, band.viewport(), knobs, self.depth, moment, self.cache)
    }
}

/// Draws a picture band by band, and sends each while the next is drawn.
///
/// A buffer is lent to the bus as long as it is sent, and the other one to the scene as long as it
/// is drawn into; they change places when both are done.
async fn frame(
    panel: &mut Panel,
    scene: &mut Scene,
    [front, back]: &mut [&'static mut [u16]; 2],
    picture: &Viewport,
    number: u32,
) {
    let mut drawn: Option<Band> = None;
    let bands = picture.bands(BAND).expect("a buffer holds rows");
    for next in bands.map(Some).chain([None]) {
        let send = async {
            if let Some(band) = &drawn
                && let Err(error) = panel.send(band, front).await
            {
                defmt::error!("frame {}: {}", number, defmt::Debug2Format(&error));
            }
        };
        // Sending is begun first, and goes on by itself while this draws.
        let draw = async {
            if let Some(band) = &next
                && let Err(error) = scene.draw(band, back, number)
            {
                defmt::error!("frame {}: {}", number, defmt::Display2Format(&error));
            }
        };
        join(send, draw).await;
        core::mem::swap(front, back);
        drawn = next;
    }
}

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    let chip = embassy_rp::init(embassy_rp::config::Config::default());
    let mut config = Config::default();
    config.frequency = SPI_HZ;
    let wires = (chip.PIN_18, chip.PIN_19);
    let spi = Spi::new_txonly(chip.SPI0, wires.0, wires.1, chip.DMA_CH0, Interrupts, config);
    let cs = Output::new(chip.PIN_17, Level::High);
    let dc = Output::new(chip.PIN_16, Level::Low);
    let reset = Output::new(chip.PIN_20, Level::High);
    // High while a frame is drawn and sent: for an oscilloscope, and for the emulator.
    let mut marker = Output::new(chip.PIN_2, Level::Low);

    let mut panel = Panel::new(spi, cs, dc, reset, &mut Delay)
        .expect("pins do not fail, and the size is the panel's");
    let mut scene = Scene { depth: DEPTH.take(), cache: CACHE.take() };
    let mut buffers: [&'static mut [u16]; 2] = [FIRST.take(), SECOND.take()];
    let picture = Viewport::new(WIDTH.into(), HEIGHT.into()).expect("at most 512 x 512");
    let mut number = 0;
    loop {
        let start = Instant::now();
        marker.set_high();
        frame(&mut panel, &mut scene, &mut buffers, &picture, number).await;
        marker.set_low();
        defmt::info!("frame {}: {} us", number, start.elapsed().as_micros());
        number = (number + 1) % FRAMES;
    }
}
