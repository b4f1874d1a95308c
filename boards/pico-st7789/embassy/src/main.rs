//! The spinning teapot in bands, under embassy: a band is drawn while the one before is sent.
#![no_std]
#![no_main]

mod panel;

use core::task::{Context, Poll, ready};
use defmt_rtt as _;
use embassy_executor::Spawner;
use embassy_rp::gpio::{Level, Output};
use embassy_rp::peripherals::DMA_CH0;
use embassy_rp::spi::{Config, Spi};
use embassy_rp::{bind_interrupts, dma};
use embassy_sync::blocking_mutex::raw::ThreadModeRawMutex;
use embassy_sync::channel::{Channel, TrySendError};
use embassy_time::{Delay, Instant};
use hither::{Band, PerspectiveEvery, Quick, Rgb565Be, SwapChain, Transfer, Vertex, Viewport};
use hither_scenes::SceneError;
use hither_scenes::spinning_teapot::{Drawn, Moment, VERTEX_COUNT, draw_onto};
use panel::{HEIGHT, Panel, PanelError, WIDTH};
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

/// The words of a band.
type Words = &'static mut [u16];

/// Bands on their way to the task that has the panel.
static TO_PANEL: Channel<ThreadModeRawMutex, (Band, Words), 1> = Channel::new();

/// Their words on the way back.
static FROM_PANEL: Channel<ThreadModeRawMutex, (Words, Result<(), PanelError>), 1> = Channel::new();

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

/// Sends bands as they come, and gives their words back.
#[embassy_executor::task]
async fn send(mut panel: Panel) -> ! {
    loop {
        let (band, words) = TO_PANEL.receive().await;
        let sent = panel.send(&band, words).await;
        FROM_PANEL.send((words, sent)).await;
    }
}

/// Sends bands through the task that has the panel: whoever draws may stop waiting for it, and it goes on.
#[derive(Default)]
struct Sender {
    in_flight: bool,
    /// Words of a band that could not be sent.
    returned: Option<Words>,
}

impl Transfer for Sender {
    type Word = u16;
    type Buffer = Words;
    type Error = PanelError;

    fn start(&mut self, band: &Band, words: Words) -> Result<(), PanelError> {
        match TO_PANEL.try_send((*band, words)) {
            Ok(()) => self.in_flight = true,
            // Never, as one at most is in flight.
            Err(TrySendError::Full((_, words))) => self.returned = Some(words),
        }
        Ok(())
    }

    fn poll_finish(
        &mut self,
        context: &mut Context<'_>,
    ) -> Poll<Result<Option<Words>, PanelError>> {
        if self.in_flight {
            let (words, sent) = ready!(FROM_PANEL.poll_receive(context));
            self.in_flight = false;
            self.returned = Some(words);
            sent?;
        }
        Poll::Ready(Ok(self.returned.take()))
    }
}

#[embassy_executor::main]
async fn main(spawner: Spawner) {
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

    let panel = Panel::new(spi, cs, dc, reset, &mut Delay)
        .expect("pins do not fail, and the size is the panel's");
    let mut scene = Scene { depth: DEPTH.take(), cache: CACHE.take() };
    spawner.spawn(send(panel).expect("there is one"));
    let (first, second): (Words, Words) = (FIRST.take(), SECOND.take());
    let mut chain = SwapChain::new(Sender::default(), first, Some(second));
    let picture = Viewport::new(WIDTH.into(), HEIGHT.into()).expect("at most 512 x 512");
    let mut number = 0;
    loop {
        let start = Instant::now();
        marker.set_high();
        let sent = chain.frame_async(&picture, |band, words| {
            if let Err(error) = scene.draw(band, words, number) {
                defmt::error!("frame {}: {}", number, defmt::Display2Format(&error));
            }
        });
        if let Err(error) = sent.await {
            defmt::error!("frame {}: {}", number, defmt::Debug2Format(&error));
        }
        marker.set_low();
        defmt::info!("frame {}: {} us", number, start.elapsed().as_micros());
        number = (number + 1) % FRAMES;
    }
}
