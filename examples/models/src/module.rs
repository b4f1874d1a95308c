//! A model as Rust source: data for flash, and the mesh over them.

use std::fmt::{self, Write};

use crate::bounds::Bounds;
use crate::image::Image;
use crate::model::Model;
use crate::order::transforms;
use crate::weld::ModelVertex;

/// What a module is made of.
#[derive(Clone, Copy, Debug)]
pub struct Module<'a> {
    /// The model: [`Keep::Lit`](crate::Keep), or [`Keep::Textured`](crate::Keep) with a texture.
    pub model: &'a Model,
    /// The name of its file.
    pub name: &'a str,
    /// Its texture, and the name of that file.
    pub texture: Option<(&'a Image, &'a str)>,
}

/// Bytes of flash of a module's data.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bytes {
    /// 6 a vertex.
    pub positions: usize,
    /// 6 a vertex for normals and colours, 8 for texture coordinates.
    pub attributes: usize,
    /// 6 a triangle.
    pub triangles: usize,
    /// 2 a texel.
    pub texels: usize,
}

impl Bytes {
    /// All of them.
    #[must_use]
    pub const fn total(self) -> usize {
        self.positions + self.attributes + self.triangles + self.texels
    }
}

impl Module<'_> {
    /// Bytes of flash that its data take.
    #[must_use]
    pub fn bytes(&self) -> Bytes {
        let vertices = self.model.vertices().len();
        Bytes {
            positions: 6 * vertices,
            attributes: if self.texture.is_some() { 8 } else { 6 } * vertices,
            triangles: 6 * self.model.triangles().len(),
            texels: self.texture.map_or(0, |(image, _)| 2 * image.words.len()),
        }
    }

    /// The source: for a file of its own, in a crate that may be `no_std` and depends on hither. The same model gives the same
    /// text, which rustfmt leaves as it is.
    #[must_use]
    pub fn source(&self) -> String {
        let mut text = String::new();
        // A string takes all that is written.
        let _ = self.header(&mut text).and_then(|()| self.data(&mut text));
        text
    }

    fn header(&self, out: &mut String) -> fmt::Result {
        let model = self.model;
        let [vertices, triangles] = [model.vertices().len(), model.triangles().len()];
        let name = file_name(self.name);
        let bytes = grouped(self.bytes().total());
        writeln!(
            out,
            "//! {name}, for hither: {}, {}, {bytes} bytes of flash.",
            counted(vertices, "vertex", "vertices"),
            counted(triangles, "triangle", "triangles"),
        )?;
        let texture = self
            .texture
            .map_or(String::new(), |(_, name)| format!(" --texture {}", file_name(name)));
        writeln!(
            out,
            "//!\n//! Made by `cargo run -p host-tests --release --bin mesh -- {name}{texture}`.\n//!"
        )?;
        self.bytes_table(out)?;
        let bits = model.fraction_bits();
        writeln!(
            out,
            "//!\n//! A position is up to 2^-{} units off along each axis, by rounding.",
            bits + 1
        )?;
        match model.counts().open_edges {
            0 => writeln!(
                out,
                "//! The surface is closed: from outside, `Cull::Back` hides nothing."
            )?,
            1 => writeln!(
                out,
                "//! The surface has an open edge: where that shows the inside, cull nothing."
            )?,
            n => writeln!(
                out,
                "//! The surface has {} open edges: where they show the inside, cull nothing.",
                grouped(n)
            )?,
        }
        writeln!(
            out,
            "//!\n//! Vertices are numbered most used first. Transforms a triangle, by entries of the vertex cache:\n//!"
        )?;
        writeln!(out, "//! | entries | transforms |\n//! | --- | --- |")?;
        for (entries, mean) in means(model) {
            writeln!(out, "//! | {} | {mean:.2} |", grouped(entries))?;
        }
        self.usage(out)
    }

    fn bytes_table(&self, out: &mut String) -> fmt::Result {
        let bytes = self.bytes();
        writeln!(out, "//! | data | bytes |\n//! | --- | --- |")?;
        writeln!(out, "//! | positions | {} |", grouped(bytes.positions))?;
        let attributes =
            if self.texture.is_some() { "texture coordinates" } else { "normals and colours" };
        writeln!(out, "//! | {attributes} | {} |", grouped(bytes.attributes))?;
        writeln!(out, "//! | triangles | {} |", grouped(bytes.triangles))?;
        if bytes.texels > 0 {
            writeln!(out, "//! | texture | {} |", grouped(bytes.texels))?;
        }
        Ok(())
    }

    fn usage(&self, out: &mut String) -> fmt::Result {
        let (drawn, planned) = if self.texture.is_some() {
            (
                "frame.draw(&MESH, &transform, &Textured(TEXTURE), &mut [Vertex::EMPTY; VERTEX_COUNT]);",
                "\n//!         .texture(TEXTURE_SIDE, REPEATS)\n//!         .coordinates(COORDINATE);",
            )
        } else {
            (
                "let lit = Lit::new(transform, &model, towards_light, ambient, diffuse)?;\n\
                 //! frame.draw(&MESH, &lit, &Gouraud, &mut [Vertex::EMPTY; VERTEX_COUNT]);",
                "\n//!         .colors();",
            )
        };
        writeln!(
            out,
            "//!\n//! To draw it, with a cache of all vertices:\n//!\n//! ```text\n//! {drawn}\n//! ```\n//!"
        )?;
        writeln!(
            out,
            "//! To plan a frame for it, seen by a camera that does not scale it (`near` and `far` are along its view):\n//!"
        )?;
        writeln!(
            out,
            "//! ```text\n//! hither::plan! {{\n//!     pub Planned = Scene::new(width, height)\n//!         .range(near, far)\n\
             //!         .model(EXTENT, stretch)\n//!         .triangle(LONGEST_EDGE, f32::INFINITY){planned}\n//! }}\n//! ```\n"
        )
    }

    fn data(&self, out: &mut String) -> fmt::Result {
        let model = self.model;
        let [kind, used] = match self.texture {
            Some(_) => ["[I16F16; 2]", "I16F16, Mesh, Rgb565, Texture"],
            None => ["NormalColor", "Mesh, NormalColor"],
        };
        writeln!(out, "use hither::{{{used}}};\n")?;
        writeln!(out, "/// Vertices: entries of a cache that transforms each once.")?;
        writeln!(out, "pub const VERTEX_COUNT: usize = {};\n", model.vertices().len())?;
        writeln!(
            out,
            "/// Triangles.\npub const TRIANGLE_COUNT: usize = {};\n",
            model.triangles().len()
        )?;
        writeln!(out, "/// Bits of fraction of a position.")?;
        writeln!(out, "pub const FRACTION_BITS: u32 = {};\n", model.fraction_bits())?;
        bounds(out, &model.bounds())?;
        if let Some((image, _)) = self.texture {
            texture_bounds(out, &model.bounds(), image)?;
        }
        writeln!(out, "/// The mesh.\npub static MESH: Mesh<'static, [i16; 3], {kind}> =")?;
        writeln!(
            out,
            "    match Mesh::try_new(&POSITIONS, FRACTION_BITS, &ATTRIBUTES, &TRIANGLES) {{"
        )?;
        writeln!(
            out,
            "        Ok(mesh) => mesh,\n        Err(_) => panic!(\"the mesh's data\"),\n    }};\n"
        )?;
        self.tables(out)
    }

    fn tables(&self, out: &mut String) -> fmt::Result {
        let (vertices, triangles) = (self.model.vertices(), self.model.triangles());
        writeln!(out, "/// Positions in units of 2^-{}.", self.model.fraction_bits())?;
        let rows = vertices.iter().map(|vertex| list(&vertex.position));
        table(out, "pub static POSITIONS: [[i16; 3]; VERTEX_COUNT]", rows)?;
        if self.texture.is_some() {
            writeln!(out, "/// Texture coordinates, v downwards.")?;
            let row = |ModelVertex { coordinate: [u, v], .. }: &_| format!("uv({u}, {v})");
            table(
                out,
                "pub static ATTRIBUTES: [[I16F16; 2]; VERTEX_COUNT]",
                vertices.iter().map(row),
            )?;
        } else {
            writeln!(out, "/// Normals of length 127, and colours.")?;
            let row = |vertex: &ModelVertex| {
                format!("lit({}, {})", list(&vertex.normal), list(&vertex.color))
            };
            table(
                out,
                "pub static ATTRIBUTES: [NormalColor; VERTEX_COUNT]",
                vertices.iter().map(row),
            )?;
        }
        writeln!(out, "/// Three vertices a triangle, counter-clockwise from the front.")?;
        let rows = triangles.iter().map(list);
        table(out, "pub static TRIANGLES: [[u16; 3]; TRIANGLE_COUNT]", rows)?;
        if let Some((image, _)) = self.texture {
            texture(out, image)?;
            writeln!(out, "/// Of raw Q16.16.\nconst fn uv(u: i32, v: i32) -> [I16F16; 2] {{")?;
            writeln!(out, "    [I16F16::from_bits(u), I16F16::from_bits(v)]\n}}")
        } else {
            writeln!(out, "const fn lit(normal: [i8; 3], color: [u8; 3]) -> NormalColor {{")?;
            writeln!(out, "    NormalColor {{ normal, color }}\n}}")
        }
    }
}

