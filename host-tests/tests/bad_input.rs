//! What cannot be drawn is an error that says why, or an outcome that is counted; nothing panics
//! and nothing is half drawn.

use hither::{
    Affine, Always, BufferSize, ClipVertex, Correction, Counts, DepthBuffer, DepthSize, Exact,
    Flat, Fragment, Frame, Framebuffer, Gouraud, Gray8, Hither, HitherDistance, I16F16, Mat4, Mesh,
    MeshError, Outcome, Perspective, PerspectiveEvery, Plane, Quick, Rect, Rgb565, Target, Texture,
    Tier, Viewport, ViewportSize,
};
use host_tests::oracle::{self, ExactTriangle, Part, Rng};
use host_tests::record::{Mark, Probe, Record, clip_vertex, frame};
use host_tests::snapped;

fn fixed(value: f64) -> I16F16 {
    I16F16::from_num(value)
}

#[test]
fn buffers_that_do_not_hold_their_size() {
    let mut words = [0u16; 11];
    let error = Framebuffer::<Rgb565>::try_new(&mut words, 4, 3).expect_err("12 pixels");
    assert_eq!(error, BufferSize::Words { needed: 12, got: 11 });
    let text = error.to_string();
    assert!(text.contains("12") && text.contains("11"), "{text}");
    let error = DepthBuffer::try_new(&mut words, 3, 4).expect_err("12 pixels");
    assert_eq!(error, BufferSize::Words { needed: 12, got: 11 });
    for (width, height) in [(0, 3), (3, 0), (0, 0), (u32::MAX, u32::MAX), (1 << 16, 1 << 16)] {
        let sides = BufferSize::Sides { width, height };
        let error = Framebuffer::<Rgb565>::try_new(&mut words, width, height).expect_err("sides");
        assert_eq!(error, sides);
        let error = DepthBuffer::try_new(&mut words, width, height).expect_err("sides");
        assert_eq!(error, sides);
    }
    assert!(Texture::<Gray8>::try_new(&[0; 5], 4, 2).is_err());
    assert!(Texture::<Gray8>::try_new(&[], 0, 0).is_err());
}

#[test]
fn frames_whose_parts_do_not_fit() {
    for (width, height) in [(0, 5), (5, 0), (513, 1), (1, u32::MAX)] {
        let error = Frame::new(Record::<()>::new(width, height)).expect_err("a side");
        assert_eq!(error, ViewportSize { width, height });
        assert_eq!(Viewport::new(width, height), Err(error));
    }
    let hither = Hither::new(fixed(1.0)).expect("above 0");
    let mut words = [0u16; 12];
    let depth = DepthBuffer::try_new(&mut words, 3, 4).expect("12 words");
    let frame = Frame::new(Record::<()>::new(4, 3)).expect("sides").with_hither(hither);
    let error = frame.with_depth(depth).expect_err("turned");
    assert_eq!(error, DepthSize { target: (4, 3), depth: (3, 4) });
    for distance in [fixed(0.0), fixed(-1.0), I16F16::MIN] {
        assert_eq!(Hither::new(distance), Err(HitherDistance { distance }));
    }
}

#[test]
fn an_index_out_of_range_is_named() {
    let positions = [[0i16; 3]; 3];
    let faces = [[0, 1, 2], [2, 1, 3]];
    let error = Mesh::try_new(&positions, 0, &[(); 3], &faces).expect_err("three vertices");
    assert_eq!(error, MeshError::Index { triangle: 1, index: 3, vertices: 3 });
    let text = error.to_string();
    assert!(text.contains("triangle 1") && text.contains("index 3"), "{text}");
}

/// A square of 4 x 4 cells, 2 units wide, with a colour a vertex.
struct Square {
    positions: Vec<[i16; 3]>,
    colors: Vec<[u8; 3]>,
    faces: Vec<[u16; 3]>,
}

impl Square {
    fn new() -> Self {
        let places = || (0..5i16).flat_map(|y| (0..5i16).map(move |x| (x, y)));
        let cells = (0..4u16).flat_map(|y| (0..4u16).map(move |x| 5 * y + x));
        Self {
            positions: places().map(|(x, y)| [x - 2, y - 2, 0]).collect(),
            colors: places().map(|(x, y)| [63 * x as u8, 63 * y as u8, 128]).collect(),
            faces: cells.flat_map(|i| [[i, i + 1, i + 6], [i, i + 6, i + 5]]).collect(),
        }
    }

