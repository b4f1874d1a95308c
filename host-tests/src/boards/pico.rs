//! The board `pico-st7789` on an emulated RP2040 with a model of its panel, in JavaScript.

use super::screen::Screen;
use crate::cross::{root, run, target_folder};
use hither::{Framebuffer, PerspectiveEvery, Quick, Rgb565, Vertex, Viewport};
use hither_examples::rgb565;
use hither_scenes::spinning_teapot::{Moment, VERTEX_COUNT, draw_onto};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

/// Columns and rows that are seen, from the top left of the panel's memory.
const SIDE: u32 = 240;

/// Columns of the panel's memory.
const MEMORY_WIDTH: usize = 240;

/// Bytes of the panel's memory: 240 x 320 words.
const MEMORY_BYTES: usize = 2 * MEMORY_WIDTH * 320;

/// The panel's COLMOD for 16 bits a pixel.
const RGB565: u64 = 0x55;

/// A run that takes longer is ended.
const SECONDS: u32 = 120;

/// Of the chip's time: firmwares that take longer are taken to be stuck.
const MILLISECONDS_A_FRAME: u32 = 2000;

/// Frames a turn, as the firmware counts them.
pub const FRAMES_A_TURN: u32 = 64;

/// What is emulated, and which fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Frames until the panel is looked at, from 1.
    pub frames: u32,
    /// The byte of pixels that the panel does not receive, counted from 1 over all frames.
    pub lose_byte: Option<u32>,
}

impl Default for Options {
    fn default() -> Self {
        Self { frames: 2, lose_byte: None }
    }
}

impl Options {
    /// The moment of the last frame.
    #[must_use]
    pub const fn last_moment(&self) -> Moment {
        Moment { number: self.frames.saturating_sub(1), frames: FRAMES_A_TURN }
    }
}

/// What the panel showed, and what the last frame took from its first instruction until it was sent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// What a person would see.
    pub screen: Screen,
    /// Instructions of the core.
    pub instructions_per_frame: u64,
    /// Cycles of the 125 MHz clock, sleep included. Flash is as fast as RAM here.
    pub cycles_per_frame: u64,
}

/// Runs a firmware on the emulated board until it has drawn and sent some frames.
///
/// # Errors
///
/// What is missing on this machine and which package brings it; the emulator's words, where the
/// firmware does not come so far; what the panel took offence at; or why nothing is seen on it.
pub fn capture(elf: &Path, options: &Options) -> Result<Run, String> {
    static INSTALLED: OnceLock<Result<(), String>> = OnceLock::new();
    INSTALLED.get_or_init(|| install(&folder())).clone()?;
    let memory = Scratch::new(elf);
    let mut command = Command::new("timeout");
    command.arg(SECONDS.to_string()).arg("node").arg(folder().join("emulate.js"));
    command.arg(elf).arg(&memory.0).args(["--frames", &options.frames.to_string()]);
    command.args(["--lose-byte", &options.lose_byte.unwrap_or(0).to_string()]);
    let limit = MILLISECONDS_A_FRAME.saturating_mul(options.frames);
    command.args(["--milliseconds", &limit.to_string()]);
    let printed = run(&mut command)?;
    let bytes = std::fs::read(&memory.0);
    let bytes = bytes.map_err(|error| format!("{}: {error}", memory.0.display()))?;
    parse(&printed, &bytes)
}

/// What the panel shows at a moment, as the host draws it, in the same tier.
///
/// # Panics
///
/// Where the scene's constants are broken.
#[must_use]
pub fn expected(moment: Moment) -> Screen {
    let pixels = (SIDE * SIDE) as usize;
    let (mut words, mut depth) = (vec![0; pixels], vec![0; pixels]);
    let mut cache = vec![Vertex::EMPTY; VERTEX_COUNT];
    let buffer = Framebuffer::<Rgb565>::try_new(&mut words, SIDE, SIDE).expect("a word a pixel");
    let viewport = Viewport::new(SIDE, SIDE).expect("at most 512 x 512");
    let knobs = (Quick::<8>, PerspectiveEvery::<16>);
    draw_onto(buffer, viewport, knobs, &mut depth, moment, &mut cache).expect("a word a pixel");
    Screen { width: SIDE, height: SIDE, rgb: rgb565::expand_all(&words) }
}

/// Where the emulator is.
fn folder() -> PathBuf {
    root().join("host-tests/emulators/rp2040")
}

/// A file for the panel's memory, of this run alone, that goes when the run is over.
struct Scratch(PathBuf);

