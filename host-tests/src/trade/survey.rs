//! How far off a point is: every triangle of the scenes drawn by itself, against the exact one, and the whole pictures.

use super::canvas::{Asked, Asking, Blank, Canvas, Pixel, texels};
use super::ideal::{Covered, Ideal, Triangle};
use super::sums::{Sum, Sums, psnr};
use super::{Picture, Point};
use crate::oracle::Viewport;
use crate::snapped::on_screen;
use hither::{Rgb565, Vertex};
use hither_examples::rgb565;
use hither_scenes::checksum::Checksum;
use hither_scenes::texture::SIZE;
use hither_scenes::trade::{HEIGHT, Knobs, PIXELS, Scene, Visitor, WIDTH};

/// What was drawn of one picture: the sum is what every instruction set has to get.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sketch {
    /// Which scene.
    pub scene: Scene,
    /// With its texture or with a colour a vertex.
    pub with_texture: bool,
    /// The checksum of its words.
    pub sum: u32,
}

/// Visits points, and surveys each.
pub struct Survey<'a> {
    scenes: &'a [Ideal],
    canvas: Canvas,
    asked: Vec<[u32; 2]>,
    color: Vec<u16>,
    done: &'a mut dyn FnMut(),
    /// The points, without their costs.
    pub points: Vec<(Point, Vec<Sketch>)>,
}

impl<'a> Survey<'a> {
    /// Over these scenes; `done` is called after each point.
    #[must_use]
    pub fn new(scenes: &'a [Ideal], done: &'a mut dyn FnMut()) -> Self {
        let (asked, color) = (vec![[0; 2]; PIXELS], vec![0; PIXELS]);
        Self { scenes, canvas: Canvas::new(), asked, color, done, points: Vec::new() }
    }

    /// Adds a scene's errors; its pictures' checksums, and the one that is shown.
    fn survey<K: Knobs>(&mut self, ideal: &Ideal, sums: &mut Sums) -> ([Sketch; 2], Picture) {
        let asked = self.coordinates::<K>(ideal, sums);
        self.colors::<K>(ideal, sums);
        if !hides(ideal.scene) {
            banding(ideal, &self.color, sums);
        }
        let is_textured = ideal.scene.is_textured();
        let shown = if is_textured { &asked } else { &self.color };
        let sketch = |with_texture: bool, words: &[u16]| Sketch {
            scene: ideal.scene,
            with_texture,
            sum: Checksum::new().with_words(words).value(),
        };
        let picture = picture(ideal, shown, sums);
        ([sketch(true, &asked), sketch(false, &self.color)], picture)
    }

    /// Coverage, depth and texture coordinates of every triangle; the picture.
    fn coordinates<K: Knobs>(&mut self, ideal: &Ideal, sums: &mut Sums) -> Vec<u16> {
        let Self { canvas, asked, .. } = self;
        let vertices = canvas.snapped::<K, Asked, 2>(ideal, asked);
        positions(ideal, &vertices, sums);
        let mut layers = vec![0; PIXELS];
        for triangle in &ideal.triangles {
            let corners = triangle.corners.map(|i| &vertices[i]);
            let (drawn, is_front) =
                canvas.triangle::<K, Asked, 2>(ideal.scene, asked, corners, &Asking);
            for (x, y, _) in &drawn {
                layers[(y * WIDTH + x) as usize] += if is_front { 1 } else { -1 };
            }
            let both = both(triangle, &drawn);
            sums.covered += triangle.covered.len() as u64;
            sums.differing += (drawn.len() + triangle.covered.len() - 2 * both.len()) as u64;
            for (at, uv) in both {
                sums.texel.add(off_texels(triangle.uv(at), uv));
                if let Some(depth) = stored::<K>(canvas, at) {
                    let exact = (triangle.depth(at) * 65_535.0).clamp(0.0, 65_535.0);
                    sums.depth.add((depth - exact).abs());
                }
            }
        }
        interior(&ideal.layers(), &layers, sums);
        canvas.picture::<K, Asked, 2>(ideal, asked, Asked::BLANK, &vertices, &Asking);
        texels(asked)
    }

    /// Colours of every triangle, in steps of RGB565; the picture is left in its words.
    fn colors<K: Knobs>(&mut self, ideal: &Ideal, sums: &mut Sums) {
        let Self { canvas, color, .. } = self;
        let vertices = canvas.snapped::<K, Rgb565, 3>(ideal, color);
        let shader = K::Shader::default();
        for triangle in &ideal.triangles {
            let corners = triangle.corners.map(|i| &vertices[i]);
            let (drawn, _) = canvas.triangle::<K, Rgb565, 3>(ideal.scene, color, corners, &shader);
            for (at, got) in both(triangle, &drawn) {
                let exact = steps_of(triangle.color(at));
                let off = (0..3).map(|i| (steps(got)[i] - exact[i]).abs());
                sums.color.add(off.fold(0.0, f64::max));
            }
        }
        canvas.picture::<K, Rgb565, 3>(ideal, color, 0, &vertices, &shader);
    }
}

impl Visitor for Survey<'_> {
    fn visit<K: Knobs>(&mut self) {
        let mut sums = Sums::default();
        let (mut pictures, mut sketches) = (Vec::new(), Vec::new());
        for ideal in self.scenes {
            let (sketch, picture) = self.survey::<K>(ideal, &mut sums);
            sketches.extend(sketch);
            pictures.push(picture);
        }
        let point = Point {
            name: name::<K>(),
            knobs: K::SETTINGS.to_vec(),
            preset: K::PRESET,
            costs: Vec::new(),
            errors: sums.errors(),
            pictures,
        };
        self.points.push((point, sketches));
        (self.done)();
    }
}

