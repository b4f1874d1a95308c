//! Triangles with smooth edges.

use super::area::{Place, of_half_planes, of_polygon};
use super::{Errors, Shares, alphas, fixed};
use hither::{
    Affine, Alpha, BothSides, ClipVertex, Edges, Exact, Fragment, Frame, Hither, I16F16, Quick,
    Rect, Sample, Tier, Translucent, Vertex, Viewport, WRange,
};
use host_tests::oracle::{self, Category, GRID, Rng, random_viewport, triangle};
use host_tests::record::{Mark, Record, clip_vertex};
use host_tests::snapped;

/// Covers all of it.
const OPAQUE: Translucent<Mark> = Translucent(Mark, 255);

/// The side of the picture.
const SIDE: u32 = 48;

/// A vertex at a place on the screen of a viewport.
fn on_screen(p: Place, (width, height): (u32, u32)) -> ClipVertex {
    let x = p[0] * 2.0 / f64::from(width) - 1.0;
    let y = 1.0 - p[1] * 2.0 / f64::from(height);
    // Sixteen of w for precision.
    ClipVertex::new(fixed(16.0 * x), fixed(16.0 * y), I16F16::ZERO, fixed(16.0))
}

/// The half planes of a triangle's front part, of snapped vertices; `None` without an area.
fn half_planes<T: Tier>(
    vertices: &[Vertex<T>; 3],
    (width, height): (u32, u32),
) -> Option<[[f64; 3]; 3]> {
    let viewport = oracle::Viewport::new(width, height);
    // Integers below 2^53.
    let v =
        vertices.each_ref().map(|v| snapped::in_pixels(v.snapped(), viewport).map(|v| v as f64));
    let exact =
        vertices.each_ref().map(|v| snapped::in_pixels(v.snapped(), viewport).map(i128::from));
    let line = |i: usize, j: usize| {
        let ([a, b, c], [x, y, z]) = (exact[i], exact[j]);
        [b * z - c * y, c * x - a * z, a * y - b * x]
    };
    let determinant: i128 = line(1, 2).iter().zip(exact[0]).map(|(a, b)| a * b).sum();
    if determinant == 0 {
        return None;
    }
    assert!(v.iter().flatten().all(|v| v.abs() < 2f64.powi(40)));
    // Of length 1, so that cutting a square by them is well-conditioned.
    Some([line(1, 2), line(2, 0), line(0, 1)].map(|plane| {
        let [a, b, c] = plane.map(|v| v as f64 * determinant.signum() as f64);
        let length = a.hypot(b).max(f64::MIN_POSITIVE);
        [a / length, b / length, c / length]
    }))
}

/// The errors of random triangles of a class, all edges smooth.
fn measure<T: Tier>(make: impl Fn(&mut Rng) -> [Place; 3], number: u32) -> Errors {
    let mut rng = Rng::new(11);
    let mut errors = Errors::default();
    for _ in 0..number {
        let points = make(&mut rng);
        let mut frame = Frame::new(Shares::new(SIDE, SIDE)).unwrap().with_tier(T::default());
        let vertices = points.map(|p| frame.snap(&on_screen(p, (SIDE, SIDE)), []));
        let _ = frame.draw_smooth(vertices.each_ref(), Edges::ALL, &OPAQUE);
        let (shares, counts) = alphas(frame.target(), (SIDE, SIDE));
        assert!(counts.iter().all(|count| *count <= 1), "{points:?}: drawn twice");
        let Some(planes) = half_planes(&vertices, (SIDE, SIDE)) else {
            assert!(shares.iter().all(|share| *share == 0.0), "{points:?}");
            continue;
        };
        for y in 0..SIDE {
            for x in 0..SIDE {
                errors.add(shares[(y * SIDE + x) as usize], of_half_planes(&planes, (x, y)));
            }
        }
    }
    errors
}

/// A number from `low` to `high`.
fn between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * (rng.below(1 << 30) as f64 / f64::from(1 << 30))
}

/// A triangle anywhere in a square of this side.
fn within(rng: &mut Rng, side: f64) -> [Place; 3] {
    let at = [0, 1].map(|_| between(rng, -2.0, f64::from(SIDE) + 2.0 - side));
    [(); 3].map(|()| at.map(|at| at + between(rng, 0.0, side)))
}

