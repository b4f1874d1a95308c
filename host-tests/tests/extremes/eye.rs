//! A vertex whose `w` goes to 0 from in front of the eye and from behind it, and through it.

use host_tests::accuracy::{Family, Scene};
use host_tests::oracle::{GRID, Rng, Vertex, Viewport};

use super::{Named, coverage, is_as_promised, pieces_are_between};

/// Every `w` near 0, then powers of two: from behind the eye to in front of it.
fn through_zero() -> impl Iterator<Item = i64> {
    let powers = (4..=20).map(|n| 1 << n);
    let far: Vec<i64> = powers.collect();
    let behind = far.clone().into_iter().rev().map(|w| -w);
    behind.chain(-12..=12).chain(far)
}

/// Places for the vertex that moves: on the axis, to every side, and far off.
const PLACES: [[i64; 2]; 9] = [
    [0, 0],
    [1, 0],
    [0, -1],
    [-3, 2],
    [700, 11],
    [-40_000, 30_000],
    [GRID, -GRID],
    [-GRID, 1],
    [12_345, GRID],
];

fn one_vertex<T: Named>() {
    let others: [[Vertex; 2]; 4] = [
        [[-GRID / 2, -GRID / 3, GRID], [GRID / 2, -GRID / 4, GRID]],
        [[-40, 30, 37], [55, 20, 1000]],
        [[-5, -5, 1], [9, 2, -1]],
        [[1, 1, 0], [GRID, -7, -GRID]],
    ];
    let mut covered = 0;
    for viewport in [Viewport::new(48, 33), Viewport::new(7, 512)] {
        for [x, y] in PLACES {
            for [p, q] in others {
                for w in through_zero() {
                    covered += coverage::<T>(viewport, [p, [x, y, w], q]).pixels();
                }
            }
        }
    }
    assert!(covered > 100_000, "{covered}");
}

/// All three at -2 to 2.
fn all_vertices<T: Named>() {
    let mut rng = Rng::new(22);
    let mut covered = 0;
    for round in 0..40 {
        let viewport = Viewport::new(rng.range(1, 40) as u32, rng.range(1, 40) as u32);
        let reach = if round % 2 == 0 { 3 } else { GRID };
        let xy = [[0; 2]; 3].map(|none| none.map(|_: i64| rng.signed(reach)));
        for i in 0..125 {
            let w = [i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2];
            let corners = [0, 1, 2].map(|k| [xy[k][0], xy[k][1], w[k]]);
            covered += coverage::<T>(viewport, corners).pixels();
        }
    }
    assert!(covered > 10_000, "{covered}");
}

/// With varyings and depth, beyond the nearest hither plane there is.
fn shaded<T: Named>() {
    let mut rng = Rng::new(23);
    let viewport = Viewport::new(64, 48);
    let mut pixels = 0;
    for w in through_zero() {
        for _ in 0..12 {
            let third = [rng.signed(64), rng.signed(64), w];
            let wide = |rng: &mut Rng| {
                let w = rng.magnitude(4096);
                [rng.range(-2 * w, 2 * w), rng.range(-2 * w, 2 * w), w]
            };
            let corners = [wide(&mut rng), third, wide(&mut rng)];
            // As a lens sets them: within 4 w, whatever w is.
            let corners = corners.map(|[x, y, w]| [x, y, w - 1, w]);
            // Depths of a vertex behind the eye cancel.
            let steep = corners.iter().any(|&[.., z, w]| z.abs() > 4 * w);
            let family = if steep { Family::Steep } else { Family::ThroughEye };
            let low = rng.range(i64::from(i32::MIN), 0) as i32;
            let attribute = [low, low + (1 << 14), low + rng.magnitude(1 << 30) as i32];
            let scene = Scene { seed: (family, 0), viewport, corners, attribute, hither: 1 };
            pieces_are_between::<T>(&scene);
            if family == Family::Steep {
                pixels += super::depths_are_as_promised::<T>(&scene);
                let scene = Scene { seed: (Family::ThroughEye, 0), ..scene };
                super::varyings_are_as_promised::<T>(&scene);
            } else {
                pixels += is_as_promised::<T>(&scene);
            }
        }
    }
    assert!(pixels > 50_000, "{pixels}");
}

in_every_tier! {
    one_vertex_goes_through_the_eye => one_vertex;
    all_vertices_are_at_the_eye => all_vertices;
    varyings_and_depths_stay_within_their_bounds => shaded;
}