impl Scratch {
    fn new(elf: &Path) -> Self {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        Self(elf.with_extension(format!("{}-{number}.gram", std::process::id())))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // There is none where the run failed.
        let _ = std::fs::remove_file(&self.0);
    }
}

/// Installs the emulator's package beside its scripts, unless the version that they ask for is there.
fn install(folder: &Path) -> Result<(), String> {
    require("node", "nodejs")?;
    let asked = json(&folder.join("package.json"))?;
    let installed = json(&folder.join("node_modules/rp2040js/package.json"));
    if installed.is_ok_and(|package| package["version"] == asked["dependencies"]["rp2040js"]) {
        return Ok(());
    }
    require("npm", "npm")?;
    let mut command = Command::new("npm");
    command.args(["ci", "--no-audit", "--no-fund", "--ignore-scripts"]).current_dir(folder);
    run(&mut command).map(drop).map_err(|why| format!("npm's package rp2040js is missing: {why}"))
}

/// Checks that a program is there.
fn require(program: &str, package: &str) -> Result<(), String> {
    match Command::new(program).arg("--version").output() {
        Ok(_) => Ok(()),
        Err(error) => {
            Err(format!("{program} is missing ({error}): Debian's package {package} brings it"))
        }
    }
}

/// A file of JSON.
fn json(path: &Path) -> Result<Value, String> {
    let explain = |why: &dyn std::fmt::Display| format!("{}: {why}", path.display());
    let text = std::fs::read_to_string(path).map_err(|error| explain(&error))?;
    serde_json::from_str(&text).map_err(|error| explain(&error))
}

/// What the emulator's line and the panel's memory say.
fn parse(line: &str, memory: &[u8]) -> Result<Run, String> {
    let printed: Value = serde_json::from_str(line)
        .map_err(|error| format!("the emulator printed {line:?}: {error}"))?;
    let last = printed["frames"].as_array().and_then(|frames| frames.last());
    let count = |name: &str| {
        let count = last.and_then(|frame| frame[name].as_u64());
        count.ok_or_else(|| format!("no {name} of a frame in {line:?}"))
    };
    Ok(Run {
        screen: shown(&printed["panel"], memory)?,
        instructions_per_frame: count("instructions")?,
        cycles_per_frame: count("cycles")?,
    })
}

/// What a person sees on a panel with these registers and this memory.
fn shown(panel: &Value, memory: &[u8]) -> Result<Screen, String> {
    let flag = |name: &str| panel[name].as_bool().ok_or_else(|| format!("no {name} in {panel}"));
    let errors = panel["errors"].as_array().ok_or_else(|| format!("no errors in {panel}"))?;
    if !errors.is_empty() {
        let errors: Vec<_> = errors.iter().map(|error| error.as_str().unwrap_or("?")).collect();
        return Err(format!("the panel took offence: {}", errors.join("; ")));
    }
    if flag("asleep")? || !flag("on")? {
        return Err("the panel is dark: it is asleep or off".to_owned());
    }
    if panel["colmod"] != RGB565 {
        return Err(format!("the panel's pixel format is {}, not {RGB565}", panel["colmod"]));
    }
    if memory.len() != MEMORY_BYTES {
        return Err(format!("the panel's memory is {} bytes, not {MEMORY_BYTES}", memory.len()));
    }
    // The glass of this board shows the complement, unless it is told to invert.
    let flip = if flag("inverted")? { 0 } else { u16::MAX };
    let words = memory.chunks_exact(2).map(|word| u16::from_le_bytes([word[0], word[1]]) ^ flip);
    let seen: Vec<u16> = words.take(MEMORY_WIDTH * SIDE as usize).collect();
    Ok(Screen { width: SIDE, height: SIDE, rgb: rgb565::expand_all(&seen) })
}

/// An ELF file for flash with these Thumb instructions at its start.
fn firmware(thumb: &[u16]) -> Vec<u8> {
    let mut boot2 = [0; 252];
    for (at, instruction) in thumb.iter().enumerate() {
        boot2[2 * at..2 * at + 2].copy_from_slice(&instruction.to_le_bytes());
    }
    let crc = boot2.iter().fold(u32::MAX, |crc, &byte| {
        let step = |crc: u32, _| (crc << 1) ^ if crc >> 31 == 1 { 0x04c1_1db7 } else { 0 };
        (0..8).fold(crc ^ u32::from(byte) << 24, step)
    });
    let mut elf = vec![0; 52];
    elf[..6].copy_from_slice(b"\x7fELF\x01\x01");
    // For Arm; one program header, of 32 bytes, behind this one.
    (elf[18], elf[28], elf[42], elf[44]) = (40, 52, 32, 1);
    let header = [1, 84, 0x1000_0000, 0x1000_0000, 256, 256, 5, 4];
    elf.extend(header.iter().flat_map(|word: &u32| word.to_le_bytes()));
    elf.extend(boot2);
    elf.extend(crc.to_le_bytes());
    elf
}

