//! Lines: their pixels against exact integers, their depths against exact rationals, and that neither depends on the order of the
//! ends or on what a window shows.

use hither::{
    Always, Angle, Counts, Cull, DepthBias, DepthBuffer, DepthWord, Exact, Frame, Hither, I16F16,
    Mat4, Mesh, Outcome, Plane, Quick, Rect, Tier, Vertex, Viewport,
};
use host_tests::oracle::line::{mix, to_f64};
use host_tests::oracle::{
    self, Category, ExactLine, GRID, LinePixel, RationalVertex, Rng, random_viewport, triangle,
};
use host_tests::record::{Mark, Record, clip_vertex};
use host_tests::snapped::{in_pixels, power_of_two, scale};
use num_rational::BigRational;
use num_traits::Signed;

fn raw(v: i64) -> I16F16 {
    I16F16::from_bits(i32::try_from(v).expect("raw Q16.16"))
}

fn library_viewport(viewport: oracle::Viewport) -> Viewport {
    Viewport::new(viewport.width, viewport.height).expect("sides of 1 to 512")
}

/// The pixels of a record, in order.
fn all(record: &Record<()>) -> Vec<LinePixel> {
    let place = |&(x, y, ()): &(u32, u32, ())| LinePixel { x: x as i32, y: y as i32 };
    let mut pixels: Vec<_> = record.pixels.iter().map(place).collect();
    pixels.sort_unstable();
    pixels
}

/// The pixels of a record, in order, none twice.
fn sorted(record: &Record<()>) -> Vec<LinePixel> {
    let pixels = all(record);
    assert!(pixels.windows(2).all(|pair| pair[0] != pair[1]), "a pixel twice: {pixels:?}");
    pixels
}

/// Two vertices of a triangle that is hard on a rasterizer; sometimes one twice.
fn ends(rng: &mut Rng, viewport: oracle::Viewport) -> [[i64; 3]; 2] {
    let category = rng.choose(&Category::ALL);
    let [a, b, _] = triangle(category, viewport, rng);
    match rng.below(16) {
        0 => [a, a],
        1 => [a, b.map(|v| v.clamp(-GRID / 2, GRID / 2) * 2)],
        2 => [a, a.map(|v| -v)],
        3 => [a, a.map(|v| v / 2)],
        _ => [a, b],
    }
}

fn pixels_are_exact<T: Tier>(seed: u64, cases: usize) {
    let mut rng = Rng::new(seed);
    let (mut drawn, mut dots) = (0, 0);
    for _ in 0..cases {
        let viewport = random_viewport(&mut rng);
        let ends = ends(&mut rng, viewport);
        let target = || Record::new(viewport.width, viewport.height);
        let mut front =
            Frame::with_viewport(target(), library_viewport(viewport)).with_tier(T::default());
        let mut both = Frame::with_viewport(target(), library_viewport(viewport))
            .with_tier(T::default())
            .with_both_sides();
        let [a, b] = ends.map(|[x, y, w]| front.snap(&clip_vertex([x, y, 0, w]), []));
        let points = [a, b].map(|v| in_pixels(v.snapped(), viewport));
        let exact = ExactLine::new(points, viewport).pixels();
        let message = || format!("seed {seed}, {ends:?} as {points:?} on {viewport:?}");
        for order in [[&a, &b], [&b, &a]] {
            front.target_mut().pixels.clear();
            let outcome = front.draw_line(order, DepthBias::NONE, &Mark);
            assert_eq!(sorted(front.target()), exact, "{}", message());
            assert_eq!(outcome == Outcome::Drawn, !exact.is_empty(), "{outcome:?}, {}", message());
        }
        let behind = points.map(|point| point.map(|v| -v));
        // Both parts may have the pixel that is between them.
        let mut parts = ExactLine::new(behind, viewport).pixels();
        parts.extend(&exact);
        parts.sort_unstable();
        let [a, b] = ends.map(|[x, y, w]| both.snap(&clip_vertex([x, y, 0, w]), []));
        both.draw_line([&a, &b], DepthBias::NONE, &Mark);
        assert_eq!(all(both.target()), parts, "both sides, {}", message());
        drawn += exact.len();
        dots += usize::from(exact.len() == 1);
    }
    assert!(drawn > 20 * cases && dots > cases / 50, "{drawn} pixels, {dots} dots");
}

