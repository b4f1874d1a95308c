//! Places for labels beside marks: each takes the first that is free, or the one that covers least.

/// A rectangle from left, top to right, bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Area {
    /// A square about a mark.
    pub(super) fn around((x, y): (f64, f64), reach: f64) -> Self {
        Self { left: x - reach, top: y - reach, right: x + reach, bottom: y + reach }
    }

    /// What both cover, in square pixels.
    pub(super) fn shared(&self, other: &Self) -> f64 {
        let width = self.right.min(other.right) - self.left.max(other.left);
        let height = self.bottom.min(other.bottom) - self.top.max(other.top);
        width.max(0.0) * height.max(0.0)
    }

    fn size(&self) -> f64 {
        (self.right - self.left) * (self.bottom - self.top)
    }
}

/// Directions from the mark, the best first.
const DIRECTIONS: [(f64, f64); 8] = [
    (0.7, -0.7),
    (1.0, 0.0),
    (0.0, -1.0),
    (0.7, 0.7),
    (-0.7, -0.7),
    (-1.0, 0.0),
    (0.0, 1.0),
    (-0.7, 0.7),
];

/// From the mark's middle to the label's near side.
const DISTANCES: [f64; 4] = [7.0, 12.0, 20.0, 30.0];

/// What is taken already, and where labels may be.
#[derive(Clone, Debug)]
pub(super) struct Labels {
    pub(super) within: Area,
    /// With how much a covered pixel counts.
    pub(super) taken: Vec<(Area, f64)>,
}

impl Labels {
    /// Takes a place of `size` beside a mark.
    pub(super) fn place(&mut self, mark: (f64, f64), size: (f64, f64)) -> Area {
        let ways = DISTANCES.iter().flat_map(|&distance| {
            DIRECTIONS.iter().map(move |&direction| beside(mark, size, direction, distance))
        });
        let best = ways.min_by(|a, b| self.badness(a).total_cmp(&self.badness(b)));
        let area = best.unwrap_or_else(|| Area::around(mark, 0.0));
        self.taken.push((area, 1.0));
        area
    }

    /// What a label would cover; what is outside counts most.
    fn badness(&self, area: &Area) -> f64 {
        let covered: f64 =
            self.taken.iter().map(|(other, weight)| weight * area.shared(other)).sum();
        covered + 100.0 * (area.size() - area.shared(&self.within)).max(0.0).round()
    }
}

/// A label whose near side or corner is at a distance from the mark.
fn beside(
    (x, y): (f64, f64),
    (width, height): (f64, f64),
    (right, down): (f64, f64),
    distance: f64,
) -> Area {
    let start = |at: f64, towards: f64, length: f64| match towards {
        0.0 => at - length / 2.0,
        towards if towards > 0.0 => at + towards * distance,
        towards => at + towards * distance - length,
    };
    let (left, top) = (start(x, right, width), start(y, down, height));
    Area { left, top, right: left + width, bottom: top + height }
}

#[cfg(test)]
mod tests {
    use super::{Area, Labels};

    #[test]
    fn labels_of_marks_that_are_close_do_not_overlap() {
        let within = Area { left: 0.0, top: 0.0, right: 300.0, bottom: 200.0 };
        let marks: Vec<_> = (0..12).map(|i| (40.0 + 9.0 * f64::from(i), 100.0)).collect();
        let taken = marks.iter().map(|&mark| (Area::around(mark, 3.0), 1.0)).collect();
        let mut labels = Labels { within, taken };
        let areas: Vec<_> = marks.iter().map(|&mark| labels.place(mark, (12.0, 10.0))).collect();
        for (index, area) in areas.iter().enumerate() {
            assert_eq!(area.shared(&within).round(), 120.0, "{area:?} is not within");
            assert!(areas[..index].iter().all(|other| area.shared(other) == 0.0), "{area:?}");
        }
    }

    #[test]
    fn a_label_in_a_corner_stays_within() {
        let within = Area { left: 0.0, top: 0.0, right: 300.0, bottom: 200.0 };
        for mark in [(0.0, 0.0), (300.0, 0.0), (0.0, 200.0), (300.0, 200.0)] {
            let area = Labels { within, taken: Vec::new() }.place(mark, (60.0, 10.0));
            assert_eq!(area.shared(&within).round(), 600.0, "{mark:?}: {area:?}");
        }
    }
}
