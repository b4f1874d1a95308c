//! The plot as SVG: grid, marks, labels and key.

use super::key::{WIDTH, key, presets};
use super::label::{Area, Labels};
use super::scale::Scale;
use super::{Axis, Group, groups};
use crate::trade::Point;
use crate::trade::number::{escaped, short};

/// Where marks may be.
const PLOT: Area = Area { left: 44.0, top: 40.0, right: 350.0, bottom: 244.0 };

/// Kept free for what has no place on a scale: zero on a logarithmic one, infinity.
const BAND: f64 = 22.0;

/// From the outermost mark of a band to the plot's frame.
const BAND_MIDDLE: f64 = 8.0;

/// Of letters of labels: their mean advance, and from line to line.
const LETTER: (f64, f64) = (5.4, 10.0);

/// In light and dark; the colours are of Okabe and Ito, which the colour-blind tell apart.
const STYLE: &str = include_str!("figure.css");

/// Both scales.
#[derive(Clone, Copy, Debug)]
struct Scales {
    cost: Scale,
    error: Scale,
    /// Errors of zero have a band of their own.
    zero: bool,
    /// And those without end.
    infinite: bool,
}

impl Scales {
    fn new(groups: &[Group]) -> Self {
        let costs: Vec<f64> = groups.iter().map(|group| group.cost).collect();
        let finite = |group: &Group| Some(group.error).filter(|error| error.is_finite());
        let errors: Vec<f64> = groups.iter().filter_map(finite).collect();
        let (bottom, top) = (PLOT.bottom, PLOT.top);
        let infinite = errors.len() < groups.len();
        let zero = errors.contains(&0.0) && Scale::new(&errors, bottom, top).logarithmic;
        let bottom = if zero { bottom - BAND } else { bottom };
        let top = if infinite { top + BAND } else { top };
        let cost = Scale::new(&costs, PLOT.left, PLOT.right);
        Self { cost, error: Scale::new(&errors, bottom, top), zero, infinite }
    }

    fn place(&self, group: &Group) -> (f64, f64) {
        let y = match group.error {
            error if error.is_infinite() => PLOT.top + BAND_MIDDLE,
            0.0 if self.zero => PLOT.bottom - BAND_MIDDLE,
            error => self.error.place(error),
        };
        (self.cost.place(group.cost), y)
    }
}

/// The plot of an error against its cost on an instruction set: a file of its own, 360 pixels wide unless it is scaled.
#[must_use]
pub fn svg(points: &[Point], axis: Axis, isa: &str) -> String {
    let groups = groups(points, axis, isa);
    let scales = Scales::new(&groups);
    let mut numbers = 1..;
    let named: Vec<(Option<usize>, &Group)> = groups
        .iter()
        .filter(|group| group.front || !presets(points, group).is_empty())
        .map(|group| (if group.front { numbers.next() } else { None }, group))
        .collect();
    let (key, end) = key(points, &named, axis.unit(), PLOT.bottom + 64.0);
    let parts = [
        heading(axis, isa),
        grid(axis, &scales),
        line(&groups, &scales),
        marks(points, axis, &groups, &scales),
        labels(points, &groups, &named, &scales),
        legend(PLOT.bottom + 46.0),
        key,
    ];
    let height = end + 10.0;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"pareto\" viewBox=\"0 0 {WIDTH} {height}\" \
         role=\"img\" aria-label=\"{title} error against cost on {isa}\">\n<style>{STYLE}</style>\n\
         <rect class=\"paper\" width=\"{WIDTH}\" height=\"{height}\"/>\n{body}</svg>\n",
        title = axis.title(),
        isa = escaped(isa),
        body = parts.concat(),
    )
}

/// What is plotted, and where it is better.
fn heading(axis: Axis, isa: &str) -> String {
    let better = if axis == Axis::Psnr { "better ↖" } else { "better ↙" };
    format!(
        "<text class=\"title\" x=\"10\" y=\"18\">{} on {}</text>\
         <text class=\"soft\" x=\"10\" y=\"33\">{}</text>\
         <text class=\"soft\" x=\"{right}\" y=\"33\" text-anchor=\"end\">{better}</text>\n",
        axis.title(),
        escaped(isa),
        axis.measure(),
        right = PLOT.right,
    )
}

