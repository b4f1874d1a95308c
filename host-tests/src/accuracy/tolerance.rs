//! The one table of how far each tier may be off.

use std::fmt;

use hither::{Affine, Correction, Exact, Perspective, PerspectiveEvery, Quick, Tier};

use super::{Errors, Family, Reference, Scene, measure};
use crate::dump::TierName;

/// A correction by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CorrectionName {
    /// `Perspective`.
    Perspective,
    /// `PerspectiveEvery<16>`.
    Every16,
    /// `Affine`.
    Affine,
}

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// An attribute, in parts of its range over the triangle, at pixels with `w` up to 4096 hither
    /// distances.
    Attribute,
    /// A stored 16-bit depth, in its units.
    Depth16,
    /// A stored 32-bit depth, in units of 16 bits.
    Depth32,
}

/// How far one quantity may be off in one tier.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// The tier.
    pub tier: TierName,
    /// How attributes are corrected.
    pub correction: CorrectionName,
    /// What attributes are held against.
    pub reference: Reference,
    /// What is measured, which says the unit.
    pub quantity: Quantity,
    /// On what scenes.
    pub families: &'static [Family],
    /// The largest error there may be.
    pub bound: f64,
}

const ALL: &[Family] = &Family::ALL;
const MILD: &[Family] = &[Family::Mild];
const STEEP: &[Family] = &[Family::Steep];

/// A row of [`TOLERANCES`].
const fn row(
    tier: TierName,
    correction: CorrectionName,
    reference: Reference,
    quantity: Quantity,
    families: &'static [Family],
    bound: f64,
) -> Tolerance {
    Tolerance { tier, correction, reference, quantity, families, bound }
}

/// `(sqrt 2 - 1) / (sqrt 2 + 1)`, rounded up: how far a straight line is from the perspective one,
/// in parts of the attribute's range, where `w` is in 1 : 2 at its ends.
const STRAIGHT: f64 = 0.172;

/// The rows of a tier.
///
/// The contract's numbers are those of the exact tier for attributes divided at each pixel (2^-10)
/// and for 16-bit depth (1 unit). The quick tiers are held to the same, but on the plane through
/// the snapped vertices, and but for steep depths, whose bound is a measurement with some room.
/// `PerspectiveEvery` promises no more than to stay between the vertices' values; on mild scenes,
/// where `w` is in 1 : 2, a piece is as far off as theory says of a straight line, and so is
/// affine. 32-bit depth is its running precision: within 2^10 of its own units in the exact tier; in
/// the quick tiers measured, with some room.
const fn rows(tier: TierName, steep: f64, running: f64) -> [Tolerance; 8] {
    use CorrectionName::{Affine as Linear, Every16, Perspective as Each};
    use Quantity::{Attribute, Depth16, Depth32};
    use Reference::{Affine, Perspective};
    [
        row(tier, Each, Perspective, Attribute, ALL, 1.0 / 1024.0),
        row(tier, Every16, Perspective, Attribute, MILD, STRAIGHT),
        row(tier, Every16, Perspective, Attribute, ALL, 1.0),
        row(tier, Linear, Affine, Attribute, ALL, 1.0 / 1024.0),
        row(tier, Linear, Perspective, Attribute, MILD, STRAIGHT),
        row(tier, Each, Perspective, Depth16, ALL, 1.0),
        row(tier, Each, Perspective, Depth16, STEEP, steep),
        row(tier, Each, Perspective, Depth32, ALL, running),
    ]
}

/// How far each tier may be off: the one place that says so. A bound may be lowered freely.
pub const TOLERANCES: [[Tolerance; 8]; 3] = [
    rows(TierName::Exact, 1.0, 1.0 / 64.0),
    rows(TierName::Quick4, 6.0, 0.25),
    rows(TierName::Quick8, 6.0, 0.25),
];

impl Tolerance {
    /// The errors over `scenes` scenes of each family.
    #[must_use]
    pub fn survey(&self, scenes: u64) -> Errors {
        match self.tier {
            TierName::Exact => self.in_tier::<Exact>(scenes),
            TierName::Quick4 => self.in_tier::<Quick<4>>(scenes),
            TierName::Quick8 => self.in_tier::<Quick<8>>(scenes),
        }
    }

    fn in_tier<T: Tier>(&self, scenes: u64) -> Errors {
        match self.correction {
            CorrectionName::Perspective => self.corrected::<T, Perspective>(scenes),
            CorrectionName::Every16 => self.corrected::<T, PerspectiveEvery<16>>(scenes),
            CorrectionName::Affine => self.corrected::<T, Affine>(scenes),
        }
    }

    fn corrected<T: Tier, I: Correction>(&self, scenes: u64) -> Errors {
        let mut errors = Errors::default();
        for &family in self.families {
            // A steep scene is small, and seldom worst.
            let scenes = if family == Family::Steep { 40 * scenes } else { scenes };
            for seed in 0..scenes {
                let scene = Scene::random(family, seed);
                if self.quantity == Quantity::Depth32 {
                    measure::<T, I, u32>(&scene, self.reference, self.quantity, &mut errors);
                } else {
                    measure::<T, I, u16>(&scene, self.reference, self.quantity, &mut errors);
                }
            }
        }
        errors
    }
}

impl fmt::Display for Tolerance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scenes = match self.families {
            [Family::Mild] => "mild",
            [Family::Steep] => "steep",
            _ => "all",
        };
        let correction = format!("{:?}", self.correction);
        let quantity = match self.quantity {
            Quantity::Attribute => "attribute / range",
            Quantity::Depth16 => "depth16 / unit",
            Quantity::Depth32 => "depth32 / unit of 16 bits",
        };
        let reference = format!("{:?}", self.reference);
        let tier = self.tier.name();
        write!(f, "{tier:7} {correction:12} {reference:12} {scenes:6} {quantity:26}")
    }
}
