//! What is checked of each board, and the faults that have to be noticed.

use super::screen::Screen;
use super::{oled, pico};
use crate::cross::{MACHINES, Machine, build, emulate};
use crate::measure::firmware::words;
use crate::measure::size::{build_size, sections};
use hither_scenes::bands_16k::{Memory, draw};
use hither_scenes::checksum::Checksum;
use hither_scenes::pictures::{WORDS, draw_all};
use hither_scenes::spinning_teapot::Moment;
use std::path::Path;

/// A program of a board, and how it is checked.
pub struct Case {
    /// The board and its program: what its picture is named after.
    pub name: String,
    check: Box<dyn Fn() -> Result<Passed, String>>,
}

/// What was found of a program that passed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Passed {
    /// In a few words.
    pub what: String,
    /// What its panel shows.
    pub screen: Option<Screen>,
    /// How many of its pixels a picture has for one of the panel, along each side.
    pub magnified: u32,
    /// Bytes of code and constants, where they are listed.
    pub flash: Option<u64>,
    /// Bytes of static variables.
    pub ram: Option<u64>,
    /// To draw a frame and send it.
    pub instructions: Option<u64>,
}

impl Case {
    fn new(name: impl Into<String>, check: impl Fn() -> Result<Passed, String> + 'static) -> Self {
        Self { name: name.into(), check: Box::new(check) }
    }

    /// Builds it, runs it, and compares.
    ///
    /// # Errors
    ///
    /// What could not be built or run, or how it differs from the host.
    pub fn check(&self) -> Result<Passed, String> {
        (self.check)()
    }
}

/// Every program that runs on an emulated machine.
#[must_use]
pub fn emulated() -> Vec<Case> {
    let mut cases: Vec<Case> = MACHINES
        .iter()
        .map(|machine| Case::new(format!("emulator-{}", machine.isa), || pictures(machine, &[])))
        .collect();
    cases.push(Case::new("emulator-microbit", || pictures(&MICROBIT, &["--features", "microbit"])));
    cases.push(Case::new("emulator-bands_16k", bands_16k));
    for board in oled::BOARDS {
        cases.push(Case::new(board.name, move || oled_board(&board)));
    }
    cases.push(Case::new("pico-st7789-bands", || pico_board(BANDS)));
    cases.push(Case::new("pico-st7789-frame", || pico_board(("pico-st7789", "frame"))));
    cases.push(Case::new("pico-st7789-embassy", || pico_board(("pico-st7789/embassy", "embassy"))));
    cases
}

/// The boards that are built only.
#[must_use]
pub fn built() -> Vec<Case> {
    [("stm32f429-disco", "thumbv7em-none-eabihf"), ("esp32c3", "riscv32imc-unknown-none-elf")]
        .map(|(board, target)| {
            Case::new(board, move || {
                let passed = measured(&build(board, board, target, &[])?)?;
                Ok(Passed { what: "built, not run".to_owned(), ..passed })
            })
        })
        .into()
}

/// Faults that must be noticed: each passes where a check fails as it should.
#[must_use]
pub fn faults() -> Vec<Case> {
    let mut cases = Vec::new();
    for board in oled::BOARDS {
        let name = format!("{}, the last flush cut short", board.name);
        cases.push(Case::new(name, move || {
            noticed(oled_panel(&board, SKIPPED)?.equals(&(board.expected)()))
        }));
    }
    let once = pico::Options { frames: 1, lose_byte: None };
    cases.push(Case::new("pico-st7789-bands, the last flush skipped", move || {
        noticed(pico_panel(BANDS, SKIPPED, once)?.1)
    }));
    let lossy = pico::Options { lose_byte: Some(50_001), ..once };
    cases.push(Case::new("pico-st7789-bands, a byte lost on the wire", move || {
        noticed(pico_panel(BANDS, &[], lossy)?.1)
    }));
    cases.push(Case::new("pico-st7789, firmwares that never end", || {
        pico::check_ends()?;
        Ok(Passed { what: "each ends with a sentence".to_owned(), ..Passed::default() })
    }));
    cases.push(Case::new("emulator, a firmware that can panic", || {
        let [m0, ..] = &MACHINES;
        match build_size(m0, "size,w1,exact,fault-panic") {
            Err(why) if why.contains("panic-never") => noticed(Err("it does not link".to_owned())),
            Err(why) => Err(why),
            Ok(_) => noticed(Ok(())),
        }
    }));
    cases
}

/// The main program of the flagship.
const BANDS: (&str, &str) = ("pico-st7789", "bands");

/// What leaves out the end of the last picture.
const SKIPPED: &[&str] = &["--features", "fault-skip-last-flush"];

/// QEMU's micro:bit: a Cortex-M0 with 16 kB of RAM.
const MICROBIT: Machine = Machine { isa: "microbit", machine: &["-M", "microbit"], ..MACHINES[0] };

/// A fault that has to show; how it does.
fn noticed(compared: Result<(), String>) -> Result<Passed, String> {
    match compared {
        Err(what) => Ok(Passed { what: format!("noticed: {what}"), ..Passed::default() }),
        Ok(()) => Err("the fault was not noticed".to_owned()),
    }
}

/// Checksums of the pictures on a machine, against the host's.
fn pictures(machine: &Machine, arguments: &[&str]) -> Result<Passed, String> {
    let (mut color, mut depth) = ([0; WORDS], [0; WORDS]);
    let mut expected = Vec::new();
    draw_all(&mut color, &mut depth, |name, color, depth| {
        expected.push(format!("{name}: {color:08x} {depth:08x}"));
    });
    let program = build("emulator", "pictures", machine.target, arguments)?;
    let printed = emulate(machine, &program)?;
    let printed: Vec<&str> = printed.lines().map(str::trim_end).collect();
    if printed == expected {
        let what = format!("{} pictures equal to the host's", expected.len());
        Ok(Passed { what, ..Passed::default() })
    } else {
        Err(format!("it drew {printed:?}, the host {expected:?}"))
    }
}

