//! The tables of figures in the README and the docs: made from what was measured, and checked against it.
//!
//! A table stands between the lines `<!-- figures:NAME -->` and `<!-- /figures -->`.

use super::size::{FIRMWARES, ISAS, Size};
use super::{Figure, TIERS, unit_name};
use hither_scenes::workloads::Workload;
use std::fmt::Write;

/// The tables there are: `peers` by the command of that name, `presets` by `trade`, the others by `measure`.
const NAMES: [&str; 7] = ["cost", "cost-all", "error", "outputs", "size", "peers", "presets"];

/// Names and texts of the tables.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// As its first line has it.
    pub name: &'static str,
    /// All lines between the marks.
    pub text: String,
}

/// By how much a figure may differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tolerance {
    /// In parts of it.
    share: f64,
    /// In its own unit, where that is more.
    units: f64,
}

impl Tolerance {
    /// Where the same toolchain made the table.
    pub(crate) const NONE: Self = Self { share: 0.0, units: 0.0 };

    /// The same for bytes of firmware that cannot panic: the order of its symbols, and so their padding, follows
    /// from the folder it is built in.
    const LAYOUT: Self = Self { share: 0.0, units: 64.0 };

    /// The same for bytes of any firmware: its messages have names of folders in them.
    pub(crate) const FOLDER: Self = Self { share: 0.0, units: 1024.0 };

    /// Where another one did.
    pub(crate) const OTHER_TOOLCHAIN: Self = Self { share: 0.03, units: 0.0 };

    /// The same for bytes: compilers differ by some hundred in firmware of any size.
    const OTHER_BYTES: Self = Self { share: 0.03, units: 1024.0 };
}

/// The tables of these figures.
#[must_use]
pub fn blocks(figures: &[Figure], sizes: &[Size], toolchain: &str) -> Vec<Block> {
    let made_by = made_by(toolchain);
    let few: Vec<_> = ISAS.to_vec();
    let mut all = Vec::new();
    for figure in figures {
        if !all.contains(&figure.isa) {
            all.push(figure.isa);
        }
    }
    vec![
        Block { name: "cost", text: costs(figures, &few) + &made_by },
        Block { name: "cost-all", text: costs(figures, &all) + &made_by },
        Block { name: "error", text: errors(figures) },
        Block { name: "size", text: size_table(sizes) + &made_by },
    ]
}

/// The line under a table.
pub(crate) fn made_by(toolchain: &str) -> String {
    format!("\nMade by `{toolchain}`, opt-level 3, LTO.\n")
}

/// A row of a table.
pub(crate) fn row(text: &mut String, cells: impl IntoIterator<Item = String>) {
    let cells: Vec<String> = cells.into_iter().collect();
    let _ = writeln!(text, "| {} |", cells.join(" | "));
}

/// The heading of a table, with a rule under it.
pub(crate) fn heading(text: &mut String, cells: Vec<String>) {
    let rule = vec!["---".to_owned(); cells.len()];
    row(text, cells);
    row(text, rule);
}

/// Instructions a unit: a row a workload, a column an instruction set and tier.
fn costs(figures: &[Figure], isas: &[&str]) -> String {
    let columns: Vec<(&str, &str)> =
        isas.iter().flat_map(|isa| TIERS.map(|tier| (*isa, tier))).collect();
    let mut text = String::new();
    let names = columns.iter().map(|(isa, tier)| format!("{isa} {tier}"));
    heading(&mut text, ["".to_owned(), "per".to_owned()].into_iter().chain(names).collect());
    for workload in Workload::ALL {
        let cost = |&(isa, tier): &(&str, &str)| {
            let found =
                figures.iter().find(|f| (f.isa, f.workload, f.tier) == (isa, workload, tier));
            found.map_or("-".to_owned(), Figure::cost)
        };
        let start = [workload.name().to_owned(), unit_name(workload.unit()).to_owned()];
        row(&mut text, start.into_iter().chain(columns.iter().map(cost)));
    }
    text
}

