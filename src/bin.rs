//! Exact bins: which rows each triangle of a mesh reaches, found once a frame, so that a band is drawn from the triangles that
//! reach it and no other.
//!
//! A band is whole rows, and the rows that a triangle reaches are one range (two, where the part behind the eye is drawn
//! too). So a triangle takes one entry of six bytes, however many bands there are and however high they are; a
//! triangle that shows nothing takes none. That the ranges are those of the snapped triangle, cut by its planes and the
//! scissor's sides, and not of its box, is what Olano and Greer (1997, section 7.3) call exact binning.
//!
//! Where the store is full, the triangles from the first without an entry on are tried in every band, after those that have
//! one: so all are drawn in the mesh's order, and the picture is the same, only slower.

use crate::depth::DepthTest;
use crate::draw::{Counts, Frame, Outcome, RowRange};
use crate::fragment::Fragment;
use crate::framebuffer::Target;
use crate::interpolation::{Correction, Interpolates};
use crate::math::unsigned;
use crate::mesh::{Mesh, StoredPosition, VertexStage};
use crate::setup::Tier;
use crate::vertex::Vertex;

/// A face, and rows that it reaches: from `first` to before `end`.
#[derive(Clone, Copy, Debug)]
struct Entry {
    face: u16,
    first: u16,
    end: u16,
}

impl Entry {
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "rows are below Viewport::MAX_SIDE")]
    const fn new(face: u16, (first, end): RowRange) -> Self {
        Self { face, first: unsigned(first) as u16, end: unsigned(end) as u16 }
    }
}

/// Which rows of the picture the triangles of a mesh reach, for up to `N` triangles that show something; 6 bytes each.
///
/// [`Frame::bin`] fills it, and [`Frame::draw_bin`] draws what a frame shows of the picture from it: of a full
/// frame all, of a band those that reach it. It is only read meanwhile, so that two cores can draw bands from the same.
///
/// ```
/// use hither::{Bins, DepthBuffer, Frame, Framebuffer, Gouraud, Hither, I16F16, Mat4, Mesh};
/// use hither::{Rgb565, Vertex, Viewport};
///
/// // Coordinates are in units of 2^-3: 8 is 1, the edge of the picture.
/// let positions = [[-7_i16, -6, 0], [7, -6, 0], [0, -1, 0], [0, 7, 0]];
/// let mesh = Mesh::try_new(&positions, 3, &[[255_u8, 90, 0]; 4], &[[0, 1, 2], [2, 1, 3]])?;
///
/// let picture = Viewport::new(64, 64)?;
/// let (mut color, mut depth) = ([0; 64 * 16], [0_u16; 64 * 16]);
/// let mut bins = Bins::<8>::new();
/// let mut cache = [Vertex::EMPTY; 4];
/// let mut drawn = vec![];
/// for band in picture.bands(color.len())? {
///     let mut frame = Frame::with_viewport(band.framebuffer::<Rgb565>(&mut color)?, band.viewport())
///         .with_hither(Hither::new(I16F16::ONE)?)
///         .with_depth(DepthBuffer::try_new(&mut depth, band.width(), band.rows())?)?;
///     frame.clear(Rgb565::BLACK);
///     if band.y() == 0 {
///         frame.bin(&mesh, &Mat4::IDENTITY, &mut cache, &mut bins);
///     }
///     let counts = frame.draw_bin(&mesh, &Mat4::IDENTITY, &Gouraud, &cache, &bins);
///     drawn.push(counts.drawn);
/// }
/// assert_eq!(drawn, [1, 1, 2, 2]);
/// assert_eq!(bins.unbinned(), 0);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Bins<const N: usize> {
    entries: heapless::Vec<Entry, N>,
    /// Faces of the mesh from the first that has no entry for want of room.
    unbinned: core::ops::Range<usize>,
}

impl<const N: usize> Default for Bins<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> Bins<N> {
    /// No triangles.
    #[must_use]
    pub const fn new() -> Self {
        Self { entries: heapless::Vec::new(), unbinned: 0..0 }
    }

    /// How many triangles had no room: those are tried in every band. 0 where `N` was enough.
    #[must_use]
    pub fn unbinned(&self) -> usize {
        self.unbinned.len()
    }

    /// How many entries are taken, of `N`.
    #[must_use]
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there is no triangle to draw, in no band.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty() && self.unbinned.is_empty()
    }

    /// The faces that reach rows `first` to before `end`, in the mesh's order, each once, and then those without an entry.
    pub fn faces(&self, first: u32, end: u32) -> impl Iterator<Item = usize> {
        let (mut entries, mut last) = (self.entries.iter(), None);
        let reached = core::iter::from_fn(move || {
            loop {
                let entry = entries.next()?;
                // The parts in front of the eye and behind it have an entry each, one after the other.
                if u32::from(entry.first) < end
                    && first < u32::from(entry.end)
                    && last != Some(entry.face)
                {
                    last = Some(entry.face);
                    return last.map(usize::from);
                }
            }
        });
        reached.chain(self.unbinned.clone())
    }

    /// Adds a face with the rows that it reaches, which are below 2^16; `None` where there is no room for it.
    #[inline(always)]
    fn add(&mut self, face: usize, [front, behind]: [RowRange; 2]) -> Option<()> {
        let face = u16::try_from(face).ok()?;
        if behind.0 < behind.1 {
            return self.add_both(face, [front, behind]);
        }
        self.entries.push(Entry::new(face, front)).ok()
    }

    /// Adds a face of which the part behind the eye reaches some rows.
    #[cold]
    fn add_both(&mut self, face: u16, rows: [RowRange; 2]) -> Option<()> {
        let before = self.entries.len();
        for rows in rows.into_iter().filter(|(first, end)| first < end) {
            if self.entries.push(Entry::new(face, rows)).is_err() {
                self.entries.truncate(before);
                return None;
            }
        }
        Some(())
    }
}

