//! How far off each workload's picture is, against references of its own: integers for coverage, `f64` for the rest.

use super::torus;
use crate::oracle::Viewport;
use crate::record::{Mark, Record};
use crate::snapped::on_screen;
use hither::{Always, ClipVertex, Cull, DepthBuffer, Exact, Flat, Frame, Quick, Rgb565, Vertex};
use hither_scenes::torus as scene;
use hither_scenes::workloads::{
    Buffers, CACHE, COLORS, COORDINATES, Corner, DEPTH_ONE, HITHER, PIXELS, Preset, SIDE, SNAPPED,
    TEXTURE_SIDE, TRIANGLES, Workload, corners, draw, texel_of, to_be_snapped,
};

/// How far off a picture is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The largest; the number of them, for pixels that are wrong.
    pub max: f64,
    /// The mean over what was compared; the share of them, for pixels that are wrong.
    pub mean: f64,
    /// In what.
    pub unit: &'static str,
}

/// What the host knows of a workload in a tier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// What was drawn.
    pub workload: Workload,
    /// The tier's name.
    pub tier: &'static str,
    /// Checksum of what the host draws.
    pub sum: u32,
    /// Pixels that are covered, before depth.
    pub pixels: usize,
    /// How far off they are.
    pub deviation: Deviation,
}

/// Workloads in all tiers.
///
/// # Panics
///
/// Where a workload cannot be drawn.
#[must_use]
pub fn references(workloads: &[Workload]) -> Vec<Reference> {
    let mut all = Vec::new();
    all.extend(workloads.iter().copied().map(reference::<Exact>));
    all.extend(workloads.iter().copied().map(reference::<Quick<4>>));
    all.extend(workloads.iter().copied().map(reference::<Quick<8>>));
    all
}

/// One workload in one tier.
fn reference<T: Preset>(workload: Workload) -> Reference {
    let picture = Picture::draw::<T>(workload);
    let pixels = covered::<T>(workload).iter().map(Vec::len).sum();
    let deviation = match workload {
        Workload::W1 | Workload::W2 | Workload::W3 => coverage::<T>(workload),
        Workload::W1z | Workload::W2z | Workload::W3z => depth::<T>(workload),
        Workload::W4 => colour(&picture),
        Workload::W5 => texel(&picture),
        Workload::W6f => faces(&picture),
        Workload::W6g => torus_colour(&picture),
        Workload::Snap => snap::<T>(),
    };
    Reference { workload, tier: T::NAME, sum: picture.sum, pixels, deviation }
}

/// What the host draws.
struct Picture {
    color: Vec<u16>,
    sum: u32,
}

impl Picture {
    fn draw<T: Preset>(workload: Workload) -> Self {
        let words = || -> Box<[u16; PIXELS]> {
            vec![0; PIXELS].into_boxed_slice().try_into().expect("as many words as pixels")
        };
        let (mut color, mut depth) = (words(), words());
        let mut triangles = vec![[Vertex::<T>::EMPTY; 3]; TRIANGLES];
        let mut cache = vec![Vertex::<T, 3>::EMPTY; CACHE];
        let mut buffers = Buffers { color: &mut color, depth: &mut depth };
        let drawn = draw(workload, &mut buffers, &mut triangles, &mut cache, || 0);
        let (_, sum) = drawn.expect("the workloads' numbers are constants in range");
        Self { color: color.to_vec(), sum }
    }

    /// Every pixel that is not background: column, row and colour.
    fn pixels(&self) -> impl Iterator<Item = (u32, u32, Rgb565)> + '_ {
        let place = |at: usize| (at as u32 % SIDE, at as u32 / SIDE);
        let drawn = self.color.iter().enumerate().filter(|(_, word)| **word != 0);
        drawn.map(move |(at, word)| (place(at).0, place(at).1, Rgb565(*word)))
    }
}

/// The triangles of W1 to W5.
fn triangles(workload: Workload) -> Vec<[Corner; 3]> {
    let mut all = Vec::new();
    corners(workload, |_, corners| all.push(corners));
    all
}

/// What a tier covers of each triangle, before depth; of W6's all in one.
fn covered<T: Preset>(workload: Workload) -> Vec<Vec<(u32, u32)>> {
    let frame = Frame::new(Record::new(SIDE, SIDE)).expect("240 x 240").with_tier(T::default());
    let places = |record: &mut Record<()>| {
        record.pixels.drain(..).map(|(x, y, ())| (x, y)).collect::<Vec<_>>()
    };
    if matches!(workload, Workload::W6f | Workload::W6g) {
        let mut frame = frame.with_hither(scene::HITHER).with_cull(Cull::Back);
        let mut cache = vec![Vertex::EMPTY; CACHE];
        let transform = scene::transform().expect("constants in range");
        frame.draw(&scene::BARE_TORUS, &transform, &Mark, &mut cache);
        return vec![places(frame.target_mut())];
    }
    let mut frame = frame.with_hither(HITHER).with_cull(Cull::Back);
    let cover = |corners: [Corner; 3]| {
        frame.draw_triangle(corners.map(|corner| (corner.clip(), [])), &Mark);
        places(frame.target_mut())
    };
    triangles(workload).into_iter().map(cover).collect()
}

