//! How far off each knob is, on a scene: what a plan promises.
//!
//! In `f64`, by constant functions: a plan is made at compile time, and nothing of this is in a firmware that keeps its plans
//! constant.
//!
//! **Position**, in pixels, of a vertex on the screen, from where real numbers would put it, with a matrix whose entries are the
//! ideal ones rounded to Q16.16. A clip coordinate of a position of up to `extent` a coordinate is off by
//! `e = (3 extent + 1) 2^-17` by the entries' rounding and 2^-17 by its own; with entries of 16 bits, which are cut by `cut`
//! bits, by `3 extent 2^(cut - 17)` more. `x / w` is at most 1, so a pixel is off by `side / 2 (e + e) / (near - e)`, and by half
//! a unit of its grid: `2^-(S + 1)` with `S` subpixel bits; in the exact tier `side / 2 (1/2 + 1/2) / 2^19`, where `w` may have
//! more than its 20 bits.
//!
//! The others are measured against the surface through the snapped vertices.
//!
//! **Varyings.** Let `u` change by at most `d` over a triangle, and `w` by a factor `r`. A straight line between two points of it
//! is off by `d bend(r)`, `bend(r) = (sqrt r - 1) / (sqrt r + 1)`, which it is where one of them has the least `w` and the other
//! the largest. `r` is `R = min(far / near, (near + deep) / near)` over a triangle; along `n` pixels of a row `1 / w` is linear,
//! so it changes by at most `n tilt` of its least: `r = min(R, 1 + n tilt)`. Where a straight line over the whole triangle is
//! taken if `d (r - 1) / 4` is within a tolerance `t`, it is off by most where `d` is largest: `d bend(min(R, 1 + 4 t / d))`.
//! A line that bends is off by `bend(r)` of its whole length by a quarter, and of its parts, 8 of `n` pixels of 9 to 32, by
//! `(8 / n)^2` (`interpolation/arcs.rs`). The rest, in raw steps of 2^-16, is in the constants below.
//!
//! **Colours** are such varyings with `d = 1`, in 63 steps of green, with half a step that rounding takes.
//!
//! **Depth**: within 1.07 steps of 16 bits (`depth/plane.rs`). With 32 bits three terms are each rounded to half a running unit,
//! 2^-17 of those steps, a pixel along a row, and the row's start, with the rounding of its terms, is within 2^-11 of one.

#![expect(clippy::float_arithmetic, reason = "evaluated at compile time")]
#![expect(clippy::cast_precision_loss, reason = "powers of two")]

use super::scene::Scene;
use super::{Point, Varied};

/// A raw step: varyings are in units of it.
const UNIT: f64 = 65_536.0;

/// How far off a linear plane of a varying is, in raw steps: 2^-8 of them for a unit. A gradient's floors are 1 1/2 of `2^t` units
/// (`setup/plane.rs`), for all columns and rows from vertex 0 to a covered pixel. In boxes below `2^(n + 1) <= 512` pixels `t` is at
/// most `10 - n`: 24 raw steps, and 8 by the floor at vertex 0. In others it is 2, to the guard band's ends.
const fn plane(scene: &Scene) -> f64 {
    let farthest = (1024 + scene.width + 1024 + scene.height) as f64;
    (farthest * 6.0 / 256.0).max(32.0)
}

/// The steps of green in RGB565.
const GREEN: f64 = 63.0;

/// `2^-n` for whole `n` up to 62.
const fn part(n: u32) -> f64 {
    1.0 / (1u64 << n) as f64
}

/// `2^n`, of up to 62.
const fn power_of(n: u32) -> f64 {
    (1u64 << if n < 62 { n } else { 62 }) as f64
}

/// A square root of 1 or more, by Newton's iteration.
const fn root(v: f64) -> f64 {
    let mut root = if v > 1.0 { v } else { 1.0 };
    loop {
        let next = (root + v / root) / 2.0;
        if next >= root {
            return root;
        }
        root = next;
    }
}

/// How far a straight line is off, in parts of what changes, where `w` changes by a factor.
const fn bend(ratio: f64) -> f64 {
    let root = root(ratio);
    (root - 1.0) / (root + 1.0)
}