/// Lines at round numbers, and the numbers.
fn grid(axis: Axis, scales: &Scales) -> String {
    let Area { left, top, right, bottom } = PLOT;
    let mut svg = String::new();
    for (x, text) in scales.cost.ticks() {
        svg += &format!(
            "<path class=\"grid\" d=\"M{x:.1} {top}V{bottom}\"/>\
             <text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{text}</text>\n",
            bottom + 12.0
        );
    }
    let mut ticks = scales.error.ticks();
    let mut bands = String::new();
    if scales.zero {
        ticks.push((bottom - BAND_MIDDLE, "0".to_owned()));
        bands += &format!("<path class=\"band\" d=\"M{left} {}H{right}\"/>", bottom - BAND + 3.0);
    }
    if scales.infinite {
        ticks.push((top + BAND_MIDDLE, "equal".to_owned()));
        bands += &format!("<path class=\"band\" d=\"M{left} {}H{right}\"/>", top + BAND - 3.0);
    }
    for (y, text) in ticks {
        svg += &format!(
            "<path class=\"grid\" d=\"M{left} {y:.1}H{right}\"/>\
             <text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>\n",
            left - 4.0,
            y + 3.5
        );
    }
    format!(
        "{svg}{bands}<path class=\"frame\" d=\"M{left} {top}V{bottom}H{right}\"/>\
         <text class=\"soft\" x=\"{right}\" y=\"{}\" text-anchor=\"end\">{}</text>\n",
        bottom + 26.0,
        axis.work(),
    )
}

/// Steps from point to point of the front: what lies on the far side of it is beaten.
fn line(groups: &[Group], scales: &Scales) -> String {
    let mut path = String::new();
    for (x, y) in groups.iter().filter(|group| group.front).map(|group| scales.place(group)) {
        path +=
            &if path.is_empty() { format!("M{x:.1} {y:.1}") } else { format!("H{x:.1}V{y:.1}") };
    }
    if path.is_empty() { path } else { format!("<path class=\"steps\" d=\"{path}\"/>\n") }
}

/// What a mark looks like: beaten points first, so that no other is hidden.
fn marks(points: &[Point], axis: Axis, groups: &[Group], scales: &Scales) -> String {
    let rank = |group: &&Group| (!presets(points, group).is_empty(), group.front);
    let mut sorted: Vec<&Group> = groups.iter().collect();
    sorted.sort_by_key(rank);
    let mark = |group: &Group| {
        let (x, y) = scales.place(group);
        let class = if group.front { "front" } else { "beaten" };
        let shape = if presets(points, group).is_empty() {
            let radius = if group.front { 3.6 } else { 2.6 };
            format!("<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\"/>")
        } else {
            format!(
                "<path class=\"preset {class}\" d=\"M{x:.1} {:.1}l5.5 5.5l-5.5 5.5l-5.5 -5.5z\"/>",
                y - 5.5
            )
        };
        let indices: Vec<String> = group.members.iter().map(usize::to_string).collect();
        format!(
            "<g class=\"mark\" data-points=\"{}\"><title>{}</title>{shape}\
             <circle class=\"touch\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"6\"/></g>\n",
            indices.join(" "),
            hover(points, axis, group),
        )
    };
    sorted.into_iter().map(mark).collect()
}

/// Every name at a mark, with cost and error.
fn hover(points: &[Point], axis: Axis, group: &Group) -> String {
    let name = |&index: &usize| {
        let Point { name, preset, .. } = &points[index];
        preset.map_or_else(|| name.clone(), |preset| format!("{preset}: {name}"))
    };
    let names: Vec<String> = group.members.iter().map(name).collect();
    let (cost, error) = (short(group.cost), short(group.error));
    let unit = if group.error.is_infinite() { "" } else { axis.unit() };
    escaped(&format!("{}\n{cost} {}, {error} {unit}", names.join("\n"), axis.work()))
}

/// Numbers of the front and names of presets, beside their marks.
fn labels(
    points: &[Point],
    groups: &[Group],
    named: &[(Option<usize>, &Group)],
    scales: &Scales,
) -> String {
    let taken = groups.iter().map(|group| obstacle(points, group, scales));
    let taken = taken.chain(obstacles_of_line(groups, scales)).collect();
    let within =
        Area { right: WIDTH - 2.0, bottom: PLOT.bottom - 1.0, left: PLOT.left + 2.0, ..PLOT };
    let mut labels = Labels { within, taken };
    let mut svg = String::new();
    for &(number, group) in named {
        let presets = presets(points, group).join(", ");
        let number = number.map(|number| number.to_string()).unwrap_or_default();
        let text = format!("{number} {presets}");
        let text = text.trim();
        let mark = scales.place(group);
        let size = (LETTER.0 * text.chars().count() as f64 + 4.0, LETTER.1);
        let area = labels.place(mark, size);
        let class = if presets.is_empty() { "number" } else { "named" };
        svg += &leader(mark, &area);
        svg += &format!(
            "<text class=\"{class} halo\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n",
            f64::midpoint(area.left, area.right),
            area.bottom - 1.8,
            escaped(text),
        );
    }
    svg
}

