//! The scenes in exact numbers: which pixels each triangle covers before it is snapped, and in `f64` what they show.
//!
//! A vertex of clip space is a sum of products of a matrix entry, Q16.16, and a stored coordinate: whole numbers in units of
//! `2^-(16 + f)`, with `f` the scene's fraction bits, below 2^33. In half pixels they are below 2^42, an edge's line is below 2^85, a
//! value of it below 2^95 and the determinant below 2^127: `i128`.

use hither::{Cull, Mat4, Rgb565};
use hither_scenes::texture::{GROUND, SIZE};
use hither_scenes::trade::{Attribute, Geometry, HEIGHT, Scene, WIDTH};

/// A pixel that a triangle covers.
#[derive(Clone, Copy, Debug)]
pub struct Covered {
    /// Column.
    pub x: u32,
    /// Row.
    pub y: u32,
    /// Shares of the three vertices in the point of clip space that is seen there; their sum is 1.
    shares: [f64; 3],
}

/// A triangle of a scene.
#[derive(Clone, Debug)]
pub struct Triangle {
    /// Which vertices.
    pub corners: [usize; 3],
    /// Whether it turns its front to the eye.
    pub is_front: bool,
    /// The pixels it covers, in rows from the top.
    pub covered: Vec<Covered>,
    clip: [[f64; 4]; 3],
    attributes: [Attribute; 3],
}

/// A vertex of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    /// As it is stored.
    pub raw: [i16; 3],
    /// What it has.
    pub attribute: Attribute,
    /// Clip space, in units of `2^-(16 + f)`.
    clip: [i64; 4],
}

/// A scene.
#[derive(Clone, Debug)]
pub struct Ideal {
    /// Which.
    pub scene: Scene,
    /// Its vertices.
    pub corners: Vec<Corner>,
    /// Its triangles.
    pub triangles: Vec<Triangle>,
    /// The colours seen at each pixel, unrounded red, green and blue in `[0, 1]`; black where nothing is.
    pub colors: Vec<[f64; 3]>,
    /// The texels seen at each pixel.
    pub texels: Vec<Rgb565>,
    /// Whether anything is seen at each pixel.
    pub shown: Vec<bool>,
}

impl Corner {
    /// In pixels on the screen, where it is beyond the hither plane.
    #[must_use]
    pub fn on_screen(&self, scene: Scene) -> Option<[f64; 2]> {
        let [x, y, _, w] = self.clip.map(|v| v as f64);
        let (width, height) = (f64::from(WIDTH), f64::from(HEIGHT));
        let at = [(x / w + 1.0) * width / 2.0, (1.0 - y / w) * height / 2.0];
        (w >= hither(scene)).then_some(at)
    }
}

impl Covered {
    fn sum(&self, values: [f64; 3]) -> f64 {
        (0..3).map(|i| self.shares[i] * values[i]).sum()
    }
}

impl Triangle {
    /// The corners' `[x, y, w]`, in units of `2^-(16 + f)`.
    #[must_use]
    pub fn corners_in_clip_space(&self) -> [[i64; 3]; 3] {
        self.clip.map(|[x, y, _, w]| [x, y, w].map(|v| v as i64))
    }

    /// `z / w` at a pixel.
    #[must_use]
    pub fn depth(&self, at: &Covered) -> f64 {
        at.sum(self.clip.map(|c| c[2])) / at.sum(self.clip.map(|c| c[3]))
    }

    /// Texture coordinates at a pixel.
    #[must_use]
    pub fn uv(&self, at: &Covered) -> [f64; 2] {
        [0, 1].map(|i| at.sum(self.attributes.map(|a| a.uv[i].to_num())))
    }

    /// Red, green and blue at a pixel.
    #[must_use]
    pub fn color(&self, at: &Covered) -> [f64; 3] {
        [0, 1, 2].map(|i| at.sum(self.attributes.map(|a| a.color[i].to_num())))
    }
}

/// The hither distance in the units of clip space.
fn hither(scene: Scene) -> f64 {
    scene.near().to_num::<f64>() * f64::from(16 + scene.fraction_bits() as i32).exp2()
}

impl Ideal {
    /// Makes a scene.
    ///
    /// # Panics
    ///
    /// Where a scene is not made of constants in range.
    #[must_use]
    pub fn new(scene: Scene) -> Self {
        let mut geometry = Geometry::EMPTY;
        let faces = scene.build(&mut geometry).expect("constants in range").triangles().to_vec();
        let matrix = scene.transform().expect("constants in range");
        let corners: Vec<Corner> = geometry
            .vertices()
            .map(|(raw, attribute)| Corner { raw, attribute, clip: clip(&matrix, raw, scene) })
            .collect();
        let triangle = |face: [u16; 3]| triangle(scene, &corners, face.map(usize::from));
        let triangles: Vec<Triangle> = faces.into_iter().filter_map(triangle).collect();
        let pixels = (WIDTH * HEIGHT) as usize;
        let mut ideal = Self {
            scene,
            corners,
            triangles,
            colors: vec![[0.0; 3]; pixels],
            texels: vec![Rgb565::BLACK; pixels],
            shown: vec![false; pixels],
        };
        ideal.show();
        ideal
    }

