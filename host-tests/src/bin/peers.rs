//! Counts what other crates' flat triangles cost, beside hither's, on the same emulated machines:
//!
//! ```text
//! cargo run -p host-tests --release --bin peers [-- --isa m4f,m0,..] [--check | --write]
//! ```
//!
//! Prints the table `peers` of docs/figures.md, whose section says what is measured. `--check` fails where the document
//! says something else; `--write` writes it anew. Both are for `m4f` and `m0`, as is a call without `--isa`.

use host_tests::cross::{MACHINES, Machine, toolchain};
use host_tests::measure::command::{Documents, chosen, progress, tables};
use host_tests::measure::error::references;
use host_tests::measure::peers::{WORKLOADS, count, table, titles};
use host_tests::measure::size::ISAS;
use host_tests::measure::{Figure, firmware};
use std::process::ExitCode;

fn main() -> ExitCode {
    let result = parse(std::env::args().skip(1));
    match result.and_then(|(machines, documents)| compare(&machines, documents)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

/// Reads the arguments.
fn parse(
    mut arguments: impl Iterator<Item = String>,
) -> Result<(Vec<&'static Machine>, Documents), String> {
    let usual = ISAS.iter().filter_map(|isa| MACHINES.iter().find(|m| m.isa == *isa));
    let usual: Vec<&Machine> = usual.collect();
    let (mut machines, mut documents) = (usual.clone(), Documents::Leave);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--isa" => {
                let list = arguments.next().ok_or("--isa needs a list")?;
                machines = chosen(&list, MACHINES.iter(), |machine| machine.isa)?;
                // In the order of the table.
                machines.sort_by_key(|m| ISAS.iter().position(|isa| *isa == m.isa).unwrap_or(2));
            }
            "--check" => documents = Documents::Check,
            "--write" => documents = Documents::Write,
            _ => return Err(format!("{argument} is not --isa, --check or --write")),
        }
    }
    let isas = |machines: &[&Machine]| machines.iter().map(|m| m.isa).collect::<Vec<_>>();
    if documents != Documents::Leave && isas(&machines) != isas(&usual) {
        return Err(format!("--check and --write need {}", ISAS.join(" and ")));
    }
    Ok((machines, documents))
}

/// Measures the peers and hither on these machines.
fn compare(machines: &[&Machine], documents: Documents) -> Result<(), String> {
    let first = machines.first().ok_or("no instruction set is asked for")?;
    let bar = progress(1 + 2 * machines.len() as u64);
    bar.set_message("host: references");
    let references = references(&WORKLOADS);
    bar.inc(1);
    let (mut counts, mut figures) = (Vec::new(), Vec::new());
    for machine in machines {
        bar.set_message(format!("{}: peers", machine.isa));
        counts.extend(count(machine)?);
        bar.inc(1);
        bar.set_message(format!("{}: hither", machine.isa));
        for count in firmware::count(machine)? {
            let mut same =
                references.iter().filter(|r| (r.workload, r.tier) == (count.workload, count.tier));
            if let Some(reference) = same.next() {
                figures.push(Figure::new(&count, reference)?);
            }
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    let block = table(&counts, &figures, &titles()?, &toolchain(first.target)?)?;
    print!("{}", block.text);
    tables("peers", documents, &["docs/figures.md"], &[block])
}
