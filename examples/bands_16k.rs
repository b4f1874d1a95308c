//! The teapot at 240 x 240 with all that it is drawn with in 14 kB: bands of six rows, as firmware for a chip with 16 kB of RAM
//! draws it (`boards/emulator`, `bands_16k`). The drawing is in `scenes/src/bands_16k.rs`.

use hither_examples::{picture, rgb565};
use hither_scenes::bands_16k::{Memory, SIDE, draw};
use hither_scenes::spinning_teapot::Moment;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut memory = Memory::new();
    let mut shown = Vec::new();
    // Each band's words are in the byte order of panels: what firmware sends, this gathers.
    draw(&mut memory, Moment { number: 0, frames: 64 }, |_, words| {
        shown.extend(words.iter().map(|&word| u16::from_be(word)));
    })?;
    let path = picture::target_folder().join("bands_16k.png");
    picture::write_png(&path, SIDE, SIDE, &rgb565::expand_all(&shown))?;
    println!("drawn in {} bytes: {}", size_of::<Memory>(), path.display());
    Ok(())
}
