//! Triangles to draw, the same ones on every target.

use hither::{
    ClipVertex, Correction, Counts, DepthTest, Fragment, Frame, Hither, I16F16, Target, Tier,
};
use host_tests::oracle::Rng;

/// The frames' hither plane.
pub fn hither() -> Hither {
    Hither::new(I16F16::ONE).expect("in front of the eye")
}

/// Draws triangles of all sizes, in front of the hither plane, some of them partly off the screen; varyings are in `[0, 1]`.
pub fn draw<C, D, T, I, S, const N: usize>(
    frame: &mut Frame<C, D, Hither, T, I>,
    fragment: &S,
    seed: u64,
) -> Counts
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
    S: Fragment<C::Color, N>,
{
    let mut rng = Rng::new(seed);
    let mut counts = Counts::default();
    for face in 0..24 {
        // On the screen: all of it, or a part.
        let reach = rng.choose(&[2.0, 0.3, 0.05]);
        let middle = [(); 2].map(|()| rng.between(-1.1, 1.1));
        let corners = [(); 3].map(|()| {
            let [x, y] = middle.map(|v| v + rng.between(-reach, reach));
            let (z, w) = (rng.fraction(), rng.between(1.0, 4.0));
            let [x, y, z, w] = [x * w, y * w, z * w, w].map(I16F16::from_num);
            let varyings = [(); N].map(|()| I16F16::from_num(rng.fraction()));
            (ClipVertex::new(x, y, z, w), varyings)
        });
        counts.add(frame.draw_triangle(corners, &fragment.for_face(face)));
    }
    counts
}