/// Entries of a vertex cache, and the vertices transformed a triangle with it.
#[must_use]
pub fn means(model: &Model) -> Vec<(usize, f64)> {
    let (vertices, triangles) = (model.vertices().len(), model.triangles());
    let mut entries = vec![vertices, vertices / 2, vertices / 4, 0];
    entries.dedup();
    let mean = |cached| transforms(triangles, vertices, cached) as f64 / triangles.len() as f64;
    entries.into_iter().map(|cached| (cached, mean(cached))).collect()
}

fn bounds(out: &mut String, bounds: &Bounds) -> fmt::Result {
    let Bounds { extent, center: [x, y, z], radius, longest_edge, .. } = bounds;
    writeln!(out, "/// The largest magnitude of a coordinate, in units: for `Scene::model`.")?;
    writeln!(out, "pub const EXTENT: f32 = {extent:?};\n")?;
    writeln!(out, "/// The middle of the box round the mesh, in units.")?;
    writeln!(out, "pub const CENTER: [f32; 3] = [{x:?}, {y:?}, {z:?}];\n")?;
    writeln!(out, "/// From there to the farthest vertex, in units: for `Scene::range`.")?;
    constant(out, "RADIUS", *radius)?;
    writeln!(
        out,
        "/// The longest edge, in units, by which `w` differs over a triangle at the most: for `Scene::triangle`."
    )?;
    constant(out, "LONGEST_EDGE", *longest_edge)
}

