//! The points as a table: one row a point and instruction set.

use super::{Cost, Errors, Point, Stat};
use crate::measure::write_rows;
use std::path::Path;

/// Columns before the knobs.
const NAMES: [&str; 3] = ["isa", "point", "preset"];

/// Columns behind the knobs. Where nothing was measured, a field is empty; a PSNR of equal pictures is `inf`.
const FIGURES: [&str; 18] = [
    "instructions_textured_pixel",
    "instructions_shaded_pixel",
    "instructions_triangle",
    "instructions_scenes",
    "flash_bytes",
    "coverage_ppm",
    "gaps",
    "doubles",
    "position_max_px",
    "position_rms_px",
    "depth_max_steps",
    "depth_rms_steps",
    "texel_max",
    "texel_rms",
    "color_max_steps",
    "color_rms_steps",
    "banding_rms_steps",
    "psnr_db",
];

/// Writes the points as CSV. Every point has the knobs of the first.
///
/// # Errors
///
/// What the file system says, with the path.
pub fn write(path: &Path, points: &[Point]) -> Result<(), String> {
    let knobs = points.first().map_or(&[][..], |point| &point.knobs);
    let knobs = knobs.iter().map(|&(knob, _)| knob);
    let heading: Vec<&str> = NAMES.into_iter().chain(knobs).chain(FIGURES).collect();
    let rows = points.iter().flat_map(|point| point.costs.iter().map(move |cost| row(point, cost)));
    write_rows(path, &heading, rows)
}

fn row(point: &Point, cost: &Cost) -> Vec<String> {
    let names = [cost.isa, &point.name, point.preset.unwrap_or_default()].map(str::to_owned);
    let knobs = point.knobs.iter().map(|&(_, setting)| setting.to_owned());
    names.into_iter().chain(knobs).chain(costs(cost)).chain(errors(&point.errors)).collect()
}

fn costs(cost: &Cost) -> [String; 5] {
    let Cost { isa: _, textured_pixel, shaded_pixel, triangle, scenes, flash } = *cost;
    [
        format!("{textured_pixel:.4}"),
        format!("{shaded_pixel:.4}"),
        format!("{triangle:.4}"),
        scenes.to_string(),
        flash.map(|bytes| bytes.to_string()).unwrap_or_default(),
    ]
}

fn errors(errors: &Errors) -> [String; 13] {
    let Errors { coverage_ppm, gaps, doubles, position, depth, texel, color, banding, psnr } =
        *errors;
    let [depth_max, depth_rms] = depth.map(stat).unwrap_or_default();
    let [[position_max, position_rms], [texel_max, texel_rms], [color_max, color_rms]] =
        [position, texel, color].map(stat);
    [
        number(coverage_ppm),
        gaps.to_string(),
        doubles.to_string(),
        position_max,
        position_rms,
        depth_max,
        depth_rms,
        texel_max,
        texel_rms,
        color_max,
        color_rms,
        number(banding),
        number(psnr),
    ]
}

fn stat(Stat { max, rms }: Stat) -> [String; 2] {
    [number(max), number(rms)]
}

/// As many digits as it takes to read the same number again.
fn number(value: f64) -> String {
    value.to_string()
}

#[cfg(test)]
mod tests {
    use super::super::made;
    use super::write;
    use std::collections::HashMap;

    #[test]
    fn what_is_written_can_be_read() {
        let points = made::points(20);
        let folder = std::env::temp_dir().join(format!("hither-trade-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder for the test");
        write(&folder.join("trade.csv"), &points).expect("the file is written");
        let mut reader = ::csv::Reader::from_path(folder.join("trade.csv")).expect("it opens");
        let rows: Vec<HashMap<String, String>> =
            reader.deserialize().collect::<Result<_, _>>().expect("it is CSV");
        assert_eq!(rows.len(), 2 * points.len());
        let pairs =
            points.iter().flat_map(|point| point.costs.iter().map(move |cost| (point, cost)));
        for (row, (point, cost)) in rows.iter().zip(pairs) {
            assert_eq!((&row["point"], row["isa"].as_str()), (&point.name, cost.isa));
            assert_eq!(row["preset"], point.preset.unwrap_or_default());
            assert!(point.knobs.iter().all(|&(knob, setting)| row[knob] == setting));
            let errors = &point.errors;
            assert_eq!((&row["gaps"][..], &row["doubles"][..]), ("0", "0"));
            assert_eq!(row["instructions_scenes"], cost.scenes.to_string());
            assert_eq!(row["texel_rms"].parse(), Ok(errors.texel.rms));
            assert_eq!(row["psnr_db"].parse(), Ok(errors.psnr));
            assert_eq!(row["depth_max_steps"].parse().ok(), errors.depth.map(|depth| depth.max));
        }
        std::fs::remove_dir_all(&folder).expect("the folder goes");
    }
}
