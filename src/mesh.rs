//! Meshes: borrowed vertices, attributes and indices, and the vertex stage that turns them into
//! clip space.

mod light;
mod neighbours;

pub use light::{Lit, NormalColor};

use crate::transform::{Mat4, ModelPosition, ShortMat4};
use crate::vertex::ClipVertex;
use fixed::types::I16F16;

/// A position as a mesh stores it: three integers, in fractions of a model unit.
pub trait StoredPosition: Copy + core::fmt::Debug {
    /// The raw coordinates.
    fn raw(&self) -> [i32; 3];
}

impl StoredPosition for [i16; 3] {
    #[inline]
    fn raw(&self) -> [i32; 3] {
        self.map(i32::from)
    }
}

impl StoredPosition for [i32; 3] {
    #[inline]
    fn raw(&self) -> [i32; 3] {
        *self
    }
}

/// An indexed triangle mesh over borrowed data, which can all be in flash: positions `P`
/// (`[i16; 3]` or `[i32; 3]`), one attribute `A` a vertex (whatever the vertex stage reads), and
/// three indices a triangle.
///
/// ```
/// use hither::Mesh;
///
/// /// A unit square: coordinates are halves, `2^1` to a unit.
/// static SQUARE: Mesh<[i16; 3], ()> = match Mesh::try_new(
///     &[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
///     1,
///     &[(); 4],
///     &[[0, 1, 2], [0, 2, 3]],
/// ) {
///     Ok(mesh) => mesh,
///     Err(_) => panic!("the square's indices"),
/// };
/// assert_eq!(SQUARE.triangles().len(), 2);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a, P, A> {
    positions: &'a [P],
    fraction_bits: u32,
    attributes: &'a [A],
    triangles: &'a [[u16; 3]],
}

impl<'a, P, A> Mesh<'a, P, A> {
    /// A mesh whose positions have `fraction_bits` bits of fraction: stored coordinate 1 is
    /// `2^-fraction_bits` model units. Indices are checked here, once.
    ///
    /// # Errors
    ///
    /// [`MeshError`] where an index is out of range (the first one), the numbers of positions and
    /// attributes differ, or `fraction_bits` is over 31.
    pub const fn try_new(
        positions: &'a [P],
        fraction_bits: u32,
        attributes: &'a [A],
        triangles: &'a [[u16; 3]],
    ) -> Result<Self, MeshError> {
        if fraction_bits > 31 {
            return Err(MeshError::Fraction { bits: fraction_bits });
        }
        if positions.len() != attributes.len() {
            let (positions, attributes) = (positions.len(), attributes.len());
            return Err(MeshError::Attributes { positions, attributes });
        }
        let mut rest = triangles;
        while let Some(([p, q, r], others)) = rest.split_first() {
            let vertices = positions.len();
            let triangle = triangles.len() - rest.len();
            rest = others;
            if *p as usize >= vertices {
                return Err(MeshError::Index { triangle, index: *p, vertices });
            }
            if *q as usize >= vertices {
                return Err(MeshError::Index { triangle, index: *q, vertices });
            }
            if *r as usize >= vertices {
                return Err(MeshError::Index { triangle, index: *r, vertices });
            }
        }
        Ok(Self { positions, fraction_bits, attributes, triangles })
    }

    /// Vertices: as many entries as a cache that holds all of them has.
    #[must_use]
    pub const fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Three indices a triangle, each below [`vertex_count`](Self::vertex_count).
    #[must_use]
    pub const fn triangles(&self) -> &'a [[u16; 3]] {
        self.triangles
    }
}

impl<P: StoredPosition, A> Mesh<'_, P, A> {
    /// Positions and attributes of the vertices from `first` on.
    #[inline]
    pub(crate) fn vertices(&self, first: usize) -> impl Iterator<Item = (ModelPosition, &A)> {
        let positions = self.positions.get(first..).unwrap_or_default().iter();
        let attributes = self.attributes.get(first..).unwrap_or_default();
        positions.zip(attributes).map(|(position, attribute)| {
            let raw = position.raw();
            (ModelPosition { raw, fraction_bits: self.fraction_bits }, attribute)
        })
    }
}

/// A mesh's data do not fit together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum MeshError {
    /// An index names no vertex.
    Index {
        /// Which triangle, from 0.
        triangle: usize,
        /// The index.
        index: u16,
        /// How many vertices there are.
        vertices: usize,
    },
    /// There is not one attribute a position.
    Attributes {
        /// Positions there are.
        positions: usize,
        /// Attributes there are.
        attributes: usize,
    },
    /// There is not one entry a triangle for its neighbours, or there are more triangles than can be named.
    Neighbours {
        /// Triangles there are.
        triangles: usize,
        /// Entries there are.
        entries: usize,
    },
    /// Positions have too many fraction bits.
    Fraction {
        /// Bits asked for; at most 31.
        bits: u32,
    },
}

