//! Drawing the workloads, with a clock read around the part that is counted.
//!
//! A function each for what is generic, so that a firmware that draws one has no code of the others.

use super::{HITHER, PIXELS, Preset, SIDE, TEXTURE, Workload, corners};
use crate::SceneError;
use crate::checksum::Checksum;
use crate::torus;
use hither::{
    ClipVertex, Cull, DepthBias, DepthBuffer, DepthTest, Edges, FaceColors, Flat, Fragment, Frame,
    Framebuffer, Gouraud, Hither, I16F16, NoDepth, Rgb565, Snapped, Target, Textured, Translucent,
    Vertex,
};

/// Triangles of W2 and W3.
pub const TRIANGLES: usize = 1000;

/// Entries of a cache for all of W6's vertices.
pub const CACHE: usize = torus::VERTEX_COUNT;

/// Vertices of `snap`.
pub const SNAPPED: usize = 128;

const O: I16F16 = I16F16::ZERO;
const I: I16F16 = I16F16::ONE;

/// Red, green and blue at the corners of W4, in the order they are drawn in.
pub const COLORS: [[I16F16; 3]; 3] = [[I, O, O], [O, O, I], [O, I, O]];

/// Texture coordinates at the corners of W5, in the order they are drawn in.
pub const COORDINATES: [[I16F16; 2]; 3] = [[O, O], [O, I], [I, O]];

/// The words a workload draws into.
#[derive(Debug)]
pub struct Buffers<'a> {
    /// RGB565 in native byte order.
    pub color: &'a mut [u16; PIXELS],
    /// Depths, where the workload has depth.
    pub depth: &'a mut [u16; PIXELS],
}

/// A workload's frame before it has depth.
type Bare<'a, T> = Frame<Framebuffer<'a, Rgb565>, NoDepth, Hither, T, <T as Preset>::Correction>;

/// A workload's frame with depth.
type Deep<'a, T> =
    Frame<Framebuffer<'a, Rgb565>, DepthBuffer<'a>, Hither, T, <T as Preset>::Correction>;

/// A frame over cleared colours.
fn bare<T: Preset>(color: &mut [u16; PIXELS], hither: Hither) -> Result<Bare<'_, T>, SceneError> {
    color.fill(0);
    let frame = Frame::new(Framebuffer::try_new(color, SIDE, SIDE)?)?.with_tier(T::default());
    let frame = frame.with_correction(T::Correction::default()).with_hither(hither);
    Ok(frame.with_cull(Cull::Back))
}

/// A frame over cleared colours and depths.
fn deep<'a, T: Preset>(
    buffers: &'a mut Buffers<'_>,
    hither: Hither,
) -> Result<Deep<'a, T>, SceneError> {
    buffers.depth.fill(u16::MAX);
    let depth = DepthBuffer::try_new(buffers.depth, SIDE, SIDE)?;
    Ok(bare(buffers.color, hither)?.with_depth(depth)?)
}

/// What the clock says of `work`; it wraps.
fn ticks(clock: impl Fn() -> u32, work: impl FnOnce()) -> u32 {
    let start = clock();
    work();
    clock().wrapping_sub(start)
}

/// The colour of a flat triangle: any but black, and another than its neighbours'.
#[must_use]
pub const fn face_color(number: usize) -> Rgb565 {
    Rgb565((number as u16).wrapping_mul(40_503) | 1)
}

/// Draws W1, W2 or W3 with as many triangles as there is room for; what the clock says of the drawing.
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn flat<T: Preset>(
    workload: Workload,
    color: &mut [u16; PIXELS],
    triangles: &mut [[Vertex<T>; 3]],
    clock: impl Fn() -> u32,
) -> Result<u32, SceneError> {
    let mut frame = bare(color, HITHER)?;
    let triangles = snapped(&frame, workload, triangles);
    Ok(ticks(clock, || draw_flat(&mut frame, triangles)))
}

/// Draws W1z, W2z or W3z; see [`flat`].
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn flat_deep<T: Preset>(
    workload: Workload,
    buffers: &mut Buffers<'_>,
    triangles: &mut [[Vertex<T>; 3]],
    clock: impl Fn() -> u32,
) -> Result<u32, SceneError> {
    let mut frame = deep::<T>(buffers, HITHER)?;
    let triangles = snapped(&frame, workload, triangles);
    Ok(ticks(clock, || draw_flat(&mut frame, triangles)))
}

/// The triangles of one of W1 to W3z as a frame snaps them; those that there are room for.
pub fn snapped<'v, C: Target, T: Preset, D: DepthTest>(
    frame: &Frame<C, D, Hither, T, T::Correction>,
    workload: Workload,
    triangles: &'v mut [[Vertex<T>; 3]],
) -> &'v [[Vertex<T>; 3]] {
    let mut count = 0;
    corners(workload, |number, corners| {
        if let Some(triangle) = triangles.get_mut(number) {
            // In place: from an array of its own it would be copied.
            for (vertex, corner) in triangle.iter_mut().zip(corners) {
                *vertex = frame.snap(&corner.clip(), []);
            }
            count = number + 1;
        }
    });
    triangles.get(..count).unwrap_or_default()
}

