//! Speed against accuracy: scenes made to hurt, and points of the knobs that draw them, the same on every instruction set.
//!
//! All are 160 x 120 pixels of RGB565, from model space on, by a mesh of which every vertex is transformed once.
//!
//! | scene | what hurts |
//! | --- | --- |
//! | `card` | nothing: one large quad in perspective, `w` 1 to 3, that costs are taken from |
//! | `torus` | nothing: a model of 1024 triangles |
//! | `floor` | long thin triangles to the horizon, 60 repeats of a texture |
//! | `wall` | a corridor with the camera going through its wall |
//! | `range` | `w` of 1 : 4064 within a triangle |
//! | `specks` | triangles of less than a pixel |
//! | `repeat` | 200 repeats of a texture on a quad |
//! | `steep` | planes seen nearly edge-on: all depths within some pixels |

mod draw;
mod geometry;
mod knobs;
mod points;
mod scene;

pub use draw::{Depths, Drawn, HEIGHT, PIXELS, WIDTH, draw_onto, picture, textured};
pub use geometry::{Attribute, Geometry, TRIANGLES, VERTICES};
pub use knobs::{DepthKnob, Knobs, Named, Of, PresetPoint, Stage};
pub use points::{Visitor, more, quick};
pub use scene::Scene;
