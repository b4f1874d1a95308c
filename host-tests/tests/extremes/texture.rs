//! Textures of sides 1 to 1024, and coordinates in `[0, 1]`, far outside of it, negative, and at the ends of their type:
//! the texel that is shown is the one that the exact coordinates are in, or no farther from them than is stated.
//!
//! A texel's colour is its index, so that what is drawn says which was read.

use hither::{Affine, Correction, Hither, I16F16, Perspective, Rgb888, Texture, Textured, Tier};
use host_tests::accuracy::Reference;
use host_tests::oracle::{Rng, Space, Surface, Viewport, whole};
use host_tests::record::{clip_vertex, frame};
use host_tests::snapped;

use super::{Named, Packed8, Pieces16};

/// All powers of two, and others.
const SIDES: [u32; 24] = [
    1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 3, 5, 6, 7, 11, 60, 100, 240, 255, 257, 640, 1000,
    1023,
];

/// Where coordinates begin, raw: on a texture's corner, inside, many repeats away, at the type's ends.
const ORIGINS: [i32; 9] = [
    0,
    0,
    -1 << 16,
    5 << 15,
    -3001,
    100 << 16,
    -(100 << 16) - 77,
    i32::MAX - (1 << 17),
    i32::MIN + 5,
];

/// How far they go: once over a texture, parts and several of it, all of the type.
const RANGES: [i64; 7] = [1 << 16, 1 << 16, 1 << 14, 37, 3 << 16, 5 << 15, 1 << 32];

const VIEWPORT: Viewport = Viewport::new(96, 64);

fn texels() -> Vec<u32> {
    (0..1 << 20).collect()
}

/// A triangle and its texture.
#[derive(Debug)]
struct Case {
    corners: [[i64; 3]; 3],
    uv: [[i32; 2]; 3],
    sides: [u32; 2],
}

impl Case {
    fn new(sides: [u32; 2], ratio: i64, rng: &mut Rng) -> Self {
        // Around the screen, in thousandths of it.
        let corners = [[-1000, -1000], [1000, -1000], [0, 1000]].map(|at: [i64; 2]| {
            let [x, y] = at.map(|v| v + rng.range(-400, 400));
            let w = 1000 * rng.range(10, 10 * ratio);
            [x * w / 1000, y * w / 1000, w]
        });
        let range = rng.choose(&RANGES);
        let origin = [rng.choose(&ORIGINS), rng.choose(&ORIGINS)];
        let uv = [[0, 0], [range, 0], [rng.range(0, range), range]].map(|off| {
            [0, 1].map(|n| {
                let signed = if range % 3 == 0 { -off[n] } else { off[n] };
                (i64::from(origin[n]) + signed).clamp(i32::MIN.into(), i32::MAX.into()) as i32
            })
        });
        Self { corners, uv, sides }
    }

