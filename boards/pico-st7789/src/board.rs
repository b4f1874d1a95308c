//! The chip brought up at 125 MHz, and the pins of the wiring.

use embedded_hal::spi::MODE_0;
use fugit::RateExtU32;
use rp2040_hal::clocks::init_clocks_and_plls;
use rp2040_hal::dma::{CH0, Channel, DMAExt};
use rp2040_hal::gpio::bank0::{Gpio2, Gpio16, Gpio17, Gpio18, Gpio19, Gpio20};
use rp2040_hal::gpio::{FunctionSio, FunctionSpi, Pin, Pins, PullDown, SioOutput};
use rp2040_hal::spi::{Enabled, Spi};
use rp2040_hal::{Clock, Sio, Timer, Watchdog, pac};

/// The first 256 bytes of flash: the boot ROM runs them, and they set up the flash that the Pico
/// has. This one reads slowly at first and then as fast as the chip can.
#[used]
#[unsafe(link_section = ".boot2")]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// Of the Pico's crystal.
const CRYSTAL_HZ: u32 = 12_000_000;

/// The fastest clock that an ST7789 is specified for is 62.5 MHz (16 ns a bit), and it is half of
/// the chip's.
const SPI_HZ: u32 = 62_500_000;

/// A pin that the program drives.
pub type Output<I> = Pin<I, FunctionSio<SioOutput>, PullDown>;

/// A pin of the SPI block.
type SpiPin<I> = Pin<I, FunctionSpi, PullDown>;

/// SPI0 on MOSI and SCK, 8 bits a word.
pub type Bus = Spi<Enabled, pac::SPI0, (SpiPin<Gpio19>, SpiPin<Gpio18>), 8>;

/// What the firmwares use of the board.
pub struct Board {
    /// To the panel.
    pub spi: Bus,
    /// The panel's chip select, active low.
    pub cs: Output<Gpio17>,
    /// Low for a command, high for data.
    pub dc: Output<Gpio16>,
    /// Resets the panel, active low.
    pub reset: Output<Gpio20>,
    /// High while a frame is drawn and sent: for an oscilloscope, and for the emulator.
    pub marker: Output<Gpio2>,
    /// Feeds SPI.
    pub dma: Channel<CH0>,
    /// Microseconds.
    pub timer: Timer,
}

impl Board {
    /// Brings the chip up.
    ///
    /// # Panics
    ///
    /// The second time.
    pub fn take() -> Self {
        let mut chip = pac::Peripherals::take().expect("taken once");
        let mut watchdog = Watchdog::new(chip.WATCHDOG);
        let clocks = init_clocks_and_plls(
            CRYSTAL_HZ,
            chip.XOSC,
            chip.CLOCKS,
            chip.PLL_SYS,
            chip.PLL_USB,
            &mut chip.RESETS,
            &mut watchdog,
        );
        let clocks = clocks.expect("12 MHz is a crystal that the PLLs take");
        let timer = Timer::new(chip.TIMER, &mut chip.RESETS, &clocks);
        let sio = Sio::new(chip.SIO);
        let (bank, pads) = (chip.IO_BANK0, chip.PADS_BANK0);
        let pins = Pins::new(bank, pads, sio.gpio_bank0, &mut chip.RESETS);
        let wires = (pins.gpio19.into_function(), pins.gpio18.into_function());
        let peripheral_hz = clocks.peripheral_clock.freq();
        let spi = Spi::<_, _, _, 8>::new(chip.SPI0, wires);
        Self {
            spi: spi.init(&mut chip.RESETS, peripheral_hz, SPI_HZ.Hz(), MODE_0),
            cs: pins.gpio17.into_push_pull_output_in_state(rp2040_hal::gpio::PinState::High),
            dc: pins.gpio16.into_push_pull_output(),
            reset: pins.gpio20.into_push_pull_output(),
            marker: pins.gpio2.into_push_pull_output(),
            dma: chip.DMA.split(&mut chip.RESETS).ch0,
            timer,
        }
    }
}
