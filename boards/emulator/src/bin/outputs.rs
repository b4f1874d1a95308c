//! Draws W6 whole, in bands and as lines, and W1 and W2 through a draw target of embedded-graphics and with smooth edges, in
//! every tier, and prints a line each: output, workload, tier, bytes of RAM, clock ticks, checksum.
//!
//! The first lines are `spin`, as those of `measure` are.
#![no_std]
#![no_main]

use emulator::clock;
use hither::{
    Bins, Cull, Exact, FaceColors, Frame, Framebuffer, Gouraud, Hither, Interpolates, Mat4,
    OnDisplay, Quick, Rgb565, Vertex, VertexStage,
};
use hither_scenes::SceneError;
use hither_scenes::checksum::Checksum;
use hither_scenes::torus;
use hither_scenes::workloads::{
    BINNED, Buffers, CACHE, Colors, HITHER, Output, PIXELS, Preset, SIDE, Store, TRIANGLES,
    Workload, draw_flat, draw_output, smooth_flat, snapped, torus_lines,
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
    triangles: ConstStaticCell<[[Vertex<T>; 3]; TRIANGLES]>,
}

impl<T: Preset> Caches<T> {
    const fn new() -> Self {
        Self {
            bare: ConstStaticCell::new([Vertex::EMPTY; CACHE]),
            colored: ConstStaticCell::new([Vertex::EMPTY; CACHE]),
            triangles: ConstStaticCell::new([[Vertex::EMPTY; 3]; TRIANGLES]),
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
    let triangles = caches.triangles.take();
    for workload in [Workload::W1, Workload::W2] {
        let counted = on_display::<T>(workload, buffers.color, triangles);
        report::<T>("display", workload, 2 * PIXELS, counted, overhead);
        let counted = smooth_flat::<T>(workload, buffers.color, triangles, clock::now);
        report::<T>("smooth", workload, 2 * PIXELS, counted, overhead);
    }
    let vertices = triangles.as_flattened_mut().get_mut(..CACHE).unwrap_or_default();
    let ram = 4 * PIXELS + size_of_val(vertices);
    report::<T>("lines", Workload::W6f, ram, torus_lines(buffers, vertices, clock::now), overhead);
}

/// Prints a line.
fn report<T: Preset>(
    name: &str,
    workload: Workload,
    ram: usize,
    counted: Result<(u32, u32), SceneError>,
    overhead: u32,
) {
    let workload = workload.name();
    match counted {
        Ok((ticks, sum)) => {
            let ticks = ticks.wrapping_sub(overhead);
            println!("{name} {workload} {} {ram} {ticks} {sum:08x}", T::NAME);
        }
        Err(error) => println!("{name} {workload} {}: {error}", T::NAME),
    }
}

/// Draws W1 or W2 through a draw target, which is a framebuffer as embedded-graphics sees it; ticks and checksum.
fn on_display<T: Preset>(
    workload: Workload,
    color: &mut [u16; PIXELS],
    triangles: &mut [[Vertex<T>; 3]; TRIANGLES],
) -> Result<(u32, u32), SceneError> {
    color.fill(0);
    let mut display = Framebuffer::<Rgb565>::try_new(color, SIDE, SIDE)?;
    let mut frame = Frame::new(OnDisplay::new(&mut display))?
        .with_tier(T::default())
        .with_correction(T::Correction::default())
        .with_hither(HITHER)
        .with_cull(Cull::Back);
    let triangles = snapped(&frame, workload, triangles);
    let start = clock::now();
    draw_flat(&mut frame, triangles);
    let Ok(()) = frame.finish();
    let ticks = clock::now().wrapping_sub(start);
    Ok((ticks, Checksum::new().with_words(color).value()))
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
        let counted = draw_output(output, buffers, colors, store, clock::now);
        report::<T>(output.name, F::WORKLOAD, output.ram::<T, N>(), counted, overhead);
    }
}
