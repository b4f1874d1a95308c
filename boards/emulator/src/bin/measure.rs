//! Draws every workload in every tier, and prints a line each: workload, tier, clock ticks, checksum.
//!
//! The first lines are `spin`, for 1,000 and 101,000 pairs of instructions: their difference is 200,000 instructions,
//! whatever the clock.
#![no_std]
#![no_main]

use emulator::clock;
use hither::{Exact, Quick, Vertex};
use hither_scenes::workloads::{Buffers, CACHE, PIXELS, Preset, TRIANGLES, Workload, draw};
use semihosting::println;
use static_cell::ConstStaticCell;

static COLOR: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
static DEPTH: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);

/// The vertices of a tier.
struct Vertices<T: Preset> {
    triangles: ConstStaticCell<[[Vertex<T>; 3]; TRIANGLES]>,
    cache: ConstStaticCell<[Vertex<T, 3>; CACHE]>,
}

impl<T: Preset> Vertices<T> {
    const fn new() -> Self {
        Self {
            triangles: ConstStaticCell::new([[Vertex::EMPTY; 3]; TRIANGLES]),
            cache: ConstStaticCell::new([Vertex::EMPTY; CACHE]),
        }
    }
}

static EXACT: Vertices<Exact> = Vertices::new();
static QUICK4: Vertices<Quick<4>> = Vertices::new();
static QUICK8: Vertices<Quick<8>> = Vertices::new();

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    let overhead = clock::start_with_spins();
    let mut buffers = Buffers { color: COLOR.take(), depth: DEPTH.take() };
    measure(&EXACT, &mut buffers, overhead);
    measure(&QUICK4, &mut buffers, overhead);
    measure(&QUICK8, &mut buffers, overhead);
    semihosting::process::exit(0)
}

/// Draws every workload in a tier.
fn measure<T: Preset>(vertices: &'static Vertices<T>, buffers: &mut Buffers<'_>, overhead: u32) {
    let (triangles, cache) = (vertices.triangles.take(), vertices.cache.take());
    for workload in Workload::ALL {
        match draw(workload, buffers, triangles, cache, clock::now) {
            Ok((ticks, sum)) => {
                let ticks = ticks.wrapping_sub(overhead);
                println!("{} {} {ticks} {sum:08x}", workload.name(), T::NAME);
            }
            Err(error) => println!("{} {}: {error}", workload.name(), T::NAME),
        }
    }
}
