//! The hither plane exactly through one, two and three vertices, with the others beyond it and before it.

use hither::{Hither, I16F16, Outcome, Snapped};
use host_tests::accuracy::{Family, Scene};
use host_tests::oracle::{
    ExactTriangle, Part, PlaneFunction, PlaneSide, Rng, Space, Surface, Viewport, whole,
};
use host_tests::record::{Mark, clip_vertex, frame};
use host_tests::snapped;
use num_bigint::BigInt;
use num_rational::BigRational;

use super::{Named, coverage, is_as_promised, pieces_are_between};

/// What a frame with a hither plane draws, and the snapped vertices.
fn draw<T: Named>(
    viewport: Viewport,
    corners: [[i64; 3]; 3],
    h: i64,
) -> (Vec<u8>, [Snapped; 3], Outcome) {
    let plane = Hither::new(I16F16::from_bits(h as i32)).expect("above 0");
    let mut frame = frame(viewport).with_tier(T::default()).with_hither(plane);
    let vertices = corners.map(|[x, y, w]| frame.snap(&clip_vertex([x, y, 0, w]), []));
    let [a, b, c] = &vertices;
    let outcome = frame.draw_snapped([a, b, c], &Mark);
    (frame.target_mut().take_counts(), vertices.map(|v| v.snapped()), outcome)
}

/// Compares each pixel with the exact plane over the exact triangle; how many the plane hides.
///
/// Where no vertex is before the plane nothing is hidden; elsewhere a pixel may fall either way where its `w` is within
/// a part in 4096 of the plane's.
fn compare<T: Named>(viewport: Viewport, corners: [[i64; 3]; 3], h: i64) -> usize {
    let (counts, snapped, outcome) = draw::<T>(viewport, corners, h);
    let points = snapped.map(|s| snapped::in_pixels(s, viewport));
    let exact = ExactTriangle::from_pixel_space(points, viewport, Part::Front);
    let scales = [0, 1, 2].map(|i| snapped::scale(snapped[i], corners[i][2]));
    let surface = Surface::from_rationals(&points.map(whole), &scales, Space::Pixel, viewport);
    let cuts = corners.iter().any(|c| c[2] < h);
    let plane = surface.filter(|_| cuts).map(|surface| {
        let at = BigRational::from_integer(h.into());
        let values = [0, 1, 2].map(|i| {
            let [_, _, w] = snapped::in_clip(snapped[i], viewport, corners[i][2]);
            w - &at
        });
        let function = PlaneFunction::new(&surface, &values);
        let band = function.largest().clone().min(at) / BigInt::from(1 << 12);
        (function, band)
    });
    let mut hidden = 0;
    for ((x, y), &count) in viewport.pixels().zip(&counts) {
        let side = match &plane {
            Some((plane, band)) if exact.covers(x, y) => plane.side_within(x, y, band),
            _ => Some(PlaneSide::Inside),
        };
        let expected = match side {
            Some(PlaneSide::Near) => continue,
            Some(PlaneSide::Inside) => exact.covers(x, y),
            _ => false,
        };
        let what = || format!("{x} {y} of {viewport:?} {corners:?} h {h} {outcome:?}");
        assert_eq!(count, u8::from(expected), "{}", what());
        hidden += usize::from(!expected && exact.covers(x, y));
    }
    hidden
}

/// Where the others of `on` vertices are.
#[derive(Clone, Copy)]
enum Others {
    Beyond,
    Before,
    Both,
}

/// A triangle with `on` vertices at `w = h`.
fn triangle(on: usize, others: Others, h: i64, rng: &mut Rng) -> [[i64; 3]; 3] {
    let most = (4 * h).max(64);
    let mut corners = [0, 1, 2].map(|i| {
        let beyond = match others {
            Others::Beyond => true,
            Others::Before => false,
            Others::Both => i == 2,
        };
        let w = if i < on {
            h
        } else if beyond {
            h + rng.magnitude(most - h)
        } else {
            h - rng.magnitude(most)
        };
        let reach = w.abs().max(1) * rng.range(1, 3);
        [rng.range(-reach, reach), rng.range(-reach, reach), w]
    });
    corners.rotate_left(rng.below(3) as usize);
    corners
}

const DISTANCES: [i64; 8] = [1, 2, 3, 77, 1 << 10, (1 << 10) + 1, 65_536, 261_000];

fn viewport(rng: &mut Rng) -> Viewport {
    Viewport::new(rng.range(1, 40) as u32, rng.range(1, 40) as u32)
}