impl core::fmt::Display for MeshError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Index { triangle, index, vertices } => {
                write!(
                    f,
                    "triangle {triangle} has index {index}, but there are {vertices} vertices"
                )
            }
            Self::Attributes { positions, attributes } => {
                write!(f, "{attributes} attributes for {positions} positions: one each is needed")
            }
            Self::Neighbours { triangles, entries } => {
                write!(
                    f,
                    "{entries} entries for the neighbours of {triangles} triangles: one each is needed, \
                     of up to 65535"
                )
            }
            Self::Fraction { bits } => {
                write!(f, "positions with {bits} fraction bits: at most 31")
            }
        }
    }
}

impl core::error::Error for MeshError {}

/// The vertex stage: from a mesh's vertex to clip space and `N` varyings. The user's to replace:
/// skinning, waves, light.
///
/// Called once a vertex that is in the cache, once a corner otherwise. A [`Mat4`] is one (it passes
/// attributes on), and so is [`Lit`](crate::Lit).
///
/// ```
/// use hither::{ClipVertex, I16F16, Mat4, ModelPosition, VertexStage};
///
/// /// Waves along x; height is the varying.
/// struct Waves(Mat4);
///
/// impl VertexStage<(), 1> for Waves {
///     fn vertex(&self, mut position: ModelPosition, _: &()) -> (ClipVertex, [I16F16; 1]) {
///         let phase = position.raw[0] & 0xff;
///         position.raw[1] += (phase * (256 - phase)) >> 8;
///         let height = I16F16::from_bits(position.raw[1]);
///         (self.0.transform(position), [height])
///     }
/// }
/// ```
pub trait VertexStage<A, const N: usize> {
    /// The vertex in clip space, and its varyings.
    fn vertex(&self, position: ModelPosition, attribute: &A) -> (ClipVertex, [I16F16; N]);
}

/// An attribute that is varyings as it stands.
pub trait AsVaryings<const N: usize> {
    /// The varyings.
    fn varyings(&self) -> [I16F16; N];
}

impl AsVaryings<0> for () {
    #[inline]
    fn varyings(&self) -> [I16F16; 0] {
        []
    }
}

impl<const N: usize> AsVaryings<N> for [I16F16; N] {
    #[inline]
    fn varyings(&self) -> Self {
        *self
    }
}

/// Bytes from 0 to 255 as `[0, 1]`.
impl<const N: usize> AsVaryings<N> for [u8; N] {
    #[inline]
    fn varyings(&self) -> [I16F16; N] {
        self.map(unit)
    }
}

/// A byte of 0 to 255 as `[0, 1]`, both ends exact, within half a raw step.
#[inline]
pub(crate) fn unit(byte: u8) -> I16F16 {
    // 65536 / 255 = 257 + 1/255.
    let byte = i32::from(byte);
    I16F16::from_bits(byte * 257 + (byte >> 7))
}

impl<A: AsVaryings<N>, const N: usize> VertexStage<A, N> for Mat4 {
    #[inline(always)]
    fn vertex(&self, position: ModelPosition, attribute: &A) -> (ClipVertex, [I16F16; N]) {
        (self.transform(position), attribute.varyings())
    }
}

impl<A: AsVaryings<N>, const N: usize> VertexStage<A, N> for ShortMat4 {
    #[inline(always)]
    fn vertex(&self, position: ModelPosition, attribute: &A) -> (ClipVertex, [I16F16; N]) {
        (self.transform(position), attribute.varyings())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn indices_are_checked_once() {
        let positions = [[0i16; 3]; 3];
        let mesh = |t: &'static [[u16; 3]]| Mesh::try_new(&positions, 4, &[(); 3], t).err();
        assert_eq!(mesh(&[[0, 1, 2], [2, 1, 0]]), None);
        assert_eq!(mesh(&[]), None);
        for bad in [&[[0, 1, 2], [3, 0, 0]], &[[0, 1, 2], [0, 3, 0]], &[[0, 1, 2], [0, 0, 3]]] {
            let error = mesh(bad).unwrap();
            assert_eq!(error.to_string(), "triangle 1 has index 3, but there are 3 vertices");
        }
        let error = Mesh::try_new(&positions, 4, &[(); 2], &[]).unwrap_err();
        assert_eq!(error, MeshError::Attributes { positions: 3, attributes: 2 });
        assert!(Mesh::try_new(&positions, 32, &[(); 3], &[]).is_err());
    }

    #[test]
    fn bytes_are_the_nearest_fraction() {
        for byte in 0..=255u8 {
            let exact = f64::from(byte) / 255.0 * 65536.0;
            assert!((f64::from(unit(byte).to_bits()) - exact).abs() <= 0.5 + 1e-9, "{byte}");
        }
    }
}