/// The micro:bit's RAM, in bytes.
const RAM_16K: u64 = 16 << 10;

/// The teapot at 240 x 240 in 16 kB of RAM, of which the linker's map has the variables and the program tells the stack.
fn bands_16k() -> Result<Passed, String> {
    let program = build("emulator", "bands_16k", MICROBIT.target, &["--features", "microbit"])?;
    let printed = emulate(&MICROBIT, &program)?;
    let (mut memory, mut deepest) = (Memory::new(), 0);
    let mut frames = 0;
    for line in printed.lines() {
        let fault = || format!("it printed {line:?}");
        let [number, sum, stack] = words(line).ok_or_else(fault)?;
        let number = number.parse().map_err(|_| fault())?;
        let mut expected = Checksum::new();
        draw(&mut memory, Moment { number, frames: 64 }, |_, words| {
            expected = expected.with_words(words);
        })
        .map_err(|error| error.to_string())?;
        if format!("{:08x}", expected.value()) != sum {
            return Err(format!("it drew frame {number} as {sum}, the host as {expected:08x?}"));
        }
        deepest = deepest.max(stack.parse::<u64>().map_err(|_| fault())?);
        frames += 1;
    }
    let path = program.with_file_name("bands_16k.map");
    let map = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let ram = ram_of_map(&map);
    if frames != 3 || ram == 0 || ram + deepest > RAM_16K {
        return Err(format!("{frames} frames of 3 in {ram} bytes and {deepest} of stack"));
    }
    let what = format!("{frames} frames equal to the host's, {deepest} bytes of stack");
    Ok(Passed { what, ram: Some(ram), ..measured(&program)? })
}

/// Bytes of RAM that the linker's map gives to sections: of lines of `VMA LMA Size Align Out`, in hexadecimal, those from
/// 2000 0000 on.
fn ram_of_map(map: &str) -> u64 {
    let size = |line: &str| {
        let [address, _, size, _, section] = words(line)?;
        let in_ram = u64::from_str_radix(address, 16).ok()? >= 0x2000_0000;
        let size = u64::from_str_radix(size, 16).ok()?;
        (in_ram && section.starts_with('.')).then_some(size)
    };
    map.lines().filter_map(size).sum()
}

/// Flash and RAM of a program.
fn measured(program: &Path) -> Result<Passed, String> {
    let context = |error: &dyn std::fmt::Display| format!("{}: {error}", program.display());
    let file = std::fs::read(program).map_err(|error| context(&error))?;
    let (flash, ram) = sections(&file).map_err(|error| context(&error))?;
    Ok(Passed { flash: Some(flash), ram: Some(ram), ..Passed::default() })
}

/// What is said of a panel that shows what it should.
const EQUAL: &str = "the panel shows the host's picture";

fn oled_board(board: &oled::Board) -> Result<Passed, String> {
    let program = build(board.name, board.name, oled::TARGET, &[])?;
    let capture = oled::capture(board.machine, &program, board.size)?;
    capture.screen.equals(&(board.expected)())?;
    let costs = capture.costs()?;
    let all: u64 = costs.iter().map(|cost| cost.draw + cost.send).sum();
    let what = format!(
        "{EQUAL} after {} frames, {} bytes of RAM untouched",
        costs.len(),
        capture.untouched
    );
    Ok(Passed {
        what,
        screen: Some(capture.screen),
        magnified: 4,
        instructions: Some(all / costs.len() as u64),
        ..measured(&program)?
    })
}

fn oled_panel(board: &oled::Board, arguments: &[&str]) -> Result<Screen, String> {
    let program = build(board.name, board.name, oled::TARGET, arguments)?;
    Ok(oled::capture(board.machine, &program, board.size)?.screen)
}

fn pico_board(program: (&str, &str)) -> Result<Passed, String> {
    let (passed, compared) = pico_panel(program, &[], pico::Options::default())?;
    compared.map(|()| passed)
}

/// Builds and runs a program of the Pico; what was found, and whether the panel shows the host's picture.
fn pico_panel(
    (board, program): (&str, &str),
    arguments: &[&str],
    options: pico::Options,
) -> Result<(Passed, Result<(), String>), String> {
    let program = build(board, program, MACHINES[0].target, arguments)?;
    let run = pico::capture(&program, &options)?;
    let compared = run.screen.equals(&pico::expected(options.last_moment()));
    let what =
        format!("{EQUAL} after {} frames, {} cycles each", options.frames, run.cycles_per_frame);
    let passed = Passed {
        what,
        screen: Some(run.screen),
        magnified: 1,
        instructions: Some(run.instructions_per_frame),
        ..measured(&program)?
    };
    Ok((passed, compared))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ram_is_read_off_a_map() {
        let map = "     VMA      LMA     Size Align Out     In      Symbol\n\
                   c0       c0     b16c     4 .text\n\
             20000000     e000       10     4 .data\n\
             20000000     e000       10     4         main.o:(.data.X)\n\
             20000010 20000010     34a0     8 .bss\n\
             20000010 20000010     34a0     1                 MEMORY\n\
                    0        0     1234     1 .debug_info\n";
        assert_eq!(ram_of_map(map), 0x34b0);
        assert_eq!(ram_of_map(""), 0);
    }
}
