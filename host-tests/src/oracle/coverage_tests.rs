//! Hand-made cases that the exact coverage must get right, and its fast way against its slow one.

use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::{ExactTriangle, covers_big};
use crate::oracle::generate::centre_step;
use crate::oracle::{
    Category, GRID, Part, RationalVertex, Rng, Space, Vertex, Viewport, random_viewport, triangle,
    whole,
};

const EIGHT: Viewport = Viewport::new(8, 8);

fn rational(numerator: i64, denominator: i64) -> BigRational {
    BigRational::new(numerator.into(), denominator.into())
}

/// The picture of a triangle whose corners are half pixels from the top left of 8 x 8.
fn picture(corners: [[i64; 2]; 3]) -> Vec<String> {
    let vertices = corners.map(|[x, y]| [x, y, 2]);
    ExactTriangle::from_pixel_space(vertices, EIGHT, Part::Front).picture()
}

#[test]
fn a_right_triangle_leaves_its_bottom_right_edge_to_the_other_half() {
    assert_eq!(
        picture([[0, 0], [0, 16], [16, 0]]),
        [
            "####### ", "######  ", "#####   ", "####    ", "###     ", "##      ", "#       ",
            "        ",
        ]
    );
    assert_eq!(
        picture([[16, 16], [0, 16], [16, 0]]),
        [
            "       #", "      ##", "     ###", "    ####", "   #####", "  ######", " #######",
            "########",
        ]
    );
}

#[test]
fn corners_on_pixel_centres_follow_the_top_left_rule() {
    // Top edge along the centres of row 1, from column 1 to column 6; apex on the centre of row 6,
    // column 1.
    assert_eq!(
        picture([[3, 3], [13, 3], [3, 13]]),
        [
            "        ", " #####  ", " ####   ", " ###    ", " ##     ", " #      ", "        ",
            "        ",
        ]
    );
    // The same upside down: the flat edge is now at the bottom, and excluded with its row.
    assert_eq!(
        picture([[3, 13], [13, 13], [3, 3]]),
        [
            "        ", "        ", " #      ", " ##     ", " ###    ", " ####   ", "        ",
            "        ",
        ]
    );
}

#[test]
fn a_steep_triangle_as_drawn_by_hand() {
    // Apex (1, 0), right (7, 4), bottom (2, 8), in pixels. Row y's centre line is at y + 1/2: the
    // left edge is at x = 1 + (y+1/2)/8, the right one at 1 + 3/2 (y+1/2) down to y = 4 and 7 - 5/4
    // (y-7/2) from there.
    assert_eq!(
        picture([[2, 0], [14, 8], [4, 16]]),
        [
            " #      ", " ##     ", " ####   ", " #####  ", "  ####  ", "  ###   ", "  ##    ",
            "  #     ",
        ]
    );
}

#[test]
fn a_square_split_by_either_diagonal_covers_each_pixel_once() {
    for viewport in [EIGHT, Viewport::new(7, 5), Viewport::new(1, 1)] {
        let square = [[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]];
        for (a, b, c, d) in [(0, 1, 2, 3), (1, 2, 3, 0)] {
            let corner = |i: usize| square[i];
            let first = [corner(a), corner(b), corner(c)];
            let second = [corner(a), corner(c), corner(d)];
            let halves =
                [first, second].map(|half| ExactTriangle::new(half, viewport, Part::Front));
            for (x, y) in viewport.pixels() {
                let count: i32 = halves.iter().map(|half| half.signed_coverage(x, y)).sum();
                assert_eq!(count, 1, "{viewport:?} {x} {y}");
            }
        }
    }
}

#[test]
fn the_screen_is_y_up_and_counter_clockwise_is_positive() {
    // The upper right quarter of NDC is the upper right of the picture.
    let corners = [[0, 0, 1], [4, 0, 1], [0, 4, 1]];
    let exact = ExactTriangle::new(corners, EIGHT, Part::Front);
    assert_eq!(exact.orientation(), 1);
    assert!(exact.covers(4, 3) && exact.covers(7, 0));
    assert!(!exact.covers(3, 3) && !exact.covers(4, 4));
    let mirrored = ExactTriangle::new([corners[0], corners[2], corners[1]], EIGHT, Part::Front);
    assert_eq!(mirrored.orientation(), -1);
    assert_eq!(mirrored.pixels(), exact.pixels());
    let pixels = [[8, 8, 2], [40, 8, 2], [8, -24, 2]];
    let pixels = ExactTriangle::from_pixel_space(pixels, EIGHT, Part::Front);
    assert_eq!((pixels.orientation(), pixels.pixels()), (1, exact.pixels()));
}

