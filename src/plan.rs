//! A planner: from the bounds of a scene and an error budget to cheap knobs that keep it, in constants.
//!
//! Bits that are proved, of numbers with their sign where they have one:
//!
//! | number | bits |
//! | --- | --- |
//! | a clip coordinate, raw: a vertex is within `far` of 0 if it is on the screen, any other of its model within `2 stretch extent` of it | 32 |
//! | an edge function over the guard band, `2^(11 + S)` subpixels wide | `2 (11 + S) + 2`, of 64 |
//! | the same in the exact tier | 62, of 64 |
//! | a texture coordinate, raw | 24 |
//! | the place of a texel | 26, of 32 |
//! | a running depth: 16 bits and those of the steps over the viewport's columns and rows | 27, of 32 |
//!
//! What is chosen, in an order of cost: [`POINTS`] and [`VARIED`]. The first that keeps the budget is taken. It is the cheapest
//! for most scenes, not for all: a knob costs more or less by what is drawn and on which chip, as the command `trade` shows.

mod error;
mod knobs;
mod model;
mod scene;

pub use error::PlanError;
pub use knobs::{
    Bits, Corrected, Every, SelectCorrection, SelectDepth, SelectReciprocal, SelectTier,
    SelectTransform, SelectWidth, Steps,
};
pub use scene::Scene;

/// Knobs for a [`Scene`], and what they promise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Plan {
    /// Subpixel bits: 4 or 8 for [`Quick`](crate::Quick), 0 for [`Exact`](crate::Exact).
    pub snap_bits: u32,
    /// Bits of a transform: 16 for [`ShortMat4`](crate::ShortMat4), 32 for [`Mat4`](crate::Mat4).
    pub transform_bits: u32,
    /// Pixels between two divisions: 8, 16 or 32 for [`PerspectiveEvery`](crate::PerspectiveEvery), 1 for
    /// [`Perspective`](crate::Perspective), 0 for [`Affine`](crate::Affine).
    pub every: u32,
    /// Bits that a varying is stepped in: 16 for [`Packed`](crate::Packed), 32 for a word.
    pub varying_bits: u32,
    /// The reciprocal: 0 for [`Table`](crate::Table), 1 or 2 for [`Newton`](crate::Newton).
    pub newton_steps: u32,
    /// Bits of a stored depth, 16 or 32.
    pub depth_bits: u32,
    /// How far off it is at the most.
    pub promise: Promise,
    /// The bits it was proved to take.
    pub budget: Budget,
}

/// How far off a [`Plan`] is at the most, on a scene that is within its bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Promise {
    /// A vertex on the screen, along x or y, from where real numbers put it.
    pub pixels: f32,
    /// A texture coordinate, from the surface through the snapped vertices; 0 where there is no texture.
    pub texels: f32,
    /// A colour channel in steps of RGB565, from that surface; 0 where there are no colours.
    pub color_steps: f32,
    /// A depth in steps of 16 bits, from that surface.
    pub depth_steps: f32,
}

/// Bits of the largest numbers there are, with their sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Budget {
    /// Raw clip coordinates: up to 32.
    pub clip_bits: u32,
    /// Edge functions: up to 64.
    pub edge_bits: u32,
    /// Raw texture coordinates: up to 24.
    pub coordinate_bits: u32,
    /// Places of texels: up to 32.
    pub texel_bits: u32,
    /// Running depths: up to 32.
    pub depth_bits: u32,
}

/// What decides positions.
#[derive(Clone, Copy)]
struct Point {
    snap_bits: u32,
    transform_bits: u32,
}

/// What decides varyings.
#[derive(Clone, Copy)]
struct Varied {
    every: u32,
    varying_bits: u32,
    newton_steps: u32,
}

/// All of the one, cheapest first.
const POINTS: [Point; 6] =
    [point(4, 16), point(8, 16), point(4, 32), point(8, 32), point(0, 16), point(0, 32)];

const fn point(snap_bits: u32, transform_bits: u32) -> Point {
    Point { snap_bits, transform_bits }
}

/// All of the other, cheapest first. A line that is not divided has a reciprocal for triangles that reach behind the hither
/// plane.
const VARIED: [Varied; 22] = [
    varied(0, 16, 2),
    varied(32, 16, 0),
    varied(32, 16, 1),
    varied(32, 16, 2),
    varied(16, 16, 0),
    varied(16, 16, 1),
    varied(16, 16, 2),
    varied(8, 16, 0),
    varied(8, 16, 1),
    varied(8, 16, 2),
    varied(0, 32, 2),
    varied(32, 32, 0),
    varied(32, 32, 1),
    varied(32, 32, 2),
    varied(16, 32, 0),
    varied(16, 32, 1),
    varied(16, 32, 2),
    varied(8, 32, 0),
    varied(8, 32, 1),
    varied(8, 32, 2),
    varied(1, 32, 1),
    varied(1, 32, 2),
];

const fn varied(every: u32, varying_bits: u32, newton_steps: u32) -> Varied {
    Varied { every, varying_bits, newton_steps }
}

impl Plan {
    /// The first knobs, in their order of cost, that keep a scene's budget. To be kept in a constant; [`plan!`](crate::plan) makes
    /// a preset of it.
    ///
    /// # Panics
    ///
    /// Where none does, with [`PlanError::text`]: at compile time, where it is kept in a constant. Elsewhere
    /// [`try_new`](Self::try_new) is the one to call.
    #[must_use]
    #[expect(clippy::panic, reason = "what fails to compile, where a plan is a constant")]
    pub const fn new(scene: Scene) -> Self {
        match Self::try_new(scene) {
            Ok(plan) => plan,
            Err(error) => panic!("{}", error.text()),
        }
    }

