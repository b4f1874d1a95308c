//! Scenes against golden pictures, tolerance 0, in every tier.
//!
//! `HITHER_BLESS=1 cargo test -p host-tests --test golden` writes the pictures anew, and still fails: look at them,
//! then run it again without.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use hither::{
    ClipVertex, Correction, Cull, DepthBuffer, DepthTest, Exact, FaceColors, Frame, Framebuffer,
    Gouraud, Hither, I16F16, Perspective, PerspectiveEvery, Quick, Rgb565, Rgb565Be, Target, Tier,
    Vertex,
};
use hither_examples::{picture, rgb565};
use hither_scenes::spinning_teapot::{self, Moment};
use hither_scenes::{floor, ground, torus};

/// Pixels along each side of every picture.
const SIDE: u32 = 120;

#[derive(Clone, Copy, Debug)]
enum Scene {
    /// The spinning teapot, at a frame of 64.
    Teapot(u32),
    /// The torus, a colour a face.
    TorusFlat,
    /// The torus, a colour a vertex.
    TorusGouraud,
    /// A triangle with `w` 1, 2 and 4 and a colour a vertex.
    Triangle,
    /// A textured plane below the eye, from behind the eye to far.
    Floor,
}

impl Scene {
    const ALL: [Self; 6] = [
        Self::Teapot(0),
        Self::Teapot(41),
        Self::TorusFlat,
        Self::TorusGouraud,
        Self::Triangle,
        Self::Floor,
    ];

    fn name(self) -> String {
        match self {
            Self::Teapot(number) => format!("teapot_{number}"),
            Self::TorusFlat => "torus_flat".to_owned(),
            Self::TorusGouraud => "torus_gouraud".to_owned(),
            Self::Triangle => "triangle".to_owned(),
            Self::Floor => "floor".to_owned(),
        }
    }

    fn hither(self) -> Hither {
        match self {
            Self::Teapot(_) => spinning_teapot::HITHER,
            Self::TorusFlat | Self::TorusGouraud => torus::HITHER,
            Self::Triangle => Hither::new(I16F16::ONE).unwrap(),
            Self::Floor => floor::HITHER,
        }
    }

    fn cull(self) -> Cull {
        match self {
            Self::Teapot(_) => spinning_teapot::CULL,
            Self::TorusFlat | Self::TorusGouraud => torus::CULL,
            Self::Triangle | Self::Floor => Cull::Neither,
        }
    }

    /// Draws it into a frame.
    fn draw<C, D, T, I>(self, frame: &mut Frame<C, D, Hither, T, I>)
    where
        C: Target<Color = Rgb565>,
        D: DepthTest,
        T: Tier,
        I: Correction,
    {
        frame.clear(ground::BACKGROUND);
        match self {
            Self::Teapot(number) => {
                let mut cache = [Vertex::EMPTY; spinning_teapot::VERTEX_COUNT];
                spinning_teapot::draw(frame, Moment { number, frames: 64 }, &mut cache).unwrap();
            }
            Self::TorusFlat => {
                let mut cache = [Vertex::EMPTY; torus::VERTEX_COUNT];
                let faces = FaceColors::new(&torus::FACE_COLORS).unwrap();
                frame.draw(&torus::BARE_TORUS, &torus::transform().unwrap(), &faces, &mut cache);
            }
            Self::TorusGouraud => {
                let mut cache = [Vertex::EMPTY; torus::VERTEX_COUNT];
                frame.draw(&torus::TORUS, &torus::transform().unwrap(), &Gouraud, &mut cache);
            }
            Self::Triangle => triangle(frame),
            Self::Floor => drop(floor::draw(frame).unwrap()),
        }
    }
}

fn triangle<C, D, T, I>(frame: &mut Frame<C, D, Hither, T, I>)
where
    C: Target<Color = Rgb565>,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    let number = |text: &str| text.parse::<I16F16>().unwrap();
    let corner = |x: &str, y: &str, w: i32, color: usize| {
        let mut rgb = [I16F16::ZERO; 3];
        rgb[color] = I16F16::ONE;
        let w = I16F16::from_num(w);
        (ClipVertex::new(number(x) * w, number(y) * w, I16F16::ZERO, w), rgb)
    };
    let corners = [
        corner("-0.9", "-0.85", 1, 0),
        corner("0.95", "-0.35", 2, 1),
        corner("-0.15", "0.9", 4, 2),
    ];
    frame.draw_triangle(corners, &Gouraud);
}

/// A scene in a tier, in words of native byte order.
fn render<T: Tier, I: Correction>(scene: Scene, tier: T, correction: I) -> Vec<u16> {
    let pixels = (SIDE * SIDE) as usize;
    let (mut words, mut depths) = (vec![0; pixels], vec![0_u16; pixels]);
    let buffer = Framebuffer::<Rgb565Be>::try_new(&mut words, SIDE, SIDE).unwrap();
    let depth = DepthBuffer::try_new(&mut depths, SIDE, SIDE).unwrap();
    let frame = Frame::new(buffer).unwrap().with_hither(scene.hither()).with_depth(depth).unwrap();
    scene.draw(&mut frame.with_tier(tier).with_correction(correction).with_cull(scene.cull()));
    words.into_iter().map(u16::from_be).collect()
}

/// The pixels of a PNG, 3 bytes each.
fn read(path: &Path) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path)?)).read_info()?;
    let mut rgb = vec![0; reader.output_buffer_size().ok_or("a picture too large")?];
    reader.next_frame(&mut rgb)?;
    Ok(rgb)
}

/// What is wrong with a picture, if anything; or writes it where that is asked for.
fn check(name: &str, rgb: &[u8]) -> Option<String> {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(name);
    if std::env::var_os("HITHER_BLESS").is_some_and(|value| value == "1") {
        picture::write_png(&golden, SIDE, SIDE, rgb).unwrap();
        return Some(format!("{name}: written anew"));
    }
    let expected = match read(&golden) {
        Ok(expected) => expected,
        Err(error) => return Some(format!("{}: {error}", golden.display())),
    };
    if expected == rgb {
        return None;
    }
    let actual: PathBuf = [env!("CARGO_TARGET_TMPDIR"), name].iter().collect();
    picture::write_png(&actual, SIDE, SIDE, rgb).unwrap();
    let differing = rgb.chunks(3).zip(expected.chunks(3)).filter(|(a, b)| a != b).count();
    Some(format!("{name}: {differing} pixels differ; drawn now: {}", actual.display()))
}

/// Every scene in a tier.
fn check_all<T: Tier, I: Correction>(tier_name: &str, tier: T, correction: I) {
    let wrong: Vec<String> = Scene::ALL
        .into_iter()
        .filter_map(|scene| {
            let rgb = rgb565::expand_all(&render(scene, tier, correction));
            check(&format!("{}.{tier_name}.png", scene.name()), &rgb)
        })
        .collect();
    assert!(wrong.is_empty(), "not the golden pictures:\n{}", wrong.join("\n"));
}

#[test]
fn exact() {
    check_all("exact", Exact, Perspective);
}

#[test]
fn quick8() {
    check_all("quick8", Quick::<8>, PerspectiveEvery::<16>);
}

#[test]
fn quick4() {
    check_all("quick4", Quick::<4>, Perspective);
}
