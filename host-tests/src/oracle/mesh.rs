//! Meshes that must be watertight: flat ones and fans. Closed ones are in `closed`.
//!
//! Each mesh says which invariant it must meet. The invariants are about the *snapped* triangles
//! and hold after any snap that moves a vertex little, because a pixel's count depends only on the
//! directions of the vertices from the eye.

use std::f64::consts::TAU;

use super::generate::{GRID, centre_step, pixel_vertex};
use super::linear::{cross, dot};
use super::{Part, Rng, Vertex, Viewport};

/// What the coverages of a mesh's triangles must add up to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Invariant {
    /// On every pixel for which [`Mesh::is_interior`] holds, the signed coverages add up to 1, and
    /// one triangle covers it unless the snap changed some triangle's facing. These are the front
    /// parts where the pixel's direction is inside this cone (its corners `(x, y, w)`, convex), and
    /// the parts behind the eye where the opposite direction is. The cone ends inside the mesh's
    /// border, far enough for the rounding of the border's vertices.
    CoversOnce(Vec<Vertex>),
    /// The mesh is closed, and its faces are counter-clockwise in NDC seen from outside. On every
    /// pixel, and for either part, seen from outside an even number of triangles covers it and the
    /// signed coverages add up to 0; seen from inside an odd number does and they add up to -1.
    Closed {
        /// Whether the eye, at `x = y = w = 0`, is inside.
        eye_inside: bool,
    },
}

/// An indexed mesh in clip space.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Vertices `(x, y, z, w)` in whole grid units, within the grid.
    pub vertices: Vec<[i64; 4]>,
    /// Three vertex indices each.
    pub triangles: Vec<[usize; 3]>,
    /// A distance of a hither plane, in grid units of `w`, for those who want one;
    /// `z = w - hither`. With the plane `CoversOnce` holds where the surface is farther than that,
    /// beyond the plane's band; `Closed` does not hold.
    pub hither: i64,
    /// What must hold.
    pub invariant: Invariant,
}

impl Mesh {
    /// The vertices `(x, y, w)` of triangle `index`.
    #[must_use]
    pub fn corners(&self, index: usize) -> [Vertex; 3] {
        self.triangles[index].map(|vertex| {
            let [x, y, _, w] = self.vertices[vertex];
            [x, y, w]
        })
    }

    /// All triangles' vertices `(x, y, w)`, in order.
    pub fn all_corners(&self) -> impl Iterator<Item = [Vertex; 3]> {
        (0..self.triangles.len()).map(|index| self.corners(index))
    }

    /// Whether the invariant says something about pixel `(x, y)` for this part: the pixel's whole
    /// square is inside the cone, so that a snap by a fraction of a pixel does not matter.
    #[must_use]
    pub fn is_interior(&self, viewport: Viewport, part: Part, (x, y): (u32, u32)) -> bool {
        let Invariant::CoversOnce(cone) = &self.invariant else {
            return true;
        };
        let centre = viewport.direction(x, y).map(|value| match part {
            Part::Front => i128::from(value),
            Part::Behind => -i128::from(value),
        });
        // Half a pixel is 1 / W and 1 / H in NDC, and directions are W H times that.
        let half = [viewport.height, viewport.width].map(i128::from);
        let square = [(-1, -1), (1, -1), (-1, 1), (1, 1)]
            .map(|(right, up)| [centre[0] + right * half[0], centre[1] + up * half[1], centre[2]]);
        let corner = |index: usize| cone[index % cone.len()].map(i128::from);
        let turning = dot(&cross(&corner(0), &corner(1)), &corner(2)).signum();
        (0..cone.len()).all(|index| {
            let side = cross(&corner(index), &corner(index + 1));
            square.iter().all(|direction| dot(&side, direction).signum() == turning)
        })
    }

    /// What the signed coverages of an interior pixel add up to.
    #[must_use]
    pub fn expected_sum(&self) -> i32 {
        match self.invariant {
            Invariant::CoversOnce(_) => 1,
            Invariant::Closed { eye_inside } => -i32::from(eye_inside),
        }
    }

    /// A mesh of directions: `hither` is chosen and `z` set from it.
    pub(super) fn from_directions(
        directions: &[Vertex],
        triangles: Vec<[usize; 3]>,
        invariant: Invariant,
        rng: &mut Rng,
    ) -> Self {
        let farthest = directions.iter().map(|&[_, _, w]| w).max();
        let hither = rng.magnitude(farthest.unwrap_or(1).max(2) / 2);
        let vertices =
            directions.iter().map(|&[x, y, w]| [x, y, (w - hither).max(-GRID), w]).collect();
        Self { vertices, triangles, hither, invariant }
    }
}