/// By what factor `w` differs over a triangle.
pub(super) const fn ratio(scene: &Scene) -> f64 {
    let (near, far) = (scene.near as f64, scene.far as f64);
    far.min(near + scene.deep as f64) / near
}

/// By what factor `w` differs along `n` pixels of a row.
const fn ratio_along(scene: &Scene, n: u32) -> f64 {
    // Where it does not, any tilt comes to nothing.
    let tilted = 1.0 + n as f64 * scene.tilt as f64;
    ratio(scene).min(tilted)
}

/// The bits of a number of 0 or more: 2 to their power is above it.
pub(super) const fn bits(v: f64) -> u32 {
    let mut bits = 0;
    let mut power = 1.0;
    while power <= v && bits < 100 {
        power *= 2.0;
        bits += 1;
    }
    bits
}

/// Of a position: see the module.
pub(super) const fn pixels(scene: &Scene, point: Point) -> f64 {
    let side = if scene.width > scene.height { scene.width } else { scene.height } as f64;
    let reach = 3.0 * scene.extent as f64;
    let cut = cut(scene);
    let short =
        if point.transform_bits == 16 && cut > 0 { power_of(cut) * part(17) * reach } else { 0.0 };
    let off = (reach + 2.0) * part(17) + short;
    let near = scene.near as f64;
    if off >= near {
        return f64::INFINITY;
    }
    let snap = match point.snap_bits {
        // Whole numbers up to 2^20 are on the grid.
        0 if scene.far <= 16.0 => 0.0,
        0 => side * part(20),
        bits => part(bits + 1),
    };
    snap + side * off / (near - off)
}

/// What no clip coordinate is beyond.
pub(super) const fn reach(scene: &Scene) -> f64 {
    scene.far as f64 + 2.0 * scene.stretch as f64 * scene.extent as f64
}

/// Whether a transform of 16 bits takes a scene's matrices: see [`ShortMat4`](crate::ShortMat4).
pub(super) const fn is_short(scene: &Scene) -> bool {
    scene.stretch < 4095.0 && reach(scene) < 8192.0
}

/// By how many bits a transform of 16 bits cuts entries.
pub(super) const fn cut(scene: &Scene) -> u32 {
    let bits = bits(scene.stretch as f64 * UNIT + 2.0);
    bits.saturating_sub(15)
}

/// How far a straight line is off that is one over all of a triangle, where it is taken: if that is within `tolerance`.
const fn straight(scene: &Scene, change: f64, tolerance: f64) -> f64 {
    if change > 0.0 { change * bend(ratio(scene).min(1.0 + 4.0 * tolerance / change)) } else { 0.0 }
}

/// Whether any triangle is not straight.
const fn bends(scene: &Scene, change: f64, tolerance: f64) -> bool {
    change * (ratio(scene) - 1.0) > 4.0 * tolerance
}

/// How far pieces of a straight line are off, with their planes and the reciprocal.
const fn pieces(scene: &Scene, change: f64, knobs: Varied) -> f64 {
    let distance = scene.far as f64 / scene.near as f64;
    let reciprocal = match knobs.newton_steps {
        0 => part(7),
        1 => part(15),
        _ => part(29),
    };
    let planes = part(16) * distance + reciprocal;
    change * (bend(ratio_along(scene, knobs.every)) + planes)
}

/// How far lines that bend are off.
const fn arcs(scene: &Scene, change: f64, newton_steps: u32) -> f64 {
    let mut line = bend(ratio_along(scene, 8));
    let mut n = 9;
    while n <= 32 {
        let parts = 64.0 / (n * n) as f64;
        line = line.max(bend(ratio_along(scene, n).min(2.0)) * (parts + 0.25));
        n += 1;
    }
    let reciprocal = if newton_steps == 0 { part(6) } else { part(13) };
    change * (line + reciprocal + part(14) * ratio(scene)) + 64.0
}

/// The power of two at a number of 1 or more, or above it.
const fn power(v: f64) -> f64 {
    let mut power = 1.0;
    while power < v {
        power *= 2.0;
    }
    power
}

