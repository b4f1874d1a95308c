//! Writes the memory map of the emulated machine that a target runs on.

use std::{env, fs, path::PathBuf};

fn main() {
    let folder = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let target = env::var("TARGET").expect("cargo sets it");
    let map = if target.starts_with("riscv") {
        "MEMORY { RAM : ORIGIN = 0x80000000, LENGTH = 8M }
REGION_ALIAS(\"REGION_TEXT\", RAM);
REGION_ALIAS(\"REGION_RODATA\", RAM);
REGION_ALIAS(\"REGION_DATA\", RAM);
REGION_ALIAS(\"REGION_BSS\", RAM);
REGION_ALIAS(\"REGION_HEAP\", RAM);
REGION_ALIAS(\"REGION_STACK\", RAM);
"
    } else if env::var_os("CARGO_FEATURE_MICROBIT").is_some() {
        "MEMORY { FLASH : ORIGIN = 0x00000000, LENGTH = 256K
RAM : ORIGIN = 0x20000000, LENGTH = 16K }
"
    } else if target.starts_with("thumbv8m") {
        "MEMORY { FLASH : ORIGIN = 0x10000000, LENGTH = 4M
RAM : ORIGIN = 0x38000000, LENGTH = 4M }
"
    } else {
        "MEMORY { FLASH : ORIGIN = 0x00000000, LENGTH = 4M
RAM : ORIGIN = 0x20000000, LENGTH = 4M }
"
    };
    fs::write(folder.join("memory.x"), map).expect("OUT_DIR is writable");
    println!("cargo:rustc-link-search={}", folder.display());
    if target.starts_with("riscv") {
        println!("cargo:rustc-link-arg=-Tmemory.x");
    } else {
        println!("cargo:rustc-link-arg=--nmagic");
    }
    println!("cargo:rustc-link-arg=-Tlink.x");
    // Beside the program: OUT_DIR is build/NAME/out there.
    let map = folder.ancestors().nth(3).expect("OUT_DIR is deep").join("bands_16k.map");
    println!("cargo:rustc-link-arg-bin=bands_16k=-Map={}", map.display());
    // The AN505's timer is elsewhere.
    println!("cargo:rustc-check-cfg=cfg(armv8m)");
    if target.starts_with("thumbv8m") {
        println!("cargo:rustc-cfg=armv8m");
    }
    println!("cargo:rerun-if-changed=build.rs");
}
