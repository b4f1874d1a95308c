//! Scenes of one triangle that are hard on interpolation.

use crate::oracle::generate::pixel_vertex;
use crate::oracle::{Category, ExactTriangle, GRID, Part, Rng, Surface, Viewport, triangle, whole};

/// Kinds of scenes; all coordinates are on the exact tier's grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// All `w` between one and two near ones, beyond the hither plane: a model in the middle of a
    /// room.
    Mild,
    /// `w` from 1 to 4096 hither distances within one triangle, all in front of the plane.
    Deep,
    /// Vertices in front of the hither plane and behind it, none behind the eye.
    ThroughHither,
    /// Vertices in front of and behind the eye, each up to 4096 hither distances away.
    ThroughEye,
    /// Less than some pixels large, with any `w`.
    Small,
    /// Thin ones, through or just beside a pixel centre.
    Sliver,
    /// All kinds of triangles that coverage is tested with.
    Nasty,
    /// Depths far beyond the range at all vertices, up to 2^20 hither distances, that cancel at a
    /// covered pixel.
    Steep,
}

impl Family {
    /// Every family but the last, which is about depth only.
    pub const ALL: [Self; 7] = [
        Self::Mild,
        Self::Deep,
        Self::ThroughHither,
        Self::ThroughEye,
        Self::Small,
        Self::Sliver,
        Self::Nasty,
    ];
}

/// One triangle in front of a camera.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Which family and seed it was made from.
    pub seed: (Family, u64),
    /// The screen.
    pub viewport: Viewport,
    /// `[x, y, z, w]`, raw.
    pub corners: [[i64; 4]; 3],
    /// A value a vertex, raw Q16.16; at least 2^14 from each other.
    pub attribute: [i32; 3],
    /// The hither distance, raw.
    pub hither: i64,
}

impl Scene {
    /// A random scene.
    #[must_use]
    pub fn random(family: Family, seed: u64) -> Self {
        let mut rng = Rng::new(seed ^ (family as u64) << 32);
        let viewport = match family {
            Family::Steep => Viewport::new(64, 64),
            _ => rng.choose(&[Viewport::new(240, 320), Viewport::new(512, 512)]),
        };
        let hither = rng.range(1, 256);
        let (corners, hither) = corners(family, viewport, hither, &mut rng);
        let z = if family == Family::Steep {
            cancelling(corners, viewport, hither, &mut rng)
        } else if rng.once_in(3) {
            [(); 3].map(|()| rng.signed(GRID))
        } else {
            depths(corners.map(|[_, _, w]| w), hither, &mut rng)
        };
        let corners = [0, 1, 2].map(|i| {
            let [x, y, w] = corners[i];
            [x, y, z[i], w]
        });
        Self { seed: (family, seed), viewport, corners, attribute: attribute(&mut rng), hither }
    }
}