/// How a flat mesh lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sheet {
    /// At one distance; covers the whole viewport.
    Facing,
    /// Slanted, nearest and farthest `w` up to 1 : 2000 apart; covers the whole viewport.
    Tilted,
    /// A plane beside the eye that runs from behind it to far ahead: the front parts cover one side
    /// of a horizon, the parts behind the eye the other.
    ThroughEye,
}

impl Sheet {
    /// Every way a sheet lies.
    pub const ALL: [Self; 3] = [Self::Facing, Self::Tilted, Self::ThroughEye];
}

/// A flat mesh: a jittered grid of 6 x 6 to 16 x 16 cells with random diagonals, all
/// counter-clockwise.
pub fn sheet(kind: Sheet, rng: &mut Rng) -> Mesh {
    let (columns, rows) = (rng.range(6, 16) as usize, rng.range(6, 16) as usize);
    let place = placing(kind, rng);
    let vertex = |s: f64, t: f64| place(s, t).map(|value| value.round() as i64);
    let mut directions = Vec::new();
    for row in 0..=rows {
        for column in 0..=columns {
            let mut jitter = |index: usize, count: usize| {
                let inner = index > 0 && index < count;
                let moved = if inner { rng.between(-0.2, 0.2) } else { 0.0 };
                2.0 * (index as f64 + moved) / count as f64 - 1.0
            };
            directions.push(vertex(jitter(column, columns), jitter(row, rows)));
        }
    }
    let mut triangles = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let low = row * (columns + 1) + column;
            let high = low + columns + 1;
            if rng.once_in(2) {
                triangles.extend([[low, low + 1, high], [high, low + 1, high + 1]]);
            } else {
                triangles.extend([[low, low + 1, high + 1], [low, high + 1, high]]);
            }
        }
    }
    // A plane through the eye's left or over it is seen from its other side.
    let [a, b, c] = triangles[0].map(|index| directions[index].map(i128::from));
    if dot(&cross(&a, &b), &c) < 0 {
        triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    let (s, t) = (1.0 - 1.0 / columns as f64, 1.0 - 1.0 / rows as f64);
    let cone = vec![vertex(-s, -t), vertex(s, -t), vertex(s, t), vertex(-s, t)];
    Mesh::from_directions(&directions, triangles, Invariant::CoversOnce(cone), rng)
}

/// The map from a sheet's own `(s, t)`, each from -1 to 1, to `(x, y, w)` in grid units.
fn placing(kind: Sheet, rng: &mut Rng) -> Box<dyn Fn(f64, f64) -> [f64; 3]> {
    /// How far a sheet reaches, in NDC: half a cell of six inside it is still outside the viewport.
    const REACH: f64 = 1.25;
    let angle = rng.between(0.0, TAU);
    match kind {
        Sheet::Facing => {
            let w = rng.between(2048.0, GRID as f64 / 1.3);
            Box::new(move |s, t| [REACH * s * w, REACH * t * w, w])
        }
        Sheet::Tilted => {
            // 1/w is linear on the screen, from `nearest` at one corner of the sheet to 2 -
            // `nearest` at the opposite one.
            let nearest = 0.5_f64.powi(rng.range(1, 10) as i32);
            let (sine, cosine) = angle.sin_cos();
            let steepness = (1.0 - nearest) / (sine.abs() + cosine.abs());
            let base = GRID as f64 / 1.3 * nearest;
            Box::new(move |s, t| {
                let w = base / (1.0 + steepness * (cosine * s + sine * t));
                [REACH * s * w, REACH * t * w, w]
            })
        }
        Sheet::ThroughEye => {
            let size = GRID as f64 * rng.between(0.05, 0.6);
            let below = size * rng.between(0.02, 0.6);
            let (sine, cosine) = angle.sin_cos();
            let slope = rng.between(-0.3, 0.3);
            Box::new(move |s, t| {
                let (across, down, ahead) = (size * s, -below, size * (t + slope * s));
                [across * cosine - down * sine, across * sine + down * cosine, ahead]
            })
        }
    }
}

