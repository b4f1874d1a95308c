//! Counts what hither costs on emulated machines, and how far off it is:
//!
//! ```text
//! cargo run -p host-tests --release --bin measure [-- --isa m0,m3,m4f,m7,m33,rv32imc] [--workload W1,..]
//!     [--check | --write]
//! ```
//!
//! Prints a table, and writes `target/measure.csv` and, with `m4f` and `m0` and all workloads, `target/size.csv`.
//! Instructions are executed ones, the same number run after run. `--check` fails where the tables of figures in
//! README.md and docs/figures.md say something else, or where the stack is over its budget; `--write` writes them anew.

use hither_examples::picture::target_folder;
use hither_scenes::workloads::Workload;
use host_tests::cross::{MACHINES, Machine, toolchain};
use host_tests::measure::command::{Documents, chosen, progress, tables};
use host_tests::measure::error::references;
use host_tests::measure::outputs::Cost;
use host_tests::measure::readme::blocks;
use host_tests::measure::size::{FIRMWARES, ISAS, Size};
use host_tests::measure::{Figure, TIERS, firmware, outputs, size, unit_name, write_csv};
use indicatif::ProgressBar;
use std::process::ExitCode;

/// Where the tables of figures are.
const DOCUMENTS: [&str; 2] = ["README.md", "docs/figures.md"];

/// What is asked for.
struct Asked {
    machines: Vec<&'static Machine>,
    workloads: Vec<Workload>,
    documents: Documents,
}

fn main() -> ExitCode {
    let result = parse(std::env::args().skip(1)).and_then(|asked| measure(&asked));
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

/// Reads the arguments.
fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Asked, String> {
    let mut asked = Asked {
        machines: MACHINES.iter().collect(),
        workloads: Workload::ALL.to_vec(),
        documents: Documents::Leave,
    };
    while let Some(argument) = arguments.next() {
        let mut list = || arguments.next().ok_or(format!("{argument} needs a list"));
        match argument.as_str() {
            "--isa" => {
                asked.machines = chosen(&list()?, MACHINES.iter(), |machine| machine.isa)?;
            }
            "--workload" => {
                asked.workloads = chosen(&list()?, Workload::ALL.into_iter(), |w| w.name())?;
            }
            "--check" => asked.documents = Documents::Check,
            "--write" => asked.documents = Documents::Write,
            _ => return Err(format!("{argument} is not --isa, --workload, --check or --write")),
        }
    }
    let all = asked.machines.len() == MACHINES.len() && asked.is_whole();
    if asked.documents != Documents::Leave && !all {
        return Err("--check and --write need every instruction set and workload".to_owned());
    }
    Ok(asked)
}

impl Asked {
    /// Whether every workload is asked for.
    fn is_whole(&self) -> bool {
        self.workloads.len() == Workload::ALL.len()
    }
}

/// Measures what is asked for.
fn measure(asked: &Asked) -> Result<(), String> {
    let sized: Vec<&Machine> = if asked.is_whole() {
        asked.machines.iter().copied().filter(|m| ISAS.contains(&m.isa)).collect()
    } else {
        Vec::new()
    };
    let steps = 1 + asked.machines.len() + sized.len() * (2 + FIRMWARES.len() * TIERS.len());
    let bar = progress(steps as u64);
    let Collected { figures, outputs, sizes } = collect(asked, &sized, &bar)?;
    bar.finish_and_clear();
    let Some(first) = asked.machines.first() else {
        return Err("no instruction set is asked for".to_owned());
    };
    let toolchain = toolchain(first.target)?;
    print(&figures, &toolchain);
    print_outputs(&outputs);
    print_sizes(&sizes);
    write_csv(&target_folder().join("measure.csv"), &figures, &toolchain)?;
    if !sizes.is_empty() {
        size::write_csv(&target_folder().join("size.csv"), &sizes, &toolchain)?;
    }
    if asked.documents == Documents::Check {
        size::check_stack(&sizes)?;
        outputs::check(&outputs)?;
    }
    let mut blocks = blocks(&figures, &sizes, &toolchain);
    blocks.push(outputs::block(&outputs, &toolchain));
    tables("measure", asked.documents, &DOCUMENTS, &blocks)
}

/// What was measured.
struct Collected {
    figures: Vec<Figure>,
    outputs: Vec<Cost>,
    sizes: Vec<Size>,
}

/// Builds and runs everything.
fn collect(asked: &Asked, sized: &[&Machine], bar: &ProgressBar) -> Result<Collected, String> {
    bar.set_message("host: references");
    let references = references(&Workload::ALL);
    bar.inc(1);
    let (mut figures, mut outputs, mut sizes) = (Vec::new(), Vec::new(), Vec::new());
    for machine in &asked.machines {
        bar.set_message(format!("{}: every workload", machine.isa));
        for count in firmware::count(machine)? {
            let same = |r: &&_| {
                let reference: &host_tests::measure::error::Reference = r;
                (reference.workload, reference.tier) == (count.workload, count.tier)
            };
            let reference = references.iter().find(same).ok_or("a count without a reference")?;
            let figure = Figure::new(&count, reference)?;
            if asked.workloads.contains(&count.workload) {
                figures.push(figure);
            }
        }
        bar.inc(1);
    }
    for machine in sized {
        bar.set_message(format!("{}: whole and in bands", machine.isa));
        outputs.extend(outputs::count(machine, &references)?);
        bar.inc(1);
        bar.set_message(format!("{}: flash, RAM and stack", machine.isa));
        sizes.extend(size::measure(machine, || bar.inc(1))?);
    }
    Ok(Collected { figures, outputs, sizes })
}

/// Prints the figures.
fn print(figures: &[Figure], toolchain: &str) {
    println!("{toolchain}, opt-level 3, LTO; instructions executed, largest and mean error\n");
    println!(
        "{:8} {:9} {:7} {:>12} {:>10}     {:9} {:>7} {:>11} {:>11}",
        "isa", "workload", "tier", "instructions", "each", "", "pixels", "largest", "mean"
    );
    for figure in figures {
        println!(
            "{:8} {:9} {:7} {:12} {:>10} per {:9} {:7} {:11.6} {:11.6} {}",
            figure.isa,
            figure.workload.name(),
            figure.tier,
            figure.instructions,
            figure.cost(),
            unit_name(figure.workload.unit()),
            figure.pixels,
            figure.deviation.max,
            figure.deviation.mean,
            figure.deviation.unit
        );
    }
}

/// Prints what ways to a display take.
fn print_outputs(outputs: &[Cost]) {
    if !outputs.is_empty() {
        println!(
            "\n{:8} {:10} {:9} {:7} {:>8} {:>12}",
            "isa", "output", "workload", "tier", "RAM", "instructions"
        );
    }
    for Cost { isa, name, workload, tier, ram, instructions } in outputs {
        let workload = workload.name();
        println!("{isa:8} {name:10} {workload:9} {tier:7} {ram:8} {instructions:12}");
    }
}

/// Prints what firmwares take.
fn print_sizes(sizes: &[Size]) {
    if !sizes.is_empty() {
        println!(
            "\n{:8} {:9} {:7} {:>8} {:>8} {:>8}",
            "isa", "firmware", "tier", "flash", "RAM", "stack"
        );
    }
    for Size { isa, workload, tier, flash, ram, stack } in sizes {
        println!("{isa:8} {workload:9} {tier:7} {flash:8} {ram:8} {stack:8}");
    }
}
