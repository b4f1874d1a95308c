//! Draws W1, W2 and W3 with the flat triangles of other crates, and prints a line each: crate, workload, clock ticks,
//! pixels drawn.
//!
//! The first lines are `spin`, as the measuring firmware's are.
#![no_std]
#![no_main]

mod peer;
mod screen;

use core::fmt::Debug;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::pixelcolor::raw::RawU16;
use embedded_graphics::prelude::*;
use emulator::clock;
use hither_scenes::workloads::{PIXELS, TRIANGLES, Workload, corners, face_color};
use peer::{Embedded3dgfx, EmbeddedGraphics, Peer};
use screen::{Counted, Screen};
use semihosting::println;
use static_cell::ConstStaticCell;

/// The corners of a triangle, in pixels.
type Corners = [Point; 3];

static WORDS: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
static AGAIN: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
static CORNERS: ConstStaticCell<[Corners; TRIANGLES]> =
    ConstStaticCell::new([[Point::zero(); 3]; TRIANGLES]);

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    clock::start();
    // Two reads with nothing between.
    let overhead = ticks(|| {});
    for pairs in [1_000, 101_000] {
        println!("spin {pairs} {}", ticks(|| clock::spin(pairs)).wrapping_sub(overhead));
    }
    let mut bench = Bench { words: WORDS.take(), again: AGAIN.take(), overhead };
    let room = CORNERS.take();
    for workload in [Workload::W1, Workload::W2, Workload::W3] {
        let triangles = triangles(workload, room);
        bench.measure::<EmbeddedGraphics>(workload, triangles);
        bench.measure::<Embedded3dgfx>(workload, triangles);
    }
    semihosting::process::exit(0)
}

/// What the clock says of `work`; it wraps.
fn ticks(work: impl FnOnce()) -> u32 {
    let start = clock::now();
    work();
    clock::now().wrapping_sub(start)
}

/// A workload's triangles: the integers that hither's vertices are snapped from.
fn triangles(workload: Workload, room: &mut [Corners; TRIANGLES]) -> &[Corners] {
    let mut count = 0;
    corners(workload, |number, corners| {
        if let Some(triangle) = room.get_mut(number) {
            *triangle = corners.map(|corner| Point::new(corner.x, corner.y));
            count = number + 1;
        }
    });
    room.get(..count).unwrap_or_default()
}

/// What the peers are measured on.
struct Bench {
    words: &'static mut [u16; PIXELS],
    again: &'static mut [u16; PIXELS],
    overhead: u32,
}

impl Bench {
    /// Draws a workload twice, by the clock, and with a count of pixels; both must be the same picture.
    fn measure<P: Peer>(&mut self, workload: Workload, triangles: &[Corners]) {
        self.words.fill(0);
        self.again.fill(0);
        let mut screen = Screen::new(self.words);
        let ticks = ticks(|| draw_all::<P, _>(&mut screen, triangles));
        let mut counted = Counted::new(self.again);
        draw_all::<P, _>(&mut counted, triangles);
        let pixels = counted.pixels;
        if self.words == self.again {
            let ticks = ticks.wrapping_sub(self.overhead);
            println!("{} {} {ticks} {pixels}", P::NAME, workload.name());
        } else {
            println!("{} {}: drawn twice, two pictures", P::NAME, workload.name());
        }
    }
}

/// The counted part: a call a triangle, in the colours of hither's.
#[inline(never)]
fn draw_all<P: Peer, T: DrawTarget<Color = Rgb565, Error: Debug>>(
    target: &mut T,
    triangles: &[Corners],
) {
    for (number, corners) in triangles.iter().enumerate() {
        let color = Rgb565::from(RawU16::new(face_color(number).0));
        P::draw(target, *corners, color);
    }
}
