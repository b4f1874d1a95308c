//! The trade of speed against accuracy: what each point of the knobs costs, how far off it is, and what it looks like.

mod canvas;
pub mod csv;
pub mod emulate;
pub mod ideal;
#[cfg(test)]
mod made;
mod number;
pub mod page;
pub mod plot;
pub mod readme;
mod sums;
pub mod survey;

/// The largest and the root of the mean square of an error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stat {
    /// The largest.
    pub max: f64,
    /// The root of the mean square.
    pub rms: f64,
}

/// How far off a point is, over its scenes, in units that a user sees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// Decisions of coverage that differ from the exact triangle's that is not snapped, in a million pixels that it covers.
    pub coverage_ppm: f64,
    /// Pixels inside of a mesh that no triangle covers.
    pub gaps: u64,
    /// Pixels inside of a mesh that are covered once too often.
    pub doubles: u64,
    /// Of a vertex on the screen, in pixels.
    pub position: Stat,
    /// In steps of 16 bits; none where no depth is kept.
    pub depth: Option<Stat>,
    /// In texels of the scenes' textures.
    pub texel: Stat,
    /// Of a colour a vertex, in steps of RGB565.
    pub color: Stat,
    /// The RMS of what the means of 4 x 4 pixels of such colours are off, in steps of RGB565: what is seen as bands.
    pub banding: f64,
    /// Of the scenes' pictures against the references, in dB; infinite where they are equal.
    pub psnr: f64,
}

/// What a point costs on one instruction set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// `m4f`, `m0` and so on.
    pub isa: &'static str,
    /// Instructions a pixel of a large textured triangle in perspective.
    pub textured_pixel: f64,
    /// Instructions a pixel of a large triangle with a colour a vertex.
    pub shaded_pixel: f64,
    /// Instructions a triangle of a small mesh with a colour a vertex, from model space on, with all its pixels.
    pub triangle: f64,
    /// Instructions of all scenes together.
    pub scenes: u64,
    /// Bytes of flash over an empty firmware's; of presets only.
    pub flash: Option<u64>,
}

/// A picture of a scene, and what it should be: 8-bit RGB, row after row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The scene's name.
    pub scene: &'static str,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// What was drawn.
    pub drawn: Vec<u8>,
    /// The reference in `f64`, rounded to RGB565.
    pub ideal: Vec<u8>,
    /// In dB; infinite where both are equal.
    pub psnr: f64,
}

/// A point: one choice of every knob.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// All its knobs in a few words: `quick8 every8 packed newton2 depth16 mat32`.
    pub name: String,
    /// A knob and its setting, in the order of the columns.
    pub knobs: Vec<(&'static str, &'static str)>,
    /// The preset's name, if it is one.
    pub preset: Option<&'static str>,
    /// One an instruction set.
    pub costs: Vec<Cost>,
    /// Over the scenes that were asked for.
    pub errors: Errors,
    /// One a scene.
    pub pictures: Vec<Picture>,
}
