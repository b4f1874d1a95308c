//! The boards' figures in their table.

use super::cases::Passed;
use crate::measure::readme::{Tolerance, close};

/// A table with the figures of those that were measured: rows whose first cell starts with a board's name; and with the
/// toolchain that made them.
///
/// The last three cells of a row are flash, RAM and instructions a frame.
#[must_use]
pub fn updated(document: &str, measured: &[(String, Passed)], toolchain: &str) -> String {
    let line = |line: &str| {
        if line.starts_with(MADE_BY) {
            return format!("{MADE_BY}{toolchain}`.");
        }
        let found = measured.iter().find(|(name, _)| key(line).as_deref() == Some(name));
        found.map_or(line.to_owned(), |(_, passed)| with_figures(line, passed))
    };
    document.lines().map(line).map(|line| line + "\n").collect()
}

/// The line that says which toolchain made the figures.
const MADE_BY: &str = "Made by `";

/// Whether a table has the figures of those that were measured, to 3% where another toolchain made it, to 1,024 where the
/// same did, maybe in another folder; gives how many
/// rows were compared.
///
/// # Errors
///
/// The row that differs.
pub fn compare(
    document: &str,
    measured: &[(String, Passed)],
    toolchain: &str,
) -> Result<usize, String> {
    let tolerance =
        if document.contains(toolchain) { Tolerance::FOLDER } else { Tolerance::OTHER_TOOLCHAIN };
    let mut compared = 0;
    let updated = updated(document, measured, toolchain);
    for (written, measured) in document.lines().zip(updated.lines()) {
        let Some(_) = key(written) else { continue };
        let cells = |row: &str| row.split('|').map(|c| c.trim().to_owned()).collect::<Vec<_>>();
        let (old, new) = (cells(written), cells(measured));
        if !old.iter().zip(&new).all(|(old, new)| close(old, new, tolerance)) {
            return Err(format!("it says\n{written}\nmeasured is\n{measured}"));
        }
        compared += 1;
    }
    Ok(compared)
}

/// The name of a row: `board` or `board-program`.
fn key(row: &str) -> Option<String> {
    let first = row.strip_prefix("| [")?.split('|').next()?;
    let (board, rest) = first.split_once(']')?;
    let program = rest.split_once("), ").map(|(_, program)| program.trim());
    Some(program.map_or(board.to_owned(), |program| format!("{board}-{program}")))
}

/// A row with other figures.
fn with_figures(row: &str, passed: &Passed) -> String {
    let mut cells: Vec<String> = row.split('|').map(str::to_owned).collect();
    let figures = [passed.flash, passed.ram, passed.instructions];
    let count = cells.len();
    // Behind the last bar there is an empty cell.
    for (cell, figure) in cells.iter_mut().skip(count.saturating_sub(4)).zip(figures) {
        *cell = figure.map_or(" - ".to_owned(), |figure| format!(" {figure} "));
    }
    cells.join("|")
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "Made by `rustc 1`.\n\
        | board | flash | RAM | instructions |\n\
        | [pico](pico), bands | 1 | 2 | 3 |\n\
        | [other](other) | 1 | 2 | - |\n";

    fn measured(flash: u64) -> Vec<(String, Passed)> {
        let passed = Passed {
            flash: Some(flash),
            ram: Some(20),
            instructions: Some(300),
            ..Passed::default()
        };
        vec![("pico-bands".to_owned(), passed)]
    }

    #[test]
    fn rows_get_the_figures_of_their_program() {
        let updated = updated(TABLE, &measured(1000), "rustc 1");
        assert_eq!(updated, TABLE.replace("1 | 2 | 3", "1000 | 20 | 300"));
        assert_eq!(compare(&updated, &measured(2024), "rustc 1"), Ok(2));
        let error = compare(&updated, &measured(2025), "rustc 1").unwrap_err();
        assert!(error.contains("1000") && error.contains("2025"), "{error}");
        assert_eq!(compare(&updated, &measured(1025), "rustc 2"), Ok(2));
        assert!(compare(&updated, &measured(1100), "rustc 2").is_err());
    }
}