#[test]
fn pixels_are_exact_in_the_exact_tier() {
    pixels_are_exact::<Exact>(101, 8000);
}

#[test]
fn pixels_are_exact_with_4_subpixel_bits() {
    pixels_are_exact::<Quick<4>>(102, 6000);
}

#[test]
fn pixels_are_exact_with_8_subpixel_bits() {
    pixels_are_exact::<Quick<8>>(103, 6000);
}

/// Ends at the grid's, the guard band's and the viewport's limits, each with each.
#[test]
fn extreme_ends_are_exact() {
    const VIEWPORT: oracle::Viewport = oracle::Viewport::new(512, 512);
    let values = [-GRID, 1 - GRID, -1, 0, 1, GRID - 1, GRID];
    let mut vertices = Vec::new();
    for x in values {
        for y in values {
            vertices.extend([-GRID, -1, 0, 1, GRID].map(|w| [x, y, w]));
        }
    }
    // The guard band's ends, 1024 pixels from the corner: x + w = 4 w.
    vertices.extend([[3 << 18, 5 << 18, 1 << 18], [-(5 << 18), -(3 << 18), 1 << 18]]);
    fn check<T: Tier>(vertices: &[[i64; 3]]) {
        let target = Record::new(VIEWPORT.width, VIEWPORT.height);
        let mut frame = Frame::new(target).expect("512").with_tier(T::default());
        let snapped: Vec<_> = vertices
            .iter()
            .map(|[x, y, w]| frame.snap(&clip_vertex([*x, *y, 0, *w]), []))
            .collect();
        for (i, a) in snapped.iter().enumerate() {
            for b in snapped.iter().skip(i % 7).step_by(7) {
                frame.target_mut().pixels.clear();
                frame.draw_line([a, b], DepthBias::NONE, &Mark);
                let points = [a, b].map(|v| in_pixels(v.snapped(), VIEWPORT));
                let exact = ExactLine::new(points, VIEWPORT).pixels();
                assert_eq!(sorted(frame.target()), exact, "{points:?}");
            }
        }
    }
    check::<Exact>(&vertices);
    check::<Quick<4>>(&vertices);
    check::<Quick<8>>(&vertices);
}

/// Lines from vertex to vertex are connected, and each vertex on the screen has its pixel.
#[test]
fn polylines_have_no_gaps() {
    let seed = 104;
    let mut rng = Rng::new(seed);
    for _ in 0..3000 {
        let reach = rng.choose(&[1, 3, 10, 40, 300, 3000]);
        let (mut x, mut y) = (rng.range(256, 63 * 256), rng.range(256, 63 * 256));
        let mut corners = Vec::new();
        for _ in 0..5 {
            corners.push([x, y]);
            x = (x + rng.range(-reach, reach)).clamp(256, 63 * 256);
            y = (y + rng.range(-reach, reach)).clamp(256, 63 * 256);
        }
        let mut frame = Frame::new(Record::new(64, 64)).expect("64").with_tier(Quick::<8>);
        let vertices: Vec<_> = corners
            .iter()
            .map(|[x, y]| {
                // In subpixels: exactly on the grid.
                let clip = [2 * x - 64 * 256, 64 * 256 - 2 * y, 0, 64 * 256];
                frame.snap(&clip_vertex(clip), [])
            })
            .collect();
        let mut lines = Vec::new();
        for pair in vertices.windows(2) {
            frame.target_mut().pixels.clear();
            frame.draw_line([&pair[0], &pair[1]], DepthBias::NONE, &Mark);
            lines.push(sorted(frame.target()));
        }
        let near = |a: &LinePixel, b: &LinePixel| (a.x - b.x).abs() <= 1 && (a.y - b.y).abs() <= 1;
        // All pixels that are reached from the first.
        let mut rest: Vec<_> = lines.concat();
        let mut reached = vec![rest[0]];
        let mut at = 0;
        while let Some(pixel) = reached.get(at).copied() {
            let (found, left) = rest.into_iter().partition(|p| near(p, &pixel));
            reached.extend::<Vec<_>>(found);
            rest = left;
            at += 1;
        }
        assert!(rest.is_empty(), "seed {seed}: {corners:?} leaves {rest:?}");
        for ([x, y], line) in corners.iter().zip(&lines) {
            let own = LinePixel { x: (x >> 8) as i32, y: (y >> 8) as i32 };
            let ends_here = |p: &&LinePixel| near(p, &own) && (p.x == own.x || p.y == own.y);
            assert!(line.iter().any(|p| ends_here(&p)), "seed {seed}: {corners:?}, {line:?}");
        }
    }
}

