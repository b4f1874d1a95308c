//! Seeded random triangles and viewports that are hard on a rasterizer.
//!
//! All vertices are `(x, y, w)` in clip space, whole numbers of one scale within [`GRID`]. Callers
//! print the seed.

use super::{Rng, Vertex, Viewport};

/// Largest magnitude of a coordinate of the exact tier's grid, in grid units.
pub const GRID: i64 = 1 << 20;

/// Largest viewport side of the exact tier, in pixels.
const SIDE: u32 = 512;

/// A kind of triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Category {
    /// All vertices in front of the eye and on the screen.
    OnScreen,
    /// All vertices in front of the eye, most far off the screen.
    FarOffScreen,
    /// Thin, with areas from far below 2^-16 to some pixels, through or just beside a pixel centre.
    Sliver,
    /// Repeated, collinear or zero vertices, and determinants of 1 and nearly 0.
    Degenerate,
    /// `w` of both signs.
    MixedSignW,
    /// `w < 0` at all vertices.
    Behind,
    /// `w = 0` at one vertex, two, or all.
    ZeroW,
    /// An edge at infinity (both its vertices have `w = 0`) or nearly there.
    EdgeAtInfinity,
    /// Vertices exactly on pixel centres, often in rows and columns.
    PixelCentre,
    /// Vertices exactly on pixel corners.
    PixelCorner,
    /// All coordinates at or next to the grid's ends and its middle.
    GridLimit,
    /// All coordinates within 4 grid units.
    Tiny,
    /// `w` of 1 to 4 at one vertex, of about 2^20 at another.
    HugeRatio,
    /// Any coordinates of any magnitude.
    Anything,
}

impl Category {
    /// Every category.
    pub const ALL: [Self; 14] = [
        Self::OnScreen,
        Self::FarOffScreen,
        Self::Sliver,
        Self::Degenerate,
        Self::MixedSignW,
        Self::Behind,
        Self::ZeroW,
        Self::EdgeAtInfinity,
        Self::PixelCentre,
        Self::PixelCorner,
        Self::GridLimit,
        Self::Tiny,
        Self::HugeRatio,
        Self::Anything,
    ];
}

/// A viewport of 1 x 1 to 512 x 512 pixels: common sizes, extremes, odd and non-square ones.
pub fn random_viewport(rng: &mut Rng) -> Viewport {
    const NAMED: [(u32, u32); 12] = [
        (1, 1),
        (1, SIDE),
        (SIDE, 1),
        (SIDE, SIDE),
        (511, 509),
        (SIDE, 511),
        (240, 240),
        (240, 320),
        (320, 240),
        (2, 2),
        (3, 7),
        (128, 64),
    ];
    let (width, height) = match rng.below(3) {
        0 => rng.choose(&NAMED),
        1 => (rng.range(1, 16) as u32, rng.range(1, 16) as u32),
        _ => (rng.range(1, i64::from(SIDE)) as u32, rng.range(1, i64::from(SIDE)) as u32),
    };
    Viewport::new(width, height)
}

/// A random triangle of a category, its vertices in random order, for a viewport of up to 512 x
/// 512.
pub fn triangle(category: Category, viewport: Viewport, rng: &mut Rng) -> [Vertex; 3] {
    let mut corners = match category {
        Category::OnScreen => each(rng, on_screen),
        Category::FarOffScreen => each(rng, far_off_screen),
        Category::Sliver => sliver(viewport, rng),
        Category::Degenerate => degenerate(rng),
        Category::MixedSignW => mixed_sign_w(rng),
        Category::Behind => each(rng, on_screen).map(|corner| corner.map(|value| -value)),
        Category::ZeroW => zero_w(rng),
        Category::EdgeAtInfinity => edge_at_infinity(rng),
        Category::PixelCentre => on_pixels(viewport, 1, rng),
        Category::PixelCorner => on_pixels(viewport, 0, rng),
        Category::GridLimit => {
            const ENDS: [i64; 7] = [-GRID, 1 - GRID, -1, 0, 1, GRID - 1, GRID];
            each(rng, |rng| [(); 3].map(|()| rng.choose(&ENDS)))
        }
        Category::Tiny => each(rng, |rng| [(); 3].map(|()| rng.range(-4, 4))),
        Category::HugeRatio => huge_ratio(rng),
        Category::Anything => each(rng, anything),
    };
    corners.rotate_left(rng.below(3) as usize);
    if rng.once_in(2) {
        corners.swap(0, 1);
    }
    corners
}

