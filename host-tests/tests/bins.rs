//! Bins: bands drawn from them are the full frame to the bit, whatever they have room for, from one thread or from two; and no
//! band is given a triangle that does not reach it.

use hither::{
    Bins, ClipVertex, Correction, Cull, DepthBuffer, Exact, Frame, Framebuffer, Gouraud, Hither,
    I16F16, Interpolates, Mesh, ModelPosition, NoDepth, Packed, PerspectiveEvery, Plane, Quick,
    Rect, Rgb565, Tier, Vertex, VertexStage, Viewport,
};
use host_tests::oracle::{self, Category, GRID, Rng, random_viewport, triangle};
use host_tests::record::{Mark, Record, clip_vertex};
use host_tests::snapped::in_pixels;
use num_rational::BigRational;
use num_traits::Zero;

/// Attributes are clip-space vertices and three varyings.
type Attribute = ([i64; 4], [i32; 3]);

/// Takes the attribute for the vertex.
struct Given;

impl VertexStage<Attribute, 3> for Given {
    fn vertex(&self, _: ModelPosition, (raw, color): &Attribute) -> (ClipVertex, [I16F16; 3]) {
        (clip_vertex(*raw), color.map(I16F16::from_bits))
    }
}

impl VertexStage<Attribute, 0> for Given {
    fn vertex(&self, _: ModelPosition, (raw, _): &Attribute) -> (ClipVertex, [I16F16; 0]) {
        (clip_vertex(*raw), [])
    }
}

/// Triangles, what clips them, and the screen they are on.
#[derive(Clone, Debug)]
struct Case {
    size: (u32, u32),
    scissor: Option<Rect>,
    attributes: Vec<Attribute>,
    triangles: Vec<[u16; 3]>,
    hither: i64,
    plane: [i64; 4],
    cull: Cull,
}

