//! Corners to vertices: quantised as they are stored, and equal ones made one.

use std::collections::HashMap;

use crate::error::{MAX_VERTICES, ObjError, Problem};
use crate::normals::{of_faces, unit};
use crate::obj::{Corner, Face, Obj};

/// Which attributes a model's vertices keep: what is not kept does not keep corners apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// Normals and colours, for [`hither::Lit`].
    Lit,
    /// Texture coordinates, for [`hither::Textured`].
    Textured,
    /// All of them.
    LitTextured,
}

/// A vertex as it is stored. What is not kept is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ModelVertex {
    /// In units of `2^-fraction_bits`.
    pub position: [i16; 3],
    /// Of length 127, or 0 where its faces have no direction.
    pub normal: [i8; 3],
    /// Red, green and blue: white where the file has no colour.
    pub color: [u8; 3],
    /// u and v in Q16.16, v downwards.
    pub coordinate: [i32; 2],
}

/// The grid that positions are rounded to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    pub(crate) fraction_bits: u32,
}

/// The largest stored coordinate, in either direction.
const LARGEST: f64 = 32767.0;

impl Grid {
    /// The finest that all corners fit.
    pub(crate) fn of(obj: &Obj) -> Result<Self, ObjError> {
        let mut largest = 0.0_f64;
        for corner in obj.faces.iter().flat_map(|face| &face.corners) {
            let position = &obj.positions[corner.position];
            for value in position.at {
                if value.abs().round() > LARGEST {
                    return Err(ObjError {
                        line: position.line,
                        problem: Problem::Position { value },
                    });
                }
                largest = largest.max(value.abs());
            }
        }
        let fits = |bits: &u32| (largest * scale(*bits)).round() <= LARGEST;
        let fraction_bits = (0..=31).rev().find(fits).unwrap_or(0);
        Ok(Self { fraction_bits })
    }

    fn round(self, at: [f64; 3]) -> [i16; 3] {
        // In range, by `of`.
        at.map(|value| (value * scale(self.fraction_bits)).round() as i16)
    }
}

/// Steps of a grid in a unit.
pub(crate) fn scale(fraction_bits: u32) -> f64 {
    f64::from(1_u32 << fraction_bits)
}

/// Makes vertices of corners.
pub(crate) struct Welder<'a> {
    obj: &'a Obj,
    keep: Keep,
    grid: Grid,
    /// For positions whose corners have no normal; empty until one is asked for.
    made_normals: Vec<[f64; 3]>,
    places: HashMap<ModelVertex, u16>,
    pub(crate) vertices: Vec<ModelVertex>,
}

impl<'a> Welder<'a> {
    pub(crate) fn new(obj: &'a Obj, keep: Keep, grid: Grid) -> Self {
        Self {
            obj,
            keep,
            grid,
            made_normals: Vec::new(),
            places: HashMap::new(),
            vertices: Vec::new(),
        }
    }

    /// A face's corners as they would be stored.
    pub(crate) fn corners(&mut self, face: &Face) -> Result<Vec<ModelVertex>, ObjError> {
        let corners = face.corners.iter().map(|corner| self.corner(corner));
        let corners = corners.collect::<Result<_, _>>();
        corners.map_err(|(line, problem)| ObjError { line: line.unwrap_or(face.line), problem })
    }

    fn corner(&mut self, corner: &Corner) -> Result<ModelVertex, (Option<usize>, Problem)> {
        let position = &self.obj.positions[corner.position];
        let mut vertex =
            ModelVertex { position: self.grid.round(position.at), ..ModelVertex::default() };
        if self.keep != Keep::Textured {
            let given = corner.normal.and_then(|normal| unit(self.obj.normals[normal]));
            let normal = given.unwrap_or_else(|| self.made_normal(corner.position));
            vertex.normal = normal.map(|v| (v * 127.0).round() as i8);
            vertex.color =
                position.color.map_or([255; 3], |color| color.map(|v| (v * 255.0).round() as u8));
        }
        if self.keep != Keep::Lit {
            let place = corner.coordinate.ok_or((None, Problem::Untextured))?;
            let coordinate = &self.obj.coordinates[place];
            let [u, v] = coordinate.at;
            for value in [u, 1.0 - v] {
                if value.abs() > LARGEST {
                    return Err((Some(coordinate.line), Problem::Coordinate { value }));
                }
            }
            vertex.coordinate = [u, 1.0 - v].map(|value| (value * 65536.0).round() as i32);
        }
        Ok(vertex)
    }

    fn made_normal(&mut self, position: usize) -> [f64; 3] {
        if self.made_normals.is_empty() {
            self.made_normals = of_faces(self.obj, scale(self.grid.fraction_bits));
        }
        self.made_normals[position]
    }

    /// The vertex that a corner becomes, an old one where it is equal.
    pub(crate) fn weld(&mut self, corner: ModelVertex, line: usize) -> Result<u16, ObjError> {
        if let Some(&place) = self.places.get(&corner) {
            return Ok(place);
        }
        let place = u16::try_from(self.vertices.len());
        let place = place.map_err(|_| ObjError { line, problem: Problem::Vertices })?;
        debug_assert!(usize::from(place) < MAX_VERTICES);
        self.places.insert(corner, place);
        self.vertices.push(corner);
        Ok(place)
    }
}
