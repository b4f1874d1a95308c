//! `src` is a pipeline: a module names only modules to its left.

use std::fs;
use std::path::{Path, PathBuf};

/// The modules of the library, first to last.
const ORDER: [&str; 28] = [
    "math",
    "color",
    "buffer",
    "pack",
    "vertex",
    "transform",
    "setup",
    "coverage",
    "clip",
    "span",
    "traversal",
    "interpolation",
    "depth",
    "texture",
    "framebuffer",
    "dirty",
    "fragment",
    "blend",
    "shape",
    "dither",
    "mesh",
    "fog",
    "preset",
    "plan",
    "draw",
    "bin",
    "band",
    "eg",
];

/// All `.rs` files under a folder.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("src is readable") {
        let path = entry.expect("src is readable").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// The module that a file below `src` belongs to.
fn module(path: &Path, src: &Path) -> String {
    let below = path.strip_prefix(src).expect("a file of src");
    let first = below.components().next().expect("a file has a name");
    first.as_os_str().to_string_lossy().trim_end_matches(".rs").to_owned()
}

/// The modules that code names as `crate::module`, outside of comments and tests. What a macro names is for the crates that use
/// it.
fn names(code: &str) -> Vec<String> {
    let code = code.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    let code = code.replace("$crate::", "");
    code.lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .flat_map(|line| line.split("crate::").skip(1))
        .map(|rest| rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect())
        .collect()
}

#[test]
fn modules_name_only_what_comes_before() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    let mut files = Vec::new();
    sources(&src, &mut files);
    let place = |name: &str| ORDER.iter().position(|m| *m == name);
    let mut wrong = Vec::new();
    let mut named = 0;
    for path in files {
        let own = module(&path, &src);
        if own == "lib" {
            continue;
        }
        let at = place(&own).unwrap_or_else(|| panic!("{own} has no place in the order"));
        for other in names(&fs::read_to_string(&path).expect("src is readable")) {
            named += 1;
            match place(&other) {
                Some(before) if before <= at => {}
                _ => wrong.push(format!("{} names {other}", path.display())),
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(named > 40, "only {named} names found: the check has lost its eyes");
}
