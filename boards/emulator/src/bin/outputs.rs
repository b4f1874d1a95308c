//! Draws W6 whole and in bands, in every tier, and prints a line each: output, workload, tier, bytes of RAM, clock ticks, checksum.
//!
//! The first lines are `spin`, as those of `measure` are.
#![no_std]
#![no_main]

use emulator::clock;
use hither::{Bins, Exact, FaceColors, Gouraud, Hither, Interpolates, Mat4, Quick, Vertex, VertexStage};
use hither_scenes::torus;
use hither_scenes::workloads::{
    BINNED, Buffers, CACHE, Colors, Output, PIXELS, Preset, Store, draw_output,
};
use semihosting::println;
use static_cell::ConstStaticCell;

static COLOR: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
static DEPTH: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
static BINS: ConstStaticCell<Bins<BINNED>> = ConstStaticCell::new(Bins::new());

/// The vertices of a tier.
struct Caches<T: Preset> {
    bare: ConstStaticCell<[Vertex<T>; CACHE]>,
    colored: ConstStaticCell<[Vertex<T, 3>; CACHE]>,
}

impl<T: Preset> Caches<T> {
    const fn new() -> Self {
        Self {
            bare: ConstStaticCell::new([Vertex::EMPTY; CACHE]),
            colored: ConstStaticCell::new([Vertex::EMPTY; CACHE]),
        }
    }
}

static EXACT: Caches<Exact> = Caches::new();
static QUICK4: Caches<Quick<4>> = Caches::new();
static QUICK8: Caches<Quick<8>> = Caches::new();

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    let overhead = clock::start_with_spins();
    let mut buffers = Buffers { color: COLOR.take(), depth: DEPTH.take() };
    let bins = BINS.take();
    measure(&EXACT, &mut buffers, bins, overhead);
    measure(&QUICK4, &mut buffers, bins, overhead);
    measure(&QUICK8, &mut buffers, bins, overhead);
    semihosting::process::exit(0)
}

/// Draws every output in a tier.
fn measure<T: Preset>(
    caches: &'static Caches<T>,
    buffers: &mut Buffers<'_>,
    bins: &mut Bins<BINNED>,
    overhead: u32,
) {
    if let Some(faces) = FaceColors::new(&torus::FACE_COLORS) {
        let mut store = Store { cache: caches.bare.take().as_mut_slice(), bins };
        count::<T, _, 0>(buffers, &faces, &mut store, overhead);
    }
    let mut store = Store { cache: caches.colored.take().as_mut_slice(), bins };
    count::<T, _, 3>(buffers, &Gouraud, &mut store, overhead);
}

/// Draws every output in some colours.
fn count<T, F, const N: usize>(
    buffers: &mut Buffers<'_>,
    colors: &F,
    store: &mut Store<'_, T, N>,
    overhead: u32,
) where
    T: Preset,
    F: Colors<N>,
    Hither: Interpolates<N>,
    Mat4: VertexStage<F::Attribute, N>,
{
    for output in Output::ALL {
        let (name, ram) = (output.name, output.ram::<T, N>());
        match draw_output(output, buffers, colors, store, clock::now) {
            Ok((ticks, sum)) => {
                let ticks = ticks.wrapping_sub(overhead);
                println!("{name} {} {} {ram} {ticks} {sum:08x}", F::NAME, T::NAME);
            }
            Err(error) => println!("{name} {} {}: {error}", F::NAME, T::NAME),
        }
    }
}