/// What a mark covers, and how bad it is to hide it.
fn obstacle(points: &[Point], group: &Group, scales: &Scales) -> (Area, f64) {
    let small = !group.front && presets(points, group).is_empty();
    let (reach, weight) = if small { (2.6, 0.4) } else { (5.5, 2.0) };
    (Area::around(scales.place(group), reach), weight)
}

/// The same of the steps between the front's marks.
fn obstacles_of_line(groups: &[Group], scales: &Scales) -> Vec<(Area, f64)> {
    let places: Vec<(f64, f64)> =
        groups.iter().filter(|group| group.front).map(|group| scales.place(group)).collect();
    let step = |pair: &[(f64, f64)]| {
        let [(x0, y0), (x1, y1)] = [pair[0], pair[1]];
        let level = Area { left: x0, top: y0 - 1.0, right: x1, bottom: y0 + 1.0 };
        let upright = Area { left: x1 - 1.0, top: y0.min(y1), right: x1 + 1.0, bottom: y0.max(y1) };
        [(level, 0.8), (upright, 0.8)]
    };
    places.windows(2).flat_map(step).collect()
}

/// A line from a mark to its label, where that is far away.
fn leader((x, y): (f64, f64), area: &Area) -> String {
    let (near_x, near_y) = (x.clamp(area.left, area.right), y.clamp(area.top, area.bottom));
    if (near_x - x).hypot(near_y - y) < 9.0 {
        return String::new();
    }
    format!("<path class=\"leader\" d=\"M{x:.1} {y:.1}L{near_x:.1} {near_y:.1}\"/>")
}

/// What the marks mean.
fn legend(y: f64) -> String {
    let middle = y - 3.2;
    format!(
        "<circle class=\"front\" cx=\"15\" cy=\"{middle}\" r=\"3.6\"/>\
         <text x=\"23\" y=\"{y}\">unbeaten</text>\
         <path class=\"preset front\" d=\"M82 {}l5.5 5.5l-5.5 5.5l-5.5 -5.5z\"/>\
         <text x=\"91\" y=\"{y}\">preset</text>\
         <circle class=\"beaten\" cx=\"136\" cy=\"{middle}\" r=\"2.6\"/>\
         <text x=\"143\" y=\"{y}\">grey: another is no dearer and no worse</text>\n",
        middle - 5.5
    )
}

#[cfg(test)]
mod tests {
    use super::super::super::made;
    use super::{Axis, svg};

    #[test]
    fn every_plot_is_well_formed_and_names_every_point() {
        let points = made::points(40);
        for (axis, isa) in Axis::ALL.into_iter().zip(["m4f", "m0"].into_iter().cycle()) {
            let text = svg(&points, axis, isa);
            let document = roxmltree::Document::parse(&text).expect("SVG is well-formed");
            let titles: Vec<&str> = document
                .descendants()
                .filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "title")))
                .filter_map(|node| node.text())
                .collect();
            for point in points.iter().filter(|point| axis.error(&point.errors).is_some()) {
                let name = |title: &&str| title.lines().any(|line| line.ends_with(&point.name));
                assert!(titles.iter().any(name), "{axis:?} lacks {}", point.name);
            }
            assert!(!text.contains("NaN") && !text.contains("inf\""), "{axis:?}");
        }
    }

    #[test]
    fn points_of_the_front_are_in_the_key() {
        let points = [(1.0, 9.0), (2.0, 4.0)].map(|(cost, error)| made::at(cost, error));
        let text = svg(&points, Axis::Texel, "m4f");
        for point in &points {
            assert!(text.contains(&format!("\">{}</text>", point.name)), "{text}");
        }
    }

    #[test]
    fn nothing_is_plotted_where_nothing_is() {
        for axis in Axis::ALL {
            assert!(roxmltree::Document::parse(&svg(&[], axis, "<m0>")).is_ok());
        }
    }
}
