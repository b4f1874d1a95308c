//! A model: from an OBJ to a mesh's arrays.

use std::collections::HashMap;

use hither::{I16F16, NormalColor};

use crate::bounds::Bounds;
use crate::error::{ObjError, Problem};
use crate::obj::{Obj, Warning};
use crate::order;
use crate::triangulate::triangulate;
use crate::weld::{Grid, Keep, ModelVertex, Welder, scale};

/// A welded, triangulated and ordered mesh, and what became of the file's faces.
#[derive(Clone, Debug)]
pub struct Model {
    keep: Keep,
    vertices: Vec<ModelVertex>,
    fraction_bits: u32,
    triangles: Vec<[u16; 3]>,
    counts: Counts,
    warnings: Vec<Warning>,
}

/// What became of a file's faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Faces of the file.
    pub faces: usize,
    /// Their corners.
    pub corners: usize,
    /// Triangles that were dropped: two of their corners are at one position on the grid.
    pub dropped: usize,
    /// Triangles without area that were kept. On the screen they hold the edges of their neighbours together.
    pub thin: usize,
    /// Edges that do not have as many triangles to one side as to the other: none of a closed surface.
    pub open_edges: usize,
}

impl Model {
    /// Reads an OBJ, keeping some of its attributes.
    ///
    /// Positions are rounded to the finest grid of 16 bits and a power of two that they fit.
    ///
    /// # Errors
    ///
    /// [`ObjError`] with the line of what cannot be read or does not fit.
    pub fn read(bytes: &[u8], keep: Keep) -> Result<Self, ObjError> {
        Self::new(&Obj::parse(bytes)?, keep)
    }

    /// A model of an OBJ that has been read.
    ///
    /// # Errors
    ///
    /// [`ObjError`] with the line of what does not fit.
    pub fn new(obj: &Obj, keep: Keep) -> Result<Self, ObjError> {
        let grid = Grid::of(obj)?;
        let mut welder = Welder::new(obj, keep, grid);
        let mut counts = Counts { faces: obj.faces.len(), ..Counts::default() };
        let mut triangles = Vec::new();
        for face in &obj.faces {
            let corners = welder.corners(face)?;
            let positions: Vec<[i16; 3]> = corners.iter().map(|corner| corner.position).collect();
            counts.corners += corners.len();
            counts.dropped += corners.len() - 2;
            for triangle in triangulate(&positions) {
                let [a, b, c] = triangle.map(|corner| positions[corner]);
                if a == b || b == c || c == a {
                    continue;
                }
                counts.dropped -= 1;
                counts.thin += usize::from(is_thin([a, b, c]));
                let [a, b, c] = triangle.map(|corner| welder.weld(corners[corner], face.line));
                triangles.push([a?, b?, c?]);
            }
        }
        if triangles.is_empty() {
            let problem = Problem::Flat { triangles: counts.dropped };
            return Err(ObjError { line: obj.lines.max(1), problem });
        }
        let triangles = order::triangles(&triangles, welder.vertices.len());
        let numbers = order::vertices(&triangles, welder.vertices.len());
        let triangles = order::renumber(&triangles, &numbers);
        let vertices: Vec<ModelVertex> =
            numbers.into_iter().map(|number| welder.vertices[usize::from(number)]).collect();
        counts.open_edges = open_edges(&vertices, &triangles);
        let warnings = warnings(obj, keep);
        Ok(Self { keep, vertices, fraction_bits: grid.fraction_bits, triangles, counts, warnings })
    }

    /// What vertices have.
    #[must_use]
    pub const fn keep(&self) -> Keep {
        self.keep
    }

    /// Vertices, up to 65,536, most used first.
    #[must_use]
    pub fn vertices(&self) -> &[ModelVertex] {
        &self.vertices
    }

    /// Bits of fraction of a position, 0 to 31: a position is off by up to half of `2^-fraction_bits` along each axis.
    #[must_use]
    pub const fn fraction_bits(&self) -> u32 {
        self.fraction_bits
    }

    /// How far a position may be from the file's, along each axis, in its units.
    #[must_use]
    pub fn rounding(&self) -> f64 {
        0.5 / scale(self.fraction_bits)
    }

    /// Three indices a triangle, at least one triangle.
    #[must_use]
    pub fn triangles(&self) -> &[[u16; 3]] {
        &self.triangles
    }

    /// What became of the file's faces.
    #[must_use]
    pub const fn counts(&self) -> Counts {
        self.counts
    }

    /// What was skipped though it shows.
    #[must_use]
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// What a planner is told of the model.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        Bounds::of(&self.vertices, &self.triangles, self.fraction_bits)
    }

    /// For [`hither::Mesh::try_new`].
    #[must_use]
    pub fn positions(&self) -> Vec<[i16; 3]> {
        self.vertices.iter().map(|vertex| vertex.position).collect()
    }

    /// Attributes for [`hither::Lit`].
    #[must_use]
    pub fn normal_colors(&self) -> Vec<NormalColor> {
        let attribute = |&ModelVertex { normal, color, .. }: &_| NormalColor { normal, color };
        self.vertices.iter().map(attribute).collect()
    }

    /// Attributes for [`hither::Textured`].
    #[must_use]
    pub fn coordinates(&self) -> Vec<[I16F16; 2]> {
        self.vertices.iter().map(|vertex| vertex.coordinate.map(I16F16::from_bits)).collect()
    }
}

fn is_thin([a, b, c]: [[i16; 3]; 3]) -> bool {
    let [a, b, c] = [a, b, c].map(|p| p.map(i64::from));
    let [u, v] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
    u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0]
}

fn open_edges(vertices: &[ModelVertex], triangles: &[[u16; 3]]) -> usize {
    let mut sides: HashMap<[[i16; 3]; 2], i64> = HashMap::new();
    for &[a, b, c] in triangles {
        for edge in [[a, b], [b, c], [c, a]] {
            let [from, to] = edge.map(|vertex| vertices[usize::from(vertex)].position);
            if from < to {
                *sides.entry([from, to]).or_default() += 1;
            } else {
                *sides.entry([to, from]).or_default() -= 1;
            }
        }
    }
    sides.values().filter(|&&side| side != 0).count()
}

/// The reader's warnings, and those about attributes that are kept.
fn warnings(obj: &Obj, keep: Keep) -> Vec<Warning> {
    let mut warnings = obj.warnings.clone();
    if keep == Keep::Textured {
        return warnings;
    }
    let corners =
        || obj.faces.iter().flat_map(|face| face.corners.iter().map(|corner| (face.line, corner)));
    let colored =
        |(_, corner): &(usize, &crate::obj::Corner)| obj.positions[corner.position].color.is_some();
    let plain = corners().filter(|corner| !colored(corner)).map(|(line, _)| line);
    if corners().any(|corner| colored(&corner)) {
        warn(&mut warnings, plain, "a corner without a colour, where others have one, is white");
    }
    let no_direction = |normal: usize| obj.normals[normal].iter().all(|&v| v == 0.0);
    let zero = corners()
        .filter(|(_, corner)| corner.normal.is_some_and(no_direction))
        .map(|(line, _)| line);
    warn(&mut warnings, zero, "a corner with a normal of length 0 has one made from its faces");
    warnings
}

fn warn(warnings: &mut Vec<Warning>, mut lines: impl Iterator<Item = usize>, what: &str) {
    if let Some(line) = lines.next() {
        warnings.push(Warning { line, times: 1 + lines.count(), what: what.to_owned() });
    }
}
