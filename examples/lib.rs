//! Host-side support that the example programs share: pictures and animations on disk, what a display makes of a
//! RGB565 word, and an independent reference renderer in `f64` to measure pictures against,
//! with the spinning teapot drawn by it.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod ideal;
pub mod picture;
pub mod reference;
pub mod rgb565;