/// The corners `[x, y, w]` and the hither distance.
fn corners(family: Family, viewport: Viewport, h: i64, rng: &mut Rng) -> ([[i64; 3]; 3], i64) {
    let far = (4096 * h).min(GRID);
    let at = |rng: &mut Rng, w: i64, reach: i64| {
        let reach = (w.abs() * reach).clamp(1, GRID);
        [rng.range(-reach, reach), rng.range(-reach, reach), w]
    };
    let corners = match family {
        Family::Mild => {
            let near = rng.range(h, far / 2).max(64);
            return (
                [(); 3].map(|()| {
                    let w = rng.range(near, 2 * near).min(GRID);
                    at(rng, w, 1)
                }),
                h.min(near),
            );
        }
        Family::Deep => {
            let third = rng.magnitude(far).max(h);
            [h, far, third].map(|w| at(rng, w, 2))
        }
        Family::ThroughHither => {
            let behind = rng.range(0, h - 1);
            let third = rng.magnitude(far);
            [behind, far, third].map(|w| {
                let reach = rng.choose(&[1, 4, 64]);
                at(rng, w.max(1), reach)
            })
        }
        Family::ThroughEye => {
            let third = rng.signed(far);
            [-rng.magnitude(far), rng.magnitude(far).max(h), third].map(|w| at(rng, w, 2))
        }
        Family::Small => {
            let middle = (
                rng.below(u64::from(viewport.width)) as i64,
                rng.below(u64::from(viewport.height)) as i64,
            );
            let [x, y, w] = pixel_vertex(viewport, middle, 1, 1);
            let reach = rng.range(1, 4 * w / i64::from(viewport.width));
            let corners = [(); 3].map(|()| {
                let scale = rng.range(1, (GRID / (w + reach)).max(1));
                let near = |v: i64, rng: &mut Rng| v + rng.range(-reach, reach);
                [near(x, rng), near(y, rng), w].map(|v| (v * scale).clamp(-GRID, GRID))
            });
            let least = corners.iter().map(|c| c[2]).min().unwrap_or(1);
            return (corners, rng.range((least / 4096).max(1), least));
        }
        Family::Steep => {
            let corners = [(); 3].map(|()| {
                let w = if rng.once_in(3) { -rng.magnitude(GRID) } else { rng.magnitude(GRID) };
                at(rng, w, 2)
            });
            return (corners, rng.magnitude(1 << 12));
        }
        Family::Sliver | Family::Nasty => {
            let category = if family == Family::Sliver {
                Category::Sliver
            } else {
                rng.choose(&Category::ALL)
            };
            let corners = triangle(category, viewport, rng);
            let most = corners.iter().map(|c| c[2]).max().unwrap_or(1).max(1);
            return (corners, rng.range((most / 4096).max(1), most));
        }
    };
    (corners, h)
}

/// z as a perspective sets it: `(w - h) f / (f - h)` for a far plane at `f`.
fn depths(w: [i64; 3], h: i64, rng: &mut Rng) -> [i64; 3] {
    let far = h + rng.magnitude(GRID);
    w.map(|w| {
        let (ahead, depth) = (i128::from(w - h) * i128::from(far), i128::from(far - h));
        ((2 * ahead + depth).div_euclid(2 * depth) as i64).clamp(-2 * GRID, 2 * GRID)
    })
}

/// Any two z, and a third so that `z / w` is within the range at some covered pixel.
fn cancelling(corners: [[i64; 3]; 3], viewport: Viewport, h: i64, rng: &mut Rng) -> [i64; 3] {
    let mut z = [0; 3].map(|_: i64| rng.range(-GRID, GRID));
    let Some(surface) = Surface::new(corners, viewport) else {
        return z;
    };
    let exact = ExactTriangle::new(corners, viewport, Part::Front);
    let q = surface.reciprocal_w();
    let mut pixels = exact.pixels();
    pixels.retain(|&(x, y)| q.at(x, y) * h as f64 <= 1.0);
    if pixels.is_empty() {
        return z;
    }
    let (x, y) = rng.choose(&pixels);
    let third = rng.below(3) as usize;
    z[third] = 0;
    let mut one = [0; 3];
    one[third] = 1;
    let at = |z: [i64; 3]| surface.depth(&whole(z)).at(x, y);
    let wanted = (rng.fraction() - at(z)) / at(one);
    z[third] = (wanted.round() as i64).clamp(-GRID, GRID);
    z
}

/// Three values: the whole range of the type, a small range, or a small one far from 0.
fn attribute(rng: &mut Rng) -> [i32; 3] {
    const LEAST: i64 = 1 << 14;
    let ends = [i64::from(i32::MIN), 0, i64::from(i32::MAX)];
    let (low, high) = match rng.below(4) {
        0 => (ends[0], ends[2]),
        1 => (0, 1 << 16),
        2 => {
            let low = rng.range(ends[0], ends[2] - LEAST);
            (low, low + LEAST)
        }
        _ => {
            let range = rng.magnitude(ends[2]).max(LEAST);
            let low = rng.range(ends[0], ends[2] - range);
            (low, low + range)
        }
    };
    let mut values = [low, high, rng.range(low, high)];
    values.rotate_left(rng.below(3) as usize);
    values.map(|v| v as i32)
}
