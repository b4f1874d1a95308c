//! Coordinates at the ends of the exact tier's grid and of 32 bits, with all signs.

use host_tests::accuracy::{Family, Scene};
use host_tests::oracle::{GRID, Rng, Vertex, Viewport};

use super::{Named, coverage, pieces_are_between};

const ENDS: [i64; 2] = [i32::MIN as i64, i32::MAX as i64];

/// One of two values for each coordinate, by its bit.
fn corners(bits: u32, mut of: impl FnMut(u32, bool) -> i64) -> [Vertex; 3] {
    [0, 1, 2].map(|i| [0, 1, 2].map(|n| of(3 * i + n, bits >> (3 * i + n) & 1 == 1)))
}

/// All 512 signs of `2^20`, and all 19,683 of it and 0.
fn grid<T: Named>() {
    let mut covered = 0;
    for bits in 0..512 {
        let corners = corners(bits, |_, negative| if negative { -GRID } else { GRID });
        let side = if bits % 32 == 0 { 512 } else { 40 };
        covered += coverage::<T>(Viewport::new(side, side), corners).pixels();
    }
    for i in 0..3_usize.pow(9) {
        let sign = |n: u32| (i / 3_usize.pow(n) % 3) as i64 - 1;
        let corners = [0, 1, 2].map(|k| [0, 1, 2].map(|n| GRID * sign(3 * k + n)));
        covered += coverage::<T>(Viewport::new(5, 4), corners).pixels();
    }
    assert!(covered > 50_000, "{covered}");
}

/// One grid step inside of the ends, and on them.
fn beside<T: Named>() {
    let mut rng = Rng::new(24);
    let mut covered = 0;
    for _ in 0..3000 {
        let viewport =
            rng.choose(&[Viewport::new(31, 17), Viewport::new(1, 1), Viewport::new(16, 3)]);
        let corners = [[0; 3]; 3]
            .map(|none| none.map(|_: i64| (GRID - rng.range(0, 1)) * rng.choose(&[-1, 1])));
        covered += coverage::<T>(viewport, corners).pixels();
    }
    let wide = corners(0b011_010_000, |_, negative| if negative { -GRID } else { GRID });
    covered += coverage::<T>(Viewport::new(512, 512), wide).pixels();
    assert!(covered > 20_000, "{covered}");
}

/// The ends of 32 bits and their neighbours, all signs of each; also with depth, varyings and a hither plane.
fn raw<T: Named>() {
    let mut rng = Rng::new(25);
    let mut covered = 0;
    for round in 0..4096 {
        let viewport = rng.choose(&[Viewport::new(24, 31), Viewport::new(9, 64)]);
        let nudge = [0; 9].map(|_: i64| rng.range(0, 1));
        let corners = corners(round % 512, |n, negative| {
            let nudge = nudge[n as usize];
            if negative { ENDS[0] + nudge } else { ENDS[1] - nudge }
        });
        covered += coverage::<T>(viewport, corners).pixels();
        if round % 4 == 0 {
            let z = rng.choose(&ENDS);
            let corners = corners.map(|[x, y, w]| [x, y, z, w]);
            let hither = rng.choose(&[1, 1 << 20, ENDS[1] - 1, ENDS[1]]);
            let attribute = [i32::MIN, i32::MAX, 0];
            let seed = (Family::Nasty, u64::from(round));
            pieces_are_between::<T>(&Scene { seed, viewport, corners, attribute, hither });
        }
    }
    assert!(covered > 100_000, "{covered}");
}

/// Of 63 bits, as a transform may leave them: the ends, and any magnitude beside them.
fn wide<T: Named>() {
    let mut rng = Rng::new(34);
    let mut covered = 0;
    for round in 0..2048 {
        let viewport = rng.choose(&[Viewport::new(24, 31), Viewport::new(9, 64)]);
        let corners = corners(round % 512, |_, negative| {
            let end = if rng.once_in(3) { rng.magnitude(i64::MAX >> 1) } else { i64::MAX >> 1 };
            if negative { -end } else { end }
        });
        covered += coverage::<T>(viewport, corners).pixels();
    }
    assert!(covered > 50_000, "{covered}");
}

in_every_tier! {
    signs_of_the_grids_ends => grid;
    neighbours_of_the_grids_ends => beside;
    ends_of_32_bits => raw;
    ends_of_63_bits => wide;
}