#[test]
fn an_edge_at_infinity_bounds_nothing() {
    // From the screen's middle towards +x and +y without end: the upper right quarter.
    let corners = [[0, 0, 1], [1, 0, 0], [0, 1, 0]];
    let exact = ExactTriangle::new(corners, EIGHT, Part::Front);
    assert_eq!(exact.pixels().len(), 16);
    assert!(exact.covers(7, 0) && exact.covers(4, 3));
    assert!(ExactTriangle::new(corners, EIGHT, Part::Behind).pixels().is_empty());
}

#[test]
fn nothing_is_covered_where_the_determinant_is_zero() {
    for corners in [
        [[0, 0, 1], [0, 0, 1], [5, 5, 1]],
        [[-4, 0, 1], [0, 0, 1], [4, 0, 1]],
        [[1, 0, 0], [0, 1, 0], [-1, -1, 0]],
        [[0, 0, 0]; 3],
    ] {
        for part in Part::ALL {
            let exact = ExactTriangle::new(corners, Viewport::new(3, 3), part);
            assert_eq!((exact.orientation(), exact.pixels().len()), (0, 0));
        }
    }
}

#[test]
fn the_part_behind_the_eye_is_the_front_of_the_negated_triangle() {
    let mut rng = Rng::new(1);
    let mut covered = 0;
    for round in 0..600 {
        let category = Category::ALL[round % Category::ALL.len()];
        let viewport = Viewport::new(rng.range(1, 24) as u32, rng.range(1, 24) as u32);
        let corners = triangle(category, viewport, &mut rng);
        let negated = corners.map(|corner| corner.map(|value| -value));
        let behind = ExactTriangle::new(corners, viewport, Part::Behind);
        let front = ExactTriangle::new(negated, viewport, Part::Front);
        assert_eq!(behind.pixels(), front.pixels(), "{category:?} {corners:?}");
        covered += front.pixels().len();
    }
    assert!(covered > 1000, "{covered}");
}

#[test]
fn positive_scales_of_vertices_change_nothing() {
    let mut rng = Rng::new(2);
    for round in 0..600 {
        let category = Category::ALL[round % Category::ALL.len()];
        let viewport = Viewport::new(rng.range(1, 20) as u32, rng.range(1, 20) as u32);
        let corners = triangle(category, viewport, &mut rng);
        let part = Part::ALL[round & 1];
        let plain = ExactTriangle::new(corners, viewport, part);
        // Up to 2^60 the coordinates leave the range of the fast way, so that both ways meet here.
        let scales = [(); 3].map(|()| rng.magnitude(1 << 40));
        let scaled = [0, 1, 2].map(|i| corners[i].map(|value| value * scales[i]));
        let scaled = ExactTriangle::new(scaled, viewport, part);
        assert_eq!(plain.pixels(), scaled.pixels(), "{category:?} {corners:?} {scales:?}");
        let thirds = [0, 1, 2].map(|i| {
            let scale = rational(scales[i], 3);
            whole(corners[i]).map(|value| value / &scale)
        });
        let thirds = ExactTriangle::from_rationals(&thirds, Space::Clip, viewport, part);
        assert_eq!(plain.pixels(), thirds.pixels(), "{category:?} {corners:?} {scales:?}");
        assert_eq!(plain.orientation(), thirds.orientation());
    }
}

#[test]
fn the_fast_way_agrees_with_the_plain_one() {
    for category in Category::ALL {
        let mut rng = Rng::new(3);
        for round in 0..120 {
            let viewport = random_viewport(&mut rng);
            let corners = triangle(category, viewport, &mut rng);
            let rationals = corners.map(whole);
            let part = Part::ALL[round & 1];
            let exact = ExactTriangle::new(corners, viewport, part);
            let through = ExactTriangle::from_rationals(&rationals, Space::Clip, viewport, part);
            for place in places(&exact, viewport, &mut rng) {
                let expected = covers_big(&rationals, Space::Clip, viewport, part, place);
                let answers = (exact.covers(place.0, place.1), through.covers(place.0, place.1));
                assert_eq!(answers, (expected, expected), "{corners:?} {viewport:?} {place:?}");
            }
        }
    }
}

