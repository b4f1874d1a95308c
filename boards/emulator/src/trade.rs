//! Drawing the trade's scenes at points of the knobs, a line for each: point, scene, what is drawn with, clock ticks, checksum.

use crate::clock;
use hither_scenes::trade::{Depths, Geometry, Knobs, PIXELS, Scene, Visitor, picture};
use semihosting::println;
use static_cell::ConstStaticCell;

static COLOR: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
static SHORT: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
static LONG: ConstStaticCell<[u32; PIXELS]> = ConstStaticCell::new([0; PIXELS]);
static GEOMETRY: ConstStaticCell<Geometry> = ConstStaticCell::new(Geometry::EMPTY);

/// Draws every scene at each point that it visits.
pub struct Counter {
    number: usize,
    overhead: u32,
    geometry: &'static mut Geometry,
    color: &'static mut [u16; PIXELS],
    depths: Depths<'static>,
}

impl Counter {
    /// Starts the clock, and prints two spins: their difference is 200,000 instructions, whatever the clock.
    #[must_use]
    pub fn start() -> Self {
        let overhead = clock::start_with_spins();
        Self {
            number: 0,
            overhead,
            geometry: GEOMETRY.take(),
            color: COLOR.take(),
            depths: Depths { short: SHORT.take(), long: LONG.take() },
        }
    }

    /// Draws and prints one picture.
    #[inline(never)]
    fn count<K: Knobs>(&mut self, scene: Scene, with_texture: bool) {
        let what = (scene, with_texture);
        let depths = self.depths.lend();
        let drawn = picture::<K>(what, self.geometry, self.color, depths, clock::now);
        let (number, name) = (self.number, scene.name());
        let with = if with_texture { "texture" } else { "colors" };
        match drawn {
            Ok(drawn) => {
                let ticks = drawn.ticks.wrapping_sub(self.overhead);
                println!("{number} {name} {with} {ticks} {:08x}", drawn.sum);
            }
            Err(error) => println!("{number} {name} {with}: {error}"),
        }
    }
}

impl Visitor for Counter {
    fn visit<K: Knobs>(&mut self) {
        for scene in Scene::ALL {
            self.count::<K>(scene, scene.is_textured());
        }
        self.count::<K>(Scene::Card, false);
        self.number += 1;
    }
}
