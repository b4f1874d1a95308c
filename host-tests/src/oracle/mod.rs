//! What the rasterizer must answer, worked out a second time from its numeric contract.
//!
//! Nothing here imports the library. Coverage and clip planes are exact (integers and rationals),
//! attributes and depth are exact until the last division, which is done in `f64`.
//!
//! | file | what |
//! |---|---|
//! | `line` | which pixels a line draws |
//! | `linear` | viewports, spaces, parts, and integer linear functions over the pixels |
//! | `coverage` | which pixels a triangle covers |
//! | `interpolate` | attributes, `1/w` and depth at a pixel |
//! | `clip` | on which side of a plane the surface at a pixel lies |
//! | `rng` | seeded random numbers |
//! | `generate` | seeded nasty triangles and viewports |
//! | `mesh` | flat meshes and fans, with the invariant each must meet |
//! | `closed` | closed meshes, seen from outside, from the side and from inside |

pub mod clip;
pub mod closed;
pub mod coverage;
pub mod generate;

pub mod interpolate;
pub mod line;
pub mod linear;
pub mod mesh;
pub mod rng;

pub use clip::{PlaneFunction, PlaneSide};
pub use closed::{Eye, Solid, closed};
pub use coverage::{ExactTriangle, covers_big};
pub use generate::{Category, GRID, random_viewport, triangle};
pub use interpolate::{PerspectiveFunction, ScreenFunction, Surface, scale_of};
pub use line::{ExactLine, LinePixel};
pub use linear::{Part, RationalVertex, Space, Vertex, Viewport, whole};
pub use mesh::{FanCentre, Invariant, Mesh, Sheet, fan, sheet};
pub use rng::Rng;
