//! Sums over 131,072 pixels, row by row: the last is as near as the first.

use host_tests::accuracy::{CorrectionName, Family, Quantity, Reference, Scene};
use host_tests::oracle::{GRID, Rng, Viewport};

use super::{Named, Packed8, Pieces16, is_as_promised, pieces_are_between, promise};

pub(super) const VIEWPORT: Viewport = Viewport::new(512, 512);

/// Half of the viewport, with the long side on top, at the bottom, left and right.
const HALVES: [[[i64; 2]; 3]; 4] = [
    [[-1, 1], [1, 1], [-1, -1]],
    [[1, -1], [-1, -1], [1, 1]],
    [[-1, -1], [-1, 1], [1, -1]],
    [[1, 1], [1, -1], [-1, 1]],
];

/// One of them, with `w` of up to `ratio` times the least.
pub(super) fn half(which: usize, ratio: i64, rng: &mut Rng) -> [[i64; 3]; 3] {
    let mut w = [1, ratio, rng.range(1, ratio)];
    w.rotate_left(rng.below(3) as usize);
    [0, 1, 2].map(|i| {
        let w = (GRID / ratio) * w[i];
        [HALVES[which][i][0] * w, HALVES[which][i][1] * w, w]
    })
}

/// Varyings and depths, by every correction that has a bound.
fn check<T: Named>() {
    let mut rng = Rng::new(30);
    for (which, ratio) in [(0, 1), (1, 2), (2, 8), (3, 4096)] {
        let corners = half(which, ratio, &mut rng);
        let h = GRID / ratio - rng.range(0, 1);
        let mut z = corners.map(|[.., w]| w - h);
        if which > 1 {
            z = [0, corners[1][2], corners[2][2] / 3];
        }
        let corners = [0, 1, 2].map(|i| [corners[i][0], corners[i][1], z[i], corners[i][2]]);
        let low = rng.range(i64::from(i32::MIN), 0) as i32;
        let attribute = [low, low + (1 << 14), low + (1 << 30)];
        let family = if ratio <= 2 { Family::Mild } else { Family::Deep };
        let seed = (family, 0);
        let scene = Scene { seed, viewport: VIEWPORT, corners, attribute, hither: h };
        assert!(is_as_promised::<T>(&scene) >= 130_816, "{scene:?}");
        if ratio <= 2 {
            let (pieces, perspective) = (CorrectionName::Every16, Reference::Perspective);
            promise::<T, Pieces16, u16>(&scene, pieces, perspective, Quantity::Attribute);
            promise::<T, Packed8, u16>(&scene, pieces, perspective, Quantity::Attribute);
        }
        pieces_are_between::<T>(&scene);
    }
}

in_every_tier! {
    varyings_and_depths_do_not_drift => check;
}