    fn mesh(&self) -> Mesh<'_, [i16; 3], [u8; 3]> {
        Mesh::try_new(&self.positions, 1, &self.colors, &self.faces).expect("indices of 25")
    }

    /// What becomes of it with a cache of `entries`, and the words and depths it leaves.
    fn draw<T: Tier>(&self, stage: &Mat4, entries: usize) -> (Counts, Vec<u16>, Vec<u16>) {
        let (mut words, mut depths) = (vec![0u16; 40 * 30], vec![0u16; 40 * 30]);
        let target = Framebuffer::<Rgb565>::try_new(&mut words, 40, 30).expect("1200 words");
        let depth = DepthBuffer::try_new(&mut depths, 40, 30).expect("1200 words");
        let mut frame = Frame::new(target)
            .expect("sides")
            .with_tier(T::default())
            .with_hither(Hither::new(fixed(0.5)).expect("above 0"))
            .with_depth(depth)
            .expect("the same size");
        frame.clear(Rgb565(0));
        let mut cache = vec![hither::Vertex::EMPTY; entries];
        let counts = frame.draw(&self.mesh(), stage, &Gouraud, &mut cache);
        (counts, words, depths)
    }
}

/// A camera that looks at the origin from `distance` away, or away from it where that is negative.
fn camera(distance: f64) -> Mat4 {
    let lens =
        Mat4::perspective(fixed(1.2), fixed(4.0 / 3.0), fixed(0.5), fixed(50.0)).expect("a lens");
    let away = Mat4::translation([fixed(0.0), fixed(0.0), fixed(-distance)]);
    let turn = Mat4::rotation_x(hither::Angle::from_turns(fixed(0.1)).sin_cos());
    lens.times(&away.times(&turn).expect("small")).expect("small")
}

#[test]
fn what_is_behind_the_eye_is_counted() {
    let square = Square::new();
    let all = square.faces.len() as u32;
    let (counts, words, _) = square.draw::<Exact>(&camera(-4.0), 25);
    assert_eq!(counts, Counts { behind: all, ..Counts::default() });
    assert!(words.iter().all(|&word| word == 0));
    let (counts, words, _) = square.draw::<Quick<8>>(&camera(3.0), 25);
    assert_eq!((counts.drawn, counts.behind), (all, 0));
    assert!(words.iter().any(|&word| word != 0));
}

#[test]
fn the_empty_vertex_has_no_area() {
    let empty = hither::Vertex::<Quick<8>, 0>::EMPTY;
    let mut words = [0u16; 16];
    let buffer = Framebuffer::<Rgb565>::try_new(&mut words, 4, 4).expect("16 pixels");
    let mut frame = Frame::new(buffer).expect("small").with_tier(Quick::<8>);
    let outcome = frame.draw_snapped([&empty; 3], &Flat(Rgb565::WHITE));
    assert_eq!((outcome, words), (Outcome::ZeroArea, [0; 16]));
}

#[test]
fn what_has_no_area_is_counted() {
    let square = Square::new();
    let all = square.faces.len() as u32;
    // Everything onto one point in front of the eye; everything onto the eye itself.
    let zero = [I16F16::ZERO; 4];
    let ahead = [I16F16::ZERO, I16F16::ZERO, I16F16::ZERO, fixed(2.0)];
    let point = Mat4::from_rows([zero, zero, zero, ahead]).expect("small");
    let (counts, words, _) = square.draw::<Exact>(&point, 25);
    assert_eq!(counts, Counts { zero_area: all, ..Counts::default() });
    assert!(words.iter().all(|&word| word == 0));
    let eye = Mat4::from_rows([zero; 4]).expect("small");
    let (counts, _, _) = square.draw::<Quick<4>>(&eye, 25);
    assert_eq!(counts.behind + counts.zero_area, all);
}

#[test]
fn any_cache_draws_the_same_picture() {
    fn check<T: Tier>(square: &Square) {
        for distance in [0.6, 1.0, 3.0] {
            let full = square.draw::<T>(&camera(distance), 25);
            assert!(full.0.drawn > 0);
            for entries in [0, 1, 7, 24, 26, 100] {
                let other = square.draw::<T>(&camera(distance), entries);
                assert!(other == full, "{entries} entries at {distance}");
            }
        }
    }
    let square = Square::new();
    check::<Exact>(&square);
    check::<Quick<4>>(&square);
    check::<Quick<8>>(&square);
}

