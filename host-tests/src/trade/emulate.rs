//! What the points cost: the scenes drawn by firmware on an emulated machine, and compared with what the host drew.

use super::survey::Sketch;
use super::{Cost, Point};
use crate::cross::{Machine, build, emulate};
use crate::measure::firmware::{fault, instructions, lines, words};
use hither_scenes::trade::Scene;

/// The firmwares, each for some of the points, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Firmware {
    program: &'static str,
    /// Points it draws.
    pub points: usize,
}

impl Firmware {
    /// The program of this name, which draws so many points.
    #[must_use]
    pub const fn new(program: &'static str, points: usize) -> Self {
        Self { program, points }
    }
}

/// What a machine counted of one picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Count {
    point: usize,
    scene: Scene,
    with_texture: bool,
    instructions: u64,
    sum: u32,
}

/// Builds a firmware for a machine and runs it: every scene at each of its points.
///
/// # Errors
///
/// What the compiler or the emulator says, or what is wrong with the firmware's words.
pub fn count(machine: &Machine, firmware: Firmware) -> Result<Vec<Count>, String> {
    let program = build("emulator", firmware.program, machine.target, &[])?;
    let counts = parse(machine, &emulate(machine, &program)?)?;
    let expected = firmware.points * (Scene::ALL.len() + 1);
    if counts.len() == expected {
        Ok(counts)
    } else {
        let (isa, drawn) = (machine.isa, counts.len());
        Err(format!("{isa}: {drawn} of {expected} pictures were drawn by {}", firmware.program))
    }
}

/// The counts that a firmware printed.
fn parse(machine: &Machine, printed: &str) -> Result<Vec<Count>, String> {
    let count = |line: &str| {
        let [point, scene, with, ticks, sum] = words(line)?;
        Some(Count {
            point: point.parse().ok()?,
            scene: Scene::ALL.into_iter().find(|known| known.name() == scene)?,
            with_texture: match with {
                "texture" => true,
                "colors" => false,
                _ => return None,
            },
            instructions: instructions(machine, ticks.parse().ok()?),
            sum: u32::from_str_radix(sum, 16).ok()?,
        })
    };
    lines(machine, printed)?
        .into_iter()
        .map(|line| count(line).ok_or_else(|| fault(machine, line)))
        .collect()
}

/// What large triangles and small ones have, so that costs can be divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Units {
    /// Pixels of the card.
    pub card_pixels: usize,
    /// Triangles of the torus.
    pub torus_triangles: usize,
}

/// Gives a point its cost on a machine, from the counts of its firmware, of which it is the `number`th.
///
/// # Errors
///
/// A picture that is not the host's.
pub fn cost(
    isa: &'static str,
    (point, sketches): &mut (Point, Vec<Sketch>),
    counts: &[Count],
    number: usize,
    units: Units,
) -> Result<(), String> {
    let mine: Vec<&Count> = counts.iter().filter(|count| count.point == number).collect();
    let of = |scene: Scene, with_texture: bool| {
        let found = mine.iter().find(|c| c.scene == scene && c.with_texture == with_texture);
        found.ok_or_else(|| format!("{isa} did not draw {} at {}", scene.name(), point.name))
    };
    let mut scenes = 0;
    for &Sketch { scene, with_texture, sum } in sketches.iter() {
        let Ok(count) = of(scene, with_texture) else {
            continue;
        };
        if count.sum != sum {
            return Err(format!(
                "{isa} drew {} at {} as {:08x}, the host as {sum:08x}",
                scene.name(),
                point.name,
                count.sum
            ));
        }
        if with_texture == scene.is_textured() {
            scenes += count.instructions;
        }
    }
    let per = |count: &Count, units: usize| count.instructions as f64 / units as f64;
    point.costs.push(Cost {
        isa,
        textured_pixel: per(of(Scene::Card, true)?, units.card_pixels),
        shaded_pixel: per(of(Scene::Card, false)?, units.card_pixels),
        triangle: per(of(Scene::Torus, false)?, units.torus_triangles),
        scenes,
        flash: None,
    });
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cross::MACHINES;
    use crate::trade::Errors;

    const SPINS: &str = "spin 1000 6405\nspin 101000 646405\n";

    fn point() -> Point {
        Point {
            name: "a point".to_owned(),
            knobs: Vec::new(),
            preset: None,
            costs: Vec::new(),
            errors: Errors::default(),
            pictures: Vec::new(),
        }
    }

    #[test]
    fn costs_are_by_pixel_and_by_triangle() {
        let printed = format!(
            "{SPINS}3 card texture 320 00000001\n3 card colors 640 00000002\n3 torus colors 960 3\n"
        );
        let counts = parse(&MACHINES[2], &printed).unwrap();
        let sketch = |scene, with_texture, sum| Sketch { scene, with_texture, sum };
        let sketches = vec![sketch(Scene::Card, true, 1), sketch(Scene::Torus, false, 3)];
        let units = Units { card_pixels: 50, torus_triangles: 100 };
        let mut surveyed = (point(), sketches);
        cost("m4f", &mut surveyed, &counts, 3, units).unwrap();
        let cost_of = surveyed.0.costs[0];
        assert_eq!(
            (cost_of.textured_pixel, cost_of.shaded_pixel, cost_of.triangle),
            (2.0, 4.0, 3.0)
        );
        assert_eq!(cost_of.scenes, 100 + 300);
        surveyed.1[0].sum = 7;
        let error = cost("m4f", &mut surveyed, &counts, 3, units).unwrap_err();
        assert!(error.contains("card at a point as 00000001, the host as 00000007"), "{error}");
    }

    #[test]
    fn garbled_lines_are_errors() {
        for line in ["0 card paint 1 1", "0 cards texture 1 1", "0 card texture 1", "panicked"] {
            let error = parse(&MACHINES[2], &format!("{SPINS}{line}\n")).unwrap_err();
            assert!(error.contains(line), "{error}");
        }
    }
}
