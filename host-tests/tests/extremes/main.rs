//! Stability at the extremes: the smallest areas, `w` at 0, planes through vertices, the steepest gradients, the longest
//! sums, the grid's ends. Each is held against exact arithmetic or `f64`, in every tier.
//!
//! | file | what |
//! |---|---|
//! | `area` | areas down to 2^-16 of a pixel |
//! | `color` | colours stepped as one word, from end to end |
//! | `eye` | a vertex's `w` through 0, from both sides |
//! | `hither` | the hither plane through one, two and three vertices |
//! | `found` | the largest errors that a search found |
//! | `steep` | the whole range of a varying and of depth within a pixel, planes seen from their side |
//! | `steps` | sums over 131,072 pixels |
//! | `texture` | sides of 1 to 1024, coordinates to the ends of their type |
//! | `grid` | coordinates at the ends of the grid and of their type |
//! | `sweep` | an edge that moves in steps of 2^-20 |

/// Makes a module of three tests, one a tier, of a check that is generic over the tier.
macro_rules! in_every_tier {
    ($($(#[$doc:meta])* $name:ident => $check:ident;)*) => { $(
        $(#[$doc])*
        mod $name {
            use hither::{Exact, Quick};

            #[test]
            fn exact_tier() {
                super::$check::<Exact>();
            }

            #[test]
            fn quick4() {
                super::$check::<Quick<4>>();
            }

            #[test]
            fn quick8() {
                super::$check::<Quick<8>>();
            }
        }
    )* };
}

mod area;
mod color;
mod eye;
mod found;
mod grid;
mod hither;
mod steep;
mod steps;
mod sweep;
mod texture;

use ::hither::{
    Affine, ClipVertex, Correction, DepthWord, Exact, Frame, Hither, I16F16, Interpolates, NoDepth,
    Packed, Perspective, PerspectiveEvery, Quick, Tier,
};
use host_tests::accuracy::{
    CorrectionName, Errors, Family, Quantity, Reference, Scene, TOLERANCES, measure,
};
use host_tests::dump::TierName;
use host_tests::oracle::{ExactTriangle, Part, Vertex, Viewport};
use host_tests::record::{Mark, Probe, Record, clip_vertex, frame};
use host_tests::snapped;

/// The correction that steps in one word what it can.
type Packed8 = Packed<PerspectiveEvery<8>>;

/// The correction that divides at the ends of pieces.
type Pieces16 = PerspectiveEvery<16>;

/// A tier by its name in the table of tolerances.
trait Named: Tier {
    /// The name.
    const NAME: TierName;
}

impl Named for Exact {
    const NAME: TierName = TierName::Exact;
}

impl Named for Quick<4> {
    const NAME: TierName = TierName::Quick4;
}

impl Named for Quick<8> {
    const NAME: TierName = TierName::Quick8;
}

/// What was covered of a triangle, by the oracle and by the library alike.
#[derive(Clone, Debug)]
struct Covered {
    /// How often each pixel, row by row.
    counts: Vec<u8>,
    /// The snapped vertices in pixel space.
    points: [Vertex; 3],
}

impl Covered {
    /// How many pixels.
    fn pixels(&self) -> usize {
        self.counts.iter().filter(|&&count| count > 0).count()
    }

    /// The area in pixels of a triangle in front of the eye.
    fn area(&self) -> f64 {
        let [[ax, ay], [bx, by], [cx, cy]] =
            self.points.map(|[x, y, w]| [x as f64 / w as f64, y as f64 / w as f64]);
        ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)).abs() / 2.0
    }
}

/// Draws a triangle `[x, y, w]` through a frame, and compares each pixel with exact arithmetic on its snapped vertices.
fn through<T: Tier, W: Interpolates<0>>(
    mut frame: Frame<Record<()>, NoDepth, W, T, Perspective>,
    viewport: Viewport,
    corners: [Vertex; 3],
) -> Covered {
    let is_wide = corners.as_flattened().iter().any(|&v| i32::try_from(v).is_err());
    // Of more than 32 bits some are rounded twice: first to a part in 2^29.
    let most = if is_wide { 0.5 + 1.0 / 256.0 } else { 0.5 };
    let vertices = corners.map(|[x, y, w]| {
        let raw = [x, y, 0, w];
        let vertex = if is_wide { ClipVertex::from_wide(raw) } else { clip_vertex(raw) };
        frame.snap(&vertex, [])
    });
    for (vertex, corner) in vertices.iter().zip(corners) {
        let off = snapped::distance(vertex.snapped(), corner, viewport);
        assert!(off <= most, "{corner:?} is snapped {off} grid units off: {:?}", vertex.snapped());
    }
    let [a, b, c] = &vertices;
    let outcome = frame.draw_snapped([a, b, c], &Mark);
    let counts = frame.target_mut().take_counts();
    let points = vertices.map(|v| snapped::in_pixels(v.snapped(), viewport));
    let [front, behind] =
        Part::ALL.map(|part| ExactTriangle::from_pixel_space(points, viewport, part));
    for ((x, y), &count) in viewport.pixels().zip(&counts) {
        let expected = u8::from(front.covers(x, y)) + u8::from(W::BEHIND && behind.covers(x, y));
        assert_eq!(count, expected, "pixel {x} {y} of {viewport:?} {corners:?} {outcome:?}");
    }
    Covered { counts, points }
}