/// How far off each tier is: a row a workload.
fn errors(figures: &[Figure]) -> String {
    let mut text = String::new();
    let names = TIERS.iter().flat_map(|tier| [format!("{tier} largest"), format!("{tier} mean")]);
    heading(&mut text, ["".to_owned(), "in".to_owned()].into_iter().chain(names).collect());
    for workload in Workload::ALL {
        let of = |tier: &str| figures.iter().find(|f| f.workload == workload && f.tier == tier);
        let unit = of(TIERS[0]).map_or("", |figure| figure.deviation.unit);
        let numbers = TIERS.iter().flat_map(|tier| {
            let numbers = of(tier).map(|f| [f.deviation.max, f.deviation.mean]);
            numbers.map_or(["-".to_owned(), "-".to_owned()], |n| n.map(significant))
        });
        row(&mut text, [workload.name().to_owned(), unit.to_owned()].into_iter().chain(numbers));
    }
    text
}

/// Three significant digits below 100.
fn significant(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = 2 - value.abs().log10().floor() as i32;
    format!("{value:.*}", digits.clamp(0, 8) as usize)
}

/// Bytes: a row a firmware and tier.
fn size_table(sizes: &[Size]) -> String {
    let mut text = String::new();
    let names = ISAS.iter().flat_map(|isa| ["flash", "RAM", "stack"].map(|n| format!("{isa} {n}")));
    heading(&mut text, ["".to_owned(), "tier".to_owned()].into_iter().chain(names).collect());
    for firmware in FIRMWARES {
        for tier in TIERS {
            let numbers = ISAS.iter().flat_map(|isa| {
                let key = (*isa, firmware.name, tier);
                let found = sizes.iter().find(|s| (s.isa, s.workload, s.tier) == key);
                let numbers = found.map(|s| [s.flash, s.ram, s.stack].map(|n| n.to_string()));
                numbers.unwrap_or(["-", "-", "-"].map(str::to_owned))
            });
            let start = [firmware.name.to_owned(), tier.to_owned()];
            row(&mut text, start.into_iter().chain(numbers));
        }
    }
    text
}

/// A document with these of its tables made anew.
///
/// # Errors
///
/// A mark that names no table or has no end.
pub fn rewritten(document: &str, blocks: &[Block]) -> Result<String, String> {
    let (mut text, mut rest) = (String::new(), document);
    while let Some((before, name, written, after)) = next_block(rest)? {
        let new = find(blocks, name)?.map_or(written, |block| &block.text);
        text += before;
        text += &format!("<!-- figures:{name} -->\n{new}<!-- /figures -->");
        rest = after;
    }
    Ok(text + rest)
}

/// Whether these of a document's tables are what was measured: to the letter where the same toolchain made them (bytes to 64), else
/// each number to 3%, and bytes to 3% or 1 kB. Gives how many tables were compared.
///
/// # Errors
///
/// What differs, or a mark that names no table or has no end.
pub fn compare(document: &str, blocks: &[Block]) -> Result<usize, String> {
    let (mut rest, mut compared) = (document, 0);
    while let Some((_, name, written, after)) = next_block(rest)? {
        rest = after;
        let Some(block) = find(blocks, name)? else { continue };
        let tolerances = match name {
            "size" => [Tolerance::LAYOUT, Tolerance::OTHER_BYTES],
            _ => [Tolerance::NONE, Tolerance::OTHER_TOOLCHAIN],
        };
        let result = same(written, &block.text, tolerances);
        result.map_err(|why| format!("table {name}: {why}"))?;
        compared += 1;
    }
    Ok(compared)
}

/// The table of a name, if it is among these.
fn find<'a>(blocks: &'a [Block], name: &str) -> Result<Option<&'a Block>, String> {
    if NAMES.contains(&name) {
        Ok(blocks.iter().find(|block| block.name == name))
    } else {
        Err(format!("there is no table {name}"))
    }
}

/// What is before the next table, its name, its text, and what follows it.
type Cut<'a> = (&'a str, &'a str, &'a str, &'a str);

fn next_block(document: &str) -> Result<Option<Cut<'_>>, String> {
    let Some((before, rest)) = document.split_once("<!-- figures:") else {
        return Ok(None);
    };
    let cut = || {
        let (name, rest) = rest.split_once(" -->\n")?;
        let (text, after) = rest.split_once("<!-- /figures -->")?;
        Some((before, name, text, after))
    };
    cut().map(Some).ok_or("a table of figures has no end".to_owned())
}

