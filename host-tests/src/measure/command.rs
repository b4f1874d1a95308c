//! What the measuring commands share: lists of names, a bar, and what becomes of the tables in the documents.

use super::readme::{Block, compare, rewritten};
use crate::cross::root;
use indicatif::{ProgressBar, ProgressStyle};

/// What becomes of the tables in the documents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Documents {
    /// Nothing.
    Leave,
    /// They are compared with what was measured.
    Check,
    /// They are written anew.
    Write,
}

/// Those of `all` whose names are in a list.
///
/// # Errors
///
/// A name that none has.
pub fn chosen<T>(
    list: &str,
    all: impl Iterator<Item = T> + Clone,
    name: impl Fn(&T) -> &'static str,
) -> Result<Vec<T>, String> {
    let names: Vec<&str> = list.split(',').collect();
    let known: Vec<&str> = all.clone().map(|item| name(&item)).collect();
    match names.iter().find(|asked| !known.contains(asked)) {
        Some(unknown) => Err(format!("{unknown} is not one of {}", known.join(", "))),
        None => Ok(all.filter(|item| names.contains(&name(item))).collect()),
    }
}

/// A bar on a terminal, nothing elsewhere.
#[must_use]
pub fn progress(steps: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {elapsed} {msg}");
    let bar = ProgressBar::new(steps);
    style.map_or(bar.clone(), |style| bar.with_style(style))
}

/// Checks or writes a command's tables in the documents of these names.
///
/// # Errors
///
/// What differs, or what the file system says, with the document's name.
pub fn tables(
    command: &str,
    documents: Documents,
    names: &[&str],
    blocks: &[Block],
) -> Result<(), String> {
    if documents == Documents::Leave {
        return Ok(());
    }
    let mut compared = 0;
    for name in names {
        let path = root().join(name);
        let context = |error: &dyn std::fmt::Display| format!("{name}: {error}");
        let text = std::fs::read_to_string(&path).map_err(|error| context(&error))?;
        if documents == Documents::Write {
            let text = rewritten(&text, blocks).map_err(|error| context(&error))?;
            std::fs::write(&path, text).map_err(|error| context(&error))?;
        } else {
            compared += compare(&text, blocks).map_err(|error| {
                context(&format!("{error}\n(`{command} -- --write` writes the tables anew)"))
            })?;
        }
    }
    if documents == Documents::Check && compared < blocks.len() {
        return Err(format!("{compared} tables of figures in {}", names.join(" and ")));
    }
    Ok(())
}
