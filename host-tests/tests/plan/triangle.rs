//! Triangles: texture coordinates, colours and depths, against the surface through the snapped vertices.

use hither::{
    Always, ClipVertex, DepthBuffer, DepthWord, Fragment, Frame, Gouraud, Hither, I16F16, Preset,
    Rgb565, Sample, Scene, Vertex,
};
use host_tests::oracle::{Rng, Viewport};
use host_tests::record::Record;
use host_tests::snapped;

use crate::EVALUATIONS;
use crate::Found;
use crate::climb::{climb, seed_of_run};

/// The guard band but for its last pixels to triangles.
const REACH: f64 = 1000.0;

/// Shows the fractions of texture coordinates, in a word where a texture would take one.
#[derive(Clone, Copy)]
struct Texel;

impl Fragment<[u16; 2], 2> for Texel {
    const WRAPS: bool = true;

    fn shade(&self, sample: Sample<2>) -> [u16; 2] {
        sample.varyings.map(|v| v.to_bits() as u16)
    }

    fn shade_lanes(&self, word: u32, _: i32, _: i32) -> Option<[u16; 2]> {
        Some([word as u16, (word >> 16) as u16])
    }
}

/// A vertex: its place in pixels, `w`, `z / w`, texture coordinates and colour.
#[derive(Clone, Copy, Debug)]
struct Corner {
    at: [f64; 2],
    w: f64,
    depth: f64,
    uv: [f64; 2],
    color: [f64; 3],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unit {
    Texels,
    Colors,
    Depth,
}

/// Adds the largest errors to what was found.
pub fn search<P: Preset>(scene: &Scene, found: &mut Found)
where
    P::Depth: Into<u64>,
{
    let mut depths = vec![P::Depth::FAR; (scene.width * scene.height) as usize];
    for unit in [Unit::Texels, Unit::Colors, Unit::Depth] {
        let unwanted = match unit {
            Unit::Texels => scene.texture == 0,
            Unit::Colors => !scene.colors,
            Unit::Depth => false,
        };
        if unwanted {
            continue;
        }
        let mut rng = Rng::new(5 + unit as u64 + seed_of_run());
        let largest = match unit {
            Unit::Texels => &mut found.texels,
            Unit::Colors => &mut found.color_steps,
            Unit::Depth => &mut found.depth_steps,
        };
        climb(
            &mut rng,
            EVALUATIONS,
            |rng, i| seed(scene, rng, i),
            |rng, corners| change(scene, rng, corners),
            |corners| {
                let off = off::<P>(corners, scene, unit, &mut depths)?;
                if off > *largest {
                    *largest = off;
                    if std::env::var("HITHER_SHOW").is_ok() {
                        println!("{unit:?} {off:.4}: {corners:?}");
                    }
                }
                Some(off)
            },
        );
    }
}

/// Triangles of all sizes, as deep as they may be, some a few pixels wide, some very thin, attributes at their ends.
fn seed(scene: &Scene, rng: &mut Rng, i: u32) -> [Corner; 3] {
    if i % 3 == 0 {
        return along_a_row(scene, rng);
    }
    if i % 6 == 5 {
        return along_a_column(scene, rng);
    }
    let (width, height) = (f64::from(scene.width), f64::from(scene.height));
    let middle = [rng.between(0.0, width), rng.between(0.0, height)];
    let [across, down] = match i % 4 {
        0 => [width, height],
        1 => [rng.between(2.0, 60.0), height],
        2 => [rng.between(1.0, 2000.0), rng.between(1.0, 2000.0)],
        _ => [rng.between(4.0, 40.0), rng.between(4.0, 40.0)],
    };
    let near = f64::from(scene.near);
    let far = f64::from(scene.far).min(near + f64::from(scene.deep));
    let start = if i % 5 == 0 { f64::from(scene.far) - (far - near) } else { near };
    // Along a row alone: two vertices in one column, or in each.
    let end = rng.below(3) as usize;
    let mut corners = [0, 1, 2].map(|k| {
        let last = k == end;
        let place = |middle: f64, size: f64, rng: &mut Rng| middle + rng.between(-size, size) / 2.0;
        let mut at = [place(middle[0], across, rng), place(middle[1], down, rng)];
        if i % 4 == 1 || i % 4 == 3 {
            at[0] = middle[0] + if last { across } else { 0.0 };
        }
        let w = match i % 3 {
            0 => rng.between(start, start + far - near),
            _ if last => start + far - near,
            _ => start,
        };
        let end = if last { 1.0 } else { 0.0 };
        let depth = if rng.once_in(2) { rng.fraction() } else { end };
        let repeats = f64::from(scene.repeats);
        let uv = [0; 2].map(|_| match i % 2 {
            0 => repeats * end,
            _ => repeats * rng.fraction(),
        });
        let color = [0; 3].map(|_| if i % 2 == 0 { end } else { rng.fraction() });
        Corner { at: at.map(|at| at.clamp(-REACH, REACH)), w, depth, uv, color }
    });
    if i % 6 == 1 {
        // From end to end of the guard band, and next to the limit of what has a plane.
        corners[0].at = [-REACH, -REACH];
        let at = rng.between(0.2, 1.0) * REACH;
        corners[1].at = if rng.once_in(2) { [at, REACH] } else { [REACH, at] };
    }
    if i % 7 < 3 || i % 6 == 1 {
        // Thin, so that gradients have few bits.
        let [a, b, _] = corners.map(|c| c.at);
        let along = rng.between(-0.2, 1.2);
        let by = 2f64.powf(-rng.between(2.0, 11.0)) * if rng.once_in(2) { 1.0 } else { -1.0 };
        let [right, down] = [b[0] - a[0], b[1] - a[1]];
        corners[2].at = [a[0] + right * along - down * by, a[1] + down * along + right * by];
    }
    corners
}

/// A triangle along some pixels of a row, over which everything changes; thin, or as high as it is long. The third vertex is
/// in line with the other two, on the screen and in depth.
fn along_a_row(scene: &Scene, rng: &mut Rng) -> [Corner; 3] {
    let (near, far) = (f64::from(scene.near), f64::from(scene.far));
    let most = far.min(near + f64::from(scene.deep));
    let run = rng.between(4.0, 48.0);
    let last = (near * (1.0 + 0.97 * run * f64::from(scene.tilt))).min(most);
    let start = [rng.between(0.0, f64::from(scene.width) - run), rng.between(8.0, 100.0)];
    let way = if rng.once_in(2) { 1.0 } else { -1.0 };
    let [height, along] = if rng.once_in(2) {
        [rng.between(0.2, 3.0), rng.between(-4.0, 5.0)]
    } else {
        [rng.between(2.0, run), rng.between(0.0, 1.0)]
    };
    let corner = |part: f64, down: f64| {
        let q = (1.0 - part) / near + part / last;
        let (w, part) = ((1.0 / q).clamp(near, most), part.clamp(0.0, 1.0));
        let across = if way > 0.0 { part * run } else { run - part * run };
        Corner {
            at: [start[0] + across, start[1] + down],
            w,
            depth: part,
            uv: [f64::from(scene.repeats) * part; 2],
            color: [part; 3],
        }
    };
    let mut corners = [corner(0.0, 0.0), corner(1.0, height), corner(along, height / 2.0)];
    corners[2].at[0] = start[0] + if way > 0.0 { along * run } else { run - along * run };
    corners[2].at[0] = corners[2].at[0].clamp(-REACH, REACH);
    if along.clamp(0.0, 1.0) == along {
        corners[2].at[1] += height;
    }
    corners
}

/// A thin triangle from the top to the bottom of the screen, up to 16 times as far away at its other end: the most that has
/// planes.
fn along_a_column(scene: &Scene, rng: &mut Rng) -> [Corner; 3] {
    let near = f64::from(scene.near);
    let far = f64::from(scene.far).min(near + f64::from(scene.deep)).min(15.9 * near);
    let (width, height) = (f64::from(scene.width), f64::from(scene.height));
    let column = rng.between(0.1, 0.8) * width;
    let thin = height * 2f64.powf(-rng.between(2.0, 9.0));
    let lean = rng.between(0.0, 0.1) * width;
    let repeats = f64::from(scene.repeats);
    let (down, up) = if rng.once_in(2) { (0.0, 1.0) } else { (1.0, 0.0) };
    let ends = [(0.0, 0.0), (1.0, 0.0), (rng.between(0.5, 1.0), thin)];
    let mut corners = ends.map(|(part, aside)| {
        let w = if part > 0.4 { far } else { near };
        let at = [column + lean * part + aside, (down + (up - down) * part) * (height - 1.0) + 0.5];
        Corner { at, w, depth: part, uv: [repeats * part; 2], color: [part; 3] }
    });
    corners.rotate_left(rng.below(3) as usize);
    corners
}

fn change(scene: &Scene, rng: &mut Rng, corners: &mut [Corner; 3]) {
    let size = 10f64.powf(-rng.between(0.0, 4.0));
    let by = rng.between(-size, size);
    let k = rng.below(3) as usize;
    let near = f64::from(scene.near);
    let reach = f64::from(scene.far).min(near + f64::from(scene.deep)) - near;
    match rng.below(12) {
        0 => {
            // All together.
            for corner in corners.iter_mut() {
                corner.at[0] += 40.0 * by;
            }
        }
        1 => {
            for corner in corners.iter_mut() {
                corner.at[1] += 40.0 * by;
            }
        }
        2..=5 => corners[k].at[rng.below(2) as usize] += 100.0 * by,
        6 | 7 => corners[k].w = (corners[k].w + by * reach).clamp(near, f64::from(scene.far)),
        8 => corners[k].depth = (corners[k].depth + by).clamp(0.0, 1.0),
        9 | 10 => {
            let limit = f64::from(scene.coordinate);
            let uv = &mut corners[k].uv[rng.below(2) as usize];
            *uv = (*uv + by * f64::from(scene.repeats)).clamp(-limit, limit);
        }
        _ => {
            let channel = &mut corners[k].color[rng.below(3) as usize];
            *channel = (*channel + by).clamp(0.0, 1.0);
        }
    }
    if rng.once_in(3) {
        let channel = &mut corners[k].color[rng.below(3) as usize];
        *channel = (*channel + rng.between(-size, size)).clamp(0.0, 1.0);
    }
}

/// Raw Q16.16.
fn raw(v: f64) -> i64 {
    (v * 65_536.0).round() as i64
}

/// The clip vertex, raw; none where it is out of bounds.
fn clip(corner: &Corner, scene: &Scene) -> Option<[i64; 4]> {
    let (width, height) = (f64::from(scene.width), f64::from(scene.height));
    let w = raw(corner.w);
    let ranged = w >= raw(f64::from(scene.near)) && w <= raw(f64::from(scene.far));
    let [x, y] = corner.at;
    let inside = x.abs() <= REACH && y.abs() <= REACH;
    let unit = w as f64;
    let at = [(2.0 * x / width - 1.0) * unit, (1.0 - 2.0 * y / height) * unit];
    let [x, y] = at.map(|v| v.round() as i64);
    let z = ((corner.depth * unit).round() as i64).min(w);
    let fits = x.abs() < 1 << 31 && y.abs() < 1 << 31;
    (ranged && inside && fits).then_some([x, y, z, w])
}

/// The surface through the snapped vertices: `E_i` at the centre of pixel (0, 0), a column and a row on.
struct Surface {
    edges: [[f64; 3]; 3],
    /// `k_i`, raw.
    scale: [f64; 3],
    determinant: f64,
}

impl Surface {
    fn new(snapped: [hither::Snapped; 3], w: [i64; 3], viewport: Viewport) -> Option<Self> {
        let [p, q, r] = snapped.map(|s| snapped::in_pixels(s, viewport).map(|v| v as f64));
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let edges = [cross(q, r), cross(r, p), cross(p, q)];
        let determinant = (0..3).map(|i| edges[0][i] * p[i]).sum::<f64>();
        let scale = [0, 1, 2].map(|i| match snapped[i] {
            hither::Snapped::Homogeneous { shift, .. } => f64::from(shift + 1).exp2(),
            hither::Snapped::Projected { subpixel_bits, .. } => {
                f64::from(subpixel_bits).exp2() / w[i] as f64
            }
        });
        (determinant != 0.0).then_some(Self { edges, scale, determinant })
    }

