//! What it costs to get a picture to a display: whole or in bands, and through another crate's draw targets.

use super::error::Reference;
use super::firmware::{fault, instructions, lines, words};
use super::readme::{Block, heading, made_by, row};
use super::size::ISAS;
use super::{TIERS, cost};
use crate::cross::{Machine, build, emulate};
use hither::{Exact, Quick, Vertex};
use hither_scenes::workloads::{
    Buffers, Output, PIXELS, Preset, TRIANGLES, Unit, Workload, smooth_flat, torus_lines,
};

/// What a machine counted of one way to a display.
#[derive(Clone, Debug, PartialEq)]
pub struct Cost {
    /// The machine's instruction set.
    pub isa: &'static str,
    /// The way's name.
    pub name: String,
    /// What was drawn.
    pub workload: Workload,
    /// The tier's name.
    pub tier: &'static str,
    /// Bytes of colours, depths, vertices and bins.
    pub ram: u64,
    /// Executed.
    pub instructions: u64,
}

/// What bands from bins may take of a whole frame's instructions, in bands of a third of the picture.
const MOST: f64 = 1.15;

/// The bands that [`MOST`] is of, and the whole frame.
const THIRDS: [&str; 2] = ["bins-80", "frame"];

/// Builds the firmware for a machine and runs it: every way in every tier.
///
/// # Errors
///
/// What the compiler or the emulator says; or a picture that is not the host's.
pub fn count(machine: &Machine, references: &[Reference]) -> Result<Vec<Cost>, String> {
    let program = build("emulator", "outputs", machine.target, &[])?;
    let printed = emulate(machine, &program)?;
    let mut costs = Vec::new();
    for line in lines(machine, &printed)? {
        let (cost, sum) = parse(machine, line).ok_or_else(|| fault(machine, line))?;
        let expected = expected(&cost, references)?;
        if sum != expected {
            let Cost { isa, name, tier, .. } = &cost;
            let drawn = cost.workload.name();
            return Err(format!(
                "{isa} drew {drawn} by {name} in {tier} as {sum:08x}, the host as {expected:08x}"
            ));
        }
        costs.push(cost);
    }
    let expected = (2 * Output::ALL.len() + 2 * FLAT.len() + 1) * TIERS.len();
    if costs.len() == expected {
        Ok(costs)
    } else {
        Err(format!("{}: {} of {expected} outputs were drawn", machine.isa, costs.len()))
    }
}

/// What is also drawn through a draw target, and with smooth edges.
const FLAT: [Workload; 2] = [Workload::W1, Workload::W2];

/// The checksum of what the host draws: the workload's own, but for smooth edges and lines.
fn expected(cost: &Cost, references: &[Reference]) -> Result<u32, String> {
    match (cost.name.as_str(), cost.tier) {
        ("smooth" | "lines", "exact") => other::<Exact>(cost),
        ("smooth" | "lines", "quick4") => other::<Quick<4>>(cost),
        ("smooth" | "lines", _) => other::<Quick<8>>(cost),
        _ => {
            let same = |r: &&Reference| (r.workload, r.tier) == (cost.workload, cost.tier);
            let reference = references.iter().find(same).ok_or("a count without a reference")?;
            Ok(reference.sum)
        }
    }
}

/// The checksum of smooth edges or lines.
fn other<T: Preset>(cost: &Cost) -> Result<u32, String> {
    let words = || -> Box<[u16; PIXELS]> {
        vec![0; PIXELS].into_boxed_slice().try_into().expect("as many words as pixels")
    };
    let (mut color, mut depth) = (words(), words());
    let mut triangles = vec![[Vertex::<T>::EMPTY; 3]; TRIANGLES];
    let drawn = if cost.name == "lines" {
        let mut buffers = Buffers { color: &mut color, depth: &mut depth };
        torus_lines(&mut buffers, triangles.as_flattened_mut(), || 0)
    } else {
        smooth_flat(cost.workload, &mut color, &mut triangles, || 0)
    };
    drawn.map(|(_, sum)| sum).map_err(|error| error.to_string())
}

/// The cost and the checksum that a line says.
fn parse(machine: &Machine, line: &str) -> Option<(Cost, u32)> {
    let [name, workload, tier, ram, ticks, sum] = words(line)?;
    let cost = Cost {
        isa: machine.isa,
        name: name.to_owned(),
        workload: Workload::ALL.into_iter().find(|w| w.name() == workload)?,
        tier: TIERS.into_iter().find(|name| *name == tier)?,
        ram: ram.parse().ok()?,
        instructions: instructions(machine, ticks.parse().ok()?),
    };
    Some((cost, u32::from_str_radix(sum, 16).ok()?))
}

/// Whether bands from bins are within `MOST` of the whole frame, in the tier that frames begin with.
///
/// # Errors
///
/// Where they are not, with both numbers.
pub fn check(costs: &[Cost]) -> Result<(), String> {
    for isa in ISAS {
        for workload in [Workload::W6f, Workload::W6g] {
            let of = |name: &str| {
                let key = (isa, name, workload, "quick8");
                costs.iter().find(|c| (c.isa, c.name.as_str(), c.workload, c.tier) == key)
            };
            let [Some(bands), Some(frame)] = THIRDS.map(of) else {
                return Err(format!("{isa}: {} by {THIRDS:?} was not drawn", workload.name()));
            };
            let ratio = bands.instructions as f64 / frame.instructions as f64;
            if ratio > MOST {
                let (name, workload) = (&bands.name, workload.name());
                return Err(format!(
                    "{isa}: {workload} by {name} takes {ratio:.3} of the frame's instructions: at most {MOST}"
                ));
            }
        }
    }
    Ok(())
}

/// The table: a row a way, its RAM in the last tier, and a column an instruction set and tier.
#[must_use]
pub fn block(costs: &[Cost], toolchain: &str) -> Block {
    let columns: Vec<(&str, &str)> =
        ISAS.iter().flat_map(|isa| TIERS.map(|tier| (*isa, tier))).collect();
    let mut text = String::new();
    let names = columns.iter().map(|(isa, tier)| format!("{isa} {tier}"));
    heading(&mut text, ["", "by", "RAM"].map(str::to_owned).into_iter().chain(names).collect());
    let mut rows: Vec<(Workload, &str)> = Vec::new();
    for cost in costs {
        if !rows.contains(&(cost.workload, &cost.name)) {
            rows.push((cost.workload, &cost.name));
        }
    }
    for (workload, name) in rows {
        let of = |(isa, tier): (&str, &str)| {
            let key = (isa, tier, workload, name);
            costs.iter().find(|c| (c.isa, c.tier, c.workload, c.name.as_str()) == key)
        };
        let ram = columns.last().and_then(|column| of(*column)).map_or(0, |cost| cost.ram);
        let start = [workload.name().to_owned(), name.to_owned(), ram.to_string()];
        let cells = columns.iter().map(|column| {
            let found = of(*column).map(|found| cost(Unit::Frame, found.instructions as f64));
            found.unwrap_or("-".to_owned())
        });
        row(&mut text, start.into_iter().chain(cells));
    }
    Block { name: "outputs", text: text + &made_by(toolchain) }
}
