//! Polygons and triangles in pixels.

use super::area::{Place, of_polygon};
use super::{Errors, Shares, alphas, fixed};
use embedded_graphics::mock_display::MockDisplay;
use embedded_graphics::pixelcolor::{BinaryColor, Gray8, Rgb565};
use embedded_graphics::prelude::*;
use hither::{Alpha, Fill, Filled, Frame, I16F16, Polygon, Quick, Triangle, Viewport};
use host_tests::oracle::Rng;
use host_tests::record::{Mark, Record};

const SIDE: u32 = 48;

type Corner = [I16F16; 2];

/// All of it.
const OPAQUE: Alpha<()> = Alpha { color: (), alpha: 255 };

/// A number from `low` to `high`.
fn between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * (rng.below(1 << 30) as f64 / f64::from(1 << 30))
}

/// Corners on the grid of 256ths.
fn corners(points: &[Place]) -> Vec<Corner> {
    points.iter().map(|p| p.map(|v| fixed((v * 256.0).round() / 256.0))).collect()
}

/// The shares of a polygon, all of them drawn once.
fn smooth(corners: &[Corner]) -> Vec<f64> {
    let mut frame = Frame::new(Shares::new(SIDE, SIDE)).unwrap();
    frame.fill_shape_smooth(&Polygon::try_new(corners).unwrap(), OPAQUE);
    let (shares, counts) = alphas(frame.target(), (SIDE, SIDE));
    assert!(counts.iter().all(|count| *count <= 1), "{corners:?}: drawn twice");
    shares
}

/// How often hard edges draw each pixel.
fn hard(corners: &[Corner]) -> Vec<u8> {
    let mut frame = Frame::new(Record::new(SIDE, SIDE)).unwrap();
    frame.fill_shape(&Polygon::try_new(corners).unwrap(), ());
    frame.target_mut().take_counts()
}

/// Whether a centre is inside, by which edges a ray to the left meets: exact, in 512ths.
fn inside(corners: &[Corner], (x, y): (u32, u32)) -> bool {
    let place = |v: I16F16| i128::from(v.to_bits()) >> 7;
    let (x, y) = (512 * i128::from(x) + 256, 512 * i128::from(y) + 256);
    let mut around = 0;
    for (i, from) in corners.iter().enumerate() {
        let ([x0, y0], [x1, y1]) = (from.map(place), corners[(i + 1) % corners.len()].map(place));
        let down = y0 <= y && y < y1;
        let up = y1 <= y && y < y0;
        // On the edge counts as right of it.
        let side = (x - x0) * (y1 - y0) - (y - y0) * (x1 - x0);
        around += i32::from(down && side >= 0) - i32::from(up && side <= 0);
    }
    around != 0
}

fn measure(make: impl Fn(&mut Rng) -> Vec<Place>, number: u32) -> Errors {
    let mut rng = Rng::new(21);
    let mut errors = Errors::default();
    for _ in 0..number {
        let mut corners = corners(&make(&mut rng));
        if rng.below(2) == 0 {
            corners.reverse();
        }
        let exact: Vec<Place> = corners.iter().map(|p| p.map(|v| v.to_num::<f64>())).collect();
        let (shares, covered) = (smooth(&corners), hard(&corners));
        for y in 0..SIDE {
            for x in 0..SIDE {
                let at = (y * SIDE + x) as usize;
                errors.add(shares[at], of_polygon(&exact, (x, y)));
                assert_eq!(
                    covered[at],
                    u8::from(inside(&corners, (x, y))),
                    "{corners:?} at ({x}, {y})"
                );
            }
        }
    }
    errors
}

/// A star round a place: corners at rising angles, at any distance.
fn star(rng: &mut Rng, count: usize, [low, high]: [f64; 2]) -> Vec<Place> {
    let middle = [(); 2].map(|()| between(rng, 5.0, 43.0));
    (0..count)
        .map(|i| {
            let angle = (i as f64 + between(rng, 0.0, 0.9)) * core::f64::consts::TAU / count as f64;
            let radius = between(rng, low, high);
            [middle[0] + radius * angle.cos(), middle[1] + radius * angle.sin()]
        })
        .collect()
}

/// A straight line of some thickness.
fn line(rng: &mut Rng, [low, high]: [f64; 2]) -> Vec<Place> {
    let [[x0, y0], [x1, y1]] = [(); 2].map(|()| [(); 2].map(|()| between(rng, -5.0, 53.0)));
    let (dx, dy) = (x1 - x0, y1 - y0);
    let half = between(rng, low, high) / dx.hypot(dy) / 2.0;
    let (u, v) = (-dy * half, dx * half);
    vec![[x0 + u, y0 + v], [x1 + u, y1 + v], [x1 - u, y1 - v], [x0 - u, y0 - v]]
}

