//! Links for an emulated machine; its memory map is the emulator crate's.

use std::env;

fn main() {
    let target = env::var("TARGET").expect("cargo sets it");
    if target.starts_with("riscv") {
        println!("cargo:rustc-link-arg=-Tmemory.x");
    } else {
        println!("cargo:rustc-link-arg=--nmagic");
    }
    println!("cargo:rustc-link-arg=-Tlink.x");
    println!("cargo:rerun-if-changed=build.rs");
}