    /// Draws it; the rows that are shown, with the exact coordinates.
    fn rows<T: Tier, I: Correction>(&self, texels: &[u32], reference: Reference) -> Vec<Row> {
        let [width, height] = self.sides;
        let texels = &texels[..(width * height) as usize];
        let texture = Texture::<Rgb888>::try_new(texels, width, height).expect("a word a texel");
        let plane = Hither::new(I16F16::from_bits(1000)).expect("above 0");
        let mut frame = frame(VIEWPORT)
            .with_tier(T::default())
            .with_correction(I::default())
            .with_hither(plane);
        let vertices = [0, 1, 2].map(|i| {
            let [x, y, w] = self.corners[i];
            frame.snap(&clip_vertex([x, y, 0, w]), self.uv[i].map(I16F16::from_bits))
        });
        let [a, b, c] = &vertices;
        let _ = frame.draw_snapped([a, b, c], &Textured(texture));
        let snapped = vertices.map(|v| v.snapped());
        let points = snapped.map(|s| whole(snapped::in_pixels(s, VIEWPORT)));
        let scales = [0, 1, 2].map(|i| snapped::scale(snapped[i], self.corners[i][2]));
        let Some(surface) = Surface::from_rationals(&points, &scales, Space::Pixel, VIEWPORT)
        else {
            return Vec::new();
        };
        let w = [0, 1, 2].map(|i| &points[i][2] / &scales[i]);
        let values = [0, 1].map(|n| whole(self.uv.map(|uv| i64::from(uv[n]))));
        let perspective = values.each_ref().map(|u| surface.attribute(u));
        let affine = values.each_ref().map(|u| surface.affine(u, &w));
        let mut pixels = frame.into_parts().0.pixels;
        pixels.sort_by_key(|&(x, y, _)| (y, x));
        let of_row = |pixels: &[(u32, u32, Rgb888)]| Row {
            at: (pixels[0].0, pixels[0].1),
            shown: pixels.iter().map(|&(.., Rgb888(at))| [at % width, at / width]).collect(),
            exact: [0, 1].map(|n| {
                let at = |&(x, y, _): &(u32, u32, Rgb888)| match reference {
                    Reference::Perspective => perspective[n].at(x, y),
                    Reference::Affine => affine[n].at(x, y),
                };
                pixels.iter().map(at).collect()
            }),
        };
        pixels.chunk_by(|a, b| a.1 == b.1).map(of_row).collect()
    }

    /// What a coordinate goes over, raw.
    fn range(&self, n: usize) -> f64 {
        let values = self.uv.map(|uv| f64::from(uv[n]));
        values.iter().fold(f64::MIN, |a, &b| a.max(b))
            - values.iter().fold(f64::MAX, |a, &b| a.min(b))
    }
}

/// A row of pixels: the texels that are shown, and exact coordinates, raw.
struct Row {
    at: (u32, u32),
    shown: Vec<[u32; 2]>,
    exact: [Vec<f64>; 2],
}

/// How far from an exact value at `i` a straight line between two others can be, of which the second is `length` pixels
/// further or the last: the largest of all such lines over `i`.
fn chord(values: &[f64], i: usize, length: usize) -> f64 {
    let off = |from: usize| {
        let to = (from + length).min(values.len() - 1);
        let part = (i - from) as f64 / (to - from).max(1) as f64;
        (values[from] + (values[to] - values[from]) * part - values[i]).abs()
    };
    (i.saturating_sub(length)..=i).map(off).fold(0.0, f64::max)
}

/// What a correction states: how far a coordinate may be at pixel `i` of a row, raw, beside a part in 1024 of its range
/// and two raw steps for its rounding and for the margin at the type's ends. `None` where it states nothing.
type Stated = fn(&[f64], usize) -> Option<f64>;

fn divided(_: &[f64], _: usize) -> Option<f64> {
    Some(0.0)
}

/// A piece of 16 pixels, or one line that is at most 2^-9 off.
fn pieces(values: &[f64], i: usize) -> Option<f64> {
    Some(chord(values, i, 16).max(128.0))
}

/// A line that bends every 8 pixels and is 32 long, with 64 raw steps that are lost on the way; of coordinates that
/// change by more than two a pixel nothing is said.
fn packed(values: &[f64], i: usize) -> Option<f64> {
    let near = values.iter().skip(i.saturating_sub(32)).take(65);
    let least = near.clone().fold(f64::MAX, |a, &b| a.min(b));
    let most = near.fold(f64::MIN, |a, &b| a.max(b));
    let off = (chord(values, i, 8) + chord(values, i, 32) / 4.0).max(128.0) + 64.0;
    (most - least <= 262_144.0).then_some(off)
}

/// How far a coordinate is from the texels of a side that have an index, raw; all repeat.
fn outside(value: f64, index: u32, side: u32) -> f64 {
    let side = f64::from(side);
    let first = f64::from(index) * 65_536.0 / side;
    let past = (value - first).rem_euclid(65_536.0);
    let width = 65_536.0 / side;
    if past <= width { 0.0 } else { (past - width).min(65_536.0 - past) }
}

