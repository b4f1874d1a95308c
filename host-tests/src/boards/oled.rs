//! The OLED boards on QEMU: what their panels show after a turn of the teapot, against the host.
//!
//! A firmware ends a turn with a reset. QEMU is told to stop there, with the last frame on the
//! panel; then its picture is taken.

pub mod ppm;
pub mod qmp;

use crate::boards::screen::Screen;
use hither_scenes::oled::{
    CacheEntry, GRAY_HEIGHT, GRAY_WIDTH, GrayBuffers, LAST, MONO_HEIGHT, MONO_WIDTH, MonoBuffers,
    gray_128x64, mono_96x16,
};
use hither_scenes::packing::PAGE_ROWS;
use hither_scenes::spinning_teapot::VERTEX_COUNT;
use qmp::Qmp;
use serde_json::json;
use std::fs;
use std::io::{ErrorKind, Read};
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

/// A board with an OLED, and its machine.
#[derive(Clone, Copy, Debug)]
pub struct Board {
    /// Its folder in `boards/`, and its program.
    pub name: &'static str,
    /// QEMU's name for it.
    pub machine: &'static str,
    /// Pixels of the panel, across and down.
    pub size: (u32, u32),
    /// What the panel shows after a turn.
    pub expected: fn() -> Screen,
}

/// The boards.
pub const BOARDS: [Board; 2] = [
    Board {
        name: "lm3s6965-oled",
        machine: "lm3s6965evb",
        size: (GRAY_WIDTH, GRAY_HEIGHT),
        expected: expected_gray,
    },
    Board {
        name: "lm3s811-oled",
        machine: "lm3s811evb",
        size: (MONO_WIDTH, MONO_HEIGHT),
        expected: expected_mono,
    },
];

/// Rust's target of both chips.
pub const TARGET: &str = "thumbv7m-none-eabi";

/// Instructions a tick of SysTick: an instruction takes 1 ns (`-icount shift=0`), a tick 20 ns, at
/// the 50 MHz that the firmware sets. What is counted is exact to one tick.
pub const INSTRUCTIONS_A_TICK: u64 = 20;

/// Pixels of QEMU's picture along a pixel of the panel.
const MAGNIFIED: u32 = 4;

/// How long a machine may take: a turn takes about a second.
const PATIENCE: Duration = Duration::from_secs(60);

/// Where both chips have RAM.
const RAM: u64 = 0x2000_0000;

/// Bytes of RAM that are looked at: the larger chip's. Behind the end of the smaller one's, nothing
/// reads as paint.
const RAM_BYTES: u64 = 64 * 1024;

/// What a machine left behind when it stopped.
#[derive(Clone, Debug)]
pub struct Capture {
    /// The panel.
    pub screen: Screen,
    /// What was printed.
    pub uart: String,
    /// Bytes of RAM between statics and stack that the stack never reached.
    pub untouched: usize,
    /// From start to stop of the emulator.
    pub took: Duration,
}

/// What a frame took, in instructions to within [`INSTRUCTIONS_A_TICK`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cost {
    /// To draw it and to pack its pixels.
    pub draw: u64,
    /// To send it to the panel, waits for the bus included.
    pub send: u64,
}

impl Capture {
    /// What each frame took, from what was printed.
    ///
    /// # Errors
    ///
    /// The line that is no report, or that there is none.
    pub fn costs(&self) -> Result<Vec<Cost>, String> {
        let costs: Result<Vec<_>, _> = self.uart.lines().enumerate().map(cost).collect();
        costs.and_then(|costs| match costs[..] {
            [] => Err("nothing was printed".to_owned()),
            _ => Ok(costs),
        })
    }
}

