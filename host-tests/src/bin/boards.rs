//! Builds the boards, runs those that can be emulated, and compares what their panels show with the host:
//!
//! ```text
//! cargo run -p host-tests --release --bin boards [-- NAME ..] [--full] [--faults] [--check | --write]
//! ```
//!
//! Prints a line a board and program, and writes each panel as a picture under `target/boards/`. Names choose those that
//! they are a part of. `--full` builds the other boards as well; `--faults` runs faulty firmwares and panels
//! instead, and passes where each is noticed. `--check` fails where the table in boards/README.md says something else;
//! `--write` writes its figures anew. The exit status is 1 where one failed.

use host_tests::boards::cases::{Case, Passed, built, emulated, faults};
use host_tests::boards::table;
use host_tests::cross::{MACHINES, root, target_folder, toolchain};
use std::process::ExitCode;
use std::time::Instant;

/// What is asked for.
#[derive(Default)]
struct Asked {
    names: Vec<String>,
    full: bool,
    faults: bool,
    check: bool,
    write: bool,
}

fn main() -> ExitCode {
    let asked = match parse(std::env::args().skip(1)) {
        Ok(asked) => asked,
        Err(why) => {
            eprintln!("{why}");
            return ExitCode::from(2);
        }
    };
    let (passed, mut failed) = run(&asked);
    if asked.check || asked.write {
        if let Err(why) = document(&passed, asked.write) {
            println!("boards/README.md: {why}");
            failed = true;
        }
    }
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// Reads the arguments.
fn parse(arguments: impl Iterator<Item = String>) -> Result<Asked, String> {
    let mut asked = Asked::default();
    for argument in arguments {
        match argument.as_str() {
            "--full" => asked.full = true,
            "--faults" => asked.faults = true,
            "--check" => asked.check = true,
            "--write" => asked.write = true,
            flag if flag.starts_with('-') => {
                return Err(format!("{flag} is not --full, --faults, --check or --write"));
            }
            _ => asked.names.push(argument),
        }
    }
    let all = cases(&Asked { full: true, faults: asked.faults, ..Asked::default() });
    let known = |name: &&String| all.iter().any(|case| case.name.contains(name.as_str()));
    match asked.names.iter().find(|name| !known(name)) {
        Some(unknown) => {
            let names: Vec<&str> = all.iter().map(|case| case.name.as_str()).collect();
            Err(format!("{unknown} is no part of one of {}", names.join(", ")))
        }
        None => Ok(asked),
    }
}

/// The cases that are asked for.
fn cases(asked: &Asked) -> Vec<Case> {
    let mut cases = if asked.faults { faults() } else { emulated() };
    if asked.full && !asked.faults {
        cases.extend(built());
    }
    let chosen = |case: &Case| {
        asked.names.is_empty() || asked.names.iter().any(|name| case.name.contains(name.as_str()))
    };
    cases.retain(chosen);
    cases
}

/// Checks all; those that passed, and whether one failed.
fn run(asked: &Asked) -> (Vec<(String, Passed)>, bool) {
    let (mut all, mut failed) = (Vec::new(), false);
    for case in cases(asked) {
        let start = Instant::now();
        let result = case.check().and_then(|passed| picture(&case, &passed).map(|()| passed));
        let seconds = start.elapsed().as_secs_f64();
        match result {
            Ok(passed) => {
                println!(
                    "{}: passed, {}{} ({seconds:.1} s)",
                    case.name,
                    passed.what,
                    figures(&passed)
                );
                all.push((case.name, passed));
            }
            Err(why) => {
                println!("{}: failed, {why} ({seconds:.1} s)", case.name);
                failed = true;
            }
        }
    }
    (all, failed)
}

/// Writes what a panel shows.
fn picture(case: &Case, passed: &Passed) -> Result<(), String> {
    let path = target_folder().join(format!("{}.png", case.name));
    passed.screen.as_ref().map_or(Ok(()), |screen| screen.write_png(&path, passed.magnified))
}

/// What was measured, as words.
fn figures(passed: &Passed) -> String {
    let figure = |number: Option<u64>, what| number.map(|n| format!(", {n} {what}"));
    let figures = [
        figure(passed.flash, "bytes of flash"),
        figure(passed.ram, "of RAM"),
        figure(passed.instructions, "instructions a frame"),
    ];
    figures.into_iter().flatten().collect()
}

/// Checks or writes the figures in the boards' table.
fn document(passed: &[(String, Passed)], write: bool) -> Result<(), String> {
    let path = root().join("boards/README.md");
    let text = std::fs::read_to_string(&path).map_err(|error| error.to_string())?;
    let toolchain = toolchain(MACHINES[0].target)?;
    if write {
        let text = table::updated(&text, passed, &toolchain);
        return std::fs::write(&path, text).map_err(|error| error.to_string());
    }
    let listed = passed.iter().filter(|(_, passed)| passed.flash.is_some()).count();
    let rows = table::compare(&text, passed, &toolchain)?;
    if rows < listed {
        return Err(format!("{rows} rows for {listed} programs"));
    }
    Ok(())
}
