//! Ways of W6 to a display: whole, or in bands, each drawn anew or from bins.
//!
//! Each draws the picture of W6f or W6g, to the bit. A band takes its own rows of the whole picture's buffers, which were
//! cleared before, so that all of it is counted in one: what a band's frame takes, the bins, and the drawing.

use super::{Buffers, CACHE, Preset, SIDE, Workload};
use crate::SceneError;
use crate::checksum::Checksum;
use crate::torus;
use hither::{
    Bins, Cull, DepthBuffer, FaceColors, Fragment, Frame, Gouraud, Hither, Interpolates, Mat4,
    Mesh, Rgb565, Vertex, VertexStage, Viewport,
};

/// Entries of the bins: of the torus 456 triangles look front before they are snapped, and some more after.
pub const BINNED: usize = 480;

/// How the picture gets to a display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    /// As tables have it.
    pub name: &'static str,
    /// Rows of a band.
    pub rows: u32,
    /// From bins, or each band with all vertices and triangles anew.
    pub binned: bool,
}

impl Output {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self { name: "frame", rows: SIDE, binned: false },
        Self { name: "bands-80", rows: 80, binned: false },
        Self { name: "bins-80", rows: 80, binned: true },
        Self { name: "bands-40", rows: 40, binned: false },
        Self { name: "bins-40", rows: 40, binned: true },
        Self { name: "bands-8", rows: 8, binned: false },
        Self { name: "bins-8", rows: 8, binned: true },
    ];

    /// Bytes of colour and depth of a band, of vertices of `N` varyings, and of the bins where there are some.
    #[must_use]
    pub const fn ram<T: Preset, const N: usize>(self) -> usize {
        let band = 2 * 2 * (SIDE * self.rows) as usize;
        let bins = if self.binned { size_of::<Bins<BINNED>>() } else { 0 };
        band + size_of::<[Vertex<T, N>; CACHE]>() + bins
    }
}

/// What W6's torus is drawn with: a colour a face, or a colour a vertex.
pub trait Colors<const N: usize>: Fragment<Rgb565, N> {
    /// W6f or W6g.
    const WORKLOAD: Workload;
    /// What its vertices have.
    type Attribute: 'static;
    /// The torus with it.
    const MESH: &'static Mesh<'static, [i32; 3], Self::Attribute>;
}

impl Colors<0> for FaceColors<'_, Rgb565> {
    const WORKLOAD: Workload = Workload::W6f;
    type Attribute = ();
    const MESH: &'static Mesh<'static, [i32; 3], ()> = &torus::BARE_TORUS;
}

impl Colors<3> for Gouraud {
    const WORKLOAD: Workload = Workload::W6g;
    type Attribute = [u8; 3];
    const MESH: &'static Mesh<'static, [i32; 3], [u8; 3]> = &torus::TORUS;
}

/// What drawing needs besides colours and depths.
#[derive(Debug)]
pub struct Store<'a, T: Preset, const N: usize> {
    /// For all vertices.
    pub cache: &'a mut [Vertex<T, N>],
    /// For all triangles that look front.
    pub bins: &'a mut Bins<BINNED>,
}

/// Draws W6 in some colours; what the clock says of all of it, from the matrices on, and the checksum of colours and depths.
///
/// # Errors
///
/// [`SceneError`]: none in practice, the numbers are constants in range.
pub fn draw_output<T, F, const N: usize>(
    output: Output,
    buffers: &mut Buffers<'_>,
    colors: &F,
    store: &mut Store<'_, T, N>,
    clock: impl Fn() -> u32,
) -> Result<(u32, u32), SceneError>
where
    T: Preset,
    F: Colors<N>,
    Hither: Interpolates<N>,
    Mat4: VertexStage<F::Attribute, N>,
{
    buffers.color.fill(0);
    buffers.depth.fill(u16::MAX);
    let start = clock();
    let drawn = draw_bands::<T, F, N>(output, buffers, colors, store);
    let ticks = clock().wrapping_sub(start);
    drawn?;
    let sum = Checksum::new().with_words(buffers.color).with_words(buffers.depth);
    Ok((ticks, sum.value()))
}

/// The counted part.
#[inline(never)]
fn draw_bands<T, F, const N: usize>(
    output: Output,
    buffers: &mut Buffers<'_>,
    colors: &F,
    store: &mut Store<'_, T, N>,
) -> Result<(), SceneError>
where
    T: Preset,
    F: Colors<N>,
    Hither: Interpolates<N>,
    Mat4: VertexStage<F::Attribute, N>,
{
    let transform = torus::transform();
    let transform = transform.as_ref().map_err(|&error| error)?;
    let words = (SIDE * output.rows) as usize;
    let parts = buffers.color.chunks_mut(words).zip(buffers.depth.chunks_mut(words));
    for (band, (color, depth)) in Viewport::new(SIDE, SIDE)?.bands(words)?.zip(parts) {
        let mut frame = Frame::with_viewport(band.framebuffer::<Rgb565>(color)?, band.viewport())
            .with_tier(T::default())
            .with_correction(T::Correction::default())
            .with_hither(torus::HITHER)
            .with_depth(DepthBuffer::try_new(depth, band.width(), band.rows())?)?
            .with_cull(Cull::Back);
        if !output.binned {
            frame.draw(F::MESH, transform, colors, store.cache);
            continue;
        }
        if band.y() == 0 {
            frame.bin(F::MESH, transform, store.cache, store.bins);
        }
        frame.draw_bin(F::MESH, transform, colors, store.cache, store.bins);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::workloads::PIXELS;
    use hither::Quick;
    use std::boxed::Box;
    use std::vec;

    fn sums<F: Colors<N>, const N: usize>(colors: &F) -> std::vec::Vec<u32>
    where
        Hither: Interpolates<N>,
        Mat4: VertexStage<F::Attribute, N>,
    {
        let words = || vec![0_u16; PIXELS].into_boxed_slice().try_into().unwrap();
        let (mut color, mut depth): (Box<[u16; PIXELS]>, Box<[u16; PIXELS]>) = (words(), words());
        let mut buffers = Buffers { color: &mut color, depth: &mut depth };
        let (mut cache, mut bins) = (vec![Vertex::EMPTY; CACHE], Bins::new());
        let mut store = Store::<Quick<8>, N> { cache: &mut cache, bins: &mut bins };
        let mut sum =
            |output| draw_output(output, &mut buffers, colors, &mut store, || 0).unwrap().1;
        let sums = Output::ALL.map(&mut sum).to_vec();
        assert_eq!(bins.unbinned(), 0);
        sums
    }

    #[test]
    fn every_way_is_the_same_picture() {
        let faces = FaceColors::new(&torus::FACE_COLORS).unwrap();
        for sums in [sums(&faces), sums(&Gouraud)] {
            assert!(sums.iter().all(|sum| *sum == sums[0]), "{sums:x?}");
        }
    }
}