/// Some random pixels, and some that are covered.
fn places(exact: &ExactTriangle, viewport: Viewport, rng: &mut Rng) -> Vec<(u32, u32)> {
    let mut places: Vec<_> = (0..6)
        .map(|_| {
            let x = rng.below(u64::from(viewport.width)) as u32;
            (x, rng.below(u64::from(viewport.height)) as u32)
        })
        .collect();
    if viewport.width * viewport.height <= 4096 {
        places.extend(exact.pixels().into_iter().step_by(97));
    }
    places
}

#[test]
fn pixel_space_agrees_with_the_plain_way_at_its_extremes() {
    let mut rng = Rng::new(4);
    for round in 0..400 {
        let viewport = random_viewport(&mut rng);
        // A vertex projected to 8 subpixel bits, one to 4, and homogeneous ones of 26 bits.
        let corners: [Vertex; 3] = [(); 3].map(|()| match rng.below(4) {
            0 => [rng.signed(1 << 18), rng.signed(1 << 18), 256],
            1 => [rng.signed(1 << 14), rng.signed(1 << 14), 16],
            2 => [rng.choose(&[-1, 1]) << 26, rng.choose(&[-1, 1]) << 26, rng.signed(1 << 26)],
            _ => [rng.signed(1 << 24), rng.signed(1 << 24), rng.signed(1 << 15)],
        });
        let part = Part::ALL[round & 1];
        let exact = ExactTriangle::from_pixel_space(corners, viewport, part);
        let rationals = corners.map(whole);
        for place in places(&exact, viewport, &mut rng) {
            let expected = covers_big(&rationals, Space::Pixel, viewport, part, place);
            assert_eq!(
                exact.covers(place.0, place.1),
                expected,
                "{corners:?} {viewport:?} {place:?}"
            );
        }
    }
}

#[test]
fn the_narrow_range_has_no_overflow_at_its_ends() {
    // Run with overflow checks: all eight signs of the largest coordinates on the largest viewport.
    let end = 1 << 40;
    let viewport = Viewport::new(1024, 1024);
    let mut rng = Rng::new(9);
    for _ in 0..200 {
        let corners = [[(); 3]; 3].map(|corner| corner.map(|()| rng.choose(&[-end, end])));
        for space in [Space::Clip, Space::Pixel] {
            let exact = ExactTriangle::from_whole(corners, space, viewport, Part::Front);
            for place in [(0, 0), (1023, 0), (0, 1023), (1023, 1023), (511, 512)] {
                let expected = covers_big(&corners.map(whole), space, viewport, Part::Front, place);
                assert_eq!(exact.covers(place.0, place.1), expected, "{corners:?} {place:?}");
            }
        }
    }
}

/// Clips a polygon to `plane . (x, y, w) >= 0` in rationals (Sutherland & Hodgman 1974).
fn clip(polygon: &[RationalVertex], plane: [i64; 3]) -> Vec<RationalVertex> {
    let plane = whole(plane);
    let side = |point: &RationalVertex| {
        (0..3).map(|i| &plane[i] * &point[i]).fold(BigRational::zero(), |sum, term| sum + term)
    };
    let mut clipped = Vec::new();
    for (i, point) in polygon.iter().enumerate() {
        let next = &polygon[(i + 1) % polygon.len()];
        let (here, there) = (side(point), side(next));
        if !here.is_negative() {
            clipped.push(point.clone());
        }
        if (&here * &there).is_negative() {
            let along = &here / (&here - &there);
            let crossing = |k: usize| &point[k] + (&next[k] - &point[k]) * &along;
            clipped.push([crossing(0), crossing(1), crossing(2)]);
        }
    }
    clipped
}