/// Pixels that are covered and should not be, or the other way round.
fn coverage<T: Preset>(workload: Workload) -> Deviation {
    let (mut wrong, mut right) = (0, 0);
    for (corners, mut drawn) in triangles(workload).into_iter().zip(covered::<T>(workload)) {
        let mut exact = exactly_covered(corners);
        right += exact.len();
        drawn.sort_unstable();
        exact.sort_unstable();
        wrong += drawn.iter().filter(|pixel| exact.binary_search(pixel).is_err()).count();
        wrong += exact.iter().filter(|pixel| drawn.binary_search(pixel).is_err()).count();
    }
    Deviation { max: wrong as f64, mean: wrong as f64 / right as f64, unit: "wrong pixels" }
}

/// The pixels of a triangle by the top-left rule, each decided by itself in integers. Units are half pixels.
fn exactly_covered(corners: [Corner; 3]) -> Vec<(u32, u32)> {
    let [a, b, c] = corners.map(|corner| (2 * corner.x, 2 * corner.y));
    let edge = |(px, py): (i32, i32), (qx, qy): (i32, i32)| (py - qy, qx - px, px * qy - py * qx);
    let edges = [edge(b, c), edge(c, a), edge(a, b)];
    let at = |(a, b, c): (i32, i32, i32), (x, y): (i32, i32)| a * x + b * y + c;
    let sign = at(edges[0], a).signum();
    let inside = |x: u32, y: u32| {
        let centre = (2 * x as i32 + 1, 2 * y as i32 + 1);
        edges.iter().all(|&edge| {
            let (value, a, b) = (sign * at(edge, centre), sign * edge.0, sign * edge.1);
            value > 0 || (value == 0 && (a > 0 || (a == 0 && b > 0)))
        })
    };
    let rows = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    rows.filter(|&(x, y)| inside(x, y)).collect()
}

/// What is linear on the screen between three corners, at the centre of a pixel.
fn linear(corners: &[Corner; 3], values: [f64; 3], (x, y): (u32, u32)) -> f64 {
    let [a, b, c] = corners.map(|corner| (f64::from(corner.x), f64::from(corner.y)));
    let point = (f64::from(x) + 0.5, f64::from(y) + 0.5);
    let area = |p: (f64, f64), q: (f64, f64), r: (f64, f64)| {
        (q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0)
    };
    let weights = [area(point, b, c), area(a, point, c), area(a, b, point)];
    let sum: f64 = weights.iter().zip(values).map(|(weight, value)| weight * value).sum();
    sum / area(a, b, c)
}

/// A value that is perspective-correct between three corners.
fn perspective(corners: &[Corner; 3], values: [f64; 3], pixel: (u32, u32)) -> f64 {
    let w = corners.map(|corner| f64::from(corner.w));
    let over_w = [0, 1, 2].map(|i| values[i] / w[i]);
    linear(corners, over_w, pixel) / linear(corners, w.map(f64::recip), pixel)
}

/// Stored depths against the planes, each triangle by itself.
fn depth<T: Preset>(workload: Workload) -> Deviation {
    let mut words = vec![0_u16; PIXELS];
    let mut offs = Vec::new();
    for corners in triangles(workload) {
        let buffer = DepthBuffer::try_new(&mut words, SIDE, SIDE).expect("as many words as pixels");
        let mut frame = Frame::new(Record::new(SIDE, SIDE))
            .expect("240 x 240")
            .with_tier(T::default())
            .with_hither(HITHER)
            .with_depth(buffer.with_compare(Always))
            .expect("the same size");
        frame.draw_triangle(corners.map(|corner| (corner.clip(), [])), &Flat(()));
        let (record, buffer) = frame.into_parts();
        let depths = corners.map(|corner| f64::from(corner.depth) / f64::from(DEPTH_ONE));
        offs.extend(record.pixels.iter().map(|&(x, y, ())| {
            let ideal = linear(&corners, depths, (x, y)).clamp(0.0, 1.0) * f64::from(u16::MAX);
            (f64::from(buffer.words()[(y * SIDE + x) as usize]) - ideal).abs()
        }));
    }
    of(offs.into_iter(), "depth units")
}

/// The largest and the mean.
fn of(offs: impl Iterator<Item = f64>, unit: &'static str) -> Deviation {
    let (mut max, mut sum, mut count) = (0.0, 0.0, 0_u32);
    for off in offs {
        (max, sum, count) = (f64::max(max, off), sum + off, count + 1);
    }
    Deviation { max, mean: sum / f64::from(count), unit }
}

/// Channels of a colour, in steps of its own.
fn channels(color: Rgb565) -> [f64; 3] {
    [color.r(), color.g(), color.b()].map(f64::from)
}

