//! The presets with their figures.

use crate::trade::Point;
use crate::trade::number::{escaped, short};
use crate::trade::plot::{Axis, pareto};

/// A card a preset.
pub(super) fn cards(points: &[Point], isas: &[&str]) -> String {
    let presets = points.iter().enumerate().filter(|(_, point)| point.preset.is_some());
    let cards: String = presets.map(|(index, point)| card(points, index, point, isas)).collect();
    format!("<div class=\"cards\">{cards}</div>\n")
}

fn card(points: &[Point], index: usize, point: &Point, isas: &[&str]) -> String {
    let name = point.preset.unwrap_or_default();
    let errors: String = Axis::ALL.into_iter().map(|axis| error(point, axis)).collect();
    let rows: String = isas.iter().map(|isa| row(points, index, isa)).collect();
    format!(
        "<article><h3>{}</h3><p class=\"knobs\"><a href=\"#p{index}\">{}</a></p>\n\
         <dl>{errors}</dl>\n\
         <table><thead><tr><th></th><th>textured pixel</th><th>shaded pixel</th><th>triangle</th>\
         <th>flash</th></tr></thead>\n<tbody>{rows}</tbody></table>\n{}</article>\n",
        escaped(name),
        escaped(&point.name),
        fronts(points, index, isas),
    )
}

fn error(point: &Point, axis: Axis) -> String {
    let value = match axis.error(&point.errors) {
        None => "none kept".to_owned(),
        Some(value) if value.is_infinite() => short(value),
        Some(value) => format!("{} {}", short(value), axis.unit()),
    };
    format!("<div><dt>{}</dt><dd>{value}</dd></div>", axis.title())
}

/// Costs on an instruction set.
fn row(points: &[Point], index: usize, isa: &str) -> String {
    let Some(cost) = points[index].costs.iter().find(|cost| cost.isa == isa) else {
        return String::new();
    };
    let flash = cost
        .flash
        .map_or_else(|| "–".to_owned(), |bytes| format!("{:.1} K", bytes as f64 / 1024.0));
    format!(
        "<tr><th>{}</th><td>{}</td><td>{}</td><td>{}</td><td>{flash}</td></tr>\n",
        escaped(isa),
        short(cost.textured_pixel),
        short(cost.shaded_pixel),
        short(cost.triangle),
    )
}

/// In which plots no other point beats it.
fn fronts(points: &[Point], index: usize, isas: &[&str]) -> String {
    let unbeaten = |isa: &str| {
        let on = |axis: &Axis| pareto(points, *axis, isa).contains(&index);
        let titles: Vec<&str> = Axis::ALL.into_iter().filter(on).map(Axis::title).collect();
        let titles = if titles.is_empty() { "nowhere".to_owned() } else { titles.join(", ") };
        format!("<li>{}: {}</li>", escaped(isa), titles.to_lowercase())
    };
    let list: String = isas.iter().map(|isa| unbeaten(isa)).collect();
    format!("<p class=\"fronts\">Unbeaten in</p><ul>{list}</ul>")
}