/// A triangle this long and wide, at any angle, with its third corner over some part of the base.
fn sliver(rng: &mut Rng, width: [f64; 2]) -> [Place; 3] {
    let (sin, cos) = between(rng, 0.0, core::f64::consts::TAU).sin_cos();
    let (length, width) = (between(rng, 4.0, 60.0), between(rng, width[0], width[1]));
    let middle = [0, 1].map(|_| between(rng, 4.0, f64::from(SIDE) - 4.0));
    let along = between(rng, -0.5, 0.5) * length;
    let turned = |u: f64, v: f64| [middle[0] + u * cos - v * sin, middle[1] + u * sin + v * cos];
    [turned(-length / 2.0, 0.0), turned(length / 2.0, 0.0), turned(along, width)]
}

/// Mean and largest errors of each class, in each tier.
fn classes<T: Tier>(tier: &str) {
    let check = |class: &str, errors: Errors, mean, largest| {
        errors.check(&format!("{tier}, {class}"), mean, largest);
    };
    check("large", measure::<T>(|rng| within(rng, 48.0), 250), 0.004, 0.09);
    check("a few pixels", measure::<T>(|rng| within(rng, 5.0), 1000), 0.01, 0.09);
    check("below a pixel", measure::<T>(|rng| within(rng, 1.3), 2000), 0.012, 0.1);
    check("slivers", measure::<T>(|rng| sliver(rng, [0.02, 1.5]), 400), 0.005, 0.1);
    check("needles", measure::<T>(|rng| sliver(rng, [1.0, 4.0]), 400), 0.005, 0.1);
    let straight = |rng: &mut Rng| {
        let [x, y, w, h] = [(); 4].map(|()| between(rng, 0.0, 40.0));
        [[x, y], [x + w, y], [x, y + h]]
    };
    check("level and upright edges", measure::<T>(straight, 300), 0.005, 0.09);
    let slopes = |rng: &mut Rng| {
        // A side of each slope of whole pixels up to 40.
        let [u, v] = [(); 2].map(|()| rng.range(-40, 40) as f64);
        let [x, y] = [(); 2].map(|()| between(rng, 0.0, 48.0));
        [[x, y], [x + u, y + v], [x - v, y + u]]
    };
    check("all slopes", measure::<T>(slopes, 400), 0.004, 0.09);
}

#[test]
fn shares_are_close_to_exact_areas() {
    classes::<Exact>("exact");
    classes::<Quick<4>>("quick4");
    classes::<Quick<8>>("quick8");
}

/// Vertices anywhere, behind the eye too: no panic, nothing outside, and shares as they should be.
fn external<T: Tier, W: WRange + hither::Interpolates<0>>(
    with: impl Fn(Frame<Shares>) -> Frame<Shares, hither::NoDepth, W>,
) -> Errors {
    let mut rng = Rng::new(12);
    let mut errors = Errors::default();
    for _ in 0..1500 {
        let any = random_viewport(&mut rng);
        let (width, height) = (any.width.min(60), any.height.min(60));
        let corners =
            triangle(rng.choose(&Category::ALL), oracle::Viewport::new(width, height), &mut rng);
        let corners = corners.map(|[x, y, w]| clip_vertex([x, y, rng.signed(GRID), w]));
        let mut frame =
            with(Frame::new(Shares::new(width, height)).unwrap()).with_tier(T::default());
        let vertices = corners.map(|corner| frame.snap(&corner, []));
        let _ = frame.draw_smooth(vertices.each_ref(), Edges::ALL, &OPAQUE);
        let (shares, counts) = alphas(frame.target(), (width, height));
        let parts = if W::BEHIND { 2 } else { 1 };
        assert!(counts.iter().all(|count| *count <= parts), "{corners:?}");
        let Some(planes) = half_planes(&vertices, (width, height)) else { continue };
        let behind = planes.map(|plane| plane.map(|v| -v));
        let flat = planes.iter().any(|[a, b, _]| a.hypot(*b) < 0.5);
        for y in 0..if flat { 0 } else { height } {
            for x in 0..width {
                let mut exact = of_half_planes(&planes, (x, y));
                if W::BEHIND {
                    exact = 1.0 - (1.0 - exact) * (1.0 - of_half_planes(&behind, (x, y)));
                }
                let share = shares[(y * width + x) as usize];
                assert!(
                    (share - exact).abs() < 0.2,
                    "{corners:?}, ({x}, {y}): {share}, not {exact}"
                );
                errors.add(share, exact);
            }
        }
    }
    errors
}

#[test]
fn shares_of_external_triangles_are_close() {
    external::<Exact, _>(|frame| frame).check("exact, any w", 0.006, 0.12);
    external::<Quick<8>, _>(|frame| frame).check("quick8, any w", 0.006, 0.12);
    external::<Quick<4>, BothSides>(Frame::with_both_sides).check(
        "quick4, both sides",
        0.006,
        0.12,
    );
}

