//! A model in a file, fitted to a display of 240 x 240, lit and with depth: a picture, or with the feature `simulator` a window
//! in which it turns.
//!
//! `model_viewer [model.obj] [--texture texture.png] [--out picture.png]`; without a model, one that comes with hither.

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use std::{env, fs};

use hither::{
    Angle, ClipVertex, Correction, Counts, DepthBuffer, Dithered, Fragment, Frame, Framebuffer,
    Gouraud, Hither, I16F16, Lit, Mat4, Mesh, ModelPosition, NormalColor, Rgb565, Sample, Texture,
    Tier, Vertex, VertexStage,
};
use hither_examples::{picture, rgb565};
use hither_models::{Image, Keep, Model, ModelVertex, SAILBOAT};

/// Pixels along each side.
const SIDE: u32 = 240;

/// Of the model's turn in a picture.
const STILL: Angle = Angle::from_degrees(I16F16::lit("-34"));

/// How far the camera looks down.
const PITCH: Angle = Angle::from_degrees(I16F16::lit("20"));

/// From the eye to the middle of the model, whose radius is 1.
const DISTANCE: I16F16 = I16F16::lit("4");

/// Focal length in half picture heights: the sphere round the model fits, which takes up to `sqrt(4^2 - 1)`.
const FOCAL: I16F16 = I16F16::lit("3.8");

/// Nearer than the sphere, and beyond it.
const NEAR: I16F16 = I16F16::lit("2.96875");
const FAR: I16F16 = I16F16::lit("5.03125");

/// Towards the lamp, which stands by the camera's left shoulder.
const TOWARDS_LIGHT: [I16F16; 3] = [I16F16::lit("-0.5"), I16F16::lit("0.75"), I16F16::lit("0.75")];
const AMBIENT: I16F16 = I16F16::lit("0.34");
const DIFFUSE: I16F16 = I16F16::lit("0.72");

const BACKGROUND: Rgb565 = Rgb565::new(10, 30, 19);

/// Bits of fraction that positions are drawn with, whatever the file's unit: the largest coordinate is then 1 to 2, where
/// fixed point is at its best.
const FRACTION_BITS: u32 = 14;

fn main() -> ExitCode {
    match view() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn view() -> Result<(), Box<dyn Error>> {
    let options = Options::of(env::args().skip(1))?;
    let viewed = Viewed::read(&options)?;
    #[cfg(feature = "simulator")]
    if options.out.is_none() {
        return window::turn(&viewed);
    }
    let mut words = vec![0; (SIDE * SIDE) as usize];
    let counts = viewed.draw(STILL, &mut words)?;
    let path = options.out.unwrap_or_else(|| picture::target_folder().join("model_viewer.png"));
    picture::write_png(&path, SIDE, SIDE, &rgb565::expand_all(&words))?;
    println!("{} of {} triangles drawn: {}", counts.drawn, counts.total(), path.display());
    Ok(())
}

/// What is asked for.
#[derive(Debug, Default)]
struct Options {
    model: Option<PathBuf>,
    texture: Option<PathBuf>,
    out: Option<PathBuf>,
}

impl Options {
    fn of(mut arguments: impl Iterator<Item = String>) -> Result<Self, String> {
        const USAGE: &str = "model_viewer [model.obj] [--texture texture.png] [--out picture.png]";
        let mut options = Self::default();
        while let Some(argument) = arguments.next() {
            let option = match argument.as_str() {
                "--texture" => &mut options.texture,
                "--out" => &mut options.out,
                other if other.starts_with('-') => {
                    return Err(format!("{other} is no option: {USAGE}"));
                }
                _ => {
                    if let Some(first) = options.model.replace(PathBuf::from(&argument)) {
                        return Err(format!(
                            "two models, {} and {argument}: {USAGE}",
                            first.display()
                        ));
                    }
                    continue;
                }
            };
            let path =
                arguments.next().ok_or_else(|| format!("{argument} needs a file: {USAGE}"))?;
            *option = Some(PathBuf::from(path));
        }
        Ok(options)
    }
}

/// A model and its texture, in memory.
struct Viewed {
    model: Model,
    positions: Vec<[i16; 3]>,
    image: Option<Image>,
}

impl Viewed {
    fn read(options: &Options) -> Result<Self, String> {
        let read =
            |path: &PathBuf| fs::read(path).map_err(|error| format!("{}: {error}", path.display()));
        let (name, bytes) = match &options.model {
            Some(path) => (path.display().to_string(), read(path)?),
            None => ("sailboat.obj".to_owned(), SAILBOAT.to_vec()),
        };
        let image = options.texture.as_ref().map(|path| {
            Image::read_png(&read(path)?).map_err(|error| format!("{}: {error}", path.display()))
        });
        let image = image.transpose()?;
        let keep = if image.is_some() { Keep::LitTextured } else { Keep::Lit };
        let model = Model::read(&bytes, keep).map_err(|error| format!("{name}: {error}"))?;
        for warning in model.warnings() {
            eprintln!("{name}: {warning}");
        }
        let positions = model.positions();
        Ok(Self { model, positions, image })
    }

    /// Draws the model, turned; words in native byte order.
    fn draw(&self, turn: Angle, words: &mut [u16]) -> Result<Counts, Box<dyn Error>> {
        let mut depths = vec![0_u16; words.len()];
        let mut frame = Frame::new(Framebuffer::<Rgb565>::try_new(words, SIDE, SIDE)?)?
            .with_hither(Hither::new(NEAR)?)
            .with_depth(DepthBuffer::try_new(&mut depths, SIDE, SIDE)?)?;
        frame.clear(BACKGROUND);
        let placed = self.placed(turn)?;
        let away = Mat4::translation([I16F16::ZERO, I16F16::ZERO, -DISTANCE]);
        let lens = Mat4::perspective(FOCAL, frame.viewport().aspect(), NEAR, FAR)?;
        let transform = lens.times(&away.times(&placed)?)?;
        let lit = Lit::new(transform, &placed, TOWARDS_LIGHT, AMBIENT, DIFFUSE)?;
        Ok(match &self.image {
            None => {
                let attributes = self.model.normal_colors();
                self.draw_mesh(&mut frame, &attributes, &lit, &Dithered(Gouraud))?
            }
            Some(image) => {
                let shader = LitTexels(image.texture());
                self.draw_mesh(&mut frame, self.model.vertices(), &LitTexture(lit), &shader)?
            }
        })
    }

    fn draw_mesh<A, D, T, I>(
        &self,
        frame: &mut Frame<Framebuffer<'_, Rgb565>, D, Hither, T, I>,
        attributes: &[A],
        stage: &impl VertexStage<A, 3>,
        shader: &impl Fragment<Rgb565, 3>,
    ) -> Result<Counts, Box<dyn Error>>
    where
        D: hither::DepthTest,
        T: Tier,
        I: Correction,
    {
        let triangles = self.model.triangles();
        let mesh = Mesh::try_new(&self.positions, FRACTION_BITS, attributes, triangles)?;
        let mut cache = vec![Vertex::EMPTY; mesh.vertex_count()];
        Ok(frame.draw(&mesh, stage, shader, &mut cache))
    }

    /// The model at the origin, of radius 1, turned and tilted.
    fn placed(&self, turn: Angle) -> Result<Mat4, Box<dyn Error>> {
        let bounds = self.model.bounds();
        // From the file's units to those drawn.
        let unit = (f64::from(self.model.fraction_bits()) - f64::from(FRACTION_BITS)).exp2();
        let middle = bounds.center.map(|v| I16F16::from_num(-f64::from(v) * unit));
        let larger = I16F16::saturating_from_num(1.0 / (f64::from(bounds.radius) * unit));
        // What a matrix holds, times the focal length; a model of a few steps of its grid stays small.
        let size = Mat4::scaling([larger.min(I16F16::lit("2048")); 3])?;
        let turned = Mat4::rotation_x(PITCH.sin_cos()).times(&Mat4::rotation_y(turn.sin_cos()))?;
        Ok(turned.times(&size)?.times(&Mat4::translation(middle))?)
    }
}

/// The vertex stage of lit textures: texture coordinates and brightness.
struct LitTexture(Lit);

impl VertexStage<ModelVertex, 3> for LitTexture {
    fn vertex(&self, position: ModelPosition, vertex: &ModelVertex) -> (ClipVertex, [I16F16; 3]) {
        let white = NormalColor { normal: vertex.normal, color: [255; 3] };
        let (clip, [brightness, ..]) = self.0.vertex(position, &white);
        let [u, v] = vertex.coordinate.map(I16F16::from_bits);
        (clip, [u, v, brightness])
    }
}

/// The shader of lit textures.
#[derive(Clone, Copy)]
struct LitTexels<'a>(Texture<'a, Rgb565>);

