//! The largest errors that a search found: they are within the promise, and no more than a factor of 4 from it.

use hither::{Exact, Perspective, Quick};
use host_tests::accuracy::{CorrectionName, Errors, Family, Quantity, Reference, Scene, measure};
use host_tests::oracle::Viewport;

use super::{Named, promised};

/// The largest error of a varying in perspective, in parts of its range, and what is promised.
fn error<T: Named>(corners: [[i64; 4]; 3], attribute: [i32; 3]) -> [f64; 2] {
    let (seed, viewport) = ((Family::Deep, 0), Viewport::new(512, 512));
    let scene = Scene { seed, viewport, corners, attribute, hither: 256 };
    let mut errors = Errors::default();
    let (near, quantity) = (Reference::Perspective, Quantity::Attribute);
    measure::<T, Perspective, u16>(&scene, near, quantity, &mut errors);
    println!("{}: {:e}", T::NAME.name(), errors.max);
    let each = CorrectionName::Perspective;
    [errors.max, promised(T::NAME, each, near, quantity, Family::Deep)]
}

fn is_near<T: Named>(corners: [[i64; 4]; 3], attribute: [i32; 3]) {
    let [error, promised] = error::<T>(corners, attribute);
    assert!(error <= promised && 4.0 * error >= promised, "{error:e}, {promised:e} promised");
}

/// One vertex on the hither plane, two 4096 times as far: uphill from random triangles.
#[test]
fn varyings_of_the_exact_tier() {
    let corners = [
        [1_048_576, -1_048_576, 524_288, 1_048_576],
        [55_219, 1_048_542, 524_288, 1_048_576],
        [-150, -256, 128, 256],
    ];
    is_near::<Exact>(corners, [-1_072_885_686, 68_208, 1_581_559]);
}

#[test]
fn varyings_of_a_quick_tier() {
    let corners = [
        [1_043_599, -1_043_598, 521_800, 1_043_600],
        [-256, -256, 128, 256],
        [-89_679, 1_045_064, 524_288, 1_048_576],
    ];
    is_near::<Quick<8>>(corners, [1_074_491_015, 65_658, 14_199_495]);
}
