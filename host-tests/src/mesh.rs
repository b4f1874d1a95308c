//! The command `mesh`: an OBJ, and a PNG where there is a texture, to a Rust module with their data for flash. What it is made
//! of is in `hither-models`.

use std::fmt::Write;
use std::fs;

use hither_models::module::{Module, grouped, means};
use hither_models::{Image, Keep, Model};

/// What is asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// The OBJ's path.
    pub model: String,
    /// The PNG's path.
    pub texture: Option<String>,
}

impl Options {
    /// From the command line.
    ///
    /// # Errors
    ///
    /// What is wrong with it, and how it is used.
    pub fn of(arguments: &[String]) -> Result<Self, String> {
        const USAGE: &str = "mesh model.obj [--texture texture.png] > model.rs";
        let wrong = |what: String| Err(format!("{what}\n{USAGE}"));
        let (mut model, mut texture) = (None, None);
        let mut arguments = arguments.iter();
        while let Some(argument) = arguments.next() {
            let (place, value) = match argument.as_str() {
                "--texture" => (&mut texture, arguments.next()),
                option if option.starts_with('-') => {
                    return wrong(format!("{option} is no option"));
                }
                _ => (&mut model, Some(argument)),
            };
            let Some(value) = value else {
                return wrong(format!("{argument} needs a file"));
            };
            if let Some(first) = place.replace(value.clone()) {
                return wrong(format!("{first} and {value}: one model, and one texture at most"));
            }
        }
        match model {
            Some(model) => Ok(Self { model, texture }),
            None => wrong("which model?".to_owned()),
        }
    }
}

/// What the command prints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Made {
    /// The module: to standard output.
    pub source: String,
    /// Counts and warnings, a line each: to standard error.
    pub report: String,
}

/// Reads the files and makes the module.
///
/// # Errors
///
/// What cannot be read or does not fit, with the file's name and for an OBJ its line.
pub fn made(options: &Options) -> Result<Made, String> {
    let read = |path: &str| fs::read(path).map_err(|error| format!("{path}: {error}"));
    let name = options.model.as_str();
    let image = match &options.texture {
        Some(path) => {
            let image =
                Image::read_png(&read(path)?).map_err(|error| format!("{path}: {error}"))?;
            Some((image, path.as_str()))
        }
        None => None,
    };
    let keep = if image.is_some() { Keep::Textured } else { Keep::Lit };
    let model = Model::read(&read(name)?, keep);
    let model = model.map_err(|error| format!("{name}: {error}"))?;
    let texture = image.as_ref().map(|(image, path)| (image, *path));
    let module = Module { model: &model, name, texture };
    Ok(Made { source: module.source(), report: report(&module) })
}

fn report(module: &Module<'_>) -> String {
    let (model, counts, bytes) = (module.model, module.model.counts(), module.bytes());
    let mut report = String::new();
    let mut line = |text: String| {
        // A string takes all that is written.
        let _ = writeln!(report, "{text}");
    };
    for warning in model.warnings() {
        line(format!("{}: {warning}", module.name));
    }
    if let Some((_, path)) = module.texture.filter(|(image, _)| image.transparent) {
        line(format!("{path}: opacity is left out"));
    }
    let number = |name: &str, number: usize| format!("{name:<12}{:>9}", grouped(number));
    line(number("faces", counts.faces));
    line(format!(
        "{}, of {} corners",
        number("vertices", model.vertices().len()),
        grouped(counts.corners)
    ));
    line(number("triangles", model.triangles().len()));
    line(format!(
        "{}, with two corners at one place of the grid",
        number("dropped", counts.dropped)
    ));
    line(format!(
        "{}, which have no area on the grid but hold edges together",
        number("thin", counts.thin)
    ));
    line(format!("{}, 0 for a closed surface", number("open edges", counts.open_edges)));
    line(format!(
        "{}, of which the texture has {}",
        number("bytes", bytes.total()),
        grouped(bytes.texels)
    ));
    line(format!(
        "rounding    {:.2e} units along each axis, at the most: positions are in units of 2^-{}",
        model.rounding(),
        model.fraction_bits()
    ));
    let means = means(model)
        .into_iter()
        .map(|(entries, mean)| format!("{mean:.2} with a cache of {}", grouped(entries)));
    line(format!("transforms  a triangle: {}", means.collect::<Vec<_>>().join(", ")));
    report
}