/// The pixels of a convex polygon given by its screen corners in pixels, y down, by the top-left
/// rule.
fn fill(corners: &[[BigRational; 2]], viewport: Viewport) -> Vec<(u32, u32)> {
    let area = (0..corners.len()).fold(BigRational::zero(), |sum, i| {
        let (a, b) = (&corners[i], &corners[(i + 1) % corners.len()]);
        sum + &a[0] * &b[1] - &a[1] * &b[0]
    });
    if corners.len() < 3 || area.is_zero() {
        return Vec::new();
    }
    let sign = area.signum();
    let covered = |&(x, y): &(u32, u32)| {
        let centre = [x, y].map(|value| rational(2 * i64::from(value) + 1, 2));
        (0..corners.len()).all(|i| {
            let (a, b) = (&corners[i], &corners[(i + 1) % corners.len()]);
            let (right, down) = ((&b[0] - &a[0]) * &sign, (&b[1] - &a[1]) * &sign);
            let value = &right * (&centre[1] - &a[1]) - &down * (&centre[0] - &a[0]);
            // With y down and a positive area the inside is to the right of travel: left edges go
            // up, top edges go right.
            let top_left = down.is_negative() || (down.is_zero() && right.is_positive());
            let point = down.is_zero() && right.is_zero();
            point || value.is_positive() || (value.is_zero() && top_left)
        })
    };
    viewport.pixels().filter(covered).collect()
}

/// Coverage by clipping to a frustum twice as wide as the screen, dividing by w, and filling the
/// polygon.
fn by_clipping(corners: [Vertex; 3], viewport: Viewport) -> Vec<(u32, u32)> {
    let mut polygon = corners.map(whole).to_vec();
    for plane in [[-1, 0, 2], [1, 0, 2], [0, -1, 2], [0, 1, 2]] {
        polygon = clip(&polygon, plane);
    }
    // In the frustum w >= 0, and w = 0 only at the eye itself.
    let to_screen = |point: &RationalVertex| {
        let half = rational(1, 2);
        let (width, height) = (i64::from(viewport.width), i64::from(viewport.height));
        let x = (&point[0] / &point[2] + rational(1, 1)) * &half * rational(width, 1);
        let y = (rational(1, 1) - &point[1] / &point[2]) * &half * rational(height, 1);
        [x, y]
    };
    polygon.retain(|point| point[2].is_positive());
    let screen: Vec<_> = polygon.iter().map(to_screen).collect();
    fill(&screen, viewport)
}

#[test]
fn external_triangles_cover_what_clipping_leaves_of_them() {
    let mut rng = Rng::new(10);
    let mut covered = 0;
    for round in 0..700 {
        let category = Category::ALL[round % Category::ALL.len()];
        let viewport = Viewport::new(rng.range(1, 12) as u32, rng.range(1, 12) as u32);
        let corners = triangle(category, viewport, &mut rng);
        let exact = ExactTriangle::new(corners, viewport, Part::Front);
        if exact.orientation() == 0 {
            continue;
        }
        let expected = by_clipping(corners, viewport);
        assert_eq!(exact.pixels(), expected, "{category:?} {corners:?} {viewport:?}");
        let behind = ExactTriangle::new(corners, viewport, Part::Behind);
        let negated = corners.map(|corner| corner.map(|value| -value));
        assert_eq!(behind.pixels(), by_clipping(negated, viewport), "{category:?} {corners:?}");
        covered += expected.len();
    }
    assert!(covered > 3000, "{covered}");
}

#[test]
fn a_triangle_with_one_vertex_behind_the_eye_as_drawn_by_hand() {
    // Two corners on the screen's bottom line and one behind the eye, whose mirror image is at the
    // middle of the top: in front of the eye the sides run down from that line, away from the
    // image, so nothing is on the screen.
    let corners = [[-1, -1, 1], [1, -1, 1], [0, -1, -1]];
    assert_eq!(ExactTriangle::new(corners, EIGHT, Part::Front).orientation(), -1);
    assert!(ExactTriangle::new(corners, EIGHT, Part::Front).pixels().is_empty());
    // With the line at half height, from (-1/2, 0) to (1/2, 0), the part in front is the strip
    // below it, widening.
    let corners = [[-1, 0, 2], [1, 0, 2], [0, -1, -1]];
    assert_eq!(
        ExactTriangle::new(corners, EIGHT, Part::Front).picture(),
        [
            "        ", "        ", "        ", "        ", "  ####  ", " ###### ", " ###### ",
            "########",
        ]
    );
}

#[test]
fn the_step_of_pixel_centres_stays_on_the_grid() {
    let mut rng = Rng::new(12);
    for _ in 0..300 {
        assert!(centre_step(random_viewport(&mut rng)) <= GRID / 4);
    }
}