/// The counted part of W1 to W3z.
#[inline(never)]
pub fn draw_flat<C: Target<Color = Rgb565>, T: Preset, D: DepthTest>(
    frame: &mut Frame<C, D, Hither, T, T::Correction>,
    triangles: &[[Vertex<T>; 3]],
) {
    for (number, [a, b, c]) in triangles.iter().enumerate() {
        frame.draw_snapped([a, b, c], &Flat(face_color(number)));
    }
}

/// Draws W1 or W2 with smooth edges over the cleared colours; what the clock says of the drawing, and the checksum of the colours.
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn smooth_flat<T: Preset>(
    workload: Workload,
    color: &mut [u16; PIXELS],
    triangles: &mut [[Vertex<T>; 3]],
    clock: impl Fn() -> u32,
) -> Result<(u32, u32), SceneError> {
    let mut frame = bare(color, HITHER)?;
    let triangles = snapped(&frame, workload, triangles);
    let ticks = ticks(clock, || draw_smooth_flat(&mut frame, triangles));
    Ok((ticks, Checksum::new().with_words(frame.target().words()).value()))
}

/// The counted part.
#[inline(never)]
fn draw_smooth_flat<T: Preset>(frame: &mut Bare<'_, T>, triangles: &[[Vertex<T>; 3]]) {
    let mut frame = frame.blended();
    for (number, [a, b, c]) in triangles.iter().enumerate() {
        let fragment = Translucent(Flat(face_color(number)), 255);
        frame.draw_smooth([a, b, c], Edges::ALL, &fragment);
    }
}

/// Draws the lines of W6's torus over its cleared colours and depths, hidden ones among themselves; what the clock says of all
/// of it, and the checksum of colours and depths.
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn torus_lines<T: Preset>(
    buffers: &mut Buffers<'_>,
    cache: &mut [Vertex<T>],
    clock: impl Fn() -> u32,
) -> Result<(u32, u32), SceneError> {
    let mut frame = deep::<T>(buffers, torus::HITHER)?;
    let mut done = Ok(());
    let ticks = ticks(clock, || done = draw_torus_lines(&mut frame, cache));
    done?;
    let sum = Checksum::new().with_words(buffers.color).with_words(buffers.depth);
    Ok((ticks, sum.value()))
}

/// The counted part.
#[inline(never)]
fn draw_torus_lines<T: Preset>(
    frame: &mut Deep<'_, T>,
    cache: &mut [Vertex<T>],
) -> Result<(), SceneError> {
    let transform = torus::transform();
    let transform = transform.as_ref().map_err(|&error| error)?;
    let white = Flat(Rgb565::WHITE);
    frame.draw_wireframe(&torus::BARE_TORUS, transform, DepthBias::NONE, &white, cache);
    Ok(())
}

/// Draws W4; what the clock says of the drawing.
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn gouraud<T: Preset>(
    buffers: &mut Buffers<'_>,
    clock: impl Fn() -> u32,
) -> Result<u32, SceneError> {
    shaded::<T, _, 3>(Workload::W4, buffers, COLORS, &Gouraud, clock)
}

/// Draws W5; what the clock says of the drawing.
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn textured<T: Preset>(
    buffers: &mut Buffers<'_>,
    clock: impl Fn() -> u32,
) -> Result<u32, SceneError> {
    shaded::<T, _, 2>(Workload::W5, buffers, COORDINATES, &Textured(TEXTURE), clock)
}

/// Draws a workload's only triangle with varyings.
fn shaded<T: Preset, F: Fragment<Rgb565, N>, const N: usize>(
    workload: Workload,
    buffers: &mut Buffers<'_>,
    [u, v, w]: [[I16F16; N]; 3],
    fragment: &F,
    clock: impl Fn() -> u32,
) -> Result<u32, SceneError> {
    let mut frame = deep::<T>(buffers, HITHER)?;
    let mut vertices = [Vertex::<T, N>::EMPTY; 3];
    corners(workload, |_, [a, b, c]| {
        for (vertex, (a, u)) in vertices.iter_mut().zip([(a, u), (b, v), (c, w)]) {
            *vertex = frame.snap(&a.clip(), u);
        }
    });
    Ok(ticks(clock, || draw_shaded(&mut frame, &vertices, fragment)))
}

/// The counted part of W4 and W5.
#[inline(never)]
fn draw_shaded<T: Preset, F: Fragment<Rgb565, N>, const N: usize>(
    frame: &mut Deep<'_, T>,
    [a, b, c]: &[Vertex<T, N>; 3],
    fragment: &F,
) {
    frame.draw_snapped([a, b, c], fragment);
}

/// Draws W6f; what the clock says of all of it, from the matrices on. A cache of [`CACHE`] vertices is one that holds
/// all.
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn torus_flat<T: Preset>(
    buffers: &mut Buffers<'_>,
    cache: &mut [Vertex<T>],
    clock: impl Fn() -> u32,
) -> Result<u32, SceneError> {
    let mut frame = deep::<T>(buffers, torus::HITHER)?;
    let mut done = Ok(());
    let ticks = ticks(clock, || done = draw_torus_flat(&mut frame, cache));
    done.map(|()| ticks)
}

