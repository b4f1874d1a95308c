//! The whole draw: any matrices, meshes, planes, sizes, buffers, textures, corrections and depths.
#![no_main]

use arbitrary::Arbitrary;
use hither::{
    Affine, Always, AsVaryings, BufferSize, Compare, Correction, Counts, Cull, DepthBuffer,
    DepthWord, DividedBy, Exact, FaceColors, Flat, Fragment, Frame, Framebuffer, Gouraud, Gray8,
    Hither, I16F16, Interpolates, Less, Lit, Mat4, Mesh, MeshError, NoDepth, NormalColor, Packed,
    Perspective, PerspectiveEvery, PixelFormat, Plane, Quick, Rgb565, Rgb565Be, Rgb888, Sample,
    Table, Target, Texture, Textured, Tier, Vertex, VertexStage, Wide,
};
use hither_fuzz::matrix::{Step, product};
use hither_fuzz::number::{Coefficients, Raw, vector};
use hither_fuzz::place::Place;
use hither_fuzz::target::Checked;
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Debug)]
struct Input {
    place: Place,
    steps: Vec<Step>,
    hither: Raw,
    planes: [Coefficients; 2],
    positions: Vec<[Raw; 3]>,
    fraction_bits: u8,
    attributes: [Raw; 4],
    triangles: Vec<[u8; 3]>,
    /// Entries of the cache that holds some of the vertices.
    cache: u8,
    /// Which tier, correction, depth and fragment.
    choice: u16,
    cull: u8,
    texture: (u8, u8, u8),
    buffer: (u32, u32, u16),
    light: ([Raw; 3], Raw, Raw),
}

/// A mesh's data, all in range.
struct Scene<'a> {
    input: &'a Input,
    place: Place,
    positions: &'a [[i32; 3]],
    triangles: &'a [[u16; 3]],
    matrix: Mat4,
}

/// A colour that depends on everything a fragment is given. The last varying is constant.
#[derive(Clone, Copy, Debug)]
struct Mix(I16F16);

impl Fragment<Rgb565, 4> for Mix {
    fn shade(&self, sample: Sample<4>) -> Rgb565 {
        let [a, b, c, constant] = sample.varyings;
        assert_eq!(constant, self.0);
        let all = a.to_bits() ^ b.to_bits() ^ c.to_bits() ^ sample.x ^ sample.y;
        Rgb565((all ^ (all >> 16)) as u16)
    }
}

/// What a picture came to.
type Result = (Counts, Vec<Option<Rgb565>>);

impl Scene<'_> {
    fn cull(&self) -> Cull {
        match self.input.cull % 4 {
            0 => Cull::Front,
            1 => Cull::Back,
            _ => Cull::Neither,
        }
    }

    fn mesh<'a, A>(&'a self, attributes: &'a [A]) -> Mesh<'a, [i32; 3], A> {
        let fraction = u32::from(self.input.fraction_bits % 32);
        let mesh = Mesh::try_new(self.positions, fraction, attributes, self.triangles);
        mesh.expect("indices in range")
    }

    /// One attribute a vertex, from a few numbers.
    fn attributes<A>(&self, attribute: impl Fn(usize, [i32; 4]) -> A) -> Vec<A> {
        let raw = self.input.attributes.map(|raw| raw.0);
        (0..self.positions.len()).map(|i| attribute(i, raw)).collect()
    }

    /// How many triangles there are counts for; fallbacks are among the drawn.
    fn check(&self, counts: &Counts, affine: bool) {
        let Counts { drawn, fallbacks, culled, behind, clipped, off_screen, zero_area } = *counts;
        let all = drawn + culled + behind + clipped + off_screen + zero_area;
        assert_eq!(all as usize, self.triangles.len(), "{counts:?}");
        assert!(fallbacks <= drawn && (affine || fallbacks == 0), "{counts:?}");
        assert!(culled == 0 || self.cull() != Cull::Neither, "{counts:?}");
    }

    /// Lengths of caches that draw the same picture.
    fn caches(&self) -> [usize; 3] {
        let some = usize::from(self.input.cache) % (self.positions.len() + 2);
        [self.positions.len(), 0, some]
    }
}