/// Where the middle vertex of a fan is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FanCentre {
    /// Exactly on the centre of a pixel.
    OnPixelCentre,
    /// Anywhere on the screen.
    Anywhere,
}

impl FanCentre {
    /// Both.
    pub const ALL: [Self; 2] = [Self::OnPixelCentre, Self::Anywhere];
}

/// A fan of 5 to 24 triangles round a vertex, all counter-clockwise, each ring vertex at a distance
/// of its own: small ones of a few pixels, some that cover the whole viewport, and some whose ring
/// lies at infinity or behind the eye.
pub fn fan(centre: FanCentre, viewport: Viewport, rng: &mut Rng) -> Mesh {
    let middle = match centre {
        FanCentre::OnPixelCentre => {
            let x = rng.below(u64::from(viewport.width)) as i64;
            let y = rng.below(u64::from(viewport.height)) as i64;
            let most = (GRID / 8 / centre_step(viewport)).max(1);
            pixel_vertex(viewport, (x, y), 1, rng.range((most / 16).max(1), most))
        }
        FanCentre::Anywhere => {
            let w = rng.range(1 << 14, GRID / 8);
            [rng.range(-w, w), rng.range(-w, w), w]
        }
    };
    let [middle_x, middle_y] = [0, 1].map(|i| middle[i] as f64 / middle[2] as f64);
    let everything = rng.once_in(2);
    // At least four pixels, where that is not more than the grid has room for.
    let side = viewport.width.min(viewport.height);
    let radius =
        if everything { 6.0 } else { rng.between(0.05, 1.0).max(8.0 / f64::from(side)).min(6.0) };
    let beyond = everything && rng.once_in(2);
    let count = rng.range(5, 24);
    let mut directions = vec![middle];
    for index in 0..count {
        let (sine, cosine) =
            (TAU * (index as f64 + rng.between(-0.2, 0.2)) / count as f64).sin_cos();
        // The ring vertex is `toward` of the middle plus a step outwards: 1 on the screen, 0 at
        // infinity, below that behind the eye.
        let toward = if beyond { rng.choose(&[1.0, 0.0, -0.5]) } else { 1.0 };
        let size = rng.between(32768.0, GRID as f64 / 8.0);
        let x = toward * middle_x + radius * cosine;
        let y = toward * middle_y + radius * sine;
        directions.push([x * size, y * size, toward * size].map(|value| value.round() as i64));
    }
    let count = count as usize;
    let triangles = (0..count).map(|i| [0, 1 + i, 1 + (i + 1) % count]).collect();
    // Neighbours on the ring are at most 1.4 / 5 of a turn apart, so it holds a circle of 0.63 of
    // its radius, and that a square of 0.44 to either side.
    let half = 0.4 * radius;
    let cone = [[-half, -half], [half, -half], [half, half], [-half, half]].map(|[x, y]| {
        [middle_x + x, middle_y + y, 1.0].map(|value| (value * GRID as f64 / 8.0).round() as i64)
    });
    Mesh::from_directions(&directions, triangles, Invariant::CoversOnce(cone.to_vec()), rng)
}

#[cfg(test)]
pub(super) mod tests {
    use num_rational::BigRational;

    use super::*;
    use crate::oracle::{ExactTriangle, RationalVertex, Space, random_viewport, whole};

    /// A snap as the contract allows one, for the mesh alone: to sixteenths of a pixel within 1024
    /// pixels of the screen's corner, else to 14 bits, each vertex scaled by a power of two. In
    /// pixel space.
    pub(in super::super) fn snapped(vertex: Vertex, viewport: Viewport) -> RationalVertex {
        let (width, height) = (i64::from(viewport.width), i64::from(viewport.height));
        let [x, y, w] =
            [width * (vertex[0] + vertex[2]), height * (vertex[2] - vertex[1]), 2 * vertex[2]];
        let nearest = |value: i64, unit: i64| (2 * value + unit).div_euclid(2 * unit);
        if w > 0 && x.abs() <= 1024 * w && y.abs() <= 1024 * w {
            return whole([nearest(16 * x, w), nearest(16 * y, w), 16]);
        }
        let largest = vertex.iter().map(|value| value.abs()).max().unwrap_or(0);
        let unit = (1..).map(|bits| 1 << bits).find(|unit| largest / unit < 1 << 14);
        let [x, y, w] = vertex.map(|value| nearest(value, unit.unwrap_or(1)));
        whole([width * (x + w), height * (w - y), 2 * w])
    }