/// A line in space, what clips it and the screen it is on.
#[derive(Clone, Debug)]
struct Case {
    viewport: oracle::Viewport,
    /// `[x, y, z, w]`.
    ends: [[i64; 4]; 2],
    hither: i64,
    plane: [i64; 4],
    bias: DepthBias,
}

impl Case {
    fn random(rng: &mut Rng) -> Self {
        let viewport = random_viewport(rng);
        let ends = ends(rng, viewport).map(|[x, y, w]| {
            let z = match rng.below(4) {
                // In the range, or anywhere within 4 w.
                0..3 if w > 0 => rng.range(0, w),
                _ => rng.range(-4 * w.abs(), 4 * w.abs()),
            };
            [x, y, z, w]
        });
        let largest = ends.iter().map(|end| end[3].abs()).max().unwrap_or(1).max(1);
        let hither = rng.choose(&[1, 1 + largest / 100, 1 + largest / 3]);
        let plane = if rng.once_in(2) { [0; 4] } else { [(); 4].map(|()| rng.signed(1 << 16)) };
        Self { viewport, ends, hither, plane, bias: DepthBias::NONE }
    }

    /// Pixels and depths, in order, with the vertices in pixel space; with a target of some size at an origin, and the ends in
    /// either order.
    fn draw<T: Tier, D: DepthWord>(
        &self,
        viewport: Viewport,
        (width, height): (u32, u32),
        (left, top): (i16, i16),
        swapped: bool,
    ) -> (Vec<(LinePixel, D)>, [hither::Snapped; 2]) {
        let mut words = vec![D::FAR; (width * height) as usize];
        let depth = DepthBuffer::try_new(&mut words, width, height).expect("a word a pixel");
        let viewport = viewport.with_origin(left, top);
        let mut frame = Frame::with_viewport(Record::new(width, height), viewport)
            .with_tier(T::default())
            .with_planes([Plane::new(self.plane.map(raw))])
            .with_hither(Hither::new(raw(self.hither)).expect("above 0"))
            .with_depth(depth.with_compare(Always))
            .expect("the same size");
        let [a, b] = self.ends.map(|end| frame.snap(&clip_vertex(end), [raw(end[0])]));
        let order = if swapped { [&b, &a] } else { [&a, &b] };
        frame.draw_line(order, self.bias, &Mark);
        let (record, depth) = frame.into_parts();
        let words = depth.words();
        let pixels = sorted(&record).into_iter().map(|pixel| {
            let word = words[pixel.y as usize * width as usize + pixel.x as usize];
            let (x, y) = (pixel.x - i32::from(left), pixel.y - i32::from(top));
            (LinePixel { x, y }, word)
        });
        (pixels.collect(), [a, b].map(|v| v.snapped()))
    }

