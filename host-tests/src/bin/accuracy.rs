//! Prints how far attributes and depth are from the `f64` reference, a line for each row of the
//! tolerance table.
//!
//! `accuracy [SCENES]`: random scenes of each family, 100 if not said.

use std::process::ExitCode;

use host_tests::accuracy::TOLERANCES;

fn main() -> ExitCode {
    let scenes = match std::env::args().nth(1).map(|word| word.parse()) {
        None => 100,
        Some(Ok(scenes)) => scenes,
        Some(Err(error)) => {
            eprintln!("accuracy [SCENES]: {error}");
            return ExitCode::from(2);
        }
    };
    println!(
        "{:7} {:12} {:12} {:6} {:26} {:>10} {:>10} {:>10} {:>10}",
        "tier", "correction", "against", "scenes", "error of", "largest", "RMS", "bound", "pixels"
    );
    let mut passed = true;
    for row in TOLERANCES.iter().flatten() {
        let errors = row.survey(scenes);
        let within = errors.max <= row.bound;
        passed &= within;
        println!(
            "{row} {:>10.3e} {:>10.3e} {:>10.3e} {:>10}{}",
            errors.max,
            errors.rms(),
            row.bound,
            errors.count,
            if within { "" } else { " beyond the bound" }
        );
    }
    if passed { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
