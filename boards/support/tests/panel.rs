//! The code that the boards share, against a model of a panel: its wires and its memory.

use board_support::{Blocking, Teapot, TeapotError};
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::pixelcolor;
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::spi::{self, ErrorKind, Operation, SpiDevice};
use hither::{
    Band, BufferSize, FrameError, Framebuffer, PerspectiveEvery, Quick, Rgb565, SwapChain, Vertex,
    Viewport,
};
use hither_scenes::SceneError;
use hither_scenes::spinning_teapot::{Moment, VERTEX_COUNT, draw_onto};
use mipidsi::interface::{SpiError, SpiInterface};
use mipidsi::models::{ILI9341Rgb565, Model, ST7789};
use mipidsi::{Builder, Display, NoResetPin};
use std::cell::RefCell;
use std::convert::Infallible;

/// DCS commands that write pixels.
const SET_COLUMNS: u8 = 0x2a;
const SET_ROWS: u8 = 0x2b;
const WRITE_MEMORY: u8 = 0x2c;

/// A panel of 240 x 320 pixels on four wires, that takes big-endian 565 words.
struct Panel {
    words: Vec<u16>,
    /// How often each pixel was written.
    writes: Vec<u32>,
    /// D/C low: bytes are commands.
    command: bool,
    /// The last command, and the bytes that came after it.
    last: u8,
    arguments: Vec<u8>,
    /// First and last, inclusive.
    columns: [u16; 2],
    rows: [u16; 2],
    /// Pixels since the last `WRITE_MEMORY`.
    written: u32,
    /// Fails at this transaction, counted down; 0 never.
    fails_in: u32,
}

impl Panel {
    const WIDTH: usize = 240;
    const HEIGHT: usize = 320;

    fn new() -> RefCell<Self> {
        RefCell::new(Self {
            words: vec![0; Self::WIDTH * Self::HEIGHT],
            writes: vec![0; Self::WIDTH * Self::HEIGHT],
            command: false,
            last: 0,
            arguments: vec![],
            columns: [0; 2],
            rows: [0; 2],
            written: 0,
            fails_in: 0,
        })
    }

    fn take(&mut self, byte: u8) {
        if self.command {
            (self.last, self.written) = (byte, 0);
            self.arguments.clear();
            return;
        }
        self.arguments.push(byte);
        match (self.last, self.arguments.as_slice()) {
            (SET_COLUMNS, &[a, b, c, d]) => self.columns = pair([a, b, c, d]),
            (SET_ROWS, &[a, b, c, d]) => self.rows = pair([a, b, c, d]),
            (WRITE_MEMORY, &[high, low]) => {
                self.write(u16::from_be_bytes([high, low]));
                self.arguments.clear();
            }
            _ => {}
        }
    }

    fn write(&mut self, word: u16) {
        let [left, right] = self.columns.map(u32::from);
        let [top, bottom] = self.rows.map(u32::from);
        let width = right - left + 1;
        let (x, y) = (left + self.written % width, top + self.written / width);
        assert!(y <= bottom, "more pixels than the window {:?} {:?}", self.columns, self.rows);
        let at = y as usize * Self::WIDTH + x as usize;
        self.words[at] = word;
        self.writes[at] += 1;
        self.written += 1;
    }
}

/// Two big-endian words.
fn pair([a, b, c, d]: [u8; 4]) -> [u16; 2] {
    [u16::from_be_bytes([a, b]), u16::from_be_bytes([c, d])]
}

/// The panel's SPI.
struct Bus<'a>(&'a RefCell<Panel>);

impl spi::ErrorType for Bus<'_> {
    type Error = ErrorKind;
}

impl SpiDevice for Bus<'_> {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), ErrorKind> {
        let mut panel = self.0.borrow_mut();
        if panel.fails_in > 0 {
            panel.fails_in -= 1;
            if panel.fails_in == 0 {
                return Err(ErrorKind::ModeFault);
            }
        }
        for operation in operations {
            let Operation::Write(bytes) = operation else { panic!("a panel is only written to") };
            bytes.iter().for_each(|&byte| panel.take(byte));
        }
        Ok(())
    }
}

/// The panel's D/C pin.
struct DataCommand<'a>(&'a RefCell<Panel>);

impl digital::ErrorType for DataCommand<'_> {
    type Error = Infallible;
}

impl OutputPin for DataCommand<'_> {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.borrow_mut().command = true;
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.borrow_mut().command = false;
        Ok(())
    }
}

/// Time does not pass.
struct NoDelay;

impl DelayNs for NoDelay {
    fn delay_ns(&mut self, _: u32) {}
}

type Driver<'a, M> = Display<SpiInterface<'a, Bus<'a>, DataCommand<'a>>, M, NoResetPin>;

/// A display of a model on the panel, as the boards set it up.
fn display<'a, M: Model<ColorFormat = pixelcolor::Rgb565>>(
    model: M,
    panel: &'a RefCell<Panel>,
    height: u16,
    batch: &'a mut [u8],
) -> Driver<'a, M> {
    let interface = SpiInterface::new(Bus(panel), DataCommand(panel), batch);
    let Ok(display) = Builder::new(model, interface).display_size(240, height).init(&mut NoDelay)
    else {
        panic!("the model panel never fails here")
    };
    display
}

/// A chain of one buffer of so many words, as the boards have.
fn chain<D>(display: D, words: usize) -> SwapChain<Blocking<D, Vec<u16>>>
where
    D: DrawTarget<Color = pixelcolor::Rgb565>,
{
    SwapChain::new(Blocking::new(display), vec![0xdead; words], None)
}