/// The cost in a line such as `frame 3: draw 123, send 45 cycles`, which is number 3.
fn cost((number, line): (usize, &str)) -> Result<Cost, String> {
    let parse = || {
        let rest = line.strip_prefix(&format!("frame {number}: draw "))?;
        let (draw, send) = rest.strip_suffix(" cycles")?.split_once(", send ")?;
        let instructions = |ticks: &str| Some(ticks.parse::<u64>().ok()? * INSTRUCTIONS_A_TICK);
        Some(Cost { draw: instructions(draw)?, send: instructions(send)? })
    };
    parse().ok_or_else(|| format!("line {number} is no report of its frame: {line}"))
}

/// Boots a firmware on one of QEMU's machines, waits until it ends its turn with a reset, and looks
/// at the panel of `size` pixels.
///
/// # Errors
///
/// What to install where QEMU is missing; what went wrong, with what was printed, where the machine
/// does not get there in a minute; or what is wrong with the picture.
pub fn capture(machine: &str, elf: &Path, size: (u32, u32)) -> Result<Capture, String> {
    let start = Instant::now();
    let folder = Folder::new()?;
    let [uart, picture, ram] = ["uart", "panel.ppm", "ram"].map(|name| folder.0.join(name));
    // Bound before the emulator starts, so that it finds it.
    let listener = qmp::listen()?;
    let address = listener.local_addr().map_err(|error| error.to_string())?;
    let mut emulator = Emulator::start(machine, elf, address, &uart)?;
    let mut session = || -> Result<(), String> {
        let mut qmp = Qmp::accept(&listener, start + PATIENCE, || emulator.exited())?;
        qmp.execute("cont", &json!({}))?;
        qmp.wait_for("STOP")?;
        qmp.execute("screendump", &json!({ "filename": picture }))?;
        let all = json!({ "val": RAM, "size": RAM_BYTES, "filename": ram });
        qmp.execute("pmemsave", &all)?;
        qmp.quit()
    };
    let read = |path: &Path| fs::read(path).map_err(|error| format!("{}: {error}", path.display()));
    let printed = || String::from_utf8_lossy(&read(&uart).unwrap_or_default()).into_owned();
    session().map_err(|error| format!("{machine}: {error}; it printed {:?}", printed()))?;
    Ok(Capture {
        screen: ppm::reduce(&ppm::parse(&read(&picture)?)?, MAGNIFIED, size)?,
        uart: printed(),
        untouched: longest_painted(&read(&ram)?),
        took: start.elapsed(),
    })
}

/// The longest run of the words that `cortex-m-rt` paints the stack with, in bytes.
fn longest_painted(ram: &[u8]) -> usize {
    const PAINT: [u8; 4] = [0xCC; 4];
    let words: Vec<_> = ram.chunks_exact(4).map(|word| word == PAINT).collect();
    let runs = words.split(|is_painted| !is_painted);
    4 * runs.map(<[bool]>::len).max().unwrap_or(0)
}

/// An emulator, which is stopped when this goes.
struct Emulator(Child);

impl Emulator {
    fn start(machine: &str, elf: &Path, qmp: SocketAddr, uart: &Path) -> Result<Self, String> {
        let mut command = Command::new("qemu-system-arm");
        command.args(["-M", machine, "-icount", "shift=0", "-display", "none", "-monitor", "none"]);
        command.args(["-S", "-action", "reboot=shutdown,shutdown=pause"]);
        command.arg("-qmp").arg(format!("tcp:{qmp}"));
        command.arg("-serial").arg(format!("file:{}", uart.display()));
        command.arg("-kernel").arg(elf);
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
        command.spawn().map(Self).map_err(|error| match error.kind() {
            ErrorKind::NotFound => {
                "qemu-system-arm is missing: Debian's package qemu-system-arm brings it".to_owned()
            }
            _ => format!("qemu-system-arm: {error}"),
        })
    }

