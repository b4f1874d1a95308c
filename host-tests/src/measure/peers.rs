//! What other crates' flat triangles cost, beside hither's: the same triangles, machines and clock.

use super::firmware::{fault, instructions, lines, words};
use super::readme::{Block, heading, made_by, row};
use super::{Figure, cost, unit_name};
use crate::cross::{Machine, build, emulate, root};
use hither_scenes::workloads::Workload;

/// The crates, by the names that the firmware prints.
pub const PEERS: [&str; 2] = ["embedded-graphics", "embedded-3dgfx"];

/// What they draw.
pub const WORKLOADS: [Workload; 3] = [Workload::W1, Workload::W2, Workload::W3];

/// The tiers of hither that they are laid beside.
const BESIDE: [&str; 2] = ["exact", "quick8"];

/// What a machine counted of one workload by one crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PeerCount {
    /// The machine's instruction set.
    pub isa: &'static str,
    /// The crate.
    pub peer: &'static str,
    /// What was drawn.
    pub workload: Workload,
    /// Executed.
    pub instructions: u64,
    /// Drawn, triangle by triangle.
    pub pixels: usize,
}

/// Builds the peers' firmware for a machine and runs it: every workload by every crate.
///
/// # Errors
///
/// What the compiler or the emulator says, or what is wrong with the firmware's words.
pub fn count(machine: &Machine) -> Result<Vec<PeerCount>, String> {
    let program = build("peers", "peers", machine.target, &[])?;
    parse(machine, &emulate(machine, &program)?)
}

/// The counts that the firmware printed.
fn parse(machine: &Machine, printed: &str) -> Result<Vec<PeerCount>, String> {
    let mut counts = Vec::new();
    for line in lines(machine, printed)? {
        let count = || {
            let [peer, workload, ticks, pixels] = words(line)?;
            let peer = PEERS.into_iter().find(|name| *name == peer)?;
            let workload = WORKLOADS.into_iter().find(|w| w.name() == workload)?;
            let instructions = instructions(machine, ticks.parse().ok()?);
            let pixels = pixels.parse().ok()?;
            Some(PeerCount { isa: machine.isa, peer, workload, instructions, pixels })
        };
        counts.push(count().ok_or_else(|| fault(machine, line))?);
    }
    let expected = PEERS.len() * WORKLOADS.len();
    if counts.len() == expected {
        Ok(counts)
    } else {
        Err(format!("{}: {} of {expected} workloads were drawn", machine.isa, counts.len()))
    }
}

/// The crates with the versions that the firmware is built with.
///
/// # Errors
///
/// What the file system says, or that a crate is not locked.
pub fn titles() -> Result<[String; 2], String> {
    let path = root().join("boards/peers/Cargo.lock");
    let context = |what: &dyn std::fmt::Display| format!("{}: {what}", path.display());
    let lock = std::fs::read_to_string(&path).map_err(|error| context(&error))?;
    let title = |peer| -> Result<String, String> {
        let version = locked(&lock, peer).ok_or_else(|| context(&format!("no {peer}")))?;
        Ok(format!("{peer} {version}"))
    };
    let [first, second] = PEERS.map(title);
    Ok([first?, second?])
}

/// The version that a lock file has of a package.
fn locked(lock: &str, package: &str) -> Option<String> {
    let (_, after) = lock.split_once(&format!("name = \"{package}\"\nversion = \""))?;
    after.split_once('"').map(|(version, _)| version.to_owned())
}

