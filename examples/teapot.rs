//! The spinning teapot.
fn main() {}