    /// The triangles of a mesh after that snap.
    pub(in super::super) fn snapped_triangles(
        mesh: &Mesh,
        viewport: Viewport,
        part: Part,
    ) -> Vec<ExactTriangle> {
        let prepare = |corners: [Vertex; 3]| {
            let corners: [[BigRational; 3]; 3] = corners.map(|corner| snapped(corner, viewport));
            ExactTriangle::from_rationals(&corners, Space::Pixel, viewport, part)
        };
        mesh.all_corners().map(prepare).collect()
    }

    fn small_viewport(rng: &mut Rng) -> Viewport {
        let viewport = random_viewport(rng);
        Viewport::new(viewport.width.min(61), viewport.height.min(48))
    }

    /// Checks the invariant on every pixel and both parts; returns the number of pixels it spoke
    /// of.
    fn check(mesh: &Mesh, viewport: Viewport, seed: u64) -> usize {
        for corners in mesh.all_corners() {
            let exact = ExactTriangle::new(corners, viewport, Part::Front);
            assert_eq!(exact.orientation(), 1, "seed {seed} {corners:?}");
        }
        assert!(mesh.vertices.iter().flatten().all(|value| value.abs() <= GRID));
        let mut seen = 0;
        for part in Part::ALL {
            let prepare = |corners| ExactTriangle::new(corners, viewport, part);
            let prepared: Vec<_> = mesh.all_corners().map(prepare).collect();
            let snapped = snapped_triangles(mesh, viewport, part);
            for (x, y) in viewport.pixels() {
                if mesh.is_interior(viewport, part, (x, y)) {
                    let count = prepared.iter().filter(|one| one.covers(x, y)).count();
                    assert_eq!(count, 1, "seed {seed} {part:?} {viewport:?} {x} {y}");
                    let sum: i32 = snapped.iter().map(|one| one.signed_coverage(x, y)).sum();
                    assert_eq!(sum, 1, "snapped, seed {seed} {part:?} {viewport:?} {x} {y}");
                    seen += 1;
                }
            }
        }
        seen
    }

    #[test]
    fn sheets_cover_their_interior_once() {
        for seed in 0..24 {
            let mut rng = Rng::new(seed);
            let viewport = small_viewport(&mut rng);
            let pixels = (viewport.width * viewport.height) as usize;
            for kind in Sheet::ALL {
                let mesh = sheet(kind, &mut rng);
                let seen = check(&mesh, viewport, seed);
                if kind != Sheet::ThroughEye {
                    assert_eq!(seen, pixels, "{kind:?} covers the viewport");
                }
            }
        }
    }

    #[test]
    fn sheets_through_the_eye_have_both_parts() {
        let viewport = Viewport::new(32, 32);
        let (mut front, mut behind) = (0, 0);
        for seed in 0..24 {
            let mesh = sheet(Sheet::ThroughEye, &mut Rng::new(seed));
            let ends = mesh.vertices.iter().map(|vertex| vertex[3]);
            assert!(ends.clone().min() < Some(0) && ends.max() > Some(0));
            let interior = |part| {
                let one = |&place: &(u32, u32)| mesh.is_interior(viewport, part, place);
                viewport.pixels().filter(one).count()
            };
            front += interior(Part::Front);
            behind += interior(Part::Behind);
        }
        assert!(front > 4000 && behind > 4000, "{front} {behind}");
    }

    #[test]
    fn fans_cover_their_interior_once() {
        let mut seen = 0;
        for seed in 0..60 {
            let mut rng = Rng::new(seed);
            let viewport = small_viewport(&mut rng);
            for centre in FanCentre::ALL {
                let mesh = fan(centre, viewport, &mut rng);
                seen += check(&mesh, viewport, seed);
            }
        }
        assert!(seen > 60_000, "{seen}");
    }

    #[test]
    fn a_fan_on_a_pixel_centre_is_exactly_there() {
        let viewport = Viewport::new(10, 15);
        let mesh = fan(FanCentre::OnPixelCentre, viewport, &mut Rng::new(3));
        let [x, y, _, w] = mesh.vertices[0];
        let centred = |place: (u32, u32)| {
            let [px, py, pw] = viewport.direction(place.0, place.1);
            x * pw == px * w && y * pw == py * w
        };
        assert!(viewport.pixels().any(centred));
    }
}
