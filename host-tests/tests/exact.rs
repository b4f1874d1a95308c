//! Coverage equals exact rational arithmetic, bit for bit, in every tier.

use std::any::TypeId;

use hither::{Cull, Exact, Outcome, Quick, Tier};
use host_tests::oracle::{
    Category, ExactTriangle, Part, Rng, Vertex, Viewport, random_viewport, triangle,
};
use host_tests::record::{Mark, clip_vertex, frame};
use host_tests::snapped;

/// How often each pixel is drawn, what became of the triangle, and its snapped vertices in pixel
/// space.
fn draw<T: Tier>(
    viewport: Viewport,
    corners: [Vertex; 3],
    both: bool,
) -> (Vec<u8>, Outcome, [Vertex; 3]) {
    let vertices = corners.map(|[x, y, w]| (clip_vertex([x, y, 0, w]), []));
    macro_rules! through {
        ($frame:expr) => {{
            let mut frame = $frame;
            let snapped = vertices.map(|(v, none)| frame.snap(&v, none).snapped());
            for (snapped, corner) in snapped.into_iter().zip(corners) {
                let off = snapped::distance(snapped, corner, viewport);
                assert!(off <= 0.5, "{corner:?} is snapped {off} grid units off: {snapped:?}");
            }
            let outcome = frame.draw_triangle(vertices, &Mark);
            let counts = frame.target_mut().take_counts();
            (counts, outcome, snapped.map(|s| snapped::in_pixels(s, viewport)))
        }};
    }
    let frame = frame(viewport).with_tier(T::default());
    if both { through!(frame.with_both_sides()) } else { through!(frame) }
}

/// A viewport of any size, mostly small so that there is time for many triangles.
fn viewport(rng: &mut Rng) -> Viewport {
    let any = random_viewport(rng);
    if rng.once_in(24) {
        any
    } else {
        Viewport::new(
            any.width.min(rng.range(1, 64) as u32),
            any.height.min(rng.range(1, 64) as u32),
        )
    }
}

/// Compares triangles of every category until `decisions` pixels were decided; returns how many
/// were.
fn compare<T: Tier>(seed: u64, decisions: usize, stretch: bool) -> usize {
    let mut rng = Rng::new(seed);
    let (mut decided, mut covered, mut triangles) = (0, 0, 0);
    while decided < decisions {
        for category in Category::ALL {
            let viewport = viewport(&mut rng);
            let mut corners = triangle(category, viewport, &mut rng);
            if stretch {
                // Off the grid, up to the ends of 32 bits.
                let by = rng.range(1, 2046);
                corners = corners.map(|c| c.map(|v| v * by + v.signum() * rng.range(0, 1 << 20)));
            }
            let both = rng.once_in(3);
            let (counts, outcome, points) = draw::<T>(viewport, corners, both);
            let what = format!(
                "seed {seed} {category:?} {viewport:?} {corners:?} both {both} {outcome:?}"
            );
            let prepare = |part| {
                if stretch || T::default().projects() {
                    ExactTriangle::from_pixel_space(points, viewport, part)
                } else {
                    ExactTriangle::new(corners, viewport, part)
                }
            };
            let [front, behind] = Part::ALL.map(prepare);
            for ((x, y), count) in viewport.pixels().zip(counts) {
                let expected = u8::from(front.covers(x, y)) + u8::from(both && behind.covers(x, y));
                assert_eq!(count, expected, "pixel {x} {y} of {what}");
                covered += usize::from(count);
            }
            decided += (viewport.width * viewport.height) as usize;
            triangles += 1;
        }
    }
    println!("{triangles} triangles, {decided} decisions, {covered} covered");
    assert!(covered > decided / 50, "{covered}");
    decided
}

/// Whether a tier moves vertices that are on the exact tier's grid.
trait Projects {
    fn projects(&self) -> bool;
}

impl<T: Tier> Projects for T {
    fn projects(&self) -> bool {
        TypeId::of::<T>() != TypeId::of::<Exact>()
    }
}

/// On the grid the vertices are the true ones: 10 million decisions and more.
#[test]
fn exact_tier() {
    assert!(compare::<Exact>(1, 16_000_000, false) >= 10_000_000);
}

#[test]
fn exact_tier_off_the_grid() {
    compare::<Exact>(2, 6_000_000, true);
}

#[test]
fn quick4() {
    compare::<Quick<4>>(3, 10_000_000, false);
    compare::<Quick<4>>(4, 4_000_000, true);
}

#[test]
fn quick8() {
    compare::<Quick<8>>(5, 10_000_000, false);
    compare::<Quick<8>>(6, 4_000_000, true);
}

/// A culled facing draws nothing, the other what it draws without culling, and facing is the sign
/// of the determinant.
fn facings<T: Tier>(seed: u64) {
    let mut rng = Rng::new(seed);
    let mut seen = [0; 3];
    for category in Category::ALL.into_iter().cycle().take(4000) {
        let viewport = Viewport::new(rng.range(1, 24) as u32, rng.range(1, 24) as u32);
        let corners = triangle(category, viewport, &mut rng);
        let vertices = corners.map(|[x, y, w]| (clip_vertex([x, y, 0, w]), []));
        let drawn = |cull| {
            let mut frame = frame(viewport).with_tier(T::default()).with_cull(cull);
            let points = vertices.map(|(v, none)| frame.snap(&v, none).snapped());
            let outcome = frame.draw_triangle(vertices, &Mark);
            let points = points.map(|s| snapped::in_pixels(s, viewport));
            let exact = ExactTriangle::from_pixel_space(points, viewport, Part::Front);
            (exact.orientation(), outcome, frame.target_mut().take_counts())
        };
        let (facing, outcome, all) = drawn(Cull::Neither);
        seen[(facing + 1) as usize] += 1;
        for (cull, hidden) in [(Cull::Back, -1), (Cull::Front, 1)] {
            let (_, culled, counts) = drawn(cull);
            let what = format!("seed {seed} {viewport:?} {corners:?} {cull:?}");
            if facing == hidden {
                assert!(counts.iter().all(|&count| count == 0), "{what}");
                assert!(culled == Outcome::Culled || culled == outcome, "{what}");
                assert_ne!(culled, Outcome::Drawn, "{what}");
            } else {
                assert_eq!((culled, &counts), (outcome, &all), "{what}");
            }
        }
        if facing == 0 {
            assert_ne!(outcome, Outcome::Drawn, "{corners:?}");
        }
    }
    assert!(seen.iter().all(|&count| count > 100), "{seen:?}");
}

#[test]
fn facings_in_every_tier() {
    facings::<Exact>(7);
    facings::<Quick<4>>(8);
    facings::<Quick<8>>(9);
}