    fn whole<T: Tier, D: DepthWord>(
        &self,
        swapped: bool,
    ) -> (Vec<(LinePixel, D)>, [hither::Snapped; 2]) {
        let oracle::Viewport { width, height } = self.viewport;
        self.draw::<T, D>(library_viewport(self.viewport), (width, height), (0, 0), swapped)
    }
}

fn windows_show_the_same<T: Tier, D: DepthWord>(seed: u64, cases: usize) {
    let mut rng = Rng::new(seed);
    let mut drawn = 0;
    for _ in 0..cases {
        let mut case = Case::random(&mut rng);
        case.bias = DepthBias(rng.choose(&[0, 1, 128, u16::MAX]));
        let oracle::Viewport { width, height } = case.viewport;
        let viewport = library_viewport(case.viewport);
        let (whole, _) = case.whole::<T, D>(false);
        drawn += whole.len();
        assert_eq!(case.whole::<T, D>(true).0, whole, "swapped, seed {seed}, {case:?}");

        let rows = rng.range(1, i64::from(height)) as u32;
        let mut bands = Vec::new();
        for top in (0..height).step_by(rows as usize) {
            let at = (0, -(top as i16));
            bands.extend(case.draw::<T, D>(viewport, (width, rows), at, rng.once_in(2)).0);
        }
        assert_eq!(bands, whole, "bands of {rows} rows, seed {seed}, {case:?}");

        let mut side = |size: u32| rng.range(-5, i64::from(size) + 5) as i32;
        let scissor = Rect { x0: side(width), y0: side(height), x1: side(width), y1: side(height) };
        let cut = viewport.with_scissor(scissor);
        let (cut, _) = case.draw::<T, D>(cut, (width + 3, height + 4), (3, 4), false);
        let inside = |&(LinePixel { x, y }, _): &(LinePixel, D)| {
            (scissor.x0..scissor.x1).contains(&x) && (scissor.y0..scissor.y1).contains(&y)
        };
        let expected: Vec<_> = whole.iter().copied().filter(inside).collect();
        assert_eq!(cut, expected, "{scissor:?}, seed {seed}, {case:?}");
    }
    assert!(drawn > 10 * cases, "{drawn} pixels");
}

#[test]
fn windows_show_the_same_in_the_exact_tier() {
    windows_show_the_same::<Exact, u32>(105, 3000);
}

#[test]
fn windows_show_the_same_with_8_subpixel_bits() {
    windows_show_the_same::<Quick<8>, u32>(106, 3000);
    windows_show_the_same::<Quick<8>, u16>(113, 3000);
}

#[test]
fn windows_show_the_same_with_4_subpixel_bits() {
    windows_show_the_same::<Quick<4>, u16>(114, 3000);
}

/// The largest error of depths.
#[derive(Debug, Default)]
struct Errors {
    /// In units of 2^-16 of the range: both ends in front of the hither plane, and any.
    front: f64,
    crossing: f64,
    pixels: usize,
    /// Pixels that planes leave out.
    cut: usize,
    /// Whether depths are of 16 bits.
    rounded: bool,
}

