//! Which faces of a mesh share an edge.

use super::{Mesh, MeshError, StoredPosition};
use core::mem::take;

/// Positions of an edge's ends, in the face's order.
type Edge = [[i32; 3]; 2];

impl<P: StoredPosition, A> Mesh<'_, P, A> {
    /// Finds the face across each edge of each triangle: `found[t][i]` is that across the edge of triangle `t` from its corner
    /// `i` to the next, and [`u16::MAX`] where there is none.
    ///
    /// Two faces share an edge where its ends have the same positions, in the opposite order; they need not be the same vertices,
    /// which may differ in their attributes. Of more than two the first that are free are taken together; faces with two corners
    /// in one place have no neighbours, and are none. Each face is compared with all after it: that is for the host, or once at
    /// the start.
    ///
    /// ```
    /// # use hither::Mesh;
    /// let square = [[-1i16, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]];
    /// let mesh = Mesh::try_new(&square, 1, &[(); 4], &[[0, 1, 2], [0, 2, 3]])?;
    /// let mut found = [[0; 3]; 2];
    /// mesh.neighbours(&mut found)?;
    /// assert_eq!(found, [[u16::MAX, u16::MAX, 1], [0, u16::MAX, u16::MAX]]);
    /// # Ok::<(), hither::MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MeshError::Neighbours`] where there is not one entry for each of up to 65,535 triangles.
    pub fn neighbours(&self, found: &mut [[u16; 3]]) -> Result<(), MeshError> {
        let (triangles, entries) = (self.triangles.len(), found.len());
        if triangles != entries || triangles > usize::from(u16::MAX) {
            return Err(MeshError::Neighbours { triangles, entries });
        }
        found.fill([u16::MAX; 3]);
        let (mut faces, mut entries) = (self.triangles, found);
        for number in 0..u16::MAX {
            let Some((face, later)) = faces.split_first() else { break };
            let Some((entry, later_entries)) = take(&mut entries).split_first_mut() else { break };
            let others = later.iter().zip(later_entries.iter_mut());
            for (other, (face_after, entry_after)) in (number + 1..).zip(others) {
                self.join((face, number, &mut *entry), (face_after, other, entry_after));
            }
            (faces, entries) = (later, later_entries);
        }
        Ok(())
    }

    /// Names two faces as neighbours across what edges they share, that have none yet.
    fn join(
        &self,
        (face, number, entry): (&[u16; 3], u16, &mut [u16; 3]),
        (other, other_number, other_entry): (&[u16; 3], u16, &mut [u16; 3]),
    ) {
        let Some(edges) = self.edges(*face) else { return };
        let Some(other_edges) = self.edges(*other) else { return };
        for ([from, to], across) in edges.iter().zip(entry) {
            for ([other_from, other_to], back) in other_edges.iter().zip(other_entry.iter_mut()) {
                let free = *across == u16::MAX && *back == u16::MAX;
                if free && from == other_to && to == other_from {
                    (*across, *back) = (other_number, number);
                }
            }
        }
    }

    /// The edges of a face, unless two corners are in one place.
    fn edges(&self, face: [u16; 3]) -> Option<[Edge; 3]> {
        let [a, b, c] = face.map(|i| self.positions.get(usize::from(i)).map(P::raw));
        let (a, b, c) = (a?, b?, c?);
        (a != b && b != c && c != a).then_some([[a, b], [b, c], [c, a]])
    }
}
