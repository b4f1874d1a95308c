//! Why a scene has no plan: a text a bound, that says which number to change.

/// No plan serves a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum PlanError {
    /// A side of the viewport.
    Viewport,
    /// `near` and `far`.
    Range,
    /// What the transform makes of the model.
    Clip,
    /// `deep` or `tilt`.
    Triangle,
    /// The texture's side.
    Texture,
    /// Texture coordinates.
    Coordinate,
    /// The position's error.
    Pixels,
    /// The texture coordinates' error.
    Texels,
    /// The colours' error.
    Colors,
    /// The depth's error.
    Depth,
}

impl PlanError {
    /// What to change.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Viewport => "`width` and `height` are 1 to 512 pixels",
            Self::Range => "`near` and `far` are 2^-16 to 32767, `near` not above `far`",
            Self::Clip => {
                "clip coordinates overflow: lower `far`, `extent` or `stretch`, so that far + 2 stretch extent is below 32768"
            }
            Self::Triangle => "`deep` and `tilt` are 0 or more",
            Self::Texture => "`texture` is a side of at most 4096 texels",
            Self::Coordinate => {
                "`coordinate` is at most 127, and `repeats` at most twice that: shift texture coordinates by whole numbers, or cut the triangle"
            }
            Self::Pixels => {
                "no snap and transform is within `pixels`: raise it or `near`, or lower `extent` or the viewport"
            }
            Self::Texels => {
                "no correction is within `texels`: raise it, or lower `repeats`, `texture`, `deep` or `tilt`"
            }
            Self::Colors => {
                "no correction is within `color_steps`, of which rounding takes 1/2: raise it, or lower `deep` or `tilt`"
            }
            Self::Depth => "no depth is within `depth_steps`: raise it",
        }
    }
}

impl core::fmt::Display for PlanError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.text())
    }
}

impl core::error::Error for PlanError {}
