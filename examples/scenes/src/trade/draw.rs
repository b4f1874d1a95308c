//! Drawing a scene at a point, with a clock read around what is counted.

use super::geometry::{Attribute, Geometry, VERTICES};
use super::knobs::{DepthKnob, Knobs, Stage};
use super::scene::Scene;
use crate::SceneError;
use crate::checksum::Checksum;
use crate::texture::{GROUND, SIZE};
use hither::{
    Counts, Fragment, Frame, Framebuffer, Less, Rgb565, Target, Texture, Textured, Vertex,
    VertexStage,
};

/// Width of the pictures, in pixels.
pub const WIDTH: u32 = 160;

/// Height of the pictures, in pixels.
pub const HEIGHT: u32 = 120;

/// Words of colour, and of depth.
pub const PIXELS: usize = (WIDTH * HEIGHT) as usize;

/// Words for depths of both widths, of which a point takes one or none.
#[derive(Debug)]
pub struct Depths<'a> {
    /// Of 16 bits.
    pub short: &'a mut [u16; PIXELS],
    /// Of 32 bits.
    pub long: &'a mut [u32; PIXELS],
}

impl Depths<'_> {
    /// The same words, lent on.
    pub fn lend(&mut self) -> Depths<'_> {
        Depths { short: self.short, long: self.long }
    }
}

/// What became of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Drawn {
    /// What the clock says of the drawing.
    pub ticks: u32,
    /// A checksum of the picture's colours.
    pub sum: u32,
    /// What became of the triangles.
    pub counts: Counts,
}

/// The scenes' texture.
///
/// # Panics
///
/// Never: it is as large as it says.
#[must_use]
pub const fn textured() -> Textured<'static, Rgb565> {
    match Texture::try_new(&GROUND, SIZE as u32, SIZE as u32) {
        Ok(texture) => Textured(texture),
        Err(_) => panic!("the texture is as large as it says"),
    }
}

/// Draws a scene's picture at a point: with its texture or with a colour a vertex.
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn picture<K: Knobs>(
    (scene, with_texture): (Scene, bool),
    geometry: &mut Geometry,
    color: &mut [u16; PIXELS],
    mut depths: Depths<'_>,
    clock: impl Fn() -> u32,
) -> Result<Drawn, SceneError> {
    color.fill(0);
    let target = Framebuffer::<Rgb565>::try_new(color, WIDTH, HEIGHT)?;
    let drawn = if with_texture {
        draw_onto::<K, _, _, 2>(target, scene, geometry, &textured(), depths.lend(), clock)
    } else {
        let shader = K::Shader::default();
        draw_onto::<K, _, _, 3>(target, scene, geometry, &shader, depths.lend(), clock)
    };
    let (ticks, counts) = drawn?;
    Ok(Drawn { ticks, sum: Checksum::new().with_words(color).value(), counts })
}

/// Draws a scene at a point onto any target of [`WIDTH`] by [`HEIGHT`] pixels.
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn draw_onto<K: Knobs, C: Target, F: Fragment<C::Color, N>, const N: usize>(
    target: C,
    scene: Scene,
    geometry: &mut Geometry,
    fragment: &F,
    depths: Depths<'_>,
    clock: impl Fn() -> u32,
) -> Result<(u32, Counts), SceneError>
where
    K::Stage: VertexStage<Attribute, N>,
{
    depths.short.fill(u16::MAX);
    depths.long.fill(u32::MAX);
    let mesh = scene.build(geometry)?;
    let frame = Frame::new(target)?.with_tier(K::Tier::default());
    let frame = frame.with_correction(K::Correction::default()).with_hither(scene.hither()?);
    let mut frame = K::Depth::with::<Less, _, _, _>(frame, depths)?.with_cull(scene.cull());
    let stage = K::Stage::of(&scene.transform()?);
    let mut cache = [Vertex::<K::Tier, N>::EMPTY; VERTICES];
    let start = clock();
    let counts = frame.draw(&mesh, &stage, fragment, &mut cache);
    Ok((clock().wrapping_sub(start), counts))
}