/// Depths and what planes leave against exact rationals, over the true `z` and the snapped `x`, `y` and `w`.
fn planes_and_depths_are_exact<T: Tier, D: DepthWord + Into<u32>>(
    seed: u64,
    cases: usize,
) -> Errors {
    let full = f64::from(Into::<u32>::into(D::FAR));
    let mut rng = Rng::new(seed);
    let mut errors = Errors { rounded: size_of::<D>() == 2, ..Errors::default() };
    for _ in 0..cases {
        let case = Case::random(&mut rng);
        let (pixels, snapped) = case.whole::<T, D>(false);
        let points = snapped.map(|v| in_pixels(v, case.viewport));
        let exact = ExactLine::new(points, case.viewport);
        let rational = |v: i64| BigRational::from_integer(v.into());
        // The vertices in pixel space in the units of the true w.
        let true_ends: [RationalVertex; 2] = [0, 1].map(|i| {
            let k = scale(snapped[i], case.ends[i][3]);
            points[i].map(|v| rational(v) / &k)
        });
        if points[0] == points[1]
            || snapped.iter().zip(&case.ends).any(|(v, end)| {
                // A `k` that is no number, of a vertex that was not projected by its own w.
                matches!(v, hither::Snapped::Projected { .. }) && end[3] <= 0
            })
        {
            continue;
        }
        // The plane looks at what came in, the hither plane at the snapped w.
        let plane_at = |end: &[i64; 4]| {
            let sum = case.plane.iter().zip(end).map(|(n, v)| n * v).sum::<i64>();
            rational(sum)
        };
        let bounds = [
            true_ends.each_ref().map(|end| &end[2] - rational(case.hither)),
            [plane_at(&case.ends[0]), plane_at(&case.ends[1])],
        ];
        let cuts = bounds.each_ref().map(|[a, b]| a.is_negative() || b.is_negative());
        // Whether a point is inside of all, if that is sure.
        let kept = |t: &BigRational| {
            let mut all = Some(true);
            for ([a, b], _) in bounds.iter().zip(cuts).filter(|(_, cuts)| *cuts) {
                let value = mix(a, b, t);
                let band = a.abs().max(b.abs()) * power_of_two(-26);
                if value < -&band {
                    return Some(false);
                }
                if value <= band {
                    all = None;
                }
            }
            all
        };
        let message = |pixel: LinePixel| format!("seed {seed}, {pixel:?} of {case:?}, {points:?}");
        let all = exact.pixels();
        if points[0][0] * points[1][2] == points[1][0] * points[0][2]
            && points[0][1] * points[1][2] == points[1][1] * points[0][2]
        {
            continue;
        }
        for &pixel in &all {
            let Some(t) = exact.parameter_of(&true_ends, exact.step(pixel)) else { continue };
            let drawn = pixels.iter().any(|(p, _)| *p == pixel);
            if let Some(kept) = kept(&t) {
                errors.cut += usize::from(!kept);
                assert_eq!(drawn, kept, "{}", message(pixel));
            }
        }
        let crosses = cuts[0];
        for (pixel, word) in pixels {
            assert!(all.contains(&pixel), "{}", message(pixel));
            let Some(t) = exact.parameter_of(&true_ends, exact.step(pixel)) else { continue };
            let z = mix(&rational(case.ends[0][2]), &rational(case.ends[1][2]), &t);
            let w = mix(&true_ends[0][2], &true_ends[1][2], &t);
            if !w.is_positive() {
                continue;
            }
            let depth = to_f64(&(z / w)).clamp(0.0, 1.0) * full;
            let error = (f64::from(Into::<u32>::into(word)) - depth).abs() / full * 65536.0;
            let worst = if crosses { &mut errors.crossing } else { &mut errors.front };
            *worst = worst.max(error);
            assert!(error < 1.0, "{error} of a unit, {}", message(pixel));
            errors.pixels += 1;
        }
    }
    errors
}

/// 16-bit depths are as near as rounding has them, and 2^-8 of a unit; 32-bit ones are within 2^8 of their units.
fn check_depths<T: Tier>(seed: u64) {
    for errors in [
        planes_and_depths_are_exact::<T, u16>(seed, 900),
        planes_and_depths_are_exact::<T, u32>(seed + 1, 900),
    ] {
        println!("{errors:?}");
        assert!(errors.pixels > 10_000 && errors.cut > 10_000, "{errors:?}");
        assert!(errors.crossing > 0.0, "{errors:?}");
        // Of a 32-bit depth 2^8 units are 2^-8 of one of 16 bits.
        let bound = if errors.rounded { 0.5 } else { 0.0 } + 1.0 / 256.0;
        assert!(errors.front <= bound && errors.crossing <= bound, "seed {seed}: {errors:?}");
    }
}

#[test]
fn depths_and_planes_in_the_exact_tier() {
    check_depths::<Exact>(107);
}

