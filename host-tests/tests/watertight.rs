//! Flat meshes, fans and closed meshes neither gap nor overlap, in every tier.
//!
//! The library draws each triangle; the facing that signs its coverage is that of the snapped
//! triangle, from the oracle.

use hither::{
    Exact, Frame, Hither, I16F16, Interpolates, NoDepth, Outcome, Perspective, Quick, Tier,
};
use host_tests::oracle::{
    ExactTriangle, Eye, FanCentre, Invariant, Mesh, Part, Rng, Sheet, Solid, Space, Surface,
    Viewport, closed, fan, random_viewport, sheet, whole,
};
use host_tests::record::{Mark, Record, clip_vertex, frame};
use host_tests::snapped;

/// How a mesh covers the screen: a number a pixel, row by row.
struct Coverage {
    /// How many triangles.
    count: Vec<u32>,
    /// The sum of their facings.
    signed: Vec<i32>,
    /// Whether a snap changed the facing of some triangle.
    folded: bool,
}

fn sign(value: i128) -> i32 {
    value.signum() as i32
}

/// The facing of a triangle on the unsnapped grid.
fn facing([a, b, c]: [[i64; 3]; 3]) -> i32 {
    let [a, b, c] = [a, b, c].map(|v| v.map(i128::from));
    sign(
        a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0]),
    )
}

/// Draws each triangle of a mesh through a frame.
fn cover<T: Tier, W: Interpolates<0>>(
    mut frame: Frame<Record<()>, NoDepth, W, T, Perspective>,
    mesh: &Mesh,
    viewport: Viewport,
) -> Coverage {
    let pixels = (viewport.width * viewport.height) as usize;
    let mut coverage = Coverage { count: vec![0; pixels], signed: vec![0; pixels], folded: false };
    let vertices: Vec<_> =
        mesh.vertices.iter().map(|&raw| frame.snap(&clip_vertex(raw), [])).collect();
    for (index, triangle) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = triangle.map(|i| &vertices[i]);
        let points = [a, b, c].map(|v| snapped::in_pixels(v.snapped(), viewport));
        let orientation =
            ExactTriangle::from_pixel_space(points, viewport, Part::Front).orientation();
        coverage.folded |= orientation != facing(mesh.corners(index));
        let _: Outcome = frame.draw_snapped([a, b, c], &Mark);
        for (x, y, ()) in frame.target_mut().pixels.drain(..) {
            let at = (y * viewport.width + x) as usize;
            coverage.count[at] += 1;
            coverage.signed[at] += orientation;
        }
    }
    coverage
}

/// Front parts only, and both parts.
fn cover_parts<T: Tier>(mesh: &Mesh, viewport: Viewport) -> [Coverage; 2] {
    let tier = || frame(viewport).with_tier(T::default());
    [cover(tier(), mesh, viewport), cover(tier().with_both_sides(), mesh, viewport)]
}

/// What was checked, so that a test that checks nothing fails.
#[derive(Debug, Default)]
struct Seen {
    pixels: usize,
    /// Pixels where all is before the hither plane, or nothing is.
    hidden: usize,
    folded: usize,
    meshes: usize,
}

/// Checks that each interior pixel is covered once; `inside` says which are.
fn covers_once(
    coverage: &Coverage,
    viewport: Viewport,
    what: &str,
    seen: &mut Seen,
    inside: impl Fn(u32, u32) -> bool,
) {
    seen.meshes += 1;
    seen.folded += usize::from(coverage.folded);
    for (at, (x, y)) in viewport.pixels().enumerate() {
        if !inside(x, y) {
            continue;
        }
        seen.pixels += 1;
        assert_eq!(coverage.signed[at], 1, "signed, {x} {y} of {what}");
        if !coverage.folded {
            assert_eq!(coverage.count[at], 1, "{x} {y} of {what}");
        }
    }
}

/// Checks the invariant of a flat mesh or a fan, for the front and for both parts.
fn flat<T: Tier>(mesh: &Mesh, viewport: Viewport, what: &str, seen: &mut Seen) {
    assert!(matches!(mesh.invariant, Invariant::CoversOnce(_)));
    let interior = |part, x, y| mesh.is_interior(viewport, part, (x, y));
    let [front, both] = cover_parts::<T>(mesh, viewport);
    covers_once(&front, viewport, &format!("front, {what}"), seen, |x, y| {
        interior(Part::Front, x, y)
    });
    // Where one part is in the mesh's interior the other covers nothing: the two cones have no
    // direction in common.
    covers_once(&both, viewport, &format!("both, {what}"), seen, |x, y| {
        interior(Part::Front, x, y) || interior(Part::Behind, x, y)
    });
    beyond_hither::<T>(mesh, viewport, what, seen);
}

