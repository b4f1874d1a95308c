//! Draws a scene through the library's public draw path into a target that records, and prints it.

use std::fmt::Write as _;
use std::io::{self, Write};

use hither::{
    Always, ClipVertex, DepthBuffer, Exact, Frame, Hither, I16F16, NoDepth, NoHither, Perspective,
    Plane, Quick, Snapped, Tier,
};
use num_rational::BigRational;

use super::{Scene, Sides, TierName, Triangle};
use crate::oracle::Viewport;
use crate::record::{Mark, Probe, Record, clip_vertex, frame};
use crate::snapped::in_clip;

/// Least number of significant digits of a printed attribute.
const DIGITS: usize = 9;

/// A pixel's column and row, and what is shown there.
type Pixels = Vec<(u32, u32, Shown)>;

/// The raw attribute and the stored depth at a pixel.
type Shown = (i32, u16);

/// Prints a line for every covered pixel.
///
/// # Errors
///
/// What writing to `out` gives.
pub fn coverage(scene: &Scene, out: &mut impl Write) -> io::Result<()> {
    let mut line = String::new();
    for (index, triangle) in scene.triangles.iter().enumerate() {
        let code = triangle.attribute.map(Code::new);
        let raw = code.as_ref().map_or([0; 3], |code| code.raw);
        for (x, y, (value, depth)) in draw(triangle, raw, viewport(scene)) {
            line.clear();
            // Writing to a string does not fail.
            let _ = write!(line, "{index} {x} {y}");
            if let Some(code) = &code {
                line.push_str(" a=");
                push_decimal(&mut line, code.value(value));
            }
            if triangle.depth {
                let _ = write!(line, " d={depth}");
            }
            line.push('\n');
            out.write_all(line.as_bytes())?;
        }
    }
    Ok(())
}

