//! Attributes and depth are as close to the `f64` reference as the tolerance table says.

use hither::{Exact, Perspective};
use host_tests::accuracy::{Errors, Family, Quantity, Reference, Scene, TOLERANCES, measure};
use host_tests::oracle::Viewport;

/// Scenes of each family.
const SCENES: u64 = 24;

fn check(tier: usize) {
    let mut beyond = Vec::new();
    for row in &TOLERANCES[tier] {
        let errors = row.survey(SCENES);
        assert!(errors.count > 10_000, "{row}: {} pixels", errors.count);
        println!("{row} {:.3e} {:.3e} of {:.3e}", errors.max, errors.rms(), row.bound);
        if errors.max.is_nan() || errors.max > row.bound {
            beyond.push(format!("{row}: {:e} in {:?}", errors.max, errors.worst));
        }
    }
    assert!(beyond.is_empty(), "{beyond:#?}");
}

#[test]
fn exact_tier() {
    check(0);
}

#[test]
fn quick4() {
    check(1);
}

#[test]
fn quick8() {
    check(2);
}

/// Depths of a million hither distances that cancel: found at random among the steep scenes.
/// Weights that are each off by a part in 2^31 make it 3.26 units at pixel (36, 12).
#[test]
fn depths_that_cancel_stay_within_a_unit() {
    let scene = Scene {
        seed: (Family::Steep, 0),
        viewport: Viewport::new(64, 64),
        corners: [[-4, 6, -916_792, 10], [37, 11, 687_566, 27], [-11, -7, 373_805, -15]],
        attribute: [0, 1 << 16, 1 << 20],
        hither: 1,
    };
    let mut errors = Errors::default();
    measure::<Exact, Perspective, u16>(
        &scene,
        Reference::Perspective,
        Quantity::Depth16,
        &mut errors,
    );
    assert!(errors.max <= 1.0, "{} units at {:?}", errors.max, errors.worst);
}
