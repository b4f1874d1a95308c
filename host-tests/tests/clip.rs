//! Clip planes and the hither plane decide exactly, but for pixels next to them.
//!
//! A plane's value at a pixel is that of the surface seen there: of the snapped triangle, whose
//! vertices have the values of the true ones (`[k_i plane(p_i)]`). For the hither plane, which
//! bounds `1 / w`, the value is of the snapped `w`; it is the true one in the exact tier on its
//! grid, and where a vertex is projected.

use hither::{Exact, Frame, Hither, I16F16, NoDepth, Perspective, Plane, Quick, Tier, WRange};
use host_tests::oracle::{
    Category, ExactTriangle, GRID, Part, PlaneFunction, PlaneSide, Rng, Space, Surface, Vertex,
    Viewport, random_viewport, triangle, whole,
};
use host_tests::record::{Mark, Record, clip_vertex, frame};
use host_tests::snapped;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

/// What is drawn, and what may clip it.
#[derive(Clone, Debug)]
struct Case<const P: usize> {
    viewport: Viewport,
    /// `[x, y, z, w]`.
    corners: [[i64; 4]; 3],
    hither: Option<i64>,
    planes: [[i64; 4]; P],
    both: bool,
}

/// How often each pixel is drawn, and the snapped vertices.
struct Drawn {
    counts: Vec<u8>,
    snapped: [hither::Snapped; 3],
}

fn finish<T: Tier, W: WRange + hither::Interpolates<0>, const P: usize>(
    mut frame: Frame<Record<()>, NoDepth, W, T, Perspective, P>,
    case: &Case<P>,
) -> Drawn {
    let vertices = case.corners.map(|corner| frame.snap(&clip_vertex(corner), []));
    let [a, b, c] = &vertices;
    let _ = frame.draw_snapped([a, b, c], &Mark);
    Drawn { counts: frame.target_mut().take_counts(), snapped: vertices.map(|v| v.snapped()) }
}

fn draw<T: Tier, const P: usize>(case: &Case<P>) -> Drawn {
    let raw = |v: i64| I16F16::from_bits(v as i32);
    let planes = case.planes.map(|plane| Plane::new(plane.map(raw)));
    let frame = frame(case.viewport).with_tier(T::default()).with_planes(planes);
    match case.hither {
        Some(h) => {
            let plane = Hither::new(raw(h)).expect("above 0");
            finish(frame.with_hither(plane), case)
        }
        None if case.both => finish(frame.with_both_sides(), case),
        None => finish(frame, case),
    }
}

/// A plane that often cuts the triangle.
fn plane(corners: &[[i64; 4]; 3], rng: &mut Rng) -> [i64; 4] {
    let mut plane = [(); 4].map(|()| rng.signed(1 << 10));
    if rng.once_in(4) {
        return plane;
    }
    // One coefficient so that the plane passes close to a point of the triangle.
    let weights = [(); 3].map(|()| rng.fraction());
    let at = |axis: usize| -> f64 { (0..3).map(|i| weights[i] * corners[i][axis] as f64).sum() };
    let axis = rng.below(4) as usize;
    let others: f64 = (0..4).filter(|&i| i != axis).map(|i| plane[i] as f64 * at(i)).sum();
    let needed = -others / at(axis);
    if needed.abs() <= 1024.0 {
        plane[axis] = needed.round() as i64;
    }
    plane
}

fn case<const P: usize>(rng: &mut Rng) -> Case<P> {
    let any = random_viewport(rng);
    let viewport = Viewport::new(
        any.width.min(rng.range(1, 48) as u32),
        any.height.min(rng.range(1, 48) as u32),
    );
    let category = rng.choose(&Category::ALL);
    let corners = triangle(category, viewport, rng).map(|[x, y, w]| [x, y, rng.signed(GRID), w]);
    let far = corners.iter().map(|c| c[3]).max().unwrap_or(1).max(1);
    let hither =
        rng.once_in(2).then(|| if rng.once_in(2) { rng.magnitude(far) } else { rng.range(1, far) });
    Case {
        viewport,
        corners,
        hither,
        planes: [(); P].map(|()| plane(&corners, rng)),
        both: rng.once_in(2),
    }
}

/// A plane over the surface, and the band in which the library may decide either way.
struct Bound {
    function: PlaneFunction,
    band: BigRational,
}

