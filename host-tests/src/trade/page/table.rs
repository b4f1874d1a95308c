//! The table of all points on one instruction set.

use crate::trade::number::{escaped, short};
use crate::trade::{Cost, Errors, Point, Stat};

/// Columns behind the name: a group, what it holds, and with what a cell's number is told.
const GROUPS: [(&str, &[&str]); 9] = [
    ("instructions", &["textured pixel", "shaded pixel", "triangle", "all scenes"]),
    ("coverage", &["ppm", "gaps", "doubles"]),
    ("position, px", &["max", "RMS"]),
    ("depth, steps", &["max", "RMS"]),
    ("texture, texels", &["max", "RMS"]),
    ("colour, steps", &["max", "RMS"]),
    ("banding", &["steps"]),
    ("picture", &["PSNR, dB"]),
    ("flash", &["bytes"]),
];

/// A row a point that was measured on the instruction set; a name leads to the point's pictures.
pub(super) fn table(points: &[Point], isa: &str) -> String {
    let groups: String = GROUPS
        .iter()
        .map(|(group, columns)| format!("<th colspan=\"{}\">{group}</th>", columns.len()))
        .collect();
    let columns: String = GROUPS
        .iter()
        .flat_map(|(_, columns)| columns.iter())
        .map(|column| format!("<th class=\"sort\">{column}</th>"))
        .collect();
    let cost = |point: &Point| point.costs.iter().copied().find(|cost| cost.isa == isa);
    let rows: String = points
        .iter()
        .enumerate()
        .filter_map(|(index, point)| Some(row(index, point, &cost(point)?)))
        .collect();
    format!(
        "<div class=\"scroll isa isa-{isa}\" tabindex=\"0\"><table class=\"points\"><caption>All points on {isa}</caption>\n\
         <thead><tr><th></th>{groups}</tr>\n<tr><th class=\"sort\">point</th>{columns}</tr></thead>\n\
         <tbody>\n{rows}</tbody></table></div>\n",
        isa = escaped(isa),
    )
}

fn row(index: usize, point: &Point, cost: &Cost) -> String {
    let preset = point.preset.map(|preset| format!("<b>{}</b> ", escaped(preset)));
    let cells: String = numbers(&point.errors, cost).into_iter().map(cell).collect();
    format!(
        "<tr><th>{}<a href=\"#p{index}\">{}</a></th>{cells}</tr>\n",
        preset.unwrap_or_default(),
        escaped(&point.name),
    )
}

/// In the order of the columns.
fn numbers(errors: &Errors, cost: &Cost) -> Vec<Option<f64>> {
    let stat = |Stat { max, rms }: Stat| [Some(max), Some(rms)];
    let depth = errors.depth.map_or([None; 2], stat);
    [
        [cost.textured_pixel, cost.shaded_pixel, cost.triangle, cost.scenes as f64]
            .map(Some)
            .to_vec(),
        [errors.coverage_ppm, errors.gaps as f64, errors.doubles as f64].map(Some).to_vec(),
        [stat(errors.position), depth, stat(errors.texel), stat(errors.color)].concat(),
        vec![Some(errors.banding), Some(errors.psnr), cost.flash.map(|bytes| bytes as f64)],
    ]
    .concat()
}

/// A number as it is read, and as it is sorted.
fn cell(value: Option<f64>) -> String {
    match value {
        None => "<td>–</td>".to_owned(),
        Some(value) if value.is_infinite() => "<td data-v=\"Infinity\">equal</td>".to_owned(),
        Some(value) => format!("<td data-v=\"{value}\">{}</td>", short(value)),
    }
}
