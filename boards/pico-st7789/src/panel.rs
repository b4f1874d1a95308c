//! The panel: its size, how it is initialised, and the window that pixels go to.

use embedded_hal::delay::DelayNs;
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::SpiBus;
use embedded_hal_bus::spi::{DeviceError, ExclusiveDevice, NoDelay};
use hither::Band;
use mipidsi::dcs::{InterfaceExt, SetColumnAddress, SetPageAddress, WriteMemoryStart};
use mipidsi::interface::{SpiError, SpiInterface};
use mipidsi::models::ST7789;
use mipidsi::options::ColorInversion;
use mipidsi::{Builder, Display, InitError};

/// Pixels a row.
pub const WIDTH: u16 = 240;

/// Rows.
pub const HEIGHT: u16 = 240;

/// The panel behind SPI, chip select and D/C, which may be lent.
pub type Interface<'a, S, CS, DC> = SpiInterface<'a, ExclusiveDevice<S, CS, NoDelay>, DC>;

/// What can go wrong on the way to a panel whose bus fails with `S` and whose pins with `P`.
pub type PanelError<S, P> = SpiError<DeviceError<S, P>, P>;

/// The panel on a bus. `buffer` gathers pixels that are drawn through a
/// [`DrawTarget`](embedded_graphics_core::draw_target::DrawTarget); commands do without.
///
/// # Errors
///
/// The pin's own.
pub fn interface<S, CS, DC>(
    spi: S,
    cs: CS,
    dc: DC,
    buffer: &mut [u8],
) -> Result<Interface<'_, S, CS, DC>, CS::Error>
where
    S: SpiBus,
    CS: OutputPin,
    DC: OutputPin,
{
    Ok(SpiInterface::new(ExclusiveDevice::new_no_delay(spi, cs)?, dc, buffer))
}

/// Resets the panel, wakes it and turns it on.
///
/// # Errors
///
/// The bus' or the pins' own.
#[expect(clippy::type_complexity, reason = "both types are mipidsi's, spelled once")]
pub fn initialise<'a, S, CS, DC, RST, P>(
    interface: Interface<'a, S, CS, DC>,
    reset: RST,
    delay: &mut impl DelayNs,
) -> Result<Display<Interface<'a, S, CS, DC>, ST7789, RST>, InitError<PanelError<S::Error, P>, P>>
where
    S: SpiBus,
    CS: OutputPin<Error = P>,
    DC: OutputPin<Error = P>,
    RST: OutputPin<Error = P>,
    P: core::fmt::Debug,
{
    Builder::new(ST7789, interface)
        .display_size(WIDTH, HEIGHT)
        // The liquid crystal of these panels blocks light where it is off.
        .invert_colors(ColorInversion::Inverted)
        .reset_pin(reset)
        .init(delay)
}

/// Makes the rows of a band the window, whole, and its first pixel the next to be written.
///
/// # Errors
///
/// The bus' or the pins' own.
pub fn open_window<S, P>(
    spi: &mut S,
    cs: &mut impl OutputPin<Error = P>,
    dc: &mut impl OutputPin<Error = P>,
    band: &Band,
) -> Result<(), PanelError<S::Error, P>>
where
    S: SpiBus,
    P: embedded_hal::digital::Error,
{
    let in_cs = |error| SpiError::Spi(DeviceError::Cs(error));
    let mut interface = interface(spi, cs, dc, &mut []).map_err(in_cs)?;
    // Both are at most the panel's sides.
    let (first, last) = (band.y() as u16, (band.y() + band.rows() - 1) as u16);
    interface.write_command(SetColumnAddress::new(0, WIDTH - 1))?;
    interface.write_command(SetPageAddress::new(first, last))?;
    interface.write_command(WriteMemoryStart)
}
