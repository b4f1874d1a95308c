//! How far attributes and depth are from the `f64` reference, in every tier.
//!
//! The reference is the plane through the *snapped* vertices: what a snap moves is coverage's
//! business, and bounded there by half a grid unit. In the exact tier the scenes are on the grid,
//! so that it is the plane through the true vertices.

mod scene;
mod tolerance;

pub use scene::{Family, Scene};
pub use tolerance::{CorrectionName, Quantity, TOLERANCES, Tolerance};

use hither::{
    Always, Correction, DepthBuffer, DepthWord, Frame, Hither, I16F16, Outcome, Snapped, Tier,
    Vertex,
};

use crate::oracle::{PerspectiveFunction, ScreenFunction, Space, Surface, whole};
use crate::record::{Probe, Record, clip_vertex};
use crate::snapped;

/// Errors of one quantity over many pixels.
#[derive(Clone, Debug, Default)]
pub struct Errors {
    /// The largest.
    pub max: f64,
    /// Where the largest was, to repeat it.
    pub worst: Option<(Scene, u32, u32)>,
    sum_of_squares: f64,
    /// How many pixels were measured.
    pub count: u64,
}

impl Errors {
    /// The root of the mean square.
    #[must_use]
    pub fn rms(&self) -> f64 {
        (self.sum_of_squares / self.count.max(1) as f64).sqrt()
    }

    fn add(&mut self, error: f64, scene: &Scene, (x, y): (u32, u32)) {
        self.count += 1;
        self.sum_of_squares += error * error;
        if error > self.max || error.is_nan() {
            self.max = error;
            self.worst = Some((scene.clone(), x, y));
        }
    }
}

/// The reference that a correction is held against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// The perspective-correct attribute.
    Perspective,
    /// The attribute that is linear on the screen, in front of the hither plane.
    Affine,
}

/// The varying that all pixels must show exactly.
const CONSTANT: I16F16 = I16F16::from_bits(-0x1234_5678);

/// Draws a scene and adds its errors.
///
/// # Panics
///
/// Where a constant attribute is not exact.
pub fn measure<T: Tier, I: Correction, W: DepthWord + Into<u64>>(
    scene: &Scene,
    reference: Reference,
    quantity: Quantity,
    into: &mut Errors,
) {
    let Scene { viewport, corners, attribute, hither, .. } = scene;
    let (width, height) = (viewport.width, viewport.height);
    let mut words = vec![W::FAR; (width * height) as usize];
    let depth = DepthBuffer::try_new(&mut words, width, height).expect("a word a pixel");
    let plane = Hither::new(I16F16::from_bits(*hither as i32)).expect("above 0");
    let mut frame = Frame::new(Record::new(width, height))
        .expect("sides of 1 to 512")
        .with_tier(T::default())
        .with_correction(I::default())
        .with_hither(plane)
        .with_depth(depth.with_compare(Always))
        .expect("the same size");
    let vertices: [Vertex<T, 2>; 3] = [0, 1, 2].map(|i| {
        let u = I16F16::from_bits(attribute[i]);
        frame.snap(&clip_vertex(corners[i]), [u, CONSTANT])
    });
    let [a, b, c] = &vertices;
    let outcome = frame.draw_snapped([a, b, c], &Probe);
    let fell_back = outcome == Outcome::DrawnByFallback;
    let snapped = vertices.map(|v| v.snapped());
    let Some(expected) =
        Expected::new(scene, snapped, reference == Reference::Affine && !fell_back)
    else {
        return;
    };
    let (record, stored) = frame.into_parts();
    let far: u64 = W::FAR.into();
    let far = far as f64;
    for &(x, y, [value, constant]) in &record.pixels {
        assert_eq!(constant, CONSTANT, "{scene:?} pixel {x} {y}");
        if quantity != Quantity::Attribute {
            let exact = (expected.depth.at(x, y) * far).clamp(0.0, far);
            let got: u64 = stored.words()[(y * width + x) as usize].into();
            into.add((got as f64 - exact).abs() * 65535.0 / far, scene, (x, y));
        } else if expected.q.at(x, y) * *hither as f64 >= 1.0 / 4096.0 {
            let error = f64::from(value.to_bits()) - expected.attribute(x, y);
            into.add(error.abs() / expected.range, scene, (x, y));
        }
    }
}

/// The reference over a scene's triangle.
struct Expected {
    perspective: PerspectiveFunction,
    /// There where it is the one that counts.
    affine: Option<ScreenFunction>,
    q: ScreenFunction,
    depth: ScreenFunction,
    /// Of the attribute, in its raw units.
    range: f64,
}

impl Expected {
    /// `None` where the snapped triangle has no area.
    fn new(scene: &Scene, snapped: [Snapped; 3], is_affine: bool) -> Option<Self> {
        let Scene { viewport, corners, attribute, .. } = scene;
        let points = snapped.map(|s| whole(snapped::in_pixels(s, *viewport)));
        let scales = [0, 1, 2].map(|i| snapped::scale(snapped[i], corners[i][3]));
        let surface = Surface::from_rationals(&points, &scales, Space::Pixel, *viewport)?;
        let u = whole(attribute.map(i64::from));
        let w = [0, 1, 2].map(|i| &points[i][2] / &scales[i]);
        let [least, most] = [attribute.iter().min(), attribute.iter().max()]
            .map(|value| value.copied().map_or(f64::NAN, f64::from));
        Some(Self {
            perspective: surface.attribute(&u),
            affine: is_affine.then(|| surface.affine(&u, &w)),
            q: surface.reciprocal_w(),
            depth: surface.depth(&whole(corners.map(|c| c[2]))),
            range: most - least,
        })
    }

    /// The attribute at a pixel, in its raw units.
    fn attribute(&self, x: u32, y: u32) -> f64 {
        match &self.affine {
            Some(affine) => affine.at(x, y),
            None => self.perspective.at(x, y),
        }
    }
}
