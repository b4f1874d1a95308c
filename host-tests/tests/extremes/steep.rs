//! The whole range of a varying and of depth within a pixel: tiny triangles, and planes that are seen from their side.

use host_tests::accuracy::{Family, Scene};
use host_tests::oracle::{GRID, Rng, Viewport};

use super::{Named, depths_are_as_promised, is_as_promised, pieces_are_between};

/// A strip up to the viewport's length and at most a pixel wide, at any angle: two vertices at its one side, the third
/// at the other.
pub(super) fn strip(viewport: Viewport, ratio: i64, rng: &mut Rng) -> [[i64; 3]; 3] {
    let side = f64::from(viewport.width.min(viewport.height));
    let (turn, middle) =
        (rng.between(0.0, std::f64::consts::TAU), [rng.between(-0.3, 0.3), rng.between(-0.3, 0.3)]);
    let (along, across) = ([turn.cos(), turn.sin()], [-turn.sin(), turn.cos()]);
    let length = rng.between(0.1, 0.9);
    let width = 2.0 / side * rng.fraction().powi(2);
    let places = [[-length, 0.0], [length, 0.0], [length * rng.between(-1.0, 1.0), width]];
    places.map(|[l, t]| {
        let w = GRID / rng.range(1, ratio);
        let at = |n: usize| ((middle[n] + l * along[n] + t * across[n]) * w as f64).round() as i64;
        [at(0).clamp(-w, w), at(1).clamp(-w, w), w]
    })
}

/// Any triangle of less than two pixels' size.
pub(super) fn dot(viewport: Viewport, rng: &mut Rng) -> [[i64; 3]; 3] {
    let side = f64::from(viewport.width.min(viewport.height));
    let middle = [rng.between(-0.9, 0.9), rng.between(-0.9, 0.9)];
    [(); 3].map(|()| {
        let w = GRID / rng.range(1, 8);
        let at = |middle: f64, off: f64| ((middle + off / side) * w as f64).round() as i64;
        [at(middle[0], rng.between(-2.0, 2.0)), at(middle[1], rng.between(-2.0, 2.0)), w]
    })
}

fn scene(corners: [[i64; 3]; 3], z: [i64; 3], viewport: Viewport, rng: &mut Rng) -> Scene {
    let least = corners.iter().map(|c| c[2]).min().unwrap_or(1);
    let mut attribute = [i32::MIN, rng.choose(&[i32::MIN, 0, 3]), i32::MAX];
    if rng.once_in(3) {
        attribute.rotate_left(1);
    }
    let steep = (0..3).any(|i| z[i].abs() > 4 * corners[i][2]);
    let corners = [0, 1, 2].map(|i| [corners[i][0], corners[i][1], z[i], corners[i][2]]);
    let family = if steep { Family::Steep } else { Family::Sliver };
    Scene { seed: (family, 0), viewport, corners, attribute, hither: rng.range(1, least) }
}

/// From the hither plane to far across a strip, and along a dot.
fn inside<T: Named>() {
    let mut rng = Rng::new(28);
    let mut pixels = 0;
    for round in 0..1600 {
        let viewport =
            if round % 20 == 0 { Viewport::new(512, 512) } else { Viewport::new(90, 64) };
        let ratio = rng.choose(&[1, 2, 16, 4096]);
        let corners =
            if round % 4 == 0 { dot(viewport, &mut rng) } else { strip(viewport, ratio, &mut rng) };
        let z = [0, rng.range(0, 1) * corners[1][2] / 9, corners[2][2]];
        let scene = scene(corners, z, viewport, &mut rng);
        pixels += is_as_promised::<T>(&scene);
        pieces_are_between::<T>(&scene);
    }
    assert!(pixels > 5_000, "{pixels}");
}

/// From before the plane to beyond far: up to 4 of the range on both sides, and up to the ends of the type.
fn beyond<T: Named>() {
    let mut rng = Rng::new(29);
    let (mut pixels, mut steep) = (0, 0);
    for round in 0..1600 {
        let viewport =
            if round % 20 == 0 { Viewport::new(512, 512) } else { Viewport::new(90, 64) };
        let corners =
            if round % 4 == 0 { dot(viewport, &mut rng) } else { strip(viewport, 4, &mut rng) };
        let times = rng.choose(&[1, 4, 4, 1000, 2047]);
        let mut z = corners.map(|[.., w]| rng.choose(&[-1, 1]) * times * w);
        if rng.once_in(2) {
            z[rng.below(3) as usize] = 0;
        }
        let scene = scene(corners, z, viewport, &mut rng);
        steep += u32::from(scene.seed.0 == Family::Steep);
        pixels += depths_are_as_promised::<T>(&scene);
    }
    assert!(pixels > 5_000 && steep > 100, "{pixels} {steep}");
}

in_every_tier! {
    the_whole_range_within_a_pixel => inside;
    depths_beyond_both_ends_saturate => beyond;
}