    /// `k_i E_i / D` at a pixel: their sum is `1 / w`.
    fn weights(&self, x: u32, y: u32) -> [f64; 3] {
        let at = [f64::from(x) + 0.5, f64::from(y) + 0.5, 1.0];
        [0, 1, 2].map(|i| {
            let edge = (0..3).map(|k| self.edges[i][k] * at[k]).sum::<f64>();
            edge * self.scale[i] / self.determinant
        })
    }

    /// What `1 / w` changes by along a row.
    fn across(&self) -> f64 {
        (0..3).map(|i| self.edges[i][0] * self.scale[i] / self.determinant).sum()
    }
}

/// The largest error over a triangle's pixels in a unit; none where it is out of bounds.
fn off<P: Preset>(
    corners: &[Corner; 3],
    scene: &Scene,
    unit: Unit,
    depths: &mut [P::Depth],
) -> Option<f64>
where
    P::Depth: Into<u64>,
{
    let mut clips = [[0; 4]; 3];
    for (raw, corner) in clips.iter_mut().zip(corners) {
        *raw = clip(corner, scene)?;
    }
    let w = clips.map(|c| c[3]);
    let deep = w.iter().max()? - w.iter().min()?;
    if deep as f64 > f64::from(scene.deep) * 65_536.0 {
        return None;
    }
    let hither = Hither::new(I16F16::from_num(scene.near)).expect("above 0");
    let (width, height) = (scene.width, scene.height);
    let viewport = Viewport::new(width, height);
    let vertex = clips.map(|c| {
        let [x, y, z, w] = c.map(|v| I16F16::from_bits(v as i32));
        ClipVertex::new(x, y, z, w)
    });
    let mut worst = 0.0f64;
    match unit {
        Unit::Texels => {
            let target = Record::<[u16; 2]>::new(width, height);
            let frame = Frame::new(target).expect("a viewport").with_preset(P::default());
            let mut frame = frame.with_hither(hither);
            let uv = corners.map(|c| c.uv.map(|v| raw(v) as i32));
            for k in 0..2 {
                let values = uv.map(|uv| i64::from(uv[k]));
                let change = values.iter().max()? - values.iter().min()?;
                let largest = values.iter().map(|v| v.abs()).max()?;
                if change > raw(f64::from(scene.repeats))
                    || largest > raw(f64::from(scene.coordinate))
                {
                    return None;
                }
            }
            let snapped: [Vertex<P::Tier, 2>; 3] =
                [0, 1, 2].map(|i| frame.snap(&vertex[i], uv[i].map(I16F16::from_bits)));
            let surface = Surface::new(snapped.map(|v| v.snapped()), w, viewport)?;
            let [a, b, c] = &snapped;
            frame.draw_snapped([a, b, c], &Texel);
            let (record, _) = frame.into_parts();
            let across = surface.across().abs();
            for (x, y, got) in record.pixels {
                let weights = surface.weights(x, y);
                let q: f64 = weights.iter().sum();
                if across > f64::from(scene.tilt) * q {
                    return None;
                }
                for k in 0..2 {
                    let n: f64 = (0..3).map(|i| weights[i] * f64::from(uv[i][k])).sum();
                    let off = (f64::from(got[k]) - n / q).rem_euclid(65_536.0);
                    worst = worst.max(off.min(65_536.0 - off));
                }
            }
            worst *= f64::from(scene.texture) / 65_536.0;
        }
        Unit::Colors => {
            let target = Record::<Rgb565>::new(width, height);
            let frame = Frame::new(target).expect("a viewport").with_preset(P::default());
            let mut frame = frame.with_hither(hither);
            let color = corners.map(|c| c.color.map(|v| raw(v) as i32));
            let snapped: [Vertex<P::Tier, 3>; 3] =
                [0, 1, 2].map(|i| frame.snap(&vertex[i], color[i].map(I16F16::from_bits)));
            let surface = Surface::new(snapped.map(|v| v.snapped()), w, viewport)?;
            let [a, b, c] = &snapped;
            frame.draw_snapped([a, b, c], &Gouraud);
            let (record, _) = frame.into_parts();
            let across = surface.across().abs();
            for (x, y, got) in record.pixels {
                let weights = surface.weights(x, y);
                let q: f64 = weights.iter().sum();
                if across > f64::from(scene.tilt) * q {
                    return None;
                }
                let channels = [(got.r(), 31.0), (got.g(), 63.0), (got.b(), 31.0)];
                for (k, (got, steps)) in channels.into_iter().enumerate() {
                    let n: f64 = (0..3).map(|i| weights[i] * f64::from(color[i][k])).sum();
                    worst = worst.max((f64::from(got) - n / q / 65_536.0 * steps).abs());
                }
            }
        }
        Unit::Depth => {
            let target = Record::<()>::new(width, height);
            let buffer = DepthBuffer::try_new(depths, width, height).expect("a word a pixel");
            let frame = Frame::new(target).expect("a viewport").with_preset(P::default());
            let frame = frame.with_hither(hither).with_depth(buffer.with_compare(Always));
            let mut frame = frame.expect("the same size");
            let snapped: [Vertex<P::Tier>; 3] = [0, 1, 2].map(|i| frame.snap(&vertex[i], []));
            let surface = Surface::new(snapped.map(|v| v.snapped()), w, viewport)?;
            let [a, b, c] = &snapped;
            frame.draw_snapped([a, b, c], &host_tests::record::Mark);
            let (record, stored) = frame.into_parts();
            let far: u64 = P::Depth::FAR.into();
            let far = far as f64;
            for (x, y, ()) in record.pixels {
                let weights = surface.weights(x, y);
                let depth: f64 = (0..3).map(|i| weights[i] * clips[i][2] as f64).sum();
                let got: u64 = stored.words()[(y * width + x) as usize].into();
                let off = (got as f64 - depth * far).abs() * 65_535.0 / far;
                worst = worst.max(off);
            }
        }
    }
    Some(worst)
}