/// The hither plane and the planes of a case.
fn bounds<const P: usize>(
    case: &Case<P>,
    snapped: &[hither::Snapped; 3],
    surface: &Surface,
) -> Vec<Bound> {
    let part = BigInt::from(1 << 12);
    let hither = case.hither.map(|h| {
        let h = BigRational::from_integer(h.into());
        let values = [0, 1, 2].map(|i| {
            let [_, _, w] = snapped::in_clip(snapped[i], case.viewport, case.corners[i][3]);
            w - &h
        });
        let function = PlaneFunction::new(surface, &values);
        let band = function.largest().clone().min(h) / &part;
        Bound { function, band }
    });
    let planes = case.planes.iter().map(|plane| {
        let value = |corner: [i64; 4]| (0..4).map(|i| plane[i] * corner[i]).sum();
        let function = PlaneFunction::new(surface, &whole(case.corners.map(value)));
        let band = function.largest() / &part;
        Bound { function, band }
    });
    hither.into_iter().chain(planes).collect()
}

/// What is seen over many cases.
#[derive(Debug, Default)]
struct Tally {
    /// Covered pixels of triangles that a plane may cut.
    decisions: usize,
    clipped: usize,
    /// Decided against exact arithmetic, inside the band.
    against: usize,
    /// The largest part of `max |n . p_i|` at which a pixel is decided against exact arithmetic.
    ratio: f64,
}

/// Compares one case.
fn check<T: Tier, const P: usize>(case: &Case<P>, tally: &mut Tally) {
    let drawn = draw::<T, P>(case);
    let points: [Vertex; 3] = drawn.snapped.map(|s| snapped::in_pixels(s, case.viewport));
    let scales = [0, 1, 2].map(|i| snapped::scale(drawn.snapped[i], case.corners[i][3]));
    let surface = Surface::from_rationals(&points.map(whole), &scales, Space::Pixel, case.viewport);
    let Some(surface) = surface else {
        assert!(drawn.counts.iter().all(|&count| count == 0), "{case:?}");
        return;
    };
    let bounds = bounds(case, &drawn.snapped, &surface);
    let prepare = |part| ExactTriangle::from_pixel_space(points, case.viewport, part);
    let [front, behind] = Part::ALL.map(prepare);
    let zero = BigRational::zero();
    for ((x, y), &count) in case.viewport.pixels().zip(&drawn.counts) {
        let is_behind = case.both && case.hither.is_none() && behind.covers(x, y);
        if !front.covers(x, y) && !is_behind {
            assert_eq!(count, 0, "{x} {y} of {case:?}");
            continue;
        }
        let is_out =
            |bound: &Bound| bound.function.side_within(x, y, &zero) == Some(PlaneSide::Outside);
        let keep = !bounds.iter().any(is_out);
        tally.decisions += 1;
        tally.clipped += usize::from(!keep);
        if count == u8::from(keep) {
            continue;
        }
        assert!(count <= 1, "{x} {y} of {case:?}");
        tally.against += 1;
        // Drawn though some planes are beyond: all those must be near. Not drawn: some plane must
        // be near.
        let wrong = bounds.iter().filter(|bound| keep || is_out(bound)).map(|bound| {
            let value = bound.function.value(x, y).expect("covered").abs();
            let near = value <= bound.band;
            let ratio = (value / bound.function.largest()).to_f64().unwrap_or(f64::NAN);
            (ratio, near)
        });
        let merge = |a: (f64, bool), b: (f64, bool)| {
            if keep { (a.0.min(b.0), a.1 || b.1) } else { (a.0.max(b.0), a.1 && b.1) }
        };
        let (ratio, near) = wrong.reduce(merge).expect("a plane");
        assert!(near, "{x} {y}: {count} drawn, {keep} exactly, {ratio:e} of the largest: {case:?}");
        tally.ratio = tally.ratio.max(ratio);
    }
}

fn compare<T: Tier>(seed: u64, cases: usize) {
    let mut rng = Rng::new(seed);
    let mut tally = Tally::default();
    for _ in 0..cases {
        check::<T, 0>(&case(&mut rng), &mut tally);
        check::<T, 1>(&case(&mut rng), &mut tally);
        check::<T, 2>(&case(&mut rng), &mut tally);
        check::<T, 3>(&case(&mut rng), &mut tally);
        check::<T, 4>(&case(&mut rng), &mut tally);
    }
    println!("{tally:?}");
    assert!(tally.clipped > tally.decisions / 10, "{tally:?}");
}

#[test]
fn exact_tier() {
    compare::<Exact>(11, 2500);
}

#[test]
fn quick4() {
    compare::<Quick<4>>(12, 1500);
}

#[test]
fn quick8() {
    compare::<Quick<8>>(13, 1500);
}