/// The unit of a varying that is divided, or linear in the exact tier, in raw steps: `2^e` of `interpolation/quotient.rs`.
const fn unit(scene: &Scene, change: f64) -> f64 {
    power(change).max(2048.0).max(power(scene.coordinate as f64 * UNIT) / 32.0)
}

/// What a difference of a power of two lacks, as Q31 has no 1: 2^-15 of it.
const fn lacking(change: f64) -> f64 {
    let power = power(change);
    part(15) * if power > change { power / 2.0 } else { power }
}

/// How far varyings that are divided at each pixel are off: their two planes beside the largest `q`, which is 2^30 at least, by
/// 2^14.8 each in the exact tier and 2^14 elsewhere; and the reciprocal, which begins within 2^-15 and is followed within `x^3`
/// where `q` changes by `x`, up to 5/128. Proved for very thin triangles with one end 16 times as far as the other: on the exact
/// tier's grid a search in `w` of that ratio found a thirteenth of it. By edge functions, where those have no planes, see `interpolation.rs`.
const fn divided(scene: &Scene, exact: bool, change: f64) -> f64 {
    let distance = scene.far as f64 / scene.near as f64;
    let planes = if exact { part(14) } else { part(15) };
    let planes = unit(scene, change) * planes * ratio(scene).min(16.0);
    let step = (scene.tilt as f64).min(5.0 / 128.0);
    let reciprocal = change * (step * step * step).max(part(15));
    let edges = change * part(23) * distance;
    planes.max(edges) + reciprocal + lacking(change) + 0.5
}

/// A varying that changes by at most so many raw steps, in those; a straight line may be off by so many, and takes so many for
/// what it is packed in.
const fn varying(scene: &Scene, exact: bool, change: f64, knobs: Varied, packed: [f64; 2]) -> f64 {
    let [tolerance, word] =
        if knobs.varying_bits == 16 { packed } else { [128.0, plane(scene) + 0.5] };
    match knobs.every {
        // Rounded in its unit, and off by its plane.
        0 if exact => {
            change * bend(ratio(scene)) + unit(scene, change) * (part(15) + part(16)) + 1.0
        }
        0 => change * bend(ratio(scene)) + word,
        1 => divided(scene, exact, change),
        _ => straight(scene, change, tolerance) + word,
    }
}

/// Of a texture coordinate, in texels.
pub(super) const fn texels(scene: &Scene, exact: bool, knobs: Varied) -> f64 {
    let change = scene.repeats as f64 * UNIT;
    let tolerance = 128.0;
    let mut off = varying(scene, exact, change, knobs, [tolerance, plane(scene) + 17.0]);
    if !exact && knobs.every > 1 && bends(scene, change, tolerance) {
        // Triangles that are too thin for planes are drawn in pieces, whatever the width.
        let mut line = pieces(scene, change, knobs) + 1.0;
        if knobs.varying_bits == 16 {
            line = line.max(arcs(scene, change, knobs.newton_steps));
        }
        off = off.max(line);
    }
    off * scene.texture as f64 / UNIT
}

/// Of a colour, in steps of green.
pub(super) const fn color_steps(scene: &Scene, exact: bool, knobs: Varied) -> f64 {
    // Of a lane: 1/32 is cut, and 23 steps are rounded to 1/64.
    let lane = (1.0 / 32.0 + 23.0 / 64.0) * UNIT / GREEN;
    let packed = [512.0, lane + 1.0];
    let mut off = varying(scene, exact, UNIT, knobs, packed);
    let tolerance = if knobs.varying_bits == 16 { 512.0 } else { 128.0 };
    if knobs.every > 1 && bends(scene, UNIT, tolerance) {
        // A lane of a piece is 1/32 too small, and as much at each of its pixels.
        let cut = if knobs.varying_bits == 16 { knobs.every as f64 / 32.0 } else { 0.0 };
        off = off.max(pieces(scene, UNIT, knobs) + 1.0 + cut * UNIT / GREEN);
    }
    0.5 + off * GREEN / UNIT
}

/// Of a depth, in steps of 16 bits.
pub(super) const fn depth_steps(scene: &Scene, depth_bits: u32) -> f64 {
    match depth_bits {
        16 => 1.07,
        _ => 1.5 * scene.width as f64 * part(16) + part(11),
    }
}