/// With the hither plane the mesh covers once what lies beyond it, and not what lies before it, but
/// for the band: `w` within a part in 4096 of the plane.
fn beyond_hither<T: Tier>(mesh: &Mesh, viewport: Viewport, what: &str, seen: &mut Seen) {
    const BAND: f64 = 1.0 / 4096.0;
    let plane = Hither::new(I16F16::from_bits(mesh.hither as i32)).expect("above 0");
    let frame = frame(viewport).with_tier(T::default()).with_hither(plane);
    let prepare = |triangle: &[usize; 3]| {
        let corners = triangle.map(|i| mesh.vertices[i]);
        let snapped = corners.map(|v| frame.snap(&clip_vertex(v), []).snapped());
        let points = snapped.map(|s| snapped::in_pixels(s, viewport));
        let scales = [0, 1, 2].map(|i| snapped::scale(snapped[i], corners[i][3]));
        let rationals = points.map(whole);
        let surface = Surface::from_rationals(&rationals, &scales, Space::Pixel, viewport)?;
        let triangle = ExactTriangle::from_pixel_space(points, viewport, Part::Front);
        Some((triangle, surface.reciprocal_w()))
    };
    let prepared: Vec<_> = mesh.triangles.iter().filter_map(prepare).collect();
    let coverage = cover(frame, mesh, viewport);
    // Whether the surfaces at a pixel all pass; the test is of h / w.
    let all = |x: u32, y: u32, test: &dyn Fn(f64) -> bool| {
        prepared
            .iter()
            .filter(|(triangle, _)| triangle.covers(x, y))
            .all(|(_, q)| test(q.at(x, y) * mesh.hither as f64))
    };
    covers_once(&coverage, viewport, &format!("beyond, {what}"), seen, |x, y| {
        mesh.is_interior(viewport, Part::Front, (x, y)) && all(x, y, &|q| q < 1.0 / (1.0 + BAND))
    });
    for (at, (x, y)) in viewport.pixels().enumerate() {
        if all(x, y, &|q| q > 1.0 / (1.0 - BAND)) {
            assert_eq!(coverage.count[at], 0, "before, {x} {y} of {what}");
            seen.hidden += 1;
        }
    }
}

/// Checks that a closed mesh covers every pixel evenly from outside and oddly from inside.
fn evenly<T: Tier>(mesh: &Mesh, viewport: Viewport, what: &str, seen: &mut Seen) {
    let [front, both] = cover_parts::<T>(mesh, viewport);
    seen.meshes += 1;
    seen.folded += usize::from(front.folded);
    let expected = mesh.expected_sum();
    for (at, (x, y)) in viewport.pixels().enumerate() {
        let behind = (both.count[at] - front.count[at], both.signed[at] - front.signed[at]);
        for (count, signed) in [(front.count[at], front.signed[at]), behind] {
            assert_eq!(signed, expected, "signed, {x} {y} of {what}");
            assert_eq!(count & 1, expected.unsigned_abs(), "{x} {y} of {what}");
        }
        seen.pixels += usize::from(front.count[at] > 0);
    }
}

fn viewport(rng: &mut Rng) -> Viewport {
    let any = random_viewport(rng);
    if rng.once_in(40) {
        return any;
    }
    Viewport::new(any.width.min(61), any.height.min(48))
}

fn flat_meshes<T: Tier>(seeds: std::ops::Range<u64>) {
    let mut seen = Seen::default();
    for seed in seeds {
        let mut rng = Rng::new(seed);
        for kind in Sheet::ALL {
            let viewport = viewport(&mut rng);
            let mesh = sheet(kind, &mut rng);
            flat::<T>(&mesh, viewport, &format!("seed {seed} {kind:?} {viewport:?}"), &mut seen);
        }
    }
    println!("{seen:?}");
    assert!(seen.pixels > 10_000, "{seen:?}");
}

fn fans<T: Tier>(seeds: std::ops::Range<u64>) {
    let mut seen = Seen::default();
    for seed in seeds {
        let mut rng = Rng::new(seed);
        for centre in FanCentre::ALL {
            let viewport = viewport(&mut rng);
            let mesh = fan(centre, viewport, &mut rng);
            flat::<T>(&mesh, viewport, &format!("seed {seed} {centre:?} {viewport:?}"), &mut seen);
        }
    }
    println!("{seen:?}");
    assert!(seen.pixels > 10_000, "{seen:?}");
}

fn closed_meshes<T: Tier>(seeds: std::ops::Range<u64>) {
    let mut seen = Seen::default();
    for seed in seeds {
        let mut rng = Rng::new(seed);
        for solid in Solid::ALL {
            for eye in Eye::ALL {
                let viewport = viewport(&mut rng);
                let mesh = closed(solid, eye, &mut rng);
                let what = format!("seed {seed} {solid:?} {eye:?} {viewport:?}");
                evenly::<T>(&mesh, viewport, &what, &mut seen);
            }
        }
    }
    println!("{seen:?}");
    assert!(seen.pixels > 10_000, "{seen:?}");
}

macro_rules! in_every_tier {
    ($($name:ident: $tier:ty;)*) => {$(
        mod $name {
            use super::*;

            #[test]
            fn flat_meshes_cover_once() {
                flat_meshes::<$tier>(0..24);
            }

            #[test]
            fn fans_cover_once() {
                fans::<$tier>(100..140);
            }

            #[test]
            fn closed_meshes_stay_closed() {
                closed_meshes::<$tier>(200..212);
            }
        }
    )*};
}

in_every_tier! {
    exact: Exact;
    quick4: Quick<4>;
    quick8: Quick<8>;
}