/// Draws one texture with one correction; how many pixels were there, and of how many the bound leaves one texel.
fn compare<T: Tier, I: Correction>(
    case: &Case,
    texels: &[u32],
    reference: Reference,
    stated: Stated,
) -> [usize; 2] {
    let mut seen = [0; 2];
    for row in case.rows::<T, I>(texels, reference) {
        for (i, shown) in row.shown.iter().enumerate() {
            for n in 0..2 {
                let value = row.exact[n][i];
                let Some(stated) = stated(&row.exact[n], i) else { continue };
                // The row of texels is read with a part of u below it: less than a raw step.
                let bound = stated + case.range(n) / 1024.0 + 2.0 + n as f64;
                let off = outside(value, shown[n], case.sides[n]);
                assert!(
                    off <= bound,
                    "{:?} {i} from {:?}: texel {shown:?} is {off} from {value} [{n}], more than {bound}, of {case:?}",
                    I::default(),
                    row.at
                );
                seen[0] += 1;
                let texel = 65_536.0 / f64::from(case.sides[n]);
                let from = value.rem_euclid(texel);
                seen[1] += usize::from(from > bound && from < texel - bound);
            }
        }
    }
    seen
}

fn check<T: Named>() {
    let (mut rng, texels) = (Rng::new(32 + u64::from(T::SUBPIXEL_BITS)), texels());
    let mut seen = [[0; 2]; 4];
    for width in SIDES {
        for height in SIDES {
            let ratio = rng.choose(&[1, 2, 8]);
            let case = Case::new([width, height], ratio, &mut rng);
            let (near, flat) = (Reference::Perspective, Reference::Affine);
            let of_each = [
                compare::<T, Perspective>(&case, &texels, near, divided),
                compare::<T, Affine>(&case, &texels, flat, divided),
                compare::<T, Pieces16>(&case, &texels, near, pieces),
                compare::<T, Packed8>(&case, &texels, near, packed),
            ];
            for (seen, of_one) in seen.iter_mut().flatten().zip(of_each.as_flattened()) {
                *seen += of_one;
            }
        }
    }
    println!("coordinates, and those of which the bound leaves one texel: {seen:?}");
    assert!(seen.iter().all(|[all, one]| *one > all / 4 && *all > 500_000), "{seen:?}");
}

/// Every texel of every side from its first coordinate to its last, by the coordinates themselves.
#[test]
fn texels_are_those_of_their_coordinates() {
    let texels = texels();
    let mut rng = Rng::new(33);
    for width in SIDES {
        for height in SIDES {
            let of_texture = &texels[..(width * height) as usize];
            let texture =
                Texture::<Rgb888>::try_new(of_texture, width, height).expect("a word a texel");
            for _ in 0..200 {
                let uv = [width, height].map(|side| {
                    let texel = rng.range(0, i64::from(side)) * 65_536 / i64::from(side);
                    let repeat = rng.choose(&[0, 0, -1, 1, 77, -32_768, 32_767, -12_345]) << 16;
                    let near = texel + repeat + rng.range(-2, 2);
                    near.clamp(i32::MIN.into(), i32::MAX.into()) as i32
                });
                let Rgb888(at) = texture
                    .nearest(I16F16::from_bits(uv[0]), I16F16::from_bits(uv[1]))
                    .expect("a texel");
                let [u, v] = uv.map(|c| c.rem_euclid(1 << 16) as u32);
                assert_eq!(at % width, (u * width) >> 16, "{uv:?} of {width} x {height}");
                // With what u adds below v, which is less than a step of it.
                let row = ((v << 16 | u) as u64 * u64::from(height)) >> 32;
                assert_eq!(u64::from(at / width), row, "{uv:?} of {width} x {height}");
            }
        }
    }
}

in_every_tier! {
    texels_shown_are_as_near_as_stated => check;
}