fn texture_bounds(out: &mut String, bounds: &Bounds, image: &Image) -> fmt::Result {
    let side = image.width.max(image.height);
    writeln!(out, "/// The texture's longer side in texels: for `Scene::texture`.")?;
    writeln!(out, "pub const TEXTURE_SIDE: u32 = {side};\n")?;
    writeln!(
        out,
        "/// How much of the texture a triangle shows at the most, 1 for a whole side: for `Scene::texture`."
    )?;
    writeln!(out, "pub const REPEATS: f32 = {:?};\n", bounds.repeats)?;
    writeln!(out, "/// The largest magnitude of a texture coordinate: for `Scene::coordinates`.")?;
    writeln!(out, "pub const COORDINATE: f32 = {:?};\n", bounds.coordinate)
}

/// A length, which is a root and so may be near a constant of the standard library.
fn constant(out: &mut String, name: &str, value: f32) -> fmt::Result {
    writeln!(out, "#[allow(clippy::approx_constant, reason = \"a length\")]")?;
    writeln!(out, "pub const {name}: f32 = {value:?};\n")
}

fn texture(out: &mut String, image: &Image) -> fmt::Result {
    let Image { width, height, words, .. } = image;
    writeln!(out, "/// The texture.")?;
    writeln!(
        out,
        "pub static TEXTURE: Texture<'static, Rgb565> = match Texture::try_new(&TEXELS, {width}, {height}) {{"
    )?;
    writeln!(
        out,
        "    Ok(texture) => texture,\n    Err(_) => panic!(\"the texture's size\"),\n}};\n"
    )?;
    writeln!(out, "/// {width} x {height} texels, RGB565, rows from the top.")?;
    let rows = words.iter().map(|word| format!("0x{word:04x}"));
    table(out, &format!("pub static TEXELS: [u16; {}]", words.len()), rows)
}

/// Columns of a line.
const WIDTH: usize = 100;

/// A table with as many entries a line as there is room for. rustfmt would give each its own.
fn table(
    out: &mut String,
    declaration: &str,
    entries: impl Iterator<Item = String>,
) -> fmt::Result {
    writeln!(out, "#[rustfmt::skip]\n{declaration} = [")?;
    let mut line = String::new();
    for entry in entries {
        if !line.is_empty() && 4 + line.len() + 1 + entry.len() + 1 > WIDTH {
            writeln!(out, "    {line}")?;
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(&entry);
        line.push(',');
    }
    if !line.is_empty() {
        writeln!(out, "    {line}")?;
    }
    writeln!(out, "];\n")
}

fn list<T: fmt::Display>(numbers: &[T; 3]) -> String {
    let [a, b, c] = numbers;
    format!("[{a}, {b}, {c}]")
}

/// The last part of a path, as a comment can show it.
fn file_name(path: &str) -> String {
    let name = path.rsplit(['/', '\\']).next().unwrap_or_default();
    name.chars().flat_map(char::escape_debug).collect()
}

/// A number and what it counts.
fn counted(number: usize, one: &str, many: &str) -> String {
    format!("{} {}", grouped(number), if number == 1 { one } else { many })
}

/// A number with its digits in threes.
#[must_use]
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut grouped = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place) % 3 == 0 {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}
