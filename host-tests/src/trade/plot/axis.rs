//! The errors that are plotted, each with the cost that belongs to it.

use crate::trade::{Cost, Errors, Point};

/// An error, and the cost it is traded against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Decisions of coverage.
    Coverage,
    /// Of vertices.
    Position,
    /// Of the depth buffer.
    Depth,
    /// Of texture coordinates.
    Texel,
    /// Of a colour a vertex.
    Color,
    /// Of the means of 4 x 4 pixels.
    Banding,
    /// Of whole pictures; higher is better.
    Psnr,
}

impl Axis {
    /// In the order of the page.
    pub const ALL: [Self; 7] = [
        Self::Psnr,
        Self::Texel,
        Self::Color,
        Self::Banding,
        Self::Depth,
        Self::Coverage,
        Self::Position,
    ];

    /// One word, as files and marks of the page are named.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Coverage => "coverage",
            Self::Position => "position",
            Self::Depth => "depth",
            Self::Texel => "texel",
            Self::Color => "color",
            Self::Banding => "banding",
            Self::Psnr => "psnr",
        }
    }

    /// As a reader sees it.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Coverage => "Coverage",
            Self::Position => "Position",
            Self::Depth => "Depth",
            Self::Texel => "Texture",
            Self::Color => "Colour",
            Self::Banding => "Banding",
            Self::Psnr => "Picture",
        }
    }

    /// What the error is, with its unit.
    #[must_use]
    pub const fn measure(self) -> &'static str {
        match self {
            Self::Coverage => "wrong decisions, in a million",
            Self::Position => "RMS error, pixels",
            Self::Depth => "RMS error, steps of 16 bits",
            Self::Texel => "RMS error, texels",
            Self::Color => "RMS error, steps of RGB565",
            Self::Banding => "RMS error of 4 x 4 means, steps of RGB565",
            Self::Psnr => "PSNR, dB (more is better)",
        }
    }

    /// Behind a number.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Coverage => "ppm",
            Self::Position => "px",
            Self::Depth | Self::Color | Self::Banding => "steps",
            Self::Texel => "texels",
            Self::Psnr => "dB",
        }
    }

    /// What the cost is.
    #[must_use]
    pub const fn work(self) -> &'static str {
        match self {
            Self::Coverage | Self::Position => "instructions a triangle",
            Self::Depth | Self::Texel => "instructions a textured pixel",
            Self::Color | Self::Banding => "instructions a shaded pixel",
            Self::Psnr => "instructions of all scenes",
        }
    }

    /// In instructions.
    #[must_use]
    pub const fn cost(self, cost: &Cost) -> f64 {
        match self {
            Self::Coverage | Self::Position => cost.triangle,
            Self::Depth | Self::Texel => cost.textured_pixel,
            Self::Color | Self::Banding => cost.shaded_pixel,
            Self::Psnr => cost.scenes as f64,
        }
    }

    /// In [`unit`](Self::unit); none where a point has no such error.
    #[must_use]
    pub fn error(self, errors: &Errors) -> Option<f64> {
        match self {
            Self::Coverage => Some(errors.coverage_ppm),
            Self::Position => Some(errors.position.rms),
            Self::Depth => errors.depth.map(|depth| depth.rms),
            Self::Texel => Some(errors.texel.rms),
            Self::Color => Some(errors.color.rms),
            Self::Banding => Some(errors.banding),
            Self::Psnr => Some(errors.psnr),
        }
    }

    /// Cost and error of a point that has both.
    pub(super) fn place(self, point: &Point, isa: &str) -> Option<(f64, f64)> {
        let cost = self.cost(point.costs.iter().find(|cost| cost.isa == isa)?);
        let error = self.error(&point.errors)?;
        (cost.is_finite() && !error.is_nan()).then_some((cost, error))
    }

    /// Less is better.
    pub(super) const fn badness(self, error: f64) -> f64 {
        match self {
            Self::Psnr => -error,
            _ => error,
        }
    }
}