/// The counted part of W6f.
#[inline(never)]
fn draw_torus_flat<T: Preset>(
    frame: &mut Deep<'_, T>,
    cache: &mut [Vertex<T>],
) -> Result<(), SceneError> {
    // By reference: a matrix that is moved out of its result stands on the stack twice.
    let transform = torus::transform();
    let transform = transform.as_ref().map_err(|&error| error)?;
    if let Some(faces) = FaceColors::new(&torus::FACE_COLORS) {
        frame.draw(&torus::BARE_TORUS, transform, &faces, cache);
    }
    Ok(())
}

/// Draws W6g; see [`torus_flat`].
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn torus_gouraud<T: Preset>(
    buffers: &mut Buffers<'_>,
    cache: &mut [Vertex<T, 3>],
    clock: impl Fn() -> u32,
) -> Result<u32, SceneError> {
    let mut frame = deep::<T>(buffers, torus::HITHER)?;
    let mut done = Ok(());
    let ticks = ticks(clock, || done = draw_torus_gouraud(&mut frame, cache));
    done.map(|()| ticks)
}

/// The counted part of W6g.
#[inline(never)]
fn draw_torus_gouraud<T: Preset>(
    frame: &mut Deep<'_, T>,
    cache: &mut [Vertex<T, 3>],
) -> Result<(), SceneError> {
    let transform = torus::transform();
    frame.draw(&torus::TORUS, transform.as_ref().map_err(|&error| error)?, &Gouraud, cache);
    Ok(())
}

/// Every fourth of W6's vertices, in clip space.
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn to_be_snapped() -> Result<[ClipVertex; SNAPPED], SceneError> {
    let transform = torus::transform()?;
    let mut clip = [ClipVertex::default(); SNAPPED];
    for (index, vertex) in clip.iter_mut().enumerate() {
        *vertex = transform.transform(torus::model_position(index * (CACHE / SNAPPED)));
    }
    Ok(clip)
}

/// Does `snap`, for the first [`SNAPPED`] of `vertices`; what the clock says of it.
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn snap<T: Preset>(
    color: &mut [u16; PIXELS],
    vertices: &mut [Vertex<T>],
    clock: impl Fn() -> u32,
) -> Result<u32, SceneError> {
    let frame = bare(color, torus::HITHER)?;
    let clip = to_be_snapped()?;
    Ok(ticks(clock, || snap_all(&frame, &clip, vertices)))
}

/// The counted part of `snap`.
#[inline(never)]
fn snap_all<T: Preset>(
    frame: &Bare<'_, T>,
    clip: &[ClipVertex; SNAPPED],
    vertices: &mut [Vertex<T>],
) {
    for (vertex, clip) in vertices.iter_mut().zip(clip) {
        *vertex = frame.snap(clip, []);
    }
}

/// Draws any workload; what the clock says, and the checksum of what came of it: of the colours, of the depths where
/// there are any, and of the snapped vertices for `snap`.
///
/// `triangles` has room for [`TRIANGLES`], `cache` for [`CACHE`].
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn draw<T: Preset>(
    workload: Workload,
    buffers: &mut Buffers<'_>,
    triangles: &mut [[Vertex<T>; 3]],
    cache: &mut [Vertex<T, 3>],
    clock: impl Fn() -> u32,
) -> Result<(u32, u32), SceneError> {
    let vertices = triangles.as_flattened_mut();
    let ticks = match workload {
        Workload::W1 | Workload::W2 | Workload::W3 => {
            flat(workload, buffers.color, triangles, clock)
        }
        Workload::W1z | Workload::W2z | Workload::W3z => {
            flat_deep(workload, buffers, triangles, clock)
        }
        Workload::W4 => gouraud::<T>(buffers, clock),
        Workload::W5 => textured::<T>(buffers, clock),
        Workload::W6f => torus_flat(buffers, vertices.get_mut(..CACHE).unwrap_or_default(), clock),
        Workload::W6g => torus_gouraud(buffers, cache, clock),
        Workload::Snap => snap(buffers.color, vertices, clock),
    }?;
    let mut sum = Checksum::new().with_words(buffers.color);
    if workload.is_deep() {
        sum = sum.with_words(buffers.depth);
    }
    if workload == Workload::Snap {
        sum = triangles.as_flattened().iter().take(SNAPPED).fold(sum, with_position);
    }
    Ok((ticks, sum.value()))
}

/// A checksum with a snapped position.
fn with_position<T: Preset>(sum: Checksum, vertex: &Vertex<T>) -> Checksum {
    let words = match vertex.snapped() {
        Snapped::Homogeneous { point: [x, y, w], shift } => [x, y, w, shift],
        Snapped::Projected { point: [x, y], .. } => [x, y, 0, 0],
    };
    words.into_iter().fold(sum, |sum, word| sum.with_bytes(&word.to_le_bytes()))
}