    /// The same.
    ///
    /// # Errors
    ///
    /// [`PlanError`] where a bound is out of range, or nothing keeps the budget.
    pub const fn try_new(scene: Scene) -> Result<Self, PlanError> {
        if let Some(error) = out_of_range(&scene) {
            return Err(error);
        }
        let Some((point, pixels)) = cheapest_point(&scene) else {
            return Err(PlanError::Pixels);
        };
        let exact = point.snap_bits == 0;
        let (varied, texels, color_steps) = match cheapest_varied(&scene, exact) {
            Ok(found) => found,
            Err(error) => return Err(error),
        };
        let depth_bits = if within(model::depth_steps(&scene, 16), scene.depth_steps) {
            16
        } else if within(model::depth_steps(&scene, 32), scene.depth_steps) {
            32
        } else {
            return Err(PlanError::Depth);
        };
        let depth_steps = model::depth_steps(&scene, depth_bits);
        Ok(Self {
            snap_bits: point.snap_bits,
            transform_bits: point.transform_bits,
            every: varied.every,
            varying_bits: varied.varying_bits,
            newton_steps: varied.newton_steps,
            depth_bits,
            promise: Promise {
                pixels: promised(pixels),
                texels: promised(texels),
                color_steps: promised(color_steps),
                depth_steps: promised(depth_steps),
            },
            budget: budget(&scene, point),
        })
    }
}

/// Whether an error is within a budget.
const fn within(off: f64, budget: f32) -> bool {
    off <= budget as f64
}

/// An error, rounded up to what a plan keeps.
#[expect(clippy::cast_possible_truncation, reason = "to the next above")]
const fn promised(off: f64) -> f32 {
    let near = off as f32;
    if off > 0.0 && near.is_finite() { f32::from_bits(near.to_bits() + 1) } else { near }
}

/// The least `w` but 0, 2^-16.
const NEAREST: f32 = 1.525_878_9e-5;

/// The first bound that is out of range.
const fn out_of_range(scene: &Scene) -> Option<PlanError> {
    let Scene { width, height, near, far, extent, stretch, .. } = *scene;
    if width == 0 || height == 0 || width > 512 || height > 512 {
        return Some(PlanError::Viewport);
    }
    // Comparisons are such that no NaN passes.
    if !(near >= NEAREST && near <= far && far <= 32_767.0) {
        return Some(PlanError::Range);
    }
    if !(extent >= 0.0 && stretch >= 0.0 && model::reach(scene) < 32_768.0) {
        return Some(PlanError::Clip);
    }
    if !(scene.deep >= 0.0 && scene.tilt >= 0.0) {
        return Some(PlanError::Triangle);
    }
    if scene.texture > 4096 {
        return Some(PlanError::Texture);
    }
    let Scene { repeats, coordinate, .. } = *scene;
    if !(coordinate >= 0.0 && coordinate <= 127.0 && repeats >= 0.0 && repeats <= 254.0) {
        return Some(PlanError::Coordinate);
    }
    None
}

/// What snaps and transforms positions, and how far off they are.
const fn cheapest_point(scene: &Scene) -> Option<(Point, f64)> {
    let mut rest = POINTS.as_slice();
    while let Some((point, others)) = rest.split_first() {
        rest = others;
        let off = model::pixels(scene, *point);
        if within(off, scene.pixels) && (point.transform_bits > 16 || model::is_short(scene)) {
            return Some((*point, off));
        }
    }
    None
}

/// What corrects varyings, and how far off are texture coordinates and colours.
const fn cheapest_varied(scene: &Scene, exact: bool) -> Result<(Varied, f64, f64), PlanError> {
    let mut colors_fit = false;
    let mut rest = VARIED.as_slice();
    while let Some((varied, others)) = rest.split_first() {
        rest = others;
        // Pieces are drawn by edge functions there, which costs more than dividing at each pixel.
        if exact && varied.every > 1 {
            continue;
        }
        let texels = if scene.texture > 0 { model::texels(scene, exact, *varied) } else { 0.0 };
        let color_steps =
            if scene.colors { model::color_steps(scene, exact, *varied) } else { 0.0 };
        let fits = [within(texels, scene.texels), within(color_steps, scene.color_steps)];
        if let [true, true] = fits {
            return Ok((*varied, texels, color_steps));
        }
        let [_, color_fits] = fits;
        colors_fit |= color_fits;
    }
    Err(if colors_fit { PlanError::Texels } else { PlanError::Colors })
}

/// The bits of a scene's numbers.
const fn budget(scene: &Scene, point: Point) -> Budget {
    let columns_and_rows = scene.width + scene.height;
    let edge_bits = match point.snap_bits {
        0 => 62,
        bits => 2 * (11 + bits) + 2,
    };
    let budget = Budget {
        clip_bits: 17 + model::bits(model::reach(scene)),
        edge_bits,
        coordinate_bits: 17 + model::bits(scene.coordinate as f64),
        texel_bits: 2 * (32 - scene.texture.leading_zeros()),
        depth_bits: 16 + (32 - columns_and_rows.leading_zeros()),
    };
    assert!(budget.clip_bits <= 32, "clip coordinates fit 32 bits");
    assert!(budget.coordinate_bits <= 24, "texture coordinates have planes");
    assert!(budget.texel_bits <= 32, "places of texels fit 32 bits");
    assert!(budget.depth_bits <= 32, "running depths fit 32 bits");
    assert!(budget.edge_bits <= 64, "edge functions fit 64 bits");
    budget
}

#[cfg(test)]
mod tests;
