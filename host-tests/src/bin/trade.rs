//! Measures the trade of speed against accuracy, over points of the knobs and scenes made to hurt:
//!
//! ```text
//! cargo run -p host-tests --release --bin trade [-- --isa m4f,m0] [--scene card,torus,..] [--quick]
//! ```
//!
//! Prints a table. `--quick` takes fewer points.

use hither_scenes::trade::{Scene, more, quick};
use host_tests::cross::{MACHINES, Machine};
use host_tests::measure::command::{chosen, progress};
use host_tests::trade::Point;
use host_tests::trade::emulate::{Count, Firmware, Units, cost, count};
use host_tests::trade::ideal::Ideal;
use host_tests::trade::survey::{Sketch, Survey};
use indicatif::ProgressBar;
use std::process::ExitCode;

/// What is asked for.
struct Asked {
    machines: Vec<&'static Machine>,
    scenes: Vec<Scene>,
    quick: bool,
}

fn main() -> ExitCode {
    let result = parse(std::env::args().skip(1)).and_then(|asked| trade(&asked));
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

/// Reads the arguments.
fn parse(mut arguments: impl Iterator<Item = String>) -> Result<Asked, String> {
    let by_name = |list: &str| chosen(list, MACHINES.iter(), |machine| machine.isa);
    let mut asked =
        Asked { machines: by_name("m4f,m0")?, scenes: Scene::ALL.to_vec(), quick: false };
    while let Some(argument) = arguments.next() {
        let mut list = || arguments.next().ok_or(format!("{argument} needs a list"));
        match argument.as_str() {
            "--isa" => asked.machines = by_name(&list()?)?,
            "--scene" => {
                asked.scenes = chosen(&list()?, Scene::ALL.into_iter(), |scene| scene.name())?;
            }
            "--quick" => asked.quick = true,
            _ => return Err(format!("{argument} is not --isa, --scene or --quick")),
        }
    }
    Ok(asked)
}

/// Measures what is asked for.
fn trade(asked: &Asked) -> Result<(), String> {
    let bar = progress(64 + 4 * asked.machines.len() as u64);
    bar.set_message("host: the scenes in exact numbers");
    let scenes: Vec<Ideal> = asked.scenes.iter().map(|&scene| Ideal::new(scene)).collect();
    bar.inc(1);
    let (mut points, firmwares) = survey(&scenes, asked.quick, &bar);
    for machine in &asked.machines {
        bar.set_message(format!("{}: what the points cost", machine.isa));
        costs(machine, &mut points, &firmwares, &bar)?;
    }
    bar.finish_and_clear();
    let points: Vec<Point> = points.into_iter().map(|(point, _)| point).collect();
    print(&points);
    Ok(())
}

type Surveyed = (Point, Vec<Sketch>);

/// Draws the points on the host; and the firmwares that draw them.
fn survey(scenes: &[Ideal], is_quick: bool, bar: &ProgressBar) -> (Vec<Surveyed>, Vec<Firmware>) {
    bar.set_message("host: how far off the points are");
    let mut done = || bar.inc(1);
    let mut survey = Survey::new(scenes, &mut done);
    quick(&mut survey);
    let first = survey.points.len();
    let mut firmwares = vec![Firmware::new("trade_quick", first)];
    if !is_quick {
        more(&mut survey);
        firmwares.push(Firmware::new("trade_more", survey.points.len() - first));
    }
    (survey.points, firmwares)
}

/// Counts what the points cost on a machine.
fn costs(
    machine: &Machine,
    points: &mut [Surveyed],
    firmwares: &[Firmware],
    bar: &ProgressBar,
) -> Result<(), String> {
    let card = Ideal::new(Scene::Card);
    let units = Units {
        card_pixels: card.triangles.iter().map(|triangle| triangle.covered.len()).sum(),
        torus_triangles: Ideal::new(Scene::Torus).triangles.len(),
    };
    let mut rest = points;
    for &firmware in firmwares {
        let counts: Vec<Count> = count(machine, firmware)?;
        let (mine, others) = rest.split_at_mut(firmware.points);
        for (number, point) in mine.iter_mut().enumerate() {
            cost(machine.isa, point, &counts, number, units)?;
        }
        rest = others;
        bar.inc(1);
    }
    Ok(())
}

/// Prints a line for each point and instruction set.
fn print(points: &[Point]) {
    println!(
        "{:44} {:6} {:>8} {:>8} {:>8} {:>7} {:>8} {:>4} {:>4} {:>8} {:>9} {:>8} {:>7} {:>7} {:>6}",
        "point",
        "isa",
        "texture",
        "colors",
        "triangle",
        "scenes",
        "coverage",
        "gaps",
        "doub",
        "position",
        "depth",
        "texel",
        "color",
        "banding",
        "PSNR"
    );
    for point in points {
        let errors = &point.errors;
        for cost in &point.costs {
            println!(
                "{:44} {:6} {:8.2} {:8.2} {:8.0} {:6.2}M {:8.0} {:4} {:4} {:8.5} {:9.3} {:8.4} {:7.3} {:7.4} {:6.2}",
                point.preset.map_or(point.name.clone(), |p| format!("{p}: {}", point.name)),
                cost.isa,
                cost.textured_pixel,
                cost.shaded_pixel,
                cost.triangle,
                cost.scenes as f64 / 1e6,
                errors.coverage_ppm,
                errors.gaps,
                errors.doubles,
                errors.position.rms,
                errors.depth.map_or(f64::NAN, |d| d.rms),
                errors.texel.rms,
                errors.color.rms,
                errors.banding,
                errors.psnr,
            );
        }
    }
}
