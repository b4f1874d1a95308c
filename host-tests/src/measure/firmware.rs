//! Running the measuring firmware on an emulated machine.

use super::TIERS;
use crate::cross::{Machine, build, emulate};
use hither_scenes::workloads::Workload;

/// What a machine counted of one workload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Count {
    /// The machine's instruction set.
    pub isa: &'static str,
    /// What was drawn.
    pub workload: Workload,
    /// The tier's name.
    pub tier: &'static str,
    /// Executed.
    pub instructions: u64,
    /// Checksum of what was drawn.
    pub sum: u32,
}

/// Builds the firmware for a machine and runs it: every workload in every tier.
///
/// # Errors
///
/// What the compiler or the emulator says, or what is wrong with the firmware's words.
pub fn count(machine: &Machine) -> Result<Vec<Count>, String> {
    let program = build("emulator", "measure", machine.target, &[])?;
    parse(machine, &emulate(machine, &program)?)
}

/// The counts that a firmware printed.
fn parse(machine: &Machine, printed: &str) -> Result<Vec<Count>, String> {
    let mut counts = Vec::new();
    for line in lines(machine, printed)? {
        let count = || {
            let [workload, tier, ticks, sum] = words(line)?;
            let workload = Workload::ALL.into_iter().find(|w| w.name() == workload)?;
            let tier = TIERS.into_iter().find(|name| *name == tier)?;
            let instructions = instructions(machine, ticks.parse().ok()?);
            let sum = u32::from_str_radix(sum, 16).ok()?;
            Some(Count { isa: machine.isa, workload, tier, instructions, sum })
        };
        counts.push(count().ok_or_else(|| fault(machine, line))?);
    }
    let expected = Workload::ALL.len() * TIERS.len();
    if counts.len() == expected {
        Ok(counts)
    } else {
        Err(format!("{}: {} of {expected} workloads were drawn", machine.isa, counts.len()))
    }
}

/// The lines that a firmware printed, without its two spins, which say whether its clock counts instructions.
pub(crate) fn lines<'a>(machine: &Machine, printed: &'a str) -> Result<Vec<&'a str>, String> {
    let (mut spins, mut rest) = (Vec::new(), Vec::new());
    for line in printed.lines() {
        match words(line) {
            Some(["spin", _, ticks]) => {
                spins.push(ticks.parse().map_err(|_| fault(machine, line))?);
            }
            _ => rest.push(line),
        }
    }
    check_clock(machine, &spins)?;
    Ok(rest)
}

/// A line that has this many words.
pub(crate) fn words<const N: usize>(line: &str) -> Option<[&str; N]> {
    line.split_whitespace().collect::<Vec<_>>().try_into().ok()
}

/// What is said of a line that is not as it should be.
pub(crate) fn fault(machine: &Machine, line: &str) -> String {
    format!("{}: the firmware printed {line:?}", machine.isa)
}

/// The nearest number of instructions to a number of ticks.
pub(crate) fn instructions(machine: &Machine, ticks: u64) -> u64 {
    let (numerator, denominator) = machine.instructions_per_tick;
    (2 * ticks * numerator + denominator) / (2 * denominator)
}

/// Whether the clock counts instructions: the two spins differ by 200,000.
fn check_clock(machine: &Machine, spins: &[u64]) -> Result<(), String> {
    let [short, long] = spins[..] else {
        return Err(format!("{}: {} spins, not 2", machine.isa, spins.len()));
    };
    let counted = instructions(machine, long.saturating_sub(short));
    if counted == 200_000 {
        Ok(())
    } else {
        Err(format!("{}: the clock counts {counted} instructions where 200000 ran", machine.isa))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cross::MACHINES;

    fn printed(spin: u32) -> String {
        let mut lines = format!("spin 1000 6405\nspin 101000 {spin}\n");
        for tier in TIERS {
            for workload in Workload::ALL {
                lines += &format!("{} {tier} 32 0000abcd\n", workload.name());
            }
        }
        lines
    }

    #[test]
    fn ticks_become_instructions() {
        let machine = &MACHINES[2];
        let counts = parse(machine, &printed(646_405)).unwrap();
        assert_eq!(counts.len(), 33);
        assert_eq!((counts[0].instructions, counts[0].sum), (10, 0xabcd));
    }

    #[test]
    fn a_clock_that_does_not_count_instructions_is_an_error() {
        let error = parse(&MACHINES[2], &printed(646_600)).unwrap_err();
        assert!(error.contains("200061"), "{error}");
    }

    #[test]
    fn what_is_missing_or_garbled_is_an_error() {
        let text = printed(646_405);
        let cut = text.rsplit_once("snap").unwrap().0;
        assert!(parse(&MACHINES[2], cut).unwrap_err().contains("32 of 33"));
        assert!(parse(&MACHINES[2], &text.replace("W5", "W7")).unwrap_err().contains("W7"));
        assert!(parse(&MACHINES[2], "panicked").is_err());
    }
}