    /// What it said, where it ended by itself.
    fn exited(&mut self) -> Option<String> {
        let status = self.0.try_wait().ok()??;
        let mut said = String::new();
        if let Some(stderr) = &mut self.0.stderr {
            // What cannot be read is not said.
            let _ = stderr.read_to_string(&mut said);
        }
        Some(format!("qemu-system-arm ended ({status}): {}", said.trim()))
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        // It may be gone already.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A folder for one run, which goes with this.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Result<Self, String> {
        static RUNS: AtomicU32 = AtomicU32::new(0);
        let run = RUNS.fetch_add(1, Ordering::Relaxed);
        let name = format!("hither-oled-{}-{run}", std::process::id());
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(Self(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What stays behind is small, and in the system's folder for such.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// The grey panel after a turn, drawn on the host: grey `v` of 15 shows as `17 v`.
#[must_use]
pub fn expected_gray() -> Screen {
    let mut buffers = Box::new(GrayBuffers::EMPTY);
    let mut cache = [CacheEntry::EMPTY; VERTEX_COUNT];
    let picture = gray_128x64(LAST, &mut buffers, &mut cache).expect("the scene's numbers fit");
    let greys = picture.iter().flat_map(|pair| [pair >> 4, pair & 0xF]);
    let rgb = greys.flat_map(|grey| [17 * grey; 3]).collect();
    Screen { width: GRAY_WIDTH, height: GRAY_HEIGHT, rgb }
}

/// The black and white panel after a turn, drawn on the host.
#[must_use]
pub fn expected_mono() -> Screen {
    let mut buffers = Box::new(MonoBuffers::EMPTY);
    let pages = mono_96x16(LAST, &mut buffers, &mut []).expect("the scene's numbers fit");
    let lit = |x: usize, y: usize| pages[y / PAGE_ROWS][x] >> (y % PAGE_ROWS) & 1;
    let rows = 0..MONO_HEIGHT as usize;
    let pixels = rows.flat_map(|y| (0..MONO_WIDTH as usize).map(move |x| lit(x, y)));
    let rgb = pixels.flat_map(|lit| [255 * lit; 3]).collect();
    Screen { width: MONO_WIDTH, height: MONO_HEIGHT, rgb }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pictures_have_the_panels_sizes_and_levels() {
        for board in BOARDS {
            let screen = (board.expected)();
            assert_eq!((screen.width, screen.height), board.size);
            assert_eq!(screen.rgb.len() as u32, 3 * board.size.0 * board.size.1);
            assert!(screen.rgb.chunks_exact(3).all(|rgb| rgb[0] % 17 == 0 && rgb == [rgb[0]; 3]));
        }
        assert!(expected_mono().rgb.iter().all(|level| matches!(level, 0 | 255)));
    }

    #[test]
    fn reports_become_instructions() {
        let report = |uart: &str| {
            let screen = Screen { width: 0, height: 0, rgb: Vec::new() };
            let (uart, untouched) = (uart.to_owned(), 0);
            Capture { screen, uart, untouched, took: Duration::ZERO }.costs()
        };
        let costs = report("frame 0: draw 12, send 3 cycles\nframe 1: draw 1, send 0 cycles\n");
        assert_eq!(costs, Ok(vec![Cost { draw: 240, send: 60 }, Cost { draw: 20, send: 0 }]));
        for wrong in ["", "stopped: stuck\n", "frame 1: draw 1, send 2 cycles\n", "frame 0: draw"] {
            assert!(report(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_longest_painted_run_is_counted() {
        assert_eq!(longest_painted(&[]), 0);
        let ram = [&[0xCC; 4][..], &[1; 4], &[0xCC; 8], &[0xCC, 0xCC, 0xCC, 0]].concat();
        assert_eq!(longest_painted(&ram), 8);
    }

    #[test]
    fn a_machine_that_is_none_is_an_error() {
        if Command::new("qemu-system-arm").arg("--version").output().is_err() {
            return;
        }
        let error = capture("no-such-machine", Path::new("nothing"), (1, 1)).unwrap_err();
        assert!(error.contains("no-such-machine"), "{error}");
    }
}