/// Draws the part of a triangle in front of the eye, and then both; the first of these.
fn coverage<T: Tier>(viewport: Viewport, corners: [Vertex; 3]) -> Covered {
    let tier = || frame(viewport).with_tier(T::default());
    through(tier().with_both_sides(), viewport, corners);
    through(tier(), viewport, corners)
}

/// The bound that the table of tolerances promises.
fn promised(
    tier: TierName,
    correction: CorrectionName,
    reference: Reference,
    quantity: Quantity,
    family: Family,
) -> f64 {
    let rows = TOLERANCES.iter().flatten().filter(|row| {
        (row.tier, row.correction, row.reference) == (tier, correction, reference)
            && row.quantity == quantity
            && row.families.contains(&family)
    });
    rows.map(|row| row.bound).reduce(f64::min).expect("a row of the table")
}

/// Draws a scene and asserts one row of the table of tolerances; how many pixels were looked at.
fn promise<T: Named, I: Correction, W: DepthWord + Into<u64>>(
    scene: &Scene,
    correction: CorrectionName,
    reference: Reference,
    quantity: Quantity,
) -> u64 {
    let mut errors = Errors::default();
    measure::<T, I, W>(scene, reference, quantity, &mut errors);
    let bound = promised(T::NAME, correction, reference, quantity, scene.seed.0);
    let (name, at) = (T::NAME.name(), &errors.worst);
    assert!(
        errors.max <= bound,
        "{name} {correction:?} {quantity:?}: {:e}, not {bound:e}, in {at:?}",
        errors.max
    );
    errors.count
}

/// Asserts a scene's depths in 16 bits, and in 32 unless its family is the one for which there is no promise.
fn depths_are_as_promised<T: Named>(scene: &Scene) -> u64 {
    use CorrectionName::Perspective as Each;
    use Reference::Perspective as True;
    if scene.seed.0 != Family::Steep {
        promise::<T, Perspective, u32>(scene, Each, True, Quantity::Depth32);
    }
    promise::<T, Perspective, u16>(scene, Each, True, Quantity::Depth16)
}

/// Asserts a scene's varyings, in perspective and affine.
fn varyings_are_as_promised<T: Named>(scene: &Scene) {
    use CorrectionName::{Affine as Linear, Perspective as Each};
    promise::<T, Perspective, u16>(scene, Each, Reference::Perspective, Quantity::Attribute);
    promise::<T, Affine, u16>(scene, Linear, Reference::Affine, Quantity::Attribute);
}

/// Asserts a scene's varyings and depths; how many pixels it has.
fn is_as_promised<T: Named>(scene: &Scene) -> u64 {
    varyings_are_as_promised::<T>(scene);
    depths_are_as_promised::<T>(scene)
}

/// Asserts that a scene's varying is between the vertices' values everywhere.
fn is_between<T: Tier, I: Correction>(scene: &Scene) {
    let plane = Hither::new(I16F16::from_bits(scene.hither as i32)).expect("above 0");
    let mut frame = frame(scene.viewport)
        .with_tier(T::default())
        .with_correction(I::default())
        .with_hither(plane);
    let vertices =
        [0, 1, 2].map(|i| (clip_vertex(scene.corners[i]), [I16F16::from_bits(scene.attribute[i])]));
    let _ = frame.draw_triangle(vertices, &Probe);
    let bits = scene.attribute;
    let (least, most) = (bits.iter().min(), bits.iter().max());
    for (x, y, [value]) in frame.target_mut().pixels.drain(..) {
        let value = value.to_bits();
        assert!(
            Some(&value) >= least && Some(&value) <= most,
            "{value} at {x} {y} of {scene:?} with {:?}",
            I::default()
        );
    }
}

/// The same with every correction that has pieces.
fn pieces_are_between<T: Tier>(scene: &Scene) {
    is_between::<T, Pieces16>(scene);
    is_between::<T, Packed8>(scene);
}
