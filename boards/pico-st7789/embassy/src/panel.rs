//! The panel on embassy's SPI: initialised by mipidsi, then fed bands by DMA.

use core::convert::Infallible;
use embassy_rp::gpio::Output;
use embassy_rp::peripherals::SPI0;
use embassy_rp::spi::{Async, Error, Spi};
use embassy_time::Delay;
use embedded_hal_bus::spi::{DeviceError, ExclusiveDevice, NoDelay};
use hither::Band;
use mipidsi::dcs::{InterfaceExt, SetColumnAddress, SetPageAddress, WriteMemoryStart};
use mipidsi::interface::{SpiError, SpiInterface};
use mipidsi::models::ST7789;
use mipidsi::options::ColorInversion;
use mipidsi::{Builder, InitError};

/// Pixels a row.
pub const WIDTH: u16 = 240;

/// Rows.
pub const HEIGHT: u16 = 240;

/// What can go wrong on the way to the panel.
pub type PanelError = SpiError<DeviceError<Error, Infallible>, Infallible>;

type Bus = Spi<'static, SPI0, Async>;
type Pin = Output<'static>;
type Lent<'a> = SpiInterface<'a, ExclusiveDevice<&'a mut Bus, &'a mut Pin, NoDelay>, &'a mut Pin>;

/// The panel and the wires to it.
pub struct Panel {
    spi: Bus,
    cs: Pin,
    dc: Pin,
}

impl Panel {
    /// Resets the panel, wakes it and turns it on.
    pub fn new(
        spi: Bus,
        cs: Pin,
        dc: Pin,
        reset: Pin,
        delay: &mut Delay,
    ) -> Result<Self, InitError<PanelError, Infallible>> {
        let mut panel = Self { spi, cs, dc };
        let interface = panel.interface().map_err(InitError::Interface)?;
        Builder::new(ST7789, interface)
            .display_size(WIDTH, HEIGHT)
            // The liquid crystal of these panels blocks light where it is off.
            .invert_colors(ColorInversion::Inverted)
            .reset_pin(reset)
            .init(delay)?;
        Ok(panel)
    }

    /// Sends the words of a band to its rows, by DMA; it is done when the panel has them.
    pub async fn send(&mut self, band: &Band, words: &[u16]) -> Result<(), PanelError> {
        // Both are at most the panel's sides.
        let (first, last) = (band.y() as u16, (band.y() + band.rows() - 1) as u16);
        let mut interface = self.interface()?;
        interface.write_command(SetColumnAddress::new(0, WIDTH - 1))?;
        interface.write_command(SetPageAddress::new(first, last))?;
        interface.write_command(WriteMemoryStart)?;
        self.cs.set_low();
        // Waits for the last bits as well, so that chip select holds until they are on the wire.
        let sent = self.spi.write(bytemuck::cast_slice(&words[..band.pixels()])).await;
        self.cs.set_high();
        sent.map_err(|error| SpiError::Spi(DeviceError::Spi(error)))
    }

    /// The panel as mipidsi drives it, for commands.
    fn interface(&mut self) -> Result<Lent<'_>, PanelError> {
        let device = ExclusiveDevice::new_no_delay(&mut self.spi, &mut self.cs)
            .map_err(|error| SpiError::Spi(DeviceError::Cs(error)))?;
        Ok(SpiInterface::new(device, &mut self.dc, &mut []))
    }
}
