//! Hill climbing.

use host_tests::oracle::Rng;

/// What is added to the seeds: 0, or `HITHER_SEED` times a thousand.
pub fn seed_of_run() -> u64 {
    std::env::var("HITHER_SEED").ok().and_then(|seed| seed.parse().ok()).unwrap_or(0) * 1000
}

/// Climbs from what `seed` gives, by what `change` changes, for so many evaluations of `value`, with a new seed where nothing
/// is gained for a while. `value` is to be made large, and is none where its argument is out of bounds.
pub fn climb<S: Clone>(
    rng: &mut Rng,
    evaluations: u32,
    mut seed: impl FnMut(&mut Rng, u32) -> S,
    mut change: impl FnMut(&mut Rng, &mut S),
    mut value: impl FnMut(&S) -> Option<f64>,
) {
    /// Evaluations in vain before a new seed.
    const PATIENCE: u32 = 120;
    let (mut restarts, mut left) = (0, evaluations);
    while left > 0 {
        let mut at = seed(rng, restarts);
        restarts += 1;
        let mut best = value(&at).unwrap_or(-1.0);
        left -= 1;
        let mut vain = 0;
        while vain < PATIENCE && left > 0 {
            left -= 1;
            let mut next = at.clone();
            change(rng, &mut next);
            match value(&next) {
                Some(gained) if gained >= best => {
                    vain = if gained > best { 0 } else { vain + 1 };
                    (best, at) = (gained, next);
                }
                _ => vain += 1,
            }
        }
    }
}
