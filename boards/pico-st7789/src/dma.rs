//! Bands sent by DMA.

use crate::panel::{PanelError, open_window};
use core::task::{Context, Poll};
use embedded_dma::ReadBuffer;
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::SpiBus;
use embedded_hal_bus::spi::DeviceError;
use hither::{Band, Transfer};
use mipidsi::interface::SpiError;
use rp2040_hal::dma::{SingleChannel, WriteTarget, single_buffer};

/// A band's words, in the panel's byte order.
pub type Words = &'static mut [u16];

/// A buffer whose first words DMA reads: those of its band.
struct Sent {
    words: Words,
    pixels: usize,
}

// SAFETY: the words are static and borrowed for good by this value alone, which nothing changes while a transfer
// holds it: they stay where they are and what they are, and so does the length.
unsafe impl ReadBuffer for Sent {
    type Word = u8;

    unsafe fn read_buffer(&self) -> (*const u8, usize) {
        let bytes: &[u8] = bytemuck::cast_slice(self.words.get(..self.pixels).unwrap_or_default());
        (bytes.as_ptr(), bytes.len())
    }
}

/// The panel, fed by a DMA channel.
///
/// A buffer moves into the transfer and comes back when the panel has it, and so do the channel and
/// the bus: nothing else can use them meanwhile.
pub struct DmaPanel<C: SingleChannel, S: WriteTarget, CS, DC> {
    idle: Option<(C, S)>,
    in_flight: Option<single_buffer::Transfer<C, Sent, S>>,
    /// A buffer that came back, or could not be sent.
    returned: Option<Words>,
    cs: CS,
    dc: DC,
}

impl<C, S, CS, DC> DmaPanel<C, S, CS, DC>
where
    C: SingleChannel,
    S: WriteTarget<TransmittedWord = u8>,
{
    /// An initialised panel.
    pub const fn new(channel: C, spi: S, cs: CS, dc: DC) -> Self {
        Self { idle: Some((channel, spi)), in_flight: None, returned: None, cs, dc }
    }
}

impl<C, S, CS, DC, P> Transfer for DmaPanel<C, S, CS, DC>
where
    C: SingleChannel,
    S: SpiBus + WriteTarget<TransmittedWord = u8>,
    CS: OutputPin<Error = P>,
    DC: OutputPin<Error = P>,
    P: embedded_hal::digital::Error,
{
    type Word = u16;
    type Buffer = Words;
    type Error = PanelError<S::Error, P>;

    fn start(&mut self, band: &Band, buffer: Words) -> Result<(), Self::Error> {
        self.returned = Some(buffer);
        if cfg!(feature = "fault-skip-last-flush") && is_last(band) {
            return Ok(());
        }
        if let Some((_, spi)) = &mut self.idle {
            open_window(spi, &mut self.cs, &mut self.dc, band)?;
            self.cs.set_low().map_err(in_cs)?;
        }
        if let Some(((channel, spi), words)) = self.idle.take().zip(self.returned.take()) {
            let sent = Sent { words, pixels: band.pixels() };
            self.in_flight = Some(single_buffer::Config::new(channel, sent, spi).start());
        }
        Ok(())
    }

    /// Waits: there is nothing else to do.
    fn poll_finish(&mut self, _: &mut Context<'_>) -> Poll<Result<Option<Words>, Self::Error>> {
        Poll::Ready(self.finish())
    }
}

impl<C, S, CS, DC, P> DmaPanel<C, S, CS, DC>
where
    C: SingleChannel,
    S: SpiBus + WriteTarget<TransmittedWord = u8>,
    CS: OutputPin<Error = P>,
    DC: OutputPin<Error = P>,
    P: embedded_hal::digital::Error,
{
    /// Waits until the panel has the last byte, and gives the buffer back.
    fn finish(&mut self) -> Result<Option<Words>, PanelError<S::Error, P>> {
        if let Some(transfer) = self.in_flight.take() {
            let (channel, sent, mut spi) = transfer.wait();
            // DMA is done when the last bytes are in SPI's queue: chip select has to wait until they
            // are on the wire as well.
            let flushed = spi.flush();
            self.idle = Some((channel, spi));
            self.returned = Some(sent.words);
            flushed.map_err(|error| SpiError::Spi(DeviceError::Spi(error)))?;
            self.cs.set_high().map_err(in_cs)?;
        }
        Ok(self.returned.take())
    }
}

/// Whether a band has the panel's last row.
fn is_last(band: &Band) -> bool {
    band.y() + band.rows() == u32::from(crate::panel::HEIGHT)
}

/// The error of chip select.
fn in_cs<S, P>(error: P) -> PanelError<S, P> {
    SpiError::Spi(DeviceError::Cs(error))
}
