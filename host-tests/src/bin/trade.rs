//! Measures the trade of speed against accuracy, over points of the knobs and scenes made to hurt:
//!
//! ```text
//! cargo run -p host-tests --release --bin trade [-- --isa m4f,m0] [--scene card,torus,..] [--quick]
//!     [--check | --write]
//! ```
//!
//! Prints a table, and writes `target/trade/trade.csv`, the page `target/trade/index.html` and its plots as SVG. `--quick` takes
//! fewer points. `--check` fails where a preset is beaten in every error, a mesh has gaps or double pixels, or README.md or its
//! plot says something else; `--write` writes them anew.

use hither_examples::picture::target_folder;
use hither_scenes::trade::{Knobs, Scene, Visitor, more, quick};
use host_tests::cross::{MACHINES, Machine, root, toolchain};
use host_tests::measure::command::{Documents, chosen, progress, tables};
use host_tests::measure::size::flash_of_preset;
use host_tests::trade::emulate::{Count, Firmware, Units, cost, count};
use host_tests::trade::ideal::Ideal;
use host_tests::trade::plot::{Axis, svg};
use host_tests::trade::survey::{Sketch, Survey};
use host_tests::trade::{Point, csv, page, readme};
use indicatif::ProgressBar;
use std::fs;
use std::path::Path;
use std::process::ExitCode;

/// The README's plot.
const PLOT: &str = "docs/trade.svg";

/// What is asked for.
struct Asked {
    machines: Vec<&'static Machine>,
    scenes: Vec<Scene>,
    quick: bool,
    documents: Documents,
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
    let mut asked = Asked {
        machines: by_name("m4f,m0")?,
        scenes: Scene::ALL.to_vec(),
        quick: false,
        documents: Documents::Leave,
    };
    while let Some(argument) = arguments.next() {
        let mut list = || arguments.next().ok_or(format!("{argument} needs a list"));
        match argument.as_str() {
            "--isa" => asked.machines = by_name(&list()?)?,
            "--scene" => {
                asked.scenes = chosen(&list()?, Scene::ALL.into_iter(), |scene| scene.name())?;
            }
            "--quick" => asked.quick = true,
            "--check" => asked.documents = Documents::Check,
            "--write" => asked.documents = Documents::Write,
            _ => {
                return Err(format!(
                    "{argument} is not --isa, --scene, --quick, --check or --write"
                ));
            }
        }
    }
    let isas: Vec<&str> = asked.machines.iter().map(|machine| machine.isa).collect();
    let all = asked.scenes.len() == Scene::ALL.len() && !asked.quick && isas == ["m0", "m4f"];
    if asked.documents != Documents::Leave && !all {
        return Err("--check and --write need m4f and m0, every scene and every point".to_owned());
    }
    Ok(asked)
}

/// Measures what is asked for.
fn trade(asked: &Asked) -> Result<(), String> {
    let bar = progress(steps(asked));
    bar.set_message("host: the scenes in exact numbers");
    let scenes: Vec<Ideal> = asked.scenes.iter().map(|&scene| Ideal::new(scene)).collect();
    bar.inc(1);
    let (mut points, firmwares) = survey(&scenes, asked.quick, &bar);
    let card = Ideal::new(Scene::Card);
    let units = Units {
        card_pixels: card.triangles.iter().map(|triangle| triangle.covered.len()).sum(),
        torus_triangles: Ideal::new(Scene::Torus).triangles.len(),
    };
    for machine in &asked.machines {
        bar.set_message(format!("{}: what the points cost", machine.isa));
        costs(machine, &mut points, &firmwares, units, &bar)?;
        flash(machine, &mut points, &bar)?;
    }
    let points: Vec<Point> = points.into_iter().map(|(point, _)| point).collect();
    bar.finish_and_clear();
    print(&points);
    publish(asked, &points)
}

/// Writes the files, and checks or writes the README's.
fn publish(asked: &Asked, points: &[Point]) -> Result<(), String> {
    let mut isas: Vec<&str> = asked.machines.iter().map(|machine| machine.isa).collect();
    // What most readers have is first.
    isas.sort_by_key(|isa| *isa != "m4f");
    let Some(first) = asked.machines.first() else {
        return Err("no instruction set is asked for".to_owned());
    };
    let toolchain = toolchain(first.target)?;
    let folder = target_folder().join("trade");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    csv::write(&folder.join("trade.csv"), points)?;
    for isa in &isas {
        for axis in Axis::ALL {
            let name = format!("{isa}-{}.svg", axis.name());
            write(&folder.join(name), &svg(points, axis, isa))?;
        }
    }
    write(&folder.join("index.html"), &page::html(points, &isas, &toolchain))?;
    println!("\nPage       {}", folder.join("index.html").display());
    println!("Table      {}", folder.join("trade.csv").display());
    if asked.documents == Documents::Check {
        readme::check(points, &isas)?;
    }
    tables("trade", asked.documents, &["README.md"], &[readme::block(points, &isas, &toolchain)])?;
    plot(asked.documents, points, &toolchain)
}

/// Checks or writes the README's plot. What another toolchain made is not compared.
fn plot(documents: Documents, points: &[Point], toolchain: &str) -> Result<(), String> {
    let (path, made) = (root().join(PLOT), svg(points, Axis::Psnr, "m4f"));
    let text = |path: &Path| {
        fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
    };
    match documents {
        Documents::Leave => Ok(()),
        Documents::Write => write(&path, &made),
        Documents::Check => {
            let is_ours = text(&root().join("README.md"))?.contains(toolchain);
            if is_ours && text(&path)? != made {
                return Err(format!("{PLOT} is not the plot (`trade -- --write` makes it anew)"));
            }
            Ok(())
        }
    }
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}

/// Counts points.
#[derive(Default)]
struct Tally {
    points: u64,
    presets: u64,
}

impl Visitor for Tally {
    fn visit<K: Knobs>(&mut self) {
        self.points += 1;
        self.presets += u64::from(K::PRESET.is_some());
    }
}

/// How many steps the bar has: the scenes, the points, and the firmwares of each machine.
fn steps(asked: &Asked) -> u64 {
    let (mut tally, mut firmwares) = (Tally::default(), 1);
    quick(&mut tally);
    if !asked.quick {
        more(&mut tally);
        firmwares += 1;
    }
    1 + tally.points + (firmwares + tally.presets) * asked.machines.len() as u64
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
    units: Units,
    bar: &ProgressBar,
) -> Result<(), String> {
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

/// Builds a firmware for each preset on a machine.
fn flash(machine: &Machine, points: &mut [Surveyed], bar: &ProgressBar) -> Result<(), String> {
    bar.set_message(format!("{}: flash of the presets", machine.isa));
    for (point, _) in points {
        let Some(preset) = point.preset else { continue };
        let bytes = flash_of_preset(machine, preset)?;
        for cost in point.costs.iter_mut().filter(|cost| cost.isa == machine.isa) {
            cost.flash = Some(bytes);
        }
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