/// Of a triangle with one smooth edge, the others decide as ever, and far from that edge all is whole.
#[test]
fn hard_edges_are_exact() {
    let mut rng = Rng::new(13);
    for number in 0..400 {
        let points = within(&mut rng, 40.0);
        let edge = number % 3;
        let mut frame = Frame::new(Shares::new(SIDE, SIDE)).unwrap();
        let vertices = points.map(|p| frame.snap(&on_screen(p, (SIDE, SIDE)), []));
        let _ = frame.draw_smooth(vertices.each_ref(), Edges::NONE.with(edge), &OPAQUE);
        let (shares, _) = alphas(frame.target(), (SIDE, SIDE));
        let mut hard = Frame::new(Record::new(SIDE, SIDE)).unwrap();
        let _ = hard.draw_snapped(vertices.each_ref(), &Mark);
        let covered = hard.target_mut().take_counts();
        let mut none = Frame::new(Shares::new(SIDE, SIDE)).unwrap();
        let _ = none.draw_smooth(vertices.each_ref(), Edges::NONE, &OPAQUE);
        let (whole, _) = alphas(none.target(), (SIDE, SIDE));
        let Some(planes) = half_planes(&vertices, (SIDE, SIDE)) else { continue };
        // Edge i is opposite of vertex i + 2.
        let smooth = planes[(edge + 2) % 3];
        for y in 0..SIDE {
            for x in 0..SIDE {
                let at = (y * SIDE + x) as usize;
                assert_eq!(whole[at], f64::from(covered[at]), "{points:?}");
                let centre = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                let distance = |[a, b, c]: [f64; 3]| a * centre[0] + b * centre[1] + c;
                let inside = planes
                    .iter()
                    .filter(|plane| **plane != smooth)
                    .all(|plane| distance(*plane) >= 0.0);
                if distance(smooth).abs() > 0.708 {
                    assert_eq!(shares[at], whole[at], "{points:?} at ({x}, {y})");
                } else if !inside {
                    assert_eq!(shares[at], 0.0, "{points:?} at ({x}, {y})");
                }
            }
        }
    }
}

/// A fan round a point inside of a convex polygon: no pixel is drawn twice but where a corner is, what is inside is whole, and the
/// picture is that of the polygon.
#[test]
fn neighbours_that_share_hard_edges_show_no_seam() {
    let mut rng = Rng::new(14);
    let mut errors = Errors::default();
    for number in 0..150 {
        let corners = 4 + number % 5;
        let radius = between(&mut rng, 6.0, 22.0);
        let start = between(&mut rng, 0.0, 1.0);
        let outline: Vec<Place> = (0..corners)
            .map(|i| (f64::from(i) + start) * core::f64::consts::TAU / f64::from(corners))
            .map(|angle| [24.0 + radius * angle.cos(), 24.0 + radius * angle.sin()])
            .collect();
        let mut frame = Frame::new(Shares::new(SIDE, SIDE)).unwrap();
        let snap = |frame: &Frame<Shares>, p: Place| frame.snap(&on_screen(p, (SIDE, SIDE)), []);
        let ring: Vec<_> = outline.iter().map(|p| snap(&frame, *p)).collect();
        let rounded = |v: &Vertex<_>| {
            let [x, y, w] = snapped::in_pixels(v.snapped(), oracle::Viewport::new(SIDE, SIDE));
            [x as f64 / w as f64, y as f64 / w as f64]
        };
        let outline: Vec<Place> = ring.iter().map(rounded).collect();
        if number % 2 == 0 {
            // Round a point inside: the first edge of each is on the outline.
            let inside = snap(
                &frame,
                [24.0 + between(&mut rng, -3.0, 3.0), 24.0 + between(&mut rng, -3.0, 3.0)],
            );
            for i in 0..ring.len() {
                let triangle = [&ring[i], &ring[(i + 1) % ring.len()], &inside];
                let _ = frame.draw_smooth(triangle, Edges::NONE.with(0), &OPAQUE);
            }
        } else {
            // Cut by the diagonals of a corner.
            for i in 1..ring.len() - 1 {
                let mut edges = Edges::NONE.with(1);
                edges = if i == 1 { edges.with(0) } else { edges };
                edges = if i == ring.len() - 2 { edges.with(2) } else { edges };
                let _ = frame.draw_smooth([&ring[0], &ring[i], &ring[i + 1]], edges, &OPAQUE);
            }
        }
        let (shares, counts) = alphas(frame.target(), (SIDE, SIDE));
        for y in 0..SIDE {
            for x in 0..SIDE {
                let at = (y * SIDE + x) as usize;
                let exact = of_polygon(&outline, (x, y));
                let to_corner = outline
                    .iter()
                    .map(|p| (p[0] - f64::from(x) - 0.5).hypot(p[1] - f64::from(y) - 0.5));
                let near_corner = to_corner.fold(f64::MAX, f64::min) < 1.5;
                assert!(counts[at] <= 1 || near_corner, "({x}, {y}) is drawn {} times", counts[at]);
                if exact > 1.0 - 1e-9 {
                    assert_eq!((shares[at], counts[at]), (1.0, 1), "({x}, {y}) is inside");
                }
                errors.add(shares[at], exact);
            }
        }
    }
    // In the pixel of a corner a diagonal says whose outline edge counts.
    errors.check("polygons of triangles", 0.01, 0.7);
}

