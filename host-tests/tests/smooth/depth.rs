//! Depth where edges are smooth.

use super::{Shares, alphas, fixed};
use hither::{
    Alpha, ClipVertex, DepthBuffer, DepthWord, Edges, Exact, Frame, Hither, I16F16, Quick, Tier,
    Translucent,
};
use host_tests::oracle::Rng;
use host_tests::record::{Mark, Record};

const SIDE: u32 = 40;

/// Three vertices in front of the hither plane at 1, with depths within this.
fn vertices(rng: &mut Rng, [near, far]: [f64; 2]) -> [ClipVertex; 3] {
    let mut number =
        |low: f64, high: f64| low + (high - low) * rng.below(1 << 20) as f64 / f64::from(1 << 20);
    [(); 3].map(|()| {
        let w = number(1.0, 9.0);
        let [x, y] = [(); 2].map(|()| w * number(-1.2, 1.2));
        ClipVertex::new(fixed(x), fixed(y), fixed(w * number(near, far)), fixed(w))
    })
}

/// Depths stored where centres are covered, as hard edges store them; nothing shown behind something.
fn tested<T: Tier, W: DepthWord>(close: impl Fn(W, W) -> bool) {
    let mut rng = Rng::new(31);
    let mut drawn = 0;
    for number in 0..300 {
        let corners = vertices(&mut rng, [0.3, 0.6]);
        let edges = Edges::ALL.without(number % 4);
        let pixels = (SIDE * SIDE) as usize;
        let (mut smooth_words, mut hard_words) = (vec![W::FAR; pixels], vec![W::FAR; pixels]);
        let hither = Hither::new(I16F16::ONE).unwrap();
        let shares = {
            let depth = DepthBuffer::try_new(&mut smooth_words, SIDE, SIDE).unwrap();
            let frame = Frame::new(Shares::new(SIDE, SIDE)).unwrap().with_tier(T::default());
            let mut frame = frame.with_hither(hither).with_depth(depth).unwrap();
            let vertices = corners.map(|corner| frame.snap(&corner, []));
            let _ = frame.draw_smooth(vertices.each_ref(), edges, &Translucent(Mark, 255));
            alphas(frame.target(), (SIDE, SIDE)).0
        };
        {
            let depth = DepthBuffer::try_new(&mut hard_words, SIDE, SIDE).unwrap();
            let frame = Frame::new(Record::new(SIDE, SIDE)).unwrap().with_tier(T::default());
            let mut frame = frame.with_hither(hither).with_depth(depth).unwrap();
            let vertices = corners.map(|corner| frame.snap(&corner, []));
            let _ = frame.draw_snapped(vertices.each_ref(), &Mark);
        }
        for (at, (got, hard)) in smooth_words.iter().zip(&hard_words).enumerate() {
            let share = shares[at];
            // A centre that is covered may have next to nothing of a sliver.
            assert!(
                *got == *hard || close(*got, *hard) || share == 0.0,
                "{corners:?}: {got:?}, not {hard:?}, of {share}"
            );
        }
        drawn += shares.iter().filter(|share| **share > 0.0).count();
        // Behind a wall nothing of it is seen, and before it all.
        for (wall, seen) in [(0.25, false), (0.65, true)] {
            let top = |bits: u32| (wall * 2f64.powi(bits as i32)) as u32;
            let wall = W::from_running(top(32));
            let mut words = vec![wall; pixels];
            let depth = DepthBuffer::try_new(&mut words, SIDE, SIDE).unwrap();
            let frame = Frame::new(Shares::new(SIDE, SIDE)).unwrap().with_tier(T::default());
            let mut frame = frame.with_hither(hither).with_depth(depth).unwrap();
            let vertices = corners.map(|corner| frame.snap(&corner, []));
            let _ = frame.draw_smooth(vertices.each_ref(), edges, &Translucent(Mark, 255));
            let (behind, _) = alphas(frame.target(), (SIDE, SIDE));
            if seen {
                assert_eq!(behind, shares, "{corners:?}");
            } else {
                assert!(behind.iter().all(|share| *share == 0.0), "{corners:?}");
            }
        }
    }
    assert!(drawn > 20_000, "{drawn} pixels");
}

#[test]
fn depths_are_stored_where_centres_are_covered() {
    tested::<Exact, u16>(|a, b| a.abs_diff(b) <= 2);
    tested::<Quick<8>, u16>(|a, b| a.abs_diff(b) <= 2);
    tested::<Quick<4>, u32>(|a, b| a.abs_diff(b) <= 1 << 12);
}

/// A share is as much of the shader's alpha.
#[test]
fn shares_are_of_the_shaders_alpha() {
    let corners = vertices(&mut Rng::new(32), [0.1, 0.2]);
    let draw = |alpha: u8| {
        let mut frame = Frame::new(Shares::new(SIDE, SIDE)).unwrap();
        let vertices = corners.map(|corner| frame.snap(&corner, []));
        let _ = frame.draw_smooth(vertices.each_ref(), Edges::ALL, &Translucent(Mark, alpha));
        frame.into_parts().0.pixels
    };
    let whole = draw(255);
    assert!(draw(0).iter().all(|(_, _, Alpha { alpha, .. })| *alpha == 0));
    for (x, y, Alpha { alpha, .. }) in draw(100) {
        let (_, _, full) = whole.iter().find(|(u, v, _)| (*u, *v) == (x, y)).unwrap();
        assert!((f64::from(alpha) - f64::from(full.alpha) * 100.0 / 255.0).abs() <= 1.0);
    }
}
