//! Plots of an error against the cost that belongs to it, with the points that no other beats.
//!
//! Written by hand as SVG: plotters, charming, poloto and splot have no hover text a mark, no places for labels, and either no
//! style sheet (so no dark mode) or no logarithmic scale.

mod axis;
mod figure;
mod key;
mod label;
mod scale;

pub use axis::Axis;
pub use figure::svg;

use super::Point;

/// Where a point is on a plot.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    /// Of the point among all.
    index: usize,
    /// Instructions.
    cost: f64,
    /// In the axis' unit.
    error: f64,
}

/// Points at the same place.
#[derive(Clone, Debug, PartialEq)]
struct Group {
    /// Instructions.
    cost: f64,
    /// In the axis' unit.
    error: f64,
    /// The points' indices.
    members: Vec<usize>,
    /// No point is at least as good in both and better in one.
    front: bool,
}

/// Costs that differ by less than this part are the same: an unrelated change of the code moves them by more.
const SAME: f64 = 0.01;

/// The points that no other beats, from the cheapest to the dearest: none is at least as good in both and better in one. Points
/// of one error whose costs are within a part in 100 of the cheapest of them are at the same place, and do not beat each other.
/// Those that lack the error, or a cost on this instruction set, do not take part.
#[must_use]
pub fn pareto(points: &[Point], axis: Axis, isa: &str) -> Vec<usize> {
    let groups = groups(points, axis, isa);
    groups.into_iter().filter(|group| group.front).flat_map(|group| group.members).collect()
}

/// Points that take part, joined where they are at the same place, from the cheapest on.
fn groups(points: &[Point], axis: Axis, isa: &str) -> Vec<Group> {
    let mut places: Vec<Place> = points
        .iter()
        .enumerate()
        .filter_map(|(index, point)| {
            axis.place(point, isa).map(|(cost, error)| (index, cost, error))
        })
        .map(|(index, cost, error)| Place { index, cost, error })
        .collect();
    let badness = |place: &Place| axis.badness(place.error);
    places.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(badness(a).total_cmp(&badness(b))));

    let mut groups: Vec<Group> = Vec::new();
    let mut best = None;
    for Place { index, cost, error } in places {
        let near = |group: &&mut Group| cost <= group.cost * (1.0 + SAME);
        let mut same = groups.iter_mut().rev().take_while(near);
        if let Some(group) = same.find(|group| group.error == error) {
            group.members.push(index);
            continue;
        }
        let badness = axis.badness(error);
        let front = best.is_none_or(|best| badness < best);
        best = if front { Some(badness) } else { best };
        groups.push(Group { cost, error, members: vec![index], front });
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::super::made;
    use super::{Axis, SAME, pareto};
    use crate::trade::Point;

    /// The definition: no other is at least as good in both and better in one; of one error and nearly one cost, none is better.
    fn defined(points: &[Point], axis: Axis, isa: &str) -> Vec<usize> {
        let place = |index: usize| {
            axis.place(&points[index], isa).map(|(cost, error)| (cost, axis.badness(error)))
        };
        let beats = |a: (f64, f64), b: (f64, f64)| {
            a.0 <= b.0 && a.1 <= b.1 && a != b && (a.1 < b.1 || a.0 * (1.0 + SAME) < b.0)
        };
        let all = 0..points.len();
        let unbeaten = |&index: &usize| {
            place(index).is_some_and(|it| !all.clone().filter_map(place).any(|a| beats(a, it)))
        };
        all.clone().filter(unbeaten).collect()
    }

    #[test]
    fn the_front_is_as_defined() {
        for seed in 0..200 {
            let points = made::coarse(seed, 1 + seed as usize % 40);
            for axis in Axis::ALL {
                let mut front = pareto(&points, axis, "m4f");
                front.sort_unstable();
                assert_eq!(front, defined(&points, axis, "m4f"), "seed {seed}, {axis:?}");
            }
        }
    }

    #[test]
    fn a_known_front() {
        // Cost and error: the third is beaten by the second, the fifth is at the place of the fourth.
        let places = [(1.0, 9.0), (2.0, 4.0), (3.0, 4.0), (4.0, 0.0), (4.0, 0.0), (5.0, 0.0)];
        let points = places.map(|(cost, error)| made::at(cost, error));
        assert_eq!(pareto(&points, Axis::Texel, "m4f"), [0, 1, 3, 4]);
    }

    #[test]
    fn more_decibels_are_better_and_equal_pictures_best() {
        let mut points = [1.0, 2.0, 3.0, 4.0].map(|cost| made::at(cost, 0.0));
        for (point, psnr) in points.iter_mut().zip([30.0, 20.0, f64::INFINITY, f64::INFINITY]) {
            point.errors.psnr = psnr;
        }
        assert_eq!(pareto(&points, Axis::Psnr, "m4f"), [0, 2]);
    }

    #[test]
    fn points_without_the_error_or_the_cost_take_no_part() {
        let mut points = [1.0, 2.0].map(|cost| made::at(cost, 1.0 / cost));
        points[0].errors.depth = None;
        assert_eq!(pareto(&points, Axis::Depth, "m4f"), [1]);
        assert!(pareto(&points, Axis::Texel, "m0").is_empty());
        points[1].errors.texel.rms = f64::NAN;
        assert_eq!(pareto(&points, Axis::Texel, "m4f"), [0]);
    }
}