/// Shows the varyings.
#[derive(Clone, Copy)]
struct Shown;

impl<const N: usize> Fragment<Alpha<[I16F16; N]>, N> for Shown {
    const UNIFORM: bool = false;

    fn shade(&self, sample: Sample<N>) -> Alpha<[I16F16; N]> {
        Alpha { color: sample.varyings, alpha: 255 }
    }
}

/// A scene of triangles with varyings, anywhere: drawn in bands and under a scissor it is the same, and varyings are between the
/// vertices'.
fn bands<T: Tier, I: hither::Correction>(correction: I) {
    let mut rng = Rng::new(15);
    let mut drawn = 0;
    for _ in 0..300 {
        let any = random_viewport(&mut rng);
        let (width, height) = (any.width.min(60), any.height.min(50));
        let corners =
            triangle(rng.choose(&Category::ALL), oracle::Viewport::new(width, height), &mut rng);
        let hither = rng.magnitude(corners.iter().map(|c| c[2]).max().unwrap_or(1).max(1));
        let corners = corners.map(|[x, y, w]| clip_vertex([x, y, rng.signed(GRID), w]));
        let values = [(); 3].map(|()| [I16F16::from_bits(rng.signed(1 << 20) as i32)]);
        let edges = Edges::ALL.without(rng.below(4) as usize);
        let viewport = Viewport::new(width, height).unwrap();
        let scissor = Rect { x0: 0, y0: 3, x1: width as i32, y1: height as i32 - 2 };
        let draw = |viewport: Viewport, rows: u32| {
            let mut frame = Frame::with_viewport(Record::new(width, rows), viewport)
                .with_tier(T::default())
                .with_correction(correction)
                .with_hither(Hither::new(I16F16::from_bits(hither as i32)).unwrap());
            let vertices = [0, 1, 2].map(|i| frame.snap(&corners[i], values[i]));
            let _ = frame.draw_smooth(vertices.each_ref(), edges, &Shown);
            let (record, _) = frame.into_parts();
            record.pixels
        };
        let mut whole = draw(viewport, height);
        whole.sort_by_key(|(x, y, _)| (*y, *x));
        let (least, most) = (values.iter().min().unwrap(), values.iter().max().unwrap());
        for (x, y, Alpha { color, .. }) in &whole {
            assert!(color >= least && color <= most, "({x}, {y}): {color:?}, not {values:?}");
        }
        let mut banded = Vec::new();
        let step = 1 + rng.below(9) as u32;
        for top in (0..height).step_by(step as usize) {
            let band = draw(viewport.with_origin(0, -(top as i16)), step.min(height - top));
            banded.extend(band.into_iter().map(|(x, y, alpha)| (x, y + top, alpha)));
        }
        banded.sort_by_key(|(x, y, _)| (*y, *x));
        assert_eq!(banded, whole, "{corners:?}");
        let mut cut = draw(viewport.with_scissor(scissor), height);
        cut.sort_by_key(|(x, y, _)| (*y, *x));
        whole.retain(|(_, y, _)| (3..height as i32 - 2).contains(&(*y as i32)));
        assert_eq!(cut, whole, "{corners:?}");
        drawn += whole.len();
    }
    assert!(drawn > 10_000, "{drawn} pixels");
}

#[test]
fn bands_and_scissors_are_the_same_to_the_bit() {
    bands::<Exact, _>(hither::Perspective);
    bands::<Quick<4>, _>(hither::PerspectiveEvery::<8>);
    bands::<Quick<8>, _>(Affine);
}