#[test]
fn depths_and_planes_with_8_subpixel_bits() {
    check_depths::<Quick<8>>(109);
}

#[test]
fn depths_and_planes_with_4_subpixel_bits() {
    check_depths::<Quick<4>>(111);
}

/// An end's pixel has the end's own depth, less the bias, down to 0.
#[test]
fn a_bias_moves_depths_towards_the_eye() {
    let mut case = Case {
        viewport: oracle::Viewport::new(16, 16),
        ends: [[-900, -10, 250, 1000], [900, -10, 750, 1000]],
        hither: 1,
        plane: [0; 4],
        bias: DepthBias::NONE,
    };
    let (plain, _) = case.whole::<Quick<8>, u16>(false);
    let (first, last) = (plain[0].1, plain[plain.len() - 1].1);
    assert_eq!(plain.len(), 16);
    assert!((16_300..18_000).contains(&first) && (48_000..49_200).contains(&last), "{plain:?}");
    for bias in [1, 128, 20_000, u16::MAX] {
        case.bias = DepthBias(bias);
        let (moved, _) = case.whole::<Quick<8>, u16>(false);
        for ((pixel, depth), (_, before)) in moved.iter().zip(&plain) {
            assert_eq!(*depth, before.saturating_sub(bias), "{pixel:?} with {bias}");
        }
    }
}

/// A grid of squares, bent, over most of a 96 x 80 screen and some of what is behind it.
fn sheet() -> (Vec<[i16; 3]>, Vec<[u16; 3]>) {
    let positions = (0..81).map(|i| {
        let (x, y) = (i % 9 - 4, i / 9 - 4);
        [30 * x, 30 * y, (x * x - y * y) * 12 - 160]
    });
    let triangles = (0..64).flat_map(|i| {
        let a = i % 8 + i / 8 * 9;
        [[a, a + 1, a + 10], [a, a + 10, a + 9]]
    });
    (positions.collect(), triangles.collect())
}

/// What culls a face of a 96 x 80 screen.
fn facing(vertices: [hither::Snapped; 3]) -> Cull {
    let [a, b, c] = vertices.map(|v| in_pixels(v, oracle::Viewport::new(96, 80)).map(i128::from));
    let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
    // y is down.
    match (a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1)).signum() {
        1 => Cull::Back,
        -1 => Cull::Front,
        _ => Cull::Neither,
    }
}

/// The edges of each face that is not culled, by a cache of any size, are the lines one by one.
#[test]
fn wireframes_are_their_edges() {
    let (positions, triangles) = sheet();
    let mesh = Mesh::try_new(&positions, 6, &[(); 81], &triangles).expect("a sheet");
    let away = Mat4::rotation_y(Angle::from_degrees(I16F16::from_num(50)).sin_cos());
    let lens = Mat4::perspective(I16F16::ONE, I16F16::ONE, I16F16::ONE, I16F16::from_num(9));
    let transform = lens.expect("a lens").times(&away).expect("in range");
    let (mut pictures, mut culled) = (Vec::new(), Vec::new());
    for cull in [Cull::Neither, Cull::Back, Cull::Front] {
        let mut of_sizes = Vec::new();
        for cached in [0, 40, 81] {
            let mut words = vec![0u16; 96 * 80];
            let depth = DepthBuffer::try_new(&mut words, 96, 80).expect("a word a pixel");
            let mut frame = Frame::new(Record::new(96, 80))
                .expect("in range")
                .with_hither(Hither::new(I16F16::ONE).expect("above 0"))
                .with_depth(depth.with_compare(Always))
                .expect("the same size")
                .with_cull(cull);
            let mut cache = vec![Vertex::EMPTY; cached];
            let counts = frame.draw_wireframe(&mesh, &transform, DepthBias(9), &Mark, &mut cache);
            if cached == 81 {
                // By hand.
                let drawn = std::mem::take(&mut frame.target_mut().pixels);
                let mut lines = Counts::default();
                for face in &triangles {
                    let [a, b, c] = face.map(|i| cache[usize::from(i)]);
                    if cull == facing([a, b, c].map(|v| v.snapped())) {
                        lines.add(Outcome::Culled);
                        continue;
                    }
                    for ends in [[&a, &b], [&b, &c], [&c, &a]] {
                        lines.add(frame.draw_line(ends, DepthBias(9), &Mark));
                    }
                    of_sizes.push(std::mem::take(&mut frame.target_mut().pixels));
                }
                assert_eq!((of_sizes.split_off(2).concat(), lines), (drawn.clone(), counts));
                frame.target_mut().pixels = drawn;
                culled.push(counts.culled);
                let gone = counts.off_screen + counts.behind;
                assert!(cull != Cull::Neither || (counts.drawn > 100 && gone > 10), "{counts:?}");
            }
            of_sizes.push(frame.into_parts().0.pixels);
        }
        assert!(of_sizes.windows(2).all(|pair| pair[0] == pair[1]));
        pictures.push(of_sizes.swap_remove(0).len());
    }
    // Each face is culled one way.
    assert_eq!((culled[0], culled[1] + culled[2]), (0, 128));
    assert!(pictures[1] + pictures[2] == pictures[0] && pictures[0] > 1000, "{pictures:?}");
}