/// The most that each channel can be, in steps of its own.
const MOST: [f64; 3] = [31.0, 63.0, 31.0];

/// How far a colour is from red, green and blue in `[0, 1]`, in steps of RGB565: the largest of the channels.
fn steps(color: Rgb565, ideal: [f64; 3]) -> f64 {
    let stored = channels(color);
    (0..3).map(|i| (stored[i] - ideal[i] * MOST[i]).abs()).fold(0.0, f64::max)
}

/// W4's colours, unrounded.
fn colour(picture: &Picture) -> Deviation {
    let corners = triangles(Workload::W4)[0];
    let channel = |i: usize| COLORS.map(|color| color[i].to_num::<f64>());
    let ideal = |x, y| [0, 1, 2].map(|i| perspective(&corners, channel(i), (x, y)));
    of(picture.pixels().map(|(x, y, color)| steps(color, ideal(x, y))), "RGB565 steps")
}

/// W5's texels: how many columns or rows from the one that holds the pixel's centre.
fn texel(picture: &Picture) -> Deviation {
    let corners = triangles(Workload::W5)[0];
    let side = f64::from(TEXTURE_SIDE);
    let ideal = |i: usize, pixel| {
        let coordinate = COORDINATES.map(|at| at[i].to_num::<f64>());
        (perspective(&corners, coordinate, pixel) * side).clamp(0.0, side - 1.0).floor()
    };
    let off = |(x, y, color): (u32, u32, Rgb565)| {
        let (column, row) = texel_of(color.0);
        let off = |texel: u32, i| (f64::from(texel) - ideal(i, (x, y))).abs();
        off(column, 0).max(off(row, 1))
    };
    of(picture.pixels().map(off), "texels")
}

/// W6f's pixels that show another face.
fn faces(picture: &Picture) -> Deviation {
    let ideal = torus::faces().to_rgb565();
    let wrong = picture.color.iter().zip(&ideal).filter(|(a, b)| a != b).count();
    let drawn = ideal.iter().filter(|word| **word != 0).count();
    Deviation { max: wrong as f64, mean: wrong as f64 / drawn as f64, unit: "wrong pixels" }
}

/// W6g's colours, unrounded; where only one of both is background, that is how far off it is.
fn torus_colour(picture: &Picture) -> Deviation {
    let ideal = torus::gouraud();
    let both = picture.color.iter().zip(ideal.colors());
    let shown = both.filter(|(word, ideal)| **word != 0 || **ideal != [0.0; 3]);
    of(shown.map(|(word, ideal)| steps(Rgb565(*word), *ideal)), "RGB565 steps")
}

/// How far vertices are from where model space has them, on the screen: by the snap, and by the matrix before it.
fn snap<T: Preset>() -> Deviation {
    let frame = Frame::new(Record::<()>::new(SIDE, SIDE)).expect("240 x 240");
    let frame = frame.with_tier(T::default()).with_hither(scene::HITHER);
    let clip: [ClipVertex; SNAPPED] = to_be_snapped().expect("constants in range");
    let off = |(index, vertex): (usize, &ClipVertex)| {
        let snapped: Vertex<T> = frame.snap(vertex, []);
        let side = f64::from(SIDE);
        let [x, y] = on_screen(snapped.snapped(), Viewport::new(SIDE, SIDE));
        let [ideal_x, ideal_y] = torus::on_screen(index * (CACHE / SNAPPED), side);
        (x - ideal_x).abs().max((y - ideal_y).abs())
    };
    of(clip.iter().enumerate().map(off), "pixels")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_workload(workload: Workload) -> [Reference; 3] {
        [
            reference::<Exact>(workload),
            reference::<Quick<4>>(workload),
            reference::<Quick<8>>(workload),
        ]
    }

    #[test]
    fn pixel_counts_are_those_of_the_top_left_rule() {
        for (workload, pixels) in
            [(Workload::W1, 22_845), (Workload::W2, 49_721), (Workload::W3, 3_926)]
        {
            for reference in of_workload(workload) {
                assert_eq!(reference.pixels, pixels, "{reference:?}");
                assert_eq!(reference.deviation.max, 0.0, "{reference:?}");
            }
        }
    }

    #[test]
    fn depth_is_within_a_unit_and_colour_within_a_step() {
        for workload in [Workload::W1z, Workload::W2z, Workload::W3z, Workload::W4] {
            for reference in of_workload(workload) {
                assert!(reference.deviation.max <= 1.0, "{reference:?}");
                assert!(reference.deviation.mean > 0.0, "{reference:?}");
            }
        }
        assert!(reference::<Exact>(Workload::W4).deviation.max <= 0.51);
    }

    #[test]
    fn a_shifted_picture_is_off() {
        let mut picture = Picture::draw::<Exact>(Workload::W5);
        assert!(texel(&picture).mean < 0.005);
        picture.color.rotate_right(1);
        assert!(texel(&picture).mean > 0.1);
    }
}