/// A clip-space whole multiple of the centre of pixel `(x, y)`, or with `odd = 0` of its top left
/// corner, `w` being `multiple` times [`centre_step`].
#[must_use]
pub fn pixel_vertex(viewport: Viewport, (x, y): (i64, i64), odd: i64, multiple: i64) -> Vertex {
    let (width, height) = (i64::from(viewport.width), i64::from(viewport.height));
    let w = centre_step(viewport) * multiple;
    [(2 * x + odd - width) * (w / width), (height - 2 * y - odd) * (w / height), w]
}

/// The least `w`, in grid units, at which all pixel centres and corners of a viewport are whole:
/// the least common multiple of its sides.
#[must_use]
pub fn centre_step(viewport: Viewport) -> i64 {
    let (width, height) = (i64::from(viewport.width), i64::from(viewport.height));
    let [divisor, ..] = extended_gcd(width, height);
    width / divisor * height
}

fn each(rng: &mut Rng, mut vertex: impl FnMut(&mut Rng) -> Vertex) -> [Vertex; 3] {
    [vertex(rng), vertex(rng), vertex(rng)]
}

fn on_screen(rng: &mut Rng) -> Vertex {
    let w = rng.magnitude(GRID);
    [rng.range(-w, w), rng.range(-w, w), w]
}

fn far_off_screen(rng: &mut Rng) -> Vertex {
    let w = rng.magnitude(1 << 12);
    if rng.once_in(4) {
        return [rng.signed(2 * w), rng.signed(2 * w), w];
    }
    [rng.signed(GRID), rng.signed(GRID), w]
}

fn anything(rng: &mut Rng) -> Vertex {
    [(); 3].map(|()| rng.signed(GRID))
}

/// Two vertices in line with a pixel centre, or next to that line, and a third one few grid steps
/// off it.
fn sliver(viewport: Viewport, rng: &mut Rng) -> [Vertex; 3] {
    let step = centre_step(viewport);
    let most = (GRID / 4 / step).max(1);
    let multiple = if rng.once_in(2) { most } else { rng.magnitude(most) };
    let place =
        (rng.below(u64::from(viewport.width)) as i64, rng.below(u64::from(viewport.height)) as i64);
    let [centre_x, centre_y, w] = pixel_vertex(viewport, place, 1, multiple);
    let (raw_x, raw_y) = match rng.below(8) {
        0 => (1, 0),
        1 => (0, 1),
        _ => (rng.magnitude(w), rng.signed(w)),
    };
    let [divisor, ..] = extended_gcd(raw_x, raw_y);
    let (along_x, along_y) = (raw_x / divisor, raw_y / divisor);
    // (off_x, off_y) is one lattice line beside the direction: along_x * off_y - along_y * off_x =
    // 1.
    let [_, off_y, minus_off_x] = extended_gcd(along_x, along_y);
    let (off_x, off_y) = (-minus_off_x, off_y);
    let longest = along_x.abs().max(along_y.abs());
    let reach = (2 * w / longest).max(1);
    let (before, after) = (rng.range(0, reach), rng.range(1, reach));
    let beside = rng.signed(1 << 11);
    let back = if along_x.abs() >= along_y.abs() {
        (beside * off_x).div_euclid(along_x)
    } else {
        (beside * off_y).div_euclid(along_y)
    };
    let third = rng.range(-before, after) - back;
    let nudge = if rng.once_in(2) { [0, 0] } else { [rng.range(-1, 1), rng.range(-1, 1)] };
    let at = |steps: i64, beside: i64| {
        let x = centre_x + steps * along_x + beside * off_x + nudge[0];
        let y = centre_y + steps * along_y + beside * off_y + nudge[1];
        [x.clamp(-GRID, GRID), y.clamp(-GRID, GRID), w]
    };
    [at(-before, 0), at(after, 0), at(third, beside)]
}