#[test]
fn bad_lines_and_meshes_draw_nothing() {
    let at = |x: i64, y: i64, w: i64| clip_vertex([x, y, 0, w]);
    let mut frame = Frame::new(Record::new(8, 8)).expect("in range");
    let empty = Vertex::EMPTY;
    let [on, behind, infinite] =
        [at(0, 0, 9), at(3, 1, -9), at(9, 4, 0)].map(|v| frame.snap(&v, []));
    for (ends, outcome) in [
        ([&empty, &empty], Outcome::Behind),
        ([&behind, &behind], Outcome::Behind),
        ([&infinite, &infinite], Outcome::Behind),
        ([&infinite, &behind], Outcome::Behind),
    ] {
        assert_eq!(frame.draw_line(ends, DepthBias(9), &Mark), outcome, "{ends:?}");
        assert!(frame.target().pixels.is_empty());
    }
    // To a vertex that is none there is no direction: the one pixel.
    assert_eq!(frame.draw_line([&on, &empty], DepthBias::NONE, &Mark), Outcome::Drawn);
    assert_eq!(frame.draw_line([&on, &on], DepthBias::NONE, &Mark), Outcome::Drawn);
    assert_eq!(frame.target().pixels, [(4, 4, ()); 2]);

    let none = Mesh::<[i16; 3], ()>::try_new(&[], 0, &[], &[]).expect("nothing");
    let counts = frame.draw_wireframe(&none, &Mat4::IDENTITY, DepthBias::NONE, &Mark, &mut []);
    assert_eq!(counts, Counts::default());
}

#[test]
fn lines_of_another_targets_size_draw_nothing() {
    let mut words = [0u16; 64];
    let depth = DepthBuffer::try_new(&mut words, 8, 8).expect("a word a pixel");
    let mut frame = Frame::new(Record::new(8, 8))
        .expect("in range")
        .with_hither(Hither::new(I16F16::ONE).expect("above 0"))
        .with_depth(depth)
        .expect("the same size");
    frame.clear_depth();
    let [a, b] = [[-1, 1, 0, 1], [1, -1, 0, 1]]
        .map(|v| frame.snap(&clip_vertex(v.map(|v| v << 16)), [I16F16::ONE]));
    assert_eq!(frame.draw_line([&a, &b], DepthBias::NONE, &Mark), Outcome::Drawn);
    assert_eq!(frame.target().pixels.len(), 8);
    *frame.target_mut() = Record::new(4, 4);
    assert_eq!(frame.draw_line([&a, &b], DepthBias::NONE, &Mark), Outcome::OffScreen);
    assert!(frame.target().pixels.is_empty());
}
