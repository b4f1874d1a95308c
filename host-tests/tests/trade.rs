//! The trade's scenes and survey: against the oracle, and whether errors are where a knob puts them.

use hither::{
    Affine, Dithered, Exact, Fidelity, Gouraud, Mat4, Packed, Perspective, PerspectiveEvery, Quick,
    ShortMat4,
};
use hither_scenes::trade::{Knobs, Of, PresetPoint, Scene, Visitor};
use host_tests::oracle::{ExactTriangle, Part, Viewport};
use host_tests::trade::Point;
use host_tests::trade::ideal::Ideal;
use host_tests::trade::survey::Survey;

type Packed8 = Packed<PerspectiveEvery<8>>;

fn scenes() -> Vec<Ideal> {
    Scene::ALL.into_iter().map(Ideal::new).collect()
}

fn survey<K: Knobs>(scenes: &[Ideal]) -> Point {
    let mut done = || {};
    let mut survey = Survey::new(scenes, &mut done);
    survey.visit::<K>();
    survey.points.remove(0).0
}

/// What scenes cover is what the oracle says of the same corners.
#[test]
fn scenes_cover_what_the_oracle_says() {
    let viewport = Viewport::new(160, 120);
    let mut pixels = 0;
    // Those that no hither plane cuts.
    for scene in [Scene::Card, Scene::Specks, Scene::Torus, Scene::Steep] {
        for triangle in Ideal::new(scene).triangles {
            let oracle =
                ExactTriangle::new(triangle.corners_in_clip_space(), viewport, Part::Front);
            let mine: Vec<(u32, u32)> = triangle.covered.iter().map(|at| (at.x, at.y)).collect();
            let mut theirs = oracle.pixels();
            theirs.sort_unstable_by_key(|&(x, y)| (y, x));
            assert_eq!(mine, theirs, "{scene:?}");
            pixels += mine.len();
        }
    }
    assert!(pixels > 20_000, "{pixels} pixels");
}

/// Every error follows the knob that decides it.
#[test]
fn errors_follow_their_knobs() {
    let scenes = scenes();
    let exact = survey::<PresetPoint<Fidelity>>(&scenes);
    let eight = survey::<Of<Quick<8>, Packed8>>(&scenes);
    let four = survey::<Of<Quick<4>, Packed<Affine>>>(&scenes);
    let short = survey::<Of<Exact, Perspective, u16, ShortMat4>>(&scenes);
    let dithered = survey::<Of<Exact, Perspective, u16, Mat4, Dithered<Gouraud>>>(&scenes);
    for point in [&exact, &eight, &four, &short, &dithered] {
        assert_eq!((point.errors.gaps, point.errors.doubles), (0, 0), "{}", point.name);
        assert_eq!(point.pictures.len(), scenes.len());
        assert!(point.errors.depth.is_some());
    }
    let [e, q8, q4, s, d] = [&exact, &eight, &four, &short, &dithered].map(|point| point.errors);
    // Half a grid unit, and what the transform rounds.
    assert!(q8.position.max > 1.0 / 1024.0 && q8.position.max < 0.5 / 256.0 + 0.002, "{q8:?}");
    assert!(q4.position.max > 1.0 / 64.0 && q4.position.max < 0.5 / 16.0 + 0.002, "{q4:?}");
    assert!(4.0 * e.position.rms < q8.position.rms && 4.0 * e.position.rms < s.position.rms);
    assert!(e.coverage_ppm < q8.coverage_ppm && q8.coverage_ppm < q4.coverage_ppm);
    assert!(e.texel.rms < 0.01 && q8.texel.rms < 4.0 && q4.texel.rms > 8.0, "{e:?} {q8:?} {q4:?}");
    assert!(e.color.max < 0.52 && d.color.max > 0.9 && d.color.max < 1.0, "{e:?} {d:?}");
    assert!(d.banding < 0.5 * e.banding, "{d:?} {e:?}");
    assert!(e.psnr > q8.psnr + 10.0 && q8.psnr > q4.psnr + 10.0, "{e:?} {q8:?} {q4:?}");
}

/// Without depth none is measured, and what is hidden shows.
#[test]
fn a_point_without_depth_has_no_depth_error() {
    let scenes = [Ideal::new(Scene::Torus)];
    let with = survey::<Of<Quick<8>, Packed8>>(&scenes);
    let without = survey::<Of<Quick<8>, Packed8, hither::NoDepth>>(&scenes);
    assert_eq!(without.errors.depth, None);
    assert_eq!(without.errors.texel, with.errors.texel);
    assert!(without.name.ends_with("no-depth"), "{}", without.name);
    assert!(without.pictures[0].psnr < with.pictures[0].psnr);
}
