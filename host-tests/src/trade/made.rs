//! Points that were made up, for tests.

use super::{Cost, Errors, Picture, Point, Stat};

/// A sequence that looks random: Knuth's MMIX generator, its upper bits.
#[derive(Clone, Copy, Debug)]
struct Random(u64);

impl Random {
    fn below(&mut self, end: u64) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % end
    }
}

/// A point whose costs and errors are all these, on `m4f` alone.
pub(super) fn at(cost: f64, error: f64) -> Point {
    let stat = Stat { max: 3.0 * error, rms: error };
    Point {
        name: format!("c{cost} e{error}"),
        knobs: vec![("snap", "quick8")],
        preset: None,
        costs: vec![Cost {
            isa: "m4f",
            textured_pixel: cost,
            shaded_pixel: cost,
            triangle: cost,
            scenes: (cost * 1e3) as u64,
            flash: None,
        }],
        errors: Errors {
            coverage_ppm: error,
            gaps: 0,
            doubles: 0,
            position: stat,
            depth: Some(stat),
            texel: stat,
            color: stat,
            banding: error,
            psnr: 60.0 - error,
        },
        pictures: Vec::new(),
    }
}

/// Points with few different numbers, so that many are equal in one or both.
pub(super) fn coarse(seed: u64, count: usize) -> Vec<Point> {
    let mut random = Random(seed);
    let mut points: Vec<Point> = Vec::new();
    for _ in 0..count {
        let mut point = at(random.below(9) as f64, random.below(9) as f64);
        if random.below(5) == 0 {
            point.errors.depth = None;
        }
        points.push(point);
    }
    points
}

/// Choices of knobs with what they might cost and err.
const SNAPS: [(&str, f64, f64); 3] =
    [("exact", 240.0, 0.002), ("quick4", 150.0, 0.03), ("quick8", 160.0, 0.0018)];
const PERSPECTIVES: [(&str, f64, f64); 5] = [
    ("affine", 1.0, 6.0),
    ("every32", 2.0, 0.9),
    ("every16", 3.1, 0.24),
    ("every8", 5.0, 0.06),
    ("pixel", 21.0, 0.004),
];
const RECIPROCALS: [(&str, f64, f64); 4] =
    [("table", 0.2, 0.02), ("newton1", 0.6, 0.0003), ("newton2", 1.1, 0.0), ("float", 0.8, 0.0)];
const DEPTHS: [(&str, f64, Option<f64>); 3] =
    [("nodepth", 0.0, None), ("depth16", 2.1, Some(0.31)), ("depth32", 2.8, Some(0.0))];
const DITHERS: [(&str, f64, f64); 2] = [("plain", 0.0, 0.29), ("dither", 1.4, 0.06)];

/// Points as a run might have them, on `m4f` and `m0`, three of them presets, with two small pictures each.
pub(super) fn points(count: usize) -> Vec<Point> {
    let mut random = Random(7);
    let mut pick = |choices: usize| random.below(choices as u64) as usize;
    let mut points: Vec<Point> = Vec::new();
    while points.len() < count {
        let choice = [pick(3), pick(5), pick(4), pick(3), pick(2)];
        let mut point = chosen(choice);
        let known = points.iter().any(|other| other.name == point.name);
        point.preset = match points.len() {
            3 => Some("Fastest"),
            11 => Some("Balanced"),
            17 => Some("Faithful"),
            _ => None,
        };
        if !known {
            points.push(point);
        }
    }
    points
}

fn chosen([snap, perspective, reciprocal, depth, dither]: [usize; 5]) -> Point {
    let (snap, triangle, position) = SNAPS[snap];
    let (perspective, pixel, bend) = PERSPECTIVES[perspective];
    let (reciprocal, divide, off) = RECIPROCALS[reciprocal];
    let (depth, buffer, depth_error) = DEPTHS[depth];
    let (dither, pattern, banding) = DITHERS[dither];
    let stat = |rms: f64| Stat { max: 4.0 * rms, rms };
    let cost = |isa, slower: f64| Cost {
        isa,
        textured_pixel: slower * (6.0 + pixel + divide * pixel / 5.0 + buffer + pattern),
        shaded_pixel: slower * (5.0 + buffer + pattern),
        triangle: slower * (triangle + 9.0 * (divide + buffer)),
        scenes: (slower * 1e5 * (12.0 + pixel + divide + buffer + triangle / 20.0)) as u64,
        flash: Some((slower * 9000.0) as u64),
    };
    let texel = (bend * bend + off * off + position * position).sqrt();
    Point {
        name: [snap, perspective, reciprocal, depth, dither].join(" "),
        knobs: vec![
            ("snap", snap),
            ("perspective", perspective),
            ("reciprocal", reciprocal),
            ("depth", depth),
            ("dither", dither),
        ],
        preset: None,
        costs: vec![cost("m4f", 1.0), cost("m0", 2.6)],
        errors: Errors {
            coverage_ppm: if snap == "exact" { 0.0 } else { 4e4 * position },
            gaps: 0,
            doubles: 0,
            position: stat(position),
            depth: depth_error.map(stat),
            texel: stat(texel),
            color: stat(banding),
            banding,
            psnr: if texel < 0.005 { f64::INFINITY } else { 38.0 - 8.0 * texel.log10() },
        },
        pictures: ["floor", "wall & <door>"].map(|scene| picture(scene, texel, dither)).to_vec(),
    }
}

/// Rings that an error moves, in RGB565.
fn picture(scene: &'static str, error: f64, dither: &str) -> Picture {
    let (width, height) = (160, 120);
    let draw = |moved: f64, noise: bool| -> Vec<u8> {
        let pixel = |index: u32| {
            let (x, y) = (index % width, index / width);
            let distance = f64::from(x).hypot(f64::from(y)) + moved * f64::from(x % 16) / 4.0;
            let grain = if noise { f64::from(8 * ((x ^ y) & 1)) } else { 0.0 };
            let level = |turn: f64| 118.0 + 110.0 * (distance / 9.0 + turn).sin() + grain;
            [level(0.0) as u8 & 0xf8, level(1.0) as u8 & 0xfc, level(2.0) as u8 & 0xf8]
        };
        (0..width * height).flat_map(pixel).collect()
    };
    let (drawn, ideal) = (draw(error, dither == "dither"), draw(0.0, false));
    let psnr = if drawn == ideal { f64::INFINITY } else { 38.0 - 8.0 * error.log10() };
    Picture { scene, width, height, drawn, ideal, psnr }
}
