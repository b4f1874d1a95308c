//! Draws a scene of triangles through the library and prints every covered pixel; see
//! [`host_tests::dump`].
//!
//! `dump < scene.txt`, `dump --snapped < scene.txt`, `dump --tiers`.

use std::io::{self, BufWriter, Read, Write};
use std::process::ExitCode;

use host_tests::dump::{Scene, TierName, coverage, snapped};

/// The status of a scene or a command line that cannot be taken.
const NOT_TAKEN: u8 = 2;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let outcome = match arguments[..] {
        ["--tiers"] => {
            TierName::ALL.into_iter().try_for_each(|tier| writeln!(io::stdout(), "{}", tier.name()))
        }
        [] => return with_scene(coverage),
        ["--snapped"] => return with_scene(snapped),
        _ => {
            eprintln!("dump [--snapped] < scene, or dump --tiers");
            return ExitCode::from(NOT_TAKEN);
        }
    };
    status(outcome)
}

/// Reads all of a scene, then prints it.
fn with_scene(
    print: impl Fn(&Scene, &mut BufWriter<io::StdoutLock<'static>>) -> io::Result<()>,
) -> ExitCode {
    let mut text = Vec::new();
    if let Err(error) = io::stdin().read_to_end(&mut text) {
        return status(Err(error));
    }
    match Scene::parse(&text) {
        Ok(scene) => {
            let mut out = BufWriter::with_capacity(1 << 16, io::stdout().lock());
            status(print(&scene, &mut out).and_then(|()| out.flush()))
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(NOT_TAKEN)
        }
    }
}

/// The exit status; a reader that has had enough is no failure.
fn status(outcome: io::Result<()>) -> ExitCode {
    match outcome {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
        _ => ExitCode::SUCCESS,
    }
}
