//! Meshes that are made when a scene begins, in what the caller keeps.

use hither::{AsVaryings, I16F16, Mesh, MeshError};

/// Vertices of the largest mesh.
pub const VERTICES: usize = 561;

/// Triangles of the largest mesh.
pub const TRIANGLES: usize = 1024;

/// What a vertex has: a place in the texture and a colour, of which a shader takes one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Attribute {
    /// Texture coordinates.
    pub uv: [I16F16; 2],
    /// Red, green and blue in `[0, 1]`.
    pub color: [I16F16; 3],
}

impl AsVaryings<2> for Attribute {
    #[inline]
    fn varyings(&self) -> [I16F16; 2] {
        self.uv
    }
}

impl AsVaryings<3> for Attribute {
    #[inline]
    fn varyings(&self) -> [I16F16; 3] {
        self.color
    }
}

/// A mesh's data.
#[derive(Clone, Debug)]
pub struct Geometry {
    positions: [[i16; 3]; VERTICES],
    attributes: [Attribute; VERTICES],
    triangles: [[u16; 3]; TRIANGLES],
    vertices: usize,
    faces: usize,
}

impl Geometry {
    /// No mesh yet.
    pub const EMPTY: Self = Self {
        positions: [[0; 3]; VERTICES],
        attributes: [Attribute { uv: [I16F16::ZERO; 2], color: [I16F16::ZERO; 3] }; VERTICES],
        triangles: [[0; 3]; TRIANGLES],
        vertices: 0,
        faces: 0,
    };

    /// Starts anew.
    pub fn clear(&mut self) {
        (self.vertices, self.faces) = (0, 0);
    }

    /// The mesh, its positions with so many bits of fraction.
    ///
    /// # Errors
    ///
    /// None in practice: the indices are those of [`Geometry::grid`].
    pub fn mesh(&self, fraction_bits: u32) -> Result<Mesh<'_, [i16; 3], Attribute>, MeshError> {
        let positions = self.positions.get(..self.vertices).unwrap_or_default();
        let attributes = self.attributes.get(..self.vertices).unwrap_or_default();
        let triangles = self.triangles.get(..self.faces).unwrap_or_default();
        Mesh::try_new(positions, fraction_bits, attributes, triangles)
    }

    /// The vertices' stored positions and attributes.
    pub fn vertices(&self) -> impl Iterator<Item = ([i16; 3], Attribute)> + '_ {
        self.positions.iter().copied().zip(self.attributes.iter().copied()).take(self.vertices)
    }

    /// Adds a sheet of `columns x rows` cells of two triangles: `vertex` has the corner at `(column, row)`. What does not fit is
    /// left out.
    pub fn grid(
        &mut self,
        [columns, rows]: [usize; 2],
        mut vertex: impl FnMut(usize, usize) -> ([i16; 3], Attribute),
    ) {
        let (first, across) = (self.vertices, columns + 1);
        for row in 0..=rows {
            for column in 0..=columns {
                let (at, attribute) = vertex(column, row);
                self.push_vertex(at, attribute);
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let corner = |x: usize, y: usize| (first + (row + y) * across + column + x) as u16;
                let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                self.push_triangle([a, b, c]);
                self.push_triangle([a, c, d]);
            }
        }
    }

    fn push_vertex(&mut self, at: [i16; 3], attribute: Attribute) {
        let places =
            self.positions.get_mut(self.vertices).zip(self.attributes.get_mut(self.vertices));
        if let Some((position, place)) = places {
            (*position, *place) = (at, attribute);
            self.vertices += 1;
        }
    }

    fn push_triangle(&mut self, indices: [u16; 3]) {
        if let Some(place) = self.triangles.get_mut(self.faces) {
            *place = indices;
            self.faces += 1;
        }
    }
}
