//! Triangles of areas from a pixel down to 2^-16 of one, on a pixel's centre, beside it and between centres.

use host_tests::accuracy::{Family, Scene};
use host_tests::oracle::{GRID, Rng, Viewport};

use super::{Named, coverage, is_as_promised, pieces_are_between};

/// Least area that the tier's grid has, as a power of two: half a square subpixel, or what is asked for.
fn least<T: Named>() -> i32 {
    if T::SUBPIXEL_BITS == 4 { -9 } else { -16 }
}

/// Three points within `reach` grid units of a pixel's centre, which is among them every other time.
fn around(viewport: Viewport, reach: i64, rng: &mut Rng) -> [[i64; 3]; 3] {
    let (width, height) = (i64::from(viewport.width), i64::from(viewport.height));
    let (column, row) = (rng.range(0, width - 1), rng.range(0, height - 1));
    let mut off = [(); 2].map(|()| [rng.range(-reach, reach), rng.range(-reach, reach)]).to_vec();
    off.push([-off[0][0] - off[1][0], -off[0][1] - off[1][1]]);
    if rng.once_in(2) {
        // A sliver: the third is nearly between the other two.
        let t = rng.fraction();
        off[2] = [0, 1].map(|n| (off[0][n] as f64 * (1.0 - t) + off[1][n] as f64 * t) as i64);
        off[2][rng.below(2) as usize] += rng.range(-2, 2);
    }
    let shift = if rng.once_in(2) { 0 } else { rng.signed(reach) };
    let offs = [off[0], off[1], off[2]];
    offs.map(|[dx, dy]| {
        // Such that the centres are on the grid where a side is a power of two.
        let w = GRID * rng.range(4, 8) / 8;
        let at =
            |centre: i64, side: i64, off: i64| (centre * (w / side) + off * w / GRID).clamp(-w, w);
        [at(2 * column + 1 - width, width, dx + shift), at(height - 1 - 2 * row, height, dy), w]
    })
}

fn check<T: Named>() {
    let mut rng = Rng::new(21);
    let mut seen = [[0; 2]; 17];
    for round in 0..12_000 {
        let viewport = if round % 200 == 0 {
            Viewport::new(512, 512)
        } else {
            rng.choose(&[Viewport::new(32, 64), Viewport::new(15, 9)])
        };
        let pixel = 2 * GRID / i64::from(viewport.width.max(viewport.height));
        let corners = around(viewport, pixel >> (round % 13), &mut rng);
        let covered = coverage::<T>(viewport, corners);
        let (area, pixels) = (covered.area(), covered.pixels());
        if area == 0.0 || area > 1.0 {
            continue;
        }
        let bits = (-area.log2()).floor().min(16.0) as usize;
        seen[bits][usize::from(pixels > 0)] += 1;
        if pixels > 0 {
            shaded::<T>(viewport, corners, &mut rng);
        }
    }
    println!("areas by powers of two, that hit nothing and that hit a pixel: {seen:?}");
    let all = &seen[..=least::<T>().unsigned_abs() as usize];
    // Of the largest few hit nothing.
    assert!(all.iter().flatten().skip(1).all(|&count| count > 0), "{seen:?}");
}

/// Asserts what one of these triangles shows, of depths and varyings over the whole of their ranges.
fn shaded<T: Named>(viewport: Viewport, corners: [[i64; 3]; 3], rng: &mut Rng) {
    let ends = [i32::MIN, rng.range(-(1 << 20), 1 << 20) as i32, i32::MAX];
    let corners = corners.map(|[x, y, w]| [x, y, rng.choose(&[0, w / 3, w]), w]);
    let hither = corners.iter().map(|c| c[3]).min().unwrap_or(1);
    let seed = (Family::Small, 0);
    let scene = Scene { seed, viewport, corners, attribute: ends, hither };
    assert!(is_as_promised::<T>(&scene) > 0, "{scene:?}");
    pieces_are_between::<T>(&scene);
}

in_every_tier! {
    areas_down_to_a_65536th_of_a_pixel => check;
}