/// Pictures without depth through caches of all lengths.
fn without_depth<T, I, W, A, S, F, const N: usize>(
    scene: &Scene,
    range: impl Fn(Frame<Checked<Rgb565>>) -> Frame<Checked<Rgb565>, NoDepth, W>,
    attributes: &[A],
    stage: &S,
    fragment: &F,
) where
    T: Tier,
    I: Correction,
    W: Interpolates<N>,
    S: VertexStage<A, N>,
    F: Fragment<Rgb565, N>,
{
    let mut first: Option<Result> = None;
    for cache in scene.caches() {
        let mut cache = vec![Vertex::EMPTY; cache];
        let target = Checked::new(&scene.place).with_overdraw();
        let mut frame = range(Frame::with_viewport(target, scene.place.viewport()))
            .with_tier(T::default())
            .with_correction(I::default())
            .with_cull(scene.cull());
        let counts = frame.draw(&scene.mesh(attributes), stage, fragment, &mut cache);
        scene.check(&counts, I::AFFINE);
        let result = (counts, frame.into_parts().0.pixels);
        let expected = first.get_or_insert_with(|| result.clone());
        assert_eq!(result, *expected);
    }
}

/// Pictures with depth and planes through caches of all lengths: depth only gets nearer, and
/// exactly where something is drawn.
fn with_depth<T, I, D, O, A, S, F, const N: usize>(
    scene: &Scene,
    hither: Hither,
    attributes: &[A],
    stage: &S,
    fragment: &F,
) where
    T: Tier,
    I: Correction,
    D: DepthWord + From<u16>,
    O: Compare,
    S: VertexStage<A, N>,
    F: Fragment<Rgb565, N>,
{
    let (width, height) = scene.place.target;
    let planes: [Plane; 2] = scene.input.planes.map(|plane| plane.planes()[0]);
    let mixed = |i: usize| D::from((i as u16).wrapping_mul(40_503) | 1);
    let fill = |i: usize| if scene.input.cull & 4 == 0 { D::FAR } else { mixed(i) };
    let before: Vec<D> = (0..width as usize * height as usize).map(fill).collect();
    let mut first: Option<(Result, Vec<D>)> = None;
    for cache in scene.caches() {
        let mut cache = vec![Vertex::EMPTY; cache];
        let mut words = before.clone();
        let depth = DepthBuffer::try_new(&mut words, width, height).expect("sides of 1 or more");
        let target = Checked::new(&scene.place).with_overdraw();
        let mut frame = Frame::with_viewport(target, scene.place.viewport())
            .with_hither(hither)
            .with_depth(depth.with_compare(O::default()))
            .expect("the target's size")
            .with_tier(T::default())
            .with_correction(I::default())
            .with_planes(planes)
            .with_cull(scene.cull());
        let counts = frame.draw(&scene.mesh(attributes), stage, fragment, &mut cache);
        scene.check(&counts, I::AFFINE);
        let pixels = frame.into_parts().0.pixels;
        monotone::<D, O>(&scene.place, &pixels, &before, &words);
        let result = ((counts, pixels), words);
        let expected = first.get_or_insert_with(|| result.clone());
        assert_eq!(result, *expected);
    }
}

/// Depth against what it was.
fn monotone<D: DepthWord, O: Compare>(
    place: &Place,
    pixels: &[Option<Rgb565>],
    before: &[D],
    after: &[D],
) {
    let less = !O::passes(D::FAR, D::FAR);
    let mut drawn = vec![false; before.len()];
    for ((x, y), pixel) in place.pixels().zip(pixels) {
        if pixel.is_some() {
            let (x, y) = (x + i64::from(place.origin.0), y + i64::from(place.origin.1));
            drawn[(y * i64::from(place.target.0) + x) as usize] = true;
        }
    }
    for ((before, after), drawn) in before.iter().zip(after).zip(drawn) {
        if less {
            assert_eq!(after < before, drawn, "{before:?} to {after:?}");
            assert!(after <= before);
        } else {
            assert!(drawn || after == before);
        }
    }
}