fn degenerate(rng: &mut Rng) -> [Vertex; 3] {
    let anywhere = |rng: &mut Rng| {
        if rng.once_in(2) { on_screen(rng) } else { anything(rng) }
    };
    let (first, second) = (anywhere(rng), anywhere(rng));
    let halved = first.map(|value| value / 2);
    match rng.below(8) {
        0 => [first, second, first],
        1 => [halved.map(|value| 2 * value), halved, second],
        2 => [first, first, first],
        3 => [first, second, [0, 0, 0]],
        4 => [first, [0, 0, 0], [0, 0, 0]],
        5 => [[(); 3]; 3].map(|vertex| vertex.map(|()| 0)),
        6 => unit_determinant(rng),
        _ => {
            // In line on the screen: the third is a whole combination of the others, or one grid
            // step beside it.
            let (a, b) = (rng.range(-7, 7), rng.range(-7, 7));
            let (first, second) = (first.map(|value| value / 16), second.map(|value| value / 16));
            let mut third = [0, 1, 2].map(|i| a * first[i] + b * second[i]);
            if rng.once_in(2) {
                third[rng.below(3) as usize] += rng.choose(&[-1, 1]);
            }
            [first, second, third]
        }
    }
}

/// Large vertices whose determinant is 1 or -1: rows added to rows, which does not change it.
fn unit_determinant(rng: &mut Rng) -> [Vertex; 3] {
    let mut rows = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    for _ in 0..rng.range(2, 24) {
        let (to, from) = rng.choose(&[(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)]);
        let factor = rng.signed(9);
        let sum: Vertex = [0, 1, 2].map(|i| rows[to][i] + factor * rows[from][i]);
        if sum.iter().all(|value| value.abs() <= GRID) {
            rows[to] = sum;
        }
    }
    rows
}

fn mixed_sign_w(rng: &mut Rng) -> [Vertex; 3] {
    let third = rng.signed(GRID);
    [rng.magnitude(GRID), -rng.magnitude(GRID), third].map(|w: i64| {
        let reach = if rng.once_in(2) { (2 * w.abs()).clamp(1, GRID) } else { GRID };
        [rng.signed(reach), rng.signed(reach), w]
    })
}

fn zero_w(rng: &mut Rng) -> [Vertex; 3] {
    let count = 1 + rng.below(3) as usize;
    let mut corners = if rng.once_in(2) { each(rng, on_screen) } else { each(rng, anything) };
    corners.iter_mut().take(count).for_each(|corner| corner[2] = 0);
    corners
}

fn edge_at_infinity(rng: &mut Rng) -> [Vertex; 3] {
    let nearness = rng.range(0, 2);
    let far = |rng: &mut Rng| [rng.signed(GRID), rng.signed(GRID), rng.range(-nearness, nearness)];
    let near = if rng.once_in(4) { anything(rng) } else { on_screen(rng) };
    [far(rng), far(rng), near]
}

fn on_pixels(viewport: Viewport, odd: i64, rng: &mut Rng) -> [Vertex; 3] {
    let (width, height) = (i64::from(viewport.width), i64::from(viewport.height));
    let most = (GRID / 3 / centre_step(viewport)).max(1);
    let outside = rng.once_in(4);
    let mut place = (0, 0);
    each(rng, |rng| {
        let (margin_x, margin_y) = if outside { (width, height) } else { (0, 0) };
        let fresh = (
            rng.range(-margin_x, width - odd + margin_x),
            rng.range(-margin_y, height - odd + margin_y),
        );
        place = match rng.below(4) {
            0 => (place.0, fresh.1),
            1 => (fresh.0, place.1),
            _ => fresh,
        };
        pixel_vertex(viewport, place, odd, rng.magnitude(most))
    })
}

fn huge_ratio(rng: &mut Rng) -> [Vertex; 3] {
    let anywhere = rng.once_in(2);
    let third = rng.magnitude(GRID);
    [rng.range(1, 4), rng.range(GRID - 4, GRID), third].map(|w| {
        let reach = if anywhere { GRID } else { w };
        [rng.signed(reach), rng.signed(reach), w]
    })
}

