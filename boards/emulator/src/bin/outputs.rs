//! Draws W6 whole and in bands, and W1 and W2 through a draw target of embedded-graphics, in every tier, and prints a line each:
//! output, workload, tier, bytes of RAM, clock ticks, checksum.
//!
//! The first lines are `spin`, as those of `measure` are.
#![no_std]
#![no_main]

use emulator::clock;
use hither::{
    Bins, Cull, Exact, FaceColors, Flat, Frame, Framebuffer, Gouraud, Hither, Interpolates, Mat4,
    OnDisplay, Quick, Rgb565, Vertex, VertexStage,
};
use hither_scenes::SceneError;
use hither_scenes::checksum::Checksum;
use hither_scenes::torus;
use hither_scenes::workloads::{
    BINNED, Buffers, CACHE, Colors, HITHER, Output, PIXELS, Preset, SIDE, Store, TRIANGLES,
    Workload, corners, draw_output, face_color,
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
        let ram = 2 * PIXELS;
        match on_display::<T>(workload, buffers.color, triangles) {
            Ok((ticks, sum)) => {
                let (name, ticks) = (workload.name(), ticks.wrapping_sub(overhead));
                println!("display {name} {} {ram} {ticks} {sum:08x}", T::NAME);
            }
            Err(error) => println!("display {} {}: {error}", workload.name(), T::NAME),
        }
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
    let mut count = 0;
    corners(workload, |number, corners| {
        if let Some(triangle) = triangles.get_mut(number) {
            for (vertex, corner) in triangle.iter_mut().zip(corners) {
                *vertex = frame.snap(&corner.clip(), []);
            }
            count = number + 1;
        }
    });
    let start = clock::now();
    draw_flat(&mut frame, triangles.get(..count).unwrap_or_default());
    let Ok(()) = frame.finish();
    let ticks = clock::now().wrapping_sub(start);
    Ok((ticks, Checksum::new().with_words(color).value()))
}

/// The counted part.
#[inline(never)]
fn draw_flat<T: Preset>(
    frame: &mut Frame<
        OnDisplay<'_, Framebuffer<'_, Rgb565>>,
        hither::NoDepth,
        Hither,
        T,
        T::Correction,
    >,
    triangles: &[[Vertex<T>; 3]],
) {
    for (number, [a, b, c]) in triangles.iter().enumerate() {
        frame.draw_snapped([a, b, c], &Flat(face_color(number)));
    }
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
