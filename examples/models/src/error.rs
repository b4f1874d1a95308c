//! What may be wrong with an OBJ.

use std::fmt;

/// A model cannot be read: what is wrong, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjError {
    /// The line of the file, from 1. A statement that goes on over several lines is where it begins.
    pub line: usize,
    /// What is wrong there.
    pub problem: Problem,
}

/// What is wrong with a line.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// A byte begins no character of UTF-8.
    Encoding {
        /// The byte.
        byte: u8,
    },
    /// Not a number, or not a finite one.
    Number {
        /// What is there, escaped, the end of long ones left out.
        text: String,
    },
    /// A statement has too few or too many numbers.
    Count {
        /// Its keyword.
        keyword: &'static str,
        /// How many it takes.
        takes: &'static str,
        /// How many there are.
        got: usize,
    },
    /// A channel of a vertex colour is not 0 to 1.
    Color {
        /// The channel's value.
        value: f64,
    },
    /// A corner of a face is none of `v`, `v/vt`, `v//vn`, `v/vt/vn`.
    Corner {
        /// What is there, escaped, the end of long ones left out.
        text: String,
    },
    /// An index is 0, or names what the file does not have.
    Index {
        /// What it is an index of: positions, texture coordinates or normals.
        of: &'static str,
        /// The index as it stands.
        index: i64,
        /// How many there are: all of the file for a positive index, those before the face for a negative one.
        count: usize,
    },
    /// A face has fewer than three corners.
    Corners {
        /// How many it has.
        got: usize,
    },
    /// Some corners of a face have a part that others do not.
    Mixed {
        /// The part: texture coordinates or normals.
        part: &'static str,
    },
    /// A position does not fit 16 bits with no bit of fraction.
    Position {
        /// The coordinate.
        value: f64,
    },
    /// A texture coordinate does not fit Q16.16.
    Coordinate {
        /// The coordinate.
        value: f64,
    },
    /// A face has no texture coordinates, but its model is to be textured.
    Untextured,
    /// A corner needs one vertex more than indices of 16 bits can name.
    Vertices,
    /// The file ends without a face.
    Faceless,
    /// The file ends, and none of its faces has a triangle of three different corners on the grid.
    Flat {
        /// How many triangles there were.
        triangles: usize,
    },
}

/// The most vertices that indices of 16 bits can name.
pub(crate) const MAX_VERTICES: usize = 1 << 16;

impl fmt::Display for ObjError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.problem)
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Encoding { byte } => write!(f, "byte 0x{byte:02x} is not UTF-8 text"),
            Self::Number { text } => write!(f, "`{text}` is not a finite number"),
            Self::Count { keyword, takes, got } => {
                write!(f, "`{keyword}` has {got} numbers: it takes {takes}")
            }
            Self::Color { value } => {
                write!(f, "a vertex colour has a channel of {value}: they are 0 to 1")
            }
            Self::Corner { text } => {
                write!(f, "`{text}` is not a corner: v, v/vt, v//vn or v/vt/vn")
            }
            Self::Index { of, index: 0, .. } => {
                write!(f, "index 0 of {of}: they count from 1, or from -1 backwards")
            }
            Self::Index { of, index, count } if *index < 0 => {
                write!(f, "index {index} of {of}, but there are {count} before it")
            }
            Self::Index { of, index, count } => {
                write!(f, "index {index} of {of}, but there are {count}")
            }
            Self::Corners { got } => write!(f, "a face with {got} corners: it takes 3 or more"),
            Self::Mixed { part } => write!(f, "a face with {part} at some corners only"),
            Self::Position { value } => {
                write!(f, "coordinate {value} does not fit 16 bits: at most 32767 either way")
            }
            Self::Coordinate { value } => {
                write!(
                    f,
                    "texture coordinate {value} does not fit Q16.16: at most 32767 either way"
                )
            }
            Self::Untextured => {
                f.write_str("a face without texture coordinates, but there is a texture")
            }
            Self::Vertices => {
                write!(
                    f,
                    "this face needs one vertex more than {MAX_VERTICES}, the most there can be"
                )
            }
            Self::Faceless => f.write_str("the file ends without a face (`f`)"),
            Self::Flat { triangles } => {
                write!(
                    f,
                    "the file ends, and on the grid none of its {triangles} triangles has three corners"
                )
            }
        }
    }
}

impl std::error::Error for ObjError {}