/// Prints the snapped vertices of every triangle.
///
/// # Errors
///
/// What writing to `out` gives.
pub fn snapped(scene: &Scene, out: &mut impl Write) -> io::Result<()> {
    let viewport = viewport(scene);
    for (index, triangle) in scene.triangles.iter().enumerate() {
        let snapped = match triangle.settings.tier {
            TierName::Exact => snap::<Exact>(triangle, viewport),
            TierName::Quick4 => snap::<Quick<4>>(triangle, viewport),
            TierName::Quick8 => snap::<Quick<8>>(triangle, viewport),
        };
        write!(out, "{index}")?;
        for (snapped, [_, _, w]) in snapped.into_iter().zip(triangle.corners) {
            for value in in_clip(snapped, viewport, i64::from(w)) {
                write_rational(out, &value)?;
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

fn write_rational(out: &mut impl Write, value: &BigRational) -> io::Result<()> {
    write!(out, " {}/{}", value.numer(), value.denom())
}

fn viewport(scene: &Scene) -> Viewport {
    let (width, height) = scene.viewport;
    Viewport::new(width, height)
}

/// The corners in clip space.
fn vertices(triangle: &Triangle) -> [ClipVertex; 3] {
    let z = triangle.z.unwrap_or_default();
    [0, 1, 2].map(|i| {
        let [x, y, w] = triangle.corners[i];
        clip_vertex([x, y, z[i], w].map(i64::from))
    })
}

/// A triangle's hither plane.
fn hither(triangle: &Triangle) -> Option<Hither> {
    let distance = triangle.settings.hither.map(I16F16::from_bits);
    distance.map(|distance| Hither::new(distance).expect("from 1 on"))
}

fn snap<T: Tier>(triangle: &Triangle, viewport: Viewport) -> [Snapped; 3] {
    let frame = frame::<()>(viewport).with_tier(T::default());
    let vertices = vertices(triangle);
    match hither(triangle) {
        Some(plane) => {
            let frame = frame.with_hither(plane);
            vertices.map(|v| frame.snap(&v, []).snapped())
        }
        None => vertices.map(|v| frame.snap(&v, []).snapped()),
    }
}

/// The pixels of a triangle.
fn draw(triangle: &Triangle, raw: [i32; 3], viewport: Viewport) -> Pixels {
    match triangle.settings.tier {
        TierName::Exact => in_tier::<Exact>(triangle, raw, viewport),
        TierName::Quick4 => in_tier::<Quick<4>>(triangle, raw, viewport),
        TierName::Quick8 => in_tier::<Quick<8>>(triangle, raw, viewport),
    }
}

fn in_tier<T: Tier>(triangle: &Triangle, raw: [i32; 3], viewport: Viewport) -> Pixels {
    match triangle.settings.planes.len() {
        0 => clipped::<T, 0>(triangle, raw, viewport),
        1 => clipped::<T, 1>(triangle, raw, viewport),
        2 => clipped::<T, 2>(triangle, raw, viewport),
        3 => clipped::<T, 3>(triangle, raw, viewport),
        _ => clipped::<T, 4>(triangle, raw, viewport),
    }
}

/// A frame without a hither plane: the plain one, before it is told more.
type Plain<C, T, const P: usize> = Frame<Record<C>, NoDepth, NoHither, T, Perspective, P>;

fn clipped<T: Tier, const P: usize>(
    triangle: &Triangle,
    raw: [i32; 3],
    viewport: Viewport,
) -> Pixels {
    fn plain<C: Copy, T: Tier, const P: usize>(
        triangle: &Triangle,
        viewport: Viewport,
    ) -> Plain<C, T, P> {
        let planes =
            std::array::from_fn(|i| Plane::new(triangle.settings.planes[i].map(I16F16::from_bits)));
        frame(viewport).with_tier(T::default()).with_planes(planes)
    }
    let vertices = vertices(triangle);
    let flat = vertices.map(|v| (v, []));
    match hither(triangle) {
        Some(plane) if triangle.attribute.is_some() || triangle.depth => {
            probe(plain::<_, T, P>(triangle, viewport), plane, vertices, raw)
        }
        Some(plane) => {
            let mut frame = plain::<_, T, P>(triangle, viewport).with_hither(plane);
            let _ = frame.draw_triangle(flat, &Mark);
            marked(frame.into_parts().0)
        }
        None if triangle.settings.sides == Sides::Both => {
            let mut frame = plain::<_, T, P>(triangle, viewport).with_both_sides();
            let _ = frame.draw_triangle(flat, &Mark);
            marked(frame.into_parts().0)
        }
        None => {
            let mut frame = plain::<_, T, P>(triangle, viewport);
            let _ = frame.draw_triangle(flat, &Mark);
            marked(frame.into_parts().0)
        }
    }
}

fn marked(record: Record<()>) -> Pixels {
    let bare = |(x, y, ()): (u32, u32, ())| (x, y, (0, 0));
    record.pixels.into_iter().map(bare).collect()
}

/// Draws with depth and one varying.
fn probe<T: Tier, const P: usize>(
    frame: Plain<[I16F16; 1], T, P>,
    plane: Hither,
    vertices: [ClipVertex; 3],
    raw: [i32; 3],
) -> Pixels {
    let (width, height) = (frame.viewport().width(), frame.viewport().height());
    let mut words = vec![0u16; width as usize * height as usize];
    let depth = DepthBuffer::try_new(&mut words, width, height).expect("a word a pixel");
    let mut frame =
        frame.with_hither(plane).with_depth(depth.with_compare(Always)).expect("the same size");
    let corners = [0, 1, 2].map(|i| (vertices[i], [I16F16::from_bits(raw[i])]));
    let _ = frame.draw_triangle(corners, &Probe);
    let (record, depth) = frame.into_parts();
    let words = depth.words();
    let shown = |(x, y, [value]): (u32, u32, [I16F16; 1])| {
        (x, y, (value.to_bits(), words[(y * width + x) as usize]))
    };
    record.pixels.into_iter().map(shown).collect()
}

/// Attributes as raw values of the library: `value = base + raw 2^-exponent`.
///
/// Scaled by a power of two to about 30 bits, so that what is printed is as precise as what the
/// library computes.
struct Code {
    given: [f64; 3],
    raw: [i32; 3],
    base: f64,
    exponent: i32,
}

impl Code {
    /// Largest magnitude of a raw value.
    const RAW: f64 = (1 << 30) as f64;

    /// From the values as they are, where 30 bits hold them exactly; else from their differences.
    fn new(given: [f64; 3]) -> Self {
        let code = Self::from_base(given, 0.0);
        let exact = |i: usize| code.decode(code.raw[i]) == given[i];
        if (0..3).all(exact) { code } else { Self::from_base(given, given[0]) }
    }

    fn from_base(given: [f64; 3], base: f64) -> Self {
        let largest = given.iter().fold(0.0_f64, |most, v| most.max((v - base).abs()));
        let fits = |exponent: i32| largest * f64::from(exponent).exp2() <= Self::RAW;
        let exponent = (0..1020).take_while(|&exponent| fits(exponent)).last();
        let exponent = exponent.filter(|_| largest > 0.0).unwrap_or(0);
        let scale = f64::from(exponent).exp2();
        Self { given, raw: given.map(|v| ((v - base) * scale).round() as i32), base, exponent }
    }

    fn decode(&self, raw: i32) -> f64 {
        self.base + f64::from(raw) * f64::from(-self.exponent).exp2()
    }

    /// The value for a raw one; what was given to the bit where a corner's raw value comes back.
    fn value(&self, raw: i32) -> f64 {
        let same = (0..3).find(|&i| self.raw[i] == raw);
        same.map_or_else(|| self.decode(raw), |i| self.given[i])
    }
}

/// Appends a number in plain decimals: as many digits as it takes, and at least nine significant
/// ones.
fn push_decimal(text: &mut String, value: f64) {
    let start = text.len();
    // Writing to a string does not fail.
    let _ = write!(text, "{value}");
    let written = &text[start..];
    let has_point = written.contains('.');
    let significant = written.trim_start_matches(['-', '0', '.']);
    let digits = significant.bytes().filter(u8::is_ascii_digit).count();
    if digits < DIGITS && !has_point {
        text.push('.');
    }
    text.extend(std::iter::repeat_n('0', DIGITS.saturating_sub(digits)));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decimal(value: f64) -> String {
        let mut text = String::new();
        push_decimal(&mut text, value);
        text
    }

    #[test]
    fn decimals_come_back_and_have_their_digits() {
        for value in [0.0, 1.0, -65536.0, 0.1, 12.75, 1e-9, 1.0 / 3.0, 4_503.000_244_140_625] {
            let text = decimal(value);
            assert_eq!(text.parse(), Ok(value), "{text}");
            let digits = text.trim_start_matches(['-', '0', '.']).replace('.', "");
            assert!(digits.len() >= 9 || value == 0.0, "{text}");
        }
        assert_eq!(decimal(5.0), "5.00000000");
        assert_eq!(decimal(-0.0625), "-0.0625000000");
    }

    #[test]
    fn given_values_come_back_exactly() {
        for given in [
            [0.0, 1.0, -65536.0],
            [0.1, 0.2, 0.3],
            [65000.001, 65000.002, 65000.003],
            [1e-300, 0.0, 5e-301],
            [-7.25; 3],
            [0.0; 3],
        ] {
            let code = Code::new(given);
            for (raw, value) in code.raw.into_iter().zip(given) {
                assert_eq!(code.value(raw), value);
            }
            let range = given.iter().fold(f64::MIN, |a, &b| a.max(b))
                - given.iter().fold(f64::MAX, |a, &b| a.min(b));
            let step = code.decode(1) - code.decode(0);
            assert!(range == 0.0 || step <= range / f64::from(1 << 13), "{given:?}");
        }
    }
}
