//! Where a number is along an axis, and the round numbers beside it.

use crate::trade::number::tick;

/// From this ratio on, a scale is logarithmic.
const LOGARITHMIC: f64 = 6.0;

/// Of the range, at each end.
const MARGIN: f64 = 0.06;

/// From numbers to places along one axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Whether `low` and `high` are logarithms.
    pub(super) logarithmic: bool,
    low: f64,
    high: f64,
    start: f64,
    end: f64,
}

impl Scale {
    /// A scale from `start` to `end` that holds all of these finite numbers.
    pub(super) fn new(values: &[f64], start: f64, end: f64) -> Self {
        let positive = || values.iter().copied().filter(|&value| value > 0.0);
        let (least, most) = ends(positive());
        let logarithmic = positive().count() > 1 && most >= LOGARITHMIC * least;
        let (low, high) = match (logarithmic, values.is_empty()) {
            (true, _) => (least.log10(), most.log10()),
            (_, true) => (0.0, 1.0),
            _ => ends(values.iter().copied()),
        };
        let range = if high > low { high - low } else { (0.2 * high.abs()).max(1e-3) };
        // Where zero is an end, it is the axis itself.
        let below = if !logarithmic && low == 0.0 { 0.0 } else { MARGIN * range };
        Self { logarithmic, low: low - below, high: high + MARGIN * range, start, end }
    }

    /// Of a number of the range.
    pub(super) fn place(&self, value: f64) -> f64 {
        let along = if self.logarithmic { value.log10() } else { value };
        self.start + (self.end - self.start) * (along - self.low) / (self.high - self.low)
    }

    /// Round numbers, three to eight where that is possible.
    pub(super) fn ticks(&self) -> Vec<(f64, String)> {
        let values = if self.logarithmic { self.logarithmic_ticks() } else { self.linear_ticks() };
        values.into_iter().map(|value| (self.place(value), tick(value))).collect()
    }

    fn logarithmic_ticks(&self) -> Vec<f64> {
        let decades = || self.low.floor() as i32..=self.high.ceil() as i32;
        let within = |value: &f64| (self.low..=self.high).contains(&value.log10());
        let with = |digits: &[f64]| -> Vec<f64> {
            let decade = |power: i32| digits.iter().map(move |digit| digit * 10f64.powi(power));
            decades().flat_map(decade).filter(within).collect()
        };
        let ways: [&[f64]; 4] =
            [&[1.0], &[1.0, 3.0], &[1.0, 2.0, 5.0], &[1.0, 2.0, 3.0, 4.0, 6.0, 8.0]];
        let way = ways.map(with).into_iter().find(|ticks| ticks.len() > 2);
        let ticks = way.unwrap_or_else(|| with(&[1.0, 2.0, 5.0]));
        let apart = ticks.len().div_ceil(8);
        ticks.into_iter().step_by(apart).collect()
    }

    fn linear_ticks(&self) -> Vec<f64> {
        let rough = (self.high - self.low) / 5.0;
        let power = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .map(|digit| digit * power)
            .into_iter()
            .find(|&step| step >= rough)
            .unwrap_or(rough);
        let steps = (self.low / step).ceil() as i64..=(self.high / step).floor() as i64;
        steps.map(|count| count as f64 * step).collect()
    }
}

/// The least and the most.
fn ends(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| {
        (least.min(value), most.max(value))
    })
}

#[cfg(test)]
mod tests {
    use super::Scale;

    #[test]
    fn ticks_are_within_and_few() {
        for ratio in [1.0, 1.1, 2.0, 7.0, 40.0, 1e3, 1e7, 1e14] {
            for least in [1e-6, 0.031, 4.7, 1.3e6] {
                let scale = Scale::new(&[least, least * ratio], 0.0, 100.0);
                let ticks = scale.ticks();
                assert!((1..=9).contains(&ticks.len()), "{least} x {ratio}: {ticks:?}");
                assert!(ticks.iter().all(|(place, _)| (-0.01..=100.01).contains(place)));
            }
        }
    }

    #[test]
    fn zero_is_an_end_of_a_linear_scale() {
        let scale = Scale::new(&[0.0, 3.0, 4.0], 0.0, 100.0);
        assert!(!scale.logarithmic);
        assert_eq!(scale.place(0.0), 0.0);
    }

    #[test]
    fn nothing_has_a_scale_too() {
        assert!(Scale::new(&[], 0.0, 100.0).ticks().len() > 1);
        assert!(Scale::new(&[0.0], 0.0, 100.0).place(0.0).is_finite());
    }
}
