//! Builds the library for the bare-metal targets, with and without features:
//! `cargo run -p host-tests --release --bin targets`.

use host_tests::cross::{MACHINES, cargo, root, run};
use std::process::ExitCode;

/// Builds the library for one target with these features.
fn check(target: &str, features: &[&str]) -> Result<(), String> {
    let mut command = cargo("check", target)?;
    command.args(["--release", "-p", "hither"]).args(features).current_dir(root());
    run(&mut command).map(drop)
}

fn main() -> ExitCode {
    let mut targets: Vec<_> = MACHINES.iter().map(|machine| machine.target).collect();
    targets.dedup();
    let mut failed = false;
    for target in targets {
        for features in [&[][..], &["--all-features"]] {
            let name = features.first().unwrap_or(&"no features");
            match check(target, features) {
                Ok(()) => println!("{target}, {name}: builds"),
                Err(why) => {
                    println!("{target}, {name}: {why}");
                    failed = true;
                }
            }
        }
    }
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}
