//! What a plan promises is kept, and is not far from what happens: an adversarial search within a scene's bounds, in each of
//! the four units, by drawing with the library through the planned preset.
//!
//! Random restarts from seeds that are known to hurt, and hill climbing by a coordinate at a time. The numbers are the same
//! in every run; with `HITHER_SEED=1` and so on it searches elsewhere, and with `HITHER_SHOW=1` it shows the triangles that it finds.

mod climb;
mod position;
mod triangle;

use hither::{Plan, Preset, Scene};

/// The largest errors found, in a promise's units.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    pixels: f64,
    texels: f64,
    color_steps: f64,
    depth_steps: f64,
}

/// How many evaluations a unit's search has.
const EVALUATIONS: u32 = 15_000;

/// Searches, and holds what is found against the promise.
fn check<P: Preset>(
    plan: &Plan,
    scene: &Scene,
    snap: impl Fn(&position::Placed, &Scene) -> Option<f64>,
) where
    P::Depth: Into<u64>,
{
    let mut found = Found { pixels: position::search(scene, snap), ..Found::default() };
    triangle::search::<P>(scene, &mut found);
    let promise = plan.promise;
    println!("{plan:?}");
    let mut wrong = Vec::new();
    for (unit, promised, found) in [
        ("pixels", promise.pixels, found.pixels),
        ("texels", promise.texels, found.texels),
        ("colour steps", promise.color_steps, found.color_steps),
        ("depth steps", promise.depth_steps, found.depth_steps),
    ] {
        let promised = f64::from(promised);
        println!("{unit}: {found:.5} of {promised:.5}, {:.2}", promised / found);
        if found > promised || promised > 4.0 * found {
            wrong.push(format!("{unit}: {promised} was promised, {found} found"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?} for {plan:?}");
}

macro_rules! scenes {
    ($($(#[$meta:meta])* $test:ident, $name:ident = $scene:expr;)*) => {$(
        hither::plan! {
            $(#[$meta])*
            $name = $scene;
        }

        #[test]
        fn $test() {
            let snap = |placed: &position::Placed, scene: &Scene| {
                placed.off::<$name, _>($name::stage, scene)
            };
            check::<$name>(&$name::PLAN, &$scene, snap);
        }
    )*};
}

scenes! {
    /// A gauge: nothing differs in depth.
    gauge, Gauge = Scene::new(240, 240)
        .range(0.75, 1.25)
        .model(1.0, 2.0)
        .triangle(0.0, 0.0)
        .texture(256, 1.0)
        .colors();
    /// A model of small triangles in the middle of a room.
    model, Model = Scene::new(240, 240)
        .range(2.0, 40.0)
        .model(1.5, 4.0)
        .triangle(0.1, f32::INFINITY)
        .texture(128, 0.25)
        .colors();
    /// A floor to the horizon, of large triangles.
    floor, Floor = Scene::new(320, 240)
        .range(1.0, 32.0)
        .model(4.0, 2.0)
        .triangle(f32::INFINITY, 0.002)
        .texture(64, 4.0)
        .within_texels(2.5);
    /// Colours on walls near by.
    wall, Wall = Scene::new(320, 240)
        .range(1.0, 8.0)
        .model(2.0, 2.0)
        .triangle(3.0, 0.01)
        .colors()
        .within_color_steps(4.0);
    /// The same, with a large texture.
    panel, Panel = Scene::new(320, 240)
        .range(1.0, 8.0)
        .model(2.0, 2.0)
        .triangle(3.0, 0.05)
        .texture(1024, 1.0);
    /// A picture that is compared with others.
    tight, Tight = Scene::new(512, 512)
        .range(4.0, 20.0)
        .model(1.0, 2.0)
        .triangle(8.0, f32::INFINITY)
        .texture(256, 2.0)
        .colors()
        .within_pixels(0.0055)
        .within_texels(0.5)
        .within_color_steps(0.6)
        .within_depth_steps(0.1);
    /// Linear on the exact tier's grid, with a texture that repeats often.
    still, Still = Scene::new(128, 64)
        .range(0.75, 1.25)
        .model(0.25, 2.0)
        .triangle(0.0, 0.0)
        .texture(128, 64.0)
        .colors()
        .within_pixels(0.004);
    /// Depths of 32 bits of projected triangles.
    shelf, Shelf = Scene::new(240, 240)
        .range(1.0, 32.0)
        .model(1.0, 2.0)
        .triangle(f32::INFINITY, 0.001)
        .texture(256, 0.5)
        .within_texels(1.5)
        .within_depth_steps(0.05);
    /// Straight pieces in whole words.
    pieces, Pieces = Scene::new(160, 128)
        .range(1.0, 4.0)
        .model(1.0, 2.0)
        .triangle(f32::INFINITY, 0.0005)
        .texture(512, 1.0)
        .colors()
        .within_texels(1.6)
        .within_color_steps(0.8);
}
