//! Bezier patches to a welded triangle mesh, at compile time.
//!
//! Two stages, each a `const fn` of its own: [`sample_all`] evaluates every patch on a regular grid, [`weld`] joins
//! the samples that neighbouring patches share and lists the triangles.

use super::patches::{PATCH_COUNT, PATCHES, POINTS};
use super::{FRACTION_BITS, NORMAL_ONE};

/// Segments along each side of a patch.
const SEGMENTS: usize = 4;

/// Samples along each side of a patch.
const SIDE: usize = SEGMENTS + 1;

/// Samples of one patch.
const PATCH_SAMPLES: usize = SIDE * SIDE;

/// Samples of all patches; vertices before welding.
const SAMPLE_COUNT: usize = PATCH_COUNT * PATCH_SAMPLES;

/// Triangles of all patches, with those that have no area because an edge of them is a pole.
const TRIANGLES_MAX: usize = PATCH_COUNT * SEGMENTS * SEGMENTS * 2;

/// Model units per unit of Newell's: the body's radius of 2 becomes 1.
const SCALE: f64 = 0.5;

/// Half of Newell's height, in his units: the middle of the model is here.
const MIDDLE: f64 = 3.15 / 2.0;

/// No vertex: the sample has none yet, or none was found.
const NO_VERTEX: u16 = u16::MAX;

const _: () = assert!(SAMPLE_COUNT < NO_VERTEX as usize, "a vertex index does not fit u16");

/// A point of the surface with its outward normal, in the formats of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sample {
    /// Position in model units, [`FRACTION_BITS`] fraction bits.
    pub(super) position: [i16; 3],
    /// Unit normal, scaled by [`NORMAL_ONE`].
    pub(super) normal: [i8; 3],
}

/// A welded mesh in arrays that are large enough for the unwelded one.
#[derive(Debug)]
pub(super) struct Welded {
    samples: [Sample; SAMPLE_COUNT],
    pub(super) sample_count: usize,
    triangles: [[u16; 3]; TRIANGLES_MAX],
    pub(super) triangle_count: usize,
}

/// Every patch on its grid, patch after patch, row after row.
pub(super) const fn sample_all() -> [Sample; SAMPLE_COUNT] {
    let mut samples = [Sample::ZERO; SAMPLE_COUNT];
    let mut at = 0;
    while at < SAMPLE_COUNT {
        let within = at % PATCH_SAMPLES;
        let row = (within / SIDE) as f64 / SEGMENTS as f64;
        let column = (within % SIDE) as f64 / SEGMENTS as f64;
        let (point, normal) = surface(at / PATCH_SAMPLES, row, column);
        samples[at] =
            Sample { position: quantize_position(point), normal: quantize_normal(normal) };
        at += 1;
    }
    samples
}

/// The point of `patch` at the parameters `row` and `column` (0 to 1), in model space and units, with its outward
/// normal of any length.
pub(super) const fn surface(patch: usize, row: f64, column: f64) -> ([f64; 3], [f64; 3]) {
    let point = blend(patch, bernstein(row), bernstein(column));
    let along_rows = blend(patch, bernstein_slope(row), bernstein(column));
    let mut along_columns = blend(patch, bernstein(row), bernstein_slope(column));
    if dot(along_columns, along_columns) < 1e-12 {
        // On a pole the first row is one point. Next to it the derivative is `row` times the mixed one, which has the
        // limit's direction.
        along_columns = blend(patch, bernstein_slope(row), bernstein_slope(column));
    }
    let [x, y, z] = point;
    let [nx, ny, nz] = cross(along_columns, along_rows);
    // Newell's z is up, ours is y: a rotation, so that orientation stays.
    ([x * SCALE, (z - MIDDLE) * SCALE, -y * SCALE], [nx, nz, -ny])
}

/// The sum of a patch's control points, weighted by rows and columns; Newell's axes and units.
const fn blend(patch: usize, rows: [f64; 4], columns: [f64; 4]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    let mut at = 0;
    while at < 16 {
        let weight = rows[at / 4] * columns[at % 4];
        let [x, y, z] = sum;
        let [px, py, pz] = POINTS[PATCHES[patch][at] as usize];
        sum = [x + weight * px, y + weight * py, z + weight * pz];
        at += 1;
    }
    sum
}

/// The four cubic Bernstein polynomials at `t`.
const fn bernstein(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

/// The derivatives of the four cubic Bernstein polynomials at `t`.
const fn bernstein_slope(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t]
}

