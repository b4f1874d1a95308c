//! The measured workloads: the same on every instruction set, in every tier.
//!
//! All draw 240 x 240 pixels of RGB565, with 16-bit depth where depth is named, into buffers that were cleared before.
//! W1 to W5 start from snapped vertices, whose snap is the workload `snap`; W6 is the whole pipeline, from the matrices
//! and model space on. Every frame has a hither plane and culls backs. One call that is not inlined is counted whole,
//! setup included.
//!
//! | name | work |
//! | --- | --- |
//! | `W1` | one flat triangle of 22,845 pixels |
//! | `W2` | 1000 flat triangles of 45 to 55 pixels in boxes of ±10 |
//! | `W3` | 1000 flat triangles of 3 to 5 pixels in boxes of ±3 |
//! | `W1z` `W2z` `W3z` | the same with interpolated depth, test and write |
//! | `W4` | W1z with a colour a vertex |
//! | `W5` | W1z with a 64 x 64 texture in perspective, `w` 1, 3 and 8 |
//! | `W6f` `W6g` | the [torus](crate::torus) of 1024 triangles, a colour a face and a colour a vertex |
//! | `snap` | 128 of W6's vertices from clip space to the tier's grid |

mod corners;
mod draw;
mod output;
mod texel;

pub use corners::{Corner, DEPTH_ONE, corners};
pub use draw::{
    Buffers, CACHE, COLORS, COORDINATES, SNAPPED, TRIANGLES, draw, draw_flat, face_color, flat,
    flat_deep, gouraud, smooth_flat, snap, snapped, textured, to_be_snapped, torus_flat,
    torus_gouraud, torus_lines,
};
pub use output::{BINNED, Colors, Output, Store, draw_output};
pub use texel::{TEXTURE, TEXTURE_SIDE, texel_of};

use hither::{
    Correction, Exact, Hither, I16F16, Packed, Perspective, PerspectiveEvery, Quick, Tier,
};

/// Width and height of the pictures, in pixels.
pub const SIDE: u32 = 240;

/// Words of colour, and of depth.
pub const PIXELS: usize = (SIDE * SIDE) as usize;

/// `w` 1 of W1 to W5, as the clip space they start from has it: with `w` = 240, pixel corners are whole coordinates.
pub const W_ONE: i32 = SIDE as i32;

/// The hither plane of W1 to W5: `w` = 1.
pub const HITHER: Hither = match Hither::new(I16F16::from_bits(W_ONE << 16)) {
    Ok(hither) => hither,
    Err(_) => panic!("the hither plane is not in front of the eye"),
};

/// A tier with the correction of varyings it is measured with: the same in every workload.
pub trait Preset: Tier {
    /// The tier's name.
    const NAME: &'static str;
    /// How varyings are corrected for perspective.
    type Correction: Correction;
}

impl Preset for Exact {
    const NAME: &'static str = "exact";
    type Correction = Perspective;
}

impl Preset for Quick<4> {
    const NAME: &'static str = "quick4";
    type Correction = Packed<PerspectiveEvery<8>>;
}

impl Preset for Quick<8> {
    const NAME: &'static str = "quick8";
    type Correction = Packed<PerspectiveEvery<8>>;
}

/// A workload; see the [module](self).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the module's table says what each is")]
pub enum Workload {
    W1,
    W2,
    W3,
    W1z,
    W2z,
    W3z,
    W4,
    W5,
    W6f,
    W6g,
    Snap,
}

/// What a workload's cost is divided by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Pixels covered, before depth.
    Pixel,
    /// Triangles given.
    Triangle,
    /// The whole picture.
    Frame,
    /// Vertices.
    Vertex,
}

impl Workload {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::W1,
        Self::W2,
        Self::W3,
        Self::W1z,
        Self::W2z,
        Self::W3z,
        Self::W4,
        Self::W5,
        Self::W6f,
        Self::W6g,
        Self::Snap,
    ];

    /// The name: `W1` to `W6g`, and `snap`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::W1 => "W1",
            Self::W2 => "W2",
            Self::W3 => "W3",
            Self::W1z => "W1z",
            Self::W2z => "W2z",
            Self::W3z => "W3z",
            Self::W4 => "W4",
            Self::W5 => "W5",
            Self::W6f => "W6f",
            Self::W6g => "W6g",
            Self::Snap => "snap",
        }
    }

    /// Whether it tests and writes depth.
    #[must_use]
    pub const fn is_deep(self) -> bool {
        !matches!(self, Self::W1 | Self::W2 | Self::W3 | Self::Snap)
    }

    /// What its cost is divided by.
    #[must_use]
    pub const fn unit(self) -> Unit {
        match self {
            Self::W1 | Self::W1z | Self::W4 | Self::W5 => Unit::Pixel,
            Self::W2 | Self::W3 | Self::W2z | Self::W3z => Unit::Triangle,
            Self::W6f | Self::W6g => Unit::Frame,
            Self::Snap => Unit::Vertex,
        }
    }

    /// Triangles it is given, back faces included.
    #[must_use]
    pub const fn triangles(self) -> usize {
        match self {
            Self::W1 | Self::W1z | Self::W4 | Self::W5 => 1,
            Self::W2 | Self::W3 | Self::W2z | Self::W3z => TRIANGLES,
            Self::W6f | Self::W6g => crate::torus::TRIANGLE_COUNT,
            Self::Snap => 0,
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use hither::Vertex;
    use std::boxed::Box;
    use std::vec;

    /// Pixels that a workload leaves another colour than the background.
    fn drawn<T: Preset>(workload: Workload) -> (usize, u32) {
        let words = || vec![0_u16; PIXELS].into_boxed_slice().try_into().unwrap();
        let (mut color, mut depth): (Box<[u16; PIXELS]>, Box<[u16; PIXELS]>) = (words(), words());
        let mut triangles = vec![[Vertex::<T>::EMPTY; 3]; TRIANGLES];
        let mut cache = vec![Vertex::<T, 3>::EMPTY; CACHE];
        let mut buffers = Buffers { color: &mut color, depth: &mut depth };
        let (_, sum) = draw(workload, &mut buffers, &mut triangles, &mut cache, || 0).unwrap();
        (color.iter().filter(|word| **word != 0).count(), sum)
    }

    #[test]
    fn the_large_triangle_has_its_pixels() {
        for workload in [Workload::W1, Workload::W1z, Workload::W5] {
            assert_eq!(drawn::<Exact>(workload).0, 22_845, "{workload:?}");
            assert_eq!(drawn::<Quick<4>>(workload).0, 22_845, "{workload:?}");
            assert_eq!(drawn::<Quick<8>>(workload).0, 22_845, "{workload:?}");
        }
    }

    #[test]
    fn every_workload_is_another_picture() {
        let mut sums: std::vec::Vec<u32> =
            Workload::ALL.into_iter().map(|workload| drawn::<Quick<8>>(workload).1).collect();
        sums.sort_unstable();
        sums.dedup();
        assert_eq!(sums.len(), Workload::ALL.len());
    }
}
