//! embedded-graphics in both directions: our triangles on its displays, its text and shapes in our buffers.

mod band;
mod calls;
mod display;
mod framebuffer;
mod mock;
mod picture;
mod shapes;
mod simulator;
mod triangles;