/// A point's settings, but for those that are what most points have.
fn name<K: Knobs>() -> String {
    const USUAL: [&str; 5] = ["word", "newton2", "depth16", "mat32", "plain"];
    let settings = K::SETTINGS.iter().map(|(_, setting)| *setting);
    let said: Vec<&str> = settings.filter(|setting| !USUAL.contains(setting)).collect();
    said.join(" ").replace("none", "no-depth")
}

/// Whether some surface of a scene hides another, so that a point without depth shows the wrong one.
const fn hides(scene: Scene) -> bool {
    matches!(scene, Scene::Torus | Scene::Wall | Scene::Specks | Scene::Steep)
}

/// How far vertices on the screen are from where they should be.
fn positions<T: hither::Tier>(ideal: &Ideal, vertices: &[Vertex<T, 2>], sums: &mut Sums) {
    let (width, height) = (f64::from(WIDTH), f64::from(HEIGHT));
    for (corner, vertex) in ideal.corners.iter().zip(vertices) {
        let Some([x, y]) = corner.on_screen(ideal.scene) else {
            continue;
        };
        if !(0.0..=width).contains(&x) || !(0.0..=height).contains(&y) {
            continue;
        }
        let [got_x, got_y] = on_screen(vertex.snapped(), Viewport::new(WIDTH, HEIGHT));
        sums.position.add((got_x - x).abs().max((got_y - y).abs()));
    }
}

/// How far off coordinates are, in texels of a texture that repeats.
fn off_texels(exact: [f64; 2], got: [u32; 2]) -> f64 {
    let off = |i: usize| {
        let off = (f64::from(got[i] as i32) / 65_536.0 - exact[i]).rem_euclid(1.0);
        off.min(1.0 - off)
    };
    off(0).max(off(1)) * SIZE as f64
}

/// The stored depth of a pixel in steps of 16 bits, if any is kept.
fn stored<K: Knobs>(canvas: &Canvas, at: &Covered) -> Option<f64> {
    let place = (at.y * WIDTH + at.x) as usize;
    let depth = K::SETTINGS.iter().find(|(knob, _)| *knob == "depth").map(|(_, setting)| *setting);
    match depth {
        Some("depth16") => Some(f64::from(canvas.short[place])),
        Some("depth32") => Some(f64::from(canvas.long[place]) * 65_535.0 / f64::from(u32::MAX)),
        _ => None,
    }
}

fn steps(color: Rgb565) -> [f64; 3] {
    [color.r(), color.g(), color.b()].map(f64::from)
}

fn steps_of([r, g, b]: [f64; 3]) -> [f64; 3] {
    [31.0 * r, 63.0 * g, 31.0 * b]
}

/// The pixels that are covered and were drawn. Both are in rows from the top.
fn both<'a, C: Copy>(triangle: &'a Triangle, drawn: &[Pixel<C>]) -> Vec<(&'a Covered, C)> {
    let found = |at: &Covered| {
        drawn.binary_search_by_key(&(at.y, at.x), |&(x, y, _)| (y, x)).ok().map(|i| drawn[i].2)
    };
    triangle.covered.iter().filter_map(|at| Some((at, found(at)?))).collect()
}

/// Counts pixels whose layers are not those of the exact mesh, where no edge of it is near.
fn interior(exact: &[i32], drawn: &[i32], sums: &mut Sums) {
    let (width, height) = (WIDTH as usize, HEIGHT as usize);
    for y in 1..height - 1 {
        for x in 1..width - 1 {
            let here = exact[y * width + x];
            let mut around =
                (y - 1..=y + 1).flat_map(|y| (x - 1..=x + 1).map(move |x| y * width + x));
            if around.all(|place| exact[place] == here) {
                // Layers of backs are counted down.
                let off = (drawn[y * width + x] - here) * if here < 0 { -1 } else { 1 };
                sums.gaps += u64::from(off < 0);
                sums.doubles += u64::from(off > 0);
            }
        }
    }
}

/// The picture beside its reference.
fn picture(ideal: &Ideal, words: &[u16], sums: &mut Sums) -> Picture {
    let reference: Vec<u16> = if ideal.scene.is_textured() {
        ideal.texels.iter().map(|color| color.0).collect()
    } else {
        ideal.colors.iter().map(|&color| rgb565::pack_unit(color)).collect()
    };
    let (drawn, reference) = (rgb565::expand_all(words), rgb565::expand_all(&reference));
    let mut sum = Sum::default();
    for (a, b) in drawn.iter().zip(&reference) {
        sum.add(f64::from(a.abs_diff(*b)));
    }
    sums.pictures.join(&sum);
    let (scene, psnr) = (ideal.scene.name(), psnr(&sum));
    Picture { scene, width: WIDTH, height: HEIGHT, drawn, ideal: reference, psnr }
}

/// What means of 4 x 4 pixels are off, where all of them show something.
fn banding(ideal: &Ideal, words: &[u16], sums: &mut Sums) {
    let (width, height) = (WIDTH as usize, HEIGHT as usize);
    for y in (0..height).step_by(4) {
        for x in (0..width).step_by(4) {
            let block: Vec<usize> = (0..16).map(|i| (y + i / 4) * width + x + i % 4).collect();
            if !block.iter().all(|&place| ideal.shown[place]) {
                continue;
            }
            let off = |i: usize| {
                let each = block.iter().map(|&place| {
                    steps(Rgb565(words[place]))[i] - steps_of(ideal.colors[place])[i]
                });
                each.sum::<f64>().abs() / 16.0
            };
            sums.banding.add((0..3).map(off).fold(0.0, f64::max));
        }
    }
}