#[test]
fn nothing_is_drawn_where_nothing_is_visible() {
    let all = [[-8, -8, 0, 4], [24, -8, 0, 4], [-8, 24, 0, 4]].map(|v| (clip_vertex(v), []));
    let draw = |viewport: Viewport, target: (u32, u32)| {
        let mut frame = Frame::with_viewport(Record::new(target.0, target.1), viewport);
        let outcome = frame.draw_triangle(all, &Mark);
        (outcome, frame.target().pixels.len())
    };
    let viewport = Viewport::new(8, 8).expect("sides");
    assert_eq!(draw(viewport, (8, 8)), (Outcome::Drawn, 64));
    let none = (Outcome::OffScreen, 0);
    assert_eq!(draw(viewport, (0, 0)), none);
    for (x, y) in [(8, 0), (0, -8), (i16::MIN, i16::MAX), (i16::MAX, 0)] {
        assert_eq!(draw(viewport.with_origin(x, y), (8, 8)), none, "{x} {y}");
    }
    let far = (i32::MIN, i32::MAX);
    for (x0, x1) in [(3, 3), (5, 2), (8, far.1), (far.0, 0), (far.1, far.0)] {
        let scissor = Rect { x0, y0: far.0, x1, y1: far.1 };
        assert_eq!(draw(viewport.with_scissor(scissor), (8, 8)), none, "{scissor:?}");
    }
    let whole = Rect { x0: far.0, y0: far.0, x1: far.1, y1: far.1 };
    assert_eq!(draw(viewport.with_scissor(whole), (8, 8)), (Outcome::Drawn, 64));
}

/// Any 32-bit coordinates, mostly at the ends of the type.
fn extreme(rng: &mut Rng) -> [i64; 4] {
    const ENDS: [i64; 9] = [
        i32::MIN as i64,
        i32::MIN as i64 + 1,
        -1,
        0,
        1,
        i32::MAX as i64,
        1 << 30,
        -(1 << 20),
        1 << 14,
    ];
    [(); 4]
        .map(|()| if rng.once_in(4) { rng.signed(i64::from(i32::MAX)) } else { rng.choose(&ENDS) })
}

/// Draws one triangle with everything on, and tells how many pixels.
fn everything<T: Tier, I: Correction, const P: usize>(
    size: (u32, u32),
    vertices: [ClipVertex; 3],
    hither: I16F16,
    planes: [Plane; P],
    varyings: [[I16F16; 2]; 3],
) -> usize {
    let (width, height) = size;
    let mut words = vec![0u32; (width * height) as usize];
    let depth = DepthBuffer::try_new(&mut words, width, height).expect("a word a pixel");
    let mut frame = Frame::new(Record::new(width, height))
        .expect("sides")
        .with_tier(T::default())
        .with_correction(I::default())
        .with_planes(planes)
        .with_hither(Hither::new(hither).expect("above 0"))
        .with_depth(depth.with_compare(Always))
        .expect("the same size");
    let _ = frame.draw_triangle([0, 1, 2].map(|i| (vertices[i], varyings[i])), &Probe);
    let pixels = &frame.target().pixels;
    for &(x, y, shown) in pixels {
        for (axis, value) in shown.into_iter().enumerate() {
            // Beyond 4096 hither distances there is no bound, but this one.
            let ends = varyings.map(|v| i64::from(v[axis].to_bits()));
            let [least, most] =
                [ends.iter().min(), ends.iter().max()].map(|v| v.copied().unwrap_or(0));
            let off = (i64::from(value.to_bits()) - least).max(most - i64::from(value.to_bits()));
            assert!(
                off <= 2 * (most - least) + 2,
                "{x} {y}: {value} of {varyings:?}, {vertices:?}"
            );
        }
    }
    pixels.len()
}

fn extremes<T: Tier>(seed: u64) {
    let mut rng = Rng::new(seed);
    let (mut covered, mut shown) = (0, 0);
    for _ in 0..6000 {
        let size = rng.choose(&[(16, 16), (1, 1), (16, 12), (512, 1), (1, 512), (33, 31)]);
        let viewport = oracle::Viewport::new(size.0, size.1);
        let corners = [(); 3].map(|()| extreme(&mut rng));
        let what = format!("seed {seed} {viewport:?} {corners:?}");
        let vertices = corners.map(clip_vertex);
        let mut frame = frame(viewport).with_tier(T::default()).with_both_sides();
        let points = vertices.map(|v| snapped::in_pixels(frame.snap(&v, []).snapped(), viewport));
        let _ = frame.draw_triangle(vertices.map(|v| (v, [])), &Mark);
        let parts = Part::ALL.map(|part| ExactTriangle::from_pixel_space(points, viewport, part));
        let counts = frame.target_mut().take_counts();
        for ((x, y), count) in viewport.pixels().zip(counts) {
            let expected = parts.iter().filter(|part| part.covers(x, y)).count();
            assert_eq!(usize::from(count), expected, "{x} {y} of {what}");
            covered += expected;
        }
        let raw = |rng: &mut Rng| I16F16::from_bits(extreme(rng)[0] as i32);
        let hither = raw(&mut rng).max(I16F16::DELTA);
        let planes = [(); 2].map(|()| Plane::new([(); 4].map(|()| raw(&mut rng))));
        let varyings = [(); 3].map(|()| [raw(&mut rng), raw(&mut rng)]);
        shown += everything::<T, Perspective, 0>(size, vertices, hither, [], varyings);
        shown += everything::<T, Perspective, 2>(size, vertices, hither, planes, varyings);
        shown += everything::<T, PerspectiveEvery<7>, 2>(size, vertices, hither, planes, varyings);
        shown += everything::<T, Affine, 0>(size, vertices, hither, [], varyings);
    }
    assert!(covered > 100_000 && shown > 20_000, "{covered} {shown}");
}

