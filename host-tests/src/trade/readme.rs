//! The presets' table in the README, and whether each preset is worth its name.

use super::plot::{Axis, pareto};
use super::{Cost, Point};
use crate::measure::readme::{Block, heading, made_by, row};

/// The table: a row a preset.
#[must_use]
pub fn block(points: &[Point], isas: &[&str], toolchain: &str) -> Block {
    let mut text = String::new();
    let costs = isas.iter().flat_map(|isa| {
        ["textured pixel", "shaded pixel", "triangle"].map(|what| format!("{isa}, {what}"))
    });
    let errors = ["position, px", "texture, texels", "colour, steps", "pictures, dB"];
    let names = ["preset".to_owned(), "is".to_owned()].into_iter().chain(costs);
    heading(&mut text, names.chain(errors.map(str::to_owned)).collect());
    for point in points {
        let Some(preset) = point.preset else { continue };
        let cost = |isa: &&str| {
            let found = point.costs.iter().find(|cost| cost.isa == *isa);
            found.map_or(["-", "-", "-"].map(str::to_owned), cells)
        };
        let errors = &point.errors;
        let numbers = [
            format!("{:.4}", errors.position.rms),
            format!("{:.4}", errors.texel.rms),
            format!("{:.2}", errors.color.rms),
            format!("{:.1}", errors.psnr),
        ];
        let start = [format!("`{preset}`"), point.name.clone()];
        row(&mut text, start.into_iter().chain(isas.iter().flat_map(cost)).chain(numbers));
    }
    Block { name: "presets", text: text + &made_by(toolchain) }
}

fn cells(cost: &Cost) -> [String; 3] {
    [
        format!("{:.1}", cost.textured_pixel),
        format!("{:.1}", cost.shaded_pixel),
        format!("{:.0}", cost.triangle),
    ]
}

/// Whether every preset is a point that no other beats, in some error, on each instruction set; and draws without gaps.
///
/// # Errors
///
/// The first preset that is beaten everywhere, and where; or the first point that has gaps or double pixels.
pub fn check(points: &[Point], isas: &[&str]) -> Result<(), String> {
    for (index, point) in points.iter().enumerate() {
        let (gaps, doubles) = (point.errors.gaps, point.errors.doubles);
        if gaps + doubles > 0 {
            return Err(format!("{}: {gaps} gaps, {doubles} double pixels", point.name));
        }
        let Some(preset) = point.preset else { continue };
        for isa in isas {
            if !Axis::ALL.into_iter().any(|axis| pareto(points, axis, isa).contains(&index)) {
                return Err(format!("{preset} is beaten in every error on {isa}"));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::made;
    use super::*;

    fn preset(cost: f64, error: f64) -> Point {
        Point { preset: Some("Some"), ..made::at(cost, error) }
    }

    #[test]
    fn a_preset_that_is_beaten_everywhere_is_an_error() {
        let mut points = vec![made::at(2.0, 3.0), preset(3.0, 2.0)];
        assert_eq!(check(&points, &["m4f"]), Ok(()));
        points.push(preset(4.0, 4.0));
        for point in &mut points {
            let error = point.errors.texel.rms;
            point.errors = crate::trade::Errors { psnr: -error, ..point.errors };
        }
        let error = check(&points, &["m4f"]).unwrap_err();
        assert!(error.contains("Some is beaten") && error.contains("m4f"), "{error}");
        points[0].errors.gaps = 1;
        assert!(check(&points, &["m4f"]).unwrap_err().contains("1 gaps"));
    }

    #[test]
    fn every_preset_has_a_row() {
        let points = [made::at(2.0, 3.0), preset(3.0, 2.0)];
        let text = block(&points, &["m4f", "m0"], "rustc 1").text;
        let rows: Vec<&str> = text.lines().filter(|line| line.starts_with("| `Some`")).collect();
        assert_eq!(rows.len(), 1);
        assert!(rows[0].contains("| 3.0 |") && rows[0].contains("| - |"), "{text}");
    }
}