/// One fragment with depth or without.
fn fragment<T, I, A, S, F, const N: usize>(
    scene: &Scene,
    hither: Hither,
    attributes: &[A],
    stage: &S,
    fragment: &F,
) where
    T: Tier,
    I: Correction,
    S: VertexStage<A, N>,
    F: Fragment<Rgb565, N>,
{
    match scene.input.choice >> 8 & 3 {
        0 => with_depth::<T, I, u16, Less, A, S, F, N>(scene, hither, attributes, stage, fragment),
        1 => with_depth::<T, I, u32, Less, A, S, F, N>(scene, hither, attributes, stage, fragment),
        2 => {
            with_depth::<T, I, u16, Always, A, S, F, N>(scene, hither, attributes, stage, fragment)
        }
        _ => without_depth::<T, I, Hither, A, S, F, N>(
            scene,
            |frame| frame.with_hither(hither),
            attributes,
            stage,
            fragment,
        ),
    }
}

/// Any fragment, with a hither plane.
fn shaded<T: Tier, I: Correction>(scene: &Scene, hither: Hither) {
    let input = scene.input;
    let raw = |i: usize, raw: i32| I16F16::from_bits(raw.wrapping_mul(i as i32 * 2 + 1));
    match input.choice >> 12 & 3 {
        0 => {
            let none = scene.attributes(|_, _| ());
            fragment::<T, I, _, _, _, 0>(scene, hither, &none, &scene.matrix, &Flat(Rgb565::RED));
        }
        1 => {
            let (width, height, seed) = input.texture;
            let (width, height) = (u32::from(width % 9), u32::from(height % 9));
            let texels: Vec<u16> =
                (0..64).map(|i: u16| i.wrapping_mul(257) ^ u16::from(seed)).collect();
            let texels = &texels[..((width * height) as usize).min(64)];
            if let Ok(texture) = Texture::<Rgb565>::try_new(texels, width, height) {
                let uv = scene.attributes(|i, [u, v, ..]| [raw(i, u), raw(i, v)]);
                let textured = Textured(texture);
                fragment::<T, I, _, _, _, 2>(scene, hither, &uv, &scene.matrix, &textured);
            } else {
                assert_eq!(width * height, 0);
            }
        }
        2 => {
            let normals = scene.attributes(|i, raw| NormalColor {
                normal: [raw[0], raw[1], raw[2].wrapping_add(i as i32 % 2)].map(|v| v as i8),
                color: [raw[3], raw[0], raw[1]].map(|v| v as u8),
            });
            let (towards, ambient, diffuse) = input.light;
            let (ambient, diffuse) = (ambient.fixed(), diffuse.fixed());
            let matrix = scene.matrix;
            let lit = Lit::new(matrix, &matrix, vector(towards), ambient, diffuse);
            if let Ok(lit) = lit {
                fragment::<T, I, _, _, _, 3>(scene, hither, &normals, &lit, &Gouraud);
            }
        }
        _ => {
            let four = scene.attributes(|i, [a, b, c, constant]| {
                [raw(i, a), raw(i, b), raw(i, c), I16F16::from_bits(constant)]
            });
            let mix = Mix(input.attributes[3].fixed());
            fragment::<T, I, _, _, _, 4>(scene, hither, &four, &scene.matrix, &mix);
        }
    }
}

/// Flat faces, in front of the eye and on both sides.
fn flat<T: Tier>(scene: &Scene) {
    let none = scene.attributes(|_, _| ());
    let colors = [1, 2, 3].map(Rgb565);
    let faces = FaceColors::new(&colors).expect("three colours");
    let matrix = &scene.matrix;
    without_depth::<T, Affine, _, _, _, _, 0>(scene, |frame| frame, &none, matrix, &faces);
    without_depth::<T, Perspective, _, _, _, _, 0>(
        scene,
        |frame| frame.with_both_sides(),
        &none,
        matrix,
        &faces,
    );
}

fn tier<T: Tier>(scene: &Scene) {
    flat::<T>(scene);
    if let Ok(hither) = Hither::new(scene.input.hither.fixed()) {
        match scene.input.choice >> 4 & 7 {
            0 => shaded::<T, Perspective>(scene, hither),
            1 => shaded::<T, PerspectiveEvery<2>>(scene, hither),
            2 => shaded::<T, PerspectiveEvery<64>>(scene, hither),
            3 => shaded::<T, Packed<PerspectiveEvery<8>>>(scene, hither),
            4 => shaded::<T, Packed<DividedBy<PerspectiveEvery<64>, Table>>>(scene, hither),
            5 => shaded::<T, Packed<Affine>>(scene, hither),
            6 => shaded::<T, Wide<DividedBy<Perspective, Table>>>(scene, hither),
            _ => shaded::<T, Affine>(scene, hither),
        }
    }
}

