//! One workload in one tier and nothing else, chosen by features: how much flash and static RAM it takes is read off
//! the program, how much stack it prints. With no workload it is the empty firmware that others are compared with.
//!
//! It links with `panic-never`: if anything that is left in it could panic, it does not link.
#![no_std]
#![no_main]

use core::hint::black_box;
use emulator::stack;
use panic_never as _;
use semihosting::io::{Write, stdout};

/// Words of stack that are painted, 32 kB: more than any workload takes.
const STACK: usize = 8192;

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    let painted = stack::paint(STACK);
    let drawn = work();
    let deepest = painted.deepest();
    let printed = deepest.filter(|_| drawn).is_some_and(print);
    semihosting::process::exit(i32::from(!printed))
}

/// Prints a number and ends the line, without the formatting machinery; whether it could.
fn print(number: u32) -> bool {
    let mut line = *b"00000000\n";
    for (digit, shift) in line.iter_mut().zip((0..32).step_by(4).rev()) {
        let value = (number >> shift) as u8 & 15;
        *digit = if value < 10 { b'0' + value } else { b'a' + value - 10 };
    }
    stdout().is_ok_and(|mut out| out.write_all(&line).is_ok())
}

/// Draws the workload; whether it could.
#[cfg(not(any(
    feature = "w1",
    feature = "w5",
    feature = "w6g",
    feature = "shaders",
    feature = "scenes"
)))]
#[inline(never)]
fn work() -> bool {
    black_box(true)
}

/// Draws the workload; whether it could.
#[cfg(any(
    feature = "w1",
    feature = "w5",
    feature = "w6g",
    feature = "shaders",
    feature = "scenes"
))]
#[inline(never)]
fn work() -> bool {
    workload::draw().is_some()
}

#[cfg(any(feature = "w1", feature = "w5", feature = "w6g", feature = "shaders"))]
mod workload {
    use core::hint::black_box;
    use hither::Vertex;
    use hither_scenes::workloads::{self, Buffers, PIXELS};
    use static_cell::ConstStaticCell;

    #[cfg(feature = "exact")]
    type Tier = hither::Exact;
    #[cfg(feature = "quick4")]
    type Tier = hither::Quick<4>;
    #[cfg(feature = "quick8")]
    type Tier = hither::Quick<8>;

    static COLOR: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);

    /// The counted part alone matters here: no clock.
    fn clock() -> u32 {
        0
    }

    /// One flat triangle.
    fn flat(color: &mut [u16; PIXELS]) -> Option<()> {
        let mut triangles = [[Vertex::<Tier>::EMPTY; 3]];
        let ticks = workloads::flat(workloads::Workload::W1, color, &mut triangles, clock);
        ticks.ok().map(drop)
    }

    #[cfg(feature = "w1")]
    pub fn draw() -> Option<()> {
        let color = COLOR.try_take()?;
        #[cfg(feature = "fault-panic")]
        {
            color[black_box(PIXELS)] = 1;
        }
        flat(color)?;
        black_box(color);
        Some(())
    }

    #[cfg(not(feature = "w1"))]
    static DEPTH: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);

    #[cfg(feature = "w5")]
    pub fn draw() -> Option<()> {
        let mut buffers = Buffers { color: COLOR.try_take()?, depth: DEPTH.try_take()? };
        workloads::textured::<Tier>(&mut buffers, clock).ok()?;
        black_box(buffers);
        Some(())
    }

    #[cfg(feature = "w6g")]
    pub fn draw() -> Option<()> {
        use hither_scenes::workloads::CACHE;
        static VERTICES: ConstStaticCell<[Vertex<Tier, 3>; CACHE]> =
            ConstStaticCell::new([Vertex::EMPTY; CACHE]);
        let mut buffers = Buffers { color: COLOR.try_take()?, depth: DEPTH.try_take()? };
        workloads::torus_gouraud(&mut buffers, VERTICES.try_take()?, clock).ok()?;
        black_box(buffers);
        Some(())
    }

    #[cfg(feature = "shaders")]
    pub fn draw() -> Option<()> {
        let mut buffers = Buffers { color: COLOR.try_take()?, depth: DEPTH.try_take()? };
        flat(buffers.color)?;
        black_box(&buffers);
        workloads::gouraud::<Tier>(&mut buffers, clock).ok()?;
        black_box(&buffers);
        workloads::textured::<Tier>(&mut buffers, clock).ok()?;
        black_box(buffers);
        Some(())
    }
}

/// A textured and a shaded mesh, at a preset's point.
#[cfg(feature = "scenes")]
mod workload {
    use core::hint::black_box;
    use hither_scenes::trade::{Depths, Geometry, PIXELS, PresetPoint, Scene, picture};
    use static_cell::ConstStaticCell;

    #[cfg(feature = "speed")]
    type Preset = hither::Speed;
    #[cfg(feature = "balance")]
    type Preset = hither::Balance;
    #[cfg(feature = "fidelity")]
    type Preset = hither::Fidelity;

    static COLOR: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
    static SHORT: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
    static LONG: ConstStaticCell<[u32; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
    static GEOMETRY: ConstStaticCell<Geometry> = ConstStaticCell::new(Geometry::EMPTY);

    pub fn draw() -> Option<()> {
        let (color, geometry) = (COLOR.try_take()?, GEOMETRY.try_take()?);
        let mut depths = Depths { short: SHORT.try_take()?, long: LONG.try_take()? };
        for what in [(Scene::Card, true), (Scene::Torus, false)] {
            let lent = depths.lend();
            picture::<PresetPoint<Preset>>(what, geometry, color, lent, || 0).ok()?;
            black_box(&color);
        }
        Some(())
    }
}