/// With nothing before the plane it hides nothing: what is drawn is what is drawn without it.
fn beyond<T: Named>() {
    let mut rng = Rng::new(26);
    let mut covered = 0;
    for h in DISTANCES {
        for round in 0..90 {
            let viewport = viewport(&mut rng);
            let corners = triangle(1 + round % 3, Others::Beyond, h, &mut rng);
            assert_eq!(compare::<T>(viewport, corners, h), 0);
            let (counts, ..) = draw::<T>(viewport, corners, h);
            let without = coverage::<T>(viewport, corners);
            assert_eq!(counts, without.counts, "{viewport:?} {corners:?}");
            covered += without.pixels();
            let z = corners.map(|[x, y, w]| [x, y, w - h, w]);
            let attribute = [i32::MIN, 7, i32::MAX];
            let seed = (Family::ThroughHither, 0);
            let scene = Scene { seed, viewport, corners: z, attribute, hither: h };
            is_as_promised::<T>(&scene);
            pieces_are_between::<T>(&scene);
        }
    }
    assert!(covered > 50_000, "{covered}");
}

/// With others before it, or some before and some beyond.
fn before<T: Named>() {
    let mut rng = Rng::new(27);
    let mut hidden = [0; 2];
    for h in DISTANCES {
        for round in 0..90 {
            let viewport = viewport(&mut rng);
            let alone = triangle(1 + round % 2, Others::Before, h, &mut rng);
            hidden[0] += compare::<T>(viewport, alone, h);
            let between = triangle(1, Others::Both, h, &mut rng);
            hidden[1] += compare::<T>(viewport, between, h);
            let z = between.map(|[x, y, w]| [x, y, w - h, w]);
            let steep = z.iter().any(|&[.., z, w]| z.abs() > 4 * w);
            let seed = (if steep { Family::Steep } else { Family::ThroughHither }, 0);
            let attribute = [-1 << 20, 7, 1 << 20];
            let scene = Scene { seed, viewport, corners: z, attribute, hither: h };
            super::depths_are_as_promised::<T>(&scene);
            let scene = Scene { seed: (Family::ThroughHither, 0), ..scene };
            super::varyings_are_as_promised::<T>(&scene);
        }
    }
    assert!(hidden.iter().all(|&pixels| pixels > 10_000), "{hidden:?}");
}

/// A plane at the ends of its type, through all three vertices; and a raw step before and beyond them.
fn ends<T: Named>() {
    let viewport = Viewport::new(12, 9);
    for h in [1, 2, i64::from(i32::MAX) - 1, i64::from(i32::MAX)] {
        let corners = [[-h, -h, h], [h, -h, h], [0, h, h]];
        assert_eq!(compare::<T>(viewport, corners, h), 0);
        let (on, ..) = draw::<T>(viewport, corners, h);
        assert!(on.iter().filter(|&&count| count == 1).count() > 30, "{h}");
        if h > 1 {
            assert_eq!(draw::<T>(viewport, corners, h - 1).0, on);
        }
        if h < i64::from(i32::MAX) {
            let (counts, _, outcome) = draw::<T>(viewport, corners, h + 1);
            assert!(counts.iter().all(|&count| count == 0));
            assert_eq!(outcome, Outcome::Behind);
        }
    }
}

/// On the plane depth is 0 and `1 / w` is at its top, at a vertex on a pixel's centre.
fn nearest<T: Named>() {
    let viewport = Viewport::new(64, 64);
    for h in [1 << 7, 3 << 7, 1 << 14, 1 << 18] {
        for far in [2 * h, 3 * h, 4 * h] {
            // The centre of pixel (31, 32) is at -1/64, -1/64.
            let centre = [-h / 64, -h / 64, 0, h];
            let corners = [[-far, far, far - h, far], centre, [far, far / 2, far - h, far]];
            for attribute in [[0, 1 << 16, 0], [i32::MAX, i32::MIN, 0]] {
                let seed = (Family::Deep, 0);
                let scene = Scene { seed, viewport, corners, attribute, hither: h };
                assert!(is_as_promised::<T>(&scene) > 100);
                pieces_are_between::<T>(&scene);
            }
        }
    }
}

in_every_tier! {
    others_are_beyond => beyond;
    others_are_before => before;
    ends_of_the_planes_type => ends;
    a_vertex_on_the_plane_is_nearest => nearest;
}