impl Fragment<Rgb565, 3> for LitTexels<'_> {
    fn shade(&self, sample: Sample<3>) -> Rgb565 {
        let [u, v, brightness] = sample.varyings;
        let texel = self.0.nearest(u, v).unwrap_or_default();
        // In [0, 1], so no channel grows.
        let dim = |channel: u8| {
            (brightness * i32::from(channel)).round().to_num::<i32>().clamp(0, 63) as u8
        };
        Rgb565::new(dim(texel.r()), dim(texel.g()), dim(texel.b()))
    }
}

/// A window that shows the model turning.
#[cfg(feature = "simulator")]
mod window {
    use std::error::Error;
    use std::time::Duration;

    use embedded_graphics::pixelcolor::Rgb565;
    use embedded_graphics::pixelcolor::raw::RawU16;
    use embedded_graphics::prelude::{DrawTarget, OriginDimensions, Point, Size};
    use embedded_graphics::primitives::Rectangle;
    use embedded_graphics_simulator::{
        OutputSettingsBuilder, SimulatorDisplay, SimulatorEvent, Window,
    };
    use hither::Angle;

    use super::{SIDE, STILL, Viewed};

    /// Of a turn, a frame.
    const STEP: u16 = 1 << 8;

    pub(super) fn turn(viewed: &Viewed) -> Result<(), Box<dyn Error>> {
        let mut display = SimulatorDisplay::<Rgb565>::new(Size::new(SIDE, SIDE));
        let settings = OutputSettingsBuilder::new().scale(2).build();
        let mut window = Window::new("hither", &settings);
        let mut words = vec![0; (SIDE * SIDE) as usize];
        let mut angle = STILL;
        loop {
            viewed.draw(angle, &mut words)?;
            let area = Rectangle::new(Point::zero(), display.size());
            display.fill_contiguous(
                &area,
                words.iter().map(|&word| Rgb565::from(RawU16::new(word))),
            )?;
            window.update(&display);
            if window.events().any(|event| event == SimulatorEvent::Quit) {
                return Ok(());
            }
            angle = Angle(angle.0.wrapping_add(STEP));
            std::thread::sleep(Duration::from_millis(16));
        }
    }
}