/// Checks that a run ends, with a sentence, whatever the firmware does: asleep for ever, busy for ever, panicked, or no
/// firmware at all.
///
/// # Errors
///
/// Which one ended otherwise, and how.
pub fn check_ends() -> Result<(), String> {
    const WFI: u16 = 0xbf30;
    const BRANCH_BACK: u16 = 0xe7fd;
    const BRANCH_HERE: u16 = 0xe7fe;
    const UDF: u16 = 0xde00;
    let asleep = firmware(&[WFI, BRANCH_BACK]);
    let mut spoiled = asleep.clone();
    *spoiled.last_mut().expect("256 bytes and more") ^= 1;
    let cases = [
        ("asleep.elf", asleep, "asleep for ever, after 0 of 2 frames"),
        ("busy.elf", firmware(&[BRANCH_HERE]), "0 of 2 frames after 4000 ms"),
        ("panic.elf", firmware(&[UDF]), "the firmware panicked (at 0x1000000"),
        ("spoiled.elf", spoiled, "boot2) is wrong"),
        ("text.elf", b"text".to_vec(), "not an ELF file for Arm"),
    ];
    let folder = target_folder();
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for (name, elf, expected) in cases {
        let path = folder.join(name);
        std::fs::write(&path, elf).map_err(|e| format!("{}: {e}", path.display()))?;
        match capture(&path, &Options::default()) {
            Err(why) if why.contains(expected) => {}
            other => return Err(format!("{name} ended with {other:?}")),
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINE: &str = r#"{"frames":[{"cycles":9,"instructions":8},{"cycles":7,"instructions":6}],
        "panel":{"on":true,"asleep":false,"inverted":true,"colmod":85,"errors":[]}}"#;

    #[test]
    fn memory_becomes_what_is_seen() {
        let mut memory = vec![0; MEMORY_BYTES];
        memory[..4].copy_from_slice(&[0x00, 0xf8, 0x1f, 0x00]);
        let run = parse(LINE, &memory).unwrap();
        assert_eq!((run.instructions_per_frame, run.cycles_per_frame), (6, 7));
        assert_eq!((run.screen.width, run.screen.height), (240, 240));
        assert_eq!(run.screen.rgb.len(), 3 * 240 * 240);
        assert_eq!(run.screen.rgb[..9], [255, 0, 0, 0, 0, 255, 0, 0, 0]);
        let complement = parse(&LINE.replace("\"inverted\":true", "\"inverted\":false"), &memory);
        assert_eq!(complement.unwrap().screen.rgb[..9], [0, 255, 255, 255, 255, 0, 255, 255, 255]);
    }

    #[test]
    fn a_panel_that_shows_nothing_is_an_error() {
        let memory = vec![0; MEMORY_BYTES];
        let why = |from: &str, to: &str| parse(&LINE.replace(from, to), &memory).unwrap_err();
        let dark = "the panel is dark: it is asleep or off";
        assert_eq!(why("\"on\":true", "\"on\":false"), dark);
        assert_eq!(why("\"asleep\":false", "\"asleep\":true"), dark);
        assert_eq!(why("85", "102"), "the panel's pixel format is 102, not 85");
        assert_eq!(why("[]", "[\"a\",\"b\"]"), "the panel took offence: a; b");
        assert!(why("\"on\":true,", "").starts_with("no on in"));
        assert!(why(",\"errors\":[]", "").starts_with("no errors in"));
        assert!(why("cycles", "circles").starts_with("no cycles of a frame in"));
        assert!(parse("", &memory).unwrap_err().starts_with("the emulator printed \"\""));
        let error = parse(LINE, &memory[1..]).unwrap_err();
        assert_eq!(error, "the panel's memory is 153599 bytes, not 153600");
    }

    #[test]
    fn what_is_missing_is_named_with_its_package() {
        let error = require("hither-no-such-program", "hither-package").unwrap_err();
        assert!(error.starts_with("hither-no-such-program is missing ("), "{error}");
        assert!(error.ends_with("Debian's package hither-package brings it"), "{error}");
    }

    #[test]
    fn the_last_moment_is_that_of_the_last_frame() {
        assert_eq!(Options::default().last_moment(), Moment { number: 1, frames: 64 });
    }
}