/// `[g, s, t]` with `s a + t b = g`, the greatest common divisor of `a` and `b` (positive unless
/// both are 0).
fn extended_gcd(a: i64, b: i64) -> [i64; 3] {
    let (mut old, mut new) = ([a, 1, 0], [b, 0, 1]);
    while new[0] != 0 {
        let quotient = old[0] / new[0];
        let rest = [0, 1, 2].map(|i| old[i] - quotient * new[i]);
        (old, new) = (new, rest);
    }
    if old[0] < 0 { old.map(|value| -value) } else { old }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::{ExactTriangle, Part};

    fn determinant([a, b, c]: [Vertex; 3]) -> i128 {
        let [a, b, c] = [a, b, c].map(|vertex| vertex.map(i128::from));
        a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    }

    #[test]
    fn every_triangle_is_on_the_grid_and_seeds_repeat() {
        for category in Category::ALL {
            let (mut rng, mut again) = (Rng::new(5), Rng::new(5));
            for _ in 0..2000 {
                let viewport = random_viewport(&mut rng);
                assert!(
                    (1..=512).contains(&viewport.width) && (1..=512).contains(&viewport.height)
                );
                let corners = triangle(category, viewport, &mut rng);
                assert!(
                    corners.iter().flatten().all(|value| value.abs() <= GRID),
                    "{category:?} {corners:?}"
                );
                let same = random_viewport(&mut again);
                assert_eq!((viewport, corners), (same, triangle(category, same, &mut again)));
            }
        }
    }

    #[test]
    fn slivers_reach_below_a_65536th_of_a_pixel_and_still_cover_some() {
        let mut rng = Rng::new(6);
        let (mut thin, mut covering) = (0, 0);
        for _ in 0..2000 {
            let viewport = Viewport::new(rng.range(1, 64) as u32, rng.range(1, 64) as u32);
            let corners = triangle(Category::Sliver, viewport, &mut rng);
            let w = corners[0][2] as f64;
            let pixels = f64::from(viewport.width * viewport.height) / 8.0;
            let area = determinant(corners).abs() as f64 / (w * w * w) * pixels;
            let is_thin = area > 0.0 && area <= 2f64.powi(-16);
            let covers = !ExactTriangle::new(corners, viewport, Part::Front).pixels().is_empty();
            thin += i32::from(is_thin);
            covering += i32::from(is_thin && covers);
        }
        assert!(thin > 200, "{thin}");
        assert!(covering > 20, "{covering}");
    }

    #[test]
    fn the_degenerate_ones_have_determinants_of_0_and_1() {
        let mut rng = Rng::new(7);
        let (mut none, mut unit) = (0, 0);
        for _ in 0..2000 {
            let viewport = Viewport::new(8, 8);
            match determinant(triangle(Category::Degenerate, viewport, &mut rng)) {
                0 => none += 1,
                1 | -1 => unit += 1,
                _ => {}
            }
        }
        assert!(none > 1000 && unit > 200, "{none} {unit}");
        for _ in 0..200 {
            assert_eq!(determinant(unit_determinant(&mut rng)).abs(), 1);
        }
    }

    #[test]
    fn pixel_vertices_are_on_the_pixels() {
        let mut rng = Rng::new(8);
        for _ in 0..500 {
            let viewport = random_viewport(&mut rng);
            let x = rng.below(u64::from(viewport.width));
            let y = rng.below(u64::from(viewport.height));
            let [vx, vy, vw] = pixel_vertex(viewport, (x as i64, y as i64), 1, 1);
            let [px, py, pw] = viewport.direction(x as u32, y as u32);
            assert_eq!((vx * pw, vy * pw), (px * vw, py * vw));
        }
        assert_eq!(pixel_vertex(Viewport::new(4, 6), (0, 0), 0, 2), [-24, 24, 24]);
        assert_eq!(pixel_vertex(Viewport::new(4, 6), (4, 6), 0, 1), [12, -12, 12]);
    }

    #[test]
    fn extended_gcd_solves_its_equation() {
        for (a, b) in [(12, 18), (-7, 3), (5, 0), (0, -4), (1 << 20, 3), (-6, -9)] {
            let [g, s, t] = extended_gcd(a, b);
            assert!(g > 0 && a % g == 0 && b % g == 0);
            assert_eq!(s * a + t * b, g);
        }
    }
}
