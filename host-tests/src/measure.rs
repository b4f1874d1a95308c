//! What hither costs and how far off it is: counted on emulated machines, compared with references on the host.

pub mod command;
pub mod error;
pub mod firmware;
pub mod outputs;
pub mod peers;
pub mod readme;
pub mod size;
pub mod torus;

use error::{Deviation, Reference};
use firmware::Count;
use hither_scenes::workloads::{Unit, Workload};
use std::path::Path;

/// The tiers' names, in the order of the tables.
pub const TIERS: [&str; 3] = ["exact", "quick4", "quick8"];

/// One row of the table: a workload in a tier on an instruction set.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The instruction set: see [`MACHINES`](crate::cross::MACHINES).
    pub isa: &'static str,
    /// What was drawn.
    pub workload: Workload,
    /// The tier's name.
    pub tier: &'static str,
    /// Executed, for all of it.
    pub instructions: u64,
    /// Covered, before depth.
    pub pixels: usize,
    /// How far off what was drawn is.
    pub deviation: Deviation,
}

impl Figure {
    /// A count with what the host knows of the same workload.
    ///
    /// # Errors
    ///
    /// Where the machine drew something else than the host.
    pub fn new(count: &Count, reference: &Reference) -> Result<Self, String> {
        let Count { isa, workload, tier, instructions, sum } = *count;
        if sum != reference.sum {
            let name = workload.name();
            let expected = reference.sum;
            return Err(format!(
                "{isa} drew {name} in {tier} as {sum:08x}, the host as {expected:08x}"
            ));
        }
        let Reference { pixels, deviation, .. } = *reference;
        Ok(Self { isa, workload, tier, instructions, pixels, deviation })
    }

    /// How many units the workload has.
    #[must_use]
    pub fn units(&self) -> usize {
        match self.workload.unit() {
            Unit::Pixel => self.pixels,
            Unit::Triangle => self.workload.triangles(),
            Unit::Frame => 1,
            Unit::Vertex => hither_scenes::workloads::SNAPPED,
        }
    }

    /// Instructions a unit of the workload.
    #[must_use]
    pub fn per_unit(&self) -> f64 {
        self.instructions as f64 / self.units() as f64
    }

    /// [`per_unit`](Self::per_unit) as tables show it.
    #[must_use]
    pub fn cost(&self) -> String {
        cost(self.workload.unit(), self.per_unit())
    }
}

/// Instructions a unit as tables show them: two decimals a pixel, none a triangle or vertex, millions a frame.
fn cost(unit: Unit, per_unit: f64) -> String {
    match unit {
        Unit::Pixel => format!("{per_unit:.2}"),
        Unit::Triangle | Unit::Vertex => format!("{per_unit:.0}"),
        Unit::Frame => format!("{:.3} M", per_unit / 1e6),
    }
}

/// What a workload's cost is divided by, as tables say it.
#[must_use]
pub const fn unit_name(unit: Unit) -> &'static str {
    match unit {
        Unit::Pixel => "pixel",
        Unit::Triangle => "triangle",
        Unit::Frame => "frame",
        Unit::Vertex => "vertex",
    }
}

/// Writes the figures as CSV.
///
/// # Errors
///
/// What the file system says, with the path.
pub fn write_csv(path: &Path, figures: &[Figure], toolchain: &str) -> Result<(), String> {
    let heading = [
        "isa",
        "workload",
        "tier",
        "instructions",
        "pixels",
        "triangles",
        "per_unit",
        "error_max",
        "error_mean",
        "error_unit",
        "toolchain",
    ];
    let rows = figures.iter().map(|figure| {
        vec![
            figure.isa.to_owned(),
            figure.workload.name().to_owned(),
            figure.tier.to_owned(),
            figure.instructions.to_string(),
            figure.pixels.to_string(),
            figure.workload.triangles().to_string(),
            format!("{:.4}", figure.per_unit()),
            format!("{:.6}", figure.deviation.max),
            format!("{:.6}", figure.deviation.mean),
            figure.deviation.unit.to_owned(),
            toolchain.to_owned(),
        ]
    });
    write_rows(path, &heading, rows)
}

/// Writes a heading and rows as CSV.
pub(crate) fn write_rows(
    path: &Path,
    heading: &[&str],
    rows: impl Iterator<Item = Vec<String>>,
) -> Result<(), String> {
    let write = || -> Result<(), csv::Error> {
        let mut writer = csv::Writer::from_path(path)?;
        writer.write_record(heading)?;
        for row in rows {
            writer.write_record(row)?;
        }
        Ok(writer.flush()?)
    };
    write().map_err(|error| format!("{}: {error}", path.display()))
}
