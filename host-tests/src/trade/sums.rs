//! Errors as they are added up.

use super::{Errors, Stat};

/// One kind of error.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sum {
    max: f64,
    squares: f64,
    count: u64,
}

impl Sum {
    pub(super) fn add(&mut self, error: f64) {
        self.max = self.max.max(error);
        self.squares += error * error;
        self.count += 1;
    }

    /// Adds what another has.
    pub(super) fn join(&mut self, other: &Self) {
        self.max = self.max.max(other.max);
        self.squares += other.squares;
        self.count += other.count;
    }

    fn stat(&self) -> Stat {
        Stat { max: self.max, rms: (self.squares / self.count.max(1) as f64).sqrt() }
    }
}

/// Of 8-bit channels, in dB; infinite where nothing is off.
pub(super) fn psnr(sum: &Sum) -> f64 {
    20.0 * (255.0 / sum.stat().rms).log10()
}

/// All errors of a point.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    pub(super) position: Sum,
    pub(super) depth: Sum,
    pub(super) texel: Sum,
    pub(super) color: Sum,
    pub(super) banding: Sum,
    pub(super) pictures: Sum,
    /// Pixels that exact triangles cover.
    pub(super) covered: u64,
    /// Pixels that only one of both covers.
    pub(super) differing: u64,
    pub(super) gaps: u64,
    pub(super) doubles: u64,
}

impl Sums {
    pub(super) fn errors(&self) -> Errors {
        Errors {
            coverage_ppm: self.differing as f64 / self.covered.max(1) as f64 * 1e6,
            gaps: self.gaps,
            doubles: self.doubles,
            position: self.position.stat(),
            depth: (self.depth.count > 0).then(|| self.depth.stat()),
            texel: self.texel.stat(),
            color: self.color.stat(),
            banding: self.banding.stat().rms,
            psnr: psnr(&self.pictures),
        }
    }
}
