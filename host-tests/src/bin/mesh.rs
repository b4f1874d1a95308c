//! Turns a model into Rust source for flash; see [`host_tests::mesh`].
//!
//! `mesh model.obj [--texture texture.png] > model.rs`.

use std::io::{self, Write};
use std::process::ExitCode;

use host_tests::mesh::{Options, made};

/// The status of a command line or a file that cannot be taken.
const NOT_TAKEN: u8 = 2;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let made = match Options::of(&arguments).and_then(|options| made(&options)) {
        Ok(made) => made,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::from(NOT_TAKEN);
        }
    };
    eprint!("{}", made.report);
    match io::stdout().write_all(made.source.as_bytes()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
        _ => ExitCode::SUCCESS,
    }
}
