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
    let fault = |line: &str| format!("{}: the firmware printed {line:?}", machine.isa);
    let (mut spins, mut counts) = (Vec::new(), Vec::new());
    for line in printed.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["spin", _, ticks] => {
                spins.push(ticks.parse::<u64>().map_err(|_| fault(line))?);
            }
            [workload, tier, ticks, sum] => {
                let find = || {
                    let workload = Workload::ALL.into_iter().find(|w| w.name() == workload)?;
                    let tier = TIERS.into_iter().find(|name| *name == tier)?;
                    let instructions = instructions(machine, ticks.parse().ok()?);
                    let sum = u32::from_str_radix(sum, 16).ok()?;
                    Some(Count { isa: machine.isa, workload, tier, instructions, sum })
                };
                counts.push(find().ok_or_else(|| fault(line))?);
            }
            _ => return Err(fault(line)),
        }
    }
    check_clock(machine, &spins)?;
    let expected = Workload::ALL.len() * TIERS.len();
    if counts.len() == expected {
        Ok(counts)
    } else {
        Err(format!("{}: {} of {expected} workloads were drawn", machine.isa, counts.len()))
    }
}

/// The nearest number of instructions to a number of ticks.
fn instructions(machine: &Machine, ticks: u64) -> u64 {
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
