//! The scene of the README's picture: the Utah teapot turning under a lamp, on textured ground.
//!
//! Everything is drawn with three varyings, so that one vertex cache serves both meshes. Numbers are
//! Q16.16 constants that `f64` holds exactly, so that a reference starts from the same ones.

use hither::{
    Angle, Correction, Counts, Cull, DepthBuffer, DepthTest, Frame, Gouraud, Hither, I16F16, Lit,
    Mat4, MatrixError, Mesh, NormalColor, Rgb565, Target, Tier, Vec3, Vertex, Viewport,
};

use crate::SceneError;
use crate::ground::{BACKGROUND, Faded, GROUND, STONES};
use crate::teapot::{FRACTION_BITS, NORMALS, POSITIONS, TRIANGLES};

/// Vertices of the larger mesh: entries of a cache that transforms each vertex once.
pub const VERTEX_COUNT: usize = crate::teapot::VERTEX_COUNT;

/// Towards the lamp, in world space, any length: from the upper left, in front.
pub const TOWARDS_LIGHT: Vec3 = [fixed("-0.75"), fixed("0.875"), fixed("0.4375")];

/// Brightness of what the lamp does not reach.
pub const AMBIENT: I16F16 = fixed("0.1875");

/// Brightness that the lamp adds where it falls straight.
pub const DIFFUSE: I16F16 = fixed("0.875");

/// The glaze: 8-bit red, green and blue.
pub const GLAZE: [u8; 3] = [70, 218, 200];

/// The eye at rest, in world space.
pub const EYE: Vec3 = [fixed("1.25"), fixed("2"), fixed("4.1875")];

/// How far the eye rises and falls, once a turn.
pub const SWAY: I16F16 = fixed("0.25");

/// What the eye looks at.
pub const TARGET: Vec3 = [fixed("0"), fixed("-0.0625"), fixed("0")];

/// Focal length in half picture heights.
pub const FOCAL: I16F16 = fixed("2.375");

/// Where the frame's hither plane and depth 0 are.
pub const NEAR: I16F16 = fixed("1");

/// Where depth 1 is.
pub const FAR: I16F16 = fixed("16");

/// The turn of the first frame: the spout to the right and a little to the front.
pub const FIRST_ANGLE: Angle = Angle::from_degrees(fixed("-6"));

/// The frame's hither plane.
pub const HITHER: Hither = match Hither::new(NEAR) {
    Ok(hither) => hither,
    Err(_) => panic!("the hither plane is not in front of the eye"),
};

/// Both facings are drawn: through the gap around the lid and into the spout the teapot's inside is seen. To leave out
/// backs is cheaper, and shows the ground there.
pub const CULL: Cull = Cull::Neither;

/// The teapot with its normals and its glaze.
pub static TEAPOT: Mesh<'static, [i16; 3], NormalColor> =
    match Mesh::try_new(&POSITIONS, FRACTION_BITS, &GLAZED, &TRIANGLES) {
        Ok(mesh) => mesh,
        Err(_) => panic!("the teapot's indices"),
    };

static GLAZED: [NormalColor; VERTEX_COUNT] = glazed();

/// What was drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Drawn {
    /// Of the teapot's triangles.
    pub teapot: Counts,
    /// Of the ground's triangles.
    pub ground: Counts,
}

/// A moment of the turn: frame `number` of `frames`; it repeats from there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moment {
    /// From 0.
    pub number: u32,
    /// Frames a turn; 0 counts as 1.
    pub frames: u32,
}

impl Moment {
    /// How far the turn is, from the first frame.
    #[must_use]
    pub fn angle(self) -> Angle {
        let frames = u64::from(self.frames.max(1));
        let steps = (u64::from(self.number) << 16) + frames / 2;
        // Whole turns are dropped by intent.
        Angle((steps / frames) as u16)
    }
}

/// Clears the frame and draws the scene at a moment.
///
/// The frame has the hither plane [`HITHER`] and culls [`CULL`]. `cache` holds up to [`VERTEX_COUNT`] entries; what
/// does not fit is transformed again where it is used.
///
/// # Errors
///
/// None in practice: the numbers are constants in range. A frame of extreme aspect may say [`MatrixError::Range`].
pub fn draw<C, D, T, I, const P: usize>(
    frame: &mut Frame<C, D, Hither, T, I, P>,
    moment: Moment,
    cache: &mut [Vertex<T, 3, P>],
) -> Result<Drawn, MatrixError>
where
    C: Target<Color = Rgb565>,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    let world = camera(frame.viewport().aspect(), FOCAL, moment)?;
    let lit = teapot(&world, moment)?;
    frame.clear(BACKGROUND);
    // The nearer first: what it hides of the ground is not shaded.
    let teapot = frame.draw(&TEAPOT, &lit, &Gouraud, cache);
    let shader = Faded { texture: STONES, into: BACKGROUND };
    let ground = frame.draw(&GROUND, &world, &shader, cache);
    Ok(Drawn { teapot, ground })
}

/// Clears the frame to black and draws the teapot alone, `focal` half picture heights large.
///
/// For pictures so small that the ground would be noise. The frame and the cache are as for
/// [`draw`].
///
/// # Errors
///
/// As for [`draw`]; and where `focal` is too large for the aspect.
pub fn draw_teapot<C, D, T, I, const P: usize>(
    frame: &mut Frame<C, D, Hither, T, I, P>,
    moment: Moment,
    focal: I16F16,
    cache: &mut [Vertex<T, 3, P>],
) -> Result<Counts, MatrixError>
where
    C: Target<Color = Rgb565>,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    let lit = teapot(&camera(frame.viewport().aspect(), focal, moment)?, moment)?;
    frame.clear(Rgb565::BLACK);
    Ok(frame.draw(&TEAPOT, &lit, &Gouraud, cache))
}