/// Whether two tables say the same, with a tolerance for one toolchain and another for two.
fn same(written: &str, measured: &str, [one, two]: [Tolerance; 2]) -> Result<(), String> {
    let made_by = |text: &str| text.lines().find(|l| l.starts_with("Made by")).map(str::to_owned);
    let tolerance = if made_by(written) == made_by(measured) { one } else { two };
    let rows = |text: &str| -> Vec<String> {
        text.lines().filter(|line| line.starts_with('|')).map(str::to_owned).collect()
    };
    let (old, new) = (rows(written), rows(measured));
    if old.len() != new.len() {
        return Err(format!("{} rows, measured {}", old.len(), new.len()));
    }
    for (old_row, new_row) in old.iter().zip(&new) {
        let cells = |row: &str| row.split('|').map(|c| c.trim().to_owned()).collect::<Vec<_>>();
        let (old, new) = (cells(old_row), cells(new_row));
        let equal = old.len() == new.len()
            && old.iter().zip(&new).all(|(old, new)| close(old, new, tolerance));
        if !equal {
            return Err(format!("it says\n{old_row}\nmeasured is\n{new_row}"));
        }
    }
    Ok(())
}

/// Whether two cells are equal, or numbers within a tolerance of each other.
pub(crate) fn close(old: &str, new: &str, tolerance: Tolerance) -> bool {
    let number = |cell: &str| cell.trim_end_matches(" M").parse::<f64>().ok();
    match (number(old), number(new)) {
        (Some(a), Some(b)) if tolerance != Tolerance::NONE => {
            (a - b).abs() <= tolerance.units.max(tolerance.share * b.abs())
        }
        _ => old == new,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOCUMENT: &str = "a\n<!-- figures:cost -->\nold\n<!-- /figures -->\nb\n";

    fn block(number: &str, by: &str) -> Block {
        let text = format!("| | per |\n| --- | --- |\n| W1 | {number} |\n\nMade by `{by}`.\n");
        Block { name: "cost", text }
    }

    #[test]
    fn a_rewritten_document_compares_equal() {
        let blocks = [block("8.82", "rustc 1")];
        let text = rewritten(DOCUMENT, &blocks).unwrap();
        assert!(
            text.starts_with("a\n<!-- figures:cost -->\n| | per |\n") && text.ends_with("\nb\n")
        );
        assert_eq!(compare(&text, &blocks), Ok(1));
        assert_eq!(rewritten(&text, &blocks).unwrap(), text);
        assert!(compare(DOCUMENT, &blocks).is_err());
    }

    #[test]
    fn the_same_toolchain_has_no_tolerance_and_another_three_percent() {
        let text = rewritten(DOCUMENT, &[block("8.82", "rustc 1")]).unwrap();
        let error = compare(&text, &[block("8.83", "rustc 1")]).unwrap_err();
        assert!(error.contains("8.82") && error.contains("8.83"), "{error}");
        assert_eq!(compare(&text, &[block("9.08", "rustc 2")]), Ok(1));
        assert!(compare(&text, &[block("9.10", "rustc 2")]).is_err());
        assert!(compare(&text, &[block("8.82 M", "rustc 1")]).is_err());
    }

    #[test]
    fn bytes_have_a_kilobyte_with_another_toolchain() {
        let document = DOCUMENT.replace("cost", "size");
        let size = |bytes: &str, by: &str| Block { name: "size", ..block(bytes, by) };
        let text = rewritten(&document, &[size("2000", "rustc 1")]).unwrap();
        assert_eq!(compare(&text, &[size("3024", "rustc 2")]), Ok(1));
        assert!(compare(&text, &[size("3025", "rustc 2")]).is_err());
        assert_eq!(compare(&text, &[size("2064", "rustc 1")]), Ok(1));
        assert!(compare(&text, &[size("2065", "rustc 1")]).is_err());
    }

    #[test]
    fn a_table_without_a_name_or_an_end_is_an_error() {
        assert!(rewritten(&DOCUMENT.replace("cost", "coast"), &[block("1", "")]).is_err());
        assert!(compare("<!-- figures:cost -->\n", &[block("1", "")]).is_err());
        assert_eq!(compare("nothing", &[]), Ok(0));
    }

    #[test]
    fn a_table_of_another_command_is_left() {
        let document = DOCUMENT.replace("cost", "peers");
        assert_eq!(rewritten(&document, &[block("1", "")]).unwrap(), document);
        assert_eq!(compare(&document, &[block("1", "")]), Ok(0));
    }

    #[test]
    fn numbers_have_three_digits() {
        let texts = [0.0, 0.000_123_4, 0.501_2, 12.345, 123.4].map(significant);
        assert_eq!(texts, ["0", "0.000123", "0.501", "12.3", "123"]);
    }
}