/// A framebuffer in a format: sizes are checked, and words past its end are left alone.
fn buffer<F: PixelFormat>(scene: &Scene, word: F::Word)
where
    F::Word: PartialEq + core::fmt::Debug,
    F::Color: hither::FromUnit,
{
    let (width, height, length) = scene.input.buffer;
    let pixels = u64::from(width) * u64::from(height);
    let length = usize::from(length % 4096);
    let mut words = vec![word; length];
    match Framebuffer::<F>::try_new(&mut words, width, height) {
        Ok(_) => assert!(pixels > 0 && pixels <= length as u64),
        Err(BufferSize::Words { needed, got }) => {
            assert!(needed as u64 == pixels && got == length && pixels > length as u64);
        }
        Err(_) => assert!(pixels == 0 || pixels > i32::MAX as u64),
    }
    let (width, height) = (1 + width % 40, 1 + height % 40);
    let needed = (width * height) as usize;
    if let Ok(target) = Framebuffer::<F>::try_new(&mut words, width, height) {
        let mut frame = Frame::with_viewport(target, scene.place.viewport());
        let hither = Hither::new(I16F16::ONE).expect("1 is positive");
        let bytes = scene.attributes(|i, raw| raw.map(|v| (v as u8).wrapping_add(i as u8)));
        let colors: Vec<[u8; 3]> = bytes.iter().map(|&[r, g, b, _]| [r, g, b]).collect();
        frame.target_mut().write(0, 0, core::iter::empty());
        let mut frame = frame.with_hither(hither);
        let counts = frame.draw(&scene.mesh(&colors), &scene.matrix, &Gouraud, &mut []);
        scene.check(&counts, false);
        assert_eq!(frame.target().size(), (width, height));
    }
    assert!(words.iter().skip(needed).all(|&rest| rest == word));
}

/// What a mesh that may be wrong is refused for.
fn refused(input: &Input, positions: &[[i32; 3]]) {
    let triangles: Vec<[u16; 3]> = input.triangles.iter().map(|t| t.map(u16::from)).collect();
    let attributes = vec![[0u8; 2]; usize::from(input.cache)];
    let _: [I16F16; 2] = [0u8; 2].varyings();
    let bits = u32::from(input.fraction_bits);
    let count = positions.len();
    match Mesh::try_new(positions, bits, &attributes, &triangles) {
        Ok(mesh) => assert_eq!(mesh.vertex_count(), attributes.len()),
        Err(MeshError::Fraction { bits }) => assert!(bits > 31),
        Err(MeshError::Attributes { .. }) => assert_ne!(count, attributes.len()),
        Err(MeshError::Index { triangle, index, vertices }) => {
            assert_eq!(vertices, count);
            assert!(triangles[triangle].contains(&index) && usize::from(index) >= count);
        }
        Err(error) => panic!("{error}"),
    }
}

fuzz_target!(|input: Input| {
    let positions: Vec<[i32; 3]> =
        input.positions.iter().take(12).map(|p| p.map(|raw| raw.0)).collect();
    refused(&input, &positions);
    let Some(matrix) = product(&input.steps) else { return };
    let count = positions.len().max(1);
    let in_range = |index: u8| (usize::from(index) % count) as u16;
    let triangles: Vec<[u16; 3]> = if positions.is_empty() {
        Vec::new()
    } else {
        input.triangles.iter().take(16).map(|t| t.map(in_range)).collect()
    };
    let mut place = input.place;
    if place.target.0.max(place.target.1) > 600 || place.target.0.min(place.target.1) == 0 {
        place.target = place.size;
    }
    let (positions, triangles) = (&positions[..], &triangles[..]);
    let scene = Scene { input: &input, place, positions, triangles, matrix };
    match input.choice % 4 {
        0 => tier::<Exact>(&scene),
        1 => tier::<Quick<4>>(&scene),
        2 => tier::<Quick<8>>(&scene),
        _ => match input.choice >> 4 & 3 {
            0 => buffer::<Rgb565Be>(&scene, 0xabcd),
            1 => buffer::<Rgb565>(&scene, 0xabcd),
            2 => buffer::<Rgb888>(&scene, 0xab_cdef),
            _ => buffer::<Gray8>(&scene, 0xab),
        },
    }
});