#[test]
fn shares_are_exact_areas_to_a_percent() {
    let check = |class: &str, errors: Errors| errors.check(class, 0.002, 0.01);
    check("triangles", measure(|rng| star(rng, 3, [1.0, 40.0]), 300));
    check(
        "stars of 4 to 64 corners",
        measure(
            |rng| {
                let n = rng.range(4, 64) as usize;
                star(rng, n, [1.0, 30.0])
            },
            300,
        ),
    );
    check(
        "circles of 64 corners",
        measure(
            |rng| {
                let r = between(rng, 0.3, 30.0);
                star(rng, 64, [r, r])
            },
            150,
        ),
    );
    check("specks", measure(|rng| star(rng, 5, [0.1, 0.9]), 1500));
    check("lines of up to 2 pixels", measure(|rng| line(rng, [0.05, 2.0]), 300));
    check(
        "level and upright boxes",
        measure(
            |rng| {
                let [x, y, w, h] = [(); 4].map(|()| between(rng, 0.0, 40.0));
                vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]]
            },
            200,
        ),
    );
    check(
        "teeth",
        measure(
            |rng| {
                let mut comb: Vec<Place> =
                    (0..30).map(|i| [1.3 * f64::from(i), between(rng, 0.0, 40.0)]).collect();
                comb.extend([[45.0, 47.0], [0.0, 46.0]]);
                comb
            },
            100,
        ),
    );
}

/// Polygons with hard edges are what triangles of `Quick<8>` are, and those that share edges have each pixel once.
#[test]
fn hard_edges_neither_gap_nor_overlap() {
    let mut rng = Rng::new(22);
    for _ in 0..300 {
        let whole = |v: i64| I16F16::from_bits((v * 256) as i32);
        let [a, b, c, d] =
            [(); 4].map(|()| [(); 2].map(|()| whole(rng.range(-300, 48 * 256 + 300))));
        let mut frame = Frame::new(Record::new(SIDE, SIDE)).unwrap().with_tier(Quick::<8>);
        let vertices = [a, b, c].map(|[x, y]| {
            // 2 X / W - 1, times 24.
            let w = I16F16::from_num(24);
            frame.snap(&hither::ClipVertex::new(x - w, w - y, I16F16::ZERO, w), [])
        });
        let _ = frame.draw_snapped(vertices.each_ref(), &Mark);
        assert_eq!(frame.target_mut().take_counts(), hard(&[a, b, c]), "{a:?} {b:?} {c:?}");
        // The frame's four sides and a place inside of it.
        let (zero, end) = (I16F16::ZERO, I16F16::from_num(SIDE));
        let middle = d.map(|v| v.max(zero).min(end));
        let ring = [[zero, zero], [end, zero], [end, end], [zero, end]];
        let mut counts = vec![0; (SIDE * SIDE) as usize];
        for i in 0..4 {
            let covered = hard(&[ring[i], ring[(i + 1) % 4], middle]);
            counts.iter_mut().zip(covered).for_each(|(count, covered)| *count += covered);
        }
        assert!(counts.iter().all(|count| *count == 1), "{middle:?}");
    }
}

#[test]
fn bad_shapes_are_nothing_or_an_error() {
    let at = |x: f64, y: f64| [fixed(x), fixed(y)];
    for few in [&[][..], &[at(3.0, 3.0)], &[at(3.0, 3.0), at(20.0, 9.0)], &[at(5.0, 5.0); 9]] {
        assert!(smooth(few).iter().all(|share| *share == 0.0));
        assert!(hard(few).iter().all(|count| *count == 0));
    }
    let many = [at(1.0, 1.0); 65];
    let error = Polygon::try_new(&many).unwrap_err();
    assert_eq!(error.to_string(), "a polygon of 65 corners: up to 64 are possible");
    // Beyond all sides, to the ends of the numbers.
    let [least, most] = [I16F16::MIN, I16F16::MAX];
    let all = [[least, least], [most, least], [most, most], [least, most]];
    assert!(smooth(&all).iter().all(|share| *share == 1.0));
    assert!(hard(&all).iter().all(|count| *count == 1));
    let mut rng = Rng::new(23);
    // Corners are rounded to it: so the reference has the same ones.
    let grid = |bits: i32| I16F16::from_bits(bits & !255);
    let mut compared = 0;
    for _ in 0..300 {
        let any: Vec<Corner> = (0..rng.below(65))
            .map(|_| {
                [(); 2].map(|()| match rng.below(4) {
                    0 => grid([least, most][rng.below(2) as usize].to_bits()),
                    1 => grid(rng.bits() as i32),
                    _ => grid(rng.range(-(8 << 16), 56 << 16) as i32),
                })
            })
            .collect();
        let (shares, covered) = (smooth(&any), hard(&any));
        assert!(shares.iter().all(|share| (0.0..=1.0).contains(share)));
        if any.len() < 65 && any.iter().flatten().all(|v| v.to_bits() % 256 == 0) {
            for (at, covered) in covered.iter().enumerate() {
                assert_eq!(*covered > 0, inside(&any, (at as u32 % SIDE, at as u32 / SIDE)));
            }
            compared += usize::from(covered.contains(&1));
        }
    }
    assert!(compared > 100, "{compared} that show something were compared");
}