impl<C, D, W, T, I, const P: usize> Frame<C, D, W, T, I, P>
where
    C: Target,
    D: DepthTest,
    T: Tier,
    I: Correction,
{
    /// Transforms a mesh's vertices into `cache`, as [`draw`](Self::draw) does, and finds for each triangle which rows of the
    /// viewport's scissor it reaches. Nothing is drawn, and it makes no difference which rows the target holds; its size and
    /// what is kept of depth are not looked at either, but for the types.
    ///
    /// Gives what will become of the triangles: `drawn` are those that reach some row. Where there is no room in `bins` the
    /// rest is not looked at, nor counted: [`Bins::unbinned`].
    pub fn bin<Q, A, S, const N: usize, const B: usize>(
        &self,
        mesh: &Mesh<'_, Q, A>,
        stage: &S,
        cache: &mut [Vertex<T, N, P>],
        bins: &mut Bins<B>,
    ) -> Counts
    where
        Q: StoredPosition,
        S: VertexStage<A, N>,
        W: Interpolates<N>,
    {
        self.transform(mesh, stage, 0, cache);
        bins.entries.clear();
        bins.unbinned = 0..0;
        let mut counts = Counts::default();
        for (face, indices) in mesh.triangles().iter().enumerate() {
            match self.reach_of(mesh, stage, *indices, cache) {
                Ok(rows) if bins.add(face, rows).is_none() => {
                    bins.unbinned = face..mesh.triangles().len();
                    break;
                }
                Ok(_) => counts.add(Outcome::Drawn),
                Err(outcome) => counts.add(outcome),
            }
        }
        counts
    }

    /// The rows that a triangle of a mesh reaches.
    #[inline(always)]
    fn reach_of<Q, A, S, const N: usize>(
        &self,
        mesh: &Mesh<'_, Q, A>,
        stage: &S,
        indices: [u16; 3],
        cache: &[Vertex<T, N, P>],
    ) -> Result<[RowRange; 2], Outcome>
    where
        Q: StoredPosition,
        S: VertexStage<A, N>,
        W: Interpolates<N>,
    {
        let [i, j, k] = indices.map(|index| cache.get(usize::from(index)));
        if let (Some(a), Some(b), Some(c)) = (i, j, k) {
            return self.reach([a, b, c]);
        }
        self.reach_of_uncached(mesh, stage, indices, [i, j, k])
    }

    /// The same where some corners are not in the cache.
    #[inline(never)]
    fn reach_of_uncached<Q, A, S, const N: usize>(
        &self,
        mesh: &Mesh<'_, Q, A>,
        stage: &S,
        indices: [u16; 3],
        cached: [Option<&Vertex<T, N, P>>; 3],
    ) -> Result<[RowRange; 2], Outcome>
    where
        Q: StoredPosition,
        S: VertexStage<A, N>,
        W: Interpolates<N>,
    {
        let [a, b, c] = &self.corners(mesh, stage, indices, cached);
        self.reach([a, b, c])
    }

    /// Draws the triangles of a mesh that reach the rows of the picture that the target holds: the same pixels as
    /// [`draw`](Self::draw) with the same mesh, stage and fragment.
    ///
    /// `cache` and `bins` are as [`bin`](Self::bin) left them, for the same mesh and stage, in a frame of the same type whose
    /// viewport had the same size and scissor. They are only read, so that frames over other bands may draw from
    /// them at the same time.
    pub fn draw_bin<Q, A, S, F, const N: usize, const B: usize>(
        &mut self,
        mesh: &Mesh<'_, Q, A>,
        stage: &S,
        fragment: &F,
        cache: &[Vertex<T, N, P>],
        bins: &Bins<B>,
    ) -> Counts
    where
        Q: StoredPosition,
        S: VertexStage<A, N>,
        F: Fragment<C::Color, N>,
        W: Interpolates<N>,
    {
        let mut counts = Counts::default();
        let (first, end) = self.rows();
        // Not a loop over the two parts in one: that takes more from face to face.
        bins.faces(first, end).for_each(|face| {
            if let Some(indices) = mesh.triangles().get(face) {
                counts.add(self.draw_face(mesh, stage, (face, indices), fragment, cache));
            }
        });
        counts
    }
}
