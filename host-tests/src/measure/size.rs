//! Flash, RAM and stack of firmwares that draw one workload in one tier.

use super::{TIERS, write_rows};
use crate::cross::{Machine, build, emulate};
use object::{Object, ObjectSection, SectionFlags, SectionKind};
use std::path::Path;

/// A firmware: its name in tables, and the feature that chooses it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Firmware {
    /// As tables and the CSV have it.
    pub name: &'static str,
    feature: &'static str,
}

/// What is measured: W1, W5 and W6g, each alone, and W1, W4 and W5 together.
pub const FIRMWARES: [Firmware; 4] = [
    Firmware { name: "W1", feature: "w1" },
    Firmware { name: "W5", feature: "w5" },
    Firmware { name: "W6g", feature: "w6g" },
    Firmware { name: "W1+W4+W5", feature: "shaders" },
];

/// The instruction sets whose firmwares are measured.
pub const ISAS: [&str; 2] = ["m4f", "m0"];

/// What one firmware takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Size {
    /// The instruction set.
    pub isa: &'static str,
    /// The firmware's name.
    pub workload: &'static str,
    /// The tier's name.
    pub tier: &'static str,
    /// Bytes of code and constants over an empty firmware's.
    pub flash: u64,
    /// Bytes of static variables, the frame's buffers and caches included.
    pub ram: u64,
    /// Bytes of stack below `main`'s frame, over an empty firmware's.
    pub stack: u64,
}

/// Bytes of one program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Bytes {
    flash: u64,
    ram: u64,
    stack: u64,
}

/// Builds and runs every firmware for a machine; `done` is called after each. All of them link without a panic.
///
/// # Errors
///
/// What the compiler, the linker or the emulator says.
pub fn measure(machine: &Machine, mut done: impl FnMut()) -> Result<Vec<Size>, String> {
    let empty = bytes(machine, "size")?;
    done();
    let mut sizes = Vec::new();
    for Firmware { name, feature } in FIRMWARES {
        for tier in TIERS {
            let Bytes { flash, ram, stack } = bytes(machine, &format!("size,{feature},{tier}"))?;
            sizes.push(Size {
                isa: machine.isa,
                workload: name,
                tier,
                flash: flash.saturating_sub(empty.flash),
                ram: ram.saturating_sub(empty.ram),
                stack: stack.saturating_sub(empty.stack),
            });
            done();
        }
    }
    Ok(sizes)
}

/// Bytes of flash of a firmware that draws a textured and a shaded mesh by a preset, over an empty firmware's.
///
/// # Errors
///
/// What the compiler, the linker or the emulator says.
pub fn flash_of_preset(machine: &Machine, preset: &str) -> Result<u64, String> {
    let empty = bytes(machine, "size")?;
    let features = format!("size,scenes,{}", preset.to_lowercase());
    Ok(bytes(machine, &features)?.flash.saturating_sub(empty.flash))
}

/// Bytes of stack that the whole pipeline, W6g, may take.
pub const STACK_LIMIT: u64 = 1536;

/// Whether W6g's stack is within [`STACK_LIMIT`] in every tier.
///
/// # Errors
///
/// Where it is not, with both numbers.
pub fn check_stack(sizes: &[Size]) -> Result<(), String> {
    match sizes.iter().find(|size| size.workload == "W6g" && size.stack > STACK_LIMIT) {
        None => Ok(()),
        Some(Size { isa, tier, stack, .. }) => {
            Err(format!("{isa}: W6g takes {stack} bytes of stack in {tier}: at most {STACK_LIMIT}"))
        }
    }
}

/// Builds a firmware of these features, and runs it for its stack.
fn bytes(machine: &Machine, features: &str) -> Result<Bytes, String> {
    let program = build_size(machine, features)?;
    let printed = emulate(machine, &program)?;
    let stack = u64::from_str_radix(printed.trim(), 16).map_err(|_| {
        format!("{}: the firmware with {features} printed {printed:?}", machine.isa)
    })?;
    let file = std::fs::read(&program).map_err(|e| format!("{}: {e}", program.display()))?;
    let (flash, ram) = sections(&file).map_err(|e| format!("{}: {e}", program.display()))?;
    Ok(Bytes { flash, ram, stack })
}

/// Builds the firmware `size`, which links only if it cannot panic.
///
/// # Errors
///
/// What the compiler or the linker says.
pub fn build_size(machine: &Machine, features: &str) -> Result<std::path::PathBuf, String> {
    let arguments = ["--no-default-features", "--features", features];
    build("emulator", "size", machine.target, &arguments)
}

/// Bytes of flash (code, constants, and what static variables start from) and of RAM (static variables, without the
/// stack) in a program.
///
/// # Errors
///
/// What is wrong with the file.
pub fn sections(file: &[u8]) -> Result<(u64, u64), object::Error> {
    const ALLOC: u64 = object::elf::SHF_ALLOC as u64;
    let (mut flash, mut ram) = (0, 0);
    for section in object::File::parse(file)?.sections() {
        let SectionFlags::Elf { sh_flags } = section.flags() else { continue };
        // Some linker scripts make a section of the RAM that is left, and dummies of addresses that memory mirrors.
        let name = section.name()?;
        if sh_flags & ALLOC == 0 || name == ".stack" || name.ends_with("_dummy") {
            continue;
        }
        match section.kind() {
            SectionKind::UninitializedData => ram += section.size(),
            SectionKind::Data => {
                flash += section.size();
                ram += section.size();
            }
            _ => flash += section.size(),
        }
    }
    Ok((flash, ram))
}

/// Writes the sizes as CSV.
///
/// # Errors
///
/// What the file system says, with the path.
pub fn write_csv(path: &Path, sizes: &[Size], toolchain: &str) -> Result<(), String> {
    let heading = ["isa", "workload", "tier", "flash", "ram", "stack", "toolchain"];
    let rows = sizes.iter().map(|size| {
        let Size { isa, workload, tier, flash, ram, stack } = size;
        let numbers = [flash, ram, stack].map(u64::to_string);
        let mut row = vec![(*isa).to_owned(), (*workload).to_owned(), (*tier).to_owned()];
        row.extend(numbers);
        row.push(toolchain.to_owned());
        row
    });
    write_rows(path, &heading, rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_deep_stack_is_an_error() {
        let size =
            |workload, stack| Size { isa: "m0", workload, tier: "exact", flash: 1, ram: 2, stack };
        assert_eq!(check_stack(&[size("W6g", STACK_LIMIT), size("W5", 9999)]), Ok(()));
        let error = check_stack(&[size("W6g", 1537)]).unwrap_err();
        assert_eq!(error, "m0: W6g takes 1537 bytes of stack in exact: at most 1536");
    }

    #[test]
    fn a_program_that_is_none_is_an_error() {
        assert!(sections(b"not a program").is_err());
    }
}