/// The teapot's vertices, turned and lit.
pub(crate) fn teapot(world: &Mat4, moment: Moment) -> Result<Lit, MatrixError> {
    let turned = Mat4::rotation_y(Angle(FIRST_ANGLE.0.wrapping_add(moment.angle().0)).sin_cos());
    Lit::new(world.times(&turned)?, &turned, TOWARDS_LIGHT, AMBIENT, DIFFUSE)
}

/// Clears and draws what a target shows of the scene: all of a viewport, or a band of it.
///
/// `depth` has a word a pixel of the target; it is cleared here. See [`draw`] for the cache.
///
/// # Errors
///
/// [`SceneError`] where the depth words are fewer than the target's pixels.
pub fn draw_onto<C, T, I>(
    target: C,
    viewport: Viewport,
    (tier, correction): (T, I),
    depth: &mut [u16],
    moment: Moment,
    cache: &mut [Vertex<T, 3>],
) -> Result<Drawn, SceneError>
where
    C: Target<Color = Rgb565>,
    T: Tier,
    I: Correction,
{
    let (width, height) = target.size();
    let depth = DepthBuffer::try_new(depth, width, height)?;
    let mut frame = Frame::with_viewport(target, viewport)
        .with_tier(tier)
        .with_correction(correction)
        .with_hither(HITHER)
        .with_depth(depth)?
        .with_cull(CULL);
    Ok(draw(&mut frame, moment, cache)?)
}

/// From the world to clip space.
pub(crate) fn camera(aspect: I16F16, focal: I16F16, moment: Moment) -> Result<Mat4, MatrixError> {
    let [x, y, z] = EYE;
    let eye = [x, y + SWAY * moment.angle().sin_cos().sin, z];
    let up = [I16F16::ZERO, I16F16::ONE, I16F16::ZERO];
    let view = Mat4::look_at(eye, TARGET, up)?;
    Mat4::perspective(focal, aspect, NEAR, FAR)?.times(&view)
}

/// A constant that Q16.16 holds.
const fn fixed(text: &str) -> I16F16 {
    I16F16::lit(text)
}

const fn glazed() -> [NormalColor; VERTEX_COUNT] {
    let mut glazed = [NormalColor { normal: [0; 3], color: GLAZE }; VERTEX_COUNT];
    let mut at = 0;
    while at < VERTEX_COUNT {
        glazed[at].normal = NORMALS[at];
        at += 1;
    }
    glazed
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::checksum::Checksum;
    use hither::{DepthBuffer, Exact, Fidelity, Framebuffer, Rgb565Be};
    use std::vec;

    #[test]
    fn a_turn_is_divided_evenly_and_repeats() {
        let angle = |number, frames| Moment { number, frames }.angle();
        assert_eq!([0, 16, 63, 64].map(|number| angle(number, 64).0), [0, 1 << 14, 63 << 10, 0]);
        assert_eq!(angle(1, 3).0, 21845);
        assert_eq!(angle(u32::MAX, 0), Angle(0));
    }

    /// The checksum of frame 5 of 8 at 80 x 60 pixels.
    fn drawn_with(cache: &mut [Vertex<Exact, 3>]) -> (Drawn, u32) {
        let (mut words, mut depths) = (vec![0; 80 * 60], vec![0_u16; 80 * 60]);
        let buffer = Framebuffer::<Rgb565Be>::try_new(&mut words, 80, 60).unwrap();
        let frame = Frame::new(buffer).unwrap().with_preset(Fidelity);
        let frame = frame.with_hither(HITHER).with_cull(CULL);
        let mut frame =
            frame.with_depth(DepthBuffer::try_new(&mut depths, 80, 60).unwrap()).unwrap();
        let drawn = draw(&mut frame, Moment { number: 5, frames: 8 }, cache).unwrap();
        (drawn, Checksum::new().with_bytes(frame.target().bytes()).value())
    }

    #[test]
    fn a_smaller_cache_draws_the_same() {
        let mut cache = [Vertex::EMPTY; VERTEX_COUNT];
        let whole = drawn_with(&mut cache);
        assert_eq!(whole, drawn_with(&mut cache[..100]));
        assert_eq!(whole, drawn_with(&mut []));
    }

    #[test]
    fn bands_are_the_picture() {
        let mut whole = vec![0; 80 * 60];
        let (mut depth, mut cache) = (vec![0; 80 * 60], [Vertex::EMPTY; VERTEX_COUNT]);
        let knobs = (hither::Quick::<8>, hither::PerspectiveEvery::<16>);
        let (picture, moment) = (Viewport::new(80, 60).unwrap(), Moment { number: 5, frames: 8 });
        let target = Framebuffer::<Rgb565Be>::try_new(&mut whole, 80, 60).unwrap();
        draw_onto(target, picture, knobs, &mut depth, moment, &mut cache).unwrap();
        let mut words = [0; 80 * 13];
        for band in picture.bands(words.len()).unwrap() {
            let target = band.framebuffer::<Rgb565Be>(&mut words).unwrap();
            draw_onto(target, band.viewport(), knobs, &mut depth, moment, &mut cache).unwrap();
            let rows = &whole[band.y() as usize * 80..][..band.pixels()];
            assert_eq!(&words[..band.pixels()], rows, "{band:?}");
        }
        let target = Framebuffer::<Rgb565Be>::try_new(&mut whole, 80, 60).unwrap();
        let error = draw_onto(target, picture, knobs, &mut depth[..4799], moment, &mut cache);
        assert!(matches!(error, Err(SceneError::Buffer(_))));
    }
}