/// The word of a pixel, all different within 256 rows.
fn number(x: usize, y: usize) -> u16 {
    (y * 256 + x) as u16
}

/// Numbers the pixels of a band.
fn fill(band: &Band, words: &mut [u16]) {
    let width = band.viewport().width() as usize;
    for (i, word) in words.iter_mut().take(band.pixels()).enumerate() {
        *word = number(i % width, band.y() as usize + i / width);
    }
}

/// Whole rows come in order, each once, whether or not the band divides the height, and whatever
/// batches the driver sends.
#[test]
fn every_pixel_is_written_once_in_its_place() {
    for (words, batch) in [(240 * 40, 512), (240 * 37 + 11, 512), (240, 2), (240 * 999, 500)] {
        let (panel, mut batch) = (Panel::new(), vec![0; batch]);
        let mut chain = chain(display(ST7789, &panel, 240, &mut batch), words);
        chain.frame(&Viewport::new(240, 240).unwrap(), fill).unwrap();
        let panel = panel.borrow();
        for y in 0..Panel::HEIGHT {
            for x in 0..Panel::WIDTH {
                let (at, shown) = (y * Panel::WIDTH + x, y < 240);
                assert_eq!(panel.writes[at], u32::from(shown), "({x}, {y}), {words} words");
                assert_eq!(panel.words[at], if shown { number(x, y) } else { 0 }, "({x}, {y})");
            }
        }
    }
}

#[test]
fn a_picture_past_the_displays_edge_is_cut_there() {
    let (panel, mut batch) = (Panel::new(), [0; 512]);
    let mut chain = chain(display(ST7789, &panel, 100, &mut batch), 250 * 30);
    chain.frame(&Viewport::new(250, 200).unwrap(), fill).unwrap();
    let panel = panel.borrow();
    for (at, (&word, &writes)) in panel.words.iter().zip(&panel.writes).enumerate() {
        let (x, y) = (at % 240, at / 240);
        assert_eq!((writes, word), if y < 100 { (1, number(x, y)) } else { (0, 0) }, "({x}, {y})");
    }
}

/// Wherever the bus fails, its own error arrives, and the next frame is whole.
#[test]
fn an_error_passes_through_and_the_buffer_comes_back() {
    let (panel, mut batch) = (Panel::new(), [0; 512]);
    let picture = Viewport::new(240, 240).unwrap();
    let mut chain = chain(display(ST7789, &panel, 240, &mut batch), 240 * 80);
    for fails_in in [1, 2, 3, 7, 50, 200] {
        panel.borrow_mut().fails_in = fails_in;
        let error = chain.frame(&picture, fill).unwrap_err();
        let FrameError::Display(SpiError::Spi(kind)) = error else { panic!("{error:?}") };
        assert_eq!(kind, ErrorKind::ModeFault, "{fails_in}");
        panel.borrow_mut().words.fill(0);
        chain.frame(&picture, fill).unwrap();
        assert_eq!(panel.borrow().words[239 * 240 + 239], number(239, 239), "{fails_in}");
    }
}

/// What the boards run, pixel for pixel against one whole frame drawn on the host.
fn shows_the_teapot(model: impl Model<ColorFormat = pixelcolor::Rgb565>, height: u16, rows: usize) {
    let picture = Viewport::new(240, u32::from(height)).unwrap();
    let moment = Moment { number: 5, frames: 64 };
    let pixels = 240 * usize::from(height);
    let (mut whole, mut depth) = (vec![0; pixels], vec![0; pixels]);
    let mut cache = [Vertex::EMPTY; VERTEX_COUNT];
    let target = Framebuffer::<Rgb565>::try_new(&mut whole, 240, picture.height()).unwrap();
    let knobs = (Quick::<8>, PerspectiveEvery::<16>);
    draw_onto(target, picture, knobs, &mut depth, moment, &mut cache).unwrap();

    let (panel, mut batch) = (Panel::new(), [0; 512]);
    let chain = chain(display(model, &panel, height, &mut batch), 240 * rows);
    let depth = &mut depth[..240 * rows];
    Teapot::new(chain, picture, depth, &mut cache).frame(moment).unwrap();
    let different = panel.borrow().words.iter().zip(&whole).filter(|(a, b)| a != b).count();
    assert_eq!(different, 0, "pixels of {pixels}");
}

#[test]
fn the_panels_of_both_boards_show_the_hosts_picture() {
    shows_the_teapot(ST7789, 240, 40);
    shows_the_teapot(ILI9341Rgb565, 320, 40);
    shows_the_teapot(ILI9341Rgb565, 320, 37);
}

#[test]
fn too_little_depth_is_an_error() {
    let (panel, mut batch, mut depth) = (Panel::new(), [0; 512], [0; 239]);
    let mut cache = [Vertex::EMPTY; VERTEX_COUNT];
    let chain = chain(display(ST7789, &panel, 240, &mut batch), 240);
    let picture = Viewport::new(240, 240).unwrap();
    let mut teapot = Teapot::new(chain, picture, &mut depth, &mut cache);
    let error = teapot.frame(Moment { number: 0, frames: 64 }).unwrap_err();
    let TeapotError::Scene(SceneError::Buffer(size)) = error else { panic!("{error:?}") };
    assert_eq!(size, BufferSize::Words { needed: 240, got: 239 });
}