const fn dot([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> f64 {
    ax * bx + ay * by + az * bz
}

pub(super) const fn cross([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> [f64; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

/// The square root of a finite positive number, by Newton's iteration (`f64::sqrt` is not `const`).
const fn square_root(value: f64) -> f64 {
    // From above the root the iteration falls until rounding stops it.
    let mut root = if value > 1.0 { value } else { 1.0 };
    loop {
        let next = 0.5 * (root + value / root);
        if next >= root {
            return root;
        }
        root = next;
    }
}

/// The nearest integer, halves away from zero, saturating (`f64::round` is not `const` in the oldest supported Rust).
const fn round_to_i16(value: f64) -> i16 {
    if value < 0.0 { (value - 0.5) as i16 } else { (value + 0.5) as i16 }
}

const fn quantize_position([x, y, z]: [f64; 3]) -> [i16; 3] {
    let one = (1_u32 << FRACTION_BITS) as f64;
    [round_to_i16(x * one), round_to_i16(y * one), round_to_i16(z * one)]
}

const fn quantize_normal(normal: [f64; 3]) -> [i8; 3] {
    let scale = NORMAL_ONE as f64 / square_root(dot(normal, normal));
    let [x, y, z] = normal;
    [round_to_i16(x * scale) as i8, round_to_i16(y * scale) as i8, round_to_i16(z * scale) as i8]
}

impl Sample {
    const ZERO: Self = Self { position: [0; 3], normal: [0; 3] };

    /// Whether two samples are one vertex: the same position and the same normal.
    const fn is(&self, other: &Self) -> bool {
        let [ax, ay, az] = self.position;
        let [bx, by, bz] = other.position;
        let [anx, any, anz] = self.normal;
        let [bnx, bny, bnz] = other.normal;
        ax == bx && ay == by && az == bz && anx == bnx && any == bny && anz == bnz
    }
}

/// Joins equal samples to one vertex and lists the triangles that have an area.
///
/// Where patches meet smoothly their samples round to the same position and the same normal, everywhere (a test holds
/// it: only the rims stay open), so nothing has to be compared with a tolerance.
/// Only samples on the borders of patches are looked up, among those on borders: inside a patch none coincide.
pub(super) const fn weld(samples: &[Sample; SAMPLE_COUNT]) -> Welded {
    let mut mesh = Welded {
        samples: [Sample::ZERO; SAMPLE_COUNT],
        sample_count: 0,
        triangles: [[0; 3]; TRIANGLES_MAX],
        triangle_count: 0,
    };
    // The vertices on borders found so far.
    let mut border = [NO_VERTEX; SAMPLE_COUNT];
    let mut border_count = 0;
    // The vertex of every sample.
    let mut vertices = [NO_VERTEX; SAMPLE_COUNT];
    let mut at = 0;
    while at < SAMPLE_COUNT {
        let sample = samples[at];
        let is_border = is_on_border(at % PATCH_SAMPLES);
        let mut vertex = NO_VERTEX;
        if is_border {
            vertex = find(&mesh, &border, border_count, &sample);
        }
        if vertex == NO_VERTEX {
            vertex = mesh.sample_count as u16;
            mesh.samples[mesh.sample_count] = sample;
            mesh.sample_count += 1;
            if is_border {
                border[border_count] = vertex;
                border_count += 1;
            }
        }
        vertices[at] = vertex;
        at += 1;
    }
    list_triangles(&mut mesh, &vertices);
    mesh
}

/// Whether a sample, by its number within its patch, lies on the patch's border.
const fn is_on_border(within: usize) -> bool {
    let row = within / SIDE;
    let column = within % SIDE;
    row == 0 || row == SEGMENTS || column == 0 || column == SEGMENTS
}

/// The border vertex that equals `sample`, or [`NO_VERTEX`].
const fn find(mesh: &Welded, border: &[u16], border_count: usize, sample: &Sample) -> u16 {
    // The latest first: neighbouring patches are near each other in the list.
    let mut at = border_count;
    while at > 0 {
        at -= 1;
        let vertex = border[at];
        if mesh.samples[vertex as usize].is(sample) {
            return vertex;
        }
    }
    NO_VERTEX
}

/// Two triangles for every grid cell, counter-clockwise from outside, without those that a pole makes degenerate.
const fn list_triangles(mesh: &mut Welded, vertices: &[u16; SAMPLE_COUNT]) {
    let mut cell = 0;
    while cell < PATCH_COUNT * SEGMENTS * SEGMENTS {
        let patch = cell / (SEGMENTS * SEGMENTS);
        let row = cell / SEGMENTS % SEGMENTS;
        let column = cell % SEGMENTS;
        let first = patch * PATCH_SAMPLES + row * SIDE + column;
        // The normal is the columns' direction cross the rows': column first is counter-clockwise.
        let near = [vertices[first], vertices[first + 1]];
        let far = [vertices[first + SIDE], vertices[first + SIDE + 1]];
        push_triangle(mesh, [near[0], near[1], far[1]]);
        push_triangle(mesh, [near[0], far[1], far[0]]);
        cell += 1;
    }
}

/// Adds a triangle unless two of its vertices are one.
const fn push_triangle(mesh: &mut Welded, triangle: [u16; 3]) {
    let [a, b, c] = triangle;
    if a != b && b != c && c != a {
        mesh.triangles[mesh.triangle_count] = triangle;
        mesh.triangle_count += 1;
    }
}

impl Welded {
    /// The positions; `N` is [`Self::sample_count`].
    pub(super) const fn positions<const N: usize>(&self) -> [[i16; 3]; N] {
        assert!(N == self.sample_count, "not the number of vertices");
        let mut positions = [[0; 3]; N];
        let mut at = 0;
        while at < N {
            positions[at] = self.samples[at].position;
            at += 1;
        }
        positions
    }

    /// The normals; `N` is [`Self::sample_count`].
    pub(super) const fn normals<const N: usize>(&self) -> [[i8; 3]; N] {
        assert!(N == self.sample_count, "not the number of vertices");
        let mut normals = [[0; 3]; N];
        let mut at = 0;
        while at < N {
            normals[at] = self.samples[at].normal;
            at += 1;
        }
        normals
    }

    /// The triangles; `N` is [`Self::triangle_count`].
    pub(super) const fn triangles<const N: usize>(&self) -> [[u16; 3]; N] {
        assert!(N == self.triangle_count, "not the number of triangles");
        let mut triangles = [[0; 3]; N];
        let mut at = 0;
        while at < N {
            triangles[at] = self.triangles[at];
            at += 1;
        }
        triangles
    }
}