/// The table of these counts beside hither's figures of the same workloads: a row an instruction set, workload and
/// crate, with [`titles`] in the order of [`PEERS`].
///
/// # Errors
///
/// Where there is no figure of hither's for a count.
pub fn table(
    counts: &[PeerCount],
    figures: &[Figure],
    titles: &[String; 2],
    toolchain: &str,
) -> Result<Block, String> {
    let mut text = String::new();
    let columns = ["isa", "", "crate", "pixels", "per", "instructions"].map(str::to_owned);
    let beside = BESIDE.iter().flat_map(|t| [format!("hither {t}"), "times fewer".to_owned()]);
    heading(&mut text, columns.into_iter().chain(beside).collect());
    for count in counts {
        let PeerCount { isa, peer, workload, instructions, pixels } = *count;
        let of = |tier: &str| {
            let found =
                figures.iter().find(|f| (f.isa, f.workload, f.tier) == (isa, workload, tier));
            found.ok_or(format!("{isa}: nothing of hither's {} in {tier}", workload.name()))
        };
        let [first, second] = BESIDE.map(of);
        let (first, second) = (first?, second?);
        let per_unit = instructions as f64 / first.units() as f64;
        let unit = workload.unit();
        let title = PEERS.iter().zip(titles).find(|(name, _)| **name == peer).map(|(_, t)| t);
        let title = title.cloned().unwrap_or_default();
        let cells = [isa.to_owned(), workload.name().to_owned(), title, pixels.to_string()];
        let cells = cells.into_iter().chain([unit_name(unit).to_owned(), cost(unit, per_unit)]);
        let beside = [first, second].map(|figure| [figure.cost(), times_fewer(count, figure)]);
        row(&mut text, cells.chain(beside.into_iter().flatten()));
    }
    Ok(Block { name: "peers", text: text + &made_by(toolchain) })
}

/// How many times fewer instructions hither's figure has than a count of the same workload; below 1 it has more.
fn times_fewer(count: &PeerCount, figure: &Figure) -> String {
    format!("{:.2}", count.instructions as f64 / figure.instructions as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cross::MACHINES;
    use crate::measure::error::Deviation;

    fn printed() -> String {
        let mut lines = "spin 1000 6405\nspin 101000 646405\n".to_owned();
        for workload in WORKLOADS {
            for peer in PEERS {
                lines += &format!("{peer} {} 3200000 23176\n", workload.name());
            }
        }
        lines
    }

    fn figure(tier: &'static str, instructions: u64) -> Figure {
        let deviation = Deviation { max: 0.0, mean: 0.0, unit: "wrong pixels" };
        let (isa, workload) = ("m4f", Workload::W1);
        Figure { isa, workload, tier, instructions, pixels: 20_000, deviation }
    }

    #[test]
    fn ticks_become_instructions() {
        let counts = parse(&MACHINES[2], &printed()).unwrap();
        assert_eq!(counts.len(), 6);
        let PeerCount { peer, workload, instructions, pixels, .. } = counts[3];
        assert_eq!((peer, workload), ("embedded-3dgfx", Workload::W2));
        assert_eq!((instructions, pixels), (1_000_000, 23_176));
    }

    #[test]
    fn what_is_missing_or_garbled_is_an_error() {
        let text = printed();
        let cut = text.rsplit_once("embedded-3dgfx").unwrap().0;
        assert!(parse(&MACHINES[2], cut).unwrap_err().contains("5 of 6"));
        let error = parse(&MACHINES[2], &text.replace("W3", "W3z")).unwrap_err();
        assert!(error.contains("W3z"), "{error}");
        let error = parse(&MACHINES[2], &text.replace("646405", "646600")).unwrap_err();
        assert!(error.contains("200061"), "{error}");
    }

    #[test]
    fn a_row_divides_by_hithers_units_and_instructions() {
        let counts = [parse(&MACHINES[2], &printed()).unwrap()[0]];
        let figures = [figure("exact", 80_000), figure("quick4", 1), figure("quick8", 30_000)];
        let titles = PEERS.map(|peer| format!("{peer} 1.2"));
        let block = table(&counts, &figures, &titles, "rustc 1").unwrap();
        let row = "| m4f | W1 | embedded-graphics 1.2 | 23176 | pixel | 50.00 | 4.00 | 12.50 | 1.50 | 33.33 |\n";
        assert!(block.text.contains(row), "{}", block.text);
        let error = table(&counts, &figures[..2], &titles, "").unwrap_err();
        assert!(error.contains("quick8"), "{error}");
    }

    #[test]
    fn versions_are_those_of_the_lock_file() {
        let lock = "[[package]]\nname = \"a-core\"\nversion = \"1.0.0\"\n\n\
                    [[package]]\nname = \"a\"\nversion = \"2.0.1\"\n";
        assert_eq!(locked(lock, "a").as_deref(), Some("2.0.1"));
        assert_eq!(locked(lock, "b"), None);
        titles().unwrap();
    }
}
