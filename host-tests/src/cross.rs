//! Building and emulating firmware: rustup's targets where they are installed, else Debian's
//! toolchain with `core` built from source.

use std::path::{Path, PathBuf};
use std::process::Command;

/// An emulated machine that a firmware runs on.
#[derive(Clone, Copy, Debug)]
pub struct Machine {
    /// Short name of the instruction set: `m0`, `m4f`, `rv32imc` and so on.
    pub isa: &'static str,
    /// Rust's target triple.
    pub target: &'static str,
    /// The emulator.
    pub emulator: &'static str,
    /// The emulator's arguments that choose the machine.
    pub machine: &'static [&'static str],
    /// Debian's package that brings the emulator.
    pub package: &'static str,
    /// How long an instruction takes, for `-icount`: 2 to this power nanoseconds.
    pub shift: u32,
    /// Instructions a tick of the clock that firmware counts by, as a fraction.
    pub instructions_per_tick: (u64, u64),
}

/// Nanoseconds that an instruction takes on Arm's machines: more than twice a tick of their timers, so that two readings
/// of one tell how many instructions are between.
const INSTRUCTION_NANOS: u64 = 128;

/// One of Arm's MPS2 boards, whose timer ticks every `tick_nanos` nanoseconds.
const fn mps2(
    isa: &'static str,
    target: &'static str,
    machine: &'static [&'static str],
    tick_nanos: u64,
) -> Machine {
    let instructions_per_tick = (tick_nanos, INSTRUCTION_NANOS);
    let (emulator, package) = ("qemu-system-arm", "qemu-system-arm");
    let shift = INSTRUCTION_NANOS.trailing_zeros();
    Machine { isa, target, emulator, machine, package, shift, instructions_per_tick }
}

/// The emulated machines, one an instruction set. The first runs Cortex-M0 code on a Cortex-M3.
pub const MACHINES: [Machine; 6] = [
    mps2("m0", "thumbv6m-none-eabi", &["-M", "mps2-an385"], 40),
    mps2("m3", "thumbv7m-none-eabi", &["-M", "mps2-an385"], 40),
    mps2("m4f", "thumbv7em-none-eabihf", &["-M", "mps2-an386"], 40),
    mps2("m7", "thumbv7em-none-eabihf", &["-M", "mps2-an500"], 40),
    mps2("m33", "thumbv8m.main-none-eabihf", &["-M", "mps2-an505"], 50),
    Machine {
        isa: "rv32imc",
        target: "riscv32imc-unknown-none-elf",
        emulator: "qemu-system-riscv32",
        machine: &["-M", "virt", "-cpu", "rv32,a=off,f=off,d=off", "-m", "16M", "-bios", "none"],
        package: "qemu-system-misc",
        // Its counter of retired instructions counts nanoseconds under `-icount`.
        shift: 0,
        instructions_per_tick: (1, 1),
    },
];

/// Arguments for every machine: no screen, output through semihosting.
const HEADLESS: &str =
    "-nographic -monitor none -serial none -semihosting-config enable=on,target=native";

/// The folder of the workspace.
#[must_use]
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Where firmware is built: one folder for all boards.
#[must_use]
pub fn target_folder() -> PathBuf {
    let base = std::env::var_os("CARGO_TARGET_DIR");
    base.map_or_else(|| root().join("target"), PathBuf::from).join("boards")
}

/// What a command printed, or why it failed.
///
/// # Errors
///
/// A sentence that names the command, where it cannot be started or fails.
pub fn run(command: &mut Command) -> Result<String, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| format!("{name}: {error}"))?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    if output.status.success() {
        Ok(text(&output.stdout))
    } else {
        Err(format!("{name} failed ({}):\n{}", output.status, text(&output.stderr)))
    }
}

/// A `cargo` command that builds for a bare-metal target.
///
/// # Errors
///
/// What to install, where no toolchain on this machine has the target.
pub fn cargo(verb: &str, target: &str) -> Result<Command, String> {
    let sysroot = run(Command::new("rustc").args(["--print", "sysroot"]))?;
    let mut command = Command::new("cargo");
    if Path::new(sysroot.trim()).join("lib/rustlib").join(target).is_dir() {
        command.arg(verb);
    } else if Path::new("/usr/bin/cargo").exists() && source_of_core().is_dir() {
        command = Command::new("/usr/bin/cargo");
        command.env("RUSTC", "/usr/bin/rustc").env("RUSTC_BOOTSTRAP", "1");
        // Flags and wrappers of the caller's toolchain are not this one's.
        command.env_remove("RUSTUP_TOOLCHAIN").env_remove("RUSTC_WRAPPER");
        command.args([verb, "-Z", "build-std=core"]);
    } else {
        return Err(format!(
            "no toolchain for {target}: `rustup target add {target}`, or Debian's packages \
             rustc-web, cargo-web, rust-web-src and lld"
        ));
    }
    command.args(["--target", target]).env("CARGO_TARGET_DIR", target_folder());
    Ok(command)
}

/// What compiles for a target: the version that `rustc` gives of itself.
///
/// # Errors
///
/// What to install, where no toolchain on this machine has the target.
pub fn toolchain(target: &str) -> Result<String, String> {
    let cargo = cargo("build", target)?;
    let compiler = cargo.get_envs().find(|(name, _)| *name == "RUSTC").and_then(|(_, path)| path);
    let mut rustc = Command::new(compiler.unwrap_or("rustc".as_ref()));
    Ok(run(rustc.arg("--version"))?.trim().to_owned())
}

/// Where Debian's toolchain keeps the source of `core`.
fn source_of_core() -> PathBuf {
    let sysroot = run(Command::new("/usr/bin/rustc").args(["--print", "sysroot"]));
    let sysroot = sysroot.unwrap_or_default();
    Path::new(sysroot.trim()).join("lib/rustlib/src/rust/library/core")
}

/// Builds a board's firmware for a target with more of cargo's arguments; the path of the program.
///
/// # Errors
///
/// The toolchain's or the compiler's words.
pub fn build(
    board: &str,
    program: &str,
    target: &str,
    arguments: &[&str],
) -> Result<PathBuf, String> {
    let mut command = cargo("build", target)?;
    command.args(["--release", "--locked", "--bin", program]).args(arguments);
    command.current_dir(root().join("boards").join(board));
    run(&mut command)?;
    Ok(target_folder().join(target).join("release").join(program))
}

/// Runs a program on a machine until it ends; what it printed.
///
/// # Errors
///
/// The emulator's words, or the package that brings it.
pub fn emulate(machine: &Machine, program: &Path) -> Result<String, String> {
    let mut command = Command::new("timeout");
    command.args(["120", machine.emulator]).args(machine.machine);
    command.args(HEADLESS.split(' ')).args(["-icount", &format!("shift={}", machine.shift)]);
    command.arg("-kernel").arg(program);
    run(&mut command).map_err(|error| {
        match Command::new(machine.emulator).arg("--version").output() {
            Ok(_) => error,
            Err(_) => {
                format!(
                    "{} is missing: Debian's package {} brings it",
                    machine.emulator, machine.package
                )
            }
        }
    })
}