/// In bands, at another origin and under a scissor it is the same.
#[test]
fn bands_are_the_same_to_the_bit() {
    let mut rng = Rng::new(24);
    for _ in 0..60 {
        let corners = corners(&star(&mut rng, 9, [1.0, 40.0]));
        let polygon = Polygon::try_new(&corners).unwrap();
        let viewport = Viewport::new(SIDE, SIDE).unwrap();
        let draw = |viewport: Viewport, rows: u32| {
            let mut frame = Frame::with_viewport(Shares::new(SIDE, rows), viewport);
            frame.fill_shape_smooth(&polygon, OPAQUE);
            let mut hard = Frame::with_viewport(Record::new(SIDE, rows), viewport);
            hard.fill_shape(&polygon, ());
            (alphas(frame.target(), (SIDE, rows)).0, hard.target_mut().take_counts())
        };
        let (mut smooth, mut hard) = (Vec::new(), Vec::new());
        for top in (0..SIDE).step_by(7) {
            let (band, hard_band) = draw(viewport.with_origin(0, -(top as i16)), 7.min(SIDE - top));
            smooth.extend(band);
            hard.extend(hard_band);
        }
        assert_eq!((smooth.clone(), hard.clone()), draw(viewport, SIDE));
        let scissor = hither::Rect { x0: 10, y0: 20, x1: 31, y1: 40 };
        let (cut, hard_cut) = draw(viewport.with_scissor(scissor), SIDE);
        for y in 0..SIDE {
            for x in 0..SIDE {
                let at = (y * SIDE + x) as usize;
                let shown = (10..31).contains(&x) && (20..40).contains(&y);
                assert_eq!(cut[at], if shown { smooth[at] } else { 0.0 });
                assert_eq!(hard_cut[at], if shown { hard[at] } else { 0 });
            }
        }
    }
}

/// On embedded-graphics' own display, which fails where a pixel is drawn twice or outside.
#[test]
fn shapes_are_drawable() {
    let triangle = Triangle([[0.5, 0.0], [7.5, 4.0], [0.5, 8.0]].map(|p| p.map(fixed)));
    let mut display = MockDisplay::<BinaryColor>::new();
    Filled::new(triangle, Fill::Hard { color: BinaryColor::On }).draw(&mut display).unwrap();
    display.assert_pattern(&[
        "#       ", "###     ", "#####   ", "####### ", "####### ", "#####   ", "###     ",
        "#       ",
    ]);

    let mut display = MockDisplay::<Gray8>::new();
    Filled::new(triangle, Fill::Smooth { color: Gray8::WHITE, over: Gray8::new(51) })
        .draw(&mut display)
        .unwrap();
    let corners = triangle.0;
    let shares = smooth(&corners);
    for y in 0..9 {
        for x in 0..9 {
            let share = shares[(y * SIDE + x) as usize];
            let shown = display.get_pixel(Point::new(x as i32, y as i32));
            let exact = (51.0 + share * 204.0).round() as u8;
            assert_eq!(shown, (share > 0.0).then_some(Gray8::new(exact)), "({x}, {y})");
        }
    }
    // All of it and more, and nothing.
    let [least, most] = [I16F16::MIN, I16F16::MAX];
    let all = [[least, least], [most, least], [most, most], [least, most]];
    let mut display = MockDisplay::<Rgb565>::new();
    Filled::new(
        Polygon::try_new(&all).unwrap(),
        Fill::Smooth { color: Rgb565::RED, over: Rgb565::BLUE },
    )
    .draw(&mut display)
    .unwrap();
    assert_eq!(display.affected_area(), display.bounding_box());
    let mut display = MockDisplay::<Rgb565>::new();
    Filled::new(Polygon::try_new(&all[..2]).unwrap(), Fill::Hard { color: Rgb565::RED })
        .draw(&mut display)
        .unwrap();
    assert_eq!(display.affected_area().size, Size::zero());
}

/// A display whose bounding box is not at the origin.
struct Offset(MockDisplay<Gray8>);

impl Dimensions for Offset {
    fn bounding_box(&self) -> embedded_graphics::primitives::Rectangle {
        embedded_graphics::primitives::Rectangle::new(Point::new(3, 2), Size::new(4, 3))
    }
}

impl DrawTarget for Offset {
    type Color = Gray8;
    type Error = core::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Gray8>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Self::Error> {
        self.0.draw_iter(pixels)
    }
}

#[test]
fn shapes_are_clipped_to_the_bounding_box() {
    let triangle = Triangle([[0.5, 0.0], [7.5, 4.0], [0.5, 8.0]].map(|p| p.map(fixed)));
    for fill in [
        Fill::Hard { color: Gray8::WHITE },
        Fill::Smooth { color: Gray8::WHITE, over: Gray8::BLACK },
    ] {
        let mut whole = MockDisplay::new();
        Filled::new(triangle, fill).draw(&mut whole).unwrap();
        let mut part = Offset(MockDisplay::new());
        Filled::new(triangle, fill).draw(&mut part).unwrap();
        for point in whole.bounding_box().points() {
            let expected = whole.get_pixel(point).filter(|_| part.bounding_box().contains(point));
            assert_eq!(part.0.get_pixel(point), expected, "{point}");
        }
    }
}
