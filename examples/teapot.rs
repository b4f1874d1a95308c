//! The spinning teapot, as a 240 x 240 RGB565 display would show it: a picture, an animation, and how far both are
//! from a reference in `f64`.

use std::error::Error;
use std::fmt::Display;

use hither::{Counts, DepthBuffer, Exact, Fidelity, Frame, Framebuffer, Rgb565Be, Vertex};
use hither_examples::{ideal, picture, reference, rgb565};
use hither_scenes::spinning_teapot::{self as scene, Drawn, Moment};

/// Pixels along each side.
const SIDE: u32 = 240;

/// Frames of a turn.
const FRAMES: u32 = 64;

/// How long a frame is shown.
const FRAME_MILLIS: u16 = 50;

fn main() -> Result<(), Box<dyn Error>> {
    let frames: Vec<(Vec<u16>, Drawn)> = (0..FRAMES)
        .map(render)
        .collect::<Result<_, _>>()
        .map_err(|e| context("drawing the teapot", e))?;
    let pictures: Vec<Vec<u8>> =
        frames.iter().map(|(words, _)| rgb565::expand_all(words)).collect();
    let folder = picture::target_folder();
    let (still, animation) = (folder.join("teapot.png"), folder.join("teapot.apng"));
    picture::write_png(&still, SIDE, SIDE, &pictures[0])
        .map_err(|e| context("writing the picture", e))?;
    picture::write_apng(&animation, SIDE, SIDE, &pictures, FRAME_MILLIS)
        .map_err(|e| context("writing the animation", e))?;
    println!("Picture    {}", still.display());
    println!("Animation  {} ({FRAMES} frames)", animation.display());

    let Drawn { teapot, ground } = frames[0].1;
    println!("\nFrame 0    {}", heading());
    println!("  teapot   {}", row(teapot));
    println!("  ground   {}", row(ground));

    println!("\nAgainst the f64 reference:");
    let differences: Vec<_> =
        (0..FRAMES).zip(&frames).map(|(number, (words, _))| difference(number, words)).collect();
    println!("  frame 0     {}", differences[0]);
    let worst = (0..differences.len()).max_by_key(|&i| differences[i].differing).unwrap_or(0);
    println!("  frame {worst:<2}    {} (the most of all)", differences[worst]);
    Ok(())
}

/// Draws a frame of the turn through hither; its words in native byte order.
fn render(number: u32) -> Result<(Vec<u16>, Drawn), Box<dyn Error>> {
    let pixels = (SIDE * SIDE) as usize;
    let (mut color_words, mut depth_words) = (vec![0_u16; pixels], vec![0_u16; pixels]);
    let buffer = Framebuffer::<Rgb565Be>::try_new(&mut color_words, SIDE, SIDE)?;
    let mut frame = Frame::new(buffer)?
        .with_preset(Fidelity)
        .with_hither(scene::HITHER)
        .with_depth(DepthBuffer::try_new(&mut depth_words, SIDE, SIDE)?)?
        .with_cull(scene::CULL);
    let mut cache = [Vertex::<Exact, 3>::EMPTY; scene::VERTEX_COUNT];
    let drawn = scene::draw(&mut frame, Moment { number, frames: FRAMES }, &mut cache)?;
    // The buffer holds what the display takes: the high byte first.
    Ok((color_words.into_iter().map(u16::from_be).collect(), drawn))
}

fn difference(number: u32, words: &[u16]) -> reference::Difference {
    let ideal = ideal::draw(Moment { number, frames: FRAMES }, SIDE as usize, SIDE as usize);
    reference::compare(words, &ideal.to_rgb565())
}

/// The names of what [`row`] gives.
fn heading() -> String {
    ["drawn", "culled", "behind", "off screen", "zero area"]
        .map(|name| format!("{name:>12}"))
        .concat()
}

/// What became of the triangles of a mesh.
fn row(counts: Counts) -> String {
    [counts.drawn, counts.culled, counts.behind, counts.off_screen, counts.zero_area]
        .map(|count| format!("{count:>12}"))
        .concat()
}

fn context(doing: &str, error: impl Display) -> String {
    format!("{doing}: {error}")
}