#[test]
fn the_ends_of_32_bits_in_the_exact_tier() {
    extremes::<Exact>(41);
}

#[test]
fn the_ends_of_32_bits_in_quick4() {
    extremes::<Quick<4>>(42);
}

#[test]
fn the_ends_of_32_bits_in_quick8() {
    extremes::<Quick<8>>(43);
}

#[test]
fn the_ends_of_64_bits_are_shifted_into_32() {
    let mut rng = Rng::new(44);
    for _ in 0..20_000 {
        let ends = [i64::MIN, i64::MAX, i64::MIN + 1, -1, 0, 1, 1 << 62, 1 << 40];
        let wide = |rng: &mut Rng| ClipVertex::from_wide([(); 4].map(|()| rng.choose(&ends)));
        let vertices = [(); 3].map(|()| (wide(&mut rng), []));
        let viewport = oracle::Viewport::new(5, 4);
        let _ = frame(viewport).with_both_sides().draw_triangle(vertices, &Mark);
        let quick = frame(viewport).with_tier(Quick::<8>);
        let _ = quick.with_both_sides().draw_triangle(vertices, &Mark);
        let hither = Hither::new(I16F16::DELTA).expect("above 0");
        let probed = vertices.map(|(v, _)| (v, [fixed(1.0)]));
        let _ = frame(viewport).with_hither(hither).draw_triangle(probed, &Probe);
    }
}

/// A transform whose result leaves 32 bits keeps the vertex where it is on the screen.
#[test]
fn transforms_that_leave_their_range_shift() {
    let large = Mat4::scaling([fixed(8192.0); 3]).expect("at its limit");
    let positions = [[i32::MAX, 0, 0], [0, i32::MAX, 0], [i32::MIN, i32::MIN, 0]];
    let mesh = Mesh::try_new(&positions, 0, &[(); 3], &[[0, 1, 2]]).expect("three vertices");
    let mut words = [0u8; 64];
    let target = Framebuffer::<Gray8>::try_new(&mut words, 8, 8).expect("64 words");
    let mut frame = Frame::new(target).expect("sides");
    let counts = frame.draw(&mesh, &large, &Flat(Gray8(1)), &mut []);
    // The whole screen lies inside, but for w = 1, that is below half a step beside 2^44.
    assert_eq!(counts.drawn + counts.zero_area + counts.behind, 1);
}

/// A target that is told nothing it does not have.
struct Strict([[bool; 16]; 16]);

impl Target for Strict {
    type Color = ();

    fn size(&self) -> (u32, u32) {
        (16, 16)
    }

    fn write(&mut self, x: usize, y: usize, colors: impl Iterator<Item = Option<()>>) {
        for (column, color) in (x..).zip(colors) {
            self.0[y][column] |= color.is_some();
        }
    }
}

/// Draws with vertices that a frame of 512 x 512 has snapped.
fn foreign<T: Tier>() {
    let large = Viewport::new(512, 512).expect("sides");
    let hither = Hither::new(I16F16::DELTA).expect("above 0");
    let tier = |viewport: Viewport| {
        let frame = Frame::with_viewport(Strict([[false; 16]; 16]), viewport);
        frame.with_tier(T::default()).with_hither(hither).with_correction(Affine)
    };
    let snapping = tier(large);
    let mut frame = tier(Viewport::new(16, 16).expect("sides"));
    let corners = [[-1.0, -1.0], [1.0, -1.0], [0.0, 1.0]].map(|xy| xy.map(fixed));
    let clip = corners.map(|[x, y]| ClipVertex::new(x, y, fixed(0.0), fixed(1.0)));
    let [a, b, c] = clip.map(|v| snapping.snap(&v, []));
    frame.draw_snapped([&a, &b, &c], &Flat(()));
    let [a, b, c] = clip.map(|v| snapping.snap(&v, [fixed(1.0); 3]));
    frame.draw_snapped([&a, &b, &c], &Nothing);
}

/// A shader with varyings and no colour.
#[derive(Clone, Copy)]
struct Nothing;

impl Fragment<(), 3> for Nothing {
    fn shade(&self, _: hither::Sample<3>) {}
}

#[test]
fn vertices_of_another_viewport_stay_inside_of_the_target() {
    foreign::<Exact>();
    foreign::<Quick<4>>();
    foreign::<Quick<8>>();
}
