//! Drawing a point's triangles on the host: each by itself, or all of a scene.
//!
//! Both by the same code, so that a point is compiled but twice: with texture coordinates as what a texture is asked for,
//! and with colours.

use super::ideal::Ideal;
use hither::{
    Cull, Fragment, Frame, Framebuffer, Hither, I16F16, Less, ModelPosition, Outcome, PixelFormat,
    Rgb565, Sample, Vertex, VertexStage,
};
use hither_scenes::trade::{
    Attribute, DepthKnob, Depths, HEIGHT, Knobs, PIXELS, Scene, Stage, WIDTH, textured,
};

/// The coordinates that a texture is asked for, raw Q16.16, or as much of them as a packed word has: their fractions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked;

impl PixelFormat for Asked {
    type Color = [u32; 2];
    type Word = [u32; 2];

    fn encode(color: [u32; 2]) -> [u32; 2] {
        color
    }

    fn decode(word: [u32; 2]) -> [u32; 2] {
        word
    }
}

/// A texture that shows what it is asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asking;

impl Fragment<[u32; 2], 2> for Asking {
    const WRAPS: bool = true;

    fn shade(&self, sample: Sample<2>) -> [u32; 2] {
        sample.varyings.map(|v| v.to_bits() as u32)
    }

    fn shade_lanes(&self, word: u32, _: i32, _: i32) -> Option<[u32; 2]> {
        Some([word & 0xffff, word >> 16])
    }
}

/// What a pixel holds that nothing was drawn to. Where a colour is the same, it is not compared.
pub(super) trait Blank: PixelFormat {
    /// The word.
    const BLANK: Self::Word;
}

impl Blank for Asked {
    const BLANK: [u32; 2] = [0x8000_0001; 2];
}

impl Blank for Rgb565 {
    const BLANK: u16 = 0x0821;
}

/// The texels that are asked for, black where nothing is.
pub(super) fn texels(asked: &[[u32; 2]]) -> Vec<u16> {
    let texture = textured().0;
    let texel = |uv: &[u32; 2]| {
        let [u, v] = uv.map(|bits| I16F16::from_bits(bits as i32));
        if *uv == Asked::BLANK { 0 } else { texture.nearest(u, v).map_or(0, |color| color.0) }
    };
    asked.iter().map(texel).collect()
}

/// A pixel that was drawn: column, row and what it shows.
pub(super) type Pixel<C> = (u32, u32, C);

/// Words of depth, and what is drawn on them.
pub(super) struct Canvas {
    /// Of 16 bits.
    pub(super) short: Box<[u16; PIXELS]>,
    /// Of 32 bits.
    pub(super) long: Box<[u32; PIXELS]>,
}

/// A frame of a point.
type Framed<'a, K, F> = Frame<
    Framebuffer<'a, F>,
    <<K as Knobs>::Depth as DepthKnob>::Test<'a, Less>,
    Hither,
    <K as Knobs>::Tier,
    <K as Knobs>::Correction,
>;

impl Canvas {
    pub(super) fn new() -> Self {
        let full = "as many words as pixels";
        Self {
            short: vec![0; PIXELS].into_boxed_slice().try_into().expect(full),
            long: vec![0; PIXELS].into_boxed_slice().try_into().expect(full),
        }
    }

    /// A frame over words that are made blank, and farthest depths.
    fn frame<'a, K: Knobs, F: Blank>(
        &'a mut self,
        scene: Scene,
        words: &'a mut [F::Word],
        blank: F::Word,
    ) -> Framed<'a, K, F> {
        let full = "as many words as pixels";
        self.short.fill(u16::MAX);
        self.long.fill(u32::MAX);
        words.fill(blank);
        let depths = Depths { short: &mut self.short, long: &mut self.long };
        let target = Framebuffer::<F>::try_new(words, WIDTH, HEIGHT).expect(full);
        let frame = Frame::new(target)
            .expect("sides in range")
            .with_tier(K::Tier::default())
            .with_correction(K::Correction::default())
            .with_hither(scene.hither().expect("in front of the eye"));
        K::Depth::with(frame, depths).expect(full)
    }

    /// A scene's vertices as a point snaps them.
    pub(super) fn snapped<K: Knobs, F: Blank, const N: usize>(
        &mut self,
        ideal: &Ideal,
        words: &mut [F::Word],
    ) -> Vec<Vertex<K::Tier, N>>
    where
        K::Stage: VertexStage<Attribute, N>,
    {
        let frame = self.frame::<K, F>(ideal.scene, words, F::BLANK);
        let stage = K::Stage::of(&ideal.scene.transform().expect("constants in range"));
        let fraction_bits = ideal.scene.fraction_bits();
        let snap = |corner: &super::ideal::Corner| {
            let raw = corner.raw.map(i32::from);
            let (clip, varyings) =
                stage.vertex(ModelPosition { raw, fraction_bits }, &corner.attribute);
            frame.snap(&clip, varyings)
        };
        ideal.corners.iter().map(snap).collect()
    }

    /// Draws a triangle by itself, whichever way it faces: its pixels in rows from the top, and whether it turns its front.
    pub(super) fn triangle<K: Knobs, F: Blank<Word: PartialEq>, const N: usize>(
        &mut self,
        scene: Scene,
        words: &mut [F::Word],
        corners: [&Vertex<K::Tier, N>; 3],
        shader: &impl Fragment<F::Color, N>,
    ) -> (Vec<Pixel<F::Color>>, bool) {
        let mut is_front = true;
        let frame = self.frame::<K, F>(scene, words, F::BLANK);
        let mut frame = frame.with_cull(Cull::Back);
        if frame.draw_snapped(corners, shader) == Outcome::Culled {
            is_front = false;
            frame.set_cull(Cull::Front);
            frame.draw_snapped(corners, shader);
        }
        drop(frame);
        let drawn = words.iter().enumerate().filter(|(_, word)| **word != F::BLANK);
        let place = |at: usize| (at as u32 % WIDTH, at as u32 / WIDTH);
        let pixels = drawn.map(|(at, &word)| (place(at).0, place(at).1, F::decode(word)));
        (pixels.collect(), is_front)
    }

    /// Draws all of a scene over words of one kind.
    pub(super) fn picture<K: Knobs, F: Blank, const N: usize>(
        &mut self,
        ideal: &Ideal,
        words: &mut [F::Word],
        blank: F::Word,
        vertices: &[Vertex<K::Tier, N>],
        shader: &impl Fragment<F::Color, N>,
    ) {
        let frame = self.frame::<K, F>(ideal.scene, words, blank);
        let mut frame = frame.with_cull(ideal.scene.cull());
        for triangle in &ideal.triangles {
            frame.draw_snapped(triangle.corners.map(|i| &vertices[i]), shader);
        }
    }
}
