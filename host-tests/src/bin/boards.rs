//! Builds the emulated boards, runs them, and compares what they drew with the host:
//! `cargo run -p host-tests --release --bin boards [-- ISA ..]`.
//!
//! Prints a line a board. The exit status is 1 where one failed.

use host_tests::cross::{MACHINES, Machine, build, emulate};
use std::process::ExitCode;
use std::time::Instant;

/// What the firmware prints, as the host draws it.
fn expected() -> Vec<String> {
    use hither_scenes::pictures::{WORDS, draw_all};
    let (mut color, mut depth) = ([0; WORDS], [0; WORDS]);
    let mut lines = Vec::new();
    draw_all(&mut color, &mut depth, |name, color, depth| {
        lines.push(format!("{name}: {color:08x} {depth:08x}"));
    });
    lines
}

/// Draws on a machine and compares; how many pictures are equal.
fn check(machine: &Machine, expected: &[String]) -> Result<usize, String> {
    let program = build("emulator", "pictures", machine.target, &[])?;
    let printed = emulate(machine, &program)?;
    let printed: Vec<&str> = printed.lines().map(str::trim_end).collect();
    if printed == expected {
        Ok(expected.len())
    } else {
        Err(format!("it drew {printed:?}, the host {expected:?}"))
    }
}

fn main() -> ExitCode {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let known = |name: &String| MACHINES.iter().any(|machine| machine.isa == name);
    if let Some(name) = asked.iter().find(|name| !known(name)) {
        let all: Vec<_> = MACHINES.iter().map(|machine| machine.isa).collect();
        eprintln!("{name} is not one of {}", all.join(", "));
        return ExitCode::from(2);
    }
    let expected = expected();
    let mut failed = false;
    for machine in MACHINES.iter().filter(|m| asked.is_empty() || asked.iter().any(|a| a == m.isa))
    {
        let start = Instant::now();
        let (verdict, why) = match check(machine, &expected) {
            Ok(pictures) => ("passed", format!("{pictures} pictures equal to the host's")),
            Err(why) => ("failed", why),
        };
        failed |= verdict == "failed";
        let seconds = start.elapsed().as_secs_f64();
        println!("emulator {}: {verdict}, {why} ({seconds:.1} s)", machine.isa);
    }
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}
