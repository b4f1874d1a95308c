//! Seeded random numbers.

/// A small random number generator: a Weyl sequence and a 64-bit mixing of it (after Steele, Lea & Flood 2014, SplitMix).
#[derive(Clone, Debug)]
pub struct Rng {
    state: u64,
}

impl Rng {
    /// The generator with this seed; equal seeds give equal numbers.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.state;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// A number from 0 to `count - 1`; `count` at least 1.
    pub fn below(&mut self, count: u64) -> u64 {
        ((u128::from(self.bits()) * u128::from(count)) >> 64) as u64
    }

    /// A number from `low` to `high`, both included.
    pub fn range(&mut self, low: i64, high: i64) -> i64 {
        low + self.below((high - low) as u64 + 1) as i64
    }

    /// A number from 1 to `high`, each power of two about equally likely.
    pub fn magnitude(&mut self, high: i64) -> i64 {
        let bits = 64 - high.leading_zeros();
        let top = 1_i64 << self.below(u64::from(bits));
        self.range(top, (2 * top - 1).min(high))
    }

    /// A number from `-high` to `high`: of any magnitude, of either sign, sometimes 0.
    pub fn signed(&mut self, high: i64) -> i64 {
        match self.below(16) {
            0 => 0,
            n if n & 1 == 0 => self.magnitude(high),
            _ => -self.magnitude(high),
        }
    }

    /// A number from 0 to 1, 1 excluded.
    pub fn fraction(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.fraction()
    }

    /// True once in `count` times.
    pub fn once_in(&mut self, count: u64) -> bool {
        self.below(count) == 0
    }

    /// One of `choices`.
    pub fn choose<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len() as u64) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stay_in_their_ranges_and_reach_both_ends() {
        let mut rng = Rng::new(1);
        let (mut ends, mut signs) = ([0; 2], [0; 3]);
        for _ in 0..5000 {
            match rng.range(-3, 3) {
                -3 => ends[0] += 1,
                3 => ends[1] += 1,
                n => assert!((-2..=2).contains(&n)),
            }
            assert!((1..=5).contains(&rng.magnitude(5)));
            assert_eq!(rng.magnitude(1), 1);
            let signed = rng.signed(1 << 20);
            assert!(signed.abs() <= 1 << 20);
            signs[(signed.signum() + 1) as usize] += 1;
            assert!((0.0..1.0).contains(&rng.fraction()));
        }
        assert!(ends.iter().chain(&signs).all(|&count| count > 200));
    }

    #[test]
    fn magnitudes_reach_the_grids_end_and_both_of_its_neighbours() {
        let mut rng = Rng::new(2);
        let all: std::collections::HashSet<_> = (0..2000).map(|_| rng.magnitude(1 << 20)).collect();
        assert!(all.contains(&1) && all.contains(&2) && all.contains(&(1 << 20)));
    }
}