impl Case {
    /// Of any triangles, some of which share corners.
    fn random(rng: &mut Rng) -> Self {
        let any = random_viewport(rng);
        let viewport = oracle::Viewport::new(any.width.min(70), any.height.min(60));
        let mut attributes = Vec::new();
        for _ in 0..rng.range(3, 16) {
            let category = rng.choose(&Category::ALL);
            for [x, y, w] in triangle(category, viewport, rng) {
                let color = [(); 3].map(|()| rng.range(0, 1 << 16) as i32);
                let z = if rng.once_in(4) { rng.signed(GRID) } else { rng.range(0, w.max(0)) };
                attributes.push(([x, y, z, w], color));
            }
        }
        let count = attributes.len() as u16;
        let mut triangles: Vec<_> = (0..count / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let mut corner = || rng.below(count.into()) as u16;
        triangles.extend((0..4).map(|_| [corner(), corner(), corner()]));
        let far = attributes.iter().map(|(raw, _)| raw[3]).max().unwrap_or(1).max(1);
        let mut side = || rng.range(-5, 75) as i32;
        let scissor = Rect { x0: side(), y0: side(), x1: side(), y1: side() };
        Self {
            size: (viewport.width, viewport.height),
            scissor: rng.once_in(3).then_some(scissor),
            attributes,
            triangles,
            hither: rng.magnitude(far),
            plane: if rng.once_in(3) { [(); 4].map(|()| rng.signed(1 << 10)) } else { [0; 4] },
            cull: rng.choose(&[Cull::Neither, Cull::Neither, Cull::Front, Cull::Back]),
        }
    }

    fn viewport(&self) -> Viewport {
        let viewport = Viewport::new(self.size.0, self.size.1).expect("1 to 512");
        self.scissor.map_or(viewport, |scissor| viewport.with_scissor(scissor))
    }

    /// Draws with a mesh of this case's triangles; the mesh borrows its positions.
    fn with_mesh<R>(&self, draw: impl FnOnce(&Mesh<'_, [i16; 3], Attribute>) -> R) -> R {
        let positions = vec![[0; 3]; self.attributes.len()];
        let mesh = Mesh::try_new(&positions, 0, &self.attributes, &self.triangles);
        draw(&mesh.expect("indices in range"))
    }

    fn hither(&self) -> Hither {
        Hither::new(I16F16::from_bits(self.hither as i32)).expect("above 0")
    }

    fn plane(&self) -> Plane {
        Plane::new(self.plane.map(|v| I16F16::from_bits(v as i32)))
    }
}

const BACKGROUND: Rgb565 = Rgb565::new(1, 2, 3);

/// A picture with its depths.
type Picture = (Vec<u16>, Vec<u16>);

/// A frame over the words of a band of a case.
fn frame<'a, T: Tier, I: Correction>(
    case: &Case,
    band: Viewport,
    rows: u32,
    (color, depth): (&'a mut [u16], &'a mut [u16]),
) -> Frame<Framebuffer<'a, Rgb565>, DepthBuffer<'a>, Hither, T, I, 1> {
    let width = case.size.0;
    let target = Framebuffer::try_new(color, width, rows).expect("a word a pixel");
    let depth = DepthBuffer::try_new(depth, width, rows).expect("a word a pixel");
    let frame = Frame::with_viewport(target, band)
        .with_tier(T::default())
        .with_correction(I::default())
        .with_planes([case.plane()])
        .with_hither(case.hither())
        .with_cull(case.cull);
    let mut frame = frame.with_depth(depth).expect("the same size");
    frame.clear(BACKGROUND);
    frame
}

/// The whole picture at once.
fn whole<T: Tier, I: Correction>(case: &Case) -> Picture {
    let (width, height) = case.size;
    let mut words = [(); 2].map(|()| vec![0; (width * height) as usize]);
    let [color, depth] = &mut words;
    let mut frame = frame::<T, I>(case, case.viewport(), height, (color, depth));
    case.with_mesh(|mesh| frame.draw(mesh, &Given, &Gouraud, &mut []));
    let [color, depth] = words;
    (color, depth)
}

/// Bands of `rows` rows from bins of `B` entries, through a cache of `cached` vertices.
fn banded<T: Tier, I: Correction, const B: usize>(
    case: &Case,
    rows: usize,
    cached: usize,
    bins: &mut Bins<B>,
) -> Picture {
    let (width, height) = case.size;
    let mut words = [(); 2].map(|()| vec![0; width as usize * rows.min(height as usize)]);
    let mut picture = (Vec::new(), Vec::new());
    let mut cache = vec![Vertex::EMPTY; cached];
    for band in case.viewport().bands(words[0].len()).expect("a row or more") {
        let [color, depth] = &mut words;
        let mut frame = frame::<T, I>(case, band.viewport(), band.rows(), (color, depth));
        let pixels = case.with_mesh(|mesh| {
            if band.y() == 0 {
                frame.bin(mesh, &Given, &mut cache, bins);
            }
            frame.draw_bin(mesh, &Given, &Gouraud, &cache, bins);
            band.pixels()
        });
        picture.0.extend_from_slice(&words[0][..pixels]);
        picture.1.extend_from_slice(&words[1][..pixels]);
    }
    picture
}

fn bands_are_the_frame<T: Tier, I: Correction>(seed: u64) {
    let mut rng = Rng::new(seed);
    let (mut full, mut drawn) = (0, 0);
    for _ in 0..400 {
        let case = Case::random(&mut rng);
        let expected = whole::<T, I>(&case);
        drawn += usize::from(expected.0.iter().any(|&color| color != BACKGROUND.0));
        // Of one row, of any, and higher than the picture.
        let rows = [1, rng.range(1, 60) as usize, 100];
        let cached = rng.range(0, case.attributes.len() as i64) as usize;
        for rows in rows {
            let mut store = (Bins::<0>::new(), Bins::<3>::new(), Bins::<64>::new());
            let what = || format!("bands of {rows} rows, seed {seed}, {case:?}");
            let banded = banded::<T, I, 0>(&case, rows, cached, &mut store.0);
            assert_eq!(banded, expected, "no room, {}", what());
            let banded = self::banded::<T, I, 3>(&case, rows, cached, &mut store.1);
            assert_eq!(banded, expected, "room for 3, {}", what());
            full += usize::from(store.1.unbinned() > 0);
            let banded = self::banded::<T, I, 64>(&case, rows, cached, &mut store.2);
            assert_eq!(banded, expected, "room for all, {}", what());
            assert_eq!(store.2.unbinned(), 0);
        }
    }
    assert!(full > 150 && drawn > 150, "{full} were full, {drawn} had pixels");
}

#[test]
fn bands_from_bins_are_the_frame_in_the_exact_tier() {
    bands_are_the_frame::<Exact, hither::Perspective>(61);
}

#[test]
fn bands_from_bins_are_the_frame_in_quick4() {
    bands_are_the_frame::<Quick<4>, PerspectiveEvery<8>>(62);
}

#[test]
fn bands_from_bins_are_the_frame_in_quick8() {
    bands_are_the_frame::<Quick<8>, Packed<PerspectiveEvery<8>>>(63);
}

/// Whether a part of a triangle has a point on the line through the centres of a row, between two places in half
/// pixels, by exact rationals. The part behind has its edge functions negated.
fn reaches(points: [[i64; 3]; 3], behind: bool, halves: (i32, i32), row: u32) -> bool {
    let [p, q, r] = points.map(|v| v.map(i128::from));
    let cross = |a: [i128; 3], b: [i128; 3]| {
        let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
        [minor(1, 2), minor(2, 0), minor(0, 1)]
    };
    let edges = [cross(q, r), cross(r, p), cross(p, q)];
    let determinant: i128 = (0..3).map(|i| edges[0][i] * p[i]).sum();
    let sign = if behind { -determinant.signum() } else { determinant.signum() };
    let whole = |v: i128| BigRational::from_integer(v.into());
    // x in [low, high] such that each sign (a x + b (row + 1/2) + c) is 0 or more.
    let [mut low, mut high] = [halves.0, halves.1].map(|half| whole(half.into()) / whole(2));
    for [a, b, c] in edges {
        let (a, rest) = (whole(sign * a), whole(sign * (b * (2 * i128::from(row) + 1) + 2 * c)));
        if a.is_zero() {
            if rest < BigRational::zero() {
                return false;
            }
            continue;
        }
        let at = -rest / (whole(2) * &a);
        if a > BigRational::zero() {
            low = low.max(at);
        } else {
            high = high.min(at);
        }
    }
    determinant != 0 && low <= high
}

/// Which rows a mesh's triangles are said to reach, against what they reach; how many were said and how many are reached.
fn check_rows<W: Interpolates<0>, T: Tier>(
    case: &Case,
    frame: Frame<Record<()>, NoDepth, W, T, hither::Affine>,
) -> (usize, usize) {
    let vertices: Vec<Vertex<T>> =
        case.attributes.iter().map(|(raw, _)| frame.snap(&clip_vertex(*raw), [])).collect();
    let mut cache = vec![Vertex::EMPTY; vertices.len()];
    let mut bins = Bins::<64>::new();
    case.with_mesh(|mesh| frame.bin(mesh, &Given, &mut cache, &mut bins));
    let whole = Rect { x0: 0, y0: 0, x1: case.size.0 as i32, y1: case.size.1 as i32 };
    let scissor = case.scissor.map_or(whole, |scissor| whole.intersect(scissor));
    let viewport = oracle::Viewport::new(case.size.0, case.size.1);
    let (mut said, mut reached) = (0, 0);
    for row in 0..case.size.1 {
        let inside = (scissor.y0..scissor.y1).contains(&(row as i32));
        let faces: Vec<_> = bins.faces(row, row + 1).collect();
        assert!(faces.windows(2).all(|pair| pair[0] < pair[1]), "in order, each once: {faces:?}");
        for (face, indices) in case.triangles.iter().enumerate() {
            let corners = indices.map(|i| in_pixels(vertices[usize::from(i)].snapped(), viewport));
            let reaches = |halves| {
                let part = |behind| self::reaches(corners, behind, halves, row);
                inside && (part(false) || (W::BEHIND && part(true)))
            };
            let listed = faces.contains(&face);
            said += usize::from(listed);
            // Between the first and the last centre, and between the sides.
            reached += usize::from(reaches((2 * scissor.x0 + 1, 2 * scissor.x1 - 1)));
            let may = !listed || reaches((2 * scissor.x0, 2 * scissor.x1));
            assert!(may, "face {face} in row {row} of {case:?}");
        }
    }
    (said, reached)
}

fn no_other_rows<T: Tier>(seed: u64) {
    let mut rng = Rng::new(seed);
    let (mut said, mut reached) = (0, 0);
    for _ in 0..250 {
        let case = Case { cull: Cull::Neither, ..Case::random(&mut rng) };
        let frame = || {
            let frame = Frame::with_viewport(Record::new(1, 1), case.viewport());
            frame.with_tier(T::default()).with_correction(hither::Affine)
        };
        let counts = [check_rows(&case, frame()), check_rows(&case, frame().with_both_sides())];
        for (one, other) in counts {
            said += one;
            reached += other;
        }
    }
    // What is reached but not said covers no pixel's centre.
    assert!(said * 10 > reached * 9, "{said} of {reached}, seed {seed}");
}

#[test]
fn no_band_has_a_triangle_that_does_not_reach_it_in_the_exact_tier() {
    no_other_rows::<Exact>(71);
}

#[test]
fn no_band_has_a_triangle_that_does_not_reach_it_in_quick4() {
    no_other_rows::<Quick<4>>(72);
}

#[test]
fn no_band_has_a_triangle_that_does_not_reach_it_in_quick8() {
    no_other_rows::<Quick<8>>(73);
}

/// Two threads draw every other band each, from the same bins and vertices, and share nothing else.
#[test]
fn two_threads_draw_the_frame() {
    let mut rng = Rng::new(81);
    for _ in 0..40 {
        let case = Case::random(&mut rng);
        let expected = whole::<Quick<8>, PerspectiveEvery<8>>(&case);
        let (width, height) = case.size;
        let rows = rng.range(1, 20) as u32;
        let mut cache = vec![Vertex::EMPTY; case.attributes.len()];
        let mut bins = Bins::<64>::new();
        let mut words = [(); 2].map(|()| vec![0; (width * height) as usize]);
        case.with_mesh(|mesh| {
            let (mut color, mut depth) = (vec![0; width as usize], vec![0; width as usize]);
            let any = frame::<Quick<8>, PerspectiveEvery<8>>(
                &case,
                case.viewport(),
                1,
                (&mut color, &mut depth),
            );
            any.bin(mesh, &Given, &mut cache, &mut bins);
            let (bins, cache, case) = (&bins, &cache, &case);
            let [color, depth] = &mut words;
            let band = (width * rows) as usize;
            let bands = case.viewport().bands(band).expect("a row or more");
            let parts = color.chunks_mut(band).zip(depth.chunks_mut(band)).zip(bands);
            let (mut even, mut odd) = (Vec::new(), Vec::new());
            for (i, part) in parts.enumerate() {
                if i % 2 == 0 { even.push(part) } else { odd.push(part) }
            }
            std::thread::scope(|scope| {
                for half in [even, odd] {
                    scope.spawn(move || {
                        for (words, band) in half {
                            let mut frame = frame::<Quick<8>, PerspectiveEvery<8>>(
                                case,
                                band.viewport(),
                                band.rows(),
                                words,
                            );
                            frame.draw_bin(mesh, &Given, &Gouraud, cache, bins);
                        }
                    });
                }
            });
        });
        let [color, depth] = words;
        assert_eq!((color, depth), expected, "{case:?}");
    }
}

/// A face number that has no room in an entry is tried in every band, as all after it.
#[test]
fn faces_beyond_16_bits_are_drawn() {
    let attributes: [Attribute; 6] = [
        ([-100, -100, 0, 1], [0; 3]),
        ([-100, -101, 0, 1], [0; 3]),
        ([-101, -100, 0, 1], [0; 3]),
        ([-1, -1, 0, 1], [0; 3]),
        ([3, -1, 0, 1], [0; 3]),
        ([-1, 3, 0, 1], [0; 3]),
    ];
    let mut triangles = vec![[0, 1, 2]; (1 << 16) + 3];
    *triangles.last_mut().expect("some") = [3, 4, 5];
    let mesh = Mesh::try_new(&[[0_i16; 3]; 6], 0, &attributes, &triangles).expect("in range");
    let mut frame = Frame::new(Record::new(4, 4)).expect("4 x 4");
    let mut bins = Bins::<2>::new();
    let mut cache = [Vertex::EMPTY; 6];
    frame.bin(&mesh, &Given, &mut cache, &mut bins);
    assert_eq!((bins.len(), bins.unbinned()), (0, 1), "those beyond a side take no room");
    triangles[1 << 16] = [3, 4, 5];
    let mesh = Mesh::try_new(&[[0_i16; 3]; 6], 0, &attributes, &triangles).expect("in range");
    let counts = frame.bin(&mesh, &Given, &mut cache, &mut bins);
    assert_eq!((counts.off_screen, bins.unbinned()), (1 << 16, 3), "nor those below 2^16");
    let counts = frame.draw_bin(&mesh, &Given, &Mark, &cache, &bins);
    assert_eq!((counts.drawn, frame.target().pixels.len()), (2, 32));
}
