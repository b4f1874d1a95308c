//! What the fuzz targets share: numbers that find edges, places to draw, a target that checks
//! every write, and coverage in 128-bit integers.

pub mod cover;
pub mod matrix;
pub mod number;
pub mod place;
pub mod target;
