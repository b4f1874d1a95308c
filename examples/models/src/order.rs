//! In which order a mesh's triangles and vertices are stored.
//!
//! Triangles that share vertices follow each other ([`triangles`]), so that what they read of flash or of the cache was read just
//! before. Vertices are numbered by how many corners use them, most first ([`vertices`]), because [`hither::Frame::draw`]
//! transforms the first `n` vertices once, for a cache of `n`, and those beyond once a corner. With `c` corners there are
//! `n + c - (corners of the first n)` transforms, the least for every `n` when the most used come first.

/// Vertices that are taken to be at hand when triangles are ordered.
const AT_HAND: usize = 16;

/// An order of triangles in which vertices are used again soon, by "tipsify" (Sander, Nehab and Barczak 2007, "Fast Triangle
/// Reordering for Vertex Locality and Reduced Overdraw", section 3): all triangles round a vertex, then round one of theirs
/// that is still at hand and soon done; linear in time. Corners keep their order.
#[must_use]
pub fn triangles(triangles: &[[u16; 3]], vertex_count: usize) -> Vec<[u16; 3]> {
    let around = Around::new(triangles, vertex_count);
    let mut live: Vec<usize> =
        (0..vertex_count).map(|vertex| around.triangles(vertex).len()).collect();
    // When a vertex came to hand; the clock begins where none is.
    let mut stamps = vec![0; vertex_count];
    let mut clock = AT_HAND + 1;
    let mut done = vec![false; triangles.len()];
    let mut ordered = Vec::with_capacity(triangles.len());
    let (mut dead_ends, mut cursor) = (Vec::new(), 0);
    let mut centre = (vertex_count > 0).then_some(0);
    while let Some(vertex) = centre {
        let mut ring: Vec<usize> = Vec::new();
        for &place in around.triangles(vertex) {
            if std::mem::replace(&mut done[place], true) {
                continue;
            }
            ordered.push(triangles[place]);
            for corner in triangles[place].map(usize::from) {
                dead_ends.push(corner);
                ring.push(corner);
                live[corner] -= 1;
                if clock - stamps[corner] > AT_HAND {
                    stamps[corner] = clock;
                    clock += 1;
                }
            }
        }
        // The one that has been at hand longest and will be to its end: each of its triangles brings up to two others.
        let age = |corner: usize| {
            let age = clock - stamps[corner];
            if age + 2 * live[corner] <= AT_HAND { age } else { 0 }
        };
        let mut best: Option<usize> = None;
        for corner in ring.into_iter().filter(|&corner| live[corner] > 0) {
            if best.is_none_or(|best| age(corner) > age(best)) {
                best = Some(corner);
            }
        }
        centre = best.or_else(|| {
            while let Some(corner) = dead_ends.pop() {
                if live[corner] > 0 {
                    return Some(corner);
                }
            }
            cursor = (cursor..vertex_count).find(|&corner| live[corner] > 0)?;
            Some(cursor)
        });
    }
    ordered
}

/// An order of vertices, most used first, of equally used ones the first that a triangle names; those that no triangle names are
/// left out. Returns old numbers by new ones.
#[must_use]
pub fn vertices(triangles: &[[u16; 3]], vertex_count: usize) -> Vec<u16> {
    let uses = uses(triangles, vertex_count);
    let mut order = by_first_use(triangles, vertex_count);
    // Stable.
    order.sort_by_key(|&vertex| std::cmp::Reverse(uses[usize::from(vertex)]));
    order
}

/// The order in which triangles name vertices first, for comparison. Returns old numbers by new ones.
#[must_use]
pub fn by_first_use(triangles: &[[u16; 3]], vertex_count: usize) -> Vec<u16> {
    let mut seen = vec![false; vertex_count];
    let first = |vertex: &u16| !std::mem::replace(&mut seen[usize::from(*vertex)], true);
    triangles.iter().flatten().copied().filter(first).collect()
}

/// Triangles by new numbers of their vertices, given the old ones by new ones.
#[must_use]
pub fn renumber(triangles: &[[u16; 3]], order: &[u16]) -> Vec<[u16; 3]> {
    let most = order.iter().copied().max().map_or(0, |most| usize::from(most) + 1);
    let mut numbers = vec![0; most];
    for (number, &vertex) in (0..=u16::MAX).zip(order) {
        numbers[usize::from(vertex)] = number;
    }
    triangles.iter().map(|triangle| triangle.map(|vertex| numbers[usize::from(vertex)])).collect()
}

/// Vertices that [`hither::Frame::draw`] transforms for a mesh, with a cache of `cached`.
#[must_use]
pub fn transforms(triangles: &[[u16; 3]], vertex_count: usize, cached: usize) -> usize {
    let cached = cached.min(vertex_count);
    cached + triangles.iter().flatten().filter(|&&vertex| usize::from(vertex) >= cached).count()
}

/// How many corners use each vertex.
fn uses(triangles: &[[u16; 3]], vertex_count: usize) -> Vec<usize> {
    let mut uses = vec![0; vertex_count];
    for &vertex in triangles.iter().flatten() {
        uses[usize::from(vertex)] += 1;
    }
    uses
}

/// The triangles round each vertex: one with it twice is there twice.
struct Around {
    starts: Vec<usize>,
    places: Vec<usize>,
}

impl Around {
    fn new(triangles: &[[u16; 3]], vertex_count: usize) -> Self {
        let mut starts = vec![0];
        let mut sum = 0;
        starts.extend(uses(triangles, vertex_count).into_iter().map(|uses| {
            sum += uses;
            sum
        }));
        let (mut ends, mut places) = (starts.clone(), vec![0; sum]);
        for (place, triangle) in triangles.iter().enumerate() {
            for corner in triangle.map(usize::from) {
                places[ends[corner]] = place;
                ends[corner] += 1;
            }
        }
        Self { starts, places }
    }

    fn triangles(&self, vertex: usize) -> &[usize] {
        &self.places[self.starts[vertex]..self.starts[vertex + 1]]
    }
}

#[cfg(test)]
mod tests;