    /// Draws the nearest of all triangles at each pixel.
    fn show(&mut self) {
        let mut nearest = vec![1.0; self.shown.len()];
        for triangle in &self.triangles {
            if self.scene.cull() == Cull::Back && !triangle.is_front {
                continue;
            }
            for at in &triangle.covered {
                let place = (at.y * WIDTH + at.x) as usize;
                let depth = triangle.depth(at);
                if depth < nearest[place] {
                    nearest[place] = depth;
                    self.shown[place] = true;
                    self.colors[place] = triangle.color(at);
                    self.texels[place] = texel(triangle.uv(at));
                }
            }
        }
    }

    /// The sum over triangles that cover a pixel, front faces counted 1 and backs -1.
    #[must_use]
    pub fn layers(&self) -> Vec<i32> {
        let mut layers = vec![0; self.shown.len()];
        for triangle in &self.triangles {
            for at in &triangle.covered {
                layers[(at.y * WIDTH + at.x) as usize] += if triangle.is_front { 1 } else { -1 };
            }
        }
        layers
    }
}

/// The texel at a place.
fn texel(uv: [f64; 2]) -> Rgb565 {
    let [column, row] = uv.map(|c| (c.rem_euclid(1.0) * SIZE as f64) as usize % SIZE);
    Rgb565(GROUND[row * SIZE + column])
}

/// A stored position in clip space, exactly.
fn clip(matrix: &Mat4, raw: [i16; 3], scene: Scene) -> [i64; 4] {
    matrix.rows().map(|row| {
        let [a, b, c, t] = row.map(|v| i64::from(v.to_bits()));
        let [x, y, z] = raw.map(i64::from);
        a * x + b * y + c * z + (t << scene.fraction_bits())
    })
}

type Point = [i128; 3];

fn cross([a, b, c]: Point, [d, e, f]: Point) -> Point {
    [b * f - c * e, c * d - a * f, a * e - b * d]
}

fn dot([a, b, c]: Point, [d, e, f]: Point) -> i128 {
    a * d + b * e + c * f
}

/// A triangle with the pixels it covers in front of the hither plane; none where it has no area.
fn triangle(scene: Scene, corners: &[Corner], indices: [usize; 3]) -> Option<Triangle> {
    let vertices = indices.map(|i| corners[i]);
    let [p, q, r] = vertices.map(|v| {
        let [x, y, _, w] = v.clip.map(i128::from);
        [i128::from(WIDTH) * (x + w), i128::from(HEIGHT) * (w - y), 2 * w]
    });
    let edges = [cross(q, r), cross(r, p), cross(p, q)];
    let determinant = dot(edges[0], p);
    let sign = determinant.signum();
    if sign == 0 {
        return None;
    }
    let mut triangle = Triangle {
        corners: indices,
        is_front: sign < 0,
        covered: Vec::new(),
        clip: vertices.map(|v| v.clip.map(|c| c as f64)),
        attributes: vertices.map(|v| v.attribute),
    };
    let near = hither(scene);
    let ([left, right], [top, bottom]) = bounds(&vertices, scene);
    for y in top..bottom {
        for x in left..right {
            let center = [2 * i128::from(x) + 1, 2 * i128::from(y) + 1, 2];
            let values = edges.map(|edge| sign * dot(edge, center));
            let inside = values.iter().zip(&edges).all(|(&value, &[a, b, _])| {
                value > 0 || (value == 0 && (sign * a > 0 || (a == 0 && sign * b > 0)))
            });
            if !inside {
                continue;
            }
            let values = values.map(|v| v as f64);
            let sum: f64 = values.iter().sum();
            let at = Covered { x, y, shares: values.map(|v| v / sum) };
            if at.sum(triangle.clip.map(|c| c[3])) >= near {
                triangle.covered.push(at);
            }
        }
    }
    Some(triangle)
}

/// Columns and rows that a triangle may cover.
fn bounds(vertices: &[Corner; 3], scene: Scene) -> ([u32; 2], [u32; 2]) {
    let places: Vec<[f64; 2]> = vertices.iter().filter_map(|v| v.on_screen(scene)).collect();
    if places.len() < 3 {
        return ([0, WIDTH], [0, HEIGHT]);
    }
    let range = |i: usize, side: u32| {
        let least = places.iter().map(|p| p[i]).fold(f64::MAX, f64::min);
        let most = places.iter().map(|p| p[i]).fold(f64::MIN, f64::max);
        // Casts of negative numbers give 0.
        [(least - 1.0) as u32, ((most + 2.0) as u32).min(side)]
    };
    (range(0, WIDTH), range(1, HEIGHT))
}
